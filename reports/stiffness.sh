#!/bin/sh
# Remakes reports/stiffness.html: both Huang designs, every contact law beside finite elements (a second).
set -eu
cd "$(dirname "$0")/.."
cargo build --release --quiet
target/release/sprag-design stiffness designs/huang2017-single-arc.toml designs/huang2017-multi-arc.toml \
    --contact roller,din26281,hertz,slice,elastic --max-torque 100 --pressure \
    --fem tests/reference/fem_single_arc.csv --fem tests/reference/fem_multi_arc.csv --fem-model "6 mm layer|long path" \
    --report reports/stiffness.html >/dev/null
