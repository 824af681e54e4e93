"""Reference for tests/motion/periodic.rs: periodic motions in stick by other means.

    python3 -m venv /tmp/v && /tmp/v/bin/pip install numpy scipy && /tmp/v/bin/python tests/reference/periodic.py

Shares no code with the library. The clutch of drivetrain.toml without its drivetrain, sprags and springs that weigh and press
next to nothing: in stick a spring between the races, from the statics of section 2 of Huang, Liu and Zhao (2017) with its windup from
the energy balance (as in drivetrain.py). State: windup w, theta_e, their rates. Preload on the inner race, the outer race on an
abutment, amplitude sin(2 pi f t) on it. The orbit by scipy's root from the period map of DOP853 (rtol 1e-13), multipliers
from the variational equations, which the library has not. What rolling asks of the contacts from the races:
n T_i OA = C, so that |T|/N is tan omega and tan nu of the statics where the sprags weigh nothing, but the torque of the wedge is.
"""

import csv
import tomllib
from pathlib import Path

import numpy as np
from numpy.polynomial import chebyshev as cheb
from scipy.integrate import solve_ivp
from scipy.optimize import brentq, root

HERE = Path(__file__).parent
data = tomllib.loads((HERE / "drivetrain.toml").read_text())
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


def roller(N):
    return K * N**0.9 / (length * 1e3) ** 0.8 * 1e-3


def statics(N):
    """(C, delta_i, delta_e, N_e, tan omega) at the inner normal force N: N m, m, m, N, 1."""
    body = N * (R_e - R_i) / (E * b * length)
    grow_i = n * N / (2 * np.pi * R_i * width) * R_i / E * ((R_i**2 + R_id**2) / (R_i**2 - R_id**2) - nu)
    N_e = N
    for _ in range(60):
        grow_e = n * N_e / (2 * np.pi * R_e * width) * R_e / E * ((R_ed**2 + R_e**2) / (R_ed**2 - R_e**2) + nu)
        OA = R_i - grow_i - roller(N) / 2
        OB = R_e + grow_e + roller(N_e) / 2
        OC_i = R_i + r_i - grow_i - body / 2 - roller(N)
        OC_e = R_e - r_e + grow_e + body / 2 + roller(N_e)
        beta = np.arccos((OC_i**2 + OC_e**2 - e_1**2) / (2 * OC_i * OC_e))
        at_a = np.arctan2(OB * np.sin(beta), OB * np.cos(beta) - OA)
        N_e = N * np.cos(at_a - beta) / np.cos(at_a)
    return n * N * np.tan(at_a) * OA, -OC_i, OC_e, N_e, np.tan(at_a)


# The clutch as a spring, by s = N^0.1.
S = (1.0, 20000.0**0.1)
nodes = 0.5 * (S[0] + S[1]) + 0.5 * (S[1] - S[0]) * np.cos(np.pi * (np.arange(60) + 0.5) / 60)
at_nodes = np.array([statics(s**10) for s in nodes]).T
C_fit, i_fit, e_fit, Ne_fit, tan_fit = (cheb.Chebyshev.fit(nodes, v, 40, domain=S) for v in at_nodes)
slope = cheb.Chebyshev.fit(
    nodes, n * (nodes**10 * i_fit.deriv()(nodes) + Ne_fit(nodes) * e_fit.deriv()(nodes)) / C_fit(nodes), 40, domain=S)
W_fit = slope.integ()
W_fit -= W_fit(S[0])
W_of = np.linspace(*S, 20001)
W_table = W_fit(W_of)


def s_of(w):
    """s at the windup w from S[0] on: table, then Newton."""
    s = np.interp(w, W_table, W_of)
    for _ in range(3):
        s -= (W_fit(s) - w) / slope(s)
    return s


def orbit(preload, amplitude, hertz, k_ab, guess=None):
    """z(0) = (s in place of the windup, theta_e, w', theta_e'), its multipliers, extremes of N and |T|/N over the period."""
    period, rate = 1 / hertz, 2 * np.pi * hertz

    def rhs(t, y):
        # s' = w'/W'(s): the spring law needs no inversion.
        s, e, dw, de = y[:4]
        C, k = C_fit(s), slope(s)
        # inner: I_i theta_i'' = C + c w' - preload; outer: I_e theta_e'' = -C - c w' - k_ab e + amplitude sin; w = e - i.
        inner = (C + c * dw - preload) / I_i
        outer = (-C - c * dw - k_ab * e + amplitude * np.sin(rate * t)) / I_e
        out = [dw / k, de, outer - inner, outer]
        if len(y) > 4:
            dC = dC_fit(s)
            A = np.array([
                [-dw * dslope(s) / k**2, 0, 1 / k, 0],
                [0, 0, 0, 1],
                [-dC / I_e - dC / I_i, -k_ab / I_e, -c / I_e - c / I_i, 0],
                [-dC / I_e, -k_ab / I_e, -c / I_e, 0],
            ])
            out += list((A @ y[4:].reshape(4, 4)).ravel())
        return out

    dC_fit, dslope = C_fit.deriv(), slope.deriv()
    run = lambda z, **more: solve_ivp(rhs, (0, period), z, method="DOP853", rtol=1e-13, atol=1e-15, **more)
    z = guess if guess is not None else np.array(
        [brentq(lambda s: C_fit(s) - preload, *S), -preload / k_ab, 0.0, 0.0])
    for _ in range(20 if guess is None else 0):
        z = run(z).y[:, -1]
    for _ in range(8):
        whole = run(np.concatenate([z, np.eye(4).ravel()])).y[:, -1]
        J = whole[4:].reshape(4, 4)
        step = np.linalg.solve(np.eye(4) - J, whole[:4] - z)
        z = z + step
        if np.max(np.abs(step)) < 1e-13:
            break
    dense = run(z, dense_output=True).sol
    s = dense(np.linspace(0, period, 200001))[0]
    multipliers = sorted(np.linalg.eigvals(J), key=lambda m: -abs(m))
    w = W_fit(s)
    return {
        "preload_nm": preload, "amplitude_nm": amplitude, "hertz": hertz, "abutment_nm_per_rad": k_ab,
        "normal_min_n": s.min() ** 10, "normal_max_n": s.max() ** 10, "required": tan_fit(s).max(),
        "windup_swing_rad": 0.5 * (w.max() - w.min()), "multiplier": abs(multipliers[0]), "multiplier_2": abs(multipliers[3]),
    }


rows = [orbit(16.8, 6.0, f, 5000.0) for f in (60.0, 100.0, 141.0, 180.0)] + [orbit(16.8, 3.0, 300.0, 1500.0)]
with open(HERE / "periodic.csv", "w", newline="") as file:
    writer = csv.DictWriter(file, rows[0].keys(), lineterminator="\n")
    writer.writeheader()
    for row in rows:
        writer.writerow({k: f"{v:.12g}" for k, v in row.items()})
        print(row)
