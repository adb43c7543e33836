#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Tests of tools/plot.py: the pictures show what the results say, and odd results break nothing."""
import contextlib
import importlib
import io
import pathlib
import resource
import subprocess
import sys
import tempfile
import unittest
import unittest.mock
import warnings

import h5py
import numpy as np
from matplotlib.figure import Figure
from matplotlib.image import imread

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "tools" / "plot.py"
sys.path.insert(0, str(SCRIPT.parent))
plot, plot_common, plot_ensemble, plot_leakage, plot_pictures = map(
    importlib.import_module,
    ("plot", "plot_common", "plot_ensemble", "plot_leakage", "plot_pictures"))

HEADER = ("step,branch,pressure,mean_gap,contact_area,contact_area_corrected,percolates,"
          "reduced_load,leak_rate,leak_rate_lower,leak_rate_upper,status")
ROWS = ["1,loading,0.05,0.4,0.11,0.1,1,,1e-3,nan,1.1e-3,ok",
        "2,loading,0.1,0.3,0.21,0.2,1,nan,1e-6,9e-7,1.2e-6,ok",
        "3,loading,0.2,0.1,0.43,0.4,0,,0,0,0,ok"]


def channel(ny, nx, flow=True):
    """A box with a channel along x in its upper half, contact below it, and one closed pocket."""
    y, x = np.meshgrid((np.arange(ny) + 0.5) / ny, (np.arange(nx) + 0.5) / nx, indexing="ij")
    wet = (y > 0.5) & (y < 0.9)
    pocket = (abs(y - 0.25) < 0.1) & (abs(x - 0.25) < 0.1)
    fields = {"open": (2 * wet + pocket).astype(np.uint8),
              "gap": np.where(wet, 0.2, np.where(pocket, 0.1, 0)),
              "pressure": np.where(wet | pocket, 0, 1.0)}
    if flow:
        fields["fluid_pressure"] = np.where(wet, 1 - x, np.nan)
        fields["current"] = np.where(wet, 10.0**(-15 * abs(y - 0.7) / 0.2), np.nan)
    return fields


def write_picture(folder, step, fields, **changes):
    """picture-STEP.h5 as the program writes it; @p changes override attributes, None omits."""
    about = {"lx": 1.0, "ly": 1.0, "nominal_pressure": 0.1, "contact_area": 0.5, "leak_rate": 1e-6,
             "inlet_pressure": 1.0, "outlet_pressure": 0.0, "worst_x": 0.75, "worst_y": 0.7,
             "percolates": 1.0, "direction": "x", **changes}
    with h5py.File(folder / f"picture-{step}.h5", "w") as file:
        for name, field in fields.items():
            file[name] = field.astype(np.float32)
        file.attrs.update({name: value for name, value in about.items() if value is not None})


def panels_of(path, lx=1.0, ly=1.0):
    """The pixels (rows from the bottom, 0 to 1) inside the frames of both panels of a picture."""
    pixels = imread(path)[::-1, :, :3]
    _, panels, _ = plot_pictures.add_panels(lx, ly)
    height, width = pixels.shape[:2]
    inside = []
    for panel in panels:
        box = panel.get_position()
        rows = slice(round(box.y0 * height) + 2, round(box.y1 * height) - 2)
        inside.append(pixels[rows, round(box.x0 * width) + 2:round(box.x1 * width) - 2])
    return inside


def share(pixels, colour, tolerance=0.02):
    """The share of the pixels that have a colour (0 to 255)."""
    return np.mean(np.all(abs(pixels - np.divide(colour, 255)) < tolerance, axis=-1))


class PlotTest(unittest.TestCase):
    """A folder for the results; draw() runs the script within this process, warnings are errors."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def write_table(self, *lines):
        (self.folder / "leakage.csv").write_text("".join(line + "\n" for line in lines))

    def draw(self, *options):
        """Exit status and messages of the script."""
        messages = io.StringIO()
        with contextlib.redirect_stderr(messages), warnings.catch_warnings():
            warnings.simplefilter("error")
            warnings.filterwarnings("ignore", category=DeprecationWarning)
            status = plot.main([str(self.folder), *options])
        return status, messages.getvalue()

    def drawn(self):
        """Names of the pictures in the folder."""
        return sorted(path.name for path in self.folder.glob("*.png"))


class Spectrum(PlotTest):
    """spectrum.png."""

    def write_spectrum(self, fits):
        (self.folder / "spectrum.csv").write_text(
            "wave_number,wavelength,density,modes,fit\n" +
            "".join(f"{q},{6.28 / q},{q**-3.6},{8 * q},{fit}\n"
                    for q, fit in zip((1., 2., 4., 8.), fits)))

    def test_with_and_without_a_fit(self):
        self.write_table(HEADER, *ROWS)
        for fits in ((1, 0.08, 0.0068, "nan"), ("nan",) * 4):
            self.write_spectrum(fits)
            self.assertEqual(self.draw(), (0, ""))
            self.assertIn("spectrum.png", self.drawn())
            pixels = imread(self.folder / "spectrum.png")[..., :3]
            line = share(pixels, (213, 94, 0))  # vermillion
            self.assertEqual(line > 0.0005, fits[0] == 1)

    def test_a_bad_table_is_reported(self):
        self.write_table(HEADER, *ROWS)
        (self.folder / "spectrum.csv").write_text("density\n1\n")
        status, message = self.draw()
        self.assertEqual(status, 1)
        self.assertIn("spectrum.csv", message)


class Leakage(PlotTest):
    """leakage.png."""

    def assert_draws(self, *lines):
        self.write_table(*lines)
        self.assertEqual(self.draw(), (0, ""))
        pixels = imread(self.folder / "leakage.png")[..., :3]
        self.assertGreater(np.mean(pixels < 0.9), 0.002, "the picture is blank")
        return pixels

    def test_panels_follow_the_columns(self):
        self.assertEqual(self.assert_draws(HEADER, *ROWS).shape, (600, 1485, 3))
        near = [row.replace("1,,", "1,0.5,").replace("1,nan,", "1,0.01,") for row in ROWS]
        self.assertEqual(self.assert_draws(HEADER, *near).shape, (600, 2205, 3))
        self.assertEqual(self.assert_draws("pressure,leak_rate", "1,2", "2,1").shape, (600, 765, 3))
        self.assertEqual(self.assert_draws("pressure,mean_gap", "1,2", "2,1").shape, (600, 765, 3))

    def test_sealed_steps_are_marked(self):
        marked = self.assert_draws(HEADER, *ROWS)
        plain = self.assert_draws(HEADER, *ROWS[:2])
        vermillion = np.array([213, 94, 0])
        left = [share(pixels[:, :740], vermillion) for pixels in (marked, plain)]
        self.assertGreater(left[0], 0)
        self.assertEqual(left[1], 0)

    def test_parted_walls_are_marked(self):
        lines = [HEADER, *ROWS, "4,loading,0.01,inf,0,0,1,,inf,0,inf,lifted-off"]
        for rows in (lines, [HEADER, lines[-1]]):
            axes = self.axes_of(plot_leakage.draw_leak_rate, *rows)
            marks = {line.get_label(): list(line.get_xdata()) for line in axes.lines}
            self.assertEqual(marks["walls apart, no limit"], [0.01])
            self.assert_draws(*rows)
        with unittest.mock.patch.object(plot_leakage, "label_axis") as label:
            self.axes_of(plot_leakage.draw_contact, *lines)
        self.assertEqual(label.call_args.args[-1], 0.4, "the scale is that of what is finite")

    def test_points_of_one_load_do_not_hide_each_other(self):
        self.write_table(HEADER, ROWS[0])
        figure = Figure()
        axes = figure.subplots()
        plot_leakage.draw_contact(axes, plot_leakage.read_table(self.folder / "leakage.csv"), {},
                                  None)
        heights = []
        for scale in figure.axes:
            at = (0, scale.lines[0].get_ydata()[0])
            heights.append(scale.transAxes.inverted().transform(scale.transData.transform(at))[1])
        self.assertGreater(abs(heights[0] - heights[1]), .05)

    def test_a_contact_that_is_loaded_again_has_its_own_line(self):
        rows = [f"{k},{branch},{pressure},0.1,{area},{area},1,,1e-6,9e-7,1.1e-6,ok"
                for k, (branch, pressure, area) in enumerate(
                    [("loading", 1, .1), ("loading", 3, .3), ("unloading", 2, .25),
                     ("loading", 2.5, .27), ("loading", 4, .4)])]
        self.write_table(HEADER, *rows)
        table = plot_leakage.read_table(self.folder / "leakage.csv")
        lines = [(label, list(table["pressure"][chosen]))
                 for label, _, _, chosen in plot_leakage.all_series(table)]
        self.assertEqual(lines, [("loading", [1, 3]), ("unloading", [2]),
                                 ("loading (2)", [2.5, 4])])
        axes = self.axes_of(plot_leakage.draw_contact, HEADER, *rows)
        self.assertIn([2.5, 4], [list(line.get_xdata()) for line in axes.lines])

    def test_bracket_is_drawn(self):
        wide = ROWS[1].replace("9e-7", "1e-7")
        blue = np.array([0, 114, 178])
        tight, loose = (share(self.assert_draws(HEADER, ROWS[0], row), blue)
                        for row in (ROWS[1].replace("9e-7,1.2e-6", "nan,nan"), wide))
        self.assertGreater(loose, tight)

    def axes_of(self, draw, *lines, fits=()):
        """What a panel's function draws of a table."""
        self.write_table(*lines)
        axes = Figure().subplots()
        draw(axes, plot_leakage.read_table(self.folder / "leakage.csv"), {}, fits)
        return axes

    def test_each_slip_length_has_a_line(self):
        header = "pressure,leak_rate,reduced_load,slip_length,status"
        lines = [f"{0.1 * step},{10.0**-step},{0.5 / step},{slip},ok"
                 for step in (2, 1, 3) for slip in (0, -1e-3, -1e-2)]
        axes = self.axes_of(plot_leakage.draw_threshold, header, *lines, fits=["one", "two"])
        labels = axes.get_legend_handles_labels()[1]
        self.assertEqual(labels, ["$d_0$ = 0", "$d_0$ = -0.001", "$d_0$ = -0.01",
                                  "slope 69/20", "slope 3"])
        self.assertEqual(len({line.get_color() for line in axes.lines[:6]}), 3)
        self.assertTrue(np.all(np.diff(axes.lines[0].get_xdata()) > 0), "ordered by load")
        self.assertEqual(axes.texts[0].get_text(), "one\ntwo")
        self.assert_draws(header, *lines)

    def test_guides_have_their_slopes(self):
        header = "pressure,leak_rate,reduced_load,slip_length"
        lines = [f"{step},{0.1**step},{0.5 / step},{slip}" for step in (1, 2) for slip in (0, -1)]
        axes = self.axes_of(plot_leakage.draw_threshold, header, *lines)
        for line, slope in zip(axes.lines[-2:], (3.45, 3)):
            x, y = np.log(line.get_data())
            self.assertAlmostEqual((y[1] - y[0]) / (x[1] - x[0]), slope)
            self.assertLess(line.get_linewidth(), 1)
        dry = self.axes_of(plot_leakage.draw_threshold, header.replace("slip_length", "other"),
                           *lines)
        self.assertIn("slope 69/20", dry.get_legend_handles_labels()[1])
        self.assertNotIn("slope 3", dry.get_legend_handles_labels()[1])

    def test_doubtful_steps_are_hollow_and_failed_ones_ringed(self):
        header = "pressure,leak_rate,leak_rate_lower,leak_rate_upper,status"
        lines = ["1,1e-3,1e-3,1e-3,ok", "2,1e-4,1e-4,1e-4,unresolved-throat",
                 "3,1e-5,1e-5,1e-5,uncertain-threshold",
                 "4,1e-30,1e-50,1e-9,flow-accuracy+unresolved-throat",
                 "5,1e-5,1e-5,1e-5,uncertain-threshold+unresolved-throat"]
        axes = self.axes_of(plot_leakage.draw_leak_rate, header, *lines)
        line, hollow = axes.lines[:2]
        self.assertEqual(list(line.get_xdata()), [1, 2, 3, 5])
        self.assertEqual(list(hollow.get_xdata()), [2, 3, 5])
        self.assertEqual(hollow.get_markerfacecolor(), "white")
        self.assertEqual(axes.get_legend_handles_labels()[1],
                         ["hollow: unresolved-throat, uncertain-threshold, "
                          "uncertain-threshold+unresolved-throat",
                          "failed: flow-accuracy+unresolved-throat"])
        self.assertGreater(axes.get_ylim()[0], 1e-8, "a failed step stretches the scale")

    def test_negative_leak_rates_are_drawn_by_their_size(self):
        header = "pressure,leak_rate,leak_rate_lower,leak_rate_upper,theory_leak_rate,reduced_load"
        lines = ["1,-1e-3,9e-4,1.1e-3,-2e-3,0.5", "2,-1e-5,9e-6,1.1e-5,-2e-5,0.1", "3,0,0,0,0,-1"]
        for draw in (plot_leakage.draw_leak_rate, plot_leakage.draw_threshold):
            axes = self.axes_of(draw, header, *lines)
            self.assertEqual(axes.get_ylabel(), "Size of the negative leak rate (scene units)")
            self.assertEqual(sorted(axes.lines[0].get_ydata()), [1e-5, 1e-3])
            theory = next(line for line in axes.lines if line.get_color() == plot_common.RED)
            self.assertEqual(sorted(theory.get_ydata()), [2e-5, 2e-3])
            self.assertLess(axes.get_ylim()[1], 1)
        self.assertEqual(self.axes_of(plot_leakage.draw_leak_rate, HEADER, *ROWS).get_ylabel(),
                         "Leak rate (scene units)")
        self.assert_draws(header, *lines)

    def test_fitted_exponents(self):
        path = self.folder / "fit.csv"
        path.write_text("quantity,slip_length,kind,from,to,exponent,error,points\n"
                        "leak_rate,0,local,0.1,0.2,3.6,0,2\n"
                        "leak_rate,0,fit,0.003,0.02,3.47,0.01,5\n"
                        "throat_gap,0,fit,0.003,0.02,1.2,0.01,5\n")
        self.assertEqual(plot_leakage.read_fits(path),
                         [r"$\beta$ = 3.470 $\pm$ 0.010, 0.003 to 0.02"])
        with path.open("a") as file:
            file.write("leak_rate,-0.01,fit,0.003,0.02,3,0,2\n")  # two points have no error
        self.assertEqual(plot_leakage.read_fits(path)[1],
                         r"$d_0$ = -0.01: $\beta$ = 3.000, 0.003 to 0.02")
        for text in ("", "quantity\nleak_rate\n"):
            path.write_text(text)
            self.assertEqual(plot_leakage.read_fits(path), [])
        self.assertEqual(plot_leakage.read_fits(self.folder / "none.csv"), [])

    def test_odd_tables(self):
        self.assert_draws(HEADER, ROWS[0])
        self.assert_draws(HEADER, ROWS[2])
        self.assert_draws(HEADER, *ROWS[2:] * 3)
        self.assert_draws(HEADER, ROWS[0], ROWS[0].replace("1e-3", "1e-5"))
        self.assert_draws(HEADER, ROWS[0], "2,loading,0.1,0.3")
        self.assert_draws(HEADER, ROWS[0].replace("1e-3", "1e-300"), ROWS[1])
        self.assert_draws(HEADER, ROWS[0], ROWS[1].replace("ok", "contact"))
        self.assert_draws(HEADER, *ROWS, ROWS[0].replace("loading", "unloading"))
        self.assert_draws(HEADER, ROWS[0], ROWS[1].replace("1e-6", "nan"))
        self.assert_draws(HEADER, ROWS[0], ROWS[1].replace("9e-7,1.2e-6", "0,inf"))

    def test_tables_without_steps(self):
        for lines in ((), (HEADER,), ("step,pressure", "1,0.1")):
            self.write_table(*lines)
            status, message = self.draw()
            self.assertEqual(status, 0)
            self.assertEqual(message.count("\n"), 1, message)
            self.assertEqual(self.drawn(), [])

    def test_a_given_gap_has_no_load_to_draw_against(self):
        self.write_table("step,mean_gap,leak_rate", "1,1,0.5")
        self.assertEqual(self.draw(), (0, ""))
        self.assertEqual(self.drawn(), [])

    def test_units(self):
        for text in ('{"units": {"length": "m", "pressure": "Pa"}}', '{"units": 3}', '{', '[]'):
            (self.folder / "run.json").write_text(text)
            self.assert_draws(HEADER, *ROWS)
        self.assertEqual(plot_common.with_unit("Gap", "length", {"length": "m"}), "Gap (m)")
        self.assertEqual(plot_common.with_unit("Gap", "length", {}), "Gap (scene units)")
        self.assertEqual(plot_common.with_unit("Current", "current", {"length": "m"}), "Current")


    def test_leak_rate_in_the_unit_that_was_asked_for(self):
        header = HEADER.replace("leak_rate_upper", "leak_rate_upper,leak_rate_ml_per_h")
        rows = [ROWS[0].replace("1.1e-3", "1.1e-3,2e-3"), ROWS[1].replace("1.2e-6", "1.2e-6,2e-6")]
        (self.folder / "run.json").write_text(
            '{"units": {"leak_rate": "m³/s"}, "column_units": {"leak_rate_ml_per_h": "ml/h"}}')
        self.assert_draws(header, *rows)
        factor, units = plot_common.wanted_leak_rate(self.folder, {"leak_rate": "m³/s"})
        self.assertAlmostEqual(factor, 2)
        self.assertEqual(units, {"leak_rate": "ml/h"})
        self.write_table(HEADER, *ROWS)
        self.assertEqual(plot_common.wanted_leak_rate(self.folder, {"length": "m"}),
                         (1, {"length": "m"}))

    def test_colour_bars_read_well(self):
        axes = Figure().subplots()
        scale = plot_pictures.ScalarMappable(plot_pictures.Normalize(0, 2.5e-6))
        plot_pictures.add_colour_bars(axes, (5, 5), [(scale, "Gap", "length")], {"length": "m"})
        bar = axes.child_axes[0]
        self.assertEqual(bar.get_xlabel(), "Gap (µm)")
        self.assertEqual(bar.xaxis.get_major_formatter()(1e-6), "1")


class Pictures(PlotTest):
    """picture-STEP.png."""

    def assert_draws(self, fields, **about):
        """Draw one step; both panels."""
        write_picture(self.folder, 1, fields, **about)
        self.assertEqual(self.draw("--only", "pictures"), (0, ""))
        return panels_of(self.folder / "picture-1.png", about.get("lx", 1), about.get("ly", 1))

    def test_contact_is_black_and_nothing_else(self):
        for lx, ly, ny, nx in ((1, 1, 200, 200), (4, 1, 50, 200), (1, 3, 150, 50),
                               (50, 1, 40, 400)):
            fields = channel(ny, nx)
            for panel in self.assert_draws(fields, lx=lx, ly=ly, worst_x=np.nan):
                contact = np.mean(fields["open"] == 0)
                self.assertAlmostEqual(share(panel, plot_pictures.CONTACT), contact, delta=0.02)

    def test_size(self):
        self.assert_draws(channel(64, 64))
        self.assertEqual(imread(self.folder / "picture-1.png").shape[:2], (1117, 1890))

    def test_colours_are_where_they_belong(self):
        gap, flow = self.assert_draws(channel(200, 200), worst_x=np.nan)
        at = lambda pixels, x, y: pixels[int(y * len(pixels)), int(x * pixels.shape[1])]
        self.assertLess(at(flow, 0.5, 0.1).max(), 0.05)  # row 0 is at the bottom
        np.testing.assert_allclose(at(flow, 0.25, 0.25), np.divide(plot_pictures.POCKET, 255),
                                   atol=0.02)
        self.assertLess(at(gap, 0.25, 0.25).mean(), at(gap, 0.5, 0.7).mean())
        red, green, blue = at(flow, 0.05, 0.55)
        self.assertGreater(green, max(red, blue))
        red, green, blue = at(flow, 0.95, 0.55)
        self.assertGreater(blue, max(red, green))
        red, green, blue = at(flow, 0.5, 0.7)
        self.assertGreater(min(red, green), 0.7)
        self.assertLess(blue, 0.4)

    def test_worst_constriction_is_circled(self):
        _, bare = self.assert_draws(channel(64, 64), worst_x=np.nan)
        _, ringed = self.assert_draws(channel(64, 64))
        self.assertEqual(share(bare, (255, 255, 255)), 0)
        self.assertGreater(share(ringed, (255, 255, 255)), 1e-4)

    def test_sealed(self):
        fields = channel(100, 100, flow=False)
        fields["open"] = np.minimum(fields["open"], 1)
        _, flow = self.assert_draws(fields, percolates=0.0, leak_rate=0.0, worst_x=np.nan)
        pockets = np.mean(fields["open"] == 1)
        self.assertGreater(share(flow, (255, 255, 255)), 0.002)  # the word "sealed" on white
        self.assertAlmostEqual(share(flow, plot_pictures.POCKET), pockets, delta=0.03)

    def test_mesh_is_outlined_and_the_rest_masked(self):
        fields = channel(100, 100)
        outside = np.zeros((100, 100), dtype=bool)
        outside[:, :40] = True
        fields["open"][outside] = 3
        for name in ("fluid_pressure", "current"):
            fields[name][outside] = np.nan
        fields["outline"] = np.array([[0.4, 0, 0.4, 1, 0], [1, 0, 1, 1, 1], [0.4, 0, 1, 0, 2]])
        gap, flow = self.assert_draws(fields, direction="mesh", worst_x=None)
        self.assertAlmostEqual(share(flow, plot_pictures.OUTSIDE), 0.4, delta=0.03)
        # The gap is shown outside the mesh as well, with its contact.
        contact = np.mean(fields["gap"] <= 0)
        self.assertAlmostEqual(share(gap, plot_pictures.CONTACT), contact, delta=0.03)
        inlet = tuple(int(plot_pictures.OUTLINES[0]["color"][k:k + 2], 16) for k in (1, 3, 5))
        self.assertGreater(share(flow, inlet), 0.003)

    def test_dry_contact_shows_its_pressure(self):
        fields = channel(100, 100, flow=False)
        dry = dict.fromkeys(("worst_x", "worst_y", "leak_rate", "percolates"))
        gap, load = self.assert_draws(fields, **dry)
        contact = np.mean(fields["open"] == 0)
        self.assertAlmostEqual(share(gap, plot_pictures.CONTACT), contact, delta=0.02)
        self.assertAlmostEqual(share(load, (255, 255, 255)), 1 - contact, delta=0.02)
        self.assertAlmostEqual(share(load, (255, 243, 77)), contact, delta=0.02)

    def test_inlet_and_outlet_are_named_on_their_sides(self):
        above, beside = [], []
        for direction in "xy":
            self.assert_draws(channel(32, 32), direction=direction)
            pixels = imread(self.folder / "picture-1.png")[..., :3]
            above.append(np.mean(pixels[115:138, 1000:] < 0.5))
            beside.append(np.mean(pixels[150:920, 1822:1860] < 0.5))
        self.assertGreater(above[0], above[1])
        self.assertGreater(beside[1], beside[0])

    def test_headline_leaves_out_what_is_unknown(self):
        about = {"nominal_pressure": 0.1, "contact_area": 0.25, "leak_rate": 2e-9}
        self.assertEqual(plot_pictures.headline(about, {"pressure": "Pa"}).split("   ·   "),
                         ["nominal pressure 0.1 Pa", "contact area 25.0 %",
                          r"leak rate $2\times10^{-9}$"])
        self.assertTrue(plot_pictures.headline({**about, "validity": "steep+plastic"}, {})
                        .endswith("   ·   validity: steep+plastic"))
        about.update(nominal_pressure=2.5e5)
        self.assertTrue(plot_pictures.headline(about, {"pressure": "Pa", "leak_rate": "ml/h"})
                        .startswith("nominal pressure 250 kPa "))
        about.update(nominal_pressure=np.nan, leak_rate=np.nan)
        self.assertEqual(plot_pictures.headline(about, {}), "contact area 25.0 %")

    def test_given_gap(self):
        fields = channel(100, 100)
        del fields["pressure"]
        _, flow = self.assert_draws(fields, nominal_pressure=None, contact_area=None)
        self.assertGreater(share(flow, plot_pictures.POCKET), 0.02)

    def test_flow_stays_out_of_the_contact(self):
        fields = channel(100, 100)
        fields.update(fluid_pressure=np.full((100, 100), 0.5), current=np.ones((100, 100)))
        _, flow = self.assert_draws(fields, worst_x=np.nan)
        contact = np.mean(fields["open"] == 0)
        self.assertAlmostEqual(share(flow, plot_pictures.CONTACT), contact, delta=0.02)

    def test_odd_fields(self):
        flat = channel(32, 32)
        self.assert_draws(flat, inlet_pressure=2.0, outlet_pressure=2.0)
        self.assert_draws({**flat, "current": np.full((32, 32), np.nan)})
        self.assert_draws({**flat, "current": 1e-30 * flat["current"]})
        self.assert_draws({**flat, "fluid_pressure": np.full((32, 32), np.nan)})
        self.assert_draws(channel(32, 32, flow=False), percolates=0.0, direction="y")
        self.assert_draws({name: 0 * field for name, field in channel(32, 32, False).items()},
                          percolates=0.0)
        self.assert_draws(flat, title=np.bytes_("a $x_{$ b"), direction="y")
        self.assert_draws(channel(2, 5000))

    def test_a_full_disk_leaves_the_earlier_picture(self):
        write_picture(self.folder, 1, channel(16, 16))
        self.draw("--only", "pictures")
        before = (self.folder / "picture-1.png").read_bytes()
        limits = resource.getrlimit(resource.RLIMIT_FSIZE)
        resource.setrlimit(resource.RLIMIT_FSIZE, (len(before) // 2, limits[1]))
        try:
            status, message = self.draw("--only", "pictures")
        finally:
            resource.setrlimit(resource.RLIMIT_FSIZE, limits)
        self.assertEqual(status, 1)
        self.assertRegex(message, "cannot draw .*picture-1.h5: OSError: .*too large")
        self.assertEqual((self.folder / "picture-1.png").read_bytes(), before)
        self.assertEqual(len(list(self.folder.iterdir())), 2)

    def test_missing_and_broken_steps(self):
        write_picture(self.folder, 1, channel(32, 32))
        write_picture(self.folder, 12, channel(32, 32))
        status, message = self.draw("--steps", "12", "7")
        self.assertEqual(status, 1)
        self.assertEqual(message.count("\n"), 2, message)  # no leakage.csv, no step 7
        self.assertEqual(self.drawn(), ["picture-12.png"])
        (self.folder / "picture-3.h5").write_bytes(b"cut short")
        (self.folder / "picture-old.h5").write_bytes(b"not ours")
        status, message = self.draw("--only", "pictures")
        self.assertEqual(status, 1)
        self.assertEqual(message.count("\n"), 1, message)
        self.assertIn("picture-3.h5", message)
        self.assertEqual(self.drawn(), ["picture-1.png", "picture-12.png"])


class Ensemble(PlotTest):
    """ensemble.png."""

    HEADER = ("realisation,seed,orientation,critical_load_lower,critical_load_upper,contact_area,"
              "crossover_load,exponent,exponent_error,status\n")

    def write_realisation(self, number, factor, status="ok"):
        folder = self.folder / f"realisation-{number}"
        folder.mkdir()
        rows = [f"0.1,{reduced},{factor * reduced**3.45},{status}\n"
                for reduced in (0.5, 0.2, 0.1, 0.05)]
        (folder / "leakage.csv").write_text("pressure,reduced_load,leak_rate,status\n" +
                                            "".join(rows))

    def write_ensemble(self, *rows):
        (self.folder / "ensemble.csv").write_text(self.HEADER +
                                                  "".join(row + "\n" for row in rows))

    def test_curves_are_superposed(self):
        for number, factor in enumerate((1e-3, 1, 1e4), 1):
            self.write_realisation(number, factor)
        curves = plot_ensemble.read_curves(self.folder)
        factors, (low, high) = plot_ensemble.superpose(list(curves.values()))
        self.assertEqual((low, high), (0.05, 0.3))
        np.testing.assert_allclose(factors * [1e-3, 1, 1e4], np.full(3, 10**(1 / 3)))

    def test_picture(self):
        self.write_realisation(1, 1e-3)
        self.write_realisation(2, 1e-5, "unresolved-throat")
        self.write_ensemble("1,1,as is,0.23,0.2301,0.42,0.3,3.5,0.1,ok",
                            "2,1,inverted,0.25,0.2501,0.44,nan,nan,nan,ok")
        self.assertEqual(self.draw(), (0, ""))
        self.assertEqual(self.drawn(), ["ensemble.png"])
        self.assertGreater(np.mean(imread(self.folder / "ensemble.png")[..., :3] < 0.9), 0.002)

    def test_samples(self):
        self.write_ensemble("1,1,as is,0.2,0.3,0.4,0.2,nan,nan,ok",
                            "2,2,rotated,nan,nan,nan,nan,nan,nan,threshold-not-found")
        table = plot_leakage.read_table(self.folder / "ensemble.csv")
        self.assertEqual(list(plot_ensemble.samples(table, "critical_load")), [0.25])
        self.assertEqual(list(plot_ensemble.samples(table, "crossover")), [0.8])

    def test_quantities_in_units_that_read_well(self):
        table = {"critical_load_lower": np.array([2e5, 2.2e5]),
                 "critical_load_upper": np.array([2e5, 2.2e5])}
        table.update(contact_area=np.ones(2), crossover_load=np.ones(2))
        quantity = ("critical_load", "Critical load", "pressure")
        for units, label, first in (({"pressure": "Pa"}, "Critical load (kPa)", 200),
                                    ({}, "Critical load (scene units)", 2e5)):
            values, text = plot_ensemble.strip_of(table, *quantity, units)
            self.assertEqual((text, values[0]), (label, first))

    def test_a_whole_seal(self):
        header = ("pressure,leak_rate_median,leak_rate_5_percent,leak_rate_95_percent,unit,"
                  "sealed\n")
        self.write_ensemble("1,1,as is,nan,nan,nan,nan,nan,nan,ok")
        (self.folder / "realisation-1").mkdir()
        (self.folder / "realisation-1" / "leakage.csv").write_text("pressure,leak_rate\n1,2\n")
        (self.folder / "seal_load.csv").write_text(
            "wanted_leak_rate,unit,load,load_5_percent,load_95_percent\n1,ml/h,1.5,nan,2\n")
        for rows in ("1,3,2,4,ml/h,0\n2,0.5,0.1,0.9,ml/h,0\n3,0,0,0.2,ml/h,0.6\n",
                     "1,0,0,0,ml/h,1\n", "1,2,1,3,,0\n"):
            (self.folder / "seal.csv").write_text(header + rows)
            self.assertEqual(self.draw(), (0, ""))
            self.assertEqual(self.drawn(), ["seal.png"])
            pixels = imread(self.folder / "seal.png")[..., :3]
            self.assertEqual(share(pixels, (0, 114, 178)) > 1e-4, "1,0,0,0" not in rows)

    def test_curves_of_an_earlier_run_are_left_out(self):
        for number in (1, 2, 3):
            self.write_realisation(number, 1)
        self.write_ensemble("1,1,as is,0.2,0.3,0.4,0.2,nan,nan,ok",
                            "3,3,as is,0.2,0.3,0.4,0.2,nan,nan,ok")
        self.assertEqual(list(plot_ensemble.read_curves(self.folder)), [1, 3])

    def test_curves_of_negative_leak_rates(self):
        self.write_realisation(1, -1e-3)
        _, leak, _ = plot_ensemble.read_curves(self.folder)[1]
        np.testing.assert_allclose(leak[-1], 1e-3 * 0.5**3.45)

    def test_odd_ensembles(self):
        self.write_realisation(1, 1)
        self.write_ensemble("1,1,as is,nan,nan,nan,nan,nan,nan,threshold-not-found")
        self.assertEqual(self.draw(), (0, ""))  # one curve, no threshold
        for text, lines in (("pressure\n1\n", 1),   # no threshold was sought
                            ("pressure,reduced_load\n1,0.5\n", 2)):   # nor is that a table
            (self.folder / "realisation-1" / "leakage.csv").write_text(text)
            status, message = self.draw()
            self.assertEqual((status, message.count("\n")), (0, lines), message)


class CommandLine(PlotTest):
    """The script as the program calls it."""

    def run_script(self):
        return subprocess.run([sys.executable, SCRIPT, self.folder], check=False,
                              capture_output=True, text=True, timeout=120)

    def test_folder_without_results(self):
        done = self.run_script()
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)

    def test_everything_at_once(self):
        self.write_table(HEADER, *ROWS)
        write_picture(self.folder, 1, channel(64, 64))
        done = self.run_script()
        self.assertEqual((done.returncode, done.stdout), (0, ""), done.stderr)
        self.assertEqual(self.drawn(), ["leakage.png", "picture-1.png"])


if __name__ == "__main__":
    unittest.main()
