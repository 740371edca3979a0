"""Outlines: the rings that bound regions of triangles, as flat arrays."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from alphamesh._arrays import Record, read_only
from alphamesh._kernels.outlines import outlines2
from alphamesh.measures import kernel_points, scaled_points

if TYPE_CHECKING:
    from alphamesh._arrays import BoolArray, CountArray, FloatArray, IntArray
    from alphamesh.filtration import Filtration

__all__ = ["Rings", "outline"]


@dataclass(frozen=True, eq=False, repr=False)
class Rings(Record):
    """Closed walks around regions, each region on the left of its rings.

    Outer rings run counter-clockwise and holes clockwise, as GeoJSON (RFC 7946) has it.
    No ring passes a point twice: where a region touches itself at a point, two of its
    rings do. So each region with its holes is a valid polygon of the OGC.

    Attributes
    ----------
    points : (n, 2) float64
        The cloud.
    rows : (k,) int32
        Corners as rows of `points`, ring after ring, each from its lexicographically
        least corner on. The first corner of a ring is not repeated at its end.
    edges : (k,) int32
        The edge of the filtration from each corner to the next one of its ring.
    offsets : (m + 1,) int64
        ``rows[offsets[i]:offsets[i + 1]]`` is ring i.
    regions : (m,) int32
        The region that each ring belongs to, ascending. The outer ring of a region
        comes before its holes.
    is_hole : (m,) bool

    All arrays are read-only.
    """

    points: FloatArray
    rows: IntArray
    edges: IntArray
    offsets: CountArray
    regions: IntArray
    is_hole: BoolArray

    def __len__(self) -> int:
        return len(self.regions)

    @cached_property
    def region_offsets(self) -> CountArray:
        """Rings ``region_offsets[i]`` to ``region_offsets[i + 1]`` are region i's, int64."""
        starts = np.flatnonzero(~self.is_hole)
        return read_only(np.append(starts, len(self.regions)).astype(np.int64))

    @cached_property
    def lengths(self) -> FloatArray:
        """Length of each ring, ``(m,)`` float64."""
        if len(self) == 0:
            return read_only(np.empty(0))
        with np.errstate(over="ignore"):
            steps = np.hypot(*(self.points.take(self._next, axis=0) - self._corners).T)
            return read_only(np.add.reduceat(steps, self.offsets[:-1]))

    @cached_property
    def areas(self) -> FloatArray:
        """Area inside of each ring, ``(m,)`` float64; negative for holes."""
        if len(self) == 0:
            return read_only(np.empty(0))
        points, exponent = scaled_points(self.points)
        # Seen from the first corner of the ring, little cancels far from the origin.
        first = np.repeat(self.rows.take(self.offsets[:-1]), np.diff(self.offsets))
        x, y = (points.take(self.rows, axis=0) - points.take(first, axis=0)).T
        u, v = (points.take(self._next, axis=0) - points.take(first, axis=0)).T
        doubled = np.add.reduceat(x * v - u * y, self.offsets[:-1])
        with np.errstate(over="ignore", under="ignore"):
            return read_only(np.ldexp(doubled, 2 * exponent - 1))

    def closed(self) -> tuple[FloatArray, CountArray]:
        """Return all corners, each ring closed by its first one, and where rings begin.

        Returns
        -------
        coordinates : (k + m, 2) float64
        offsets : (m + 1,) int64
        """
        rows = np.insert(self.rows, self.offsets[1:], self.rows.take(self.offsets[:-1]))
        offsets = self.offsets + np.arange(len(self.offsets))
        return self.points.take(rows, axis=0), offsets

    @property
    def _corners(self) -> FloatArray:
        return self.points.take(self.rows, axis=0)

    @property
    def _next(self) -> IntArray:
        """The row after each corner in its ring."""
        following = np.roll(self.rows, -1)
        following[self.offsets[1:] - 1] = self.rows.take(self.offsets[:-1])
        return following

    def __repr__(self) -> str:
        holes = int(np.count_nonzero(self.is_hole))
        return (
            f"<Rings: {len(self) - holes:,} outer, {holes:,} holes, {len(self.rows):,} corners>"
        )


def outline(filtration: Filtration, regions: IntArray) -> Rings:
    """Trace the rings around regions of triangles, in linear time and exactly.

    Parameters
    ----------
    filtration : Filtration
    regions : (T,) int32
        Region of each triangle, below zero for none; the triangles of a region must be
        connected by edges, and no number be left out.

    Returns
    -------
    Rings

    Notes
    -----
    Where a region has several fans of triangles around a point, a ring that arrives
    there goes on around the gap between two fans. Each gap belongs to another part of
    the plane: a curve through two of them would cut the region in two. So each ring
    bounds one part of the plane without the region, and passes no point twice.
    """
    _, edges, triangles = filtration.simplices
    points, _ = kernel_points(filtration.points)
    offsets, rows, ring_edges, ring_regions, is_hole = outlines2(
        points, triangles, edges, filtration.edge_triangles, regions
    )
    return Rings(filtration.points, rows, ring_edges, offsets, ring_regions, is_hole)
