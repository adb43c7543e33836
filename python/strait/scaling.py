# SPDX-License-Identifier: GPL-2.0-or-later
"""How a leak rate vanishes at the critical load L_c: exponents against the reduced load
ε = 1 − L/L_c, where the power law begins, and how the last constriction closes.

    rows = run.table.rows(run.table["status"] == "ok")
    fit = fit_exponent(rows["reduced_load"], rows["leak_rate"])
    print(f"{fit.exponent:.3f} ± {fit.error:.3f}")

Needs numpy alone, except closing_constant(), which needs scipy.
"""
import typing

import numpy as np

LEAK_RATE_EXPONENT = 69 / 20  # that of the paper, for a viscous fluid between dry elastic walls
# Reduced loads at which the leak rate falls exponentially with the load. Half of the lower end
# would include the beginning of the power law, a larger upper end loads with hardly any contact.
EXPONENTIAL_DECAY = (0.3, 0.7)
SADDLE = -0.1  # C of closing_law(), fitted to a square saddle at ε = 1e-2 to 1e-4


class Fit(typing.NamedTuple):
    """A power β of a quantity ∝ ε^β over a window of ε."""
    start: float     # smallest ε
    end: float       # largest ε
    exponent: float  # β
    error: float     # standard error of the fit; 0 for two points
    points: int      # number of points


class Exponents(typing.NamedTuple):
    """Local exponents of a constriction that closes, each of a quantity ∝ ε^β."""
    gap: np.ndarray        # at the narrowest point
    width: np.ndarray      # half the width of the channel there
    length: np.ndarray     # along the channel, over which the gap doubles
    leak_rate: np.ndarray  # ∝ gap^(5/2) · width


def within(reduced_load, window):
    """Which reduced loads lie in a window; those of steps are the wanted ones only to rounding."""
    return (reduced_load >= window[0] - 1e-9) & (reduced_load <= window[1] + 1e-9)


def _fit_line(x, y):
    """The slope of y against x by least squares, and its standard error."""
    x, y = x - np.mean(x), y - np.mean(y)
    slope = np.sum(x * y) / np.sum(x * x)
    left_over = np.sum((y - slope * x)**2)
    return slope, np.sqrt(left_over / ((x.size - 2) * np.sum(x * x))) if x.size > 2 else 0.


def fit_exponent(reduced_load, values):
    """A Fit to positive values by least squares of logarithms; None without two different
    loads."""
    if len(reduced_load) == 0 or np.min(reduced_load) == np.max(reduced_load):
        return None
    exponent, error = _fit_line(np.log(reduced_load), np.log(values))
    return Fit(np.min(reduced_load), np.max(reduced_load), exponent, error, len(values))


def neighbours(reduced_load):
    """Pairs of indices of different loads with none between them, in the order of falling ε."""
    order = np.argsort(-reduced_load, kind="stable")
    return [pair for pair in zip(order[:-1], order[1:])
            if reduced_load[pair[1]] < reduced_load[pair[0]]]


def decay_rate(reduced_load, leak_rate):
    """The rate s of a leak rate ∝ exp(s ε), by least squares over EXPONENTIAL_DECAY; NaN without
    two different loads in that range."""
    chosen = within(reduced_load, EXPONENTIAL_DECAY)
    x = reduced_load[chosen]
    if x.size == 0 or x.min() == x.max():
        return np.nan
    return _fit_line(x, np.log(leak_rate[chosen]))[0]


def crossover(rate):
    """The reduced load at which exp(s ε), with s from decay_rate(), has the local exponent
    LEAK_RATE_EXPONENT; NaN if it would be above 1, so that there is no crossover."""
    return LEAK_RATE_EXPONENT / rate if rate >= LEAK_RATE_EXPONENT else np.nan


def closing_law(reduced_load, constant=SADDLE):
    """Exponents of slender-contact asymptotics (doc/theory.md), formal and without proof, which
    drift with Λ = 1 + √(½ ln(1/ε) + C). NaN where Λ is not real: there the constriction is not a
    small part of the contact."""
    with np.errstate(invalid="ignore"):
        slenderness = 1 + np.sqrt(constant - 0.5 * np.log(reduced_load))
    gap, width = 1 + 0.5 / slenderness, 1 / (2 + slenderness**-2)
    return Exponents(gap, width, 0.5 * gap, 2.5 * gap + width)


def closing_constant(reduced_load, exponents):
    """C of the closing_law() whose exponents of the leak rate have the same mean as the measured
    ones; NaN if there is none."""
    from scipy.optimize import brentq

    if len(reduced_load) == 0:
        return np.nan

    def excess(constant):
        return np.sum(closing_law(reduced_load, constant).leak_rate - exponents)

    # From the least constant with which the largest ε has a Λ to one with which the exponents are
    # those of the limit ε → 0: they fall all the way.
    least, most = 0.5 * np.log(np.max(reduced_load)), 1e7
    if not excess(least) > 0 > excess(most):
        return np.nan
    return brentq(excess, least, most)
