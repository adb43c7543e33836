# SPDX-License-Identifier: GPL-2.0-or-later
"""Asperities that yield: unloading, and loading again, do not follow the first loading.

    python3 plastic_cycle.py [GRID POINTS]
"""
import sys

import matplotlib.pyplot as plt
import numpy as np
import strait

n = int(sys.argv[1]) if sys.argv[1:] else 256
seal = strait.Seal(strait.Scene(surface=dict(short_cut_off_wavelength=8 / n),
                                contact=dict(grid_points=n, yielding="cut-off", hardness=0.5)))
up = np.linspace(0.01, 0.1, 6)
loading = seal.follow(up)
unloading = seal.follow(up[-2::-1], from_=loading[-1])
again = seal.follow(np.append(up[1:], 0.12), from_=unloading[-1])
_, (left, right) = plt.subplots(1, 2, figsize=(9, 4), layout="constrained")
for path, name in (loading, "loading"), (unloading, "unloading"), (again, "again"):
    leak_rates = [seal.flow(state).leak_rate for state in path]
    left.plot(path["nominal_pressure"], path["contact_area"], ".-", label=name)
    right.semilogy(path["nominal_pressure"], leak_rates, ".-", label=name)
print(f"contact area at {up[0]}: {loading[0].contact_area:.4f}, "
      f"after {up[-1]}: {unloading[-1].contact_area:.4f}")
left.set(xlabel="pressure / E*", ylabel="contact area")
right.set(xlabel="pressure / E*", ylabel="leak rate")
left.legend()
plt.savefig("plastic_cycle.png", bbox_inches="tight")
