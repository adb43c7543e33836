#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Check what strait must refuse before any work, and what must do it no harm.

    check_guards.py --program P --folder F [TEST ...]
"""
import argparse
import csv
import json
import os
import shutil
import subprocess
import sys
import unittest

PROJECT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..")
SCENE = """
subsection Surface
  set Roll-off wavelength = 0.5
  set Short cut-off wavelength = 0.125
end
subsection Contact
  set Grid points = 32
end
subsection Load programme
  set Pressures = 0.05
end
subsection Output
  set Pictures = false
end
"""


class Guards(unittest.TestCase):
    program = folder = None

    def setUp(self):
        self.here = os.path.join(self.folder, self.id().rsplit(".", maxsplit=1)[-1])
        shutil.rmtree(self.here, ignore_errors=True)
        os.makedirs(self.here)

    def write(self, name, text):
        path = os.path.join(self.here, name)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        return path

    def strait(self, *arguments, timeout=120):
        """Exit status and the text of both streams."""
        process = subprocess.run([self.program, *arguments], cwd=self.here, text=True,
                                 stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                 timeout=timeout, check=False)
        return process.returncode, process.stdout

    def test_results_of_another_scene_stay(self):
        scene = self.write("a.prm", SCENE)
        table = os.path.join(self.here, "out", "leakage.csv")
        self.assertEqual(self.strait(scene, "--output", "out")[0], 0)
        with open(table, encoding="utf-8") as file:
            before = file.read()
        other = (scene, "--output", "out", "--set", "Surface/Seed=2")
        listed = sorted(os.listdir(os.path.join(self.here, "out")))
        status, text = self.strait(*other)
        self.assertEqual(status, 2, text)
        self.assertIn("Surface/Seed = 1 where the scene now has 2", text)
        with open(table, encoding="utf-8") as file:
            self.assertEqual(file.read(), before)
        self.assertEqual(sorted(os.listdir(os.path.join(self.here, "out"))), listed)
        self.assertEqual(self.strait(scene, "--output", "out")[0], 0)  # the same scene
        self.assertEqual(self.strait(*other, "--force")[0], 0)
        with open(table, encoding="utf-8") as file:
            self.assertNotEqual(file.read(), before)

    def test_scenes_beyond_the_model_say_so(self):
        """Two scenes of prm, without effects that they need, on a coarser grid."""
        for name, cut_off, words, without in (
                ("metal_gasket_helium", 1.25e-5, {"plastic", "rarefied", "rarefied-throat"},
                 ("--set", "Fluid/Rarefaction=none", "--set", "Contact/Yielding=none")),
                ("oring_water", 2.5e-5, {"fluid-pressure"}, ())):
            with self.subTest(name):
                status, text = self.strait(
                    os.path.join(PROJECT, "prm", name + ".prm"), "--output", name,
                    "--set", "Contact/Grid points=64", "--set", "Output/Pictures=false",
                    "--set", f"Surface/Short cut-off wavelength={cut_off}", *without)
                self.assertEqual(status, 0, text)
                with open(os.path.join(self.here, name, "leakage.csv"), encoding="utf-8") as file:
                    rows = list(csv.DictReader(file))
                with open(os.path.join(self.here, name, "run.json"), encoding="utf-8") as file:
                    record = json.load(file)["validity"]
                self.assertEqual(len(rows), len(record))
                for row, entry in zip(rows, record):
                    self.assertEqual(row["validity"], entry["validity"])
                    self.assertLessEqual(words, set(row["validity"].split("+")))
                    for check in entry["checks"]:
                        if check["word"] in words:
                            self.assertGreater(check["number"], check["most"])
                for word in words:
                    self.assertEqual(text.count(f"warning: {word}: "), 1, text)
                self.assertIn("; validity: ", text)

    def test_number_of_ranks(self):
        copy = os.path.join(self.here, "tools")
        os.makedirs(copy)
        shutil.copy(os.path.join(PROJECT, "tools", "run"), copy)
        for ranks in ("two", "0", "-1", "1.5", "2 3"):
            process = subprocess.run([os.path.join(copy, "run"), "a.prm"], text=True,
                                     env={**os.environ, "STRAIT_RANKS": ranks},
                                     stderr=subprocess.PIPE, check=False)
            self.assertEqual(process.returncode, 2)
            self.assertIn(f"STRAIT_RANKS = '{ranks}'", process.stderr)

    def test_current_folder_that_is_gone(self):
        process = subprocess.run(
            ["sh", "-c", 'mkdir gone; cd gone; rmdir ../gone; exec "$0" --version', self.program],
            cwd=self.here, text=True, stderr=subprocess.PIPE, timeout=20, check=False)
        self.assertEqual(process.returncode, 2, process.stderr)
        self.assertEqual(process.stderr.count("\n"), 1, process.stderr)
        self.assertIn("current folder", process.stderr)

    def test_nested_subsections(self):
        n = 100000
        for text in ("subsection Surface\n" * n + "end\n" * n, "subsection A\n" * n):
            status, output = self.strait(self.write("deep.prm", text), "--dry-run", timeout=20)
            self.assertEqual(status, 2, output)
            self.assertEqual(output.count("\n"), 1, output)

    def test_extreme_viscosity_leaks_in_proportion(self):
        scene = self.write("a.prm", SCENE)
        rates = []
        for value in (1e-30, 1., 1e30):
            status, text = self.strait(scene, "--set", f"Fluid/Viscosity={value}", "--force",
                                       "--output", "out")
            self.assertEqual(status, 0, text)
            with open(os.path.join(self.here, "out", "leakage.csv"), encoding="utf-8") as file:
                rates.append(float(next(csv.DictReader(file))["leak_rate"]) * value)
        self.assertAlmostEqual(rates[0] / rates[1], 1, 6)
        self.assertAlmostEqual(rates[2] / rates[1], 1, 6)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", required=True, type=os.path.abspath)
    parser.add_argument("--folder", required=True, type=os.path.abspath)
    options, rest = parser.parse_known_args()
    Guards.program, Guards.folder = options.program, options.folder
    unittest.main(argv=[sys.argv[0], *rest])
