"""``scipy.spatial.Delaunay``."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from alphamesh import _kernels
from alphamesh._arrays import read_only
from alphamesh.delaunay import delaunay
from alphamesh.delaunay3d import Delaunay3D, oriented_tetrahedra
from alphamesh.errors import CloudShapeError
from alphamesh.measures import scaled_points

if TYPE_CHECKING:
    from alphamesh._arrays import FloatArray, IntArray

__all__ = ["Delaunay"]


# The corners of the facet opposite to each corner, counter-clockwise seen from outside.
_FACETS = {
    2: np.array([[1, 2], [2, 0], [0, 1]]),
    3: np.array([[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]]),
}


class Delaunay:
    """The Delaunay triangulation of points, with the names of ``scipy.spatial.Delaunay``.

    Parameters
    ----------
    points : array-like of shape (n, 2) or (n, 3)

    Attributes
    ----------
    points : (n, d) float64
    simplices : (T, d + 1) int32
        Rows of `points`: triangles, counter-clockwise, or tetrahedra, positively oriented.
    neighbors : (T, d + 1) int32
        The simplex opposite to each corner; -1 at the border.
    coplanar : (k, 3) int32
        Points that are in no simplex, as they are duplicates: the point, a simplex
        that it is a corner of, and the point that it equals.

    Raises
    ------
    CloudShapeError
        If the points are on one line, or, with three coordinates, in one plane: as there,
        there is no triangulation.
    CloudShapeError, NonFiniteError, CoordinateRangeError
        If `points` are no points in the plane or in space.

    Notes
    -----
    Differences from SciPy: the triangulation is exact and unique (there, Qhull rounds,
    and leaves points out at large coordinates); of cocircular or cospherical points, another
    of the possible triangulations may be chosen; simplices come in another order. There is no
    `transform`, `paraboloid_scale`, `lift_points` nor incremental mode, and no Qhull
    options; `tol` of `find_simplex` has no effect, as there is no tolerance.
    """

    def __init__(self, points: Any) -> None:
        made = delaunay(points)
        cells = made.tetrahedra if isinstance(made, Delaunay3D) else made.triangles
        if len(cells) == 0:
            raise _flat(made)
        if isinstance(made, Delaunay3D):
            oriented = oriented_tetrahedra(made.points, cells)
            turned = (oriented != cells).any(axis=1)
        else:
            corners, _ = scaled_points(made.points)
            turned = _kernels.orient2(corners.take(cells, axis=0)) < 0
        # The last two corners are exchanged where that is needed, and so are neighbours.
        usual = np.arange(cells.shape[1])
        order = np.where(turned[:, np.newaxis], np.append(usual[:-2], usual[:-3:-1]), usual)
        self._made = made
        self.simplices: IntArray = read_only(np.take_along_axis(cells, order, axis=1))
        self.neighbors: IntArray = read_only(np.take_along_axis(made.neighbors, order, axis=1))

    @property
    def points(self) -> FloatArray:
        """The points, ``(n, d)`` float64."""
        return self._made.points

    @property
    def ndim(self) -> int:
        """Number of coordinates, 2 or 3."""
        return int(self.points.shape[1])

    @property
    def npoints(self) -> int:
        """Number of points."""
        return len(self.points)

    @property
    def nsimplex(self) -> int:
        """Number of simplices."""
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
        """Facets of the convex hull, ``(m, d)`` int32: edges, or triangles."""
        simplex, corner = np.nonzero(self.neighbors < 0)
        rows = _FACETS[self.ndim][corner]
        return read_only(self.simplices[simplex[:, np.newaxis], rows])

    @cached_property
    def vertex_to_simplex(self) -> IntArray:
        """A simplex of each point, ``(n,)`` int32; -1 for duplicates."""
        found = np.full(self.npoints, -1, dtype=np.int32)
        found[self.simplices.ravel()] = np.repeat(
            np.arange(self.nsimplex, dtype=np.int32), self.ndim + 1
        )
        return read_only(found)

    @cached_property
    def coplanar(self) -> IntArray:
        """Duplicates, ``(k, 3)`` int32: the point, a simplex, the point that it equals."""
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
        """Return the simplex that each point of `xi` lies in, -1 outside; exact.

        Parameters
        ----------
        xi : array-like of shape (..., d)
        bruteforce, tol : optional
            Without effect.

        Returns
        -------
        (...) int32
        """
        wanted = np.asarray(xi, dtype=np.float64)
        if wanted.ndim == 0 or wanted.shape[-1] != self.ndim:
            columns = "two columns, x and y" if self.ndim == 2 else "three columns"
            raise CloudShapeError(f"xi must have {columns}; got {wanted.shape}")
        found = self._made.find(wanted.reshape(-1, self.ndim))
        return read_only(found.reshape(wanted.shape[:-1]))

    def __repr__(self) -> str:
        return f"<Delaunay: {self.npoints:,} points, {self.nsimplex:,} simplices>"


def _flat(made: Any) -> CloudShapeError:
    """Return the error for points without a triangulation."""
    if isinstance(made, Delaunay3D):
        return CloudShapeError(
            "the points are in one plane or fewer than four, so there is no tetrahedron; "
            "alphamesh.delaunay(points).triangles has the triangles in the plane"
        )
    return CloudShapeError(
        "the points are on one line or fewer than three, so there is no triangle; "
        "alphamesh.delaunay(points).path has the edges along the line"
    )
