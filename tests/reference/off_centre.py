"""Reference for tests/unlike/off_centre.rs: a race that runs out and gives way on its bearings, by other means.

    python3 -m venv /tmp/v && /tmp/v/bin/pip install numpy scipy && /tmp/v/bin/python tests/reference/off_centre.py

Shares no code with the library. The clutch of designs/huang2017-single-arc.toml without springs, its sprags without inertia, one of them
larger, in its scene low-6. Without inertia a sprag that rolls on both races has the place that these and the axis leave it: N and azimuth
by two equations (it has rolled along each race), solved by Newton's method with no table. All forces are then differences of one potential, the
sum of what all sprags have stored at their N, by theta_bi, theta_be and the shift of the axis. scipy's DOP853, rtol 1e-9.
"""

import tomllib
from pathlib import Path

import numpy as np
from numpy.polynomial import chebyshev as cheb
from scipy.integrate import solve_ivp
from scipy.optimize import fsolve

data = tomllib.loads((Path(__file__).parents[2] / "designs/huang2017-single-arc.toml").read_text())
sprags, races = data["sprags"], data["races"]
n = sprags["count"]
E, nu = data["material"]["youngs_modulus_gpa"] * 1e9, data["material"]["poisson_ratio"]
R_id, R_i, R_e, R_ed = (races[k] * 1e-3 for k in (
    "inner_bore_radius_mm", "inner_radius_mm", "outer_radius_mm", "outer_outside_radius_mm"))
width, length = races["width_mm"] * 1e-3, sprags["length_mm"] * 1e-3
r_e, e_1 = sprags["outer_radius_mm"] * 1e-3, sprags["centre_distance_mm"] * 1e-3
r_i, b = sprags["inner_arcs"][0]["radius_mm"] * 1e-3, sprags["width_mm"] * 1e-3
K = data["contact"]["roller_coefficient"]
I_i, I_e = races["inner_inertia_kg_m2"], races["outer_inertia_kg_m2"]
c = races["viscous_damping_nm_s_per_rad"]
scene = next(s for s in data["scenarios"] if s["name"] == "low-6")
amplitude, omega, k_ab = scene["amplitude_nm"], 2 * np.pi * scene["frequency_hz"], scene["abutment_stiffness_nm_per_rad"]

# What the test changes.
DURATION, PRELOAD, OFFSET = 0.001, 10.0, 5e-6
STIFFNESS, MASS = 5e7, 0.5
DAMPING = 2 * 0.02 * np.sqrt(STIFFNESS * MASS)
SIZE = np.zeros(n)
SIZE[3] = 1e-6
AZIMUTH = 2 * np.pi * np.arange(n) / n


def roller(N):
    return K * N**0.9 / (length * 1e3) ** 0.8 * 1e-3


def geometry(N, size, along=0.0, across=0.0):
    """OA, OB, OC_i, OC_e, beta, rotation, T_bi, N_be; the axis of the inner race off along OC_e and across it."""
    body = N * (R_e - R_i) / (E * b * length) - size
    grow_i = n * N / (2 * np.pi * R_i * width) * R_i / E * ((R_i**2 + R_id**2) / (R_i**2 - R_id**2) - nu)
    OA = R_i - grow_i - roller(N) / 2
    OC_i = R_i + r_i - grow_i - body / 2 - roller(N)
    N_e = N
    for _ in range(6):
        grow_e = n * N_e / (2 * np.pi * R_e * width) * R_e / E * ((R_ed**2 + R_e**2) / (R_ed**2 - R_e**2) + nu)
        OB = R_e + grow_e + roller(N_e) / 2
        OC_e = R_e - r_e + grow_e + body / 2 + roller(N_e)
        # From the axis of the inner race to C_e.
        reach = np.hypot(OC_e - along, across)
        beta = 2 * np.arcsin(np.sqrt((e_1**2 - (OC_i - reach) ** 2) / (4 * OC_i * reach))) - np.arctan2(across, OC_e - along)
        # The force at A goes through B.
        ax, ay = along + OA * np.cos(beta), across + OA * np.sin(beta)
        # Force on the sprag: N outward at beta and T back along the track.
        lean = np.arctan2(ay, OB - ax)
        T = N * np.tan(beta + lean)
        N_e = N * np.cos(beta) + T * np.sin(beta)
    C = along + OC_i * np.cos(beta) - OC_e, across + OC_i * np.sin(beta)
    return OA, OB, OC_i, OC_e, beta, np.arctan2(C[1], C[0]), T, N_e


_, _, _, _, beta_0, turned_0, _, _ = geometry(0.0, 0.0)


def rolled(N, size, along, across):
    """Turns of inner and outer race against the line OC_e, rigid bodies."""
    _, _, _, _, beta, rotation, _, _ = geometry(N, size, along, across)
    rotation = rotation - turned_0
    turn = rotation - (beta - beta_0)
    return rotation - turn - r_i * turn / R_i, rotation * r_e / R_e


S = (0.0, 9000.0**0.1)
nodes = 0.5 * (S[0] + S[1]) + 0.5 * (S[1] - S[0]) * np.cos(np.pi * (np.arange(80) + 0.5) / 80)


class Kind:
    """Windup, stored energy and turn of the outer race against the line OC_e of one kind between concentric races, by s = N^0.1."""

    def __init__(self, size):
        fit = lambda v: cheb.Chebyshev.fit(nodes, v, 60, domain=S)
        OA, OB, OC_i, OC_e, beta, rotation, T, _ = geometry(nodes**10, size)
        d = lambda v: fit(v).deriv()(nodes)
        inner = (d(rotation) * (OA - OC_e * np.cos(beta)) - np.sin(beta) * d(OC_e)) / OA
        rate = fit(d(rotation) * (OB - OC_e) / OB - inner)
        self.W = rate.integ(lbnd=0.0)
        self.U = fit(T * OA * rate(nodes)).integ(lbnd=0.0)
        self.B = fit(d(rotation) * (OB - OC_e) / OB).integ(lbnd=0.0)


kinds = {size: Kind(size) for size in set(SIZE)}


def windup(s):
    return np.array([kinds[size].W(v) for size, v in zip(SIZE, s)])


def axis(theta_i, shift):
    """The axis of the inner race: its offset goes with it."""
    return -OFFSET * np.cos(theta_i) + shift[0], -OFFSET * np.sin(theta_i) + shift[1]


def seen(axis_m, phi):
    u = AZIMUTH + phi
    x, y = axis_m
    return x * np.cos(u) + y * np.sin(u), -x * np.sin(u) + y * np.cos(u)


def more(s, axis_m, phi):
    """G_A and G_B, and the outer race's turn between concentric races, exact."""
    N = s**10
    inner, outer = rolled(N, SIZE, *seen(axis_m, phi))
    inner_0, outer_0 = rolled(N, SIZE, 0.0, 0.0)
    return inner_0 - inner, outer - outer_0, np.array([kinds[size].B(v) for size, v in zip(SIZE, s)])


BEGUN = sum(more(np.zeros(n), axis(0.0, (0.0, 0.0)), np.zeros(n))[:2])
OUTER = more(np.zeros(n), axis(0.0, (0.0, 0.0)), np.zeros(n))
OUTER = OUTER[1] + OUTER[2]
last = [np.full(n, 2.0), np.zeros(n), None]


def stored(q, near=False):
    """Energy of all sprags, and s and azimuth of each, where the races and the axis are at q = theta_bi, theta_be, shift; ``near`` the
    last place its slopes are used."""
    axis_m = axis(q[0], q[2:])
    s, phi = last[0].copy(), last[1].copy()

    def miss(s, phi):
        a, b, turned = more(s, axis_m, phi)
        return windup(s) + a + b - BEGUN + q[0] - q[1], phi + turned + b - OUTER - q[1]

    for _ in range(20):
        m = miss(s, phi)
        if not near:
            h = 1e-6
            up, on = miss(s + h, phi), miss(s, phi + h)
            last[2] = [(up[i] - m[i]) / h for i in (0, 1)], [(on[i] - m[i]) / h for i in (0, 1)]
        (a, b), (c, d) = last[2]
        det = a * d - c * b
        ds, dp = (m[0] * d - m[1] * c) / det, (a * m[1] - b * m[0]) / det
        s, phi = s - ds, phi - dp
        if np.max(np.abs(ds)) < 1e-14 and np.max(np.abs(dp)) < 1e-14:
            break
    return sum(kinds[size].U(v) for size, v in zip(SIZE, s)), s, phi


STEPS = (2e-6, 2e-6, 2e-8, 2e-8)


def forces(q):
    """What the sprags do to q: minus the slopes of what they have stored, by differences."""
    _, last[0], last[1] = stored(q)
    out = []
    for i, h in enumerate(STEPS):
        at = lambda k: stored([v + (k * h if i == j else 0.0) for j, v in enumerate(q)], near=True)[0]
        out.append((at(-1) - at(1)) / (2 * h))
    return np.array(out)


def rest():
    def miss(z):
        f = forces([z[0], z[1], z[2] * 1e-6, z[3] * 1e-6])
        return [f[0] - PRELOAD, f[1] - k_ab * z[1], (f[2] - STIFFNESS * z[2] * 1e-6) / 100, (f[3] - STIFFNESS * z[3] * 1e-6) / 100]

    z = fsolve(miss, [-0.022, -PRELOAD / k_ab, 0.0, 0.0], xtol=1e-13)
    return np.array([z[0], z[1], z[2] * 1e-6, z[3] * 1e-6])


def slope(t, y):
    f = forces(y[:4])
    drag = c * (y[4] - y[5])
    return np.concatenate([y[4:], [
        (f[0] - PRELOAD - drag) / I_i,
        (f[1] + amplitude * np.sin(omega * t) + drag - k_ab * y[1]) / I_e,
        (f[2] - STIFFNESS * y[2] - DAMPING * y[6]) / MASS,
        (f[3] - STIFFNESS * y[3] - DAMPING * y[7]) / MASS]])


# What differences leave of forces is 1e-6 N.
ATOL = (1e-11, 1e-11, 1e-14, 1e-14, 1e-7, 1e-7, 1e-9, 1e-9)


def main():
    start = rest()
    ran = solve_ivp(slope, (0.0, DURATION), np.concatenate([start, np.zeros(4)]), "DOP853", rtol=1e-9, atol=ATOL, max_step=1e-4)
    y = ran.y[:, -1]
    _, s, _ = stored(y[:4])
    at = axis(y[0], y[2:4])
    figures = [start[0], start[2], start[3], y[0], y[1], at[0], at[1], s[0] ** 10, s[3] ** 10, s[6] ** 10]
    print("[" + ", ".join("%.9e" % v for v in figures) + "]")


main()
