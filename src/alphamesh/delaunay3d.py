"""The Delaunay triangulation of a cloud in space."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from alphamesh._arrays import Record, read_only
from alphamesh._kernels.space import orient3
from alphamesh.measures import scaled_points

if TYPE_CHECKING:
    from alphamesh._arrays import FloatArray, IntArray

__all__ = ["Delaunay3D", "oriented_tetrahedra", "outward_triangles"]

# Tetrahedra worked on at a time: their coordinates stay in the processor's cache.
_CHUNK = 1 << 14


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
    triangles : (F, 3) int32
        All triangles, ascending within a triangle.
    edges : (E, 2) int32
        All edges, ascending within an edge.

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
    triangles: IntArray
    edges: IntArray

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

    def __repr__(self) -> str:
        return f"<Delaunay3D: {len(self.points):,} points, {len(self.tetrahedra):,} tetrahedra>"


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
