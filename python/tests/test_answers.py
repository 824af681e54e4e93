"""The same figures as the command, to the last bit."""

from __future__ import annotations

import csv
import dataclasses
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import sprag_design as sd

from .conftest import DESIGNS, MULTI_ARC, NAMES, Command, figures

# One with slices, one off centre or with press fits, the paper's two.
CHECKED = ["huang2017-multi-arc", "huang2017-single-arc", "series-833-small", "starter"]


def mine(answer: dict[str, Any]) -> dict[str, Any]:
    return {k: v for k, v in answer.items() if k not in NAMES}


@pytest.mark.parametrize("name", CHECKED)
def test_check_is_that_of_the_command(name: str, command: Command) -> None:
    path = DESIGNS / f"{name}.toml"
    check = sd.Design.load(path).check()
    said = command("check", path, "--json", "--quiet")
    assert mine(check.to_dict()) == figures(said.stdout)
    assert check.passed == (said.returncode == 0)
    assert all(row.held == (row.margin >= -1e-8) for row in check.margins)


@pytest.mark.parametrize("scenario", ["high-10", "low-6", "rated-45"])
def test_simulate_is_that_of_the_command(
    scenario: str, design: sd.Design, command: Command, tmp_path: Path
) -> None:
    table = tmp_path / "history.csv"
    said = command("simulate", MULTI_ARC, "--scenario", scenario, "--json", "--quiet", "--csv", table)
    answer = design.simulate(scenario)
    assert mine(answer.to_dict()) == figures(said.stdout)
    with table.open(newline="") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    assert set(rows[0]) <= set(answer.history)
    for name in ("theta_inner_rad", "normal_inner_n", "time_s"):
        written = np.array([float(row[name]) for row in rows])
        assert np.array_equal(written, answer.history[name]), name
    assert [row["mode_inner"] for row in rows] == answer.history["mode_inner"].tolist()
    assert answer.theta_inner_rad is answer.history["theta_inner_rad"]
    assert answer.theta_inner_rad[-1] == pytest.approx(answer.theta_inner_end_rad, abs=1e-9)


def test_stiffness_is_that_of_the_command(design: sd.Design, command: Command) -> None:
    said = command("stiffness", MULTI_ARC, "--torques", "3.34,16.8,1e4", "--contact", "roller,hertz", "--json", "--quiet")
    answer = design.stiffness([3.34, 16.8, 1e4], laws=["roller", "hertz"])
    assert mine(answer.to_dict()) == figures(said.stdout)
    assert answer.torque_nm.tolist() == [3.34, 16.8]
    assert answer.laws[0].beyond_end_nm == (1e4,)
    said_windup = [p["windup_deg"] for p in figures(said.stdout)["laws"][1]["points"]]
    assert answer.laws[1].windup_deg.tolist() == said_windup
    # Without torques: as the command without flags.
    said = command("stiffness", MULTI_ARC, "--json", "--quiet")
    assert mine(design.stiffness().to_dict()) == figures(said.stdout)


def test_evaluate_is_that_of_the_command(design: sd.Design, command: Command) -> None:
    problem = design.problem()
    low, high = (np.array(b) for b in zip(*problem.bounds, strict=True))
    vectors = [problem.start, (0.5 * (low + high)).tolist(), low.tolist()]
    said = command("evaluate", MULTI_ARC, given="\n".join(json.dumps(x) for x in vectors))
    for x, line in zip(vectors, said.stdout.splitlines(), strict=True):
        assert design.evaluate(x).to_dict() == json.loads(line)
    described = json.loads(command("evaluate", MULTI_ARC, "--describe").stdout)
    assert [v.name for v in problem.variables] == [v["name"] for v in described["variables"]]
    assert (problem.objectives, problem.limits) == (described["objectives"], described["limits"])


def test_points_and_their_margins_are_those_of_the_command(design: sd.Design, command: Command) -> None:
    problem = design.problem()
    points = problem.sample(5, seed=3, first=2)
    said = command("sample", MULTI_ARC, "--sobol", "7", "--seed", "3", "--first", "2").stdout.splitlines()[2:]
    assert points.tolist() == [[float(v) for v in line.split(",")[1:]] for line in said]
    assert problem.evaluate_all(points) == [problem.evaluate(x) for x in points]
    with pytest.raises(ValueError, match="lies outside its bounds"):
        problem.evaluate_all([problem.start, [50.0] * 4])


def test_optimize_is_that_of_the_command(design: sd.Design, command: Command, tmp_path: Path) -> None:
    better = tmp_path / "better.toml"
    said = command("optimize", MULTI_ARC, "-o", better, "--starts", "1", "--evaluations", "60", "--json", "--quiet")
    command_says = json.loads(said.stdout)
    found = design.optimize(starts=1, evaluations=60)
    answer = found.to_dict()
    for key in ("status", "feasible", "best", "start", "in_file", "evaluations", "error_estimate", "dropped_variables"):
        assert answer[key] == command_says[key], key
    assert found.feasible and found.design.evaluate(found.best.variables.values()).feasible
    assert list(found.best.variables) == [v.name for v in found.design.problem().variables]
    assert found.makeable and found.free_centroid is not None and found.steps is not None and found.steps.found
    # What the command writes has notes on what was changed, and says the same.
    assert sd.Design.load(better).check().to_dict()["margins"] == found.design.check().to_dict()["margins"]


def test_every_key_of_json_is_an_attribute(design: sd.Design) -> None:
    simulation = design.simulate("low-6")
    for answer in (design.check(), simulation, design.optimize(starts=1, evaluations=5)):
        fields = {f.name for f in dataclasses.fields(answer)}
        for key in answer.to_dict():
            name = {"pass": "passed"}.get(key, key)
            assert name in fields, (type(answer), key)
    law = design.stiffness([3.0]).to_dict()["laws"][0]
    known = {f.name for f in dataclasses.fields(sd.Curve)}
    assert set(law["points"][0]) <= known


def test_a_changed_design_is_that_of_set(design: sd.Design, command: Command) -> None:
    said = command("check", MULTI_ARC, "--set", "r_i2_mm=4.1", "--set", "friction.static=0.11", "--json", "--quiet")
    changed = design.with_(r_i2_mm=4.1).set("friction.static", 0.11)
    assert changed.hash == json.loads(said.stdout)["design_hash"]
    assert mine(changed.check().to_dict()) == figures(said.stdout)
    assert design.set("sprags.inner_arcs[1].radius_mm", 4.1) == design.with_(r_i2_mm=np.float64(4.1))
    assert design.with_(**{"friction.static": 0.11}) == design.set("friction.static", 0.11) != design


def test_the_command_answers_from_the_wheel(command: Command) -> None:
    assert command("--version").stdout.strip() == f"sprag-design {sd.__version__}"
    assert command("check", MULTI_ARC, "--nonsense").returncode == 2
    assert "huang" in command("check", "--help").stdout
