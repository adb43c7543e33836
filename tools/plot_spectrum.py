# SPDX-License-Identifier: GPL-2.0-or-later
"""spectrum.png from spectrum.csv: the spectrum of a surface and the self-affine fit to it."""
import numpy as np
from matplotlib.figure import Figure

from plot_common import BLUE, VERMILLION, save
from strait_results import read_table


def draw_spectrum(path, units):
    """Draw the density against the wave number on double logarithmic axes."""
    table = read_table(path)
    q, density = table["wave_number"], table["density"]
    length = units.get("length") if units else None
    shown = density > 1e-12 * density.max()
    figure = Figure(figsize=(5.2, 4.2), layout="constrained")
    axes = figure.subplots()
    axes.loglog(q[shown], density[shown], "o", color=BLUE, label="surface")
    fitted = np.isfinite(table["fit"])
    if fitted.any():
        slope = np.diff(np.log(table["fit"][fitted]))[-1] / np.diff(np.log(q[fitted]))[-1]
        axes.loglog(q[fitted], table["fit"][fitted], "-", color=VERMILLION,
                    label=f"self-affine, $H$ = {-slope / 2 - 1:.2f}")
    axes.set(xlabel=f"Wave number $q$ (1/{length})" if length else "Wave number $q$",
             ylabel=f"Power spectral density $C(q)$ ({length}⁴)" if length
             else "Power spectral density $C(q)$")
    axes.grid(True)
    axes.legend()
    save(figure, path.with_suffix(".png"))
