#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Poiseuille coefficient Q_P of a gas between parallel walls, from kinetic theory.

    tools/bgk_poiseuille.py DELTA [DELTA ...]

The linearised BGK equation between walls that reflect diffusely leaves one integral
equation for the velocity (Cercignani and Daneri, J. Appl. Phys. 34, 3509, 1963),
    psi(x) = 1 + 1/sqrt(pi) * integral of T_-1(|x - y|) psi(y) dy over a gap of width delta,
    T_n(x) = integral of t^n exp(-t^2 - x/t) dt over t > 0,
and Q_P = (integral of psi)/delta^2 - 1/delta. It is solved by Galerkin's method with
functions that are constant on panels, narrow ones at the walls; their integrals are
differences of T_1. Q_P is extrapolated twice in the number of panels, which begins with
10 up to delta = 2^-10, 90 up to 4 and 180 beyond. Below delta = 1e-4 the differences
cancel; use the expansion in source/interface/rarefied_gas.cc there. The table in that file
is the output of this script, but for its first entry, which is that of the expansion.
"""
import sys

import numpy as np

STEP = 0.04  # of the trapezoidal rule in ln t, which is exact to rounding
LN_T = np.arange(-22.0, 3.2, STEP)
T = np.exp(LN_T)


def t_1(x):
    """T_1 at each number of an array."""
    flat = np.ravel(x)
    result = np.empty(flat.size)
    for part in np.array_split(np.arange(flat.size), max(1, flat.size // 4000)):
        result[part] = np.exp(-flat[part, None] / T) @ np.exp(2 * LN_T - T * T) * STEP
    return result.reshape(np.shape(x))


def coefficient(delta, panels):
    """Q_P with this number of panels; its error falls as the inverse square of that."""
    u = np.linspace(0.0, 1.0, panels + 1)
    ends = delta * u**3 * (10.0 - 15.0 * u + 6.0 * u * u)
    widths = np.diff(ends)
    table = t_1(np.abs(ends[:, None] - ends[None, :]))
    matrix = np.triu(table[1:, :-1] + table[:-1, 1:] - table[1:, 1:] - table[:-1, :-1], 1)
    matrix += matrix.T
    matrix[np.diag_indices(panels)] = 2.0 * (
        0.5 * np.sqrt(np.pi) * widths + t_1(widths) - 0.5)
    psi = np.linalg.solve(np.diag(widths) - matrix / np.sqrt(np.pi), widths)
    return widths @ psi / delta**2 - 1.0 / delta


def extrapolated(delta, panels):
    """Q_P, extrapolated from this number of panels, twice and four times as many."""
    coarse, middle, fine = (coefficient(delta, n * panels) for n in (1, 2, 4))
    first, second = (4.0 * middle - coarse) / 3.0, (4.0 * fine - middle) / 3.0
    return (16.0 * second - first) / 15.0


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    deltas = [float(argument) for argument in sys.argv[1:]]
    if not all(1e-4 <= delta < float("inf") for delta in deltas):
        sys.exit("bgk_poiseuille.py: DELTA must be a number of at least 1e-4")
    for delta in deltas:
        panels = 10 if delta <= 2.0**-10 else 90 if delta <= 4.0 else 180
        print(f"{delta:.9g} {extrapolated(delta, panels):.6f}")


if __name__ == "__main__":
    main()
