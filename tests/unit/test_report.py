#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Tests of tools/strait-report: the page says what the results say, and odd ones break nothing."""
import html
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import numpy as np

TOOLS = pathlib.Path(__file__).resolve().parents[2] / "tools"
sys.path.insert(0, str(TOOLS))
from report_page import Column, percent, readable  # noqa: E402
from report_results import relative_errors  # noqa: E402

SCENE = """subsection Surface
  set Kind = self-affine
end
subsection Theory
  set Enabled = false
  set Gamma   = 0.45
end
"""
TABLE = ("step,branch,pressure,contact_area,percolates,leak_rate,leak_rate_lower,leak_rate_upper,"
         "leak_rate_ml_per_h,status,validity\n"
         "1,loading,2e5,0.1,1,4e-12,3.96e-12,4.04e-12,0.0144,ok,ok\n"
         "2,loading,3e5,0.2,1,1e-13,nan,1.1e-13,0.00036,unresolved-throat,steep+plastic\n"
         "3,loading,4e5,0.4,0,0,0,0,0,ok,ok\n")
RECORD = {"version": "9.9", "ranks": 1, "grid": {"nx": 64, "ny": 32}, "seconds": {"total": 2.0,
          "contact": 1.5}, "column_units": {"pressure": "Pa", "leak_rate": "m³/s",
                                            "leak_rate_ml_per_h": "ml/h"},
          "validity": [{"step": 2, "validity": "steep", "checks": [
              {"word": "steep", "number": 0.5, "most": 0.3, "holds": False, "advice": "too steep"},
              {"word": "coarse-throat", "number": None, "least": 3, "holds": False,
               "advice": "no points"}]}],
          "error_budget": [{"step": 1, "relative_errors": {"mesh": 0.01}, "largest": "mesh",
                            "reduced_by": "Fluid/Target accuracy"}],
          "warnings": ["steep: told above", "<script>alert(1)</script>"]}


class Report(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)
        for name, text in (("parameters.prm", SCENE), ("leakage.csv", TABLE),
                           ("run.json", json.dumps(RECORD)), ("log.txt", "</pre><b>log\n")):
            (self.folder / name).write_text(text, encoding="utf-8")

    def run_script(self, *arguments):
        return subprocess.run([sys.executable, str(TOOLS / "strait-report"), *arguments],
                              text=True, capture_output=True, check=False)

    def page(self):
        result = self.run_script(str(self.folder))
        self.assertEqual((result.returncode, result.stdout, result.stderr), (0, "", ""))
        return (self.folder / "report.html").read_text(encoding="utf-8")

    def text(self):
        return " ".join(html.unescape(re.sub("<[^>]+>", " ", self.page())).split())

    def test_numbers_units_and_errors(self):
        text = self.text()
        for words in ("4e-12 ± 1 %", "0.0144 ± 1 %", "kPa", "grid 64 × 32", "too steep",
                      "at most 0.3", "Fluid/Target accuracy", "contact 1.5 s",
                      "Leak rate at a pressure of 200 kPa: 0.0144 ml/h ± 1 %",
                      "Leak rate at a pressure of 400 kPa: none"):
            self.assertIn(words, text)
        self.assertNotIn("Gamma", text.split("parameters.prm")[0])  # of an effect that is off

    def test_of_several_units_the_first_answers(self):
        more = [line + end for line, end in zip(
            TABLE.splitlines(), (",leak_rate_l_per_s", ",4e-9", ",1e-10", ",0"), strict=True)]
        (self.folder / "leakage.csv").write_text("\n".join(more) + "\n", encoding="utf-8")
        text = self.text()
        self.assertIn("Leak rate at a pressure of 200 kPa: 0.0144 ml/h ± 1 %", text)
        self.assertIn("4e-09 ± 1 %", text)

    def test_a_rate_that_is_not_known_has_its_status(self):
        (self.folder / "leakage.csv").write_text(
            TABLE.replace("4e-12,3.96e-12,4.04e-12,0.0144,ok", "inf,nan,inf,inf,lifted-off"),
            encoding="utf-8")
        self.assertIn("Leak rate at a pressure of 200 kPa: not known (lifted-off)", self.text())

    def test_a_rate_of_a_contact_that_failed_is_no_answer(self):
        failed = TABLE.replace("0.0144,ok", "0.0144,contact")
        (self.folder / "leakage.csv").write_text(failed, encoding="utf-8")
        text = self.text()
        self.assertIn("Leak rate at a pressure of 200 kPa: not known (contact)", text)
        self.assertNotIn("4e-12 ±", text)

    def test_a_doubtful_rate_says_so(self):
        doubtful = TABLE.replace("4e-12,3.96e-12,4.04e-12,0.0144,ok",
                                 "4e-12,1e-13,4e-12,0.0144,flow-accuracy+unresolved-throat")
        (self.folder / "leakage.csv").write_text(doubtful, encoding="utf-8")
        self.assertIn("0.0144 ml/h ± 98 % (flow-accuracy+unresolved-throat)", self.text())

    def test_where_it_closes_and_where_it_opens(self):
        (self.folder / "threshold.csv").write_text(
            "slip_length,critical_load_lower,critical_load_upper\n0,2e5,2.1e5\n",
            encoding="utf-8")
        self.assertIn("Seals at a pressure between 200 kPa and 210 kPa", self.text())
        (self.folder / "parameters.prm").write_text(
            SCENE + "subsection Load programme\n  set Path = unloading\nend\n", encoding="utf-8")
        self.assertIn("Opens, unloaded, at a pressure between 200 kPa and 210 kPa", self.text())

    def test_an_unknown_bound_gives_no_error(self):
        cell = re.search(r'data-value="1e-13">([^<]*)<', self.page()).group(1)
        self.assertEqual(cell, "1e-13")

    def test_texts_are_no_markup(self):
        page = self.page()
        self.assertNotIn("<script>alert", page)
        self.assertNotIn("<b>log", page)
        self.assertEqual(page.count("<script>"), 1)
        self.assertIn("default-src 'none'", page)

    def test_the_theory_alone(self):
        (self.folder / "leakage.csv").write_text(
            "step,pressure,theory_leak_rate,status\n1,2e5,6.5e-6,ok\n", encoding="utf-8")
        shown = self.text().split("All columns")[0]
        self.assertIn("theory leak rate", shown)
        self.assertIn("6.5e-06", shown)

    def test_a_run_that_goes_on(self):
        (self.folder / "run.json").unlink()
        self.assertIn("run not complete", self.text())

    def test_realisations(self):
        one = self.folder / "realisation-1"
        one.mkdir()
        for name in ("leakage.csv", "run.json", "parameters.prm"):
            (self.folder / name).rename(one / name) if name != "parameters.prm" else \
                (one / name).write_text(SCENE)
        (self.folder / "ensemble.csv").write_text("realisation,seed,status\n1,7,ok\n")
        (self.folder / "log.txt").write_text(
            "whole seal: old\n  under 1\nwhole seal: new\n  under 2\n  warning: small\nmore\n")
        text = self.text()
        self.assertIn("1 realisations", text)
        self.assertIn("under 2", text)
        self.assertIn("small", text)
        self.assertNotIn("under 1", text.split("log.txt")[0])
        self.assertIn("leak rate at 300 kPa", text)

    def test_realisations_of_an_earlier_run_are_left_out(self):
        for k in (1, 2):
            one = self.folder / f"realisation-{k}"
            one.mkdir()
            for name in ("leakage.csv", "parameters.prm"):
                (one / name).write_text((self.folder / name).read_text())
        (self.folder / "ensemble.csv").write_text("realisation,seed,status\n1,7,ok\n")
        text = self.text()
        self.assertIn("1 realisations", text)
        self.assertNotIn("realisation-2", text)

    def write_slips_and_branches(self, folder):
        """Two loads and back, each with two slip lengths."""
        rows = [(0.05, "loading"), (0.1, "loading"), (0.05, "unloading")]
        (folder / "leakage.csv").write_text(
            "step,branch,pressure,slip_length,leak_rate,leak_rate_lower,leak_rate_upper,status\n" +
            "".join(f"{k},{branch},{load},{slip},{(k + 1)}e-6,{(k + 1)}e-6,{(k + 1)}e-6,ok\n"
                    for k, (load, branch, slip) in enumerate(
                        (load, branch, slip) for load, branch in rows for slip in (-0.005, 0))))
        (folder / "run.json").unlink(missing_ok=True)

    def test_slip_length_and_branch_are_named(self):
        self.write_slips_and_branches(self.folder)
        (self.folder / "threshold.csv").write_text(
            "critical_load_lower,critical_load_upper,slip_length\n"
            "0.15,0.16,-0.005\n0.19,0.2,0\n")
        text = self.text()
        for words in ("at a pressure of 0.05, slip length -0.005, loading: 1e-06 ±",
                      "at a pressure of 0.05, slip length 0, unloading: 6e-06 ±",
                      "Seals at a pressure between 0.15 and 0.16, slip length -0.005",
                      "Seals at a pressure between 0.19 and 0.2, slip length 0",
                      "step pressure slip length branch leak rate"):
            self.assertIn(words, text)

    def test_where_there_is_one_of_each_they_are_not(self):
        (self.folder / "threshold.csv").write_text(
            "critical_load_lower,critical_load_upper,critical_load_error,slip_length\n"
            "3e5,3.1e5,0.004,0\n")
        text = self.text()
        self.assertIn("Seals at a pressure between 300 kPa and 310 kPa, "
                      "finer points within 0.4 % of that", text)
        self.assertNotIn("slip length 0", text)
        self.assertNotIn("loading:", text)
        self.assertIn("step pressure kPa leak rate", text)

    def test_realisations_with_several_slip_lengths(self):
        for k in (1, 2):
            one = self.folder / f"realisation-{k}"
            one.mkdir()
            (one / "parameters.prm").write_text(SCENE)
            self.write_slips_and_branches(one)
        (self.folder / "ensemble.csv").write_text("realisation,seed,status\n1,7,ok\n2,8,ok\n")
        table = self.text().split("The realisations")[1].split("All of each realisation")[0]
        for words in ("leak rate at 0.05, slip length -0.005, loading",
                      "leak rate at 0.05, slip length 0, unloading",
                      "1 1e-06 ± 0 % 2e-06 ± 0 % 5e-06 ± 0 % 6e-06 ± 0 % 3e-06 ± 0 % 4e-06"):
            self.assertIn(words, table)

    def test_realisations_at_reduced_loads(self):
        """Each at a load of its own, as far below its critical load as the others."""
        for k in (1, 2):
            one = self.folder / f"realisation-{k}"
            one.mkdir()
            (one / "parameters.prm").write_text(SCENE)
            (one / "leakage.csv").write_text(
                "step,pressure,reduced_load,leak_rate,leak_rate_lower,leak_rate_upper,status\n"
                f"1,0.05,{1 - 0.05 / k},9e-6,9e-6,9e-6,ok\n"
                f"2,{0.7 * k},0.3,{k}e-6,{k}e-6,{k}e-6,ok\n"
                f"3,{0.9 * k},{0.1 + 1e-17},{k}e-7,{k}e-7,{k}e-7,ok\n")
        (self.folder / "run.json").unlink()
        (self.folder / "ensemble.csv").write_text("realisation,seed,status\n1,7,ok\n2,8,ok\n")
        (self.folder / "ensemble_summary.csv").write_text(
            "quantity,mean,standard_deviation,samples,missing\ncritical_load,1.5,0.7,2,0\n")
        text = self.text()
        table = text.split("The realisations")[1].split("All of each realisation")[0]
        for words in ("leak rate at 0.05 leak rate at 1 − L/Lc = 0.3 leak rate at 1 − L/Lc = 0.1",
                      "1 9e-06 ± 0 % 1e-06 ± 0 % 1e-07 ± 0 % 2 9e-06 ± 0 % 2e-06 ± 0 % 2e-07"):
            self.assertIn(words, table)
        self.assertIn("critical_load 1.5 0.7 2 0", text)

    def test_a_limit_that_is_passed_without_a_number(self):
        checks = [{"word": "fluid-pressure", "number": number, "most": 0.1, "holds": holds,
                   "advice": "too high"} for number, holds in
                  ((0.05, True), (None, False), (0.01, True))]
        (self.folder / "run.json").write_text(json.dumps({**RECORD, "validity": [
            {"step": k, "checks": [check]} for k, check in enumerate(checks, 1)]}))
        self.assertIn("fluid-pressure – 2 at most 0.1 passed: too high", self.text())

    def test_what_is_no_result(self):
        for arguments in ([], ["--help"], [str(self.folder / "none")]):
            result = self.run_script(*arguments)
            self.assertEqual(result.returncode, 1)
            self.assertNotIn("Traceback", result.stderr)


class Errors(unittest.TestCase):
    def test_as_far_as_the_further_bound(self):
        """A bracket, a wide one with the rate at its end, a gas's, one whose error is known."""
        rate = np.array([1., -1., 1., 1.])
        known = np.array([np.nan, np.nan, np.nan, 0.5])
        errors = relative_errors({"leak_rate": rate, "leak_rate_error": known,
                                  "leak_rate_lower": np.array([0.9, 0.1, 0.98, 0.9]),
                                  "leak_rate_upper": np.array([1.1, 1., 1.36, 1.1])})
        np.testing.assert_allclose(errors, [0.1, 0.9, 0.36, 0.5])


    def test_of_a_failed_step_no_bounds_hold(self):
        errors = relative_errors({"leak_rate": np.ones(2), "leak_rate_lower": np.full(2, 0.9),
                                  "leak_rate_upper": np.full(2, 1.1),
                                  "status": np.array(["contact", "unresolved-throat"])})
        np.testing.assert_allclose(errors, [np.nan, 0.1])

    def test_in_percent_without_an_exponent(self):
        self.assertEqual([percent(error) for error in (0.0123, 0.996, 2.54, 12.)],
                         ["1.2 %", "100 %", "254 %", "12 times"])


class Columns(unittest.TestCase):
    def test_readable_units(self):
        for unit, values, known in (("Pa", [1e5, 5e5], "kPa"), ("Pa", [3e6], "MPa"),
                                    ("m", [2e-7, 0.], "nm"), ("m", [1e-6, 2e-6], "µm"),
                                    ("m", [1e-12], "nm"), ("m³/s", [1e-12], "m³/s"),
                                    ("Pa", [np.nan], "Pa")):
            self.assertEqual(readable(unit, np.array(values))[1], known)

    def test_sorts_by_the_number_and_not_by_what_is_shown(self):
        column = Column("gap", "m", [2e-6, 1e-7])
        self.assertIn('data-value="2e-06">2<', column.cell(0))
        self.assertIn('data-value="1e-07">0.1<', column.cell(1))


if __name__ == "__main__":
    unittest.main()
