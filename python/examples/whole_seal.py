# SPDX-License-Identifier: GPL-2.0-or-later
"""The O-ring of prm/oring_seal.prm: the leak rate of the whole seal, with a band of 90 %.

    python3 whole_seal.py [GRID POINTS]
"""
import pathlib
import sys

import matplotlib.pyplot as plt
import strait

n = int(sys.argv[1]) if sys.argv[1:] else 512
here = pathlib.Path(__file__).resolve()
file = next(path for folder in ("prm", "strait/prm") for parent in here.parents
            if (path := parent / folder / "oring_seal.prm").exists())
scene = strait.Scene.from_prm(file, contact=dict(grid_points=n),
                              surface=dict(short_cut_off_wavelength=4e-4 * 8 / n),
                              realisations=dict(seeds=range(1, 9 if n > 128 else 5)),
                              output=dict(report=False, pictures=False))
run = scene.run("whole_seal")
table, load = run.csv("seal.csv"), run.csv("seal_load.csv")
print(f"{table['leak_rate_median'][0]:.3g} {table['unit'][0]} at {table['pressure'][0]:.3g} Pa, "
      f"in 90 % of seals {table['leak_rate_5_percent'][0]:.2g} to "
      f"{table['leak_rate_95_percent'][0]:.2g}")
plt.semilogy(table["pressure"], table["leak_rate_median"], ".-", label="median")
plt.fill_between(table["pressure"], table["leak_rate_5_percent"], table["leak_rate_95_percent"],
                 alpha=0.3, label="90 % of seals")
plt.axvline(load["load_95_percent"][0], color="k", linestyle=":", label="leaks as wanted")
plt.xlabel("mean pressure (Pa)")
plt.ylabel(f"leak rate ({table['unit'][0]})")
plt.legend()
plt.savefig("whole_seal.png", bbox_inches="tight")
