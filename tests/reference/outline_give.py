#!/usr/bin/env python3
"""Compliance of a sprag's outline along its strut beyond that of a disc, by finite elements: an independent check of
src/wedge/bulk.rs. Prints outline_give.csv. Needs numpy and scipy.

Plane stress, nine-node quadrilaterals between the inner and the outer side, crowded towards both contacts. Forces q along the strut are
spread as Hertz's pressure over a half width a at A and B; their work over q is the approach. A disc of diameter h under the same forces
has 4 q/(pi E) [ln(2h/a) - 3/4] to order (a/h)^2 (Johnson, Contact Mechanics, (5.57), and a quarter for the mean over the patch). The
difference over (1 + nu)/E is the table: C of src/wedge/bulk.rs. Meshes of 48 and 64 elements and half widths of h/125 and h/250 differ by
0.002.
"""
import numpy as np
import scipy.sparse as sp
import scipy.sparse.linalg as sl

NU = 0.3
GAUSS = [(-0.6**0.5, 5 / 9), (0.0, 8 / 9), (0.6**0.5, 5 / 9)]


def lagrange(t):
    return (np.array([t * (t - 1) / 2, 1 - t * t, t * (t + 1) / 2]), np.array([t - 0.5, -2 * t, t + 0.5]))


def crowded(n, at, finest):
    """n elements over [0, 1] in geometric progression away from `at`, the finest `finest` long: their ends."""
    def side(length, count):
        if count == 0:
            return np.array([0.0])
        low, high = 1 + 1e-9, 10.0
        for _ in range(200):
            q = 0.5 * (low + high)
            low, high = (q, high) if finest * (q**count - 1) / (q - 1) < length else (low, q)
        w = finest * q ** np.arange(count)
        return np.concatenate([[0.0], np.cumsum(w) / w.sum() * length])
    left = max(2, round(n * 0.5))
    return np.concatenate([at - side(at, left)[::-1], at + side(1 - at, n - left)[1:]])


def both_ends(n, finest):
    low, high = 1 + 1e-9, 10.0
    for _ in range(200):
        q = 0.5 * (low + high)
        low, high = (q, high) if finest * (q ** (n // 2) - 1) / (q - 1) < 0.5 else (low, q)
    w = finest * q ** np.arange(n // 2)
    h = np.concatenate([[0.0], np.cumsum(w) / w.sum() * 0.5])
    return np.concatenate([h, 1 - h[-2::-1]])


def work(inner, outer, a_at, b_at, a, b, half, n=(48, 48)):
    """Work of unit forces (per length, E = 1) along a-b spread over +-half. inner(s), outer(s): sides for s in [0, 1], both from rear to
    front; the contacts lie at s = a_at and b_at. Flanks are straight."""
    size = abs(inner(1.0) - inner(0.0))
    fine = half / 6 / size
    # s of the columns moves from a_at at the bottom to b_at at the top.
    sa, sb = crowded(n[0], a_at, fine), crowded(n[0], b_at, fine)
    ts = both_ends(n[1], fine)
    mid = lambda v: np.sort(np.concatenate([v, 0.5 * (v[1:] + v[:-1])]))
    sa, sb, ts = mid(sa), mid(sb), mid(ts)
    ni, nj = len(sa), len(ts)
    low = np.array([inner(s) for s in sa])
    high = np.array([outer(s) for s in sb])
    X = low[:, None] * (1 - ts[None, :]) + high[:, None] * ts[None, :]
    idx = lambda i, j: i * nj + j
    D = np.array([[1, NU, 0], [NU, 1, 0], [0, 0, (1 - NU) / 2]]) / (1 - NU * NU)
    rows, cols, vals = [], [], []
    for i in range(0, ni - 1, 2):
        for j in range(0, nj - 1, 2):
            nodes = [idx(i + p, j + r) for p in range(3) for r in range(3)]
            z = np.array([X[i + p, j + r] for p in range(3) for r in range(3)])
            K = np.zeros((18, 18))
            for x, wx in GAUSS:
                Nx, dx = lagrange(x)
                for t, wt in GAUSS:
                    Nt, dt = lagrange(t)
                    gx, gt = np.outer(dx, Nt).ravel(), np.outer(Nx, dt).ravel()
                    J = np.array([[gx @ z.real, gx @ z.imag], [gt @ z.real, gt @ z.imag]])
                    det = J[0, 0] * J[1, 1] - J[0, 1] * J[1, 0]
                    g = np.linalg.solve(J, np.array([gx, gt]))
                    B = np.zeros((3, 18))
                    B[0, 0::2], B[1, 1::2], B[2, 0::2], B[2, 1::2] = g[0], g[1], g[1], g[0]
                    K += B.T @ D @ B * (abs(det) * wx * wt)
            dof = np.array([2 * q + c for q in nodes for c in range(2)])
            rows.append(np.repeat(dof, 18)), cols.append(np.tile(dof, 18)), vals.append(K.ravel())
    K = sp.csr_matrix((np.concatenate(vals), (np.concatenate(rows), np.concatenate(cols))))
    e = (b - a) / abs(b - a)
    F = np.zeros(2 * ni * nj)
    for j, place, force in ((0, a, e), (nj - 1, b, -e)):
        total = 0.0
        part = np.zeros(ni)
        for i in range(0, ni - 1, 2):
            z = X[i : i + 3, j]
            g = np.polynomial.legendre.leggauss(8)
            for x, w in zip(*g):
                N, d = lagrange(x)
                p, tangent = N @ z, d @ z
                u = ((p - place) * np.conj(1j * e)).real / half
                if abs(u) < 1:
                    q = np.sqrt(1 - u * u) * abs((tangent * np.conj(1j * e)).real) * w
                    part[i : i + 3] += q * N
                    total += q
        for i in range(ni):
            F[2 * idx(i, j)] += force.real * part[i] / total
            F[2 * idx(i, j) + 1] += force.imag * part[i] / total
    # A rigid motion is held at three degrees of freedom; the load is in balance but for rounding of the lever.
    hold = [2 * idx(0, nj // 2), 2 * idx(0, nj // 2) + 1, 2 * idx(ni - 1, nj // 2) + 1]
    free = np.setdiff1d(np.arange(2 * ni * nj), hold)
    u = sl.spsolve(K[free][:, free].tocsc(), F[free])
    return F[free] @ u


def sprag(design, share):
    """Sides of a sprag with one inner arc and flanks parallel to the strut at first contact, contact at `share` of the profile."""
    ri, end, re, e1, Ri, Re, rear, front = design
    oc_i, oc_e = Ri + ri, Re - re
    beta = np.arccos((oc_i**2 + oc_e**2 - e1**2) / (2 * oc_i * oc_e))
    turned = lambda azimuth: np.sin(azimuth) + 1j * np.cos(azimuth)
    c = -1j * oc_e + oc_i * turned(beta)
    inner_at = lambda turn: c + ri * turned(beta + np.pi - turn)
    a0, b0 = inner_at(0.0), 1j * re
    up = (b0 - a0) / abs(b0 - a0)
    across = lambda z: ((z - a0) * np.conj(up)).imag * -1  # positive x side

    def meet(f, want, low, high):
        for _ in range(100):
            m = 0.5 * (low + high)
            low, high = (m, high) if (f(m) < want) else (low, m)
        return low

    t1 = meet(lambda t: across(inner_at(t)), front, 0.0, 2.0)
    t0 = -meet(lambda t: -across(inner_at(-t)), rear, 0.0, 2.0)
    outer_at = lambda azimuth: re * turned(azimuth)
    p1 = meet(lambda p: across(outer_at(p)), front, 0.0, 1.5)
    p0 = -meet(lambda p: -across(outer_at(-p)), rear, 0.0, 1.5)
    turn = share * end
    axis = c + oc_i * turned(beta + np.pi - turn)
    azimuth = np.arctan2(-axis.real, -axis.imag)
    return (
        lambda s: inner_at(t0 + s * (t1 - t0)),
        lambda s: outer_at(p0 + s * (p1 - p0)),
        (turn - t0) / (t1 - t0),
        (azimuth - p0) / (p1 - p0),
        inner_at(turn),
        outer_at(azimuth),
        Re - Ri,
    )


# r_i, end of its turn, r_e, e_1, R_i, R_e, rear and front half width: lengths in mm.
DESIGNS = {
    "single arc": (4.02, 0.45, 4.68, 0.62, 11.11, 19.44, 2.525, 2.525),
    "narrow sprags": (6.3, 0.2954, 11.88, 1.3849, 71.0, 89.0, 3.6591, 3.6),
}


def give(design, share, part=0.004, n=(64, 64)):
    """C in (1 + nu)/E: work less that of the disc under Hertz's pressure, 4/(pi E) [ln(2h/a) - 3/4]."""
    *sides, h = sprag(design, share)
    half = part * h
    inner, outer, sa, sb, a, b = sides
    w = work(inner, outer, sa, sb, a, b, half, n)
    e = (b - a) / abs(b - a)
    # The patch lies along the side, which leans against the strut.
    along = lambda f, s: (f(s + 1e-6) - f(s - 1e-6)) / abs(f(s + 1e-6) - f(s - 1e-6))
    lean = [abs((along(f, s) * np.conj(1j * e)).real) for f, s in ((inner, sa), (outer, sb))]
    alone = sum(2 / np.pi * (np.log(2 * h * c / half) - 0.75) for c in lean)
    return (w - alone) / (1 + NU)


if __name__ == "__main__":
    print("design,share,give")
    for name, design in DESIGNS.items():
        for share in (0.0, 0.3, 0.6, 0.8, 0.95):
            print(f"{name},{share},{give(design, share):.4f}", flush=True)
