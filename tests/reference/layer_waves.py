#!/usr/bin/env python3
"""Share of plane stress in a wave on the edge of an elastic layer, by finite elements over its section: where the figures of layer_share
and element_share (src/contact/layer.rs) come from. Prints layer_waves.csv. Needs numpy and scipy.

Thickness l = 1, |z| < 1/2, free faces, edge y = 0, wave cos kx along the edge, E = 1. Displacements u(y, z) sin kx, v cos kx, w cos kx; nine-node
quadrilaterals on 0 < z < 1/2. f = displacement of the edge, even over the thickness, over 2p/(E k), p the mean pressure. S = [f - (1 - nu^2)]/nu^2 falls
from 1 to 0. "element": the same of one element whose thickness strain is even, with the shear factor 3/4.
"""
import numpy as np
import scipy.sparse as sp
import scipy.sparse.linalg as sl

GAUSS = [(-0.6**0.5, 5 / 9), (0.0, 8 / 9), (0.6**0.5, 5 / 9)]


def lagrange(t):
    return np.array([t * (t - 1) / 2, 1 - t * t, t * (t + 1) / 2]), np.array([t - 0.5, -2 * t, t + 0.5])


def edges(first, end, n):
    low, high = 1.0000001, 3.0
    for _ in range(100):
        q = 0.5 * (low + high)
        low, high = (q, high) if first * (q**n - 1) / (q - 1) < end else (low, q)
    return np.concatenate([[0], np.cumsum(first * q ** np.arange(n))])


def wave(k, nu, ny=24, nz=10):
    """f of the wave k."""
    mu = 0.5 / (1 + nu)
    D = np.diag([2 * mu] * 3 + [mu] * 3)
    D[:3, :3] += nu / ((1 + nu) * (1 - 2 * nu))
    ys = edges(min(0.02, 0.05 / k), 14 / k, ny)
    w = 1.5 ** -np.arange(nz)
    zs = np.concatenate([[0], np.cumsum(w) / w.sum()]) * 0.5
    width = 2 * nz + 1
    index = lambda i, j: i * width + j
    count = 3 * (2 * ny + 1) * width
    rows, cols, values = [], [], []
    for i in range(ny):
        for j in range(nz):
            hy, hz = ys[i + 1] - ys[i], zs[j + 1] - zs[j]
            nodes = [index(2 * i + a, 2 * j + b) for a in range(3) for b in range(3)]
            K = np.zeros((27, 27))
            for y, wy in GAUSS:
                for z, wz in GAUSS:
                    (a, da), (b, db) = lagrange(y), lagrange(z)
                    n, dy, dz = (np.outer(*p).ravel() for p in ((a, b), (da * 2 / hy, b), (a, db * 2 / hz)))
                    B = np.zeros((6, 27))
                    B[0, 0::3], B[1, 1::3], B[2, 2::3] = k * n, dy, dz
                    B[3, 0::3], B[3, 1::3] = dy, -k * n
                    B[4, 1::3], B[4, 2::3] = dz, dy
                    B[5, 0::3], B[5, 2::3] = dz, -k * n
                    K += B.T @ D @ B * (wy * wz * hy * hz / 4)
            dof = np.array([3 * q + c for q in nodes for c in range(3)])
            rows.append(np.repeat(dof, 27)), cols.append(np.tile(dof, 27)), values.append(K.ravel())
    K = sp.csr_matrix((np.concatenate(values), (np.concatenate(rows), np.concatenate(cols))))
    held = {3 * index(i, 0) + 2 for i in range(2 * ny + 1)} | {3 * index(2 * ny, j) + c for j in range(width) for c in range(3)}
    free = np.array(sorted(set(range(count)) - held))
    top = np.array([3 * index(0, j) + 1 for j in range(width)])
    rest = np.setdiff1d(free, top)
    u = np.zeros(count)
    u[top] = 1
    u[rest] = sl.spsolve(K[rest][:, rest].tocsc(), -K[rest][:, top] @ np.ones(width))
    return k / 4 / (K @ u)[top].sum()


def element(k, nu):
    m = (32 / (1 - nu)) ** 0.5
    s = np.hypot(k, m)
    return 1 / (1 + nu * nu / (1 - nu * nu) * 2 * k * k * (s - k) / (s * m * m))


if __name__ == "__main__":
    print("poisson,wave,layer,element")
    for nu in (0.2, 0.25, 0.3, 0.35, 0.4):
        for k in (0.5, 1, 2, 4, 8, 16, 32, 64):
            shares = [(f(k, nu) - (1 - nu**2)) / nu**2 for f in (wave, element)]
            print(f"{nu},{k},{shares[0]:.4f},{shares[1]:.4f}")
