#!/usr/bin/env python3
"""Audit DXF drawings with ezdxf, and draw them: every file must load and have no finding.

    python3 -m venv /tmp/cad && /tmp/cad/bin/pip install ezdxf matplotlib
    /tmp/cad/bin/python tests/cad/audit.py sprag.dxf clutch.dxf [--png FOLDER]

Prints findings, units, layers, and the area and length of every closed outline, which `sprag-design` prints too.
Exit code 0: no finding.
"""

import argparse
import math
import sys
from pathlib import Path

import ezdxf
from ezdxf import units
from ezdxf.math import bulge_to_arc


def area_mm2(polyline):
    """Area of a closed polyline: its polygon and the segments of circle behind its bulges."""
    points = [(v.dxf.location.x, v.dxf.location.y, v.dxf.bulge) for v in polyline.vertices]
    area = 0.0
    for (x0, y0, bulge), (x1, y1, _) in zip(points, points[1:] + points[:1]):
        area += 0.5 * (x0 * y1 - x1 * y0)
        if bulge:
            _, _, _, radius = bulge_to_arc((x0, y0), (x1, y1), bulge)
            angle = 4.0 * math.atan(bulge)
            area += 0.5 * radius**2 * (angle - math.sin(angle))
    return area


def audit(path, png):
    document = ezdxf.readfile(path)
    auditor = document.audit()
    findings = [f"{e.code}: {e.message}" for e in auditor.errors + auditor.fixes]
    space = document.modelspace()
    print(f"{path}: {document.dxfversion}, {units.decode(document.units)}, {len(findings)} findings")
    for finding in findings:
        print("  ", finding)
    layers = {}
    for entity in space:
        layers.setdefault(entity.dxf.layer, []).append(entity.dxftype())
    for layer, kinds in layers.items():
        print("  ", layer, ", ".join(f"{kinds.count(k)} {k}" for k in sorted(set(kinds))))
    outlines = [e for e in space if e.dxftype() == "POLYLINE"]
    if outlines:
        areas = [area_mm2(e) for e in outlines]
        closed = all(e.is_closed for e in outlines)
        print(f"   {len(outlines)} outlines, closed: {closed}, area {min(areas):.9f} to {max(areas):.9f} mm2")
        if not closed:
            findings.append("an outline is open")
    known = set(document.layers.entries) | {l.dxf.name for l in document.layers}
    missing = [l for l in layers if l not in known and l.lower() not in {k.lower() for k in known}]
    if missing:
        findings.append(f"layers without an entry: {missing}")
    if png:
        from ezdxf.addons.drawing import Frontend, RenderContext, config, matplotlib as backend
        import matplotlib.pyplot as plt

        figure = plt.figure(figsize=(14, 14))
        axes = figure.add_axes([0, 0, 1, 1])
        colours = config.Configuration(background_policy=config.BackgroundPolicy.WHITE)
        Frontend(RenderContext(document), backend.MatplotlibBackend(axes), config=colours).draw_layout(space)
        figure.savefig(Path(png) / (Path(path).stem + ".png"), dpi=90)
        plt.close(figure)
    return not findings


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", nargs="+", metavar="FILE.dxf")
    parser.add_argument("--png", metavar="FOLDER", help="draw each file into this folder")
    arguments = parser.parse_args()
    return 0 if all([audit(path, arguments.png) for path in arguments.files]) else 1


if __name__ == "__main__":
    sys.exit(main())
