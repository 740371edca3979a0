"""Points into files, whole or not at all."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from types import MappingProxyType
from typing import BinaryIO

import numpy as np
from numpy.typing import NDArray

from alphamesh.io._atomic import atomic_path

__all__ = ["POINT_WRITERS", "csv_text", "write_points"]

Points = NDArray[np.float64]

# Lines made in one go: fast, and Ctrl-C never waits long.
_LINES = 50_000


def write_points(points: Points, path: Path) -> None:
    """Write points to `path` in the format that its extension tells.

    Parameters
    ----------
    points : (n, 2) float64 array
    path : Path
        Its extension is a key of `POINT_WRITERS`.

    Raises
    ------
    FileWriteError
        If it cannot be written; nothing is left behind.
    """
    write = POINT_WRITERS[path.suffix.lower()]
    with atomic_path(path) as temporary, temporary.open("wb") as file:
        write(points, file)


def csv_text(points: Points, delimiter: str = ",") -> Iterator[str]:
    """Return the lines of a table without header, every number exact."""
    for start in range(0, len(points), _LINES):
        rows = points[start : start + _LINES].tolist()
        yield "".join(f"{x!r}{delimiter}{y!r}\n" for x, y in rows)


def _table(delimiter: str, header: str) -> Callable[[Points, BinaryIO], None]:
    def write(points: Points, file: BinaryIO) -> None:
        file.write(header.encode())
        for lines in csv_text(points, delimiter):
            file.write(lines.encode())

    return write


def _npy(points: Points, file: BinaryIO) -> None:
    np.save(file, points, allow_pickle=False)


def _npz(points: Points, file: BinaryIO) -> None:
    np.savez(file, points=points)


POINT_WRITERS: Mapping[str, Callable[[Points, BinaryIO], None]] = MappingProxyType(
    {
        ".csv": _table(",", "x,y\n"),
        ".tsv": _table("\t", "x\ty\n"),
        ".txt": _table(" ", ""),
        ".npy": _npy,
        ".npz": _npz,
    }
)
"""How to write each format, by file extension."""
