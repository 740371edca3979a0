"""The Delaunay triangulation of a cloud: which points are neighbours."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from alphamesh import _kernels
from alphamesh._arrays import Record, read_only
from alphamesh._kernels.cells import locate2
from alphamesh._kernels.weighted import regular2
from alphamesh._weights import equal_weight, nothing_hidden
from alphamesh.delaunay3d import Delaunay3D, delaunay_in_space
from alphamesh.points import as_cloud, coordinate_error, merged_rows, tiny_queries

if TYPE_CHECKING:
    from alphamesh._arrays import FloatArray, IntArray
    from alphamesh._kernels import Progress
    from alphamesh.points import Cloud

__all__ = ["Delaunay", "delaunay", "delaunay_in_plane", "edges_of", "neighbors_of"]


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
    weights : (n,) float64 or None
        Squared radii of balls: the triangulation is the regular one, dual to the power
        diagram [3]_. None for balls of equal size.
    hidden : (h,) int32
        Rows that are no vertices because heavier points leave them no part of the power
        diagram, ascending.

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
    .. [3] F. Aurenhammer, Power diagrams: properties, algorithms and applications, SIAM
       Journal on Computing 16 (1987) 78-96.
    """

    points: FloatArray
    representative: IntArray
    triangles: IntArray
    neighbors: IntArray
    path: IntArray
    weights: FloatArray | None = None
    hidden: IntArray = field(default_factory=nothing_hidden)

    @cached_property
    def edges(self) -> IntArray:
        """All edges, ``(E, 2)`` int32, ascending within an edge."""
        if len(self.triangles) == 0:
            return self.path
        return edges_of(self.triangles, self.neighbors)

    def find(self, queries: Any, *, threads: int | None = None) -> IntArray:
        """Return the triangle that each query lies in; every decision is exact.

        Parameters
        ----------
        queries : array-like of shape (m, 2)
        threads : int, optional
            Threads to use; by default one for each usable CPU. The result does not depend
            on it.

        Returns
        -------
        (m,) int32
            Rows of `triangles`; -1 outside of all triangles. Triangles are closed: on a
            common edge or vertex, the first of those that meet there is returned.

        Raises
        ------
        CloudShapeError, NonFiniteError
            If `queries` is not a table of finite numbers; the message names the rows.
        CoordinateRangeError
            If coordinates of queries are too small beside the points for exact arithmetic.
        ParameterError
            If `threads` is not what it must be.
        """
        wanted = as_cloud(queries, 2).points
        arrays = self.points, self.triangles, self.neighbors
        try:
            return locate2(*arrays, wanted, threads)
        except _kernels.BadCoordinates:
            if not np.isfinite(wanted).all():
                raise coordinate_error(wanted) from None
        # Queries far outside need no arithmetic to be told so.
        low, high = self.points.min(axis=0), self.points.max(axis=0)
        near = ((wanted >= low) & (wanted <= high)).all(axis=1)
        found = np.full(len(wanted), -1, dtype=np.int32)
        try:
            found[near] = locate2(*arrays, wanted[near], threads)
        except _kernels.BadCoordinates:
            raise tiny_queries(self.points, np.where(near[:, None], wanted, 0.0)) from None
        return read_only(found)

    def __repr__(self) -> str:
        return (
            f"<Delaunay: {len(self.points):,} points, {len(self.triangles):,} triangles"
            f"{', on one line' if len(self.path) else ''}>"
        )


def edges_of(triangles: IntArray, neighbors: IntArray) -> IntArray:
    """Return the edges of triangles that know their neighbors, ``(E, 2)`` int32."""
    # An edge belongs to the later of its two triangles, or to its only one.
    mine = neighbors < np.arange(len(triangles), dtype=np.int32)[:, np.newaxis]
    opposite = triangles[:, [[1, 2], [0, 2], [0, 1]]]
    return read_only(opposite[mine])


def delaunay(
    points: Any,
    *,
    weights: Any = None,
    threads: int | None = None,
    progress: Progress | None = None,
) -> Delaunay | Delaunay3D:
    """Triangulate a cloud; every decision is exact.

    Parameters
    ----------
    points : array-like of shape (n, 2) or (n, 3)
        See :func:`alphamesh.points.as_cloud`. Duplicates are merged.
    weights : array-like of shape (n,), optional
        Squared radii of balls: then the triangulation is the regular one. By default all
        balls are of equal size.
    threads : int, optional
        Threads to use; by default one for each usable CPU. The result does not depend
        on it.
    progress : callable, optional
        Called with the fraction that is done, from 0 to 1, about ten times a second.

    Returns
    -------
    Delaunay or Delaunay3D
        Points with two columns lie in the plane, those with three in space.

    Raises
    ------
    CloudShapeError, NonFiniteError, CoordinateRangeError, CloudTooLargeError
        If there is no exact triangulation of such points; the message names the rows.
    WeightsError
        If there is not one finite weight for each point.
    ParameterError
        If `threads` or `progress` is not what it must be.
    """
    cloud = as_cloud(points, weights=weights)
    if cloud.points.shape[1] == 3:
        return delaunay_in_space(cloud, threads=threads, progress=progress)
    return delaunay_in_plane(cloud, threads=threads, progress=progress)


def delaunay_in_plane(
    points: Any, *, threads: int | None = None, progress: Progress | None = None
) -> Delaunay:
    """Triangulate a cloud in the plane; see :func:`delaunay`."""
    cloud = as_cloud(points, 2)
    if cloud.weights is not None and equal_weight(cloud.weights) is None:
        return _regular(cloud, threads, progress)
    try:
        result = _kernels.delaunay2(cloud.points, threads, progress)
    except _kernels.BadCoordinates:
        raise coordinate_error(cloud.points) from None
    representative, triangles, neighbors, path = result
    if representative is None:
        representative = read_only(np.arange(len(cloud.points), dtype=np.int32))
    return Delaunay(cloud.points, representative, triangles, neighbors, path, cloud.weights)


def _regular(cloud: Cloud, threads: int | None, progress: Progress | None) -> Delaunay:
    """Triangulate a cloud whose weights differ."""
    assert cloud.weights is not None
    try:
        result = regular2(cloud.points, cloud.weights, threads, progress)
    except _kernels.BadCoordinates:
        raise coordinate_error(cloud.points, cloud.weights) from None
    merged, hidden, (_, edges, triangles), _, edge_triangles = result
    return Delaunay(
        cloud.points,
        merged_rows(merged, len(cloud))[0],
        triangles,
        neighbors_of(triangles, edges, edge_triangles),
        edges if len(triangles) == 0 else edges[:0],
        cloud.weights,
        hidden,
    )


def neighbors_of(triangles: IntArray, edges: IntArray, edge_triangles: IntArray) -> IntArray:
    """Return the triangle beyond the edge opposite to each corner, ``(T, 3)`` int32."""
    neighbors = np.full(triangles.size, -1, dtype=np.int32)
    # Hull edges have one triangle, which keeps its -1.
    inner = np.flatnonzero(edge_triangles.min(axis=1, initial=0) >= 0)
    cofaces, ends = (rows.take(inner, axis=0) for rows in (edge_triangles, edges))
    for side in (0, 1):
        corners = triangles.take(cofaces[:, side], axis=0)
        # Corners and ends ascend, so the corner left out is where they first differ.
        opposite = 2 - (corners[:, 1] != ends[:, 1])
        opposite[corners[:, 0] != ends[:, 0]] = 0
        neighbors[3 * cofaces[:, side].astype(np.intp) + opposite] = cofaces[:, 1 - side]
    return read_only(neighbors.reshape(-1, 3))
