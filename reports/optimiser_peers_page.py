#!/usr/bin/env python3
"""reports/optimiser-peers.html from reports/optimiser-peers.csv and its courses; part of reports/optimiser_peers.sh.

usage: optimiser_peers_page.py TOOL OUT COMMAND DESIGN...
"""
import csv
import html
import io
import json
import os
import subprocess
import sys
import tempfile
from importlib.metadata import version

import matplotlib

matplotlib.use("svg")
matplotlib.rcParams.update({"svg.hashsalt": "sprag-design", "font.size": 9, "svg.fonttype": "none"})
import matplotlib.pyplot as plt  # noqa: E402

TOOL, OUT, COMMAND, *DESIGNS = sys.argv[1:]
OURS = "sprag-design optimize, 1 thread"
PAIR = "sprag-design optimize, 2 threads"
GLOBAL = "scipy differential evolution"
# Column that is known here alone, by the courses: read by reports/cost.py.
NEAR = "until_within_0.1_percent"
# That of the pages of all commands; numbers are on the right, ours are marked, and pictures stay dark on light.
with open(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "src", "report", "page.css")) as style:
    STYLE = style.read() + """td, th { text-align: right; }
td:first-child, th:first-child { text-align: left; }
tr.ours { background: var(--tint); font-weight: 600; }
figure svg { background: #ffffff; }
"""


def about(design):
    """Variables, rows and hash of a problem."""
    done = subprocess.run([TOOL, "evaluate", design, "--describe", "--quiet"], input="", capture_output=True, text=True,
                          check=True)
    return json.loads(done.stdout.splitlines()[0])


def gap(best, value):
    return (best - value) / abs(best)


def table(rows, best):
    out = ["<div class=table><table><tr><th>method</th><th>evaluations</th><th>of them until within 0.1 % of the best</th>"
           "<th>slip margin found</th><th>below the best, %</th><th>time, s</th></tr>"]
    for r in rows:
        found = r["objective"]
        cells = ([f"{float(found):.7f}", f"{100 * gap(best, float(found)):.2g}"] if found else ["none feasible", "–"])
        near = next((n for n, v in r["course"] if gap(best, v) <= 1e-3), "never" if r["course"] else "")
        r[NEAR] = near
        out.append(f"<tr{' class=ours' if r['method'] in (OURS, PAIR) else ''}><td>{html.escape(r['method'])}</td>"
                   f"<td>{r['evaluations']}</td><td>{'–' if near == 'never' else near}</td>"
                   f"<td>{cells[0]}</td><td>{cells[1]}</td><td>{float(r['time_s']):.0f}</td></tr>")
    return "".join(out) + "</table></div>"


def robust(design):
    """What the tolerances do to the optimum, and what the design gives up that holds every limit at every corner."""
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run([TOOL, "optimize", design, "-o", os.path.join(folder, "new.toml"), "--json", "--quiet", "--step-mm", "0",
                               "--robust"], capture_output=True, text=True)
    found = json.loads(done.stdout)
    made, held = found["tolerances"], found["robust"]["made"]
    out = ["<div class=table><table><tr><th>within the tolerances of the file</th><th>as drawn</th><th>worst corner</th><th>1 %</th>"
           "<th>50 %</th><th>draws that hold every limit</th></tr>"]
    for name, m in (("optimum", made), ("optimum that holds every limit at every corner", held)):
        o = m["objective"]
        out.append(f"<tr><td>{name}</td>" + "".join(f"<td>{o[k]:.4f}</td>" for k in ("nominal", "worst", "p01", "p50"))
                   + f"<td>{100 * m['yield']:.0f} %</td></tr>")
    broken = [f"{r['code']} {r['worst']:.3g}" for r in made["margins"] if r["worst"] < 0]
    note = (f"Of {made['corners']} corners and {made['draws']} draws (seed {made['seed']}). Limits of the optimum that the "
            f"tolerances break, at their worst corner: {', '.join(broken) or 'none'}.")
    return "".join(out) + f"</table></div><p>{html.escape(note)}</p>"


def fidelities(design):
    """One climb by the error allowed in an evaluation, with what a scene cannot feel left out, and with everything."""
    rows = []
    for full in (False, True):
        for tolerance in ("1e-3", "1e-4", "1e-5", "1e-6", "1e-8"):
            with tempfile.TemporaryDirectory() as folder:
                done = subprocess.run([TOOL, "optimize", design, "-o", os.path.join(folder, "new.toml"), "--json", "--quiet", "--step-mm", "0",
                                       "--starts", "1", "--threads", "1", "--tolerance", tolerance]
                                      + ["--full"] * full, capture_output=True, text=True)
            d = json.loads(done.stdout)
            moved = max(abs(c["change"]) for c in d["change_in_full"])
            rows.append((tolerance, full, d["best"]["objective"], d["error_estimate"], moved, d["evaluations"],
                         1e3 * d["run_time_s"] / d["evaluations"], d["run_time_s"]))
    sharpest = rows[-1][2]
    out = ["<div class=table><table><tr><th>error allowed in the search</th><th>model in the search</th><th>optimum, looked at in full</th>"
           "<th>off the sharpest, %</th><th>objective moves when looked at in full</th><th>any margin moves</th>"
           "<th>evaluations</th><th>ms each</th><th>time, s</th></tr>"]
    for tolerance, full, objective, own, moved, count, each, seconds in rows:
        out.append(f"<tr><td>{tolerance}</td><td>{'everything' if full else 'reduced'}</td><td>{objective:.7f}</td>"
                   f"<td>{100 * abs(gap(sharpest, objective)):.1g}</td><td>{own:.1e}</td><td>{moved:.1e}</td><td>{count}</td>"
                   f"<td>{each:.0f}</td><td>{seconds:.1f}</td></tr>")
    return "".join(out) + "</table></div>"


def picture(rows, best):
    figure, axes = plt.subplots(figsize=(8, 3.4))
    for r in rows:
        if not r["course"]:
            if r["objective"]:
                axes.plot(int(r["evaluations"]), max(100 * gap(best, float(r["objective"])), 1e-6), "k*", ms=11,
                          label=r["method"], zorder=9)
            continue
        x = [n for n, _ in r["course"]] + [int(r["evaluations"])]
        y = [max(100 * gap(best, v), 1e-6) for _, v in r["course"]]
        axes.step(x, y + y[-1:], where="post", label=r["method"])
    axes.axhline(0.1, color="grey", lw=0.7, ls="--")
    axes.set(xscale="log", yscale="log", xlabel="design evaluations", ylabel="below the best found by any, %",
             ylim=(5e-7, 200))
    axes.legend(fontsize=7, loc="lower left")
    out = io.StringIO()
    figure.savefig(out, format="svg", bbox_inches="tight", metadata={"Date": None})
    plt.close(figure)
    return figured(out.getvalue()[out.getvalue().index("<svg"):])


def figured(svg):
    return (f"<figure>{svg}<figcaption>How far the best design so far lies below the best that any method found, over the "
            "evaluations spent; dashed: 0.1 %. A star: a method without a course, at its end.</figcaption></figure>")


def main():
    with open(OUT + ".csv", newline="") as f:
        found = list(csv.DictReader(f))
    courses = {}
    with open(OUT + "-courses.jsonl") as f:
        for text in f:
            if not text.startswith("["):
                continue  # a method's own complaint
            name, method, course = json.loads(text)
            courses[name, method] = course
    parts, verdicts, hashes, distances, spent, measured, opening = [], [], [], [], [], [], ""
    for design in DESIGNS:
        name = os.path.splitext(os.path.basename(design))[0]
        problem = about(design)
        hashes.append(f"{name} {problem['design_hash'][:12]}")
        rows = [dict(r, course=courses.get((name, r["method"]), [])) for r in found if r["problem"] == name]
        best = max(float(r["objective"]) for r in rows if r["objective"])
        ours = next(r for r in rows if r["method"] == OURS)
        other = next(r for r in rows if r["method"] == GLOBAL)
        off = 100 * gap(float(other["objective"]), float(ours["objective"])) if other["objective"] else float("-inf")
        measured += rows
        verdicts.append(f"<li>{html.escape(problem['design'])}: ours {float(ours['objective']):.6f} in "
                        f"{ours['evaluations']} evaluations; {GLOBAL} {float(other['objective']):.6f} in "
                        f"{other['evaluations']}: ours is {abs(off):.2g} % {'below' if off > 0 else 'above'} it.</li>")
        distances.append(off)
        spent.append((int(ours["evaluations"]), int(other["evaluations"])))
        pair = next(r for r in rows if r["method"] == PAIR)
        same = "the same to the last digit" if pair["objective"] == ours["objective"] else "NOT the same"
        threads = (f"{ours['starts']} climbs met {ours['optima']} {'optimum' if ours['optima'] == '1' else 'optima'}; none took more than {ours['most_in_a_start']} "
                   f"evaluations. Two threads end at {same}, {float(ours['time_s']) / float(pair['time_s']):.2f} times sooner.")
        v = ", ".join(f"{x['name']} {x['min']:g} to {x['max']:g}" for x in problem["variables"])
        drawn = picture(rows, best)
        if not opening:
            # The first opens the page.
            opening, drawn = drawn.replace("<figcaption>", f"<figcaption>{html.escape(problem['design'])}. ", 1), ""
        parts.append(f"<h2>{html.escape(problem['design'])}</h2><p>Free: {html.escape(v)}. Objectives (the least is "
                     f"maximised): {html.escape(', '.join(problem['objectives']))}. Limits: {len(problem['limits'])}."
                     f"</p>{drawn}{table(rows, best)}<p>{html.escape(threads)}</p>"
                     f"<details class=apart><summary>Tolerances, and error against run time</summary>{robust(design)}"
                     f"<p>Error against run time by what is left out of an evaluation (one climb from the file's start, one "
                     f"thread; the default allows 1e-6 and leaves out what a scene cannot feel):</p>{fidelities(design)}</details>")
    first = f"sprag-design {problem['version']}; designs {', '.join(hashes)}; {COMMAND}"
    fewest, most = min(n for n, _ in spent), max(n for n, _ in spent)
    said = (f"optimize ends above what {GLOBAL} finds or within {max(distances + [0.0]):.7f} % of it on all {len(distances)} problems, "
            f"after {fewest} to {most} evaluations against {max(n for _, n in spent)}.")
    page = f"""<!-- {html.escape(first)} -->
<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>Optimisers on one evaluator</title>
<style>
{STYLE}</style>
</head>
<body>
<main>
<header>
<p class="kind">Optimisers on one evaluator</p>
<h1>optimize beside scipy, pymoo, basin and cobyla</h1>
<dl><dt>Designs</dt><dd>{html.escape(", ".join(hashes))}</dd><dt>Command</dt><dd><code>{html.escape(COMMAND)}</code></dd>
<dt>Made by</dt><dd>sprag-design {problem['version']}</dd></dl>
</header>
<p class="verdict said">{html.escape(said)}</p>
{opening}
<p>{len(distances)} problems, the same evaluator for all (<code>sprag-design evaluate</code>: every scenario's slip margin and
every limit at one vector). Bounds are mapped to a unit box. A point asked for twice counts once. The value counts only
where no limit is violated.</p><ul>{''.join(verdicts)}</ul>{''.join(parts)}
<h2>How each was run</h2><ul>
<li>sprag-design optimize: as a user runs it, but for the number of threads and `--step-mm 0`, no rounding, which the others do not do either; its evaluations are those of all
starts, the finish and the influence table together. Beside them it takes derivatives of all margins along single variables, at
some 0.45 of an evaluation each in time (<code>examples/cost.rs</code>): column <code>derivatives</code> of the CSV.</li>
<li>{GLOBAL}: scipy {version('scipy')}, Sobol start, seed 1, feasibility first, then the objective; stopped at the
number of evaluations given.</li>
<li>pymoo genetic algorithm: pymoo {version('pymoo')}, population 60, seed 1, constraints as its own rule treats them,
a quarter of that number.</li>
<li>COBYLA and SLSQP of scipy, COBYLA and SLSQP of basin 3.2, COBYLA of cobyla 1.0: epigraph form (maximise t, every
objective at least t, every limit at least 0), from the file's start and four spread points, at most 3000 evaluations
for all five; differences of SLSQP 1e-5 of the range, simplex 0.1 to 1e-6 of the range.</li></ul>
<h2>Omissions</h2><ul>
<li>No method was tuned; each has the settings above on all three problems.</li>
<li>Time is wall time on a machine that did other work, through a pipe for all but ours: compare evaluations.</li>
<li>The best value is the best that any of these found, not proved to be the greatest there is.</li>
<li>Ours goes on with new starts until no other optimum is to be expected; the stochastic ones use up their budget.</li></ul>
</main>
</body>
</html>
"""
    with open(OUT + ".html.new", "w") as f:
        f.write(page)
    os.replace(OUT + ".html.new", OUT + ".html")
    columns = [c for c in found[0] if c != NEAR] + [NEAR]
    with open(OUT + ".csv.new", "w", newline="") as f:
        w = csv.DictWriter(f, columns, extrasaction="ignore", restval="", lineterminator="\n")
        w.writeheader()
        w.writerows(measured)
    os.replace(OUT + ".csv.new", OUT + ".csv")


main()
