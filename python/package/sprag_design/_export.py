"""A design written for another program."""

from __future__ import annotations

import os
import warnings
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from . import _core
from ._arguments import positive, whole_or_none
from ._files import write

_FORMATS = {"dxf": ".dxf", "step": ".step", "svg": ".svg", "csv": ".csv", "calculix": ".inp", "fmu": ".fmu"}
"""Formats with the ending of their files."""

_DRAWN = ("dxf", "step", "svg", "csv")

_MEANS = {
    "part": _DRAWN,
    "table": ("csv",),
    "deviation_mm": ("csv",),
    "fmi": ("fmu",),
    "library": ("fmu",),
    "clutch_alone": ("fmu",),
    "variant": ("calculix",),
    "mesh_mm": ("calculix",),
    "torque_nm": ("calculix",),
    "increments": ("calculix",),
    "friction": ("calculix",),
}
"""Options with the formats that they belong to."""


def export(design: _core.Design, path: str | os.PathLike[str], format: str | None, options: Mapping[str, Any], *, force: bool) -> Path:
    target = Path(path)
    if format is None:
        ending = {".stp": ".step"}.get(target.suffix.lower(), target.suffix.lower())
        format = next((name for name, known in _FORMATS.items() if known == ending), None)
    if format not in _FORMATS:
        raise ValueError(f"format {format!r} ({target}): allowed: {', '.join(_FORMATS)}, or a file that ends in one of {', '.join(_FORMATS.values())}")
    for name in options:
        if format not in _MEANS[name]:
            raise ValueError(f"{name} has no meaning with format {format}: it belongs to {', '.join(_MEANS[name])}")
    for name in ("deviation_mm", "mesh_mm", "torque_nm", "friction"):
        if name in options:
            positive(name, options[name])
    part = options.get("part", "sprag")
    if target.is_dir():
        of = f"-{part}" if format in _DRAWN else ""
        target = target / f"{Path(design.file).stem}{of}{_FORMATS[format]}"
    if target.exists() and not force:
        raise FileExistsError(f"{target} is there already: force=True replaces it")
    return write(target, _content(design, format, part, options), force=force)


def _content(design: _core.Design, format: str, part: str, options: Mapping[str, Any]) -> str | bytes:
    if format == "fmu":
        fmi, library = options.get("fmi", 2), options.get("library")
        if fmi not in (2, 3):
            raise ValueError(f"fmi {fmi!r}: allowed: 2, 3")
        if library is None:
            raise ValueError("library: a co-simulation unit needs the library that goes inside, which the wheel has not; fmu/build.sh builds it")
        return _core.unit(design, fmi == 3, library, bool(options.get("clutch_alone")))
    if format == "calculix":
        increments = whole_or_none("increments", options.get("increments"), 1)
        torque_nm, mesh_mm = options.get("torque_nm"), options.get("mesh_mm")
        return _core.deck(design, options.get("variant"), mesh_mm, torque_nm, increments, options.get("friction"))
    kind = format
    if format == "csv":
        kind = options.get("table", "arcs")
        if kind not in ("arcs", "points"):
            raise ValueError(f"table {kind!r}: allowed: arcs, points")
        if "deviation_mm" in options and kind != "points":
            raise ValueError("deviation_mm has no meaning with table arcs: it belongs to points")
    text, note = _core.part(design, kind, part, options.get("deviation_mm"))
    if note is not None:
        warnings.warn(note, stacklevel=4)
    return text
