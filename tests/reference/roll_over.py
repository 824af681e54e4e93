"""Reference for tests/wedge/roll_over.rs: the single-arc clutch of Huang, Liu and Zhao (2017) over the highest place of its sprags.

    python3 -m venv /tmp/v && /tmp/v/bin/pip install numpy scipy && /tmp/v/bin/python tests/reference/roll_over.py

Shares no code with the library and goes another way: the turn psi of the line from C_e to the centre of the arc (or to the edge at its end)
is given and N solved from the triangle O C_i C_e, beta from the law of sines, so upright is no special place; windup
from the energy balance C dW = n (N_i d(delta_i) + N_e d(delta_e)), not from the rolling of the contacts. The profile ends at 0.45 rad.
"""

import csv
from pathlib import Path

import numpy as np
from scipy.integrate import quad
from scipy.optimize import brentq, minimize_scalar

HERE = Path(__file__).parent
n, E, nu = 12, 206e9, 0.3
length, width = 6e-3, 5.05e-3
R_id, R_i, R_e, R_ed = 7.21e-3, 11.11e-3, 19.44e-3, 26.23e-3
r_e, e_1, r_i, K, end = 4.68e-3, 0.62e-3, 4.02e-3, 3.944e-5, 0.45


def roller(N):
    return K * N**0.9 / (length * 1e3) ** 0.8 * 1e-3


def ring(inside, outside, sign):
    a, b = inside**2, outside**2
    return n / (2 * np.pi * length * E) * ((a + b) / (b - a) + sign * nu)


c_i, c_e = ring(R_id, R_i, -1), ring(R_e, R_ed, 1)
c_g = (R_e - R_i) / (width * length * E)


def place(psi, e, r):
    """N, beta, torque and the approaches, the centre of the arc of radius r at e and psi from C_e."""

    def at(N):
        Ne = N
        for _ in range(100):
            d_i = c_i * N + c_g * N / 2 + roller(N)
            d_e = c_e * Ne + c_g * N / 2 + roller(Ne)
            OC_i, OC_e = R_i + r - d_i, R_e - r_e + d_e
            OA = R_i - c_i * N - roller(N) / 2
            OB = R_e + c_e * Ne + roller(Ne) / 2
            beta = np.arcsin(e * np.sin(psi) / OC_i)
            omega = np.arctan2(OB * np.sin(beta), OB * np.cos(beta) - OA)
            new = N / np.cos(omega) * np.cos(omega - beta)
            if abs(new - Ne) < 1e-15 * N:
                break
            Ne = new
        gap = OC_i - np.sqrt(OC_e**2 + 2 * OC_e * e * np.cos(psi) + e * e)
        return gap, beta, n * N * np.tan(omega) * OA, d_i, d_e, Ne

    low, high = 1e-12, 1e6
    if at(low)[0] < 0:
        return None
    N = brentq(lambda N: at(N)[0], low, high, xtol=1e-300, rtol=8.9e-16)
    _, beta, torque, d_i, d_e, Ne = at(N)
    return N, beta, torque, d_i, d_e, Ne


# First contact.
OC_i, OC_e = R_i + r_i, R_e - r_e
beta0 = np.arccos((OC_i**2 + OC_e**2 - e_1**2) / (2 * OC_i * OC_e))
psi0 = np.arctan2(OC_i * np.sin(beta0), OC_i * np.cos(beta0) - OC_e)


def on_arc(turned):
    return place(psi0 + turned, e_1, r_i)


# The edge: turned (of the body) at which the turn of the contact is `end`.
edge = brentq(lambda t: t - (on_arc(t)[1] - beta0) - end, 0.3, 0.6, xtol=1e-15)
azimuth = beta0 - end
P = e_1 * np.array([np.sin(psi0), np.cos(psi0)]) - r_i * np.array([np.sin(azimuth), np.cos(azimuth)])
e_p = np.hypot(*P)
psi_p = np.arctan2(P[0], P[1]) % (2 * np.pi)


def on_edge(turned):
    return place(psi_p + turned, e_p, 0.0)


def course(turned):
    return on_arc(turned) if turned <= edge else on_edge(turned)


def slope(turned):
    """dU/d(turned) per sprag and dW/d(turned), by central differences of the approaches."""
    h = 1e-5
    f = on_arc if turned < edge else on_edge
    a, m, b = f(turned - h), f(turned), f(turned + h)
    dU = (m[0] * (b[3] - a[3]) + m[5] * (b[4] - a[4])) / (2 * h)
    return dU, n * dU / m[2]


def windup(a, b):
    return quad(lambda t: slope(t)[1], a, b, epsabs=1e-13, epsrel=1e-10, limit=400)[0]


upright = np.pi - psi_p
lost = brentq(lambda t: (course(t) or [-1.0])[0] - 100.0, upright, upright + 0.6, xtol=1e-13)  # N = 100 N
least = minimize_scalar(lambda t: course(t)[2], bounds=(upright, lost), method="bounded", options={"xatol": 1e-10}).x
# From first contact dW/d(turned) is smooth but for N ~ x^1.1 at its beginning: x = z^9.
start = 0.05
first = quad(lambda z: slope(z**9)[1] * 9 * z**8, 2e-5 ** (1 / 9), start ** (1 / 9), epsabs=1e-13, epsrel=1e-9)[0]
first += slope(2e-5)[1] * 2e-5
w_edge = first + windup(start, edge)
rows = []
for name, at in [("edge", edge), ("quarter", edge + 0.25 * (upright - edge)), ("half", edge + 0.5 * (upright - edge)),
                 ("upright", upright), ("beyond", upright + 0.5 * (lost - upright)), ("least", least), ("nearly-lost", lost)]:
    side = [edge, at]
    if at > upright:
        w = windup(edge, upright - 1e-3) + windup(upright + 1e-3, at)
        w += 1e-3 * (slope(upright - 1e-3)[1] + slope(upright + 1e-3)[1])
    elif at == upright:
        w = windup(edge, upright - 1e-3) + 1e-3 * slope(upright - 1e-3)[1]
    else:
        w = windup(edge, at)
    N, beta, torque, *_ = course(at)
    rows.append([name, at, N, torque, w_edge + w])

with open(HERE / "roll_over.csv", "w", newline="") as f:
    out = csv.writer(f, lineterminator="\n")
    out.writerow(["place", "turned_rad", "normal_n", "torque_nm", "windup_rad"])
    for name, *values in rows:
        out.writerow([name] + [f"{v:.10g}" for v in values])
print(open(HERE / "roll_over.csv").read())
