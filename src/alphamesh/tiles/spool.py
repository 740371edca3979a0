"""Points on their way from chunks to tiles: a file for each chunk, sorted by tile."""

from __future__ import annotations

from io import BufferedReader
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from alphamesh._kernels.tiles import checksum
from alphamesh.errors import FileReadError
from alphamesh.io._atomic import atomic_path

if TYPE_CHECKING:
    from alphamesh._arrays import CountArray, FloatArray, IntArray

__all__ = ["Spool"]

# Bytes of a point's row.
_ROW = 4


class Spool:
    """Files of points, each sorted by tile.

    A file begins with the number of tiles, and for each tile where its points begin and a
    checksum; then come the points of a tile and their rows in the chunk, tile by tile. It
    is not forced to the disk, so that the checksums must tell whether all of it is there.

    Parameters
    ----------
    folder : Path
    dimension : int
    """

    def __init__(self, folder: Path, dimension: int) -> None:
        self.folder = folder
        self.dimension = dimension
        self._point = 8 * dimension

    def path(self, chunk: int) -> Path:
        """Return the file of a chunk."""
        return self.folder / f"{chunk:06}.points"

    def write(
        self, chunk: int, offsets: CountArray, rows: IntArray, points: FloatArray
    ) -> None:
        """Keep the points of a chunk.

        Parameters
        ----------
        chunk : int
        offsets : (t + 1,) int64
        rows : (k,) int32
            In the chunk, tile by tile.
        points : (k, d) float64
        """
        parts = [
            (points[a:b].data.cast("B"), rows[a:b].data.cast("B"))
            for a, b in zip(offsets[:-1].tolist(), offsets[1:].tolist(), strict=True)
            if a < b
        ]
        sums = np.zeros(len(offsets) - 1, dtype=np.uint64)
        sums[np.flatnonzero(np.diff(offsets))] = [_sum_of(*part) for part in parts]
        with atomic_path(self.path(chunk), forced=False) as path, path.open("wb") as file:
            file.write(np.array([len(offsets) - 1]).tobytes())
            file.write(offsets.tobytes() + sums.tobytes())
            for part in parts:
                file.writelines(part)

    def holds(self, chunk: int) -> bool:
        """Tell whether the points of a chunk are there, by their checksums."""
        try:
            with self.path(chunk).open("rb") as file:
                tiles = int.from_bytes(file.read(8), "little")
                offsets, sums = self._table(file, tiles)
                return all(
                    self._read(file, tiles, part, int(total)) is not None
                    for part, total in zip(pairwise(offsets.tolist()), sums, strict=True)
                )
        except (OSError, ValueError):
            return False

    def points_of(
        self, tile: int, tiles: int, first_rows: CountArray, dtype: Any
    ) -> tuple[CountArray, FloatArray]:
        """Return the points of a tile and its halo, ascending by row.

        Parameters
        ----------
        tile, tiles : int
        first_rows : (c,) int64
            The first row of each chunk.
        dtype : dtype
            Of rows.

        Returns
        -------
        rows : (n,) of dtype
        points : (n, d) float64

        Raises
        ------
        FileReadError
            If a file is damaged.
        """
        rows, points = [np.empty(0, dtype=dtype)], [np.empty((0, self.dimension))]
        for chunk, first_row in enumerate(first_rows.tolist()):
            with self.path(chunk).open("rb") as file:
                offsets, sums = self._table(file, tiles, tile, 1)
                found = self._read(file, tiles, (offsets[0], offsets[1]), int(sums[0]))
            if found is None:
                raise FileReadError(f"{self.path(chunk)} is damaged; run the tiles again")
            rows.append(np.add(found[0], first_row, dtype=dtype))
            points.append(found[1])
        return np.concatenate(rows), np.concatenate(points)

    def drop(self) -> None:
        """Delete all files."""
        for file in self.folder.glob("*.points"):
            file.unlink()

    def _table(
        self, file: BufferedReader, tiles: int, first: int = 0, count: int | None = None
    ) -> tuple[CountArray, Any]:
        """Read where some tiles begin and end, and their checksums."""
        count = tiles if count is None else count
        file.seek(8 * (1 + first))
        offsets = np.frombuffer(file.read(8 * (count + 1)), dtype=np.int64)
        file.seek(8 * (2 + tiles + first))
        sums = np.frombuffer(file.read(8 * count), dtype=np.uint64)
        if len(offsets) != count + 1 or len(sums) != count:
            raise ValueError("the file is too short")
        return offsets, sums

    def _read(
        self, file: BufferedReader, tiles: int, part: tuple[int, int], total: int
    ) -> tuple[IntArray, FloatArray] | None:
        """Read rows and points of one tile; None if they are not what was written."""
        start, end = part
        count = end - start
        if count == 0:
            return np.empty(0, dtype=np.int32), np.empty((0, self.dimension))
        file.seek(8 * (2 + 2 * tiles) + (self._point + _ROW) * start)
        points, rows = np.empty((count, self.dimension)), np.empty(count, dtype=np.int32)
        views = points.data.cast("B"), rows.data.cast("B")
        whole = all(file.readinto(view) == len(view) for view in views)
        return (rows, points) if whole and _sum_of(*views) == total else None


def _sum_of(points: memoryview, rows: memoryview) -> int:
    return checksum(rows, checksum(points))
