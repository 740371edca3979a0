"""Results into tables, whole or not at all: CSV for people, Parquet and NPZ for programs."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from alphamesh.io._atomic import atomic_path

__all__ = ["write_table"]

Columns = Mapping[str, NDArray[Any]]

# What would end a cell, or begin a comment.
_AWKWARD = re.compile(r"[,;\t\"\n\r#]")

# Lines made in one go: fast, and Ctrl-C never waits long.
_LINES = 50_000


def write_table(path: Path, columns: Columns, arrays: Columns | None = None) -> None:
    """Write a table to a ``.csv``, ``.tsv``, ``.parquet`` or ``.npz`` file.

    Parameters
    ----------
    path : Path
    columns : mapping of str to (m,) array
        Of all formats but NPZ; numbers are written so that nothing is lost.
    arrays : mapping of str to array, optional
        What an NPZ file holds instead.

    Raises
    ------
    FileWriteError
        If it cannot be written; nothing is left behind.
    MissingLibraryError
        For Parquet, if pyarrow is not installed.
    """
    with atomic_path(path) as temporary, temporary.open("wb") as file:
        suffix = path.suffix.lower()
        if suffix == ".parquet":
            from alphamesh.io._parquet import write_parquet

            write_parquet(columns, file)
            return
        if suffix == ".npz":
            named: dict[str, Any] = dict(columns if arrays is None else arrays)
            np.savez(file, **named)
            return
        delimiter = "\t" if suffix == ".tsv" else ","
        file.write((delimiter.join(columns) + "\n").encode())
        values = list(columns.values())
        for start in range(0, len(values[0]), _LINES):
            rows = zip(
                *(column[start : start + _LINES].tolist() for column in values), strict=True
            )
            lines = (delimiter.join(map(_cell, row)) + "\n" for row in rows)
            file.write("".join(lines).encode())


def _cell(value: object) -> str:
    """Return a number so that it reads back the same, truth as 1 or 0, text as CSV."""
    if isinstance(value, bool):
        return str(int(value))
    if isinstance(value, int | float):
        return repr(value)
    text = "" if value is None else str(value)
    return '"' + text.replace('"', '""') + '"' if _AWKWARD.search(text) else text
