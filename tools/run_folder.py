# SPDX-License-Identifier: GPL-2.0-or-later
"""Find files in the output folder of a run, or of several realisations, and judge rows by their
status."""
import contextlib
import csv
import re

import numpy as np

from strait_results import read_table

UNCERTAIN = ("unresolved-throat", "uncertain-threshold", "inaccurate")


def _is_made_of(status, words):
    return np.array([set(text.split("+")) <= set(words) for text in status], bool)


def is_uncertain(status):
    """Where every word of a status (words are joined by +) is a doubt about a converged result."""
    return _is_made_of(status, UNCERTAIN)


def is_trusted(status):
    """Where nothing failed, with or without doubts."""
    return _is_made_of(status, ("ok", "", *UNCERTAIN))


def has_bounds(status):
    """Where the bounds of the leak rate hold, even if they are wider than was asked for."""
    return _is_made_of(status, ("ok", "", "flow-accuracy", *UNCERTAIN))


def leak_rates(columns):
    """Names of the columns of leak rates: that in the scene's units, then those asked for."""
    return [name for name in columns if name == "leak_rate" or
            (name.startswith("leak_rate_") and
             name not in ("leak_rate_lower", "leak_rate_upper", "leak_rate_error"))]


def numbered(folder, pattern):
    """The paths in a folder by the number that stands for the * of a pattern, in that order."""
    form, found = re.escape(pattern).replace(r"\*", r"(\d+)"), {}
    for path in folder.glob(pattern):
        name = re.fullmatch(form, path.relative_to(folder).as_posix())
        if name:
            found[int(name[1])] = path
    return dict(sorted(found.items()))


def realisations(folder, pattern="realisation-*"):
    """The folders of the realisations, or a file in each, by number. If there is an ensemble.csv,
    only those that it lists, as others may be left from an earlier run."""
    found, table = numbered(folder, pattern), folder / "ensemble.csv"
    if table.exists():
        listed = read_table(table).get("realisation", ())
        found = {number: path for number, path in found.items() if number in listed}
    return found


def at_load(pressures, load):
    """Where pressures equal a load to rounding; loads may be far below one."""
    return np.isclose(pressures, load, rtol=1e-9, atol=0)


def nearest_slip(table):
    """Where the slip length is the one nearest to zero, which is taken if there are several."""
    slips = table.get("slip_length", np.zeros(table.n_rows))
    return slips == slips.max(initial=-np.inf)  # none is positive


def scene_in(folder):
    """The text of the scene whose results a folder holds."""
    return (folder / "parameters.prm").read_text(encoding="utf-8")


def read_parameters(scene):
    """The values in the text of a scene, such as parameters.prm, by "Section/Parameter"."""
    values, section = {}, []
    for line in scene.splitlines():
        word, _, rest = line.split("#")[0].strip().partition(" ")
        if word == "subsection":
            section.append(rest.strip())
        elif word == "end":
            section.pop()
        elif word == "set":
            name, _, value = rest.partition("=")
            values["/".join([*section, name.strip()])] = value.strip()
    return values


@contextlib.contextmanager
def replacing(path):
    """A path to write to, which replaces a file when it is complete: if the disk is full, a file
    of an earlier run stays as it is."""
    partial = path.with_suffix(".part")
    try:
        yield partial
        partial.replace(path)
    finally:
        partial.unlink(missing_ok=True)


def write_table(path, header, rows):
    """Write a table; doc/results.md defines its columns."""
    with replacing(path) as partial, open(partial, "w", newline="", encoding="utf-8") as file:
        csv.writer(file, lineterminator="\n").writerows([header, *rows])
