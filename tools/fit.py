#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Exponents of leak rate and throat near the threshold, and the crossover of the leak rate.

For a run that looked for its threshold, writes fit.csv. For several realisations, completes
ensemble.csv and writes ensemble_summary.csv. doc/results.md defines the columns. Lines that begin
with "warning: " tell which steps or results cannot be used. Exit status 1 with a sentence if
something is missing.
"""
import argparse
import csv
import pathlib
import sys

try:
    import numpy as np

    from run_folder import is_trusted, nearest_slip, read_parameters, scene_in, write_table
    from strait_results import Table, read_table
    from strait_scaling import (EXPONENTIAL_DECAY, LEAK_RATE_EXPONENT, closing_constant,
                                closing_law, crossover, decay_rate, fit_exponent, neighbours,
                                within)
except ImportError as missing:
    sys.exit(f"fit.py: the Python module {missing.name} is missing; "
             "install python3-numpy and python3-scipy.")

# What is fitted: its member of the law of closing, and its exponent if an immobile layer of fluid
# (a negative slip length) closes the throat while that is still wide and smooth.
QUANTITIES = {"leak_rate": ("leak_rate", 3.), "throat_gap": ("gap", 1.),
              "throat_length": ("length", 0.5), "throat_width": ("width", 0.5)}
# If local exponents differ by more than this within a window, a single exponent describes the
# window, not the threshold. Half of it would warn of drifts that do not change the first decimal of
# the exponent; double of it would let drifts pass that do.
SETTLED = 0.05
FIT_COLUMNS = ("quantity", "slip_length", "kind", "from", "to", "exponent", "error", "points",
               "closing_law", "status")


def warn(text):
    """Print a warning, which the program passes on to its log."""
    print(f"warning: {text}")


def joined(status):
    """All words of several statuses, joined by +; "ok" if there are none."""
    words = dict.fromkeys(word for text in status for word in text.split("+") if word != "ok")
    return "+".join(words) or "ok"


def asked_for(folder):
    """The largest reduced load of fits, as the scene has it; and whether the laws of closing and of
    the crossover apply, which are those of a viscous fluid between walls without adhesion."""
    scene = read_parameters(scene_in(folder))
    return (float(scene["Load programme/Largest reduced load of fits"]),
            scene.get("Fluid/Rarefaction", "none") == "none" and
            scene.get("Contact/Adhesion/Enabled") != "true")


def samples_in(folder):
    """The quantities at each step with a positive reduced load: one row a step, with zeros where a
    quantity is unknown."""
    steps = read_table(folder / "leakage.csv")
    steps = steps.rows(steps["reduced_load"] > 0)
    throats = read_table(folder / "constrictions.csv")
    sound = is_trusted(steps["status"])
    place = {step: k for k, step in enumerate(throats["step"])}
    rows = [place.get(step) for step in steps["step"]]
    values = {"leak_rate": np.where(sound, np.abs(steps["leak_rate"]), 0.)}
    for name in ("gap", "length", "width"):
        values["throat_" + name] = np.array(
            [throats[name][row] if row is not None and is_sound else 0.
             for row, is_sound in zip(rows, sound)])
    if "theory_leak_rate" in steps:
        values["theory_leak_rate"] = np.abs(steps["theory_leak_rate"])
    return Table({"slip_length": steps.get("slip_length", np.zeros(steps.n_rows)),
                  "reduced_load": steps["reduced_load"], "status": steps["status"].astype(str),
                  "is_coarse": np.array(["coarse-throat" in text.split("+")
                                         for text in steps["validity"]], bool), **values})


def converged(samples, quantity):
    """Which rows have a value of a quantity."""
    return samples[quantity] > 0


def doubtless(samples, quantity):
    """Which rows can be used for exponents: those without any doubt."""
    return converged(samples, quantity) & (samples["status"] == "ok")


def resolved(samples, quantity):
    """Which rows can be used for the crossover: those whose throat is not too coarse."""
    return converged(samples, quantity) & ~samples["is_coarse"]


def local_slopes(samples, quantity):
    """(Fit, status) of each pair of neighbouring rows."""
    reduced = samples["reduced_load"]
    return [(fit_exponent(reduced[[i, j]], samples[quantity][[i, j]]),
             joined(samples["status"][[i, j]])) for i, j in neighbours(reduced)]


def fit_up_to(largest, samples, quantity):
    """The Fit to all rows without any doubt up to a reduced load, or None."""
    rows = samples.rows(doubtless(samples, quantity) & within(samples["reduced_load"], (0, largest)))
    return fit_exponent(rows["reduced_load"], rows[quantity])


def middle(fit):
    """The geometric mean of the ends of a window."""
    return np.sqrt(fit.start * fit.end)


def report(quantity, fit, slopes):
    """Print a fit, and a warning if local exponents within its window disagree."""
    print(f"exponent of {quantity}: {fit.exponent:.3f} ± {fit.error:.3f} for {fit.start:.3g} <= "
          f"1 - L/L_c <= {fit.end:.3g} ({fit.points} points)")
    local = [fit.exponent, *(slope.exponent for slope, _ in slopes if slope.end <= fit.end)]
    if max(local) - min(local) > SETTLED:
        warn(f"corrections to scaling: the local exponent of {quantity} drifts from "
             f"{min(local):.3f} to {max(local):.3f} within the fit")


def fits_of(samples, largest, has_law):
    """Yield the rows of fit.csv, and print the fits."""
    trusted = samples.rows(doubtless(samples, "leak_rate") & (samples["slip_length"] == 0))
    slopes = [fit for fit, _ in local_slopes(trusted, "leak_rate") if within(fit.end, (0, largest))]
    constant = closing_constant(np.array([middle(fit) for fit in slopes]),
                                np.array([fit.exponent for fit in slopes])) if has_law else np.nan
    for slip_length in np.unique(samples["slip_length"]):
        of_slip = samples.rows(samples["slip_length"] == slip_length)
        for quantity, (member, with_slip) in QUANTITIES.items():
            for fit, status in local_slopes(of_slip.rows(converged(of_slip, quantity)), quantity):
                law = getattr(closing_law(middle(fit), constant), member)
                yield (quantity, slip_length, "local", *fit,
                       with_slip if slip_length < 0 and has_law else law, status)
            fit = fit_up_to(largest, of_slip, quantity)
            if fit:
                yield quantity, slip_length, "fit", *fit, np.nan, "ok"
                report(quantity, fit,
                       local_slopes(of_slip.rows(doubtless(of_slip, quantity)), quantity))


def suffice(result, samples, window, serves):
    """Whether at least two of the steps in a window, or all of them, have a leak rate that can be
    used for a result; and a warning about the others, or None."""
    samples = samples.rows(within(samples["reduced_load"], window))
    used = serves(samples, "leak_rate")
    n_used, n_steps = np.count_nonzero(used), samples.n_rows
    if n_used == n_steps:
        return True, None
    others = joined("coarse-throat" if serves is resolved and is_coarse else status for
                    status, is_coarse in zip(samples["status"][~used], samples["is_coarse"][~used]))
    return n_used >= 2, (
        (f"no {result}, which takes two steps" if n_used < 2 else result) +
        f": {n_used} of {n_steps} steps with 1 - L/L_c from {window[0]:.3g} to {window[1]:.3g} "
        f"serve; the others are left out for {others}")


def summary_of(samples, largest, thresholds, has_law):
    """The entries of ensemble.csv for a run at the slip length nearest to zero; the words for its
    status if a result is missing; and the warnings."""
    samples = samples.rows(nearest_slip(samples))
    result, words, warnings = {}, [], []
    for word, name, window, serves in (
            ("no-exponent", "exponent of leak_rate", (0, largest), doubtless),
            ("no-crossover", "crossover load", EXPONENTIAL_DECAY, resolved)):
        is_enough, warning = suffice(name, samples, window, serves)
        words += [] if is_enough else [word]
        warnings += [warning] if warning else []
    fit = fit_up_to(largest, samples, "leak_rate")
    result["exponent"], result["exponent_error"] = (fit.exponent, fit.error) if fit else \
        (np.nan, np.nan)
    slip = samples["slip_length"].max(initial=-np.inf)
    loads = thresholds.rows(thresholds["slip_length"] == slip)
    critical = 0.5 * (loads["critical_load_lower"] + loads["critical_load_upper"])
    for prefix, name in (("", "leak rate"), ("theory_", "theory's leak rate")):
        quantity, result[prefix + "crossover"] = prefix + "leak_rate", np.nan
        if quantity in samples:
            rows = samples.rows(resolved(samples, quantity))
            rate = decay_rate(rows["reduced_load"], rows[quantity])
            reason = None
            if not has_law or slip < 0:
                reason = ("the exponent 69/20 is that of a viscous fluid without slip between "
                          "walls that do not attract")
            elif rate < LEAK_RATE_EXPONENT:
                reason = (f"its logarithm rises by less than 69/20 times 1 - L/L_c from "
                          f"{EXPONENTIAL_DECAY[0]:.3g} to {EXPONENTIAL_DECAY[1]:.3g}")
            else:
                result[prefix + "crossover"] = crossover(rate)
            if reason and np.isfinite(rate):
                warnings.append(f"no crossover load of the {name}: {reason}")
                words += [] if prefix else ["no-crossover"]
        result[prefix + "crossover_load"] = ((1 - result[prefix + "crossover"]) * critical[0]
                                             if critical.size else np.nan)
    return result, joined(words), warnings


def entry(value):
    """A number with all its digits, or a text as it is."""
    return f"{value:.17g}" if isinstance(value, float) else str(value)


def write(path, header, rows):
    """Write a table of such entries."""
    write_table(path, header, ([entry(value) for value in row] for row in rows))


def fit_run(folder, largest, has_law):
    """Write fit.csv, and print the fits and warnings."""
    samples = samples_in(folder)
    write(folder / "fit.csv", FIT_COLUMNS, fits_of(samples, largest, has_law))
    for warning in summary_of(samples, largest, read_table(folder / "threshold.csv"), has_law)[2]:
        warn(warning)


def fit_realisation(row, folder, largest, has_law):
    """Complete a row of ensemble.csv by the fits; return the reduced load of the crossover."""
    if row["status"] == "failed":
        return np.nan
    path = folder / f"realisation-{row['realisation']}"
    found, words, _ = summary_of(samples_in(path), largest, read_table(path / "threshold.csv"),
                                 has_law)
    row.update({name: entry(found[name]) for name in found if name in row})
    status = row["status"].split("+")
    row["status"] = joined([*(word for word in status if not word.startswith("no-")), words])
    return found["crossover"]


def scatter_of(samples):
    """A row of ensemble_summary.csv without the name: mean, scatter, number known and missing."""
    known = samples[np.isfinite(samples)]
    return (known.mean() if known.size else np.nan,
            known.std(ddof=1) if known.size > 1 else np.nan, known.size, samples.size - known.size)


def fit_ensemble(folder, largest, has_law):
    """Complete ensemble.csv, write ensemble_summary.csv and warn of what is unknown."""
    path = folder / "ensemble.csv"
    with open(path, newline="", encoding="utf-8") as file:
        reader = csv.DictReader(file)
        columns, rows = reader.fieldnames, list(reader)
    crossovers = np.array([fit_realisation(row, folder, largest, has_law) for row in rows])
    write(path, columns, ([row[name] for name in columns] for row in rows))
    table = read_table(path)
    table["critical_load"] = 0.5 * (table["critical_load_lower"] + table["critical_load_upper"])
    table["crossover_reduced_load"] = crossovers
    quantities = [name for name in ("contact_area", "critical_load", "crossover_load",
                                    "crossover_reduced_load", "exponent", "theory_crossover_load")
                  if name in table]
    scatter = {name: scatter_of(table[name]) for name in quantities}
    write(folder / "ensemble_summary.csv",
          ("quantity", "mean", "standard_deviation", "samples", "missing"),
          ((name, *numbers) for name, numbers in scatter.items()))
    for name, (_, _, n_known, n_missing) in scatter.items():
        if n_missing > 0:
            warn(f"{name} is known of {n_known} of {len(rows)} realisations; the column status of "
                 "ensemble.csv or the log of the realisation tells why, or Load programme/Reduced "
                 "loads has too few steps for it")


def window(text):
    """The largest reduced load of a fit, as the scene's parameter allows it."""
    if not 0 < float(text) <= 1:
        raise argparse.ArgumentTypeError(f"{text} is not above 0 and at most 1")
    return float(text)


def main(arguments=None):
    """Fit the folder of the command line and return the exit status."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("folder", metavar="OUTPUT_DIR", type=pathlib.Path)
    parser.add_argument("--largest", type=window, metavar="REDUCED_LOAD",
                        help="fit up to this in place of the scene's Largest reduced load of fits")
    options = parser.parse_args(arguments)
    folder = options.folder
    try:
        largest, has_law = asked_for(folder)
        largest = largest if options.largest is None else options.largest
        (fit_ensemble if (folder / "ensemble.csv").exists() else fit_run)(folder, largest, has_law)
    except (OSError, KeyError, ValueError) as problem:
        print(f"fit.py: {folder} holds no results of a search for the threshold that can be "
              f"fitted ({' '.join(f'{type(problem).__name__}: {problem}'.split())}).")
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
