"""Searches that are followed, stopped, resumed; what they find is the file of the command."""

from __future__ import annotations

import json
import pickle
from pathlib import Path

import numpy as np
import pytest

import sprag_design as sd

from .conftest import MULTI_ARC, Command, python
from .test_processes import needs_fork

NOT_OPTIMISED = "Nothing in it is optimised"


def test_progress_is_that_of_the_command(design: sd.Design) -> None:
    seen: list[sd.Progress] = []
    found = design.optimize(starts=1, evaluations=30, progress=seen.append)
    assert found.status == "evaluation-limit" or found.evaluations >= 30
    counts = [p.evaluations for p in seen]
    assert counts == sorted(counts) and counts[0] >= 1 and len(seen) >= 2
    best = [p.best for p in seen if p.best is not None]
    assert best and f"best feasible {best[-1]:.5f}" in seen[-1].words
    assert str(seen[-1]).endswith(f"{counts[-1]} evaluations")


@pytest.mark.parametrize("no", [False, np.False_])
def test_a_progress_that_says_no_stops_with_the_best_so_far(design: sd.Design, no: object) -> None:
    calls = 0

    def enough(so_far: sd.Progress) -> object:
        nonlocal calls
        calls += 1
        return no if so_far.best is not None and so_far.evaluations > 20 else 0

    found = design.optimize(starts=1000, evaluations=100_000, progress=enough)
    assert found.status == "interrupted" and 20 < found.evaluations < 5000 and calls >= 1
    assert found.best.objective >= found.start.objective and found.design.check().margins


def test_an_exception_of_progress_is_raised(design: sd.Design) -> None:
    def broken(so_far: sd.Progress) -> None:
        raise LookupError(so_far.part)

    with pytest.raises(LookupError):
        design.optimize(starts=1000, evaluations=100_000, progress=broken)


@needs_fork
@pytest.mark.parametrize("call", ["optimize(", "pareto(['slip-margin', 'torque-capacity'], "])
def test_ctrl_c_leaves_the_best_so_far(call: str, tmp_path: Path) -> None:
    code = """
import os, signal, sys
import sprag_design as sd
design = sd.Design.load(sys.argv[1])
def stop(so_far):
    if so_far.best is not None and so_far.evaluations > 40: os.kill(os.getpid(), signal.SIGINT)
try:
    design.CALLstarts=1000, evaluations=100000, progress=stop)
except KeyboardInterrupt as ended:
    found = ended.found
    optimum = getattr(found, "optimum", found)
    optimum.design.save(sys.argv[2] + "/best.toml")
    print(type(ended).__name__, type(found).__name__, optimum.status, optimum.evaluations)
""".replace("CALL", call)
    done = python(code, MULTI_ARC, tmp_path)
    words = done.stdout.split()
    assert words[:3] == ["Interrupted", "Optimum" if call == "optimize(" else "Front", "interrupted"], done.stderr
    assert sd.Design.load(tmp_path / "best.toml").check().margins


def test_what_a_stop_leaves_can_be_pickled(design: sd.Design) -> None:
    ended = sd.Interrupted(design.check())
    again = pickle.loads(pickle.dumps(ended))
    assert isinstance(again, sd.Interrupted) and issubclass(sd.Interrupted, KeyboardInterrupt) and again.found == ended.found and "found" in str(again)


def test_a_journal_goes_on_where_a_search_was_stopped(design: sd.Design, command: Command, tmp_path: Path) -> None:
    journal = tmp_path / "search.csv"
    stopped = design.optimize(starts=1, evaluations=60, journal=journal, progress=lambda so_far: so_far.evaluations < 15)
    rows = len(journal.read_text().splitlines())
    assert stopped.status == "interrupted" and rows > 10
    again = design.optimize(starts=1, evaluations=60, journal=journal)
    whole = design.optimize(starts=1, evaluations=60)
    assert again.to_dict()["best"] == whole.to_dict()["best"] and again.status == whole.status
    # It is the command's journal: another search adds nothing to it.
    all_rows = journal.read_text()
    flags = ["--starts", "1", "--evaluations", "60", "--journal", journal, "--json", "--quiet"]
    said = json.loads(command("optimize", MULTI_ARC, "-o", tmp_path / "new.toml", *flags).stdout)
    assert said["best"] == whole.to_dict()["best"] and journal.read_text() == all_rows
    foreign = tmp_path / "notes.csv"
    foreign.write_text("mine\n1\n")
    with pytest.raises(ValueError, match="no journal"):
        design.optimize(starts=1, evaluations=5, journal=foreign)
    assert foreign.read_text() == "mine\n1\n"
    with pytest.raises(OSError, match="nowhere"):
        design.optimize(starts=1, evaluations=5, journal=tmp_path / "nowhere" / "a.csv")


def test_a_saved_optimum_is_the_file_of_the_command(command: Command, tmp_path: Path) -> None:
    """Byte for byte, but for who asked."""
    first, theirs, mine = (tmp_path / name for name in ("first.toml", "theirs.toml", "mine.toml"))
    made = sd.new("two-speed", bore_mm=40, torque_nm=1000)
    made.design.save(first)
    assert NOT_OPTIMISED in made.design.text
    flags = ["--starts", "1", "--evaluations", "60", "--quiet"]
    assert command("optimize", first, "-o", theirs, *flags).returncode == 0
    found = sd.Design.load(first).optimize(starts=1, evaluations=60)
    found.design.save(mine)
    assert NOT_OPTIMISED not in found.design.text
    by = "# by: Python, design.optimize(evaluations=60, starts=1)"
    assert by in mine.read_text().splitlines()

    def said(path: Path) -> list[str]:
        return [line for line in path.read_text().splitlines() if not line.startswith("# by: ")]

    assert said(mine) == said(theirs)
    # A file that the tool has written may be searched on, and is told as one that it has written.
    assert command("optimize", mine, "-o", theirs, *flags).returncode == 0


def test_the_nearest_design_says_what_it_does_not_hold(design: sd.Design, command: Command, tmp_path: Path) -> None:
    hard = design.set("limits.hoop_inner_mpa", 1.0)
    found = hard.optimize(starts=1, evaluations=10)
    assert not found.feasible and "NOT FEASIBLE" in found.design.text.splitlines()[0]
    assert "NOT HELD" in repr(found)


def test_what_was_found_is_set_again(design: sd.Design) -> None:
    """Variables are floats, whole ones too."""
    first = sd.new("two-speed", bore_mm=40, torque_nm=1000).design
    counted = first.set("optimize.variables", [*first["optimize.variables"], {"name": "count", "min": first["count"], "max": first["count"] + 1}])
    found = counted.optimize(starts=1, evaluations=10)
    assert isinstance(found.best.variables["count"], float)
    again = counted.with_(**found.best.variables)
    assert isinstance(again["count"], int) and all(again[name] == value for name, value in found.best.variables.items())
    assert design.with_(count=11.0) == design.with_(count=11) and design.with_(count=np.float64(11)) == design.with_(count=11)
    with pytest.raises(sd.DesignError, match=r"(?s)11\.5.*whole number"):
        design.with_(count=11.5)


def test_whole_numbers_may_be_floats(design: sd.Design) -> None:
    found = design.optimize(evaluations=1e1, starts=1.0)
    assert found.evaluations > 0 and "evaluations=10," in found.design.text
    assert len(design.problem().sample(3.0)) == 3 and len(design.simulate("low-6", rows=1e2).history["time_s"]) >= 2
    for options, word in [({"evaluations": 10.5}, "evaluations 10.5: allowed: a whole number"), ({"starts": 0}, "starts 0: allowed: 1 or more")]:
        with pytest.raises(ValueError, match=word):
            design.optimize(**options)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="points 65: allowed: 2 to 64"):
        design.pareto(["slip-margin", "torque-capacity"], points=65)
    with pytest.raises(ValueError, match="rows 'many'"):
        design.simulate("low-6", rows="many")  # type: ignore[arg-type]
