# SPDX-License-Identifier: GPL-2.0-or-later
"""What the manual has in HTML beyond its Markdown pages.

- The lists of links of doc/index.md, heading by heading, are the navigation.
- Each parameter and each column of a table of results has an anchor, which the search finds; a
  parameter that is named in full in another page is a link to it.
- Each scene and each script that is named or linked has a page of its own.
- Formulas are MathML, which browsers render by themselves.
"""
import functools
import pathlib
import posixpath
import re

from docutils import nodes
from docutils.utils.math.latex2mathml import tex2mathml
from pygments import highlight
from pygments.formatters import HtmlFormatter
from pygments.lexers import get_lexer_by_name
from sphinx import addnodes
from sphinx.util import logging
from sphinx.util.osutil import relative_uri

LOGGER = logging.getLogger(__name__)
# Files that become pages, and the language that they are in.
PAGES = {"prm/**/*.prm": "ini", "python/examples/*.py": "python"}


def add_navigation(app, name, source):
    """A hidden table of contents behind each list of pages of the index."""
    if name != app.config.root_doc:
        return

    def with_contents(match):
        # Pages as Sphinx names them, from the top of the project.
        pages = re.findall(r"^- \[([^\]]+)\]\(([\w./]+)\.(?:md|rst)\)", match[2], re.MULTILINE)
        entries = "\n".join(f"{title} </{posixpath.normpath('doc/' + page)}>"
                            for title, page in pages)
        return (f"## {match[1]}\n{match[2]}\n```{{toctree}}\n:hidden:\n:caption: {match[1]}\n\n"
                f"{entries}\n```\n\n")

    source[0] = re.sub(r"^## (.+)\n((?:(?!## ).*\n)*)", with_contents, source[0],
                       flags=re.MULTILINE)


def name_rows(app, document):
    """Anchors for the rows of the references of parameters and columns."""
    page = app.env.docname
    kind = {"doc/parameters": "parameter", "doc/results": "column"}.get(page)
    if not kind:
        return
    domain = app.env.get_domain("std")
    for table in document.findall(nodes.table):
        section = table.parent
        heading = next(table.findall(nodes.entry)).astext().lower()
        if not isinstance(section, nodes.section) or heading != kind:
            continue
        table["classes"].append("names")
        title = section.next_node(nodes.title).astext().replace(" / ", "/")
        for row in next(table.findall(nodes.tbody)).findall(nodes.row):
            name = row[0].astext().replace("’", "'")  # as before typesetting
            full = f"{title}/{name}" if kind == "parameter" else f"{name} ({title})"
            anchor = nodes.make_id(f"{title}-{name}")
            row[0]["ids"].append(anchor)
            domain.note_object(kind, full, anchor, location=row)


def parameter_named(app, text):
    """(page, anchor) of the parameter that some literal text names in full, or None."""
    objects = app.env.get_domain("std").objects
    return objects.get(("parameter", text.split(" = ")[0].strip()))


@functools.lru_cache(None)
def files_with_pages(project):
    """The language of each file that has a page, by its name from the top of the project."""
    return {path.relative_to(project).as_posix(): language for pattern, language in PAGES.items()
            for path in sorted(pathlib.Path(project).glob(pattern))}


def add_links(app, document, page):
    """What is named in literal text becomes a link, as do links to files that have a page."""
    def link(target, anchor=""):
        uri = relative_uri(app.builder.get_target_uri(page), app.builder.get_target_uri(target))
        return nodes.reference("", "", internal=True, refuri=uri + anchor)

    for literal in list(document.findall(nodes.literal)):
        if isinstance(literal.parent, (nodes.reference, nodes.title)):
            continue
        named = parameter_named(app, literal.astext())
        if named and named[0] != page:
            reference = link(named[0], "#" + named[1])
        elif literal.astext() in files_with_pages(app.srcdir):
            reference = link(literal.astext())
        else:
            continue
        literal.replace_self(reference)
        reference += literal
    for download in list(document.findall(addnodes.download_reference)):
        path = (pathlib.Path(app.srcdir) / page).parent / download["reftarget"]
        file = path.resolve().relative_to(app.srcdir).as_posix()
        if file in files_with_pages(app.srcdir):
            reference = link(file)
            reference += download.children
            download.replace_self(reference)


def source_pages(app):
    """A page of each scene and script."""
    for name, language in files_with_pages(app.srcdir).items():
        code = highlight((pathlib.Path(app.srcdir) / name).read_text("utf-8"),
                         get_lexer_by_name(language), HtmlFormatter())
        yield name, {"title": name, "body": f"<h1>{name}</h1>\n{code}"}, "page.html"


def visit_math(translator, node):
    """A formula in the line or, of a block, on a line of its own."""
    try:
        translator.body.append(tex2mathml(node.astext(), inline=isinstance(node, nodes.math)))
    except SyntaxError as error:
        LOGGER.warning("formula '%s': %s", node.astext(), error, location=node)
    raise nodes.SkipNode


def finish(app, error):
    """index.html leads to the first page; the theme, which Debian has in parts that a server
    joins, becomes one that a browser reads from the disk."""
    if error is not None or app.builder.format != "html":
        return
    first = app.builder.get_target_uri(app.config.root_doc)
    (pathlib.Path(app.outdir) / "index.html").write_text(
        f'<!DOCTYPE html><title>strait</title><meta http-equiv="refresh" '
        f'content="0; url={first}"><a href="{first}">The manual</a>\n', encoding="utf-8")
    static = pathlib.Path(app.outdir) / "_static"
    style, script = static / "styles" / "furo.css", static / "scripts" / "furo.js"
    style.write_text(re.sub(r"@import url\(/javascript/[^)]*\);", "", style.read_text("utf-8")),
                     encoding="utf-8")
    part = re.compile(r'^import \w+ from "./([\w.-]+)";$', re.MULTILINE)
    script.write_text(part.sub(lambda match: (script.parent / match[1]).read_text("utf-8"),
                               script.read_text("utf-8")), encoding="utf-8")


def setup(app):
    """Sphinx calls this."""
    for kind in ("parameter", "column"):
        app.add_object_type(kind, kind)
    app.add_html_math_renderer("mathml", (visit_math, None), (visit_math, None))
    app.connect("source-read", add_navigation)
    app.connect("doctree-read", name_rows)
    app.connect("doctree-resolved", add_links)
    app.connect("html-collect-pages", source_pages)
    app.connect("build-finished", finish)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
