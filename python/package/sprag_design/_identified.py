"""Unknown parameters found from what was measured."""

from __future__ import annotations

import csv
import io
import numbers
import os
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from . import _core
from ._answers import _columns, _Common, plain_of
from ._arguments import called, one, whole
from ._errors import Interrupted

if TYPE_CHECKING:
    import pandas as pd

    from ._design import Design


@dataclass(frozen=True)
class FoundUnknown:
    """An unknown and what the data say of it, in the unit of its name; ``None`` where a search was stopped before it was known."""

    name: str
    """Name: a variable of ``[optimize]`` or the dotted path of a number in the file."""
    min: float
    """Lower bound."""
    max: float
    """Upper bound."""
    before: float | None
    """Value in the design that was given."""
    value: float
    """Value found."""
    half_width_95: float | None
    """Half the width of its 95 % interval by the scatter of the data; ``None`` also where they give none."""
    half_width_95_by_law: float | None
    """The same by the error of the contact law."""
    sigma: float | None
    """Its standard error by the scatter."""
    determined: bool | None
    """Whether the data determine it."""
    note: str | None
    """What keeps them from it."""


@dataclass(frozen=True)
class Observed:
    """A measured number beside the model, both in the unit of the quantity's name."""

    line: int
    """Line of the table, from 1, the head counted."""
    label: str
    """Its label."""
    use: str
    """``fit``, or ``check``: compared only."""
    quantity: str
    """The column that it stands in."""
    torque_nm: float | None
    """Torque at which it was seen, N m."""
    observed: float
    """What was measured."""
    predicted: float | None
    """What the design found says."""
    relative: float | None
    """Predicted over observed, less 1."""
    decided_by: str | None
    """The limit that sets a threshold."""
    why_not: str | None
    """Why the design says nothing."""


@dataclass(frozen=True, repr=False)
class Identification(_Common):
    """Unknown parameters of a design, found from measured or published numbers; of a search that Ctrl-C ended the fields that are
    ``None`` were not looked at."""

    verdict: str
    """The answer in a sentence."""
    design: Design
    """The design with the values found, its file the one that the command writes."""
    determined: bool | None
    """Whether the data determine every unknown."""
    converged: bool
    """Whether the last step no longer mattered."""
    evaluations: int
    """Evaluations of all fitted observations."""
    unknowns: tuple[FoundUnknown, ...]
    """Each unknown."""
    observations: tuple[Observed, ...] | None
    """Each observation beside the model."""
    correlation: tuple[tuple[float, ...], ...] | None
    """Correlation of what was found, by the numbers of the unknowns; ``None``: not known."""
    residual_sigma: float | None
    """Standard deviation of the scaled residuals; ``None``: no degree of freedom."""
    degrees_of_freedom: int | None
    """Observations less unknowns."""
    singular_ratio: float | None
    """Least over largest singular value of the scaled sensitivities."""
    sums_of_squares: tuple[float, ...] | None
    """Sum of the squared scaled residuals at the end of each start."""
    remarks: tuple[str, ...] | None
    """What the tables do not say."""

    def to_pandas(self) -> pd.DataFrame:
        """A row for each observation; of a search that was stopped one for each unknown. Needs pandas."""
        return _columns(self.unknowns if self.observations is None else self.observations)


def identify(design: Design, data: Any, unknowns: Mapping[str, Any], starts: float, seed: float, evaluations: float) -> Identification:
    """What :meth:`Design.identify` answers."""
    named, table = _table(data)
    bounds = []
    for name, between in unknowns.items():
        row = list(between) if isinstance(between, Iterable) and not isinstance(between, str) else []
        if len(row) != 2:
            raise ValueError(f"unknown {name!r}: {between!r}: allowed: its bounds, such as (0.05, 0.2)")
        bounds.append((name, one(name, row[0]), one(name, row[1])))
    limits = whole("starts", starts, 1, 1000), whole("seed", seed, 0), whole("evaluations", evaluations, 1, 1_000_000)
    usual = {"starts": (limits[0], 4), "seed": (limits[1], 1), "evaluations": (limits[2], 200)}
    by = called("design.identify", named, {name: (low, high) for name, low, high in bounds}, **usual)
    common, body, verdict, made, interrupted = _core.identify(design._core, table, named, bounds, *limits, by)
    found = plain_of(Identification, (common, body), design=type(design)(made), verdict=verdict)
    if interrupted:
        raise Interrupted(found)
    return found


def _table(data: Any) -> tuple[str, str]:
    """What stands for the data in messages, and they as CSV."""
    if isinstance(data, (str, os.PathLike)):
        return os.fspath(data), Path(data).read_text(encoding="utf-8")
    keys = getattr(data, "keys", None)
    if keys is None:
        raise TypeError(f"data {data!r}: allowed: a file (CSV), columns by name (dict), a table of pandas")
    names = [str(name) for name in keys()]
    columns = [_column(name, data[key]) for name, key in zip(names, keys(), strict=True)]
    lengths = dict(zip(names, map(len, columns), strict=True))
    if len(set(lengths.values())) > 1:
        raise ValueError(f"data: columns of different lengths: {lengths}")
    text = io.StringIO()
    rows = csv.writer(text, lineterminator="\n")
    rows.writerows([names, *zip(*columns, strict=True)])
    return "data", text.getvalue()


def _column(name: str, values: Any) -> list[str]:
    """The cells of a column; what is not known says nothing."""
    if isinstance(values, (str, bytes)) or not isinstance(values, Iterable):
        raise TypeError(f"data: {name}: {values!r}: allowed: values in a row")
    return [_cell(value) for value in values]


def _cell(value: Any) -> str:
    """A text, or a number to its last digit; nothing for ``None``, NaN and what pandas has for them."""
    text = repr(float(value)) if isinstance(value, numbers.Real) else str(value)
    return "" if text in ("None", "nan", "<NA>") else text
