#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Tests of tools/seal_network.py and tools/whole_seal.py: a seal from its patches."""
import csv
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools"))
import seal_scene  # noqa: E402
import whole_seal  # noqa: E402
from seal_network import Band, at_loads, network_conductance, sample_seals  # noqa: E402

# ln(K/e^µ) of N1 × N2 bonds with ln K ~ (µ, σ²): mean and standard deviation at σ = 1, 2, 3.
KNOWN = {(4, 4): ((0.03, 0.25), (0.09, 0.54), (0.18, 0.89)),
         (8, 8): ((0.04, 0.12), (0.11, 0.25), (0.19, 0.43)),
         (32, 32): ((0.01, 0.03), (0.03, 0.06), (0.06, 0.11)),
         (4, 128): ((0.09, 0.04), (0.29, 0.11), (0.61, 0.19))}


class Network(unittest.TestCase):
    """Conductances of bonds, where they are known."""

    def setUp(self):
        self.rng = np.random.default_rng(7)

    def square(self, draw, n1, n2):
        return network_conductance(draw((n1, n2)), draw((n1 - 1, n2))) * n1 / n2

    def test_side_by_side_and_one_after_the_other(self):
        bonds = np.array([2., 3., 5.])
        self.assertAlmostEqual(network_conductance(bonds[None], np.zeros((0, 3))), 10, 12)
        self.assertAlmostEqual(network_conductance(bonds[:, None], np.ones((2, 1))),
                               1 / (1 / bonds).sum(), 12)

    def test_a_network_solved_by_hand(self):
        # Two columns, without and with a short circuit between their middles.
        along = np.array([[1., 3.], [3., 1.]])
        for across, exact in ((0., 1.5), (1e9, 2.)):
            self.assertAlmostEqual(network_conductance(along, np.full((1, 2), across)), exact, 6)

    def test_against_a_dense_solution(self):
        for n1, n2 in ((2, 2), (3, 2), (4, 3), (3, 8), (6, 5)):
            along, across = self.rng.random((n1, n2)), self.rng.random((n1 - 1, n2))
            matrix, right = np.zeros((2, (n1 - 1) * n2, (n1 - 1) * n2)), np.zeros((n1 - 1) * n2)
            node = np.arange((n1 - 1) * n2).reshape(n1 - 1, n2)
            matrix = matrix[0]
            for i in range(n1):
                for j in range(n2):
                    ends = [node[k, j] for k in (i - 1, i) if 0 <= k < n1 - 1]
                    matrix[ends, ends] += along[i, j]
                    if len(ends) == 2:
                        matrix[ends, ends[::-1]] -= along[i, j]
                    if i < n1 - 1:
                        ends = [node[i, j], node[i, (j + 1) % n2]]
                        for a, b in (ends, ends[::-1]):
                            matrix[a, a] += across[i, j]
                            matrix[a, b] -= across[i, j]
            right[node[0]] = along[0]
            potential = np.linalg.solve(matrix, right)
            exact = (along[0] * (1 - potential[node[0]])).sum()
            self.assertAlmostEqual(network_conductance(along, across) / exact, 1, 10)

    def test_dykhne(self):
        def half(shape):
            return self.rng.choice([1., 100.], size=shape)
        logs = [np.log(self.square(half, 48, 48)) for _ in range(40)]
        self.assertAlmostEqual(np.mean(logs), np.log(10), delta=0.06)  # 2.3 %; scatter 0.007

    def test_log_normal_bias_and_scatter(self):
        for (n1, n2), rows in KNOWN.items():
            for sigma, (bias, scatter) in zip((1, 2, 3), rows):
                def draw(shape, sigma=sigma):
                    return np.exp(sigma * self.rng.standard_normal(shape))
                logs = [np.log(self.square(draw, n1, n2)) for _ in range(150)]
                self.assertAlmostEqual(np.mean(logs), bias, delta=0.01 + 0.3 * scatter)
                self.assertAlmostEqual(np.std(logs) / scatter, 1, delta=0.35)

    def test_sealed_patches(self):
        self.assertEqual(network_conductance(np.zeros((3, 4)), np.ones((2, 4))), 0)
        blocked = np.ones((3, 4))
        blocked[1] = 0
        self.assertEqual(network_conductance(blocked, np.ones((2, 4))), 0)
        one = np.zeros((3, 4))
        one[:, 2] = 3
        island = np.zeros((2, 4))
        island[0, 0] = 1  # a bond that nothing leads to
        self.assertAlmostEqual(network_conductance(one, island), 1, 12)
        sealed = [self.square(lambda shape: (self.rng.random(shape) > f) * 1., 60, 60)
                  for f in (0.05, 0.6)]
        self.assertAlmostEqual(sealed[0], 0.9, delta=0.04)
        self.assertEqual(sealed[1], 0)

    def test_ten_orders_of_magnitude(self):
        def draw(shape):
            return np.exp(6 * self.rng.standard_normal(shape))
        along, across = draw((16, 16)), draw((15, 16))
        direct = network_conductance(along, across)
        self.assertAlmostEqual(network_conductance(along * 1e-30, across * 1e-30) * 1e30 / direct,
                               1, 8)

    def test_patches_that_are_not_square(self):
        pool = np.full((3, 4), 7.)
        for aspect in (0.5, 1, 2):
            seals = sample_seals(pool, pool[:, 1:], 12, aspect, True, self.rng)
            np.testing.assert_allclose(seals, 7., rtol=1e-9)


class InLoad(unittest.TestCase):
    """Patches between the loads where they are known."""

    def test_exponential_is_exact(self):
        loads = np.array([1., 2., 4.])
        wanted = np.array([1., 1.3, 2., 3.7, 4.])
        np.testing.assert_allclose(at_loads(loads, np.exp(-3 * loads)[None], wanted),
                                   np.exp(-3 * wanted)[None])

    def test_towards_a_sealed_patch(self):
        known = at_loads(np.array([1., 2., 3.]), np.array([[4., 2., 0.]]),
                         np.array([2.5, 3.]))
        np.testing.assert_allclose(known, [[1., 0.]])

    def test_rounding_opens_no_sealed_patch(self):
        # At the load where one patch seals and at that from which another one leaks.
        loads = np.array([0.05, 0.12, 0.25])
        about = 0.12 * (1 + np.array([-4, -1, 0, 1, 4]) * np.finfo(float).eps)
        known = at_loads(loads, np.array([[1., 0., 0.], [0., 0., 1.]]), about)
        self.assertTrue((known == 0).all())

    def test_wanted_load(self):
        loads = np.array([1., 2., 3.])
        self.assertAlmostEqual(whole_seal.crossing(loads, np.array([100., 10., 0.]), 10**1.5), 1.5)
        self.assertAlmostEqual(whole_seal.crossing(loads, np.array([100., 10., 0.]), 2.5), 2.75)
        self.assertTrue(np.isnan(whole_seal.crossing(loads, np.array([9., 8., 7.]), 1.)))
        self.assertAlmostEqual(whole_seal.crossing(loads, np.array([10., 8., 7.]), 10.), 1.)
        self.assertAlmostEqual(whole_seal.crossing(loads, np.array([9., 8., 8.]), 8.), 2.)


class InARow(unittest.TestCase):
    """Patches one behind the other, whose ends do not open on reservoirs."""

    def test_what_the_ends_add_is_counted_once(self):
        # A resistance of 3 in a row, less 1 for the two ends together.
        alone, two = np.array([1 / 2]), np.array([1 / 5])
        inner, _ = whole_seal.in_endless_row(alone, two, 0., 0.)
        self.assertAlmostEqual(inner[0], 1 / 3)
        for n in (1, 2, 3, 7):
            along, ends = np.full((1, n), inner[0]), np.full((1, n), alone[0])
            whole_seal.open_at_ends(along, ends)
            self.assertAlmostEqual(1 / network_conductance(along.T, np.zeros((n - 1, 1))),
                                   3 * n - 1)

    def test_errors_and_sealed_rows(self):
        alone, two = np.array([1., 1., 0., 1.]), np.array([0.5, 0., 0., 0.6])
        inner, error = whole_seal.in_endless_row(alone, two, 0.01, 0.01)
        # No ends; a way through one that does not meet itself; sealed; a bracket that is wide.
        np.testing.assert_allclose(inner, [1., 0., 0., 1.])
        self.assertAlmostEqual(error[0], 0.03)
        self.assertEqual(list(error[1:3]), [0., 0.])


class Confidence(unittest.TestCase):
    """The band of 90 % holds the truth as often as it says."""

    def test_coverage_of_log_normal_patches(self):
        # What a seal of the whole population leaks, against bands from eight of its patches.
        rng = np.random.default_rng(3)
        inside = 0
        for _ in range(25):
            pool = np.repeat(np.exp(rng.standard_normal((8, 1))), 6, axis=1)
            band = Band(pool, pool[:, 1:], 12, 1., 0., rng)
            truth = network_conductance(np.exp(rng.standard_normal((6, 12))),
                                        np.exp(rng.standard_normal((5, 12)))) / 2
            inside += band.lower < truth < band.upper
        self.assertGreaterEqual(inside, 18)  # 22.5 are expected; fewer than 18 by a chance of 0.2 %

    def test_the_error_of_the_solution_is_not_widened(self):
        # Of one patch, as it were: 5 and 95 % of what is uniform between the bounds.
        pool = np.ones((2, 1)) * [[1.], [1 + 1e-13]]
        for error in (0.0318, 0.3):
            band = Band(pool, pool[:, 1:], 20, 1., error, np.random.default_rng(1))
            self.assertGreater(band.student, 5)
            self.assertAlmostEqual(np.log(band.upper) / error, 0.9, delta=0.05)
            self.assertAlmostEqual(np.log(band.lower) / error, -0.9, delta=0.05)
        # Where patches differ Student's t widens that, and the solutions add no more than they err.
        pool = np.array([[1.], [4.]])
        alone, mixed = (Band(pool, pool[:, 1:], 20, 1., error, np.random.default_rng(1))
                        for error in (0., 0.0318))
        self.assertLess(abs(np.log(mixed.upper / alone.upper)), 0.0318)
        self.assertLess(abs(np.log(mixed.lower / alone.lower)), 0.0318)

    def test_where_it_comes_from(self):
        rng = np.random.default_rng(3)
        many = np.repeat(np.exp(rng.standard_normal((400, 1))), 4, axis=1)
        band = Band(many, many[:, 1:], 4, 1., 0., rng)
        self.assertAlmostEqual(band.arrangement, 0.25, delta=0.05)  # σ/√(N1 N2)
        self.assertLess(band.patches, 0.6 * band.arrangement)  # σ/√n = 0.05, hidden below it
        few = many[:8]
        band = Band(few, few[:, 1:], 500, 1., 0., rng)
        expected = np.log(few[:, 0]).std(ddof=1) / np.sqrt(8)
        self.assertAlmostEqual(band.patches / expected, 1, delta=0.3)
        self.assertLess(band.arrangement, 0.3 * band.patches)


SCENE = """subsection Surface
  set Kind = self-affine
  set Size = 1
  set Roll-off wavelength = 0.25
  set Rotate = {rotate}
end
subsection Fluid
  set Direction = x
end
subsection Contact
  set Yielding = {yielding}
end
subsection Load programme
  set Pressures = {loads}
end
subsection Realisations
  set Orientations = {orientations}
end
subsection Seal
  set Enabled = true
  set Circumference = 20
  set Contact width = 4
  set Pressure profile = {profile}
  set Isotropic = {isotropic}
  set Wanted leak rate = {wanted}
end
subsection Output
  set Leak rate units =
end
"""


class OfAFolder(unittest.TestCase):
    """The script, with made-up results."""

    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)
        self.about = {"loads": "0.1, 0.2, 0.4", "profile": "", "isotropic": "true", "wanted": 0,
                      "rotate": "false", "yielding": "none", "orientations": "as is, rotated"}

    def write(self, rates, rotated=(), status="ok", **about):
        """A realisation for each list of leak rates."""
        self.about.update(about)
        loads = self.about["loads"].split(", ")
        for k, of_one in enumerate([None, *rates]):
            folder = self.folder / f"realisation-{k}" if k else self.folder
            folder.mkdir(exist_ok=True)
            about = {**self.about, "rotate": "true" if k in rotated else "false"}
            (folder / "parameters.prm").write_text(SCENE.format(**about))
            if k:
                (folder / "leakage.csv").write_text(
                    "pressure,leak_rate,leak_rate_lower,leak_rate_upper,status\n" +
                    "".join(f"{load},{rate},{0.99 * rate},{1.01 * rate},{status}\n"
                            for load, rate in zip(loads, of_one)))

    def assess(self, *arguments, scene=None):
        return subprocess.run(
            [sys.executable, str(ROOT / "tools" / "whole_seal.py"),
             *(arguments or [str(self.folder)])],
            text=True, capture_output=True, check=False,
            input=scene if scene is not None else "")

    def table(self, name="seal.csv"):
        with open(self.folder / name, encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def test_a_folder_without_a_run(self):
        result = self.assess(str(self.folder / "none"))
        self.assertEqual(result.returncode, 1)
        self.assertRegex(result.stderr, r"^whole_seal.py: there is no file \S+/none/parameters.prm; ")
        result = self.assess(__file__)
        self.assertEqual(result.returncode, 1)
        self.assertRegex(result.stderr, r"^whole_seal.py: there is no file \S+/parameters.prm; ")

    def test_a_seal_smaller_than_a_patch(self):
        self.write([[8., 2., 0.5]] * 4)
        self.assertNotIn("a patch is", self.assess().stdout)
        scene = self.folder / "parameters.prm"
        text = scene.read_text().replace("rence = 20", "rence = 0.5").replace("= 4", "= 0.5")
        scene.write_text(text)
        said = self.assess().stdout
        self.assertIn("a patch is longer than the contact is wide (0.5)", said)
        self.assertIn("a patch is broader than the seal is long (0.5)", said)

    def test_equal_patches(self):
        self.write([[8., 2., 0.5]] * 4, wanted=4.)
        result = self.assess()
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        for row, rate in zip(self.table(), (8., 2., 0.5)):  # times 20/4
            self.assertAlmostEqual(float(row["leak_rate_median"]) / (5 * rate), 1, delta=0.01)
            self.assertGreater(float(row["leak_rate_5_percent"]), 4.9 * rate)
            self.assertLess(float(row["leak_rate_95_percent"]), 5.1 * rate)
            self.assertAlmostEqual(float(row["solution_error"]), 0.01)
        # ln Q is linear in the load: from 10 at 0.2 to 2.5 at 0.4.
        load = 0.2 + 0.2 * np.log(10 / 4) / np.log(4)
        found = self.table("seal_load.csv")[0]
        self.assertAlmostEqual(float(found["load"]), load, delta=0.004)
        self.assertLess(float(found["load_5_percent"]), float(found["load_95_percent"]))

    def test_columns_are_those_of_the_manual(self):
        self.write([[8., 2., 0.5], [6., 1., 0.1]], wanted=4.)
        self.assess()
        manual = (ROOT / "doc" / "results.md").read_text(encoding="utf-8")
        for name in ("seal.csv", "seal_load.csv"):
            section = manual.split(f"## {name}\n")[1].split("\n## ")[0]
            self.assertEqual(list(self.table(name)[0]), re.findall(r"^\| `(\w+)`", section, re.M))

    def test_a_lay_across_the_flow(self):
        # Along 1, across 1e-6: no current leaves its column, so the mean of series of four.
        self.write([[1.] * 3] * 2 + [[1e-6] * 3] * 2, rotated=(3, 4), isotropic="false")
        result = self.assess()
        self.assertIn("2 along the flow and 2 across", result.stdout)
        self.assertAlmostEqual(float(self.table()[0]["leak_rate_median"]), 5, delta=0.1)
        self.write([[1.] * 3] * 2 + [[1e-6] * 3] * 2, rotated=(3, 4), isotropic="true")
        self.assertIn("4 along the flow, which serve across it as well", self.assess().stdout)
        self.assertLess(float(self.table()[0]["leak_rate_median"]), 1)

    def test_a_lay_without_patches_that_tell_of_it(self):
        for orientations, width, missing in (("as is, inverted", 4, "across the lay; add rotated"),
                                             ("rotated", 4, "along the flow; add 'as is'"),
                                             ("as is", 1, None)):
            self.about.update(isotropic="false", orientations=orientations)
            refused = self.assess("--check", scene=SCENE.format(**self.about).replace(
                "width = 4", f"width = {width}"))
            self.assertEqual(refused.returncode, 1 if missing else 0)
            self.assertIn(missing or "", refused.stderr)
        # None is left.
        self.write([[1.] * 3] * 3, rotated=(3,), isotropic="false", orientations="as is, rotated")
        (self.folder / "realisation-3" / "leakage.csv").unlink()
        self.assertRegex(self.assess().stderr, "^The whole seal has a lay and needs a patch across "
                                               "it .*, and there is none: realisation-3 .*\\.\n$")

    def test_what_dominates(self):
        rng = np.random.default_rng(2)
        self.write(np.exp(rng.standard_normal((8, 1))) * [1, 1, 1])
        self.assertRegex(self.assess().stdout, "comes from the number of patches: 32 in place of 8")
        self.write([[1., 1., 1.]] * 8)
        self.assertIn("comes from the solutions of the patches", self.assess().stdout)
        self.write([[1., 1., 0.]] * 7 + [[1., 1., 1.]])
        self.assertIn("most seals do not leak at all", self.assess().stdout)
        self.assertEqual(float(self.table()[-1]["leak_rate_median"]), 0)
        self.write([[1., 1., 0.]] * 4 + [[1., 1., 1.]] * 4)
        self.assertRegex(self.assess().stdout, "at 0.4 [0-9.]+ % of seals do not leak at all: ")

    def test_sealed_patches_take_nothing_off_the_error(self):
        loads, nan = [.1, .2, .3], np.nan
        error_at = whole_seal.mean_errors(loads, np.array([[.02, nan, nan], [.04, .08, nan]]))
        for load, error in ((.1, .03), (.15, .055), (.2, .08), (.25, .08), (.3, .08)):
            self.assertAlmostEqual(float(error_at(load)), error)
        self.assertEqual(float(whole_seal.mean_errors(loads, np.full((2, 3), nan))(.2)), 0)
        self.write([[8., 2., 0.]] * 3 + [[8., 2., 0.5]])
        self.assess()
        for row in self.table():
            self.assertAlmostEqual(float(row["solution_error"]), 0.01)

    def test_what_depends_on_the_drop_is_pointed_out(self):
        self.write([[1., 1., 1.]] * 4)
        self.assertNotIn("pressure drop", self.assess().stdout)
        path = self.folder / "parameters.prm"
        path.write_text(path.read_text().replace("  set Direction = x",
                                                 "  set Direction = x\n  set Rarefaction = slip"))
        self.assertIn("under the whole pressure drop", self.assess().stdout)

    def test_wanted_load_where_patches_seal(self):
        rng = np.random.default_rng(3)
        first = np.exp(rng.standard_normal(8))
        self.write([[a, .1 * a, 0 if k < 3 else 1e-3 * a] for k, a in enumerate(first)],
                   wanted=.05)
        self.assess()
        found = self.table("seal_load.csv")[0]
        low, middle, high = (float(found[name]) for name in
                             ("load_5_percent", "load", "load_95_percent"))
        self.assertLess(low, middle)
        self.assertLess(middle, high)
        # The whole seal at that load leaks as much as is wanted.
        scene = whole_seal.seal_of(whole_seal.scene_in(self.folder))
        patches = whole_seal.Patches(self.folder, scene)
        band, = whole_seal.bands_of(scene, patches, [middle])
        self.assertAlmostEqual(band.median / .05, 1, delta=.05)

    def test_two_patches(self):
        medians = []
        for order in ([[4.] * 3, [1.] * 3], [[1.] * 3, [4.] * 3]):
            self.write(order)
            self.assess()
            row = self.table()[0]
            medians.append(float(row["leak_rate_median"]))
            self.assertLess(float(row["leak_rate_5_percent"]), 5.)
            self.assertGreater(float(row["leak_rate_95_percent"]), 20.)
        np.testing.assert_allclose(medians, 10., rtol=.2)   # five times the geometric mean

    def test_a_path_that_turns_round(self):
        # What leaks on the way back is of another curve where states depend on their past.
        warning = "the path of the loads turns round"
        for loads, kept in (("0.1, 0.4, 0.2", 2), ("0.1, 0.2, 0.1", 2), ("0.4, 0.2, 0.1", 3),
                            ("0.1, 0.2, 0.2", 2)):
            rates = [8., 1., 4.] if loads.startswith("0.1") else [1., 4., 8.]
            self.write([rates] * 4, loads=loads, yielding="cut-off")
            self.assertEqual(warning in self.assess().stdout, loads not in ("0.4, 0.2, 0.1",
                                                                            "0.1, 0.2, 0.2"))
            self.assertEqual(len(self.table()), kept)
            self.assertAlmostEqual(float(self.table()[0]["leak_rate_median"]) / 40, 1, delta=.01)
        self.write([[8., 1., 4.]] * 4, loads="0.1, 0.4, 0.2", yielding="none")
        self.assertNotIn(warning, self.assess().stdout)
        self.assertEqual(len(self.table()), 3)

    def test_small_patches_are_pointed_out(self):
        self.write([[1., 1., 1.]] * 4)
        self.assertNotIn("roll-off", self.assess().stdout)
        for path in self.folder.rglob("parameters.prm"):
            path.write_text(path.read_text().replace("= 0.25", "= 0.5"))
        self.assertIn("are 2 roll-off wavelengths long", self.assess().stdout)

    def test_hertz(self):
        self.about["profile"] = "hertz"
        seal = seal_scene.Seal(SCENE.format(**self.about))
        along, around, _ = seal.columns()
        self.assertAlmostEqual(along.mean(), 1, 14)
        # The integrals of (4/π) √(1 − ξ²) over an outer and an inner quarter of the width.
        outer = 4 / np.pi * (np.pi / 3 - np.sqrt(3) / 4)
        np.testing.assert_allclose(along, [outer, 2 - outer, 2 - outer, outer], rtol=1e-14)
        self.assertEqual(len(around), 3)
        self.assertGreater(around[1], around[0])
        # 0.1 and 0.4 would need more than the patches know, of the bond in the middle as well.
        middle = 8 / np.pi * (np.sqrt(15) / 16 + np.arcsin(1 / 4))
        np.testing.assert_allclose(seal.rows(), [0.1 / outer, 0.2, 0.4 / middle], rtol=1e-14)

    def test_the_mean_of_any_profile_is_one(self):
        table = self.folder / "profile.csv"
        for n, inner in ((1, 0.3), (2, 1.1), (3, 2.7), (7, 0.01), (40, 39.9)):
            table.write_text(f"0 0.1\n{inner} 0.7\n{n} 0.2\n")
            for profile in ("", "hertz", table):
                self.about["profile"] = profile
                scene = SCENE.format(**self.about).replace("width = 4", f"width = {n}")
                along, _, mean = seal_scene.Seal(scene).columns()
                self.assertAlmostEqual(along.mean(), 1, 13)
                if mean:
                    self.assertAlmostEqual(mean, (0.8 * inner + 0.9 * (n - inner)) / 2 / n, 13)

    def test_one_row_of_patches_has_no_profile(self):
        self.about.update(loads="0.1", profile="hertz")
        scene = SCENE.format(**self.about).replace("width = 4", "width = 1")
        refused = self.assess("--check", scene=scene)
        self.assertEqual(refused.returncode, 1)
        self.assertRegex(refused.stderr, "^Seal/Pressure profile = hertz cannot press parts .* = 1; "
                                         r"make .* or leave the profile empty\.\n$")
        table = self.folder / "profile.csv"
        table.write_text("0 0.1\n1 0.1\n")
        even = scene.replace("profile = hertz", f"profile = {table}")
        self.assertEqual(self.assess("--check", scene=even).returncode, 0)
        scene = scene.replace("profile = hertz", "profile =")
        self.assertEqual(list(seal_scene.Seal(scene).rows()), [0.1])
        self.assertEqual(self.assess("--check", scene=scene).returncode, 0)

    def rows(self, loads, profile):
        self.about.update(loads=loads, profile=profile)
        return seal_scene.Seal(SCENE.format(**self.about)).rows()

    def test_loads_under_tension(self):
        self.assertEqual(list(self.rows("-0.1, 0.2, 0.4", "")), [-0.1, 0.2, 0.4])
        self.assertEqual(list(self.rows("-0.3, -0.2, -0.1", "")), [-0.3, -0.2, -0.1])
        # The same loads pull as push: what is known of pressure is known of tension.
        pushed = self.rows("0.1, 0.2, 0.4", "hertz")
        np.testing.assert_allclose(self.rows("-0.4, -0.2, -0.1", "hertz"), -pushed[::-1])
        np.testing.assert_allclose(self.rows("-0.4, 0, 0.4", "hertz"), [-pushed[-1], 0, pushed[-1]])
        table = self.folder / "profile.csv"
        table.write_text("0 0\n2 0\n3 1\n4 1\n")  # a mean of 3/8, and nothing on the first half
        np.testing.assert_allclose(self.rows("-0.3, 0.1, 1", table), [-0.3 * 3 / 8, 0.1, 3 / 8])  # once
        refused = self.assess("--check", scene=SCENE.format(
            **{**self.about, "loads": "-0.21, -0.2", "profile": "hertz"}))
        self.assertRegex(refused.stderr, r"presses the patches by -0\.25\d* to -0\.16\d*; let Load")

    def test_profile_of_a_table(self):
        table = self.folder / "profile.csv"
        table.write_text("x (m), p\n0, 0.1\n2, 0.3\n4, 0.1\n")
        self.about["profile"] = table
        seal = seal_scene.Seal(SCENE.format(**self.about))
        along, _, mean = seal.columns()
        self.assertAlmostEqual(mean, 0.2)
        np.testing.assert_allclose(along, [0.75, 1.25, 1.25, 0.75], rtol=1e-9)
        np.testing.assert_allclose(seal.rows(), [0.1 / 0.75, 0.2, 0.4 / 1.375])

    def test_what_is_refused(self):
        scene = SCENE.format(**{**self.about, "profile": "hertz"})
        self.assertEqual(self.assess("--check", scene=scene).returncode, 0)
        narrow = self.assess("--check", scene=scene.replace("0.1, 0.2, 0.4", "0.2, 0.21"))
        self.assertEqual(narrow.returncode, 1)
        self.assertRegex(narrow.stderr, r"presses the patches by 0\.16\d* to 0\.25\d*; let Load")
        bad = self.folder / "bad.txt"
        for text, words in (("1 2\n", "two or more lines"), ("0 1\n4 -1\n", "not negative"),
                            ("4 1\n0 1\n", "grows"), ("0 1\n3 1\n", "make them the same"),
                            ("0,0;1,2\n2,5;1,3\n4,0;1,2\n", "decimal commas in line 1"),
                            ("x p\n0 1\n2 garbage\n4 1\n", "no two numbers in line 3")):
            bad.write_text(text)
            result = self.assess("--check", scene=SCENE.format(**{**self.about, "profile": bad}))
            self.assertEqual(result.returncode, 1, text)
            self.assertIn(words, result.stderr)
        gone = self.assess("--check", scene=SCENE.format(**{**self.about, "profile": "/none"}))
        self.assertRegex(gone.stderr, "^Seal/Pressure profile: .*/none.*\n$")

    def test_patches_of_an_earlier_run_are_left_out(self):
        self.write([[8., 2., 0.5]] * 4)
        (self.folder / "ensemble.csv").write_text("realisation,seed\n1,1\n2,2\n3,3\n")
        self.assertIn("drawn from 3 along the flow", self.assess().stdout)

    def test_one_slip_length_of_several_is_taken_and_named(self):
        self.write([[8., 2., 0.5]] * 3)
        self.assertNotIn("slip", self.assess().stdout)
        slips = [(-0.005, 0.1), (0, 1)]
        for ordered in (slips, slips[::-1]):
            for path in self.folder.glob("realisation-*/leakage.csv"):
                path.write_text("pressure,slip_length,leak_rate,leak_rate_lower,leak_rate_upper,"
                                "status\n" + "".join(
                                    f"{load},{slip}{f',{factor * rate}' * 3},ok\n"
                                    for load, rate in ((0.1, 8.), (0.2, 2.), (0.4, 0.5))
                                    for slip, factor in ordered))
            self.assertIn("serve across it as well, with the slip length 0, the nearest to zero of 2\n",
                          self.assess().stdout)
            self.assertAlmostEqual(float(self.table()[0]["leak_rate_median"]), 40, delta=0.1)

    def write_errors(self, *sources):
        """The column leak_rate_error, and what run.json says that it holds."""
        for path in self.folder.glob("realisation-*/leakage.csv"):
            lines = path.read_text().splitlines()
            path.write_text("\n".join([lines[0] + ",leak_rate_error"] +
                                      [line + ",0.2" for line in lines[1:]]) + "\n")
            path.with_name("run.json").write_text(json.dumps({"error_budget": [
                {"step": k, "relative_errors": dict.fromkeys(sources, 0.1)} for k in (1, 2)]}))

    def test_the_error_of_the_contact_grid_is_sought_in_the_budget(self):
        doubt = "the error of the contact grid is not in the band; "
        self.write([[8., 2., 0.5]] * 3)
        self.assertIn(doubt + "Output/Error budget = true", self.assess().stdout)
        self.write_errors("mesh", "gap interpolation")  # of a grid that cannot be halved
        said = self.assess().stdout
        self.assertIn(doubt + "the logs of the patches say why", said)
        self.assertIn("improve Contact/Grid points", said)
        self.write([[8., 2., 0.5]] * 3)
        self.write_errors("mesh", "gap interpolation", "contact grid")
        self.assertNotIn(doubt, self.assess().stdout)

    def test_bounds_that_are_wider_than_asked_are_no_failure(self):
        self.write([[8., 2., 0.5]] * 3)
        before = self.assess().stdout
        path = self.folder / "realisation-2" / "leakage.csv"
        path.write_text(path.read_text().replace("ok\n0.4", "flow-accuracy\n0.4"))
        self.assertEqual(self.assess().stdout, before)

    def test_patches_that_failed_are_left_out(self):
        self.write([[8., 2., 0.5]] * 3)
        path = self.folder / "realisation-2" / "leakage.csv"
        path.write_text(path.read_text().replace("ok\n0.4", "flow-not-converged\n0.4"))
        result = self.assess()
        self.assertEqual(result.returncode, 0)
        self.assertIn("left out: realisation-2", result.stdout)
        (self.folder / "realisation-1" / "leakage.csv").unlink()
        result = self.assess()
        self.assertEqual(result.returncode, 1)
        self.assertIn("needs two patches", result.stderr)


if __name__ == "__main__":
    unittest.main()
