"""Tables as text, read by NumPy; what it stumbles over is found again line by line."""

from __future__ import annotations

import codecs
import io
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from itertools import chain, islice
from typing import TYPE_CHECKING, Any, TextIO

import numpy as np

from alphamesh.errors import FileReadError
from alphamesh.io._columns import Wanted
from alphamesh.io._diagnosis import explain
from alphamesh.io._layout import Layout, TextOptions, blank_characters
from alphamesh.io._sniff import find_layout
from alphamesh.io._sources import Source

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from alphamesh._arrays import FloatArray

__all__ = ["layout_of", "read_cells", "read_rows", "read_text"]

_BYTE_ORDER_MARKS = (
    (codecs.BOM_UTF8, "utf-8-sig"),
    (codecs.BOM_UTF32_LE, "utf-32"),
    (codecs.BOM_UTF32_BE, "utf-32"),
    (codecs.BOM_UTF16_LE, "utf-16"),
    (codecs.BOM_UTF16_BE, "utf-16"),
)
_SIGNATURES = (
    (b"\x93NUMPY", "an NPY file"),
    (b"PK\x03\x04", "a zip archive, such as NPZ or a spreadsheet"),
    (b"PAR1", "a Parquet file"),
    (b"ply\n", "a PLY file"),
    (b"ply\r\n", "a PLY file"),
    (b"\x1f\x8b", "compressed by gzip, which its name should tell by .gz"),
)


def read_text(
    source: Source,
    wanted: Wanted,
    options: TextOptions,
    usual_delimiter: str | None,
) -> FloatArray:
    """Read the columns of a delimited or blank-separated text.

    Parameters
    ----------
    source : Source
    wanted : Wanted
        As from :func:`wanted_columns`.
    options : TextOptions
    usual_delimiter : str or None
        The delimiter that the name of the file stands for, if it does.

    Returns
    -------
    (n, dimension) float64 array

    Raises
    ------
    FileReadError
        If it is not such a text, or a number is missing or is not one.
    """
    return read_rows(source, *layout_of(source, wanted, options, usual_delimiter))


def layout_of(
    source: Source, wanted: Wanted, options: TextOptions, usual_delimiter: str | None
) -> tuple[str, Layout]:
    """Return the encoding and the layout of a text; see :func:`read_text`."""
    encoding = _encoding(source, options.encoding)
    with _open_text(source, encoding) as text:
        return encoding, find_layout(source, text, wanted, options, usual_delimiter)


def read_cells(source: Source, encoding: str, layout: Layout) -> NDArray[Any]:
    """Return the cells that `layout` points to as text, ``(n, columns)``."""
    with _open_text(source, encoding) as text:
        rows = _Rows(islice(text, layout.first - 1, None), layout)
        try:
            return rows.read(np.dtype(np.object_))
        except UnicodeError:
            raise
        except ValueError as error:
            raise source.failure(
                f"has rows with fewer cells than its header has names ({error}); complete them"
            ) from error


def read_rows(source: Source, encoding: str, layout: Layout) -> FloatArray:
    """Read the numbers that `layout` points to; errors name the lines at fault."""
    table: FloatArray | None = None
    reason = ""
    with _open_text(source, encoding) as text:
        rows = _Rows(islice(text, layout.first - 1, None), layout)
        try:
            table = rows.read()
        except UnicodeError:
            raise
        except ValueError as error:
            reason = str(error)
    if table is not None and not rows.odd_quotes:
        return table
    # NumPy stops at the line at fault, unless an open quotation mark came before it.
    for start in (layout.first,) if rows.odd_quotes else (rows.line, layout.first):
        with _open_text(source, encoding) as text:
            fault = explain(islice(text, start - 1, None), layout, start)
        if fault:
            raise source.failure(fault)
    if table is None:
        raise source.failure(f"cannot be read as a table: {reason}")
    return table


class _Rows:
    """The lines of a table that hold something, with points for decimal commas.

    Lines of delimiters alone, as spreadsheets write them, count as blank.
    """

    def __init__(self, lines: Iterable[str], layout: Layout) -> None:
        self.odd_quotes = False
        self.line = layout.first - 1
        self._lines = lines
        self._layout = layout

    def read(self, dtype: Any = np.float64) -> NDArray[Any]:
        layout = self._layout
        kept = self._kept()
        first = next(kept, None)
        if first is None:  # NumPy warns of tables without rows
            return np.empty((0, len(layout.columns)), dtype=dtype)
        return np.loadtxt(
            chain([first], kept),
            dtype=dtype,
            delimiter=layout.delimiter,
            comments=layout.comment,
            usecols=layout.columns,
            quotechar='"',
            ndmin=2,
            max_rows=layout.rows,
        )

    def _kept(self) -> Iterator[str]:
        blank = blank_characters(self._layout.delimiter)
        comma = self._layout.decimal == ","
        for line in self._lines:
            self.line += 1
            if '"' in line and line.count('"') % 2:
                self.odd_quotes = True
            if line.strip(blank):
                yield line.replace(",", ".") if comma else line


def _encoding(source: Source, encoding: str | None) -> str:
    """Return the encoding that the first bytes stand for, else the one given or UTF-8."""
    with source.open() as raw:
        top = raw.read(8)
    for signature, what in _SIGNATURES:
        if top.startswith(signature):
            raise source.failure(
                f"is not a table in text but {what}; rename it, or pass file_format="
            )
    if encoding is not None:
        return encoding
    return next((name for mark, name in _BYTE_ORDER_MARKS if top.startswith(mark)), "utf-8")


@contextmanager
def _open_text(source: Source, encoding: str) -> Iterator[TextIO]:
    try:
        with source.open() as raw, io.TextIOWrapper(raw, encoding) as text:
            yield text
    except UnicodeError as error:
        raise _encoding_failure(source, encoding, error) from error


def _encoding_failure(source: Source, encoding: str, error: UnicodeError) -> FileReadError:
    where = ""
    if encoding.startswith("utf-8"):
        with source.open() as raw:
            for number, line in enumerate(raw, 1):
                if not _decodes(line):
                    where = f" in line {number}"
                    break
    return source.failure(
        f"is not text in the encoding {encoding}{where} ({error}); name its encoding, such "
        "as encoding='latin-1' for files from older programs"
    )


def _decodes(line: bytes) -> bool:
    try:
        line.decode()
    except UnicodeDecodeError:
        return False
    return True
