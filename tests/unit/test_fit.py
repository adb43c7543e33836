#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Tests of tools/fit.py and of python/strait/scaling.py."""
import contextlib
import csv
import io
import pathlib
import sys
import tempfile
import unittest

import numpy as np

TOOLS = pathlib.Path(__file__).resolve().parents[2] / "tools"
sys.path.insert(0, str(TOOLS))
import fit  # noqa: E402
import strait_scaling as scaling  # noqa: E402
from strait_results import read_table  # noqa: E402


class Exponents(unittest.TestCase):
    def test_powers_and_their_drift(self):
        reduced = np.array([0.1, 0.003, 0.02, 0.01])
        values = 7 * reduced**3.45
        chosen = scaling.within(reduced, (0, 0.02))
        found = scaling.fit_exponent(reduced[chosen], values[chosen])
        self.assertEqual((found.start, found.end, found.points), (0.003, 0.02, 3))
        self.assertAlmostEqual(found.exponent, 3.45, places=12)
        self.assertAlmostEqual(found.error, 0, places=6)
        pairs = scaling.neighbours(reduced)
        self.assertEqual(pairs, [(0, 2), (2, 3), (3, 1)])
        self.assertIsNone(scaling.fit_exponent(reduced[:1], values[:1]))
        self.assertIsNone(scaling.fit_exponent(np.array([]), np.array([])))

    def test_standard_error_of_a_line(self):
        # y = 0, 1, 0 at x = −1, 0, 1: a slope of 0, and 2/3 left over for one degree of freedom.
        found = scaling.fit_exponent(np.exp([-1, 0, 1]), np.exp([0, 1, 0]))
        self.assertAlmostEqual(found.exponent, 0)
        self.assertAlmostEqual(found.error, np.sqrt(2 / 3 / 2))

    def test_the_same_load_twice_tells_none(self):
        twice = np.array([0.3, 0.3])
        self.assertIsNone(scaling.fit_exponent(twice, twice))
        self.assertEqual(scaling.neighbours(twice), [])

    def test_a_slow_decay_has_no_crossover(self):
        reduced = np.array([0.7, 0.5, 0.3])
        for slope, expected in ((6.9, 0.5), (3.46, 3.45 / 3.46), (3.44, np.nan), (1, np.nan),
                                (0, np.nan), (-5, np.nan)):
            rate = scaling.decay_rate(reduced, np.exp(slope * reduced))
            self.assertAlmostEqual(rate, slope, places=12)
            np.testing.assert_allclose(scaling.crossover(rate), expected, rtol=1e-12)
        self.assertTrue(np.isnan(scaling.decay_rate(reduced[:1], reduced[:1])))


class ClosingLaw(unittest.TestCase):
    def test_exponents_of_a_square_saddle(self):
        # Worked out by hand from the formulas.
        for load, gap, width, leak_rate in ((1.4e-2, 1.206, .461, 3.476), (7e-4, 1.174, .472, 3.406),
                                            (1.4e-4, 1.162, .475, 3.380), (1.4e-5, 1.150, .479, 3.353),
                                            (1e-8, 1.124, .485, 3.296), (1e-12, 1.106, .489, 3.255)):
            np.testing.assert_allclose(scaling.closing_law(load), (gap, width, .5 * gap, leak_rate),
                                       atol=1e-3)
        # The limits are approached so slowly that no contact gets there.
        self.assertTrue(3.05 < scaling.closing_law(1e-300).leak_rate < 3.08)

    def test_the_constant_that_exponents_were_made_with(self):
        load = np.array([.05, 1e-2, 1e-3, 1e-4])
        for constant in (-1., -.1, 0., .7, 5.):
            exponents = scaling.closing_law(load, constant).leak_rate
            # One that is too large and one that is too small by as much.
            for change in (0, np.array([.01, 0, 0, -.01])):
                self.assertAlmostEqual(scaling.closing_constant(load, exponents + change), constant,
                                       places=6)

    def test_no_constant_would_do(self):
        for load, exponents in (((), ()), ((1e-2,), (2.9,)), ((1e-2,), (6.,))):
            self.assertTrue(np.isnan(scaling.closing_constant(np.array(load), np.array(exponents))))
        self.assertTrue(np.isnan(scaling.closing_law(1e-3, np.nan).leak_rate))
        # Where the constriction is no small part.
        self.assertTrue(np.isnan(scaling.closing_law(.3, -1.3).leak_rate))
        self.assertFalse(np.isnan(scaling.closing_law(.05, -1.3).leak_rate))


def step(reduced_load, leak_rate, status="ok", validity="ok", slip_length=0.):
    """What a row of a run needs, with the square of the leak rate for that of the theory."""
    return {"reduced_load": reduced_load, "leak_rate": leak_rate, "status": status,
            "validity": validity, "slip_length": slip_length, "theory_leak_rate": leak_rate**2}


class Folder(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.addCleanup(self.temporary.cleanup)
        self.folder = pathlib.Path(self.temporary.name)

    def table(self, name, rows, columns=()):
        """Write a table of dictionaries."""
        with open(self.folder / name, "w", newline="", encoding="utf-8") as file:
            writer = csv.DictWriter(file, columns or rows[0])
            writer.writeheader()
            writer.writerows(rows)

    def make_run(self, steps, largest=0.02, thresholds=((0., 2.),), where="", scene=""):
        """The tables that a run leaves, with throats that close like ε^1.2."""
        (self.folder / where).mkdir(exist_ok=True)
        (self.folder / "parameters.prm").write_text(
            "subsection Load programme\n"
            f"  set Largest reduced load of fits = {largest}\nend\n{scene}", encoding="utf-8")
        numbers = [{"step": k + 1, **row} for k, row in enumerate(steps)]
        self.table(where + "leakage.csv", numbers)
        self.table(where + "constrictions.csv",
                   [{"step": row["step"], "gap": row["reduced_load"]**1.2,
                     "length": row["reduced_load"]**.6, "width": row["reduced_load"]**.45}
                    for row in numbers if row["leak_rate"] > 0], ("step", "gap", "length", "width"))
        self.table(where + "threshold.csv",
                   [{"slip_length": slip, "critical_load_lower": load, "critical_load_upper": load}
                    for slip, load in thresholds])

    def said(self, *options):
        """What the script prints."""
        screen = io.StringIO()
        with contextlib.redirect_stdout(screen):
            status = fit.main([str(self.folder), *options])
        self.assertEqual(status, 0, screen.getvalue())
        return screen.getvalue().splitlines()

    def warnings(self, *options):
        """Those of a run."""
        return [line.partition(": ")[2] for line in self.said(*options)
                if line.startswith("warning: ")]

    def summary(self, largest=0.02):
        """What a run says for ensemble.csv, and its words."""
        return fit.summary_of(fit.samples_in(self.folder), largest,
                              read_table(self.folder / "threshold.csv"), True)[:2]


class OfARun(Folder):
    def test_resolved_steps_alone_are_fitted(self):
        self.make_run([*(step(e, e**3.) for e in (.02, .01, .005)),
                       step(.002, 1., "unresolved-throat"),
                       step(.001, 1., "flow-accuracy")])
        self.assertEqual(self.warnings()[0],
                         "exponent of leak_rate: 3 of 5 steps with 1 - L/L_c from 0 to 0.02 serve; "
                         "the others are left out for unresolved-throat+flow-accuracy")
        found, words = self.summary()
        self.assertAlmostEqual(found["exponent"], 3., places=12)
        self.assertEqual(words, "ok")
        table = read_table(self.folder / "fit.csv")
        self.assertEqual(tuple(table), fit.FIT_COLUMNS)
        leak = table.rows(table["quantity"] == "leak_rate")
        self.assertEqual(list(leak["kind"]), ["local"] * 3 + ["fit"])
        self.assertEqual(list(leak["status"]), ["ok", "ok", "unresolved-throat", "ok"])
        self.assertEqual(list(leak["points"]), [2, 2, 2, 3])
        exponents = {name: rows["exponent"][-1] for name, rows in table.groups("quantity")}
        self.assertEqual({name: round(value, 9) for name, value in exponents.items()},
                         {"leak_rate": 3., "throat_gap": 1.2, "throat_length": .6,
                          "throat_width": .45})

    def test_what_is_missing_is_said(self):
        steps = [step(.02, 1., "unresolved-throat"), step(.01, .1)]
        for more, expected in ((None, "no-exponent"), (step(.5, 10.), "no-exponent"),
                               (step(.3, 1., validity="steep+coarse-throat"),
                                "no-exponent+no-crossover")):
            steps += [more] if more else []
            self.make_run(steps)
            found, words = self.summary()
            self.assertEqual(words, expected)
            self.assertTrue(np.isnan(found["crossover"]))
        self.assertEqual(self.warnings()[-1],
                         "no crossover load, which takes two steps: 1 of 2 steps with 1 - L/L_c "
                         "from 0.3 to 0.7 serve; the others are left out for coarse-throat")
        self.assertEqual(set(read_table(self.folder / "fit.csv")["kind"]), {"local"})

    def test_the_window_of_the_law_is_that_of_the_fit(self):
        # The largest load is there but for rounding.
        self.make_run([step(e, e**3.6) for e in (.30000000000000004, .2)], .3)
        self.assertEqual(self.said()[0],
                         "exponent of leak_rate: 3.600 ± 0.000 for 0.2 <= 1 - L/L_c <= 0.3 "
                         "(2 points)")
        table = read_table(self.folder / "fit.csv")
        self.assertAlmostEqual(table["closing_law"][0], 3.6, places=6)
        self.assertTrue(np.isnan(table["closing_law"][1]))

    def test_another_window(self):
        self.make_run([step(e, e**(3. if e < .015 else 4.)) for e in (.04, .02, .01, .005)])
        self.said()
        before = read_table(self.folder / "fit.csv")
        self.said("--largest", "0.01")
        after = read_table(self.folder / "fit.csv")
        chosen = (after["kind"] == "fit") & (after["quantity"] == "leak_rate")
        self.assertEqual(before["points"][chosen], [3])
        self.assertEqual(after["points"][chosen], [2])
        self.assertAlmostEqual(after["exponent"][chosen][0], 3., places=12)

    def test_a_window_that_no_scene_could_have(self):
        for largest in ("nan", "-0.5", "0", "1.5"):
            with self.assertRaises(SystemExit), contextlib.redirect_stderr(io.StringIO()) as said:
                fit.main([str(self.folder), f"--largest={largest}"])
            self.assertIn("is not above 0 and at most 1", said.getvalue())

    def test_exponents_that_drift(self):
        self.make_run([step(e, e**(3. if e < .015 else 3.2)) for e in (.02, .01, .005)])
        self.assertRegex(self.warnings()[0], "^corrections to scaling: the local exponent of "
                         r"leak_rate drifts from 1\.871 to 3\.000 within the fit$")

    def test_no_other_slip_is_taken_for_the_least(self):
        self.make_run([row for e in (.02, .01) for row in
                       (step(e, 1., "flow-solver"), step(e, e**3., slip_length=-.1))])
        found, words = self.summary()
        self.assertTrue(np.isnan(found["exponent"]))
        self.assertEqual(words, "no-exponent")
        self.said()
        table = read_table(self.folder / "fit.csv")
        self.assertEqual(set(table["slip_length"]), {-.1})
        self.assertEqual(table["closing_law"][0], 3.)

    # exp(s ε) has its crossover at 69/(20 s); a coarse throat must not spoil it, and one that
    # exponents cannot be told from does not. The theory's is from the same steps.
    def test_crossover_of_resolved_steps(self):
        self.make_run([*(step(e, np.exp(10. * e), "unresolved-throat") for e in (.7, .6, .5)),
                       step(.3, 1e-9, validity="coarse-throat")],
                      thresholds=((-.1, 1.), (0., 2.)))
        found, words = self.summary()
        self.assertAlmostEqual(found["crossover"], .345, places=12)
        # Of several slip lengths the least counts, wherever it stands.
        self.assertAlmostEqual(found["crossover_load"], 2 * (1 - .345), places=12)
        self.assertAlmostEqual(found["theory_crossover_load"], 2 * (1 - .1725), places=12)
        self.assertEqual(words, "ok")

    def test_the_status_speaks_of_the_leak_rate_alone(self):
        # That decays too slowly; the theory's is its square.
        self.make_run([step(e, np.exp(3. * e)) for e in (.7, .5)])
        found, words = self.summary()
        self.assertTrue(np.isnan(found["crossover_load"]))
        self.assertAlmostEqual(found["theory_crossover_load"], 2 * (1 - .575), places=12)
        self.assertEqual(words, "no-crossover")
        self.assertEqual(self.warnings(), [
            "no crossover load of the leak rate: its logarithm rises by less than 69/20 times "
            "1 - L/L_c from 0.3 to 0.7"])
        self.make_run([step(e, np.exp(e)) for e in (.7, .5)])
        self.assertTrue(np.isnan(self.summary()[0]["theory_crossover_load"]))
        self.assertEqual(self.summary()[1], "no-crossover")
        self.assertEqual(len(self.warnings()), 2)

    def test_other_physics_close_by_no_law_that_is_known(self):
        steps = [*(step(e, np.exp(10. * e)) for e in (.7, .5)), *(step(e, e**3.6) for e in (.3, .2))]
        slips = [{**row, "slip_length": -.1} for row in steps]
        adhesion = "subsection Contact\n  subsection Adhesion\n    set Enabled = true\n  end\nend\n"
        for scene, rows in (("subsection Fluid\n  set Rarefaction = slip\nend\n", steps),
                            (adhesion, steps), (adhesion, slips), ("", slips)):
            self.make_run(rows, .3, ((0., 2.), (-.1, 1.)), scene=scene)
            for quantity in ("the leak rate", "the theory's leak rate"):
                self.assertIn(f"no crossover load of {quantity}: the exponent 69/20 is that of a "
                              "viscous fluid without slip between walls that do not attract",
                              self.warnings())
            table = read_table(self.folder / "fit.csv")
            laws = table["closing_law"][table["quantity"] == "leak_rate"]
            self.assertTrue(np.isnan(laws[:-1]).all() if scene else (laws[:-1] == 3).all())
            found, words, _ = fit.summary_of(fit.samples_in(self.folder), .3,
                                             read_table(self.folder / "threshold.csv"),
                                             fit.asked_for(self.folder)[1])
            self.assertTrue(np.isnan(found["crossover_load"]))
            self.assertEqual(words, "no-crossover")

    def test_a_run_without_steps(self):
        columns = tuple(step(.1, 1.)) + ("step",)
        self.make_run([step(.1, 1.)])
        self.table("leakage.csv", [], columns)
        self.table("constrictions.csv", [], ("step", "gap", "length", "width"))
        self.assertEqual(self.said(), [])
        self.assertEqual(read_table(self.folder / "fit.csv").n_rows, 0)

    def test_no_search_for_a_threshold(self):
        self.table("leakage.csv", [{"step": 1, "leak_rate": 1, "status": "ok"}])
        screen = io.StringIO()
        with contextlib.redirect_stdout(screen):
            self.assertEqual(fit.main([str(self.folder)]), 1)
        self.assertIn("holds no results of a search for the threshold", screen.getvalue())
        self.assertFalse((self.folder / "fit.csv").exists())


class OfRealisations(Folder):
    def setUp(self):
        super().setUp()
        rates = {1: 10., 2: 20., 3: 3., 4: 10.}  # the last one failed between its steps
        for number, rate in rates.items():
            self.make_run([*(step(e, np.exp(rate * e)) for e in (.7, .3)),
                           *(step(e, e**3.) for e in (.02, .01))], where=f"realisation-{number}/")
        self.rows = [{"realisation": number, "critical_load_lower": load,
                      "critical_load_upper": load, "contact_area": .4, "crossover_load": "nan",
                      "exponent": "nan", "exponent_error": "nan", "theory_crossover_load": "nan",
                      "status": status, "validity": "ok"}
                     for number, load, status in ((1, 2., "ok"), (2, 2., "unresolved-throat"),
                                                  (3, 2., "ok"), (4, "nan", "failed"))]
        self.rows[-1]["contact_area"] = "nan"
        self.table("ensemble.csv", self.rows)

    def test_what_is_open_is_filled_in(self):
        for _ in range(2):  # the second time changes nothing
            warnings = self.warnings()
            table = read_table(self.folder / "ensemble.csv")
            self.assertEqual(tuple(table), tuple(self.rows[0]))
            np.testing.assert_allclose(table["crossover_load"],
                                       [2 * (1 - .345), 2 * (1 - .1725), np.nan, np.nan])
            np.testing.assert_allclose(table["exponent"], [3., 3., 3., np.nan])
            self.assertEqual(list(table["status"]),
                             ["ok", "unresolved-throat", "no-crossover", "failed"])
            np.testing.assert_array_equal(table["critical_load_lower"], [2., 2., 2., np.nan])
            summary = read_table(self.folder / "ensemble_summary.csv")
            self.assertEqual(list(summary["quantity"]),
                             ["contact_area", "critical_load", "crossover_load",
                              "crossover_reduced_load", "exponent", "theory_crossover_load"])
            np.testing.assert_array_equal(summary["samples"], [3, 3, 2, 2, 3, 3])
            np.testing.assert_array_equal(summary["missing"], [1, 1, 2, 2, 1, 1])
            self.assertAlmostEqual(summary["mean"][3], .25875)
            self.assertAlmostEqual(summary["standard_deviation"][3], .1725 / np.sqrt(2))
            self.assertEqual(len(warnings), 6)
            self.assertRegex(warnings[2], "^crossover_load is known of 2 of 4 realisations; ")

    def test_one_has_no_scatter(self):
        self.table("ensemble.csv", self.rows[:1])
        self.assertEqual(self.warnings(), [])
        summary = read_table(self.folder / "ensemble_summary.csv")
        self.assertTrue(np.isnan(summary["standard_deviation"]).all())
        np.testing.assert_array_equal(summary["samples"], 1)


if __name__ == "__main__":
    unittest.main()
