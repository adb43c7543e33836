# SPDX-License-Identifier: GPL-2.0-or-later
"""How the leak rate of an isolated constriction vanishes as it closes: with an exponent that
drifts with the logarithm of 1 − p/p_c, or with 3 if an immobile layer of fluid closes it first.

    python3 saddle_exponents.py [GRID POINTS]
"""
import sys

import matplotlib.pyplot as plt
import numpy as np
import strait

n = int(sys.argv[1]) if sys.argv[1:] else 512
scene = strait.Scene(surface=dict(kind="square saddle"),
                     contact=dict(grid_points=n, tolerance=1e-9, zoom=dict(enabled=True)),
                     fluid=dict(slip_length=(0, -1e-2), target_accuracy=0.01),
                     load_programme=dict(find_threshold=True, threshold_tolerance=1e-7, pressures=(),
                                         reduced_loads=np.geomspace(0.1, 24 / n**2, 6)))
run = scene.run()
print(f"critical load {run.csv('threshold.csv')['critical_load_lower'][0]:.5f}")
fits = run.csv("fit.csv")
local = fits.rows((fits["quantity"] == "leak_rate") & (fits["kind"] == "local"))
for slip_length, rows in local.groups("slip_length"):
    middle, exponent = np.sqrt(rows["from"] * rows["to"]), rows["exponent"]
    print(f"exponents {exponent[0]:.3f} to {exponent[-1]:.3f} at a slip length of {slip_length:g}")
    plt.semilogx(middle, exponent, ".-", label=f"slip length {slip_length:g}")
plt.semilogx(middle, strait.closing_law(middle, -0.13).leak_rate, "k--", label="law of closing")
plt.axhline(69 / 20, color="grey", linewidth=0.5)
plt.gca().invert_xaxis()
plt.xlabel("1 − p/p_c")
plt.ylabel("local exponent of the leak rate")
plt.legend()
plt.savefig("saddle_exponents.png", bbox_inches="tight")
