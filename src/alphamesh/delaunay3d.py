"""The Delaunay triangulation of a cloud in space."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from alphamesh._arrays import Record, read_only
from alphamesh._kernels import BadCoordinates
from alphamesh._kernels.space import alpha3, delaunay3, orient3, tetrahedron_triangles3
from alphamesh._kernels.weighted import regular3
from alphamesh._weights import equal_weight, nothing_hidden
from alphamesh.hull3d import ConvexHull3D
from alphamesh.location3d import as_queries_in_space, labels_at
from alphamesh.measures import scaled_points
from alphamesh.points import as_cloud, coordinate_error, merged_rows

if TYPE_CHECKING:
    from alphamesh._arrays import FloatArray, IntArray
    from alphamesh._kernels import Progress
    from alphamesh.points import Cloud

__all__ = [
    "Delaunay3D",
    "delaunay_in_space",
    "neighbors_in_space",
    "oriented_tetrahedra",
    "outward_triangles",
]

# Tetrahedra worked on at a time: their coordinates stay in the processor's cache.
_CHUNK = 1 << 14
# The corners of the triangle opposite to each corner of a tetrahedron.
_OPPOSITE = [[1, 2, 3], [0, 2, 3], [0, 1, 3], [0, 1, 2]]


@dataclass(frozen=True, eq=False, repr=False)
class Delaunay3D(Record):
    """A Delaunay triangulation in space: the circumspheres hold no point inside.

    Attributes
    ----------
    points : (n, 3) float64
    representative : (n,) int32
        The lowest row with the coordinates of row i: i itself unless it is a duplicate.
    tetrahedra : (T, 4) int32
        Rows of `points`, ascending within a tetrahedron. Empty for a cloud in one plane.
    neighbors : (T, 4) int32
        ``neighbors[t, j]`` is the tetrahedron on the other side of the triangle that lies
        opposite to ``tetrahedra[t, j]``; -1 on the convex hull.
    faces : tuple of (F, 3) int32 and (E, 2) int32, or None
        `triangles` and `edges`, if these are known already; else they are found when they
        are asked for.
    weights : (n,) float64 or None
    hidden : (h,) int32
        See :class:`~alphamesh.Delaunay`.

    All arrays are read-only.

    Notes
    -----
    Where five or more points lie on one sphere, several triangulations are Delaunay. The
    one that a symbolic perturbation picks [1]_ depends on the coordinates alone: neither
    on the order of the points nor on the number of threads.

    References
    ----------
    .. [1] O. Devillers and M. Teillaud, Perturbations for Delaunay and weighted Delaunay
       3D triangulations, Computational Geometry 44 (2011) 160-168.
    """

    points: FloatArray
    representative: IntArray
    tetrahedra: IntArray
    neighbors: IntArray
    faces: tuple[IntArray, IntArray] | None = None
    weights: FloatArray | None = None
    hidden: IntArray = field(default_factory=nothing_hidden)

    @property
    def triangles(self) -> IntArray:
        """All triangles, ``(F, 3)`` int32, ascending within a triangle."""
        return self._known_faces[0]

    @property
    def edges(self) -> IntArray:
        """All edges, ``(E, 2)`` int32, ascending within an edge."""
        return self._known_faces[1]

    @cached_property
    def _known_faces(self) -> tuple[IntArray, IntArray]:
        if self.faces is not None:
            return self.faces
        # Faster than to sort those of the tetrahedra, and in the order of a complex.
        _, (edges, triangles, _), _, _ = alpha3(self.points)
        return triangles, edges

    @cached_property
    def _incidence(self) -> tuple[IntArray, IntArray]:
        """The tetrahedra of each triangle, and the triangles of each tetrahedron."""
        rows = np.arange(len(self.tetrahedra), dtype=np.int32)
        # A triangle is that of the later of its two tetrahedra, or of its only one.
        mine = self.neighbors < rows[:, np.newaxis]
        cofaces = np.column_stack((np.repeat(rows, mine.sum(axis=1)), self.neighbors[mine]))
        triangles = self.tetrahedra[:, _OPPOSITE][mine]
        return cofaces, tetrahedron_triangles3(self.tetrahedra, triangles, cofaces)

    def find(self, queries: Any, *, threads: int | None = None) -> IntArray:
        """Return the tetrahedron that each query lies in; every decision is exact.

        Parameters
        ----------
        queries : array-like of shape (m, 3)
        threads : int, optional
            Threads to use; by default one for each usable CPU. The result does not depend
            on it.

        Returns
        -------
        (m,) int32
            Rows of `tetrahedra`; -1 outside of all of them. Tetrahedra are closed: on a
            common face, the first of those that meet there is returned.

        Raises
        ------
        CloudShapeError, NonFiniteError
            If `queries` is not a table of finite numbers; the message names the rows.
        CoordinateRangeError
            If coordinates of queries are too small beside the points for exact arithmetic.
        ParameterError
            If `threads` is not what it must be.
        """
        wanted = as_queries_in_space(queries)
        labels = np.arange(len(self.tetrahedra), dtype=np.int32)
        found, _ = labels_at(
            self.points, self.tetrahedra, self._incidence, labels, wanted, threads
        )
        return found

    @cached_property
    def hull_triangles(self) -> IntArray:
        """Border of the convex hull, ``(h, 3)`` int32, counter-clockwise seen from outside.

        Hull faces with more than three corners come as several triangles.
        """
        rows, opposite = np.nonzero(self.neighbors < 0)
        corners = self.tetrahedra.take(rows, axis=0)
        left_out = opposite[:, np.newaxis] == np.arange(4)
        return outward_triangles(
            self.points, corners[~left_out].reshape(-1, 3), corners[left_out]
        )

    @cached_property
    def convex_hull(self) -> ConvexHull3D:
        """The convex hull, bounded by the hull triangles."""
        return ConvexHull3D(self.points, self.hull_triangles)

    def __repr__(self) -> str:
        return f"<Delaunay3D: {len(self.points):,} points, {len(self.tetrahedra):,} tetrahedra>"


def delaunay_in_space(
    points: Any, *, threads: int | None = None, progress: Progress | None = None
) -> Delaunay3D:
    """Triangulate a cloud in space; see :func:`alphamesh.delaunay`, also for the errors.

    Parameters
    ----------
    points : array-like of shape (n, 3)
    threads, progress : optional

    Returns
    -------
    Delaunay3D
    """
    cloud = as_cloud(points, 3)
    if cloud.weights is not None and equal_weight(cloud.weights) is None:
        return _regular(cloud, threads, progress)
    try:
        merged, tetrahedra, neighbors = delaunay3(cloud.points, threads, progress)
        representative, _ = merged_rows(merged, len(cloud))
    except BadCoordinates:
        raise coordinate_error(cloud.points) from None
    return Delaunay3D(
        cloud.points, representative, tetrahedra, neighbors, weights=cloud.weights
    )


def _regular(cloud: Cloud, threads: int | None, progress: Progress | None) -> Delaunay3D:
    """Triangulate a cloud whose weights differ."""
    assert cloud.weights is not None
    try:
        result = regular3(cloud.points, cloud.weights, threads, progress)
    except BadCoordinates:
        raise coordinate_error(cloud.points, cloud.weights) from None
    merged, hidden, (_, edges, triangles, tetrahedra), _, cofaces = result
    return Delaunay3D(
        cloud.points,
        merged_rows(merged, len(cloud))[0],
        tetrahedra,
        neighbors_in_space(cofaces, tetrahedron_triangles3(tetrahedra, triangles, cofaces)),
        (triangles, edges),
        cloud.weights,
        hidden,
    )


def neighbors_in_space(
    triangle_tetrahedra: IntArray, tetrahedron_triangles: IntArray
) -> IntArray:
    """Return the tetrahedron beyond the triangle opposite to each corner, ``(T, 4)`` int32."""
    # The numbers on either side of a triangle sum up to one and the other.
    both = triangle_tetrahedra.sum(axis=1, dtype=np.int32)
    rows = np.arange(len(tetrahedron_triangles), dtype=np.int32)[:, np.newaxis]
    return read_only(both.take(tetrahedron_triangles) - rows)


def oriented_tetrahedra(points: FloatArray, tetrahedra: IntArray) -> IntArray:
    """Return the tetrahedra with their last two corners exchanged where that is needed.

    Parameters
    ----------
    points : (n, 3) float64
    tetrahedra : (k, 4) int32

    Returns
    -------
    (k, 4) int32
        Positively oriented: seen from the last corner, the others run counter-clockwise.
    """
    oriented = tetrahedra.copy()
    points, _ = scaled_points(points)
    for start in range(0, len(oriented), _CHUNK):
        part = oriented[start : start + _CHUNK]
        negative = orient3(points.take(part, axis=0)) < 0
        part[negative, 2:] = part[negative, :1:-1]
    return read_only(oriented)


def outward_triangles(points: FloatArray, triangles: IntArray, apexes: IntArray) -> IntArray:
    """Return triangles turned so that they run counter-clockwise as seen from outside.

    Parameters
    ----------
    points : (n, 3) float64
    triangles : (k, 3) int32
    apexes : (k,) int32
        Of each triangle, a point on its inner side.

    Returns
    -------
    (k, 3) int32
        Where it runs the other way, the last two corners are exchanged.
    """
    outward = triangles.copy()
    points, _ = scaled_points(points)
    for start in range(0, len(outward), _CHUNK):
        part = slice(start, start + _CHUNK)
        corners = np.column_stack((triangles[part], apexes[part]))
        turned = np.flatnonzero(orient3(points.take(corners, axis=0)) > 0) + start
        outward[turned, 1:] = outward[turned, :0:-1]
    return read_only(outward)
