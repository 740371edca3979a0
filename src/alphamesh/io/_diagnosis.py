"""Say which lines of a text table hold no numbers, and what to do about them."""

from __future__ import annotations

import csv
import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from typing import Literal, TypeAlias

from alphamesh.errors import rows_text
from alphamesh.io._layout import Layout, blank_characters, is_missing, is_number, split

__all__ = ["explain"]

Kind: TypeAlias = Literal["short", "blank", "text", "quote"]
Row: TypeAlias = tuple[int, list[str], list[str]]  # line number, cells, the lines behind it

_KEPT = 6
# Rows looked at to count the faults, so that the message comes soon.
_LOOKED_AT = 200_000
_QUOTED = re.compile('"[^"]*"')
_OPEN_QUOTE = re.compile(r'(?:^|\s)"[^"]*$')


@dataclass(slots=True)
class _Fault:
    kind: Kind
    detail: str
    lines: list[int] = field(default_factory=list)
    total: int = 0


def explain(lines: Iterable[str], layout: Layout, start: int) -> str:
    """Return what is wrong with the rows of a table, or "" if nothing is.

    Parameters
    ----------
    lines : iterable of str
        The text from line number `start` on.
    layout : Layout
    start : int
        The first line with data, or one before which nothing is wrong.

    Returns
    -------
    str
        A phrase that follows the name of the file: lines and remedy.
    """
    faults: dict[Kind, _Fault] = {}
    seen = 0
    try:
        for number, cells, behind in _rows(lines, layout, start):
            seen += 1
            found = _fault(number, cells, behind, layout)
            if found is not None:
                fault = faults.setdefault(found.kind, found)
                fault.total += 1
                if len(fault.lines) < _KEPT:
                    fault.lines.append(number)
            if number - layout.first + 1 == layout.rows or seen == _LOOKED_AT:
                break
    except csv.Error as error:
        if not faults:
            return f"cannot be read as a table: {error}; check delimiter="
    if not faults:
        return ""
    first = min(faults.values(), key=lambda fault: fault.lines[0])
    where = rows_text(first.lines, total=first.total).replace("row", "line", 1)
    if seen == _LOOKED_AT:
        where += " and perhaps more"
    every = first.total == seen and start == layout.first
    return f"{_WHAT[first.kind]} in {where} ({first.detail}); {_remedy(first, every, layout)}"


def _rows(lines: Iterable[str], layout: Layout, start: int) -> Iterator[Row]:
    """Yield the rows with something in them."""
    blank = blank_characters(layout.delimiter)
    if layout.delimiter is None:
        for number, whole in enumerate(lines, start):
            line = _without_comment(whole, layout)
            if line.strip(blank):
                yield number, split(line, None), [line]
        return
    number = start
    behind: list[str] = []
    for cells in csv.reader(_remembered(lines, layout, behind), delimiter=layout.delimiter):
        taken = behind.copy()
        behind.clear()
        if "".join(taken).strip(blank):
            yield number, [cell.strip() for cell in cells], taken
        number += len(taken)


def _remembered(lines: Iterable[str], layout: Layout, behind: list[str]) -> Iterator[str]:
    """Yield lines for the csv reader, and keep those that it took for its row."""
    for line in lines:
        behind.append(_without_comment(line, layout))
        yield behind[-1]


def _without_comment(line: str, layout: Layout) -> str:
    if layout.comment is None:
        return line
    head, mark, _ = line.partition(layout.comment)
    return head if mark and head.count('"') % 2 == 0 else line


def _fault(number: int, cells: list[str], behind: list[str], layout: Layout) -> _Fault | None:
    """Return what is wrong with one row."""
    if _swallows_rows(behind, layout):
        return _Fault("quote", f"line {number} begins {behind[0].strip()[:30]!r}")
    needed = max(layout.columns) + 1
    if len(cells) < needed:
        return _Fault("short", f"{len(cells)} where {needed} are needed")
    for column in layout.columns:
        cell = cells[column]
        if not is_number(cell, layout.decimal):
            kind: Kind = "blank" if not cell or is_missing(cell) else "text"
            where = f"line {number}, column {layout.column_text(column)}"
            return _Fault(kind, f"{where}: {_short(cell)}" if cell else where)
    return None


def _swallows_rows(behind: list[str], layout: Layout) -> bool:
    """Whether a quotation mark left open has made a cell out of the rows after it."""
    if layout.delimiter is None:
        return any(_OPEN_QUOTE.search(_QUOTED.sub("", line)) for line in behind)
    return any(
        '"' not in line and _fault(0, split(line, layout.delimiter), [], layout) is None
        for line in behind[1:]
    )


_WHAT: dict[Kind, str] = {
    "short": "has too few columns",
    "blank": "has no number",
    "text": "has text in the place of a number",
    "quote": "has a quotation mark that is not closed",
}


def _remedy(fault: _Fault, every: bool, layout: Layout) -> str:
    if fault.kind == "quote":
        return "close it, or delete it"
    if fault.kind == "blank":
        return "fill in these numbers or delete the lines"
    if fault.kind == "short":
        return "complete or delete the lines, or check delimiter= and comment="
    return _text_remedy(fault, every, layout)


def _text_remedy(fault: _Fault, every: bool, layout: Layout) -> str:
    if layout.decimal == "." and re.search(r"\d,\d", fault.detail):
        return "if these are decimal commas, pass decimal=','"
    if every:
        named = f" (there are {', '.join(map(repr, layout.names))})" if layout.names else ""
        return f"choose columns of numbers with columns={named}"
    if fault.lines == [layout.first]:
        return (
            f"if line {layout.first} is a header, pass header=True; else correct or delete it"
        )
    return "correct or delete the lines"


def _short(cell: str) -> str:
    return repr(cell if len(cell) <= 30 else cell[:27] + "...")
