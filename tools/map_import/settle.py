# SPDX-License-Identifier: GPL-2.0-or-later
"""Decide on channel, size and units: as the file states them, or the user."""
import re

import numpy as np

from .channel import Refused, check_extents, metres_in


def choose(channels, wanted):
    """The channel that the user names, or the only map of heights."""
    listed = "\n".join(f"  {i}: {channel}" for i, channel in enumerate(channels, 1))
    if wanted:
        found = [channel for i, channel in enumerate(channels, 1)
                 if wanted in (channel.name, str(i))]
        if len(found) != 1:
            raise Refused(f"has no single channel '{wanted}'; there are\n{listed}")
        return found[0]
    heights = [channel for channel in channels if not channel.quantity]
    if len(heights) == 1:
        return heights[0]
    if not heights and len(channels) == 1:
        return channels[0]
    raise Refused(f"has several channels; choose one with --channel NAME or NUMBER:\n{listed}")


def _parse_size(text):
    """Sides in metres of "10 um" or "10, 20 um"; raises Refused."""
    # "2,5 um" may be meant as one side or as two.
    match = re.fullmatch(r"\s*([-+.\deE]+)(?:,?\s+([-+.\deE]+))?\s+([^\W\d]+)\s*", text)
    metres = metres_in(match[3]) if match else None
    try:
        sides = [float(number) * metres for number in match.groups()[:2] if number] if metres else []
    except ValueError:
        sides = []
    if not 1 <= len(sides) <= 2 or not all(0 < side < 1e6 for side in sides):
        raise Refused(f"cannot have the --size '{text}': write \"10 um\" or \"10, 20 um\"")
    return sides[0], sides[-1]


def _parse_unit(text):
    metres = metres_in(text) if text else None
    if text and not metres:
        raise Refused(f"cannot be read with the unit '{text}', which is no unit of length")
    return metres


def settle(channel, options):
    """Give a channel the size and units that the user states; return notes of what they override.

    Raises Refused if one of them is missing, or the map makes no sense.
    """
    size = _parse_size(options.size) if options.size else None
    xy_unit, unit = _parse_unit(options.xy_unit), _parse_unit(options.unit)
    notes = [channel.note] if channel.note else []
    if channel.refusal:
        raise Refused(channel.refusal)
    if channel.disputed and not size:
        raise Refused(f"states {channel.disputed}, which contradict each other: --size tells")
    ny, nx = channel.values.shape
    check_extents(nx, ny, channel.values.nbytes)
    if min(nx, ny) < 2:
        raise Refused(f"is a profile of {nx} x {ny} points and no map")
    if size and channel.size and any(abs(a / b - 1) > 1e-3 for a, b in zip(size, channel.size)):
        notes.append(f"note: the file states the size {channel.size[0]:.6g} x "
                     f"{channel.size[1]:.6g} m; --size prevails")
    if unit and channel.metres and abs(unit / channel.metres - 1) > 1e-9:
        notes.append(f"note: the file states a unit of {channel.metres:.6g} m; --unit prevails")
    if xy_unit and channel.size:
        notes.append("note: --xy-unit prevails over the unit that the file states"
                     if channel.extent else
                     "note: --xy-unit holds for coordinates and for sides without a unit only")
    if xy_unit and channel.extent:
        channel.size = tuple(side * xy_unit for side in channel.extent)
    channel.size, channel.metres = size or channel.size, unit or channel.metres
    _check_completeness(channel, unit)
    _check_values(channel)
    return notes


def _check_completeness(channel, unit):
    if channel.quantity and not unit:
        raise Refused(f"has heights in '{channel.quantity}', which is no length: --unit says what a "
                      "value of 1 is, such as --unit nm")
    lateral = "--xy-unit um" if channel.extent else '--size "10 um"'
    lacking = [(what, option) for what, option, known in (
        ("the unit of its sides" if channel.extent else "its size", lateral, channel.size),
        ("the unit of its heights", "--unit nm", channel.metres)) if known is None]
    if lacking:
        raise Refused(f"does not state {' and '.join(what for what, _ in lacking)}: add, with its "
                      "own values, " + " ".join(option for _, option in lacking))


def _check_values(channel):
    if not all(np.isfinite(side) and 0 < side < 1e6 for side in channel.size):
        raise Refused(f"states the size {channel.size[0]:g} x {channel.size[1]:g} m, which no map has")
    if not np.isfinite(channel.values).any():
        raise Refused("has no measured point")
    with np.errstate(all="ignore"):
        heights = channel.values[np.isfinite(channel.values)] * channel.metres
    if not np.isfinite(heights).all() or abs(heights).max() > 1e6:
        raise Refused("has heights above 1000 km: look for the number that marks missing points, "
                      "or for the unit")
