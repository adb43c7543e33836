# SPDX-License-Identifier: GPL-2.0-or-later
"""Files of arrays: NetCDF, HDF5, numpy and MATLAB."""
import os

import numpy as np

from .channel import Channel, Refused, check_extents, dispute, metres_in, whole_side


def _plain(attribute):
    """An attribute as text or as one number; None for anything else."""
    value = np.asarray(attribute)
    if value.size != 1:
        return None
    value = value.reshape(-1)[0]
    if isinstance(value, bytes):
        return value.decode("utf-8", "replace").strip("\0 ")
    if isinstance(value, str):
        return value.strip()
    return float(value) if isinstance(value, (np.number, np.bool_)) else None


def _is_true(attribute):
    """Whether an attribute, a text or one number, means yes; what means neither yes nor no does
    not."""
    return str(attribute).lower() in ("true", "yes", "1", "1.0")


# Attributes that mark missing values, in terms of the stored numbers.
_MARKS = ("_FillValue", "missing_value", "valid_min", "valid_max", "valid_range")
# Default fill values of NetCDF for integers, which hold unless an attribute names another.
_UNWRITTEN = {"i2": -32767, "i4": -2147483647, "u2": 65535, "u4": 4294967295}


def _read_attributes(attributes):
    """Each attribute as text or one number; those that mark missing values as arrays."""
    return {name: _numbers(value) if name in _MARKS else _plain(value)
            for name, value in attributes}


def _numbers(attribute):
    """An attribute as an array of numbers, which may be written as one text; empty if it is anything
    else."""
    value = np.asarray(attribute).reshape(-1)
    if value.dtype.kind not in "iuf":
        try:
            return np.array([float(_plain(attribute))])
        except (TypeError, ValueError):
            return np.zeros(0)
    return value


def _first(attributes, *names):
    for name in names:
        if name in attributes and attributes[name] is not None:
            return attributes[name]
    return None


def _unit(levels, *names):
    """The unit that the first of several sets of attributes states which states any; None if none
    does. Raises Refused if a set states two."""
    for attributes in levels:
        stated = [str(attributes[name]) for name in names if attributes.get(name)]
        if len({metres_in(unit) or unit for unit in stated}) > 1:
            raise Refused(f"has attributes that state two units, '{stated[0]}' and '{stated[1]}': "
                          "remove one of them")
        if stated:
            return stated[0]
    return None


def _interpret(values, attributes):
    """Replace values that are marked as missing by nan, and apply scale and offset."""
    stored = np.asarray(values)
    is_unsigned = str(attributes.get("_Unsigned")).lower() == "true" and stored.dtype.kind == "i"
    if is_unsigned:   # classic NetCDF has no such integers, only this attribute
        stored = stored.astype(stored.dtype.str.replace("i", "u"))
    is_packed = stored.dtype.kind in "iu"

    def marks(name):
        found = attributes.get(name, np.zeros(0))
        with np.errstate(over="ignore"):
            keeps = is_packed and not (is_unsigned and found.dtype.kind == "i")
            return found if keeps else found.astype(stored.dtype)

    # The default fill value of NetCDF for real numbers, and then the marks of the file.
    result = stored.astype(float)
    is_missing = abs(result) >= 9.96e36
    for name in ("_FillValue", "missing_value"):
        is_missing |= np.isin(stored, marks(name))
    for name in ("scale_factor", "add_offset"):
        if name in attributes and not isinstance(attributes[name], float):
            raise Refused(f"has an attribute {name} that is not one number")
    result = result * attributes.get("scale_factor", 1.) + attributes.get("add_offset", 0.)
    for name, is_outside in (("valid_min", np.less), ("valid_max", np.greater)):
        bound = marks(name)
        if not bound.size and marks("valid_range").size == 2:
            bound = marks("valid_range")[:1] if name == "valid_min" else marks("valid_range")[1:]
        if bound.size == 1:
            # For packed integers, a bound that is a real number is one of the unpacked values.
            is_unpacked = is_packed and bound.dtype.kind == "f"
            is_missing |= is_outside(result if is_unpacked else stored, bound[0])
    return np.where(is_missing, np.nan, result)


def _map(name, values, attributes, of_file=None):
    """The channel of an array, by its attributes or else those of its file."""
    levels = attributes, of_file or {}
    known = {**levels[1], **attributes}
    ny, nx = values.shape
    unit = _unit(levels, "unit", "units")
    lateral = _unit(levels, "lateral_unit", "lateral_units")
    lateral = metres_in(lateral) if lateral else None
    sides = [_first(known, "lx"), _first(known, "ly")]
    steps = [_first(known, "dx"), _first(known, "dy")]
    disputed = dispute("x", nx, sides[0], steps[0]) or dispute("y", ny, sides[1], steps[1])
    extent = tuple(map(whole_side, (nx, ny), sides, steps))
    extent = extent if all(isinstance(side, float) for side in extent) else None
    size = tuple(side * lateral for side in extent) if extent and lateral else None
    metres = metres_in(unit) if unit else None
    return Channel(name, _interpret(values, attributes), size, extent, metres,
                   "" if metres or not unit else unit, _is_true(known.get("periodic")),
                   disputed=disputed)


# NetCDF: contact.engineering's layout.

def _were_written(coordinates):
    """Whether there are coordinates; they are missing, or all equal, if none were ever written."""
    return len(coordinates) > 1 and not (
        np.isnan(coordinates).all() or (coordinates == coordinates[0]).all())


def _side(n, coordinate):
    """Lengths of a side and a step, the metres in their unit, and whether the side is periodic."""
    if coordinate is None:
        return None, None, None, False
    values, attributes = coordinate
    unit = _unit((attributes, {"units": attributes.get("length_unit")}), "unit", "units")
    metres = metres_in(unit) if unit else None
    step = abs(values[-1] - values[0]) / (n - 1) if _were_written(values) else None
    length = attributes.get("length")
    length = whole_side(n, length if isinstance(length, float) else None, step)
    return length, step, metres, _is_true(attributes.get("periodic"))


def _against_attributes(channel, steps, units):
    """How steps of coordinates contradict the sides in attributes of the map; "" if they agree.

    Lengths are compared if the coordinates have units, else plain numbers.
    """
    sides, unit = (channel.size, " m") if units else (channel.extent, "")
    if not sides:
        return ""
    ny, nx = channel.values.shape
    dx, dy = np.multiply(steps, units) if units else steps
    return dispute("x", nx, sides[0], dx, unit) or dispute("y", ny, sides[1], dy, unit)


def _is_regular(values):
    """Whether coordinates have equal steps, as points of a grid must, to a twentieth of one."""
    line = np.linspace(values[0], values[-1], len(values))
    return bool((abs(values - line) <= abs(line[1] - line[0]) / 20).all())


def _netcdf_channel(name, values, dimensions, attributes, coordinates, of_file=None):
    """The channel of a variable. The dimension named x, or else the last one, runs along x; the map
    is turned so that both coordinates increase."""
    attributes = {"_FillValue": _numbers(_UNWRITTEN.get(values.dtype.str[1:], "")), **attributes}
    if dimensions[0].lower() == "x":
        values, dimensions = values.T, dimensions[::-1]
    coordinates = {dimension: (_interpret(*coordinates[dimension]), coordinates[dimension][1])
                   for dimension in dimensions
                   if dimension in coordinates and coordinates[dimension][0].dtype.kind in "iuf"}
    refusal = ""
    for axis, dimension in enumerate(dimensions):
        along = coordinates[dimension][0] if dimension in coordinates else np.zeros(0)
        if _were_written(along):
            if not _is_regular(along):
                refusal = (f"has coordinates '{dimension}' without equal steps, which no map has: "
                           "resample it to a regular grid")
            elif along[0] > along[-1]:
                values = np.flip(values, axis)
    ny, nx = values.shape
    lx, dx, metres_x, periodic_x = _side(nx, coordinates.get(dimensions[1]))
    ly, dy, metres_y, periodic_y = _side(ny, coordinates.get(dimensions[0]))
    of_all = _first(coordinates.get(dimensions[1], (None, {}))[1], "length_unit")
    channel = _map(name, values, attributes, {"units": of_all} if of_all else of_file)
    if lx and ly:
        units = (metres_x, metres_y) if metres_x and metres_y else None
        channel.disputed = (channel.disputed or dispute("x", nx, lx, dx)
                            or dispute("y", ny, ly, dy)
                            or _against_attributes(channel, (dx or lx / nx, dy or ly / ny), units))
        channel.extent = lx, ly
        channel.size = (lx * metres_x, ly * metres_y) if units else None
    channel.periodic, channel.refusal = periodic_x and periodic_y, refusal
    return channel


def _attempt(read, name, values, *arguments):
    """The channel that is read so, or one that cannot be imported; others of the file may be."""
    try:
        return read(name, values, *arguments)
    except Refused as reason:
        return Channel(name, values, refusal=str(reason))


def read_classic_netcdf(path):
    from scipy.io import netcdf_file

    with netcdf_file(path, "r", mmap=False, maskandscale=False) as file:
        attributes = {name: _read_attributes(variable._attributes.items())
                      for name, variable in file.variables.items()}
        coordinates = {name: (variable[:], attributes[name])
                       for name, variable in file.variables.items() if len(variable.shape) == 1}
        channels = []
        for name, variable in file.variables.items():
            if len(variable.shape) == 2 and variable.typecode() != "c":
                check_extents(*variable.shape, os.path.getsize(path))
                channels.append(_attempt(_netcdf_channel, name, np.array(variable[:]),
                                         variable.dimensions, attributes[name], coordinates))
    return [found for found in channels if found.name == "heights"] or channels


# HDF5, and NetCDF-4, which is HDF5.

def _attributes(thing):
    return _read_attributes(
        (key, value) for key, value in thing.attrs.items()
        if getattr(value, "dtype", None) is None or value.dtype.kind in "SUOifub")


def _unwritten(data):
    """The fill value of points that were never written; attributes may name another."""
    return {} if data.fillvalue == 0 else {"_FillValue": _numbers(data.fillvalue)}


def read_hdf5(path):
    import h5py

    n_bytes, channels = os.path.getsize(path), []
    with h5py.File(path, "r") as file:
        of_file = _attributes(file)
        coordinates = {}
        arrays = []

        def visit(name, thing):
            if not isinstance(thing, h5py.Dataset) or thing.dtype.kind not in "iuf":
                return
            if thing.ndim == 1 and 0 < thing.size < 65536:
                coordinates[name] = (thing[:], _attributes(thing))
            elif thing.ndim == 2 and min(thing.shape) > 0:
                arrays.append((name, thing))

        file.visititems(visit)
        for name, data in arrays:
            check_extents(*data.shape, n_bytes)
            attributes = {**_unwritten(data), **_attributes(data)}
            # Dimensions of a NetCDF-4 variable; another group may have others of the same names.
            scales = [dimension[0].name if len(dimension) else dimension.label
                      for dimension in data.dims]
            if any(scales):
                dimensions = [scale.rsplit("/", 1)[-1] for scale in scales]
                known = {dimension: coordinates[scale[1:]]
                         for dimension, scale in zip(dimensions, scales) if scale[1:] in coordinates}
                channels.append(_attempt(_netcdf_channel, name, data[:], dimensions, attributes,
                                         known, of_file))
            else:
                channels.append(_attempt(_map, name, data[:], attributes, of_file))
    return [found for found in channels if found.name == "heights"] or channels


# Arrays without any attributes.

def _bare(name, values):
    values = np.asarray(values)
    if values.ndim != 2 or values.dtype.kind not in "iufb" or min(values.shape) < 2:
        return []
    return [Channel(name, values.astype(float))]


def read_npy(path):
    loaded = np.load(path, allow_pickle=False)
    if isinstance(loaded, np.ndarray):
        if not _bare("", loaded):
            raise Refused("holds no array of numbers with two dimensions")
        return _bare("", loaded)
    with loaded:
        return [channel for name in loaded.files for channel in _bare(name, loaded[name])]


def read_matlab(path):
    from scipy.io import loadmat

    return [channel for name, values in loadmat(path).items() if not name.startswith("__")
            for channel in _bare(name, values)]


def read_matlab_hdf5(path):
    """MATLAB 7.3 stores arrays by columns, so that HDF5 shows them transposed."""
    return [channel for stored in read_hdf5(path)
            for channel in _bare(stored.name, stored.values.T)]
