"""Optuna's sampler on the margins of a design; limits are its constraints.

    python with_optuna.py designs/huang2017-multi-arc.toml
"""

from __future__ import annotations

import sys

import optuna

import sprag_design as sd


def main(path: str, quick: bool) -> None:
    problem = sd.Design.load(path).problem()
    start = problem.evaluate(problem.start)

    def objective(trial: optuna.Trial) -> float:
        x = [trial.suggest_float(v.name, v.min, v.max) for v in problem.variables]
        e = problem.evaluate(x)
        if e.refused is not None:
            raise optuna.TrialPruned(e.refused)
        trial.set_user_attr("violations", [-limit for limit in e.limits])
        trial.set_user_attr("feasible", e.feasible)
        return e.least

    def violations(trial: optuna.trial.FrozenTrial) -> list[float]:
        return list(trial.user_attrs.get("violations", [1.0] * len(problem.limits)))

    optuna.logging.set_verbosity(optuna.logging.WARNING)
    sampler = optuna.samplers.TPESampler(seed=1, constraints_func=violations, multivariate=True)
    study = optuna.create_study(direction="maximize", sampler=sampler)
    study.enqueue_trial({v.name: v.start for v in problem.variables})
    study.optimize(objective, n_trials=120 if quick else 1000)
    held = [t for t in study.trials if t.user_attrs.get("feasible") and t.value is not None]
    best = max(held, key=lambda t: t.value or 0.0)
    print(best.params)
    print(f"least objective {start.least:.5f} -> {best.value:.5f}")


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit("usage: python with_optuna.py DESIGN.toml [--quick]")
    main(sys.argv[1], "--quick" in sys.argv)
