"""Compiled part of sprag_design."""

from collections.abc import Callable, Sequence
from os import PathLike
from pathlib import Path
from typing import final

__all__ = [
    "Compared",
    "Design",
    "Problem",
    "Simulated",
    "__version__",
    "compare",
    "contact_laws",
    "deck",
    "first_design",
    "forked",
    "identify",
    "map_tables",
    "optimize",
    "part",
    "purposes",
    "resonance",
    "run_command",
    "sheet",
    "unit",
]
__version__: str

@final
class Design:
    @staticmethod
    def load(path: str | PathLike[str]) -> Design: ...
    @staticmethod
    def parse(source: str, folder: str | PathLike[str], file: str) -> Design: ...
    def with_settings(self, settings: Sequence[tuple[str, str]]) -> Design: ...
    def value(self, path: str) -> tuple[str | None, str]: ...
    @property
    def name(self) -> str: ...
    @property
    def hash(self) -> str: ...
    @property
    def source(self) -> str: ...
    @property
    def folder(self) -> Path: ...
    @property
    def file(self) -> str: ...
    @property
    def scenarios(self) -> list[str]: ...
    def check(self) -> tuple[str, str, str]: ...
    def stiffness(
        self, torques_nm: Sequence[float], laws: Sequence[str], max_torque_nm: float | None
    ) -> tuple[str, str]: ...
    def simulate(
        self,
        scenario: str,
        published: bool,
        band_m_s: float | None,
        tolerance: float | None,
        step_s: float | None,
        rows: int | None,
        window_s: Sequence[float] | None,
        most_steps: int | None,
        full: bool,
    ) -> Simulated: ...
    def life(self) -> tuple[str, str]: ...
    def overrun(
        self, outer: bool, speeds_rpm: Sequence[float], temperatures_c: Sequence[float]
    ) -> tuple[str, str]: ...
    def reengage(
        self,
        torque_nm: float | None,
        inertia_kg_m2: Sequence[float | None],
        outer_held: bool | None,
        friction: float | None,
        speed_rpm: float | None,
        paths_mm: Sequence[float] | None,
        over_friction: Sequence[float],
        over_inertia_kg_m2: Sequence[float],
    ) -> tuple[str, str]: ...
    def sharing(self, torque_nm: float | None) -> tuple[str, str]: ...
    def sharing_in_scene(self, scenario: str, most_steps: int | None) -> tuple[str, str]: ...
    def feed(
        self,
        stroke_deg: float,
        frequencies_hz: Sequence[float] | None,
        brake_nm: float | None,
        inertia_kg_m2: float | None,
        inner_drives: bool,
        allowed_deg: float,
        springs: Sequence[float],
    ) -> tuple[str, str]: ...
    def problem(self, full: bool) -> Problem: ...
    def drawings(self) -> tuple[str, str, str]: ...

@final
class Problem:
    @property
    def about(self) -> str: ...
    def names(self, x: Sequence[float]) -> tuple[list[str], list[str]]: ...
    def evaluate(
        self, x: Sequence[float]
    ) -> tuple[list[float], list[float], float, float, bool, str | None]: ...
    def evaluate_all(
        self, points: Sequence[Sequence[float]]
    ) -> list[tuple[list[float], list[float], float, float, bool, str | None]]: ...
    def sample(self, count: int, seed: int, first: int) -> list[list[float]]: ...
    def file_at(self, x: Sequence[float]) -> str: ...

@final
class Simulated:
    @property
    def common(self) -> str: ...
    def json(self) -> str: ...
    def verdict_line(self) -> str: ...
    def history(self) -> dict[str, bytes | list[str] | list[int | None]]: ...

@final
class Compared:
    def parts(self) -> tuple[str, str, str]: ...
    def page(self, by: str) -> str: ...

def optimize(
    design: Design,
    evaluations: int,
    starts: int | None,
    swarm: int | None,
    tolerance: float,
    full: bool,
    step_mm: float | None,
    reserve: float | None,
    front: Sequence[str],
    front_steps: int,
    robust: bool,
    draws: int,
    journal: str | PathLike[str] | None,
    by: str,
    progress: Callable[[str], bool] | None,
) -> tuple[str, str, Design, Design | None, list[str], bool]: ...
def identify(
    design: Design,
    table: str,
    named: str,
    unknowns: Sequence[tuple[str, float, float]],
    starts: int,
    seed: int,
    evaluations: int,
    by: str,
) -> tuple[str, str, str, Design, bool]: ...
def resonance(
    design: Design,
    scenario: str | None,
    frequency_hz: Sequence[float] | None,
    amplitude_nm: Sequence[float] | None,
    points: Sequence[int] | None,
    tolerance: float,
) -> tuple[str, str, bool]: ...
def purposes() -> list[tuple[str, str]]: ...
def first_design(
    purpose: str | None, numbers: Sequence[tuple[str, str, float]], material: str | None
) -> tuple[str, str, str, str, Design]: ...
def compare(designs: Sequence[Design]) -> Compared: ...
def sheet(design: Design, by: str) -> str: ...
def part(design: Design, format: str, part: str, deviation_mm: float | None) -> tuple[str, str | None]: ...
def deck(
    design: Design,
    variant: str | None,
    mesh_mm: float | None,
    torque_nm: float | None,
    increments: int | None,
    friction: float | None,
) -> str: ...
def unit(design: Design, three: bool, library: str | PathLike[str], clutch_alone: bool) -> bytes: ...
def run_command(args: Sequence[str]) -> int: ...
def contact_laws() -> list[str]: ...
def forked() -> None: ...
def map_tables(
    tables: Sequence[str | PathLike[str]], by: str, over: Sequence[tuple[str, str]]
) -> tuple[str, str]: ...
