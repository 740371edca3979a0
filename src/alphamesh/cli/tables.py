"""Results into tables, whole or not at all: CSV for people, NPZ for programs."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from alphamesh.cli.types import TableFile
from alphamesh.io._atomic import atomic_path

__all__ = ["TableFile", "write_table"]

Columns = Mapping[str, NDArray[Any]]

# Lines made in one go: fast, and Ctrl-C never waits long.
_LINES = 50_000


def write_table(path: Path, columns: Columns, arrays: Columns | None = None) -> None:
    """Write a table to a ``.csv``, ``.tsv`` or ``.npz`` file.

    Parameters
    ----------
    path : Path
    columns : mapping of str to (m,) array
        The columns of the text formats; numbers are written so that nothing is lost.
    arrays : mapping of str to array, optional
        What an NPZ file holds instead.

    Raises
    ------
    FileWriteError
        If it cannot be written; nothing is left behind.
    """
    with atomic_path(path) as temporary, temporary.open("wb") as file:
        suffix = path.suffix.lower()
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
            lines = (delimiter.join(map(repr, row)) + "\n" for row in rows)
            file.write("".join(lines).encode())
