#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Tests that check_links.py, check_pages.py, check_manual.py and check_doxygen.py find
mistakes."""
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
import check_doxygen  # noqa: E402
import check_links  # noqa: E402
import check_manual  # noqa: E402
import check_pages  # noqa: E402


class Pages(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.project = Path(self.temporary.name)
        (self.project / "doc" / "images").mkdir(parents=True)
        self.write("README.md", "# R\n[a](doc/a.md#two-words)\n")
        self.write("doc/a.md", "# A\n## Two words\n")

    def tearDown(self):
        self.temporary.cleanup()

    def write(self, name, text):
        (self.project / name).write_text(text, encoding="utf-8")


class Links(Pages):
    def expect_one(self, complaint):
        problems = check_links.check_sources(self.project)
        self.assertEqual(len(problems), 1, problems)
        self.assertIn(complaint, problems[0])

    def test_good_pages(self):
        self.write("doc/a.md", "# A\n## Two words\n`[no](link)` [web](https://example.org)\n")
        self.assertEqual(check_links.check_sources(self.project), [])

    def test_missing_page(self):
        self.write("doc/a.md", "# A\n## Two words\n[b](b.md)\n")
        self.expect_one("'b.md' does not exist")

    def test_missing_heading(self):
        self.write("doc/a.md", "# A\n## Other words\n")
        self.expect_one("is no heading of a.md")

    def test_orphan(self):
        self.write("doc/b.md", "# B\n[a](a.md)\n")
        self.expect_one("b.md: no link leads here")

    def test_unused_picture(self):
        self.write("doc/images/x.png", "")
        self.expect_one("x.png: no page shows this picture")


class Rendered(Pages):
    """Pages as Sphinx writes them."""

    def problems(self, body):
        self.write("doc/b.html", '<a href="#here" id="here">b</a>')
        self.write("doc/a.html", body)
        html = self.project.resolve() / "doc"
        pages = {path: check_pages.Page(path) for path in html.glob("*.html")}
        return check_pages.check_references(pages, html)

    def test_good_pages(self):
        self.assertEqual(self.problems('<a href="b.html#here">b</a> <code>**no**</code>'
                                       '<a href="https://example.org">web</a>'), [])

    def test_mistakes(self):
        for body, complaint in (('<a href="c.html">c</a>', "'c.html' does not exist"),
                                ('<a href="b.html#there">b</a>', "has no such anchor"),
                                ('<img src="https://example.org/x.png">', "from elsewhere"),
                                ('<script src="/x.js"></script>', "from elsewhere"),
                                ("<p>**not bold**</p>", "was not rendered"),
                                ("<p>| a | b |\n|---|---|</p>", "was not rendered"),
                                ("<p>$$ x $$</p>", "was not rendered")):
            self.assertIn(complaint, "\n".join(self.problems(body)), body)

    def test_style_that_loads_a_font(self):
        self.write("doc/a.css", "@import url(https://example.org/a.css);")
        self.assertIn("a.css loads something", "\n".join(self.problems("")))


class Commands(Pages):
    def blocks(self, text):
        self.write("doc/a.md", "# A\n\n" + text)
        return check_manual.blocks_of(self.project / "doc" / "a.md")

    def test_comments(self):
        block, = self.blocks("<!-- manual: run: --set \"A/B=c d\" -->\n```sh\nfrobnicate\n```\n")
        self.assertIsNone(block.problem)
        self.assertEqual(block.arguments, ["--set", "A/B=c d"])
        block, = self.blocks("<!-- manual: dry-run -->\n```sh\ntools/run x.prm\n```\n")
        self.assertEqual(block.arguments, ["--dry-run"])

    def test_blocks_without_comment(self):
        block, = self.blocks("```sh\ntools/run x.prm\n```\n")
        self.assertIn("no comment", block.problem)
        block, = self.blocks("```\ntools/run x.prm\n```\n")
        self.assertIn("begins with ```sh", block.problem)
        block, = self.blocks("<!-- manual: skip -->\n```sh\ntools/test\n```\n")
        self.assertIn("must say why", block.problem)
        self.assertEqual(self.blocks("```\nstep 1 of 3\n```\n"), [])

    def test_a_comment_without_commands(self):
        with self.assertRaises(SystemExit):
            self.blocks("<!-- manual: run -->\n\ntext\n")

    def test_indented_block(self):
        block, = self.blocks("    tools/run x.prm   # 1 s\n    … --set \"A=b\"\n")
        self.assertIsNone(block.problem)
        self.assertEqual(block.how, "dry-run")
        self.assertEqual(block.text, "tools/run x.prm   # 1 s\ntools/run x.prm --set \"A=b\"\n")

    def test_failures_are_seen(self):
        block, = self.blocks("<!-- manual: run -->\n```sh\ntrue\nfalse\ntrue\n```\n")
        (self.project / "build").mkdir()
        self.assertIn("exit status 1", check_manual.run(block, "/bin/true", self.project))


class Docstrings(unittest.TestCase):
    def missing(self, member, kind, scope="class strait::Grid"):
        return f"a.h:1: warning: Member {member} ({kind}) of {scope} is not documented."

    def test_names_that_say_it_all(self):
        for member, kind in (("size() const", "function"), ("nx", "variable"),
                             ("Grid(int n)", "function"), ("bind(Section section)", "function"),
                             ("operator[](int i)", "function"), ("Matrix", "typedef")):
            self.assertTrue(check_doxygen.speaks_for_itself(self.missing(member, kind)), member)

    def test_what_needs_a_docstring(self):
        for warning in (self.missing("row(int i) const", "function"),
                        self.missing("Kind", "enumeration"),
                        self.missing("sum(double x)", "function", "namespace strait"),
                        "a.h:1: warning: Compound strait::Grid is not documented.",
                        "a.h:1: warning: argument 'x' is not found"):
            self.assertFalse(check_doxygen.speaks_for_itself(warning), warning)


if __name__ == "__main__":
    unittest.main()
