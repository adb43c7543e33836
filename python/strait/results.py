#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Read the results of a run of strait: tables, units and fields, as numpy arrays.

    from strait import Run            # or from strait_results, which needs numpy alone
    run = Run("output/quickstart")
    run.table["leak_rate"]            # an array for each column of leakage.csv, or ensemble.csv
    run.unit("leak_rate")             # "m³/s"; "" if the scene states no units
    run.csv("fit.csv")                # any other table of the folder, with its units
    run.table.to_pandas()             # as a DataFrame, where pandas is installed
    run.fields(4)["gap"]              # fields-4.h5: gap, pressure, labels of shape (ny, nx)
    run.picture(4)["fluid_pressure"]  # picture-4.h5: the same on fewer points, with the flow

On the command line it prints the table of a run, with shortened numbers:

    strait_results.py OUTPUT_DIR
"""
import csv
import json
import pathlib
import sys

import numpy as np


WIDTH = 80  # columns of a terminal


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


class Table(dict):
    """Columns by their names, as arrays of equal length.

    >>> table = Table({"seed": np.array([1, 1, 2]), "leak_rate": np.array([3., 2., 5.])},
    ...               {"leak_rate": "m³/s"})
    >>> print(table)
    seed             1 1 2
    leak_rate (m³/s) 3 2 5
    >>> for seed, rows in table.groups("seed"):
    ...     print(seed, rows["leak_rate"])
    1 [3. 2.]
    2 [5.]
    """

    def __init__(self, columns=(), units=None):
        super().__init__(columns)
        self.units = {name: unit for name, unit in (units or {}).items() if name in self}

    @property
    def n_rows(self):
        """The length of the columns."""
        return len(next(iter(self.values()))) if self else 0

    def rows(self, which):
        """The rows that a slice, or an array of indices or truth values, selects."""
        return Table({name: values[which] for name, values in self.items()}, self.units)

    def groups(self, column):
        """Each value of a column with the rows that have it, in the order of the table; rows whose
        value is NaN are one group."""
        values = self[column]
        known = values == values  # NaN does not even equal itself
        found = dict.fromkeys(value if value == value else np.nan for value in values.tolist())
        return [(value, self.rows(values == value if value == value else ~known))
                for value in found]

    def to_pandas(self):
        """A DataFrame, its units in `attrs["units"]`; needs pandas."""
        import pandas
        frame = pandas.DataFrame(dict(self))
        frame.attrs["units"] = dict(self.units)
        return frame

    def __str__(self):
        titles = [name + (f" ({self.units[name]})" if self.units.get(name, "1") not in ("", "1")
                          else "") for name in self]
        # A line for each column, in blocks of as many rows of the table as fit a terminal.
        cells = [[f"{value:.6g}" if isinstance(value, float) else str(value)
                  for value in values] for values in zip(*(v.tolist() for v in self.values()))]
        widths = [max(map(len, row)) for row in cells]
        left, blocks, begin = max(map(len, titles), default=0), [], 0
        while begin < len(cells) or not blocks:
            end = begin + 1
            while end < len(cells) and left + sum(widths[begin:end + 1]) + end + 1 - begin <= WIDTH:
                end += 1
            blocks.append("\n".join(
                f"{title:{left}} " + " ".join(f"{row[k]:>{width}}" for row, width in
                                              zip(cells[begin:end], widths[begin:end]))
                for k, title in enumerate(titles)))
            begin = end
        return "\n\n".join(blocks)

    def __reduce__(self):
        return Table, (dict(self), self.units)


def read_table(path, units=None):
    """Read a table. A column with texts and no number is one of texts, others are of numbers."""
    with open(path, newline="", encoding="utf-8", errors="replace") as file:
        reader = csv.DictReader(file, skipinitialspace=True)
        names, rows = reader.fieldnames or [], list(reader)
    return Table({name: _column([(row[name] or "").strip() for row in rows])
                  for name in names if name}, units)


class Run:
    """The results in one output folder."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder).absolute()  # whatever the current folder is later
        record = self.folder / "run.json"
        # That of a single run is absent while it goes on.
        self.record = json.loads(record.read_text(encoding="utf-8")) if record.exists() else {}
        self._units = self.record.get("column_units", {})
        # Each of several realisations has a folder with a table of its own.
        is_ensemble = (self.folder / "ensemble.csv").exists()
        self.table = self.csv("ensemble.csv" if is_ensemble else "leakage.csv")
        self.keeper = None  # removes a temporary folder after the end of this object

    def csv(self, name):
        """The columns of a table by their names. Raises FileNotFoundError, which names the tables
        that exist."""
        if not (self.folder / name).exists():
            known = ", ".join(sorted(path.name for path in self.folder.glob("*.csv"))) or "none"
            raise FileNotFoundError(f"{self.folder} has no {name}; its tables: {known}")
        return read_table(self.folder / name, self._units)

    def unit(self, column):
        """The unit of a column of any table; empty for texts, and if the scene states no units."""
        return self._units.get(column, "")

    def fields(self, step):
        """All data sets of fields-STEP.h5, those of a group in a dictionary of their own. Each
        dictionary has the attributes of its group under "attributes"."""
        return self._datasets(f"fields-{step}.h5")

    def picture(self, step):
        """All data sets of picture-STEP.h5, likewise."""
        return self._datasets(f"picture-{step}.h5")

    def _datasets(self, name):
        import h5py  # not needed for tables

        def contents(group):
            return {**{key: contents(item) if isinstance(item, h5py.Group) else item[()]
                       for key, item in group.items()}, "attributes": dict(group.attrs)}

        with h5py.File(self.folder / name, "r") as file:
            return contents(file)


def main(arguments):
    """Print the table of a run."""
    if arguments in (["--help"], ["-h"]):
        print(__doc__)
        return
    if len(arguments) != 1:
        sys.exit(__doc__)
    try:
        run = Run(arguments[0])
    except (OSError, json.JSONDecodeError) as error:
        sys.exit(f"strait_results.py: cannot read the results in {arguments[0]}: {error}")
    print(run.table)


if __name__ == "__main__":
    main(sys.argv[1:])
