"""Arrays of another shape, files that go, workers that are killed, disks that are full."""

from __future__ import annotations

import json
import subprocess
import sys
import sysconfig
import threading
import time
from pathlib import Path

import numpy as np
import pytest

import sprag_design as sd

from .conftest import DESIGNS, MULTI_ARC, python

needs_fork = pytest.mark.skipif(sys.platform == "win32", reason="Windows has no fork")


@pytest.mark.parametrize(
    "x", [np.zeros((2, 4)), np.zeros((1, 4)), np.full((4, 1), 4.0), np.array(4.0), np.zeros(3), np.full(4, np.nan), np.full(4, np.inf), "4.08", [None] * 4]
)
def test_an_array_of_another_shape_is_no_vector(design: sd.Design, x: object) -> None:
    with pytest.raises((ValueError, TypeError)):
        design.evaluate(x)  # type: ignore[arg-type]


@pytest.mark.parametrize("points", [np.zeros(4), np.zeros((2, 3)), np.zeros((1, 2, 4)), [[4.08, 4.15, 0.19, np.nan]]])
def test_an_array_of_another_shape_is_no_list_of_points(design: sd.Design, points: object) -> None:
    with pytest.raises((ValueError, TypeError)):
        design.problem().evaluate_all(points)  # type: ignore[arg-type]
    assert design.problem().evaluate_all(np.zeros((0, 4))) == []


@pytest.mark.parametrize("torques", [np.zeros((2, 2)), np.ones((2, 1)), [np.nan], np.array([-1.0]), ["x"]])
def test_torques_of_another_shape_are_none(design: sd.Design, torques: object) -> None:
    with pytest.raises((ValueError, TypeError)):
        design.stiffness(torques)  # type: ignore[arg-type]


@pytest.mark.parametrize("values", [np.ones((2, 2)), np.ones((2, 1)), [np.nan], [np.inf], "fast", [None]])
def test_speeds_and_paths_of_another_shape_are_none(values: object) -> None:
    lubricated, starter = (sd.Design.load(DESIGNS / f"{name}.toml") for name in ("lubricated", "starter"))
    with pytest.raises((ValueError, TypeError)):
        lubricated.overrun(values)  # type: ignore[arg-type]
    with pytest.raises((ValueError, TypeError)):
        lubricated.overrun([300], values)  # type: ignore[arg-type]
    with pytest.raises((ValueError, TypeError)):
        starter.reengage(values, torque_nm=50, friction=0.06)  # type: ignore[arg-type]


@pytest.mark.parametrize("value", [np.array([4.1]), np.array([[4.1]]), float("nan"), np.float64("inf"), None])
def test_a_value_of_another_shape_is_none(design: sd.Design, value: object) -> None:
    with pytest.raises((sd.DesignError, TypeError)):
        design.with_(r_i2_mm=value)  # type: ignore[arg-type]
    # An array without an axis is a number.
    assert design.with_(r_i2_mm=np.array(4.1)) == design.with_(r_i2_mm=4.1)  # type: ignore[arg-type]


@pytest.mark.parametrize("options", [{"count": -1}, {"count": 2, "seed": -1}, {"count": 2, "first": -1}])
def test_points_that_are_less_than_none_are_refused(design: sd.Design, options: dict[str, int]) -> None:
    with pytest.raises(ValueError, match="allowed: 0 or more"):
        design.problem().sample(**options)


@pytest.mark.parametrize("option", ["tolerance", "step_mm", "reserve"])
def test_a_search_by_nan_is_none(design: sd.Design, option: str) -> None:
    with pytest.raises(ValueError, match=f"{option} nan"):
        design.optimize(starts=1, **{option: float("nan")})  # type: ignore[arg-type]


def test_an_answer_does_not_need_the_histories_either(tmp_path: Path) -> None:
    for path in DESIGNS.glob("*"):
        if path.suffix == ".csv" or path.name == "indexing-drive.toml":
            (tmp_path / path.name).write_bytes(path.read_bytes())
    design = sd.Design.load(tmp_path / "indexing-drive.toml")
    known = design.check().to_dict()["margins"]
    for path in tmp_path.iterdir():
        path.unlink()
    tmp_path.rmdir()
    assert design.check().to_dict()["margins"] == known
    # What must be read again says which file is missing.
    with pytest.raises(sd.DesignError, match=r"\.csv"):
        design.set("friction.static", 0.11)


def test_a_file_deleted_while_the_command_runs_is_not_missed(tmp_path: Path) -> None:
    path = tmp_path / "short-lived.toml"
    path.write_text(MULTI_ARC.read_text())
    script = Path(sysconfig.get_path("scripts")) / "sprag-design"
    words = [str(script), "evaluate", str(path), "--static", "--sobol", "300", "--csv", str(tmp_path / "out.csv"), "--quiet"]
    with subprocess.Popen(words) as running:
        while not list(tmp_path.glob(".sprag-design-*")) and running.poll() is None:
            time.sleep(0.01)
        path.unlink()
    assert running.returncode == 0
    assert len((tmp_path / "out.csv").read_text().splitlines()) == 302


def test_a_history_deleted_while_it_runs_is_not_missed(tmp_path: Path) -> None:
    """What a thread computes needs no file any more; what is asked of a new design says which file is gone."""
    for path in DESIGNS.glob("*"):
        if path.suffix == ".csv" or path.name == "indexing-drive.toml":
            (tmp_path / path.name).write_bytes(path.read_bytes())
    design = sd.Design.load(tmp_path / "indexing-drive.toml")
    scene = design.scenarios[0]
    found: list[sd.Simulation] = []
    thread = threading.Thread(target=lambda: found.append(design.simulate(scene)))
    thread.start()
    for path in tmp_path.iterdir():
        path.unlink()
    thread.join()
    known = sd.Design.load(DESIGNS / "indexing-drive.toml").simulate(scene)
    assert found[0].theta_inner_end_rad == known.theta_inner_end_rad
    with pytest.raises(sd.DesignError, match="no such file"):
        sd.Design.load(tmp_path / "indexing-drive.toml")


@needs_fork
def test_a_killed_worker_is_an_exception_and_no_wait() -> None:
    code = """
import multiprocessing, os, signal, sys
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
import sprag_design as sd
design = sd.Design.load(sys.argv[1])
problem = design.problem()
known = problem.evaluate(problem.start)
def work(kill):
    if kill: os.kill(os.getpid(), signal.SIGKILL)
    return problem.evaluate(problem.start)
context = multiprocessing.get_context("fork")
with ProcessPoolExecutor(2, mp_context=context) as pool:
    try:
        list(pool.map(work, [False, True, False, False]))
        sys.exit("nobody was missed")
    except BrokenProcessPool:
        pass
# Neither this process nor another pool is the worse for it.
again = [problem.evaluate(problem.start), design.problem().evaluate_all([problem.start])[0]]
with ProcessPoolExecutor(2, mp_context=context) as pool:
    again += pool.map(work, [False] * 4)
sys.exit(any(a != known for a in again))
"""
    done = python(code, MULTI_ARC)
    assert done.returncode == 0, done.stderr


def full_disk() -> None:
    """No file may grow beyond 4 kB: writing fails as on a full disk."""
    import resource

    resource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096))


@needs_fork
def test_a_full_disk_leaves_no_half_of_a_design(tmp_path: Path) -> None:
    code = """
import resource, sys
import sprag_design as sd
design = sd.Design.load(sys.argv[1])
resource.setrlimit(resource.RLIMIT_FSIZE, (1000, 1000))
try:
    design.save(sys.argv[2] + "/new.toml")
except OSError:
    try:
        design.save(sys.argv[2] + "/other.toml", force=True)
    except OSError:
        sys.exit(0 if design.stiffness([3.0]).windup_deg[0] > 0 else 2)
sys.exit(1)
"""
    done = python(code, MULTI_ARC, tmp_path)
    assert done.returncode == 0, done.stderr
    assert not list(tmp_path.iterdir())


@needs_fork
def test_a_full_disk_fails_a_sweep_in_words_and_a_second_run_is_whole(tmp_path: Path) -> None:
    script = Path(sysconfig.get_path("scripts")) / "sprag-design"
    table = tmp_path / "margins.csv"
    words = [str(script), "evaluate", str(MULTI_ARC), "--static", "--sobol", "64", "--csv", str(table), "--quiet"]
    failed = subprocess.run(words, capture_output=True, text=True, preexec_fn=full_disk, timeout=300)
    assert failed.returncode not in (0, 1) and "margins.csv" in failed.stderr, failed
    assert not table.exists()
    assert subprocess.run(words, timeout=300).returncode == 0
    assert len(table.read_text().splitlines()) == 66


@needs_fork
def test_a_search_without_room_for_its_design_still_answers(tmp_path: Path) -> None:
    script = Path(sysconfig.get_path("scripts")) / "sprag-design"
    flags = ["--starts", "1", "--evaluations", "10", "--json", "--quiet"]
    words = [str(script), "optimize", str(MULTI_ARC), "-o", str(tmp_path / "new.toml"), *flags]
    done = subprocess.run(words, capture_output=True, text=True, preexec_fn=full_disk, timeout=300)
    said = json.loads(done.stdout)
    assert done.returncode not in (0, 1) and "best" in said, done.stderr
    assert "unwritten" in said or "new" in done.stderr
    assert not (tmp_path / "new.toml").exists()
