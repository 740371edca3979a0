"""Look at the top of a text: which delimiter, is there a header, where are the numbers."""

from __future__ import annotations

import re
from collections import Counter
from dataclasses import dataclass
from typing import TextIO

from alphamesh.io._columns import Wanted, choose_columns, same_name
from alphamesh.io._layout import Layout, TextOptions, blank_characters, is_value, split
from alphamesh.io._sources import Source

__all__ = ["find_layout"]

# How much of a file decides.
_SAMPLE_LINES = 100
_SAMPLE_CHARACTERS = 2**20
_DELIMITERS = ("\t", ";", ",")


@dataclass(frozen=True, slots=True)
class _Sample:
    """The first lines that hold data: their numbers and text; the comment before them."""

    numbers: list[int]
    lines: list[str]
    remark: str


def find_layout(
    source: Source,
    text: TextIO,
    wanted: Wanted,
    options: TextOptions,
    usual_delimiter: str | None,
) -> Layout:
    """Find out how a text table is laid out.

    Parameters
    ----------
    source : Source
        For messages.
    text : text file
        Read from its start.
    wanted : Wanted
        As from :func:`wanted_columns`.
    options : TextOptions
        What the caller knows.
    usual_delimiter : str or None
        The delimiter that the name of the file stands for, if it does.

    Raises
    ------
    FileReadError
        If there are no rows, or the columns asked for are not there.
    """
    sample = _take(source, text, options)
    if not sample.lines:
        raise source.failure(
            "holds no rows of numbers; was it written to the end? "
            "(lines that begin with a comment character, and those skipped, do not count)"
        )
    delimiter = options.delimiter or usual_delimiter or _delimiter(sample.lines, options)
    delimiter = None if delimiter == " " else delimiter
    cells = [split(line, delimiter) for line in sample.lines]
    start, names = 0, []
    if _is_header(cells[0], wanted, options):
        if len(cells) == 1:
            raise source.failure(
                f"holds only the header line {sample.lines[0].strip()[:60]!r} and no rows of "
                "numbers; was it written to the end? If that line is data, pass header=False"
            )
        start, names = 1, cells[0]
    elif options.header == "auto":
        names = _remark_names(sample, cells, delimiter, options)
    width = _usual_width(cells[start:], sample.lines[start:])
    _refuse_count(source, cells, width)
    if names:
        names = _aligned_names(source, names, cells[start:], width, wanted)
    columns = choose_columns(source, wanted, names, width)
    return Layout(
        sample.numbers[start],
        columns,
        delimiter,
        tuple(names),
        options.comment,
        options.decimal,
    )


def _take(source: Source, text: TextIO, options: TextOptions) -> _Sample:
    """Return the first lines with data, their comments cut off."""
    sample = _Sample([], [], "")
    remark, number, budget = "", 0, _SAMPLE_CHARACTERS
    blank = blank_characters(options.delimiter or "".join(_DELIMITERS))
    while len(sample.lines) < _SAMPLE_LINES and budget > 0:
        line = text.readline(_SAMPLE_CHARACTERS)
        if not line:
            break
        number += 1
        budget -= len(line)
        if len(line) == _SAMPLE_CHARACTERS or "\0" in line:
            raise source.failure(
                f"is not a table in text: line {number} is very long or holds binary data; "
                "if it is a point file of another format, pass file_format="
            )
        if number <= options.skip:
            continue
        if options.comment is not None:
            line, mark, after = line.partition(options.comment)
            if mark and not line.strip(blank) and not sample.lines:
                remark = after.strip()
        if line.strip(blank):
            sample.numbers.append(number)
            sample.lines.append(line)
    return _Sample(sample.numbers, sample.lines, remark)


def _delimiter(lines: list[str], options: TextOptions) -> str | None:
    """Return the delimiter found in most lines; None for blanks."""
    stripped = [re.sub('"[^"]*"', "", line).strip() for line in lines]
    for candidate in _DELIMITERS:
        if candidate == options.decimal:
            continue
        if 2 * sum(candidate in line for line in stripped) > len(stripped):
            return candidate
    return None


def _is_header(cells: list[str], wanted: Wanted, options: TextOptions) -> bool:
    """Return whether a line has no number at all, or a name that is asked for."""
    if isinstance(options.header, bool):
        return options.header
    asked = [i for i in wanted.columns if isinstance(i, str) and not is_value(i)]
    if any(same_name(cell, item) for cell in cells for item in asked):
        return True
    return not any(is_value(cell, options.decimal) for cell in cells)


def _remark_names(
    sample: _Sample, cells: list[list[str]], delimiter: str | None, options: TextOptions
) -> list[str]:
    """Return the column names in the comment before the data, if it holds just those."""
    width = _usual_width(cells, sample.lines)
    for separator in (delimiter, None):
        names = split(sample.remark, separator)
        if len(names) == width and not any(is_value(name, options.decimal) for name in names):
            return names
    return []


def _usual_width(cells: list[list[str]], lines: list[str]) -> int:
    """Return the most common number of cells; those of quotes over lines count last."""
    whole = [row for row, line in zip(cells, lines, strict=True) if line.count('"') % 2 == 0]
    return Counter(len(row) for row in whole or cells).most_common(1)[0][0]


def _aligned_names(
    source: Source, names: list[str], cells: list[list[str]], width: int, wanted: Wanted
) -> list[str]:
    """Return one name for each column of the rows."""
    if len(names) == width:
        return names
    if len(names) == width - 1:
        if all(row[-1] == "" for row in cells if len(row) == width):
            return [*names, ""]  # the rows end with a delimiter
        return ["", *names]  # R leaves the column of row names without a name
    if wanted.columns and all(isinstance(item, int) for item in wanted.columns):
        return []
    raise source.failure(
        f"names {len(names)} columns in its header, but its rows have {width}; choose by "
        "number, such as columns=(0, 1), and check delimiter="
    )


def _refuse_count(source: Source, cells: list[list[str]], width: int) -> None:
    """Name the remedy for files that begin with the number of their points."""
    if width > 1 and len(cells[0]) == 1 and cells[0][0].isdigit():
        raise source.failure(
            f"begins with a lone number, while other lines have {width} columns; if it is "
            "the number of points, pass skip=1; in the XYZ files of chemistry skip=2 and "
            "columns=(1, 2)"
        )
