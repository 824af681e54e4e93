"""First designs, comparisons, resonance: what the functions of the package answer beside those of :class:`Design`."""

from __future__ import annotations

import html
import json
import os
import typing
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from . import _core
from ._answers import Margin, _axes, _Common, _common, _object
from ._arguments import called
from ._files import write

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.axes import Axes

    from ._design import Design


@dataclass(frozen=True, repr=False)
class Page:
    """A page of its own, HTML: nothing is loaded from elsewhere, it prints on A4."""

    title: str
    """What it is."""
    html: str
    """Its text."""

    def save(self, path: str | os.PathLike[str], *, force: bool = False) -> Path:
        """Write it, UTF-8. A file that is there is replaced only with ``force``.

        Raises ``FileExistsError``.
        """
        return write(path, self.html, force=force)

    def __str__(self) -> str:
        return self.html

    def __repr__(self) -> str:
        return f"<Page {self.title!r}: {len(self.html)} characters of HTML>"

    def _repr_html_(self) -> str:
        # A frame of its own: the page's style is not the notebook's.
        return f'<iframe srcdoc="{html.escape(self.html)}" width="100%" height="800"></iframe>'


# ---- new, size


@dataclass(frozen=True)
class TriedSpace:
    """A race space that was tried."""

    race_space_mm: float
    """Gap between the tracks, mm."""
    count: int
    """Sprags."""
    length_mm: float | None
    """Length of the sprags, mm; ``None`` where nothing is carried."""
    width_mm: float | None
    """Width of the races, mm; ``None`` where no clutch comes of it, as the two below."""
    outside_mm: float | None
    """Outside diameter, mm."""
    mass_g: float | None
    """Mass of sprags and races, g."""
    carries_nm: float | None
    """Torque that it carries, N m."""
    decided_by: str
    """What decides."""
    possible: bool
    """Whether it does what is asked."""
    taken: bool
    """Whether it is the one of the answer."""
    verdict: str
    """The same in words."""


@dataclass(frozen=True)
class Taken:
    """A number of a new clutch that nobody has said."""

    what: str
    """What it is."""
    value: str
    """Its value, with its unit."""
    origin: str
    """Where it comes from, and what rests on it; ``from`` in JSON."""


@dataclass(frozen=True, repr=False)
class FirstDesign(_Common):
    """A first design, with every race space that was tried."""

    design: Design
    """The design: its file is the one that the command writes."""
    verdict: str
    """The answer in one line."""
    outside_mm: float
    """Outside diameter, mm."""
    width_mm: float
    """Width of the races, mm."""
    mass_g: float
    """Mass of sprags and races, g."""
    drag_torque_nm: float | None
    """Drag torque in overrun, N m."""
    heat_w: float | None
    """Heat of the drag in overrun, W."""
    sliding_rpm: float | None
    """Speed at which the races slide on the sprags in overrun, rev/min."""
    margins: tuple[Margin, ...]
    """One row for each limit."""
    tried: tuple[TriedSpace, ...]
    """Every race space tried, a row of ``tried``."""
    warnings: tuple[str, ...]
    """What one should not overlook."""
    taken: tuple[Taken, ...]
    """What it rests on that nobody has said."""

    def to_pandas(self) -> pd.DataFrame:
        """A row for each race space tried. Needs pandas."""
        import dataclasses

        import pandas as pd

        return pd.DataFrame([dataclasses.asdict(row) for row in self.tried])


def first_of(found: tuple[str, str, str, str, Any], design: Design) -> FirstDesign:
    shared, data = _common(found[0], found[1])
    taken = tuple(Taken(row["what"], row["value"], row["from"]) for row in json.loads(found[2]))
    return _object(FirstDesign, data, design=design, verdict=found[3], taken=taken, **shared)


# ---- compare


@dataclass(frozen=True)
class ComparedDesign:
    """A design of a comparison."""

    name: str
    """Its name."""
    file: str
    """Where it comes from."""
    design_hash: str
    """SHA-256 of its file."""
    passed: bool
    """Whether every required limit is held; ``pass`` in JSON."""
    deciding: str | None
    """Code of the required limit with the least margin."""


@dataclass(frozen=True)
class ComparedInput:
    """An input that differs."""

    path: str
    """Its key in the file, tables included."""
    unit: str
    """Its unit; empty for a pure number."""
    values: tuple[Any, ...]
    """Its values; ``None`` where a design has none."""


@dataclass(frozen=True)
class ComparedFigure:
    """A figure."""

    key: str
    """Its key, the unit at the end."""
    unit: str
    """Its unit."""
    values: tuple[float | None, ...]
    """Its values."""


@dataclass(frozen=True)
class ComparedMargin:
    """A limit; ``None`` where a design does not name it."""

    code: str
    """Its code."""
    held: tuple[bool | None, ...]
    """Whether it is held."""
    margins: tuple[float | None, ...]
    """Its margin as a number."""
    required: tuple[bool | None, ...]
    """Whether it counts for the verdict."""
    torque_capacities_nm: tuple[float | None, ...]
    """Torque at which it would be reached, N m, where it depends on torque."""


@dataclass(frozen=True)
class ComparedScene:
    """A scene; ``None`` where a design does not have it or nothing is known."""

    name: str
    """Its name."""
    required_friction: tuple[float | None, ...]
    """Static friction from which on it sticks."""
    slip_margin: tuple[float | None, ...]
    """Static over required friction, less 1."""
    contact_margin: tuple[float | None, ...]
    """Contact margin."""


@dataclass(frozen=True, repr=False)
class Comparison(_Common):
    """Designs side by side; every list of values has one for each design, in their order."""

    _compared: _core.Compared = field(repr=False, compare=False)
    verdict: str
    """The answer in one line."""
    designs: tuple[ComparedDesign, ...]
    """The designs, the one before first."""
    inputs: tuple[ComparedInput, ...]
    """Inputs that differ."""
    figures: tuple[ComparedFigure, ...]
    """Figures side by side."""
    margins: tuple[ComparedMargin, ...]
    """Margins side by side."""
    scenes: tuple[ComparedScene, ...]
    """Scenes side by side."""

    def to_pandas(self) -> pd.DataFrame:
        """Margins by code, a column for each design. Needs pandas."""
        import pandas as pd

        names = [f"{chr(65 + i)}, {d.name}" for i, d in enumerate(self.designs)]
        table = pd.DataFrame([row.margins for row in self.margins], columns=names, dtype="float64")
        table.index = pd.Index([row.code for row in self.margins], name="code")
        return table

    def page(self) -> Page:
        """The page of ``compare --report``: drawings over one another, curves, tables."""
        return Page("Comparison", self._compared.page(called("compare", [d.file for d in self.designs])))

    def __reduce__(self) -> typing.NoReturn:
        raise TypeError("a comparison cannot be pickled: take to_dict(), or the designs")


def comparison_of(found: _core.Compared) -> Comparison:
    common, body, verdict = found.parts()
    shared, data = _common(common, body)
    return _object(Comparison, data, _compared=found, verdict=verdict, **shared)


# ---- resonance


@dataclass(frozen=True)
class PeriodicState:
    """A motion that repeats with the excitation; numbers are ``None`` where none was found."""

    frequency_hz: float
    """Frequency of the excitation, Hz."""
    amplitude_nm: float
    """Its amplitude, N m."""
    state: str
    """What the clutch does: ``rolls``, ``slips``, ``lifts-off``, ``overloaded``, ``disengages``, ``not-found``."""
    stable: bool | None
    """Whether a small disturbance dies out; ``None`` where that is not known."""
    required_static_friction: float | None
    """Static friction that rolling needs."""
    slip_margin: float | None
    """Static over required friction, less 1."""
    contact_margin: float | None
    """Smallest normal force at the inner contact over that of the static load."""
    normal_min_n: float | None
    """Smallest normal force of one sprag at the inner contact, N."""
    normal_max_n: float | None
    """Largest normal force of one sprag at the inner contact, N."""
    slip_inner_mm: float | None
    """Path of slip at the inner contact in a period, mm."""
    open_s: float | None
    """Time without contact in a period, s."""
    drift_rad: float | None
    """By how much the races go on against one another in a period, rad."""
    other_state: str | None
    """Another state at the same frequency and amplitude; which of them comes is for the start to say."""


@dataclass(frozen=True, repr=False)
class Resonance(_Common):
    """Periodic states of a torsional excitation."""

    verdict: str
    """The answer in a sentence."""
    scenario: str
    """Name of the scenario."""
    states: tuple[PeriodicState, ...]
    """Each state, a row of ``ResonanceAnswer::states``."""
    rolls: bool
    """Whether both contacts roll everywhere."""
    static_friction: float
    """Static friction that there is."""
    amplitudes_left: int
    """Amplitudes that a stop has left out."""
    eigenfrequencies: tuple[dict[str, Any], ...]
    """Small free swings of both races about the mean torque with the clutch engaged, lowest first."""

    def to_pandas(self) -> pd.DataFrame:
        """A row for each state. Needs pandas."""
        import dataclasses

        import pandas as pd

        return pd.DataFrame([dataclasses.asdict(row) for row in self.states])

    def plot(self, ax: Axes | None = None) -> Axes:
        """Static friction that rolling needs over frequency, a curve for each amplitude, with the friction that there is. Needs matplotlib."""
        ax = _axes(ax)
        amplitudes = list(dict.fromkeys(s.amplitude_nm for s in self.states))
        for amplitude_nm in amplitudes:
            rows = [s for s in self.states if s.amplitude_nm == amplitude_nm and s.required_static_friction is not None]
            needed = [typing.cast(float, s.required_static_friction) for s in rows]
            ax.plot([s.frequency_hz for s in rows], needed, marker=".", label=f"{amplitude_nm:g} Nm")
        ax.axhline(self.static_friction, color="black", linewidth=0.8, label="there is")
        ax.set_xlabel("Frequency, Hz")
        ax.set_ylabel("Static friction that rolling needs")
        ax.set_title(self.scenario)
        if len(amplitudes) <= 10:
            ax.legend()
        return ax
