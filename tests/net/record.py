#!/usr/bin/env python3
"""The net under a change of structure: what every command answers on every design, recorded and compared.

    python3 tests/net/record.py record BINARY CHECKOUT FOLDER    run BINARY on the designs of CHECKOUT, write FOLDER
    python3 tests/net/record.py compare BEFORE AFTER             what differs; exit code 1 where something does
    python3 tests/net/record.py figures BEFORE AFTER             across versions: each key and column that both have, how many of its
                                                                 numbers are the same to the last bit, how far the others moved

Recorded are exit code, standard output (JSON and text), the error text, and every file written. Run times are left out
and so is the hash of a design. Numbers are compared as they are printed, JSON keys and CSV rows in their order.
Standard library only. Some three minutes with a release build on two cores.
"""

import concurrent.futures
import csv
import hashlib
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import tomllib

LAWS = "roller,din26281,hertz,slice,elastic"
DATA = "label,use,torque_nm,windup_deg\na,,10,1.2345\nb,fit,16.8,1.94\nc,,50,5.1\nd,check,90,8.5\n"
# Values that a run does not repeat, wherever they stand.
PASSING = {"run_time_s", "design_hash", "time_s_wall", "seconds"}
REFUSALS = {
    "unknown-key": ("count = 12", "cuont = 12"),
    "not-a-number": ("count = 12", 'count = "twelve"'),
    "out-of-range": ("count = 12", "count = 0"),
    "second-radius": ("radius_mm = 4.08", "radius_mm = 40.8"),
    "no-scene": ('scenarios = ["low-10"', 'scenarios = ["low-11"'),
    "syntax": ("[races]", "[races"),
    "law": ('law = "roller"', 'law = "rolller"'),
    "too-many-faults": ("mm = ", "m = "),
}
MULTI = "designs/huang2017-multi-arc.toml"
SWINGS = ["resonance", MULTI, "--scenario", "high-6"]
STARTS = ["reengage", "designs/starter.toml", "--torque", "50", "--inner-inertia", "0.05", "--outer-inertia", "0.05"]
ANSWERS = {
    "feed": ["feed", "designs/indexing.toml", "--stroke", "30", "--brake", "100", "--inertia", "0.02"],
    "feed-lost": ["feed", "designs/indexing.toml", "--stroke", "12", "--brake", "5", "--frequency", "5,40,200"],
    "life": ["life", "designs/indexing-life.toml"],
    "life-scatter": ["life", "designs/indexing-life.toml", "--set", "life.friction_scatter=0.15"],
    "sharing": ["sharing", "designs/unlike-sprags.toml"],
    "sharing-too-much": ["sharing", "designs/unlike-sprags.toml", "--torque", "4000"],
    "reengage": [*STARTS, "--friction", "0.06"],
    "reengage-held": ["reengage", "designs/indexing.toml", "--torque", "100", "--friction", "0.06",
                      "--inner-inertia", "0.02", "--outer-held"],
    "resonance": SWINGS,
    "resonance-map": [*SWINGS, "--frequency", "100:300", "--amplitude", "5:15", "--points", "5"],
    "overrun": ["overrun", "designs/lubricated.toml"],
    "overrun-outer": ["overrun", "designs/lubricated.toml", "--race", "outer", "--temperatures", "20,60"],
    "compare": ["compare", "designs/huang2017-single-arc.toml", MULTI],
    "compare-three": ["compare", "designs/series-833-small.toml", "designs/series-833-mid.toml",
                      "designs/series-833-large.toml"],
}


def commands(root):
    """Name, arguments and standard input of every run, in a folder that holds `designs` and `problems`."""
    designs = sorted((root / "designs").glob("*.toml"))
    problems = sorted((root / "problems").glob("*.toml"))
    yield "help", ["--help"], None
    for name in ["materials", "schema"]:
        yield name, [name], None
    yield "materials-json", ["materials", "--json", "--csv", "out.csv"], None
    for path in designs + problems:
        file, key = str(path.relative_to(root)), path.stem
        parsed = tomllib.loads(path.read_text())
        yield f"check-{key}", ["check", file, "--json", "--csv", "out.csv", "--overrun-csv", "run.csv"], None
        yield f"check-text-{key}", ["check", file], None
        yield f"stiffness-{key}", ["stiffness", file, "--contact", LAWS, "--json", "--csv", "out.csv"], None
        yield f"stiffness-text-{key}", ["stiffness", file], None
        for scene in (parsed.get("scenarios", []) if path in designs else []):
            name = scene["name"]
            run = ["simulate", file, "--scenario", name]
            yield f"simulate-{key}-{name}", run + ["--json", "--csv", "out.csv"], None
            yield f"simulate-text-{key}-{name}", run, None
        if "optimize" in parsed:
            middle = [(v["min"] + v["max"]) / 2 for v in parsed["optimize"]["variables"]]
            middle = [int(x) if isinstance(v["min"], int) else x
                      for x, v in zip(middle, parsed["optimize"]["variables"])]
            yield f"evaluate-{key}", ["evaluate", file, "--describe"], json.dumps(middle) + "\n"
            # Evaluations count in rounds of both threads; one climb is the same for any number of them.
            yield f"optimize-{key}", ["optimize", file, "-o", "new.toml", "--starts", "1", "--evaluations", "60",
                                      "--json", "--csv", "out.csv"], None
            yield f"optimize-text-{key}", ["optimize", file, "-o", "new.toml", "--starts", "1",
                                           "--evaluations", "60", "--quiet"], None
    multi = MULTI
    for pressure in ["slices", "reference", "free-ends"]:
        yield f"pressure-{pressure}", ["stiffness", multi, "--torques", "16.8", f"--pressure={pressure}", "--json"], None
    yield "accuracy", ["accuracy", multi, "--cases", "0", "--min-step", "1e-5", "--quiet"], None
    for extra in (["--full"], ["--tolerance", "1e-8"], ["--step", "1e-5"], ["--method", "published"]):
        yield ("simulate-" + "".join(extra).strip("-"),
               ["simulate", multi, "--scenario", "high-8", "--json", *extra], None)
    yield "export", ["export", multi, "--format", "calculix", "-o", "deck.inp", "--mesh", "0.1", "--torque", "30"], None
    yield "identify", ["identify", multi, "--data", "data.csv", "--unknown", "r_i3_mm:3.6:4.8", "-o", "found.toml",
                       "--starts", "2", "--json", "--csv", "out.csv"], None
    yield "identify-text", ["identify", multi, "--data", "data.csv", "--unknown",
                            "r_i3_mm:3.6:4.8,centroid_y_mm:0.3:0.8", "--starts", "1"], None
    yield "size", ["size", "--bore", "20", "--torque", "150", "-o", "new.toml", "--json"], None
    yield "size-text", ["size", "--bore", "35", "--torque", "400", "--speed", "3000", "-o", "new.toml"], None
    yield "optimize-global", ["optimize", multi, "-o", "new.toml", "--global", "40", "--starts", "1",
                              "--evaluations", "30", "--json"], None
    yield "optimize-pareto", ["optimize", "problems/a-huang-at-rest.toml", "-o", "new.toml", "--starts", "1", "--pareto",
                              "slip-margin,windup", "--points", "2", "--evaluations", "30", "--json"], None
    for name, arguments in ANSWERS.items():
        yield name, [*arguments, "--json", "--csv", "out.csv"], None
        yield f"{name}-text", arguments, None
    for name in REFUSALS:
        yield f"refused-{name}", ["check", f"refused-{name}.toml", "--json"], None
    for name, arguments in {
        "no-file": ["check", "nowhere.toml"], "no-scenario": ["simulate", multi, "--scenario", "nothing"],
        "no-option": ["check", multi, "--bogus"], "no-output": ["size", "--bore", "20", "--torque", "100"],
        "bad-torques": ["stiffness", multi, "--torques", "a,b"], "no-optimize": ["optimize", "designs/indexing.toml"],
        "bad-vector": ["evaluate", multi],
    }.items():
        yield f"refused-{name}", arguments, "[1]\n" if name == "bad-vector" else None


def prepare(folder, checkout):
    shutil.copytree(checkout / "designs", folder / "designs")
    shutil.copytree(checkout / "tests" / "optimise" / "designs", folder / "problems")
    (folder / "data.csv").write_text(DATA)
    text = (folder / "designs" / "huang2017-multi-arc.toml").read_text()
    for name, (old, new) in REFUSALS.items():
        assert old in text, f"{old} is no longer in the design that the refusal {name} is made of"
        (folder / f"refused-{name}.toml").write_text(text.replace(old, new))


def plain(value):
    """JSON without what passes, keys in their order."""
    if isinstance(value, dict):
        return {k: plain(v) for k, v in value.items() if k not in PASSING}
    return [plain(v) for v in value] if isinstance(value, list) else value


def shown(data, here):
    """Text of an answer without the folder it was made in, hashes and times."""
    try:
        text = data.decode()
    except UnicodeDecodeError:
        return "sha256 " + hashlib.sha256(data).hexdigest() + "\n"
    text = text.replace(here, "HERE")
    lines = []
    for line in text.splitlines():
        try:
            assert line.startswith("{")
            lines.append(json.dumps(plain(json.loads(line)), indent=1, ensure_ascii=False))
        except (AssertionError, ValueError):
            line = re.sub(r"\b[0-9a-f]{64}\b|\b[0-9a-f]{12,16}…", "HASH", line)
            lines.append(re.sub(r"\b\d+([.,]\d+)? ?(s|ms|min)\b(?= (of |on |wall|run))", "TIME", line))
    return "\n".join(lines) + "\n"


def one(binary, checkout, out, name, arguments, stdin):
    with tempfile.TemporaryDirectory() as scratch:
        here = pathlib.Path(scratch) / "w"
        here.mkdir()
        prepare(here, checkout)
        before = {p.relative_to(here) for p in here.rglob("*")}
        run = subprocess.run([binary, *arguments], cwd=here, input=(stdin or "").encode(), capture_output=True,
                             env={**os.environ, "NO_COLOR": "1"}, timeout=1200)
        texts = {"exit": f"{run.returncode}\n", "stdout": shown(run.stdout, scratch)}
        if run.returncode != 0 or "refused" in name:
            texts["stderr"] = shown(run.stderr, scratch)
        for path in sorted(p for p in here.rglob("*") if p.is_file() and p.relative_to(here) not in before):
            texts[str(path.relative_to(here)).replace("/", "_")] = shown(path.read_bytes(), scratch)
    (out / name).mkdir(parents=True, exist_ok=True)
    for part, text in texts.items():
        (out / name / part).write_text(text)
    return name


def record(binary, checkout, out):
    binary, checkout, out = str(pathlib.Path(binary).resolve()), pathlib.Path(checkout).resolve(), pathlib.Path(out)
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder) / "w"
        root.mkdir()
        prepare(root, checkout)
        jobs = list(commands(root))
    with concurrent.futures.ThreadPoolExecutor(int(os.environ.get("JOBS", os.cpu_count() or 1))) as pool:
        done = [pool.submit(one, binary, checkout, out, *job) for job in jobs]
        for i, job in enumerate(concurrent.futures.as_completed(done), 1):
            print(f"{i}/{len(done)} {job.result()}", file=sys.stderr)


# What tells the objects of a list apart, where they have it; else their place does.
TELLS = ["code", "limit", "figure", "law", "term", "variable", "name", "scenario", "start"]


def leaves(value, path, key):
    """Each value of a JSON answer with where it stands and the key that it has there."""
    if isinstance(value, dict):
        for k, v in value.items():
            yield from leaves(v, path + (k,), key + (k,))
    elif isinstance(value, list):
        for i, v in enumerate(value):
            told = next((str(v[t]) for t in TELLS if isinstance(v, dict) and t in v), str(i))
            yield from leaves(v, path + (told,), key)
    else:
        yield path, ".".join(key), value


def parsed(path):
    """The figures of one recorded output: where each stands, its key, its value; none of what is neither JSON nor CSV."""
    text = path.read_text()
    if path.suffix == ".csv":
        rows = list(csv.reader(line for line in text.splitlines() if not line.startswith("#")))
        for number, row in enumerate(rows[1:]):
            for column, cell in zip(rows[0], row):
                yield (number, row[0] if column != rows[0][0] else "", column), f"column {column}", cell
    elif text.startswith("{"):
        try:
            yield from leaves(json.loads(text), (), ())
        except ValueError:
            return


def figures(before, after):
    before, after = pathlib.Path(before), pathlib.Path(after)
    found, gone = {}, {}
    for old in sorted(p for p in before.rglob("*") if p.name == "stdout" or p.suffix == ".csv"):
        new, command = after / old.relative_to(before), old.parent.name.split("-")[0]
        if not new.exists():
            continue
        now = {path: value for path, _, value in parsed(new)}
        for path, key, value in parsed(old):
            if path not in now:
                gone.setdefault((command, key), set()).add(old.parent.name)
                continue
            tally = found.setdefault((command, key), [0, 0, 0.0])
            if now[path] == value:
                tally[0] += 1
                continue
            tally[1] += 1
            try:
                a, b = float(value), float(now[path])
                tally[2] = max(tally[2], abs(a - b) / max(abs(a), abs(b)) if a != b else 0.0)
            except (TypeError, ValueError):
                pass
    print("command  key  same  moved  largest relative move")
    for (command, key), (same, moved, most) in sorted(found.items()):
        if moved:
            print(f"{command}  {key}  {same}  {moved}  {most:.2g}")
    same = sum(t[0] for t in found.values())
    print(f"{same} of {sum(t[0] + t[1] for t in found.values())} values that both have are the same")
    for (command, key), where in sorted(gone.items()):
        print(f"gone or elsewhere: {command}  {key}  in {len(where)} runs")


def compare(before, after):
    before, after = pathlib.Path(before), pathlib.Path(after)
    names = sorted({str(p.relative_to(d)) for d in (before, after) for p in d.rglob("*") if p.is_file()})
    different = 0
    for name in names:
        sides = [(d / name).read_text().splitlines() if (d / name).exists() else None for d in (before, after)]
        if sides[0] == sides[1]:
            continue
        different += 1
        if None in sides:
            print(f"{name}: only {'after' if sides[0] is None else 'before'}")
            continue
        result = subprocess.run(["diff", "-U0", before / name, after / name], capture_output=True, text=True)
        rows = [r for r in result.stdout.splitlines()[2:] if not r.startswith("@@")]
        print(f"{name}: {len(rows)} lines differ")
        limit = int(os.environ.get("LINES", "6"))
        print("".join(f"    {row[:220]}\n" for row in rows[:limit]), end="")
    print(f"{len(names)} recorded, {different} differ")
    return different


if __name__ == "__main__":
    if len(sys.argv) == 5 and sys.argv[1] == "record":
        record(*sys.argv[2:])
    elif len(sys.argv) == 4 and sys.argv[1] == "compare":
        sys.exit(1 if compare(*sys.argv[2:]) else 0)
    elif len(sys.argv) == 4 and sys.argv[1] == "figures":
        figures(*sys.argv[2:])
    else:
        sys.exit(__doc__)
