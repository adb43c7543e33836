#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Compare two tables of results (CSV with a header line) column by column.

    compare_tables.py REFERENCE RESULT [--rtol COLUMN=VALUE ...] [--default-rtol VALUE]

Numbers must agree within a relative tolerance, everything else exactly. There
is no absolute tolerance: a leak rate of 1e-10 is compared like any other number,
and 0 agrees only with 0. Columns that end in _seconds are not compared. Exit
status 1 if the tables differ; each difference is one line on standard output.
"""
import argparse
import csv
import math
import sys

DEFAULT_RTOL = 1e-6


def read_table(path):
    """Column names and rows (dictionaries) of a CSV file."""
    with open(path, newline="", encoding="utf-8") as file:
        rows = [[cell.strip() for cell in row] for row in csv.reader(file) if row]
    if not rows:
        raise ValueError(f"{path} is empty")
    names = rows[0]
    for number, row in enumerate(rows[1:], start=1):
        if len(row) != len(names):
            raise ValueError(f"{path}: row {number} has {len(row)} cells, "
                             f"the header has {len(names)}")
    return names, [dict(zip(names, row)) for row in rows[1:]]


def as_number(text):
    try:
        return float(text)
    except ValueError:
        return None


def cells_differ(expected, found, rtol):
    """A description of the difference between two cells, or None."""
    a, b = as_number(expected), as_number(found)
    if a is None or b is None:
        return None if expected == found else f"expected '{expected}', found '{found}'"
    if a == b or (math.isnan(a) and math.isnan(b)):
        return None
    difference = abs(a - b) / max(abs(a), abs(b))
    if difference <= rtol:  # false for nan
        return None
    return (f"expected {expected}, found {found}: relative difference "
            f"{difference:.2e} exceeds {rtol:.2e}")


def compare(reference, result, rtol=None, default_rtol=DEFAULT_RTOL):
    """All differences between two files, as a list of sentences."""
    rtol = rtol or {}
    expected_names, expected_rows = read_table(reference)
    names, rows = read_table(result)
    problems = []
    for name in expected_names:
        if name not in names:
            problems.append(f"column {name}: missing in the result")
    for name in names:
        if name not in expected_names:
            problems.append(f"column {name}: not in the reference")
    for name in rtol:
        if name not in expected_names:
            problems.append(f"column {name}: has a tolerance but is not in the reference")
    common = [name for name in expected_names if name in names]
    if common != [name for name in names if name in expected_names]:
        problems.append("the columns come in another order")
    if len(expected_rows) != len(rows):
        problems.append(f"expected {len(expected_rows)} rows, found {len(rows)}")
    for number, (expected, found) in enumerate(zip(expected_rows, rows), start=1):
        for name in common:
            if name.endswith("_seconds"):
                continue
            difference = cells_differ(expected[name], found[name],
                                      rtol.get(name, default_rtol))
            if difference:
                problems.append(f"column {name}, row {number}: {difference}")
    return problems


def parse_tolerance(text):
    name, _, value = text.partition("=")
    if not value or as_number(value) is None:
        raise argparse.ArgumentTypeError(f"'{text}' is not COLUMN=VALUE")
    return name, float(value)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("reference")
    parser.add_argument("result")
    parser.add_argument("--rtol", nargs="*", type=parse_tolerance, default=[])
    parser.add_argument("--default-rtol", type=float, default=DEFAULT_RTOL)
    arguments = parser.parse_args()
    try:
        problems = compare(arguments.reference, arguments.result,
                           dict(arguments.rtol), arguments.default_rtol)
    except (OSError, ValueError) as error:
        problems = [str(error)]
    for problem in problems:
        print(problem)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
