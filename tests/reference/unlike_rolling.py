#!/usr/bin/env python3
"""Rolling contact of two unlike half-planes that stick: an independent check of "Unlike bodies" in src/wedge/rolling.rs. Prints
unlike_rolling.csv. Needs numpy.

Steady: pressure p and shear q on cells, both coupled by Dundurs' beta (Johnson, Contact Mechanics, (2.24), (2.25)), E* = 1, R = 1, contact
travelling towards +x, q positive where it acts on the softer body (beta > 0) that way:

  d/dx normal displacement    -(2/pi) int p ds/(x - s) + 2 beta q = -x/R
  relative strain             -2 beta p - (2/pi) int q ds/(x - s) = constant, the creep

q is lumped a quarter of a cell behind the middle and strain taken a quarter ahead of it, which makes q bounded at the leading edge and
singular at the trailing one. Columns: beta, T/N, how far the pressure's centroid lies behind the contact point over a, creep without
T's own over a/R. With --growing: shift of bodies under a load that grows, a = N^0.5, x = 2.25 N^0.9, against int (2/pi) beta (a/R) dx.
"""
import sys

import numpy as np


def steady(beta, ratio, n=800):
    load = 0.002
    half = np.sqrt(4 * load / np.pi)
    edges = np.linspace(-1.1 * half, 1.1 * half, n + 1)
    h, middle = edges[1] - edges[0], 0.5 * (edges[1:] + edges[:-1])
    log = lambda d: np.where(d == 0, 0, d * np.log(np.abs(np.where(d == 0, 1, d))) - d)
    at = middle[:, None]
    sunk = -(2 / np.pi) * (log(at - edges[None, :-1]) - log(at - edges[None, 1:]))
    lumps, places = middle - h / 4, middle + h / 4
    raised = 2 * beta * h * (np.subtract.outer(middle, lumps) > 0)
    sheared = h / np.subtract.outer(places, lumps)
    pressed = 0.75 * np.eye(n) + 0.25 * np.eye(n, k=1)
    touching = np.abs(middle) < half
    for _ in range(80):
        on = np.where(touching)[0]
        m, block = len(on), np.ix_(on, on)
        a, b = np.zeros((2 * m + 2, 2 * m + 2)), np.zeros(2 * m + 2)
        a[:m, :m], a[:m, m : 2 * m], a[:m, 2 * m], b[:m] = sunk[block], raised[block], -1, -middle[on] ** 2 / 2
        a[m : 2 * m, :m], a[m : 2 * m, m : 2 * m], a[m : 2 * m, -1] = -2 * beta * pressed[block], -(2 / np.pi) * sheared[block], -1
        a[2 * m, :m], b[2 * m] = h, load
        a[-1, m : 2 * m], b[-1] = h, ratio * load
        x = np.linalg.solve(a, b)
        p, q = np.zeros(n), np.zeros(n)
        p[on], q[on] = x[:m], x[m : 2 * m]
        gap = sunk @ p + raised @ q - x[2 * m] + middle**2 / 2
        after = (touching & (p >= 0)) | (~touching & (gap < -1e-12))
        if (after == touching).all():
            break
        touching = after
    own = -ratio * load * 2 / (np.pi * half)
    return -(p * middle).sum() / p.sum() / half, -(x[-1] - own) / half


def growing(last=10.0, steps=1500):
    """x/a and shift over the integral; beta/R = 1."""
    a, x = (lambda n: n**0.5), (lambda n: 2.25 * n**0.9)
    first = (0.5 / (0.9 * 2.25)) ** 2.5
    middle, half = x(first), a(first)
    # Up to there the patch grows both ways: g' = |xi| meets int (g' - sqrt(a^2 - xi^2))/sqrt(a^2 - xi^2) = 0 for every a.
    edges = list(middle - half * np.cos(np.pi * np.arange(201) / 200))
    strain = [abs(0.5 * (u + v) - middle) for u, v in zip(edges, edges[1:])]
    angle = lambda at, x, a: np.arcsin(np.clip((at - x) / a, -1, 1))

    def mean(x, a):
        t = angle(np.array(edges), x, a)
        return np.dot(strain, np.diff(a * ((0.5 - t / np.pi) * np.sin(t) - np.cos(t) / np.pi)))

    behind, left = middle - half, -mean(middle, half)
    for i in range(1, steps + 1):
        n = first * (last / first) ** (i / steps)
        edges.append(x(n) + a(n))
        t = angle(np.array(edges), x(n), a(n))
        w = np.diff(a(n) * (t - np.cos(t)))
        strain.append((2 * a(n) ** 2 - np.dot(w[:-1], strain)) / w[-1])
        e, b = np.array(edges), x(n) - a(n)
        left += np.dot(strain, np.clip(np.minimum(e[1:], b) - np.maximum(e[:-1], behind), 0, None))
        behind = b
        if i % 150 == 0:
            print(f"{x(n) / a(n):.2f},{(left + mean(x(n), a(n))) / (2 / np.pi * 2.25 * 0.9 / 1.4 * n**1.4):.3f}")


if __name__ == "__main__":
    if sys.argv[1:] == ["--growing"]:
        print("ways_per_half_width,shift_over_integral")
        growing()
    else:
        print("beta,tangential_over_normal,behind_over_half_width,further_over_half_width_per_radius")
        for beta, ratio in ((0.1, 0.0), (0.1, 0.1), (-0.1, 0.1), (0.05, 0.1)):
            print(f"{beta},{ratio}," + ",".join(f"{v:.5f}" for v in steady(beta, ratio)))
