#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Tests of tools/study: all its cases run in one folder, one after the other."""
import csv
import pathlib
import runpy
import subprocess
import sys
import tempfile
import unittest

TOOLS = pathlib.Path(__file__).resolve().parents[2] / "tools"

# As strait does: the results of another scene are left alone without --force.
PROGRAM = """#!/usr/bin/python3
import pathlib, sys
folder = pathlib.Path(sys.argv[sys.argv.index("--output") + 1])
if folder.exists() and "--force" not in sys.argv:
    sys.exit(2)
folder.mkdir(exist_ok=True)
accuracy = next(float(word.split("=")[1]) for word in sys.argv if "Target accuracy" in word)
(folder / "leakage.csv").write_text(
    "step,pressure,leak_rate,leak_rate_lower,leak_rate_upper,unknowns,refinements,"
    "contact_seconds,flow_seconds,status\\n"
    f"1,0.1,{1 + accuracy / 4},{1 - accuracy},{1 + accuracy},{1 / accuracy},1,1,1,ok\\n")
"""


class Study(unittest.TestCase):
    def study(self, *options, program=PROGRAM):
        """The study of a made-up program, and the rows of its table."""
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            path = folder / "strait"
            path.write_text(program, encoding="utf-8")
            path.chmod(0o755)
            done = subprocess.run(
                [sys.executable, str(TOOLS / "study"), "scene.prm", "--program", str(path),
                 "--output", str(folder / "study"), "--grids", "64", "--accuracies", "0.1", "0.05",
                 "--degrees", "1", "--tolerances", "1e-6", *options],
                text=True, capture_output=True, check=False)
            table = folder / "study" / "study.csv"
            if not table.exists():
                return done, []
            with open(table, encoding="utf-8") as file:
                return done, list(csv.DictReader(file))

    def test_all_cases_are_run(self):
        done, rows = self.study("--set", "Surface/Seed=2")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual([(row["refinement"], float(row["accuracy"])) for row in rows],
                         [("adaptive", 0.01), ("adaptive", 0.1), ("adaptive", 0.05),
                          ("uniform", 0.1), ("uniform", 0.05)])

    def test_curves_are_those_of_one_tolerance(self):
        drawn = runpy.run_path(str(TOOLS / "study"), run_name="study")["drawn"]
        _, rows = self.study("--tolerances", "1e-4", "1e-6")
        self.assertEqual(len(rows), 6)
        rows = [{**row, "tolerance": float(row["tolerance"]),
                 "is_reference": int(row["is_reference"])} for row in rows]
        self.assertEqual([(row["refinement"], row["tolerance"]) for row in drawn(rows)],
                         2 * [("adaptive", 1e-6)] + 2 * [("uniform", 1e-6)])

    def test_what_is_varied_cannot_be_set(self):
        for text in ("Fluid/Target accuracy=0.3", "Contact/Grid  points = 96"):
            done, rows = self.study("--set", text)
            self.assertIn("would change what the study varies", done.stderr)
            self.assertEqual((done.returncode, rows), (1, []))

    def test_a_program_that_is_not_there(self):
        done, _ = self.study("--program", "/none")
        self.assertEqual(done.returncode, 2)
        self.assertIn("there is no program /none", done.stderr)

    def test_what_is_no_single_run(self):
        for program in (PROGRAM.replace("leakage.csv", "ensemble.csv"),
                        PROGRAM.replace("leak_rate,leak_rate_lower", "mean_gap,mean_gap_lower")):
            done, rows = self.study(program=program)
            self.assertIn("must be one run with a leak rate", done.stderr)
            self.assertEqual((done.returncode, rows), (1, []))


if __name__ == "__main__":
    unittest.main()
