#!/usr/bin/env bash
# Where an evaluation's instructions go, by phase: callgrind counts them, the same on every run and under any load.
#
#   benches/cost.sh [--json] FILE.toml BINARY...
#   benches/cost.sh designs/huang2017-multi-arc.toml before target/cost/release/sprag-design
#
# Each binary evaluates the start of FILE's [optimize] and three points beside it; what it does without a point is taken off.
# Functions are known by name: CARGO_PROFILE_RELEASE_STRIP=none CARGO_TARGET_DIR=target/cost cargo build --release --locked
# --json: one line for each binary. Installs valgrind where it is absent; needs python3.
set -eu
how=--text
[ "${1:-}" != --json ] || { how=--json; shift; }
[ $# -ge 2 ] || { sed -n '2,9p' "$0"; exit 2; }
. "$(dirname "$0")/../tests/install.sh"
need valgrind valgrind
design=$1
shift
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$1" evaluate "$design" --describe </dev/null | python3 -c '
import json, sys
variables = json.loads(sys.stdin.readline())["variables"]
for share in (0.0, 0.03, -0.02, 0.05):
    def at(k, v):
        x = v["start"] + share * (-1) ** k * (v["max"] - v["min"])
        return v["start"] if v["whole"] else min(max(x, v["min"]), v["max"])
    print([at(k, v) for k, v in enumerate(variables)])
' >"$work/points"
: >"$work/nothing"
for binary in "$@"; do
    for what in points nothing; do
        valgrind --tool=callgrind --callgrind-out-file="$work/of-$what" \
            "$binary" evaluate "$design" --threads 1 <"$work/$what" >/dev/null 2>"$work/log"
    done
    python3 "$(dirname "$0")/cost.py" "$how" "$binary" "$work/of-points" "$work/of-nothing"
done
