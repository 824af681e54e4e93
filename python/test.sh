#!/usr/bin/env bash
# Build the wheel, install it into an environment of its own, check the types, run the tests.
# python/test.sh [more arguments of pytest]
# PYTHON: the interpreter, 3.10 or later. WORK: folder of the environment and of the wheel, kept for the next time.
# PROFILE=dev builds in a fraction of the time what runs at half the speed.
# EXTRAS=1 installs Optuna and OpenMDAO too; without them their examples are left out.
set -euo pipefail
cd "$(dirname "$0")"
stage() { printf '\n-- python: %s (at %d s)\n' "$1" "$SECONDS"; }

python=${PYTHON:-python3}
# Beside the tool's own build, so that what both need is built once.
export CARGO_TARGET_DIR=${CARGO_TARGET_DIR:-$(cd .. && pwd)/target}
work=${WORK:-$CARGO_TARGET_DIR/python}
mkdir -p "$work"

cargo fmt --check

stage "environment"
[ -x "$work/venv/bin/python" ] || "$python" -m venv "$work/venv"
pip() { "$work/venv/bin/python" -m pip --quiet --disable-pip-version-check "$@"; }
pip install "maturin>=1.16,<2" numpy pandas pandas-stubs matplotlib scipy mypy pytest
[ -z "${EXTRAS:-}" ] || pip install optuna openmdao

stage "wheel"
rm -rf "$work/wheel"
"$work/venv/bin/maturin" build --profile "${PROFILE:-release}" --locked --quiet --out "$work/wheel" --interpreter "$work/venv/bin/python"
ls -sh "$work/wheel"
pip install --force-reinstall --no-deps "$work"/wheel/*.whl

stage "types"
# The stubs of the compiled part are held against it, then everything against the stubs.
"$work/venv/bin/python" -m mypy.stubtest sprag_design._core
"$work/venv/bin/python" -m mypy

stage "tests"
"$work/venv/bin/python" -m pytest -q "$@"
stage "done"
