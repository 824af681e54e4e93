"""Reference for tests/wedge/spiral.rs: Table 1's clutch of Huang, Liu and Zhao (2017) with spirals for an inner profile.

    python3 -m venv /tmp/v && /tmp/v/bin/pip install numpy scipy && /tmp/v/bin/python tests/reference/spiral.py

Shares no code with the library and knows no arcs of a spiral: the contact is sought on the curve itself, r = r_0 exp(k phi) in polar
coordinates about its pole (for the curve of constant strut angle taken r_e R_i/R_e inwards along its normal), N and turn by Newton's
method, windup from the energy balance C dW = n (N_i d(delta_i) + N_e d(delta_e)).
"""

import csv
from pathlib import Path

import numpy as np
from scipy.integrate import quad
from scipy.optimize import brentq

HERE = Path(__file__).parent
n, E, nu = 12, 206e9, 0.3
length, width = 6e-3, 5.05e-3
R_id, R_i, R_e, R_ed = 7.21e-3, 11.11e-3, 19.44e-3, 26.23e-3
r_e, K = 4.68e-3, 3.944e-5
strut = np.radians(4.45)


def roller(N):
    return K * N**0.9 / (length * 1e3) ** 0.8 * 1e-3


def ring(inside, outside, sign):
    a, b = inside**2, outside**2
    return n / (2 * np.pi * length * E) * ((a + b) / (b - a) + sign * nu)


c_i, c_e = ring(R_id, R_i, -1), ring(R_e, R_ed, 1)
c_g = (R_e - R_i) / (width * length * E)


class Polar:
    """The curve r_0 exp(k phi) about `pole`, `inward` along its normal; first point, normal and tangent as given."""

    def __init__(self, start, normal, k, radius, inward):
        self.k, self.inward = k, inward
        # The radius from the pole makes arctan k with the normal, on the side towards which the contact travels.
        self.r_0 = (radius + inward) / np.hypot(1, k)
        tangent = np.array([-normal[1], normal[0]])
        ray = (normal + k * tangent) / np.hypot(1, k)
        self.azimuth = np.arctan2(ray[1], ray[0])
        self.pole = start + inward * normal - self.r_0 * ray

    def at(self, turn):
        """Point and outward normal: the tangent turns as the radius does."""
        a = self.azimuth + turn
        ray, across = np.array([np.cos(a), np.sin(a)]), np.array([-np.sin(a), np.cos(a)])
        normal = (ray - self.k * across) / np.hypot(1, self.k)
        return self.pole + self.r_0 * np.exp(self.k * turn) * ray - self.inward * normal, normal


class Circle:
    def __init__(self, centre, radius, normal):
        self.centre, self.radius, self.azimuth = centre, radius, np.arctan2(normal[1], normal[0])

    def at(self, turn):
        normal = np.array([np.cos(self.azimuth + turn), np.sin(self.azimuth + turn)])
        return self.centre + self.radius * normal, normal


class Behind:
    """A curve up to a turn, another from there."""

    def __init__(self, first, turn, second):
        self.first, self.turn, self.second = first, turn, second

    def at(self, turn):
        return self.first.at(turn) if turn <= self.turn else self.second.at(turn - self.turn)


def first_contact(omega):
    """A and the normal there, from C_e, O below: triangle O A B by the law of sines."""
    beta = omega - np.arcsin(R_i / R_e * np.sin(omega))
    a = R_i * np.array([np.sin(beta), np.cos(beta)]) - np.array([0, R_e - r_e])
    return a, -np.array([np.sin(beta), np.cos(beta)])


def solved(curve, turn):
    """(N, N_e, tan omega, torque, delta_i, delta_e) where the contact lies at `turn`."""
    point, normal = curve.at(turn)

    def at(N):
        Ne = N
        for _ in range(200):
            d_i = c_i * N + c_g * N / 2 + roller(N)
            d_e = c_e * Ne + c_g * N / 2 + roller(Ne)
            OA, OB = R_i - c_i * N - roller(N) / 2, R_e + c_e * Ne + roller(Ne) / 2
            o = point + (R_i - d_i) * normal
            OC_e = np.hypot(*o)
            sin = (o[0] * normal[1] - o[1] * normal[0]) / OC_e
            beta = -np.arcsin(sin)
            omega = np.arctan2(OB * np.sin(beta), OB * np.cos(beta) - OA)
            new = N / np.cos(omega) * np.cos(omega - beta)
            if abs(new - Ne) < 1e-15 * N:
                break
            Ne = new
        return R_e - r_e + d_e - OC_e, Ne, np.tan(omega), n * N * np.tan(omega) * OA, d_i, d_e

    N = brentq(lambda N: at(N)[0], 1e-9, 1e6, xtol=1e-300, rtol=8.9e-16)
    return (N, *at(N)[1:])


def windup(curve, turn):
    """int n (N_i delta_i' + N_e delta_e')/C d(turn); N ~ turn^1.1 at its beginning: turn = z^9."""

    def slope(t):
        h = 1e-4 * t
        # Central differences of fourth order.
        f = [solved(curve, t + i * h) for i in (-2, -1, 1, 2)]
        d = [(f[0][j] - 8 * f[1][j] + 8 * f[2][j] - f[3][j]) / (12 * h) for j in (4, 5)]
        at = solved(curve, t)
        return n * (at[0] * d[0] + at[1] * d[1]) / at[3]

    first = 1e-6
    whole = slope(first) * first
    # A difference over a junction would see both curves: the pieces end beside it, and the rest is a trapezium.
    cuts, junction, beside = [first, 0.01], getattr(curve, "turn", None), 3e-4
    if junction is not None and junction < turn:
        cuts += [junction * (1 - beside), junction * (1 + beside)]
        whole += beside * junction * (slope(cuts[2]) + slope(cuts[3]))
    for a, b in zip([cuts[0], cuts[1], *cuts[3:]], [*cuts[1:3], turn]):
        whole += quad(lambda z: slope(z**9) * 9 * z**8, a ** (1 / 9), b ** (1 / 9), epsabs=1e-11, epsrel=1e-9, limit=200)[0]
    return whole


q_r = r_e * R_i / R_e


def constant(point, normal, tan):
    p = point @ normal
    return Polar(point, normal, tan, (p + q_r) * (1 + tan**2) - q_r, q_r)


a, normal = first_contact(strut)
k = np.tan(strut)
# An arc of 4.02 mm with e_1 = 0.62 mm up to 0.06 rad, then the curve that keeps the strut angle reached.
OC_1, OC_e = R_i + 4.02e-3, R_e - r_e
beta0 = np.arccos((OC_1**2 + OC_e**2 - 0.62e-3**2) / (2 * OC_1 * OC_e))
arc = Circle(np.array([OC_1 * np.sin(beta0), OC_1 * np.cos(beta0) - OC_e]), 4.02e-3, -np.array([np.sin(beta0), np.cos(beta0)]))
junction, normal_j = arc.at(0.06)
aside = junction @ np.array([-normal_j[1], normal_j[0]])
tan_j = aside / (junction @ normal_j + q_r)
CURVES = {
    "constant": constant(a, normal, k),
    "logarithmic": Polar(a, normal, k, 4.02e-3, 0.0),
    "behind": Behind(arc, 0.06, constant(junction, normal_j, tan_j)),
}

rows = []
for name, curve in CURVES.items():
    for torque in (3.34, 16.8, 50.0, 90.0):
        turn = brentq(lambda t: solved(curve, t)[3] - torque, 1e-4, 0.5, xtol=1e-16, rtol=8.9e-16)
        N, Ne, tan, _, _, _ = solved(curve, turn)
        rows.append([name, torque, N, Ne, tan, turn, windup(curve, turn)])
        print(rows[-1], flush=True)

with open(HERE / "spiral.csv", "w", newline="") as f:
    out = csv.writer(f, lineterminator="\n")
    out.writerow(["curve", "torque_nm", "normal_inner_n", "normal_outer_n", "tan_omega", "turn_rad", "windup_rad"])
    for name, *values in rows:
        out.writerow([name] + [f"{v:.10g}" for v in values])
