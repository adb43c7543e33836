# SPDX-License-Identifier: GPL-2.0-or-later
"""ensemble.png: the leak rates of all realisations superposed, and the scatter of their thresholds.

Each curve is multiplied by a factor of its own, so that all have the same mean logarithm over the
reduced loads, up to 0.3, that all of them reach.
"""
import sys

import numpy as np
from matplotlib.figure import Figure

from plot_common import BLUE, COLOURS, VERMILLION, readable, save, scientific, with_unit
from run_folder import is_trusted, is_uncertain, nearest_slip, realisations
from strait_results import Table, read_table

LARGEST_SUPERPOSED = 0.3
QUANTITIES = (("critical_load", "Critical load", "pressure"),
              ("contact_area", "Contact area there", None),
              ("crossover", "Crossover load / critical load", None))


def read_curve(path):
    """(reduced load, magnitude of the leak rate, whether uncertain) of one realisation.

    In the order of the reduced load, at the slip length that is nearest to zero.
    """
    table = read_table(path)
    reduced, leak, status = table["reduced_load"], np.abs(table["leak_rate"]), table["status"]
    rows = np.flatnonzero((reduced > 0) & (leak > 0) & nearest_slip(table) & is_trusted(status))
    rows = rows[np.argsort(reduced[rows])]
    return reduced[rows], leak[rows], is_uncertain(status[rows])


def read_curves(folder):
    """The curves of all realisations that have at least two points, by their number."""
    curves = {}
    for number, path in realisations(folder, "realisation-*/leakage.csv").items():
        try:
            if "reduced_load" not in read_table(path):
                continue  # no threshold was sought
            curve = read_curve(path)
            if len(curve[0]) > 1:
                curves[number] = curve
        except (OSError, KeyError, ValueError, IndexError):
            print(f"plot.py: {path} could not be used.", file=sys.stderr)
    return curves


def common_range(curves):
    """The reduced loads that every curve reaches, up to LARGEST_SUPERPOSED."""
    low = max(reduced[0] for reduced, _, _ in curves)
    high = min(reduced[-1] for reduced, _, _ in curves)
    return (low, min(high, LARGEST_SUPERPOSED)) if low < LARGEST_SUPERPOSED else (low, high)


def superpose(curves):
    """The factor that lays each curve on the others, and the range of reduced loads it is from."""
    low, high = common_range(curves)
    at = np.linspace(np.log10(low), np.log10(high), 20) if low < high else np.log10([low])
    levels = [np.interp(at, np.log10(reduced), np.log10(leak)).mean()
              for reduced, leak, _ in curves]
    return 10.0**(np.mean(levels) - np.array(levels)), (low, high)


def draw_curves(axes, curves, units):
    """Draw all curves, each times its factor, and a line with the slope 69/20."""
    factors, (low, high) = superpose(list(curves.values()))
    for (number, (reduced, leak, hollow)), factor in zip(curves.items(), factors):
        style = {"color": COLOURS[number % len(COLOURS)], "markersize": 4, "linewidth": 0.8}
        axes.plot(reduced, factor * leak, "o-", **style)
        axes.plot(reduced[hollow], factor * leak[hollow], "o", markerfacecolor="white", **style)
    x = np.array([low, min(1, 10 * low)])
    start = np.exp(np.mean([np.log(factor * np.interp(low, reduced, leak))
                            for (reduced, leak, _), factor in zip(curves.values(), factors)]))
    axes.plot(x, 3 * start * (x / low)**3.45, "--", color="0.35", linewidth=0.9,
              label="slope 69/20")
    axes.set(xscale="log", yscale="log", xlabel=r"Distance from threshold, $1 - L/L_c$",
             ylabel=with_unit("Leak rate, shifted", "leak_rate", units))
    axes.set_title(f"{len(curves)} realisations, times {factors.min():.2g} to {factors.max():.2g}: "
                   f"equal mean logarithm from {low:.2g} to {high:.2g}", fontsize=9)
    if any(hollow.any() for _, _, hollow in curves.values()):
        axes.plot([], [], "o", color="0.4", markerfacecolor="white", label="hollow: unresolved")
    axes.legend()
    axes.grid(True)


def at_nearest_slip(table, folder):
    """The table with the critical loads and contact areas at the slip length nearest to zero, as in
    threshold.csv of the realisations: the crossover is that of this slip length, while ensemble.csv
    may have the thresholds of another. And this slip length if there are several, else None."""
    table, several = Table({name: values.copy() for name, values in table.items()}), None
    for number, path in realisations(folder, "realisation-*/threshold.csv").items():
        threshold = read_table(path)
        row = np.flatnonzero(nearest_slip(threshold))[:1]
        for name in ("critical_load_lower", "critical_load_upper", "contact_area"):
            table[name][table["realisation"] == number] = \
                threshold[name][row] if row.size else np.nan
        if threshold.n_rows > 1:
            several = threshold["slip_length"][row[0]]
    return table, several


def samples(table, name):
    """The finite values of a quantity of ensemble.csv."""
    critical = 0.5 * (table["critical_load_lower"] + table["critical_load_upper"])
    values = {"critical_load": critical, "contact_area": table["contact_area"],
              "crossover": table["crossover_load"] / critical}[name]
    return values[np.isfinite(values)]


def strip_of(table, name, label, unit, units):
    """The values of a quantity in a unit that reads well, and their label."""
    values = samples(table, name)
    if not (unit and units):
        return values, with_unit(label, unit, units) if unit else label
    factor, readable_unit = readable(units.get(unit), values)
    return values / factor, with_unit(label, unit, {**units, unit: readable_unit})


def draw_strip(axes, values, label):
    """Draw the values as dots, their mean as a line and the standard deviation as a band."""
    axes.plot(np.linspace(-0.3, 0.3, len(values)), values, "o", color=BLUE, fillstyle="none")
    mean, scatter = values.mean(), values.std(ddof=1) if len(values) > 1 else 0
    axes.axhline(mean, color=VERMILLION)
    axes.axhspan(mean - scatter, mean + scatter, color=VERMILLION, alpha=0.15, linewidth=0)
    axes.set(xticks=[], xlim=(-0.6, 0.6), ylabel=label)
    axes.set_title(rf"{mean:.3g} $\pm$ {scatter:.2g}", fontsize=9)


def draw_ensemble(path, units):
    """Draw ensemble.png from ensemble.csv and the folders of the realisations beside it."""
    table, slip = at_nearest_slip(read_table(path), path.parent)
    curves = read_curves(path.parent)
    strips = [strip_of(table, name, label if slip is None or name != "critical_load" else
                       f"{label}, $d_0$ = {scientific(slip)}", unit, units)
              for name, label, unit in QUANTITIES] if table else []
    strips = [strip for strip in strips if len(strip[0])]
    if not (curves or strips):
        if path.with_name("seal.csv").exists():
            return None  # no thresholds were wanted
        return print(f"plot.py: {path} holds no thresholds: no ensemble.png.", file=sys.stderr)
    widths = [4] * bool(curves) + [1] * len(strips)
    figure = Figure(figsize=(0.3 + 1.55 * sum(widths), 4.4), layout="constrained")
    panels = list(np.ravel(figure.subplots(1, len(widths), width_ratios=widths)))
    if curves:
        draw_curves(panels.pop(0), curves, units)
    for axes, strip in zip(panels, strips):
        draw_strip(axes, *strip)
    return save(figure, path.with_suffix(".png"))
