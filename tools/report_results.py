# SPDX-License-Identifier: GPL-2.0-or-later
"""The results of a folder as report.html needs them: of one run, or of several realisations."""
import re

import numpy as np

from run_folder import has_bounds, read_parameters, realisations, scene_in
from strait_results import Run


class Results:
    """The results in a folder: of one run, or of realisations with a run each."""

    def __init__(self, folder):
        self.folder = folder
        self.is_ensemble = (folder / "ensemble.csv").exists()
        self.runs = [Run(path.parent) for path in
                     realisations(folder, "realisation-*/leakage.csv").values()] \
            if self.is_ensemble else [Run(folder)]
        if not self.runs:
            raise FileNotFoundError(f"{folder} holds no realisation that is done")
        self.scene = scene_in(folder)
        self.parameters = read_parameters(self.scene)
        log = folder / "log.txt"
        self.log = log.read_text(encoding="utf-8", errors="replace") if log.exists() else ""

    def path(self, name):
        """The path of a file of the folder, or None if it does not exist."""
        path = self.folder / name
        return path if path.exists() else None

    def whole_seal(self):
        """The lines of the log about the whole seal, from the last time it was assessed."""
        found = re.findall(r"^whole seal:.*(?:\n  .*)*", self.log, re.MULTILINE)
        return found[-1].splitlines() if found else []


def relative_errors(columns):
    """Relative errors of the leak rates: the total one if known, else that of the farther bound;
    not a number for steps that failed, whose bounds do not hold."""
    rate = np.abs(columns["leak_rate"])
    with np.errstate(divide="ignore", invalid="ignore"):
        bracket = np.maximum(columns["leak_rate_upper"] / rate - 1,
                             1 - columns["leak_rate_lower"] / rate)
    known = columns.get("leak_rate_error", np.full(len(rate), np.nan))
    bounded = has_bounds(columns.get("status", np.full(len(rate), "ok")))
    return np.where(np.isfinite(known), known, np.where(bounded, bracket, np.nan))
