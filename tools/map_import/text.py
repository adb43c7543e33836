# SPDX-License-Identifier: GPL-2.0-or-later
"""Tables of numbers: matrices, points, channels one after the other, with any header.

Nothing is guessed: a table that can be read in several ways is refused with a sentence that
names them and the option that chooses.
"""
import itertools
import math
import re

import numpy as np

from .channel import Channel, MOST_POINTS, Refused, metres_in
from .table import Block, blocks_of, last_digits, separator_of, table_of
from .text_header import TextHeader, take_apart


def _is_uniform(values, words, share=1.):
    """Whether values go up or down by equal steps, as those of an axis do.

    The values printed as words may be off by one in the last digit, but not by more than this
    share of a step.
    """
    steps = np.diff(values)
    with np.errstate(all="ignore"):
        step = abs(steps.mean()) if len(steps) > 2 else 0.
        if not (0 < step < math.inf and abs(np.sign(steps).sum()) == len(steps)):
            return False
        off = abs(values - np.linspace(values[0], values[-1], len(values)))
        # A millionth of a step allows for rounding errors.
        digits = last_digits(words) if len(words) == len(values) else 0.
        allowed = np.minimum(digits, share * step) + 1e-6 * step
        return bool((abs(abs(steps) - step) < 1e-3 * step).all() or (off <= allowed).all())


def _grid_indices(coordinates):
    """The grid line of each coordinate, counted from 0, and their spacing; None without a grid."""
    if not np.isfinite(coordinates).all():
        return None
    distinct = np.unique(coordinates)
    extent = distinct[-1] - distinct[0]
    steps = np.diff(distinct)
    steps = steps[steps > extent / (20. * MOST_POINTS)]
    if extent <= 0 or not len(steps):
        return None
    # The mean of the steps between neighbouring lines, which noise does not bias.
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
    """Maps of lines x, y, z, ...: (one for each column after x and y, (dx, dy)), or None."""
    x, y = _grid_indices(table[:, 0]), _grid_indices(table[:, 1])
    if x is None or y is None or len(table) < 4:
        return None
    nx, ny = x[0].max() + 1, y[0].max() + 1
    place = y[0] * nx + x[0]
    # A grid with more holes than points is not one.
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
        line = line.lstrip("#% ")
        if separator is None:
            if re.search("[:=]", line):   # a statement
                continue
            # A unit behind a name would be a word of its own.
            line = re.sub(r"\s+(?=[\[(])", "", line)
        words = [word.strip(" \t,;") for word in line.split(separator)]
        if len(words) == n_columns:
            return words
    return [""] * n_columns


def _unit_of_column(name):
    """The unit in the name of a column, or ""."""
    match = re.search(r"[\[(/]\s*([^\])]+)[\])]?$|\s(?:in)\s+(\S+)$", name)
    return (match[1] or match[2]) if match else ""


def _metres_of_column(name, of_header):
    """The metres in the unit of a column, and whether its name contradicts the header."""
    unit = _unit_of_column(name)
    own = metres_in(unit) if unit else None
    differs = unit and of_header and (own is None or abs(own / of_header - 1) > 1e-9)
    return own or of_header, bool(differs)


def _in_order(table, names):
    """The table and its names with x and y in front, if names tell which columns these are: a word
    of one becomes a word of the other if x is replaced by y, or column by row."""
    said = [re.findall(r"[^\W\d_]+", re.sub(r"[\[(].*", "", name.lower())) for name in names]
    for x, y in (("x", "y"), ("column", "row"), ("col", "row")):
        for i, words in enumerate(said):
            twins = {word.replace(x, y, 1) for word in words if x in word}
            if not twins:
                continue
            for j, others in enumerate(said):
                if i != j and twins.intersection(others):
                    order = [i, j, *(k for k in range(len(names)) if k not in (i, j))]
                    return table[:, order], [names[k] for k in order]
    return table, names


def _as_points(table, header, names, options):
    """The channels of a table of points; None if these form no grid."""
    if names[0].lower() in ("index", "i", "#", "no", "no.", "nr", "nr."):
        table, names = table[:, 1:], names[1:]
    if table.shape[1] < 3:
        _refuse_profile(*table.shape)
    table, names = _in_order(table, names)
    found = _points(table)
    if not found:
        return None
    maps, spacing = found
    lateral = []
    for name in names[:2]:
        unit, differs = _metres_of_column(name, header.coordinate)
        if differs and not (options.xy_unit or options.size):
            raise Refused(f"names a column '{name}' and states another unit of coordinates in its "
                          "header: --xy-unit or --size says what holds")
        lateral.append(unit)
    channels = []
    for values, name in zip(maps, names[2:]):
        unit, differs = _metres_of_column(name, header.metres)
        refusal = "" if options.unit or not differs else (
            f"names a column '{name}' and states another unit of heights in its header: --unit "
            "says what holds")
        ny, nx = values.shape
        extent = nx * spacing[0], ny * spacing[1]
        size = header.size(nx, ny) if None in lateral else (
            extent[0] * lateral[0], extent[1] * lateral[1])
        disputed = header.disputed(nx, ny, size)
        if len(maps) > 1:
            name = name or f"column {len(channels) + 3}"
        channels.append(Channel(name or header.name, header.without_marks(values), size, extent,
                                unit, header.quantity, disputed=disputed, refusal=refusal))
    return channels


def _refuse_profile(n_rows, n_columns):
    what = "one number" if n_columns == 1 else "two numbers"
    raise Refused(f"has {what} in each of its {n_rows} lines, which is a profile and no map "
                  "(if it is a matrix all the same: --as matrix)")


def _edges(block, separator):
    """The words of the first two rows, and of the first two columns."""
    rows = [line.rstrip().split(separator) for line in block.lines[:2]]
    return rows, list(zip(*(line.split(separator, 2)[:2] for line in block.lines)))


def _without_axes(table, edges):
    """The matrix below a row of x, and beside a column of y if there is one; and its extent."""
    y, words_y = table[1:, 0], edges[1][0][1:]
    column = _is_uniform(y, words_y)
    x, words_x = table[0, int(column):], edges[0][0][int(column):table.shape[1]]
    # Steps that are printed more coarsely may hide a gap.
    if not _is_uniform(x, words_x, .3) or (column and not _is_uniform(y, words_y, .3)):
        raise Refused("has no first row, or first column, of equal steps to three tenths of one, "
                      "which --as axes needs")
    values = table[1:, int(column):]
    ny, nx = values.shape
    dx = abs(x[-1] - x[0]) / (nx - 1)
    extent = nx * dx, ny * (abs(y[-1] - y[0]) / (ny - 1) if column else dx)
    # The heights are turned so that x and y increase.
    values = values[:, ::-1] if x[0] > x[-1] else values
    return (values[::-1] if column and y[0] > y[-1] else values), extent


def _check_for_axes(table, header, corner, edges):
    """Refuse a matrix whose first row or column may be an axis."""
    n_rows, n_columns = table.shape
    if (header.rows, header.columns) == (n_rows, n_columns):
        return
    if n_rows < 4 or n_columns < 4:
        return

    def stands_out(lines, words):
        """Whether the first line, with or without its first number, has equal steps, and the
        second has not."""
        return any(_is_uniform(lines[0, i:], words[0][i:lines.shape[1]])
                   and not _is_uniform(lines[1, i:], words[1][i:lines.shape[1]]) for i in (0, 1))

    row = bool(corner) or stands_out(table[:2], edges[0])
    column = stands_out(table.T[:2], edges[1])
    if row:
        raise Refused("begins with a row of equal steps: it may be the x of the columns (--as axes) "
                      "or part of the map (--as matrix)")
    if column:
        raise Refused("begins each line with a number that grows by equal steps: if it is part of "
                      "the map say --as matrix; profiles side by side are no map")


def _check_promise(table, header):
    """The table with the rows and columns that its header states; one column may be the matrix."""
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
    header = TextHeader(header_lines, options)
    separator = separator_of(max(block.lines[:20], key=len))
    table, corner = table_of(block, separator, options)
    n_rows, n_columns = table.shape
    reading = options.reading
    names = _column_names(header_lines, separator, n_columns)
    # Below the sides of a map, a matrix may have three columns as well.
    may_be_points = n_columns >= 3 and (header.rows, header.columns) != table.shape and (
        not header.side or n_columns < n_rows)
    if reading == "points" or (reading is None and may_be_points):
        channels = _as_points(table, header, names, options)
        if channels:
            return channels
        if reading == "points" or (n_columns == 3 and not header.side):
            raise Refused("has three or more numbers a line that are no x, y, z of points on a "
                          "regular grid, each once (if it is a matrix: --as matrix)")
    table = _check_promise(table, header)
    if reading is None and table.shape[1] <= 2:
        _refuse_profile(*table.shape)
    if reading is None and re.sub(r"\s*[\[(].*", "", names[0].lower()) in ("index", "x"):
        raise Refused("names its columns as a profile or a list of points that form no grid (if it "
                      "is a matrix: --as matrix)")
    extent = None
    if reading == "axes" or (reading is None and corner is not None and "/" in corner):
        table, extent = _without_axes(table, _edges(block, separator))
    elif reading is None:
        _check_for_axes(table, header, corner, _edges(block, separator))
    ny, nx = table.shape
    of_axes = tuple(side * header.coordinate for side in extent) if (
        extent and header.coordinate) else None
    return [Channel(header.name, header.without_marks(table), of_axes or header.size(nx, ny),
                    extent, header.metres, header.quantity,
                    disputed=header.disputed(nx, ny, of_axes))]


def _join(blocks, options):
    """Join blocks that only blank lines separate, if they may be one table."""
    if any(block.header for block in blocks[1:]):
        return blocks
    lines = list(itertools.chain.from_iterable(block.lines for block in blocks))
    whole = Block(blocks[0].first_line, blocks[0].header)
    whole.lines = lines
    # As in files for gnuplot: blank lines between the lines of a scan, or between all lines.
    n_columns = len(lines[0].split(separator_of(lines[0])))
    if options.reading or n_columns == 3 or all(len(block) == 1 for block in blocks):
        return [whole]
    return blocks


def _without_statements(common, own):
    """The lines of the common header, without what the header of one table states anew."""
    keys = {found[0] for found in map(take_apart, own) if found}
    return [line for line in common if (take_apart(line) or ("",))[0] not in keys]


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
        try:
            lines = block.header if i == 0 or TextHeader(block.header, options).size(1, 1) else (
                _without_statements(common, block.header) + block.header)
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
