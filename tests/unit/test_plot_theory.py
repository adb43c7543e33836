#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Tests of the theory in the pictures: red lines, gaps.png and the comparison of runs."""
import json
import math
import pathlib
import sys
import tempfile
import unittest
import unittest.mock

import h5py
import numpy as np
from matplotlib.image import imread

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "tools" / "plot.py"
sys.path.insert(0, str(SCRIPT.parent))
import plot  # noqa: E402
import plot_theory  # noqa: E402

SCENE = """subsection Surface
  set Size                     = 2, 1 # lx, ly
  set Roll-off wavelength      = 0.5
  set Short cut-off wavelength = 0.1
end
subsection Fluid
  set Direction       = x
  set Inlet pressure  = 3
  set Outlet pressure = 1
  set Viscosity       = 0.5
end
subsection Theory
  set Critical contact fraction = 0.3
  set Dimension parameter       = critical fraction
end
"""


def red(path):
    """The share of the pixels that are as red as the lines of the theory."""
    pixels = imread(path)[..., :3]
    return np.mean((pixels[..., 0] > 0.7) & (pixels[..., 1:].max(axis=-1) < 0.2))


class TheoryPlot(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def write_theory(self):
        rows = [f"{k},{p},{math.erf(2 * p)},{0.1 - p / 4},{1e-3 * (0.2 - p)**3},1e-4,ok"
                for k, p in enumerate((0.02, 0.1, 0.05, 0.15), 1)]
        (self.folder / "leakage.csv").write_text(
            "step,pressure,theory_contact_area,theory_mean_gap,theory_leak_rate,theory_error,"
            "status\n" + "\n".join(rows) + "\n")
        (self.folder / "parameters.prm").write_text(SCENE)

    def test_theory_alone(self):
        self.write_theory()
        self.assertEqual(plot.main([str(self.folder)]), 0)
        self.assertGreater(red(self.folder / "leakage.png"), 1e-3)

    def test_theory_beside_the_simulation(self):
        header = "step,pressure,contact_area,mean_gap,leak_rate"
        rows = ["1,0.1,0.2,0.02,1e-6,{}", "2,0.2,0.4,0.01,1e-9,{}"]
        shares = []
        for more, values in ((",status", ("ok", "ok")),
                             (",theory_leak_rate,status", ("1e-6,ok", "0,ok")),
                             (",theory_leak_rate,status", ("2e-6,ok", "1e-9,ok"))):
            (self.folder / "leakage.csv").write_text("\n".join(
                [header + more] + [row.format(v) for row, v in zip(rows, values)]) + "\n")
            self.assertEqual(plot.main([str(self.folder)]), 0)
            shares.append(red(self.folder / "leakage.png"))
        self.assertEqual(shares[0], 0)
        self.assertGreater(shares[2], 1e-3)
        self.assertLess(shares[1], shares[2])  # zero has no place on a logarithmic axis

    def test_gaps(self):
        edges = np.concatenate([[0], np.geomspace(1e-4, 1, 41)])
        for step in (1, 2, 10):
            with h5py.File(self.folder / f"fields-{step}.h5", "w") as file:
                file.attrs["nominal_pressure"] = 0.1 * step
                group = file.create_group("gap_distribution")
                group["edges"] = edges
                group["persson"] = np.full(41, 0.9 / 41)
                if step > 1:
                    group["simulated"] = np.where(edges[1:] < 0.5, 0.02, 0)
        (self.folder / "fields-3.h5").write_bytes(b"cut short")
        self.write_theory()
        self.assertEqual(plot.main([str(self.folder)]), 0)
        self.assertGreater(red(self.folder / "gaps.png"), 1e-4)

    def test_no_gaps_no_picture(self):
        self.write_theory()
        with h5py.File(self.folder / "fields-1.h5", "w") as file:
            file["gap"] = np.zeros((2, 2))
        self.assertEqual(plot.main([str(self.folder)]), 0)
        self.assertFalse((self.folder / "gaps.png").exists())

    def test_normalised_by_the_flow_at_the_cut_off(self):
        self.write_theory()
        load, leak, ratio = plot_theory.normalised(self.folder)
        self.assertAlmostEqual(ratio, 0.2)
        # The contact area erf(2 p) reaches 0.3 at the critical load.
        np.testing.assert_allclose([math.erf(2 * 0.02 / load[0])], [0.3], rtol=1e-9)
        flow = 0.1**3 / (12 * 0.5) * 2 * 1 / 2
        np.testing.assert_allclose(leak[1], 1e-3 * 0.1**3 / flow, rtol=1e-9)

    def test_gas_whose_viscosity_only_the_program_knows(self):
        """The default that parameters.prm then has is not that of the gas."""
        def drawn(gas, viscosity):
            (self.folder / "parameters.prm").write_text(SCENE.replace(
                "  set Viscosity       = 0.5", f"  set Gas = {gas}\n  set Viscosity = {viscosity}"))
            with unittest.mock.patch.object(plot_theory.Figure, "savefig", autospec=True) as save:
                plot_theory.draw_folders([self.folder], self.folder / "theory.png")
            axes = save.call_args.args[0].axes[0]
            return axes.get_ylabel(), axes.lines[0].get_ydata()[0]

        self.write_theory()
        (self.folder / "run.json").write_text(json.dumps({"units": {"leak_rate": "m³/s"}}))
        leak, flow_of_one = 1e-3 * 0.18**3, 0.1**3 / 12 * 2 * 1 / 2
        for gas, viscosity, expected in (("", 1, leak / flow_of_one), ("helium", 1, leak),
                                         ("helium", 2e-5, leak / flow_of_one * 2e-5)):
            with self.subTest(gas=gas, viscosity=viscosity):
                label, value = drawn(gas, viscosity)
                self.assertAlmostEqual(value / expected, 1)
                self.assertEqual(label == "Leak rate (m³/s)", expected == leak)

    def test_leak_rates_of_different_units(self):
        self.write_theory()
        other = self.folder / "other"
        other.mkdir()
        (other / "leakage.csv").write_bytes((self.folder / "leakage.csv").read_bytes())
        (other / "parameters.prm").write_text(SCENE.replace("= 0.5\nend\nsubsection Theory",
                                                            "= 1\n  set Gas = air\nend\n"
                                                            "subsection Theory"))
        (other / "run.json").write_text(json.dumps({"units": {"leak_rate": "mm³/s"}}))
        with self.assertRaisesRegex(ValueError, "different units.* Fluid/Viscosity"):
            plot_theory.draw_folders([self.folder, other], self.folder / "theory.png")

    def test_comparison(self):
        self.write_theory()
        picture = self.folder / "compared.png"
        self.assertEqual(plot_theory.main([str(self.folder), "--picture", str(picture)]), 0)
        self.assertTrue(picture.exists())
        self.assertEqual(plot_theory.main([str(self.folder / "missing")]), 1)


if __name__ == "__main__":
    unittest.main()
