#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Check that results do not depend on place, orientation, units, or repetition.

    hard_cases.py --program P --mpirun M --folder F [--case NAME]

A small rough seal is computed as it is and, in turn, shifted across the flow, mirrored,
rotated with the flow, in other units, and once more. The results must be the same, to the
last bit where only powers of two differ. Steps within 1e-10 of the critical load must agree
with each other. With each optional effect, the seal is mirrored, rotated, and set twice side
by side.
"""
import argparse
import csv
import json
import os
import re
import shutil
import subprocess
import sys

import h5py
import numpy as np

SIZE = {"x": 1.25, "y": 1.0}
POINTS = {"x": 40, "y": 32}
LENGTHS = {"mean_gap": 1, "effective_gap": 1, "worst_constriction_gap": 1,
           "leak_rate": 3, "leak_rate_lower": 3, "leak_rate_upper": 3}
SAME = ["percolates", "contact_area", "contact_area_corrected", "status"]


def rough_map(factor=1):
    """Heights of shape (ny, nx), `factor` times as fine as POINTS: waves of random phase, at
    least 8 `factor` points long along each axis."""
    random = np.random.default_rng(7)
    ny, nx = POINTS["y"] * factor, POINTS["x"] * factor
    y, x = np.mgrid[0:ny, 0:nx]
    heights = np.zeros((ny, nx))
    for m in range(-4, 5):
        for n in range(0, 6):
            q = np.hypot(n / SIZE["x"], m / SIZE["y"])
            if q > 0:
                phase = random.uniform(0, 2 * np.pi)
                heights += q**-1.8 * np.cos(2 * np.pi * (n * x / nx + m * y / ny) + phase)
    return heights * 0.02


class Seal:
    """A scene as nested dictionaries, and its height map."""

    def __init__(self, heights):
        self.heights = heights
        self.size = [SIZE["x"], SIZE["y"]]
        self.modulus = 1.
        self.pressures = [0.02, 0.06, 0.12, 0.4]
        self.fluid = {"Direction": "x", "Viscosity": 1., "Inlet pressure": 1.,
                      "Target accuracy": 0.05}
        self.contact = {}
        self.output = {}

    def text(self, map_name):
        ny, nx = self.heights.shape
        sections = {
            "Surface": {"Kind": "file", "File": map_name, "Height unit": "scene",
                        "Size": "{!r}, {!r}".format(*self.size)},
            "Contact": {"Grid points": f"{nx}, {ny}",
                        "Effective modulus": repr(self.modulus), **self.contact},
            "Fluid": self.fluid,
            "Load programme": {"Pressures": ", ".join(map(repr, self.pressures))},
            "Output": {"Pictures": "false", **self.output}}
        def lines(rows):
            for key, value in rows.items():
                if isinstance(value, dict):
                    yield from (f"subsection {key}\n", *lines(value), "end\n")
                else:
                    yield f"set {key} = {value}\n"
        return "".join(lines(sections))


class Runner:
    def __init__(self, options):
        self.options = options

    def run(self, name, seal, ranks=1, statuses=(0,)):
        """The rows of leakage.csv, and the folder of the results."""
        folder = os.path.join(self.options.folder, name)
        os.makedirs(folder)
        np.save(os.path.join(folder, "map.npy"), seal.heights)
        with open(os.path.join(folder, "scene.prm"), "w", encoding="utf-8") as file:
            file.write(seal.text("map.npy"))
        command = [self.options.program, "--quiet", "scene.prm"]
        if ranks > 1:
            command = [self.options.mpirun, "--quiet", "-np", str(ranks)] + command
        done = subprocess.run(command, cwd=folder, text=True, capture_output=True,
                              timeout=120, check=False)
        if done.returncode not in statuses:
            raise RuntimeError(f"{name} ended with status {done.returncode}: "
                               f"{done.stderr}")
        output = os.path.join(folder, "output")
        with open(os.path.join(output, "leakage.csv"), encoding="utf-8") as file:
            return list(csv.DictReader(file)), output


def differences(reference, rows, rtol, length=1., others=None, leave_out=()):
    """Complaints about rows that differ from the reference by more than a relative `rtol`.
    Lengths must be `length` times those of the reference, and `others` has the factors of
    further columns."""
    others = others or {}
    complaints = []
    if len(reference) != len(rows):
        return [f"{len(rows)} rows instead of {len(reference)}"]
    for number, (a, b) in enumerate(zip(reference, rows), start=1):
        for name in [*LENGTHS, *SAME]:
            if name in leave_out:
                continue
            if a[name] == b[name] == "nan" or name == "status":
                if a[name] != b[name]:
                    complaints.append(f"row {number}: {name} {a[name]} and {b[name]}")
                continue
            expected = float(a[name]) * length**LENGTHS.get(name, 0) * others.get(name, 1.)
            # A cube root may be rounded differently.
            allowed = max(rtol, 4e-16 if name == "effective_gap" else 0.)
            if not abs(float(b[name]) - expected) <= allowed * abs(expected):
                complaints.append(f"row {number}: {name} is {b[name]}, expected "
                                  f"{expected!r}")
    return complaints


def differences_moved(reference, rows, rtol=1e-6, leak_rate=1., leave_out=()):
    """Complaints about rows whose flow is on another mesh. Their brackets, divided by the
    factor `leak_rate`, need only overlap with those of the reference, after widening by the
    errors of the leak rate where the tables have them."""
    complaints = differences(reference, rows, rtol, leave_out=[
        "leak_rate", "leak_rate_lower", "leak_rate_upper", "effective_gap", *leave_out])
    for number, (a, b) in enumerate(zip(reference, rows), start=1):
        low = max(float(a["leak_rate_lower"]), float(b["leak_rate_lower"]) / leak_rate)
        high = min(float(a["leak_rate_upper"]), float(b["leak_rate_upper"]) / leak_rate)
        error = np.nansum([float(row.get("leak_rate_error", 0.)) for row in (a, b)])
        if not low <= high * (1 + 1e-6 + error):
            complaints.append(f"row {number}: the brackets of the leak rate do not "
                              f"overlap: {low} > {high}")
    return complaints


def shifted(runner, base):
    """Shifted by 1, 7, 16 and 31 points across the flow."""
    complaints = []
    for points in (1, 7, 16, 31):
        seal = Seal(np.roll(rough_map(), points, axis=0))
        rows, _ = runner.run(f"shifted_{points}", seal)
        complaints += differences_moved(base, rows)
    return complaints


def mirrored(runner, base):
    """Mirrored across the flow, and along it, which reverses the flow."""
    complaints = []
    for axis in (0, 1):
        # The grid point at the inlet stays where it is.
        seal = Seal(np.roll(np.flip(rough_map(), axis), 1, axis))
        rows, _ = runner.run(f"mirrored_{axis}", seal)
        complaints += differences_moved(base, rows)
    return complaints


def rotated(runner, base):
    """Rotated by 90 degrees, with the direction of the flow."""
    seal = Seal(np.ascontiguousarray(rough_map().T))
    seal.size.reverse()
    seal.fluid["Direction"] = "y"
    rows, _ = runner.run("rotated", seal)
    return differences(base, rows, 1e-6)


def in_other_units(runner, base):
    """Heights, all lengths, and pressures in turn times 2^-40 and 2^40, about 1e-12 and
    1e12: powers of two, so that nothing is rounded."""
    complaints = []
    for power in (-40, 40):
        factor = 2.**power
        seal = Seal(rough_map() * factor)
        seal.modulus /= factor
        rows, _ = runner.run(f"heights_{power}", seal)
        complaints += differences(base, rows, 0., factor)

        seal = Seal(rough_map() * factor)
        seal.size = [side * factor for side in seal.size]
        rows, _ = runner.run(f"lengths_{power}", seal)
        complaints += differences(base, rows, 0., factor)

        seal = Seal(rough_map())
        seal.modulus *= factor
        seal.pressures = [pressure * factor for pressure in seal.pressures]
        seal.fluid["Inlet pressure"] = 2.**-power
        seal.fluid["Viscosity"] = factor
        rows, _ = runner.run(f"pressures_{power}", seal)
        flow = dict.fromkeys(["leak_rate", "leak_rate_lower", "leak_rate_upper"],
                             factor**-2)
        complaints += differences(base, rows, 0., others=flow)
    return complaints


def content_of(file):
    """All data sets and attributes of an HDF5 file, without the time stamps in it."""
    items = {}

    def visit(name, item):
        if isinstance(item, h5py.Dataset):
            items[name] = (item.shape, item.dtype.str, item[...].tobytes())
        items[name + " attributes"] = [(key, repr(value))
                                       for key, value in sorted(item.attrs.items())]

    with h5py.File(file, "r") as root:
        root.visititems(visit)
    return items


def without_times(file):
    """The content of a result file without times and dates."""
    name = os.path.basename(file)
    if name.endswith(".h5"):
        return content_of(file)
    with open(file, "rb") as stream:
        content = stream.read()
    if name.endswith(("vtu", ".pvd")):
        return re.sub(rb"<!--.*?-->", b"", content, flags=re.DOTALL)
    if name.endswith(".csv"):
        rows = list(csv.reader(content.decode().splitlines()))
        kept = [i for i, title in enumerate(rows[0]) if not title.endswith("_seconds")]
        return [[row[i] for i in kept] for row in rows]
    if name == "run.json":
        def strip(value):
            if isinstance(value, dict):
                return {key: strip(entry) for key, entry in value.items()
                        if key not in ("seconds", "bytes_per_grid_point")}
            return value
        return strip(json.loads(content))
    if name == "log.txt":
        return re.sub(rb" *[0-9.e+-]+ *(m?s|min|h)\b", b" TIME", content)
    return content


def repeated(runner, _):
    """Computed twice on equally many ranks: the same files except for times."""
    complaints = []
    for ranks in (1, 2):
        outputs = []
        for attempt in ("first", "second"):
            seal = Seal(rough_map())
            seal.output["Fields"] = "all"
            _, output = runner.run(f"repeated_on_{ranks}", seal, ranks)
            # Run both in the same folder, as some files name it.
            kept = os.path.join(runner.options.folder, f"{attempt}_on_{ranks}")
            outputs.append(shutil.move(output, kept))
            shutil.rmtree(os.path.dirname(output))
        names = [sorted(os.path.relpath(os.path.join(path, file), output)
                        for path, _, files in os.walk(output) for file in files)
                 for output in outputs]
        if names[0] != names[1]:
            complaints.append(f"{ranks} ranks: other files: {names}")
            continue
        for name in names[0]:
            first, second = (without_times(os.path.join(output, name))
                             for output in outputs)
            if first != second:
                complaints.append(f"{ranks} ranks: {name} is not the same twice")
    return complaints


def at_threshold(runner, _):
    """At loads within 1e-10 of the critical load, where the throat is nearly closed."""
    seal = Seal(rough_map())
    seal.contact = {"Tolerance": 1e-13}
    search = Seal(rough_map())
    search.contact = seal.contact
    text = search.text
    search.text = lambda name: text(name) + (
        "subsection Load programme\n  set Find threshold = true\n"
        "  set Threshold tolerance = 1e-9\nend\n")
    _, output = runner.run("search", search)
    with open(os.path.join(output, "threshold.csv"), encoding="utf-8") as file:
        found = next(csv.DictReader(file))
    lower = float(found["critical_load_lower"])
    upper = float(found["critical_load_upper"])
    seal.fluid["Maximum unknowns"] = 40000
    seal.pressures = [lower * (1 - 1e-3), lower * (1 - 1e-10),
                      *np.linspace(lower, upper, 11).tolist(), upper * (1 + 1e-10)]
    # The cells may be too coarse for such a throat; then the bracket is wide.
    rows, _ = runner.run("threshold", seal, statuses=(0, 1))
    seal.pressures = seal.pressures[:2]
    seal.fluid["Target accuracy"] = 0.005
    closer, _ = runner.run("threshold_closer", seal, statuses=(0, 1))
    is_open = [int(row["percolates"]) for row in rows]
    complaints = []
    if is_open[0] != 1 or is_open[-1] != 0 or is_open != sorted(is_open, reverse=True):
        complaints.append(f"open and sealed from {lower!r} to {upper!r}: {is_open}")
    for row in rows:
        if row["status"] not in ("ok", "flow-accuracy") or not (
                float(row["leak_rate_lower"]) <= float(row["leak_rate"])
                <= float(row["leak_rate_upper"])):
            complaints.append(f"at {row['pressure']} the leak rate is not in its bounds: "
                              f"{row['status']}")
        if (float(row["leak_rate"]) > 0) != (row["percolates"] == "1"):
            complaints.append(f"at {row['pressure']} verdict and leak rate disagree")
    for a, b in zip(rows, closer):
        if not (float(a["leak_rate_lower"]) <= float(b["leak_rate_upper"])
                and float(b["leak_rate_lower"]) <= float(a["leak_rate_upper"])):
            complaints.append(f"at {a['pressure']} brackets of other widths contradict "
                              "each other")
    return complaints


EFFECTS = {
    "slip": {"fluid": {"Slip length": "-5e-4"}},
    "gas": {"fluid": {"State": "gas", "Inlet pressure": 2., "Outlet pressure": 1.}},
    "yields": {"contact": {"Hardness": 0.6, "Yielding": "cut-off"}},
    "adhesion": {"contact": {"Adhesion": {"Enabled": "true", "Surface energy": 1e-4,
                                          "Range": 5e-3}}},
    "zoom": {"contact": {"Zoom": {"Enabled": "true"}}},
    "feedback": {"fluid": {"Inlet pressure": 0.01,
                           "Wall feedback": {"Enabled": "true"}}},
    "trapped": {"fluid": {"Inlet pressure": 0.01,
                          "Wall feedback": {"Enabled": "true",
                                            "Trapped fluid": "incompressible"}}}}


def with_effects(runner, _):
    """With each optional effect: mirrored across the flow, rotated, and twice side by side."""
    complaints = []
    for name, effect in EFFECTS.items():
        zooms = name == "zoom"
        heights = rough_map(3 if zooms else 1)

        def rows_of(what, heights, twice=False, rotated=False):
            seal = Seal(heights)
            seal.contact = effect.get("contact", {})
            seal.fluid.update(effect.get("fluid", {}))
            seal.size[1] *= 2 if twice else 1
            if rotated:
                seal.size.reverse()
                seal.fluid["Direction"] = "y"
            return runner.run(f"{name}_{what}", seal)[0]

        base = rows_of("base", heights)
        # Windows are not mirrored exactly, and feedback has a tolerance.
        rtol = 1e-3 if zooms else 1e-4 if name in ("feedback", "trapped") else 1e-6
        mirror = np.roll(np.flip(heights, 0), 1, 0)
        found = [*differences_moved(base, rows_of("mirrored", mirror), rtol),
                 *differences_moved(base, rows_of("rotated", heights.T.copy(),
                                                  rotated=True), rtol),
                 *differences_moved(base, rows_of("twice", np.tile(heights, (2, 1)),
                                                  twice=True), rtol, 2.)]
        complaints += [f"{name}: {complaint}" for complaint in found]
    return complaints


CASES = [shifted, mirrored, rotated, in_other_units, repeated, at_threshold, with_effects]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", required=True, type=os.path.abspath)
    parser.add_argument("--mpirun", default="mpirun")
    parser.add_argument("--folder", required=True, type=os.path.abspath)
    parser.add_argument("--case", choices=[case.__name__ for case in CASES])
    options = parser.parse_args()
    shutil.rmtree(options.folder, ignore_errors=True)
    os.makedirs(options.folder)
    runner = Runner(options)
    base, _ = runner.run("base", Seal(rough_map()))
    if {row["percolates"] for row in base} != {"0", "1"}:
        print("FAILED: the seal should leak at some of the loads and not at others")
        return 1
    failures = 0
    for case in CASES:
        if options.case not in (None, case.__name__):
            continue
        complaints = case(runner, base)
        failures += bool(complaints)
        print(f"{'FAILED' if complaints else 'passed'}: {case.__name__}")
        for complaint in complaints:
            print("    " + complaint)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
