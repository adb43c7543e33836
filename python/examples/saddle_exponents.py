# SPDX-License-Identifier: GPL-2.0-or-later
"""How the leak rate of an isolated constriction vanishes where it closes: with an exponent that
drifts with the logarithm of 1 − p/p_c, unless the fluid does not see the last of the gap.

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
for slip_length, rows in run.table.groups("slip_length"):
    log_load, log_rate = np.log(rows["reduced_load"]), np.log(rows["leak_rate"])
    middle = np.exp((log_load[1:] + log_load[:-1]) / 2)
    exponent = np.diff(log_rate) / np.diff(log_load)
    print(f"exponents {exponent[0]:.3f} to {exponent[-1]:.3f} at a slip length of {slip_length:g}")
    plt.semilogx(middle, exponent, ".-", label=f"slip length {slip_length:g}")
slenderness = 1 + np.sqrt(np.log(1 / middle) / 2 - 0.13)
gap, width = 1 + 0.5 / slenderness, 1 / (2 + slenderness**-2)  # the exponents of the throat
plt.semilogx(middle, 2.5 * gap + width, "k--", label="law of closing")
plt.axhline(69 / 20, color="grey", linewidth=0.5)
plt.gca().invert_xaxis()
plt.xlabel("1 − p/p_c")
plt.ylabel("local exponent of the leak rate")
plt.legend()
plt.savefig("saddle_exponents.png", bbox_inches="tight")
