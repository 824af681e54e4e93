#!/usr/bin/env bash
# Build the wheel, and it alone, into WORK/wheel, with maturin in the environment WORK/venv; both are made where they are absent.
# python/wheel.sh
# PYTHON: the interpreter, 3.10 or later. WORK: by default `python` in the target folder.
# PROFILE=dev builds in a fraction of the time what runs at half the speed.
set -euo pipefail
cd "$(dirname "$0")"

# Beside the tool's own build, so that what both need is built once.
export CARGO_TARGET_DIR=${CARGO_TARGET_DIR:-$(cd .. && pwd)/target}
work=${WORK:-$CARGO_TARGET_DIR/python}
mkdir -p "$work"
[ -x "$work/venv/bin/python" ] || "${PYTHON:-python3}" -m venv "$work/venv"
"$work/venv/bin/python" -m pip --quiet --disable-pip-version-check install "maturin>=1.16,<2"
rm -rf "$work/wheel"
"$work/venv/bin/maturin" build --profile "${PROFILE:-release}" --locked --quiet --out "$work/wheel" --interpreter "$work/venv/bin/python"
