"""Exceptions."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class DesignProblem:
    """One thing wrong with a design file."""

    file: str
    """Name of the file."""
    line: int | None
    """Line from 1; ``None`` where no line is at fault."""
    column: int | None
    """Column from 1."""
    key: str
    """Dotted path of the key, rows of arrays counted from 0; empty where no key is at fault."""
    found: str
    """What stands there."""
    allowed: str
    """What may stand there."""
    help: str
    """How to mend it."""
    also: tuple[str, ...] = ()
    """The other keys that take part."""


class DesignError(ValueError):
    """A refused design. The message has a line for each problem; :attr:`problems` has them in parts."""

    def __init__(self, message: str, problems: str = '{"file": "", "problems": []}') -> None:
        super().__init__(message, problems)
        found = json.loads(problems)
        self.file: str = found["file"]
        """Name of the file."""
        self.problems: tuple[DesignProblem, ...] = tuple(
            DesignProblem(
                file=self.file,
                line=p["line"],
                column=p["column"],
                key=p["key"],
                found=p["found"],
                allowed=p["allowed"],
                help=p["help"],
                also=tuple(other["key"] for other in p["also"]),
            )
            for p in found["problems"]
        )
        """What is wrong, in the order of the file."""

    def __str__(self) -> str:
        return str(self.args[0])


class NoClutch(ValueError):
    """The design file is in order, but no clutch comes about: a sprag that does not reach both races, say."""


class NotSized(NoClutch):
    """No clutch of the family does what is asked: the message says which limit prevents it, and the nearest possible."""

    def __init__(self, message: str, tried: str = "[]") -> None:
        super().__init__(message, tried)
        self.tried: tuple[dict[str, Any], ...] = tuple(json.loads(tried))
        """Every race space that was tried, as the command prints them with ``--json``."""

    def __str__(self) -> str:
        return str(self.args[0])


class Interrupted(KeyboardInterrupt):
    """Ctrl-C has ended a search, a fit or a map, whose answer so far is :attr:`found`. Who does not catch it sees a ``KeyboardInterrupt``."""

    def __init__(self, found: Any) -> None:
        super().__init__("stopped; what was found until then is the attribute `found` of this exception")
        self.found = found
        """The answer of what was stopped: an ``Optimum``, a ``Front``, an ``Identification`` or a ``Resonance``."""

    def __reduce__(self) -> tuple[Any, ...]:
        return Interrupted, (self.found,)
