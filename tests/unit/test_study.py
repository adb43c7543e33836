#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Tests of tools/study: all its cases run in one folder, one after the other."""
import csv
import pathlib
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
    def test_all_cases_are_run(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            program = folder / "strait"
            program.write_text(PROGRAM, encoding="utf-8")
            program.chmod(0o755)
            done = subprocess.run(
                [sys.executable, str(TOOLS / "study"), "scene.prm", "--program", str(program),
                 "--output", str(folder / "study"), "--grids", "64", "--accuracies", "0.1", "0.05",
                 "--degrees", "1", "--tolerances", "1e-6"],
                text=True, capture_output=True, check=False)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            with open(folder / "study" / "study.csv", encoding="utf-8") as file:
                self.assertEqual([(row["refinement"], float(row["accuracy"]))
                                  for row in csv.DictReader(file)],
                                 [("adaptive", 0.01), ("adaptive", 0.1), ("adaptive", 0.05),
                                  ("uniform", 0.1), ("uniform", 0.05)])


if __name__ == "__main__":
    unittest.main()
