#!/usr/bin/env bash
# Remakes reports/cost.csv and reports/cost.html: what an evaluation costs, by phase, before and now, and what error that buys.
#
#   reports/cost.sh [BEFORE [NAME]]
#
# BEFORE: the program as it was, to stand beside what is built here; NAME says which it is. Both need the names of their functions:
#   CARGO_PROFILE_RELEASE_STRIP=none cargo build --release --locked
# BUILT=FOLDER takes sprag-design and examples/cost from there in place of a build. Some minutes; needs Rust, python3, and
# Debian's valgrind and time. Counts are the same everywhere; times are this machine's, so compare those of one run.
set -eu
cd "$(dirname "$0")/.."
. tests/install.sh
need valgrind valgrind /usr/bin/time time
if [ -z "${BUILT:-}" ]; then
    CARGO_PROFILE_RELEASE_STRIP=none CARGO_TARGET_DIR=target/cost cargo build --release --locked --bin sprag-design --example cost
    BUILT=target/cost/release
fi
said="reports/cost.sh"
[ $# -eq 0 ] || said="reports/cost.sh BEFORE"
python3 reports/cost.py "$BUILT" reports/cost.csv "$said" "$@"
python3 reports/cost_page.py reports/cost.csv reports/cost.html
