#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""The leak rate of a whole seal from the realisations of a run: seal.csv and seal_load.csv.

Reads parameters.prm and the folders of the realisations; see doc/seal.md. Exit status 1 with a
sentence if something is missing.
"""
import argparse
import math
import pathlib
import sys

try:
    import numpy as np

    from report_results import relative_errors
    from run_folder import (at_load, has_bounds, leak_rates, nearest_slip, read_parameters,
                            realisations, scene_in, write_table)
    from seal_network import Band, at_loads, matrix_bytes
    from seal_scene import Seal, box_of
    from strait_results import Run
except ImportError as missing:
    sys.exit(f"whole_seal.py: the Python module {missing.name} is missing; "
             "install python3-numpy and python3-scipy.")

# Patches shorter than this many roll-off wavelengths are neither representative nor uncoupled: at
# four, the waves longer than a patch, which no patch has, would carry 3 % of the variance of the
# heights, for a Hurst exponent of 0.8 and a flat spectrum beyond; 11 % at two, 0.7 % at eight.
LEAST_WAVES = 4
# Loads inserted between the two that enclose the wanted leak rate. Half as many and twice as many
# change the load found for prm/oring_seal.prm by a hundredth, no more than other random seals do,
# and take half and twice the time.
N_BETWEEN = 7
# Most memory for the matrix of a network. It allows 315 patches along the flow, where the 800
# networks of one load take hours.
MOST_BYTES = 1e9


def seal_of(scene):
    """The seal of a scene; exits if the matrix of its network takes too much memory."""
    seal = Seal(scene)
    size = matrix_bytes(seal.n_along, seal.n_around)
    if size > MOST_BYTES:
        sys.exit(f"Seal/Contact width = {seal.width:.6g} is {seal.n_along} patches of "
                 f"{seal.length:.6g}, whose network takes a matrix of {size / 1e9:.3g} GB, where "
                 f"{MOST_BYTES / 1e9:.3g} are allowed; enlarge Surface/Size.")
    return seal


def in_endless_row(alone, two, error_alone, error_two):
    """Leak rate of a box in an endless row, and its error, from those of one box and of two.

    The difference of the two resistances is that of a box without the effect of its ends. It is not
    less than the resistance of one box: a reservoir between two would be a short circuit.
    """
    with np.errstate(divide="ignore", invalid="ignore"):
        resistance, of_two = 1 / alone, 1 / two
        difference = np.where(two > 0, of_two - resistance, np.inf)
        error = (of_two * error_two + resistance * error_alone) / difference
    difference = np.maximum(difference, resistance)
    return np.where(alone > 0, 1 / difference, 0.), np.where(two > 0, error, 0.)


def rows_at(table, loads):
    """The rows of a patch at each of the loads, in the order of its path."""
    chosen = nearest_slip(table)
    return [np.flatnonzero(at_load(table["pressure"], load) & chosen) for load in loads]


class Patches:
    """Conductances of the realisations at all loads: per square, under the pressure drop of the
    seal."""

    def __init__(self, folder, seal):
        self.along, self.across, self.ends = [], [], []
        self.errors, self.dropped, self.in_rows = [], [], True
        self.factor, self.unit, self.load_unit, self.slip = 1., "", "", ""
        self.knows_budget, budgets = True, []
        for path in realisations(folder).values():
            try:
                run, values = Run(path), read_parameters(scene_in(path))
                alone, in_a_row, errors = self._of_loads(run, box_of(values), seal)
            except (OSError, KeyError, ValueError) as problem:
                self.dropped.append(f"{path.name} ({problem})")
                continue
            rotated = values["Surface/Rotate"] == "true"
            if rotated and not seal.isotropic:
                self.across.append(in_a_row)
            else:
                self.along.append(in_a_row)
                self.ends.append(alone)
            self.in_rows = self.in_rows and "two_boxes_leak_rate" in run.table
            self.errors.append(errors)
            self.knows_budget = self.knows_budget and "leak_rate_error" in run.table
            # Without a run.json nothing is known about its steps.
            budgets += run.record.get("error_budget", [{"relative_errors": {}}])
            self._take_unit(run, seal)
            self._take_slip(run)
        if len(self.along) < 2:
            sys.exit("The whole seal needs two patches along the flow with leak rates at all "
                     f"loads, and there are {len(self.along)}" +
                     (": " + "; ".join(self.dropped) if self.dropped else "") + ".")
        if not (self.across or seal.isotropic or seal.n_along == 1):
            sys.exit("The whole seal has a lay and needs a patch across it with leak rates at all "
                     "loads, and there is none" +
                     (": " + "; ".join(self.dropped) if self.dropped else "") + ".")
        self.along, self.ends = np.array(self.along), np.array(self.ends)
        self.across = np.array(self.across) if self.across else self.along
        # Not every grid can be compared with a coarser one.
        self.knows_grid = self.knows_budget and all(
            step["relative_errors"].get("contact grid") is not None for step in budgets)

    @staticmethod
    def _of_loads(run, box, seal):
        """Conductances of a patch: alone between reservoirs, and in an endless row; and errors."""
        table, (length, breadth) = run.table, box
        rows = [found[:1] for found in rows_at(table, seal.loads)]
        for load, row in zip(seal.loads, rows):
            if not row.size or not has_bounds(table["status"][row]).all():
                raise ValueError(f"no leak rate at {load:.6g}")
        table = {name: values[np.concatenate(rows)] for name, values in table.items()}
        errors = relative_errors(table)
        alone = np.abs(table["leak_rate"])
        in_a_row = alone
        if "two_boxes_leak_rate" in table:
            # Half the width of the bracket, or all of it if the leak rate is its upper end.
            of_two = table["two_boxes_error"] * np.where(table["two_boxes_error"] > 0.5, 1, 0.5)
            in_a_row, errors = in_endless_row(alone, np.abs(table["two_boxes_leak_rate"]),
                                              errors, of_two)
        return (alone * length / breadth, in_a_row * length / breadth,
                np.where(in_a_row > 0, errors, np.nan))

    def _take_unit(self, run, seal):
        """Set the unit of leak rates that was asked for, and the factor to it from the scene's."""
        self.unit = run.unit("leak_rate")
        self.load_unit = f" {run.unit('pressure')}".rstrip()  # as it follows a number
        if not seal.unit:
            return
        leaks = np.flatnonzero(np.nan_to_num(run.table["leak_rate"]))  # a failed row has none
        if leaks.size:
            column = leak_rates(run.table)[1]
            self.factor = run.table[column][leaks[0]] / run.table["leak_rate"][leaks[0]]
        self.unit = seal.unit

    def _take_slip(self, run):
        """Set the words about the slip length, which are printed if there are several."""
        slips = run.table.get("slip_length", np.zeros(1))
        if len(set(slips)) > 1:
            length = f"{slips.max():.6g} {run.unit('slip_length')}".rstrip()
            self.slip = f", with the slip length {length}, the nearest to zero of {len(set(slips))}"


def open_at_ends(along, alone):
    """Give the first and the last patch along the flow one end that opens on a reservoir."""
    with np.errstate(divide="ignore"):
        for column in (0, -1):
            along[:, column] = 2 / (1 / along[:, column] + 1 / alone[:, column]) \
                if along.shape[1] > 1 else alone[:, column]


def mean_errors(loads, errors):
    """The mean relative error of the patches that leak, as a function of the load.

    A sealed patch has no error, and does not reduce the mean of the others.
    """
    leaks = ~np.isnan(errors)
    known = leaks.any(axis=0)
    if not known.any():
        return np.zeros_like
    mean = np.nanmean(errors[:, known], axis=0)
    return lambda load: np.interp(load, np.asarray(loads)[known], mean)


def bands_of(seal, patches, loads):
    """Yield the Band at each of the loads, which the patches must cover."""
    along, across, _ = seal.columns()
    scale = patches.factor * seal.circumference / seal.width
    rng = np.random.default_rng(1)
    error_at = mean_errors(seal.loads, np.array(patches.errors))

    def at(pool, load, columns):
        return scale * (at_loads(seal.loads, pool, load * columns) if len(seal.loads) > 1
                        else np.repeat(pool, len(columns), axis=1))

    for load in loads:
        k_along, k_across, k_ends = (at(pool, load, columns) for pool, columns in
                                     ((patches.along, along), (patches.across, across),
                                      (patches.ends, along)))
        open_at_ends(k_along, k_ends)
        yield Band(k_along, k_across, seal.n_around, seal.breadth / seal.length,
                   float(error_at(load)), rng)


def crossing(loads, rates, wanted):
    """The load at which a falling leak rate passes the wanted one; NaN if beyond the loads."""
    for k in np.flatnonzero((rates[:-1] >= wanted) & (rates[1:] <= wanted) &
                            (rates[:-1] > rates[1:])):
        (a, b), (la, lb) = rates[k:k + 2], loads[k:k + 2]
        part = math.log(a / wanted) / math.log(a / b) if b > 0 else (a - wanted) / (a - b)
        return la + part * (lb - la)
    return math.nan


def loads_for(seal, patches, loads, bands):
    """The loads at which the median, the 5 and the 95 % quantile are the wanted leak rate.

    Between two loads the patches are interpolated, not the quantiles of seals: if some patches seal
    on the way, interpolated quantiles would be off.
    """
    wanted, curves = seal.wanted, [quantiles_of(bands)]
    passed = (curves[0][:, :-1] >= wanted) & (curves[0][:, 1:] <= wanted)
    between = [np.linspace(*loads[k:k + 2], N_BETWEEN + 2)[1:-1]
               for k in np.flatnonzero(passed.any(axis=0))]
    more = np.concatenate([[], *between])
    curves.append(quantiles_of(list(bands_of(seal, patches, more))))
    all_loads = np.concatenate([loads, more])
    order = np.argsort(all_loads)
    return [crossing(all_loads[order], rates[order], wanted) for rates in np.hstack(curves)]


def quantiles_of(bands):
    """Median, 5 and 95 % of each band: three rows."""
    return np.array([[band.median, band.lower, band.upper] for band in bands]).reshape(-1, 3).T


def verdict(load, band, seal, patches):
    """One sentence about what dominates the uncertainty, and what reduces it."""
    n, load = len(patches.along), f"{load:.6g}{patches.load_unit}"
    parts = {"patches": 1.645 * band.student * band.patches, "seal": 1.645 * band.arrangement,
             "solution": band.solution}
    most = max(parts, key=parts.get)
    more = "Realisations/Seeds" if seal.roll_off else "measure more of the surface"
    factor = f"a factor of {math.exp(parts[most]):.3g}"
    if band.lower == 0:
        share = "most" if band.median == 0 else f"{100 * band.sealed:.2g} % of"
        return (f"at {load} {share} seals do not leak at all: what leaks is decided by few "
                f"patches; simulate more of them ({more})")
    if most == "patches":
        return (f"most of the uncertainty at {load}, {factor} each way, comes from the number "
                f"of patches: {4 * n} in place of {n} would about halve it ({more})")
    if most == "seal":
        return (f"most of the uncertainty at {load}, {factor} each way, is that of the seal "
                "itself: seals of this size differ so much, and no more patches narrow it")
    advice = ("Contact/Grid points, Contact/Zoom or Fluid/Target accuracy, as their logs say"
              if patches.knows_budget else "Fluid/Target accuracy")
    return (f"most of the uncertainty at {load}, {factor} each way, comes from the solutions "
            f"of the patches: improve {advice}")


def doubts(seal, patches):
    """Yield warnings about what the band does not include."""
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
    if seal.n_along == 1:
        yield ("one row of patches leaks through the few of them that leak most, which a few "
               "patches may lack: up to a fifth of seals leak more than the band's upper end")
    if seal.n_along > 1 and not patches.in_rows:
        yield ("the ends of patches open on reservoirs, which in a row of them counts too often "
               "and leaks too much: that cannot be allowed for here (Seal/Two in a row)")
    if seal.n_along > 1 and seal.depends_on_drop:
        yield ("each patch was solved under the whole pressure drop, of which it has a part in a "
               "row, and with Wall feedback or Rarefaction its conductance depends on that")
    if seal.turns_round:
        yield (f"the path of the loads turns round, and these are the leak rates before, at "
               f"{len(seal.loads)} loads: what leaks after it depends on the loads before; "
               "let the path end at the loads that the seal works at")
    if seal.n_along * seal.length > 1.5 * seal.width:
        yield f"a patch is longer than the contact is wide ({seal.width:.4g})"
    if seal.n_around * seal.breadth > 1.5 * seal.circumference:
        yield f"a patch is broader than the seal is long ({seal.circumference:.4g})"
    if not patches.knows_grid:
        yield ("the error of the contact grid is not in the band; " +
               ("the logs of the patches say why" if patches.knows_budget else
                "Output/Error budget = true estimates it"))


def assess(folder):
    """Write the tables and print what they mean."""
    seal = seal_of(scene_in(folder))
    patches = Patches(folder, seal)
    loads = seal.rows()
    bands = list(bands_of(seal, patches, loads))
    write_table(folder / "seal.csv",
                ("pressure", "leak_rate_median", "leak_rate_5_percent", "leak_rate_95_percent",
                 "unit", "sealed", "scatter_patches", "scatter_arrangement", "solution_error"),
                [(load, band.median, band.lower, band.upper, patches.unit, band.sealed,
                  band.patches, band.arrangement, band.solution) for load, band in zip(loads, bands)])
    unit, load_unit = patches.unit or "in the scene's units", patches.load_unit
    across = (", which serve across it as well" if patches.across is patches.along
              else f" and {len(patches.across)} across")
    print(f"whole seal: {seal.n_along} × {seal.n_around} patches, drawn from "
          f"{len(patches.along)} along the flow{across}{patches.slip}")
    for load, band in zip(loads, bands):
        print(f"  under {load:.6g}{load_unit}: {band.median:.4g} {unit}, "
              f"90 % between {band.lower:.4g} and {band.upper:.4g}")
    print("  " + verdict(loads[-1], bands[-1], seal, patches))
    (folder / "seal_load.csv").unlink(missing_ok=True)  # that of another wanted leak rate
    if seal.wanted > 0:
        found = loads_for(seal, patches, loads, bands)
        write_table(folder / "seal_load.csv",
                    ("wanted_leak_rate", "unit", "load", "load_5_percent", "load_95_percent"),
                    [(seal.wanted, patches.unit, *found)])
        print(f"  {seal.wanted:.4g} {unit}: under {found[0]:.4g}{load_unit}, 90 % between "
              f"{found[1]:.4g} and {found[2]:.4g}" +
              ("; nan: beyond these loads" if np.isnan(found).any() else ""))
    for doubt in doubts(seal, patches):
        print("  warning: " + doubt)


def main():
    """Read the command line and check or assess the seal."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("folder", metavar="OUTPUT_DIR", type=pathlib.Path, nargs="?")
    parser.add_argument("--check", action="store_true",
                        help="only check size and profile of the seal on standard input")
    options = parser.parse_args()
    if options.check:
        seal_of(sys.stdin.read()).rows()
    elif options.folder:
        try:
            assess(options.folder)
        except (FileNotFoundError, NotADirectoryError) as error:
            sys.exit(f"whole_seal.py: there is no file {error.filename}; give the folder of a run "
                     "with Realisations.")
    else:
        parser.error("which results?")


if __name__ == "__main__":
    main()
