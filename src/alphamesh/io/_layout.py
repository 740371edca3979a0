"""What is said and what is found of a table in text: options, layout, cells."""

from __future__ import annotations

import codecs
import csv
from dataclasses import dataclass
from typing import Literal

from alphamesh.errors import ParameterError

__all__ = ["Layout", "TextOptions", "blank_characters", "is_number", "is_value", "split"]

# What people and programs write where a number is missing.
_MISSING = frozenset({"na", "n/a", "#n/a", "null", "none", "missing", "-", "--", "?", "*"})


@dataclass(frozen=True, slots=True)
class TextOptions:
    """What the caller says of a text table; the defaults look at the file."""

    delimiter: str | None = None
    header: bool | Literal["auto"] = "auto"
    skip: int = 0
    comment: str | None = "#"
    decimal: str = "."
    encoding: str | None = None

    def check(self) -> None:
        """Raise ParameterError unless every option has a possible value."""
        if not _one_character_or_none(self.delimiter):
            raise ParameterError(
                f"delimiter must be one character, not {self.delimiter!r}; "
                "leave it out to have it found, or give ' ' for runs of blanks"
            )
        if self.header not in (True, False, "auto"):
            raise ParameterError(f"header must be True, False or 'auto', not {self.header!r}")
        if type(self.skip) is not int or self.skip < 0:
            raise ParameterError(f"skip must be a number of lines, not {self.skip!r}")
        if not _one_character_or_none(self.comment):
            raise ParameterError(f"comment must be one character or None, not {self.comment!r}")
        if self.comment is not None and self.comment == self.delimiter:
            raise ParameterError(f"comment and delimiter are both {self.comment!r}")
        if self.decimal not in (".", ",") or self.decimal == self.delimiter:
            raise ParameterError(
                f"decimal must be '.' or ',' and not the delimiter, not {self.decimal!r}"
            )
        self._check_encoding()

    def _check_encoding(self) -> None:
        try:
            codecs.lookup(self.encoding or "utf-8")
        except (LookupError, TypeError, ValueError):
            raise ParameterError(
                f"encoding {self.encoding!r} is unknown; common ones are 'utf-8', "
                "'latin-1', 'cp1252' and 'utf-16'"
            ) from None


@dataclass(frozen=True, slots=True)
class Layout:
    """Where the numbers stand in a text.

    Attributes
    ----------
    first : int
        The number of the first line with data, from 1.
    columns : tuple of int
        The columns to read, from 0.
    delimiter : str or None
        One character; None for runs of blanks.
    names : tuple of str
        The names of all columns; empty if they have none.
    comment : str or None
        What starts a comment.
    decimal : str
        ``"."`` or ``","``.
    rows : int or None
        Read no more than so many rows.
    """

    first: int
    columns: tuple[int, ...]
    delimiter: str | None = None
    names: tuple[str, ...] = ()
    comment: str | None = None
    decimal: str = "."
    rows: int | None = None

    def column_text(self, column: int) -> str:
        """Return how messages call a column."""
        return repr(self.names[column]) if column < len(self.names) else f"number {column}"


def blank_characters(delimiters: str | None) -> str:
    """Return the characters that a line without any content may hold."""
    return ' \t\r\n\v\f"' + (delimiters or "")


def split(line: str, delimiter: str | None) -> list[str]:
    """Return the cells of one line, without the blanks around them."""
    if delimiter is None:
        if '"' not in line:
            return line.split()
        line = " ".join(line.split())
        return [cell for cell in _parsed(line, " ") if cell]
    return [cell.strip() for cell in _parsed(line.rstrip("\r\n"), delimiter)]


def _parsed(line: str, delimiter: str) -> list[str]:
    if '"' not in line:
        return line.split(delimiter)
    try:
        return next(csv.reader([line], delimiter=delimiter, skipinitialspace=True), [])
    except csv.Error:
        return line.split(delimiter)


def is_number(cell: str, decimal: str = ".") -> bool:
    """Whether a cell reads as a floating-point number, in ASCII and without ``_``."""
    text = cell.replace(",", ".") if decimal == "," else cell
    if "_" in text or not text.isascii():
        return False
    try:
        float(text)
    except ValueError:
        return False
    return True


def is_value(cell: str, decimal: str = ".") -> bool:
    """Whether a cell is a number or a mark that a number is missing."""
    return is_number(cell, decimal) or is_missing(cell)


def is_missing(cell: str) -> bool:
    """Whether a cell is a usual mark that a number is missing; blank cells are not."""
    return cell.strip().casefold() in _MISSING


def _one_character_or_none(text: object) -> bool:
    return text is None or (isinstance(text, str) and len(text) == 1 and text not in '\r\n"')
