#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Run one of python/examples on a small grid, and check what it prints and draws.

    run_example.py EXAMPLE FOLDER
"""
import pathlib
import re
import shutil
import subprocess
import sys

# Grid points, and bounds of the first numbers that are printed.
EXPECTED = {
    "hertz": (128, (0.99, 1.01)),
    "saddle_exponents": (128, (1.43, 1.44), (3.2, 3.35), (2.99, 3.02)),
    "rough_sweep": (64, (24, 24), (1e2, 1e5)),
    "threshold_of_seeds": (64, (0.2, 0.35)),
    "feedback": (32, (1e-9, 1e-5), (1e-9, 1e-5)),
    "wet_and_dry": (64, (0.4, 0.4), (0.001, 0.01), (0.4, 0.7),
                    (0.4, 0.4), (0.03, 0.2), (0.4, 0.6)),
    "adhesion_cycle": (128, (3, 5), (1e-4, 1e-1)),
    "gas": (32, (10., 1e5)),
    "plastic_cycle": (64, (0.01, 0.01), (0.01, 0.05), (0.1, 0.1), (0.03, 0.2)),
    "ring": (128, (1e-9, 1e-4)),
    "whole_seal": (64, (1e-3, 1e3)),
}
NUMBER = re.compile(r"(?<![\w.])-?\d+(?:\.\d+)?(?:e[-+]\d+)?")


def main():
    example, folder = map(pathlib.Path, sys.argv[1:])
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    points, *bounds = EXPECTED[example.stem]
    ended = subprocess.run([sys.executable, example, str(points)], cwd=folder, text=True,
                           capture_output=True, check=False)
    print(ended.stdout, ended.stderr)
    if ended.returncode != 0:
        return 1
    numbers = [float(number) for number in NUMBER.findall(ended.stdout)]
    for number, (lower, upper) in zip(numbers, bounds, strict=False):
        if not lower <= number <= upper:
            print(f"FAILED: {number} is not between {lower} and {upper}")
            return 1
    if len(numbers) < len(bounds):
        print("FAILED: too few numbers are printed")
        return 1
    picture = folder / f"{example.stem}.png"
    if not picture.exists() or picture.stat().st_size < 5000:
        print("FAILED: there is no picture")
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
