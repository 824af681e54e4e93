"""Links of the book in the folder given: mdbook writes .html for every .md, also for files outside the book, which stay .md;
these are put right. Fails with a list where a link leads nowhere."""

import pathlib
import re
import sys
import urllib.parse

book = pathlib.Path(sys.argv[1])
nowhere = []
for page in sorted(book.rglob("*.html")):
    if page.name in ("print.html", "404.html", "toc.html"):
        continue  # every page in one, with the links of pages in folders; a page for servers; a frame

    def put_right(match):
        attribute, target = match.groups()
        if re.match(r"[a-z]+:", target):
            return match[0]
        path = page.parent / urllib.parse.unquote(target)
        if path.exists():
            return match[0]
        if path.with_suffix(".md").exists():
            return f'{attribute}="{target.removesuffix(".html")}.md'
        nowhere.append(f"{page.relative_to(book)}: {target}")
        return match[0]

    text = page.read_text()
    mended = re.sub(r'(href|src)="([^"#?]+)', put_right, text)
    if mended != text:
        page.write_text(mended)
if nowhere:
    sys.exit("links that lead nowhere:\n  " + "\n  ".join(nowhere))
