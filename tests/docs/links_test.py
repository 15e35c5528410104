#!/usr/bin/env python3
"""Links and pictures of the pages for people lead to files, and to headings, that exist.

usage: links_test.py REPOSITORY
"""
import pathlib
import re
import sys

LINK = re.compile(r"\[[^\]]*\]\(([^)\s]+)\)")


def without_code(text):
    return re.sub(r"```.*?```|`[^`\n]*`", "", text, flags=re.DOTALL)


def anchors(page):
    """Of the headings of a page, as GitHub and GitLab make them."""
    found = set()
    for heading in re.findall(r"^#+ (.*)$", page.read_text(), re.MULTILINE):
        found.add(re.sub(r"[^\w\- ]", "", heading.strip().lower()).replace(" ", "-"))
    return found


def broken_links(page):
    for target in LINK.findall(without_code(page.read_text())):
        path, _, anchor = target.partition("#")
        file = page.parent / path if path else page
        if re.match(r"[a-z]+:", target):
            continue
        if not file.exists():
            yield f"{target}: no such file"
        elif anchor and anchor not in anchors(file):
            yield f"{target}: no such heading"


def main():
    root = pathlib.Path(sys.argv[1])
    pages = [*sorted(root.glob("*.md")), *sorted((root / "docs").glob("*.md"))]
    failures = [f"{page.relative_to(root)}: {link}" for page in pages for link in broken_links(page)]
    print(*failures, f"{len(pages)} pages, {len(failures)} broken links", sep="\n")
    return 1 if failures or len(pages) < 5 else 0


if __name__ == "__main__":
    sys.exit(main())
