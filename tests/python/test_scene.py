#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Scenes, runs and sweeps from Python."""
import doctest
import functools
import importlib
import os
import pathlib
import pickle
import subprocess
import sys
import tempfile
import unittest
import unittest.mock
import warnings

import numpy as np
import strait

PROJECT = pathlib.Path(__file__).resolve().parents[2]
SMALL = {"Contact/Grid points": 64, "Surface/Short cut-off wavelength": 0.125,
         "Fluid/Target accuracy": 0.1}


def load_tests(_loader, tests, _pattern):
    """The examples of the docstrings are tests as well."""
    for name in ("", ".results", ".scene", ".seal", ".sweep"):
        tests.addTests(doctest.DocTestSuite(importlib.import_module("strait" + name),
                                            extraglobs={"np": np},
                                            optionflags=doctest.ELLIPSIS))
    return tests


class Scenes(unittest.TestCase):
    def test_values_survive_the_way_there_and_back(self):
        for name, value in {"Contact/Grid points": (64, 128), "Surface/Invert": True,
                            "Surface/RMS value": 0.1 + 0.2, "Surface/Kind": "flat",
                            "Fluid/Slip length": (-0.1, 0)}.items():
            scene = strait.Scene({name: value})
            self.assertEqual(scene[name], value)
            self.assertEqual(strait.Scene({name: scene[name]}).text, scene.text)

    def test_numbers_may_be_of_numpy(self):
        scene = strait.Scene({"Load programme/Pressures": np.linspace(0.1, 0.3, 3),
                              "Surface/Seed": np.int64(3),
                              "Contact/Effective modulus": np.array(2.)})
        self.assertEqual(scene["Load programme/Pressures"], (0.1, 0.2, 0.3))
        self.assertEqual(scene["surface/seed"], 3)
        self.assertEqual(scene["contact/effective modulus"], 2)

    def test_errors_are_the_programs(self):
        for parameters, sentence in [({"Contact/Grid pints": 8}, "did you mean 'Grid points'"),
                                     (dict(contact=dict(grid_pints=8)), "mean 'Grid points'"),
                                     ({"Contact/Grid points": -8}, "expected one or two integers"),
                                     ({"nonsense": 8}, "expected .Section/Parameter=value.")]:
            with self.assertRaisesRegex(strait.SceneError, sentence):
                strait.Scene(parameters)
        self.assertTrue(issubclass(strait.SceneError, ValueError))
        for wrong in ("a.prm", 3):
            with self.assertRaisesRegex(TypeError, "Scene.from_prm"):
                strait.Scene(wrong)

    def test_texts_may_be_bytes_or_go_on_in_another_line(self):
        scene = strait.Scene({"Output/Directory": b"there", "Surface/Kind": "expression",
                              "Surface/Expression": """cos(2*pi*x)
                              + cos(2*pi*y)"""})
        self.assertEqual(scene["Output/Directory"], "there")
        self.assertEqual(scene["Surface/Expression"].split(), ["cos(2*pi*x)", "+", "cos(2*pi*y)"])
        self.assertEqual(scene.replace(contact=dict(grid_points=64)).heights().shape, (64, 64))

    def test_a_file_that_is_missing(self):
        with self.assertRaisesRegex(strait.SceneError, "Cannot read the scene file '.*/no.prm'"):
            strait.Scene.from_prm("no.prm")

    def test_a_file_and_what_is_changed_of_it(self):
        file = PROJECT / "prm" / "quickstart.prm"
        scene = strait.Scene.from_prm(file, surface=dict(seed=5))
        self.assertEqual(scene["Surface/Seed"], 5)
        self.assertEqual(scene["Contact/Grid points"],
                         strait.Scene.from_prm(file)["Contact/Grid points"])
        self.assertEqual(pickle.loads(pickle.dumps(scene)).text, scene.text)

    def test_relative_paths_count_from_where_they_were_given(self):
        self.addCleanup(os.chdir, pathlib.Path.cwd())
        folders = [pathlib.Path(self.enterContext(tempfile.TemporaryDirectory())).resolve()
                   for _ in range(2)]
        for k, folder in enumerate(folders, 1):
            np.save(folder / "map.npy", k * np.cos(np.pi * np.arange(64) / 8) * np.ones((64, 1)))
            (folder / "scene.prm").write_text("subsection Surface\n  set Kind = file\n"
                                              f"  set File = map.npy\n  set Seed = {k}\nend\n")
        os.chdir(folders[0])
        given = strait.Scene({**SMALL, "Surface/Kind": "file", "surface/file": "map.npy",
                              "Surface/Size": 1})
        of_file = strait.Scene.from_prm("scene.prm", {**SMALL, "Surface/Size": 1})
        heights = given.heights()
        os.chdir(folders[1])
        for scene in (given, of_file):
            for other in (scene, scene.replace(fluid=dict(enabled=False)),
                          pickle.loads(pickle.dumps(scene))):
                self.assertEqual(other["Surface/File"], str(folders[0] / "map.npy"))
                np.testing.assert_array_equal(other.heights(), heights)
        run = given.replace(fluid=dict(enabled=False)).run()
        self.assertAlmostEqual(run.table["mean_gap"][0],
                               strait.Seal(given).solve(0.05).mean_gap, 12)
        here = given.replace({"Surface/File": pathlib.Path("map.npy")})
        np.testing.assert_allclose(here.heights(), 2 * heights)

    def test_paths_are_those_of_the_program(self):
        rows, section = {}, ""
        for line in (PROJECT / "doc" / "parameters.md").read_text(encoding="utf-8").splitlines():
            if line.startswith("## "):
                section = line[3:].replace(" / ", "/")
            cells = [cell.strip() for cell in line.split("|")]
            if len(cells) > 4 and cells[3].endswith("a path"):
                rows[f"{section}/{cells[1]}"] = cells[3].removesuffix("a path").rstrip(" or,")
        self.assertEqual(strait.scene.PATHS, rows)
        for name, word in rows.items():
            self.assertEqual(strait.Scene({name: word}).overrides, [f"{name}={word}"])

    def test_units(self):
        scene = strait.Scene.from_prm(PROJECT / "prm" / "oring_water.prm")
        self.assertEqual(scene.units["leak_rate"], "m³/s")
        self.assertEqual(scene.units["pressure"], "Pa")
        self.assertEqual(strait.Scene().units["leak_rate"], "")

    def test_heights(self):
        scene = strait.Scene({**SMALL, "Contact/Grid points": (64, 32), "Surface/Size": (2, 1)})
        heights = scene.heights()
        self.assertEqual(heights.shape, scene.shape)
        self.assertEqual(heights.shape, (32, 64))
        self.assertAlmostEqual(strait.statistics(heights, scene.size)["rms_slope"], 1., 1)


class Runs(unittest.TestCase):
    def test_temporary_folder_lasts_as_long_as_the_run(self):
        run = strait.Scene(SMALL).run()
        folder = run.folder
        self.assertTrue((folder / "run.json").exists())
        self.assertEqual(run.table["status"].tolist(), ["ok", "ok"])
        del run
        self.assertFalse(folder.exists())

    def test_a_folder_that_is_asked_for_lasts_whatever_its_name(self):
        before = pathlib.Path.cwd()
        with tempfile.TemporaryDirectory() as folder:
            os.chdir(folder)
            try:
                scene = strait.Scene({**SMALL, "Output/Directory": "output",
                                      "Output/Pictures": False})
                run = scene.run()
                self.assertEqual(run.folder, pathlib.Path("output").absolute())
                self.assertTrue((pathlib.Path(folder) / "output" / "run.json").exists())
                os.chdir(before)  # the results stay those of the first folder
                self.assertEqual(run.csv("leakage.csv").n_rows, 2)
                os.chdir(folder)
                # A sweep keeps only its table, whatever the directory of its scene is.
                strait.sweep(scene.replace({"Output/Directory": "other"}), [{}])
                self.assertFalse(pathlib.Path("other").exists())
            finally:
                os.chdir(before)

    def test_groups_of_fields(self):
        import h5py
        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / "leakage.csv").write_text("step\n1\n")
            with h5py.File(pathlib.Path(folder) / "fields-1.h5", "w") as file:
                file["gap"] = np.ones((2, 3))
                file.attrs["lx"] = 3.
                file["window-1/gap"] = np.ones((4, 5))
                file["window-1"].attrs["lx"] = 0.5
            fields = strait.Run(folder).fields(1)
        self.assertEqual(fields["gap"].shape, (2, 3))
        self.assertEqual(fields["attributes"], {"lx": 3.})
        self.assertEqual(fields["window-1"]["gap"].shape, (4, 5))
        self.assertEqual(fields["window-1"]["attributes"], {"lx": 0.5})

    def test_folder_of_another_scene_is_left_alone(self):
        with tempfile.TemporaryDirectory() as folder:
            scene = strait.Scene({**SMALL, "Output/Pictures": False})
            scene.run(folder)
            other = scene.replace({"Surface/Seed": 2})
            with self.assertRaises(strait.SceneError):
                other.run(folder)
            self.assertEqual(other.run(folder, force=True).table.n_rows, 2)

    def test_realisations(self):
        run = strait.Scene({**SMALL, "Realisations/Seeds": [3, 4], "Load programme/Pressures": 0.1,
                            "Load programme/Find threshold": True}).run()
        self.assertEqual(run.table["seed"].tolist(), [3, 4])
        self.assertEqual(strait.Run(run.folder / "realisation-2").table.n_rows, 1)

    def test_realisations_in_units(self):
        scene = strait.Scene({**SMALL, "Realisations/Seeds": [3, 4], "Load programme/Pressures": 0.1,
                              "Load programme/Find threshold": True, "Units/Length": "mm",
                              "Units/Pressure": "MPa", "Units/Time": "s", "Surface/Size": 1,
                              "Fluid/Inlet pressure": 0.01})
        self.assertEqual(scene.run().unit("critical_load_lower"), "MPa")
        table = strait.sweep(scene, [{}], table="ensemble.csv")
        self.assertEqual(table.units["critical_load_lower"], "MPa")

    def test_units_that_differ_between_runs(self):
        scene = strait.Scene({**SMALL, "Load programme/Pressures": 0.1, "Fluid/Enabled": False,
                              "Units/Pressure": "MPa", "Units/Time": "s", "Surface/Size": 1,
                              "Output/Pictures": False})
        table = strait.sweep(scene, {"Units/Length": ["mm", "um", "mm"]})
        self.assertEqual((table.units["pressure"], table.units["mean_gap"]), ("MPa", ""))

    def test_fields_of_the_last_load_that_no_state_has(self):
        """Fluid that carries the load parts the walls; the run says that there are no fields."""
        scene = strait.Scene({**SMALL, "Fluid/Wall feedback/Enabled": True, "Output/Fields": "last",
                              "Fluid/Inlet pressure": 0.1, "Fluid/Outlet pressure": 0.1,
                              "Load programme/Pressures": (0.2, 0.05)})
        with self.assertRaises(strait.NotConverged) as caught:
            scene.run()
        run = caught.exception.run
        self.assertEqual(list(run.folder.glob("fields-*")), [])
        self.assertIn("Output/Fields = last wrote none", (run.folder / "log.txt").read_text())

    def test_not_converged_comes_with_its_results(self):
        with self.assertRaises(strait.NotConverged) as context:
            strait.Scene({**SMALL, "Contact/Maximum iterations": 2}).run()
        self.assertNotIn("ok", context.exception.run.table["status"])

    def test_pandas(self):
        try:
            import pandas  # noqa: F401
        except ImportError:
            self.skipTest("pandas is not installed")
        frame = strait.Scene({**SMALL, "Units/Length": "m", "Units/Pressure": "Pa",
                              "Units/Time": "s", "Surface/Size": 1,
                              "Fluid/Inlet pressure": 0.01}).run().table.to_pandas()
        self.assertEqual(frame.shape[0], 2)
        self.assertEqual(frame.attrs["units"]["leak_rate"], "m³/s")


class Windows(unittest.TestCase):
    """Realisations that are windows of one large map."""

    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        text = subprocess.run([sys.executable, PROJECT / "tools" / "make_example_map.py"],
                              stdout=subprocess.PIPE, text=True, check=True).stdout
        self.map = 1e-9 * np.loadtxt(text.splitlines())
        (self.folder / "map.txt").write_text(text, encoding="utf-8")
        self.scene = strait.Scene.from_prm(
            PROJECT / "prm" / "measured_surface.prm",
            surface=dict(file=self.folder / "map.txt"), fluid=dict(target_accuracy=0.2),
            load_programme=dict(pressures=5e4), output=dict(pictures=False))

    def test_a_window_is_a_part_of_the_map(self):
        scene = self.scene.replace(surface=dict(windows=(2, 3), seed=4))
        self.assertEqual(scene.shape, (42, 64))
        np.testing.assert_allclose(scene.size, (64e-6, 42e-6))
        np.testing.assert_allclose(scene.heights(), self.map[42:84, 64:], atol=1e-20)

    def test_a_seal_of_windows_is_one_of_their_own_files(self):
        run = self.scene.replace(
            surface=dict(windows=(2, 1), detrend="tilt"), realisations=dict(seeds=(1, 2)),
            seal=dict(enabled=True, circumference=1e-2, contact_width=64e-6)
            ).run(self.folder / "seal")
        leak_rates = []
        for k in (1, 2):
            np.save(self.folder / f"{k}.npy", self.map[:, 64 * (k - 1):64 * k])
            alone = self.scene.replace(surface=dict(file=self.folder / f"{k}.npy", detrend="tilt",
                                                    size=(64e-6, 128e-6))
                                       ).run(self.folder / str(k))
            leak_rates.append(alone.table["leak_rate"][0])
            patch = strait.read_table(run.folder / f"realisation-{k}" / "leakage.csv")
            np.testing.assert_allclose(patch["leak_rate"], leak_rates[-1], rtol=1e-6)
        self.assertNotAlmostEqual(leak_rates[0] / leak_rates[1], 1, 2)
        # Patches that follow each other around the ring leak their mean times their number.
        median = run.csv("seal.csv")["leak_rate_median"][0]
        self.assertTrue(min(leak_rates) < median / (1e-2 / 128e-6) < max(leak_rates))


class Sweeps(unittest.TestCase):
    def test_processes_change_nothing(self):
        scene = strait.Scene(SMALL)
        what = {"Surface/Seed": range(1, 4), "Surface/Invert": [False, True]}
        alone, together = (strait.sweep(scene, what, processes=n) for n in (1, 2))
        self.assertEqual(alone.n_rows, 12)
        self.assertEqual(list(alone), list(together))
        for column in ("Surface/Seed", "pressure", "leak_rate", "status"):
            np.testing.assert_array_equal(alone[column], together[column])
        self.assertEqual(len(alone.groups("Surface/Seed")), 3)

    def test_a_parameter_that_a_mapping_leaves_out_is_the_scenes(self):
        scene = strait.Scene({**SMALL, "Surface/Seed": 7, "Load programme/Pressures": 0.1})
        table = strait.sweep(scene, [{"Surface/Invert": True}, {"surface": {"seed": 3}}])
        self.assertEqual(table["Surface/Invert"].tolist(), [True, False])
        self.assertEqual(table["surface/seed"].tolist(), [7, 3])
        self.assertEqual([rows.n_rows for _, rows in table.groups("surface/seed")], [1, 1])

    def test_what_is_not_known_is_one_group(self):
        table = strait.Table({"a": np.array([np.nan, 2., np.nan, 2.]), "row": np.arange(4)})
        groups = table.groups("a")
        self.assertEqual([rows["row"].tolist() for _, rows in groups], [[0, 2], [1, 3]])
        self.assertTrue(np.isnan(groups[0][0]))

    def test_other_table_and_output(self):
        with tempfile.TemporaryDirectory() as folder:
            table = strait.sweep(strait.Scene({**SMALL, "Load programme/Find threshold": True,
                                               "Output/Pictures": False}),
                                 [{"Surface/Seed": 1}, {"Surface/Seed": 2}],
                                 table="threshold.csv", output=folder)
            self.assertTrue((pathlib.Path(folder) / "2" / "leakage.csv").exists())
        self.assertTrue(np.all(table["critical_load_lower"] < table["critical_load_upper"]))

    def test_runs_without_the_table_add_no_rows(self):
        scene = strait.Scene({**SMALL, "Output/Pictures": False})
        searches = {"Load programme/Find threshold": [False, True]}
        table = strait.sweep(scene, searches, table="threshold.csv")
        self.assertEqual(table["Load programme/Find threshold"].tolist(), [True])
        with self.assertRaisesRegex(FileNotFoundError, "None of the runs has jumps.csv."):
            strait.sweep(scene, [{}], table="jumps.csv")
        failed = strait.Table({"status": np.array(["failed"])})
        for others in ([], [failed]):
            with unittest.mock.patch.object(sys.modules["strait.sweep"], "_run",
                                            side_effect=[strait.Table({}), *others]), \
                    self.assertRaisesRegex(FileNotFoundError, "None of the runs has leak.csv."):
                strait.sweep(scene, [{}] * (1 + len(others)), table="leak.csv")

    def test_results_of_another_scene_are_left_alone(self):
        scene = strait.Scene({**SMALL, "Load programme/Pressures": 0.1, "Output/Pictures": False})
        for processes in (1, 2):
            with tempfile.TemporaryDirectory() as folder:
                scene.run(f"{folder}/1")
                before = strait.Run(f"{folder}/1").table["leak_rate"][0]
                sweep = functools.partial(strait.sweep, scene, {"Surface/Seed": [5]},
                                          output=folder, processes=processes)
                with self.assertRaisesRegex(strait.SceneError, "results of another scene"):
                    sweep()
                self.assertEqual(strait.Run(f"{folder}/1").table["leak_rate"][0], before)
                self.assertNotEqual(sweep(force=True)["leak_rate"][0], before)

    def test_processes_that_fail_leave_no_folder(self):
        with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder, \
                unittest.mock.patch.dict(os.environ, TMPDIR=folder), \
                unittest.mock.patch("tempfile.tempdir", None):
            with self.assertRaises(FileNotFoundError):
                strait.sweep(strait.Scene(SMALL), {"Surface/Seed": [1, 2, 3]},
                             table="threshold.csv", processes=2)
            self.assertEqual(list(pathlib.Path(folder).glob("strait-*")), [])

    def test_failures(self):
        scene = strait.Scene(SMALL)
        table = strait.sweep(scene, {"Contact/Maximum iterations": [2, 1000]}, processes=2)
        self.assertEqual([str(status) == "ok" for status in table["status"]],
                         [False, False, True, True])
        with self.assertRaises(strait.SceneError):
            strait.sweep(scene, {"Contact/Grid points": [64, -1]}, processes=2)


if __name__ == "__main__":
    warnings.simplefilter("error")
    unittest.main()
