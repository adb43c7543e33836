# SPDX-License-Identifier: GPL-2.0-or-later
"""At which load, and at which contact area, 16 surfaces of one kind seal.

    python3 threshold_of_seeds.py [GRID POINTS]
"""
import sys

import matplotlib.pyplot as plt
import strait

n = int(sys.argv[1]) if sys.argv[1:] else 256
scene = strait.Scene(contact=dict(grid_points=n), surface=dict(short_cut_off_wavelength=16 / n),
                     fluid=dict(target_accuracy=0.1),
                     load_programme=dict(find_threshold=True, pressures=[]))
table = strait.sweep(scene, {"Surface/Seed": range(1, 17)}, processes=2, table="threshold.csv")
load = (table["critical_load_lower"] + table["critical_load_upper"]) / 2
print(f"critical load {load.mean():.3f} ± {load.std(ddof=1):.3f} E*, "
      f"contact area {table['contact_area'].mean():.3f} ± {table['contact_area'].std(ddof=1):.3f}")
plt.plot(load, table["contact_area"], "o")
for seed, x, y in zip(table["Surface/Seed"], load, table["contact_area"]):
    plt.annotate(f" {seed}", (x, y))
plt.xlabel("critical load / E*")
plt.ylabel("contact area there")
plt.savefig("threshold_of_seeds.png", bbox_inches="tight")
