#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Run the Python of doc/python.md block by block, and check its list of examples."""
import contextlib
import io
import os
import pathlib
import re
import tempfile
import unittest

PROJECT = pathlib.Path(__file__).resolve().parents[2]
PAGE = (PROJECT / "doc" / "python.md").read_text("utf-8")


class Manual(unittest.TestCase):
    def test_blocks(self):
        blocks = re.findall(r"^```python\n(.*?)^```$", PAGE, re.MULTILINE | re.DOTALL)
        self.assertGreater(len(blocks), 4)
        names, before = {}, os.getcwd()
        with tempfile.TemporaryDirectory() as folder:
            os.chdir(folder)
            try:
                for block in blocks:
                    with self.subTest(block), contextlib.redirect_stdout(io.StringIO()):
                        exec(compile(block, "doc/python.md", "exec"), names)
            finally:
                os.chdir(before)

    def test_every_example_is_listed(self):
        listed = re.findall(r"^\| \[\w+\.py\]\(\.\./(\S+)\)", PAGE, re.MULTILINE)
        self.assertEqual(sorted(listed), sorted(str(path.relative_to(PROJECT)) for path in
                                                (PROJECT / "python/examples").glob("*.py")))


if __name__ == "__main__":
    unittest.main()
