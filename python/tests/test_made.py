"""First designs, comparisons, resonance, sheets and exports are those of the command."""

from __future__ import annotations

import dataclasses
import json
import pickle
import re
from pathlib import Path

import pytest

import sprag_design as sd

from .conftest import DESIGNS, MULTI_ARC, Command, figures, python
from .test_answers import mine
from .test_processes import needs_fork

UNWRITTEN = ("written", "unwritten")


def test_new_is_that_of_the_command(command: Command, tmp_path: Path) -> None:
    theirs, own = tmp_path / "theirs.toml", tmp_path / "own.toml"
    flags = ["--for", "indexing", "--bore", "30", "--torque", "200", "--engagements", "1e7", "--material", "20MnCr5"]
    said = command("new", *flags, "-o", theirs, "--json", "--quiet")
    found = sd.new("indexing", bore_mm=30, torque_nm=200, engagements=1e7, material="20MnCr5")
    found.design.save(own)
    assert own.read_bytes() == theirs.read_bytes()
    answer = {k: v for k, v in mine(found.to_dict()).items() if k not in UNWRITTEN}
    assert answer == {k: v for k, v in figures(said.stdout).items() if k not in UNWRITTEN}
    assert found.verdict in repr(found) and sum(row.taken for row in found.tried) == 1
    fields = {f.name for f in dataclasses.fields(found)} | {"sized", "written"}
    assert set(found.to_dict()) <= fields and set(found.to_dict()["tried"][0]) <= {f.name for f in dataclasses.fields(sd.TriedSpace)}
    # What nobody has said is listed as the command lists it.
    listed = command("new", *flags, "-o", theirs, "--force").stdout
    assert found.taken and all(re.search(f"  {re.escape(t.what)} +{re.escape(t.value)} +{re.escape(t.origin)}\n", listed) for t in found.taken)
    assert "indexing" in sd.purposes()


def test_size_is_that_of_the_command(command: Command, tmp_path: Path) -> None:
    theirs, none = tmp_path / "theirs.toml", tmp_path / "none.toml"
    said = command("size", "--bore", "40", "--peak", "1300", "--speed", "3000", "--friction", "0.1", "-o", theirs, "--json", "--quiet")
    found = sd.size(bore_mm=40, peak_nm=1300, keep_contact_rpm=3000, friction=0.1)
    assert found.design.text == theirs.read_text() and found.outside_mm == json.loads(said.stdout)["outside_mm"]
    said = command("size", "--bore", "40", "--torque", "1000", "--outside", "70", "-o", none, "--json", "--quiet")
    with pytest.raises(sd.NotSized) as caught:
        sd.size(bore_mm=40, torque_nm=1000, outside_mm=70)
    refused = json.loads(said.stdout)
    assert list(caught.value.tried) == refused["tried"] and not refused["sized"]
    assert str(caught.value) == refused["why"].replace("--outside", "outside_mm").replace("--width", "width_mm")
    assert pickle.loads(pickle.dumps(caught.value)).tried == caught.value.tried


def test_what_no_clutch_can_be_asked_for_is_refused() -> None:
    for options, word in [
        ({"bore_mm": 40}, "torque_nm or peak_nm"),
        ({"bore_mm": 0.0, "torque_nm": 10}, "bore_mm: found 0 mm; allowed: 1 to 2000 mm"),
        ({"bore_mm": float("nan"), "torque_nm": 10}, "bore_mm"),
        ({"bore_mm": [40, 50], "torque_nm": 10}, "one number"),
        ({"bore_mm": 40, "torque_nm": 100, "material": "wood"}, "the library has"),
        ({"bore_mm": 40, "torque_nm": 100, "keep_contact_rpm": -1}, "keep_contact_rpm"),
    ]:
        with pytest.raises(ValueError, match=word):
            sd.size(**options)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="allowed: .*starter"):
        sd.new("rocket", bore_mm=40, torque_nm=100)


def test_compare_is_that_of_the_command(design: sd.Design, command: Command, tmp_path: Path) -> None:
    pytest.importorskip("pandas")
    after, page = tmp_path / "after.toml", tmp_path / "compare.html"
    design.with_(r_i2_mm=4.1).save(after)
    said = command("compare", MULTI_ARC, after, "--json", "--quiet")
    found = sd.compare([design, sd.Design.load(after)])
    assert mine(found.to_dict()) == figures(said.stdout)
    assert [row.path for row in found.inputs] == ["sprags.inner_arcs[1].radius_mm"] and found.inputs[0].values[1] == 4.1
    assert found.verdict in command("compare", MULTI_ARC, after).stdout and found.verdict in repr(found)
    for key in ("designs", "inputs", "figures", "margins", "scenes"):
        known = {f.name for f in dataclasses.fields(getattr(found, key)[0])} | {"pass"}
        assert set(found.to_dict()[key][0]) <= known, key
    table = found.to_pandas()
    assert table.T["hoop-inner"].tolist() == list(next(m.margins for m in found.margins if m.code == "hoop-inner"))
    assert found.page().save(page) == page and page.read_text().count("<svg") >= 2
    with pytest.raises(ValueError, match="1 designs: allowed: 2 to 6"):
        sd.compare([design])
    with pytest.raises(TypeError, match="to_dict"):
        pickle.dumps(found)


def test_resonance_is_that_of_the_command(design: sd.Design, command: Command) -> None:
    pytest.importorskip("matplotlib").use("Agg")
    said = command("resonance", MULTI_ARC, "--scenario", "high-6", "--json", "--quiet")
    one = design.resonance("high-6")
    assert mine(one.to_dict()) == figures(said.stdout) and len(one.states) == 1 and one.verdict in repr(one)
    ranges = ["--frequency", "50:150", "--amplitude", "2:4", "--points", "5x2"]
    said = command("resonance", MULTI_ARC, "--scenario", "high-6", *ranges, "--json", "--quiet")
    found = design.resonance("high-6", frequency_hz=(50, 150), amplitude_nm=(2, 4), points=(5, 2))
    assert mine(found.to_dict()) == figures(said.stdout)
    assert [s.frequency_hz for s in found.states[:5]] == [50, 75, 100, 125, 150] and found.states[5].amplitude_nm == 4
    state = found.to_dict()["states"][0]
    assert {f.name for f in dataclasses.fields(sd.PeriodicState)} <= set(state) and state["state"] == found.states[0].state
    assert {f.name for f in dataclasses.fields(sd.Resonance)} >= set(mine(found.to_dict())) - {"left_out", "error_estimate"}
    assert len(found.plot().lines) == 3
    for options, word in [
        ({"frequency_hz": (400, 20)}, "rising"),
        ({"points": 5}, "points need a range"),
        ({"frequency_hz": (20, 40), "points": 1}, "one point"),
        ({"frequency_hz": 20, "points": 0}, "1 to 1000"),
        ({"tolerance": 1.0}, "1e-9 to 1e-3"),
    ]:
        with pytest.raises(ValueError, match=word):
            design.resonance("high-6", **options)  # type: ignore[arg-type]
    with pytest.raises(KeyError, match="did you mean high-6"):
        design.resonance("high-66")
    with pytest.raises(ValueError, match="several scenarios"):
        design.resonance()
    with pytest.raises(ValueError, match="no torsional excitation"):
        sd.size(bore_mm=40, torque_nm=100).design.resonance()


@needs_fork
def test_ctrl_c_leaves_the_amplitudes_that_are_done() -> None:
    code = """
import os, signal, sys, threading
import sprag_design as sd
design = sd.Design.load(sys.argv[1])
threading.Timer(5.0, os.kill, (os.getpid(), signal.SIGINT)).start()
try:
    design.resonance("high-6", frequency_hz=(50, 150), amplitude_nm=(1, 20), points=(10, 1000))
except sd.Interrupted as ended:
    found = ended.found
    print(len(found.states) == 10 * (1000 - found.amplitudes_left) > 0, "stopped" in found.verdict)
"""
    done = python(code, MULTI_ARC)
    assert done.stdout.split() == ["True", "True"], done.stderr


def test_the_sheet_is_that_of_the_command(design: sd.Design, command: Command, tmp_path: Path) -> None:
    theirs, own = tmp_path / "theirs.html", tmp_path / "own.html"
    command("sheet", MULTI_ARC, "--report", theirs, "--quiet")
    sheet = design.sheet()
    assert sheet.save(own) == own and own.read_text() == sheet.html == str(sheet)
    assert "<iframe" in sheet._repr_html_() and "Design sheet" in repr(sheet)
    with pytest.raises(FileExistsError):
        sheet.save(own)
    copy = tmp_path / "copy.toml"
    design.save(copy)
    for write in (sheet.save, lambda path, force: design.export(path, format="dxf", force=force)):
        with pytest.raises(FileExistsError, match="a design file by its name"):
            write(copy, force=True)
    assert copy.read_text() == design.text
    sheet.save(own, force=True)
    assert [p.name for p in tmp_path.iterdir() if p.suffix == ".tmp"] == []

    def same(page: Path) -> str:
        text = re.sub(r'"run_time_s": ?[0-9.e-]+', "", page.read_text())
        return re.sub(r"sprag-design sheet [^<]*?\.html|Python, design\.sheet\(\)", "BY", text)

    assert same(own) == same(theirs)


@pytest.mark.parametrize(
    ("name", "flags", "options"),
    [
        ("sprag.dxf", ["--format", "dxf"], {}),
        ("clutch.step", ["--format", "step", "--part", "clutch"], {"part": "clutch"}),
        ("inner.svg", ["--format", "svg", "--part", "inner"], {"part": "inner"}),
        ("arcs.csv", ["--format", "csv"], {}),
        ("points.csv", ["--format", "csv", "--table", "points", "--deviation-mm", "0.01"], {"table": "points", "deviation_mm": 0.01}),
        ("clutch.inp", ["--format", "calculix", "--torque", "16.8", "--mesh", "0.1"], {"torque_nm": 16.8, "mesh_mm": 0.1}),
    ],
)
def test_an_export_is_that_of_the_command(
    name: str, flags: list[str], options: dict[str, object], command: Command, tmp_path: Path
) -> None:
    starter = DESIGNS / ("huang2017-single-arc.toml" if name.endswith(".inp") else "starter.toml")
    theirs, own = tmp_path / f"theirs-{name}", tmp_path / name
    done = command("export", starter, *flags, "-o", theirs, "--quiet")
    assert done.returncode == 0, done.stderr
    assert sd.Design.load(starter).export(own, **options) == own  # type: ignore[arg-type]
    assert own.read_bytes() == theirs.read_bytes()


def test_an_export_goes_into_a_folder_and_over_nothing(design: sd.Design, tmp_path: Path) -> None:
    starter = sd.Design.load(DESIGNS / "starter.toml")
    path = starter.export(tmp_path, format="dxf", part="clutch")
    assert path == tmp_path / "starter-clutch.dxf" and path.stat().st_size > 1000
    with pytest.raises(FileExistsError, match="force"):
        starter.export(path, part="clutch")
    assert starter.export(path, part="clutch", force=True) == path
    for options, word in [
        ({"format": "pdf"}, "allowed: dxf"),
        ({}, "allowed: dxf"),
        ({"format": "dxf", "part": "cage"}, "allowed: sprag, inner"),
        ({"format": "dxf", "mesh_mm": 1}, "belongs to calculix"),
        ({"format": "csv", "deviation_mm": 0.1}, "belongs to points"),
        ({"format": "csv", "table": "points", "deviation_mm": 1e-9}, "1e-5|0.00001 or more"),
        ({"format": "fmu"}, "library"),
        ({"format": "fmu", "library": MULTI_ARC}, "found no library"),
        ({"format": "calculix", "increments": 7.5}, "whole number"),
        ({"format": "calculix", "torque_nm": 1e6}, "the curve ends"),
    ]:
        with pytest.raises(ValueError, match=word):
            starter.export(tmp_path / "a", **options)  # type: ignore[arg-type]
    with pytest.raises(OSError):
        starter.export(tmp_path / "nowhere" / "a.dxf")
    assert [p.name for p in tmp_path.iterdir()] == ["starter-clutch.dxf"]


def test_tracks_that_are_there_are_kept() -> None:
    found = sd.new("helicopter", bore_mm=18, torque_nm=130, inner_track_mm=28, outer_track_mm=44.7)
    assert (found.design["races.inner_radius_mm"], found.design["races.outer_radius_mm"]) == (14.0, 22.35)


WINDUPS: dict[str, list[float | None]] = {"torque_nm": [10, 16.8, 30, 50], "windup_deg": [1.2345, 1.94, None, 5.1], "k_secant_nm_per_rad": [None, None, 540.0, None]}
UNKNOWN: dict[str, tuple[float, float]] = {"r_i2_mm": (3.6, 4.6), "friction.static": (0.05, 0.2)}


def test_what_is_identified_is_that_of_the_command(design: sd.Design, command: Command, tmp_path: Path) -> None:
    pandas = pytest.importorskip("pandas")
    table, new = tmp_path / "seen.csv", tmp_path / "new.toml"
    pandas.DataFrame(WINDUPS).to_csv(table, index=False)
    words = ",".join(f"{name}:{low}:{high}" for name, (low, high) in UNKNOWN.items())
    said = command("identify", MULTI_ARC, "--data", table, "--unknown", words, "-o", new, "--json", "--quiet")
    found = design.identify(WINDUPS, UNKNOWN)
    theirs = figures(said.stdout)
    assert theirs.pop("written") == str(new) and mine(found.to_dict()) | {"written": str(new)} == theirs | {"written": str(new)}
    assert found.observations is not None and [row.line for row in found.observations] == [2, 3, 4, 5]
    assert found.determined is False and found.unknowns[1].note and "friction.static" in found.verdict
    # The file is the command's but for who asked.
    rest = [line for line in found.design.text.splitlines() if not line.startswith("# by")]
    assert rest == [line for line in new.read_text().splitlines() if not line.startswith("# by")]
    assert found.design.get("sprags.inner_arcs[1].radius_mm") == found.unknowns[0].value
    for data in (table, str(table), pandas.read_csv(table), pandas.read_csv(table).convert_dtypes()):
        assert mine(design.identify(data, UNKNOWN).to_dict()) == mine(found.to_dict())
    assert found.to_pandas().line.tolist() == [2, 3, 4, 5] and pickle.loads(pickle.dumps(found)).verdict == found.verdict
    for data, unknowns, word in [
        ({"torque_nm": [10], "windup_deg": [1, 2]}, UNKNOWN, "different lengths"),
        ({"torque_nm": [10], "windup_de": [1]}, UNKNOWN, "windup_de"),
        (WINDUPS, {"r_i9_mm": (1, 2)}, "r_i9_mm"),
        (WINDUPS, {"r_i2_mm": (4.2, 3.9)}, "not below"),
        (WINDUPS, {"r_i2_mm": 4.2}, "its bounds"),
        (WINDUPS, {"r_i2_mm": (4.0, float("inf"))}, "inf is no finite number"),
    ]:
        with pytest.raises(ValueError, match=word):
            design.identify(data, unknowns)  # type: ignore[arg-type]
    with pytest.raises(FileNotFoundError):
        design.identify(tmp_path / "none.csv", UNKNOWN)


@needs_fork
def test_a_fit_that_is_stopped_leaves_the_best_so_far() -> None:
    code = """
import os, signal, sys, threading
import sprag_design as sd
design = sd.Design.load(sys.argv[1])
threading.Timer(5.0, os.kill, (os.getpid(), signal.SIGINT)).start()
try:
    design.identify({"torque_nm": [10, 50], "windup_deg": [1.2345, 5.1]}, {"r_i2_mm": (3.6, 4.6)}, starts=1000, evaluations=1_000_000)
except sd.Interrupted as ended:
    found = ended.found
    print(found.observations is None, "stopped" in found.verdict, 3.6 <= found.unknowns[0].value <= 4.6)
"""
    done = python(code, MULTI_ARC)
    assert done.stdout.split() == ["True"] * 3, done.stderr
