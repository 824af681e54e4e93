"""Errors carry file, line and key; what makes no sense is refused with what is allowed."""

from __future__ import annotations

import pickle
from pathlib import Path

import pytest

import sprag_design as sd

from .conftest import MULTI_ARC


def test_a_refused_design_names_file_line_and_key(tmp_path: Path) -> None:
    path = tmp_path / "bad.toml"
    text = MULTI_ARC.read_text()
    line = next(i for i, row in enumerate(text.splitlines(), 1) if row.startswith("count"))
    path.write_text(text.replace("\ncount = ", "\ncount = -", 1))
    with pytest.raises(sd.DesignError) as caught:
        sd.Design.load(path)
    problem = caught.value.problems[0]
    assert (problem.file, problem.line, problem.key) == (str(path), line, "sprags.count")
    assert problem.found.startswith("-") and problem.allowed and problem.help
    assert f"bad.toml:{line}:" in str(caught.value)
    again = pickle.loads(pickle.dumps(caught.value))
    assert (str(again), again.problems) == (str(caught.value), caught.value.problems)


def test_a_file_that_is_not_there_is_a_design_error() -> None:
    with pytest.raises(sd.DesignError) as caught:
        sd.Design.load("nowhere.toml")
    assert caught.value.problems[0].line is None and "no such file" in str(caught.value)


def test_unknown_names_are_refused_with_the_nearest(design: sd.Design) -> None:
    with pytest.raises(sd.DesignError, match="r_i2_mm"):
        design.with_(r_i22_mm=4.1)
    with pytest.raises(sd.DesignError, match="friction.static"):
        design.set("friction.statik", 0.1)
    with pytest.raises(sd.DesignError):
        design.with_(r_i2_mm=float("nan"))
    with pytest.raises(TypeError, match="a list or a table"):
        design.set("friction.static", object())  # type: ignore[arg-type]
    with pytest.raises(KeyError, match="high-10"):
        design.simulate("high-99")
    with pytest.raises(KeyError, match="hoop-inner"):
        design.check().margin("hoop")
    with pytest.raises(ValueError, match="roller"):
        design.stiffness([3.0], laws=["rolller"])
    with pytest.raises(AttributeError, match="theta_inner_rad"):
        design.simulate("low-6").theta_inner


@pytest.mark.parametrize("torque", [0.0, -1.0, float("nan"), float("inf"), 1e-9])
def test_a_torque_that_is_none_is_refused(design: sd.Design, torque: float) -> None:
    with pytest.raises(ValueError, match="torque"):
        design.stiffness([3.0, torque])


@pytest.mark.parametrize(
    ("options", "word"),
    [
        ({"tolerance": 1.0}, "tolerance"),
        ({"step_s": -1.0}, "step_s"),
        ({"window_s": (0.2, 0.1)}, "window_s"),
        ({"rows": 1}, "rows"),
        ({"method": "euler"}, "published"),
        ({"band_m_s": 1e-4}, "published"),
    ],
)
def test_an_option_that_makes_no_sense_is_refused(
    design: sd.Design, options: dict[str, object], word: str
) -> None:
    with pytest.raises(ValueError, match=word):
        design.simulate("low-6", **options)  # type: ignore[arg-type]


@pytest.mark.parametrize("x", [[], [4.0], [1e9, 4.15, 0.19, 0.53], [float("nan"), 4.15, 0.19, 0.53]])
def test_what_is_no_vector_is_refused(design: sd.Design, x: list[float]) -> None:
    with pytest.raises(ValueError, match="r_i2_mm"):
        design.evaluate(x)


def test_a_design_without_a_task_has_no_problem(design: sd.Design) -> None:
    text = design.text[: design.text.index("[optimize]")]
    with pytest.raises(ValueError, match="optimize"):
        sd.Design.parse(text).evaluate([1.0])


def test_an_answer_does_not_need_the_file(tmp_path: Path) -> None:
    path = tmp_path / "gone.toml"
    path.write_text(MULTI_ARC.read_text())
    design = sd.Design.load(path)
    path.unlink()
    assert design.stiffness([3.0]).windup_deg[0] > 0.0
    assert design.with_(r_i2_mm=4.1).evaluate(design.problem().start).refused is None
