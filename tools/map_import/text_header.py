# SPDX-License-Identifier: GPL-2.0-or-later
"""What the lines above the numbers of a text file say: size, units, rows and columns."""
import re

from .channel import Refused, metres_in

# Gwyddion writes its header in the language of its user.
_WIDTH = ("width breite largeur ancho anchura larghezza largura šířka ширина szerokość bredd "
          "szélesség 幅 너비 宽度").split() + ["x size", "x-size", "x-length", "x length"]
_HEIGHT = ("height höhe hauteur alto altura altezza výška высота wysokość höjd magasság 高さ "
           "높이 高度").split() + ["y size", "y-size", "y-length", "y length"]
_SPACING = {"pixel size": "xy", "xy calibration": "xy", "pixel pitch": "xy", "spacing": "xy",
            "x pixel size": "x", "x spacing": "x", "dx": "x",
            "y pixel size": "y", "y spacing": "y", "dy": "y"}
_VALUE_UNIT = ("value units", "value unit", "height unit", "height units", "z unit", "z units",
               "z-unit", "data unit", "unit", "werteinheiten")
_COLUMNS = ("x-pixels", "x pixels", "columns")
_ROWS = ("y-pixels", "y pixels", "rows")


def _number(text):
    try:
        value = float(text.replace(",", "."))
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


class TextHeader:
    """Sizes in metres; None where the header does not state them."""

    def __init__(self, lines):
        self.side, self.spacing = {}, {}
        self.metres = None         # of a value of 1
        self.quantity = ""         # of values that are no length
        self.coordinate = None     # metres of a coordinate of 1
        self.rows = self.columns = None
        self.is_gwyddion = False   # then no column is an axis
        self.name = ""
        self._default = None       # of lengths that come without a unit
        self._has_factor = False
        statements = [found for found in map(take_apart, lines) if found]
        for key, value, _ in statements:
            if key in ("x-unit", "y-unit"):
                self._default = metres_in(value)
        keys = [key for key, _, _ in statements]
        if "bit2nm" in keys:
            if self._default is None:
                self._default = 1e-9   # of SPIP
            if any(key == "z-unit" and value != "nm" for key, value, _ in statements):
                raise Refused("states both Bit2nm and another unit of heights")
        for line in lines:
            self._read_line(line)
        self._read_gwyddion(lines)

    def _length(self, value, unit):
        number, metres = _number(value), metres_in(unit) if unit else self._default
        if number is None or (unit and metres is None):
            raise Refused(f"states the length '{value} {unit}' in its header, which is none")
        return None if metres is None else number * metres

    def _read_line(self, line):
        extents = re.fullmatch(r"[#\s]*h=(\d{1,9})\s+w=(\d{1,9})\s*", line, re.I)
        factor = re.fullmatch(r"[#\s]*height conversion factor \(-> (\S+)\)\s*=\s*(\S+)\s*",
                              line, re.I)
        if extents:
            self.rows, self.columns = int(extents[1]), int(extents[2])
        elif factor:
            self.metres, self._has_factor = self._length(factor[2], factor[1]), True
        else:
            statement = take_apart(line)
            if statement:
                self._read_statement(*statement)

    def _read_statement(self, key, value, unit):
        if unit.lower() in ("px", "pixel", "pixels"):   # an image of so many, no length
            return
        if key in _WIDTH:
            self.side["x"] = self._length(value, unit)
        elif key in _HEIGHT:
            self.side["y"] = self._length(value, unit)
        elif key in _SPACING:
            for axis in _SPACING[key]:
                self.spacing[axis] = self._length(value, unit)
        elif key in _VALUE_UNIT and value and not self._has_factor:
            text = f"{value} {unit}" if unit else value
            self.metres = metres_in(text)
            self.quantity = "" if self.metres else text
        elif key in ("xy unit", "xy units", "x unit", "lateral unit"):
            self.coordinate = metres_in(value)
        elif key in _COLUMNS and value.isdecimal():
            self.columns = int(value)
        elif key in _ROWS and value.isdecimal():
            self.rows = int(value)
        elif key == "bit2nm":
            self.metres = self._length(value, "nm")
            self._has_factor = True
        elif key in ("channel", "title"):
            self.name = value

    def _read_gwyddion(self, lines):
        """Gwyddion's four lines in a language that the lists do not know: by their order."""
        statements = [take_apart(line) for line in lines if line.startswith("#")]
        if not 3 <= len(statements) <= 4 or len(statements) != len(lines) or None in statements:
            return
        (_, wide, unit_x), (_, high, unit_y), (_, unit, rest) = statements[-3:]
        if rest or not (_number(wide) and _number(high) and metres_in(unit_x)
                        and metres_in(unit_y)):
            return
        self.is_gwyddion = True
        self.side = {"x": self._length(wide, unit_x), "y": self._length(high, unit_y)}
        self.metres = metres_in(unit)
        self.quantity = "" if self.metres else unit
        self.name = statements[0][1] if len(statements) == 4 else ""

    def size(self, nx, ny):
        """lx, ly of so many points; None if not both are stated."""
        if self.side.get("x") and self.side.get("y"):
            return self.side["x"], self.side["y"]
        if self.spacing.get("x") and self.spacing.get("y"):
            return nx * self.spacing["x"], ny * self.spacing["y"]
        return None
