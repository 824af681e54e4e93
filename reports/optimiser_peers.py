#!/usr/bin/env python3
"""Other optimisers on the evaluator of `sprag-design optimize`, on three design files.

Runs scipy (differential evolution, COBYLA, SLSQP) and pymoo (genetic algorithm) through `sprag-design evaluate`, and
our own search through `sprag-design optimize`; reads what peers/ (basin, cobyla) wrote. Writes
reports/optimiser-peers.csv and reports/optimiser-peers.html. Made by reports/optimiser_peers.sh, outside CI.
"""
import csv
import json
import math
import os
import subprocess
import sys
import tempfile
import time

import numpy as np

TOOL, OUT, MOST = sys.argv[1], sys.argv[2], int(sys.argv[3])
DESIGNS = sys.argv[4:]
SEED = 1


class Evaluator:
    """One `sprag-design evaluate` process; counts, remembers and keeps the course of the best feasible value."""

    def __init__(self, design):
        self.process = subprocess.Popen([TOOL, "evaluate", design, "--describe", "--quiet"], text=True,
                                        stdin=subprocess.PIPE, stdout=subprocess.PIPE, bufsize=1)
        self.about = json.loads(self.process.stdout.readline())
        v = self.about["variables"]
        self.lo, self.hi = np.array([x["min"] for x in v]), np.array([x["max"] for x in v])
        self.start = np.clip(np.array([x["start"] for x in v]), self.lo, self.hi)
        self.forget()

    def forget(self):
        self.count, self.best, self.best_x, self.course, self.known = 0, -math.inf, None, [], {}
        self.begun = time.perf_counter()

    def at(self, unit):
        """Answer at a point of the unit box; a point asked for twice costs nothing."""
        x = self.lo + np.clip(np.asarray(unit, float), 0.0, 1.0) * (self.hi - self.lo)
        key = x.tobytes()
        if key not in self.known:
            self.process.stdin.write(json.dumps(list(map(float, x))) + "\n")
            self.process.stdin.flush()
            found = json.loads(self.process.stdout.readline())
            self.known[key] = found
            self.count += 1
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

    def unit_start(self):
        return (self.start - self.lo) / (self.hi - self.lo)


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

    minimize(Problem(), GA(pop_size=60), ("n_eval", MOST // 4), seed=SEED, verbose=False)


def local(method):
    def go(ev):
        """Epigraph form: maximise t with every objective at least t, every limit at least 0; ten starts."""
        from scipy.optimize import minimize
        from scipy.stats import qmc
        n = len(ev.lo)
        starts = [ev.unit_start()] + list(qmc.Sobol(n, seed=SEED).random(4))
        for u0 in starts:
            first = ev.at(u0)
            if "refused" in first:
                continue
            rows = len(first["objectives"]) + len(first["limits"])

            def g(z):
                limited(ev, 3000, None)
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
                               "--threads", str(threads), "--journal", journal], capture_output=True, text=True)
        seconds = time.perf_counter() - begun
        with open(journal, newline="") as f:
            return json.loads(done.stdout), seconds, course_of(csv.DictReader(f))


def course_of(journal):
    """The best feasible value so far over the evaluations of a journal; derivatives are not among these."""
    course = []
    for k, row in enumerate(journal, 1):
        if row["outcome"] == "ok" and min(map(float, row["limits"].split(";"))) >= -1e-8:
            value = min(map(float, row["objectives"].split(";")))
            if not course or value > course[-1][1]:
                course.append((k, value))
    return course


def main():
    rows, courses = [], {}
    for design in DESIGNS:
        name = os.path.splitext(os.path.basename(design))[0]
        for threads in (1, 2):
            found, seconds, course = ours(design, threads)
            best = found.get("best") or {}
            starts = [s["evaluations"] for s in found["starts"]]
            method = f"sprag-design optimize, {threads} thread{'s' * (threads > 1)}"
            rows.append((name, method, found["evaluations"], seconds, best.get("objective"), len(starts), max(starts),
                         found["optima"]["seen"], found["derivatives"]))
            courses[name, method] = course
            print(rows[-1], file=sys.stderr, flush=True)
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
    path = OUT + ".csv"
    with open(path + ".new", "w", newline="") as f:
        w = csv.writer(f)
        w.writerow(["problem", "method", "evaluations", "time_s", "objective", "starts", "most_in_a_start", "optima", "derivatives"])
        w.writerows(rows)
    os.replace(path + ".new", path)
    with open(OUT + "-courses.jsonl", "w") as f:
        for (name, method), course in courses.items():
            f.write(json.dumps([name, method, course]) + "\n")


main()
