#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""The leak rate of a whole seal from the realisations of a run: seal.csv and seal_load.csv.

Reads parameters.prm and the folders of the realisations; see doc/seal.md. Exit status 1 with a
sentence where something is missing.
"""
import argparse
import csv
import math
import pathlib
import sys

try:
    import numpy as np

    from plot_common import is_trusted, read_parameters
    from seal_network import Band, at_loads
    from strait_results import Run
except ImportError as missing:
    sys.exit(f"whole_seal.py: the Python module {missing.name} is missing; "
             "install python3-numpy, python3-scipy and python3-matplotlib.")

# Patches shorter than this many of the longest waves are neither representative nor uncoupled:
# at four, waves longer than a patch, which no patch has, would carry 3 % of the variance of the
# heights for a Hurst exponent of 0.8 and a flat spectrum beyond; 11 % at two, 0.7 % at eight.
LEAST_WAVES = 4


def scene_in(folder):
    """The text of the scene whose results a folder holds."""
    return (folder / "parameters.prm").read_text(encoding="utf-8")


def box_of(values):
    """Sides of the box of a scene, along the flow and across."""
    sizes = [float(size) for size in values["Surface/Size"].split(",")]
    return (sizes[0], sizes[-1]) if values["Fluid/Direction"] == "x" else (sizes[-1], sizes[0])


class Seal:
    """What the scene says of the seal."""

    def __init__(self, scene):
        values = read_parameters(scene)
        self.loads = np.unique([float(load) for load in
                                values["Load programme/Pressures"].split(",") if load.strip()])
        self.circumference = float(values["Seal/Circumference"])
        self.width = float(values["Seal/Contact width"])
        self.isotropic = values["Seal/Isotropic"] == "true"
        self.wanted = float(values["Seal/Wanted leak rate"])
        self.profile = values["Seal/Pressure profile"]
        self.length, self.breadth = box_of(values)
        self.n_along = max(1, round(self.width / self.length))
        self.n_around = max(1, round(self.circumference / self.breadth))
        self.roll_off = (float(values["Surface/Roll-off wavelength"])
                         if values["Surface/Kind"] == "self-affine" else None)
        units = values["Output/Leak rate units"].split(",")
        self.unit = units[0].strip()

    def profile_values(self, places):
        """Pressure over its mean at places from 0 to 1 across the width, and the mean."""
        if not self.profile:
            return np.ones_like(places), None
        if self.profile == "hertz":
            return 4 / math.pi * np.sqrt(np.clip(1 - (2 * places - 1)**2, 0, None)), None
        x, p = read_profile(self.profile)
        if abs(np.ptp(x) / self.width - 1) > 0.01:
            sys.exit(f"Seal/Pressure profile = {self.profile} spans {np.ptp(x):.6g}, and "
                     f"Seal/Contact width is {self.width:.6g}; make them the same.")
        mean = np.trapz(p, x) / np.ptp(x)
        return np.interp(places, (x - x[0]) / np.ptp(x), p) / mean, mean

    def columns(self):
        """Pressure over its mean at the patches, one after the other along the flow; at those in
        between, which lead around; and the table's own mean pressure, if there is one."""
        fine = 64 * self.n_along
        values, mean = self.profile_values((np.arange(fine) + 0.5) / fine)
        halves = values.reshape(2 * self.n_along, -1).mean(axis=1)
        return (halves[::2] + halves[1::2]) / 2, (halves[1:-1:2] + halves[2::2]) / 2, mean

    def rows(self):
        """The mean loads for which the patches know the pressures of the whole profile."""
        along, _, mean = self.columns()
        wanted = self.loads if mean is None else np.union1d(self.loads, [mean])
        # Rounding of the profile must not cost the first load and the last.
        inside = ((wanted * along.min() >= self.loads[0] * (1 - 1e-9)) &
                  (wanted * along.max() <= self.loads[-1] * (1 + 1e-9)))
        if len(self.loads) < 2 and not np.allclose(along, 1):
            inside[:] = False
        if not inside.any() or (mean is not None and not inside[wanted == mean].all()):
            load = self.loads.mean() if mean is None else mean
            sys.exit(f"Under a mean pressure of {load:.6g} Seal/Pressure profile presses the "
                     f"patches by {load * along.min():.6g} to {load * along.max():.6g}; let Load "
                     "programme/Pressures begin below and end above that, as nothing is "
                     "extrapolated.")
        return wanted[inside]


def read_profile(path):
    """Positions and pressures of a table of two columns; lines without two numbers are headers."""
    rows = []
    try:
        text = pathlib.Path(path).read_text(encoding="utf-8", errors="replace")
    except OSError as error:
        sys.exit(f"Seal/Pressure profile: {error}.")
    for line in text.splitlines():
        try:
            x, p = (float(word) for word in line.replace(",", " ").replace(";", " ").split()[:2])
            rows.append((x, p))
        except ValueError:
            continue
    x, p = np.array(rows).reshape(-1, 2).T
    if len(x) < 2 or not (np.diff(x) > 0).all() or not (p >= 0).all() or not p.any() \
            or not np.isfinite([x, p]).all():
        sys.exit(f"Seal/Pressure profile = {path} must hold two or more lines of a position that "
                 "grows and a pressure that is not negative.")
    return x, p


class Patches:
    """What the realisations conduct: squares under the seal's pressure drop, at all loads."""

    def __init__(self, folder, seal):
        self.along, self.across, self.errors, self.dropped = [], [], [], []
        self.factor, self.unit, self.load_unit, solution_sources = 1., "", "", set()
        paths = sorted(folder.glob("realisation-*"), key=lambda path: int(path.name[12:]))
        for path in paths:
            try:
                run, values = Run(path), read_parameters(scene_in(path))
                conductances, errors = self._of_loads(run, box_of(values), seal)
            except (OSError, KeyError, ValueError) as problem:
                self.dropped.append(f"{path.name} ({problem})")
                continue
            rotated = values["Surface/Rotate"] == "true"
            (self.across if rotated and not seal.isotropic else self.along).append(conductances)
            self.errors.append(errors)
            solution_sources.add("grid" if "leak_rate_error" in run.table else "mesh")
            self._take_unit(run, seal)
        if len(self.along) < 2:
            sys.exit("The whole seal needs two patches along the flow with leak rates at all "
                     f"loads, and there are {len(self.along)}" +
                     (": " + "; ".join(self.dropped) if self.dropped else "") + ".")
        self.along = np.array(self.along)
        self.across = np.array(self.across) if self.across else self.along
        self.knows_grid = solution_sources == {"grid"}

    @staticmethod
    def _of_loads(run, box, seal):
        table, (length, breadth) = run.table, box
        conductances, errors = [], []
        for load in seal.loads:
            row = np.flatnonzero(np.isclose(table["pressure"], load, rtol=1e-9))[:1]
            if not row.size or not is_trusted(table["status"][row]).all():
                raise ValueError(f"no leak rate at {load:.6g}")
            rate, low, high = (abs(float(table[name][row[0]])) for name in
                               ("leak_rate", "leak_rate_lower", "leak_rate_upper"))
            conductances.append(rate * length / breadth)
            known = float(table.get("leak_rate_error", np.full(row[0] + 1, np.nan))[row[0]])
            errors.append(0. if rate == 0 else known if np.isfinite(known)
                          else 0.5 * (high - low) / rate)
        return conductances, errors

    def _take_unit(self, run, seal):
        """The unit that was asked for, and what a leak rate of the scene is in it."""
        self.unit = run.unit("leak_rate")
        self.load_unit = f" {run.unit('pressure')}".rstrip()  # as it follows a number
        if not seal.unit:
            return
        column = "leak_rate_" + seal.unit.replace("/", "_per_").replace(" ", "_")
        leaks = np.flatnonzero(run.table["leak_rate"] != 0)
        if leaks.size:
            self.factor = run.table[column][leaks[0]] / run.table["leak_rate"][leaks[0]]
        self.unit = seal.unit


def bands_of(seal, patches):
    """(load, Band) of each load that the patches cover."""
    along, across, _ = seal.columns()
    scale = patches.factor * seal.circumference / seal.width
    rng = np.random.default_rng(1)
    errors = np.mean(patches.errors, axis=0)
    for load in seal.rows():
        k_along, k_across = ((scale * at_loads(seal.loads, pool, load * np.asarray(columns)))
                             if len(seal.loads) > 1 else np.repeat(scale * pool, len(columns), 1)
                             for pool, columns in ((patches.along, along),
                                                   (patches.across, across)))
        yield load, Band(k_along, k_across, seal.n_around, seal.breadth / seal.length,
                         float(np.interp(load, seal.loads, errors)), rng)


def crossing(loads, rates, wanted):
    """The load at which a falling leak rate passes the wanted one; NaN beyond the loads."""
    for k in np.flatnonzero((rates[:-1] > wanted) & (rates[1:] <= wanted)):
        (a, b), (la, lb) = rates[k:k + 2], loads[k:k + 2]
        part = math.log(a / wanted) / math.log(a / b) if b > 0 else (a - wanted) / (a - b)
        return la + part * (lb - la)
    return math.nan


def verdict(load, band, patches):
    """What dominates the uncertainty, and what to do about it: one sentence."""
    n, load = len(patches.along), f"{load:.6g}{patches.load_unit}"
    parts = {"patches": 1.645 * band.student * band.patches, "seal": 1.645 * band.arrangement,
             "solution": band.solution}
    most = max(parts, key=parts.get)
    factor = f"a factor of {math.exp(parts[most]):.3g}"
    if band.median == 0:
        return (f"at {load} most seals do not leak at all: what leaks is decided by few "
                "patches; simulate more of them (Realisations/Seeds)")
    if most == "patches":
        return (f"most of the uncertainty at {load}, {factor} each way, comes from the number "
                f"of patches: {4 * n} in place of {n} would about halve it (Realisations/Seeds)")
    if most == "seal":
        return (f"most of the uncertainty at {load}, {factor} each way, is that of the seal "
                "itself: seals of this size differ so much, and no more patches narrow it")
    advice = ("Contact/Grid points, Contact/Zoom or Fluid/Target accuracy, as their logs say"
              if patches.knows_grid else "Fluid/Target accuracy")
    return (f"most of the uncertainty at {load}, {factor} each way, comes from the solutions "
            f"of the patches: improve {advice}")


def doubts(seal, patches):
    """What the band does not know of."""
    if patches.dropped:
        yield f"left out: {'; '.join(patches.dropped)}"
    side = min(seal.length, seal.breadth)
    if seal.roll_off and side < LEAST_WAVES * seal.roll_off * (1 - 1e-9):
        yield (f"patches of {side:.4g} are {side / seal.roll_off:.3g} roll-off wavelengths long, "
               f"where {LEAST_WAVES} are needed: longer waves couple neighbours and are missing, "
               "which the band does not know of; enlarge Surface/Size")
    if seal.roll_off is None:
        yield ("whether patches of this size are independent is not known of a measured map: "
               "compare with patches twice as large")
    if seal.n_along * seal.length > 1.5 * seal.width:
        yield f"a patch is longer than the contact is wide ({seal.width:.4g})"
    if not patches.knows_grid:
        yield ("the error of the contact grid is not in the band; Output/Error budget = true "
               "estimates it")


def write(path, header, rows):
    """A table, whose columns doc/results.md defines."""
    with open(path, "w", newline="", encoding="utf-8") as file:
        csv.writer(file, lineterminator="\n").writerows([header, *rows])


def assess(folder):
    """Write the tables and say what they mean."""
    seal = Seal(scene_in(folder))
    patches = Patches(folder, seal)
    bands = list(bands_of(seal, patches))
    write(folder / "seal.csv",
          ("pressure", "leak_rate_median", "leak_rate_5_percent", "leak_rate_95_percent", "unit",
           "sealed", "scatter_patches", "scatter_arrangement", "solution_error"),
          [(load, band.median, band.lower, band.upper, patches.unit, band.sealed, band.patches,
            band.arrangement, band.solution) for load, band in bands])
    unit, load_unit = patches.unit or "in the scene's units", patches.load_unit
    print(f"whole seal: {seal.n_along} × {seal.n_around} patches, drawn from "
          f"{len(patches.along)} along the flow and {len(patches.across)} across")
    for load, band in bands:
        print(f"  under {load:.6g}{load_unit}: {band.median:.4g} {unit}, "
              f"90 % between {band.lower:.4g} and {band.upper:.4g}")
    print("  " + verdict(*bands[-1], patches))
    if seal.wanted > 0:
        loads = np.array([load for load, _ in bands])
        found = [crossing(loads, np.array([getattr(band, name) for _, band in bands]), seal.wanted)
                 for name in ("median", "lower", "upper")]
        write(folder / "seal_load.csv",
              ("wanted_leak_rate", "unit", "load", "load_5_percent", "load_95_percent"),
              [(seal.wanted, patches.unit, *found)])
        print(f"  {seal.wanted:.4g} {unit}: under {found[0]:.4g}{load_unit}, 90 % between "
              f"{found[1]:.4g} and {found[2]:.4g}" +
              ("; nan: beyond these loads" if np.isnan(found).any() else ""))
    for doubt in doubts(seal, patches):
        print("  warning: " + doubt)


def main():
    """Read the command line; the exit status is 0 unless a sentence ended it."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("folder", metavar="OUTPUT_DIR", type=pathlib.Path, nargs="?")
    parser.add_argument("--check", action="store_true",
                        help="only check the pressure profile of the scene on standard input")
    options = parser.parse_args()
    if options.check:
        Seal(sys.stdin.read()).rows()
    elif options.folder:
        assess(options.folder)
    else:
        parser.error("which results?")


if __name__ == "__main__":
    main()
