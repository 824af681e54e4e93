#!/bin/sh
# Other optimisers on the evaluator of `sprag-design optimize`: reports/optimiser-peers.{csv,html}. An hour; outside CI.
# Needs Rust, Python 3 with venv, and PyPI.
set -eu
cd "$(dirname "$0")/.."
cargo build --release
CARGO_TARGET_DIR=target/peers cargo build --release --manifest-path peers/optimisers/Cargo.toml
venv=target/peers/venv
[ -x "$venv/bin/python" ] || python3 -m venv "$venv"
"$venv/bin/pip" install --quiet scipy==1.17.1 pymoo==0.6.2 matplotlib numpy
out=reports/optimiser-peers
designs=$(ls tests/optimise/designs/[abc]-*.toml)
"$venv/bin/python" reports/optimiser_peers.py target/release/sprag-design "$out" "${EVALUATIONS:-20000}" $designs
target/peers/release/sprag-design-optimiser-peers target/release/sprag-design $designs \
    2>>"$out-courses.jsonl" >>"$out.csv"
"$venv/bin/python" reports/optimiser_peers_page.py target/release/sprag-design "$out" "sh reports/optimiser_peers.sh" $designs
rm "$out-courses.jsonl"
