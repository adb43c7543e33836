# SPDX-License-Identifier: GPL-2.0-or-later
"""Instruments' own formats, through Gwyddion; and Gwyddion's own format, GWY."""
import os
import shutil
import struct
import subprocess
import zipfile

import numpy as np

from .channel import Channel, Refused, check_extents, metres_in

SECONDS = 20   # of the 25 s that an import may take; the slowest of forty files took 1.5 s


def convert(path, scratch):
    """Let Gwyddion convert a file to GWY, and return the channels in that. Raises Refused."""
    if not shutil.which("gwyddion"):
        raise Refused("needs Gwyddion to be read: sudo apt install gwyddion")
    output = os.path.join(scratch, "converted.gwy")
    # Gwyddion keeps settings and a log in the home folder.
    environment = {**os.environ, "HOME": scratch, "XDG_CONFIG_HOME": scratch, "LC_ALL": "C.UTF-8"}
    try:
        result = subprocess.run(
            ["gwyddion", "--convert-to-gwy=" + output, os.path.abspath(path)], text=True,
            errors="replace", capture_output=True, timeout=SECONDS, check=False, env=environment,
            stdin=subprocess.DEVNULL)
    except subprocess.TimeoutExpired:
        raise Refused(f"kept Gwyddion busy for {SECONDS} s without result") from None
    if result.returncode < 0:
        raise Refused("ended Gwyddion, as damaged files do")
    if result.returncode or not os.path.exists(output):
        said = [line.split(": ", 1)[-1] for line in result.stderr.splitlines() if ": " in line]
        reason = next((line for line in said if not line.startswith("Cannot write")), "")
        if "No module" in reason:
            raise Refused("has a format that is known neither here nor to Gwyddion")
        raise Refused(f"is refused by Gwyddion: {reason.rstrip('.') or 'no reason given'}")
    return read_gwy(output, mask_is_missing=True)


def convert_x3p(path, scratch):
    """The channels of an X3P file, also if main.xml is in a folder, where Gwyddion misses it."""
    with zipfile.ZipFile(path) as archive:
        main = next(name for name in archive.namelist() if name.split("/")[-1] == "main.xml")
        folder = main[:-len("main.xml")]
        if not folder:
            return convert(path, scratch)
        path = os.path.join(scratch, "unfolded.x3p")
        total = 0
        with zipfile.ZipFile(path, "w") as plain:
            for entry in archive.infolist():
                total += entry.file_size
                if total > 1 << 30:
                    raise Refused("unpacks to more than 1 GB")
                if entry.filename.startswith(folder) and not entry.is_dir():
                    plain.writestr(entry.filename[len(folder):], archive.read(entry))
    return convert(path, scratch)


class _Reader:
    """Reads GWY objects and their components; positions are those of bytes in the content."""

    _NUMBERS = {"b": "<u1", "c": "<i1", "i": "<i4", "q": "<i8", "d": "<f8"}

    def __init__(self, content):
        self.content = content

    def take(self, position, n_bytes):
        if n_bytes < 0 or position + n_bytes > len(self.content):
            raise Refused("ends before its data do")
        return self.content[position:position + n_bytes], position + n_bytes

    def text(self, position):
        end = self.content.find(b"\0", position)
        if end < 0:
            raise Refused("ends before its data do")
        return self.content[position:end].decode("utf-8", "replace"), end + 1

    def count(self, position):
        raw, position = self.take(position, 4)
        return struct.unpack("<I", raw)[0], position

    def object(self, position, depth=0):
        """Type and components of the object at a position, and the position behind it."""
        if depth > 16:
            raise Refused("nests its data too deeply")
        kind, position = self.text(position)
        size, position = self.count(position)
        end = position + size
        components = {}
        while position < min(end, len(self.content)):
            name, position = self.text(position)
            letter, position = self.take(position, 1)
            components[name], position = self.value(letter.decode("latin-1"), position, depth)
        return (kind, components), end

    def value(self, letter, position, depth):
        if letter == "s":
            return self.text(position)
        if letter == "o":
            return self.object(position, depth + 1)
        if letter.lower() not in self._NUMBERS and letter not in "SO":
            raise Refused(f"has a component of the unknown type {letter!r}")
        if letter.islower():
            kind = np.dtype(self._NUMBERS[letter])
            raw, position = self.take(position, kind.itemsize)
            return np.frombuffer(raw, kind)[0], position
        n, position = self.count(position)
        if letter in "SO":
            for _ in range(n):
                _, position = self.value(letter.lower(), position, depth)
            return None, position
        kind = np.dtype(self._NUMBERS[letter.lower()])
        raw, position = self.take(position, n * kind.itemsize)
        return np.frombuffer(raw, kind), position


def _unit(field, name):
    kind, components = field.get(name) or ("", {})
    return str(components.get("unitstr", "")) if kind == "GwySIUnit" else ""


def _field(container, key):
    found = container.get(key)
    if not isinstance(found, tuple) or found[0] != "GwyDataField":
        return None
    field = found[1]
    nx, ny = int(field.get("xres", 0)), int(field.get("yres", 0))
    data = field.get("data")
    if not isinstance(data, np.ndarray):
        raise Refused("has a channel without data")
    check_extents(nx, ny, data.nbytes)
    if data.size != nx * ny:
        raise Refused(f"has a channel of {nx} x {ny} points that holds {data.size}")
    return field, data.astype(float).reshape(ny, nx)


def read_gwy(path, mask_is_missing=False):
    """The channels of a GWY file. After a conversion, masked points are those not measured."""
    with open(path, "rb") as file:
        content = file.read()
    if content[:4] != b"GWYP":
        raise Refused("is no file of Gwyddion's format")
    (_, container), _ = _Reader(content).object(4)
    channels = []
    keys = [key for key in container if key.count("/") == 2 and key.endswith("/data")]
    for key in sorted(keys, key=lambda key: (len(key), key)):
        found = _field(container, key)
        if not found:
            continue
        field, values = found
        mask = _field(container, key[:-4] + "mask")
        note = ""
        if mask and mask_is_missing and mask[1].shape == values.shape:
            values[mask[1] > 0] = np.nan
        elif mask:
            note = "note: the file's mask may mean anything and is left out"
        lateral, unit = metres_in(_unit(field, "si_unit_xy")), _unit(field, "si_unit_z")
        size = lateral and tuple(float(field.get(side, 0)) * lateral
                                 for side in ("xreal", "yreal"))
        metres = metres_in(unit)
        name = container.get(key + "/title")
        channels.append(Channel(name if isinstance(name, str) else f"channel {key.split('/')[1]}",
                                values, size, None, metres, "" if metres else unit or "no unit", note=note))
    return channels
