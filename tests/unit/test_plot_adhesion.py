#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Tests of tools/plot_adhesion.py."""
import importlib
import pathlib
import sys
import tempfile
import unittest

import h5py
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tools"))
plot_adhesion = importlib.import_module("plot_adhesion")

HEADER = "step,branch,pressure,reduced_load,leak_rate,leak_rate_lower,leak_rate_upper,status\n"


class Comparison(unittest.TestCase):
    """Two runs, one of them unloading, with fields."""

    def setUp(self):
        # pylint: disable=consider-using-with
        self.folder = tempfile.TemporaryDirectory()
        self.runs = []
        for name, branch in (("long", "loading"), ("long opening", "unloading")):
            path = pathlib.Path(self.folder.name) / branch
            path.mkdir()
            (path / "leakage.csv").write_text(
                HEADER + f"1,{branch},0.1,0.5,1e-3,9e-4,1.2e-3,ok\n"
                f"2,{branch},0.19,0.05,1e-6,1e-6,1e-6,unresolved-throat\n"
                f"3,{branch},0.3,-0.5,0,0,0,ok\n", encoding="utf-8")
            for step, contact in ((2, 1), (10, 3)):
                with h5py.File(path / f"fields-{step}.h5", "w") as file:
                    gap = np.ones((4, 8))
                    gap[:contact] = 0
                    file["gap"] = gap
                    file.attrs.update({"lx": 2., "ly": 1.})
            self.runs.append((name, path))

    def tearDown(self):
        self.folder.cleanup()

    def test_leakage(self):
        """Only what leaks below the threshold is drawn, and unloading is dashed."""
        left, right = plot_adhesion.draw_leakage(self.runs).axes
        lines = [line for line in right.lines if line.get_label() in ("long", "long opening")]
        self.assertEqual([list(line.get_xdata()) for line in lines], 2 * [[0.05, 0.5]])
        self.assertEqual([line.get_linestyle() for line in lines], ["-", "--"])
        self.assertEqual(lines[0].get_color(), lines[1].get_color())
        self.assertEqual(left.get_yscale(), "log")
        bracket = left.collections[0].get_segments()[0]
        np.testing.assert_allclose(bracket[:, 1], [9e-4, 1.2e-3])

    def test_tension_slip_and_outflow(self):
        """Leak rates under tension are drawn, one line a slip length, whatever their sign."""
        path = self.runs[0][1] / "leakage.csv"
        rows = [("0.2", "0.3", "0", 1e-6), ("0.2", "0.3", "-0.1", 1e-7), ("0", "1", "0", 1e-3),
                ("0", "1", "-0.1", 1e-4), ("-0.1", "1.3", "0", 1e-2)]
        path.write_text(HEADER.replace("step", "slip_length,step") + "".join(
            f"{slip},{k},loading,{load},{reduced},{-leak},{leak},{leak},ok\n"
            for k, (load, reduced, slip, leak) in enumerate(rows)), encoding="utf-8")
        left, _ = plot_adhesion.draw_leakage(self.runs[:1]).axes
        lines = [line for line in left.lines if len(line.get_xdata())]
        self.assertEqual([list(line.get_xdata()) for line in lines], [[-0.1, 0, 0.2], [0, 0.2]])
        np.testing.assert_allclose(lines[1].get_ydata(), [1e-4, 1e-7])
        self.assertEqual(lines[1].get_label(), "long, $d_0$ = -0.1")

    def test_contact(self):
        """The fields of the last step, not of the last name in the alphabet."""
        axes = plot_adhesion.draw_contact(self.runs).axes
        self.assertEqual(axes[0].get_title(), "long: 75.0 %")
        for fields in self.runs[0][1].glob("fields-*.h5"):
            fields.unlink()
        with self.assertRaisesRegex(SystemExit, "holds no fields-STEP.h5"):
            plot_adhesion.draw_contact(self.runs)


if __name__ == "__main__":
    unittest.main()
