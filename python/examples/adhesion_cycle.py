# SPDX-License-Identifier: GPL-2.0-or-later
"""Four peaks with adhesion are pressed on a half-space and torn off again: the contact jumps.

    python3 adhesion_cycle.py [GRID POINTS]
"""
import sys

import matplotlib.pyplot as plt
import numpy as np
import strait

n = int(sys.argv[1]) if sys.argv[1:] else 256
seal = strait.Seal(strait.Scene(
    surface=dict(kind="square saddle"), fluid=dict(enabled=False),
    contact=dict(grid_points=n, adhesion=dict(enabled=True, surface_energy=0.2, tabor_number=2)),
    load_programme=dict(jump_tolerance=1e-3)))
loading = seal.follow(np.linspace(0.1, 1.4, 27))
unloading = seal.follow(np.linspace(1.4, -0.2, 33), from_=loading[-1])
jumps = loading.jumps + unloading.jumps
lost = sum(jump.dissipated for jump in jumps if not jump.is_pull_off)
print(f"{len(jumps)} jumps, {lost:.4f} of energy an area lost")
for path, name in (loading, "loading"), (unloading, "unloading"):
    plt.plot(path["nominal_pressure"], path["contact_area"], ".-", label=name)
for jump in jumps:
    after = 0 if jump.is_pull_off else jump.after.contact_area
    plt.annotate("", (jump.before.pressure, after),
                 (jump.before.pressure, jump.before.contact_area), arrowprops=dict(arrowstyle="->"))
plt.xlabel("pressure")
plt.ylabel("contact area")
plt.legend()
plt.savefig("adhesion_cycle.png", bbox_inches="tight")
