# SPDX-License-Identifier: GPL-2.0-or-later
"""A sphere on an elastic half-space, beside the theory of Hertz (1881).

    python3 hertz.py [GRID POINTS]
"""
import sys

import matplotlib.pyplot as plt
import numpy as np
import strait

n = int(sys.argv[1]) if sys.argv[1:] else 512
radius, load = 2., 1e-3  # in units of the box and of E*
seal = strait.Seal(strait.Scene(surface=dict(kind="sphere", amplitude=radius),
                                contact=dict(grid_points=n), fluid=dict(enabled=False)))
pressure = seal.solve(load).pressure

a = (3 * load * radius / 4) ** (1 / 3)
peak = 2 * a / (np.pi * radius)
x = (np.arange(n) - n // 2) / n
print(f"largest pressure over Hertz's: {pressure.max() / peak:.4f}")
plt.plot(x / a, pressure[n // 2] / peak, ".", label=f"{n} × {n} points")
plt.plot(x / a, np.sqrt(np.maximum(0, 1 - (x / a) ** 2)), label="Hertz")
plt.xlabel("distance over contact radius")
plt.ylabel("pressure over Hertz's largest")
plt.xlim(-1.5, 1.5)
plt.legend()
plt.savefig("hertz.png", bbox_inches="tight")
