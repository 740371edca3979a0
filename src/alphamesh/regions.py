"""Regions and holes of a set of triangles: which there are, and how large."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from alphamesh._arrays import Record, read_only
from alphamesh._kernels.outlines import parts2
from alphamesh.errors import ParameterError
from alphamesh.measures import kernel_points, scaled_points, triangle_areas
from alphamesh.outline import Rings, outline

if TYPE_CHECKING:
    from alphamesh._arrays import BoolArray, CountArray, FloatArray, IntArray
    from alphamesh.filtration import Filtration

__all__ = [
    "Holes",
    "Parts",
    "Regions",
    "find_holes",
    "find_parts",
    "find_regions",
    "labelled",
    "large_regions",
    "without_holes",
]

_FIRST_HOLE = -2


@dataclass(frozen=True, eq=False, repr=False)
class Parts(Record):
    """The plane, divided by a set of triangles into regions, holes and the outside.

    Attributes
    ----------
    filtration : Filtration
    labels : (T,) int32
        Of each triangle of the filtration: the number of its region, the largest first;
        -1 outside, where a way leads to infinity; ``-2 - h`` in hole h.
    """

    filtration: Filtration
    labels: IntArray

    @cached_property
    def region_areas(self) -> FloatArray:
        """In squared units of the points, ``(r,)`` float64, descending."""
        return read_only(_sums(self.labels, self.filtration.triangle_areas))

    @cached_property
    def hole_areas(self) -> FloatArray:
        """In squared units of the points, ``(h,)`` float64, in no particular order."""
        return read_only(_sums(self.holes, self.filtration.triangle_areas))

    @cached_property
    def holes(self) -> IntArray:
        """Number of the hole that each triangle lies in, below zero for none, int32."""
        return read_only(np.maximum(_FIRST_HOLE - self.labels, -1))


@dataclass(frozen=True, eq=False, repr=False)
class Regions(Record):
    """The regions of a shape: sets of triangles connected by edges, the largest first.

    Regions that touch at a point are two. Equally large ones come in the order of their
    first triangles.

    Attributes
    ----------
    labels : (k,) int32
        The region of each of the triangles of the shape.
    vertex_labels : (n,) int32
        The region that each point is a corner of, the lowest if there are several; -1
        if none. Duplicates have the one of their representative.
    areas : (r,) float64
        In squared units of the points.
    perimeters : (r,) float64
        Length of all rings, around the region and its holes.
    centroids : (r, 2) float64
        Centres of area.
    hole_counts : (r,) int64
        How many holes the polygon of the region has. Whatever lies in such a hole,
        other regions or nothing, it counts as one.
    triangle_counts : (r,) int64

    All arrays are read-only.
    """

    labels: IntArray
    vertex_labels: IntArray
    areas: FloatArray
    perimeters: FloatArray
    centroids: FloatArray
    hole_counts: CountArray
    triangle_counts: CountArray

    def __len__(self) -> int:
        return len(self.areas)

    @property
    def euler_characteristics(self) -> CountArray:
        """Vertices minus edges plus triangles of each region: 1 minus its holes, int64."""
        return 1 - self.hole_counts

    def __repr__(self) -> str:
        return f"<Regions: {len(self):,}, with {int(self.hole_counts.sum()):,} holes>"


@dataclass(frozen=True, eq=False, repr=False)
class Holes(Record):
    """The holes of a shape: bounded parts of the plane without it, the largest first.

    A hole is a set of triangles connected by edges, as a region is. So an island in a
    hole is not part of it, and islands that touch the border can divide it in two.

    Attributes
    ----------
    areas : (h,) float64
        In squared units of the points, without islands.
    perimeters : (h,) float64
        Length of all rings, around the hole and its islands.
    regions : (h,) int32
        The region in a hole of which it lies, at its border; -1 if it is enclosed by
        several regions that touch at points.
    rings : Rings
        The outline of each hole, the hole on its left: around it counter-clockwise,
        around islands clockwise.

    All arrays are read-only.
    """

    areas: FloatArray
    perimeters: FloatArray
    regions: IntArray
    rings: Rings

    def __len__(self) -> int:
        return len(self.areas)

    def __repr__(self) -> str:
        return f"<Holes: {len(self):,}>"


def find_parts(filtration: Filtration, has_triangle: BoolArray) -> Parts:
    """Divide the triangles of a filtration into regions, holes and the outside.

    Parameters
    ----------
    filtration : Filtration
    has_triangle : (T,) bool
        Which triangles the shape has.
    """
    _, edges, triangles = filtration.simplices
    points, _ = kernel_points(filtration.points)
    found = parts2(points, triangles, edges, filtration.edge_triangles, has_triangle)
    parts = Parts(filtration, found)
    if found.max(initial=-1) <= 0:
        return parts
    # New numbers by size; those below zero stay.
    ranks = _ranks(parts.region_areas)
    known = found >= 0
    labels = found.copy()
    labels[known] = ranks.take(found.compress(known))
    return Parts(filtration, read_only(labels))


def _ranks(areas: FloatArray) -> IntArray:
    """Return the place of each area in descending order; equal ones keep their order."""
    ranks = np.empty(len(areas), dtype=np.int32)
    ranks[np.argsort(-areas, kind="stable")] = np.arange(len(areas))
    return ranks


def _sums(labels: IntArray, values: FloatArray) -> FloatArray:
    """Return the sum of the values of each label; those below zero do not count."""
    used = labels >= 0
    return _totals(labels.compress(used), values.compress(used), 0)


def _totals(labels: IntArray, values: FloatArray, count: int) -> FloatArray:
    """Return the sum of the values of each label, of which there are `count` or more."""
    with np.errstate(over="ignore"):
        return np.asarray(np.bincount(labels, values, count), dtype=np.float64)


def find_regions(filtration: Filtration, parts: Parts, rings: Rings) -> Regions:
    """Measure the regions of a set of triangles.

    Parameters
    ----------
    filtration : Filtration
    parts : Parts
    rings : Rings
        The outline of the regions of `parts`.
    """
    inside = parts.labels >= 0
    labels = read_only(parts.labels.compress(inside))
    triangles = filtration.simplices[2].compress(inside, axis=0)
    perimeters = _totals(rings.regions, rings.lengths, len(parts.region_areas))
    return Regions(
        labels,
        _vertex_labels(filtration, triangles, labels, rings),
        parts.region_areas,
        read_only(perimeters),
        _centroids(filtration, inside, labels, len(parts.region_areas)),
        read_only(np.diff(rings.region_offsets) - 1),
        read_only(np.bincount(labels, minlength=len(parts.region_areas))),
    )


def _vertex_labels(
    filtration: Filtration, triangles: IntArray, labels: IntArray, rings: Rings
) -> IntArray:
    """Return the lowest label at each row of points, -1 where there is none."""
    lowest = np.full(len(filtration.points), -1, dtype=np.int32)
    for corner in range(3):
        lowest[triangles[:, corner]] = labels
    # Regions meet at corners of their rings only.
    np.minimum.at(lowest, rings.rows, np.repeat(rings.regions, np.diff(rings.offsets)))
    return read_only(lowest.take(filtration.representative))


def _centroids(
    filtration: Filtration, inside: BoolArray, labels: IntArray, count: int
) -> FloatArray:
    """Return the centre of area of each region."""
    points, exponent = scaled_points(filtration.points)
    triangles = filtration.simplices[2].compress(inside, axis=0)
    if exponent == 0:
        weights = filtration.triangle_areas.compress(inside)
    else:
        weights = triangle_areas(points, triangles)
    total = _totals(labels, weights, count)
    flat = total == 0  # too thin for float64: any inner point is as good
    if flat.any():
        weights[flat.take(labels)] = 1.0
        total = _totals(labels, weights, count)
    # Seen from a corner of the region, little cancels far from the origin.
    origin = np.empty(count, dtype=np.int32)
    origin[labels] = triangles[:, 0]
    centroids = points.take(origin, axis=0)
    start = centroids.take(labels, axis=0)
    middle = (points.take(triangles, axis=0) - start[:, np.newaxis]).sum(axis=1) / 3
    shares = weights / total.take(labels)
    for axis in (0, 1):
        centroids[:, axis] += _totals(labels, shares * middle[:, axis], count)
    return read_only(np.ldexp(centroids, exponent))


def find_holes(filtration: Filtration, parts: Parts, rings: Rings) -> Holes:
    """Measure the holes of a set of triangles, and find the regions around them.

    Parameters are those of :func:`find_regions`.
    """
    ranks = _ranks(parts.hole_areas)
    # Row -1 reads the last entry.
    around = outline(filtration, np.append(ranks, np.int32(-1)).take(parts.holes, mode="wrap"))
    areas = np.empty(len(ranks))
    areas[ranks] = parts.hole_areas
    perimeters = _totals(around.regions, around.lengths, len(ranks))
    return Holes(read_only(areas), read_only(perimeters), _surrounding(around, rings), around)


def _surrounding(around: Rings, rings: Rings) -> IntArray:
    """Return for each hole the region that has it in one of its holes, -1 if none has.

    Along its outer ring, a hole meets holes of no region but this one. Other regions
    that it meets there lie in that hole themselves, and show it their outer rings.
    """
    of_hole = np.repeat(rings.is_hole, np.diff(rings.offsets))
    most = max(rings.edges.max(initial=-1), around.edges.max(initial=-1))
    region_at = np.full(int(most) + 1, -1, dtype=np.int32)
    ring_regions = np.repeat(rings.regions, np.diff(rings.offsets))
    region_at[rings.edges.compress(of_hole)] = ring_regions.compress(of_hole)
    outer = np.repeat(~around.is_hole, np.diff(around.offsets))
    met = region_at.take(around.edges.compress(outer))
    sizes = np.diff(around.offsets).compress(~around.is_hole)
    if len(sizes) == 0:
        return read_only(np.empty(0, dtype=np.int32))
    return read_only(np.maximum.reduceat(met, np.append(0, np.cumsum(sizes)[:-1])))


# ---------------------------------------------------------------------- choosing


def labelled(labels: IntArray, kept: BoolArray) -> BoolArray:
    """Return which triangles have a label that is kept; those below zero never are."""
    # Row -1 reads the last entry.
    return read_only(np.append(kept, False).take(np.maximum(labels, -1), mode="wrap"))


def without_holes(
    filtration: Filtration, has_triangle: BoolArray, parts: Parts, max_area: float
) -> Parts:
    """Return the parts of the plane once holes of at most `max_area` are filled.

    Parameters
    ----------
    filtration : Filtration
    has_triangle : (T,) bool
    parts : Parts
        Those of `has_triangle`.
    max_area : float

    Raises
    ------
    ParameterError
        If `max_area` is negative or NaN.
    """
    _require_area("max_hole_area", max_area)
    small = parts.hole_areas <= max_area
    if max_area == 0 or not small.any():
        return parts
    return find_parts(filtration, has_triangle | labelled(parts.holes, small))


def large_regions(parts: Parts, min_area: float, most: int | None) -> BoolArray:
    """Return the regions of at least `min_area`, at most so many, ``(r,)`` bool.

    Raises
    ------
    ParameterError
        If `min_area` is negative or NaN, or `most` not a whole number of 0 or more.
    """
    _require_area("min_region_area", min_area)
    given: Any = most
    if given is not None and (
        not isinstance(given, int | np.integer) or isinstance(given, bool) or given < 0
    ):
        raise ParameterError(
            f"keep_largest must be a whole number of 0 or more, or None; got {most!r}"
        )
    large = parts.region_areas >= min_area
    if most is not None:
        large[most:] = False
    return large


def _require_area(name: str, area: float) -> None:
    if not area >= 0:
        raise ParameterError(
            f"{name} must be 0 or more, in squared units of the points; got {area!r}"
        )
