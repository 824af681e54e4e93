#!/usr/bin/env bash
# The pictures of the guide: docs/pictures.sh BINARY. Makes the pages that the guide shows and the studio with BINARY, and a picture
# of each, at most 1280 px wide and 120 kB large, in docs/src/. Look at each before it is committed. Installs what it needs:
# Chromium, Node.js and ImageMagick from Debian's packages, playwright-core from npm.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
. "$here/../tests/install.sh"
binary=$(realpath "$1")
out=$here/src
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
need convert imagemagick
browser "$work"
cp "$here/pictures.mjs" "$work"
cp -r "$here/../designs" "$work"
cd "$work"
tool() { "$binary" "$@" --quiet >/dev/null; }
tool new --for two-speed --bore 40 --torque 1000 -o mine.toml
tool check mine.toml --report check.html
tool optimize mine.toml -o better.toml --report optimize.html
tool compare mine.toml better.toml --report compare.html
tool simulate designs/huang2017-multi-arc.toml --scenario high-10 --report simulate.html
node pictures.mjs "$binary" mine.toml check.html optimize.html=Geometry:1 compare.html=Profiles:2 simulate.html=Histories:5
for picture in check optimize compare simulate studio; do
    convert "$picture.png" +dither -colors 128 -define png:compression-level=9 "PNG8:$out/$picture.png"
    bytes=$(stat -c %s "$out/$picture.png")
    printf '%s.png: %d kB\n' "$picture" $((bytes / 1000))
    [ "$bytes" -le 120000 ] || { echo "more than 120 kB"; exit 1; }
done
