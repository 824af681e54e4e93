"""Reference for tests/service/driven_cage.rs: a sprag of designs/lift-off-inner.toml, dry, mu 0.1, in a cage that the inner race drives.

    python3 tests/reference/driven_cage.py

Shares no code and no formula with the library: points of the sprag in Cartesian coordinates, each force a vector on its line, one linear
system for their sizes. The pivot may go outward by a clearance. The sprag is solved on the inner race, then on its stop, tilted open about
the centre of its outer arc; where in both of them something would have to pull it stands in between, at the tilt, found by bisection, at
which the stop bears nothing. Lift-off is where the outer race would have to pull, by bisection.
"""

import csv
from math import cos, hypot, pi, sin, sqrt
from pathlib import Path

R_i, R_e, r_e, r_i, e = 35e-3, 50e-3, 8.6e-3, 7.6e-3, 1.25e-3
count, mass, drag_nm, mu, K_r = 18, 0.0195, 0.6, 0.1, 0.05
centroid, pivot = (1.55e-3, 0.70e-3), (0.15e-3, -0.50e-3)

# x to the right, y up, C_e on y; positive azimuth is clockwise. C_1 ahead of C_e by the triangle of the three distances.
oc_e, oc_1 = R_e - r_e, R_i + r_i
up = (oc_1**2 - e**2 + oc_e**2) / (2 * oc_e)
C_e, C_1 = (0.0, oc_e), (sqrt(oc_1**2 - up**2), up)
G, P = [(x, oc_e + y) for x, y in (centroid, pivot)]


def out(v):
    return v[0] / hypot(*v), v[1] / hypot(*v)


def forward(v):
    u = out(v)
    return u[1], -u[0]


def wrench(where, force):
    """Force along x and y and clockwise moment about the axis of the clutch."""
    return [*force, force[0] * where[1] - force[1] * where[0]]


def solve(columns, right):
    m = [[c[i] for c in columns] + [right[i]] for i in range(3)]
    for i in range(3):
        k = max(range(i, 3), key=lambda r: abs(m[r][i]))
        m[i], m[k] = m[k], m[i]
        for r in range(3):
            if r != i:
                m[r] = [x - m[r][i] / m[i][i] * y for x, y in zip(m[r], m[i])]
    return [m[i][3] / m[i][i] for i in range(3)]


A, B = tuple(R_i * x for x in out(C_1)), tuple(R_e * x for x in out(C_e))
inner = wrench(A, out(A))
# The outer race presses inward and drags back.
outer = wrench(B, tuple(-o - mu * f for o, f in zip(out(B), forward(B))))


def turned(point, tilt):
    """Open is counterclockwise, about C_e."""
    x, y = point[0], point[1] - oc_e
    return x * cos(tilt) - y * sin(tilt), oc_e + x * sin(tilt) + y * cos(tilt)


def settle(omega, spring, tilt, on_inner):
    """N_A or the force of the stop, N_B, the force that drives."""
    g, p = turned(G, tilt), turned(P, tilt)
    spin = wrench(g, tuple(mass * omega**2 * x for x in g))
    first = inner if on_inner else wrench(p, tuple(-o for o in out(p)))
    more = K_r * tilt
    return solve([first, outer, wrench(p, forward(p))], [-spin[0], -spin[1], -spin[2] - spring - more])


def bisect(f, low, high):
    for _ in range(200):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if f(middle) > 0 else (low, middle)
    return 0.5 * (low + high)


def stop_at(clearance):
    return bisect(lambda t: hypot(*P) + clearance - hypot(*turned(P, t)), 0.0, 1.0)


def normals(omega, spring, stop):
    n_a, n_b, _ = settle(omega, spring, 0.0, True)
    if n_a >= 0:
        return n_a, n_b
    r, n_b, _ = settle(omega, spring, stop, False)
    if r >= 0:
        return 0.0, n_b
    # The stop pulls at first contact's tilt less than 0, at its own more: between them it bears nothing.
    tilt = bisect(lambda t: settle(omega, spring, t, False)[0], 0.0, stop)
    return 0.0, settle(omega, spring, tilt, False)[1]


if __name__ == "__main__":
    wanted = drag_nm / (count * mu * R_e)
    spring = bisect(lambda m: wanted - settle(0.0, m, 0.0, True)[1], 1e-6, 10.0)
    with open(Path(__file__).parent / "driven_cage.csv", "w", newline="") as to:
        table = csv.writer(to, lineterminator="\n")
        table.writerow(["clearance_um", "lift_off_rpm", "speed_rpm", "normal_inner_n", "normal_outer_n", "drag_torque_nm"])
        for clearance_um in (0, 5, 20):
            stop = stop_at(1e-6 * clearance_um) if clearance_um else 0.0
            lift = bisect(lambda w: settle(w, spring, stop, False)[1], 1.0, 1e4)
            for part in (0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.99, 0.9999):
                n_a, n_b = normals(part * lift, spring, stop)
                row = clearance_um, lift * 30 / pi, part * lift * 30 / pi, n_a, n_b, count * mu * n_b * R_e
                table.writerow([f"{x:.9g}" for x in row])
    print(f"moment of the spring {spring:.9g} N m")
