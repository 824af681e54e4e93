#!/usr/bin/env bash
# The page of build.sh in Chromium, opened from disk, beside the command: try/test.sh PAGE.html BINARY [FOLDER for pictures]
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
. "$here/../tests/install.sh"
page=$(realpath "$1") binary=$(realpath "$2") pictures=$(realpath -m "${3:-$(mktemp -d)}")
mkdir -p "$pictures"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
browser "$work"
cp "$here/test.mjs" "$work"
cd "$work"
node test.mjs "$page" "$binary" "$here/../designs/huang2017-multi-arc.toml" "$pictures"
