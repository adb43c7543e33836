#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Install the build, then build and run the programs of examples/library against it.

    check_install.py PROJECT BUILD FOLDER
"""
import os
import re
import shutil
import subprocess
import sys


def run(*command):
    """The output of a command; ends the test if it fails."""
    result = subprocess.run(command, text=True, capture_output=True, check=False)
    if result.returncode != 0:
        sys.exit(f"FAILED: {' '.join(command)}\n{result.stdout}\n{result.stderr}")
    return result.stdout


def main():
    project, build, folder = map(os.path.abspath, sys.argv[1:4])
    prefix, example = os.path.join(folder, "prefix"), os.path.join(folder, "example")
    shutil.rmtree(folder, ignore_errors=True)
    run("cmake", "--install", build, "--prefix", prefix)
    version = run(os.path.join(prefix, "bin", "strait"), "--version")
    if not re.match(r"strait \d+\.\d+\.\d+\s*$", version):
        sys.exit(f"FAILED: strait --version prints '{version}'")
    for script in ("plot.py", "fit.py", "strait_results.py", "strait_import", "strait-report",
                   "prm/quickstart.prm"):
        if not os.path.exists(os.path.join(prefix, "share", "strait", script)):
            sys.exit(f"FAILED: {script} is not installed")

    run("cmake", "-S", os.path.join(project, "examples", "library"), "-B", example,
        f"-DCMAKE_PREFIX_PATH={prefix}", "-Wno-dev")
    run("cmake", "--build", example)
    areas = [float(area) for area in
             re.findall(r"contact area ([\d.]+)", run(os.path.join(example, "contact")))]
    if len(areas) != 3 or not 0 < areas[0] < areas[1] < areas[2] < 1:
        sys.exit(f"FAILED: the contact areas are {areas}")
    leak = run(os.path.join(example, "flow"))
    lower, upper = map(float, re.search(r"between (\S+) and (\S+)", leak).groups())
    exact = float(re.search(r"exact\s+(\S+)", leak).group(1))
    # The bounds are those of the interpolated gap, whose error is below 1e-3.
    if not lower * (1 - 1e-3) < exact < upper * (1 + 1e-3) or upper > 1.01 * lower:
        sys.exit(f"FAILED: the bracket is wrong: {leak}")
    shutil.rmtree(folder)


if __name__ == "__main__":
    main()
