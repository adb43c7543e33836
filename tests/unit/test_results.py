#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Tests of tools/strait_results.py."""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

import h5py
import numpy as np

TOOLS = pathlib.Path(__file__).resolve().parents[2] / "tools"
sys.path.insert(0, str(TOOLS))
from strait_results import Run  # noqa: E402


class ReadsARun(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self.temporary.name)
        (self.folder / "leakage.csv").write_text(
            "step,branch,leak_rate,status\n1,loading,1.5e-9,ok\n2,loading,0,ok\n",
            encoding="utf-8")

    def tearDown(self):
        self.temporary.cleanup()

    def test_table_and_units(self):
        run = Run(self.folder)
        np.testing.assert_array_equal(run.table["leak_rate"], [1.5e-9, 0.])
        self.assertEqual(list(run.table["status"]), ["ok", "ok"])
        self.assertEqual(run.unit("leak_rate"), "")
        (self.folder / "run.json").write_text(
            json.dumps({"column_units": {"leak_rate": "m³/s"}}), encoding="utf-8")
        self.assertEqual(Run(self.folder).unit("leak_rate"), "m³/s")

    def test_a_table_that_is_not_there(self):
        with self.assertRaisesRegex(FileNotFoundError, "has no fit.csv; its tables: leakage.csv$"):
            Run(self.folder).csv("fit.csv")

    def test_an_ensemble_has_units_too(self):
        (self.folder / "ensemble.csv").write_text(
            "realisation,critical_load_lower,crossover_load,status\n1,0.2,0.1,ok\n")
        self.assertEqual(Run(self.folder).unit("critical_load_lower"), "")
        (self.folder / "run.json").write_text(json.dumps({"column_units": {
            "pressure": "MPa", "critical_load_lower": "MPa", "crossover_load": "MPa",
            "status": ""}}), encoding="utf-8")
        run = Run(self.folder)
        self.assertEqual(run.unit("critical_load_lower"), "MPa")
        self.assertEqual(run.table.units, {"critical_load_lower": "MPa", "crossover_load": "MPa",
                                           "status": ""})
        self.assertEqual(run.csv("leakage.csv").units, {"status": ""})

    def test_fields(self):
        with h5py.File(self.folder / "fields-2.h5", "w") as file:
            file["gap"] = np.arange(6.).reshape(2, 3)
            file.attrs["lx"] = 3.
        fields = Run(self.folder).fields(2)
        self.assertEqual(fields["gap"].shape, (2, 3))
        self.assertEqual(fields["attributes"]["lx"], 3.)

    def test_command_line(self):
        script = [sys.executable, str(TOOLS / "strait_results.py")]
        shown = subprocess.run([*script, str(self.folder)], text=True, capture_output=True,
                               check=True)
        self.assertRegex(shown.stdout, r"leak_rate +1\.5e-09 +0\n")
        wide = "step,status\n" + "".join(f"{k},{'ok' if k % 9 else 'inaccurate'}\n"
                                         for k in range(1, 60))
        (self.folder / "leakage.csv").write_text(wide, encoding="utf-8")
        lines = subprocess.run([*script, str(self.folder)], text=True, capture_output=True,
                               check=True).stdout.splitlines()
        self.assertLessEqual(max(map(len, lines)), 80)
        self.assertGreater(max(map(len, lines)), 70)
        self.assertEqual([int(cell) for line in lines if line.startswith("step")
                          for cell in line.split()[1:]], list(range(1, 60)))
        missing = subprocess.run([*script, str(self.folder / "none")], text=True,
                                 capture_output=True, check=False)
        self.assertEqual(missing.returncode, 1)
        self.assertRegex(missing.stderr, r"^strait_results\.py: .*leakage\.csv.*\n$")
        (self.folder / "run.json").write_text('{"column_units": {', encoding="utf-8")
        cut_off = subprocess.run([*script, str(self.folder)], text=True, capture_output=True,
                                 check=False)
        self.assertEqual(cut_off.returncode, 1)
        self.assertRegex(cut_off.stderr, r"^strait_results\.py: cannot read .*\n$")
        help_text = subprocess.run([*script, "--help"], text=True, capture_output=True, check=True)
        self.assertIn("strait_results.py OUTPUT_DIR", help_text.stdout)


if __name__ == "__main__":
    unittest.main()
