#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Theory as red lines beside the simulation; as a script, runs of the theory in one picture.

plot_theory.py FOLDER... --picture FILE draws the leak rate of the effective medium in each folder
against the load over the critical load, as in figure 2b of the paper. Leak rates are divided by the
flow through a uniform gap of the short cut-off wavelength. If a scene names a gas and leaves its
viscosity to the program, that flow is unknown here, and all leak rates are drawn as they are.
"""
import argparse
import pathlib
import sys
from statistics import NormalDist

import numpy as np
from matplotlib.figure import Figure

from plot_common import COLOURS, RED, read_units, scientific, use_style, with_unit
from run_folder import read_parameters, scene_in
from seal_scene import box_of
from strait_results import read_table


def draw_theory(axes, table, x, name="theory_leak_rate", label="theory"):
    """Draw the column @p name against the column @p x as a red line: for the leak rate its
    magnitude, one line for each slip length. Contact area and mean gap do not depend on slip."""
    if name not in table:
        return
    values, slips = table[name], np.zeros(len(table[name]))
    if name == "theory_leak_rate":
        values, slips = np.abs(values), table.get("slip_length", slips)
    for i, slip in enumerate(dict.fromkeys(slips)):
        rows = np.flatnonzero((slips == slip) & np.isfinite(table[x]) & (values > 0))
        rows = rows[np.argsort(table[x][rows], kind="stable")]
        axes.plot(table[x][rows], values[rows], ("-", "--", ":", "-.")[i % 4], color=RED,
                  linewidth=1.1, label=label if i == 0 else None, zorder=1)


def flow_at_cut_off(scene):
    """The leak rate through a uniform gap λs; None if only the program knows the viscosity."""
    # As in FluidParameters::take_gas(): for a named gas the default stands for its own viscosity.
    viscosity = float(scene["Fluid/Viscosity"])
    if scene.get("Fluid/Gas") and viscosity == 1:
        return None
    length, breadth = box_of(scene)
    return float(scene["Surface/Short cut-off wavelength"])**3 / (12 * viscosity) * \
        breadth / length * \
        (float(scene["Fluid/Inlet pressure"]) - float(scene["Fluid/Outlet pressure"]))


def normalised(folder, by_flow=True):
    """(load over critical load, leak rate, λs/λr) of the rows without slip; the leak rate is
    divided by that of a uniform gap λs, or else the magnitude as it is."""
    table, scene = read_table(folder / "leakage.csv"), read_parameters(scene_in(folder))
    dimension = scene["Theory/Dimension parameter"]
    if dimension not in ("bruggeman", "critical fraction"):
        raise ValueError("Theory/Dimension parameter must be bruggeman or critical fraction")
    sealing = 0.5 if dimension == "bruggeman" else float(scene["Theory/Critical contact fraction"])
    table = table.rows(table.get("slip_length", np.zeros(table.n_rows)) == 0)
    if not table.n_rows:
        raise ValueError("only rows with the slip length 0 can be compared, and there are none")
    first = np.argmin(table["pressure"])
    # The contact area is the error function of a multiple of the load.
    scale = [NormalDist().inv_cdf((1 + area) / 2)
             for area in (sealing, table["theory_contact_area"][first])]
    critical = table["pressure"][first] * scale[0] / scale[1]
    leak = table["theory_leak_rate"]
    return (table["pressure"] / critical,
            leak / flow_at_cut_off(scene) if by_flow else np.abs(leak),
            float(scene["Surface/Short cut-off wavelength"]) /
            float(scene["Surface/Roll-off wavelength"]))


def unit_of_all(folders):
    """The units of the first folder; raises ValueError if the leak rates of the folders have
    different ones."""
    units = [read_units(folder) for folder in folders]
    if len({of_one.get("leak_rate") for of_one in units}) > 1:
        raise ValueError("the leak rates of these runs have different units, and one that names a "
                         "gas cannot be normalised; give Fluid/Viscosity")
    return units[0]


def draw_folders(folders, picture):
    """Draw the curves of all folders against the load and the distance from the threshold."""
    figure = Figure(figsize=(9.6, 4.2), layout="constrained")
    left, right = figure.subplots(1, 2, sharey=True)
    by_flow = all(flow_at_cut_off(read_parameters(scene_in(folder))) is not None
                  for folder in folders)
    label = (r"Leak rate / that of a gap $\lambda_s$ everywhere" if by_flow else
             with_unit("Leak rate", "leak_rate", unit_of_all(folders)))
    for i, folder in enumerate(folders):
        load, leak, ratio = normalised(folder, by_flow)
        rows = np.argsort(load)
        rows = rows[leak[rows] > 0]
        style = {"color": COLOURS[i % len(COLOURS)],
                 "label": rf"$\lambda_s/\lambda_r$ = {scientific(ratio)}"}
        left.plot(load[rows], leak[rows], **style)
        right.plot(1 - load[rows], leak[rows], **style)
    left.set(yscale="log", xlabel="$L/L_c$", ylabel=label)
    right.set(xscale="log", xlabel=r"Distance from threshold, $1 - L/L_c$")
    left.legend()
    for axes in (left, right):
        axes.grid(True)
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
    except KeyError as column:
        print(f"plot_theory.py: the results have no column {column}: theory is drawn beside a "
              "contact, with Theory/Enabled = true", file=sys.stderr)
        return 1
    except (OSError, ValueError) as error:
        print(f"plot_theory.py: {type(error).__name__}: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
