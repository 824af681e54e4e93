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

from .conftest import DESIGNS, MULTI_ARC, NAMES, ROOT, Command, figures

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


def test_the_front_is_that_of_the_command(design: sd.Design, command: Command, tmp_path: Path) -> None:
    aims = ["slip-margin", "torque-capacity"]
    flags = ["--pareto", ",".join(aims), "--points", "2", "--starts", "1", "--evaluations", "60", "--json", "--quiet"]
    said = command("optimize", MULTI_ARC, "-o", tmp_path / "new.toml", *flags)
    front = design.pareto(aims, points=2, starts=1, evaluations=60)
    assert front.to_dict()["pareto"] == json.loads(said.stdout)["pareto"]
    assert len(front.points) >= 2 and list(front.points[0].objectives) == sorted(aims)
    with pytest.raises(ValueError, match="two or three different"):
        design.pareto(["slip-margin", "slip-margin"])
    with pytest.raises(ValueError, match="lift-off"):
        design.pareto(["slip-margin", "beauty"])


def test_a_robust_search_is_that_of_the_command(design: sd.Design, command: Command, tmp_path: Path) -> None:
    path = tmp_path / "made.toml"
    path.write_text(MULTI_ARC.read_text().replace("[optimize]", "[tolerances]\nsprag_inner_radius_mm = 0.002\n\n[optimize]"))
    flags = ["--robust", "--draws", "10", "--starts", "1", "--evaluations", "20", "--json", "--quiet"]
    said = json.loads(command("optimize", path, "-o", tmp_path / "new.toml", *flags).stdout)
    found = sd.Design.load(path).optimize(starts=1, evaluations=20, robust=True, draws=10)
    for key in ("best", "tolerances", "robust", "not_done"):
        assert found.to_dict()[key] == said[key], key
    assert (found.robust_design is None) == (found.robust is None)
    if found.robust_design is not None:
        written = sd.Design.load(tmp_path / "new.robust.toml")
        assert written.check().to_dict()["margins"] == found.robust_design.check().to_dict()["margins"]
    with pytest.raises(ValueError, match="tolerances"):
        design.optimize(robust=True)


def test_life_is_that_of_the_command(design: sd.Design, command: Command) -> None:
    path = DESIGNS / "indexing-life.toml"
    life = sd.Design.load(path).life()
    said = command("life", path, "--json", "--quiet")
    assert mine(life.to_dict()) == figures(said.stdout)
    assert life.held == (said.returncode == 0) and len(life.places) >= 2
    with pytest.raises(ValueError, match=r"\[life\]"):
        design.life()


def test_overrun_is_that_of_the_command(design: sd.Design, command: Command) -> None:
    path = DESIGNS / "lubricated.toml"
    lubricated = sd.Design.load(path)
    said = command("overrun", path, "--speeds", "300,1000", "--temperatures", "20,60", "--race", "outer", "--json", "--quiet")
    found = lubricated.overrun([300, 1000], [20, 60], race="outer")
    assert mine(found.to_dict()) == figures(said.stdout)
    assert [(line.oil_c, round(line.speed_rpm)) for line in found.lines] == [(20, 300), (20, 1000), (60, 300), (60, 1000)]
    assert found.lines[0].film_over_roughness == found.to_dict()["lines"][0]["lambda"]
    assert mine(lubricated.overrun().to_dict()) == figures(command("overrun", path, "--json", "--quiet").stdout)
    for options, word in [
        ({"race": "cage"}, "inner, outer"),
        ({"speeds_rpm": [0.0]}, "above 0"),
        ({"speeds_rpm": [float("nan")]}, "above 0"),
        ({"temperatures_c": [float("nan")]}, "-60 to 250"),
    ]:
        with pytest.raises(ValueError, match=word):
            lubricated.overrun(**options)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="lubrication"):
        design.overrun()


def test_reengage_is_that_of_the_command(command: Command) -> None:
    path = DESIGNS / "starter.toml"
    starter = sd.Design.load(path)
    flags = ["--torque", "50", "--inner-inertia", "0.05", "--outer-inertia", "0.05", "--friction", "0.06", "--paths", "0.1,10"]
    said = command("reengage", path, *flags, "--json", "--quiet")
    found = starter.reengage(
        [0.1, 10], torque_nm=50, inertia_inner_kg_m2=0.05, inertia_outer_kg_m2=0.05, friction=0.06
    )
    assert mine(found.to_dict()) == figures(said.stdout)
    assert found.held == (said.returncode == 0) and [b.path_mm for b in found.blows] == [0.1, 10]
    over = ["--over-friction", "0.04,0.06", "--over-inertia", "0.01"]
    said = command("reengage", path, "--torque", "50", "--friction", "0.06", "--paths", "0.1", *over, "--json", "--quiet")
    table = starter.reengage([0.1], torque_nm=50, friction=0.06, over_friction=[0.04, 0.06], over_inertia_kg_m2=[0.01])
    assert mine(table.to_dict()) == figures(said.stdout) and [b.friction for b in table.over] == [0.04, 0.06]
    for options, word in [
        ({"torque_nm": float("nan")}, "torque_nm"),
        ({"paths_mm": [3, 1]}, "longer than the one before"),
        ({"speed_rpm": float("inf")}, "finite"),
    ]:
        with pytest.raises(ValueError, match=word):
            starter.reengage(**options)  # type: ignore[arg-type]


def test_sharing_is_that_of_the_command(command: Command, design: sd.Design) -> None:
    path = DESIGNS / "unlike-sprags.toml"
    said = command("sharing", path, "--torque", "40", "--json", "--quiet")
    found = sd.Design.load(path).sharing(40)
    assert mine(found.to_dict()) == figures(said.stdout)
    assert found.held == (said.returncode == 0) and [s.number for s in found.sprags] == list(range(1, len(found.sprags) + 1))
    with pytest.raises(ValueError, match="above 0"):
        sd.Design.load(path).sharing(float("nan"))
    with pytest.raises(ValueError, match="sharing"):
        design.sharing()


def test_a_scene_of_sprags_one_by_one_is_that_of_the_command(command: Command, design: sd.Design) -> None:
    path = DESIGNS / "unlike-sprags.toml"
    said = command("sharing", path, "--scenario", "engagement", "--json", "--quiet")
    found = sd.Design.load(path).sharing_in_scene("engagement")
    assert mine(found.to_dict()) == figures(said.stdout)
    assert found.held == (said.returncode == 0) and [s.number for s in found.sprags] == list(range(1, 13))
    assert found.bearing_max_n is not None and found.bearing_max_n > 0
    assert set(found.to_dict()) <= {f.name for f in dataclasses.fields(found)}
    assert set(found.to_dict()["sprags"][0]) <= {f.name for f in dataclasses.fields(sd.SceneSprag)}
    with pytest.raises(KeyError, match="engagement"):
        sd.Design.load(path).sharing_in_scene("nothing")
    with pytest.raises(ValueError, match="most_steps"):
        sd.Design.load(path).sharing_in_scene("engagement", most_steps=0)
    with pytest.raises(ValueError, match="sharing"):
        design.sharing_in_scene("high-6")


def test_feed_is_that_of_the_command(command: Command) -> None:
    path = DESIGNS / "indexing.toml"
    flags = ["--stroke", "12", "--brake", "50", "--frequency", "5,10", "--inertia", "0.02"]
    said = command("feed", path, *flags, "--json", "--quiet")
    found = sd.Design.load(path).feed(12, [5, 10], brake_nm=50, inertia_kg_m2=0.02)
    assert mine(found.to_dict()) == figures(said.stdout)
    assert found.held == (said.returncode == 0) and [f.frequency_hz for f in found.frequencies] == [5, 10]
    said = command("feed", path, *flags, "--spring", "0.5,2", "--json", "--quiet")
    found = sd.Design.load(path).feed(12, [5, 10], brake_nm=50, inertia_kg_m2=0.02, springs=[0.5, 2])
    assert mine(found.to_dict()) == figures(said.stdout) and [s.factor for s in found.springs] == [0.5, 2]
    for options, word in [({"driver": "cage"}, "outer, inner"), ({"brake_nm": 1e9}, "brake"), ({"allowed_deg": 0.0}, "allowed_deg")]:
        with pytest.raises((ValueError, sd.NoClutch), match=word):
            sd.Design.load(path).feed(12, [5], **options)  # type: ignore[arg-type]


def test_a_map_is_that_of_the_command(command: Command, tmp_path: Path) -> None:
    table = tmp_path / "margins.csv"
    said = command("evaluate", MULTI_ARC, "--static", "--grid", "r_i2_mm=4,centroid_x_mm=3", "--csv", table)
    assert said.returncode == 0, said.stderr
    answer = sd.map_tables(table, over=[("r_i2_mm", "centroid_x_mm")])
    assert answer.to_dict() == json.loads(command("map", table, "--json").stdout)
    plane = answer.planes[0]
    assert plane.best.shape == plane.decides.shape == (3, 4) == (len(plane.y_edges) - 1, len(plane.x_edges) - 1)
    assert plane.points.sum() == answer.points == 12 and plane.held.sum() == answer.held
    with pytest.raises(ValueError, match="cannot be read"):
        sd.map_tables(tmp_path / "nowhere.csv")
    with pytest.raises(ValueError, match="r_i2_mm"):
        sd.map_tables(table, over=[("r_i2", "r_i3_mm")])


def test_every_key_of_json_is_an_attribute(design: sd.Design) -> None:
    simulation = design.simulate("low-6")
    life = sd.Design.load(DESIGNS / "indexing-life.toml").life()
    overrun = sd.Design.load(DESIGNS / "lubricated.toml").overrun([300])
    blow = sd.Design.load(DESIGNS / "starter.toml").reengage([1], torque_nm=50, friction=0.06)
    sharing = sd.Design.load(DESIGNS / "unlike-sprags.toml").sharing()
    feed = sd.Design.load(DESIGNS / "indexing.toml").feed(12, [5], brake_nm=50)
    rows = [(life, "places"), (life, "loads"), (overrun, "lines"), (blow, "blows"), (sharing, "sprags"), (feed, "frequencies")]
    for answer, key in rows:
        known = {f.name for f in dataclasses.fields(getattr(answer, key)[0])} | {"lambda"}
        assert set(answer.to_dict()[key][0]) <= known, key
    train = sd.Design.load(ROOT / "tests" / "reference" / "drivetrain.toml").simulate("all")
    assert train.eigenfrequencies and "frequency_hz" in train.eigenfrequencies[0] and simulation.eigenfrequencies is None
    for answer in (design.check(), simulation, train, design.optimize(starts=1, evaluations=5), life, overrun, blow, sharing, feed):
        fields = {f.name for f in dataclasses.fields(answer)}
        for key in answer.to_dict():
            name = {"pass": "passed"}.get(key, key)
            assert name in fields, (type(answer), key)
    law = design.stiffness([3.0]).to_dict()["laws"][0]
    known = {f.name for f in dataclasses.fields(sd.Curve)}
    assert set(law["points"][0]) <= known


def test_a_table_is_set_as_one(design: sd.Design) -> None:
    oil = {"oil": "ISO VG 32", "temperature_c": 60, "race_roughness_um": 0.25, "sprag_roughness_um": 0.25}
    wet = design.set("lubrication", oil)
    assert wet.overrun().to_dict()["oil"] == "ISO VG 32"
    with pytest.raises(sd.DesignError, match="oil"):
        design.set("lubrication", {**oil, "oil": "olive"})


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


def test_a_check_shows_what_the_command_shows(design: sd.Design) -> None:
    pytest.importorskip("pandas")
    check = design.check()
    slip = check.margin("slip:low-10")
    assert slip.slip_margin is not None and slip.shown_margin == slip.slip_margin != slip.margin
    shown = check._repr_html_()
    assert f"<td>10 % wanted</td><td>μ</td><td>{100.0 * slip.slip_margin:.3g} %</td><td>held</td>" in shown
    table = check.to_pandas()
    assert list(table.columns[table.columns.get_loc("margin") :][:2]) == ["margin", "slip_margin"]
    assert table["slip_margin"].dtype == table["demand"].dtype == np.float64
    # A scene that is overloaded has rows without demand and allowable.
    overloaded = design.set("scenarios[rated-45].preload_nm", 3000.0).check()
    assert any(row.allowable is None for row in overloaded.margins)
    assert "NOT HELD" in overloaded._repr_html_() and len(overloaded.to_pandas()) == len(overloaded.margins)


def test_an_optimum_says_what_it_is(design: sd.Design) -> None:
    found = design.optimize(evaluations=12, starts=1)
    assert f"{found.best.objective:.5g}" in found.verdict and found.verdict in repr(found)
    shown = found._repr_html_()
    assert all(f"<td>{name}</td>" in shown for name in found.best.variables)
    assert f"<td>{found.best.margins[0].code}</td>" in shown


def test_what_cannot_be_drawn_or_made_says_why(design: sd.Design) -> None:
    pytest.importorskip("matplotlib").use("Agg")
    low = design.simulate("low-6")
    with pytest.raises(KeyError, match="no column nix; there are: time_s"):
        low.plot("nix")
    with pytest.raises(TypeError, match="Design.load"):
        sd.Design("huang.toml")  # type: ignore[arg-type]
    assert "os" not in dir(sd)
