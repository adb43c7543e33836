#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Read the results of a run of strait: tables, units and fields, as numpy arrays.

    from strait_results import Run
    run = Run("output/quickstart")
    run.table["leak_rate"]            # one array a column of leakage.csv
    run.unit("leak_rate")             # "m³/s"; "" if the scene states no units
    run.csv("fit.csv")                # any other table of the folder, units likewise
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


def _number(text):
    try:
        return float(text)
    except ValueError:
        return None


def _column(texts):
    numbers = [_number(text) for text in texts]
    if any(texts) and all(number is None for number in numbers):
        return np.array(texts)
    return np.array([np.nan if number is None else number for number in numbers])


def read_table(path):
    """The columns of a table: texts where there are some and no number, else numbers or NaN."""
    with open(path, newline="", encoding="utf-8", errors="replace") as file:
        reader = csv.DictReader(file, skipinitialspace=True)
        names, rows = reader.fieldnames or [], list(reader)
    return {name: _column([(row[name] or "").strip() for row in rows])
            for name in names if name}


class Run:
    """The results in one output folder."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        self.table = self.csv("leakage.csv")
        record = self.folder / "run.json"
        # Absent while the run goes on.
        self.record = json.loads(record.read_text(encoding="utf-8")) if record.exists() else {}

    def csv(self, name):
        """The columns of a table by their names."""
        return read_table(self.folder / name)

    def unit(self, column):
        """The unit of a column of any table, empty of texts and where the scene states none."""
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
