"""A finished complex on disk: facts about the whole, and its simplices tile by tile."""

from __future__ import annotations

import os
from collections.abc import Iterator
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from alphamesh._arrays import read_only
from alphamesh.errors import FileReadError, MissingLibraryError, ParameterError
from alphamesh.tiles.merge import Summary, finish, merge
from alphamesh.tiles.store import TABLES, Store

if TYPE_CHECKING:
    from alphamesh._arrays import CountArray, FloatArray

__all__ = ["TiledComplex"]


class TiledComplex:
    """The alpha complex of a whole cloud at one radius, in the files of a folder.

    The tables ``vertices``, ``edges`` and ``triangles`` in the folder are Parquet
    datasets, one file a tile, that pandas, Dask, DuckDB and others read as they are. Rows
    of points are those of the whole cloud.

    Parameters
    ----------
    folder : path-like
        Of :func:`run`.

    Raises
    ------
    FileReadError
        If there is no finished run in the folder.
    """

    def __init__(self, folder: str | os.PathLike[str]) -> None:
        self._store = Store(folder)
        summary, tiling = self._store.summary(), self._store.plan()
        if summary is None or tiling is None:
            raise FileReadError(
                f"{folder} holds no finished tiles; run them first (again, if they were "
                "stopped: they go on where they were)"
            )
        self.folder = self._store.folder
        self.summary: Summary = summary
        self.tiling = tiling

    @property
    def radius(self) -> float:
        """The radius of the complex."""
        return self.summary.radius

    def tables(self, name: str) -> Iterator[Any]:
        """Yield a table tile by tile.

        Parameters
        ----------
        name : {"vertices", "edges", "triangles"}

        Yields
        ------
        pyarrow.Table
        """
        if name not in TABLES:
            raise ParameterError(f"name must be one of {', '.join(TABLES)}; got {name!r}")
        try:
            import pyarrow.parquet as pq
        except ImportError as error:
            raise MissingLibraryError.of("pyarrow", "tiles", "reading tiles") from error
        for tile in range(len(self.tiling)):
            yield pq.read_table(self.folder / name / f"part-{tile:06}.parquet")

    def simplices(self, dimension: int) -> tuple[CountArray, FloatArray]:
        """Return all simplices of one dimension, if they fit in memory.

        Parameters
        ----------
        dimension : {0, 1, 2}

        Returns
        -------
        simplices : (m, dimension + 1) int64
            In the order of their rows.
        radii : (m,) float64
        """
        if dimension not in (0, 1, 2):
            raise ParameterError(f"dimension must be 0, 1 or 2; got {dimension!r}")
        if dimension == 0:
            rows = np.concatenate([_distinct(table) for table in self.tables("vertices")])
            return read_only(np.sort(rows)[:, np.newaxis]), read_only(np.zeros(len(rows)))
        tables = list(self.tables(TABLES[dimension]))
        columns = [
            np.concatenate([table.column(name).to_numpy() for table in tables])
            for name in (*(f"vertex{i}" for i in range(dimension + 1)), "radius")
        ]
        order = np.lexsort(columns[-2::-1])
        simplices = np.stack(columns[:-1], axis=1).take(order, axis=0)
        return read_only(simplices), read_only(columns[-1].take(order))

    @cached_property
    def _merged(self) -> tuple[Any, Any]:
        parts = [self._store.part(tile) for tile in range(len(self.tiling))]
        _, labels, areas = merge([part for part, _ in parts], self.radius)
        return (labels, [boundary for _, boundary in parts]), areas

    @property
    def region_areas(self) -> FloatArray:
        """Area of each region, the largest first, ``(r,)`` float64."""
        areas: FloatArray = self._merged[1]
        return areas

    def polygons(self) -> Any:
        """Return the regions of the whole as valid polygons, the largest first.

        Only the boundary has to fit in memory.

        Returns
        -------
        (r,) array of shapely.Polygon

        Raises
        ------
        MissingLibraryError
            If shapely is not installed.
        """
        labels, boundaries = self._merged[0]
        return finish(boundaries, labels)

    def __repr__(self) -> str:
        facts = self.summary
        return (
            f"<TiledComplex at radius {facts.radius:.6g}: {len(self.tiling):,} tiles, "
            f"{facts.points:,} points, {facts.triangles:,} triangles>"
        )


def _distinct(table: Any) -> CountArray:
    """Return the rows that stand for themselves."""
    rows = table.column("row").to_numpy()
    found: CountArray = rows[rows == table.column("representative").to_numpy()]
    return found
