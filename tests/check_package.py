#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Make the Debian package, unpack it and run what is in it.

    check_package.py BUILD FOLDER

Status 77 (a skipped test) where Debian's tools for packages are missing.
"""
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path


def run(*command, **options):
    """The output of a command; ends the test if it fails."""
    result = subprocess.run(list(map(str, command)), text=True, capture_output=True,
                            check=False, **options)
    if result.returncode != 0:
        sys.exit(f"FAILED: {' '.join(map(str, command))}\n{result.stdout}\n{result.stderr}")
    return result.stdout


def main():
    build, folder = map(Path, sys.argv[1:])
    for tool in ("dpkg-deb", "dpkg-shlibdeps"):
        if shutil.which(tool) is None:
            print(f"{tool} is not installed (Debian package dpkg-dev): no package is made")
            return 77
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    run("cpack", "--config", build / "CPackConfig.cmake", "-B", folder)
    packages = list(folder.glob("*.deb"))
    if len(packages) != 1:
        sys.exit(f"FAILED: the packages are {packages}")
    control = run("dpkg-deb", "--field", packages[0])
    for pattern in (r"Package: strait$", r"Depends:.*\bopenmpi-bin\b", r"Depends:.*\blibdeal\.ii-",
                    r"Depends:.*\blibhypre-", r"Depends:.*\bpython3-matplotlib\b"):
        if not re.search(pattern, control, re.MULTILINE):
            sys.exit(f"FAILED: no match for {pattern} in\n{control}")
    root = folder / "root"
    run("dpkg-deb", "-x", packages[0], root)
    for name in ("include/strait/contact/contact_solver.h", "lib/libstrait.a",
                 "lib/cmake/strait/straitConfig.cmake", "share/doc/strait/copyright",
                 "share/strait/plot.py", "share/strait/strait_results.py"):
        if not (root / "usr" / name).exists():
            sys.exit(f"FAILED: {name} is not in the package")
    run(root / "usr/bin/strait", root / "usr/share/strait/prm/measured_surface.prm",
        "--set", "Load programme/Pressures=1e5", cwd=folder)
    results = folder / "output" / "measured_surface"
    if not (results / "leakage.png").exists():
        sys.exit("FAILED: the unpacked program drew no picture")
    modules = root / "usr/lib/python3/dist-packages"
    if modules.exists():
        path = {**os.environ, "PYTHONPATH": str(modules)}
        seed = run("/usr/bin/python3", "-c",
                   "import strait; print(strait.__file__, strait.Scene(surface=dict(seed=7))"
                   "['Surface/Seed'])", cwd=folder, env=path)
        if seed.split() != [str(modules / "strait/__init__.py"), "7"]:
            sys.exit(f"FAILED: the package for Python says {seed}")
    if "leak_rate (m³/s)" not in run(root / "usr/share/strait/strait_results.py", results):
        sys.exit("FAILED: the reader of results shows no leak rate")
    shutil.rmtree(folder)
    return 0


if __name__ == "__main__":
    sys.exit(main())
