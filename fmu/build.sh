#!/usr/bin/env bash
# Build the library inside co-simulation units, beside the tool: `sprag-design export --format fmu` finds it there.
# fmu/build.sh [more arguments of cargo build]
# PROFILE=dev builds in a fraction of the time what runs slower.
set -euo pipefail
cd "$(dirname "$0")"
export CARGO_TARGET_DIR=${CARGO_TARGET_DIR:-$(cd .. && pwd)/target}
cargo build --profile "${PROFILE:-release}" --locked "$@"
