#!/usr/bin/env python3
"""Hoop stress along the tracks of a clutch by CalculiX: tests/reference/fem_hoop.csv.

    python3 reports/hoop_beside_fem.py WORK      some ten minutes; WORK keeps decks and results

Each deck is that of `sprag-design export --format calculix`, with the stresses of all elements along both tracks printed at the
end. A row: normal force of one sprag, tangential over normal force, how far the element lies behind the middle of the patch (against
the pull of the sprag's force along the track), how deep its middle lies, hoop stress, mean over the element. Within three half
widths of the patch there is none: there the contact's own stresses change within an element.
"""

import csv
import math
import os
import subprocess
import sys
from collections import defaultdict

TOOL = os.environ.get("SPRAG_DESIGN", "target/release/sprag-design")
# Name, design, values set, torque, spacing in mm.
CASES = [
    ("table-1", "designs/huang2017-single-arc.toml", [], 26.8, 0.04),
    ("table-1 thin", "designs/huang2017-single-arc.toml", ["races.outer_outside_radius_mm=22.0"], 20.0, 0.04),
    ("table-1 held", "designs/huang2017-single-arc.toml", ["races.outer_rim=held", "races.inner_rim=held"], 26.8, 0.04),
]
# Three half widths of the wider patch.
NEAR_MM = 0.6
OUT = "tests/reference/fem_hoop.csv"


def with_prints(deck):
    """The deck with stresses of the tracks and rims printed in its last step, and those elements by their set."""
    points, elements, block, mode = {}, defaultdict(dict), None, None
    for line in deck.splitlines():
        if line.startswith("*"):
            mode = line.split(",")[0]
            block = line.split("ELSET=E")[-1] if mode == "*ELEMENT" else None
        elif mode == "*NODE":
            number, x, y, _ = line.split(",")
            points[int(number)] = (float(x), float(y))
        elif mode == "*ELEMENT" and block in ("INNER", "OUTER"):
            number, *corners = map(int, line.split(","))
            elements[block][number] = corners
    sets = {}
    for block, of in elements.items():
        radius = {e: sorted(math.hypot(*points[n]) for n in c) for e, c in of.items()}
        low, high = min(r[0] for r in radius.values()), max(r[-1] for r in radius.values())
        sets[f"H{block}LOW"] = [e for e, r in radius.items() if r[0] < low + 1e-6]
        sets[f"H{block}HIGH"] = [e for e, r in radius.items() if r[-1] > high - 1e-6]
    middles = {e: [sum(points[n][i] for n in c) / 8 for i in (0, 1)] for of in elements.values() for e, c in of.items()}
    lines = "".join(f"*ELSET, ELSET={name}\n" + "".join(f"{e}\n" for e in of) for name, of in sets.items())
    prints = "".join(f"*EL PRINT, ELSET={name}, FREQUENCY=1000\nS\n" for name in sets)
    head, step = deck.rsplit("*STEP, NLGEOM", 1)
    first, rest = head.split("** Step 1:", 1)
    return first + lines + "** Step 1:" + rest + "*STEP, NLGEOM" + step.replace("*END STEP", prints + "*END STEP"), sets, middles


def run(work, name, design, values, torque, mesh):
    job = os.path.join(work, name.replace(" ", "-"))
    sets = [word for value in values + ["contact.law=elastic", "contact.stress_state=plane-stress"] for word in ("--set", value)]
    subprocess.run(
        [TOOL, "export", design, "--format", "calculix", "--variant", "plane-stress", "--torque", str(torque), "--mesh", str(mesh),
         "--quiet", "--force", "-o", f"{job}.plain.inp", *sets], check=True)
    deck, sets_of, middles = with_prints(open(f"{job}.plain.inp").read())
    if not os.path.exists(f"{job}.dat") or open(f"{job}.inp").read() != deck:
        open(f"{job}.inp", "w").write(deck)
        environment = {"OMP_NUM_THREADS": "1", **os.environ}
        subprocess.run(["nice", "-n", "5", "ccx", "-i", os.path.basename(job)], cwd=work, env=environment, check=True,
                       stdout=open(f"{job}.log", "w"))
    dat = open(f"{job}.dat").read()
    subprocess.run([TOOL, "export", design, "--format", "calculix", "--read", f"{job}.dat", "--csv", f"{job}.csv", "--force", "--quiet",
                    *sets], check=True, stdout=subprocess.DEVNULL)
    last = list(csv.DictReader(open(f"{job}.csv")))[-1]
    start = next(float(line.split("=")[1]) for line in deck.splitlines() if "start_rad = " in line)
    half = 0.5 * (math.radians(float(last["windup_deg"])) - start)
    return stresses(dat, sets_of, middles, half), contacts(dat), last


def stresses(dat, sets, middles, half):
    """Of every set (azimuth, radius, hoop stress) of its elements; the rings have turned by `half` either way."""
    found, mode = defaultdict(lambda: defaultdict(list)), None
    for line in dat.splitlines():
        if " time " in line:
            mode = next((s for s in sets if s in line), None)
        elif mode and line.strip():
            e, _, sxx, syy, _, sxy, *_ = line.split()
            found[mode][int(e)].append([float(sxx), float(syy), float(sxy)])
    out = {}
    for name, of in found.items():
        rows = []
        for e, points in of.items():
            sxx, syy, sxy = (sum(p[i] for p in points) / len(points) for i in range(3))
            r = math.hypot(*middles[e])
            azimuth = math.atan2(*middles[e]) + (half if "OUTER" in name else -half)
            tx, ty = math.cos(azimuth), -math.sin(azimuth)
            rows.append((azimuth, r, sxx * tx * tx + syy * ty * ty + 2 * sxy * tx * ty))
        out[name] = sorted(rows)
    return out


def contacts(dat):
    """Azimuths of the middles of the inner and the outer patch in the last increment."""
    at, mode, seen = {}, None, 0
    for line in dat.splitlines():
        if "statistics for slave set" in line:
            mode, seen = ("inner" if "SSPRAGIN" in line else "outer"), 0
        elif mode and line.split() and line.split()[0].lstrip("-").replace(".", "", 1)[:1].isdigit():
            seen += 1
            if seen == 2:
                x, y, *_ = map(float, line.split())
                at[mode] = math.atan2(x, y)
                mode = None
    return at


def main():
    work = sys.argv[1]
    os.makedirs(work, exist_ok=True)
    with open(OUT, "w") as out:
        table = csv.writer(out, lineterminator="\n")
        table.writerow(["case", "race", "bore_mm", "outside_mm", "rim", "normal_n", "tan", "behind_mm", "deep_mm", "hoop_mpa"])
        for name, design, values, torque, mesh in CASES:
            found, patch, last = run(work, name, design, values, torque, mesh)
            at = {"inner": (7.21, 11.11), "outer": (19.44, 22.0 if "thin" in name else 26.23)}
            normal, tan = float(last["normal_inner_n"]), float(last["tan_omega"])
            for race, (bore, outside) in at.items():
                track, behind = (outside, -1) if race == "inner" else (bore, 1)
                # The moment of the sprag is none: T falls with the radius.
                along = tan * at["inner"][1] / track
                for azimuth, radius, hoop in found["HINNERHIGH" if race == "inner" else "HOUTERLOW"]:
                    x = behind * track * (azimuth - patch[race])
                    if abs(x) > NEAR_MM:
                        rim = "held" if "held" in name else "turning as one"
                        table.writerow([name, race, bore, outside, rim, f"{normal:.1f}", f"{along:.5f}", f"{x:.3f}",
                                        f"{abs(radius - track):.4f}", f"{hoop:.1f}"])


if __name__ == "__main__":
    main()
