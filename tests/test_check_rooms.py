#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Tests of check_rooms.py on small projects."""
import os
import subprocess
import sys
import tempfile
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
LICENCE = "// SPDX-License-Identifier: GPL-2.0-or-later\n"


class House(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = folder.name
        self.unit("contact/a", [], [])

    def write(self, name, text):
        path = os.path.join(self.path, name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "w", encoding="utf-8") as file:
            file.write(LICENCE + text)

    def unit(self, name, of_header, of_source):
        lines = [f"#include <strait/{other}.h>\n" for other in of_header]
        self.write(f"include/strait/{name}.h", "#pragma once\n" + "".join(lines))
        self.write(f"source/{name}.cc", "".join(
            f"#include <strait/{other}.h>\n" for other in [name, *of_source]))

    def check(self, *options):
        done = subprocess.run(
            [sys.executable, os.path.join(HERE, "check_rooms.py"), self.path, *options],
            capture_output=True, text=True, check=False)
        return done.returncode, done.stdout + done.stderr

    def assert_refused(self, *words):
        status, text = self.check()
        self.assertEqual(status, 1, text)
        for word in words:
            self.assertIn(word, text)

    def test_order_is_accepted(self):
        self.unit("contact/b", ["contact/a"], ["spectral/c"])
        self.unit("spectral/c", [], [])
        self.assertEqual(self.check()[0], 0, self.check()[1])

    def test_cycle_of_headers(self):
        self.unit("contact/b", ["contact/c"], [])
        self.unit("contact/c", ["contact/b"], [])
        self.assert_refused("contact/b, contact/c")

    def test_cycle_through_sources(self):
        self.unit("contact/b", ["contact/c"], [])
        self.unit("contact/c", [], ["contact/d"])
        self.unit("contact/d", ["contact/b"], [])
        self.assert_refused("contact/b, contact/c, contact/d")

    def test_later_room(self):
        self.unit("flow/b", [], [])
        self.unit("contact/c", [], ["flow/b"])
        self.assert_refused("must not know strait/flow/b.h")

    def test_missing_header(self):
        self.unit("contact/b", [], ["contact/none"])
        self.assert_refused("does not exist")

    def test_headers_with_one_user(self):
        self.unit("contact/b", ["contact/a"], [])
        self.assertIn("strait/contact/a.h", self.check("--one-user")[1])
        self.unit("contact/c", ["contact/a", "contact/b"], [])
        text = self.check("--one-user")[1]
        self.assertNotIn("strait/contact/a.h", text)
        self.assertIn("strait/contact/b.h", text)


if __name__ == "__main__":
    unittest.main()
