# SPDX-License-Identifier: GPL-2.0-or-later
"""Leak rate against load for some rough surfaces of one kind, with brackets.

    python3 rough_sweep.py [GRID POINTS]
"""
import sys

import matplotlib.pyplot as plt
import numpy as np
import strait

n = int(sys.argv[1]) if sys.argv[1:] else 256
scene = strait.Scene({"Contact/Grid points": n, "Surface/Short cut-off wavelength": 16 / n,
                      "Load programme/Pressures": np.linspace(0.02, 0.16, 6)})
table = strait.sweep(scene, {"Surface/Seed": range(1, 5)}, processes=2)
print(f"{table.n_rows} steps, the leak rates span a factor of "
      f"{table['leak_rate'].max() / table['leak_rate'].min():.1e}")
for seed, rows in table.groups("Surface/Seed"):
    error = [rows["leak_rate"] - rows["leak_rate_lower"],
             rows["leak_rate_upper"] - rows["leak_rate"]]
    plt.errorbar(rows["pressure"], rows["leak_rate"], error, marker=".", label=f"seed {seed}")
plt.yscale("log")
plt.xlabel("pressure / E*")
plt.ylabel("leak rate")
plt.legend()
plt.savefig("rough_sweep.png", bbox_inches="tight")
