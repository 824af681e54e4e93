"""Reference for tests/service/carried.rs: the clutch of designs/lift-off-inner.toml, dry, from overrun until the outer race catches up.

    python3 tests/reference/carried.py

Shares no code and no formula with the library: as in driven_cage.py the sprag is a body in Cartesian coordinates, here with its forces of
inertia; it, the cage and the inner race are one linear system for the force of the inner race or of the stop, that of the outer race, the
push of the cage and the acceleration. Both races move by Runge and Kutta's fourth-order rule in short steps until they are equally fast.
"""

import csv
from math import exp, hypot, pi
from pathlib import Path

from driven_cage import A, B, G, K_r, P, R_e, bisect, count, drag_nm, forward, inner, mass, out, settle, stop_at, turned, wrench

inertia, inner_race, outer_race, damping = 4.4e-7, 0.0204, 0.05, 0.05
stiffness, reversing = 1000.0, 20.0
static, kinetic, decay = 0.11, 0.09, 5.0


def linear(m):
    n = len(m)
    for i in range(n):
        k = max(range(i, n), key=lambda r: abs(m[r][i]))
        m[i], m[k] = m[k], m[i]
        for r in range(n):
            if r != i:
                f = m[r][i] / m[i][i]
                m[r] = [x - f * y for x, y in zip(m[r], m[i])]
    return [m[i][n] / m[i][i] for i in range(n)]


def sprag(omega, mu, torque, spring, tilt, on_inner):
    """Force of the inner race or of the stop, N_B, acceleration of the cage."""
    g, p = turned(G, tilt), turned(P, tilt)
    first = inner if on_inner else wrench(p, tuple(-o for o in out(p)))
    second = wrench(B, tuple(-o - mu * f for o, f in zip(out(B), forward(B))))
    push = wrench(p, forward(p))
    slow = wrench(g, tuple(-mass * hypot(*g) * f for f in forward(g)))
    slow[2] -= inertia
    spin = wrench(g, tuple(mass * omega**2 * x for x in g))
    closing = spring + K_r * tilt
    rows = [[first[i], second[i], push[i], slow[i], -spin[i] - (closing if i == 2 else 0.0)] for i in range(3)]
    # The spring reacts on the cage, and the cage is the inner race.
    rows.append([0.0, 0.0, -count * push[2], -inner_race, count * closing - torque])
    x, n_b, _, w = linear(rows)
    return x, n_b, w


def ride(omega, mu, torque, spring, stop):
    """N_A, N_B, acceleration."""
    x, n_b, w = sprag(omega, mu, torque, spring, stop, False)
    if n_b <= 0.0:
        # Off, and held open: a body of the cage.
        return 0.0, 0.0, torque / (inner_race + count * (inertia + mass * hypot(*turned(G, stop)) ** 2))
    n_a, at_n_a, at_w = sprag(omega, mu, torque, spring, 0.0, True)
    if n_a >= 0.0:
        return n_a, at_n_a, at_w
    if x < 0.0:
        tilt = bisect(lambda t: sprag(omega, mu, torque, spring, t, False)[0], 0.0, stop)
        _, n_b, w = sprag(omega, mu, torque, spring, tilt, False)
    return 0.0, n_b, w


def ridden(y, spring, stop):
    _, _, omega_i, omega_e, _ = y
    mu = kinetic + (static - kinetic) * exp(-decay * abs(R_e * (omega_i - omega_e)))
    drag = damping * (omega_i - omega_e)
    return mu, drag, *ride(omega_i, mu, -reversing - drag, spring, stop)


def slope(y, spring, stop, on):
    _, turned_e, omega_i, omega_e, _ = y
    mu, drag, _, n_b, w = ridden(y, spring, stop)
    at_outer = drag - stiffness * turned_e + count * mu * n_b * R_e
    return [omega_i, omega_e, w, at_outer / outer_race, R_e * (omega_i - omega_e) if on else 0.0]


def step(y, h, spring, stop, on):
    k1 = slope(y, spring, stop, on)
    k2 = slope([a + 0.5 * h * b for a, b in zip(y, k1)], spring, stop, on)
    k3 = slope([a + 0.5 * h * b for a, b in zip(y, k2)], spring, stop, on)
    k4 = slope([a + h * b for a, b in zip(y, k3)], spring, stop, on)
    return [a + h / 6.0 * (p + 2.0 * q + 2.0 * r + s) for a, p, q, r, s in zip(y, k1, k2, k3, k4)]


def meet(free_rpm, spring, stop):
    """Time, state and first N_B; the last of the state is the path of B, which sprags that are off do not slide."""
    y, t, h = [0.0, 0.0, free_rpm * pi / 30, 0.0, 0.0], 0.0, 2e-5
    pressed = lambda z: ridden(z, spring, stop)[3] > 0.0
    n_b, on = ridden(y, spring, stop)[3], pressed(y)
    while True:
        after = step(y, h, spring, stop, on)
        if after[2] <= after[3]:
            rest = bisect(lambda x: (lambda z: z[2] - z[3])(step(y, x, spring, stop, on)), 0.0, h)
            return t + rest, step(y, rest, spring, stop, on), n_b
        part = h
        if pressed(after) != on:
            part = bisect(lambda x: 1.0 if pressed(step(y, x, spring, stop, on)) == on else -1.0, 0.0, h)
            after, on = step(y, part, spring, stop, on), not on
        y, t = after, t + part


if __name__ == "__main__":
    wanted = drag_nm / (count * 0.1 * R_e)
    spring = bisect(lambda m: wanted - settle(0.0, m, 0.0, True)[1], 1e-6, 10.0)
    with open(Path(__file__).parent / "carried.csv", "w", newline="") as to:
        table = csv.writer(to, lineterminator="\n")
        table.writerow(["clearance_um", "free_run_rpm", "normal_outer_n", "meet_s", "inner_rad", "outer_rad", "rad_s", "slid_m"])
        for clearance_um, rpm in ((0, 300), (0, 800), (0, 1200), (5, 600), (20, 1500)):
            stop = stop_at(1e-6 * clearance_um) if clearance_um else 0.0
            t, y, n_b = meet(rpm, spring, stop)
            table.writerow([clearance_um, rpm] + [f"{x:.9g}" for x in (n_b, t, y[0], y[1], y[2], y[4])])
