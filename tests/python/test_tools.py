#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""The tools on made-up results in which loads, slip lengths or doubts could be mixed up."""
import html
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest
import unittest.mock

import numpy as np

TOOLS = pathlib.Path(__file__).resolve().parents[2] / "tools"
sys.path.insert(0, str(TOOLS))
import make_example_map  # noqa: E402
import plot_adhesion  # noqa: E402
import plot_ensemble  # noqa: E402
import plot_theory  # noqa: E402
import seal_network  # noqa: E402
import seal_scene  # noqa: E402
import whole_seal  # noqa: E402


class InAFolder(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))

    def write(self, **files):
        """Write files, by names with an underscore in place of the dot."""
        for name, text in files.items():
            stem, _, ending = name.rpartition("_")
            (self.folder / f"{stem}.{ending}").write_text(text, encoding="utf-8")


def run_tool(name, *arguments, **options):
    return subprocess.run([sys.executable, TOOLS / name, *map(str, arguments)], text=True,
                          capture_output=True, check=False, **options)


SEAL = """subsection Surface
  set Kind = self-affine
  set Size = 1
  set Roll-off wavelength = 0.25
end
subsection Fluid
  set Direction = x
end
subsection Load programme
  set Pressures = 1, 2, 4
end
subsection Seal
  set Circumference = {around}
  set Contact width = {width}
  set Pressure profile = {profile}
  set Isotropic = true
  set Wanted leak rate = 0
end
subsection Output
  set Leak rate units =
end
"""


def seal(width, profile, around=20):
    return SEAL.format(width=width, profile=profile, around=around)


class WholeSeal(unittest.TestCase):
    def check(self, scene):
        return run_tool("whole_seal.py", "--check", input=scene)

    def test_bonds_around_are_not_extrapolated_either(self):
        # Of two patches over the width each has the mean pressure; the bond between has more.
        around = 8 / np.pi * (np.pi / 12 + np.sqrt(3) / 8)
        scene = seal_scene.Seal(seal(2, "hertz"))
        np.testing.assert_allclose(scene.columns()[1], [around], rtol=1e-14)
        np.testing.assert_allclose(scene.rows()[-1], 4 / around, rtol=1e-14)
        for width in (2, 3, 4, 5):
            scene = seal_scene.Seal(seal(width, "hertz"))
            pressures = np.outer(scene.rows(), np.concatenate(scene.columns()[:2]))
            self.assertGreater(pressures.min(), 1 - 1e-9)
            self.assertLess(pressures.max(), 4 + 1e-8)
        refused = self.check(seal(2, "hertz").replace("1, 2, 4", "1, 1.2"))
        self.assertEqual(refused.returncode, 1)
        self.assertRegex(refused.stderr, r"^Under .* presses the patches by 1\.1\d* to 1\.3\d*; "
                                         r"let Load programme/Pressures .*\n$")
        self.assertEqual(self.check(seal(2, "").replace("1, 2, 4", "1")).returncode, 0)

    def test_rounding_is_no_extrapolation(self):
        # A patch sealed at the last load must not have a negative conductance just beyond it.
        beyond = np.array([np.nextafter(1.6, 2)])
        self.assertEqual(seal_network.at_loads(np.array([1., 1.6]), np.array([[1., 0.]]), beyond),
                         0)

    def test_a_network_that_cannot_be_held_is_refused_before_the_run(self):
        for width in (3750, 1e8):
            refused = self.check(seal(width, "", 235000))
            self.assertEqual(refused.returncode, 1)
            self.assertRegex(refused.stderr, r"^Seal/Contact width = \S+ .* GB.*"
                                             r"enlarge Surface/Size\.\n$")
        self.assertEqual(self.check(seal(300, "", 235000)).returncode, 0)
        self.assertEqual(self.check(seal(3750, "", 2)).returncode, 0)

    def test_the_memory_is_that_of_the_matrix(self):
        solve = seal_network.solveh_banded
        for n_along, n_around in ((7, 5000), (7, 3), (80, 5000)):
            pool, sizes = np.ones((2, n_along)), set()

            def noted(matrix, *arguments, sizes=sizes, **options):
                sizes.add(matrix.nbytes)
                return solve(matrix, *arguments, **options)

            with unittest.mock.patch.multiple(seal_network, solveh_banded=noted, N_NETWORKS=1):
                seal_network.sample_seals(pool, pool[:, 1:], n_around, 1, False,
                                          np.random.default_rng(1))
            self.assertEqual(sizes, {seal_network.matrix_bytes(n_along, n_around)})


class SmallLoads(InAFolder):
    LOADS = (1e-9, 3e-9)  # both equal zero to 1e-8

    def write_patch(self):
        self.write(leakage_csv="pressure,leak_rate,leak_rate_lower,leak_rate_upper,status\n" +
                   "".join(f"{load},{rate},{rate},{rate},ok\n"
                           for load, rate in zip(self.LOADS, (8., 2.))))

    def test_of_a_whole_seal(self):
        self.write_patch()
        scene = seal_scene.Seal(seal(1, "").replace("1, 2, 4", "3e-9, 1e-9"))
        alone, _, _ = whole_seal.Patches._of_loads(whole_seal.Run(self.folder), (1, 1), scene)
        self.assertEqual(alone.tolist(), [8., 2.])

    def test_of_realisations_near_the_threshold(self):
        # Reduced loads 2e-6 and 1e-5, for the critical load 1.
        (self.folder / "realisation-1").mkdir()
        self.write(**{"parameters_prm": "", "ensemble_csv": "realisation,status\n1,ok\n",
                      "realisation-1/leakage_csv":
                          "pressure,leak_rate,leak_rate_lower,leak_rate_upper,status\n"
                          "0.99999,8,8,8,ok\n0.999998,2,2,2,ok\n"})
        done = run_tool("strait-report", self.folder)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        page = (self.folder / "report.html").read_text(encoding="utf-8")
        text = " ".join(html.unescape(re.sub("<[^>]+>", " ", page)).split())
        self.assertIn("1 8 ± 0 % 2 ± 0 % All of each", text)


class Ensembles(InAFolder):
    HEADER = ("realisation,critical_load_lower,critical_load_upper,contact_area,crossover_load,"
              "theory_crossover_load,status\n")

    def setUp(self):
        super().setUp()
        (self.folder / "realisation-1").mkdir()
        self.write(parameters_prm="")
        self.write(ensemble_csv=self.HEADER + "1,1e5,1e5,0.2,1.6e5,1.5e5,ok\n")

    def write_thresholds(self, *rows):
        self.write(**{"realisation-1/threshold_csv":
                      "critical_load_lower,critical_load_upper,contact_area,slip_length\n" +
                      "".join(row + "\n" for row in rows)})

    def draw(self):
        """The labels of the panels, and the values in them."""
        panels, draw_strip = [], plot_ensemble.draw_strip

        def noted(axes, values, label):
            panels.append((label, *values))
            draw_strip(axes, values, label)

        with unittest.mock.patch.object(plot_ensemble, "draw_strip", noted):
            plot_ensemble.draw_ensemble(self.folder / "ensemble.csv", {"pressure": "Pa"})
        return panels

    def test_all_is_of_the_slip_length_nearest_to_zero(self):
        rows = ["1e5,1e5,0.2,-0.01", "2e5,2e5,0.4,0"]
        for ordered in (rows, rows[::-1]):
            self.write_thresholds(*ordered)
            self.assertEqual(self.draw(), [("Critical load, $d_0$ = 0 (kPa)", 200.),
                                           ("Contact area there", 0.4),
                                           ("Crossover load / critical load", 0.8)])

    def test_one_slip_length_is_not_named(self):
        self.write_thresholds("2e5,2e5,0.4,0")
        self.assertEqual([panel[0] for panel in self.draw()],
                         ["Critical load (kPa)", "Contact area there",
                          "Crossover load / critical load"])

    def test_loads_of_a_report_have_their_units(self):
        self.write(**{"realisation-1/leakage_csv":
                      "pressure,leak_rate,leak_rate_lower,leak_rate_upper,status\n1e5,1,1,1,ok\n",
                      "run_json": json.dumps({"column_units": dict.fromkeys((
                          "pressure", "critical_load_lower", "critical_load_upper",
                          "crossover_load", "theory_crossover_load"), "Pa")})})
        done = run_tool("strait-report", self.folder)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        page = (self.folder / "report.html").read_text(encoding="utf-8")
        for name in ("critical load lower", "crossover load", "theory crossover load"):
            self.assertIn(f"{name}<small>kPa</small>", page)


class Comparisons(InAFolder):
    def test_theory_is_compared_without_slip(self):
        scene = ("subsection Surface\n  set Size = 1\n  set Roll-off wavelength = 0.5\n"
                 "  set Short cut-off wavelength = 0.1\nend\nsubsection Fluid\n"
                 "  set Direction = x\n  set Inlet pressure = 1\n  set Outlet pressure = 0\n"
                 "  set Viscosity = 1\nend\n"
                 "subsection Theory\n  set Dimension parameter = bruggeman\nend\n")
        header = "pressure,slip_length,theory_contact_area,theory_leak_rate\n"
        self.write(parameters_prm=scene, leakage_csv=header + "0.1,-0.01,0.2,1e-7\n"
                   "0.1,0,0.2,1e-6\n0.2,-0.01,0.4,1e-9\n0.2,0,0.4,1e-8\n")
        load, leak, _ = plot_theory.normalised(self.folder)
        np.testing.assert_allclose(load / load[0], [1, 2])
        np.testing.assert_allclose(leak, 12e3 * np.array([1e-6, 1e-8]))
        self.write(leakage_csv=header + "0.1,-0.01,0.2,1e-7\n")
        refused = run_tool("plot_theory.py", self.folder)
        self.assertEqual(refused.returncode, 1)
        self.assertRegex(refused.stderr, r"slip length 0 .* there are none\n$")

    def test_two_doubts_are_no_failure(self):
        (self.folder / "runs").mkdir()
        self.write(**{"runs/leakage_csv":
                      "branch,pressure,reduced_load,leak_rate,leak_rate_lower,leak_rate_upper,"
                      "status\nloading,0.1,0.5,1e-3,1e-3,1e-3,ok\n"
                      "loading,0.18,0.1,1e-5,1e-5,1e-5,unresolved-throat+inaccurate\n"
                      "loading,0.19,0.05,1e-6,1e-6,1e-6,unresolved-throat+flow-accuracy\n"})
        _, right = plot_adhesion.draw_leakage([("a", self.folder / "runs")]).axes
        lines = [list(line.get_xdata()) for line in right.lines[:2]]
        self.assertEqual(lines, [[0.1, 0.5], [0.1]])  # the second: hollow markers


class ExampleMap(unittest.TestCase):
    def test_waves_above_the_roll_off_are_of_equal_power(self):
        power = np.abs(np.fft.fft2(make_example_map.heights(256)))
        k = np.hypot(*np.meshgrid(*2 * [np.fft.fftfreq(256, 1 / 256)]))
        largest = power.max()
        above = (k >= 1) & (k <= 256 / make_example_map.ROLL_OFF)
        np.testing.assert_allclose(power[above], largest)
        self.assertGreater(above.sum(), 40)
        self.assertLess(power[(k > 256 / make_example_map.SHORTEST) | (k == 0)].max(),
                        1e-9 * largest)
        self.assertIn("roll-off wavelength of 64", make_example_map.__doc__)


if __name__ == "__main__":
    unittest.main()
