#!/usr/bin/env python3
"""The half-space reference against tamaas and ContactMechanics, cell for cell.

    python3 -m venv /tmp/peer && /tmp/peer/bin/pip install numpy scipy tamaas ContactMechanics
    /tmp/peer/bin/python reports/check_half_space.py > reports/half-space-peer.md

Run from the project's root. The cases come from `cargo run --release --example half_space_peer`, each with its
grid and gaps; both peers solve the same grid without periodic images. Numbers are relative differences, ours
over theirs minus one; `rows` is the largest difference of a row's force over the largest row force.
"""
import json
import subprocess
import sys

import numpy as np


def cases():
    command = ["cargo", "run", "--release", "--quiet", "--example", "half_space_peer"]
    text = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    return [json.loads(line) for line in text.splitlines()]


def surface(case):
    """Gap over (x, y), m."""
    nx = case["across"]
    x = (np.arange(nx) + 0.5 - nx / 2) * case["patch_width_m"] / nx
    return x[:, None] ** 2 / (2 * case["effective_radius_m"]) + np.array(case["gap_m"])[None, :]


def by_tamaas(case):
    import tamaas as tm

    tm.set_log_level(tm.LogLevel.error)
    gap = surface(case)
    size = [case["patch_width_m"], case["length_m"]]
    model = tm.Model(tm.model_type.basic_2d, size, list(gap.shape))
    # E/(1 - nu^2) of the one deformable body is the contact modulus
    model.E, model.nu = case["contact_modulus_pa"], 0.0
    tm.ModelFactory.registerNonPeriodic(model, "dcfft")
    # heights point towards the other body
    solver = tm.PolonskyKeerRey(model, -gap, 1e-11)
    solver.setIntegralOperator("dcfft")
    solver.max_iter = 4000
    error = solver.solve(case["normal_n"] / (size[0] * size[1]))
    pressure = np.array(model.traction)
    # the model's own displacement has the mean taken off
    sunk = np.zeros_like(pressure)
    model.operators["dcfft"](pressure, sunk)
    return pressure, (sunk + gap)[pressure > 0].mean(), error


def by_contact_mechanics(case):
    from ContactMechanics import FreeFFTElasticHalfSpace
    from ContactMechanics.Optimization import constrained_conjugate_gradients

    gap = surface(case)
    size = (case["patch_width_m"], case["length_m"])
    substrate = FreeFFTElasticHalfSpace(gap.shape, young=case["contact_modulus_pa"], physical_sizes=size)
    scale = case["normal_n"] / gap.size
    # heights point towards the other body; a uniform load to start from, compression negative
    start = np.zeros(substrate.nb_subdomain_grid_pts)
    start[: gap.shape[0], : gap.shape[1]] = -scale
    found = constrained_conjugate_gradients(
        substrate, -gap, external_force=case["normal_n"], initial_forces=start,
        pentol=1e-7 * case["approach_m"], forcetol=1e-8 * scale, thermotol=1e-8, maxiter=20000)
    force = np.abs(np.asarray(found.jac)[: gap.shape[0], : gap.shape[1]])
    if not found.success:
        raise RuntimeError(f"ContactMechanics: {found.message}")
    return force * gap.size / (size[0] * size[1]), float(abs(found.offset)), found.success


def main():
    import tamaas
    import ContactMechanics

    print("# The half-space reference against its peers\n")
    print("Command: `python reports/check_half_space.py > reports/half-space-peer.md`; the script says how to install.")
    print(f"Peers: tamaas {tamaas.__version__}, ContactMechanics {ContactMechanics.__version__}, same grids.\n")
    print("| case | N | cells | peer | approach | peak pressure | middle pressure | rows | peak/p0 |")
    print("|---|---|---|---|---|---|---|---|---|")
    worst = 0.0
    for case in cases():
        ours = np.array(case["pressure_pa"])
        loads = np.array(case["load_n"])
        for peer, solve in (("tamaas", by_tamaas), ("ContactMechanics", by_contact_mechanics)):
            if peer == "ContactMechanics" and case["along"] > 120:
                continue  # minutes
            pressure, approach, _ = solve(case)
            area = case["patch_width_m"] * case["length_m"] / pressure.size
            rows = pressure.sum(axis=0) * area
            peak = pressure.max(axis=0)
            middle = case["along"] // 2
            off = [
                case["approach_m"] / approach - 1,
                ours.max() / peak.max() - 1,
                ours[middle] / peak[middle] - 1 if peak[middle] > 0 else float(ours[middle] > 0),
                np.abs(loads - rows).max() / rows.max(),
            ]
            worst = max(worst, *map(abs, off))
            cells = f"{case['across']} x {case['along']}"
            figures = " | ".join(f"{v:.1e}" for v in off)
            print(f"| {case['name']} | {case['normal_n']:.0f} | {cells} | {peer} | {figures} "
                  f"| {ours.max() / case['hertz_pa']:.4f} |")
    print(f"\nLargest difference: {worst:.1e}.")
    return 0 if worst < 1e-3 else 1


if __name__ == "__main__":
    sys.exit(main())
