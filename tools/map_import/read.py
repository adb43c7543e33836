# SPDX-License-Identifier: GPL-2.0-or-later
"""Choose the reader of a file by its content, never by its name."""
import bz2
import gzip
import lzma
import os
import re
import zipfile
import zlib

from . import arrays, gwyddion, text
from .channel import Refused
from .table import decode

LARGEST = 1 << 30   # bytes that a compressed file may unpack to; no map has more

_COMPRESSED = {b"\x1f\x8b": gzip.open, b"BZh": bz2.open, b"\xfd7zXZ\0": lzma.open}


def _unpack(stream, scratch):
    """Unpack a compressed stream to a file in the scratch folder, and return its path."""
    path = os.path.join(scratch, "unpacked")
    with open(path, "wb") as output:
        while block := stream.read(1 << 20):
            if output.tell() > LARGEST:
                raise Refused("unpacks to more than 1 GB")
            output.write(block)
    return path


def _read_zip(path, options, scratch):
    with zipfile.ZipFile(path) as archive:
        names = [name for name in archive.namelist() if not name.endswith("/")]
        if any(name.split("/")[-1] == "main.xml" for name in names):
            return gwyddion.convert_x3p(path, scratch)
        if names and all(name.endswith(".npy") for name in names):
            return arrays.read_npy(path)
        if len(names) != 1:
            return gwyddion.convert(path, scratch)
        with archive.open(names[0]) as stream:
            unpacked = _unpack(stream, scratch)
    return _read(unpacked, options, scratch, is_unpacked=True)


def _read_text(content, path, options, scratch):
    """The channels of a text. If its header does not state everything, Gwyddion is tried, which
    knows the texts of some vendors."""
    factor = re.match(r"Wyko ASCII Data File Format\s+\d+\s+0\b.*?^Mult\s[^\n]*?([^\s]+)\s*$",
                      content, re.S | re.M)
    if factor and float(factor[1]) != 1:
        raise Refused(f"is Wyko's text of waves with Mult {factor[1]}, by which some programs "
                      "multiply heights and others divide: export it in real units")
    channels, refusal = [], None
    try:
        channels = text.read_text(content, options)
    except Refused as reason:
        refusal = reason
    if channels and all(channel.size and channel.metres for channel in channels):
        return channels
    try:
        known = [channel for channel in gwyddion.convert(path, scratch)
                 if channel.size and channel.metres]
    except Refused:
        known = []
    if refusal and not known:
        raise refusal
    return known or channels


def _read(path, options, scratch, is_unpacked=False):
    with open(path, "rb") as file:
        start = file.read(512)
    if not start:
        raise Refused("is empty")
    if start.startswith(b"\x93NUMPY"):
        return arrays.read_npy(path)
    if start.startswith(b"\x89HDF"):
        return arrays.read_hdf5(path)
    if start.startswith((b"CDF\1", b"CDF\2")):
        return arrays.read_classic_netcdf(path)
    if start.startswith(b"MATLAB 7.3"):
        return arrays.read_matlab_hdf5(path)
    if start.startswith(b"MATLAB 5.0"):
        return arrays.read_matlab(path)
    if start.startswith(b"GWYP"):
        return gwyddion.read_gwy(path)
    if start.startswith(b"PK\3\4") and not is_unpacked:
        return _read_zip(path, options, scratch)
    for magic, opener in _COMPRESSED.items():
        if start.startswith(magic) and not is_unpacked:
            with opener(path) as stream:
                unpacked = _unpack(stream, scratch)
            return _read(unpacked, options, scratch, is_unpacked=True)
    if start.startswith((b"aBCR", b"aISO")):
        return gwyddion.convert(path, scratch)
    with open(path, "rb") as file:
        content = decode(file.read())
    if content is None:
        return gwyddion.convert(path, scratch)
    return _read_text(content, path, options, scratch)


def read(path, options, scratch):
    """The channels of a file; raises Refused, whatever is wrong with it."""
    try:
        channels = _read(path, options, scratch)
    except Refused:
        raise
    except MemoryError:
        raise Refused("needs more memory than its size warrants") from None
    except (zipfile.BadZipFile, zlib.error, lzma.LZMAError, EOFError, OSError) as reason:
        raise Refused(f"is damaged: {str(reason).splitlines()[0] if str(reason) else 'it ends early'}"
                      ) from None
    except Exception as reason:  # Damaged files make the libraries raise anything.
        said = str(reason).splitlines()
        raise Refused(f"is damaged: {said[0][:200] if said else type(reason).__name__}") from None
    if not channels:
        raise Refused("holds no map of numbers")
    return channels
