# SPDX-License-Identifier: GPL-2.0-or-later
"""How much more a seal leaks because the fluid presses its walls apart.

    python3 feedback.py [GRID POINTS]
"""
import sys

import matplotlib.pyplot as plt
import numpy as np
import strait

n = int(sys.argv[1]) if sys.argv[1:] else 128
load, inlet_pressures = 0.1, np.linspace(0.01, 0.08, 4)
scene = strait.Scene(contact=dict(grid_points=n), surface=dict(short_cut_off_wavelength=8 / n),
                     fluid=dict(target_accuracy=0.05))
stiff = strait.Seal(scene)
soft = strait.Seal(scene.replace({"Fluid/Wall feedback/Enabled": True}))
for seal, name in (stiff, "without feedback"), (soft, "with feedback"):
    path = seal.follow([seal.control(load, inlet_pressure=p) for p in inlet_pressures])
    rates = np.array([seal.flow(state).leak_rate for state in path])
    print(f"{name}: {rates[0]:.3e} to {rates[-1]:.3e}")
    plt.plot(inlet_pressures / load, rates / inlet_pressures, ".-", label=name)
plt.yscale("log")
plt.xlabel("fluid's pressure over load")
plt.ylabel("leak rate over fluid's pressure")
plt.legend()
plt.savefig("feedback.png", bbox_inches="tight")
