"""Tables, plots, drawings, pickles."""

from __future__ import annotations

import pickle
from pathlib import Path

import numpy as np
import pytest

import sprag_design as sd

from .test_processes import needs_fork


def test_tables(design: sd.Design) -> None:
    pytest.importorskip("pandas")
    check = design.check()
    assert check.to_pandas().loc["hoop-inner", "margin"] == check.margin("hoop-inner").margin
    simulation = design.simulate("low-6")
    table = simulation.to_pandas()
    assert table.index.name == "time_s" and len(table) == len(simulation.time_s)
    assert table["theta_inner_rad"].iloc[-1] == simulation.theta_inner_rad[-1]
    assert design.stiffness([3.0, 9.0], laws=["roller", "hertz"]).to_pandas()["contact"].tolist() == [
        "roller",
        "roller",
        "hertz",
        "hertz",
    ]


def test_plots(design: sd.Design) -> None:
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    simulation = design.simulate("low-6")
    line = simulation.plot().lines[0]
    assert np.array_equal(line.get_xdata(), simulation.time_s)
    assert np.array_equal(line.get_ydata(), simulation.theta_inner_rad)
    assert len(design.stiffness([3.0, 9.0], laws=["roller", "hertz"]).plot().lines) == 2
    check = design.check()
    assert len(check.plot().patches) == len(check.margins)


def test_a_notebook_shows_the_drawing_and_the_margins(design: sd.Design) -> None:
    page = design._repr_html_()
    assert page.count("<svg") == 1 and design.name in page
    assert "<svg" in design.drawing_svg("clutch") != design.drawing_svg("centres")
    with pytest.raises(ValueError, match="centres"):
        design.drawing_svg("race")
    named = design.set("name", "<b>bold</b>")
    assert "<b>bold</b>" not in named._repr_html_()
    check = design.check()
    assert all(row.code in check._repr_html_() for row in check.margins)


def test_pickles(design: sd.Design) -> None:
    again = pickle.loads(pickle.dumps(design))
    assert again == design and hash(again) == hash(design) and again.stiffness([3.0]).to_dict().keys()
    check = design.check()
    assert pickle.loads(pickle.dumps(check)) == check
    with pytest.raises(TypeError, match="to_dict"):
        pickle.dumps(design.simulate("low-6"))


def test_what_is_given_cannot_be_changed(design: sd.Design) -> None:
    simulation = design.simulate("low-6")
    simulation.to_dict()["notes"].append("mine")
    assert "mine" not in simulation.to_dict()["notes"]
    with pytest.raises(ValueError, match="read-only"):
        simulation.theta_inner_rad[0] = 1.0


def test_a_design_is_saved_once(design: sd.Design, tmp_path: Path) -> None:
    path = tmp_path / "new.toml"
    design.with_(r_i2_mm=4.1).save(path)
    assert sd.Design.load(path) == design.with_(r_i2_mm=4.1)
    with pytest.raises(FileExistsError):
        design.save(path)


@needs_fork
def test_a_design_is_saved_over_another_by_force(design: sd.Design, tmp_path: Path) -> None:
    path = tmp_path / "new.toml"
    design.with_(r_i2_mm=4.1).save(path)
    link = tmp_path / "link.toml"
    link.symlink_to(path)
    path.chmod(0o640)
    design.save(link, force=True)
    assert link.is_symlink() and sd.Design.load(path) == design and path.stat().st_mode & 0o777 == 0o640
    with pytest.raises(OSError):
        design.save(tmp_path, force=True)
    design.save("/dev/null", force=True)
    assert not Path("/dev/null").is_file() and sorted(p.name for p in tmp_path.iterdir()) == ["link.toml", "new.toml"]


def test_an_answer_prints_in_a_line(design: sd.Design) -> None:
    for answer in (design.check(), design.stiffness([10.0])):
        assert "\n" not in repr(answer) and len(repr(answer)) < 1000
        assert repr(answer).startswith(f"<{type(answer).__name__}")
    check = design.check()
    assert check.verdict in str(check)


def test_a_problem_says_whose_it_is_and_what_it_varies(design: sd.Design) -> None:
    said = repr(design.problem())
    assert said.startswith(f"<Problem of {design.name!r}: slip-margin; ") and "r_i2_mm" in said
