"""A finished complex on disk: facts about the whole, and its simplices tile by tile."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from alphamesh._arrays import read_only
from alphamesh.errors import (
    DimensionError,
    FileReadError,
    MissingLibraryError,
    ParameterError,
    PeriodicError,
)
from alphamesh.tiles.merge import Summary, finish, merge
from alphamesh.tiles.store import TABLES, Store

if TYPE_CHECKING:
    from alphamesh._arrays import CountArray, FloatArray, IntArray, KindArray

__all__ = ["TiledComplex"]


class TiledComplex:
    """The alpha complex of a whole cloud at one radius, in the files of a folder.

    The tables ``vertices``, ``edges``, ``triangles`` (and ``tetrahedra``) in the folder are
    Parquet datasets, one file a tile, that pandas, Dask, DuckDB and others read as they
    are. Rows of points are those of the whole cloud.

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

    @property
    def periods(self) -> tuple[float | None, ...] | None:
        """The sides of the periodic box, None for open directions; None if there is none."""
        return self._store.periods

    def tables(self, name: str) -> Iterator[Any]:
        """Yield a table tile by tile.

        Parameters
        ----------
        name : {"vertices", "edges", "triangles", "tetrahedra"}
            The last in space only.

        Yields
        ------
        pyarrow.Table
        """
        known = TABLES[: self.tiling.dimension + 1]
        if name not in known:
            raise ParameterError(f"name must be one of {', '.join(known)}; got {name!r}")
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
        dimension : int
            From 0 for vertices to 2 for triangles in the plane, 3 for tetrahedra in space.

        Returns
        -------
        simplices : (m, dimension + 1) int64
            In the order of their rows.
        radii : (m,) float64
            With weights, signed roots of power values, those of vertices among them.
        """
        if dimension not in range(self.tiling.dimension + 1):
            raise ParameterError(
                f"dimension must be from 0 to {self.tiling.dimension}; got {dimension!r}"
            )
        if dimension == 0:
            found = [_vertices_of(table) for table in self.tables("vertices")]
            rows, radii = (np.concatenate(part) for part in zip(*found, strict=True))
            order = np.argsort(rows)
            return read_only(rows.take(order)[:, np.newaxis]), read_only(radii.take(order))
        columns = self._sorted(dimension, ("radius",))
        return read_only(np.stack(columns[:-1], axis=1)), read_only(columns[-1])

    def offsets(self, dimension: int) -> KindArray:
        """Return where the vertices of :meth:`simplices` lie in a periodic box.

        Parameters
        ----------
        dimension : int

        Returns
        -------
        (m, dimension + 1, d) int8
            How many periods each vertex lies from its place in the box, where the table of
            vertices has it; the first of each simplex lies there.

        Raises
        ------
        PeriodicError
            If there is no periodic box.
        """
        if self.periods is None:
            raise PeriodicError("offsets are of periodic boxes: tiles.dataset(..., periods=)")
        d, count = self.tiling.dimension, self.summary.counts[dimension]
        made = np.zeros((count, dimension + 1, d), dtype=np.int8)
        if dimension > 0:
            names = [f"offset{i}{axis}" for i in range(1, dimension + 1) for axis in "xyz"[:d]]
            moves = np.stack(self._sorted(dimension, names)[dimension + 1 :], axis=1)
            made[:, 1:] = moves.reshape(count, dimension, d)
        return read_only(made)

    def _sorted(self, dimension: int, names: Sequence[str]) -> list[Any]:
        """Return the vertices of all simplices, and other columns, in the order of rows."""
        tables = list(self.tables(TABLES[dimension]))
        wanted = (*(f"vertex{i}" for i in range(dimension + 1)), *names)
        columns = [
            np.concatenate([table.column(name).to_numpy() for table in tables])
            for name in wanted
        ]
        order = np.lexsort(columns[dimension::-1])
        return [column.take(order) for column in columns]

    @cached_property
    def _merged(self) -> tuple[Any, Any]:
        parts = [self._store.part(tile) for tile in range(len(self.tiling))]
        _, labels, sizes = merge(
            [part for part, _ in parts], self.radius, periodic=self.periods is not None
        )
        return (labels, [boundary for _, boundary in parts]), sizes

    @property
    def region_sizes(self) -> FloatArray:
        """Area or volume of each region, the largest first, ``(r,)`` float64."""
        sizes: FloatArray = self._merged[1]
        return sizes

    def boundary(self) -> tuple[FloatArray, IntArray, CountArray]:
        """Return the boundary of the cells of the whole, turned outwards.

        Only the boundary has to fit in memory.

        Returns
        -------
        points : (n, d) float64
            The vertices of the boundary.
        facets : (b, d) int32
            Edges with the shape on their left, or triangles that run counter-clockwise as
            seen from outside, as rows of `points`.
        rows : (n,) int64
            The row in the whole cloud of each vertex.

        Raises
        ------
        PeriodicError
            In a periodic box, where surfaces need not be closed.
        """
        self._need_open_space("boundary()")
        _, boundaries = self._merged[0]
        facets = np.concatenate([boundary.facets for boundary in boundaries])
        places = np.concatenate([b.points[:, :-1] for b in boundaries])
        rows, first, corners = np.unique(facets.ravel(), return_index=True, return_inverse=True)
        points = places.reshape(-1, self.tiling.dimension).take(first, axis=0)
        numbered = corners.reshape(facets.shape).astype(np.int32)
        return read_only(points), read_only(numbered), read_only(rows)

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
        DimensionError
            In space, which has no polygons: see :meth:`boundary`.
        PeriodicError
            In a periodic box, where rings need not be closed.
        """
        self._need_open_space("polygons()")
        if self.tiling.dimension == 3:
            raise DimensionError(
                "polygons are of the plane; boundary() gives the surface of a complex in space"
            )
        labels, boundaries = self._merged[0]
        return finish(boundaries, labels)

    def _need_open_space(self, what: str) -> None:
        if self.periods is not None:
            raise PeriodicError(
                f"{what} is there for open clouds alone, as what runs around a box does not "
                "close; the table of facets has those of kind 2, with offsets()"
            )

    def __repr__(self) -> str:
        facts = self.summary
        return (
            f"<TiledComplex at radius {facts.radius:.6g}: {len(self.tiling):,} tiles, "
            f"{facts.points:,} points, {facts.counts[-1]:,} {TABLES[self.tiling.dimension]}>"
        )


def _vertices_of(table: Any) -> tuple[CountArray, FloatArray]:
    """Return the rows of a table that are vertices, and since when."""
    rows = table.column("row").to_numpy()
    if "radius" not in table.column_names:
        kept = rows.compress(rows == table.column("representative").to_numpy())
        return kept, np.zeros(len(kept))
    radii = table.column("radius").to_numpy()
    there = ~np.isnan(radii)
    return rows.compress(there), radii.compress(there)
