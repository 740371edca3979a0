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
    points : (n, 2) or (n, 3) float64 array
    path : Path
        Its extension is a key of `POINT_WRITERS`.

    Raises
    ------
    FileWriteError
        If it cannot be written; nothing is left behind.
    MissingLibraryError
        For Parquet, if pyarrow is not installed.
    """
    write = POINT_WRITERS[path.suffix.lower()]
    with atomic_path(path) as temporary, temporary.open("wb") as file:
        write(points, file)


def csv_text(points: Points, delimiter: str = ",") -> Iterator[str]:
    """Return the lines of a table without header, every number exact."""
    for start in range(0, len(points), _LINES):
        rows = points[start : start + _LINES].tolist()
        yield "".join(delimiter.join(map(repr, row)) + "\n" for row in rows)


def _table(delimiter: str, *, header: bool = True) -> Callable[[Points, BinaryIO], None]:
    def write(points: Points, file: BinaryIO) -> None:
        if header:
            file.write(f"{delimiter.join('xyz'[: points.shape[1]])}\n".encode())
        for lines in csv_text(points, delimiter):
            file.write(lines.encode())

    return write


def _npy(points: Points, file: BinaryIO) -> None:
    np.save(file, points, allow_pickle=False)


def _npz(points: Points, file: BinaryIO) -> None:
    np.savez(file, points=points)


def _parquet(points: Points, file: BinaryIO) -> None:
    from alphamesh.io._parquet import write_parquet

    write_parquet(dict(zip("xyz", points.T, strict=False)), file)


def _ply(points: Points, file: BinaryIO) -> None:
    """Write vertices alone, binary; flat ones get z = 0, as most readers need it."""
    in_space = np.zeros((len(points), 3), dtype="<f8")
    in_space[:, : points.shape[1]] = points
    properties = "".join(f"property double {axis}\n" for axis in "xyz")
    file.write(
        "ply\nformat binary_little_endian 1.0\n"
        f"element vertex {len(points)}\n{properties}end_header\n".encode()
    )
    file.write(in_space.tobytes())


def _pcd(points: Points, file: BinaryIO) -> None:
    """Write float64 coordinates, binary; flat points get z = 0, as in PLY files."""
    in_space = np.zeros((len(points), 3))
    in_space[:, : points.shape[1]] = points
    file.write(
        "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\n"
        "FIELDS x y z\nSIZE 8 8 8\nTYPE F F F\nCOUNT 1 1 1\n"
        f"WIDTH {len(points)}\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\n"
        f"POINTS {len(points)}\nDATA binary\n".encode()
    )
    file.write(in_space.astype("<f8").tobytes())


POINT_WRITERS: Mapping[str, Callable[[Points, BinaryIO], None]] = MappingProxyType(
    {
        ".csv": _table(","),
        ".tsv": _table("\t"),
        ".txt": _table(" ", header=False),
        ".xyz": _table(" ", header=False),
        ".npy": _npy,
        ".npz": _npz,
        ".parquet": _parquet,
        ".ply": _ply,
        ".pcd": _pcd,
    }
)
"""How to write each format, by file extension."""
