"""``python -m sprag_design``: the command."""

from ._command import main

raise SystemExit(main())
