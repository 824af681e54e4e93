#!/usr/bin/env python3
"""reports/optimiser-peers.{csv,html} from what each method found and its courses; part of reports/optimiser_peers.sh.

usage: optimiser_peers_page.py TOOL OUT WORK COMMAND DESIGN...
"""
import csv
import html
import io
import json
import os
import subprocess
import sys
from importlib.metadata import version

import matplotlib

matplotlib.use("svg")
matplotlib.rcParams.update({"svg.hashsalt": "sprag-design", "font.size": 9, "svg.fonttype": "none"})
import matplotlib.pyplot as plt  # noqa: E402

TOOL, OUT, WORK, COMMAND, *DESIGNS = sys.argv[1:]
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


def until_near(row, best):
    """Evaluations until the course is within 0.1 % of the best; `None`: never."""
    return next((n for n, v in row["course"] if gap(best, v) <= 1e-3), None)


def is_ours(row):
    return row["method"] in (OURS, PAIR)


def table(rows, best):
    out = ["<div class=table><table><tr><th>method</th><th>evaluations</th><th>of them until within 0.1 % of the best</th>"
           "<th>slip margin found</th><th>below the best, %</th></tr>"]
    for r in rows:
        found = r["objective"]
        cells = ([f"{float(found):.7f}", f"{100 * gap(best, float(found)):.2g}"] if found else ["none feasible", "–"])
        near = until_near(r, best)
        r[NEAR] = "never" if near is None else f"{near:.1f}".removesuffix(".0")
        out.append(f"<tr{' class=ours' if is_ours(r) else ''}><td>{html.escape(r['method'])}</td>"
                   f"<td>{float(r['evaluations']):.0f}</td><td>{'–' if near is None else r[NEAR]}</td>"
                   f"<td>{cells[0]}</td><td>{cells[1]}</td></tr>")
    return "".join(out) + "</table></div>"


def overview(problems):
    """Evaluations until within 0.1 % of the best, problem by problem: a dot for each method, ours filled."""
    figure, axes = plt.subplots(figsize=(8, 3.2))
    names = sorted({r["method"] for _, rows, _ in problems for r in rows if not is_ours(r)})
    marks = dict(zip(names, "osD^v<>px"))
    for at, (name, rows, best) in enumerate(problems):
        for r in rows:
            near = until_near(r, best)
            if near is None or r["method"] == PAIR:
                continue
            if is_ours(r):
                axes.plot(near, at, "k*", ms=13, label=OURS if at == 0 else None, zorder=9)
            else:
                axes.plot(near, at, marks[r["method"]], mfc="none", mec=f"C{names.index(r['method'])}",
                          label=r["method"] if at == 0 else None)
    axes.set(xscale="log", xlabel="evaluations until within 0.1 % of the best that any method found",
             yticks=range(len(problems)), yticklabels=[name for name, _, _ in problems])
    axes.invert_yaxis()
    axes.grid(axis="x", lw=0.4)
    axes.legend(fontsize=7, loc="center left", bbox_to_anchor=(1.0, 0.5))
    return drawn(figure, "Evaluations until the best design so far is within 0.1 % of the best that any method found; ours with its "
                 "derivatives at their cost. A method without a mark never comes so near.")


def picture(rows, best):
    figure, axes = plt.subplots(figsize=(8, 3.4))
    for r in rows:
        if not r["course"] or r["method"] == PAIR:
            continue
        x = [n for n, _ in r["course"]] + [float(r["evaluations"])]
        y = [max(100 * gap(best, v), 1e-6) for _, v in r["course"]]
        axes.step(x, y + y[-1:], where="post", label=r["method"], lw=2.5 if is_ours(r) else 1.0,
                  color="black" if is_ours(r) else None)
    axes.axhline(0.1, color="grey", lw=0.7, ls="--")
    axes.set(xscale="log", yscale="log", xlabel="design evaluations", ylabel="below the best found by any, %",
             ylim=(5e-7, 200))
    axes.legend(fontsize=7, loc="lower left")
    return drawn(figure, "How far the best design so far lies below the best that any method found, over the evaluations spent; "
                 "dashed: 0.1 %.")


def drawn(figure, caption):
    out = io.StringIO()
    figure.savefig(out, format="svg", bbox_inches="tight", metadata={"Date": None})
    plt.close(figure)
    svg = out.getvalue()[out.getvalue().index("<svg"):]
    return f"<figure>{svg}<figcaption>{caption}</figcaption></figure>"


def read_found():
    """Rows of all methods, and their courses by problem and method."""
    found, courses = [], {}
    for part in sorted(os.listdir(WORK)):
        path = os.path.join(WORK, part)
        if part == "rust.csv":
            with open(path, newline="") as f:
                keys = ("problem", "method", "evaluations", "time_s", "objective")
                found += [dict(zip(keys, row)) for row in csv.reader(f)]
        elif part.endswith(".csv"):
            with open(path, newline="") as f:
                found += list(csv.DictReader(f))
        elif part.endswith(".jsonl"):
            with open(path) as f:
                for text in f:
                    if text.startswith("["):  # else a method's own complaint
                        name, method, course = json.loads(text)
                        courses[name, method] = course
    return found, courses


def main():
    found, courses = read_found()
    parts, hashes, problems, measured = [], [], [], []
    for design in DESIGNS:
        name = os.path.splitext(os.path.basename(design))[0]
        problem = about(design)
        hashes.append(f"{name} {problem['design_hash'][:12]}")
        rows = [dict(r, course=courses.get((name, r["method"]), [])) for r in found if r["problem"] == name]
        rows.sort(key=lambda r: not is_ours(r))
        best = max(float(r["objective"]) for r in rows if r["objective"])
        ours = next(r for r in rows if r["method"] == OURS)
        pair = next(r for r in rows if r["method"] == PAIR)
        problems.append((name, rows, best))
        measured += rows
        same = "the same to the last digit" if pair["objective"] == ours["objective"] else "NOT the same"
        optima = f"{ours['optima']} {'optimum' if ours['optima'] == '1' else 'optima'}"
        said = (f"The whole search: {float(ours['evaluations']):.0f} evaluations with its {ours['derivatives']} derivatives at "
                f"{float(ours['derivative_cost']):.2f} each; {ours['starts']} climbs met {optima}, none took more than "
                f"{ours['most_in_a_start']} evaluations. Two threads end at {same}.")
        absent = sorted({r["method"] for r in found} - {r["method"] for r in rows})
        said += f" Not run on this one: {', '.join(absent)}." if absent else ""
        v = ", ".join(f"{x['name']} {x['min']:g} to {x['max']:g}" for x in problem["variables"])
        parts.append(f"<h2>{html.escape(problem['design'])}</h2><p>Free: {html.escape(v)}. Objectives (the least is "
                     f"maximised): {html.escape(', '.join(problem['objectives']))}. Limits: {len(problem['limits'])}."
                     f"</p>{picture(rows, best)}{table(rows, best)}<p>{html.escape(said)}</p>")
    first = f"sprag-design {problem['version']}; designs {', '.join(hashes)}; {COMMAND}"
    won, told = [], []
    for name, rows, best in problems:
        ours = next(r for r in rows if r["method"] == OURS)
        near = until_near(ours, best)
        others = [(n, r["method"]) for r in rows if not is_ours(r) and (n := until_near(r, best)) is not None]
        fewest = min(others, default=(float("inf"), "none"))
        won += [name] * (near is not None and near < fewest[0])
        told.append(f"<li>{html.escape(name)}: ours {'never' if near is None else f'{near:.1f}'}, the best of the others "
                    f"{fewest[0]:g} ({html.escape(fewest[1])})</li>")
    said = (f"optimize comes within 0.1 % of the best after fewer evaluations than any other method on {len(won)} of "
            f"{len(problems)} problems, its derivatives counted at their cost.")
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
{overview(problems)}
<p>{len(problems)} problems, the same evaluator for all (<code>sprag-design evaluate</code>: every scenario's slip margin and
every limit at one vector). Bounds are mapped to a unit box. A point asked for twice counts once. The value counts only
where no limit is violated. Evaluations until within 0.1 %:</p><ul>{''.join(told)}</ul>{''.join(parts)}
<h2>How each was run</h2><ul>
<li>sprag-design optimize: as a user runs it, but for the number of threads and `--step-mm 0`, no rounding, which the others do not do
either; its evaluations are those of all starts, the finish and the influence table together. Beside them it takes derivatives of all
margins along single variables; each is counted at what it costs in instructions against an evaluation
(<code>examples/cost.rs</code>, callgrind): column <code>derivative_cost</code> of the CSV.</li>
<li>Whole numbers: each value has an equal share of the unit; COBYLA and SLSQP start from the file's values at each of them.</li>
<li>Robust: an evaluation counts for the clutch as drawn and for each corner of its tolerances, and a point counts once all of them
are looked at. Ours (<code>--starts 1</code>) goes by slopes between its climbs: the course has the points at which a climb ends, each with
such a look beside all that was spent by then; the search itself looks at all corners where it has settled alone.</li>
<li>{GLOBAL}: scipy {version('scipy')}, Sobol start, seed 1, feasibility first, then the objective; stopped at the
number of evaluations given.</li>
<li>pymoo genetic algorithm: pymoo {version('pymoo')}, population 60, seed 1, constraints as its own rule treats them,
a quarter of that number.</li>
<li>COBYLA and SLSQP of scipy, COBYLA and SLSQP of basin 3.2, COBYLA of cobyla 1.0: epigraph form (maximise t, every
objective at least t, every limit at least 0), from the file's start and four spread points, at most 3000 evaluations
for all five; differences of SLSQP 1e-5 of the range, simplex 0.1 to 1e-6 of the range.</li></ul>
<h2>Omissions</h2><ul>
<li>No method was tuned; each has the settings above on all problems. Two constants of ours, the steps between two derivatives and what a
climb keeps of every limit, were chosen on the first three.</li>
<li>No times: the machine did other work meanwhile. Those of the CSV are of no use but as a size.</li>
<li>The best value is the best that any of these found, not proved to be the greatest there is.</li>
<li>Ours goes on with new starts until no other optimum is to be expected; the stochastic ones use up their budget.</li></ul>
</main>
</body>
</html>
"""
    with open(OUT + ".html.new", "w") as f:
        f.write(page)
    os.replace(OUT + ".html.new", OUT + ".html")
    columns = [c for c in measured[0] if c not in (NEAR, "course")] + [NEAR]
    with open(OUT + ".csv.new", "w", newline="") as f:
        w = csv.DictWriter(f, columns, extrasaction="ignore", restval="", lineterminator="\n")
        w.writeheader()
        w.writerows(measured)
    os.replace(OUT + ".csv.new", OUT + ".csv")


main()
