"""Reference for tests/service/worn_outside.rs: a sprag of designs/lift-off-inner.toml that has worn a flat into its outer arc.

    python3 tests/reference/worn_outside.py

Shares no code and no formula with the library: the sprag as points in Cartesian coordinates, turned about where it rolls until it overlaps
the outer track by the depth of the flat; the lens that both share by integration over the arc; the edge of the flat where both circles
cross; the strut from there to the inner contact; forces as vectors on their lines, dry, mu 0.1, on the flat and with the spring relaxed by
what the sprag has turned against the line to its centroid.
"""

import csv
from math import acos, asin, atan2, cos, hypot, pi, sin, sqrt
from pathlib import Path

R_i, R_e, r_e, r_i, e, length = 35e-3, 50e-3, 8.6e-3, 7.6e-3, 1.25e-3, 18e-3
count, mass, drag_nm, mu, K_r = 18, 0.0195, 0.6, 0.1, 0.05
centroid, pivot = (1.55e-3, 0.70e-3), (0.15e-3, -0.50e-3)


def bisect(f, low, high):
    for _ in range(200):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if f(middle) > 0 else (low, middle)
    return 0.5 * (low + high)


def turn(v, angle):
    """Clockwise, in which azimuths count."""
    return v[0] * cos(angle) + v[1] * sin(angle), -v[0] * sin(angle) + v[1] * cos(angle)


def drawn():
    """C_1 from C_e in the drawn sprag, C_e on y above the axis."""
    x = bisect(lambda x: hypot(x, R_e - r_e + sqrt(e * e - x * x)) - (R_i + r_i), 0.0, e)
    return x, sqrt(e * e - x * x)


C_1 = drawn()


class Pose:
    """The sprag so turned that it touches inside and its outer arc overlaps the track by `depth`: C_e stays on y."""

    def __init__(self, depth):
        self.c_e = (0.0, R_e - r_e + depth)
        self.angle = bisect(lambda a: R_i + r_i - hypot(*self.at(C_1, a)), 0.2, 0.0)
        self.c_1, self.g, self.p = [self.at(v, self.angle) for v in (C_1, centroid, pivot)]
        # It turns by what it turns against the line to its centroid.
        first = atan2(centroid[0], R_e - r_e + centroid[1])
        self.turned = self.angle - (atan2(*self.g) - first)

    def at(self, v, angle):
        x, y = turn(v, angle)
        return self.c_e[0] + x, self.c_e[1] + y


def lens(pose):
    """Volume of sprag beyond the track."""
    d = pose.c_e[1]
    half = acos((R_e**2 - r_e**2 - d**2) / (2 * r_e * d))
    n, area = 4000, 0.0
    for i in range(n):
        a = -half + 2 * half * (i + 0.5) / n
        x, y = r_e * sin(a), d + r_e * cos(a)
        # Out along the arc's normal from the track to the arc, strips 2 half r_e/n wide.
        inside = sqrt(R_e**2 - (d * sin(a)) ** 2) - d * cos(a)
        area += (r_e**2 - inside**2) / 2 * (2 * half / n)
        assert hypot(x, y) > R_e - 1e-12
    return area * length


def edge(pose):
    """Where arc and track cross behind B, tan omega of the strut to A, and how far normals of track and arc are apart there."""
    d = pose.c_e[1]
    half = acos((R_e**2 - r_e**2 - d**2) / (2 * r_e * d))
    x, y = -r_e * sin(half), d + r_e * cos(half)
    a = tuple(R_i * v / hypot(*pose.c_1) for v in pose.c_1)
    out = tuple(v / R_i for v in a)
    strut = x - a[0], y - a[1]
    along = strut[0] * out[0] + strut[1] * out[1]
    across = abs(strut[0] * out[1] - strut[1] * out[0])
    return across / along, half - asin(-x / R_e)


def wrench(where, force):
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


def unit(v):
    return v[0] / hypot(*v), v[1] / hypot(*v)


def forces(pose, omega, spring, inside):
    """N_A or the force of the stop, N_B, the force that drives."""
    a, b = tuple(R_i * v for v in unit(pose.c_1)), (0.0, R_e)
    o = unit(pose.c_1 if inside else pose.p)
    first = wrench(a, o) if inside else wrench(pose.p, (-o[0], -o[1]))
    outer = wrench(b, (-mu, -1.0))
    f = unit(pose.p)
    drive = wrench(pose.p, (f[1], -f[0]))
    spin = wrench(pose.g, tuple(mass * omega**2 * v for v in pose.g))
    return solve([first, outer, drive], [-spin[0], -spin[1], -spin[2] - spring])


class Opened(Pose):
    """A pose tilted open about C_e until its pivot is `stop` from the axis."""

    def __init__(self, pose, stop):
        self.c_e = pose.c_e
        self.tilt = bisect(lambda t: stop - hypot(*self.at(pivot, pose.angle - t)), 0.0, 1.0)
        self.angle = pose.angle - self.tilt
        self.c_1, self.g, self.p = [self.at(v, self.angle) for v in (C_1, centroid, pivot)]


if __name__ == "__main__":
    sharp = Pose(0.0)
    wanted = drag_nm / (count * mu * R_e)
    spring = bisect(lambda m: wanted - forces(sharp, 0.0, m, True)[1], 1e-6, 10.0)
    stop = hypot(*sharp.p) + 20e-6
    with open(Path(__file__).parent / "worn_outside.csv", "w", newline="") as to:
        table = csv.writer(to, lineterminator="\n")
        table.writerow(
            "flat_um,volume_mm3,turned_rad,pivot_out_um,first_tan_omega,edge_turn_rad,normal_inner_n,normal_outer_n,lift_off_rpm".split(",")
        )
        for flat_um in (0.5, 2.0, 5.0, 10.0, 20.0):
            pose = Pose(1e-6 * flat_um)
            tan, turns = edge(pose)
            left = spring - K_r * pose.turned
            n_a, n_b, _ = forces(pose, 200 * pi / 30, left, True)
            opened = Opened(pose, stop)
            off = bisect(lambda w: forces(opened, w, left + K_r * opened.tilt, False)[1], 1.0, 1e4)
            out = hypot(*pose.p) - hypot(*sharp.p)
            row = flat_um, 1e9 * lens(pose), pose.turned, 1e6 * out, tan, turns, n_a, n_b, off * 30 / pi
            table.writerow([f"{x:.9g}" for x in row])
