# SPDX-License-Identifier: GPL-2.0-or-later
"""What the pictures of a run have in common: style, numbers and units."""
import json

import matplotlib
import numpy as np

from run_folder import leak_rates, replacing
from strait_results import Run

STYLE = {"font.size": 10, "xtick.labelsize": 9, "ytick.labelsize": 9, "legend.fontsize": 9,
         "legend.frameon": False, "lines.linewidth": 1.4, "lines.markersize": 5, "savefig.dpi": 150,
         "grid.color": "0.9", "grid.linewidth": 0.6, "axes.formatter.use_mathtext": True,
         "axes.formatter.limits": (-3, 4)}
BLUE, VERMILLION, GREEN = "#0072b2", "#d55e00", "#009e73"  # Okabe and Ito
RED = "#cc0000"  # theory, as in the paper
COLOURS = (BLUE, GREEN, "#cc79a7", "#e69f00", "#56b4e9", "#000000")


def use_style():
    """Set this style alone: settings of the user, such as TeX, could break the pictures."""
    matplotlib.rcdefaults()
    matplotlib.rcParams.update(STYLE)


def save(figure, path):
    """Write a figure to a PNG file."""
    with replacing(path) as partial:
        # Level 4 takes half the time of the usual 6, for files that are 5 % larger.
        figure.savefig(partial, format="png", pil_kwargs={"compress_level": 4})


def with_unit(text, name, units):
    """An axis label with the unit of quantity @p name."""
    unit = units.get(name) if units else "scene units"
    return f"{text} ({unit})" if unit else text


# (factor, name) of units that may read better, by the unit that the scene states.
PREFIXES = {"m": ((1, "m"), (1e-3, "mm"), (1e-6, "µm"), (1e-9, "nm")),
            "Pa": ((1e9, "GPa"), (1e6, "MPa"), (1e3, "kPa"), (1, "Pa"))}


def readable(unit, values):
    """(factor, name) of the largest unit of PREFIXES in which the median is at least one."""
    sizes = np.abs(values[np.isfinite(values) & (values != 0)])
    if unit not in PREFIXES or not sizes.size:
        return 1, unit
    middle = np.median(sizes)
    fitting = [prefix for prefix in PREFIXES[unit] if middle >= 0.9999 * prefix[0]]
    return max(fitting) if fitting else min(PREFIXES[unit])


def label_axis(axis, text, name, units, largest):
    """Label a linear axis that goes to @p largest, with a prefix of the unit of quantity @p name if
    that would else be a tiny or a huge number and the unit is one of SI."""
    label = with_unit(text, name, units)
    factor, unit = readable((units or {}).get(name), np.array([largest]))
    if factor != 1 and not 0.1 <= largest < 1000:
        label = f"{text} ({unit})"
        axis.set_major_formatter(lambda value, _: f"{value / factor:.4g}")
    axis.set_label_text(label)


def with_best_unit(value, unit):
    """A number with the unit that reads best; without a unit, as it is."""
    factor, unit = readable(unit, np.array([value])) if unit else (1, "")
    return f"{scientific(value / factor)} {unit}".rstrip()


def wanted_leak_rate(folder, units):
    """The factor from the scene's leak rate to the first unit of Output/Leak rate units, and all
    units with that one for the leak rate; 1 and the given units if none is asked for."""
    try:
        run = Run(folder)
        column = leak_rates(run.table)[1]
        leaks = np.flatnonzero(np.isfinite(run.table["leak_rate"]) & (run.table["leak_rate"] != 0))
        factor = run.table[column][leaks[0]] / run.table["leak_rate"][leaks[0]]
        return factor, {**units, "leak_rate": run.record["column_units"][column]}
    except (OSError, ValueError, KeyError, IndexError, AttributeError):
        return 1, units


def scientific(value):
    """A number to three digits, with a power of ten where that is shorter."""
    mantissa, _, exponent = f"{value:.3g}".partition("e")
    return rf"${mantissa}\times10^{{{int(exponent)}}}$" if exponent else mantissa


def read_units(folder):
    """The units named in run.json; empty if it names none."""
    try:
        units = json.loads((folder / "run.json").read_text(encoding="utf-8"))["units"]
        return {name: str(unit) for name, unit in units.items() if unit}
    except (OSError, ValueError, KeyError, TypeError, AttributeError):
        return {}
