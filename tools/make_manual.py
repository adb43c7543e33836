#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Render the manual, doc/*.md and README.md, to HTML.

    make_manual.py PROJECT OUTPUT_DIR [PAGE]

Pages keep their names, with .html for .md; index.html is doc/index.md. Its lists of links,
heading by heading, are the navigation bar of every page; pages that it does not list come
last. Images and other files that are linked are copied, scenes of prm/ become pages, and a
scene that is named becomes a link. PAGE is where Doxygen writes, inside OUTPUT_DIR.
"""
import html
import pathlib
import re
import shutil
import sys

try:
    import markdown
    from markdown.extensions.toc import TocExtension
except ImportError:
    sys.exit("make_manual.py: the Python module markdown is missing; install python3-markdown.")

STYLE = """
body { margin: 0; font: 16px/1.5 sans-serif; color: #222; display: flex; }
nav { flex: 0 0 13em; padding: 1em 1.2em; background: #f3f3f0; min-height: 100vh;
      box-sizing: border-box; font-size: 90%; }
nav h2 { font-size: 100%; margin: 1em 0 .2em; }
nav a { display: block; padding: .1em 0; }
nav a.here { font-weight: bold; color: #222; }
main { padding: 1em 2.5em 4em; max-width: 52em; min-width: 0; }
a { color: #05609b; text-decoration: none; }
a:hover { text-decoration: underline; }
h1, h2, h3 { line-height: 1.2; margin: 1.4em 0 .5em; }
h1 { margin-top: .4em; }
code { font-size: 90%; background: #f3f3f0; padding: 0 .15em; }
pre { background: #f3f3f0; padding: .7em 1em; overflow-x: auto; }
pre code { padding: 0; }
table { border-collapse: collapse; display: block; overflow-x: auto; font-size: 92%; }
th, td { border: 1px solid #ccc; padding: .2em .6em; vertical-align: top; text-align: left; }
th { background: #f3f3f0; }
img { max-width: 100%; }
@media (max-width: 45em) { body { display: block; } nav { min-height: 0; } }
"""

PAGE = """<!DOCTYPE html>
<html lang="en">
<head><meta charset="utf-8"><meta name="viewport" content="width=device-width">
<title>{title} – strait</title><link rel="stylesheet" href="{root}style.css"></head>
<body><nav><a href="{root}index.html"><b>strait</b></a>
{navigation}
</nav><main>
{body}
</main></body></html>
"""


def slug(title, separator="-"):
    """The anchor that GitHub gives a heading."""
    kept = re.sub(r"[^\w\- ]", "", title.strip().lower())
    return kept.replace(" ", separator)


def title_of(text, fallback):
    match = re.search(r"^# (.+)$", text, re.MULTILINE)
    return match[1] if match else fallback


def outside_code(text, function):
    """Apply a function to what is neither in a code block nor in a code span."""
    parts = re.split(r"(^```.*?^```[ ]*$|^(?: {4}.*\n)+|`[^`\n]+`)", text,
                     flags=re.MULTILINE | re.DOTALL)
    return "".join(part if k % 2 else function(part) for k, part in enumerate(parts))


def to_html(text):
    # E* and p* are moduli and pressures, no emphasis.
    text = outside_code(text, lambda part: re.sub(r"(?<![\\*])(E|\bp)\*(?!\*)", r"\1\\*", part))
    converter = markdown.Markdown(extensions=["tables", "fenced_code", "sane_lists",
                                              TocExtension(slugify=slug)])
    return converter.convert(text)


class Manual:
    """All pages of the manual and where they go."""

    def __init__(self, project, output, code):
        self.project, self.output, self.code = project, output, code
        self.sources = sorted((project / "doc").glob("*.md")) + [project / "README.md"]
        self.titles = {self.target(source): title_of(source.read_text("utf-8"), source.stem)
                       for source in self.sources}
        self.titles["readme.html"] = "Overview"
        self.groups = self.read_groups()

    @staticmethod
    def target(source):
        return ("readme" if source.name == "README.md" else source.stem) + ".html"

    def read_groups(self):
        """[(heading, [(page, its name in the list)])] of doc/index.md."""
        groups, listed = [], {"index.html"}
        index = (self.project / "doc" / "index.md").read_text("utf-8")
        for line in index.splitlines():
            if line.startswith("## "):
                groups.append((line[3:], []))
            match = re.match(r"[-*] \[([^\]]+)\]\(([\w./]+)\.md\)", line)
            if match and groups:
                page = pathlib.Path(match[2]).name.lower() + ".html"
                groups[-1][1].append((page, match[1]))
                listed.add(page)
        others = [(page, title) for page, title in self.titles.items() if page not in listed]
        return [group for group in groups if group[1]] + ([("More", others)] if others else [])

    def navigation(self, here, root):
        lines = []
        for heading, pages in self.groups:
            lines.append(f"<h2>{html.escape(heading)}</h2>")
            lines += [f'<a href="{root}{page}"{" class=here" * (page == here)}>'
                      f"{html.escape(name)}</a>" for page, name in pages]
        if self.code:
            lines.append(f'<a href="{root}{self.code}">Reference of the code</a>')
        return "\n".join(lines)

    def rewritten(self, source, reference):
        """Where a relative link or image of a source file leads to in the output."""
        path, _, anchor = reference.partition("#")
        if not path or re.match(r"[a-z]+:", path):
            return reference
        target = (source.parent / path).resolve()
        if target in self.sources:
            result = self.target(target)
        elif target.suffix == ".prm" and target.is_file():
            result = self.scene_page(target)
        elif target.is_file():
            result = str(target.relative_to(self.project)).removeprefix("doc/")
            (self.output / result).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(target, self.output / result)
        else:
            raise ValueError(f"{source}: '{reference}' is no file")
        return result + ("#" + anchor if anchor else "")

    def scene_page(self, scene):
        return str(scene.relative_to(self.project)) + ".html"

    def link_scenes(self, body):
        """`prm/x.prm` becomes a link where it is not one."""
        def link(match):
            scene = self.project / match[1]
            return f'<a href="{self.scene_page(scene)}">{match[0]}</a>' \
                if scene.is_file() else match[0]
        return re.sub(r"(?<!\">)<code>(prm/[\w/]+\.prm)</code>", link, body)

    def write(self, page, title, body):
        path = self.output / page
        path.parent.mkdir(parents=True, exist_ok=True)
        root = "../" * page.count("/")
        path.write_text(PAGE.format(title=html.escape(title), root=root, body=body,
                                    navigation=self.navigation(page, root)), "utf-8")

    def write_all(self):
        self.output.mkdir(parents=True, exist_ok=True)
        (self.output / "style.css").write_text(STYLE, "utf-8")
        for source in self.sources:
            body = re.sub(r'(?<=(?:href|.src)=")([^"]*)',
                          lambda match, source=source: self.rewritten(source, match[1]),
                          to_html(source.read_text("utf-8")))
            page = self.target(source)
            self.write(page, self.titles[page], self.link_scenes(body))
        for scene in (self.project / "prm").rglob("*.prm"):
            name = str(scene.relative_to(self.project))
            self.write(name + ".html", name, f"<h1>{name}</h1>\n<pre><code>"
                       f"{html.escape(scene.read_text('utf-8'))}</code></pre>")


def main():
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    project, output, *code = sys.argv[1:]
    try:
        Manual(pathlib.Path(project).resolve(), pathlib.Path(output), *(code or [""])).write_all()
    except (OSError, ValueError) as error:
        sys.exit(f"make_manual.py: {error}")


if __name__ == "__main__":
    main()
