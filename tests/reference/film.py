#!/usr/bin/env python3
"""Film of a lubricated line contact by a numerical solution of Reynolds' and the elastic equation: tests/reference/film.csv.

    python3 -m venv v && v/bin/pip install numpy && v/bin/python tests/reference/film.py > tests/reference/film.csv

Independent of the crate: no film formula is in here. In Moes' scaling, U = eta u_s/(E' R) with u_s the sum of both surface
speeds, x = R U^(1/4) X, h = R U^(1/2) H, p = E' U^(1/4) P, the whole problem has two numbers, M = W/U^(1/2) and L = alpha E' U^(1/4):

    d/dX(H^3 exp(-L P) dP/dX) = 6 dH/dX where P > 0,      H = H0 + X^2/2 - (4/pi) integral P ln|X - S| dS,      integral P dX = M.

Finite volumes on a graded grid, the elastic integral exact for pressure constant in a cell, Barus' viscosity; P >= 0
(Reynolds' condition) by an active set inside Newton's method; steps in load from the rigid limit. From the same pressure: couette =
integral exp(L P)/H dX where P > 0, the shear by sliding; roll = integral (H/2) dP/dX dX, that by rolling; h_centre, the gap at the
centre of pressure; h_at_top, that at the largest pressure.
"""
import sys
import numpy as np


def grid(scale, half, cells):
    """Cell edges from -200 scales to +3, finest (uniform in asinh) near the middle of the contact."""
    left, right = -200.0 * scale - 2 * half, 3.0 * scale + 1.6 * half
    knee = 0.6 * scale + 0.9 * half
    s = np.linspace(np.arcsinh(left / knee), np.arcsinh(right / knee), cells + 1)
    return knee * np.sinh(s)


def kernel(x, edges):
    """-(4/pi) of the integral of ln|x - s| over each cell."""
    def f(d):
        return d * np.log(np.maximum(np.abs(d), 1e-300)) - d
    a, b = edges[None, :-1], edges[1:][None, :]
    return -(4 / np.pi) * (f(x[:, None] - a) - f(x[:, None] - b))


def solve(m, el, cells=900, start=None):
    h_guess = 2.45 / m
    scale = np.sqrt(2 * h_guess)
    half = np.sqrt(8 * m / np.pi) if m > 0.3 else 0.0
    e = grid(min(scale, 6.0 if m > 1 else scale), half, cells)
    x = 0.5 * (e[1:] + e[:-1])
    dx = np.diff(e)
    k = kernel(x, e)
    n = len(x)
    if start is None:
        h = h_guess + 0.5 * x**2
        p = np.zeros(n)
        h0 = h_guess
    else:
        xs, ps, h0 = start
        p = np.interp(x, xs, ps, left=0, right=0)
    gap = 0.5 * (dx[1:] + dx[:-1])

    def load_step(p, h0, m, el):
        for it in range(400):
            h = h0 + 0.5 * x**2 + k @ p
            h = np.maximum(h, 1e-6)
            hf = 0.5 * (h[1:] + h[:-1])
            pf = 0.5 * (p[1:] + p[:-1])
            vis = np.exp(-el * pf)
            c = hf**3 * vis / gap
            dp = p[1:] - p[:-1]
            flux = c * dp - 6 * hf
            # first and last cell: P = 0 outside
            c0 = h[0]**3 * np.exp(-el * p[0]) / (0.5 * dx[0])
            fl0 = c0 * p[0] - 6 * (h0 + 0.5 * e[0]**2 + (kernel(e[:1], e) @ p)[0])
            fln = -(h[-1]**3 / (0.5 * dx[-1])) * p[-1] - 6 * h[-1]
            fl = np.concatenate([[fl0], flux, [fln]])
            r = fl[1:] - fl[:-1]
            dcdh = 3 * hf**2 * vis / gap * dp
            # d flux_f / d p: through p, viscosity, h
            j = np.zeros((n + 1, n + 1))
            i = np.arange(n - 1)
            j[i + 1, i] += -c - 0.5 * el * c * dp
            j[i + 1, i + 1] += c - 0.5 * el * c * dp
            kk = np.hstack([k, np.ones((n, 1))])
            j[1:n, :] += 0.5 * dcdh[:, None] * (kk[1:] + kk[:-1]) - 3 * (kk[1:] + kk[:-1])
            k0 = np.append(kernel(e[:1], e)[0], 1.0)
            j[0, 0] += c0 * (1 - el * p[0])
            j[0] += -6 * k0
            j[n, n - 1] += -(h[-1]**3 / (0.5 * dx[-1]))
            j[n] += -6 * kk[-1]
            jac = j[1:] - j[:-1]
            full = np.zeros((n + 1, n + 1))
            rhs = np.zeros(n + 1)
            row = np.abs(jac[np.arange(n), np.arange(n)]) + 1e-30
            # complementarity min(P, -r) = 0: P >= 0, and where P = 0 the film may only open (r <= 0)
            active = (p + r / row) > 0
            full[:n] = np.where(active[:, None], jac / row[:, None], 0)
            rhs[:n] = np.where(active, -r / row, -p)
            off = ~active
            full[np.where(off)[0], np.where(off)[0]] = 1.0
            full[n, :n] = dx
            rhs[n] = m - p @ dx
            if not p.any():             # without pressure the load does not feel H0 yet
                full[n], rhs[n] = 0, 0
                full[n, n] = 1
            try:
                d = np.linalg.solve(full, rhs)
            except np.linalg.LinAlgError:
                return p, h0, False
            step = 1.0
            top = max(p.max(), 1e-9)
            big = np.abs(d[:n]).max()
            if big > 0.5 * top and it > 0:
                step = 0.5 * top / big if el > 0 or m > 0.3 else 1.0
            if d[n] < 0 and el == 0 and m < 0.3:
                step = min(step, 0.5 * h0 / -d[n]) if h0 > 0 else step
            p = np.maximum(p + step * d[:n], 0.0)
            h0 = h0 + step * d[n]
            if big < 1e-11 * top + 1e-14 and abs(d[n]) < 1e-10 * max(abs(h0), 1e-3):
                return p, h0, True
        return p, h0, False

    p, h0, ok = load_step(p, h0, m, el)
    h = h0 + 0.5 * x**2 + k @ p
    wet = p > 1e-9 * p.max()
    couette = np.sum((np.exp(el * p) / h * dx)[wet])
    roll = 0.5 * np.sum((0.5 * (h[1:] + h[:-1]) * (p[1:] - p[:-1])))
    centre = np.interp((p @ (dx * x)) / m, x, h)
    at_top = h[np.argmax(p)]
    return ok, h[wet].min(), centre, at_top, couette, roll, (x, p, h0), p.max()


def main():
    print("m,l,h_min,h_centre,h_at_top,couette,roll,p_max")
    levels = [0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0]
    for el in [0.0, 2.0, 5.0, 10.0, 15.0]:
        start = None
        for m in levels:
            if el * np.sqrt(m / (2 * np.pi)) > 9:
                continue                    # Barus' exponent at the Hertz pressure: beyond it nothing is oil any more
            best = None
            if el > 0:
                # walk up in L from the isoviscous solution at this load
                s = iso[m]
                good = True
                for e in np.linspace(0, el, 13)[1:]:
                    out = solve(m, e, start=s)
                    s = out[6]
                    good = good and out[0]
                best = out
            else:
                if start is not None and m > 0.5:
                    last = [q for q in levels if q < m][-1]
                    for q in np.geomspace(last, m, 6)[1:]:
                        out = solve(q, 0.0, start=start)
                        start = out[6]
                else:
                    out = solve(m, 0.0, start=start)
                    start = out[6]
                best = out
                globals().setdefault("iso", {})[m] = start
            ok, hm, hc, ht, co, ro, _, top = best
            if ok:
                print(f"{m},{el},{hm:.6g},{hc:.6g},{ht:.6g},{co:.6g},{ro:.6g},{top:.6g}", flush=True)
            else:
                print(f"no convergence: M {m}, L {el}", file=sys.stderr)


if __name__ == "__main__":
    main()
