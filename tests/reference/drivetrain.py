"""Reference for tests/motion/drivetrain.rs: the case of drivetrain.toml by other means.

    python3 -m venv /tmp/v && /tmp/v/bin/pip install numpy scipy && /tmp/v/bin/python tests/reference/drivetrain.py

Shares no code with the library. State: absolute angles and speeds of every inertia about its own axis (the library has
twists, reflected to the races, beside a mean speed). The clutch in stick is a spring whose torque and stiffness come from the
statics of section 2 of Huang, Liu and Zhao (2017) with massless sprags: roller law, Lame's rings, (6), growth by rotation (7);
its windup from the energy balance C dW = n (N_i d(delta_i) + N_e d(delta_e)), not from the rolling of the contacts. Fits in
N^0.1 (Chebyshev) carry it. scipy's DOP853, rtol 1e-13. Eigenvalues by numpy from the same matrices.
"""

import csv
import tomllib
from pathlib import Path

import numpy as np
from numpy.polynomial import chebyshev as cheb
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

HERE = Path(__file__).parent
data = tomllib.loads((HERE / "drivetrain.toml").read_text())
sprags, races = data["sprags"], data["races"]
scene = data["scenarios"][0]
omega = scene["speed_rpm"] * np.pi / 30
n = sprags["count"]
E = data["material"]["youngs_modulus_gpa"] * 1e9
nu, density = data["material"]["poisson_ratio"], data["material"]["density_kg_m3"]
R_id, R_i, R_e, R_ed = (races[k] * 1e-3 for k in (
    "inner_bore_radius_mm", "inner_radius_mm", "outer_radius_mm", "outer_outside_radius_mm"))
width, length = races["width_mm"] * 1e-3, sprags["length_mm"] * 1e-3
r_e, e_1 = sprags["outer_radius_mm"] * 1e-3, sprags["centre_distance_mm"] * 1e-3
r_i, b = sprags["inner_arcs"][0]["radius_mm"] * 1e-3, sprags["width_mm"] * 1e-3
K = data["contact"]["roller_coefficient"]


def roller(N):
    return K * N**0.9 / (length * 1e3) ** 0.8 * 1e-3


def statics(N):
    """(C, delta_i, delta_e, N_e) at the inner normal force N: torque, approaches of the centres, N m, m, N."""
    body = N * (R_e - R_i) / (E * b * length)
    grow_i = n * N / (2 * np.pi * R_i * width) * R_i / E * ((R_i**2 + R_id**2) / (R_i**2 - R_id**2) - nu)
    by_speed = density * omega**2 * R_e / (4 * E) * ((3 + nu) * R_ed**2 + (1 - nu) * R_e**2)
    N_e = N
    for _ in range(60):
        grow_e = n * N_e / (2 * np.pi * R_e * width) * R_e / E * ((R_ed**2 + R_e**2) / (R_ed**2 - R_e**2) + nu)
        OA = R_i - grow_i - roller(N) / 2
        OB = R_e + grow_e + roller(N_e) / 2 + by_speed
        OC_i = R_i + r_i - grow_i - body / 2 - roller(N)
        OC_e = R_e - r_e + grow_e + by_speed + body / 2 + roller(N_e)
        cos_beta = (OC_i**2 + OC_e**2 - e_1**2) / (2 * OC_i * OC_e)
        beta = np.arccos(cos_beta)
        # The strut AB carries the force: omega_strut at A, beta = omega_strut - nu_strut.
        at_a = np.arctan2(OB * np.sin(beta), OB * np.cos(beta) - OA)
        at_b = at_a - beta
        N_e = N * np.cos(at_b) / np.cos(at_a)
    return n * N * np.tan(at_a) * OA, -OC_i, OC_e, N_e


# The clutch as a spring, by s = N^0.1.
S = (1.2, 9000.0**0.1)
nodes = np.cos(np.pi * (np.arange(60) + 0.5) / 60)
at_nodes = np.array([statics((0.5 * (S[0] + S[1]) + 0.5 * (S[1] - S[0]) * x) ** 10) for x in nodes]).T
C_fit, i_fit, e_fit, N_e_fit = (cheb.Chebyshev.fit(0.5 * (S[0] + S[1]) + 0.5 * (S[1] - S[0]) * nodes, v, 40, domain=S)
                                for v in at_nodes)
di_fit, de_fit = i_fit.deriv(), e_fit.deriv()
dC_fit = C_fit.deriv()


def windup_slope(s):
    return n * (s**10 * di_fit(s) + N_e_fit(s) * de_fit(s)) / C_fit(s)


# Inertias: the races, then those of the file on shafts; what is rigid is added to what it is joined to.
names, J, shafts, acts, drags, where = ["inner-race", "outer-race"], [1.41e-3, 1.41e-3], [], [], [0.0, 0.0], {}
where = {"inner-race": (0, 1.0), "outer-race": (1, 1.0)}
J = [races["inner_inertia_kg_m2"], races["outer_inertia_kg_m2"]]
for d in data["drivetrain"]:
    parent, own = where[d["to"]]
    ratio = d.get("ratio", 1.0)
    if "stiffness_nm_per_rad" in d:
        body = len(names)
        names.append(d["name"])
        J.append(d["inertia_kg_m2"])
        drags.append(d.get("drag_nm_s_per_rad", 0.0))
        # Twist: own angle less ratio times that of the parent inertia (own: turns of the named one per body).
        shafts.append((body, parent, ratio * own, d["stiffness_nm_per_rad"], d.get("damping_nm_s_per_rad", 0.0)))
        where[d["name"]] = (body, 1.0)
    else:
        body, own = parent, ratio * own
        J[body] += d["inertia_kg_m2"] * own**2
        where[d["name"]] = (body, own)
    body, own = where[d["name"]]
    acts.append((body, own, d))
J = np.array(J)
count = len(J)

history = [tuple(map(float, row)) for row in list(csv.reader((HERE / "drivetrain_torque.csv").open()))[1:]]


def gas(g, angle):
    swept = np.pi / 4 * (g["bore_mm"] * 1e-3) ** 2 * g["stroke_mm"] * 1e-3
    e, l, k = g["compression_ratio"], g["rod_ratio"], g["polytropic_exponent"]
    p_0, p_i = g["intake_pressure_mpa"] * 1e6, g["mean_pressure_mpa"] * 1e6
    V_c = swept / (e - 1)
    V_max = V_c + swept
    work = p_0 * V_max / (k - 1) * (e ** (k - 1) - 1)
    total = 0.0
    for i in range(g["cylinders"]):
        x = (angle + g["phase_rad"] - 4 * np.pi * i / g["cylinders"]) % (4 * np.pi)
        if np.pi <= x < 3 * np.pi:
            continue
        # Piston from the crank: s = r cos x + sqrt(L^2 - r^2 sin^2 x), with r = 1/2 stroke in swept volumes.
        r, L = swept / 2, swept / (2 * l)
        slider = np.sqrt(L * L - (r * np.sin(x)) ** 2)
        V = V_c + r + L - (r * np.cos(x) + slider)
        dV = r * np.sin(x) + r * r * np.sin(x) * np.cos(x) / slider
        p = p_0 * (V_max / V) ** k * (1 + p_i * swept / work if x < np.pi else 1.0)
        total += (p - p_0) * dV
    return total


def torque(d, angle, t, side, mean=False):
    total = d.get("torque_nm", 0.0)
    if "torque_history_csv" in d:
        total += at_history(t, side)
    if "gas" in d:
        g = d["gas"]
        swept = np.pi / 4 * (g["bore_mm"] * 1e-3) ** 2 * g["stroke_mm"] * 1e-3
        total += g["cylinders"] * swept * g["mean_pressure_mpa"] * 1e6 / (4 * np.pi) if mean else gas(g, angle)
    if not mean:
        total += sum(o["amplitude_nm"] * np.sin(o["order"] * angle + o.get("phase_rad", 0.0)) for o in d.get("orders", []))
    return total


def at_history(t, piece):
    (t0, v0), (t1, v1) = history[piece], history[piece + 1] if piece + 1 < len(history) else (history[piece][0] + 1.0, history[piece][1])
    return v0 + (v1 - v0) * (t - t0) / (t1 - t0)


def slope(t, y, piece):
    angle, speed, s = y[:count], y[count:2 * count], y[-1]
    T = np.zeros(count)
    C = C_fit(s) 
    drag = races["viscous_damping_nm_s_per_rad"] * (speed[0] - speed[1])
    T[0] += C - drag
    T[1] += drag - C
    for body, parent, ratio, k, c in shafts:
        shaft = k * (angle[body] - ratio * angle[parent]) + c * (speed[body] - ratio * speed[parent])
        T[body] -= shaft
        T[parent] += ratio * shaft
    for body in range(2, count):
        T[body] -= drags[body] * speed[body]
    for body, own, d in acts:
        T[body] += own * torque(d, own * (angle[body] - start[body]) + offset[d["name"]], t, piece)
    return np.concatenate([speed, T / J, [(speed[1] - speed[0]) / windup_slope(s)]])


# The start: all at the mean speed, twisted as the mean torques and one common acceleration have it.
turns = [1.0, 1.0]
for body, parent, ratio, *_ in shafts:
    turns.append(ratio * turns[parent])
turns = np.array(turns)
M = np.zeros((count, len(shafts) + 2))  # twists, C, acceleration
right = np.zeros(count)
for i, (body, parent, ratio, k, c) in enumerate(shafts):
    M[body, i] -= k
    M[parent, i] += ratio * k
M[0, -2], M[1, -2] = 1.0, -1.0
M[:, -1] = -J * turns
for body in range(2, count):
    right[body] += drags[body] * turns[body] * omega
for body, own, d in acts:
    right[body] -= own * torque(d, 0.0, 0.0, 0, mean=True)
found = np.linalg.solve(M, right)
C_0 = found[-2]
s_0 = brentq(lambda s: C_fit(s) - C_0, *S, xtol=1e-15)
start = np.zeros(count)
W_0 = None
for i, (body, parent, ratio, *_) in enumerate(shafts):
    start[body] = ratio * start[parent] + found[i]
# Angles of orders and gas count from the angle of the race: an inertia stands at its twists, the inner race at minus the windup.
S_touch = np.linspace(0, 1, 2)


def windup_from_touch():
    """W at the start, from first contact: Gauss over N^0.1, whose derivative the fits do not reach down to 0."""
    x, w = np.polynomial.legendre.leggauss(60)
    total, edges = 0.0, np.array([1e-3, 0.5, 1.0, s_0])
    for a, c in zip(edges[:-1], edges[1:]):
        for xi, wi in zip(x, w):
            s = 0.5 * (a + c) + 0.5 * (c - a) * xi
            h = 1e-4 * s
            stencil = [(-2, 1 / 12), (-1, -8 / 12), (1, 8 / 12), (2, -1 / 12)]
            values = [(f, statics((s + j * h) ** 10)) for j, f in stencil]
            di, de = (sum(f * v[m] for f, v in values) / h for m in (1, 2))
            C, _, _, N_e = statics(s**10)
            total += 0.5 * (c - a) * wi * n * (s**10 * di + N_e * de) / C
    return total


W_0 = windup_from_touch()
offset = {}
for body, own, d in acts:
    side = body
    while side > 1:
        side = next(p for b_, p, *_ in shafts if b_ == side)
    stands = start[body] + turns[body] * (-W_0 if side == 0 else 0.0)
    offset[d["name"]] = own * stands

y = np.concatenate([start, turns * omega, [s_0]])
times = np.linspace(0.0, scene["duration_s"], 11)
rows, t = [], 0.0
edges = [0.0, 0.01, 0.02, 0.035, scene["duration_s"]]
pieces = [0, 1, 3, 4]
for a, c, piece in zip(edges[:-1], edges[1:], pieces):
    inside = [x for x in times if a <= x < c or x == c == edges[-1]]
    run = solve_ivp(slope, (a, c), y, "DOP853", args=(piece,), rtol=1e-13, atol=1e-15, dense_output=True, max_step=2e-5)
    for x in inside:
        rows.append((x, run.sol(x)))
    y = run.y[:, -1]

with (HERE / "drivetrain.csv").open("w") as out:
    shafted = [names[b_] for b_, *_ in shafts]
    out.write("time_s,inner_moved_rad,outer_moved_rad,clutch_nm")
    out.write("".join(f",{x}_moved_rad,{x}_speed_rad_s,{x}_shaft_nm" for x in shafted) + "\n")
    for x, y in rows:
        moved = y[:count] - start
        # Races beside the mean speed.
        values = [x, moved[0] - omega * x, moved[1] - omega * x, C_fit(y[-1])]
        for body, parent, ratio, k, c in shafts:
            shaft = k * (y[body] - ratio * y[parent]) + c * (y[count + body] - ratio * y[count + parent])
            values += [moved[body], y[count + body], shaft]
        out.write(",".join(repr(float(v)) for v in values) + "\n")

# Eigenvalues with the clutch engaged at the start.
Kc = dC_fit(s_0) / windup_slope(s_0)
stiff, damp = np.zeros((count, count)), np.zeros((count, count))


def spring(matrix, row, value):
    matrix += value * np.outer(row, row)


unit = np.eye(count)
spring(stiff, unit[0] - unit[1], Kc)
spring(damp, unit[0] - unit[1], races["viscous_damping_nm_s_per_rad"])
for body, parent, ratio, k, c in shafts:
    spring(stiff, unit[body] - ratio * unit[parent], k)
    spring(damp, unit[body] - ratio * unit[parent], c)
damp += np.diag(drags[:count])
undamped = np.sort(np.sqrt(np.maximum(np.linalg.eigvals(stiff / J[:, None]).real, 0.0)))[1:] / (2 * np.pi)
first = np.block([[np.zeros((count, count)), np.eye(count)], [-stiff / J[:, None], -damp / J[:, None]]])
values = np.linalg.eigvals(first)
swings = sorted((v for v in values if v.imag > 1.0), key=abs)
with (HERE / "drivetrain_modes.csv").open("w") as out:
    out.write("frequency_hz,damping_ratio\n")
    for f, v in zip(undamped, swings):
        out.write(f"{float(f)!r},{float(-v.real / abs(v))!r}\n")
print("C_0", C_0, "s", s_0, "W_0", W_0, "Kc", Kc, "range", min(r[1][-1] for r in rows), max(r[1][-1] for r in rows))
print(undamped)
