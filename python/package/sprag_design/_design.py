"""The design and the questions to it."""

from __future__ import annotations

import html
import json
import math
import os
import warnings
from collections.abc import Callable, Iterable, Mapping, Sequence
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
    Progress,
    Reengagement,
    Sharing,
    SharingScene,
    Simulation,
    Stiffness,
    SweepMap,
    check_of,
    front_of,
    map_of,
    optimum_of,
    plain_of,
    simulation_of,
    stiffness_of,
)

from ._arguments import Setting, called, listed, positive, span, toml, whole, whole_or_none
from ._errors import Interrupted
from ._export import export
from ._files import write
from ._identified import Identification, identify
from ._made import Page, Resonance
from ._problem import Problem

if TYPE_CHECKING:
    import pandas as pd

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
        return Design(self._core.with_settings([(key, toml(value)) for key, value in values.items()]))

    def set(self, path: str, value: Setting) -> Design:
        """The same design with another value at a dotted path of the file, rows counted from 0 or by their name:
        ``design.set("sprags.inner_arcs[1].radius_mm", 4.1)``, ``design.set("scenarios[high-10].amplitude_nm", 9)``.

        Raises :class:`DesignError`.
        """
        return Design(self._core.with_settings([(path, toml(value))]))

    def __getitem__(self, path: str) -> Any:
        """What the file says, in the units of its keys: by the short names of variables, ``design["r_i2_mm"]``, or by dotted path as
        :meth:`set` takes it, ``design["friction.static"]``, ``design["scenarios[high-10].amplitude_nm"]``. A table is a dict.

        Raises ``KeyError`` with the names that there are.
        """
        value, why = self._core.value(_name(path))
        if value is None:
            raise KeyError(why)
        return json.loads(value)

    def get(self, path: str, default: Any = None) -> Any:
        """The same, or ``default`` where this file says nothing of it.

        Raises ``KeyError`` for a name that no design file has.
        """
        value, _ = self._core.value(_name(path))
        return default if value is None else json.loads(value)

    def __contains__(self, path: object) -> bool:
        """Whether the file says something there."""
        try:
            return isinstance(path, str) and self._core.value(path)[0] is not None
        except KeyError:
            return False

    def save(self, path: str | os.PathLike[str], *, force: bool = False) -> None:
        """Write the design file. A file that is there is replaced only with ``force``; where the disk is full nothing is left.

        Raises ``FileExistsError``.
        """
        write(path, self.text, force=force, design=True)

    def check(self) -> Check:
        """Hold the design against each of its limits.

        Raises :class:`NoClutch` where no clutch comes about.
        """
        return check_of(self._core.check())

    def stiffness(
        self,
        torques_nm: float | Iterable[float] | None = None,
        *,
        laws: str | Sequence[str] = (),
        max_torque_nm: float | None = None,
    ) -> Stiffness:
        """The static curve at rest, at torques in N m or at 20 even ones up to ``max_torque_nm`` (the design's peak torque
        where that is left out), by the contact laws named, or the design's own (:func:`contact_laws`).

        Torques beyond the end of a curve have no row: they stand in ``beyond_end_nm``, and a warning names them. Where every curve ends
        before ``max_torque_nm``, the torques go up to the last end, which a warning and ``short_of_nm`` tell.

        Raises ``ValueError`` for a torque that is not above 0, :class:`NoClutch`.
        """
        torques = [] if torques_nm is None else listed("torques_nm", torques_nm)
        if torques and max_torque_nm is not None:
            raise ValueError("torques_nm and max_torque_nm: give one of the two")
        laws = [laws] if isinstance(laws, str) else list(laws)
        found = stiffness_of(self._core.stiffness(torques, laws, max_torque_nm), max_torque_nm)
        if found.short_of_nm is not None:
            ends = "; ".join(f"{law.contact}: curve ends {law.end.reason} at {law.end.torque_nm:.5g} Nm" for law in found.laws)
            warnings.warn(f"max_torque_nm {found.short_of_nm:g} is beyond the end, the torques go up to that ({ends})", stacklevel=2)
        if beyond := sorted({nm for law in found.laws for nm in law.beyond_end_nm}):
            warnings.warn(f"beyond the end of the curve, and no rows: {beyond} N m", stacklevel=2)
        return found

    def simulate(
        self,
        scenario: str,
        *,
        tolerance: float | None = None,
        step_s: float | None = None,
        rows: float | None = None,
        window_s: tuple[float, float] | None = None,
        most_steps: float | None = None,
        full: bool = False,
        method: str = "event",
        band_m_s: float | None = None,
    ) -> Simulation:
        """Run one scenario: verdict, figures with their errors, history. Options are those of the command ``simulate``.

        Raises ``KeyError`` where there is no such scenario, ``ValueError`` for an option that makes no sense.
        """
        if method not in ("event", "published"):
            raise ValueError(f"method {method!r}: allowed: event, published")
        rows_asked, steps = whole_or_none("rows", rows, 2), whole_or_none("most_steps", most_steps, 1)
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
                scenario, method == "published", band_m_s, tolerance, step_s, rows_asked, window_s, steps, full
            )
        )

    def optimize(
        self,
        *,
        evaluations: float = 500,
        starts: float | None = None,
        swarm: float | None = None,
        tolerance: float = 1e-6,
        full: bool = False,
        step_mm: float | None = None,
        reserve: float | None = None,
        robust: bool = False,
        draws: float = 200,
        journal: str | os.PathLike[str] | None = None,
        progress: Callable[[Progress], object] | None = None,
    ) -> Optimum:
        """Search for a better design as the table ``[optimize]`` of the file says; no design is written. ``evaluations``: most
        of each climb; ``starts``: number of climbs, left open 8 to 32; ``swarm``: evaluations of a particle swarm first;
        ``step_mm``: step in which lengths can be made, mm, 0 for none, left open that of the file; ``reserve``: what every limit
        keeps of its margin, left open that of the file; ``robust``: margins within ``[tolerances]`` at every corner and in
        ``draws`` seeded draws, and a design that holds them at every corner.

        ``journal``: a file (CSV) that every evaluation is appended to at once, and whose earlier ones of the same problem are not computed
        again: the same call goes on where a search was stopped, and ends where an uninterrupted one ends.

        ``progress`` is called, in this thread, with the :class:`Progress` so far, up to 50 times a second and at the end. Where it returns
        ``False`` the search stops, and the answer is the best so far, ``status`` ``interrupted``. Ctrl-C raises :class:`Interrupted`, a
        ``KeyboardInterrupt`` that has the same answer as ``found``; before the start is known, a bare one.

        Raises ``ValueError`` where the design has no such table, and for a file that is no journal.
        """
        found = self._search(
            "optimize", (), 8, evaluations, starts, swarm, tolerance, full, step_mm, reserve, robust, draws, journal, progress
        )
        optimum = optimum_of(*found[:4])
        if found[4]:
            raise Interrupted(optimum)
        return optimum

    def pareto(
        self,
        objectives: Sequence[str],
        *,
        points: float = 8,
        evaluations: float = 500,
        starts: float | None = None,
        swarm: float | None = None,
        tolerance: float = 1e-6,
        full: bool = False,
        step_mm: float | None = None,
        reserve: float | None = None,
        journal: str | os.PathLike[str] | None = None,
        progress: Callable[[Progress], object] | None = None,
    ) -> Front:
        """The front between two or three objectives, such as ``["slip-margin", "torque-capacity"]``: designs of which none is
        better in all of them. ``points``: steps between any two of its ends; the other options are those of :meth:`optimize`,
        whose answer comes along. What is stopped before the front is whole has no points, but the optimum so far.

        Raises ``ValueError`` for other objectives than those of ``[optimize]``, and where the design has no such table;
        :class:`Interrupted` as there.
        """
        aims = [objectives] if isinstance(objectives, str) else list(objectives)
        if not 2 <= len(set(aims)) == len(aims) <= 3:
            raise ValueError(f"objectives {aims}: allowed: two or three different ones")
        steps = whole("points", points, 2, 64)
        found = self._search(
            "pareto", aims, steps, evaluations, starts, swarm, tolerance, full, step_mm, reserve, False, 200, journal, progress
        )
        front = front_of(optimum_of(*found[:4]), aims)
        if found[4]:
            raise Interrupted(front)
        return front

    def _search(
        self,
        method: str,
        aims: Sequence[str],
        points: int,
        evaluations: float,
        starts: float | None,
        swarm: float | None,
        tolerance: float,
        full: bool,
        step_mm: float | None,
        reserve: float | None,
        robust: bool,
        draws: float,
        journal: str | os.PathLike[str] | None,
        progress: Callable[[Progress], object] | None,
    ) -> tuple[str, str, Design, Design | None, bool]:
        evaluations, starts = whole("evaluations", evaluations, 1), whole_or_none("starts", starts, 1)
        swarm, draws = whole_or_none("swarm", swarm, 80), whole("draws", draws, 10)
        if not 1e-13 <= tolerance <= 1e-3:
            raise ValueError(f"tolerance {tolerance}: allowed: 1e-13 to 1e-3; 1e-6 serves well")
        for name, value in ("step_mm", step_mm), ("reserve", reserve):
            if value is not None and not 0 <= value <= 1:
                raise ValueError(f"{name} {value}: allowed: 0 to 1")

        def go_on(text: str) -> bool:
            assert progress is not None
            answer = progress(Progress(**json.loads(text)))
            # A False of numpy is one, too.
            return answer is None or type(answer).__name__ not in ("bool", "bool_") or bool(answer)

        options = {
            "points": (points, 8),
            "evaluations": (evaluations, 500),
            "starts": (starts, None),
            "swarm": (swarm, None),
            "tolerance": (tolerance, 1e-6),
            "full": (full, False),
            "step_mm": (step_mm, None),
            "reserve": (reserve, None),
            "robust": (robust, False),
            "draws": (draws, 200),
            "journal": (None if journal is None else os.fspath(journal), None),
        }
        by = called(f"design.{method}", *([list(aims)] if aims else []), **options)
        common, body, design, other, said, interrupted = _core.optimize(
            self._core,
            evaluations,
            starts,
            swarm,
            tolerance,
            full,
            step_mm,
            reserve,
            aims,
            points,
            robust,
            draws,
            journal,
            by,
            None if progress is None else go_on,
        )
        for line in said:
            warnings.warn(line, stacklevel=3)
        return common, body, Design(design), None if other is None else Design(other), interrupted

    def resonance(
        self,
        scenario: str | None = None,
        *,
        frequency_hz: float | tuple[float, float] | None = None,
        amplitude_nm: float | tuple[float, float] | None = None,
        points: float | tuple[float, float] | None = None,
        tolerance: float = 1e-6,
    ) -> Resonance:
        """Motions that repeat with a torsional excitation, their start forgotten: the one of ``scenario`` (left out: the only one of
        the kind), or a map over frequency (Hz) and amplitude (N m): from and to, or one number. ``points``: how many of each, ends
        included, one number for both; left out 50. ``tolerance``: error allowed of every figure relative to its natural size.

        Raises ``KeyError`` where there is no such scenario, ``ValueError`` where it is no torsional excitation or a drivetrain takes part,
        :class:`NoClutch`; Ctrl-C raises :class:`Interrupted` with the amplitudes that were done.
        """
        wanted: tuple[int, int] | None = None
        if points is not None:
            both = listed("points", points)
            if len(both) not in (1, 2):
                raise ValueError(f"points {points!r}: allowed: one number, or one for frequencies and one for amplitudes")
            wanted = whole("points", both[0], 1, 1000), whole("points", both[-1], 1, 1000)
        if not 1e-9 <= tolerance <= 1e-3:
            raise ValueError(f"tolerance {tolerance}: allowed: 1e-9 to 1e-3")
        frequencies, amplitudes = span("frequency_hz", frequency_hz), span("amplitude_nm", amplitude_nm)
        common, body, interrupted = _core.resonance(self._core, scenario, frequencies, amplitudes, wanted, tolerance)
        found = plain_of(Resonance, (common, body))
        if interrupted:
            raise Interrupted(found)
        return found

    def identify(
        self,
        data: str | os.PathLike[str] | Mapping[str, Iterable[Any]] | pd.DataFrame,
        unknowns: Mapping[str, tuple[float, float]],
        *,
        starts: float = 4,
        seed: float = 1,
        evaluations: float = 200,
    ) -> Identification:
        """Unknown parameters from measured or published numbers: the design that fits them best, how well each value is known, and what
        the data cannot tell apart. ``data``: a file (CSV) or columns by name, a row for each test, as the command ``identify`` has them:
        ``torque_nm`` with ``windup_deg``, ``normal_inner_n``, ..., ``nominal_torque_nm``, ``lift_off_rpm``; ``<column>_sigma``; dotted
        keys that a row changes; a cell that is ``None`` or NaN says nothing. ``unknowns``: the bounds of each, by the name of a variable
        or the dotted path of a number. ``starts``, ``seed``, ``evaluations``: of the search.

        Raises ``ValueError`` for data or unknowns that make no sense, :class:`NoClutch` where no design between the bounds can be compared
        with the data; Ctrl-C raises :class:`Interrupted` with the best so far.
        """
        return identify(self, data, unknowns, starts, seed, evaluations)

    def sheet(self) -> Page:
        """The design sheet, HTML: verdict, dimensioned drawing, margins, scenes, all inputs; prints on A4.

        Raises :class:`NoClutch` where no clutch comes about.
        """
        return Page(f"Design sheet of {self.name}", _core.sheet(self._core, called("design.sheet")))

    def export(
        self,
        path: str | os.PathLike[str],
        *,
        format: str | None = None,
        part: str | None = None,
        table: str | None = None,
        deviation_mm: float | None = None,
        fmi: int | None = None,
        library: str | os.PathLike[str] | None = None,
        clutch_alone: bool = False,
        variant: str | None = None,
        mesh_mm: float | None = None,
        torque_nm: float | None = None,
        increments: float | None = None,
        friction: float | None = None,
        force: bool = False,
    ) -> Path:
        """Write the design for another program; the path of the file. ``path``: a file, or a folder, in which the file is named after the
        design's. ``format``: ``dxf``, ``step``, ``svg``, ``csv``, ``calculix``, ``fmu``, left out by the ending of the file (``.inp``:
        calculix). A file that is there is replaced only with ``force``.

        dxf, step, svg, csv: ``part`` (``sprag``, left out; ``inner``, ``outer``, ``clutch``). csv: ``table`` (``arcs``, left out;
        ``points``, with ``deviation_mm``: the most that a chord leaves its arc, mm). calculix: ``variant``, ``mesh_mm``, ``torque_nm``,
        ``increments``, ``friction`` as the command has them. fmu: ``library``, which the wheel does not have, ``fmi`` (2, left out; 3),
        ``clutch_alone`` leaves ``[[drivetrain]]`` out.

        Raises ``ValueError`` for an option that means nothing to the format, ``FileExistsError``, :class:`NoClutch` where the part cannot be
        drawn.
        """
        options = {
            "part": part,
            "table": table,
            "deviation_mm": deviation_mm,
            "fmi": fmi,
            "library": library,
            "clutch_alone": clutch_alone or None,
            "variant": variant,
            "mesh_mm": mesh_mm,
            "torque_nm": torque_nm,
            "increments": increments,
            "friction": friction,
        }
        return export(self._core, path, format, {name: value for name, value in options.items() if value is not None}, force=force)

    def life(self) -> Life:
        """What the life of loads in the table ``[life]`` of the file does to the clutch.

        Raises ``ValueError`` where the design has no such table, :class:`NoClutch`.
        """
        return plain_of(Life, self._core.life())

    def overrun(
        self, speeds_rpm: float | Iterable[float] = (), temperatures_c: float | Iterable[float] = (), *, race: str = "inner"
    ) -> FilmOverrun:
        """Overrun on the film that ``[lubrication]`` names, at each speed of the race that runs (rpm; left out: 50, 100, 200,
        500 ... up to lift-off and 50 m/s) and each temperature of the oil (C; left out: that of the file). ``race``: the one
        that runs, ``inner`` or ``outer``.

        Raises ``ValueError`` where the design has no such table and for what is no speed or temperature, :class:`NoClutch`.
        """
        if race not in ("inner", "outer"):
            raise ValueError(f"race {race!r}: allowed: inner, outer")
        temperatures = listed("temperatures_c", temperatures_c)
        for celsius in temperatures:
            if not -60.0 <= celsius <= 250.0:
                raise ValueError(f"temperatures_c {celsius}: allowed: -60 to 250")
        speeds = positive("speeds_rpm", speeds_rpm)
        return plain_of(FilmOverrun, self._core.overrun(race == "outer", speeds, temperatures))

    def reengage(
        self,
        paths_mm: float | Iterable[float] | None = None,
        *,
        torque_nm: float | None = None,
        inertia_inner_kg_m2: float | None = None,
        inertia_outer_kg_m2: float | None = None,
        outer_held: bool | None = None,
        friction: float | None = None,
        speed_rpm: float | None = None,
        over_friction: float | Iterable[float] = (),
        over_inertia_kg_m2: float | Iterable[float] = (),
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
                positive(name, [value])
        if speed_rpm is not None and not math.isfinite(speed_rpm):
            raise ValueError(f"speed_rpm {speed_rpm}: allowed: a finite number")
        paths = None if paths_mm is None else positive("paths_mm", paths_mm)
        inertias = (inertia_inner_kg_m2, inertia_outer_kg_m2)
        over = (positive("over_friction", over_friction), positive("over_inertia_kg_m2", over_inertia_kg_m2))
        found = self._core.reengage(torque_nm, inertias, outer_held, friction, speed_rpm, paths, *over)
        return plain_of(Reengagement, found)

    def sharing(self, torque_nm: float | None = None) -> Sharing:
        """What each sprag carries where they are unlike, races bend, run out and give way: the table ``[sharing]`` of the file.
        ``torque_nm``: left out the nominal torque of ``[limits]``.

        Raises ``ValueError`` where the design has no such table or there is no torque, :class:`NoClutch`.
        """
        torque = None if torque_nm is None else positive("torque_nm", [torque_nm])[0]
        return plain_of(Sharing, self._core.sharing(torque))

    def sharing_in_scene(self, scenario: str, *, most_steps: float | None = None) -> SharingScene:
        """A scenario with its sprags one by one, as ``[sharing]`` has them: who catches when, who slips, what each carries over time, what
        the bearings of the races hold. ``most_steps``: as in :meth:`simulate`.

        Raises ``KeyError`` where there is no such scenario, ``ValueError`` where the design has no such table or the scenario cannot be run so.
        """
        steps = whole_or_none("most_steps", most_steps, 1)
        return plain_of(SharingScene, self._core.sharing_in_scene(scenario, steps))

    def feed(
        self,
        stroke_deg: float,
        frequencies_hz: float | Iterable[float] | None = None,
        *,
        brake_nm: float | None = None,
        inertia_kg_m2: float | None = None,
        driver: str = "outer",
        allowed_deg: float = 0.1,
        springs: float | Iterable[float] = (),
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
                positive(name, [value])
        frequencies = None if frequencies_hz is None else positive("frequencies_hz", frequencies_hz)
        core = self._core.feed(stroke_deg, frequencies, brake_nm, inertia_kg_m2, driver == "inner", allowed_deg, positive("springs", springs))
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


def _name(path: str) -> str:
    if not isinstance(path, str):
        raise TypeError(f"{path!r}: a value of a design is named by text, such as 'r_i2_mm' or 'friction.static'")
    return path


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
