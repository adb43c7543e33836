# SPDX-License-Identifier: GPL-2.0-or-later
"""seal.png: the leak rate of a whole seal against load, with its 90 % band."""
import numpy as np
from matplotlib.figure import Figure

from plot_common import BLUE, VERMILLION, label_axis, save
from strait_results import read_table


def draw_band(axes, table):
    """Draw the median as a line in its 90 % band, cut at the lower edge where seals do not leak."""
    load = table["pressure"]
    low, middle, high = (table[f"leak_rate_{name}"] for name in
                         ("5_percent", "median", "95_percent"))
    leaks = np.concatenate([values[values > 0] for values in (low, middle, high)])
    if not leaks.size:
        axes.set_yticks([])
    else:
        bottom = 0.5 * leaks.min()
        axes.fill_between(load, np.maximum(low, bottom), np.maximum(high, bottom), color=BLUE,
                          alpha=0.2, linewidth=0, label="90 %")
        axes.plot(load[middle > 0], middle[middle > 0], "o-", color=BLUE, label="median")
        bars = np.maximum(middle, bottom)
        axes.errorbar(load, bars, yerr=[bars - np.maximum(low, bottom),
                                        np.maximum(high, bottom) - bars],
                      fmt="none", ecolor=BLUE, elinewidth=1)
        axes.set(yscale="log", ylim=(bottom, 2 * leaks.max()))
    sealed = middle == 0
    if sealed.any():
        axes.plot(load[sealed], np.full(sealed.sum(), 0.035), "v", color=VERMILLION,
                  fillstyle="none", transform=axes.get_xaxis_transform(),
                  label="most do not leak")


def draw_wanted(axes, path):
    """Draw the wanted leak rate, and the load at which it is reached, with its band."""
    table = read_table(path)
    load, low, high = (float(table[name][0]) for name in
                       ("load", "load_5_percent", "load_95_percent"))
    axes.axhline(table["wanted_leak_rate"][0], color=VERMILLION, linewidth=0.9, label="wanted")
    if np.isfinite(load):
        axes.axvline(load, color=VERMILLION, linewidth=0.9)
    if np.isfinite(low + high):
        axes.axvspan(low, high, color=VERMILLION, alpha=0.12, linewidth=0)


def draw_seal(path, units):
    """Draw seal.png from seal.csv and, if there is one, seal_load.csv."""
    table = read_table(path)
    figure = Figure(figsize=(5.6, 4.0), layout="constrained")
    axes = figure.subplots()
    draw_band(axes, table)
    wanted = path.with_name("seal_load.csv")
    if wanted.exists():
        draw_wanted(axes, wanted)
    unit = str(np.ravel(table["unit"])[0])
    label_axis(axes.xaxis, "Nominal pressure, mean over the width", "pressure", units,
               table["pressure"].max(initial=0))
    axes.set(ylabel="Leak rate of the whole seal (" +
                    ("scene units" if unit in ("", "nan") else unit) + ")")
    axes.grid(True)
    axes.legend()
    return save(figure, path.with_suffix(".png"))
