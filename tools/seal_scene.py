# SPDX-License-Identifier: GPL-2.0-or-later
"""A whole seal as the scene describes it: its size, and the pressure over its width."""
import math
import pathlib
import re
import sys

import numpy as np
from scipy.integrate import cumulative_trapezoid

from run_folder import at_load, read_parameters


def box_of(values):
    """The sides of the box of a scene: along the flow and across."""
    sizes = [float(size) for size in values["Surface/Size"].split(",")]
    return (sizes[0], sizes[-1]) if values["Fluid/Direction"] == "x" else (sizes[-1], sizes[0])


def until_they_turn(loads):
    """The loads of a path up to where it first turns round."""
    ways = np.sign(np.diff(loads))
    way = ways[np.flatnonzero(ways)[:1]]
    back = np.flatnonzero(ways * way < 0) if way.size else way
    return loads[:back[0] + 1] if back.size else loads


def _joined(loads, others):
    """The loads, and those of the others that differ from all of them."""
    return np.union1d(loads, [load for load in others if not at_load(loads, load).any()])


class Seal:
    """The seal that a scene describes."""

    def __init__(self, scene):
        values = read_parameters(scene)
        path = np.array([float(load) for load in
                         values["Load programme/Pressures"].split(",") if load.strip()])
        # As in Scene::depends_on_path().
        has_memory = (values.get("Contact/Yielding", "none") != "none" or
                      values.get("Contact/Adhesion/Enabled") == "true" or
                      values.get("Fluid/Wall feedback/Enabled") == "true")
        # Leak rates after the path turned round are those of another curve.
        first_way = until_they_turn(path) if has_memory else path
        self.turns_round = has_memory and (first_way.size < path.size or
                                           values.get("Load programme/Path") == "cycle")
        self.loads = np.unique(first_way)
        self.circumference = float(values["Seal/Circumference"])
        self.width = float(values["Seal/Contact width"])
        self.isotropic = values["Seal/Isotropic"] == "true"
        self.orientations = values.get("Realisations/Orientations", "as is").split(",")
        self.wanted = float(values["Seal/Wanted leak rate"])
        self.profile = values["Seal/Pressure profile"]
        self.length, self.breadth = box_of(values)
        self.n_along = max(1, round(self.width / self.length))
        self.n_around = max(1, round(self.circumference / self.breadth))
        self.roll_off = (float(values["Surface/Roll-off wavelength"])
                         if values["Surface/Kind"] == "self-affine" else None)
        self.depends_on_drop = (values.get("Fluid/Wall feedback/Enabled") == "true" or
                                values.get("Fluid/Rarefaction", "none") != "none")
        units = values["Output/Leak rate units"].split(",")
        self.unit = units[0].strip()

    def _shares(self, places):
        """The fraction of the load between the edge and each of the places, which go from 0 to 1
        over the width; and the mean pressure of the table, or None without a table."""
        if not self.profile:
            return places, None
        if self.profile == "hertz":
            xi = 2 * places - 1
            return 0.5 + (xi * np.sqrt(1 - xi**2) + np.arcsin(xi)) / math.pi, None
        x, p = read_profile(self.profile)
        if abs(np.ptp(x) / self.width - 1) > 0.01:
            sys.exit(f"Seal/Pressure profile = {self.profile} spans {np.ptp(x):.6g}, and "
                     f"Seal/Contact width is {self.width:.6g}; make them the same.")
        places_of_table = (x - x[0]) / np.ptp(x)
        knots = np.union1d(places_of_table, places)
        up_to = cumulative_trapezoid(np.interp(knots, places_of_table, p), knots, initial=0)
        return up_to[np.searchsorted(knots, places)] / up_to[-1], up_to[-1]

    def columns(self):
        """Pressure over mean pressure at the patches, which follow each other along the flow; at
        the bonds between them, which lead around; and the mean pressure of the table."""
        shares, mean = self._shares(np.linspace(0, 1, 2 * self.n_along + 1))
        patches = self.n_along * (shares[2:] - shares[:-2])   # and bonds between them
        return patches[::2], patches[1::2], mean

    def _ends(self, factors):
        """The least and the largest mean load at which the pressures of all factors are known."""
        with np.errstate(divide="ignore", invalid="ignore"):   # factors may be 0
            return (np.fmax.reduce(self.loads[0] / factors),
                    np.fmin.reduce(self.loads[-1] / factors))

    def _require_patches(self):
        """Refuse a seal for which the scene has no suitable patches."""
        if not self.isotropic:
            rotated = ["rotated" in name for name in self.orientations]
            if self.n_along > 1 and not any(rotated):
                sys.exit("Seal/Isotropic = false needs patches across the lay; add rotated to "
                         "Realisations/Orientations.")
            if all(rotated):
                sys.exit("Seal/Isotropic = false needs patches along the flow; add 'as is' to "
                         "Realisations/Orientations.")
        places = np.linspace(0, 1, 9)
        if self.n_along == 1 and not np.allclose(self._shares(places)[0], places):
            sys.exit(f"Seal/Pressure profile = {self.profile} cannot press parts of a patch, and "
                     f"one patch spans Seal/Contact width = {self.width:.6g}; make Surface/Size "
                     "along the flow half of that or less, or leave the profile empty.")

    def rows(self):
        """The mean loads at which the pressures of the whole profile, at bonds along and around,
        lie within the loads of the patches: from these loads, the least and the largest possible
        one, and the mean pressure of the table."""
        along, around, mean = self.columns()
        self._require_patches()
        bonds = np.concatenate([along, around])
        least, most, uniform = bonds.min(), bonds.max(), np.allclose(bonds, 1)
        wanted = self.loads if mean is None else _joined(self.loads, [mean])
        if not uniform:
            ends = self._ends(np.array([least, most]))
            wanted = _joined(wanted, ends) if ends[0] < ends[1] else wanted
        # Under tension the bond with the largest factor has the least pressure.
        pressures = np.outer(wanted, [least, most])
        # Rounding of the profile must not cost the first load and the last.
        rounding = 1e-9 * abs(self.loads)
        inside = ((pressures.min(axis=1) >= self.loads[0] - rounding[0]) &
                  (pressures.max(axis=1) <= self.loads[-1] + rounding[-1]))
        if len(self.loads) < 2 and not uniform:
            inside[:] = False
        if not inside.any() or (mean is not None and not inside[at_load(wanted, mean)].all()):
            load = self.loads.mean() if mean is None else mean
            low, high = sorted([load * least, load * most])
            sys.exit(f"Under a mean pressure of {load:.6g} Seal/Pressure profile presses the "
                     f"patches by {low:.6g} to {high:.6g}; let Load "
                     "programme/Pressures begin below and end above that, as nothing is "
                     "extrapolated.")
        return wanted[inside]


def read_profile(path):
    """Positions and pressures in a table of two columns, below any header."""
    rows = []
    try:
        text = pathlib.Path(path).read_text(encoding="utf-8", errors="replace")
    except OSError as error:
        sys.exit(f"Seal/Pressure profile: {error}.")
    for number, line in enumerate(text.splitlines(), 1):
        words = [word for word in re.split(r"\s*[;\t,]\s*|\s+", line.strip()) if word]
        try:
            x, p = map(float, words)
            rows.append((x, p))
        except ValueError:
            if rows and words and not line.lstrip().startswith("#"):
                sys.exit(f"Seal/Pressure profile = {path} has no two numbers in line {number}; "
                         "write a position and a pressure, with decimal points.")
        if len(words) == 4 and re.fullmatch(r"[-+\d;\s]*,[-+\d,;\s]+", line):   # 2,5;1,3
            sys.exit(f"Seal/Pressure profile = {path} has decimal commas in line {number}; write "
                     "decimal points.")
    x, p = np.array(rows).reshape(-1, 2).T
    if len(x) < 2 or not (np.diff(x) > 0).all() or not (p >= 0).all() or not p.any() \
            or not np.isfinite([x, p]).all():
        sys.exit(f"Seal/Pressure profile = {path} must hold two or more lines of a position that "
                 "grows and a pressure that is not negative.")
    return x, p
