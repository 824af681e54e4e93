#!/usr/bin/env python3
"""A deck of several sprags of which one is larger, from the deck of one sector, and the forces of each sprag from its result: what
`reports/validate_sharing.sh` holds `sprag-design sharing` against. Needs numpy.

  sharing_deck.py DECK.inp DESIGN.toml SPRAGS SIZE_UM OVERLAP_UM OUT.inp
  sharing_deck.py --read OUT.inp OUT.dat

DECK.inp is `export --format calculix --variant layer` of a design of one inner arc and of bodies of one steel. SPRAGS sectors, each turned on by its angle, hang
together where they are cut; the last is cyclic with the first. The first sprag measures SIZE_UM more across its contacts: its arcs are
parallel curves, half of it at each. All sprags are rolled as rigid bodies to where one as drawn has OVERLAP_UM at either contact (a
cage holds them at one angle), which is the windup 2 overlap/(tan omega R_i). The overlap takes hold in step 1, the races turn in step 2.

--read prints, for every increment of step 2, torque of the clutch and normal force at A of each sprag: torque from the moments of the
contact forces, N of one sprag from its force and the moment at the radius of its patch.
"""
import re
import sys
import tomllib

import numpy as np


def turned(points, angle):
    """Towards positive azimuth, from +y to +x."""
    c, s = np.cos(angle), np.sin(angle)
    return np.column_stack([points[:, 0] * c + points[:, 1] * s, -points[:, 0] * s + points[:, 1] * c])


def circle(points):
    """Centre and radius of the circle through points on an arc, by least squares."""
    a = np.column_stack([2 * points, np.ones(len(points))])
    x = np.linalg.lstsq(a, (points**2).sum(axis=1), rcond=None)[0]
    return x[:2]


def sections(text):
    """Keyword lines with the data lines below them, comments left out."""
    out = []
    for line in text.splitlines():
        if line.startswith("**"):
            continue
        if line.startswith("*"):
            out.append((line, []))
        else:
            out[-1][1].append(line)
    return out


def rolled(design, overlap):
    """Angle of the line C_e C_i against that from O to C_e, and OC_e, mm, of a sprag with that overlap at either contact."""
    s, r = design["sprags"], design["races"]
    oc_i = r["inner_radius_mm"] + s["inner_arcs"][0]["radius_mm"] - overlap
    oc_e = r["outer_radius_mm"] - s["outer_radius_mm"] + overlap
    beta = np.arccos((oc_i**2 + oc_e**2 - s["centre_distance_mm"] ** 2) / (2 * oc_i * oc_e))
    return np.arctan2(oc_i * np.sin(beta), oc_i * np.cos(beta) - oc_e), oc_e


def larger(points, ni, nj, size):
    """The block with its lower and its upper surface moved out along their normals by half of `size`."""
    grid = points.reshape(-1, nj, ni, 2)
    out = grid.copy()
    low, high = grid[0, 0], grid[0, -1]
    moved = []
    for surface in (low, high):
        # The flanks' ends lie on the arc too.
        away = surface - circle(surface)
        moved.append(0.5 * size * away / np.linalg.norm(away, axis=1)[:, None])
    height = np.linalg.norm(grid - low, axis=3) / np.linalg.norm(high - low, axis=1)
    out += moved[0] * (1 - height)[..., None] + moved[1] * height[..., None]
    return out.reshape(-1, 2)


def make(deck, design, count, size, overlap):
    facts = dict(re.findall(r"\*\* sprag-design (\w+) = (.*)", deck))
    sector = 2 * np.pi / float(facts["count"])
    parts = sections(deck)
    nodes, first = {}, {}
    for name, data in parts:
        if name.startswith("*NODE, NSET=N"):
            nodes[name[13:]] = np.array([[float(v) for v in row.split(",")] for row in data])
    elements = {n[n.index("ELSET=") + 6 :]: [[int(v) for v in row.split(",")] for row in d] for n, d in parts if n.startswith("*ELEMENT, TYPE=C3D8I")}
    per = int(max(block[:, 0].max() for name, block in nodes.items() if name != "CONTROL"))
    most = max(e[0] for block in elements.values() for e in block) + 8
    control = int(nodes["CONTROL"][0, 0])
    assert control == per + 1
    # Where the exporter has placed the sprag, and where it shall stand.
    s = elements["ESPRAG"][0]
    ni = s[3] - s[2]
    body = nodes["SPRAG"]
    nj = len(body) // (2 * ni)
    (angle0, oc0), (angle1, oc1) = rolled(design, 4e-4), rolled(design, overlap)
    stand = lambda p: turned(p - [0, oc0], angle1 - angle0) + [0, oc1]
    out = [f"** {count} sprags of a clutch, the first {1e3 * size:g} um larger; made by tests/reference/sharing_deck.py"]
    out += [f"** sprag-design {k} = {v}" for k, v in facts.items()] + [f"** sharing sprags = {count}"]
    node = lambda n, j: n + j * per if n <= per else n - per + count * per
    for name, block in nodes.items():
        if name == "CONTROL":
            continue
        out.append(f"*NODE, NSET=N{name}")
        for j in range(count):
            p = block[:, 1:3]
            if name == "SPRAG":
                p = stand(larger(p, ni, nj, size) if j == 0 else p)
            for row, q in zip(block, turned(p, j * sector)):
                out.append(f"{node(int(row[0]), j)},{q[0]:.12e},{q[1]:.12e},{row[3]:.9e}")
    out.append("*NODE, NSET=NCONTROL")
    out += [f"{node(control + i, 0)},0.,0.,0." for i in (0, 1)]
    for name, block in elements.items():
        out.append(f"*ELEMENT, TYPE=C3D8I, ELSET={name}")
        out += [f"{e[0] + j * most}," + ",".join(str(node(n, j)) for n in e[1:]) for j in range(count) for e in block]
    equations = 0
    for name, data in parts:
        if name.startswith(("*MATERIAL", "*ELASTIC", "*SOLID", "*SURFACE INTERACTION", "*SURFACE BEHAVIOR", "*FRICTION")):
            out += [name] + data
        elif name.startswith("*SURFACE, NAME="):
            label = name[15:].split(",")[0]
            for j in range(count):
                out.append(f"*SURFACE, NAME={label}{j}, TYPE=ELEMENT")
                out += [f"{int(e) + j * most},{f}" for e, f in (row.split(",") for row in data)]
        elif name.startswith("*ELEMENT, TYPE=SPRING1"):
            out.append(name)
            out += [f"{int(e) + j * most},{node(int(n), j)}" for j in range(count) for e, n in (row.split(",") for row in data)]
        elif name.startswith("*SPRING"):
            out += [name] + data
        elif name.startswith("*CONTACT PAIR"):
            for j in range(count):
                out += [name] + [",".join(f"{s.strip()}{j}" for s in row.split(",")) for row in data]
        elif name.startswith("*EQUATION"):
            equations += 1
            out.append(name)
            terms = [row.split(",") for row in data[1::2]]
            terms = [[(int(t[i]), int(t[i + 1]), float(t[i + 2])) for i in range(0, len(t), 3)] for t in terms]
            out += equation(terms, equations, count, sector, node, control)
        elif name.startswith("*BOUNDARY"):
            # Held along the axis: a node of every sector; in a step: the controls, which all share.
            sectors = count if data[0].endswith(",3,3") else 1
            held = [row.split(",", 1) for row in data]
            out += [name] + [f"{node(int(n), j)},{rest}" for j in range(sectors) for n, rest in held]
        elif name.startswith("*CONTACT PRINT"):
            for j in range(count):
                out += [re.sub(r"(SLAVE=\w+|MASTER=\w+)", rf"\g<1>{j}", name)] + data
        elif name.startswith(("*STEP", "*STATIC", "*CONTROLS", "*NODE PRINT", "*END")):
            out += [name] + data
    return "\n".join(out) + "\n"


def equation(terms, which, count, sector, node, control):
    """`which`: 1, faces of a layer alike; 2, 4, cut faces; 3, 5, driven circles."""
    out = []
    write = lambda ts: out.extend([str(len(ts)), ",".join(f"{n},{d},{c:.12f}" for n, d, c in ts)])
    for j in range(count):
        for ts in terms:
            if which == 1:
                write([(node(n, j), d, c) for n, d, c in ts])
            elif which in (2, 4):
                slave, dof, _ = ts[0]
                master = ts[1][0]
                if j + 1 < count:
                    write([(node(slave, j), dof, 1), (node(master, j + 1), dof, -1)])
                elif dof == 3:
                    write([(node(slave, j), 3, 1), (node(master, 0), 3, -1)])
                else:
                    c, s = np.cos(count * sector), np.sin(count * sector)
                    row = [(1, -c), (2, -s)] if dof == 1 else [(1, s), (2, -c)]
                    write([(node(slave, j), dof, 1)] + [(node(master, 0), d, v) for d, v in row])
            else:
                vector = np.zeros(2)
                for n, d, c in ts[:2]:
                    vector[d - 1] = c
                x, y = turned(vector[None, :], j * sector)[0]
                n = node(ts[0][0], j)
                own = sorted([(n, 1, x), (n, 2, y)], key=lambda t: -abs(t[2]))
                write(own + [(node(ts[2][0], 0), 1, -1)])
    return out


def read(deck, dat):
    facts = dict(re.findall(r"\*\* (?:sprag-design|sharing) (\w+) = (.*)", deck))
    count, whole, factor = int(facts["sprags"]), float(facts["count"]), float(facts["axial_factor"])
    found = {}
    lines = dat.splitlines()
    for at, line in enumerate(lines):
        head = re.search(r"statistics for slave set SSPRAGIN(\d+), .* time\s+(\S+)", line)
        if not head or float(head[2]) <= 1:
            continue
        rows = []
        for text in lines[at + 1 : at + 18]:
            try:
                values = [float(v) for v in text.split()]
            except ValueError:
                continue
            if values:
                rows.append(values)
        force, centre = rows[0], rows[1]
        tangential = force[5] / np.hypot(centre[0], centre[1])
        normal = np.sqrt(force[0] ** 2 + force[1] ** 2 - tangential**2)
        found.setdefault(float(head[2]), {})[int(head[1])] = (factor * normal, factor * force[5])
    for time, sprags in sorted(found.items()):
        if len(sprags) == count:
            torque = 1e-3 * whole / count * sum(s[1] for s in sprags.values())
            yield torque, [sprags[j][0] for j in range(count)]


if __name__ == "__main__":
    if sys.argv[1] == "--read":
        rows = list(read(open(sys.argv[2]).read(), open(sys.argv[3]).read()))
        print("torque_nm," + ",".join(f"normal_{j + 1}_n" for j in range(len(rows[0][1]))))
        for torque, normals in rows:
            print(f"{torque:.5f}," + ",".join(f"{n:.3f}" for n in normals))
    else:
        text = make(open(sys.argv[1]).read(), tomllib.load(open(sys.argv[2], "rb")), int(sys.argv[3]), 1e-3 * float(sys.argv[4]), 1e-3 * float(sys.argv[5]))
        open(sys.argv[6], "w").write(text)
