#!/usr/bin/env bash
# Remakes reports/house.md: lines by room, crates, CPU-seconds of a cold build, size of the binary, files that a limit, a law
# or a kind touches, beside what they were before everything was described once. Three cold builds, that of before among them, some
# twelve CPU-minutes: on a machine that does nothing else, for CPU-seconds of two machines do not compare. With --no-build the lines
# and crates alone, on standard output. Needs git, python3.
set -euo pipefail
cd "$(dirname "$0")/.."

# CPU-seconds of "$@", children and all.
cpu() {
    local TIMEFORMAT='%U %S'
    { time "$@" >/dev/null 2>&1; } 2>&1 | awk '{ printf "%.0f", $1 + $2 }'
}

crates() { cargo tree --locked -e normal,build --prefix none --no-dedupe "$@" | awk '{ print $1, $2 }' | sort -u | wc -l; }

command_s="" library_s="" bytes="" before_s="" before_bytes=""
before=7350902
cold=$(mktemp -d)
trap 'git worktree remove --force "$cold/before"; rm -rf "$cold"' EXIT
git worktree add --quiet --detach "$cold/before" "$before"
before_crates=$(cd "$cold/before" && crates)
if [ "${1:-}" != --no-build ]; then
    command_s=$(CARGO_TARGET_DIR=$cold/command cpu cargo build --release --locked --bin sprag-design)
    bytes=$(wc -c <"$cold/command/release/sprag-design")
    before_s=$(CARGO_TARGET_DIR=$cold/of-before cpu cargo build --release --locked --bin sprag-design --manifest-path "$cold/before/Cargo.toml")
    before_bytes=$(wc -c <"$cold/of-before/release/sprag-design")
    library_s=$(CARGO_TARGET_DIR=$cold/library cpu cargo build --release --locked --lib --no-default-features)
fi
out=$(BEFORE=$before BEFORE_S=$before_s BEFORE_BYTES=$before_bytes COMMAND_S=$command_s LIBRARY_S=$library_s BYTES=$bytes CRATES=$(crates) BEFORE_CRATES=$before_crates \
    LIBRARY_CRATES=$(crates --no-default-features) python3 - <<'PY'
import os, pathlib, re, subprocess

# The commit before the first part of "everything described once".
BEFORE = os.environ["BEFORE"]


# Files and rooms of commands and models that came since.
ADDED = tuple(
    """sharing/ sprags/ feed/ feed.rs life/ life.rs reengage/ reengage.rs sweep/ studio/ compare/ import/ lubrication/ element/
    cli/new.rs cli/studio.rs cli/export/fmu.rs cli/export/geometry.rs cli/evaluate_points.rs cli/sweep.rs cli/import.rs cli/resonance.rs
    cli/map.rs cli/reengage.rs cli/overrun.rs cli/sample.rs cli/feed.rs cli/explain.rs cli/sharing.rs cli/sheet.rs cli/compare.rs
    cli/life.rs dynamics/many/ dynamics/train/ dynamics/periodic.rs dynamics/repeat.rs dynamics/swing.rs dynamics/outside.rs
    scenario/periodic.rs scenario/resonance.rs scenario/train.rs answer/resonance/ answer/sharing/ answer/reengagement/
    answer/life/ answer/feed/ answer/sharing_scene/ answer/sweep/ answer/overrun/ answer/comparison/ answer/explanation.rs
    answer/imported.rs answer/exported.rs answer/co_simulation.rs answer/oils.rs answer/check/sheet.rs answer/simulation/train.rs
    answer/check/overrun.rs answer/under_load.rs export/dxf.rs export/step.rs export/svg.rs export/fmu/ export/sheet.rs export/part.rs
    export/rows.rs file/life_file.rs file/sharing_file.rs file/lubrication_file.rs file/drivetrain.rs
    file/drivetrain_file.rs file/random_torque.rs clutch/drivetrain.rs clutch/lubrication.rs clutch/service.rs clutch/sharing.rs
    margin/unlike.rs margin/track_tension.rs margin/overrun.rs optimise/realise.rs optimise/grid.rs optimise/freed.rs
    optimise/near_corners.rs report/heat.rs report/parallel.rs report/strip.rs size/purpose.rs race/rim.rs race/shooting.rs
    race/torsion.rs race/influence.rs race/harmonic.rs wedge/apart.rs""".split()
)


def split(text):
    """Lines of product, of comments and of tests in one file."""
    product = comment = test = 0
    column = None
    lines = text.split("\n")
    for at, line in enumerate(lines):
        bare = line.strip()
        if column is None and bare == "#[cfg(test)]" and at + 1 < len(lines) and re.match(r"\s*mod \w+ \{", lines[at + 1]):
            column = len(line) - len(line.lstrip())
        if not bare:
            continue
        if column is not None:
            test += 1
            if bare == "}" and len(line) - len(line.lstrip()) == column:
                column = None
        elif bare.startswith("//"):
            comment += 1
        else:
            product += 1
    return [product, comment, test]


def is_test(path):
    return path.endswith("tests.rs") or "/tests/" in path


def rooms(files):
    found = {}
    for path, text in files:
        room = path.split("/")[1].removesuffix(".rs")
        counts = split(text)
        if is_test(path):
            counts = [0, 0, sum(counts)]
        old = found.setdefault(room, [0, 0, 0])
        found[room] = [a + b for a, b in zip(old, counts)]
    return found


now = rooms((str(p), p.read_text()) for p in sorted(pathlib.Path("src").rglob("*.rs")))
git = lambda *args: subprocess.run(["git", *args], check=True, capture_output=True, text=True).stdout
names = [n for n in git("ls-tree", "-r", "--name-only", BEFORE, "src").split("\n") if n.endswith(".rs")]
before = rooms((n, git("show", f"{BEFORE}:{n}")) for n in names)

tool = re.search(r'^version = "(.*)"', pathlib.Path("Cargo.toml").read_text(), re.M).group(1)
print(f"<!-- sprag-design {tool}; reports/house.sh; {git('rev-parse', '--short', 'HEAD').strip()} against {BEFORE} -->")
print("# The house in figures\n")
print("Lines of `src` that are not empty, by room; before: when the rebuild began.\n")
print("| room | product | before | comments | before | tests | before |\n|---|--:|--:|--:|--:|--:|--:|")
total = [[0, 0, 0], [0, 0, 0]]
for room in sorted(set(now) | set(before)):
    a, b = now.get(room, [0, 0, 0]), before.get(room, [0, 0, 0])
    total = [[x + y for x, y in zip(t, r)] for t, r in zip(total, (a, b))]
    print(f"| {room} | {a[0]} | {b[0]} | {a[1]} | {b[1]} | {a[2]} | {b[2]} |")
a, b = total
print(f"| all | {a[0]} | {b[0]} | {a[1]} | {b[1]} | {a[2]} | {b[2]} |\n")

value = lambda key, unit="": f"{os.environ[key]}{unit}" if os.environ.get(key) else "not measured here"
def size(key):
    return f"{int(os.environ[key]) / 1e6:.1f} MB" if os.environ.get(key) else "not measured here"


print("| | now | before |\n|---|--:|--:|")
print(f"| crates behind the command | {value('CRATES')} | {value('BEFORE_CRATES')} |")
print(f"| crates behind the library alone | {value('LIBRARY_CRATES')} | as the command |")
print(f"| cold build of the command, CPU-seconds | {value('COMMAND_S')} | {value('BEFORE_S')} |")
print(f"| cold build of the library alone, CPU-seconds | {value('LIBRARY_S')} | as the command |")
print(f"| binary | {size('BYTES')} | {size('BEFORE_BYTES')} |")
print("| files of `src` that a further limit touches | 2 | 8 |")
print("| files of `src` that a further contact law touches | 2, 3 with a formula of its own | 8 |")
print("| files of `src` that a further kind of scenario touches | 3 | 14 |\n")
print("Files touched were counted by adding each in a branch that was thrown away: a limit on the length of the strut")
print("(`design/limits.rs`, `margin/table.rs`); Palmgren's line contact (`clutch/law.rs`, `wedge/elastic.rs`); a torque held")
print("for a while (`clutch/question.rs`, `file/scenarios.rs`, `scenario/prepare.rs`). Each was accepted in a file, computed,")
print("and worded on page and terminal.\n")
cli = now.get("cli", [0, 0, 0])[0]
help_lines = sum(text.count("\n    /// ") for path, text in ((str(p), p.read_text()) for p in pathlib.Path("src/cli").rglob("*.rs")))
product = {str(p.relative_to("src")): 0 if is_test(str(p)) else split(p.read_text())[0] for p in pathlib.Path("src").rglob("*.rs")}
added = {p: lines for p, lines in product.items() if p.startswith(ADDED)}
added_cli = sum(lines for p, lines in added.items() if p.startswith("cli/"))
everything = sum(product.values())
print(f"`cli` keeps arguments, paths, printing, journal files, progress, exit codes: {cli} lines for 26 commands, beside {help_lines} lines of")
print(f"help on their arguments. It had 7817 for 11. 2000 were aimed at, and 35 000 for all, for the commands of that time: without the files of")
print(f"commands and models that came since ({sum(added.values())} lines, {added_cli} of them in `cli`) it is {cli - added_cli} and {everything - sum(added.values())}.")
print("What is added to a command inside its file (several files at once, --set, drawings for phones) counts as old; so do answers as typed")
print("values (some 1600 lines in place of untyped ones), each key with its meaning.")
PY
)
if [ "${1:-}" = --no-build ]; then
    printf '%s\n' "$out"
else
    printf '%s\n' "$out" >reports/house.md
fi
