# SPDX-License-Identifier: GPL-2.0-or-later
"""What the pictures of a run have in common: style, numbers and units."""
import json

import matplotlib
import numpy as np

STYLE = {"font.size": 10, "xtick.labelsize": 9, "ytick.labelsize": 9, "legend.fontsize": 9,
         "legend.frameon": False, "lines.linewidth": 1.4, "lines.markersize": 5, "savefig.dpi": 150,
         "axes.formatter.use_mathtext": True, "axes.formatter.limits": (-3, 4)}
BLUE, VERMILLION, GREEN = "#0072b2", "#d55e00", "#009e73"  # Okabe and Ito
RED = "#cc0000"  # theory, as in the paper
COLOURS = (BLUE, GREEN, "#cc79a7", "#e69f00", "#56b4e9", "#000000")
UNCERTAIN = ("unresolved-throat", "uncertain-threshold", "inaccurate")  # converged, but not the last word


def is_uncertain(status):
    """Where every word of a status, joined by +, is a doubt about a converged result."""
    return np.array([set(text.split("+")) <= set(UNCERTAIN) for text in status], bool)


def is_trusted(status):
    """Where nothing failed, doubts or not."""
    return np.isin(status, ["ok", ""]) | is_uncertain(status)


def use_style():
    """Our style alone: a user's own settings, TeX for one, could break the pictures."""
    matplotlib.rcdefaults()
    matplotlib.rcParams.update(STYLE)


def with_unit(text, name, units):
    """An axis label with the unit of quantity @p name."""
    unit = units.get(name) if units else "scene units"
    return f"{text} ({unit})" if unit else text


# Powers of ten of the units of SI that read better than the unit itself.
PREFIXED = {"m": {-9: "nm", -6: "µm", -3: "mm"},
            "Pa": {3: "kPa", 6: "MPa", 9: "GPa"}}


def label_axis(axis, text, name, units, largest):
    """Label a linear axis that goes to @p largest, in a unit that makes that no tiny or huge
    number where the unit of quantity @p name is of SI."""
    label = with_unit(text, name, units)
    unit = (units or {}).get(name)
    fitting = [power for power in PREFIXED.get(unit, {})
               if np.isfinite(largest) and 1 <= largest / 10.**power < 1000]
    if fitting and not 0.1 <= largest < 1000:
        power = fitting[0]
        label = f"{text} ({PREFIXED[unit][power]})"
        axis.set_major_formatter(lambda value, _: f"{value / 10.**power:.4g}")
    axis.set_label_text(label)


def scientific(value):
    """A number to three digits, with a power of ten where that is shorter."""
    mantissa, _, exponent = f"{value:.3g}".partition("e")
    return rf"${mantissa}\times10^{{{int(exponent)}}}$" if exponent else mantissa


def read_parameters(scene):
    """The values in the text of a scene, such as parameters.prm, by "Section/Parameter"."""
    values, section = {}, []
    for line in scene.splitlines():
        word, _, rest = line.split("#")[0].strip().partition(" ")
        if word == "subsection":
            section.append(rest.strip())
        elif word == "end":
            section.pop()
        elif word == "set":
            name, _, value = rest.partition("=")
            values["/".join([*section, name.strip()])] = value.strip()
    return values


def read_units(folder):
    """The units named in run.json, of several realisations in the first one's; empty where it
    names none."""
    path = folder / "run.json"
    if not path.exists():
        path = folder / "realisation-1" / "run.json"
    try:
        units = json.loads(path.read_text(encoding="utf-8"))["units"]
        return {name: str(unit) for name, unit in units.items() if unit}
    except (OSError, ValueError, KeyError, TypeError, AttributeError):
        return {}
