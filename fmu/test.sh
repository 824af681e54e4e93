#!/usr/bin/env bash
# Build the library of co-simulation units, export one of each version of FMI, validate and run them under FMPy; a train around a
# unit; three units as the FMI cross-check wants them, replayed by FMPy and libcosim.
# fmu/test.sh
# PYTHON: the interpreter. WORK: folder of the environment and of the units, kept for the next time.
# TOOL, LIBRARY: tool and library that are built already, with the tests of the library run.
# PROFILE=dev builds in a fraction of the time what runs slower.
set -euo pipefail
cd "$(dirname "$0")"
stage() { printf '\n-- fmu: %s (at %d s)\n' "$1" "$SECONDS"; }

python=${PYTHON:-python3}
export CARGO_TARGET_DIR=${CARGO_TARGET_DIR:-$(cd .. && pwd)/target}
profile=${PROFILE:-release}
built=$CARGO_TARGET_DIR/$([ "$profile" = dev ] && echo debug || echo "$profile")
work=${WORK:-$CARGO_TARGET_DIR/fmu}
mkdir -p "$work"

cargo fmt --check

stage "library"
if [ -z "${LIBRARY:-}" ]; then
    PROFILE=$profile ./build.sh --quiet
    # The paths of URIs.
    cargo test --profile "$profile" --locked --quiet
    LIBRARY=$(find "$built" -maxdepth 1 -name '*sprag_design_fmu.so' -o -maxdepth 1 -name '*sprag_design_fmu.d[yl]l*')
fi
if [ -z "${TOOL:-}" ]; then
    cargo build --profile "$profile" --locked --quiet --manifest-path ../Cargo.toml
    TOOL=$built/sprag-design
fi
ls -sh "$LIBRARY"

stage "environment"
[ -x "$work/venv/bin/python" ] || "$python" -m venv "$work/venv"
pip() { "$work/venv/bin/python" -m pip --quiet --disable-pip-version-check "$@"; }
pip install "fmpy==0.3.32"
pip install --only-binary :all: "libcosimpy==0.0.6" || echo "libcosim has no wheel for this platform: the cross-check goes without it"

stage "units"
"$work/venv/bin/python" tests/units.py "$TOOL" "$LIBRARY" ../designs/huang2017-multi-arc.toml "$work" \
    ../docs/src/co-simulation.md

stage "a train around the unit"
"$work/venv/bin/python" tests/drivetrain.py "$TOOL" "$LIBRARY" ../designs/huang2017-multi-arc.toml "$work"

stage "cross-check"
"$work/venv/bin/python" tests/cross_check.py "$TOOL" "$LIBRARY" ../designs "$work"
stage "done"
