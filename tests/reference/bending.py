"""Reference for tests/unlike/bending.rs: three unlike sprags between races that bend, by other means.

    python3 -m venv /tmp/v && /tmp/v/bin/pip install numpy scipy && /tmp/v/bin/python tests/reference/bending.py

Shares no code with the library. The clutch of designs/huang2017-single-arc.toml without springs, nine of its twelve sprags missing, one of
the others larger, its sprags without inertia, in its scene low-6. Of N_j each race gives way at i as a plane ring (Michell's stress
function, harmonics from 2 on, the half-plane's part in closed form) with the forces along the track that equilibrium asks for at every
instant, less what the law of twelve even sprags has of it. Where the tracks have receded each sprag is closed anew by its triangle and
rolls as rigid bodies do (no approach that stands for both, no linear step). The torque is the slope of what sprags and races have stored
over the windup. scipy's DOP853, rtol 1e-10.
"""

import tomllib
from pathlib import Path

import numpy as np
from numpy.polynomial import chebyshev as cheb
from scipy.integrate import solve_ivp
from scipy.optimize import brentq, fsolve

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
DURATION, PRELOAD = 0.004, 10.0
PLACES = np.array([0, 3, 8])
SIZE = np.array([0.0, 2e-6, 0.0])
AZIMUTH = 2 * np.pi * PLACES / n


def response(m, track, other):
    """Track's radial (as cos) and tangential (as sin) displacement under sigma_rr = cos m theta, then sigma_rt = sin m theta on it; the
    other rim free. Unit: of the track's radius over E."""
    kappa, mu = (3 - nu) / (1 + nu), 1 / (2 * (1 + nu))
    powers = np.array([m, m + 2, -m, 2 - m], float)
    x = other / track

    def stresses(r):
        # Columns scaled by what they are at the other rim where they grow there.
        scale = np.maximum(1.0, x ** (powers - 2)) if x > 0 else np.ones(4)
        radial = (powers - m * m) * r ** (powers - 2)
        shear = m * (powers - 1) * r ** (powers - 2)
        return np.array([radial, shear]) / scale, scale

    at_track, scale = stresses(1.0)
    at_rim, _ = stresses(x)
    lift = np.array([-m, kappa - m - 1, m, kappa + m - 1]) / scale
    drift = np.array([m, kappa + m + 1, m, -(kappa - m + 1)]) / scale
    system = np.vstack([at_track, at_rim])
    out = []
    for load in ([1, 0, 0, 0], [0, 1, 0, 0]):
        a = np.linalg.solve(system, np.array(load, float))
        out.append((lift @ a / (2 * mu), drift @ a / (2 * mu)))
    return out


def influence(track, other):
    """G(angle): recede and along, by normal force and force along, m/N."""
    sign = 1.0 if other > track else -1.0
    harmonics = range(2, 400)
    table = []
    for m in harmonics:
        (pr, pt), (sr, st) = response(m, track, other)
        # sigma_rr = -p; outside of the inner race sigma_rt = q, bore of the outer race sigma_rt = -q.
        table.append((-sign * pr, -pt, -sign * sign * sr, -sign * st))
    table = np.array(table)
    unit = 1 / (np.pi * width * E)
    m = np.arange(2, 400)
    # What they tend to: 2/m and (1 - nu)/m.
    limit = np.array([2 / m, -(1 - nu) / m, -(1 - nu) / m, 2 / m]).T
    signs = np.sign(table[-1] * limit[-1])
    rest = table - limit * signs
    if other > track:
        mean = (1 / (2 * np.pi * width * E)) * ((other**2 + track**2) / (other**2 - track**2) + nu)
    else:
        mean = (1 / (2 * np.pi * width * E)) * ((track**2 + other**2) / (track**2 - other**2) - nu)

    def at(angle):
        angle = angle % (2 * np.pi)
        cos, sin = np.cos(m * angle), np.sin(m * angle)
        log = -np.log(2 * np.sin(angle / 2)) - np.cos(angle)
        saw = (np.pi - angle) / 2 - np.sin(angle)
        # Pressure cos: (cos, sin). Shear cos = sin(m theta + pi/2): (-sin, cos).
        nn = rest[:, 0] @ cos + signs[0] * 2 * log
        tn = rest[:, 1] @ sin - signs[1] * (1 - nu) * saw
        nt = -(rest[:, 2] @ sin - signs[2] * (1 - nu) * saw)
        tt = rest[:, 3] @ cos + signs[3] * 2 * log
        return unit * np.array([[nn, nt], [tn, tt]]) + np.array([[mean, 0], [0, 0]])

    return at


def matrix(track, other):
    g = influence(track, other)
    law = -sum(g(2 * np.pi * k / n) for k in range(1, n))
    return np.array([[law if i == j else g(AZIMUTH[i] - AZIMUTH[j]) for j in range(3)] for i in range(3)])


INNER, OUTER = matrix(R_i, R_id), matrix(R_e, R_ed)


def roller(N):
    return K * N**0.9 / (length * 1e3) ** 0.8 * 1e-3


def geometry(N, size, inner=0.0, outer=0.0):
    """OA, OB, OC_i, OC_e, beta, rotation, T_bi, N_be, T_be where the tracks have receded by so much more."""
    body = N * (R_e - R_i) / (E * b * length) - size
    grow_i = n * N / (2 * np.pi * R_i * width) * R_i / E * ((R_i**2 + R_id**2) / (R_i**2 - R_id**2) - nu) + inner
    N_e = N
    for _ in range(30):
        grow_e = n * N_e / (2 * np.pi * R_e * width) * R_e / E * ((R_ed**2 + R_e**2) / (R_ed**2 - R_e**2) + nu) + outer
        OA = R_i - grow_i - roller(N) / 2
        OB = R_e + grow_e + roller(N_e) / 2
        OC_i = R_i + r_i - grow_i - body / 2 - roller(N)
        OC_e = R_e - r_e + grow_e + body / 2 + roller(N_e)
        beta = 2 * np.arcsin(np.sqrt((e_1**2 - (OC_i - OC_e) ** 2) / (4 * OC_i * OC_e)))
        at_a = np.arctan2(OB * np.sin(beta), OB * np.cos(beta) - OA)
        N_e = N * np.cos(at_a - beta) / np.cos(at_a)
    rotation = np.arctan2(OC_i * np.sin(beta), OC_i * np.cos(beta) - OC_e)
    return OA, OB, OC_i, OC_e, beta, rotation, N * np.tan(at_a), N_e, N_e * np.tan(at_a - beta)


_, _, _, _, beta_0, turned_0, *_ = geometry(0.0, 0.0)


def rolled(N, size, inner, outer):
    """How far the races have turned against one another, rigid bodies."""
    _, _, _, _, beta, rotation, *_ = geometry(N, size, inner, outer)
    rotation = rotation - turned_0
    turn = rotation - (beta - beta_0)
    return rotation * r_e / R_e - (rotation - turn - r_i * turn / R_i)


S = (0.0, 9000.0**0.1)
nodes = 0.5 * (S[0] + S[1]) + 0.5 * (S[1] - S[0]) * np.cos(np.pi * (np.arange(80) + 0.5) / 80)


class Kind:
    """Windup and stored energy of one kind on its own curve, by s = N^0.1."""

    def __init__(self, size):
        fit = lambda v: cheb.Chebyshev.fit(nodes, v, 60, domain=S)
        OA, OB, OC_i, OC_e, beta, rotation, T, *_ = geometry(nodes**10, size)
        d = lambda v: fit(v).deriv()(nodes)
        inner = (d(rotation) * (OA - OC_e * np.cos(beta)) - np.sin(beta) * d(OC_e)) / OA
        rate = fit(d(rotation) * (OB - OC_e) / OB - inner)
        self.W = rate.integ(lbnd=0.0)
        self.U = fit(T * OA * rate(nodes)).integ(lbnd=0.0)


kinds = [Kind(size) for size in SIZE]
last = np.full(3, 2.3)


def given_way(s):
    """What both tracks recede, and give along as a windup; what the races have stored beside the law."""
    N = s**10
    forces = np.array([geometry(v, size) for v, size in zip(N, SIZE)])
    inner = np.array([N, forces[:, 6]]).T
    outer = np.array([forces[:, 7], -forces[:, 8]]).T
    moved_i, moved_e = np.einsum("ijab,jb->ia", INNER, inner), np.einsum("ijab,jb->ia", OUTER, outer)
    stored = 0.5 * (np.sum(inner * moved_i) + np.sum(outer * moved_e))
    return moved_i[:, 0], moved_e[:, 0], moved_e[:, 1] / R_e - moved_i[:, 1] / R_i, stored


def carried(w):
    """s of each at windup w."""
    def miss(s):
        inner, outer, along, _ = given_way(s)
        own = np.array([k.W(v) for k, v in zip(kinds, s)])
        more = np.array([rolled(v**10, size, i, o) - rolled(v**10, size, 0.0, 0.0)
                         for v, size, i, o in zip(s, SIZE, inner, outer)])
        return own + more - w - along

    global last
    found, _, ok, why = fsolve(miss, last, xtol=1e-13, full_output=True)
    assert np.max(np.abs(miss(found))) < 1e-12, why
    last = found
    return found


def stored(w):
    s = carried(w)
    return sum(k.U(v) for k, v in zip(kinds, s)) + given_way(s)[3]


# The torque over the windup, once.
FROM, UNTIL = 0.02, 0.12
places = 0.5 * (FROM + UNTIL) + 0.5 * (UNTIL - FROM) * np.cos(np.pi * (np.arange(50) + 0.5) / 50)
ENERGY = cheb.Chebyshev.fit(places, [stored(w) for w in places], 40, domain=(FROM, UNTIL))
torque = ENERGY.deriv()


def slope(t, y):
    drag, C = c * (y[2] - y[3]), torque(y[1] - y[0])
    return [y[2], y[3], (C - PRELOAD - drag) / I_i, (-C + amplitude * np.sin(omega * t) + drag - k_ab * y[1]) / I_e]


def main():
    outer = -PRELOAD / k_ab
    w = brentq(lambda w: torque(w) - PRELOAD, FROM, UNTIL, xtol=1e-15)
    ran = solve_ivp(slope, (0.0, DURATION), [outer - w, outer, 0.0, 0.0], "DOP853", rtol=1e-10, atol=1e-13, max_step=1e-4)
    y = ran.y[:, -1]
    first, end = carried(w) ** 10, carried(y[1] - y[0]) ** 10
    round_s = np.array([brentq(lambda s: k.W(s) - w, 1.0, S[1]) for k in kinds]) ** 10
    # What the slope of the stored energy differs by from the forces: of the order u/OA.
    s = carried(w)
    inner, outer_m, _, _ = given_way(s)
    direct = 0.0
    for v, size, i, o in zip(s, SIZE, inner, outer_m):
        g = geometry(v**10, size, i, o)
        direct += g[6] * g[0]
    print("torque of the forces %.6f of %.6f Nm; u %s %s um; shares %s, round %s" % (
        direct, PRELOAD, inner * 1e6, outer_m * 1e6, first / first.mean(), round_s / round_s.mean()))
    print("[" + ", ".join("%.9e" % v for v in [outer - w, *first, y[0], y[1], *end]) + "]")


main()
