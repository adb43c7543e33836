#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""What processes side by side save in a sweep: seconds of 20 scenes one after the other and in
several processes, and their ratio; on two idle cores it should be 0.6 or less.

    PYTHONPATH=build/python sweep_cost.py [PROCESSES, default 2 [GRID POINTS, default 256]]
"""
import sys
import time

import numpy as np

import strait


def main(processes: int = 2, points: int = 256) -> None:
    scene = strait.Scene(contact=dict(grid_points=points),
                         surface=dict(short_cut_off_wavelength=16 / points),
                         load_programme=dict(pressures=[0.05, 0.1]))
    tables, seconds = [], []
    for n in (1, processes):
        begin = time.perf_counter()
        tables.append(strait.sweep(scene, {"Surface/Seed": range(1, 21)}, processes=n))
        seconds.append(time.perf_counter() - begin)
    assert np.array_equal(tables[0]["leak_rate"], tables[1]["leak_rate"])
    print(f"one process {seconds[0]:.1f} s, {processes} processes {seconds[1]:.1f} s, "
          f"ratio {seconds[1] / seconds[0]:.2f}")


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
