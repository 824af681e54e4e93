#!/usr/bin/env python3
"""Other optimisers on the evaluator of `sprag-design optimize`.

Runs scipy (differential evolution, COBYLA, SLSQP) and pymoo (genetic algorithm) through `sprag-design evaluate`, and
our own search through `sprag-design optimize`. Writes reports/optimiser-peers.csv and courses beside it, for
optimiser_peers_page.py. Made by reports/optimiser_peers.sh, outside CI.

usage: optimiser_peers.py TOOL OUT EVALUATIONS ours|peers DESIGN...

A design whose name ends in -robust is held at every corner of its tolerances: an evaluation of it counts for each.
"""
import csv
import json
import math
import os
import re
import subprocess
import sys
import tempfile
import time

import numpy as np

TOOL, OUT, MOST, WHO = sys.argv[1], sys.argv[2], int(sys.argv[3]), sys.argv[4]
DESIGNS = sys.argv[5:]
SEED = 1


def is_robust(design):
    return design.removesuffix(".toml").endswith("-robust")


class Evaluator:
    """One `sprag-design evaluate` process; counts, remembers and keeps the course of the best feasible value."""

    def __init__(self, design):
        self.process = subprocess.Popen([TOOL, "evaluate", design, "--describe", "--quiet"] + ["--robust"] * is_robust(design),
                                        text=True, stdin=subprocess.PIPE, stdout=subprocess.PIPE, bufsize=1)
        self.about = json.loads(self.process.stdout.readline())
        v = self.about["variables"]
        self.whole = np.array([x["whole"] for x in v])
        # Clutches that one answer looks at: each has its objectives.
        self.each = len(self.about["objectives"]) // len({name.split(" @ ")[0] for name in self.about["objectives"]})
        self.lo, self.hi = np.array([x["min"] for x in v]), np.array([x["max"] for x in v])
        self.start = np.clip(np.array([x["start"] for x in v]), self.lo, self.hi)
        self.forget()

    def forget(self):
        self.count, self.best, self.best_x, self.course, self.known = 0, -math.inf, None, [], {}
        self.begun = time.perf_counter()

    def at(self, unit):
        """Answer at a point of the unit box; a point asked for twice costs nothing."""
        unit = np.clip(np.asarray(unit, float), 0.0, 1.0)
        # Of a whole number each value has an equal share of the unit.
        steps = np.minimum(np.floor(unit * (self.hi - self.lo + 1.0)), self.hi - self.lo)
        x = self.lo + np.where(self.whole, steps, unit * (self.hi - self.lo))
        key = x.tobytes()
        if key not in self.known:
            self.process.stdin.write(json.dumps(list(map(float, x))) + "\n")
            self.process.stdin.flush()
            found = json.loads(self.process.stdout.readline())
            self.known[key] = found
            self.count += self.each
            if found.get("feasible") and found["least"] > self.best:
                self.best, self.best_x = found["least"], x
                self.course.append((self.count, self.best))
        return self.known[key]

    def rule(self, unit):
        """Feasibility first, then the objective: what methods without constraints minimise."""
        found = self.at(unit)
        if "refused" in found:
            return 1e3
        return -found["least"] if found["feasible"] else 10.0 + found["violation"]

    def unit_of(self, x):
        return np.where(self.whole, (x - self.lo + 0.5) / (self.hi - self.lo + 1.0), (x - self.lo) / (self.hi - self.lo))

    def unit_start(self):
        return self.unit_of(self.start)

    def starts(self):
        """The file's start and four spread points; with a whole number the file's start at each of its values, outwards."""
        from scipy.stats import qmc
        if not self.whole.any():
            return [self.unit_start()] + list(qmc.Sobol(len(self.lo), seed=SEED).random(4))
        at = int(np.argmax(self.whole))
        values = sorted(np.arange(self.lo[at], self.hi[at] + 1.0), key=lambda v: abs(v - self.start[at]))
        return [self.unit_of(np.where(np.arange(len(self.lo)) == at, v, self.start)) for v in values]


class Enough(Exception):
    """The allowed evaluations are used up."""


def limited(ev, most, what):
    if ev.count >= most:
        raise Enough
    return what


def differential_evolution(ev):
    from scipy.optimize import differential_evolution as de
    n = len(ev.lo)
    population = max(5, min(15, 60 // n))

    def f(u):
        limited(ev, MOST, None)
        return ev.rule(u)

    try:
        de(f, [(0.0, 1.0)] * n, popsize=population, maxiter=10**6, tol=1e-12, atol=0.0, polish=False, rng=SEED,
           init="sobol")
    except Enough:
        pass


def genetic(ev):
    from pymoo.algorithms.soo.nonconvex.ga import GA
    from pymoo.core.problem import ElementwiseProblem
    from pymoo.optimize import minimize
    limits = len(ev.at(ev.unit_start()).get("limits", [])) or 1

    class Problem(ElementwiseProblem):
        def __init__(self):
            super().__init__(n_var=len(ev.lo), n_obj=1, n_ieq_constr=limits, xl=0.0, xu=1.0)

        def _evaluate(self, u, out, *args, **kwargs):
            found = ev.at(u)
            refused = "refused" in found
            out["F"] = 1e3 if refused else -found["least"]
            out["G"] = [1e3] * limits if refused else [-g for g in found["limits"]]

    minimize(Problem(), GA(pop_size=60), ("n_eval", MOST // 4 // ev.each), seed=SEED, verbose=False)


def local(method):
    def go(ev):
        """Epigraph form: maximise t with every objective at least t, every limit at least 0; five starts."""
        from scipy.optimize import minimize
        n = len(ev.lo)
        for u0 in ev.starts():
            first = ev.at(u0)
            if "refused" in first:
                continue
            rows = len(first["objectives"]) + len(first["limits"])

            def g(z):
                limited(ev, 3000 * ev.each, None)
                found = ev.at(z[:n])
                if "refused" in found:
                    return np.full(rows, -10.0)
                return np.array([o - z[n] for o in found["objectives"]] + found["limits"])

            settings = ({"rhobeg": 0.1, "maxiter": 600, "tol": 1e-6} if method == "COBYLA"
                        else {"eps": 1e-5, "maxiter": 100, "ftol": 1e-9})
            tol = settings.pop("tol", None)
            try:
                minimize(lambda z: -z[n], np.append(u0, first["least"]), method=method, tol=tol,
                         bounds=[(0.0, 1.0)] * n + [(-5.0, 5.0)],
                         constraints=[{"type": "ineq", "fun": g}], options=settings)
            except Enough:
                break
    return go


METHODS = [("scipy differential evolution", differential_evolution), ("pymoo genetic algorithm", genetic),
           ("scipy COBYLA, 5 starts", local("COBYLA")), ("scipy SLSQP, 5 starts", local("SLSQP"))]


def ours(design, threads):
    with tempfile.TemporaryDirectory() as folder:
        journal = os.path.join(folder, "journal.csv")
        begun = time.perf_counter()
        done = subprocess.run([TOOL, "optimize", design, "-o", os.path.join(folder, "new.toml"), "--json", "--quiet", "--step-mm", "0",
                               "--threads", str(threads), "--journal", journal, *["--robust"] * is_robust(design)],
                              capture_output=True, text=True)
        seconds = time.perf_counter() - begun
        return json.loads(done.stdout), seconds


def spent(found, derivative):
    """Evaluations of a search, its derivatives at their cost; of a robust one without the draws that follow it."""
    robust = found.get("robust")
    made = robust["made"] if robust else {"draws": 0, "corners": -1}
    beside = robust["evaluations"] - made["draws"] - made["corners"] - 1 if robust else 0
    along = found["derivatives"] + (robust["derivatives"] if robust else 0)
    return found["evaluations"] + derivative * along + beside


def courses_of_ours(design):
    """The course of `optimize` on one thread over evaluations and derivatives, from examples/cost.rs."""
    cost = os.path.join(os.path.dirname(TOOL), "examples", "cost")
    done = subprocess.run([cost, "robust" if is_robust(design) else "course", design], capture_output=True, text=True, check=True)
    return [json.loads(line) for line in done.stdout.splitlines()]


def cost_of_a_derivative(design, variables):
    """In evaluations, by instructions."""
    cost = os.path.join(os.path.dirname(TOOL), "examples", "cost")

    def instructions(along, times):
        done = subprocess.run(["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", cost, "slopes", design,
                               str(along), str(times)], capture_output=True, text=True, check=True)
        return float(re.search(r"Collected : (\d+)", done.stderr).group(1))

    once = instructions(0, 3) - instructions(0, 1)
    return (instructions(variables, 3) - instructions(variables, 1) - once) / once / variables


def main():
    rows, courses = [], {}
    for design in DESIGNS:
        name = os.path.splitext(os.path.basename(design))[0]
        if WHO == "ours":
            for threads in (1, 2):
                found, seconds = ours(design, threads)
                continuous = {v["name"] for v in json.loads(subprocess.run(
                    [TOOL, "evaluate", design, "--describe", "--quiet"], input="", capture_output=True, text=True,
                    check=True).stdout.splitlines()[0])["variables"] if not v["whole"]}
                free = len(continuous - set(found["dropped_variables"]))
                derivative = cost_of_a_derivative(design, free) if threads == 1 else derivative
                best = found["robust"]["made"]["objective"]["worst"] if found.get("robust") else found["best"]["objective"]
                starts = [s["evaluations"] for s in found["starts"]]
                method = f"sprag-design optimize, {threads} thread{'s' * (threads > 1)}"
                rows.append((name, method, spent(found, derivative), seconds, best, len(starts), max(starts),
                             found["optima"]["seen"], found["derivatives"], derivative))
                if threads == 1:
                    course = [(n + derivative * d, v) for n, d, v in courses_of_ours(design)]
                courses[name, method] = course
                print(rows[-1], file=sys.stderr, flush=True)
                write(rows, courses)
            continue
        ev = Evaluator(design)
        for method, go in METHODS:
            ev.forget()
            go(ev)
            rows.append((name, method, ev.count, time.perf_counter() - ev.begun,
                         None if ev.best_x is None else ev.best))
            courses[name, method] = ev.course
            write(rows, courses)
            print(rows[-1], file=sys.stderr, flush=True)


def write(rows, courses):
    """What is known so far: a run of an hour that is stopped loses one method."""
    path = f"{OUT}-{WHO}.csv"
    with open(path + ".new", "w", newline="") as f:
        w = csv.writer(f, lineterminator="\n")
        w.writerow(["problem", "method", "evaluations", "time_s", "objective", "starts", "most_in_a_start", "optima", "derivatives",
                    "derivative_cost"])
        w.writerows(rows)
    os.replace(path + ".new", path)
    with open(f"{OUT}-{WHO}-courses.jsonl", "w") as f:
        for (name, method), course in courses.items():
            f.write(json.dumps([name, method, course]) + "\n")


main()
