#!/usr/bin/env python3
"""Renew the outputs that README and guide show: python3 docs/shown.py BINARY [PAGE ...]

Every block of text that begins with `$ sprag-design`, or `$ echo '...' | sprag-design`, is run as `tests/guide.rs` runs it,
and what is shown of its output is replaced by what is printed now: as many lines as before, `...` standing for any number; a
part between two `...` is looked for by likeness. Look at the difference before it is committed. Standard library only.
"""

import difflib
import pathlib
import shlex
import shutil
import subprocess
import sys
import tempfile


def likeness(a, b):
    return difflib.SequenceMatcher(None, "\n".join(a), "\n".join(b)).ratio()


def renewed(shown, printed):
    """The lines of `shown` with today's output in their place."""
    parts, part = [], []
    for line in shown:
        if line == "...":
            parts.append(part)
            part = []
        else:
            part.append(line)
    parts.append(part)
    out, at = [], 0
    for k, part in enumerate(parts):
        if k > 0:
            out.append("...")
        if not part:
            continue
        if k == 0:
            start = 0
        elif k == len(parts) - 1:
            start = max(at, len(printed) - len(part))
        else:
            starts = range(at, max(at, len(printed) - len(part)) + 1)
            start = max(starts, key=lambda i: likeness(part, printed[i : i + len(part)]))
        new = printed[start : start + len(part)]
        out += new
        at = start + len(new)
    return out


def renew(page, binary):
    folder = tempfile.mkdtemp()
    for name in ["designs", "tests/reference"]:
        shutil.copytree(name, f"{folder}/{name}")
    lines, out, i = page.read_text().split("\n"), [], 0
    inside = False
    while i < len(lines):
        line = lines[i]
        if line.startswith("```"):
            inside = line == "```text" and not inside
        if not (inside and line.startswith(("$ sprag-design", "$ echo '"))):
            out.append(line)
            i += 1
            continue
        command = line[2:]
        out.append(line)
        i += 1
        while command.endswith("\\"):
            command = command[:-1] + " " + lines[i].strip()
            out.append(lines[i])
            i += 1
        shown = []
        while not (lines[i].startswith("```") or lines[i].startswith("$ ")):
            shown.append(lines[i])
            i += 1
        given, _, command = command.rpartition("' | ")
        words = shlex.split(command)[1:]
        given = given.removeprefix("echo '")
        run = subprocess.run([binary, *words, "--quiet"], cwd=folder, capture_output=True, text=True, input=given)
        # A refusal stands on standard error.
        text = run.stdout if run.returncode < 2 else run.stdout + run.stderr
        printed = [p.rstrip() for p in text.rstrip("\n").split("\n")]
        tail = []
        while shown and not shown[-1].strip():
            tail.append(shown.pop())
        out += (renewed(shown, printed) if shown else []) + tail
    page.write_text("\n".join(out))
    shutil.rmtree(folder)


if __name__ == "__main__":
    binary = str(pathlib.Path(sys.argv[1]).resolve())
    pages = sys.argv[2:] or ["README.md", *sorted(str(p) for p in pathlib.Path("docs/src").rglob("*.md"))]
    for page in pages:
        renew(pathlib.Path(page), binary)
