"""What the questions answer: frozen classes whose names end in their unit, with arrays, tables and plots.

``to_dict`` of each is the object that the command prints with ``--json``, without the keys that name tool and design.
"""

from __future__ import annotations

import dataclasses
import functools
import html
import json
import types
import typing
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, TypeVar

from . import _core

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt
    import pandas as pd
    from matplotlib.axes import Axes

    from ._design import Design

    Numbers = npt.NDArray[np.float64]

T = TypeVar("T")

_KEYS = {"passed": "pass", "film_over_roughness": "lambda"}
"""Attributes whose key in JSON is a word of Python."""


def _value(kind: Any, data: Any) -> Any:
    """``data`` of JSON as a value of the type ``kind``."""
    if data is None:
        return None
    origin, args = typing.get_origin(kind), typing.get_args(kind)
    if origin in (typing.Union, types.UnionType):
        return _value(next(a for a in args if a is not type(None)), data)
    if origin is tuple:
        return tuple(_value(args[0], item) for item in data)
    if dataclasses.is_dataclass(kind) and isinstance(kind, type):
        return _object(kind, data)
    return data


@functools.lru_cache(maxsize=None)
def _hints(kind: Any) -> dict[str, Any]:
    # The design is no part of JSON, and its module comes later.
    return typing.get_type_hints(kind, localns={"Design": object})


def _object(kind: type[T], data: dict[str, Any], **more: Any) -> T:
    """An object of JSON as a class of this module; keys that it does not have are left to ``to_dict``."""
    hints = _hints(typing.cast(Any, kind))
    names = [f.name for f in dataclasses.fields(kind) if f.name not in more]  # type: ignore[arg-type]
    return kind(**{n: _value(hints[n], data.get(_KEYS.get(n, n))) for n in names}, **more)


def _columns(rows: typing.Iterable[Any]) -> pd.DataFrame:
    import pandas as pd

    listed = list(rows)
    table = pd.DataFrame([dataclasses.asdict(row) for row in listed])
    # A number that a row does not have is NaN there.
    hints = _hints(typing.cast(Any, type(listed[0]))) if listed else {}
    return table.astype({name: "float64" for name in table.columns if hints[name] == (float | None)})


def _axes(ax: Axes | None) -> Axes:
    if ax is not None:
        return ax
    import matplotlib.pyplot as plt

    return plt.subplots(layout="constrained")[1]


def _html_table(head: typing.Iterable[str], rows: typing.Iterable[typing.Iterable[str]]) -> str:
    def line(cells: typing.Iterable[str], tag: str) -> str:
        return "<tr>" + "".join(f"<{tag}>{html.escape(cell)}</{tag}>" for cell in cells) + "</tr>"

    return f"<table>{line(head, 'th')}{''.join(line(row, 'td') for row in rows)}</table>"


def _figure(value: float | None, spec: str = ".4g") -> str:
    """A number in words; nothing where there is none."""
    return "" if value is None else format(value, spec)


@dataclass(frozen=True)
class LeftOut:
    """A term that the model leaves out."""

    term: str
    """The term."""
    why: str
    """Why it is left out."""
    cost: str
    """What that costs, with its source; "not estimated" where nobody knows."""


@dataclass(frozen=True)
class _Common:
    """What all answers share."""

    run_time_s: float
    """Time of the computation alone, s."""
    left_out: tuple[LeftOut, ...]
    """What the model leaves out, each with its reason and its cost."""
    error_estimate: Any
    """How far off the answer is, where something was integrated or iterated: a number, or numbers by name."""
    _data: dict[str, Any] = field(repr=False, compare=False)

    def to_dict(self) -> dict[str, Any]:
        """The object of ``--json``: figures in the units of their names, ``None`` where there is none."""
        return typing.cast("dict[str, Any]", json.loads(json.dumps(self._data)))

    def __repr__(self) -> str:
        return f"<{type(self).__name__}: {self._said()}>"

    def _said(self) -> str:
        """What was found, in one line."""
        return str(getattr(self, "verdict", ""))


def _common(text: str, body: str) -> tuple[dict[str, Any], dict[str, Any]]:
    """Fields that all answers share, and the figures."""
    shared = json.loads(text)
    data = json.loads(body)
    left_out = tuple(_object(LeftOut, entry) for entry in shared["left_out"])
    whole = {k: v for k, v in shared.items() if k != "error_estimate" or v is not None} | data
    fields = {
        "run_time_s": shared["run_time_s"],
        "left_out": left_out,
        "error_estimate": shared["error_estimate"],
        "_data": whole,
    }
    return fields, data


# ---- check


class _Shown:
    """A row that has a margin."""

    margin: float
    """Margin as a number; 0 or more is held."""
    slip_margin: float | None
    """Of slip rows static over required friction, less 1."""

    @property
    def shown_margin(self) -> float:
        """The margin as the command shows it: of slip rows the slip margin, which is held against the wanted one."""
        return self.margin if self.slip_margin is None else self.slip_margin


@dataclass(frozen=True)
class Margin(_Shown):
    """A limit: what is demanded, what is allowed, the margin between them."""

    code: str
    """Code for scripts, such as ``hoop-inner``, ``slip:high-6``."""
    name: str
    """Name for people."""
    demand: float | None
    """Demand, in ``unit``; ``None`` where no friction suffices, the scene is overloaded or the curve ends below the row's
    torque."""
    allowable: float | None
    """Allowable, in ``unit``; of slip the wanted slip margin."""
    unit: str
    """Unit of demand and allowable; ``1`` of a pure number."""
    margin: float
    """Margin as a number; 0 or more is held. Of slip rows it is against the wanted slip margin: people read ``slip_margin``."""
    torque_capacity_nm: float | None
    """Torque at which the limit would be reached, N m, where it depends on torque."""
    capacity_beyond_end: bool
    """Whether the limit is not reached before the curve ends: the capacity is then at least that much."""
    required: bool
    """Whether it counts for the verdict; the others are shown only."""
    computed: bool
    """False where a run met its limit of work or the clutch does not engage: neither held nor broken."""
    overloaded: bool
    """Whether the row's scene or torque goes beyond the end of the curve."""
    held: bool
    """Whether the limit is held."""
    slip_margin: float | None
    """Of slip rows static over required friction, less 1; ``None`` elsewhere."""


@dataclass(frozen=True)
class Deciding:
    """The required limit with the least margin."""

    code: str
    """Code of that limit."""
    name: str
    """Name of that limit."""
    margin: float
    """Its margin as a number."""


@dataclass(frozen=True)
class Capacity:
    """A torque capacity and the limit that sets it."""

    code: str
    """Code of the limit that sets it."""
    name: str
    """Name of that limit."""
    torque_capacity_nm: float
    """That torque, N m."""


@dataclass(frozen=True)
class End:
    """Where the static curve ends."""

    reason: str
    """Why the curve ends there."""
    torque_nm: float
    """Torque at the end, N m."""
    beyond: dict[str, Any] | None
    """What comes after it; absent where no equilibrium is found there."""


@dataclass(frozen=True)
class OverrunPoint:
    """Steady overrun at one speed."""

    race: str
    """Race that runs: ``outer`` or ``inner``; the other stands."""
    speed_rpm: float
    """Speed of that race, rev/min."""
    drag_torque_nm: float
    """Drag torque of the whole clutch, N m."""
    normal_inner_n: float
    """Normal force of one sprag at the inner contact, N."""
    normal_outer_n: float
    """The same at the outer contact, N."""
    friction: float
    """Coefficient of friction of the sliding contact at that speed: the inner one, in a driven cage the outer one."""
    growth_rate_per_s: float | None
    """Growth of a small swing of the sprags about the equilibrium, 1/s; positive: the equilibrium does not stay; ``None``
    where they are off or nothing slides."""
    swing_frequency_hz: float | None
    """Frequency of that swing, Hz."""
    lifted_off: bool
    """Whether the sprags are off the race that they slide on."""
    outer_race_growth_um: float
    """Growth of the outer track by rotation, um."""
    rotation_hoop_outer_mpa: float
    """Hoop stress of the outer race by rotation, MPa."""


@dataclass(frozen=True)
class Overrun:
    """Overrun against speed."""

    centrifugal: str
    """What the centrifugal force does to the sprags: ``engaging``, ``disengaging`` or ``neutral``."""
    gamma_deg: float
    """Azimuth of the outer contact arc's centre ahead of the centroid at first contact at rest, deg; positive: engaging at
    speed."""
    drag_torque_slow_nm: float
    """Drag torque of the slowest overrun, without centrifugal force, N m."""
    points: tuple[OverrunPoint, ...]
    """All speeds looked at: first the outer race runs, then the inner one."""
    outer_race_turns: bool
    """Whether the design names a speed of the outer race, in a limit or a scene."""
    named: tuple[dict[str, Any], ...]
    """The overruns that the design names."""
    warning: str | None
    """A warning where the equilibrium does not stay at a speed that the design names, or, where it names none, at any;
    ``None`` where it does. A note where only a limit names that speed and the swing takes longer than 1 s to grow tenfold."""
    passing: str | None
    """A note where that is so at other speeds only, on the way through them."""
    lift_off_more_drag_rpm: float | None
    """The speed of lift-off where the spring drags a tenth more, rev/min; ``None``: no lift-off up to
    ``lift_off_searched_to_rpm``."""


@dataclass(frozen=True, repr=False)
class Check(_Common):
    """A design held against each of its limits."""

    verdict: str
    """The answer in one line."""
    margins: tuple[Margin, ...]
    """One row for each limit."""
    passed: bool
    """Whether every required limit is held; ``pass`` in JSON."""
    deciding: Deciding | None
    """The required limit with the least margin."""
    lowest_torque_capacity: Capacity | None
    """The lowest torque at which a required limit would be reached."""
    nominal_torque_capacity: Capacity | None
    """The lowest among the limits that are held at nominal torque."""
    peak_torque_capacity: Capacity | None
    """The lowest among the limits that are held at peak torque."""
    end: End
    """Where the static curve ends, which may be below the torques of the limits."""
    lift_off_rpm: float | None
    """Speed of the outer race at which the sprags lift off the inner one, rev/min, in a driven cage of the inner race at
    which they lift off the outer one; ``None``: contact is kept up to ``lift_off_searched_to_rpm``."""
    lift_off_searched_to_rpm: float
    """How far a lift-off was looked for, rev/min."""
    overrun: Overrun
    """Overrun against speed."""
    at_speed: dict[str, Any] | None
    """What the rows without a scene leave out, which are at rest; ``None``: no scene carries torque while the races turn."""
    running: dict[str, Any] | None
    """Radii as made and as run; ``None``: the races run as made."""
    run_out: dict[str, Any] | None
    """Load round the circumference; ``None``: the design names no eccentricity."""
    notes: tuple[str, ...]
    """What is said of this design beside the rows, warnings first, then how the rows are to be read; a line each."""

    def margin(self, code: str) -> Margin:
        """The row of that code.

        Raises ``KeyError`` with the codes that there are.
        """
        for row in self.margins:
            if row.code == code:
                return row
        raise KeyError(f"no margin {code}; there are: {', '.join(row.code for row in self.margins)}")

    def to_pandas(self) -> pd.DataFrame:
        """The rows as a table, by code. Needs pandas."""
        table = _columns(self.margins).set_index("code")
        table.insert(list(table.columns).index("margin") + 1, "slip_margin", table.pop("slip_margin"))
        return table

    def plot(self, ax: Axes | None = None) -> Axes:
        """Margins as bars, of slip rows the slip margin. Needs matplotlib."""
        ax = _axes(ax)
        rows = self.margins[::-1]
        colours = ["0.75" if not r.required else "tab:green" if r.held else "tab:red" for r in rows]
        # Where nothing is demanded the margin is a million.
        ax.barh([r.code for r in rows], [min(100.0 * r.shown_margin, 150.0) for r in rows], color=colours)
        ax.axvline(0.0, color="black", linewidth=0.8)
        ax.set_xlabel("Margin, % (cut at 150; grey: shown only)")
        return ax

    def _repr_html_(self) -> str:
        def cells(r: Margin) -> tuple[str, ...]:
            slips = r.code.startswith("slip:")
            allowable = None if r.allowable is None else 100.0 * r.allowable if slips else r.allowable
            wanted = f"{_figure(allowable)} % wanted" if slips and allowable is not None else _figure(allowable)
            unit = r.unit if r.unit != "1" else "μ" if slips else ""
            margin = "" if r.demand is None and not r.computed else f"{100.0 * r.shown_margin:.3g} %"
            verdict = "shown" if not r.required else "not computed" if not r.computed else "held" if r.held else "NOT HELD"
            return r.code, _figure(r.demand), wanted, unit, margin, verdict

        head = ("Limit", "Demand", "Allowable", "Unit", "Margin", "Verdict")
        notes = [(note, f"<p>{html.escape(note)}</p>") for note in self.notes]
        warnings = "".join(line for note, line in notes if note.startswith("Warning"))
        others = "".join(line for note, line in notes if not note.startswith("Warning"))
        more = f"<details><summary>Notes</summary>{others}</details>" if others else ""
        return f"<p><b>{html.escape(self.verdict)}</b></p>{warnings}{_html_table(head, map(cells, self.margins))}{more}"


def check_of(found: tuple[str, str, str]) -> Check:
    shared, data = _common(found[0], found[1])
    return _object(Check, data, verdict=found[2], **shared)


# ---- stiffness


@dataclass(frozen=True)
class Junction:
    """Where one inner arc hands over to the next."""

    torque_nm: float
    """Torque at which it does, N m."""
    alpha_rad: float
    """Rotation of the sprag there, rad."""
    arc: int
    """Number of the arc that ends here, from 1."""


_POINT = (
    "torque_nm",
    "normal_inner_n",
    "normal_outer_n",
    "tan_omega",
    "tan_nu",
    "alpha_rad",
    "windup_deg",
    "k_secant_nm_per_rad",
    "k_tangent_nm_per_rad",
    "hertz_inner_mpa",
    "hertz_inner_error_mpa",
    "hertz_inner_pointwise_mpa",
    "hertz_outer_mpa",
)


@dataclass(frozen=True, eq=False, repr=False)
class Curve:
    """The static curve by one contact law: arrays with one value for each torque that the curve reaches."""

    contact: str
    """The contact law."""
    torque_nm: Numbers
    """Torque asked for, N m."""
    normal_inner_n: Numbers
    """Normal force of one sprag at the inner contact, N."""
    normal_outer_n: Numbers
    """The same at the outer contact, N."""
    tan_omega: Numbers
    """Tangential over normal force at the inner contact."""
    tan_nu: Numbers
    """The same at the outer contact."""
    alpha_rad: Numbers
    """Rotation of the sprag, rad."""
    windup_deg: Numbers
    """Windup of the races against each other, deg."""
    k_secant_nm_per_rad: Numbers
    """Secant stiffness, N m/rad."""
    k_tangent_nm_per_rad: Numbers
    """Tangent stiffness, N m/rad."""
    hertz_inner_mpa: Numbers
    """Peak Hertz pressure at the inner contact, MPa."""
    hertz_inner_error_mpa: Numbers
    """How far that is off at most: the curve's interpolation, and the pressure's shape while a junction lies under the
    contact."""
    hertz_inner_pointwise_mpa: Numbers
    """Peak Hertz pressure there with the radius at the contact point alone, as the paper takes it, MPa."""
    hertz_outer_mpa: Numbers
    """Peak Hertz pressure at the outer contact, MPa."""
    arc: npt.NDArray[np.int64]
    """Inner arc in contact, from 1."""
    straddles_junction: npt.NDArray[np.bool_]
    """Whether the inner contact lies on two arcs."""
    beyond_end_nm: tuple[float, ...]
    """Torques asked for that the curve does not reach, N m; ``beyond_end`` in JSON."""
    junctions: tuple[Junction, ...]
    """Where one arc hands over to the next."""
    end: End
    """Where the curve ends."""

    def to_pandas(self) -> pd.DataFrame:
        """A row for each torque. Needs pandas."""
        import pandas as pd

        return pd.DataFrame({n: getattr(self, n) for n in (*_POINT, "arc", "straddles_junction")})

    def _said(self) -> str:
        end = f"curve ends {self.end.reason} at {self.end.torque_nm:.5g} Nm"
        if not len(self.torque_nm):
            return f"{self.contact}, no torque that it reaches; {end}"
        return f"{self.contact}, {self.windup_deg[-1]:.4g} deg at {self.torque_nm[-1]:.5g} Nm; {end}"

    def __repr__(self) -> str:
        return f"<Curve: {self._said()}>"


def _curve(law: dict[str, Any]) -> Curve:
    import numpy as np

    points = law["points"]
    numbers = {n: np.array([p[n] for p in points], dtype=np.float64) for n in _POINT}
    return Curve(
        contact=law["contact"],
        arc=np.array([p["arc"] for p in points], dtype=np.int64),
        straddles_junction=np.array([p["straddles_junction"] for p in points], dtype=np.bool_),
        beyond_end_nm=tuple(law["beyond_end"]),
        junctions=tuple(_object(Junction, j) for j in law["junctions"]),
        end=_object(End, law["end"]),
        **numbers,
    )


@dataclass(frozen=True, eq=False, repr=False)
class Stiffness(_Common):
    """Static curves at rest. The figures of the first law stand at the top: ``stiffness.windup_deg``."""

    laws: tuple[Curve, ...]
    """A curve for each contact law asked for."""
    short_of_nm: float | None
    """The ``max_torque_nm`` that was asked for, where every curve ends before it: the torques go up to the last end. ``None``: they go
    up to it."""

    def _said(self) -> str:
        short = "" if self.short_of_nm is None else f"; short of the {self.short_of_nm:g} Nm asked for"
        return "; ".join(law._said() for law in self.laws) + short

    @property
    def torque_nm(self) -> Numbers:
        """Torques of the first law's curve."""
        return self.laws[0].torque_nm

    @property
    def windup_deg(self) -> Numbers:
        """Windup by the first law."""
        return self.laws[0].windup_deg

    @property
    def normal_inner_n(self) -> Numbers:
        """Normal force of one sprag at the inner contact, by the first law."""
        return self.laws[0].normal_inner_n

    @property
    def k_tangent_nm_per_rad(self) -> Numbers:
        """Tangent stiffness by the first law."""
        return self.laws[0].k_tangent_nm_per_rad

    @property
    def k_secant_nm_per_rad(self) -> Numbers:
        """Secant stiffness by the first law."""
        return self.laws[0].k_secant_nm_per_rad

    def to_pandas(self) -> pd.DataFrame:
        """A row for each law and torque. Needs pandas."""
        import pandas as pd

        return pd.concat([law.to_pandas().assign(contact=law.contact) for law in self.laws], ignore_index=True)

    def plot(self, ax: Axes | None = None, *, label: str = "") -> Axes:
        """Torque over windup, a curve for each law. ``label``: what tells these curves from others in the same axes, such as the name
        of a design; left out they are numbered. Needs matplotlib."""
        ax = _axes(ax)
        taken = [line.get_label() for line in ax.lines]
        for law in self.laws:
            name = f"{label}, {law.contact}" if label and len(self.laws) > 1 else label or law.contact
            again = sum(other == name or str(other).startswith(f"{name} (") for other in taken)
            ax.plot(law.windup_deg, law.torque_nm, marker=".", label=f"{name} ({again + 1})" if again else name)
        ax.set_xlabel("Windup, deg")
        ax.set_ylabel("Torque, Nm")
        # The curves rise to the right: what they leave free is above on the left.
        ax.legend(loc="upper left")
        return ax


def stiffness_of(found: tuple[str, str], asked_nm: float | None) -> Stiffness:
    shared, data = _common(*found)
    laws = tuple(_curve(law) for law in data["laws"])
    short = asked_nm is not None and asked_nm > max(law.end.torque_nm for law in laws)
    return Stiffness(laws=laws, short_of_nm=asked_nm if short else None, **shared)


# ---- simulate


@dataclass(frozen=True)
class SlipHeat:
    """Work, heat and wear of slip at one contact of one sprag."""

    work_j: float
    """Work of friction, J."""
    power_w: float
    """Largest power of friction, W."""
    flux_w_per_mm2: float
    """Largest heat of both bodies over the Hertz flat, W/mm2."""
    flash_k: float
    """Largest rise of the hottest place above the bodies, K."""
    peclet: float
    """Peclet number then; below some 5 heat goes sideways too, and the rise is less."""
    sprag_wear_um: float | None
    """Depth worn off the sprag if asperities carry all, um; ``None`` without ``[lubrication]``."""
    race_wear_um: float | None
    """Depth worn off the place of the race that most slips over, um; at most, ``None`` as above."""


@dataclass(frozen=True)
class WorstSlip:
    """The slip with the most work at one contact."""

    from_s: float
    """When it begins, s."""
    time_s: float
    """Its time in slip, s."""
    path_mm: float
    """Its path, mm."""
    heat: SlipHeat
    """Its work, heat and wear."""


@dataclass(frozen=True)
class Slip:
    """Slip at one contact."""

    time_s: float | None
    """Time of slip, s."""
    distance_mm: float | None
    """Path of slip, mm."""
    net_mm: float | None
    """Net slip, mm; positive towards overrunning."""
    heat: SlipHeat | None
    """Work, heat and wear of all of it; ``None`` where nothing slips, and by the published scheme."""
    worst: WorstSlip | None
    """The slip with the most work."""


@dataclass(frozen=True)
class Slips:
    """Slip at both contacts."""

    inner: Slip
    """At the inner contact."""
    outer: Slip
    """At the outer contact."""


@dataclass(frozen=True, eq=False, repr=False)
class Simulation(_Common):
    """What became of a scene. Columns of its history are attributes too: ``simulation.theta_inner_rad``."""

    _simulated: _core.Simulated = field(repr=False)
    scenario: str
    """Name of the scenario."""
    kind: str
    """Kind of the scenario."""
    method: str
    """``event``, ``published``, or ``equilibrium`` where nothing is integrated."""
    verdict: str | None
    """``sticks``, ``slips-overrunning``, ``slips-engaging``, ``disengages``, ``overloaded``, ``at-threshold``."""
    stop: str
    """Why the run ended; ``no-start`` where the clutch has no such start."""
    reason: str | None
    """Why the scenario has no start, or why a run did not come to its end and what would let it."""
    t_end_s: float | None
    """Time reached, s."""
    theta_inner_end_rad: float | None
    """Rotation of the inner race at the end, rad."""
    theta_outer_end_rad: float | None
    """Rotation of the outer race at the end, rad."""
    offset_rad: float | None
    """Offset that slip leaves between the races, rad; positive towards overrunning."""
    slip: Slips
    """Slip at both contacts."""
    contact_lost_s: float | None
    """Time without contact, s."""
    peak_tan_demand: float | None
    """Largest tangential over normal force, either contact."""
    required_static_friction: float | None
    """Static friction from which on the scene sticks."""
    required_static_friction_by: str | None
    """How that was found. ``rolling``: the largest tangential over normal force in pure rolling; ``bisection``: by runs with
    slip, where rolling unloads the contact."""
    slip_margin: float | None
    """Static over required friction, less 1."""
    contact_margin: float | None
    """Smallest normal force at the inner contact in pure rolling over that of the static load; negative by the pull that
    rolling would need."""
    normal_min_n: float | None
    """Smallest normal force of one sprag at the inner contact, N."""
    normal_max_n: float | None
    """Largest normal force of one sprag at the inner contact, N."""
    extremes: dict[str, Any] | None
    """Extremes of the run, with their times."""
    equilibrium: dict[str, Any] | None
    """The state of a static scenario or of a steady overrun, where nothing is integrated."""
    hertz_peak_mpa: float | None
    """Largest Hertz pressure, MPa."""
    hertz_static_mpa: float | None
    """Hertz pressure of the static load, MPa."""
    hertz_least_mpa: float | None
    """Hertz pressure at the inner contact at the smallest normal force, MPa."""
    hertz_rated_mpa: float | None
    """Hertz pressure at the inner contact at nominal torque, MPa."""
    events: int | None
    """Changes of mode: sticking, slipping, open."""
    zeno_closures: int | None
    """Sequences of ever faster changes of mode that were closed at their limit."""
    inconsistent_choices: int | None
    """Changes of mode at which no mode was consistent with the forces."""
    fast_motion: dict[str, Any] | None
    """What was fastest where the run gave up."""
    steps: int | None
    """Steps of the integrator, of all runs."""
    rejections: int | None
    """Steps refused and tried again, of all runs."""
    rhs_evaluations: int | None
    """Evaluations of the equations of motion, of all runs."""
    error_estimates: dict[str, Any] | None
    """Errors of the figures by name."""
    energy_balance: dict[str, Any] | None
    """Where the energy went, J."""
    beyond: dict[str, Any] | None
    """What comes after the end of the curve, where the scene goes there."""
    eigenfrequencies: tuple[dict[str, Any], ...] | None
    """Eigenfrequencies of races and drivetrain with the clutch engaged, lowest first; none without a drivetrain."""
    assumptions: tuple[str, ...] | None
    """Inputs of an engagement that the paper does not publish for its Figure 8."""
    tolerance_reached: bool | None
    """Whether every error is below the tolerance."""
    worst_figure: tuple[Any, ...] | None
    """The figure whose error is largest by its natural size, where the tolerance is not reached, and that."""
    finer_gave_up: str | None
    """Why a run with finer steps than those that answer did not come to its end."""
    spread_rad: tuple[float, ...] | None
    """Smallest and largest rotation of the inner race at the end over the runs made, rad, where the tolerance is not
    reached."""
    initial_slip_s: float | None
    """How long the inner contact slips after a reversal, s."""
    drag_torque_nm: float | None
    """Drag torque of a steady overrun, N m."""
    lift_off_rpm: float | None
    """Speed of the outer race at which the sprags lift off, rev/min; absent where they stay on up to 60 000."""
    growth_rate_per_s: float | None
    """Growth of a small swing of the sprags about a steady overrun, races at constant speeds, 1/s; positive: the overrun
    does not stay. Absent where they are off."""
    swing_frequency_hz: float | None
    """Frequency of that swing, Hz."""
    swing_normal_inner_n: float | None
    """Normal force at the inner contact about which they swing, by the equations of motion, N."""
    kept: tuple[LeftOut, ...]
    """Terms that the planner looked at and kept."""
    notes: tuple[str, ...]
    """What a reader must know beside the figures."""

    @functools.cached_property
    def history(self) -> dict[str, npt.NDArray[Any]]:
        """The history in columns of one length, by names that end in their unit; NaN where a number has no value, 0 where
        no arc touches. Of an equilibrium its one row."""
        import numpy as np

        def array(values: bytes | list[str] | list[int | None]) -> npt.NDArray[Any]:
            if isinstance(values, bytes):
                return np.frombuffer(values, dtype=np.float64)
            if values and isinstance(values[0], str):
                return np.array(values, dtype=np.str_)
            return np.array([0 if v is None else v for v in values], dtype=np.int64)

        return {name: array(values) for name, values in self._simulated.history().items()}

    def __getattr__(self, name: str) -> npt.NDArray[Any]:
        # Only what is no attribute comes here: a column of the history.
        if name.startswith("_") or name == "history":
            raise AttributeError(name)
        try:
            return self.history[name]
        except KeyError:
            columns = ", ".join(self.history)
            raise AttributeError(f"a simulation has no {name}; the columns of this history are: {columns}") from None

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self.history]

    def _said(self) -> str:
        return self.verdict_line

    @property
    def verdict_line(self) -> str:
        """The verdict in one line."""
        return self._simulated.verdict_line()

    def to_pandas(self) -> pd.DataFrame:
        """The history as a table, by time where there is any. Needs pandas."""
        import pandas as pd

        table = pd.DataFrame(self.history)
        return table.set_index("time_s") if "time_s" in table else table

    def plot(self, column: str = "theta_inner_rad", ax: Axes | None = None) -> Axes:
        """A column of the history over time. Needs matplotlib.

        Raises ``ValueError`` of a scene without a history over time, ``KeyError`` of a column that there is not.
        """
        if "time_s" not in self.history:
            raise ValueError(f"scene {self.scenario} is static or steady: there is no history over time to plot")
        if column not in self.history:
            raise KeyError(f"no column {column}; there are: {', '.join(self.history)}")
        ax = _axes(ax)
        ax.plot(self.history["time_s"], self.history[column])
        ax.set_xlabel("Time, s")
        ax.set_ylabel(column)
        ax.set_title(self.scenario)
        return ax

    def __reduce__(self) -> typing.NoReturn:
        raise TypeError("a simulation cannot be pickled: take to_dict() and history")


def simulation_of(found: _core.Simulated) -> Simulation:
    shared, data = _common(found.common, found.json())
    return _object(Simulation, data, _simulated=found, **shared)


# ---- optimize


@dataclass(frozen=True)
class Progress:
    """How far a search is."""

    part: str
    """The part of the search that goes on."""
    evaluations: int
    """Evaluations of the clutch, of all parts."""
    best: float | None
    """Largest least objective of a step of this part that held every limit."""
    least_margin: float | None
    """Least objective at the last step."""
    violation: float | None
    """How far its worst limit is missed."""
    violated: int | None
    """How many of its limits are."""
    words: str
    """The same as the command's progress line has it."""

    def __str__(self) -> str:
        return f"{self.words}; {self.evaluations} evaluations"


@dataclass(frozen=True)
class Variable:
    """A free number of the design."""

    name: str
    """Short name, with its unit."""
    min: float
    """Least value."""
    max: float
    """Greatest value."""
    start: float
    """Value in the design, or the bound nearest to it."""
    whole: bool
    """Whether it is a whole number."""


@dataclass(frozen=True)
class Evaluation:
    """Margins at one vector."""

    x: tuple[float, ...]
    """The vector."""
    objectives: tuple[float, ...]
    """Margins whose least is made largest."""
    limits: tuple[float, ...]
    """Margins that must be 0 or more."""
    least: float
    """The least objective; NaN where the vector is refused."""
    violation: float
    """How far the worst limit is missed, or the wanted slip margin where that is raised; 0: none is; NaN where the vector is refused."""
    feasible: bool
    """Whether every limit is held, the wanted slip margin among them."""
    refused: str | None
    """Why there is no clutch at the vector."""

    def to_dict(self) -> dict[str, Any]:
        """The object that the command ``evaluate`` prints."""
        if self.refused is not None:
            return {"x": list(self.x), "refused": self.refused}
        return {
            "x": list(self.x),
            "objectives": list(self.objectives),
            "limits": list(self.limits),
            "least": self.least,
            "violation": self.violation,
            "feasible": self.feasible,
        }


@dataclass(frozen=True)
class FoundMargin(_Shown):
    """A margin of a design of the search."""

    code: str
    """Code for scripts."""
    name: str
    """Name for people."""
    unit: str
    """Unit of demand and allowable."""
    allowable: float
    """Allowable, in ``unit``; of slip the wanted slip margin."""
    margin: float
    """Margin as a number; 0 or more is held."""
    slip_margin: float | None
    """Of slip rows static over required friction, less 1."""
    demand: float | None
    """Demand, in ``unit``, where it is a number."""


@dataclass(frozen=True)
class Found:
    """A design of the search."""

    variables: dict[str, float]
    """Values of the variables, in the units of their names."""
    objective: float
    """The objective, in its own unit; ``None`` of a least margin that some scene does not have."""
    margins: tuple[FoundMargin, ...]
    """Margins of that design."""


@dataclass(frozen=True)
class Bound:
    """A design that bounds the answer and is none itself."""

    variables: dict[str, float]
    """Values of its variables."""
    objective: float
    """The objective, in its own unit."""
    evaluations: int
    """Evaluations of the clutch."""


@dataclass(frozen=True)
class CodeMargin:
    """A margin in short."""

    code: str
    """Code for scripts."""
    margin: float
    """Margin as a number; 0 or more is held."""


@dataclass(frozen=True)
class Steps:
    """Lengths in steps that can be made."""

    step_mm: float
    """The step, mm."""
    variables: tuple[str, ...]
    """Variables that have it."""
    found: bool
    """Whether a point of the grid near the optimum holds every limit, so that it is the answer."""
    not_held: tuple[CodeMargin, ...]
    """Else what the nearest point does not hold; margins less the reserve."""
    evaluations: int
    """Evaluations of the clutch."""


@dataclass(frozen=True, repr=False)
class Optimum(_Common):
    """What a search for a better design found."""

    design: Design
    """The design found, its file the one that the command writes; where nothing holds every limit the nearest one."""
    robust_design: Design | None
    """The design that holds at every corner of the tolerances, or comes as near as was found, where that was asked for."""
    status: str
    """How the best climb ended: ``converged``, ``infeasible``, ``evaluation-limit``, ``interrupted``, ``stalled``."""
    aim: str
    """What was made better."""
    feasible: bool
    """Whether every margin of the design found is held."""
    not_held: tuple[str, ...]
    """Codes of the margins that are not."""
    best: Found
    """The design found."""
    in_file: dict[str, float]
    """Values in the design file."""
    start: Found
    """Where the search began."""
    objective_error: float
    """How far the objective is off: its change when the optimum is looked at in full at a tenth of the tolerance."""
    evaluations: int
    """Evaluations of the clutch in all."""
    derivatives: int
    """Derivatives of all margins along one variable beside them, each at 0.3 to 1.1 times the cost."""
    failed_evaluations: int
    """Evaluations of the best climb at which there was no clutch."""
    fighting_limits: tuple[str, ...]
    """Limits that no design near holds together."""
    dropped_variables: tuple[str, ...]
    """Variables that move no margin."""
    makeable: bool
    """Whether it can be made: a search that is stopped may have a free centroid, for which there are no flanks yet."""
    free_centroid: Bound | None
    """What the search came to with its centroid free and its mass given: a bound, no flanks were asked for."""
    unrounded: Bound | None
    """The answer before its lengths were put in steps: a bound."""
    steps: Steps | None
    """Its lengths in steps."""
    reserve: float
    """What every limit keeps of its margin."""
    active_constraints: tuple[str, ...]
    """What holds the optimum where it is."""
    prices: tuple[dict[str, Any], ...]
    """What each active limit and bound costs."""
    influence: dict[str, Any]
    """Change of each margin over the whole range of each variable, at the start."""
    sensitivities: dict[str, Any] | None
    """The same at the optimum."""
    starts: tuple[dict[str, Any], ...]
    """Climbs."""
    optima: dict[str, Any]
    """Optima that they met, and how many are to be expected."""
    whole_numbers: tuple[dict[str, Any], ...]
    """Whole numbers that were tried."""
    change_in_full: tuple[dict[str, Any], ...]
    """What margins gained or lost when they were looked at in full."""
    realised: dict[str, Any] | None
    """Flanks for a free centroid."""
    relief: dict[str, Any] | None
    """What would free an infeasible problem."""
    pareto: tuple[dict[str, Any], ...]
    """Points of the front, or the optimum as the only one."""
    tolerances: dict[str, Any] | None
    """The optimum as it may be made."""
    robust: dict[str, Any] | None
    """The design that holds at every corner of the tolerances."""
    seed: int
    """Seed of everything random."""
    not_done: tuple[str, ...]
    """What was asked and could not be done."""

    def to_pandas(self) -> pd.DataFrame:
        """Variables before and after. Needs pandas."""
        import pandas as pd

        return pd.DataFrame({"given": self.in_file, "best": self.best.variables})

    @property
    def verdict(self) -> str:
        """What was found, in one line."""
        before, after = (_figure(found.objective, ".5g") or "none" for found in (self.start, self.best))
        limits = "every limit held" if self.feasible else f"NOT HELD: {', '.join(self.not_held)}"
        return f"{self.aim} {before} -> {after}, {limits}; {self.status} after {self.evaluations} evaluations"

    def _repr_html_(self) -> str:
        variables = [(n, _figure(self.in_file.get(n), ".6g"), f"{best:.6g}") for n, best in self.best.variables.items()]
        before = {row.code: row for row in self.start.margins}

        def percent(row: FoundMargin | None) -> str:
            return "" if row is None else f"{100.0 * row.shown_margin:.3g} %"

        margins = [(row.code, percent(before.get(row.code)), percent(row)) for row in self.best.margins]
        return (
            f"<p><b>{html.escape(self.verdict)}</b></p>"
            f"{_html_table(('Variable', 'Given', 'Best'), variables)}"
            f"{_html_table(('Limit', 'Margin before', 'Margin after'), margins)}"
        )


def optimum_of(common: str, body: str, design: Design, robust: Design | None) -> Optimum:
    shared, data = _common(common, body)
    # JSON has them by the alphabet, vectors in the order of the file.
    names = [v.name for v in design.problem().variables]

    def ordered(values: dict[str, float]) -> dict[str, float]:
        known = {name: values[name] for name in names if name in values}
        return known | values

    inside = {k: data[k] | {"variables": ordered(data[k]["variables"])} for k in ("best", "start")}
    return _object(
        Optimum, data | inside | {"in_file": ordered(data["in_file"])}, design=design, robust_design=robust, **shared
    )


@dataclass(frozen=True)
class FrontPoint:
    """A design of a front."""

    variables: dict[str, float]
    """Values in the units of their names."""
    objectives: dict[str, float]
    """Each objective in its own unit."""


@dataclass(frozen=True, repr=False)
class Front:
    """Designs between objectives, of which none is better in all of them."""

    objectives: tuple[str, ...]
    """The objectives, as they were asked for."""
    points: tuple[FrontPoint, ...]
    """The designs; none where no design holds every limit."""
    optimum: Optimum
    """The search beside it."""

    def to_dict(self) -> dict[str, Any]:
        """The object of ``optimize --pareto ... --json``."""
        return self.optimum.to_dict()

    def __repr__(self) -> str:
        return f"<Front: {len(self.points)} designs between {' and '.join(self.objectives)}; optimum: {self.optimum.verdict}>"

    def to_pandas(self) -> pd.DataFrame:
        """A row for each design, objectives first. Needs pandas."""
        import pandas as pd

        return pd.DataFrame([p.objectives | p.variables for p in self.points])

    def plot(self, ax: Axes | None = None) -> Axes:
        """The second objective over the first. Needs matplotlib."""
        ax = _axes(ax)
        x, y = self.objectives[:2]
        ax.plot([p.objectives[x] for p in self.points], [p.objectives[y] for p in self.points], "o")
        ax.set_xlabel(x)
        ax.set_ylabel(y)
        return ax


def front_of(optimum: Optimum, aims: typing.Sequence[str]) -> Front:
    # Without a front the optimum stands there alone, with the objective of the file.
    points = tuple(_object(FrontPoint, p) for p in optimum.pareto if "objectives" in p)
    return Front(tuple(aims), points, optimum)


# ---- life, overrun, reengage


def plain_of(kind: type[T], found: tuple[str, str], **more: Any) -> T:
    """An answer whose JSON has its attributes but for ``more``."""
    shared, data = _common(*found)
    return _object(kind, data, **more, **shared)


@dataclass(frozen=True)
class LifePlace:
    """A place that a life uses up."""

    code: str
    """Code."""
    cycles: float
    """Cycles that it sees in this life."""
    used: float | None
    """Share of its life that is used up (Miner); ``None``: no strength is given."""
    used_worn: float | None
    """The same of the clutch as it wears; ``None`` also where nothing is known to wear."""
    lives: float | None
    """How often this life fits in."""
    mostly_at_nm: float | None
    """Torque at which most of that is used up; ``None`` likewise."""
    place: str
    """The place in words."""
    verdict: str
    """Whether it lasts, in words."""


@dataclass(frozen=True)
class LifeLoad:
    """A load of a life."""

    torque_nm: float
    """Torque."""
    engagements: float
    """Engagements at it."""
    carried: bool
    """Whether the clutch carries it."""
    hertz_inner_mpa: float | None
    """Hertz pressure at the inner contact, MPa; ``None`` where the torque is not carried, as the five below."""
    hertz_outer_mpa: float | None
    """The same at the outer contact, MPa."""
    hoop_inner_mpa: float | None
    """Hoop stress of the inner race, with the bending between the sprags, MPa."""
    hoop_outer_mpa: float | None
    """The same of the outer race, MPa."""
    walk_inner_mm: float | None
    """What the inner contact rolls on sprag and race in an engagement, mm."""
    walk_outer_mm: float | None
    """The same of the outer contact, mm."""
    passes_inner: float
    """Contacts that one place of the inner track sees in an engagement."""
    passes_outer: float
    """The same of the outer track."""
    slip_probability: float | None
    """Chance of a slip in an engagement."""


@dataclass(frozen=True, repr=False)
class Life(_Common):
    """What a life of loads does to a clutch."""

    verdict: str
    """The answer in one line."""
    held: bool
    """Whether nothing that is known fails: carried, no slip in the mean, no mark, every life long enough, slips as allowed."""
    indents: bool
    """Whether the largest load indents a contact."""
    not_known: tuple[str, ...]
    """Codes of the places whose life is not known."""
    swings: tuple[dict[str, Any], ...]
    """Each scenario that goes on for hours: ``scenario``, ``hours``, ``frequency_hz``, ``from_nm``, ``torque_nm``, ``engagements``."""
    swings_not_counted: tuple[str, ...]
    """Scenarios that swing and that the service does not name."""
    slips_allowed: float | None
    """Slips by chance that the file allows."""
    engagements: float
    """Engagements in all."""
    largest_torque_nm: float
    """The largest torque."""
    expected_slips: float | None
    """Slips to be expected by chance."""
    indentation_inner: float
    """Load until the inner contact is indented (ISO 76), over the largest one."""
    indentation_outer: float
    """The same of the outer contact."""
    places: tuple[LifePlace, ...]
    """Each place with what is used up."""
    loads: tuple[LifeLoad, ...]
    """Each load with what one engagement does."""
    wear: dict[str, Any] | None
    """The clutch as it wears: ``hours``, ``broken_after_lives``, ``broken_by``, ``states``; ``None`` without overruns or oil."""

    def to_pandas(self) -> pd.DataFrame:
        """The loads as a table. Needs pandas."""
        return _columns(self.loads)


@dataclass(frozen=True)
class FilmOverrunLine:
    """Overrun at one speed and one temperature of the oil; what needs a film is ``None`` where none bears."""

    oil_c: float
    """Temperature of the oil, C."""
    speed_rpm: float
    """Speed of the race that runs, rev/min."""
    normal_inner_n: float
    """Normal force of one sprag at the inner contact, N."""
    lifted_off: bool
    """Whether the sprags are off the inner race."""
    film_um: float | None
    """Thickness of the film, um."""
    film_over_roughness: float | None
    """Thickness of the film over the composite roughness; ``lambda`` in JSON."""
    regime: str | None
    """``IR``, ``IE``, ``VR`` or ``VE``: oil of constant viscosity (I) or one that pressure makes thicker (V), rigid (R) or elastic
    (E) bodies."""
    moes_load: float | None
    """Moes' load number of the line contact."""
    moes_lubricant: float | None
    """Moes' number of its lubricant."""
    asperity_share: float | None
    """Share of the load that asperities bear."""
    nahme: float | None
    """Nahme's number: by how much shear heats and thins the film."""
    friction: float
    """Coefficient of friction of the inner contact, film and asperities together."""
    friction_dry: float
    """The same by the friction law alone, without a film."""
    drag_torque_nm: float
    """Drag torque of the whole clutch, N m."""
    drag_torque_dry_nm: float
    """The same by the friction law alone, N m."""
    heat_w: float | None
    """Heat of all inner contacts, W."""
    film_c: float | None
    """Temperature of the film, C."""
    contact_c: float | None
    """Temperature of the contact's surfaces, C."""
    inner_race_c: float | None
    """Temperature of the inner race, C."""
    sprags_c: float | None
    """Temperature of the sprags, C."""
    outer_race_c: float | None
    """Temperature of the outer race, C."""
    heat_balance_error: float | None
    """What the balance of heat leaves over, by the heat."""
    warm_gap_mm: float | None
    """Distance of the tracks at these temperatures, without load, mm; ``None``: expansion not known, as the four below."""
    warm_first_tan_omega: float | None
    """tan omega at first contact there."""
    warm_joint_inner_mpa: float | None
    """Pressure between inner race and shaft there, MPa; ``None``: no press fit, or a loose one."""
    warm_joint_outer_mpa: float | None
    """Pressure between outer race and housing there, MPa; ``None``: no press fit, or a loose one."""
    warm_bears_nm: float | None
    """Peak torque that every limit bears there, N m."""
    growth_rate_per_s: float | None
    """Growth of a small swing of the sprags, 1/s; positive: the equilibrium does not stay."""
    growth_by_friction_per_s: float | None
    """The same with the film's friction alone, without its squeeze, 1/s."""
    growth_dry_per_s: float | None
    """The same by the friction law alone, 1/s."""
    swing_frequency_hz: float | None
    """Frequency of that swing, Hz."""
    sprag_wear_first_hour_um: float | None
    """Depth worn off a sprag in the first hour from its drawn shape, um; it grows with the power 2/3 of time."""
    race_wear_um_per_hour: float | None
    """Depth worn off the track of the inner race in every hour, um."""


@dataclass(frozen=True)
class SlipWear:
    """What the slip does that ``[lubrication]`` asks for."""

    torque_nm: float
    """Torque under which it slips, N m."""
    speed_m_s: float
    """Speed of slip, m/s."""
    path_mm: float
    """Path of slip, mm."""
    normal_n: float
    """Normal force of one sprag, N."""
    friction: float
    """Coefficient of friction."""
    flash_k: float
    """Rise of the hottest place above the bodies, K."""
    peclet: float
    """Peclet number of the contact; below some 5 heat goes sideways too, and the rise is less."""
    sprag_wear_um: float | None
    """Depth worn off a sprag, um."""
    race_wear_um: float | None
    """Depth worn off a place of the race that one sprag slips over, um."""


@dataclass(frozen=True, repr=False)
class FilmOverrun(_Common):
    """Overrun on a film."""

    verdict: str
    """What matters most, in one line."""
    oil: str
    """The oil."""
    race: str
    """Race that runs, ``inner`` or ``outer``."""
    picked: str
    """Which race and speeds were taken, and why."""
    composite_roughness_um: float
    """Rq of both bodies together."""
    lift_off_rpm: float | None
    """Speed of the outer race at which the sprags lift off."""
    lines: tuple[FilmOverrunLine, ...]
    """Temperatures one after another, speeds in each."""
    slip: SlipWear | None
    """The slip that the file asks for."""
    warnings: tuple[str, ...]
    """What a reader must know beside the figures."""

    def to_pandas(self) -> pd.DataFrame:
        """A row for each line. Needs pandas."""
        return _columns(self.lines)

    def plot(self, column: str = "drag_torque_nm", ax: Axes | None = None) -> Axes:
        """A figure over the speed, a curve for each temperature. Needs matplotlib."""
        ax = _axes(ax)
        for oil_c in dict.fromkeys(line.oil_c for line in self.lines):
            rows = [line for line in self.lines if line.oil_c == oil_c]
            ax.plot([r.speed_rpm for r in rows], [getattr(r, column) for r in rows], marker=".", label=f"{oil_c:g} °C")
        ax.set_xlabel("Speed, rpm")
        ax.set_ylabel(column)
        ax.legend()
        return ax


@dataclass(frozen=True)
class Blow:
    """A path of slip and the blow after it."""

    path_mm: float
    """Path of slip after which the friction is back, mm at the inner track."""
    slip_ms: float
    """When that is, ms after the slip began."""
    peak_ms: float | None
    """When the load is largest, ms after the slip began; ``None`` where the sprags are out of reach."""
    path_in_all_mm: float | None
    """Path until the races stand still against one another, mm at the inner track; ``None`` likewise."""
    speed_rpm: float | None
    """Largest speed of the races against one another, rev/min; ``None`` where the sprags are thrown out once the friction is back."""
    peak_torque_nm: float | None
    """The blow, N m; ``None``: beyond the end of the curve."""
    peak_by_energy_nm: float | None
    """The same where nothing is lost, N m."""
    energy_j: float | None
    """Energy of the races against one another at that speed, J."""
    hertz_inner_mpa: float | None
    """Largest Hertz pressure at the inner contact, MPa."""
    held: bool
    """Whether every limit at peak torque bears it."""
    ended: str | None
    """Why it was not followed to its end."""
    verdict: str
    """Whether it is borne, in words."""
    times: float | None
    """The blow over the torque carried."""
    of_borne: float | None
    """The energy over what the limits let the windup take up."""


@dataclass(frozen=True)
class BlowAt:
    """A blow at another friction and inertia."""

    friction: float
    """Coefficient of friction while it slips."""
    inertia_inner_kg_m2: float
    """What turns with the inner race, that included, kg m^2."""
    path_mm: float
    """Path of slip, mm at the inner track."""
    peak_torque_nm: float | None
    """The blow, N m; ``None``: no slip, thrown out, or beyond the end of the curve, as the two below."""
    times: float | None
    """The blow over the torque carried."""
    hertz_inner_mpa: float | None
    """Largest Hertz pressure at the inner contact, MPa."""
    verdict: str
    """Whether it is borne, in words."""


@dataclass(frozen=True, repr=False)
class Reengagement(_Common):
    """Slip under load and the blow when the clutch grips again."""

    verdict: str
    """The answer in one line."""
    held: bool
    """Whether the clutch bears every blow."""
    torque_nm: float
    """Torque that the clutch carries when the slip begins, and that goes on acting, N m."""
    friction: float
    """Coefficient of friction of both contacts while they slip."""
    speed_rpm: float
    """Speed of both races before, rev/min."""
    inertia_inner_kg_m2: float
    """What turns with the inner race, that included, kg m^2."""
    inertia_outer_kg_m2: float | None
    """The same of the outer race, kg m^2; ``None`` where it is held."""
    outer_held: bool
    """Whether the outer race is held."""
    bears_nm: float | None
    """Peak torque that every limit bears, N m."""
    bears_by: str | None
    """The limit that sets it."""
    blows: tuple[Blow, ...]
    """Each path of slip with its blow."""
    over: tuple[BlowAt, ...]
    """Each friction and inertia that was asked for, at each path."""
    bears_j: float | None
    """Energy that the windup takes up from the torque carried to ``bears_nm``, J."""
    end_of_curve_j: float | None
    """The same to the end of the curve, J."""
    torque_needs_friction: float | None
    """Friction that holds the torque."""
    borne: dict[str, Any] | None
    """Where a blow is not borne: ``path_mm``, up to which slip would be, and ``friction``, from which on the shortest path is."""
    speed_of: str | None
    """The scenario whose speed was taken."""
    needs_friction: float | None
    """Where it does not slip: the friction that the torque needs."""
    slip_ended: str | None
    """Why the slip was not followed to its end."""
    lift_off_rpm: float | None
    """Speed of the outer race from which on the sprags lift off in steady overrun."""
    thrown: dict[str, Any] | None
    """Where the slip throws the sprags out of reach: time, path, speeds."""

    def to_pandas(self) -> pd.DataFrame:
        """A row for each path of slip. Needs pandas."""
        return _columns(self.blows)

    def plot(self, ax: Axes | None = None) -> Axes:
        """Blow over path of slip. Needs matplotlib."""
        ax = _axes(ax)
        rows = [b for b in self.blows if b.peak_torque_nm is not None]
        ax.semilogx([b.path_mm for b in rows], [typing.cast(float, b.peak_torque_nm) for b in rows], marker=".")
        ax.set_xlabel("Slip until the friction is back, mm")
        ax.set_ylabel("Blow, Nm")
        if not rows:
            ax.set_title("No blow that the clutch could carry: see why in thrown and blows")
        return ax


# ---- sharing, feed


@dataclass(frozen=True)
class SharingSprag:
    """A sprag of its own and what it carries."""

    number: int
    """Number, from 1."""
    azimuth_deg: float
    """Azimuth, degrees."""
    size_um: float
    """By how much it measures more across its contacts, um."""
    gap_um: float
    """What it lacks to its races before it engages, um."""
    friction: float
    """Its static friction coefficient."""
    idle: bool
    """Whether it never comes to carry."""
    lag_deg: float | None
    """Windup by which it catches after the first, degrees."""
    catches_nm: float | None
    """Torque at which it catches, N m."""
    first_friction: float | None
    """Static friction that it needs as it catches."""
    normal_inner_n: float
    """Normal force at the inner contact, N."""
    normal_outer_n: float
    """Normal force at the outer contact, N."""
    share: float
    """Its torque over the mean of all."""
    hertz_inner_mpa: float
    """Hertz pressure at the inner contact, MPa."""
    hertz_outer_mpa: float
    """Hertz pressure at the outer contact, MPa."""
    required_friction: float
    """Static friction that it needs."""
    bent_inner_um: float
    """By how much the inner track gives there beside its mean growth, um."""
    bent_outer_um: float
    """The same of the outer track, um."""
    needs_friction: float | None
    """Static friction that it needs under load, else as it catches."""
    state: str
    """What it does, in words."""


@dataclass(frozen=True, repr=False)
class Sharing(_Common):
    """What each sprag carries."""

    verdict: str
    """The answer in one line."""
    held: bool
    """Whether the torque is carried, no sprag pressed beyond the limit, and none needs more friction than it has."""
    torque_nm: float
    """Torque, N m."""
    seed: int | None
    """Seed from which the tolerances are drawn."""
    allowed_mpa: float | None
    """Hertz pressure that is allowed, MPa."""
    may_be_lost: int | None
    """How many sprags may be lost before the limit is broken or one slips; ``None``: not known, at least as many as ``losses`` hold."""
    end_torque_nm: float | None
    """Torque up to which the clutch carries, N m."""
    end_reason: str | None
    """Why it carries no more."""
    beyond: dict[str, Any] | None
    """Beyond the end of a sprag, as the races are turned on: torque, who goes over, what remains; ``None``: none does."""
    sprags: tuple[SharingSprag, ...]
    """Each sprag."""
    turn: tuple[dict[str, Any], ...]
    """Over a turn of the widest gap: windup, sprags that carry, shares, pressure, force on the bearings."""
    engagement: tuple[dict[str, Any], ...]
    """As the torque rises: who carries how much."""
    losses: tuple[dict[str, Any], ...]
    """With one sprag after another lost."""
    harmonics_inner_um: tuple[float, ...]
    """Out-of-round of the inner track by harmonics, from the first on, um."""
    harmonics_outer_um: tuple[float, ...]
    """The same of the outer track, um."""

    def to_pandas(self) -> pd.DataFrame:
        """A row for each sprag. Needs pandas."""
        return _columns(self.sprags)


@dataclass(frozen=True)
class SceneSprag:
    """A sprag of its own and what became of it in a scene."""

    number: int
    """Number, from 1."""
    azimuth_deg: float
    """Azimuth, degrees."""
    size_um: float
    """By how much it measures more across its contacts, um."""
    gap_um: float
    """What it lacks to its races before it engages, um."""
    friction: float
    """Its static friction coefficient."""
    state: str
    """What became of it, in a word."""
    order: int | None
    """Its place among those that catch, from 1; ``None``: it never does."""
    over_at_s: float | None
    """When it goes over its highest place, s."""
    gone_at_s: float | None
    """When it has lost contact after that, s."""
    idle: str | None
    """Why it cannot carry; ``None``: it can. Then the fields below are ``None``."""
    catches_s: float | None
    """When it first carries, s; ``None``: never."""
    normal_max_n: float | None
    """Largest normal force at the inner contact, N."""
    normal_max_at_s: float | None
    """When, s."""
    largest_share: float | None
    """Largest normal force over the mean of all places while that is loaded."""
    largest_share_at_s: float | None
    """When, s."""
    used_friction: float | None
    """The larger of the two below."""
    used_friction_inner: float | None
    """Largest tangential over normal force at the inner contact under load."""
    used_friction_outer: float | None
    """The same at the outer contact."""
    slips_at_s: float | None
    """When a contact that had caught first slips under load, s."""
    slips_inner: bool | None
    """Whether it was the inner one."""
    slips_normal_n: float | None
    """Normal force at the inner contact then, N."""
    slip_inner_um: float | None
    """Slip at the inner contact over the scene, signed, um."""
    slip_outer_um: float | None
    """The same at the outer contact."""
    slip_path_inner_um: float | None
    """Path of the slip at the inner contact, um."""
    slip_path_outer_um: float | None
    """The same at the outer contact."""
    contact_lost_s: float | None
    """Time without contact after it has caught, s."""


@dataclass(frozen=True, repr=False)
class SharingScene(_Common):
    """A scene with its sprags one by one."""

    verdict: str
    """The answer in one line."""
    held: bool
    """Whether the clutch holds to the end of the scene, or lets go where its torque turns round, and no sprag slips under load or goes over."""
    scenario: str
    """Name of the scenario."""
    stop: str
    """Why the run ended."""
    end_s: float
    """Time reached, s."""
    given_up: str | None
    """Why the run did not come to its end; ``None``: it did, or what happened is an answer."""
    largest_share: float | None
    """Largest share of a sprag, 1: the mean of all places."""
    largest_share_sprag: int | None
    """Its number."""
    largest_share_at_s: float | None
    """When, s."""
    share_at_rest: float | None
    """Largest share when the scene begins."""
    share_at_rest_round: float | None
    """The same between races that stay round."""
    bending_left_out: float | None
    """Part of the bending that the inertia of the rings leaves out; ``None``: races do not bend here."""
    lowest_mode_inner_hz: float | None
    """Lowest natural frequency of the inner race's ring, Hz."""
    lowest_mode_outer_hz: float | None
    """The same of the outer race's, Hz."""
    scene_hz: float | None
    """Frequency of the scene beside which these are held, Hz."""
    over: int
    """How many sprags go over their highest place."""
    gone: int
    """How many have lost contact after that."""
    bearing_max_n: float | None
    """Largest force on the bearings of the races, N; ``None``: their axes meet and stay, as of those below."""
    bearing_max_at_s: float | None
    """When, s."""
    axes_apart_max_um: float | None
    """How far the axes lie apart at most, um."""
    bearing_mass_kg: float | None
    """Mass that moves on the bearings, kg; ``None``: they are held."""
    bearing_frequency_hz: float | None
    """Frequency at which it swings on them, Hz."""
    seed: int | None
    """Seed from which the tolerances are drawn."""
    catching: tuple[int, ...]
    """Numbers of the sprags in the order in which they catch."""
    slipping: int
    """How many slip under load after they have caught."""
    first_slip_sprag: int | None
    """The first of them."""
    first_slip_at_s: float | None
    """When, s."""
    theta_inner_rad: float
    """Angle of the inner race at the end, rad."""
    theta_outer_rad: float
    """The same of the outer race, rad."""
    theta_inner_error_rad: float | None
    """Difference of the inner angle to a run ten times as coarse, rad."""
    normal_max_error: float | None
    """The same of the largest normal force, as a part of it."""
    energy_residual_j: float
    """What works and changes of energy leave over, J."""
    energy_through_j: float
    """Energy that went through, J."""
    kinds: int
    """Kinds of sprags that are computed."""
    events: int
    """Changes of what sprags do."""
    steps: int
    """Steps of the run."""
    rhs_evaluations: int
    """Evaluations of the equations, each of all sprags."""
    sprags: tuple[SceneSprag, ...]
    """Each sprag."""
    history: tuple[dict[str, Any], ...]
    """Over time: angles, shares and forces by sprag, force on the bearings and place of the axis."""

    def to_pandas(self) -> pd.DataFrame:
        """A row for each sprag. Needs pandas."""
        return _columns(self.sprags)


@dataclass(frozen=True)
class FedFrequency:
    """Strokes at one frequency."""

    frequency_hz: float
    """Strokes a second, Hz."""
    feed_deg: float | None
    """What a stroke feeds, degrees; ``None`` where none was run to its end, as the four below."""
    error_deg: float | None
    """That less the stroke, degrees; negative: less."""
    off_deg: float | None
    """What it feeds more than slow strokes, degrees."""
    runs_on_deg: float | None
    """Turn of the fed race after the driving one has turned back, degrees."""
    unlike_deg: float | None
    """By how much strokes differ, degrees."""
    peak_torque_nm: float | None
    """Largest torque, N m."""
    hertz_inner_mpa: float | None
    """Hertz pressure at it, MPa."""
    open_ms: float
    """Time without contact, ms."""
    strokes: int
    """Strokes run."""
    held: bool
    """Whether they feed as they should and the clutch bears it."""
    ended: str | None
    """Why the run ended before its end."""
    verdict: str
    """The same in words."""


@dataclass(frozen=True)
class SpringFeed:
    """How far strokes feed as they should with another spring."""

    factor: float
    """Stiffness and drag torque of the spring over those of the file."""
    drag_torque_nm: float
    """Drag torque of the whole clutch with it, N m."""
    limit_hz: float | None
    """Frequency up to which strokes feed as they should, Hz; ``None``: all that were asked for, or not even the first."""
    lost_hz: float | None
    """The first frequency asked for at which they do not, Hz; ``None``: none, as the two below."""
    off_deg: float | None
    """What a stroke feeds there more than slow ones, degrees."""
    open_ms: float | None
    """Time without contact there, ms."""
    verdict: str
    """The same in words."""


@dataclass(frozen=True, repr=False)
class Feed(_Common):
    """What each stroke of an indexing drive feeds."""

    verdict: str
    """The answer in one line."""
    held: bool
    """Whether strokes of every frequency feed as they should."""
    stroke_deg: float
    """Angle that the driving race turns by and back, degrees."""
    brake_nm: float
    """Torque of the brake on the fed race, N m."""
    inertia_kg_m2: float
    """What turns with the fed race, kg m^2."""
    driver: str
    """The race that swings: ``outer`` or ``inner``."""
    allowed_deg: float
    """By how much a stroke may feed more or less than slow ones, degrees."""
    windup_deg: float
    """Windup under the brake, which every stroke loses, degrees."""
    limit_hz: float | None
    """Frequency beyond which strokes first fail, Hz."""
    looks: int
    """How many frequencies between those that were asked for were looked at."""
    lost_between_hz: float | None
    """The first that was met beyond ``limit_hz``, Hz, where it lies between two that were asked for."""
    bears_nm: float | None
    """Peak torque that every limit bears, N m."""
    bears_by: str | None
    """The limit that sets it."""
    frequencies: tuple[FedFrequency, ...]
    """Each frequency."""
    springs: tuple[SpringFeed, ...]
    """Each other spring that was asked for."""

    def to_pandas(self) -> pd.DataFrame:
        """A row for each frequency. Needs pandas."""
        return _columns(self.frequencies)


# ---- map


@dataclass(frozen=True, eq=False)
class Plane:
    """A plane over two variables: rows are tiles along ``y``, columns along ``x``."""

    x: str
    """Variable to the right."""
    y: str
    """Variable upwards."""
    x_edges: Numbers
    """Edges of the tiles along it, one more than tiles."""
    y_edges: Numbers
    """The same upwards."""
    points: npt.NDArray[np.int64]
    """Points in each tile."""
    held: npt.NDArray[np.int64]
    """Those that hold every limit."""
    best: Numbers
    """Largest value, of the points held where there are any; NaN without points."""
    decides: npt.NDArray[Any]
    """What decides there, or nothing."""


@dataclass(frozen=True, eq=False, repr=False)
class SweepMap:
    """What tables of margins show."""

    verdict: str
    """The answer in one line."""
    by: str
    """The column that is mapped."""
    points: int
    """Points in all."""
    without_clutch: int
    """Points without a clutch."""
    held: int
    """Points that hold every limit."""
    variables: tuple[dict[str, Any], ...]
    """Name, range, range of what is held."""
    deciding: tuple[dict[str, Any], ...]
    """What decides, and at how many points."""
    best: dict[str, Any] | None
    """The best point."""
    planes: tuple[Plane, ...]
    """Planes over two variables."""
    _data: dict[str, Any] = field(repr=False)

    def to_dict(self) -> dict[str, Any]:
        """The object of ``map --json``."""
        return typing.cast("dict[str, Any]", json.loads(json.dumps(self._data)))

    def __repr__(self) -> str:
        return f"<SweepMap: {self.verdict}>"

    def plot(self, plane: int = 0, ax: Axes | None = None) -> Axes:
        """The best value over a plane. Needs matplotlib."""
        ax = _axes(ax)
        shown = self.planes[plane]
        mesh = ax.pcolormesh(shown.x_edges, shown.y_edges, shown.best)
        ax.figure.colorbar(mesh, ax=ax, label=self.by)
        ax.set_xlabel(shown.x)
        ax.set_ylabel(shown.y)
        return ax


def map_of(found: tuple[str, str]) -> SweepMap:
    import numpy as np

    def plane(p: dict[str, Any]) -> Plane:
        shape = (len(p["y_edges"]) - 1, len(p["x_edges"]) - 1)
        return Plane(
            x=p["x"],
            y=p["y"],
            x_edges=np.array(p["x_edges"], dtype=np.float64),
            y_edges=np.array(p["y_edges"], dtype=np.float64),
            points=np.array(p["points"], dtype=np.int64).reshape(shape),
            held=np.array(p["held"], dtype=np.int64).reshape(shape),
            best=np.array(p["best"], dtype=np.float64).reshape(shape),
            decides=np.array([d or "" for d in p["decides"]], dtype=np.str_).reshape(shape),
        )

    data = json.loads(found[0])
    planes = tuple(plane(p) for p in json.loads(found[1]))
    return _object(SweepMap, data, planes=planes, _data=data)
