"""The convex hull of a cloud: the ring of points that a rubber band would touch."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from alphamesh import _kernels
from alphamesh._arrays import Record, read_only
from alphamesh._kernels.cells import hull2
from alphamesh.errors import ParameterError
from alphamesh.measures import total_length, triangle_areas
from alphamesh.points import as_cloud, coordinate_error

if TYPE_CHECKING:
    from alphamesh._arrays import FloatArray, IntArray

__all__ = ["ConvexHull", "convex_hull"]


@dataclass(frozen=True, eq=False, repr=False)
class ConvexHull(Record):
    """The convex hull of a cloud.

    Attributes
    ----------
    points : (n, 2) float64
    ring : (h,) int32
        Rows of `points`, counter-clockwise from the lexicographically least one (least x,
        then least y); the first one is not repeated at the end. Of duplicates, the lowest
        row. Empty for an empty cloud, one row for a single point. A cloud on one line has
        the two ends, or, if border points are kept, all points from the least to the
        greatest.

    All arrays are read-only.
    """

    points: FloatArray
    ring: IntArray

    @cached_property
    def corners(self) -> FloatArray:
        """Coordinates of the ring, ``(h, 2)`` float64."""
        return read_only(self.points.take(self.ring, axis=0))

    @cached_property
    def edges(self) -> IntArray:
        """From, to, with the hull on the left, ``(h, 2)`` int32; one edge or a path if flat."""
        closed = len(self.ring) > 2 and self.area > 0
        ends = np.roll(self.ring, -1) if closed else self.ring[1:]
        return read_only(np.column_stack((self.ring[: len(ends)], ends)))

    @cached_property
    def area(self) -> float:
        """Area, in squared units of the points."""
        first, rest = self.ring[:1], self.ring[1:]
        fan = np.column_stack((np.repeat(first, max(0, len(rest) - 1)), rest[:-1], rest[1:]))
        with np.errstate(over="ignore"):
            return float(triangle_areas(self.points, fan).sum())

    @cached_property
    def perimeter(self) -> float:
        """Length of the way around; of a cloud on one line, twice the distance of its ends."""
        around = np.column_stack((self.ring, np.roll(self.ring, -1)))
        return total_length(self.points, around)

    def __repr__(self) -> str:
        return f"<ConvexHull: {len(self.ring):,} of {len(self.points):,} points>"


def convex_hull(points: Any, *, collinear: bool = False) -> ConvexHull:
    """Return the convex hull of a cloud; every decision is exact.

    Parameters
    ----------
    points : array-like of shape (n, 2)
        See :func:`alphamesh.points.as_cloud`. Any number of points is legal.
    collinear : bool, default False
        Keep points that lie on the border between two corners.

    Returns
    -------
    ConvexHull

    Raises
    ------
    CloudShapeError, NonFiniteError, CoordinateRangeError, CloudTooLargeError
        If there is no exact hull of such points; the message names the rows.
    ParameterError
        If `collinear` is neither True nor False.

    Notes
    -----
    Points inside a polygon of extreme ones are thrown away first [1]_, the others are
    sorted, and the hull is their lower and upper chain [2]_.

    References
    ----------
    .. [1] S. G. Akl and G. T. Toussaint, A fast convex hull algorithm, Information
       Processing Letters 7 (1978) 219-222.
    .. [2] A. M. Andrew, Another efficient algorithm for convex hulls in two dimensions,
       Information Processing Letters 9 (1979) 216-219.

    Examples
    --------
    >>> import alphamesh as am
    >>> hull = am.convex_hull([[0, 0], [2, 0], [1, 0], [1, 1], [2, 2], [0, 2]])
    >>> hull.ring.tolist(), hull.area
    ([0, 1, 4, 5], 4.0)
    """
    if not isinstance(collinear, bool | np.bool_):
        raise ParameterError(
            f"collinear must be True or False (keep points between corners?); got {collinear!r}"
        )
    cloud = as_cloud(points, 2)
    try:
        ring = hull2(cloud.points, collinear=bool(collinear))
    except _kernels.BadCoordinates:
        raise coordinate_error(cloud.points) from None
    return ConvexHull(cloud.points, ring)
