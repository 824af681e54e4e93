#!/bin/sh
# Remakes reports/accuracy-peers.html and .csv: integrators of others (diffsol, differential-equations) beside ours. Builds
# them first, in their own workspace: several minutes the first time; the comparison itself takes some minutes more.
set -eu
cd "$(dirname "$0")/.."
CARGO_TARGET_DIR=${CARGO_TARGET_DIR:-target}/peers
export CARGO_TARGET_DIR
cargo build --release --locked --quiet --manifest-path peers/Cargo.toml
"$CARGO_TARGET_DIR/release/sprag-design-peers"
