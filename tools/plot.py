#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Draw the results of a run: leakage.png, gaps.png, spectrum.png and a picture-STEP.png for each
load step; or those of several realisations: ensemble.png and seal.png.

Reads the tables, fields-STEP.h5 and picture-STEP.h5 of the folder, and for several realisations
also their folders. Units on the axes come from run.json, whose entry "units" may name those of
length, pressure, leak_rate and current; without it the axes say "scene units".
Exit status 1 if the folder holds no results or a file cannot be read or written; everything else is
drawn nevertheless.
"""
import argparse
import pathlib
import sys

try:
    from plot_common import read_units, use_style
    from plot_ensemble import draw_ensemble
    from plot_gaps import draw_gaps
    from plot_leakage import draw_leakage
    from plot_pictures import draw_picture
    from plot_seal import draw_seal
    from plot_spectrum import draw_spectrum
    from run_folder import numbered
except ImportError as missing:
    sys.exit(f"plot.py: the Python module {missing.name} is missing; "
             "install python3-numpy, python3-matplotlib and python3-h5py.")


def find_results(folder, only, steps):
    """What to draw: (function, path) pairs, of which some files may be missing."""
    pictures = numbered(folder, "picture-*.h5")
    table, ensemble = folder / "leakage.csv", folder / "ensemble.csv"
    if not (table.exists() or ensemble.exists() or pictures):
        sys.exit(f"plot.py: {folder} holds no results (leakage.csv, ensemble.csv or "
                 "picture-STEP.h5).")
    wanted = [(draw_ensemble, ensemble)] if only != "pictures" and ensemble.exists() else []
    seal = folder / "seal.csv"
    if wanted and seal.exists():
        wanted.append((draw_seal, seal))
    if only != "pictures" and not wanted:
        wanted += [(draw_leakage, table), (draw_gaps, folder)]
    spectrum = folder / "spectrum.csv"
    if not only and spectrum.exists():
        wanted.append((draw_spectrum, spectrum))
    if only != "leakage":
        wanted += [(draw_picture, pictures.get(step, folder / f"picture-{step}.h5"))
                   for step in steps or pictures]
    return wanted


def main(arguments=None):
    """Draw what the command line asks for and return the exit status."""
    parser = argparse.ArgumentParser(description="Draw the results of a run of strait.")
    parser.add_argument("folder", metavar="OUTPUT_DIR", type=pathlib.Path)
    parser.add_argument("--only", choices=("leakage", "pictures"), help="draw these alone")
    parser.add_argument("--steps", type=int, nargs="+", metavar="STEP", help="these pictures")
    options = parser.parse_args(arguments)
    use_style()
    units, status = read_units(options.folder), 0
    for draw, path in find_results(options.folder, options.only, options.steps):
        if not path.exists():
            print(f"plot.py: {path} is missing.", file=sys.stderr)
            status = 1 if draw is draw_picture else status   # one that was asked for
            continue
        try:
            draw(path, units)
        except (OSError, KeyError, ValueError, IndexError) as error:
            problem = " ".join(f"{type(error).__name__}: {error}".split())
            print(f"plot.py: cannot draw {path}: {problem}", file=sys.stderr)
            status = 1
    return status


if __name__ == "__main__":
    sys.exit(main())
