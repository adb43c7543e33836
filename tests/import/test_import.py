#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Tests of strait_import with files of all kinds, ambiguous ones, and damaged ones.

Files of instruments are read from the folder that STRAIT_MAPS names, or else from
../shared/data/maps beside the project, if it exists. The program strait is tested with the same
files if STRAIT_PROGRAM names it.
"""
import gzip
import hashlib
import importlib.machinery
import importlib.util
import os
import pathlib
import random
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import time
import unittest
import unittest.mock

import numpy as np
from scipy.io import netcdf_file

import files
import mutate
from map_import import gwyddion, read, settle   # mutate.py adds the folder to the path
from map_import.channel import Refused

TOOL = pathlib.Path(__file__).resolve().parents[2] / "tools" / "strait_import"
sys.dont_write_bytecode = True
loader = importlib.machinery.SourceFileLoader("strait_import", str(TOOL))
front = importlib.util.module_from_spec(importlib.util.spec_from_loader("strait_import", loader))
loader.exec_module(front)

REAL = os.environ.get("STRAIT_MAPS", str(TOOL.parents[2] / "shared" / "data" / "maps"))
PROGRAM = os.environ.get("STRAIT_PROGRAM", "")
HAS_GWYDDION = shutil.which("gwyddion") is not None


class Case(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="strait-import-")
        self.addCleanup(shutil.rmtree, self.folder)

    def write(self, name, content):
        path = os.path.join(self.folder, name)
        with open(path, "wb") as file:
            file.write(content.encode() if isinstance(content, str) else content)
        return path

    def run_tool(self, path, *options):
        output = os.path.join(self.folder, "map.nc")
        return subprocess.run([str(TOOL), path, "-o", output, "--force", *options], text=True,
                              capture_output=True, check=False, timeout=60)

    def read_map(self):
        with netcdf_file(os.path.join(self.folder, "map.nc"), mmap=False) as file:
            self.assertEqual(file.variables["heights"].unit, b"m")
            return (file.variables["heights"][:].T.copy(), float(file.variables["x"].length),
                    float(file.variables["y"].length))

    def read(self, path, *options):
        """Heights and size in metres, as strait_import would write them; raises Refused."""
        settings = front.parse_arguments([path, *options])
        with tempfile.TemporaryDirectory() as scratch:
            channel = settle.choose(read.read(path, settings, scratch), settings.channel)
        settle.settle(channel, settings)
        return channel.values * channel.metres, *channel.size

    def check_map(self, path, *options, hole=False):
        try:
            heights, lx, ly = self.read(path, *options)
        except Refused as reason:
            self.fail(f"refused: {reason}")
        self.check_heights(heights, lx, ly, hole)

    def check_heights(self, heights, lx, ly, hole=False):
        heights = np.where(np.isfinite(heights), heights, np.nan)
        expected = files.MICRONS * 1e-6
        if hole:
            expected[files.HOLE] = np.nan
        np.testing.assert_allclose(heights, expected, rtol=1e-6)
        np.testing.assert_allclose((lx, ly), files.SIZE, rtol=1e-6)

    def check_refusal(self, path, words, *options):
        with self.assertRaisesRegex(Refused, words):
            self.read(path, *options)

    def check_exit(self, path, words, *options):
        """The same of strait_import as a program, which writes no map."""
        result = self.run_tool(path, *options)
        self.assertEqual(result.returncode, 2, result.stdout)
        self.assertRegex(result.stderr, words)
        self.assertEqual(result.stderr.count("strait_import:"), 1)
        self.assertFalse(os.path.exists(os.path.join(self.folder, "map.nc")))


class Text(Case):
    def test_complete(self):
        for name, text in files.COMPLETE.items():
            with self.subTest(name):
                self.check_map(self.write(name, text))

    def test_ambiguous(self):
        for name, (text, words, options) in files.AMBIGUOUS.items():
            with self.subTest(name):
                path = self.write(name, text)
                self.check_refusal(path, words)
                if options:
                    self.check_map(path, *options)

    def test_refused(self):
        for name, (text, words) in files.REFUSED.items():
            with self.subTest(name):
                self.check_refusal(self.write(name, text), words)
        self.check_refusal(self.write("wyko.asc", files.wyko(mult=2)), "multiply .* divide")

    def test_packed(self):
        for name, content in files.packed().items():
            with self.subTest(name):
                self.check_map(self.write(name, content))

    def test_missing_points(self):
        for word in ("nan", "bad", "***", "--", "n/a", "No Data", "inf"):
            with self.subTest(word):
                lines = files.rows("\t").splitlines()
                row = lines[files.HOLE[0]].split("\t")
                row[files.HOLE[1]] = word
                lines[files.HOLE[0]] = "\t".join(row)
                header = files.gwyddion_header("Channel", "Width", "Height", "Value units")
                self.check_map(self.write("hole.txt", header + "\n".join(lines)), hole=True)

    def read_edge(self, text, separator=";"):
        """Read a map whose first row is another text; return how many points each row lacks."""
        header = files.SIDES + "z unit: um\n"
        below = files.rows(separator).split("\n", 1)[1]
        return np.isnan(self.read(self.write("edge.csv", header + text + "\n" + below))[0]).sum(1)

    def test_missing_points_at_the_edge(self):
        first = files.rows(";").splitlines()[0].split(";")
        for mark in ("#N/A", "-nan(ind)", "****", "NULL"):
            with self.subTest(mark):
                one = self.read_edge(";".join([mark, *first[1:]]))
                self.assertEqual(one.tolist(), [1] + [0] * (files.NY - 1))
                whole = self.read_edge(";".join([mark] * files.NX))
                self.assertEqual(whole.tolist(), [files.NX] + [0] * (files.NY - 1))
        for ornament in ("---- " * files.NX, "* " * files.NX, ";".join(["um"] * files.NX)):
            header = files.SIDES + "z unit: um\n" + ornament + "\n"
            self.check_map(self.write("edge.txt", header + files.rows(" ")))
        # Empty cells may be missing points or nothing.
        for separator in ";\t,":
            with self.assertRaisesRegex(Refused, "has empty cells only in line 4"):
                self.read_edge(separator * (files.NX - 1), separator)
        # A spreadsheet pads all lines in the same way.
        padding = ";" * (files.NX - 2)
        text = "".join(line + padding + "\n" for line in
                       ("Width;24 um", "Height;10 um", "Unit;um", ";"))
        self.check_map(self.write("padded.csv", text + files.rows(";") + "\n;" + padding))

    def test_mark_in_the_header(self):
        lines = files.rows(" ").splitlines()
        row = lines[files.HOLE[0]].split()
        row[files.HOLE[1]] = "-9999"
        lines[files.HOLE[0]] = " ".join(row)
        for statement in ("# NODATA_value: -9999", "NODATA_value -9999", "No data value = -9999",
                          "No data -9999", "Missing value;-9999;;;", "bad value -9999"):
            with self.subTest(statement):
                header = files.SIDES + "z unit: um\n" + statement + "\n"
                self.check_map(self.write("mark.txt", header + "\n".join(lines)), hole=True)
        header = files.SIDES + "NODATA_value -9999\nfill value: 0\n"
        self.check_refusal(self.write("mark.txt", header + "\n".join(lines)), "both -9999 and 0")
        for value in ("-9999,0", "-9999 um", "none"):
            header = files.SIDES + "z unit: um\nNODATA_value: " + value + "\n"
            self.check_refusal(self.write("mark.txt", header + "\n".join(lines)), "is no number")
        # The number of missing points is not a mark.
        for statement in ("Missing points: 0", "Invalid data: 17", "# NaN: 17"):
            header = files.SIDES + "z unit: um\n" + statement + "\n"
            self.check_map(self.write("count.txt", header + files.rows(" ")))

    def test_size(self):
        path = self.write("plain.txt", files.rows(" "))
        for size in ("24, 10 um", "24 10 um", " 24.0, 1e1 µm"):
            self.check_map(path, "--unit", "um", "--size", size)
        for size in ("24,10 um", "24, 10um", "10um", "24, 10", "um", "24, 10, 3 um", "24, -10 um"):
            self.check_refusal(path, "cannot have the --size", "--unit", "um", "--size", size)

    def test_axis_with_a_gap(self):
        """Whole numbers may be rounded, so that an axis with a gap is refused with any option."""
        steps = [x + (x > 5) for x in range(files.NX)]
        path = self.write("gap.txt", " ".join(map(str, steps)) + "\n" + files.rows(" "))
        self.check_refusal(path, "--as axes.*--as matrix")
        self.check_refusal(path, "no first row.* of equal steps", "--as", "axes", *files.IN_NM)

    def test_empty_corner(self):
        """A missing first point is not taken for the corner of axes."""
        text = ";".join(["", *files.rows(";").split(";")[1:]])
        path = self.write("corner.txt", "Width: 24 um\nHeight: 10 um\nUnit: um\n" + text)
        heights, *_ = self.read(path)
        expected = files.MICRONS * 1e-6
        expected[0, 0] = np.nan
        np.testing.assert_allclose(heights, expected)

    def test_matrix_of_a_few_columns(self):
        """What is said of the file is no row of names, and a matrix below sides may be narrow."""
        path = self.write("map.txt", "x size: 10 um\ny size: 8 um\nUnit: um\n" + "\n".join(
            f"{x % 3} {x % 7} {x % 5}" for x in range(1, 9)))
        self.assertEqual(self.read(path)[0].shape, (8, 3))
        path = self.write("map.txt", "z unit: um\nx size: 10 um\n" + "\n".join(
            f"{x % 3} {x % 7} {x % 5} 2" for x in range(1, 9)))
        self.check_refusal(path, "does not state its size")

    def test_summary_that_nobody_reads(self):
        path = self.write("map.txt", files.COMPLETE["gwyddion.txt"])
        read_end, write_end = os.pipe()
        os.close(read_end)
        with os.fdopen(write_end, "w") as closed:
            result = subprocess.run([str(TOOL), path], stdout=closed, stderr=subprocess.PIPE,
                                    check=False, timeout=60)
        self.assertEqual((result.returncode, result.stderr), (0, b""))
        self.assertTrue(os.path.exists(os.path.join(self.folder, "map.nc")))

    def test_absent_point(self):
        lines = files.points(" ").splitlines()
        del lines[files.HOLE[0] * files.NX + files.HOLE[1]]
        self.check_map(self.write("hole.txt", "\n".join(lines)), *files.XY, hole=True)


class Arrays(Case):
    def test_all(self):
        files.write_arrays(self.folder)
        for name, options in (("array.npy", files.IN_NM), ("array.npz", files.IN_NM),
                              ("array.mat", files.IN_NM), ("matlab73.mat", files.IN_NM),
                              ("attributes.h5", []),
                              ("two.h5", ["--channel", "first", *files.IN_NM]),
                              ("netcdf4.nc", []), ("classic.nc", [])):
            with self.subTest(name):
                self.check_map(os.path.join(self.folder, name), *options)
        self.check_refusal(os.path.join(self.folder, "two.h5"), "1: first .*\n  2: second")
        self.check_refusal(os.path.join(self.folder, "array.npy"), "--size .* --unit")

    def test_coordinates_of_netcdf(self):
        path = os.path.join(self.folder, "map.nc")
        x, y = 2. * np.arange(files.NX), 1. * np.arange(files.NY)
        for step_x, step_y in ((-1, 1), (1, -1), (-1, -1)):
            with self.subTest(step_x=step_x, step_y=step_y):
                files.write_netcdf(path, x[::step_x], y[::step_y],
                                   files.MICRONS[::step_y, ::step_x])
                self.check_map(path)
        # Rounded coordinates are not refused.
        files.write_netcdf(path, x + .02 * (x % 4), y, files.MICRONS)
        heights, *_ = self.read(path)
        np.testing.assert_allclose(heights, files.MICRONS * 1e-6)
        x[-1] += 60
        files.write_netcdf(path, x, y, files.MICRONS)
        self.check_refusal(path, "coordinates 'x' without equal steps")

    def test_packed_coordinates(self):
        """Their scale counts, turned or not, and integers do not overflow."""
        import h5py

        path = os.path.join(self.folder, "map.nc")
        for scale in (2., -2.):
            with self.subTest(scale=scale):
                files.write_netcdf(path, np.arange(files.NX), 1. * np.arange(files.NY),
                                   files.MICRONS[:, ::-1] if scale < 0 else files.MICRONS)
                with netcdf_file(path, "a") as file:
                    file.variables["x"].scale_factor, file.variables["x"].add_offset = scale, 7.
                self.check_map(path)
        for kind, start in (("u2", 0), ("i1", -128), ("u1", 0)):
            step = 20 if kind == "i1" else 1    # rises by more than the largest number
            with self.subTest(kind=kind), h5py.File(path, "w") as file:
                file["heights"] = files.MICRONS[::-1] if kind == "u2" else files.MICRONS
                file["heights"].attrs["unit"] = "um"
                for axis, n in enumerate(files.MICRONS.shape):
                    line = start + step * np.arange(n)
                    turned = kind == "u2" and axis == 0
                    file["yx"[axis]] = (line[::-1] if turned else line).astype(kind)
                    file["yx"[axis]].attrs["units"] = f"{(1, 2)[axis] / step} um"
                    file["yx"[axis]].make_scale("yx"[axis])
                    file["heights"].dims[axis].attach_scale(file["yx"[axis]])
            self.check_map(path)

    def test_attributes_of_the_file(self):
        """They hold for what the data set leaves open; what contradicts itself is refused."""
        import h5py

        path = os.path.join(self.folder, "map.h5")
        of_map = {"units": "um", "lateral_units": "um", "dx": 2., "dy": 1.}
        for of_data, words in ((of_map, ""), ({**of_map, "unit": "nm"}, "two units, 'nm' and 'um'"),
                               ({**of_map, "scale_factor": np.array([1., 2.])}, "no.* one number"),
                               ({**of_map, "scale_factor": "1"}, "not one number")):
            with h5py.File(path, "w") as file:
                file["height"] = files.MICRONS
                file["height"].attrs.update(of_data)
                file.attrs.update({"unit": "mm", "lateral_unit": "nm"})
            with self.subTest(of_data=of_data):
                if words:
                    self.check_refusal(path, words)
                else:
                    self.check_map(path)

    def test_labels_of_dimensions(self):
        import h5py

        path = os.path.join(self.folder, "map.h5")
        with h5py.File(path, "w") as file:
            file["height"] = files.MICRONS.T
            file["height"].attrs.update({"unit": "um", "lx": 24., "ly": 10., "lateral_unit": "um"})
            file["height"].dims[0].label, file["height"].dims[1].label = "x", "y"
        self.check_map(path)

    def test_marks_as_text(self):
        import h5py

        path = os.path.join(self.folder, "map.h5")
        heights = files.MICRONS.copy()
        heights[files.HOLE] = -9999.
        with h5py.File(path, "w") as file:
            file["height"] = heights
            file["height"].attrs.update({"unit": "um", "lx": 24., "ly": 10., "lateral_unit": "um",
                                         "missing_value": "-9999"})
        self.check_map(path, hole=True)

    def test_scales_of_netcdf4(self):
        """Dimensions are known by their names, also without coordinates; each group has its own."""
        import h5py

        path = os.path.join(self.folder, "map.h5")
        of_map = {"unit": "um", "lx": 24., "ly": 10., "lateral_unit": "um"}
        none = "This is a netCDF dimension but not a netCDF variable."
        lines = {"x": 2. * np.arange(files.NX), "y": 1. * np.arange(files.NY)[::-1]}
        for written in ("", "x", "y", "xy"):
            with self.subTest(written), h5py.File(path, "w") as file:
                file["fine/heights"] = (files.MICRONS[::-1] if "y" in written
                                        else files.MICRONS).T
                file["fine/heights"].attrs.update(of_map if written != "xy" else {"unit": "um"})
                for axis, (name, line) in enumerate(lines.items()):
                    other = file.create_dataset(name, data=5. * line)
                    other.attrs["units"] = "mm"
                    other.make_scale(name)
                    scale = file.create_dataset(f"fine/{name}", data=line * (name in written))
                    scale.attrs["units"] = "um"
                    scale.make_scale(name if name in written else none)
                    file["fine/heights"].dims[axis].attach_scale(scale)
            self.check_map(path)

    def test_unwritten_parts_of_hdf5(self):
        import h5py

        path = os.path.join(self.folder, "map.h5")
        with h5py.File(path, "w") as file:
            data = file.create_dataset("height", files.MICRONS.shape, "f4", chunks=(1, 1),
                                       fillvalue=-9999.)
            data.attrs.update({"unit": "um", "lx": 24., "ly": 10., "lateral_unit": "um"})
            for place, value in np.ndenumerate(files.MICRONS):
                if place != files.HOLE:
                    data[place] = value
        self.check_map(path, hole=True)

    def test_contradictions(self):
        import h5py

        path = os.path.join(self.folder, "map.nc")
        x, y = 2. * np.arange(files.NX), 1. * np.arange(files.NY)
        files.write_netcdf(path, x, y, files.MICRONS)
        with netcdf_file(path, "a") as file:
            file.variables["x"].length = 240.
        self.check_refusal(path, "a side of 240 and 12 points in steps of 2, which contradict")
        self.check_map(path, "--size", "24, 10 um")
        path = os.path.join(self.folder, "attributes.h5")
        for side, step in ((24., 2.), (24., -2.), (22., 2.), (240., 2.)):   # the last is wrong
            with h5py.File(path, "w") as file:
                file["height"] = files.MICRONS
                file["height"].attrs.update({"unit": "um", "lateral_unit": "um", "lx": side,
                                             "ly": 10., "dx": step, "dy": 1.})
            if side < 100:
                self.check_map(path)
        self.check_refusal(path, "a side of 240 and 12 points in steps of 2, which contradict")

    def test_side_between_points(self):
        """A side that is stated from the first point to the last is one step too short."""
        import h5py

        heights = np.resize(files.MICRONS, (24, 40))
        attributes, netcdf = (os.path.join(self.folder, name) for name in ("map.h5", "map.nc"))
        with h5py.File(attributes, "w") as file:
            file["height"] = heights
            file["height"].attrs.update({"unit": "um", "lateral_unit": "um", "lx": 19.5,
                                         "ly": 8.625, "dx": .5, "dy": .375})
        files.write_netcdf(netcdf, .5 * np.arange(40), .375 * np.arange(24), heights)
        with netcdf_file(netcdf, "a") as file:
            file.variables["x"].length, file.variables["y"].length = 19.5, 8.625
        header = "x size: 19.5 um\ny size: 8.625 um\ndx: 0.5 um\ndy: 0.375 um\nz unit: um\n"
        rows = "".join(" ".join(map(str, row)) + "\n" for row in heights)
        for path in (attributes, netcdf, self.write("map.txt", header + rows)):
            with self.subTest(path):
                np.testing.assert_allclose(self.read(path)[1:], (20e-6, 9e-6), rtol=1e-12)
        # Steps that the file has rounded.
        for sides, size in (((24., 10.), (26.1816, 11.111)), ((26.18, 11.11), (26.18, 11.11))):
            header = (f"x size: {sides[0]} um\ny size: {sides[1]} um\ndx: 2.1818 um\n"
                      "dy: 1.1111 um\nz unit: um\n")
            with self.subTest(sides):
                path = self.write("rounded.txt", header + files.rows(" "))
                np.testing.assert_allclose(self.read(path)[1:], np.multiply(size, 1e-6))

    def test_unit_of_all_lengths(self):
        """contact.engineering states the unit of lengths only with the coordinates."""
        path = os.path.join(self.folder, "map.nc")
        with netcdf_file(path, "w") as file:
            for name, n, length in (("x", files.NX, 24.), ("y", files.NY, 10.)):
                file.createDimension(name, n)
                along = file.createVariable(name, "f8", (name,))
                along[:] = (np.arange(n) + .5) * length / n
                along.length, along.periodic, along.length_unit = length, 0, b"um"
            file.createVariable("heights", "f8", ("x", "y"))[:] = files.MICRONS.T
        self.check_map(path)
        # A unit that the heights themselves state prevails, under either name.
        for attribute in ("unit", "units"):
            with netcdf_file(path, "a") as file:
                heights = file.variables["heights"]
                heights._attributes.clear()
                setattr(heights, attribute, b"mm")
            np.testing.assert_allclose(self.read(path)[0], files.MICRONS * 1e-3)

    def test_attributes_against_coordinates(self):
        path = os.path.join(self.folder, "map.nc")
        x, y = 2. * np.arange(files.NX), 1. * np.arange(files.NY)
        for sides, is_refused in (((24., 10.), False), ((22., 9.), False), ((24., 20.), True),
                                  ((.024, .01), True)):
            files.write_netcdf(path, x, y, files.MICRONS, lx=sides[0], ly=sides[1],
                               lateral_unit=b"um")
            if is_refused:
                self.check_refusal(path, "a side of .* m and 1. points in steps of .* contradict")
            self.check_map(path, *["--size", "24, 10 um"] * is_refused)
        files.write_netcdf(path, x, y, files.MICRONS, lx=.024, ly=.01, lateral_unit=b"mm")
        self.check_map(path)
        # Attributes that contradict each other are refused, whatever the coordinates are.
        files.write_netcdf(path, x, y, files.MICRONS, lx=24., ly=10., dx=3., dy=1.)
        self.check_refusal(path, "a side of 24 and 12 points in steps of 3, which contradict")
        # Sides without a unit cannot contradict coordinates.
        files.write_netcdf(path, x, y, files.MICRONS, lx=2.4e-5, ly=1e-5)
        self.check_map(path)

    def test_periodic(self):
        import h5py

        path = os.path.join(self.folder, "map.h5")
        netcdf = os.path.join(self.folder, "map.nc")
        files.write_netcdf(netcdf, 2. * np.arange(files.NX), 1. * np.arange(files.NY),
                           files.MICRONS)
        for expected, stated in ((True, ("true", "Yes", "1", b"TRUE", 1, 1., np.True_)),
                                 (False, ("false", "No", "0", b"False", 0, 0., np.False_,
                                          "perhaps", ""))):
            for value in stated:
                with self.subTest(value=value):
                    with h5py.File(path, "w") as file:
                        file["height"] = files.MICRONS
                        file["height"].attrs["periodic"] = value
                    self.assertIs(read.read(path, None, self.folder)[0].periodic, expected)
                    if isinstance(value, np.bool_):   # which classic NetCDF does not have
                        continue
                    with netcdf_file(netcdf, "a") as file:
                        file.variables["x"].periodic = file.variables["y"].periodic = value
                    self.assertIs(read.read(netcdf, None, self.folder)[0].periodic, expected)

    def test_marks_of_missing_values(self):
        path = os.path.join(self.folder, "map.nc")
        tenths = np.rint(10 * files.MICRONS)
        for mark, dtype, attributes in (
                (-9999, "d", {"_FillValue": -9999.}),
                (-9999, "d", {"missing_value": np.array([-8888., -9999.])}),
                (-9999, "d", {"valid_min": -5000.}),
                (9999, "f", {"valid_max": 5000.}),
                (9999, "d", {"valid_range": np.array([-5000., 5000.])}),
                (-32767, "h", {"scale_factor": .1}),
                (-2147483647, "i", {"scale_factor": .1}),
                (-999, "h", {"scale_factor": .1, "valid_min": np.int16(-500)}),
                (-999, "h", {"scale_factor": .1, "valid_min": -50.})):
            with self.subTest(dtype=dtype, **attributes):
                values = tenths.copy() if dtype in "hi" else files.MICRONS.copy()
                values[files.HOLE] = mark
                files.write_netcdf(path, 2. * np.arange(files.NX), 1. * np.arange(files.NY),
                                   values, dtype, **attributes)
                self.check_map(path, hole=True)
        # Unsigned numbers of 16 bits, as the signed ones that classic NetCDF has.
        counts = (tenths + 40000).astype("u2").astype("i2")
        counts[files.HOLE] = -2
        files.write_netcdf(path, 2. * np.arange(files.NX), 1. * np.arange(files.NY), counts, "h",
                           scale_factor=np.array([.1]), add_offset=-4000., _Unsigned="true",
                           _FillValue=np.int16(-2))
        self.check_map(path, hole=True)

    def test_without_gwyddion(self):
        with unittest.mock.patch("shutil.which", return_value=None):
            self.check_refusal(self.write("map.x3p", files.x3p()), "sudo apt install gwyddion")

    def test_gwyddion_that_hangs(self):
        os.chmod(self.write("gwyddion", "#!/bin/sh\nexec sleep 60\n"), 0o755)
        with (unittest.mock.patch.dict(os.environ, PATH=self.folder + ":" + os.environ["PATH"]),
              unittest.mock.patch.object(gwyddion, "SECONDS", .1)):
            self.check_refusal(self.write("map.x3p", files.x3p()), "busy for 0.1 s")

    def test_gwy(self):
        self.check_map(self.write("map.gwy", files.gwy()))


class Result(Case):
    def run_and_check(self, path, *options):
        result = self.run_tool(path, *options)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.check_heights(*self.read_map())

    def test_import_again(self):
        """A map that was imported can be imported again, without change."""
        self.run_and_check(self.write("map.txt", files.COMPLETE["gwyddion.txt"]))
        os.rename(os.path.join(self.folder, "map.nc"), os.path.join(self.folder, "first.nc"))
        self.run_and_check(os.path.join(self.folder, "first.nc"))

    def test_provenance_and_picture(self):
        path = self.write("map.txt", files.COMPLETE["gwyddion.txt"])
        self.run_and_check(path)
        with netcdf_file(os.path.join(self.folder, "map.nc"), mmap=False) as file:
            self.assertAlmostEqual(file.variables["x"].length / files.SIZE[0], 1, 14)
            self.assertEqual(file.source, b"map.txt")
            with open(path, "rb") as original:
                self.assertEqual(file.sha256.decode(), hashlib.sha256(original.read()).hexdigest())
        with open(os.path.join(self.folder, "map.png"), "rb") as file:
            self.assertEqual(file.read(4), b"\x89PNG")
        self.assertEqual(sorted(os.listdir(self.folder)), ["map.nc", "map.png", "map.txt"])

    def test_steep_slope_warns(self):
        header = files.gwyddion_header("Channel", "Width", "Height", "Value units")
        path = self.write("map.txt", header.replace("units: µm", "units: m") + files.rows(" "))
        result = self.run_tool(path)
        self.assertRegex(result.stdout, "warning: an rms slope above 1")

    def run_there(self, *arguments):
        """Status and message of the program in the folder of the files."""
        result = subprocess.run([str(TOOL), *arguments], text=True, capture_output=True,
                                check=False, timeout=60, cwd=self.folder)
        return result.returncode, result.stderr

    def content(self, name):
        with open(os.path.join(self.folder, name), "rb") as file:
            return file.read()

    def test_existing_files_are_kept(self):
        self.write("map.txt", files.COMPLETE["gwyddion.txt"])
        for name in ("map.nc", "map.png"):
            with self.subTest(name):
                kept = self.write(name, "precious")
                status, message = self.run_there("map.txt")
                self.assertEqual(status, 2)
                self.assertRegex(message, f"'{name}' exists already: .* -o, or add --force")
                self.assertEqual(self.content(name), b"precious")
                os.remove(kept)
                self.assertEqual(os.listdir(self.folder), ["map.txt"])
        self.write("map.png", "not precious")
        self.assertEqual(self.run_there("map.txt", "--force"), (0, ""))
        self.assertEqual(self.content("map.png")[:4], b"\x89PNG")

    def test_output_that_is_no_map(self):
        self.write("map.txt", files.COMPLETE["gwyddion.txt"])
        for name, words in (("a.png", "with -o, ending in .nc"), ("a.PNG", "ending in .nc"),
                            (".", "is a folder"), (self.folder, "is a folder")):
            for force in ([], ["--force"]):
                with self.subTest(name, force=force):
                    status, message = self.run_there("map.txt", "-o", name, *force)
                    self.assertEqual(status, 2)
                    self.assertIn(words, message)
                    self.assertEqual(os.listdir(self.folder), ["map.txt"])

    def test_measurement_is_kept(self):
        text = files.COMPLETE["gwyddion.txt"]
        for name in ("map.txt", "map.nc", "scan.png"):
            self.write(name, text)
        os.mkdir(os.path.join(self.folder, "sub"))
        os.symlink("map.txt", os.path.join(self.folder, "link.txt"))
        before = sorted(os.listdir(self.folder))
        for arguments in (["map.nc"], ["map.txt", "-o", "map.txt"],
                          ["map.txt", "-o", "sub/../map.txt"],
                          [os.path.join(self.folder, "map.txt"), "-o", "map.txt"],
                          ["link.txt", "-o", "map.txt"], ["map.txt", "-o", "link.txt"],
                          ["scan.png"], ["scan.png", "-o", "scan.nc"]):   # the picture would
            for force in ([], ["--force"]):
                with self.subTest(arguments=arguments, force=force):
                    status, message = self.run_there(*arguments, *force)
                    self.assertEqual(status, 2)
                    self.assertRegex(message, "would replace the measurement itself: .* -o")
        self.assertEqual(sorted(os.listdir(self.folder)), before)
        for name in ("map.txt", "map.nc", "scan.png"):
            self.assertEqual(self.content(name), text.encode())


@unittest.skipUnless(PROGRAM, "STRAIT_PROGRAM does not name the program")
class Program(Case):
    def test_reads_and_writes_maps(self):
        """The program reads what strait_import writes, and the other way round."""
        path = self.write("map.txt", files.COMPLETE["gwyddion.txt"])
        self.assertEqual(self.run_tool(path).returncode, 0)
        scene = self.write("scene.prm", """
            subsection Surface
              set Kind = file
              set File = map.nc
            end
            subsection Fluid
              set Enabled = false
            end
            subsection Load programme
              set Pressures = 1e-3
            end
            subsection Output
              set Surface map = true
              set Pictures = false
            end""")
        output = os.path.join(self.folder, "output")
        result = subprocess.run([PROGRAM, scene, "--output", output], text=True,
                                capture_output=True, check=False)
        self.assertEqual(result.returncode, 0, result.stderr)
        written = os.path.join(output, "surface.nc")
        with netcdf_file(written, mmap=False) as file:
            self.assertEqual(file.variables["x"].periodic, 1)
            self.assertEqual(file.variables["y"].unit, b"m")
            np.testing.assert_allclose(file.variables["x"][:], np.arange(files.NX) * 2e-6)
        self.check_map(written)

    def test_both_readers_find_the_same_size(self):
        """A NetCDF file has the same sides for the program as after an import."""
        path = os.path.join(self.folder, "map.nc")
        for kind in ("f8", "i2"):
            for sides in ({}, {"x": 24., "y": 10.}, {"x": 22., "y": 9.}, {"x": np.int16(22),
                                                                          "y": np.int16(9)}):
                with netcdf_file(path, "w") as file:
                    for name, n, step in (("x", files.NX, 2), ("y", files.NY, 1)):
                        file.createDimension(name, n)
                        along = file.createVariable(name, kind, (name,))
                        along[:] = step * np.arange(n)
                        along.unit = "um"
                        if name in sides:
                            along.length = sides[name]
                    heights = file.createVariable("heights", "f8", ("y", "x"))
                    heights[:], heights.unit = files.MICRONS, "um"
                with self.subTest(kind=kind, sides=sides):
                    np.testing.assert_allclose(self.read(path)[1:], (24e-6, 10e-6))
                    said = subprocess.run(
                        [PROGRAM, self.write("scene.prm", f"subsection Surface\n set Kind = file\n "
                                             f"set File = {path}\nend\n"), "--dry-run"],
                        text=True, capture_output=True, check=False, cwd=self.folder).stdout
                    self.assertIn("on a box of 2.4e-05 × 1e-05,", said)
        # Packed numbers, which the program leaves to strait_import.
        with netcdf_file(path, "a") as file:
            file.variables["x"].scale_factor = .5
        refused = subprocess.run([PROGRAM, os.path.join(self.folder, "scene.prm"), "--dry-run"],
                                 text=True, capture_output=True, check=False)
        self.assertEqual(refused.returncode, 2)
        self.assertIn("has the attribute scale_factor: type", refused.stderr)

        # Records, whose number stands elsewhere.
        with netcdf_file(path, "w") as file:
            file.createDimension("y", None)
            file.createDimension("x", files.NX)
            heights = file.createVariable("heights", "f8", ("y", "x"))
            heights[:], heights.unit = files.MICRONS, "um"
        refused = subprocess.run([PROGRAM, os.path.join(self.folder, "scene.prm"), "--dry-run"],
                                 text=True, capture_output=True, check=False)
        self.assertEqual(refused.returncode, 2)
        self.assertIn("has heights in records: type", refused.stderr)

    def test_both_readers_find_the_same_marks_and_axes(self):
        """A mark in double precision for heights in single, whose first dimension is X."""
        path = os.path.join(self.folder, "map.nc")
        heights = files.MICRONS.copy()
        heights[files.HOLE] = -9999.1
        with netcdf_file(path, "w") as file:
            for name, n, step in (("X", files.NX, 2), ("Y", files.NY, 1)):
                file.createDimension(name, n)
                along = file.createVariable(name, "f8", (name,))
                along[:], along.unit = step * np.arange(n), "um"
            stored = file.createVariable("heights", "f4", ("X", "Y"))
            stored[:], stored.unit, stored._FillValue = heights.T, "um", -9999.1
        self.check_map(path, hole=True)
        scene = self.write("scene.prm", f"subsection Surface\n set Kind = file\n set File = {path}\n"
                           " set Largest missing share = 0.1\nend\n")
        said = subprocess.run([PROGRAM, scene, "--dry-run"], text=True, capture_output=True,
                              check=False, cwd=self.folder).stdout
        self.assertIn("on a box of 2.4e-05 × 1e-05,", said)
        self.assertRegex(said, "1 .*missing")

    def test_names_the_command_of_the_import(self):
        path = self.write("map.x3p", files.x3p())
        scene = self.write("scene.prm", f"subsection Surface\n set Kind = file\n "
                           f"set File = {path}\nend\n")
        result = subprocess.run([PROGRAM, scene], text=True, capture_output=True, check=False,
                                cwd=self.folder)
        self.assertEqual(result.returncode, 2)
        command = re.search('type "([^"]+)"', result.stderr)[1]
        if HAS_GWYDDION:
            subprocess.run(command.split(), check=True, capture_output=True)
            self.check_map(re.search("set Surface/File = (.*)", result.stderr)[1].strip(" ."))


class Damaged(Case):
    def samples(self):
        """One file of each kind, by name."""
        files.write_arrays(self.folder)
        for name, content in {**files.packed(), "map.gwy": files.gwy(),
                              "text.txt": files.COMPLETE["spip.asc"],
                              "points.csv": files.COMPLETE["points.csv"],
                              **(files.THROUGH_GWYDDION if HAS_GWYDDION else {})}.items():
            self.write(name, content)
        return sorted(os.listdir(self.folder))

    def test_absent_empty_and_folder(self):
        self.check_exit(os.path.join(self.folder, "none.txt"), "does not exist")
        self.check_exit(self.folder, "is no file")
        self.check_exit(self.write("empty.txt", ""), "is empty")

    def test_one_sentence(self):
        for name, (text, words, _) in list(files.AMBIGUOUS.items())[:3]:
            with self.subTest(name):
                self.check_exit(self.write(name, text), words)

    def test_truncated(self):
        for name in self.samples():
            path = os.path.join(self.folder, name)
            with open(path, "rb") as file:
                content = file.read()
            for part in (.3, .9):
                with self.subTest(name=name, part=part):
                    path = self.write("cut-" + name, content[:int(part * len(content))])
                    try:
                        heights, *_ = self.read(path, *files.IN_NM)
                    except Refused:
                        continue
                    # A text that ends early may be a smaller map; the number at the cut is lost.
                    whole = files.MICRONS[:len(heights) - 1] * 1e-6
                    np.testing.assert_allclose(heights[:-1], whole, rtol=1e-6)

    def test_known_troublemakers(self):
        """On these files the libraries read out of bounds, go on forever or take gigabytes."""
        data = pathlib.Path(__file__).resolve().parent / "data"
        for path in (*sorted(data.iterdir()), data.parents[1] / "robustness/data/boundless.nc"):
            if path.name == "endless.h5":   # the next test
                continue
            with self.subTest(path.name):
                begin = time.monotonic()
                self.check_exit(str(path), ".")
                self.assertLess(time.monotonic() - begin, 30)

    def test_file_that_is_read_forever(self):
        path = pathlib.Path(__file__).resolve().parent / "data" / "endless.h5"
        impatient = TOOL.read_text(encoding="utf-8").replace("SECONDS, MEMORY = 25,",
                                                             "SECONDS, MEMORY = 2,")
        begin = time.monotonic()
        result = subprocess.run([sys.executable, "-", str(path), "-o",
                                 os.path.join(self.folder, "map.nc")], input=impatient,
                                text=True, capture_output=True, check=False, timeout=60,
                                env={**os.environ, "PYTHONPATH": str(TOOL.parent)})
        self.assertEqual((result.returncode, result.stderr),
                         (2, f"strait_import: '{path}' is not read within 2 s.\n"))
        self.assertLess(time.monotonic() - begin, 10)
        self.assertFalse(os.path.exists(os.path.join(self.folder, "map.nc")))

    def test_huge_claims(self):
        npy = b"\x93NUMPY\1\0v\0" + (b"{'descr': '<f8', 'fortran_order': False, 'shape': "
                                     b"(60000, 60000), }").ljust(117) + b"\n" + b"\0" * 80
        gwy = files.gwy().replace(b"xres\0i" + struct.pack("<i", files.NX),
                                  b"xres\0i" + struct.pack("<i", 60000))
        for name, content in (("huge.npy", npy), ("huge.gwy", gwy),
                              ("header.txt", "# Width: 1 m\n" * 10**6)):
            with self.subTest(name):
                begin = time.monotonic()
                self.check_exit(self.write(name, content), ".", *files.IN_NM)
                self.assertLess(time.monotonic() - begin, 30)

    def test_archive_that_unpacks_to_too_much(self):
        path = self.write("bomb.gz", gzip.compress(b"1 2 3 4 5 6\n" * (1 << 18)))
        with unittest.mock.patch.object(read, "LARGEST", 1 << 20):
            self.check_refusal(path, "unpacks to more than")

    def test_mutations(self):
        """A few mutations of each file; more can be run by hand: mutate.py FILE RUNS."""
        n_runs = 15
        for name in self.samples():
            with self.subTest(name):
                through = name in files.THROUGH_GWYDDION
                counts = mutate.mutate(os.path.join(self.folder, name),
                                       3 if through else n_runs, random.Random(name))
                self.assertEqual(counts["error"], 0)


@unittest.skipUnless(HAS_GWYDDION, "Gwyddion is not installed: its formats are not tested")
class Gwyddion(Case):
    def test_all(self):
        for name, content in files.THROUGH_GWYDDION.items():
            with self.subTest(name):
                self.check_map(self.write(name, content))

    def test_infinite_points_of_x3p(self):
        self.check_map(self.write("hole.x3p", files.x3p(hole=True)), hole=True)


# Points, size in m, rms height in m of the measured points, and number of missing points.
INSTRUMENTS = {
    "x3p-2.x3p": (650, 650, 8.29767e-5, 2.04478e-4, 7.728e-8, 0),
    "sur-2.sur": (563, 484, 1.96149e-3, 1.68626e-3, 3.1187e-8, 0),
    "opd-1.opd": (640, 480, 1.25909e-4, 9.44319e-5, 8.3565e-9, 116),
    "plu-1.plu": (768, 576, 1.27488e-3, 9.5616e-4, 2.8344e-6, 0),
    "nid-1.nid Z-Axis forward": (256, 256, 2e-5, 2e-5, 2.3959e-7, 0),
    "nid-1.nid Z-AxisSensor forward": (256, 256, 2e-5, 2e-5, 3.0267e-7, 0),
    "mi-1.mi": (256, 256, 2e-5, 2e-5, 3.3215e-8, 0),
    "di-1.di 1": (512, 512, 5e-7, 5e-7, 9.946e-9, 0),
    "di-1.di 2": (512, 512, 5e-7, 5e-7, 1.1401e-7, 0),
    "frt-2.frt": (150, 300, .03, .06, 8.8268e-6, 12314),
    "al3d-1.al3d": (200, 296, 8.76054e-5, 1.29656e-4, 7.6883e-6, 0),
    "metropro-1.dat": (640, 480, 7.02881e-4, 5.27161e-4, 7.5288e-8, 0),
    "top-1.top": (256, 256, 6e-7, 6e-7, 3.1531e-9, 0),
    "stp-1.stp": (256, 256, 6e-7, 6e-7, 1.6542e-9, 0),
    "bcrf-1.bcrf": (960, 600, 1.7774e-3, 1.11088e-3, 2.456e-8, 0),
    "sdf-1.sdf": (7, 4, 7e-6, 4e-6, 1.3603e-8, 0),
    "matrix-3.txt": (256, 256, 1e-5, 1e-5, 3.5223e-8, 0),
    "gwyddion-export-german.txt": (3, 4, 1.234e-5, 5.6789e-6, 4.7058, 0),
    "gwyddion-export-english.txt": (3, 4, 1.234e-5, 5.6789e-6, 4.7058, 0),
    "txt_example.txt": (6, 3, 1e-6, 5e-7, 2.6644e-8, 0),
}
NO_MAPS = {
    "di_corrupted.di": "truncated", "hfm-1.hfm": ".", "nid-1.nid": "8: Z-AxisSensor backward",
    "di-1.di": "2: Height", "matrix-5.txt": "--size", "xyz-1.txt": "--xy-unit",
    "xyz-1-different-order.txt": "--xy-unit", "xyz-2.txt": "--xy-unit", "xy-1.txt": "profile",
    "xy-2.txt": "2 values in line 3", "xy-3.txt": "profile", "csv-1.csv": "profile",
    "csv-2.csv": "profile", "csv-3.csv": "profile", "dektak-1.csv": ".",
    "multiple_data_sets.h5": "2: dataset2", "nonsense_txt_file.txt": "no table",
    "wrongnpyfile.npy": "known neither", "single_column.txt": "profile",
    "nonuniform.asc": "profile", "example-2d.npy": "--size",
}


@unittest.skipUnless(os.path.isdir(REAL), f"There are no files of instruments in {REAL}")
class Instruments(Case):
    @unittest.skipUnless(HAS_GWYDDION, "Gwyddion is not installed: its formats are not tested")
    def test_maps(self):
        for key, (nx, ny, lx, ly, rms, missing) in INSTRUMENTS.items():
            with self.subTest(key):
                name, _, channel = key.partition(" ")
                heights, *size = self.read(os.path.join(REAL, name),
                                           *(["--channel", channel] if channel else []))
                self.assertEqual(heights.shape, (ny, nx))
                np.testing.assert_allclose(size, (lx, ly), rtol=1e-5)
                self.assertAlmostEqual(np.nanstd(heights) / rms, 1, 3)
                self.assertEqual(np.isnan(heights).sum(), missing)

    def test_refused(self):
        for name, words in NO_MAPS.items():
            with self.subTest(name):
                self.check_refusal(os.path.join(REAL, name), words)


if __name__ == "__main__":
    unittest.main(verbosity=1 if len(sys.argv) > 1 else 2)
