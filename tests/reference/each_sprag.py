"""Reference for tests/unlike/each_sprag.rs: two unlike kinds of sprags in one scene by other means.

    python3 -m venv /tmp/v && /tmp/v/bin/pip install numpy scipy && /tmp/v/bin/python tests/reference/each_sprag.py

Shares no code with the library. The clutch of designs/huang2017-single-arc.toml, eleven sprags as drawn and one that is larger and
smoother, in its scene low-10 with another friction law. Statics of section 2 of Huang, Liu and Zhao (2017), each kind with its own size,
as polynomials of N^0.1. Motion: all accelerations and contact forces of all kinds (alpha'', phi'', T_bi, T_be of each, theta_bi'',
theta_be'') in one linear system, the equations of `Model::forces` unreduced; scipy's DOP853 (rtol 1e-12), every change of a grip
by its root finder. B is checked to hold throughout. Prints the figures that the test quotes.
"""

import tomllib
from pathlib import Path

import numpy as np
from numpy.polynomial import chebyshev as cheb
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

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
mass, inertia = sprags["mass_kg"], sprags["inertia_kg_m2"]
g_x, g_y = sprags["centroid"]["x_mm"] * 1e-3, sprags["centroid"]["y_mm"] * 1e-3
k_r, drag = data["spring"]["stiffness_nm_per_rad"], data["spring"]["drag_torque_nm"]
scene = next(s for s in data["scenarios"] if s["name"] == "low-10")
preload, amplitude = scene["preload_nm"], scene["amplitude_nm"]
omega, k_ab = 2 * np.pi * scene["frequency_hz"], scene["abutment_stiffness_nm_per_rad"]

# What the test changes: the friction law, the length of the scene, and sprag 5.
STATIC, KINETIC, DECAY = 0.12, 0.1195, 5.0
DURATION = 0.025
SIZE, SMOOTH = 4e-6, 0.0812


def roller(N):
    return K * N**0.9 / (length * 1e3) ** 0.8 * 1e-3


def geometry(N, size):
    """OA, OB, OC_i, OC_e, beta, T_bi, N_be of a sprag that measures `size` more."""
    body = N * (R_e - R_i) / (E * b * length) - size
    grow_i = n * N / (2 * np.pi * R_i * width) * R_i / E * ((R_i**2 + R_id**2) / (R_i**2 - R_id**2) - nu)
    N_e = N
    for _ in range(60):
        grow_e = n * N_e / (2 * np.pi * R_e * width) * R_e / E * ((R_ed**2 + R_e**2) / (R_ed**2 - R_e**2) + nu)
        OA = R_i - grow_i - roller(N) / 2
        OB = R_e + grow_e + roller(N_e) / 2
        OC_i = R_i + r_i - grow_i - body / 2 - roller(N)
        OC_e = R_e - r_e + grow_e + body / 2 + roller(N_e)
        beta = 2 * np.arcsin(np.sqrt((e_1**2 - (OC_i - OC_e) ** 2) / (4 * OC_i * OC_e)))
        at_a = np.arctan2(OB * np.sin(beta), OB * np.cos(beta) - OA)
        N_e = N * np.cos(at_a - beta) / np.cos(at_a)
    return OA, OB, OC_i, OC_e, beta, N * np.tan(at_a), N_e


def turned(OC_i, OC_e, beta):
    """Azimuth of C_i from C_e in the frame of OC_e."""
    return np.arctan2(OC_i * np.sin(beta), OC_i * np.cos(beta) - OC_e)


_, _, at_first_i, at_first_e, beta_0, _, _ = geometry(0.0, 0.0)
turned_0 = turned(at_first_i, at_first_e, beta_0)


def centroid(OC_e, rotation):
    x, y = np.cos(rotation) * g_x + np.sin(rotation) * g_y, -np.sin(rotation) * g_x + np.cos(rotation) * g_y + OC_e
    return np.hypot(x, y), -np.arctan2(x, y)


gamma_0 = centroid(at_first_e, 0.0)[1]
# From 1 N on: none is unloaded further in this scene.
S = (1.0, 12000.0**0.1)
nodes = 0.5 * (S[0] + S[1]) + 0.5 * (S[1] - S[0]) * np.cos(np.pi * (np.arange(60) + 0.5) / 60)


class Curve:
    """One kind of sprag along its own curve, by s = N^0.1."""

    def __init__(self, size):
        rows = []
        for s in nodes:
            OA, OB, OC_i, OC_e, beta, T, N_e = geometry(s**10, size)
            rotation = turned(OC_i, OC_e, beta) - turned_0
            OC_g, gamma = centroid(OC_e, rotation)
            rows.append((OA, OB, OC_i, OC_e, beta + gamma, gamma, OC_g, rotation + gamma - gamma_0, T, N_e))
        fit = lambda v: cheb.Chebyshev.fit(nodes, v, 40, domain=S)
        (self.OA, self.OB, self.OC_i, self.OC_e, self.bg, self.g, self.OC_g, self.alpha, self.T, self.N_e) = (
            fit(np.array(v)) for v in zip(*rows))
        d_alpha, d_g = self.alpha.deriv(), self.OC_g.deriv()
        slope = d_g(nodes) / d_alpha(nodes)
        at = lambda f: f(nodes)
        self.OC_g_slope = fit(slope)
        self.rho_i = fit((at(self.OC_g) * np.cos(at(self.bg)) - at(self.OA) + slope * np.sin(at(self.bg))) / at(self.OA))
        self.rho_e = fit((at(self.OB) - at(self.OC_g) * np.cos(at(self.g)) - slope * np.sin(at(self.g))) / at(self.OB))
        # U' by the forces and approaches, not by the torque.
        self.U = fit((-nodes**10 * self.OC_i.deriv()(nodes) + at(self.N_e) * self.OC_e.deriv()(nodes)) / d_alpha(nodes))
        # Up to the first newton rho is that at it, to 1e-5 of a windup that is itself 1e-3 of all.
        _, _, OC_i, OC_e, beta, _, _ = geometry(0.0, size)
        rotation = turned(OC_i, OC_e, beta) - turned_0
        touch = rotation + centroid(OC_e, rotation)[1] - gamma_0
        self.W = fit((at(self.rho_i) + at(self.rho_e)) * d_alpha(nodes)).integ(lbnd=S[0])
        self.W += (self.rho_i(S[0]) + self.rho_e(S[0])) * (self.alpha(S[0]) - touch)
        self.d_alpha, self.d_rho_i, self.d_rho_e = d_alpha, self.rho_i.deriv(), self.rho_e.deriv()
        self.table = np.linspace(*S, 4001)
        self.alphas = self.alpha(self.table)

    def s_of(self, alpha):
        s = np.interp(alpha, self.alphas, self.table)
        for _ in range(3):
            s -= (self.alpha(s) - alpha) / self.d_alpha(s)
        return s


kinds = [(Curve(0.0), n - 1, STATIC), (Curve(SIZE), 1, SMOOTH)]

# alpha_max from the drag torque.
OA, OB, OC_i, OC_e, beta, _, _ = geometry(0.0, 0.0)
OC_g, gamma = centroid(OC_e, 0.0)
T = drag / (n * R_i)
N = T / 0.1
alpha_max = ((OC_g * np.sin(beta + gamma) - OC_g * np.sin(gamma)) * N + (OC_g * np.cos(beta + gamma) - OA) * T
             + (OB - OC_g * np.cos(gamma)) * T * OA / OB) / k_r


def start():
    own = lambda curve, w: brentq(lambda s: curve.W(s) - w, *S, xtol=1e-15)
    carried = lambda w: sum(m * curve.T(own(curve, w)) * curve.OA(own(curve, w)) for curve, m, _ in kinds)
    w = brentq(lambda w: carried(w) - preload, 1e-3, 0.06, xtol=1e-16)
    outer = -preload / k_ab
    sprag = [v for curve, _, _ in kinds for v in (curve.alpha(own(curve, w)), 0.0, 0.0, 0.0)]
    return np.array([outer - w, outer, 0.0, 0.0, *sprag])


def look(t, y, slips):
    """Accelerations and forces: theta_bi'', theta_be'', then alpha'', phi'', T_bi, T_be of each; N_bi, N_be, v_A of each."""
    size = 2 + 4 * len(kinds)
    A, rhs, seen = np.zeros((size, size)), np.zeros(size), []
    A[0, 0], A[1, 1] = I_i, I_e
    rhs[0] = -c * (y[2] - y[3]) - preload
    rhs[1] = c * (y[2] - y[3]) + amplitude * np.sin(omega * t) - k_ab * y[1]
    for k, ((curve, m, static), slip) in enumerate(zip(kinds, slips)):
        alpha, phi, da, dp = y[4 + 4 * k:8 + 4 * k]
        s = curve.s_of(alpha)
        N, OA, OB, OC_g, slope = s**10, curve.OA(s), curve.OB(s), curve.OC_g(s), curve.OC_g_slope(s)
        rho_i, rho_e = curve.rho_i(s), curve.rho_e(s)
        a, p, ti, te = range(2 + 4 * k, 6 + 4 * k)
        A[0, ti], A[1, te] = -m * OA, m * OB
        A[a, a] = A[a, p] = A[p, a] = inertia
        A[a, ti], A[a, te] = -rho_i * OA, -rho_e * OB
        rhs[a] = k_r * (alpha_max - alpha) - curve.U(s) + mass * OC_g * slope * dp**2
        A[p, p] = inertia + mass * OC_g**2
        A[p, ti], A[p, te] = OA, -OB
        rhs[p] = -2 * mass * OC_g * slope * da * dp
        v_A = OA * (y[2] - dp + rho_i * da)
        if slip == 0:
            A[ti, 0], A[ti, p], A[ti, a] = 1.0, -1.0, rho_i
            rhs[ti] = -curve.d_rho_i(s) / curve.d_alpha(s) * da**2
        else:
            kinetic = KINETIC * static / STATIC
            A[ti, ti] = 1.0
            rhs[ti] = -slip * (kinetic + (static - kinetic) * np.exp(-DECAY * max(slip * v_A, 0.0))) * N
        A[te, 1], A[te, p], A[te, a] = 1.0, -1.0, -rho_e
        rhs[te] = curve.d_rho_e(s) / curve.d_alpha(s) * da**2
        seen.append((N, OC_g, curve.bg(s), curve.g(s), v_A, dp))
    x = np.linalg.solve(A, rhs)
    out = []
    for k, (N, OC_g, bg, g, v_A, dp) in enumerate(seen):
        T, T_e = x[4 + 4 * k], x[5 + 4 * k]
        N_e = (N * np.cos(bg) + T * np.sin(bg) - T_e * np.sin(g) + mass * OC_g * dp**2) / np.cos(g)
        out.append((N, N_e, v_A, T, T_e))
    return x, out


def slope(t, y, slips):
    x, _ = look(t, y, slips)
    parts = [v for k in range(len(kinds)) for v in (y[6 + 4 * k], y[7 + 4 * k], x[2 + 4 * k], x[3 + 4 * k])]
    return np.array([y[2], y[3], x[0], x[1], *parts])


def until_a_change(t, y, slips):
    """The motion up to the first change of a grip at A."""
    since = t

    def falls(k):
        def event(t, y):
            N, _, v_A, T, _ = look(t, y, slips)[1][k]
            # A slip begins at v = 0 and rises: it may end from some way on.
            return kinds[k][2] * N - abs(T) if slips[k] == 0 else slips[k] * v_A + (1e-9 if t - since < 1e-6 else 0.0)
        event.terminal, event.direction = True, -1
        return event

    return solve_ivp(lambda t, y: slope(t, y, slips), (t, DURATION), y, "DOP853", rtol=1e-12, atol=1e-15, max_step=1e-4,
                     events=[falls(k) for k in range(len(kinds))], dense_output=True)


def largest(ran, slips, k):
    """Largest N_bi of kind k, by the parabola through the three highest of many places."""
    times = np.linspace(ran.t[0], ran.t[-1], 2000)
    values = [look(time, ran.sol(time), slips)[1][k][0] for time in times]
    j = int(np.argmax(values))
    if not 0 < j < len(times) - 1:
        return values[j]
    left, mid, right = values[j - 1:j + 2]
    return mid - (right - left) ** 2 / (8 * (left - 2 * mid + right))


def main():
    y, t, slips, most = start(), 0.0, [0, 0], [0.0, 0.0]
    while True:
        ran = until_a_change(t, y, slips)
        for time, state in zip(ran.t, ran.y.T):
            for k, (_, N_e, _, _, T_e) in enumerate(look(time, state, slips)[1]):
                assert abs(T_e) < kinds[k][2] * N_e, (time, k, T_e / N_e)
        most = [max(most[k], largest(ran, slips, k)) for k in range(len(kinds))]
        t, y = ran.t[-1], ran.y[:, -1]
        if ran.status != 1:
            break
        k = next(k for k in range(len(kinds)) if len(ran.t_events[k]))
        sign = slips[k]
        slips[k] = -int(np.sign(look(t, y, slips)[1][k][3])) if sign == 0 else 0
        N, _, _, T, _ = look(t, y, slips)[1][k]
        if sign != 0 and abs(T) > kinds[k][2] * N:
            slips[k] = -sign
        print("at %.9e s kind %d: %s" % (t, k, {0: "holds", 1: "overruns", -1: "slips engaging"}[slips[k]]))
    for name, value in zip(("theta_bi", "theta_be", "alpha drawn", "alpha smooth"), (y[0], y[1], y[4], y[8])):
        print("%-13s %.9e rad" % (name, value))
    print("largest N     %.7e %.7e N" % tuple(most))


main()
