#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Seals, states, paths, transitions and flows from Python."""
import ctypes
import gc
import threading
import unittest
import warnings

import numpy as np
import strait

SMALL = {"Contact/Grid points": 64, "Surface/Short cut-off wavelength": 0.125,
         "Fluid/Target accuracy": 0.1}


class MallInfo(ctypes.Structure):
    """glibc's struct mallinfo2."""
    _fields_ = [(name, ctypes.c_size_t) for name in (
        "arena", "ordblks", "smblks", "hblks", "hblkhd", "usmblks", "fsmblks", "uordblks",
        "fordblks", "keepcost")]


def allocated_bytes():
    """Bytes on the heap; resident memory would come and go by whole large pages."""
    mallinfo = ctypes.CDLL(None).mallinfo2
    mallinfo.restype = MallInfo
    return mallinfo().uordblks + mallinfo().hblkhd


class Seals(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scene = strait.Scene(SMALL)
        cls.seal = strait.Seal(cls.scene)

    def test_hertz(self):
        radius, load = 2., 1e-3  # the box is so large that periodic images hardly matter
        seal = strait.Seal(strait.Scene(surface=dict(kind="sphere", amplitude=radius),
                                        contact=dict(grid_points=256), fluid=dict(enabled=False)))
        state = seal.solve(load)
        a = (3 * load * radius / 4) ** (1 / 3)
        self.assertAlmostEqual(state.pressure.max() / (2 * a / (np.pi * radius)), 1., delta=0.01)
        self.assertAlmostEqual(state.contact_area / (np.pi * a**2), 1., delta=0.05)

    def test_same_as_the_program(self):
        table = self.scene.run().table
        for load, area, rate in zip(table["pressure"], table["contact_area"], table["leak_rate"]):
            state = self.seal.solve(load)
            self.assertAlmostEqual(state.contact_area, area, 12)
            self.assertAlmostEqual(self.seal.flow(state).leak_rate / rate, 1., 3)

    def test_arrays_are_views_that_keep_their_state(self):
        state = self.seal.solve(0.1)
        gap = state.gap
        self.assertIs(gap.base, state)
        self.assertEqual(gap.__array_interface__["data"], state.gap.__array_interface__["data"])
        with self.assertRaises(ValueError):
            gap[0, 0] = 1.
        mean = state.mean_gap
        del state
        gc.collect()
        self.assertAlmostEqual(gap.mean(), mean, 12)
        self.assertAlmostEqual(self.seal.solve(0.1).pressure.mean(), 0.1, 9)

    def test_states_of_another_seal_are_refused(self):
        state = self.seal.solve(0.1)
        finer = strait.Seal(strait.Scene({**SMALL, "Contact/Grid points": 128}))
        given = strait.Seal(strait.Scene({**SMALL, "Contact/Enabled": False}))
        for other in (finer.solve(0.1), given.solve()):
            for use in (self.seal.flow, lambda s: self.seal.solve(0.1, from_=s),
                        lambda s: self.seal.follow([0.2], from_=s)):
                with self.assertRaisesRegex(ValueError, "another seal"):
                    use(other)
        self.assertGreater(self.seal.flow(state).leak_rate, 0.)

    def test_fields_of_a_sealed_gap_are_not_a_number(self):
        flow = self.seal.flow(self.seal.solve(2.), fields=True)
        self.assertFalse(flow.percolates)
        self.assertTrue(np.isnan(flow.pressure).all() and np.isnan(flow.current).all())

    def test_what_there_is_not_is_none(self):
        state = self.seal.solve(0.1)
        for name in ("fluid_pressure", "indentation", "adhesive_energy", "fluid_load"):
            self.assertIsNone(getattr(state, name))
        self.assertIsNone(self.seal.flow(state).pressure)

    def test_heights_of_ones_own(self):
        state = strait.Seal(self.scene, self.scene.heights()).solve(0.1)
        self.assertEqual(state.contact_area, self.seal.solve(0.1).contact_area)
        with self.assertRaisesRegex(strait.SceneError, r"\(64, 64\).*\(32, 64\)"):
            strait.Seal(self.scene, np.zeros((32, 64)))
        with self.assertRaisesRegex(strait.SceneError, "finite"):
            strait.Seal(self.scene, np.full((64, 64), np.nan))
        masked = np.ma.masked_equal(np.eye(64), 1.)
        for call in (lambda: strait.Seal(self.scene, masked), lambda: strait.statistics(masked)):
            with self.assertRaisesRegex(strait.SceneError, "masked points"):
                call()
        wavy = 1j * np.eye(64)
        for call in (lambda: strait.Seal(self.scene, wavy), lambda: strait.statistics(wavy)):
            with self.assertRaisesRegex(strait.SceneError, "complex numbers"):
                call()
        for size in (0., (1., -1.), np.inf, np.nan):
            with self.assertRaisesRegex(strait.SceneError, "lengths above zero"):
                strait.statistics(np.eye(64), size)
        inverted = self.scene.replace({"Surface/Invert": True})
        for scene in (inverted, self.scene.replace({"Surface/Detrend": "tilt"})):
            with self.assertWarnsRegex(strait.SceneWarning, "do not act on heights that are given"):
                strait.Seal(scene, self.scene.heights())

    def test_a_range_is_that_of_the_heights(self):
        # Given heights need not be the sphere of the scene, whose radius must not matter.
        adhesive = {"Contact/Grid points": 64, "Fluid/Enabled": False, "Surface/Amplitude": 20,
                    "Contact/Adhesion/Enabled": True, "Contact/Adhesion/Surface energy": 0.02,
                    "Contact/Adhesion/Tabor number": 0.5}
        x = 2 * np.pi * np.arange(64) / 64
        heights = 0.02 * (np.cos(x) + np.cos(x)[:, None])
        gaps = [strait.Seal(strait.Scene({**adhesive, "Surface/Kind": kind}), heights
                            ).solve(0.02).mean_gap for kind in ("sphere", "square saddle")]
        self.assertEqual(*gaps)

    def test_controls_that_mean_nothing(self):
        for what in ({"slip_length": np.nan}, {"slip_length": -np.inf}, {"slip_length": 1e-3},
                     {"inlet_pressure": np.nan}):
            with self.subTest(what), self.assertRaisesRegex(strait.SceneError, "finite number"):
                self.seal.control(.1, **what)
        for load in (np.nan, -np.inf, 1e-40, 1e31):
            with self.subTest(load), self.assertRaisesRegex(strait.SceneError, "finite number"):
                self.seal.solve(load)
        gas = strait.Seal(self.scene.replace({"Fluid/State": "gas"}))
        with self.assertRaisesRegex(strait.SceneError, "absolute pressures"):
            gas.control(.1, inlet_pressure=-1.)
        for first in (np.nan, np.inf, 0., -1., 1e-40):
            with self.subTest(first), self.assertRaisesRegex(strait.SceneError, "finite number"):
                self.seal.find_transitions(first)
        self.assertLess(self.seal.flow(self.seal.solve(self.seal.control(.1, slip_length=-1e-3))
                                       ).leak_rate,
                        self.seal.flow(self.seal.solve(.1)).leak_rate)

    def test_paths_and_transitions(self):
        path = self.seal.follow([0.05, 0.1, 0.15])
        self.assertTrue(np.all(np.diff(path["contact_area"]) > 0))
        self.assertEqual(path[2].control.target, 0.15)
        transition = self.seal.find_transition()
        self.assertLess(transition.upper / transition.lower, 1 + 1e-4)
        self.assertTrue(self.seal.flow(self.seal.solve(transition.lower)).percolates)
        self.assertFalse(self.seal.flow(self.seal.solve(transition.upper)).percolates)

    def test_adhesion_jumps(self):
        seal = strait.Seal(strait.Scene(
            surface=dict(kind="sphere", amplitude=1), fluid=dict(enabled=False),
            contact=dict(grid_points=64, adhesion=dict(enabled=True, surface_energy=0.02,
                                                       range=0.04))))
        path = seal.follow([0.02, 0., -0.5])
        self.assertTrue(path.parted)
        self.assertEqual(len(path), 2)
        self.assertTrue(path.jumps[-1].is_pull_off)
        self.assertLess(path.jumps[-1].before.pressure, 0.)

    def test_memory_of_yielding(self):
        seal = strait.Seal(self.scene.replace({"Contact/Yielding": "cut-off",
                                               "Contact/Hardness": 0.5}))
        first = seal.solve(0.1)
        self.assertGreater(seal.solve(0.05, from_=first).contact_area,
                           seal.solve(0.05).contact_area)
        self.assertGreater(first.indentation.max(), 0.)
        with self.assertRaisesRegex(strait.SceneError, "another seal"):
            self.seal.solve(0.05, from_=first)

    def test_fluid_on_the_walls(self):
        seal = strait.Seal(self.scene.replace({"Fluid/Wall feedback/Enabled": True,
                                               "Fluid/Inlet pressure": 0.02}))
        state = seal.solve(0.1)
        self.assertGreater(state.mean_gap, self.seal.solve(0.1).mean_gap)
        self.assertAlmostEqual(state.fluid_pressure.mean(), state.fluid_load, 9)
        more = seal.solve(seal.control(0.1, inlet_pressure=0.04), from_=state)
        self.assertGreater(more.mean_gap, state.mean_gap)
        self.assertGreater(seal.flow(more).leak_rate, 2 * seal.flow(state).leak_rate)

    def test_fields_of_a_flow(self):
        flow = self.seal.flow(self.seal.solve(0.1), fields=True)
        leaks = flow.clusters == 4
        self.assertTrue(np.array_equal(np.isfinite(flow.pressure), leaks))
        columns = np.nanmean(flow.pressure, axis=0)
        self.assertGreater(columns[1], columns[-1])
        # The current across any line is the leak rate, to the accuracy of the grid spacing.
        across = np.nansum(flow.current, axis=0) / 64
        self.assertGreater(across.min(), 0.7 * flow.leak_rate)

    def test_flow_in_a_gap_that_leads_nowhere(self):
        gap = np.full((32, 32), -0.1)
        gap[:, 5] = 0.2
        closed = strait.flow_in_gap(gap)
        self.assertFalse(closed.percolates)
        self.assertEqual(closed.leak_rate, 0.)
        across = strait.flow_in_gap(gap, fluid=dict(direction="y"))
        self.assertTrue(across.percolates)

    def test_a_gap_is_an_array_of_two_dimensions(self):
        for gap in (0.1, np.ones(32), np.ones((1, 32, 32))):
            with self.assertRaisesRegex(strait.SceneError, r"the shape \(ny, nx\), but has"):
                strait.flow_in_gap(gap)

    def test_other_threads_run_meanwhile(self):
        counted = []
        done = threading.Event()

        def count():
            while not done.is_set():
                counted.append(1)
                done.wait(1e-4)

        finer = strait.Seal(self.scene.replace({"Contact/Grid points": 512}))
        thread = threading.Thread(target=count)
        thread.start()
        results = []
        others = [threading.Thread(target=lambda p=p: results.append(finer.solve(p)))
                  for p in (0.05, 0.1, 0.15)]
        for other in others:
            other.start()
        for other in others:
            other.join()
        done.set()
        thread.join()
        self.assertEqual(sorted(round(state.control.target, 2) for state in results),
                         [0.05, 0.1, 0.15])
        self.assertGreater(len(counted), 3)

    def test_threads_make_and_drop_seals(self):
        areas = []

        def work():
            for _ in range(5):
                areas.append(strait.Seal(self.scene, self.scene.heights()).solve(0.1).contact_area)

        threads = [threading.Thread(target=work) for _ in range(3)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(len(areas), 15)
        self.assertEqual(len(set(areas)), 1)

    def test_memory_does_not_grow(self):
        for _ in range(50):
            self.seal.solve(0.1)
        before = allocated_bytes()
        for _ in range(300):
            self.seal.solve(0.1)
        self.assertLess(allocated_bytes() - before, 65536)  # size of one state

    def test_errors(self):
        with self.assertRaisesRegex(strait.SceneError, "Wall feedback"):
            self.seal.find_blow_outs([0.3])
        dry = strait.Seal(self.scene.replace({"Fluid/Enabled": False}))
        with self.assertRaisesRegex(strait.SceneError, "no flow"):
            dry.flow(dry.solve(0.1))
        for call in (lambda: self.seal.solve("much"), lambda: self.seal.flow(None)):
            with self.assertRaises(TypeError):
                call()
        for shape in ((0, 5), (5, 0), (0, 0)):
            with self.assertRaisesRegex(strait.SceneError, "neither of them 0"):
                strait.statistics(np.zeros(shape))

    def test_what_the_program_refuses_or_warns_of(self):
        real = {**SMALL, "Units/Length": "um", "Units/Pressure": "MPa", "Surface/Size": 50,
                "Surface/RMS value": 0.4, "Surface/Roll-off wavelength": 20,
                "Surface/Short cut-off wavelength": 6, "Contact/Effective modulus": 10,
                "Fluid/Inlet pressure": 1}
        seal = strait.Seal(strait.Scene(real))
        with self.assertRaisesRegex(strait.SceneError, "exceeds the nominal pressure"):
            seal.solve(0.5)
        with self.assertRaisesRegex(strait.SceneError, "more than the effective modulus"):
            seal.follow([2., 25.])
        self.assertTrue(seal.solve(seal.control(0.5, inlet_pressure=0.4)).converged)
        pressed = strait.Seal(strait.Scene({**real, "Fluid/Wall feedback/Enabled": True}))
        with self.assertRaisesRegex(strait.SceneError, "more than the effective modulus"):
            pressed.find_blow_outs([25.])
        with self.assertRaisesRegex(strait.SceneError, "which no surface has"):
            strait.Seal(strait.Scene({**real, "Surface/RMS value": 50}))
        fine = {"Surface/Short cut-off wavelength": 1 / 128, "Fluid/Enabled": False}
        with self.assertRaisesRegex(strait.SceneError, "spans only 0.5 grid points"):
            strait.Seal(strait.Scene({**fine, "Contact/Grid points": 64}))
        with self.assertWarnsRegex(strait.SceneWarning, "spans only 2 grid points"):
            strait.Seal(strait.Scene({**fine, "Contact/Grid points": 256}))
        with self.assertWarnsRegex(strait.SceneWarning, "have no effect: Range"):
            strait.Seal(strait.Scene({**SMALL, "Contact/Adhesion/Range": 0.1}))

    def test_warnings(self):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            strait.Seal(strait.Scene(
                surface=dict(kind="sphere", amplitude=1), fluid=dict(enabled=False),
                contact=dict(grid_points=64, adhesion=dict(enabled=True, surface_energy=0.02,
                                                           range=0.025))))
        self.assertTrue(caught)
        self.assertTrue(issubclass(caught[0].category, strait.SceneWarning))


if __name__ == "__main__":
    unittest.main()
