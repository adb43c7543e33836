#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Compare runs with different adhesion.

    plot_adhesion.py leakage PICTURE.png LABEL=FOLDER ...   leak rates against load and 1 - L/L_c
    plot_adhesion.py contact PICTURE.png LABEL=FOLDER ...   contact of the last fields of each

Unloading branches are dashed.
"""
import itertools
import pathlib
import sys

import h5py
import numpy as np
from matplotlib.figure import Figure

from plot_common import BLUE, COLOURS, VERMILLION, use_style
from plot_leakage import all_series, draw_line, error_bars
from run_folder import is_trusted, is_uncertain, numbered
from strait_results import read_table


def draw_leakage(runs):
    """Leak rates, left against the load, right against the reduced load with slopes 69/20 and 1."""
    figure = Figure(figsize=(9, 4), layout="constrained")
    left, right = figure.subplots(1, 2)
    colours = dict.fromkeys(label.replace(" opening", "") for label, _ in runs)
    colours = dict(zip(colours, (*COLOURS, VERMILLION)))
    for label, folder in runs:
        table = read_table(folder / "leakage.csv")
        if "reduced_load" not in table:
            raise SystemExit(f"{folder}: only runs with Find threshold can be compared.")
        leak = np.abs(table["leak_rate"])
        leaks = (leak > 0) & np.isfinite(leak) & is_trusted(table["status"])
        hollow = is_uncertain(table["status"])
        colour = colours[label.replace(" opening", "")]
        for marker, (words, _, branch, of_series) in zip(itertools.cycle("os^Dv"),
                                                         all_series(table)):
            for axes, name, drawn in ((left, "pressure", leaks),
                                      (right, "reduced_load", leaks & (table["reduced_load"] > 0))):
                rows = drawn & of_series
                draw_line(axes, table[name][rows], leak[rows], hollow[rows], color=colour,
                          label=f"{label}, {words}" if words else label, marker=marker,
                          linestyle="--" if branch == "unloading" else "-")
                axes.errorbar(table[name][rows], leak[rows], yerr=error_bars(table, rows),
                              fmt="none", ecolor=colour)
    left.set(yscale="log", xlabel="Nominal pressure", ylabel="Leak rate")
    right.set(xscale="log", yscale="log", xlabel="1 - load / critical load")
    x = np.array([0.01, 0.1])
    level = max(line.get_ydata().max() for line in right.lines if len(line.get_ydata()))
    for slope, kind in ((69 / 20, ":"), (1, "-.")):
        right.plot(x, 0.3 * level * (x / 0.1)**slope, kind, color="0.4",
                   label=f"slope {slope:.3g}")
    right.legend()
    return figure


def draw_contact(runs):
    """The contact (dark) in the last fields of each run."""
    figure = Figure(figsize=(3.4 * len(runs), 3.8), layout="constrained")
    for axes, (label, folder) in zip(figure.subplots(1, len(runs), squeeze=False)[0], runs):
        fields = list(numbered(folder, "fields-*.h5").values())
        if not fields:
            raise SystemExit(f"{folder} holds no fields-STEP.h5: run it with Output/Fields = last.")
        with h5py.File(fields[-1]) as file:
            gap = file["gap"][()]
            size = (0, file.attrs["lx"], 0, file.attrs["ly"])
        axes.imshow(gap > 0, cmap="gray", origin="lower", extent=size, vmin=-0.2)
        axes.contour(gap > 0, [0.5], colors=BLUE, linewidths=0.4, origin="lower", extent=size)
        axes.set(title=f"{label}: {100 * (gap == 0).mean():.1f} %", xticks=[], yticks=[])
    return figure


def main(kind, picture, *runs):
    """Run the script with the arguments of the command line."""
    use_style()
    pairs = [(run.rpartition("=")[0], pathlib.Path(run.rpartition("=")[2])) for run in runs]
    {"leakage": draw_leakage, "contact": draw_contact}[kind](pairs).savefig(picture)


if __name__ == "__main__":
    if len(sys.argv) < 4 or sys.argv[1] not in ("leakage", "contact"):
        raise SystemExit(__doc__)
    main(*sys.argv[1:])
