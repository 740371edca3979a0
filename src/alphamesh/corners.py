"""Corner cutting: rings of points that become smooth without crossing one another."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from alphamesh._kernels import orient2

if TYPE_CHECKING:
    from alphamesh._arrays import BoolArray, CountArray, FloatArray

__all__ = ["Corners", "corners_of", "in_triangles"]

_CUT = 0.25


@dataclass(frozen=True, slots=True, eq=False)
class Corners:
    """Corners of rings; the first of a ring is not repeated.

    Attributes
    ----------
    points : (k, 2) float64
    offsets : (m + 1,) int64
    fixed : (k,) bool
        Which corners are not to be cut.
    """

    points: FloatArray
    offsets: CountArray
    fixed: BoolArray

    def neighbours(self) -> tuple[FloatArray, FloatArray]:
        """Return the corner before and the corner after each corner in its ring."""
        before, after = np.roll(self.points, 1, axis=0), np.roll(self.points, -1, axis=0)
        first, last = self.offsets[:-1], self.offsets[1:] - 1
        before[first], after[last] = self.points[last], self.points[first]
        return before, after

    def cut(self) -> Corners:
        """Return the corners after one cut: two points for each that is not fixed."""
        before, after = self.neighbours()
        counts = np.where(self.fixed, 1, 2)
        ends = np.cumsum(counts)
        points = np.repeat(self.points, counts, axis=0)
        cut = np.flatnonzero(~self.fixed)
        here = self.points[cut]
        points[ends[cut] - 2] = here + _CUT * (before[cut] - here)
        points[ends[cut] - 1] = here + _CUT * (after[cut] - here)
        offsets = np.append(0, ends)[self.offsets]
        return Corners(points, offsets, np.repeat(self.fixed, counts))

    def closed(self) -> tuple[FloatArray, CountArray]:
        """Return all points, each ring closed by its first one, and where rings begin."""
        first = self.points[self.offsets[:-1]]
        points = np.insert(self.points, self.offsets[1:], first, axis=0)
        return points, self.offsets + np.arange(len(self.offsets))


def corners_of(closed: FloatArray, offsets: CountArray) -> Corners:
    """Return the corners of closed rings, none of them fixed.

    Parameters
    ----------
    closed : (k, 2) float64
        Each ring ends with its first point.
    offsets : (m + 1,) int64
    """
    points = np.delete(closed, offsets[1:] - 1, axis=0)
    return Corners(points, offsets - np.arange(len(offsets)), np.zeros(len(points), dtype=bool))


def in_triangles(triangles: FloatArray, points: FloatArray) -> BoolArray:
    """Return which points lie in their triangle or on its border; exact.

    Parameters
    ----------
    triangles : (k, 3, 2) float64
        Either way around. Of a flat triangle, the whole line counts.
    points : (k, 2) float64

    Returns
    -------
    (k,) bool
    """
    sides = np.empty((len(points), 3), dtype=np.int8)
    for side in range(3):
        ends = triangles[:, (side, (side + 1) % 3)]
        sides[:, side] = orient2(np.concatenate((ends, points[:, np.newaxis]), axis=1))
    return np.asarray((sides >= 0).all(axis=1) | (sides <= 0).all(axis=1))
