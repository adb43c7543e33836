# SPDX-License-Identifier: GPL-2.0-or-later
"""Split a text into blocks of lines of numbers, and these into tables, whatever the separator."""
import csv
import math
import re

import numpy as np

from .channel import Refused

_MISSING = {"nan", "-nan", "bad", "***", "**", "--", "---", "#n/a", "n/a", "na", "nodata",
            "masked", "inf", "-inf", "+inf", "infinity", "-infinity", "#nan", "-1.#ind", "1.#qnan",
            "-1.#ind00", "1.#qnan0", "nan(ind)", "-nan(ind)", "****", "null"}
# A statement of the value that marks missing points.
MARK = re.compile(r"[#%\s]*(?:no[ _-]?data(?:[ _-]?value)?|"
                  r"(?:missing|fill|invalid|bad|nan)[ _-]?value)\b[\s:=,;]+(\S.*?)[\s,;]*", re.I)
_NUMBER = re.compile(r"[-+]?(\d+([.,]\d*)*|[.,]\d+)([eE][-+]?\d+)?")


def decode(content):
    """The text of a file in UTF-8, UTF-16 or Latin-1; None for a binary file."""
    for mark, encoding in ((b"\xff\xfe", "utf-16"), (b"\xfe\xff", "utf-16"),
                           (b"\xef\xbb\xbf", "utf-8-sig")):
        if content.startswith(mark):
            try:
                return content.decode(encoding)
            except UnicodeDecodeError:
                return None
    if re.search(rb"[\x00-\x08\x0e-\x1f]", content[:65536]) or b"\0" in content:
        return None
    try:
        return content.decode("utf-8")
    except UnicodeDecodeError:
        return content.decode("latin-1")


def _is_number(word):
    return word.lower() in _MISSING or _NUMBER.fullmatch(word) is not None


def _is_data(line):
    """Whether a line holds numbers: the first word is one, and at least half of all are."""
    words = re.split(r"[\s;,]+", line[:1000].strip(" \t;,"))
    if line.startswith(("#", "%")) and not _is_number(words[0]):
        return False
    if not _is_number(words[0]):
        # The corner of a table with axes may be a word. A damaged number must not make its
        # row a line of words, which would be skipped.
        return len(words) > 3 and not re.search("[:=]", line) and (
            2 * sum(map(_is_number, words)) >= len(words))
    if words[0].lower() in _MISSING and len(words) == 1:
        return False                                     # "---" is an ornament
    if len(line) > 1000:
        words = words[:-1]
    return 2 * sum(map(_is_number, words)) >= len(words)


class Block:
    """Consecutive lines of numbers, and the lines of words above them."""

    def __init__(self, first_line, header):
        self.first_line, self.header, self.lines = first_line, header, []

    def __len__(self):
        return len(self.lines)


def _without_quotes(line):
    """A line without the quotes of its cells; commas between cells become semicolons."""
    if ";" in line or "\t" in line:
        return line.replace('"', "")
    return ";".join(next(csv.reader([line]), []))


def _refuse_empty_rows(lines):
    """Refuse rows of empty cells next to lines of numbers: they may be missing points or nothing.

    They are nothing if lines of words are padded with empty cells as well, as by a spreadsheet.
    """
    for number, (line, before, after) in enumerate(
            zip(lines, ["", *lines], [*lines[1:], ""]), 1):
        cells = re.fullmatch(r" *([;,\t])(?: *\1)* *", line)
        if not cells or not any(
                _is_data(other) and other.count(cells[1]) == line.count(cells[1])
                for other in (before, after)):
            continue
        if not any(other.rstrip().endswith(cells[1]) and re.match(r"\W*[^\W\d]", other)
                   and other.count(cells[1]) == line.count(cells[1]) for other in lines[:1000]):
            raise Refused(f"has empty cells only in line {number}: write nan into them if the row "
                          "was not measured, or remove it")


def blocks_of(text):
    """The blocks of the text; blank lines and lines of words separate them."""
    lines = [_without_quotes(line) if '"' in line else line
             for line in text.replace("\u2212", "-").splitlines()]
    _refuse_empty_rows(lines)
    blocks, header, is_open = [], [], False
    for number, line in enumerate(lines, 1):
        if ("ata" in line or "ATA" in line) and not MARK.fullmatch(line):
            line = re.sub(r"no data", "nan", line, flags=re.I)
        if not line.strip() or MARK.fullmatch(line) or not _is_data(line):
            is_open = False
            if line.strip(" \t,;") and len(line) <= 1000 and len(header) < 1000:
                header.append(line)
            continue
        if not is_open:
            blocks.append(Block(number, header))
            header, is_open = [], True
        blocks[-1].lines.append(line)
    return blocks


def separator_of(line):
    """The separator of the numbers in a line; None for white space."""
    if ";" in line:
        return ";"
    if "\t" in line.strip():
        return "\t"
    if re.search(r"[^\s,]\s+[^\s,]", line.strip()):
        return None
    return "," if "," in line else None


def may_be_thousands(word):
    """Whether the commas of a number may separate thousands as well as decimals."""
    return re.fullmatch(r"\s*[-+]?[1-9]\d{0,2}(,\d{3})+\s*", word) is not None


def last_digits(words):
    """The value of one in the last printed digit of each number; 0 for a word that is none."""
    found = [re.fullmatch(r"[-+]?\d*(?:[.,](\d*))?(?:[eE]([-+]?\d{1,4}))?", word.strip())
             for word in words]
    return np.array([float(f"1e{int(match[2] or 0) - len(match[1] or '')}") if match else 0.
                     for match in found])


def _decimal_sign(block, separator, options):
    """The decimal sign, from the first rows or the option of the user."""
    rows = block.lines[:200]
    if separator == ",":
        text = "\n".join(rows)
        if "." not in text and re.search(r"\d,\d", text) and re.search(r"\d, +[-+\d]", text):
            raise Refused("has commas with a blank behind them and others without, which may be "
                          "separators and decimal signs: export it with another separator")
        return "."
    if options.decimal:
        return "," if options.decimal == "comma" else "."
    words = [word for line in rows for word in line.split(separator) if "," in word]
    if not words:
        return "."
    if any("." in word for word in words) or all(map(may_be_thousands, words)):
        raise Refused("has commas that may be decimal signs or separate thousands, as in "
                      f"'{words[0].strip()}': --decimal comma or --decimal point says which")
    return ","


def table_of(block, separator, options):
    """The numbers of a block, and the word in its upper left corner if that is not a number."""
    comma = _decimal_sign(block, separator, options) == ","
    rows, corner, n_columns = [], None, None
    for i, line in enumerate(block.lines):
        words = [word.strip() for word in line.rstrip().split(separator)]
        if separator and words[-1] == "":
            words.pop()                                  # a separator may end a line
        if i == 0 and words and re.fullmatch(r"[^\d.]*", words[0]) and (
                not _is_number(words[0])):
            corner, words[0] = words[0], "nan"
        if n_columns is None:
            n_columns = len(words)
        if len(words) != n_columns:
            raise Refused(f"has {len(words)} values in line {block.first_line + i} and "
                          f"{n_columns} in the row above")
        rows.append(_numbers(words, comma, block.first_line + i))
    if not rows[0].size:
        raise Refused("holds no table of numbers")
    return np.array(rows), corner


def _numbers(words, comma, line_number):
    numbers = []
    for column, word in enumerate(words, 1):
        try:
            if "_" in word:          # float() accepts it in numbers
                raise ValueError
            if not word or word.lower() in _MISSING:
                numbers.append(math.nan)
            else:
                numbers.append(float(word.replace(",", ".") if comma else word))
        except ValueError:
            raise Refused(f"has '{word[:40]}' in line {line_number}, column {column}, which is no "
                          "number") from None
    return np.array(numbers)
