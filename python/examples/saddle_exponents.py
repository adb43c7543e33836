# SPDX-License-Identifier: GPL-2.0-or-later
"""How the leak rate of an isolated constriction vanishes where it closes: as a power of
1 − p/p_c, with an exponent of 3.45.

    python3 saddle_exponents.py [GRID POINTS]
"""
import sys

import matplotlib.pyplot as plt
import numpy as np
import strait

n = int(sys.argv[1]) if sys.argv[1:] else 1024
seal = strait.Seal(strait.Scene(surface=dict(kind="square saddle"), contact=dict(grid_points=n),
                                fluid=dict(target_accuracy=0.01)))
critical = seal.find_transition(first=1.4).middle  # 0.2286 · 2π E* Δ/L
reduced = np.geomspace(0.1, 12 / n, 6)
flows = [seal.flow(state) for state in seal.follow(critical * (1 - reduced))]
leak_rate = np.array([flow.leak_rate for flow in flows])

exponent, offset = np.polyfit(np.log(reduced), np.log(leak_rate), 1)
print(f"critical load {critical:.5f}, exponent {exponent:.3f}")
error = [[flow.leak_rate - flow.lower for flow in flows],
         [flow.upper - flow.leak_rate for flow in flows]]
plt.errorbar(reduced, leak_rate, error, fmt=".", label=f"{n} × {n} points")
plt.loglog(reduced, np.exp(offset) * reduced**exponent, label=f"exponent {exponent:.2f}")
plt.xlabel("1 − p/p_c")
plt.ylabel("leak rate")
plt.legend()
plt.savefig("saddle_exponents.png", bbox_inches="tight")
