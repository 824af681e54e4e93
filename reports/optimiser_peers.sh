#!/bin/sh
# Other optimisers on the evaluator of `sprag-design optimize`: reports/optimiser-peers.{csv,html}. An hour; outside CI.
# Needs Rust, Python 3 with venv, PyPI, and Debian's valgrind.
set -eu
cd "$(dirname "$0")/.."
cargo build --release --bin sprag-design --example cost
CARGO_TARGET_DIR=target/peers cargo build --release --manifest-path peers/optimisers/Cargo.toml
venv=target/peers/venv
[ -x "$venv/bin/python" ] || python3 -m venv "$venv"
"$venv/bin/pip" install --quiet scipy==1.17.1 pymoo==0.6.2 matplotlib numpy
out=reports/optimiser-peers
work=${WORK:-target/peers/found}
mkdir -p "$work"
designs=$(ls tests/optimise/designs/[a-f]-*.toml)
# KEEP=1 takes what others found from an earlier run in WORK: our own search alone is run again.
if [ -z "${KEEP:-}" ]; then
    "$venv/bin/python" reports/optimiser_peers.py target/release/sprag-design "$work/found" "${EVALUATIONS:-20000}" peers $designs
    target/peers/release/sprag-design-optimiser-peers target/release/sprag-design $designs 2>"$work/rust.jsonl" >"$work/rust.csv"
fi
"$venv/bin/python" reports/optimiser_peers.py target/release/sprag-design "$work/found" 0 ours $designs
"$venv/bin/python" reports/optimiser_peers_page.py target/release/sprag-design "$out" "$work" "sh reports/optimiser_peers.sh" $designs
