#!/usr/bin/env python3
"""A ring under point forces on its track, by plane-stress finite elements: tests/reference/ring_influence.csv.

    python3 -m venv v && v/bin/python -m pip install numpy scipy && v/bin/python tests/reference/ring_influence.py > tests/reference/ring_influence.csv

Independent of the crate: eight-node quadrilaterals on a polar grid, no series. Forces balance themselves, the other rim is free; the
rotation of the ring as a whole is taken out as the mean displacement along the track. normal: 1000 N away from the contacts at 0 and 180
deg; along: 1000 N along the track in the positive sense at 0 and 180 deg and back at 90 and 270 deg. E = 206 GPa, nu = 0.3, width 6 mm.
Displacements of the track, um: away from the contacts, and along the track in the positive sense.
"""
import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.linalg import splu

E, NU, W = 206e3, 0.3, 6.0  # MPa, mm
RINGS = [("outer", 19.44, 26.23), ("outer", 19.44, 20.44), ("inner", 11.11, 7.21), ("inner", 11.11, 10.11)]
ANGLES = [20, 30, 45, 60, 75, 105, 120, 150, 165]
AROUND, ACROSS = 360, 12


def shape(xi, eta):
    """Serendipity functions and slopes; nodes: corners, then mid-sides, counterclockwise from (-1, -1)."""
    corners = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
    n, dx, de = np.zeros(8), np.zeros(8), np.zeros(8)
    for k, (a, b) in enumerate(corners):
        p, q, s = 1 + a * xi, 1 + b * eta, a * xi + b * eta - 1
        n[k], dx[k], de[k] = p * q * s / 4, a * q * (s + p) / 4, b * p * (s + q) / 4
    for k, (a, b) in zip((4, 5, 6, 7), [(0, -1), (1, 0), (0, 1), (-1, 0)]):
        if a == 0:
            n[k], dx[k], de[k] = (1 - xi**2) * (1 + b * eta) / 2, -xi * (1 + b * eta), b * (1 - xi**2) / 2
        else:
            n[k], dx[k], de[k] = (1 - eta**2) * (1 + a * xi) / 2, a * (1 - eta**2) / 2, -eta * (1 + a * xi)
    return n, dx, de


def ring(track, other):
    radii = np.linspace(track, other, 2 * ACROSS + 1)
    number = lambda i, j: (i % (2 * AROUND)) * (2 * ACROSS + 1) + j
    count = 2 * AROUND * (2 * ACROSS + 1)
    angle = lambda i: np.pi * i / AROUND
    xy = np.array([[r * np.cos(angle(i)), r * np.sin(angle(i))] for i in range(2 * AROUND) for r in radii])
    d = E / (1 - NU**2) * np.array([[1, NU, 0], [NU, 1, 0], [0, 0, (1 - NU) / 2]])
    g = np.sqrt(0.6)
    points = [(a, b, wa * wb) for a, wa in ((-g, 5 / 9), (0, 8 / 9), (g, 5 / 9)) for b, wb in ((-g, 5 / 9), (0, 8 / 9), (g, 5 / 9))]
    rows, cols, values = [], [], []
    for e in range(AROUND):
        for f in range(ACROSS):
            i, j = 2 * e, 2 * f
            nodes = [number(i, j), number(i + 2, j), number(i + 2, j + 2), number(i, j + 2),
                     number(i + 1, j), number(i + 2, j + 1), number(i + 1, j + 2), number(i, j + 1)]
            k = np.zeros((16, 16))
            for a, b, w in points:
                _, dx, de = shape(a, b)
                jac = np.array([dx, de]) @ xy[nodes]
                grad = np.linalg.solve(jac, np.array([dx, de]))
                bm = np.zeros((3, 16))
                bm[0, 0::2], bm[1, 1::2], bm[2, 0::2], bm[2, 1::2] = grad[0], grad[1], grad[1], grad[0]
                k += bm.T @ d @ bm * abs(np.linalg.det(jac)) * w * W
            dofs = np.array([[2 * n, 2 * n + 1] for n in nodes]).ravel()
            rows += list(np.repeat(dofs, 16)); cols += list(np.tile(dofs, 16)); values += list(k.ravel())
    stiffness = coo_matrix((values, (rows, cols)), shape=(2 * count, 2 * count)).tocsc()
    # Three displacements held: the forces balance themselves.
    held = [2 * number(0, 0), 2 * number(0, 0) + 1, 2 * number(AROUND, 0) + 1]
    # The grid's places in the middle of elements are no nodes.
    used = np.flatnonzero(stiffness.diagonal())
    free = np.setdiff1d(used, held)
    return stiffness[free][:, free], free, number, angle, count


for side, track, other in RINGS:
    stiffness, free, number, angle, count = ring(track, other)
    lu = splu(stiffness)
    away = 1 if side == "outer" else -1
    if (side, track, other) == RINGS[0]:
        print("side,track_mm,other_rim_mm,case,angle_deg,away_um,along_um")
    for case, forces in (("normal", [(0, away, 0), (180, away, 0)]), ("along", [(0, 0, 1), (180, 0, 1), (90, 0, -1), (270, 0, -1)])):
        load = np.zeros(2 * count)
        for at, radial, along in forces:
            i = at * AROUND // 180
            c, s = np.cos(angle(i)), np.sin(angle(i))
            n = number(i, 0)
            load[2 * n] += 1000 * (radial * c - along * s)
            load[2 * n + 1] += 1000 * (radial * s + along * c)
        u = np.zeros(2 * count)
        u[free] = lu.solve(load[free])
        polar = np.array([[c * u[2 * n] + s * u[2 * n + 1], -s * u[2 * n] + c * u[2 * n + 1]]
                          for i in range(2 * AROUND) for n, c, s in [(number(i, 0), np.cos(angle(i)), np.sin(angle(i)))]])
        turns = np.exp(-1j * np.array([angle(i) for i in range(2 * AROUND)]))
        # Held points move the ring as a whole: no first harmonic of the radius, no mean along the track.
        first = 2 * np.mean(polar[:, 0] * turns)
        polar[:, 0] -= (first * np.conj(turns)).real
        polar[:, 1] -= (1j * first * np.conj(turns)).real
        polar[:, 1] -= polar[:, 1].mean()
        for at in ANGLES:
            radial, along = polar[at * AROUND // 180]
            print(f"{side},{track},{other},{case},{at},{1e3 * away * radial:.5f},{1e3 * along:.5f}")
