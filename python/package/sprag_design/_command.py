"""The command ``sprag-design``, as the wheel installs it."""

from __future__ import annotations

import sys

from . import _core


def main() -> int:
    """Run the command with the arguments of this process; the exit code."""
    return _core.run_command(["sprag-design", *sys.argv[1:]])
