#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Theory as red lines beside the simulation; as a script, several runs of the theory in one.

plot_theory.py FOLDER... --picture FILE draws what the effective medium leaks in each folder
against the load over that which seals it, normalised by the flow through a gap of the short
cut-off wavelength everywhere, as the paper's figure 2b.
"""
import argparse
import math
import pathlib
import re
import sys

import numpy as np
from matplotlib.figure import Figure

from plot_common import COLOURS, RED, scientific, use_style
from strait_results import read_table


def draw_theory(axes, table, x, name="theory_leak_rate", label="theory"):
    """A red line of the column @p name against the column @p x; of the leak rate one for each
    slip length, on which contact area and mean gap do not depend."""
    if name not in table:
        return
    slips = np.zeros(len(table[name]))
    if name == "theory_leak_rate":
        slips = table.get("slip_length", slips)
    for i, slip in enumerate(dict.fromkeys(slips)):
        rows = np.flatnonzero((slips == slip) & np.isfinite(table[x]) & (table[name] > 0))
        rows = rows[np.argsort(table[x][rows], kind="stable")]
        axes.plot(table[x][rows], table[name][rows], ("-", "--", ":", "-.")[i % 4], color=RED,
                  linewidth=1.1, label=label if i == 0 else None, zorder=1)


def parameters_of(folder):
    """The resolved scene of a run: values by name, the last where sections share one."""
    text = (folder / "parameters.prm").read_text(encoding="utf-8")
    return dict(re.findall(r"^\s*set (.+?)\s*= *(.*?)\s*(?:#.*)?$", text, re.MULTILINE))


def inverse_erf(value):
    """By bisection; a handful of values is wanted."""
    low, high = 0.0, 6.0
    for _ in range(100):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if math.erf(middle) < value else (low, middle)
    return low


def normalised(folder):
    """(load over the critical one, leak rate over that of a gap λs everywhere, λr/λs)."""
    table, scene = read_table(folder / "leakage.csv"), parameters_of(folder)
    cut_off = float(scene["Short cut-off wavelength"])
    if scene["Dimension parameter"] not in ("bruggeman", "critical fraction"):
        raise ValueError("Theory/Dimension parameter must be bruggeman or critical fraction")
    sealing = 0.5 if scene["Dimension parameter"] == "bruggeman" \
        else float(scene["Critical contact fraction"])
    first = np.argmin(table["pressure"])
    critical = table["pressure"][first] * inverse_erf(sealing) / \
        inverse_erf(table["theory_contact_area"][first])
    size = [float(side) for side in scene["Size"].split(",")]
    aspect = (size[-1] / size[0])**(1 if scene["Direction"] == "x" else -1)
    flow = cut_off**3 / (12 * float(scene["Viscosity"])) * aspect * \
        (float(scene["Inlet pressure"]) - float(scene["Outlet pressure"]))
    return (table["pressure"] / critical, table["theory_leak_rate"] / flow,
            cut_off / float(scene["Roll-off wavelength"]))


def draw_folders(folders, picture):
    """The curves of all folders over the load, and over the distance from the threshold."""
    figure = Figure(figsize=(9.6, 4.2), layout="constrained")
    left, right = figure.subplots(1, 2, sharey=True)
    for i, folder in enumerate(folders):
        load, leak, ratio = normalised(folder)
        rows = np.argsort(load)
        rows = rows[leak[rows] > 0]
        style = {"color": COLOURS[i % len(COLOURS)],
                 "label": rf"$\lambda_s/\lambda_r$ = {scientific(ratio)}"}
        left.plot(load[rows], leak[rows], **style)
        right.plot(1 - load[rows], leak[rows], **style)
    left.set(yscale="log", xlabel="$L/L_c$",
             ylabel=r"Leak rate / that of a gap $\lambda_s$ everywhere")
    right.set(xscale="log", xlabel=r"Distance from threshold, $1 - L/L_c$")
    left.legend()
    for axes in (left, right):
        axes.grid(color="0.9", linewidth=0.6)
    figure.savefig(picture)


def main(arguments=None):
    """Draw the folders of the command line and return the exit status."""
    parser = argparse.ArgumentParser(description="Compare runs of the theory alone.")
    parser.add_argument("folders", metavar="OUTPUT_DIR", type=pathlib.Path, nargs="+")
    parser.add_argument("--picture", metavar="FILE", default="theory.png")
    options = parser.parse_args(arguments)
    use_style()
    try:
        draw_folders(options.folders, options.picture)
    except (OSError, KeyError, ValueError) as error:
        print(f"plot_theory.py: {type(error).__name__}: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
