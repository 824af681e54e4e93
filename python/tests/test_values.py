"""Values of a design by name; numbers in a row; answers in a line."""

from __future__ import annotations

import warnings

import numpy as np
import pytest

import sprag_design as sd

from .conftest import DESIGNS


def test_a_value_is_read_by_its_name_and_by_its_path(design: sd.Design) -> None:
    assert design["r_i2_mm"] == design["sprags.inner_arcs[1].radius_mm"] == 4.08
    assert design["count"] == 12 and isinstance(design["count"], int)
    assert design["friction.static"] == design.get("friction.static") == design["friction"]["static"]
    assert design["scenarios[high-10].kind"] == design["scenarios"][design.scenarios.index("high-10")]["kind"]
    assert design.with_(r_i2_mm=4.1)["r_i2_mm"] == 4.1
    assert "friction.static" in design and "cage" not in design and "nonsense" not in design and 3 not in design
    # Whatever can be read can be set.
    assert design.set("friction", design["friction"])["friction"] == design["friction"]


def test_a_value_that_is_not_there_is_told_with_those_that_are(design: sd.Design) -> None:
    for path, word in [
        ("friction.statik", "did you mean friction.static"),
        ("r_i22_mm", "did you mean r_i2_mm"),
        ("limits.windup_nominal_deg", "it holds limits.nominal_torque_nm.*limits.hoop_inner_mpa"),
        ("scenarios[high-11].kind", r"scenarios\[high-10\]"),
        ("sprags.inner_arcs[9].radius_mm", r"sprags.inner_arcs\[2\]"),
        ("", "there are"),
    ]:
        with pytest.raises(KeyError, match=word):
            design[path]
    assert design.get("limits.windup_nominal_deg") is None and design.get("cage", {}) == {}
    with pytest.raises(KeyError, match="did you mean friction.static"):
        design.get("friction.statik")
    with pytest.raises(TypeError, match="named by text"):
        design[0]  # type: ignore[index]


def test_a_table_ends_with_the_curve_and_says_so(design: sd.Design) -> None:
    with pytest.warns(UserWarning, match=r"max_torque_nm 1e\+09 is beyond the end.*off-profile at 200.4"):
        short = design.stiffness(max_torque_nm=1e9)
    assert short.short_of_nm == 1e9 and short.torque_nm[-1] == short.laws[0].end.torque_nm
    assert "off-profile" in repr(short) and "short of" in repr(short)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert design.stiffness(max_torque_nm=50).short_of_nm is None and design.stiffness().short_of_nm is None


def test_one_number_is_a_row_of_one(design: sd.Design) -> None:
    assert design.stiffness(90.0).torque_nm.tolist() == [90.0] == design.stiffness(np.float64(90)).torque_nm.tolist()
    assert len(sd.Design.load(DESIGNS / "lubricated.toml").overrun(300, 60).lines) == 1
    with pytest.raises(ValueError, match=r"torques_nm: an array of shape \(2, 2\).*one axis"):
        design.stiffness(np.ones((2, 2)))
    with pytest.raises(ValueError, match=r"x: an array of shape \(1, 4\)"):
        design.evaluate(np.zeros((1, 4)))
    with pytest.raises(TypeError, match="torques_nm: .*numbers in a row"):
        design.stiffness([[3.0, 4.0]])  # type: ignore[list-item]
    with pytest.raises(TypeError, match="torques_nm 'ten'"):
        design.stiffness("ten")  # type: ignore[arg-type]


def test_an_answer_says_what_it_found_in_a_line(design: sd.Design) -> None:
    feed = sd.Design.load(DESIGNS / "indexing.toml").feed(12, 5, brake_nm=50)
    blow = sd.Design.load(DESIGNS / "starter.toml").reengage(0.1, torque_nm=50, friction=0.06)
    simulation, check = design.simulate("low-6"), design.check()
    assert feed.verdict in repr(feed) and blow.verdict in repr(blow) and check.verdict in repr(check)
    assert simulation.verdict_line in repr(simulation)
    assert repr(design.stiffness([16.8])) == "<Stiffness: roller, 1.975 deg at 16.8 Nm; curve ends off-profile at 200.44 Nm>"
    for answer in (feed, blow, simulation, check, design.stiffness(laws=sd.contact_laws()[:2])):
        assert "\n" not in repr(answer) and len(repr(answer)) < 400 and "run_time_s" not in repr(answer)


def test_stiffness_plots_in_the_same_axes_keep_their_names_apart(design: sd.Design) -> None:
    pytest.importorskip("matplotlib").use("Agg")
    ax = design.stiffness([3.0, 9.0]).plot()
    design.with_(r_i2_mm=4.1).stiffness([3.0, 9.0]).plot(ax)
    design.stiffness([3.0, 9.0], laws=["roller", "hertz"]).plot(ax, label="both")
    legend = ax.get_legend()
    assert legend is not None
    assert [text.get_text() for text in legend.get_texts()] == ["roller", "roller (2)", "both, roller", "both, hertz"]
