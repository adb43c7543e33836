#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Check the links of the manual.

    check_links.py sources PROJECT           README.md and doc/*.md
    check_links.py html PROJECT FOLDER       the pages that tools/make_manual.py makes

sources: every relative link and image exists, every anchor is a heading, each picture of
doc/images is shown, and each page can be reached from README.md.
html: the same of what was rendered, and that tables came out as tables. Status 77 (a
skipped test) where the Python module markdown is not installed.
"""
import importlib.util
import re
import shutil
import subprocess
import sys
from html.parser import HTMLParser
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


class Page(HTMLParser):
    """What a rendered page refers to and what can be referred to."""

    def __init__(self, path):
        super().__init__()
        self.references, self.anchors, self.text, self.n_tables = [], set(), "", 0
        self.code = 0
        self.feed(path.read_text("utf-8"))

    def handle_starttag(self, tag, attrs):
        attributes = dict(attrs)
        self.references += [attributes[name] for name in ("href", "src") if name in attributes]
        self.anchors |= {attributes["id"]} if "id" in attributes else set()
        self.n_tables += tag == "table"
        self.code += tag in ("code", "pre")

    def handle_endtag(self, tag):
        self.code -= tag in ("code", "pre")

    def handle_data(self, data):
        if not self.code:
            self.text += data


def check_html(project, folder):
    shutil.rmtree(folder, ignore_errors=True)
    subprocess.run([sys.executable, project / "tools" / "make_manual.py", project, folder],
                   check=True)
    pages = {path.resolve(): Page(path) for path in sorted(folder.rglob("*.html"))}
    problems = []
    for path, page in pages.items():
        for reference in page.references:
            target, _, anchor = reference.partition("#")
            if re.match(r"[a-z]+:", target):
                continue
            other = (path.parent / target).resolve() if target else path
            if not other.exists():
                problems.append(f"{path.name}: '{reference}' does not exist")
            elif anchor and anchor not in pages[other].anchors:
                problems.append(f"{path.name}: '{reference}' has no such anchor")
        for remains in re.findall(r"\|\s*:?-+:?\s*\||\*\*\w|\]\([^)]*\)|```", page.text):
            problems.append(f"{path.name}: '{remains}' was not rendered")
    for source in [project / "README.md", *(project / "doc").glob("*.md")]:
        n_tables = len(re.findall(r"^ *\|[ :|-]*-[ :|-]*\|$",
                                  source.read_text("utf-8"), re.MULTILINE))
        name = "readme" if source.name == "README.md" else source.stem
        if pages[(folder / f"{name}.html").resolve()].n_tables != n_tables:
            problems.append(f"{source.name}: not all of its {n_tables} tables were rendered")
    if not problems:
        shutil.rmtree(folder)
    return problems


def main():
    what, project, *folder = sys.argv[1:]
    if what == "html" and importlib.util.find_spec("markdown") is None:
        print("python3-markdown is not installed: the manual is not rendered")
        return 77
    problems = check_sources(Path(project)) if what == "sources" \
        else check_html(Path(project), Path(folder[0]))
    print("\n".join(problems))
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
