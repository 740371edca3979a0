"""The Delaunay triangulation of a cloud: which points are neighbours."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from alphamesh import _kernels
from alphamesh._arrays import Record, read_only
from alphamesh.points import as_cloud, coordinate_error

if TYPE_CHECKING:
    from alphamesh._arrays import FloatArray, IntArray
    from alphamesh._kernels import Progress

__all__ = ["Delaunay", "delaunay"]


@dataclass(frozen=True, eq=False, repr=False)
class Delaunay(Record):
    """A Delaunay triangulation: triangles whose circumcircles hold no point inside.

    Attributes
    ----------
    points : (n, 2) float64
    representative : (n,) int32
        The lowest row with the coordinates of row i: i itself unless it is a duplicate.
    triangles : (T, 3) int32
        Rows of `points`, ascending within a triangle. Empty for a cloud on one line.
    neighbors : (T, 3) int32
        ``neighbors[t, j]`` is the triangle on the other side of the edge that lies
        opposite to ``triangles[t, j]``; -1 on the convex hull.
    path : (E, 2) int32
        Of a cloud on one line, the edges from each point to the next; else empty.

    All arrays are read-only.

    Notes
    -----
    Where four or more points lie on one circle, several triangulations are Delaunay. The
    one that a symbolic perturbation picks [2]_ depends on the coordinates alone: neither
    on the order of the points nor on the number of threads.

    References
    ----------
    .. [1] B. Delaunay, Sur la sphère vide, Bulletin de l'Académie des Sciences de
       l'URSS, Classe des sciences mathématiques et naturelles 6 (1934) 793-800.
    .. [2] O. Devillers and M. Teillaud, Perturbations for Delaunay and weighted Delaunay
       3D triangulations, Computational Geometry 44 (2011) 160-168.
    """

    points: FloatArray
    representative: IntArray
    triangles: IntArray
    neighbors: IntArray
    path: IntArray

    @cached_property
    def edges(self) -> IntArray:
        """All edges, ``(E, 2)`` int32, ascending within an edge."""
        if len(self.triangles) == 0:
            return self.path
        # An edge belongs to the later of its two triangles, or to its only one.
        mine = self.neighbors < np.arange(len(self.triangles), dtype=np.int32)[:, np.newaxis]
        opposite = self.triangles[:, [[1, 2], [0, 2], [0, 1]]]
        return read_only(opposite[mine])

    def __repr__(self) -> str:
        return (
            f"<Delaunay: {len(self.points):,} points, {len(self.triangles):,} triangles"
            f"{', on one line' if len(self.path) else ''}>"
        )


def delaunay(
    points: Any, *, threads: int | None = None, progress: Progress | None = None
) -> Delaunay:
    """Triangulate a cloud; every decision is exact.

    Parameters
    ----------
    points : array-like of shape (n, 2)
        See :func:`alphamesh.points.as_cloud`. Duplicates are merged.
    threads : int, optional
        Threads to use; by default one for each usable CPU. The result does not depend
        on it.
    progress : callable, optional
        Called with the fraction that is done, from 0 to 1, about ten times a second.

    Returns
    -------
    Delaunay

    Raises
    ------
    CloudShapeError, NonFiniteError, CoordinateRangeError, CloudTooLargeError
        If there is no exact triangulation of such points; the message names the rows.
    ParameterError
        If `threads` or `progress` is not what it must be.
    """
    cloud = as_cloud(points)
    try:
        result = _kernels.delaunay2(cloud.points, threads, progress)
    except _kernels.BadCoordinates:
        raise coordinate_error(cloud.points) from None
    representative, triangles, neighbors, path = result
    if representative is None:
        representative = read_only(np.arange(len(cloud.points), dtype=np.int32))
    return Delaunay(cloud.points, representative, triangles, neighbors, path)
