"""SLSQP of scipy on the margins of a design: the least objective, t, is made largest, every limit held.

    python with_scipy.py designs/huang2017-multi-arc.toml
"""

from __future__ import annotations

import sys

import numpy as np
from scipy.optimize import minimize

import sprag_design as sd


def main(path: str, quick: bool) -> None:
    problem = sd.Design.load(path).problem()
    whole = [v.name for v in problem.variables if v.whole]
    if whole:
        sys.exit(f"SLSQP knows no whole numbers: take {', '.join(whole)} out of [optimize] variables, or with_optuna.py")
    low, high = np.array(problem.bounds).T
    known: dict[bytes, sd.Evaluation] = {}

    def at(unit: np.ndarray) -> sd.Evaluation:
        x = np.clip(low + unit * (high - low), low, high)
        if x.tobytes() not in known:
            known[x.tobytes()] = problem.evaluate(x)
        return known[x.tobytes()]

    last: list[tuple[np.ndarray, np.ndarray]] = []

    def rows(v: np.ndarray) -> np.ndarray:
        """Objectives above t, and limits, all 0 or more."""
        e = at(v[:-1])
        if e.refused is None:
            margins: np.ndarray = np.concatenate([np.array(e.objectives) - v[-1], e.limits])
            last[:] = [(v, margins)]
            return margins
        if not last:
            return np.full(len(problem.objectives) + len(problem.limits), -1.0)
        # No clutch there: the farther from the last one, the worse, so that a line search turns back.
        there, held = last[0]
        worse: np.ndarray = np.minimum(held, 0.0) - float(np.linalg.norm(v - there))
        return worse

    begin = (np.array(problem.start) - low) / (high - low)
    start = at(begin)
    found = minimize(
        lambda v: -v[-1],
        [*begin, start.least],
        jac=lambda v: np.array([*np.zeros(len(low)), -1.0]),
        constraints={"type": "ineq", "fun": rows},
        bounds=[(0.0, 1.0)] * len(low) + [(-1.0, 10.0)],
        method="SLSQP",
        options={"maxiter": 6 if quick else 100, "eps": 1e-3},
    )
    # The best that holds every limit, whatever the optimiser ended with.
    best = max((e for e in known.values() if e.feasible), key=lambda e: e.least, default=start)
    print(found.message, f"({len(known)} evaluations)")
    print({v.name: float(x) for v, x in zip(problem.variables, best.x, strict=True)})
    print(f"least objective {start.least:.5f} -> {best.least:.5f}")


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit("usage: python with_scipy.py DESIGN.toml [--quick]")
    main(sys.argv[1], "--quick" in sys.argv)
