#!/usr/bin/env python3
"""Read STEP solids with OpenCASCADE and hold them against the design: valid, volume, centre, moments of inertia to 1e-6.

    python3 -m venv /tmp/cad && /tmp/cad/bin/pip install cadquery-ocp      # 1.1 GB, so not in CI
    /tmp/cad/bin/python tests/cad/step.py path/to/sprag-design designs/starter.toml [more designs]

For every design the parts sprag, inner, outer and clutch are exported and read back. What is expected follows from the
table of arcs (`--format csv`), by Green's theorem here, and from the design's own JSON; nothing of the STEP writer is used.
Exit code 0: all within 1e-6.
"""

import csv
import io
import json
import math
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy

from OCP.BRepCheck import BRepCheck_Analyzer
from OCP.BRepGProp import BRepGProp
from OCP.GProp import GProp_GProps
from OCP.IFSelect import IFSelect_RetDone
from OCP.STEPControl import STEPControl_Reader
from OCP.TopAbs import TopAbs_FACE, TopAbs_SOLID
from OCP.TopExp import TopExp_Explorer
from OCP.BRepAdaptor import BRepAdaptor_Surface
from OCP.TopoDS import TopoDS

WITHIN = 1e-6


def run(tool, *arguments):
    done = subprocess.run([tool, "export", *arguments], capture_output=True, text=True)
    if done.returncode != 0:
        raise SystemExit(f"{arguments}: {done.stderr}")
    return done.stdout


def plane_moments(rows):
    """Area, first moments and second moments about the origin of the loops in a table of arcs, each counterclockwise.

    Integrals of 1, x, y, x2, y2 by Green's theorem, Gauss-Legendre with 40 points on every arc: exact to rounding.
    """
    nodes, weights = numpy.polynomial.legendre.leggauss(40)
    sums = numpy.zeros(5)
    for row in rows:
        if row["kind"] == "line":
            p, q = (numpy.array([float(row[f"{e}_x_mm"]), float(row[f"{e}_y_mm"])]) for e in ("start", "end"))
            t = 0.5 * (nodes + 1)
            x, y = (p[i] + (q[i] - p[i]) * t for i in (0, 1))
            dx, dy = ((q[i] - p[i]) * 0.5 * weights for i in (0, 1))
        else:
            a, b = (math.radians(float(row[k])) for k in ("start_deg", "end_deg"))
            r = float(row["radius_mm"])
            angle = a + (b - a) * 0.5 * (nodes + 1)
            x = float(row["centre_x_mm"]) + r * numpy.cos(angle)
            y = float(row["centre_y_mm"]) + r * numpy.sin(angle)
            step = (b - a) * 0.5 * weights * r
            dx, dy = -numpy.sin(angle) * step, numpy.cos(angle) * step
        sums += [
            (0.5 * (x * dy - y * dx)).sum(),
            (0.5 * x * x * dy).sum(),
            (-0.5 * y * y * dx).sum(),
            (x**3 / 3 * dy).sum(),
            (-(y**3) / 3 * dx).sum(),
        ]
    return sums


def expected(tool, design, part, lengths):
    """Integrals over the volume, z from the middle: 1 (mm3), x, y (mm4), x2, y2, z2 (mm5)."""
    rows = list(csv.DictReader(io.StringIO(run(tool, design, "--format", "csv", "--part", part))))
    whole = 0.0
    for body in dict.fromkeys(r["body"] for r in rows):
        of_body = [r for r in rows if r["body"] == body]
        sums = plane_moments([r for r in of_body if r["surface"] not in holes(body)])
        sums = sums - plane_moments([r for r in of_body if r["surface"] in holes(body)])
        length = lengths["sprag" if body.startswith("sprag") else "race"]
        whole = whole + length * numpy.array([*sums, sums[0] * length**2 / 12])
    return whole


def holes(body):
    return {"inner race": ["bore"], "outer race": ["track"]}.get(body, [])


def read(path):
    reader = STEPControl_Reader()
    if reader.ReadFile(str(path)) != IFSelect_RetDone:
        raise SystemExit(f"{path}: not read")
    reader.TransferRoots()
    return reader.OneShape()


def count(shape, kind):
    explorer, found = TopExp_Explorer(shape, kind), []
    while explorer.More():
        found.append(explorer.Current())
        explorer.Next()
    return found


def check(tool, design, folder):
    import tomllib

    text = tomllib.loads(Path(design).read_text())
    lengths = {"sprag": text["sprags"]["length_mm"], "race": text["races"]["width_mm"]}
    good = True
    for part in ("sprag", "inner", "outer", "clutch"):
        path = Path(folder) / f"{Path(design).stem}-{part}.step"
        run(tool, design, "--format", "step", "--part", part, "-o", str(path), "--force", "--quiet")
        shape = read(path)
        properties = GProp_GProps()
        BRepGProp.VolumeProperties_s(shape, properties, 1e-12)
        volume = properties.Mass()
        matrix, centre = properties.MatrixOfInertia(), properties.CentreOfMass()
        want = expected(tool, design, part, lengths)
        x, y = want[1:3] / want[0]
        # About the centre: the moments about x, y and z.
        about = want[3:] - want[0] * numpy.array([x * x, y * y, 0.0])
        moments = about.sum() - about
        size = math.sqrt(moments[2] / want[0])
        solids = count(shape, TopAbs_SOLID)
        kinds = {}
        for face in count(shape, TopAbs_FACE):
            kind = BRepAdaptor_Surface(TopoDS.Face(face)).GetType().name.removeprefix("GeomAbs_")
            kinds[kind] = kinds.get(kind, 0) + 1
        valid = BRepCheck_Analyzer(shape).IsValid()
        off = (
            abs(volume / want[0] - 1),
            math.hypot(centre.X() - x, centre.Y() - y) / size,
            max(abs(matrix.Value(k + 1, k + 1) / moments[k] - 1) for k in range(3)),
        )
        wanted = {"sprag": 1, "inner": 1, "outer": 1, "clutch": 2 + text["sprags"]["count"]}[part]
        fine = valid and max(off) < WITHIN and len(solids) == wanted and set(kinds) <= {"Plane", "Cylinder"}
        good &= fine
        print(
            f"{path.name}: {'valid' if valid else 'NOT VALID'}, {len(solids)} solids, {kinds}, "
            f"volume {volume:.6f} mm3 ({off[0]:.1e} off), centre {off[1]:.1e} of the radius of gyration off, "
            f"moments of inertia {', '.join(f'{m:.5f}' for m in moments)} mm5 ({off[2]:.1e} off)"
            f"{'' if fine else '  FAILED'}"
        )
        if part == "sprag":
            ours = json.loads(run(tool, design, "--format", "csv", "--json", "--quiet"))
            given = ours["mass_over_given"]
            print(f"   mass drawn over mass given: {'follows from the outline' if given is None else given}")
    return good


def main():
    if len(sys.argv) < 3:
        raise SystemExit(__doc__)
    tool, *designs = sys.argv[1:]
    with tempfile.TemporaryDirectory() as folder:
        return 0 if all([check(tool, design, folder) for design in designs]) else 1


if __name__ == "__main__":
    sys.exit(main())
