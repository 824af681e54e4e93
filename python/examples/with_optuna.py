"""Optuna's sampler (from 5.0 on) on the margins of a design; limits are its constraints.

    python with_optuna.py designs/huang2017-multi-arc.toml
"""

from __future__ import annotations

import sys

import optuna

import sprag_design as sd


def main(path: str, quick: bool) -> None:
    problem = sd.Design.load(path).problem()
    start = problem.evaluate(problem.start)

    def suggested(trial: optuna.Trial, v: sd.Variable) -> float:
        return trial.suggest_int(v.name, int(v.min), int(v.max)) if v.whole else trial.suggest_float(v.name, v.min, v.max)

    def objective(trial: optuna.Trial) -> float:
        x = [suggested(trial, v) for v in problem.variables]
        e = problem.evaluate(x)
        if e.refused is not None:
            raise optuna.TrialPruned(e.refused)
        for name, limit in zip(problem.limits, e.limits, strict=True):
            trial.set_constraint(name, -limit)
        trial.set_user_attr("feasible", e.feasible)
        return e.least

    optuna.logging.set_verbosity(optuna.logging.WARNING)
    sampler = optuna.samplers.TPESampler(seed=1, multivariate=True)
    study = optuna.create_study(direction="maximize", sampler=sampler)
    study.enqueue_trial({v.name: int(v.start) if v.whole else v.start for v in problem.variables})
    study.optimize(objective, n_trials=120 if quick else 1000)
    held = [t for t in study.trials if t.user_attrs.get("feasible") and t.value is not None]
    best = max(held, key=lambda t: t.value or 0.0)
    print(best.params)
    print(f"least objective {start.least:.5f} -> {best.value:.5f}")


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit("usage: python with_optuna.py DESIGN.toml [--quick]")
    main(sys.argv[1], "--quick" in sys.argv)
