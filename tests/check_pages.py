#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Check the manual as HTML: check_pages.py PROJECT FOLDER [PYTHON_PACKAGE]

Sphinx builds it without a warning. Every reference of a page leads somewhere, every parameter
has an anchor, tables and formulas are rendered as such, and nothing is loaded from elsewhere. In
headless Chromium, if there is one, the search finds a parameter and no page is wider than a
phone. Status 77 (a skipped test) if Sphinx is not installed or, after all the rest, if there is
no Chromium.
"""
import importlib.util
import os
import re
import shutil
import subprocess
import sys
from html.parser import HTMLParser
from pathlib import Path

NEEDED = {"sphinx": "python3-sphinx", "myst_parser": "python3-myst-parser", "furo": "furo"}
PHONE = 400  # pixels
# A frame as wide as a phone shows all pages, one after the other, which tell it their widths.
FRAMES = f"""<!DOCTYPE html><title>0</title><iframe width={PHONE} height=800></iframe><script>
const pages = PAGES, frame = document.querySelector("iframe"), wide = [];
const next = () => {{ if (pages.length) frame.src = pages.shift();
                      else document.title = "WIDE " + wide.join(" "); }};
onmessage = event => {{ const [page, width] = event.data;
                        if (width > {PHONE}) wide.push(page + ":" + width);
                        next(); }};
next();
</script>"""
TELL = """<script>addEventListener("load", () => parent.postMessage(
  [location.pathname.split("/").pop(), document.documentElement.scrollWidth], "*"));</script>"""


class Page(HTMLParser):
    """What a rendered page refers to and loads, and the anchors that it has."""

    def __init__(self, path):
        super().__init__()
        self.references, self.loaded, self.anchors = [], [], set()
        self.text, self.n_tables, self.n_formulas, self.code = "", 0, 0, 0
        self.feed(path.read_text("utf-8"))

    def handle_starttag(self, tag, attrs):
        attributes = dict(attrs)
        targets = [attributes[name] for name in ("href", "src") if attributes.get(name)]
        self.references += targets
        self.loaded += targets if tag != "a" else []
        self.anchors |= {attributes["id"]} if "id" in attributes else set()
        self.n_tables += tag == "table" and "docutils" in attributes.get("class", "")
        self.n_formulas += tag == "math"
        self.code += tag in ("code", "pre", "script", "style")

    def handle_endtag(self, tag):
        self.code -= tag in ("code", "pre", "script", "style")

    def handle_data(self, data):
        if not self.code:
            self.text += data


def make(project, folder, package):
    """Build the pages with Sphinx, and return its complaints."""
    shutil.rmtree(folder, ignore_errors=True)
    environment = {**os.environ, "STRAIT_PYTHON_PACKAGE": package, "STRAIT_VERSION": "test"}
    result = subprocess.run([sys.executable, "-m", "sphinx", "-q", "-W", "--keep-going",
                             "-b", "html", "-d", folder / "doctrees", "-c", project / "doc",
                             project, folder / "html"], env=environment, text=True, check=False,
                            stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    return [result.stdout] if result.returncode or result.stdout else []


def check_references(pages, html):
    problems = []
    for path, page in pages.items():
        for reference in page.references:
            target, _, anchor = reference.partition("#")
            if re.match(r"(https?|mailto|data):", target) or "code/" in target:
                continue  # Doxygen writes to code
            other = (path.parent / target.split("?")[0]).resolve() if target else path
            if not other.exists():
                problems.append(f"{path.name}: '{reference}' does not exist")
            elif anchor and other in pages and anchor not in pages[other].anchors:
                problems.append(f"{path.name}: '{reference}' has no such anchor")
        problems += [f"{path.name}: '{target}' is loaded from elsewhere"
                     for target in page.loaded if re.match(r"https?:|//|/", target)]
        problems += [f"{path.name}: '{remains}' was not rendered" for remains in re.findall(
            r"\|\s*:?-+:?\s*\||\*\*\w[^*,()]*\*\*|\]\([^)]*\)|```|\$\$|\\frac", page.text)]
    for style in html.rglob("*.css"):
        if re.search(r"@import|url\(['\"]?(https?:|/)", style.read_text("utf-8")):
            problems.append(f"{style.name} loads something from elsewhere")
    return problems


def rows_below(heading, text):
    """(section, first cell) of each row of the tables whose first column has this heading."""
    rows, section, inside = [], "", False
    for line in text.splitlines():
        cell = line.split("|")[1].strip(" `") if line.startswith("|") else ""
        if line.startswith("#"):
            section = line.strip("# ")
        inside = bool(cell) and (inside or cell == heading)
        if inside and cell != heading and cell.strip("-:"):
            rows.append((section, cell))
    return rows


def anchor_of(name):
    """The identifier that docutils makes: small letters and digits, joined by hyphens."""
    return re.sub(r"[^a-z0-9]+", "-", name.lower()).strip("-")


def check_contents(project, pages, html):
    """Check that pages have all tables and anchors of parameters, and that there are formulas."""
    problems = []
    for source in [project / "README.md", *(project / "doc").glob("*.md")]:
        text = source.read_text("utf-8")
        page = pages[html / source.relative_to(project).with_suffix(".html")]
        n_tables = len(re.findall(r"^ *\|[ :|-]*-[ :|-]*\|$", text, re.MULTILINE))
        if page.n_tables != n_tables:
            problems.append(f"{source.name}: {page.n_tables} of its {n_tables} tables are there")
    for page, heading in (("parameters", "Parameter"), ("results", "column")):
        names = rows_below(heading, (project / "doc" / f"{page}.md").read_text("utf-8"))
        anchors = pages[html / "doc" / f"{page}.html"].anchors
        problems += [f"{page}.md: {section}/{name} has no anchor" for section, name in names
                     if anchor_of(f"{section}-{name}") not in anchors] \
            or ([] if names else [f"{page}.md: no table begins with '{heading}'"])
    if sum(page.n_formulas for page in pages.values()) == 0:
        problems.append("no page has a formula")
    return problems


def in_browser(browser, folder, url):
    """The page after its scripts, and what the console said."""
    result = subprocess.run(
        [browser, "--headless=new", "--no-sandbox", "--disable-gpu", "--enable-logging=stderr",
         f"--user-data-dir={folder / 'profile'}", "--allow-file-access-from-files",
         "--virtual-time-budget=60000", "--dump-dom", url],
        text=True, capture_output=True, check=False, timeout=300)
    return result.stdout, [line for line in result.stderr.splitlines() if "CONSOLE" in line]


def check_in_browser(browser, folder, pages):
    html = folder / "html"
    found, problems = in_browser(browser, folder,
                                 (html / "search.html").as_uri() + "?q=Hurst+exponent")
    first = re.search(r'<ul class="search".*?href="([^"]*)"', found, re.DOTALL)
    if not first or not first[1].endswith("doc/parameters.html#surface-hurst-exponent"):
        problems.append(f"the search finds {first and first[1]} first")
    for path in pages:
        path.write_text(path.read_text("utf-8").replace("</body>", TELL + "</body>"), "utf-8")
    names = [path.relative_to(html).as_posix() for path in pages if path.parent.name == "doc"]
    (html / "frames.html").write_text(FRAMES.replace("PAGES", str(names)), "utf-8")
    shown, complaints = in_browser(browser, folder, (html / "frames.html").as_uri())
    title = re.search("<title>(.*?)</title>", shown)[1]
    if title.strip() != "WIDE":
        problems.append(f"wider than a phone: {title}")
    return problems + complaints


def main():
    project, folder = (Path(argument).resolve() for argument in sys.argv[1:3])
    missing = [package for module, package in NEEDED.items()
               if importlib.util.find_spec(module) is None]
    if missing:
        print(f"The manual is not made: {', '.join(missing)} not installed.")
        return 77
    problems = make(project, folder, (sys.argv[3:] or [""])[0])
    html = folder / "html"
    pages = {path: Page(path) for path in sorted(html.rglob("*.html"))}
    problems += check_references(pages, html) + check_contents(project, pages, html)
    browser = next(filter(None, map(shutil.which, ("chromium", "chromium-browser",
                                                   "google-chrome"))), None)
    if browser:
        problems += check_in_browser(browser, folder, pages)
    print("\n".join(problems))
    if problems:
        return 1
    shutil.rmtree(folder)
    if not browser:
        print("No Chromium here: search and width of the pages were not tested.")
        return 77
    return 0


if __name__ == "__main__":
    sys.exit(main())
