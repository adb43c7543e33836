# SPDX-License-Identifier: GPL-2.0-or-later
"""Helium through a metal contact: the throughput of a viscous gas, and of a rarefied one.

    python3 gas.py [GRID POINTS]
"""
import sys

import matplotlib.pyplot as plt
import numpy as np
import strait

n = int(sys.argv[1]) if sys.argv[1:] else 128
scene = strait.Scene(units=dict(length="m", pressure="Pa", time="s"),
                     surface=dict(size=1e-4, roll_off_wavelength=5e-5,
                                  short_cut_off_wavelength=1e-4 * 8 / n, rms_value=0.05),
                     contact=dict(grid_points=n, youngs_moduli=(7e10, 2.1e11),
                                  poisson_ratios=(0.33, 0.3)),
                     fluid=dict(state="gas", gas="helium"),
                     load_programme=dict(pressures=1e8))
table = strait.sweep(scene, {"Fluid/Rarefaction": ["none", "slip", "transitional"],
                             "Fluid/Inlet pressure": np.geomspace(1e3, 1e6, 4)}, processes=2)
throughput = {}
for model, rows in table.groups("Fluid/Rarefaction"):
    pressure = rows["Fluid/Inlet pressure"]
    throughput[model] = rows["leak_rate"] * pressure / 2  # volumes are at mean pressure
    plt.loglog(pressure, throughput[model], ".-", label=model)
viscous, rarefied = throughput["none"], throughput["transitional"]
print(f"rarefied over viscous: {rarefied[0] / viscous[0]:.3g} at 1 kPa, "
      f"{rarefied[-1] / viscous[-1]:.3g} at 1 MPa")
plt.xlabel("inlet pressure (Pa), against vacuum")
plt.ylabel("throughput (Pa m³/s)")
plt.legend(title="rarefaction")
plt.savefig("gas.png", bbox_inches="tight")
