# SPDX-License-Identifier: GPL-2.0-or-later
"""The header of a text file, the lines above its numbers: size, units, rows and columns."""
import re

import numpy as np

from .channel import Refused, dispute, metres_in, whole_side
from .table import MARK, may_be_thousands

# Gwyddion writes its header in the language of its user; these are the known keys.
_GWYDDION = {
    "channel": ["channel"],
    "width": ("width breite largeur ancho anchura larghezza largura šířka ширина szerokość bredd "
              "szélesség 幅 너비 宽度").split(),
    "height": ("height höhe hauteur alto altura altezza výška высота wysokość höjd magasság 高さ "
               "높이 高度").split(),
    "value units": ["value units", "werteinheiten"]}
_NAME = _GWYDDION["channel"] + ["title"]
_WIDTH = _GWYDDION["width"] + ["x size", "x-size", "x-length", "x length"]
_HEIGHT = _GWYDDION["height"] + ["y size", "y-size", "y-length", "y length"]
_SPACING = {"pixel size": "xy", "xy calibration": "xy", "pixel pitch": "xy", "spacing": "xy",
            "x pixel size": "x", "x spacing": "x", "dx": "x",
            "y pixel size": "y", "y spacing": "y", "dy": "y"}
_VALUE_UNIT = _GWYDDION["value units"] + ["value unit", "height unit", "height units", "z unit",
                                          "z units", "z-unit", "data unit", "unit"]
_LATERAL_UNIT = ("xy unit", "xy units", "x unit", "y unit", "lateral unit")
# A key of these words alone, with one of scaling among them, is a factor of the heights; so it is
# if they are written as one word.
_SCALING = "scale|scaling|factor|conversion|multiplier"
_OF_HEIGHTS = re.compile(rf"(?:{_SCALING}|z|heights?|values?|data|of|the|[\s_-])+")
_COLUMNS = ("x-pixels", "x pixels", "columns")
_ROWS = ("y-pixels", "y pixels", "rows")
_KNOWN = {*_NAME, *_WIDTH, *_HEIGHT, *_SPACING, *_VALUE_UNIT, *_LATERAL_UNIT, *_COLUMNS, *_ROWS,
          "x-unit", "y-unit", "bit2nm"}
# Lengths with one of these words in their keys are not sides.
_NO_SIDE = set("offset origin position center centre radius diameter depth thickness wavelength "
               "cutoff pixel step spacing pitch resolution roughness amplitude range rms".split())


def _number(text, has_thousands=False):
    try:
        value = float(text.replace(",", "" if has_thousands else "."))
    except ValueError:
        return None
    return value if 0 < value < 1e300 and "_" not in text else None


def take_apart(line):
    """KEY, VALUE and UNIT of "KEY: VALUE UNIT" with any of : = , ; or a tab; or None."""
    line = line.replace('"', "").strip().lstrip("#%").strip()
    match = (re.fullmatch(r"([^:=,;\t]+?)\s*[:=]\s*(.*)", line)
             or re.fullmatch(r"([^:=,;\t]+?)\s*[,;\t]\s*(.*)", line))
    if not match:
        return None
    value = match[2].strip(" \t,;")
    parts = re.fullmatch(r"([-+.,\deE]+)[\s,;]+(\S.*)", value)
    return (match[1].lower(), *(parts.groups() if parts else (value, "")))


def _words(key):
    return set(re.split(r"[\s_-]+", key))


def _scales_heights(key, value, unit):
    """Whether a statement is a factor of the heights, other than 1."""
    name = re.sub(r"\s*[\[(].*", "", key)   # without a unit
    return bool(_OF_HEIGHTS.fullmatch(name) and re.search(_SCALING, name)
                and _number(value.lstrip("+-"))
                and (unit or name != key or _number(value) != 1))


def _may_stand_for(key, meaning):
    """Whether a key may be that of Gwyddion with this meaning, in any language."""
    return key in _GWYDDION[meaning] or (key not in _KNOWN and not _words(key) & _NO_SIDE)


def _in_english(lines):
    """The lines of a header, with English keys if it is Gwyddion's in an unknown language.

    Gwyddion always writes four lines: channel, width, height and value units. An unknown key
    therefore means what its place tells, but only if the whole header can be Gwyddion's. With a key
    of another program, or a known key at another place, it is not, and each key counts by its name.
    """
    statements = [take_apart(line) for line in lines if line.startswith("#")]
    if not len(lines) == len(statements) == len(_GWYDDION) or None in statements or not all(
            _may_stand_for(key, meaning) for (key, *_), meaning in zip(statements, _GWYDDION)):
        return lines
    _, (_, wide, unit_x), (_, high, unit_y), (_, unit, rest) = statements
    if rest or _number(unit.lstrip("+-")) or not (
            _number(wide) and _number(high) and metres_in(unit_x) and metres_in(unit_y)):
        return lines
    return [f"# {meaning}: {value} {unit}".rstrip()
            for meaning, (_, value, unit) in zip(_GWYDDION, statements)]


def _agreed_mark(earlier, text):
    try:
        mark = float(text)
    except ValueError:
        raise Refused(f"has '{text}' as the mark of missing points in its header, which is no "
                      "number") from None
    if earlier not in (None, mark):
        raise Refused(f"has both {earlier:g} and {mark:g} as marks of missing points in its header: "
                      "write nan in place of one")
    return mark


class TextHeader:
    """What a header states. Sizes are in metres, and None if it does not state them.

    Raises Refused if it contradicts itself or can be read in several ways, unless an option of
    the user decides.
    """

    def __init__(self, lines, options):
        self._options = options
        self._stated = {}          # length and text of each statement that must not be contradicted
        self.side = {}
        self.spacing = {}          # along x, y or, if these are missing, xy
        self.metres = None         # metres in a value of 1
        self.quantity = ""         # unit of values that are no lengths
        self.coordinate = None     # metres in a coordinate of 1
        self.rows = self.columns = None
        self.name = ""
        self.mark = None           # the value of missing points
        self._default = {}         # metres in 1 along x and y, if a length has no unit
        self._has_factor = False
        lines = _in_english(lines)
        statements = [found for found in map(take_apart, lines) if found]
        for key, value, _ in statements:
            if key in ("x-unit", "y-unit"):
                self._default[key[0]] = metres_in(value)
                self._agree(f"the unit along {key[0]}", metres_in(value), value, "--size")
        keys = [key for key, _, _ in statements]
        if "bit2nm" in keys:
            self._default = self._default or {"x": 1e-9, "y": 1e-9}   # as in SPIP
            if any(key == "z-unit" and value != "nm" for key, value, _ in statements):
                raise Refused("states both Bit2nm and another unit of heights")
        for line in lines:
            self._read_line(line)

    def _agree(self, what, length, text, *options):
        """Refuse a statement that contradicts an earlier one, unless an option decides."""
        earlier, as_text = self._stated.setdefault(what, (length, text))
        is_same = earlier == length or (
            None not in (earlier, length) and abs(earlier - length) <= 1e-3 * abs(length))
        if not is_same and not any(getattr(self._options, option.lstrip("-").replace("-", "_"))
                                   for option in options):
            raise Refused(f"states {what} as '{as_text}' and as '{text}' in its header: "
                          f"{' or '.join(options)} says what it is")

    def _length(self, value, unit, axes=""):
        """A length along the axes in metres; None if it has no unit and no default."""
        if may_be_thousands(value) and not self._options.decimal:
            raise Refused(f"states the length '{value} {unit}' in its header, whose comma may be a "
                          "decimal sign or separate thousands: --decimal comma or --decimal point "
                          "says which")
        number = _number(value, may_be_thousands(value) and self._options.decimal == "point")
        defaults = {self._default.get(axis) for axis in axes}
        if not unit and axes and defaults == {None}:
            unit = self._options.xy_unit or ""
        metres = metres_in(unit) if unit else defaults.pop() if len(defaults) == 1 else None
        if number is None or (unit and metres is None):
            raise Refused(f"states the length '{value} {unit}' in its header, which is none")
        return None if metres is None else number * metres

    def _read_line(self, line):
        extents = re.fullmatch(r"[#\s]*h=(\d{1,9})\s+w=(\d{1,9})\s*", line, re.I)
        factor = re.fullmatch(r"[#\s]*height conversion factor \(-> (\S+)\)\s*=\s*(\S+)\s*",
                              line, re.I)
        mark = MARK.fullmatch(line)
        if mark:
            self.mark = _agreed_mark(self.mark, mark[1])
        elif extents:
            self.rows, self.columns = int(extents[1]), int(extents[2])
        elif factor:
            self._read_factor(factor[2], factor[1])
        else:
            statement = take_apart(line)
            if statement:
                self._read_statement(*statement)

    def _read_statement(self, key, value, unit):
        if unit.lower() in ("px", "pixel", "pixels"):   # points of an image, no length
            return
        text = f"{value} {unit}" if unit else value
        if key in _WIDTH or key in _HEIGHT:
            axis = "x" if key in _WIDTH else "y"
            self.side[axis] = self._length(value, unit, axis)
            self._agree(f"its side along {axis}", self.side[axis], text, "--size")
        elif key in _SPACING:
            axes = _SPACING[key]
            self.spacing[axes] = self._length(value, unit, axes)
            self._agree(f"its spacing along {' and '.join(axes)}", self.spacing[axes], text,
                        "--size")
        elif key in _VALUE_UNIT and value and not self._has_factor:
            self.metres = metres_in(text)
            self.quantity = "" if self.metres else text
            self._agree("the unit of its heights", self.metres, text, "--unit")
        elif key in _LATERAL_UNIT:
            self.coordinate = metres_in(value)
            self._agree("the unit of its coordinates", self.coordinate, value, "--xy-unit",
                        "--size")
        elif key in _COLUMNS and value.isdecimal():
            self.columns = int(value)
        elif key in _ROWS and value.isdecimal():
            self.rows = int(value)
        elif key == "bit2nm":
            self._read_factor(value, "nm")
        elif key in _NAME:
            self.name = value
        elif _scales_heights(key, value, unit) and not self._options.unit:
            raise Refused(f"states '{key}' as '{text}' in its header, by which heights may have to "
                          "be multiplied: --unit says what a value of 1 is, such as --unit "
                          "\"63.1 nm\"")

    def _read_factor(self, value, unit):
        self.metres, self._has_factor = self._length(value, unit), True
        self._agree("the factor of its heights", self.metres, f"{value} {unit}", "--unit")

    def without_marks(self, heights):
        """The heights, with nan for the value of missing points."""
        return heights if self.mark is None else np.where(heights == self.mark, np.nan, heights)

    def size(self, nx, ny):
        """lx, ly of nx × ny points; None unless both are stated."""
        sides = tuple(whole_side(n, self.side.get(axis), self._step(axis))
                      for axis, n in zip("xy", (nx, ny)))
        return sides if all(sides) else None

    def _step(self, axis):
        return self.spacing.get(axis, self.spacing.get("xy"))

    def disputed(self, nx, ny, of_coordinates=None):
        """How sides, steps and the sides of coordinates contradict each other; "" if they agree."""
        found = ""
        for axis, n, length in zip("xy", (nx, ny), of_coordinates or (None, None)):
            side, step = self.side.get(axis), self._step(axis)
            found = (found or dispute(axis, n, side, step, " m")
                     or dispute(axis, n, side or (step and n * step), length and length / n, " m"))
        return found
