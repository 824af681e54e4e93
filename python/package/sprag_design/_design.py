"""The design and the questions to it."""

from __future__ import annotations

import html
import json
import math
import numbers
import os
import warnings
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from . import _core
from ._answers import (
    Check,
    Evaluation,
    Feed,
    FilmOverrun,
    Front,
    Life,
    Optimum,
    Reengagement,
    Sharing,
    SharingScene,
    Simulation,
    Stiffness,
    SweepMap,
    Variable,
    _object,
    check_of,
    front_of,
    map_of,
    optimum_of,
    plain_of,
    simulation_of,
    stiffness_of,
)

if TYPE_CHECKING:
    from ._answers import Numbers

Setting = bool | int | float | str | Sequence[Any] | Mapping[str, Any]


def _toml(value: Any) -> str:
    """A value as a design file has it."""
    if getattr(value, "ndim", None) == 0:
        # A number of numpy, be it an array without an axis.
        value = value.item()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return json.dumps(value)
    if isinstance(value, numbers.Integral):
        return str(int(value))
    if isinstance(value, numbers.Real):
        return repr(float(value))
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{json.dumps(str(key))} = {_toml(item)}" for key, item in value.items()) + " }"
    if isinstance(value, Iterable):
        return "[" + ", ".join(_toml(item) for item in value) + "]"
    raise TypeError(f"{value!r} is no value of a design file: a number, a text, true, false, a list or a table (dict) of these is")


def _positive(name: str, values: Iterable[float]) -> list[float]:
    """Numbers above 0, or an exception that says which is none."""
    listed = [float(value) for value in values]
    for value in listed:
        if not 0.0 < value < math.inf:
            raise ValueError(f"{name} {value}: allowed: a finite number above 0")
    return listed


class Design:
    """A checked clutch design, which never changes. :meth:`with_` and :meth:`set` give another."""

    __slots__ = ("_core", "_problem")

    def __init__(self, core: _core.Design) -> None:
        """Use :meth:`load` or :meth:`parse`."""
        if not isinstance(core, _core.Design):
            raise TypeError("a design is read by Design.load(path) or Design.parse(text)")
        self._core = core
        self._problem: Problem | None = None

    @staticmethod
    def load(path: str | os.PathLike[str]) -> Design:
        """Read and check a design file.

        Raises :class:`DesignError` with everything found wrong.
        """
        return Design(_core.Design.load(path))

    @staticmethod
    def parse(text: str, folder: str | os.PathLike[str] = "", file: str = "design.toml") -> Design:
        """Check the text of a design file that would lie in ``folder``, from which its histories are named; ``file`` stands
        for it in messages.

        Raises :class:`DesignError`.
        """
        return Design(_core.Design.parse(text, folder, file))

    @property
    def name(self) -> str:
        """Name of the design."""
        return self._core.name

    @property
    def hash(self) -> str:
        """SHA-256 of the file's text and of its histories: names exactly what is computed."""
        return self._core.hash

    @property
    def text(self) -> str:
        """Text of the design file."""
        return self._core.source

    @property
    def folder(self) -> Path:
        """Folder from which histories are named."""
        return Path(self._core.folder)

    @property
    def scenarios(self) -> list[str]:
        """Names of the scenarios."""
        return self._core.scenarios

    def with_(self, **values: Setting) -> Design:
        """The same design with other values, by the short names of variables: ``design.with_(r_i2_mm=4.1)``. Several that are
        only good together, by paths too: ``design.with_(**{"races.inner_radius_mm": 42.0, "races.outer_radius_mm": 50.33})``.

        Raises :class:`DesignError` where a name is unknown or the new design is refused.
        """
        return Design(self._core.with_settings([(key, _toml(value)) for key, value in values.items()]))

    def set(self, path: str, value: Setting) -> Design:
        """The same design with another value at a dotted path of the file, rows counted from 0 or by their name:
        ``design.set("sprags.inner_arcs[1].radius_mm", 4.1)``, ``design.set("scenarios[high-10].amplitude_nm", 9)``.

        Raises :class:`DesignError`.
        """
        return Design(self._core.with_settings([(path, _toml(value))]))

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the design file. A file that is there is not replaced; where the disk is full nothing is left."""
        with open(path, "x", encoding="utf-8", newline="") as file:
            try:
                file.write(self.text)
                file.flush()
            except OSError:
                os.unlink(path)
                raise

    def check(self) -> Check:
        """Hold the design against each of its limits.

        Raises :class:`NoClutch` where no clutch comes about.
        """
        return check_of(self._core.check())

    def stiffness(
        self,
        torques_nm: Iterable[float] | None = None,
        *,
        laws: Sequence[str] = (),
        max_torque_nm: float | None = None,
    ) -> Stiffness:
        """The static curve at rest, at torques in N m or at 20 even ones up to ``max_torque_nm`` (the design's peak torque
        where that is left out), by the contact laws named, or the design's own (:func:`contact_laws`).

        Torques beyond the end of a curve have no row: they stand in ``beyond_end_nm``, and a warning names them.

        Raises ``ValueError`` for a torque that is not above 0, :class:`NoClutch`.
        """
        torques = [] if torques_nm is None else [float(t) for t in torques_nm]
        if torques and max_torque_nm is not None:
            raise ValueError("torques_nm and max_torque_nm: give one of the two")
        laws = [laws] if isinstance(laws, str) else list(laws)
        found = stiffness_of(self._core.stiffness(torques, laws, max_torque_nm))
        if beyond := sorted({nm for law in found.laws for nm in law.beyond_end_nm}):
            warnings.warn(f"beyond the end of the curve, and no rows: {beyond} N m", stacklevel=2)
        return found

    def simulate(
        self,
        scenario: str,
        *,
        tolerance: float | None = None,
        step_s: float | None = None,
        rows: int | None = None,
        window_s: tuple[float, float] | None = None,
        most_steps: int | None = None,
        full: bool = False,
        method: str = "event",
        band_m_s: float | None = None,
    ) -> Simulation:
        """Run one scenario: verdict, figures with their errors, history. Options are those of the command ``simulate``.

        Raises ``KeyError`` where there is no such scenario, ``ValueError`` for an option that makes no sense.
        """
        if method not in ("event", "published"):
            raise ValueError(f"method {method!r}: allowed: event, published")
        if rows is not None and rows < 2:
            raise ValueError(f"rows {rows}: allowed: 2 or more")
        if most_steps is not None and most_steps < 1:
            raise ValueError(f"most_steps {most_steps}: allowed: 1 or more")
        if method == "event" and band_m_s is not None:
            raise ValueError("band_m_s: only with method published")
        if method == "published":
            for name, value in (("tolerance", tolerance), ("window_s", window_s), ("most_steps", most_steps)):
                if value is not None:
                    raise ValueError(f"{name}: only with method event")
            if band_m_s is not None and not 0.0 < band_m_s < float("inf"):
                raise ValueError(f"band_m_s {band_m_s}: allowed: a finite number above 0")
        return simulation_of(
            self._core.simulate(
                scenario, method == "published", band_m_s, tolerance, step_s, rows, window_s, most_steps, full
            )
        )

    def optimize(
        self,
        *,
        evaluations: int = 500,
        starts: int | None = None,
        swarm: int | None = None,
        tolerance: float = 1e-6,
        full: bool = False,
        step_mm: float | None = None,
        reserve: float | None = None,
        robust: bool = False,
        draws: int = 200,
    ) -> Optimum:
        """Search for a better design as the table ``[optimize]`` of the file says; nothing is written. ``evaluations``: most
        of each climb; ``starts``: number of climbs, left open 8 to 32; ``swarm``: evaluations of a particle swarm first;
        ``step_mm``: step in which lengths can be made, mm, 0 for none, left open that of the file; ``reserve``: what every limit
        keeps of its margin, left open that of the file; ``robust``: margins within ``[tolerances]`` at every corner and in
        ``draws`` seeded draws, and a design that holds them at every corner.

        Raises ``ValueError`` where the design has no such table.
        """
        found = self._search((), 8, evaluations, starts, swarm, tolerance, full, step_mm, reserve, robust, draws)
        return optimum_of(*found)

    def pareto(
        self,
        objectives: Sequence[str],
        *,
        points: int = 8,
        evaluations: int = 500,
        starts: int | None = None,
        swarm: int | None = None,
        tolerance: float = 1e-6,
        full: bool = False,
        step_mm: float | None = None,
        reserve: float | None = None,
    ) -> Front:
        """The front between two or three objectives, such as ``["slip-margin", "torque-capacity"]``: designs of which none is
        better in all of them. ``points``: steps between any two of its ends; the other options are those of :meth:`optimize`,
        whose answer comes along.

        Raises ``ValueError`` for other objectives than those of ``[optimize]``, and where the design has no such table.
        """
        aims = [objectives] if isinstance(objectives, str) else list(objectives)
        if not 2 <= len(set(aims)) == len(aims) <= 3:
            raise ValueError(f"objectives {aims}: allowed: two or three different ones")
        if not 2 <= points <= 64:
            raise ValueError(f"points {points}: allowed: 2 to 64")
        found = self._search(aims, points, evaluations, starts, swarm, tolerance, full, step_mm, reserve, False, 200)
        return front_of(optimum_of(*found), aims)

    def _search(
        self,
        aims: Sequence[str],
        points: int,
        evaluations: int,
        starts: int | None,
        swarm: int | None,
        tolerance: float,
        full: bool,
        step_mm: float | None,
        reserve: float | None,
        robust: bool,
        draws: int,
    ) -> tuple[str, str, Design, Design | None]:
        if evaluations < 1 or (starts is not None and starts < 1):
            raise ValueError("evaluations and starts: allowed: 1 or more")
        if swarm is not None and swarm < 80:
            raise ValueError(f"swarm {swarm}: allowed: 80 or more")
        if not 1e-13 <= tolerance <= 1e-3:
            raise ValueError(f"tolerance {tolerance}: allowed: 1e-13 to 1e-3; 1e-6 serves well")
        if draws < 10:
            raise ValueError(f"draws {draws}: allowed: 10 or more")
        for name, value in ("step_mm", step_mm), ("reserve", reserve):
            if value is not None and not 0 <= value <= 1:
                raise ValueError(f"{name} {value}: allowed: 0 to 1")
        common, body, design, other = self._core.optimize(
            evaluations, starts, swarm, tolerance, full, step_mm, reserve, aims, points, robust, draws
        )
        return common, body, Design(design), None if other is None else Design(other)

    def life(self) -> Life:
        """What the life of loads in the table ``[life]`` of the file does to the clutch.

        Raises ``ValueError`` where the design has no such table, :class:`NoClutch`.
        """
        return plain_of(Life, self._core.life())

    def overrun(
        self, speeds_rpm: Iterable[float] = (), temperatures_c: Iterable[float] = (), *, race: str = "inner"
    ) -> FilmOverrun:
        """Overrun on the film that ``[lubrication]`` names, at each speed of the race that runs (rpm; left out: 50, 100, 200,
        500 ... up to lift-off and 50 m/s) and each temperature of the oil (C; left out: that of the file). ``race``: the one
        that runs, ``inner`` or ``outer``.

        Raises ``ValueError`` where the design has no such table and for what is no speed or temperature, :class:`NoClutch`.
        """
        if race not in ("inner", "outer"):
            raise ValueError(f"race {race!r}: allowed: inner, outer")
        temperatures = [float(t) for t in temperatures_c]
        for celsius in temperatures:
            if not -60.0 <= celsius <= 250.0:
                raise ValueError(f"temperatures_c {celsius}: allowed: -60 to 250")
        speeds = _positive("speeds_rpm", speeds_rpm)
        return plain_of(FilmOverrun, self._core.overrun(race == "outer", speeds, temperatures))

    def reengage(
        self,
        paths_mm: Iterable[float] | None = None,
        *,
        torque_nm: float | None = None,
        inertia_inner_kg_m2: float | None = None,
        inertia_outer_kg_m2: float | None = None,
        outer_held: bool | None = None,
        friction: float | None = None,
        speed_rpm: float | None = None,
        over_friction: Iterable[float] = (),
        over_inertia_kg_m2: Iterable[float] = (),
    ) -> Reengagement:
        """Slip under load and the blow when the clutch grips again, for each path of slip at the inner track (mm, rising; left
        out: 0.1 to 30). ``torque_nm``: carried when the slip begins, left out the nominal torque of ``[limits]``; inertias:
        what turns with each race, the race included, left out the race alone; ``outer_held``: the outer race keeps its speed (left out: where the design names none of it)
        whatever acts on it; ``friction`` while it slips, left out 0.95 of
        what the torque needs; ``speed_rpm``: of both races, left out the largest at which a scenario of the design carries torque.
        ``over_friction`` and ``over_inertia_kg_m2`` (of the inner race) make a table of blows over both, ``over``.

        Raises ``ValueError`` for what makes no sense, :class:`NoClutch` where the clutch cannot carry the torque.
        """
        given = {
            "torque_nm": torque_nm,
            "inertia_inner_kg_m2": inertia_inner_kg_m2,
            "inertia_outer_kg_m2": inertia_outer_kg_m2,
            "friction": friction,
        }
        for name, value in given.items():
            if value is not None:
                _positive(name, [value])
        if speed_rpm is not None and not math.isfinite(speed_rpm):
            raise ValueError(f"speed_rpm {speed_rpm}: allowed: a finite number")
        paths = None if paths_mm is None else _positive("paths_mm", paths_mm)
        inertias = (inertia_inner_kg_m2, inertia_outer_kg_m2)
        over = (_positive("over_friction", over_friction), _positive("over_inertia_kg_m2", over_inertia_kg_m2))
        found = self._core.reengage(torque_nm, inertias, outer_held, friction, speed_rpm, paths, *over)
        return plain_of(Reengagement, found)

    def sharing(self, torque_nm: float | None = None) -> Sharing:
        """What each sprag carries where they are unlike, races bend, run out and give way: the table ``[sharing]`` of the file.
        ``torque_nm``: left out the nominal torque of ``[limits]``.

        Raises ``ValueError`` where the design has no such table or there is no torque, :class:`NoClutch`.
        """
        torque = None if torque_nm is None else _positive("torque_nm", [torque_nm])[0]
        return plain_of(Sharing, self._core.sharing(torque))

    def sharing_in_scene(self, scenario: str, *, most_steps: int | None = None) -> SharingScene:
        """A scenario with its sprags one by one, as ``[sharing]`` has them: who catches when, who slips, what each carries over time, what
        the bearings of the races hold. ``most_steps``: as in :meth:`simulate`.

        Raises ``KeyError`` where there is no such scenario, ``ValueError`` where the design has no such table or the scenario cannot be run so.
        """
        if most_steps is not None and most_steps < 1:
            raise ValueError(f"most_steps {most_steps}: allowed: 1 or more")
        return plain_of(SharingScene, self._core.sharing_in_scene(scenario, most_steps))

    def feed(
        self,
        stroke_deg: float,
        frequencies_hz: Iterable[float] | None = None,
        *,
        brake_nm: float | None = None,
        inertia_kg_m2: float | None = None,
        driver: str = "outer",
        allowed_deg: float = 0.1,
        springs: Iterable[float] = (),
    ) -> Feed:
        """What each stroke of an indexing drive feeds, at each frequency (Hz, rising; left out: 1 to 50). The race ``driver``,
        ``outer`` or ``inner``, turns by ``stroke_deg`` and back, the other is fed against ``brake_nm`` (left out: the nominal
        torque of ``[limits]``) with ``inertia_kg_m2`` turning with it (left out: the race alone). A stroke may feed more or less than slow
        ones by ``allowed_deg``. ``springs``: other springs to look at, factors of stiffness and drag torque of the file's.

        Raises ``ValueError`` for what makes no sense, :class:`NoClutch` where the clutch cannot begin so.
        """
        if driver not in ("outer", "inner"):
            raise ValueError(f"driver {driver!r}: allowed: outer, inner")
        given = {"stroke_deg": stroke_deg, "brake_nm": brake_nm, "inertia_kg_m2": inertia_kg_m2, "allowed_deg": allowed_deg}
        for name, value in given.items():
            if value is not None:
                _positive(name, [value])
        frequencies = None if frequencies_hz is None else _positive("frequencies_hz", frequencies_hz)
        core = self._core.feed(stroke_deg, frequencies, brake_nm, inertia_kg_m2, driver == "inner", allowed_deg, _positive("springs", springs))
        return plain_of(Feed, core)

    def problem(self, *, full: bool = False) -> Problem:
        """The variables of ``[optimize]`` and the margins at their values, for optimisers of others. ``full`` leaves nothing
        out that a scene cannot feel.

        Raises ``ValueError`` where the design has no such table.
        """
        return Problem(self, full=full)

    def evaluate(self, x: Iterable[float]) -> Evaluation:
        """Margins at the values ``x`` of the variables of ``[optimize]``, as the command ``evaluate`` has them.

        Raises ``ValueError`` for another number of values, and for one out of its bounds.
        """
        if self._problem is None:
            self._problem = self.problem()
        return self._problem.evaluate(x)

    def drawing_svg(self, what: str = "sprag") -> str:
        """A drawing to scale: ``sprag``, ``clutch`` or ``centres`` (arc centres)."""
        names = ("sprag", "clutch", "centres")
        if what not in names:
            raise ValueError(f"drawing {what!r}: allowed: {', '.join(names)}")
        return self._core.drawings()[names.index(what)]

    def _repr_html_(self) -> str:
        title = f"<p><b>{html.escape(self.name)}</b> <code>{self.hash[:12]}</code></p>"
        try:
            return title + self.drawing_svg()
        except ValueError as why:
            return f"{title}<p>{html.escape(str(why))}</p>"

    def __repr__(self) -> str:
        return f"<Design {self.name!r} {self.hash[:12]}>"

    def __eq__(self, other: object) -> bool:
        return self.hash == other.hash if isinstance(other, Design) else NotImplemented

    def __hash__(self) -> int:
        return hash(self.hash)

    def __reduce__(self) -> tuple[Any, ...]:
        return Design.parse, (self.text, str(self.folder), self._core.file)


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
        values = [float(v) for v in x]
        objectives, limits, least, violation, feasible, refused = self._core.evaluate(values)
        return Evaluation(tuple(values), tuple(objectives), tuple(limits), least, violation, feasible, refused)

    def evaluate_all(self, points: Iterable[Iterable[float]]) -> list[Evaluation]:
        """Margins at many points, rows of an array say, side by side on all cores; in their order. As :meth:`evaluate`."""
        rows = [[float(v) for v in x] for x in points]
        return [
            Evaluation(tuple(x), tuple(objectives), tuple(limits), least, violation, feasible, refused)
            for x, (objectives, limits, least, violation, feasible, refused) in zip(
                rows, self._core.evaluate_all(rows), strict=True
            )
        ]

    def sample(self, count: int, *, seed: int = 1, first: int = 0) -> Numbers:
        """``count`` scrambled Sobol points of the box, a row each, from number ``first`` on: those of the command ``sample``."""
        import numpy as np

        for name, value in ("count", count), ("seed", seed), ("first", first):
            if value < 0:
                raise ValueError(f"{name} {value}: allowed: 0 or more")
        return np.array(self._core.sample(count, seed, first), dtype=np.float64)

    def design_at(self, x: Iterable[float]) -> Design:
        """The design with the values ``x``, and with the limits of ``[optimize]``, so that ``check`` holds it to what was
        searched for."""
        text = self._core.file_at([float(v) for v in x])
        return Design.parse(text, self.design.folder, self.design._core.file)

    def __reduce__(self) -> tuple[Any, ...]:
        return _problem, (self.design, self.full)


def _problem(design: Design, full: bool) -> Problem:
    return Problem(design, full=full)


def map_tables(
    tables: str | os.PathLike[str] | Sequence[str | os.PathLike[str]],
    *,
    over: Sequence[tuple[str, str]] = (),
    by: str = "margin",
) -> SweepMap:
    """What tables of margins show, parts of one sweep as the command ``evaluate`` writes them: how much of the box is held,
    what decides, planes over two variables each (``over``; left out the first six pairs that vary). Read in flat memory.

    Raises ``ValueError`` for what is no such table, and for an unknown column or variable.
    """
    paths = [tables] if isinstance(tables, (str, os.PathLike)) else list(tables)
    if not paths:
        raise ValueError("tables: allowed: one or more")
    return map_of(_core.map_tables(paths, by, [(x, y) for x, y in over]))
