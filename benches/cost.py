"""Reads what callgrind wrote of one binary (cost.sh): instructions per evaluation, by phase."""
import collections
import json
import re
import sys

POINTS = 4


def read(path):
    """Instructions in all; by function those inside its calls; calls by function."""
    names, inclusive, calls = {}, collections.Counter(), collections.Counter()
    total, at, callee = 0, None, None
    for line in open(path):
        if named := re.match(r"(c?)fn=\((\d+)\)(?: (.*))?", line):
            called, key, name = named.groups()
            names.setdefault(key, name)
            if called:
                callee = names[key]
            else:
                at = names[key]
        elif line.startswith("calls="):
            calls[callee] += int(line[6:].split()[0])
        elif re.match(r"[+\-*\d]", line) and at:
            cost = int(line.split()[-1])
            if callee:
                inclusive[callee] += cost
                callee = None
            else:
                total += cost
    return total, inclusive, calls


def measured(points, nothing):
    """Of two such files, one of an evaluation of POINTS points and one of none, per evaluation."""
    total, inclusive, calls = read(points)
    idle, idle_inclusive, _ = read(nothing)
    whole = (total - idle) / POINTS

    def of(*names):
        """What the first of these functions that is there (others are inlined) took."""
        for name in names:
            found = [n for n in inclusive if re.search(name, n)]
            if found:
                return max(inclusive[n] - idle_inclusive[n] for n in found) / POINTS
        return 0.0

    curves = of(r"WedgeCurve>::march$")
    with_state = of(r"margin::load::load_state_with$", r"margin::curve_at_rest$", r"margin::load::load_state_at$", r"margin::load::load_state$")
    phases = {
        "the file: values put in, read": of(r"file::form::DesignForm::at$", r"file::edit::with_values$") + of(r"design::Design>::parse_in$"),
        "curves": curves,
        "rows of the load state": of(r"smooth::load_rows$", r"margin::load_rows$", r"margin::load_margins$", r"margin::load::rows$"),
        "scenes made ready, without curves": max(of(r"plan::plan_at$", r"plan::plan$") - max(curves - with_state, 0.0), 0.0),
        "pure-rolling runs": of(r"demand::roll$") or of(r"rolling::rolling$") + of(r"rolling::rolling_tracked$"),
        "runs where no friction suffices": of(r"demand::bisect$", r"demand::bisected$"),
    }
    if not any(phases.values()):
        sys.exit("cost.py: no function of this program by name: build with CARGO_PROFILE_RELEASE_STRIP=none")
    phases["all else"] = whole - sum(phases.values())
    closures = sum(n for function, n in calls.items() if function.endswith("Statics::closure")) / POINTS
    each = of(r"Statics::closure$") / closures if closures else 0.0
    return {"whole": whole, "phases": phases, "closures": closures, "closure": each}


def told(binary, found):
    whole = found["whole"]
    print(f"\n{binary}: {whole / 1e6:.2f} M instructions per evaluation")
    for phase, cost in found["phases"].items():
        print(f"  {phase:<36}{cost / 1e6:>8.2f} M {100 * cost / whole:>6.1f} %")
    if found["closures"]:
        print(f"  closures: {found['closures']:.0f}, of {found['closure'] / 1e3:.1f} k each")


if __name__ == "__main__":
    how, binary, points, nothing = sys.argv[1:]
    found = measured(points, nothing)
    print(json.dumps(found)) if how == "--json" else told(binary, found)
