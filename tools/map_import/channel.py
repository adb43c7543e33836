# SPDX-License-Identifier: GPL-2.0-or-later
"""Channels, which the readers return, and the units and refusals that they share."""
import dataclasses
import re

import numpy as np

# No grid of strait has more points a side; a header that claims more is damaged.
MOST_POINTS = 65535


class Refused(Exception):
    """The file cannot be imported; the message continues a sentence that begins with its name."""


@dataclasses.dataclass
class Channel:
    """A map of ny x nx values, row 0 at y = 0; not finite where nothing was measured."""
    name: str
    values: np.ndarray
    size: tuple = None     # lx, ly in metres of nx x ny points; None: not stated
    extent: tuple = None   # the same as plain numbers, in the unit of the file
    metres: float = None   # height of a value of 1; None: not stated, or no length
    quantity: str = ""     # unit of values that are no lengths, such as V
    periodic: bool = False
    note: str = ""         # what the user should know about it
    disputed: str = ""     # two sizes stated in the file that contradict each other
    refusal: str = ""      # why this channel cannot be imported; others of the file may be

    def __str__(self):
        ny, nx = self.values.shape
        return f"{self.name} ({nx} x {ny}{', in ' + self.quantity if self.quantity else ''})"


_PREFIX = {"": 1., "k": 1e3, "c": 1e-2, "m": 1e-3, "u": 1e-6, "n": 1e-9, "p": 1e-12}
_NAMES = {"meter": 1., "metre": 1., "millimeter": 1e-3, "millimetre": 1e-3, "micron": 1e-6,
          "micrometer": 1e-6, "micrometre": 1e-6, "nanometer": 1e-9, "nanometre": 1e-9,
          "angstrom": 1e-10, "å": 1e-10, "inch": .0254, "in": .0254}


def metres_in(unit):
    """The metres in a unit of length, such as "um" or "63.1 nm"; None for another text."""
    match = re.fullmatch(r"([-+.\deE]+(?=[\sa-zA-Zµμ]))?\s*(\S+)", unit.strip(" ()[]\"'"))
    if not match:
        return None
    try:
        factor = float(match[1] or 1)
    except ValueError:
        return None
    name = match[2].replace("µ", "u").replace("μ", "u")
    if name.endswith("m") and name[:-1] in _PREFIX:
        return factor * _PREFIX[name[:-1]]
    known = _NAMES.get(name.lower(), _NAMES.get(name.lower().rstrip("s")))
    return known and factor * known


def dispute(axis, n, side, step, unit=""):
    """How a side and a step between n points contradict each other. "" if one of them is no number,
    or if they agree to a hundredth; the side may be that of n steps or of n - 1."""
    if not (isinstance(side, float) and isinstance(step, float)) or (
            abs((n - .5) * abs(step) - side) <= .6 * abs(step) + .01 * abs(side)):
        return ""
    return f"along {axis} a side of {side:g}{unit} and {n} points in steps of {step:g}{unit}"


def whole_side(n, side, step):
    """The side of a box with n points, from what a file states: a side, a step, or both.

    A stated side may be that from the first point to the last, which is one step less. It is
    taken for that if n - 1 steps, which may be rounded, make it up to a hundredth of a step.
    """
    if not isinstance(step, float):
        return side
    if side is None:
        return n * abs(step)
    is_between_points = isinstance(side, float) and (
        abs((n - 1) * abs(step) - side) <= .01 * abs(step))
    return n * abs(step) if is_between_points else side


def check_extents(n_columns, n_rows, n_bytes):
    """Refuse a map that cannot be in a file of so many bytes, before memory is allocated."""
    if not (1 <= n_columns <= MOST_POINTS and 1 <= n_rows <= MOST_POINTS):
        raise Refused(f"claims {n_columns} x {n_rows} points, which no map has")
    # Deflate, the densest compression in use, makes at most 1032 bytes of one.
    if n_columns * n_rows > 1032 * n_bytes:
        raise Refused(f"claims {n_columns} x {n_rows} points and is too short for them")
