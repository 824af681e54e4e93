"""Every field of an answer says what it is, in the words of the Rust struct that it comes from."""

from __future__ import annotations

import ast
import importlib.util
from pathlib import Path
from types import ModuleType

import pytest

PYTHON = Path(__file__).resolve().parents[1]


@pytest.fixture(scope="module")
def docstrings() -> ModuleType:
    spec = importlib.util.spec_from_file_location("docstrings", PYTHON / "docstrings.py")
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def fields(source: str) -> dict[str, str | None]:
    """Docstring of each public field of the classes of a module, by CLASS.FIELD."""
    found: dict[str, str | None] = {}
    for kind in ast.parse(source).body:
        if isinstance(kind, ast.ClassDef):
            for field, after in zip(kind.body, [*kind.body[1:], None], strict=True):
                if isinstance(field, ast.AnnAssign) and isinstance(field.target, ast.Name) and field.target.id[0] != "_":
                    told = isinstance(after, ast.Expr) and isinstance(after.value, ast.Constant) and str(after.value.value)
                    found[f"{kind.name}.{field.target.id}"] = told or None
    return found


@pytest.mark.parametrize("module", ["_answers", "_made", "_errors"])
def test_each_field_has_its_docstring(module: str) -> None:
    all_of_them = fields((PYTHON / "package" / "sprag_design" / f"{module}.py").read_text())
    assert len(all_of_them) > {"_answers": 300, "_made": 60, "_errors": 7}[module]
    assert [name for name, told in all_of_them.items() if told is None] == []


def test_docstrings_are_those_of_the_structs(docstrings: ModuleType) -> None:
    for module in docstrings.MODULES:
        assert docstrings.documented(module.read_text()) == module.read_text(), "python python/docstrings.py writes them anew"
    given = docstrings.MODULES[0].read_text()
    # Most fields come of a struct.
    known = {f"{kind}.{field}" for kind, places in docstrings.STRUCTS.items() for p in places for field in docstrings.comments(p)}
    assert len(known & fields(given).keys()) >= 175
    # What is missing or stale is put right, whatever stood there.
    spoilt = given.replace('    """Rotation of the inner race at the end, rad."""\n', "").replace("Windup of the races", "Windup")
    assert spoilt != given and docstrings.documented(spoilt) == given


def test_rust_becomes_python(docstrings: ModuleType) -> None:
    assert docstrings.in_python("Null: see [`Margin`] or `unit`.") == "``None``: see ``Margin`` or ``unit``."
