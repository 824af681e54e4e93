"""A clutch as a component of OpenMDAO, with partials by differences.

    python with_openmdao.py designs/huang2017-multi-arc.toml
"""

from __future__ import annotations

import os
import sys
from typing import Any

os.environ.setdefault("OPENMDAO_REPORTS", "0")

import numpy as np
import openmdao.api as om

import sprag_design as sd


class Clutch(om.ExplicitComponent):  # type: ignore[misc]
    """Variables of ``[optimize]``, each from 0 to 1 over its range, in; objectives and limits out."""

    def __init__(self, problem: sd.Problem) -> None:
        super().__init__()
        self.problem = problem
        self.low, high = np.array(problem.bounds).T
        self.range = high - self.low

    def setup(self) -> None:
        self.add_input("x", val=(np.array(self.problem.start) - self.low) / self.range)
        self.add_output("objectives", shape=len(self.problem.objectives))
        self.add_output("limits", shape=len(self.problem.limits))
        self.add_output("least", val=0.0)

    def setup_partials(self) -> None:
        # Margins are smooth to 1e-8 or so: a step of a thousandth of the range is well above that.
        self.declare_partials("*", "x", method="fd", step=1e-3)

    def compute(self, inputs: Any, outputs: Any, *_: Any) -> None:
        x = np.clip(inputs["x"], 0.0, 1.0) * self.range + self.low
        e = self.problem.evaluate(np.clip(x, *np.array(self.problem.bounds).T))
        if e.refused is not None:
            raise om.AnalysisError(e.refused)
        outputs["objectives"], outputs["limits"], outputs["least"] = e.objectives, e.limits, e.least


def main(path: str, quick: bool) -> None:
    problem = sd.Design.load(path).problem()
    whole = [v.name for v in problem.variables if v.whole]
    if whole:
        sys.exit(f"SLSQP knows no whole numbers: take {', '.join(whole)} out of [optimize] variables, or with_optuna.py")
    model = om.Problem(reports=False)
    clutch = model.model.add_subsystem("clutch", Clutch(problem), promotes=["*"])
    # t is made largest while no objective lies below it.
    start = problem.evaluate(problem.start)
    model.model.add_subsystem("t", om.IndepVarComp("t", start.least), promotes=["*"])
    above = om.ExecComp("above = objectives - t", above={"shape": len(problem.objectives)}, objectives={"shape": len(problem.objectives)})
    model.model.add_subsystem("over", above, promotes=["*"])
    model.model.add_design_var("x", lower=0.0, upper=1.0)
    model.model.add_design_var("t", lower=-1.0, upper=10.0)
    model.model.add_constraint("limits", lower=0.0)
    model.model.add_constraint("above", lower=0.0)
    model.model.add_objective("t", scaler=-1.0)
    model.driver = om.ScipyOptimizeDriver(optimizer="SLSQP", disp=False, maxiter=6 if quick else 100)
    model.setup()
    model.run_driver()
    x = model.get_val("x") * clutch.range + clutch.low
    best = problem.evaluate(np.clip(x, *np.array(problem.bounds).T))
    print({v.name: float(value) for v, value in zip(problem.variables, best.x, strict=True)}, "violation", best.violation)
    print(f"least objective {start.least:.5f} -> {best.least:.5f}")


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit("usage: python with_openmdao.py DESIGN.toml [--quick]")
    main(sys.argv[1], "--quick" in sys.argv)
