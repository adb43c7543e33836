#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Read the results of a run of strait: tables, units and fields, as numpy arrays.

    from strait_results import Run
    run = Run("output/quickstart")
    run.table["leak_rate"]            # one array a column of leakage.csv
    run.unit("leak_rate")             # "m³/s"; "" if the scene states no units
    run.csv("spectrum.csv")           # any other table of the folder
    run.fields(4)["gap"]              # fields-4.h5: gap, pressure, labels of shape (ny, nx)
    run.picture(4)["fluid_pressure"]  # picture-4.h5: the same thinned out, with the flow

On the command line it prints the table of a run, numbers shortened:

    strait_results.py OUTPUT_DIR
"""
import csv
import json
import pathlib
import sys

import numpy as np


def _column(texts):
    try:
        return np.array([float(text) for text in texts])
    except ValueError:
        return np.array(texts)


class Run:
    """The results in one output folder."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        self.table = self.csv("leakage.csv")
        record = self.folder / "run.json"
        # Absent while the run goes on.
        self.record = json.loads(record.read_text(encoding="utf-8")) if record.exists() else {}

    def csv(self, name):
        """The columns of a table: numbers where all entries are, else texts."""
        with open(self.folder / name, newline="", encoding="utf-8") as file:
            rows = list(csv.reader(file, skipinitialspace=True))
        return {column: _column([row[k] for row in rows[1:]])
                for k, column in enumerate(rows[0])}

    def unit(self, column):
        """The unit of a column of leakage.csv, empty where the scene states none."""
        return self.record.get("column_units", {}).get(column, "")

    def fields(self, step):
        """All data sets of fields-STEP.h5, and its attributes under "attributes"."""
        return self._datasets(f"fields-{step}.h5")

    def picture(self, step):
        """The same of picture-STEP.h5."""
        return self._datasets(f"picture-{step}.h5")

    def _datasets(self, name):
        import h5py  # not needed for tables
        with h5py.File(self.folder / name, "r") as file:
            result = {key: file[key][()] for key in file}
            result["attributes"] = dict(file.attrs)
        return result


def main(arguments):
    """Print the table of a run."""
    if len(arguments) != 1:
        sys.exit(__doc__)
    try:
        run = Run(arguments[0])
    except OSError as error:
        sys.exit(f"strait_results.py: {error}")
    names = list(run.table)
    units = [run.unit(name) for name in names]
    rows = [[f"{value:.6g}" if isinstance(value, float) else str(value)
             for value in map(np.ndarray.item, map(np.asarray, row))]
            for row in zip(*run.table.values())]
    for name, unit, *values in zip(names, units, *rows):
        print(f"{name + (f' ({unit})' if unit not in ('', '1') else ''):32}", *values)


if __name__ == "__main__":
    main(sys.argv[1:])
