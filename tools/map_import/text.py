# SPDX-License-Identifier: GPL-2.0-or-later
"""Tables of numbers: matrices, points, channels one after the other, with any header.

Nothing is guessed: where a table can be read in several ways, the sentence that refuses it
names them and the option that chooses.
"""
import itertools
import math
import re

import numpy as np

from .channel import Channel, MOST_POINTS, Refused, metres_in
from .table import Block, blocks_of, separator_of, table_of
from .text_header import TextHeader


def _is_uniform(values):
    """Whether values go up or down by equal steps, as those of an axis do."""
    steps = np.diff(values)
    with np.errstate(all="ignore"):
        return bool(len(steps) > 2 and np.isfinite(steps).all() and abs(steps[0]) > 0
                    and (abs(steps - steps.mean()) < 1e-3 * abs(steps.mean())).all())


def _grid_indices(coordinates):
    """The grid lines of scattered coordinates and their spacing; None if they form none."""
    if not np.isfinite(coordinates).all():
        return None
    distinct = np.unique(coordinates)
    extent = distinct[-1] - distinct[0]
    steps = np.diff(distinct)
    steps = steps[steps > extent / (20. * MOST_POINTS)]
    if extent <= 0 or not len(steps):
        return None
    # The mean over the steps between neighbours, which noise of the file does not bias.
    least = steps.min()
    spacing = steps[steps < 1.5 * least].mean()
    lines = np.rint((coordinates - distinct[0]) / spacing)
    spacing = extent / max(lines.max(), 1)
    lines = np.rint((coordinates - distinct[0]) / spacing)
    if lines.max() >= MOST_POINTS or (
            abs(coordinates - distinct[0] - lines * spacing) > spacing / 20).any():
        return None
    return lines.astype(int), spacing


def _points(table):
    """The map of lines x, y, z, ... as ((values of each column behind), (dx, dy)), or None."""
    x, y = _grid_indices(table[:, 0]), _grid_indices(table[:, 1])
    if x is None or y is None or len(table) < 4:
        return None
    nx, ny = x[0].max() + 1, y[0].max() + 1
    place = y[0] * nx + x[0]
    # A grid with more holes than points is none.
    if nx * ny > 2 * len(table) or len(np.unique(place)) != len(place):
        return None
    maps = []
    for column in table.T[2:]:
        values = np.full(nx * ny, math.nan)
        values[place] = column
        maps.append(values.reshape(ny, nx))
    return maps, (x[1], y[1])


def _column_names(header, separator, n_columns):
    """The names above the columns, if there is one for each."""
    for line in reversed(header):
        words = [word.strip() for word in line.lstrip("#% ").split(separator)]
        if len(words) == n_columns:
            return words
    return [""] * n_columns


def _unit_of_column(name):
    match = re.search(r"[\[(/]\s*([^\])]+)[\])]?$|\s(?:in)\s+(\S+)$", name)
    return metres_in(match[1] or match[2]) if match else None


def _as_points(table, header, names):
    """Channels of a table of points; None if it is none."""
    if names[0].lower() in ("index", "i", "#", "no", "no.", "nr", "nr."):
        table, names = table[:, 1:], names[1:]
    if table.shape[1] < 3:
        _refuse_profile(*table.shape)
    found = _points(table)
    if not found:
        return None
    maps, spacing = found
    lateral = [header.coordinate or _unit_of_column(name) for name in names[:2]]
    channels = []
    for values, name in zip(maps, names[2:]):
        unit = header.metres or _unit_of_column(name)
        ny, nx = values.shape
        extent = nx * spacing[0], ny * spacing[1]
        size = None if None in lateral else (extent[0] * lateral[0], extent[1] * lateral[1])
        if len(maps) > 1:
            name = name or f"column {len(channels) + 3}"
        channels.append(Channel(name or header.name, values, size, extent, unit,
                                header.quantity))
    return channels


def _refuse_profile(n_rows, n_columns):
    what = "one number" if n_columns == 1 else "two numbers"
    raise Refused(f"has {what} in each of its {n_rows} lines, which is a profile and no map "
                  "(if it is a matrix all the same: --as matrix)")


def _without_axes(table):
    """A matrix below a row of x, and beside a column of y where there is one."""
    column = _is_uniform(table[1:, 0])
    y = table[1:, 0] if column else None
    x = table[0, 1:] if column else table[0]
    if not _is_uniform(x):
        raise Refused("has no first row of equal steps, which --as axes needs")
    values = table[1:, 1:] if column else table[1:]
    ny, nx = values.shape
    dx = abs(x[-1] - x[0]) / (nx - 1)
    extent = nx * dx, ny * (abs(y[-1] - y[0]) / (ny - 1) if column else dx)
    # Heights are turned so that x and y go up.
    values = values[:, ::-1] if x[0] > x[-1] else values
    return (values[::-1] if column and y[0] > y[-1] else values), extent


def _check_for_axes(table, header, corner):
    """Refuse a matrix whose first row or column may be an axis."""
    n_rows, n_columns = table.shape
    if header.is_gwyddion or (header.rows, header.columns) == (n_rows, n_columns):
        return
    if n_rows < 4 or n_columns < 4:
        return
    row = corner is not None or (
        (_is_uniform(table[0]) and not _is_uniform(table[1]))
        or (_is_uniform(table[0, 1:]) and not _is_uniform(table[1, 1:])))
    column = ((_is_uniform(table[:, 0]) and not _is_uniform(table[:, 1]))
              or (_is_uniform(table[1:, 0]) and not _is_uniform(table[1:, 1])))
    if row:
        raise Refused("begins with a row of equal steps: it may be the x of the columns (--as axes) "
                      "or part of the map (--as matrix)")
    if column:
        raise Refused("begins each line with a number that grows by equal steps: if it is part of "
                      "the map say --as matrix; profiles side by side are no map")


def _check_promise(table, header):
    """A single column may be the whole matrix; a multiple of the rows, several channels."""
    n_rows, n_columns = table.shape
    rows, columns = header.rows, header.columns
    if rows and columns and n_columns == 1 and n_rows == rows * columns:
        return table.reshape(rows, columns)
    if (rows or n_rows) != n_rows or (columns or n_columns) != n_columns:
        raise Refused(f"promises {rows or n_rows} rows of {columns or n_columns} values and holds "
                      f"{n_rows} rows of {n_columns}")
    return table


def _read_block(block, header_lines, options):
    """The channels of a block under its header."""
    header = TextHeader(header_lines)
    separator = separator_of(max(block.lines[:20], key=len))
    table, corner = table_of(block, separator, options)
    n_rows, n_columns = table.shape
    reading = options.reading
    names = _column_names(header_lines, separator, n_columns)
    if reading == "points" or (reading is None and n_columns >= 3 and not header.side):
        channels = _as_points(table, header, names)
        if channels:
            return channels
        if reading == "points" or n_columns == 3:
            raise Refused("has three or more numbers a line that are no x, y, z of points on a "
                          "regular grid, each once (if it is a matrix: --as matrix)")
    table = _check_promise(table, header)
    if reading is None and table.shape[1] <= 2:
        _refuse_profile(*table.shape)
    if reading is None and names[0].lower() in ("index", "x"):
        raise Refused("names its columns as a profile or a list of points that form no grid")
    size, extent = header.size(table.shape[1], table.shape[0]), None
    if reading == "axes" or (reading is None and corner is not None and "/" in corner):
        table, extent = _without_axes(table)
        size = tuple(side * header.coordinate for side in extent) if header.coordinate else size
    elif reading is None:
        _check_for_axes(table, header, corner)
    return [Channel(header.name, table, size, extent, header.metres, header.quantity)]


def _join(blocks, options):
    """Lines that only blank ones separate may be one table."""
    if any(block.header for block in blocks[1:]):
        return blocks
    lines = list(itertools.chain.from_iterable(block.lines for block in blocks))
    whole = Block(blocks[0].first_line, blocks[0].header)
    whole.lines = lines
    # As of gnuplot: blank lines between the lines of a scan, or between all.
    n_columns = len(lines[0].split(separator_of(lines[0])))
    if options.reading or n_columns == 3 or all(len(block) == 1 for block in blocks):
        return [whole]
    return blocks


def read_text(text, options):
    """The channels of a text file; raises Refused."""
    blocks = blocks_of(text)
    if not blocks:
        raise Refused("holds no table of numbers")
    if len(blocks) > 1:
        blocks = _join(blocks, options)
    if len(blocks) > 64:
        raise Refused(f"falls into {len(blocks)} tables between lines of words")
    channels, common = [], blocks[0].header
    for i, block in enumerate(blocks):
        lines = block.header if i == 0 or TextHeader(block.header).size(1, 1) else (
            common + block.header)
        try:
            channels += _read_block(block, lines, options)
        except Refused as reason:
            if len(blocks) > 1:
                raise Refused(f"has {len(blocks)} tables, and that of line {block.first_line} "
                              + str(reason)) from None
            raise
    if len(channels) > 1:
        for i, channel in enumerate(channels, 1):
            channel.name = channel.name or f"table {i}"
    return channels
