# SPDX-License-Identifier: GPL-2.0-or-later
"""Water that a contact traps carries load, during loading and unloading.

    python3 wet_and_dry.py [GRID POINTS]
"""
import sys

import matplotlib.pyplot as plt
import numpy as np
import strait

n = int(sys.argv[1]) if sys.argv[1:] else 256
loads = np.linspace(0.05, 0.4, 8)
scene = strait.Scene(contact=dict(grid_points=n), surface=dict(short_cut_off_wavelength=16 / n),
                     fluid=dict(inlet_pressure=0.02, target_accuracy=0.05,
                                wall_feedback=dict(enabled=True)))
figure, (left, right) = plt.subplots(1, 2, figsize=(9, 4))
for law, name, color in ("drained", "dry", "C1"), ("incompressible", "wet", "C0"):
    seal = strait.Seal(scene.replace({"Fluid/Wall feedback/Trapped fluid": law}))
    up = seal.follow(loads)
    down = seal.follow(loads[::-1], from_=up[-1])
    print(f"{name}: at a load of {loads[-1]:.2g} the fluid carries "
          f"{up[-1].fluid_load:.4f}, contact {up[-1].contact_area:.4f}")
    for path, branch, line in (up, "loading", ".-"), (down, "unloading", "x--"):
        left.plot(path["nominal_pressure"], path["contact_area"], line, color=color,
                  label=f"{name}, {branch}")
        right.plot(path["nominal_pressure"], path["fluid_load"], line, color=color)
left.set_ylabel("contact area")
left.legend()
right.set_ylabel("load on the fluid")
for axes in left, right:
    axes.set_xlabel("load")
figure.tight_layout()
figure.savefig("wet_and_dry.png")
