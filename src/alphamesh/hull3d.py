"""The convex hull of a cloud in space."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from alphamesh._arrays import Record, read_only
from alphamesh.measures import tetrahedron_volumes, triangle_areas

if TYPE_CHECKING:
    from alphamesh._arrays import FloatArray, IntArray

__all__ = ["ConvexHull3D"]


@dataclass(frozen=True, eq=False, repr=False)
class ConvexHull3D(Record):
    """The convex hull of a cloud in space; empty for a cloud in one plane.

    Attributes
    ----------
    points : (n, 3) float64
    triangles : (h, 3) int32
        Its border: rows of `points`, counter-clockwise as seen from outside. Faces with
        more than three corners come as several triangles, and points on the border are
        corners too, as in the Delaunay triangulation.

    All arrays are read-only.
    """

    points: FloatArray
    triangles: IntArray

    @cached_property
    def vertices(self) -> IntArray:
        """Rows of the points on the border, ascending, ``(k,)`` int32."""
        return read_only(np.unique(self.triangles))

    @cached_property
    def volume(self) -> float:
        """Volume, in cubed units of the points."""
        apex = np.repeat(self.vertices[:1], len(self.triangles))
        cones = np.column_stack((self.triangles, apex))
        cones = cones[(self.triangles != apex[:, np.newaxis]).all(axis=1)]
        with np.errstate(over="ignore"):
            return float(tetrahedron_volumes(self.points, cones).sum())

    @cached_property
    def area(self) -> float:
        """Area of the border, in squared units of the points."""
        with np.errstate(over="ignore"):
            return float(triangle_areas(self.points, self.triangles).sum())

    def __repr__(self) -> str:
        return f"<ConvexHull3D: {len(self.vertices):,} of {len(self.points):,} points>"
