# SPDX-License-Identifier: GPL-2.0-or-later
"""A ring between rough faces: where the fluid goes from the inner to the outer circle.

    python3 ring.py [GRID POINTS]
"""
import pathlib
import sys

import matplotlib.pyplot as plt
import numpy as np
import strait

n = int(sys.argv[1]) if sys.argv[1:] else 256
here = pathlib.Path(__file__).resolve()
mesh = next(path for folder in ("meshes", "strait/meshes") for parent in here.parents
            if (path := parent / folder / "ring.msh").exists())
scene = strait.Scene({"Contact/Grid points": n, "Surface/Short cut-off wavelength": 8 / n,
                      "Surface/Roll-off wavelength": 0.25, "Fluid/Mesh": mesh})
seal = strait.Seal(scene)
state = seal.solve(0.1)
flow = seal.flow(state, fields=True)
print(f"leak rate {flow.leak_rate:.3e}, between {flow.lower:.3e} and {flow.upper:.3e}")
plt.figure(figsize=(6, 5))
plt.imshow(np.where(state.gap > 0, np.nan, 0.), cmap="gray", origin="lower", extent=(0, 1, 0, 1))
plt.imshow(flow.pressure, origin="lower", extent=(0, 1, 0, 1))
plt.colorbar(label="pressure of the fluid")
plt.plot(flow.constriction_x, flow.constriction_y, "ro", fillstyle="none", markersize=15)
plt.savefig("ring.png", bbox_inches="tight")
