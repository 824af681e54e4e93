"""The variables of a design and the margins at their values."""

from __future__ import annotations

import json
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from ._answers import Evaluation, Variable, _object
from ._arguments import listed, whole

if TYPE_CHECKING:
    from ._answers import Numbers
    from ._design import Design


class Problem:
    """The variables of a design's ``[optimize]`` and the margins at their values. Safe to use from several threads."""

    __slots__ = ("_core", "_names", "aim", "design", "full", "variables")

    def __init__(self, design: Design, *, full: bool = False) -> None:
        self._core = design._core.problem(full)
        self._names: tuple[list[str], list[str]] | None = None
        about = json.loads(self._core.about)
        self.design = design
        """The design."""
        self.full = full
        self.aim: str = about["aim"]
        """What is made better."""
        self.variables: tuple[Variable, ...] = tuple(_object(Variable, v) for v in about["variables"])
        """The variables in the order of the vector."""

    def __repr__(self) -> str:
        names = ", ".join(v.name for v in self.variables)
        return f"<Problem of {self.design.name!r}: {self.aim}; {names}>"

    @property
    def bounds(self) -> list[tuple[float, float]]:
        """Least and greatest value of each variable, as scipy takes them."""
        return [(v.min, v.max) for v in self.variables]

    @property
    def start(self) -> list[float]:
        """Values to start from."""
        return [v.start for v in self.variables]

    def _rows(self) -> tuple[list[str], list[str]]:
        if self._names is None:
            self._names = self._core.names(self.start)
        return self._names

    @property
    def objectives(self) -> list[str]:
        """Codes of the objectives."""
        return self._rows()[0]

    @property
    def limits(self) -> list[str]:
        """Codes of the limits."""
        return self._rows()[1]

    def evaluate(self, x: Iterable[float]) -> Evaluation:
        """Margins at ``x``. What is no clutch has ``refused``.

        Raises ``ValueError`` for another number of values, and for one out of its bounds.
        """
        values = listed("x", x)
        objectives, limits, least, violation, feasible, refused = self._core.evaluate(values)
        return Evaluation(tuple(values), tuple(objectives), tuple(limits), least, violation, feasible, refused)

    def evaluate_all(self, points: Iterable[Iterable[float]]) -> list[Evaluation]:
        """Margins at many points, rows of an array say, side by side on all cores; in their order. As :meth:`evaluate`."""
        rows = [listed("points", x) for x in points]
        return [
            Evaluation(tuple(x), tuple(objectives), tuple(limits), least, violation, feasible, refused)
            for x, (objectives, limits, least, violation, feasible, refused) in zip(
                rows, self._core.evaluate_all(rows), strict=True
            )
        ]

    def sample(self, count: float, *, seed: float = 1, first: float = 0) -> Numbers:
        """``count`` scrambled Sobol points of the box, a row each, from number ``first`` on: those of the command ``sample``."""
        import numpy as np

        asked = (whole(name, value, 0) for name, value in (("count", count), ("seed", seed), ("first", first)))
        return np.array(self._core.sample(*asked), dtype=np.float64)

    def design_at(self, x: Iterable[float]) -> Design:
        """The design with the values ``x``, and with the limits of ``[optimize]``, so that ``check`` holds it to what was
        searched for."""
        text = self._core.file_at(listed("x", x))
        return type(self.design).parse(text, self.design.folder, self.design._core.file)

    def __reduce__(self) -> tuple[Any, ...]:
        return _problem, (self.design, self.full)


def _problem(design: Design, full: bool) -> Problem:
    return Problem(design, full=full)
