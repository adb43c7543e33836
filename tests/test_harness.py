#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Tests of compare_tables.py and run_scene.py, with a fake program."""
import os
import subprocess
import sys
import tempfile
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "tools"))
import compare_tables  # noqa: E402

FAKE_PROGRAM = """#!/bin/sh
# Does what the scene says, in shell; its second and third argument are --output DIR.
output="$3"
eval "$(sed -n 's/^do //p' "$1")"
"""


class Folder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = folder.name

    def write(self, name, text):
        path = os.path.join(self.path, name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        return path


class CompareTables(Folder):
    def compare(self, reference, result, **options):
        return compare_tables.compare(self.write("a.csv", reference),
                                      self.write("b.csv", result), **options)

    def test_equal_tables_agree(self):
        table = "step, leak_rate, status\n1, 1e-10, ok\n"
        self.assertEqual(self.compare(table, table), [])

    def test_small_numbers_are_compared_relatively(self):
        problems = self.compare("leak_rate\n1e-10\n", "leak_rate\n1.001e-10\n")
        self.assertEqual(len(problems), 1)
        self.assertIn("column leak_rate, row 1", problems[0])

    def test_zero_agrees_with_zero_only(self):
        self.assertEqual(self.compare("a\n0\n", "a\n0.0\n"), [])
        self.assertEqual(len(self.compare("a\n0\n", "a\n1e-300\n")), 1)

    def test_tolerance_of_a_column(self):
        self.assertEqual(self.compare("a,b\n1,1\n", "a,b\n1.01,1\n", rtol={"a": 0.02}), [])
        self.assertEqual(len(self.compare("a,b\n1,1\n", "a,b\n1,1.01\n", rtol={"a": 0.02})), 1)
        self.assertEqual(len(self.compare("a\n1\n", "a\n1\n", rtol={"c": 1})), 1)

    def test_seconds_are_ignored(self):
        self.assertEqual(self.compare("flow_seconds\n1\n", "flow_seconds\n2\n"), [])

    def test_columns_of_one_table_only(self):
        self.assertEqual(len(self.compare("a,b\n1,2\n", "a\n1\n")), 1)
        self.assertEqual(len(self.compare("a\n1\n", "a,b\n1,2\n")), 1)
        self.assertEqual(len(self.compare("a,b\n1,2\n", "b,a\n2,1\n")), 1)

    def test_number_of_rows(self):
        self.assertEqual(len(self.compare("a\n1\n2\n", "a\n1\n")), 1)

    def test_nan_and_words(self):
        self.assertEqual(len(self.compare("a\n1\n", "a\nnan\n")), 1)
        self.assertEqual(len(self.compare("status\nok\n", "status\nnot converged\n")), 1)

    def test_broken_tables(self):
        with self.assertRaises(ValueError):
            self.compare("a\n1\n", "")
        with self.assertRaises(ValueError):
            self.compare("a\n1\n", "a\n1,2\n")


class RunScene(Folder):
    def judge(self, kind, scene):
        program = self.write("program", FAKE_PROGRAM)
        os.chmod(program, 0o755)
        path = self.write("scenes/scene.prm", scene)
        process = subprocess.run(
            [sys.executable, os.path.join(HERE, "run_scene.py"), kind, path,
             "--program", program, "--folder", os.path.join(self.path, "run")],
            capture_output=True, text=True, check=False)
        return process.returncode, process.stdout + process.stderr

    def test_status_and_message(self):
        scene = ("# STATUS: 2\n# STDERR: no such\n# NOTHING WRITTEN\n"
                 "do echo 'no such thing' >&2; exit 2\n")
        self.assertEqual(self.judge("robustness", scene)[0], 0)
        for wrong in (scene.replace("exit 2", "exit 1"),
                      scene.replace("no such thing", "help"),
                      scene.replace("exit 2", "echo more >&2; exit 2"),
                      scene.replace("exit 2", "mkdir $output; exit 2")):
            self.assertEqual(self.judge("robustness", wrong)[0], 1, wrong)

    def test_column(self):
        scene = ("# COLUMN: leak_rate=0\n"
                 "do mkdir $output; printf 'step,leak_rate\\n1,0\\n' > $output/leakage.csv\n")
        self.assertEqual(self.judge("robustness", scene)[0], 0)
        self.assertEqual(self.judge("robustness", scene.replace("1,0", "1,2"))[0], 1)

    def test_hanging_program_is_stopped(self):
        status, text = self.judge("robustness", "# TIMEOUT: 0.5\ndo exec sleep 60\n")
        self.assertEqual(status, 1)
        self.assertIn("still running", text)

    def test_unknown_tag(self):
        self.assertEqual(self.judge("robustness", "# STATSU: 2\ndo exit 0\n")[0], 1)

    def test_regression(self):
        scene = ("# RTOL: leak_rate=1e-3\n"
                 "do mkdir $output; printf 'step,leak_rate\\n1,1.0001\\n' > $output/leakage.csv\n")
        status, text = self.judge("regression", scene)
        self.assertEqual(status, 1)
        self.assertIn("is missing", text)
        self.write("scenes/scene/leakage.csv", "step,leak_rate\n1,1\n")
        self.assertEqual(self.judge("regression", scene)[0], 0)
        status, text = self.judge("regression", scene.replace("1.0001", "1.01"))
        self.assertEqual(status, 1)
        self.assertIn("column leak_rate, row 1", text)


if __name__ == "__main__":
    unittest.main()
