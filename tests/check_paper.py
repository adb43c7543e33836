#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Run small versions of the scenes of prm/paper, and check what the manual says of the figures.

    check_paper.py --program P --scenes prm/paper --folder F [FIGURE ...]

A small version is the scene itself on fewer points, with fewer loads and fewer scales of the
surface. What is checked, and the expected numbers, are those of doc/paper.md, doc/closing.md,
doc/theory.md and doc/adhesion.md for the full scenes.
"""
import argparse
import math
import os
import shutil
import subprocess
import sys
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "tools"))
import compare_tables  # noqa: E402

# Two roll-off wavelengths in the box, 16 points on the shortest wave.
SMALL = {"Contact/Grid points": 128, "Surface/Short cut-off wavelength": .125,
         "Contact/Zoom/Points along throat": 6}


def read(folder, name):
    """The rows of a table as dictionaries of numbers, or of text where there is none."""
    def value(text):
        number = compare_tables.as_number(text)
        return text if number is None else number
    rows = compare_tables.read_table(os.path.join(folder, name + ".csv"))[1]
    return [{key: value(text) for key, text in row.items()} for row in rows]


class Paper(unittest.TestCase):
    program = scenes = folder = None

    def run_scene(self, name, overrides, variant=""):
        """The folder of the results of a scene with other parameters."""
        output = os.path.join(self.folder, name + variant)
        shutil.rmtree(output, ignore_errors=True)
        command = [self.program, os.path.join(self.scenes, name + ".prm"), "--output", output,
                   "--quiet", "--set", "Output/Pictures=false", "--set", "Output/Fields=none",
                   "--set", "Output/Checkpoint=false"]
        for parameter, value in overrides.items():
            command += ["--set", f"{parameter}={value}"]
        done = subprocess.run(command, capture_output=True, text=True, timeout=250, check=False)
        # 1: some step is not as accurate as asked for.
        self.assertIn(done.returncode, (0, 1), done.stderr)
        return output

    def test_commands(self):
        """Each command at the head of a scene is one that strait accepts."""
        done = subprocess.run(
            [os.path.join(self.scenes, "..", "..", "tools", "paper"), "--program", self.program,
             "--dry-run"], capture_output=True, text=True, timeout=250, check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertGreater(done.stdout.count("exit status 0"), 30)

    def by_reduced_load(self, folder, slip_length=None):
        """The rows of leakage.csv that have a reduced load, by this load."""
        return {round(row["reduced_load"], 6): row for row in read(folder, "leakage")
                if row["reduced_load"] != ""
                and slip_length in (None, row.get("slip_length"))}

    def exponent(self, rows, wide, narrow, quantity="leak_rate"):
        return math.log(rows[wide][quantity] / rows[narrow][quantity]) / math.log(wide / narrow)

    def between(self, low, value, high):
        self.assertGreaterEqual(value, low)
        self.assertLessEqual(value, high)

    def critical_load(self, folder):
        row = read(folder, "threshold")[0]
        return .5 * (row["critical_load_lower"] + row["critical_load_upper"])

    def saddle(self, name, grid, critical_load, exponent, gap):
        folder = self.run_scene(name, {
            "Contact/Grid points": grid, "Load programme/Pressures": "",
            "Load programme/Reduced loads": "0.1, 0.05", "Fluid/Target accuracy": .02})
        rows = self.by_reduced_load(folder)
        self.assertAlmostEqual(self.critical_load(folder) / critical_load, 1., delta=1e-3)
        self.assertAlmostEqual(self.exponent(rows, .1, .05), exponent, delta=.05)
        self.assertAlmostEqual(self.exponent(rows, .1, .05, "worst_constriction_gap"), gap,
                               delta=.02)

    def test_saddle_square(self):
        self.saddle("saddle_square", "256", 1.436369, 3.62, 1.251)

    def test_saddle_triangular(self):
        self.saddle("saddle_triangular", "240, 416", 3.87382, 3.91, 1.35)
        # With windows, on half as many points each way, as in doc/closing.md.
        folder = self.run_scene("saddle_triangular", {
            "Contact/Grid points": "120, 208", "Contact/Zoom/Enabled": "true",
            "Load programme/Pressures": "", "Load programme/Threshold tolerance": 1e-4,
            "Load programme/Reduced loads": "0.05, 0.02", "Fluid/Target accuracy": .02}, "_zoom")
        rows = self.by_reduced_load(folder)
        self.assertAlmostEqual(self.exponent(rows, .05, .02), 3.802, delta=.01)
        self.assertAlmostEqual(self.exponent(rows, .05, .02, "worst_constriction_gap"), 1.312,
                               delta=.003)

    def test_saddle_honeycomb(self):
        self.saddle("saddle_honeycomb", "240, 416", .345261, 3.50, 1.205)

    def test_fig1(self):
        """The leak rate falls fast, then exponentially, then as a power."""
        folder = self.run_scene("fig1", {
            "Contact/Grid points": 256, "Surface/Short cut-off wavelength": .0625,
            "Load programme/Pressures": "0.001, 0.005, 0.02",
            "Load programme/Reduced loads": "0.8, 0.6, 0.4, 0.2, 0.1, 0.05",
            "Fluid/Target accuracy": .1, "Contact/Zoom/Enabled": "true"})
        rows = read(folder, "leakage")
        load = [1. - row["reduced_load"] for row in rows]
        steepness = [math.log(a["leak_rate"] / b["leak_rate"]) / (y - x)
                     for a, b, x, y in zip(rows, rows[1:], load, load[1:])]
        middle = steepness[3:6]
        self.assertGreater(steepness[0], 1.5 * max(middle))
        self.assertLess(max(middle), 1.5 * min(middle))
        self.assertGreater(steepness[-1], 1.5 * max(middle))
        self.between(3., self.exponent(self.by_reduced_load(folder), .1, .05), 4.2)

    def test_fig1_full(self):
        """Near the threshold there are more constrictions on the way, and fewer that matter."""
        folder = self.run_scene("fig1_full", {
            "Contact/Grid points": 256, "Surface/Short cut-off wavelength": .125,
            "Load programme/Pressures": "", "Load programme/Reduced loads": "0.7, 0.02",
            "Fluid/Target accuracy": .05})
        far, near = read(folder, "constrictions")
        self.assertGreater(near["constrictions"], far["constrictions"])
        self.assertGreater(far["constrictions_for_90_percent"], 2)
        self.assertLessEqual(near["constrictions_for_90_percent"], 2)

    def test_fig1_seeds(self):
        """The gap of a throat closes like that of a saddle; near the threshold there is one."""
        folder = self.run_scene("fig1_seeds", {
            **SMALL, "Realisations/Seeds": "2, 3, 4", "Load programme/Pressures": "",
            "Load programme/Reduced loads": "0.7, 0.3, 0.05, 0.01"})
        alone = 0
        exponents = []
        for number in range(1, 4):
            one = os.path.join(folder, f"realisation-{number}")
            rows = self.by_reduced_load(one)
            exponents.append(self.exponent(rows, .05, .01, "worst_constriction_gap"))
            alone += read(one, "constrictions")[-1]["constrictions_for_90_percent"] == 1
        self.assertAlmostEqual(sum(exponents) / 3, 1.22, delta=.06)
        self.assertGreaterEqual(alone, 2)
        for row in read(folder, "ensemble"):
            self.between(.55, row["crossover_load"] / row["critical_load_upper"], .9)

    def test_fig2a(self):
        """A larger box has more constrictions far from the threshold, and one near it."""
        loads = {"Load programme/Pressures": "", "Load programme/Reduced loads": "0.7, 0.01"}
        numbers = []
        for waves in (2, 4):
            folder = self.run_scene("fig2a", {
                **loads, "Contact/Grid points": 64 * waves,
                "Contact/Zoom/Points along throat": 6,
                "Surface/Roll-off wavelength": 1. / waves,
                "Surface/Short cut-off wavelength": .25 / waves}, f"_{waves}")
            numbers.append([row["constrictions_for_90_percent"]
                            for row in read(folder, "constrictions")])
        self.assertGreater(numbers[1][0], numbers[0][0])
        for far, near in numbers:
            self.assertGreater(far, near)
            self.assertLessEqual(near, 2)

    def test_hurst_03(self):
        rows = self.by_reduced_load(self.run_scene("hurst_03", {
            **SMALL, "Load programme/Pressures": "",
            "Load programme/Reduced loads": "0.05, 0.01"}))
        self.assertAlmostEqual(self.exponent(rows, .05, .01, "worst_constriction_gap"), 1.22,
                               delta=.06)
        self.between(3.2, self.exponent(rows, .05, .01), 3.8)

    def test_fig2b(self):
        """With many scales the curves coincide beyond about 0.7 of the critical load."""
        curves = []
        for number, cut_off in enumerate((5e-6, 5e-8)):
            folder = self.run_scene("fig2b", {"Surface/Short cut-off wavelength": cut_off},
                                    f"_{number}")
            curves.append([row["theory_leak_rate"] / cut_off ** 3
                           for row in read(folder, "leakage") if row["pressure"] > .19])
        self.assertEqual([len(curve) > 5 for curve in curves], [True, True])
        for few, many in zip(*curves):
            self.assertAlmostEqual(few / many, 1., delta=.07)

    def test_fig3(self):
        """With a negative slip length the exponent becomes 3; far away nothing changes."""
        lengths = (0., -1e-3)
        folder = self.run_scene("fig3", {
            "Contact/Grid points": 128, "Surface/Short cut-off wavelength": 5.,
            "Contact/Zoom/Points along throat": 8,
            "Fluid/Slip length": ", ".join(map(str, lengths)),
            "Load programme/Pressures": .05, "Load programme/Reduced loads": "0.01, 0.001"})
        far = [row["leak_rate"] for row in read(folder, "leakage") if row["pressure"] == .05]
        self.assertAlmostEqual(far[1] / far[0], 1., delta=.02)
        exponents = [self.exponent(self.by_reduced_load(folder, length), .01, .001)
                     for length in lengths]
        self.assertGreater(exponents[0], 3.3)
        self.assertAlmostEqual(exponents[1], 3., delta=.1)

    def test_fig4_random_adhesive(self):
        """Adhesion of short range reduces the critical load and the exponent."""
        loads = {"Contact/Grid points": 128, "Surface/Short cut-off wavelength": .25,
                 "Load programme/Pressures": .02, "Load programme/Threshold tolerance": 1e-3,
                 "Load programme/Reduced loads": "0.3, 0.1"}
        results = {}
        for number in ("none", .25, 1):
            folder = self.run_scene("fig4_random_adhesive", {
                **loads, **({"Contact/Adhesion/Enabled": "false"} if number == "none" else
                            {"Contact/Adhesion/Tabor number": number})}, f"_{number}")
            results[number] = (self.critical_load(folder),
                               self.exponent(self.by_reduced_load(folder), .3, .1))
        self.assertLess(results[.25][0], .9 * results["none"][0])
        self.assertLess(results[1][0], results[.25][0])
        self.assertAlmostEqual(results[.25][1], results["none"][1], delta=.5)
        self.assertLess(results[1][1], results[.25][1] - 1.)

    def test_fig5_isolated_adhesive(self):
        """Adhesion of long range is like none; with a short one the saddle jumps, and opens under
        less load than it closes."""
        common = {"Contact/Grid points": 128, "Contact/Tolerance": 1e-7,
                  "Fluid/Target accuracy": .02, "Load programme/Threshold tolerance": 1e-4,
                  "Load programme/Reduced loads": "0.1, 0.05, 0.01"}
        rows = self.by_reduced_load(self.run_scene("fig5_isolated_adhesive", common))
        self.assertAlmostEqual(self.exponent(rows, .1, .05), 3.66, delta=.15)
        short = {**common, "Contact/Adhesion/Tabor number": 2}
        closing = self.run_scene("fig5_isolated_adhesive", short, "_closing")
        rows = self.by_reduced_load(closing)
        self.between(.8, self.exponent(rows, .1, .05), 1.3)
        self.assertLess(self.exponent(rows, .05, .01), .8)
        self.assertAlmostEqual(self.critical_load(closing), 1.039, delta=.01)
        opening = self.run_scene("fig5_isolated_adhesive", {
            **short, "Load programme/Path": "unloading", "Load programme/Reduced loads": ""},
            "_opening")
        self.assertAlmostEqual(self.critical_load(opening), .995, delta=.01)

    def test_fig4_seeds(self):
        """Exponents fall to about one at the threshold; surfaces open under less load than they
        close."""
        common = {"Contact/Grid points": 128, "Surface/Short cut-off wavelength": .25,
                  "Contact/Adhesion/Tabor number": 1.5, "Realisations/Seeds": "1, 2",
                  "Load programme/Pressures": .02, "Load programme/Threshold tolerance": 3e-3}
        closing = self.run_scene("fig4_seeds", {
            **common, "Load programme/Reduced loads": "0.3, 0.1, 0.03"}, "_closing")
        opening = self.run_scene("fig4_seeds", {
            **common, "Load programme/Path": "unloading", "Load programme/Pressures": "",
            "Load programme/Reduced loads": ""}, "_opening")
        for number in (1, 2):
            one = os.path.join(closing, f"realisation-{number}")
            rows = self.by_reduced_load(one)
            self.assertGreater(self.exponent(rows, .3, .1), self.exponent(rows, .1, .03))
            self.assertLess(self.exponent(rows, .1, .03), 1.3)
            self.assertLess(
                self.critical_load(os.path.join(opening, f"realisation-{number}")),
                .97 * self.critical_load(one))

    def test_fig5_exponent(self):
        """The local exponent falls below one; without the leak rate at the jump it is 1 to 1.5."""
        folder = self.run_scene("fig5_exponent", {
            "Contact/Grid points": 128, "Fluid/Target accuracy": .02,
            "Load programme/Reduced loads": "0.2, 0.1, 0.02, 0.001"})
        rows = self.by_reduced_load(folder)
        self.between(1.2, self.exponent(rows, .2, .1), 1.8)
        self.assertLess(self.exponent(rows, .02, .001), .6)
        end = rows[.001]["leak_rate"]
        self.between(1., math.log((rows[.2]["leak_rate"] - end) / (rows[.02]["leak_rate"] - end))
                     / math.log(10.), 1.5)

    def test_theory_crossover(self):
        """The crossover of the corrected effective medium is that of the leak rate, to a tenth."""
        folder = self.run_scene("theory_crossover", {
            "Contact/Grid points": 256, "Surface/Short cut-off wavelength": .0625,
            "Realisations/Seeds": "2, 3", "Load programme/Pressures": ""})
        for row in read(folder, "ensemble"):
            self.assertAlmostEqual(row["theory_crossover_load"] / row["crossover_load"], 1.,
                                   delta=.1)

    def test_theory_area(self):
        """Persson's contact area is too small by about a fifth, his mean gap right to a tenth."""
        folder = self.run_scene("theory_area", {
            "Contact/Grid points": 256, "Surface/Short cut-off wavelength": .0625,
            "Load programme/Pressures": "0.05, 0.1, 0.2"})
        for row in read(folder, "leakage"):
            self.between(1.05, row["contact_area_corrected"] / row["theory_contact_area"], 1.35)
            self.assertAlmostEqual(row["mean_gap"] / row["theory_mean_gap"], 1., delta=.1)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", required=True)
    parser.add_argument("--scenes", required=True)
    parser.add_argument("--folder", required=True)
    parser.add_argument("figure", nargs="*")
    options = parser.parse_args()
    Paper.program, Paper.scenes = options.program, options.scenes
    Paper.folder = os.path.abspath(options.folder)
    os.makedirs(Paper.folder, exist_ok=True)
    names = [f"Paper.test_{figure}" for figure in options.figure] or None
    program = unittest.main(argv=[sys.argv[0], "-v"], defaultTest=names, exit=False)
    return 0 if program.result.wasSuccessful() else 1


if __name__ == "__main__":
    sys.exit(main())
