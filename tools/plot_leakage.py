# SPDX-License-Identifier: GPL-2.0-or-later
"""leakage.png: leak rate, contact and gap against load, and the leak rate against 1 - L/L_c."""
import sys

import numpy as np
from matplotlib.figure import Figure

from plot_common import (COLOURS, GREEN, VERMILLION, label_axis, save, scientific,
                         wanted_leak_rate, with_unit)
from plot_theory import draw_theory
from run_folder import is_trusted, is_uncertain
from strait_results import read_table


def column(table, name, default):
    """A column of the table, or the same value in every row."""
    return table.get(name, np.full(len(next(iter(table.values()))), default))


def leak_rate_label(table, units):
    """The label of an axis for magnitudes of leak rates, as its scale is logarithmic."""
    rates = [table[name] for name in ("leak_rate", "theory_leak_rate") if name in table]
    is_negative = any((rate < 0).any() for rate in rates)
    return with_unit("Size of the negative leak rate" if is_negative else "Leak rate",
                     "leak_rate", units)


def all_series(table):
    """(label, slip length, branch, rows) of each line: one for each slip length and branch, and for
    each time that a path comes back to a branch."""
    branches, slips = column(table, "branch", ""), column(table, "slip_length", 0.)
    several_branches, several_slips = len(set(branches)) > 1, len(set(slips)) > 1
    for slip in dict.fromkeys(slips):
        of_slip = np.flatnonzero(slips == slip)
        turns = np.flatnonzero(branches[of_slip][1:] != branches[of_slip][:-1]) + 1
        times = {}
        for piece in np.split(of_slip, turns):
            branch = branches[piece[0]]
            times[branch] = times.get(branch, 0) + 1
            branch += f" ({times[branch]})" if times[branch] > 1 else ""
            words = [f"$d_0$ = {scientific(slip)}"] if several_slips else []
            words += [branch] if several_branches else []
            yield ", ".join(words) or None, slip, branch, np.isin(np.arange(len(slips)), piece)


def error_bars(table, rows):
    """Distances of the bounds from the magnitude of the leak rate, below and above; 0: no bound."""
    leak = np.abs(table["leak_rate"])
    with np.errstate(invalid="ignore"):  # the leak rate of parted walls is infinite
        bars = np.array([leak - column(table, "leak_rate_lower", np.nan),
                         column(table, "leak_rate_upper", np.nan) - leak])[:, rows]
    return np.where(np.isfinite(bars), np.maximum(bars, 0), 0)


def draw_line(axes, x, y, hollow, **style):
    """Draw a line in the order of @p x, with hollow markers where @p hollow is true."""
    order = np.argsort(x, kind="stable")
    marker, label = style.pop("marker"), style.pop("label", None)
    axes.plot(x[order], y[order], marker=marker, label=label, **style)
    axes.plot(x[hollow], y[hollow], marker=marker, markerfacecolor="white",
              **{**style, "linestyle": "none"})


def draw_steps(axes, table, x):
    """Draw magnitudes of leak rates, with their known bounds, against the column @p x."""
    leak, status = np.abs(table["leak_rate"]), column(table, "status", "ok")
    drawn = np.isfinite(table[x]) & np.isfinite(leak) & (leak > 0)
    failed = drawn & ~is_trusted(status)
    hollow = drawn & is_uncertain(status)
    slips, branches = [], []
    for label, slip, branch, chosen in all_series(table):
        slips += [slip] * (slip not in slips)
        branches += [branch] * (branch not in branches)
        rows = drawn & chosen
        colour = COLOURS[slips.index(slip) % len(COLOURS)]
        axes.errorbar(table[x][rows], leak[rows], yerr=error_bars(table, rows), fmt="none",
                      ecolor=colour, elinewidth=2.5)
        rows = rows & ~failed
        draw_line(axes, table[x][rows], leak[rows], hollow[rows], color=colour,
                  marker="osDv^<>p"[branches.index(branch) % 8], label=label)
    if hollow.any():
        axes.plot([], [], "o", color="0.4", markerfacecolor="white",
                  label="hollow: " + ", ".join(dict.fromkeys(status[hollow])))
    keep_in_view(axes, leak[drawn & ~failed])
    if failed.any():  # at their value, or else at the nearer edge
        axes.plot(table[x][failed], np.clip(leak[failed], *axes.get_ylim()), "o", color=VERMILLION,
                  fillstyle="none", markersize=10, clip_on=False,
                  label="failed: " + ", ".join(dict.fromkeys(status[failed])))


def keep_in_view(axes, trusted):
    """Set a logarithmic scale that fits trusted values; bounds of failed steps can be far off."""
    if trusted.size and trusted.max() > trusted.min():
        low, high = np.log10([trusted.min(), trusted.max()])
        margin = max(0.08 * (high - low), 0.5)
        axes.set(yscale="log", ylim=(10.0**(low - margin), 10.0**(high + margin)))
    elif axes.has_data():
        axes.set_yscale("log")


def draw_leak_rate(axes, table, units, _):
    """Draw the leak rate (logarithmic) against the load. Steps that do not percolate are marked on
    the axis, steps with parted walls, where nothing limits the leak rate, at the top."""
    leak, pressure = table["leak_rate"], table["pressure"]
    percolates = column(table, "percolates", np.nan)
    sealed = np.where(np.isfinite(percolates), percolates == 0, leak == 0)
    if (np.abs(leak) > 0).any():
        draw_steps(axes, table, "pressure")
        draw_theory(axes, table, "pressure")
    else:
        axes.set_yticks([])
    for rows, height, marker, label in ((sealed, 0.035, "v", "sealed"),
                                        (np.isinf(leak), 0.965, "^", "walls apart, no limit")):
        if rows.any():
            axes.plot(pressure[rows], np.full(rows.sum(), height), marker, color=VERMILLION,
                      markersize=7, fillstyle="none", transform=axes.get_xaxis_transform(),
                      label=label)
    label_axis(axes.xaxis, "Nominal pressure", "pressure", units, pressure.max(initial=0))
    axes.set_ylabel(leak_rate_label(table, units))


def draw_contact(axes, table, units, _):
    """Draw contact area (left scale) and mean gap (right scale) against the load."""
    label_axis(axes.xaxis, "Nominal pressure", "pressure", units,
               table["pressure"].max(initial=0))
    quantities = [("contact_area", "Contact area / nominal area", GREEN, "o"),
                  ("mean_gap", "Mean gap", VERMILLION, "s")]
    present = [quantity for quantity in quantities if quantity[0] in table]
    series = list(all_series(table))
    for i, (name, label, colour, marker) in enumerate(present):
        scale = axes.twinx() if i else axes
        for _, _, branch, rows in series:
            filling = "full" if branch == series[0][2] else "none"   # hollow: once turned back
            draw_line(scale, table["pressure"][rows], table[name][rows],
                      np.zeros(rows.sum(), bool), marker=marker, color=colour, fillstyle=filling)
        draw_theory(scale, table, "pressure", f"theory_{name}", None if i else "theory")
        if name == "mean_gap":
            label_axis(scale.yaxis, label, "length", units,
                       np.max(table[name], initial=0, where=np.isfinite(table[name])))
            label = scale.get_ylabel()
        scale.set_ylabel(label, color=colour)
        scale.tick_params(axis="y", colors=colour)
        scale.set_ylim(bottom=0, top=(1 + .2 * i) * scale.get_ylim()[1])   # single points apart


def draw_theory_alone(axes, table, units, _):
    """Draw the leak rate of the effective medium, if nothing was simulated."""
    draw_theory(axes, table, "pressure")
    axes.set(yscale="log", xlabel=with_unit("Nominal pressure", "pressure", units),
             ylabel=leak_rate_label(table, units))


def draw_guides(axes, table):
    """Draw thin lines with the expected slopes at the last point: 69/20 without slip, and 3 for the
    most negative slip length."""
    reduced, leak, slips = (column(table, name, 0.)
                            for name in ("reduced_load", "leak_rate", "slip_length"))
    leak = np.abs(leak)
    converged = is_trusted(column(table, "status", "ok"))
    for slope, name, kind in ((69 / 20, "69/20", slips == 0), (3, "3", slips < 0)):
        rows = np.flatnonzero(kind & converged & (reduced > 0) & (leak > 0))
        rows = rows[slips[rows] == slips[rows].min(initial=0)]
        if rows.size == 0:
            continue
        last = rows[np.argmin(reduced[rows])]
        x = reduced[last] * np.array([1, min(10, 1 / reduced[last])])
        axes.plot(x, 2 * leak[last] * (x / x[0])**slope, "--" if slope > 3 else ":",
                  color="0.35", linewidth=0.9, label=f"slope {name}")


def fitted_exponents(table):
    """One line for each exponent of the leak rate in the table fit.csv."""
    if not table or len(table["quantity"]) == 0:
        return []
    wanted = (table["quantity"] == "leak_rate") & (table["kind"] == "fit")
    several = len(set(column(table, "slip_length", 0.))) > 1
    return [(f"$d_0$ = {scientific(table['slip_length'][k])}: " if several else "") +
            rf"$\beta$ = {table['exponent'][k]:.3f}" +
            (rf" $\pm$ {table['error'][k]:.3f}, " if table["points"][k] > 2 else ", ") +
            f"{table['from'][k]:.2g} to {table['to'][k]:.2g}" for k in np.flatnonzero(wanted)]


def draw_threshold(axes, table, units, fits):
    """Draw the leak rate against the distance from the threshold, both logarithmic."""
    near = {name: values[column(table, "reduced_load", np.nan) > 0]
            for name, values in table.items()}
    draw_steps(axes, near, "reduced_load")
    draw_theory(axes, near, "reduced_load")
    draw_guides(axes, near)
    axes.set(xscale="log", yscale="log", xlabel=r"Distance from threshold, $1 - L/L_c$",
             ylabel=leak_rate_label(table, units))
    axes.text(0.97, 0.03, "\n".join(fits), transform=axes.transAxes, ha="right", fontsize=9)


def read_fits(path):
    """The exponents of the leak rate in fit.csv; none if it is missing or cannot be read."""
    try:
        return fitted_exponents(read_table(path))
    except (OSError, KeyError, ValueError):
        return []


def draw_critical_loads(axes, path):
    """Draw a line at each critical load of threshold.csv that lies near the steps."""
    table = read_table(path) if path.exists() else {}
    middles = [0.5 * sum(pair) for pair in zip(np.ravel(table.get("critical_load_lower", ())),
                                               np.ravel(table.get("critical_load_upper", ())))]
    near = [load for load in middles if load < 1.5 * axes.get_xlim()[1]]
    for load in near:
        axes.axvline(load, color="0.35", linestyle="--", linewidth=0.9,
                     label="critical load" if load == near[0] else None)


def draw_leakage(path, units):
    """Draw leakage.png from leakage.csv, with one panel for each relation that the table holds."""
    table = read_table(path)
    if table and "pressure" not in table:
        return None  # a given gap: one row, and no load to draw it against
    factor, units = wanted_leak_rate(path.parent, units)
    for name in ("leak_rate", "leak_rate_lower", "leak_rate_upper", "theory_leak_rate"):
        if name in table:
            table[name] = factor * table[name]
    reduced = table.get("reduced_load", np.zeros(1))
    panels = [draw_leak_rate] if "leak_rate" in table else \
        [draw_theory_alone] if "theory_leak_rate" in table else []
    panels += [draw_contact] if "contact_area" in table or "mean_gap" in table else []
    panels += [draw_threshold] if panels[:1] == [draw_leak_rate] and (reduced > 0).sum() > 1 else []
    if not panels or not np.isfinite(table.get("pressure", np.nan)).any():
        return print(f"plot.py: {path} holds no load steps: no leakage.png.", file=sys.stderr)
    figure = Figure(figsize=(0.3 + 4.8 * len(panels), 4.0), layout="constrained")
    figure.get_layout_engine().set(wspace=0.06)
    fits = read_fits(path.with_name("fit.csv"))
    for draw, axes in zip(panels, np.ravel(figure.subplots(1, len(panels)))):
        draw(axes, table, units, fits)
        if draw is draw_leak_rate:
            draw_critical_loads(axes, path.with_name("threshold.csv"))
        axes.grid(True)
        if axes.get_legend_handles_labels()[0]:
            axes.legend()
    return save(figure, path.with_suffix(".png"))
