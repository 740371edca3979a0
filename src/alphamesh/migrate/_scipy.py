"""``scipy.spatial.Delaunay``."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from alphamesh import _kernels
from alphamesh._arrays import read_only
from alphamesh.delaunay import delaunay_in_plane
from alphamesh.errors import CloudShapeError
from alphamesh.measures import scaled_points

if TYPE_CHECKING:
    from alphamesh._arrays import FloatArray, IntArray

__all__ = ["Delaunay"]


class Delaunay:
    """The Delaunay triangulation of points, with the names of ``scipy.spatial.Delaunay``.

    Parameters
    ----------
    points : array-like of shape (n, 2)

    Attributes
    ----------
    points : (n, 2) float64
    simplices : (T, 3) int32
        Rows of `points`, counter-clockwise.
    neighbors : (T, 3) int32
        The triangle opposite to each corner; -1 at the border.
    coplanar : (k, 3) int32
        Points that are in no triangle, as they are duplicates: the point, a triangle
        that it is a corner of, and the point that it equals.

    Raises
    ------
    CloudShapeError
        If the points are on one line: as there, there is no triangulation.
    CloudShapeError, NonFiniteError, CoordinateRangeError
        If `points` are no points in the plane.

    Notes
    -----
    Differences from SciPy: the triangulation is exact and unique (there, Qhull rounds,
    and leaves points out at large coordinates); of cocircular points, another of the
    possible triangulations may be chosen; triangles come in another order. There is no
    `transform`, `paraboloid_scale`, `lift_points` nor incremental mode, and no Qhull
    options; `tol` of `find_simplex` has no effect, as there is no tolerance.
    """

    def __init__(self, points: Any) -> None:
        self._made = delaunay_in_plane(points)
        if len(self._made.triangles) == 0:
            raise CloudShapeError(
                "the points are on one line or fewer than three, so there is no triangle; "
                "alphamesh.delaunay(points).path has the edges along the line"
            )
        corners, _ = scaled_points(self._made.points)
        triangles = self._made.triangles
        turned = _kernels.orient2(corners.take(triangles, axis=0)) < 0
        order = np.where(turned[:, np.newaxis], [0, 2, 1], [0, 1, 2])
        self.simplices: IntArray = read_only(np.take_along_axis(triangles, order, axis=1))
        self.neighbors: IntArray = read_only(
            np.take_along_axis(self._made.neighbors, order, axis=1)
        )

    @property
    def points(self) -> FloatArray:
        """The points, ``(n, 2)`` float64."""
        return self._made.points

    @property
    def ndim(self) -> int:
        """2."""
        return 2

    @property
    def npoints(self) -> int:
        """Number of points."""
        return len(self.points)

    @property
    def nsimplex(self) -> int:
        """Number of triangles."""
        return len(self.simplices)

    @property
    def min_bound(self) -> FloatArray:
        """Least coordinates."""
        return np.asarray(self.points.min(axis=0))

    @property
    def max_bound(self) -> FloatArray:
        """Largest coordinates."""
        return np.asarray(self.points.max(axis=0))

    @cached_property
    def convex_hull(self) -> IntArray:
        """Edges of the convex hull, ``(m, 2)`` int32."""
        triangle, corner = np.nonzero(self.neighbors < 0)
        ends = np.array([[1, 2], [2, 0], [0, 1]])[corner]
        return read_only(self.simplices[triangle[:, np.newaxis], ends])

    @cached_property
    def vertex_to_simplex(self) -> IntArray:
        """A triangle of each point, ``(n,)`` int32; -1 for duplicates."""
        found = np.full(self.npoints, -1, dtype=np.int32)
        found[self.simplices.ravel()] = np.repeat(np.arange(self.nsimplex, dtype=np.int32), 3)
        return read_only(found)

    @cached_property
    def coplanar(self) -> IntArray:
        """Duplicates, ``(k, 3)`` int32: the point, a triangle, the point that it equals."""
        equal = self._made.representative
        rows = np.flatnonzero(equal != np.arange(self.npoints, dtype=np.int32))
        same = equal[rows]
        return read_only(
            np.column_stack((rows, self.vertex_to_simplex[same], same)).astype(np.int32)
        )

    @cached_property
    def vertex_neighbor_vertices(self) -> tuple[IntArray, IntArray]:
        """Neighbours of point k: ``indices[indptr[k]:indptr[k + 1]]``, as two arrays."""
        edges = self._made.edges
        both = np.concatenate((edges, edges[:, ::-1]))
        both = both[np.lexsort((both[:, 1], both[:, 0]))]
        indptr = np.searchsorted(both[:, 0], np.arange(self.npoints + 1)).astype(np.int32)
        return read_only(indptr), read_only(np.ascontiguousarray(both[:, 1]))

    def find_simplex(
        self, xi: Any, bruteforce: bool = False, tol: float | None = None
    ) -> IntArray:
        """Return the triangle that each point of `xi` lies in, -1 outside; exact.

        Parameters
        ----------
        xi : array-like of shape (..., 2)
        bruteforce, tol : optional
            Without effect.

        Returns
        -------
        (...) int32
        """
        wanted = np.asarray(xi, dtype=np.float64)
        if wanted.ndim == 0 or wanted.shape[-1] != 2:
            raise CloudShapeError(f"xi must have two columns, x and y; got {wanted.shape}")
        found = self._made.find(wanted.reshape(-1, 2))
        return read_only(found.reshape(wanted.shape[:-1]))

    def __repr__(self) -> str:
        return f"<Delaunay: {self.npoints:,} points, {self.nsimplex:,} simplices>"
