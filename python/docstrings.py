"""Docstrings of the answers' fields from the comments of the Rust structs that they come from.

    python python/docstrings.py            writes them into those of package/sprag_design
    python python/docstrings.py --check    ends with 1 where they are not those of the structs

A field whose key no struct has (an answer that is put together key by key) keeps its own docstring.
"""

from __future__ import annotations

import ast
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
PACKAGE = ROOT / "python" / "package" / "sprag_design"
MODULES = [PACKAGE / "_answers.py", PACKAGE / "_made.py", PACKAGE / "_identified.py"]
WIDTH = 128

STRUCTS = {
    "LeftOut": ["answer/left_out.rs LeftOut"],
    "_Common": ["answer/envelope.rs Envelope"],
    "Margin": ["answer/check/body.rs CheckRow"],
    "Deciding": ["answer/check/body.rs Deciding"],
    "Capacity": ["answer/check/body.rs Capacity"],
    "End": ["answer/stiffness/body.rs CurveEnd"],
    "OverrunPoint": ["answer/check/overrun.rs OverrunRow"],
    "Overrun": ["answer/check/overrun.rs OverrunSection"],
    "Check": ["answer/check/body.rs CheckBody"],
    "Junction": ["answer/stiffness/junctions.rs Junction"],
    "Curve": ["answer/stiffness/body.rs CurvePoint", "answer/stiffness/body.rs CurveBody"],
    "SlipHeat": ["answer/simulation/body.rs SlipHeat"],
    "WorstSlip": ["answer/simulation/body.rs WorstSlip"],
    "Slip": ["answer/simulation/body.rs Slip"],
    "Slips": ["answer/simulation/body.rs Slips"],
    "Simulation": ["answer/simulation/body.rs SimulationBody"],
    "FoundMargin": ["answer/search/body.rs SearchRow"],
    "Found": ["answer/search/body.rs Found"],
    "Bound": ["answer/search/steps.rs Bound"],
    "CodeMargin": ["answer/search/realised.rs CodeMargin"],
    "Steps": ["answer/search/steps.rs Steps"],
    "Optimum": ["answer/search/body.rs SearchBody"],
    "Progress": ["answer/search/so_far.rs SearchSoFar"],
    "Taken": ["answer/sizing.rs Taken"],
    "FirstDesign": ["answer/sizing.rs SizingBody"],
    "ComparedDesign": ["answer/comparison/body.rs ComparedDesign"],
    "ComparedInput": ["answer/comparison/body.rs ComparedInput"],
    "ComparedFigure": ["answer/comparison/body.rs ComparedFigure"],
    "ComparedMargin": ["answer/comparison/body.rs ComparedMargin"],
    "ComparedScene": ["answer/comparison/body.rs ComparedScene"],
    "Comparison": ["answer/comparison/body.rs ComparisonBody"],
    "Identification": ["answer/identification/body.rs IdentificationBody"],
    "Resonance": ["answer/resonance/body.rs ResonanceBody"],
}
"""Class of Python: file and struct of Rust."""

KEYS = {"passed": "pass", "beyond_end_nm": "beyond_end", "origin": "from"}
"""Fields whose name in Rust is another."""


def comments(place: str) -> dict[str, str]:
    """The comment of each public field of a struct."""
    file, name = place.split()
    text = (ROOT / "src" / file).read_text(encoding="utf-8")
    found = re.search(rf"^pub(?:\([a-z]+\))? struct {name}\b[^{{;]*\{{\n(.*?)^\}}", text, re.S | re.M)
    if found is None:
        raise SystemExit(f"src/{file}: no struct {name}")
    fields: dict[str, str] = {}
    told: list[str] = []
    for line in found[1].splitlines():
        line = line.strip()
        if line.startswith("///"):
            told.append(line[3:].strip())
        elif field := re.match(r"pub (?:r#)?(\w+):", line):
            fields[field[1]] = in_python(" ".join(told))
            told = []
        elif not line.startswith("#["):
            told = []
    return fields


def in_python(text: str) -> str:
    """A comment as a docstring: what is JSON's null is None."""
    text = re.sub(r"\[(`[^`]+`)\]", r"\1", text)
    text = re.sub(r"\b[Nn]ull\b", "`None`", text)
    return re.sub(r"`([^`]+)`", r"``\1``", text)


def wrapped(text: str) -> list[str]:
    """The docstring as lines of a class body."""
    lines, line = [], '    """'
    for word in text.split():
        glue = "" if line.endswith('"""') or not line.strip() else " "
        if len(line + glue + word) + 3 > WIDTH:
            lines.append(line)
            line, glue = "    ", ""
        line += glue + word
    return [*lines, line + '"""']


def documented(source: str) -> str:
    """The module with the docstrings of its fields as the structs have them."""
    lines = source.splitlines()
    changes: list[tuple[int, int, list[str]]] = []
    for kind in ast.parse(source).body:
        if not isinstance(kind, ast.ClassDef) or kind.name not in STRUCTS:
            continue
        known: dict[str, str] = {}
        for place in STRUCTS[kind.name]:
            known = comments(place) | known
        following = [*kind.body[1:], None]
        for field, after in zip(kind.body, following, strict=True):
            if not isinstance(field, ast.AnnAssign) or not isinstance(field.target, ast.Name):
                continue
            name = field.target.id
            text = known.get(KEYS.get(name, name))
            if not text:
                continue
            if name in KEYS:
                text = f"{text.removesuffix('.')}; ``{KEYS[name]}`` in JSON."
            begin = end = field.end_lineno or 0
            if isinstance(after, ast.Expr) and isinstance(after.value, ast.Constant):
                end = after.end_lineno or 0
            changes.append((begin, end, wrapped(text)))
    for begin, end, text_lines in sorted(changes, reverse=True):
        lines[begin:end] = text_lines
    return "\n".join(lines) + "\n"


def main() -> int:
    stale = 0
    for module in MODULES:
        given = module.read_text(encoding="utf-8")
        wanted = documented(given)
        if "--check" in sys.argv[1:]:
            stale |= given != wanted
        else:
            module.write_text(wanted, encoding="utf-8")
    return stale


if __name__ == "__main__":
    sys.exit(main())
