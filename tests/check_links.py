#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Check the links of the manual, README.md and doc/*.md: check_links.py PROJECT

Every relative link and image exists, every anchor is a heading, each picture of doc/images is
shown, each page can be reached from README.md, and no line ends with a blank.
"""
import re
import sys
from pathlib import Path


def without_code(text):
    """A page without its blocks and spans of code, in which nothing is a link."""
    text = re.sub(r"^```.*?^```", "", text, flags=re.MULTILINE | re.DOTALL)
    return re.sub(r"`[^`\n]*`", "", text)


def headings(text):
    """The anchors that GitHub makes of the headings."""
    text = re.sub(r"^```.*?^```", "", text, flags=re.MULTILINE | re.DOTALL)
    titles = re.findall(r"^#+ (.+)$", text, re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", title.strip().lower()).replace(" ", "-")
            for title in titles}


def links(text):
    return [target for target in re.findall(r"\]\(([^)\s]+)\)", without_code(text))
            if not re.match(r"[a-z]+:", target)]


def check_sources(project):
    pages = {path.resolve(): path.read_text("utf-8")
             for path in [project / "README.md", *sorted((project / "doc").glob("*.md"))]}
    problems, images, leads_to = [], set(), {}
    for page, text in pages.items():
        leads_to[page] = set()
        for link in links(text):
            path, _, anchor = link.partition("#")
            target = (page.parent / path).resolve() if path else page
            if not target.exists():
                problems.append(f"{page.name}: '{link}' does not exist")
            elif anchor and target in pages and anchor not in headings(pages[target]):
                problems.append(f"{page.name}: '{link}' is no heading of {target.name}")
            images.add(target)
            leads_to[page].add(target)
        if not text.startswith("# "):
            problems.append(f"{page.name}: the first line is no title")
        for number, line in enumerate(text.split("\n"), start=1):
            if line.endswith(" "):
                problems.append(f"{page.name}:{number}: blanks at the end of the line")
    reached, todo = set(), [(project / "README.md").resolve()]
    while todo:
        page = todo.pop()
        if page in pages and page not in reached:
            reached.add(page)
            todo += leads_to[page]
    for page in pages:
        if page not in reached:
            problems.append(f"{page.name}: no link leads here")
    for image in (project / "doc" / "images").iterdir():
        if image.resolve() not in images:
            problems.append(f"{image.name}: no page shows this picture")
    return problems


def main():
    problems = check_sources(Path(sys.argv[1]))
    print("\n".join(problems))
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
