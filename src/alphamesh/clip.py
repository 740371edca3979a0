"""Convex cells cut by a convex region, all at once; and by any region with shapely."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from alphamesh import _shapely
from alphamesh._arrays import Record, read_only
from alphamesh.arcs import next_pieces

if TYPE_CHECKING:
    from alphamesh._arrays import BoolArray, CountArray, FloatArray

__all__ = ["ClippedVoronoi", "Rings", "clip_rings", "lines_in_box", "ring_areas"]

# Flat outlines: vertices (m, 2), and where each outline begins (k + 1).
Rings: TypeAlias = "tuple[FloatArray, CountArray]"


@dataclass(frozen=True, eq=False, repr=False)
class ClippedVoronoi(Record):
    """The part of each Voronoi cell that lies in a region.

    Attributes
    ----------
    points : (n, 2) float64
    offset : (n + 1,) int64
        Rings ``offset[i]`` to ``offset[i + 1]`` bound the cell of row i: none if it is
        outside of the region or a merged duplicate; one if the region is convex.
    ring_offset : (k + 1,) int64
        Vertices ``ring_offset[j]`` to ``ring_offset[j + 1]`` are ring j, the first not
        repeated.
    hole : (k,) bool
        Outer rings are counter-clockwise, each followed by its holes, clockwise.
    vertices : (m, 2) float64
        Where two cells meet they have the same numbers.

    All arrays are read-only.
    """

    points: FloatArray
    offset: CountArray
    ring_offset: CountArray
    hole: BoolArray
    vertices: FloatArray

    @cached_property
    def areas(self) -> FloatArray:
        """Area of each clipped cell, ``(n,)`` float64; 0 where nothing is left."""
        signed = ring_areas((self.vertices, self.ring_offset))
        total = np.append(0.0, np.cumsum(signed))
        areas = np.diff(total[self.offset])
        single = np.diff(self.offset) == 1
        areas[single] = signed[self.offset[:-1][single]]
        return read_only(areas)

    def to_shapely(self) -> _shapely.Geometries:
        """Return each clipped cell as a shapely polygon, or several; empty where none is left.

        Returns
        -------
        (n,) object

        Raises
        ------
        MissingLibraryError
            If shapely is not installed.
        """
        return _shapely.with_holes(
            self.vertices,
            self.ring_offset,
            self.hole,
            self.offset,
            "Turning cells into polygons",
        )

    def __repr__(self) -> str:
        cells = int(np.count_nonzero(np.diff(self.offset)))
        return f"<ClippedVoronoi: {cells:,} of {len(self.points):,} cells>"


def ring_areas(rings: Rings) -> FloatArray:
    """Return the area of each ring, negative for clockwise ones, ``(k,)`` float64."""
    vertices, offset = rings
    areas = np.zeros(len(offset) - 1)
    used = np.diff(offset) > 0
    if not used.any():
        return areas
    # Seen from its first vertex, a ring's area does not suffer from a far origin.
    first = np.repeat(vertices[offset[:-1][used]], np.diff(offset)[used], axis=0)
    x, y = (vertices - first).T
    following = next_pieces(offset)
    doubled = x * y[following] - x[following] * y
    areas[used] = np.add.reduceat(doubled, offset[:-1][used]) / 2
    return areas


def clip_rings(rings: Rings, corners: FloatArray) -> Rings:
    """Cut convex rings by a convex polygon, side by side (Sutherland and Hodgman 1974).

    Parameters
    ----------
    rings : Rings
        Counter-clockwise.
    corners : (c, 2) float64
        Counter-clockwise.

    Returns
    -------
    Rings
        As many as before; without vertices where no part inside the polygon is left.
    """
    whole = _lying_inside(rings, corners)
    cut = _selected(rings, ~whole)
    for corner, after in zip(corners, np.roll(corners, -1, axis=0), strict=True):
        cut = _clip_by_side(cut, corner, after - corner)
    return _merged(rings, cut, whole)


def _sides(vertices: FloatArray, corner: FloatArray, direction: FloatArray) -> FloatArray:
    """Return how far left of the line each vertex is (exactly signed for upright lines)."""
    sides: FloatArray = direction[0] * (vertices[:, 1] - corner[1]) - direction[1] * (
        vertices[:, 0] - corner[0]
    )
    return sides


def _lying_inside(rings: Rings, corners: FloatArray) -> BoolArray:
    """Tell which rings have no vertex outside of the polygon."""
    vertices, offset = rings
    inside = np.ones(len(vertices), dtype=np.bool_)
    for corner, after in zip(corners, np.roll(corners, -1, axis=0), strict=True):
        inside &= _sides(vertices, corner, after - corner) >= 0
    outside = np.append(0, np.cumsum(~inside))
    whole: BoolArray = np.diff(outside[offset]) == 0
    return whole


def _selected(rings: Rings, mask: BoolArray) -> Rings:
    """Return the rings where `mask` is true."""
    vertices, offset = rings
    counts = np.diff(offset)
    return vertices[np.repeat(mask, counts)], np.append(0, np.cumsum(counts[mask]))


def _merged(rings: Rings, cut: Rings, whole: BoolArray) -> Rings:
    """Return all rings in their order: the whole ones, and what the others became."""
    vertices, offset = rings
    counts = np.diff(offset)
    kept = vertices[np.repeat(whole, counts)]
    counts[~whole] = np.diff(cut[1])
    merged = np.empty((int(counts.sum()), 2))
    old = np.repeat(whole, counts)
    merged[old], merged[~old] = kept, cut[0]
    return merged, np.append(0, np.cumsum(counts))


def _clip_by_side(rings: Rings, corner: FloatArray, direction: FloatArray) -> Rings:
    """Cut convex rings by the half-plane on the left of a line.

    A ring without a vertex strictly inside vanishes, so that no ring is left flat.
    """
    vertices, offset = rings
    side = _sides(vertices, corner, direction)
    following = next_pieces(offset)
    crosses = side * np.sign(side[following]) < 0
    within = np.diff(np.append(0, np.cumsum(side > 0))[offset]) > 0
    kept = np.column_stack((side >= 0, crosses))
    kept &= np.repeat(within, np.diff(offset))[:, np.newaxis]
    out = np.empty((len(vertices), 2, 2))
    out[:, 0] = vertices
    at = np.flatnonzero(crosses)
    crossings = _crossings(vertices, side, np.column_stack((at, following[at])))
    for axis in (0, 1):
        if direction[axis] == 0:  # an upright or level line: on it to the last bit
            crossings[:, axis] = corner[axis]
    out[at, 1] = crossings
    return out[kept], np.append(0, np.cumsum(kept.sum(axis=1)))[offset]


def _crossings(vertices: FloatArray, side: FloatArray, pairs: CountArray) -> FloatArray:
    """Return where segments cross a line: the same bits whichever end comes first."""
    (a, b), (side_a, side_b) = vertices[pairs.T], side[pairs.T]
    swap = (a[:, 0] > b[:, 0]) | ((a[:, 0] == b[:, 0]) & (a[:, 1] > b[:, 1]))
    side_a, side_b = np.where(swap, side_b, side_a), np.where(swap, side_a, side_b)
    swap = swap[:, np.newaxis]
    a, b = np.where(swap, b, a), np.where(swap, a, b)
    crossings: FloatArray = a + (side_a / (side_a - side_b))[:, np.newaxis] * (b - a)
    return crossings


def lines_in_box(
    lines: tuple[FloatArray, FloatArray], ends: FloatArray, box: tuple[float, ...]
) -> tuple[FloatArray, CountArray]:
    """Cut segments by a box (Liang and Barsky 1984).

    Parameters
    ----------
    lines : pair of (k, 2) float64
        A point near each segment, and the unit vector from its first to its second end.
    ends : (k, 2, 2) float64
        NaN where a segment has no end.
    box : (xmin, ymin, xmax, ymax)

    Returns
    -------
    segments : (m, 2, 2) float64
        With coordinates of the box, to the last bit, where it cuts.
    index : (m,) int64
        Which of the given segments each one is part of.
    """
    middle, direction = lines
    along = ((ends - middle[:, np.newaxis]) * direction[:, np.newaxis]).sum(axis=2)
    enter = np.where(np.isnan(along[:, 0]), -np.inf, along[:, 0])
    leave = np.where(np.isnan(along[:, 1]), np.inf, along[:, 1])
    by = np.full((2, len(middle)), -1)  # which side of the box cuts: none yet
    for axis in (0, 1):
        step = direction[:, axis]
        flat = np.flatnonzero(step == 0)
        with np.errstate(divide="ignore", invalid="ignore"):
            first, last = ((box[axis + k] - middle[:, axis]) / step for k in (0, 2))
        outside = (middle[flat, axis] < box[axis]) | (middle[flat, axis] > box[axis + 2])
        first[flat] = np.where(outside, np.inf, -np.inf)
        last[flat] = -first[flat]
        forward = step >= 0
        begin, finish = np.where(forward, first, last), np.where(forward, last, first)
        by[0, begin > enter] = axis
        by[1, finish < leave] = axis
        np.maximum(enter, begin, out=enter)
        np.minimum(leave, finish, out=leave)
    index = np.flatnonzero(enter <= leave)
    segments = ends[index]
    for k, position in enumerate((enter, leave)):
        for axis in (0, 1):
            at = np.flatnonzero(by[k, index] == axis)
            row = index[at]
            segments[at, k] = middle[row] + position[row, np.newaxis] * direction[row]
            ahead = (direction[row, axis] > 0) == (k == 1)
            segments[at, k, axis] = np.where(ahead, box[axis + 2], box[axis])
    return segments, index
