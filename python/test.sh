#!/usr/bin/env bash
# Build the wheel, install it into an environment of its own and into one without cargo, check the types, run the tests, measure.
# python/test.sh [more arguments of pytest]
# PYTHON: the interpreter, 3.10 or later. WORK: folder of the environment and of the wheel, kept for the next time.
# PROFILE=dev builds in a fraction of the time what runs at half the speed.
# EXTRAS=1 installs Optuna, OpenMDAO and what runs the notebook too; without them their examples are left out.
set -euo pipefail
cd "$(dirname "$0")"
stage() { printf '\n-- python: %s (at %d s)\n' "$1" "$SECONDS"; }

python=${PYTHON:-python3}
export CARGO_TARGET_DIR=${CARGO_TARGET_DIR:-$(cd .. && pwd)/target}
export WORK=${WORK:-$CARGO_TARGET_DIR/python}

cargo fmt --check

stage "wheel"
./wheel.sh
ls -sh "$WORK/wheel"

stage "a fresh environment without cargo"
fresh=$WORK/fresh
rm -rf "$fresh"
"$python" -m venv "$fresh"
"$fresh/bin/python" -m pip --quiet --disable-pip-version-check install --only-binary :all: "$WORK"/wheel/*.whl
design=$(cd .. && pwd)/designs/huang2017-multi-arc.toml
(
    cd /
    run() { env -i PATH="$fresh/bin:/usr/bin:/bin" "$@"; }
    run sh -c 'command -v cargo rustc' && echo "cargo is one of the system's programs: what follows says less"
    run python -c 'import sys, sprag_design as sd; print(sd.__file__, sd.Design.load(sys.argv[1]).check().verdict, sep="\n")' "$design"
    run sprag-design --version
    run sprag-design check "$design" --quiet >/dev/null
)

stage "environment"
pip() { "$WORK/venv/bin/python" -m pip --quiet --disable-pip-version-check "$@"; }
pip install numpy pandas pandas-stubs matplotlib scipy mypy pytest
[ -z "${EXTRAS:-}" ] || pip install 'optuna>=5' openmdao nbclient nbformat ipykernel
pip install --force-reinstall --no-deps "$WORK"/wheel/*.whl

stage "types"
# The stubs of the compiled part are held against it, then everything against the stubs.
"$WORK/venv/bin/python" -m mypy.stubtest sprag_design._core
"$WORK/venv/bin/python" -m mypy

stage "tests"
"$WORK/venv/bin/python" -m pytest -q "$@"

stage "what a call costs, and what a second thread brings"
"$WORK/venv/bin/python" measure.py || echo "not held here: ask again on a machine that does nothing else"
stage "done"
