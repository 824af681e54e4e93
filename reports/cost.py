#!/usr/bin/env python3
"""Measures what an evaluation costs and what error that buys: reports/cost.csv, one figure a row. Part of reports/cost.sh.

usage: cost.py BUILT OUT.csv COMMAND [BEFORE [NAME]]
"""
import csv
import json
import os
import re
import resource
import statistics
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, "benches")
import cost as counted  # noqa: E402

BUILT, OUT, COMMAND, *EARLIER = sys.argv[1:]
NOW, EXAMPLE = os.path.join(BUILT, "sprag-design"), os.path.join(BUILT, "examples", "cost")
BEFORE = EARLIER[0] if EARLIER else None
BINARIES = ([("before", BEFORE)] if BEFORE else []) + [("now", NOW)]
DESIGNS = {"roller": "designs/huang2017-multi-arc.toml", "elastic": "designs/huang2017-elastic.toml"}
PROBLEMS = [f"tests/optimise/designs/{p}.toml" for p in ("a-huang-at-rest", "b-huang-at-speed", "c-24-sprags", "d-indexing-elastic",
                                                            "e-starter-eight")]
# What an answer says of its own run time.
RUN_TIMES = re.compile(r'"run_time_s":[-+0-9.e]+')
# Least limit that still holds, as the program has it.
RESOLUTION = 1e-8
ROUNDS = 5
ROWS = []


def say(part, design, who, setting, quantity, value, unit=""):
    ROWS.append((part, design, who, setting, quantity, value, unit))


def run(*words, stdin=""):
    return subprocess.run(words, input=stdin, capture_output=True, text=True, check=True).stdout


def measured(*words, stdin=""):
    """Answer, wall s, CPU s, largest memory in MB of a process."""
    with tempfile.NamedTemporaryFile("r") as told:
        begun, used = time.perf_counter(), resource.getrusage(resource.RUSAGE_CHILDREN)
        out = run("/usr/bin/time", "-f", "%M", "-o", told.name, *words, stdin=stdin)
        wall, now = time.perf_counter() - begun, resource.getrusage(resource.RUSAGE_CHILDREN)
        memory = told.read().split()[-1]
    return out, wall, now.ru_utime + now.ru_stime - used.ru_utime - used.ru_stime, float(memory) / 1024


def sobol(design, count, *more):
    """Rows of a table of points."""
    lines = run(NOW, "evaluate", design, "--sobol", str(count), "--quiet", *more).splitlines()
    return list(csv.DictReader(lines[1:]))


def variables(design):
    return [v["name"] for v in json.loads(run(NOW, "evaluate", design, "--describe", "--quiet"))["variables"]]


def points(design, count):
    """So many points of the box at which there is a clutch, as lines for `evaluate`."""
    names = variables(design)
    rows = [r for r in sobol(design, 3 * count) if not r["refused"]][:count]
    return "".join(json.dumps([float(r[n]) for n in names]) + "\n" for r in rows)


def beside_start(design):
    """The points of benches/cost.sh."""
    lines = []
    for share in (0.0, 0.03, -0.02, 0.05):
        free = json.loads(run(NOW, "evaluate", design, "--describe", "--quiet"))["variables"]
        x = [v["start"] + share * (-1) ** k * (v["max"] - v["min"]) for k, v in enumerate(free)]
        x = [min(max(a, v["min"]), v["max"]) for a, v in zip(x, free)]
        lines.append(json.dumps(x) + "\n")
    return "".join(lines)


def phases():
    for law, design in DESIGNS.items():
        for who, binary in BINARIES:
            found = json.loads(run("benches/cost.sh", "--json", design, binary))
            say("phases", law, who, "", "whole", found["whole"], "instructions")
            for phase, cost in found["phases"].items():
                say("phases", law, who, "", phase, cost, "instructions")
            say("phases", law, who, "", "closures", found["closures"])
            say("phases", law, who, "", "closure", found["closure"], "instructions")
        scenes = [json.loads(line) for line in run(EXAMPLE, "counts", design, stdin=beside_start(design)).splitlines()]
        for name in scenes[0]:
            say("floor", law, "now", name, "right-hand sides", statistics.mean(s[name] for s in scenes))
        say("floor", law, "now", "all", "right-hand sides", statistics.mean(sum(s.values()) for s in scenes))


def speed():
    """In pairs, in turn: before, now, before, now."""
    for law, design in DESIGNS.items():
        lines, nothing, answers = points(design, 100), "", {}
        for threads in (1, 2):
            wall, cpu = ({who: [] for who, _ in BINARIES} for _ in range(2))
            for _ in range(ROUNDS):
                for who, binary in BINARIES:
                    words = (binary, "evaluate", design, "--quiet", "--threads", str(threads))
                    _, idle_wall, idle_cpu, _ = measured(*words, stdin=nothing)
                    answers[who], w, c, _ = measured(*words, stdin=lines)
                    count = lines.count("\n")
                    wall[who].append((w - idle_wall) / count)
                    cpu[who].append((c - idle_cpu) / count)
            setting = f"{threads} thread{'s' * (threads > 1)}"
            for who, _ in BINARIES:
                say("speed", law, who, setting, "evaluations a second", 1 / statistics.median(wall[who]), "1/s")
                say("speed", law, who, setting, "processor time of one", 1e3 * statistics.median(cpu[who]), "ms")
            if BEFORE:
                for name, of in (("wall", wall), ("processor", cpu)):
                    ratio = statistics.median(a / b for a, b in zip(of["before"], of["now"]))
                    say("speed", law, "now", setting, f"times as fast, {name} time, median of pairs", ratio)
        if BEFORE:
            say("speed", law, "before", "", "largest difference of a margin", apart(design, answers))


def apart(design, answers):
    """Largest difference of a margin that both programs give, relative where a margin is above 1."""
    told = {who: json.loads(run(binary, "evaluate", design, "--describe", "--quiet")) for who, binary in BINARIES}

    def named(who):
        for answer in map(json.loads, answers[who].splitlines()):
            yield {(kind, name): value for kind in ("objectives", "limits") for name, value in zip(told[who][kind], answer[kind])}

    worst = 0.0
    for a, b in zip(named("before"), named("now")):
        assert a.keys() <= b.keys(), a.keys() - b.keys()
        worst = max(worst, *(abs(a[of] - b[of]) / max(1.0, abs(b[of])) for of in a))
    return worst


def curve():
    for law, design in DESIGNS.items():
        instructions = {}
        with tempfile.TemporaryDirectory() as folder:
            for how in ("full", "search"):
                seen = {}
                for times in (0, 4):
                    path = os.path.join(folder, f"{how}-{times}")
                    run("valgrind", "--tool=callgrind", f"--callgrind-out-file={path}", EXAMPLE, "build", design, how, str(times))
                    seen[times] = counted.read(path)
                whole = (seen[4][0] - seen[0][0]) / 4
                closures = [n for n in seen[4][2] if n.endswith("Statics::closure")]
                calls = sum(seen[4][2][n] for n in closures) / 4
                inside = sum(seen[4][1][n] for n in closures) / 4
                instructions[how] = (whole, calls, inside / calls)
        for line in run(EXAMPLE, "curve", design).splitlines():
            row = json.loads(line)
            how = row["how"]
            if how in instructions:
                whole, calls, _ = instructions[how]
                setting = ""
            else:
                calls = row["closures"]
                whole, setting = calls * instructions["full"][2], str(calls)
            say("curve", law, how, setting, "closures", calls)
            say("curve", law, how, setting, "instructions", whole, "instructions")
            say("curve", law, how, setting, "time", row["time_s"], "s")
            say("curve", law, how, setting, "error of the normal force", row["normal"])
            if "windup" in row:
                say("curve", law, how, setting, "error of the windup", row["windup"])


def scene():
    design = DESIGNS["roller"]
    for name in ("high-10", "rated-45"):
        found = {}
        for tolerance in ("1e-12", "1e-3", "1e-4", "1e-5", "1e-6", "1e-7", "1e-8", "1e-9", "1e-10"):
            times = []
            for _ in range(3):
                out, _, cpu, _ = measured(NOW, "simulate", design, "--scenario", name, "--tolerance", tolerance, "--json",
                                          "--quiet", "--threads", "1")
                times.append(cpu)
            answer = json.loads(out)
            found[tolerance] = answer
            if tolerance == "1e-12":
                continue
            sharp = found["1e-12"]
            said = [("processor time", statistics.median(times), "s"), ("right-hand sides", answer["rhs_evaluations"], ""),
                    ("error of the angle", abs(answer["theta_inner_end_rad"] - sharp["theta_inner_end_rad"]), "rad"),
                    ("stated error of the angle", answer["error_estimates"]["theta_inner_rad"], "rad")]
            if sharp["required_static_friction"] is not None:
                off = abs(answer["required_static_friction"] - sharp["required_static_friction"])
                said.append(("error of the required friction", off, ""))
            for quantity, value, unit in said:
                say("scene", "roller", name, tolerance, quantity, value, unit)
    with open("reports/accuracy-peers.csv", newline="") as f:
        f.readline()
        for row in csv.DictReader(f):
            if row["scene"] == "high-10" and not row["failure"] and row["theta_inner_error_rad"]:
                for quantity, key, unit in (("right-hand sides", "rhs_evaluations", ""), ("error of the angle", "theta_inner_error_rad", "rad")):
                    say("integrators", "roller", row["method"], row["setting"], quantity, float(row[key]), unit)


def evaluation():
    count = 50
    for law, design in DESIGNS.items():
        tables = {how: sobol(design, count, *(["--full"] if how == "full" else [])) for how in ("quick", "full")}
        worst, at, compared, counted_margins = 0.0, "", 0, 0
        for a, b in zip(tables["quick"], tables["full"]):
            if a["refused"] or b["refused"]:
                assert bool(a["refused"]) == bool(b["refused"]), (a, b)
                continue
            compared += 1
            for name in a:
                if name.startswith(("objective.", "limit.")):
                    counted_margins += 1
                    off = abs(float(a[name]) - float(b[name])) / max(1.0, abs(float(b[name])))
                    if off > worst:
                        worst, at = off, name
        say("evaluation", law, "quick", f"{compared} of {count} points", "largest difference of a margin", worst)
        say("evaluation", law, "quick", f"{compared} of {count} points", "margins compared", counted_margins)
        say("evaluation", law, "quick", at, "where", at)
        lines = points(design, count)
        cpu = {"quick": [], "full": []}
        for _ in range(ROUNDS):
            for how in cpu:
                more = ["--full"] * (how == "full")
                words = (NOW, "evaluate", design, "--quiet", "--threads", "1", *more)
                cpu[how].append((measured(*words, stdin=lines)[2] - measured(*words)[2]) / lines.count("\n"))
        for how, times in cpu.items():
            say("evaluation", law, how, "", "processor time of one", 1e3 * statistics.median(times), "ms")
        say("evaluation", law, "quick", "", "times as fast as full, median of pairs",
            statistics.median(b / a for a, b in zip(cpu["quick"], cpu["full"])))


def optimum():
    with open("reports/optimiser-peers.csv", newline="") as f:
        peers = list(csv.DictReader(f))
    for design in PROBLEMS:
        name = os.path.splitext(os.path.basename(design))[0]
        with tempfile.TemporaryDirectory() as folder:
            journal = os.path.join(folder, "journal.csv")
            answer = json.loads(run(NOW, "optimize", design, "-o", os.path.join(folder, "new.toml"), "--journal", journal, "--json",
                                    "--quiet", "--step-mm", "0", "--threads", "1"))
            with open(journal, newline="") as f:
                rows = list(csv.DictReader(f))
        ours = answer["best"]["objective"]
        those = [p for p in peers if p["problem"] == name and not p["method"].startswith("sprag-design")]
        best = max([ours] + [float(p["objective"]) for p in those if p["objective"]])
        so_far, near = float("-inf"), None
        for k, row in enumerate(rows, 1):
            if row["outcome"] != "ok" or min(map(float, row["limits"].split(";"))) < -RESOLUTION:
                continue
            value = min(map(float, row["objectives"].split(";")))
            if value > so_far:
                so_far = value
                say("course", name, "sprag-design optimize", str(k), "slip margin, best so far", value)
                near = near or (k if best - value <= 1e-3 * abs(best) else None)
        who = "sprag-design optimize"
        say("optimum", name, who, "", "evaluations", answer["evaluations"])
        say("optimum", name, who, "", "rows of the journal", len(rows))
        say("optimum", name, who, "", "until within 0.1 % of the best", near)
        say("optimum", name, who, "", "slip margin", ours)
        say("optimum", name, who, "", "below the best, relative", (best - ours) / abs(best))
        for p in those:
            say("optimum", name, p["method"], "", "evaluations", int(p["evaluations"]))
            say("optimum", name, p["method"], "", "until within 0.1 % of the best", p["until_within_0.1_percent"])
            if p["objective"]:
                say("optimum", name, p["method"], "", "slip margin", float(p["objective"]))
                say("optimum", name, p["method"], "", "below the best, relative", (best - float(p["objective"])) / abs(best))
        tolerances(name, design)


def tolerances(name, design):
    """One climb by the error allowed in an evaluation."""
    found = {}
    for tolerance in ("1e-9", "1e-3", "1e-4", "1e-5", "1e-6", "1e-7", "1e-8"):
        with tempfile.TemporaryDirectory() as folder:
            out, _, cpu, _ = measured(NOW, "optimize", design, "-o", os.path.join(folder, "new.toml"), "--json", "--quiet", "--step-mm",
                                      "0", "--starts", "1", "--threads", "1", "--tolerance", tolerance)
        found[tolerance] = answer = json.loads(out)
        if tolerance != "1e-9":
            sharp = found["1e-9"]["best"]["objective"]
            say("climb", name, "sprag-design optimize", tolerance, "evaluations", answer["evaluations"])
            say("climb", name, "sprag-design optimize", tolerance, "processor time", cpu, "s")
            say("climb", name, "sprag-design optimize", tolerance, "off the sharpest, relative",
                abs(answer["best"]["objective"] - sharp) / abs(sharp))
            say("climb", name, "sprag-design optimize", tolerance, "any margin moves, looked at in full",
                max(abs(c["change"]) for c in answer["change_in_full"]))


def scaling():
    design = DESIGNS["roller"]
    jobs = {"sweep of 3000 points": ("evaluate", design, "--sobol", "3000"),
            "search, eight variables": ("optimize", PROBLEMS[-1], "--json", "-o", "-"),
            "resonance map, 20 x 20": ("resonance", design, "--scenario", "high-6", "--frequency", "20:400", "--amplitude", "1:20",
                                       "--points", "20x20", "--json")}
    with tempfile.TemporaryDirectory() as folder:
        for job, words in jobs.items():
            words = [os.path.join(folder, "better.toml") if w == "-" else w for w in words]
            answers, wall = {}, {1: [], 2: []}
            for _ in range(3):
                for threads in wall:
                    more = ["--force"] * ("-o" in words)
                    out, seconds, _, _ = measured(NOW, *words, *more, "--quiet", "--threads", str(threads))
                    answers[threads] = RUN_TIMES.sub("", out)
                    wall[threads].append(seconds)
            say("scaling", job, "now", "2 threads", "the same bytes as on one", "yes" if answers[1] == answers[2] else "NO")
            for threads, seconds in wall.items():
                say("scaling", job, "now", f"{threads} thread{'s' * (threads > 1)}", "time", statistics.median(seconds), "s")
            say("scaling", job, "now", "2 threads", "times as fast as one, median of pairs",
                statistics.median(a / b for a, b in zip(wall[1], wall[2])))
    for count in (300, 3000):
        for threads in (1, 2):
            _, _, _, memory = measured(NOW, "evaluate", design, "--sobol", str(count), "--quiet", "--threads", str(threads))
            say("scaling", "sweep", "now", f"{count} points, {threads} thread{'s' * (threads > 1)}", "largest memory", memory, "MB")


def main():
    about = {law: json.loads(run(NOW, "evaluate", d, "--describe", "--quiet")) for law, d in DESIGNS.items()}
    for law, a in about.items():
        say("head", law, "now", "", "design_hash", a["design_hash"])
        say("head", law, "now", "", "design", a["design"])
    commit = subprocess.run(["git", "describe", "--always"], capture_output=True, text=True).stdout.strip()
    say("head", "", "now", "", "version", about["roller"]["version"])
    say("head", "", "now", "", "commit", commit)
    if BEFORE:
        say("head", "", "before", "", "name", EARLIER[1] if len(EARLIER) > 1 else "an earlier version")
    say("head", "", "", "", "processors", os.cpu_count())
    busy = [os.getloadavg()[0]]
    for part in (phases, speed, curve, scene, evaluation, optimum, scaling):
        print(part.__name__, file=sys.stderr, flush=True)
        part()
        busy.append(os.getloadavg()[0])
        hashes = " and ".join(a["design_hash"] for a in about.values())
        with open(OUT + ".new", "w", newline="") as f:
            f.write(f"# sprag-design {about['roller']['version']}; design {hashes}; {COMMAND}\n")
            w = csv.writer(f, lineterminator="\n")
            w.writerow(["part", "design", "who", "setting", "quantity", "value", "unit"])
            w.writerows(ROWS + [("head", "", "", "", "processes that wanted to run, least", min(busy), ""),
                                ("head", "", "", "", "processes that wanted to run, most", max(busy), "")])
        os.replace(OUT + ".new", OUT)


main()
