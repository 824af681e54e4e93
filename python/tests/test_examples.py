"""README and examples run as they are."""

from __future__ import annotations

import re
import runpy
import subprocess
import sys
from pathlib import Path

import pytest

from .conftest import MULTI_ARC, ROOT

PYTHON = Path(__file__).resolve().parents[1]


def test_the_readme_runs(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    pytest.importorskip("matplotlib").use("Agg")
    pytest.importorskip("pandas")
    # It names designs as seen from the project's folder, and writes beside them.
    (tmp_path / "designs").symlink_to(ROOT / "designs")
    monkeypatch.chdir(tmp_path)
    blocks = re.findall(r"```python\n(.*?)```", (PYTHON / "README.md").read_text(), re.S)
    assert len(blocks) >= 3
    names: dict[str, object] = {}
    for block in blocks:
        exec(compile(block, "README.md", "exec"), names)


@pytest.mark.parametrize(("example", "needs"), [("with_scipy", "scipy"), ("with_optuna", "optuna"), ("with_openmdao", "openmdao")])
def test_an_example_finds_a_better_design(example: str, needs: str, tmp_path: Path) -> None:
    pytest.importorskip(needs)
    words = [sys.executable, str(PYTHON / "examples" / f"{example}.py"), str(MULTI_ARC), "--quick"]
    done = subprocess.run(words, capture_output=True, text=True, timeout=600, cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    found = re.search(r"least objective (\S+) -> (\S+)", done.stdout)
    assert found and float(found[2]) > float(found[1]), done.stdout


def test_the_module_is_the_command(capfd: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "argv", ["sprag_design", "materials"])
    with pytest.raises(SystemExit) as ended:
        runpy.run_module("sprag_design", run_name="__main__")
    assert ended.value.code == 0 and capfd.readouterr().out


def test_the_notebook_runs_and_holds_no_outputs() -> None:
    nbformat = pytest.importorskip("nbformat")
    nbclient = pytest.importorskip("nbclient")
    pytest.importorskip("ipykernel")
    pytest.importorskip("matplotlib")
    pytest.importorskip("pandas")
    folder = PYTHON / "examples"
    notebook = nbformat.read(folder / "first_steps.ipynb", as_version=4)
    nbformat.validate(notebook)
    cells = [cell for cell in notebook.cells if cell.cell_type == "code"]
    assert all(cell.outputs == [] and cell.execution_count is None for cell in cells)
    # The kernel is this very Python: a kernel of another name would be another installation.
    kernel = nbclient.NotebookClient(notebook, timeout=300, kernel_name="python3", resources={"metadata": {"path": folder}})
    kernel.execute()
    shown = [set().union(*(output.get("data", {}) for output in cell.outputs)) for cell in cells]
    assert not any(output.output_type == "error" for cell in cells for output in cell.outputs)
    # Design, check, table, drawing, plot, design, tables, plot: each cell shows what it is there for.
    wanted = ["text/html", "text/html", "text/html", "image/svg+xml", "image/png", "text/html", "text/html", "image/png", "text/plain"]
    assert [kind in kinds for kind, kinds in zip(wanted, shown, strict=True)] == [True] * len(wanted), shown
    said = "".join(output.get("text", "") for cell in cells for output in cell.outputs)
    assert "held" in said and "smallest normal force" in said
