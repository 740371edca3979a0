"""Points on their way from chunks to tiles: a file for each chunk, sorted by tile."""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from alphamesh._kernels.tiles import checksum, recycled
from alphamesh.errors import FileReadError
from alphamesh.io._atomic import atomic_path
from alphamesh.tiles.direct import DirectReader, lent_block, write_direct

if TYPE_CHECKING:
    from alphamesh._arrays import CountArray, FloatArray, IntArray

__all__ = ["Spool"]

# Bytes of a point's row.
_ROW = 4


class Spool:
    """Files of points, each sorted by tile.

    A file begins with a table, after a checksum of it: for each tile where its points begin,
    then for each a checksum of them. The points of a tile and their rows in the chunk come
    next, tile by tile. Files are not forced to the disk, so that checksums must tell
    whether all of it is there.

    Parameters
    ----------
    folder : Path
    dimension, tiles : int
    """

    def __init__(self, folder: Path, dimension: int, tiles: int) -> None:
        self.folder = folder
        self.dimension = dimension
        self.tiles = tiles
        self._point = 8 * dimension + _ROW
        self._header = 8 * (2 + 2 * tiles)

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
        with (
            atomic_path(self.path(chunk), forced=False) as path,
            write_direct(path, summed=False) as file,
        ):
            table = offsets.tobytes() + sums.tobytes()
            file.write(checksum(table).to_bytes(8, "little") + table)
            for part in parts:
                for content in part:
                    file.write(content)

    def holds(self, chunk: int) -> bool:
        """Tell whether the points of a chunk are there, by their checksums."""
        try:
            with lent_block() as block, DirectReader(self.path(chunk), block) as file:
                head = file.peek(0, self._header)
                if checksum(head[8:]) != int.from_bytes(head[:8], "little"):
                    return False
                offsets, sums = self._table(file, 0, self.tiles)
                parts = zip(pairwise(offsets.tolist()), sums.tolist(), strict=True)
                return all(
                    self._read(file, a, np.empty((b - a, self.dimension)), total) is not None
                    for (a, b), total in parts
                    if a != b
                )
        except (OSError, FileReadError):
            return False

    def points_of(
        self, tile: int, first_rows: CountArray, dtype: Any
    ) -> tuple[CountArray, FloatArray]:
        """Return the points of a tile and its halo, ascending by row.

        Parameters
        ----------
        tile : int
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
        with lent_block() as block:
            parts = []
            for chunk in range(len(first_rows)):
                with DirectReader(self.path(chunk), block) as file:
                    (start, end), (total,) = (x.tolist() for x in self._table(file, tile, 1))
                parts.append((start, end, total))
            count = sum(end - start for start, end, _ in parts)
            points = recycled((count, self.dimension), np.float64)
            rows = recycled((count,), dtype)
            done = 0
            for chunk, (start, end, total) in enumerate(parts):
                if start == end:
                    continue
                part = slice(done, done + end - start)
                with DirectReader(self.path(chunk), block) as file:
                    found = self._read(file, start, points[part], total)
                if found is None:
                    raise FileReadError(f"{self.path(chunk)} is damaged; run the tiles again")
                np.add(found, rows.dtype.type(first_rows[chunk]), out=rows[part])
                done = part.stop
        return rows, points

    def drop(self) -> None:
        """Delete all files."""
        for file in self.folder.glob("*.points"):
            file.unlink()

    def _table(self, file: DirectReader, first: int, count: int) -> tuple[CountArray, Any]:
        """Read where some tiles begin and end, and their checksums.

        Raises
        ------
        FileReadError
            If no file of this length can begin so.
        """
        if file.size >= self._header:
            places = file.peek(8 * (1 + first), 8 * (count + 1))
            offsets = np.frombuffer(places, dtype=np.int64)
            sums = np.frombuffer(file.peek(8 * (2 + self.tiles + first), 8 * count), np.uint64)
            most = (file.size - self._header) // self._point
            if offsets[0] >= 0 and (np.diff(offsets) >= 0).all() and offsets[-1] <= most:
                return offsets, sums
        raise FileReadError(f"{file.name} is damaged; run the tiles again")

    def _read(
        self, file: DirectReader, start: int, points: FloatArray, total: int
    ) -> IntArray | None:
        """Read points of one tile and return their rows; None if they are not as written."""
        rows = np.empty(len(points), dtype=np.int32)
        views = points.data.cast("B"), rows.data.cast("B")
        whole = file.fill(self._header + self._point * start, *views)
        return rows if whole and _sum_of(*views) == total else None


def _sum_of(points: memoryview, rows: memoryview) -> int:
    return checksum(rows, checksum(points))
