"""Regions and holes of a set of triangles: which there are, and how large."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from alphamesh._arrays import Record, read_only
from alphamesh._kernels.outlines import parts2
from alphamesh.measures import kernel_points, triangle_areas
from alphamesh.outline import Rings, outline
from alphamesh.parts import (
    Parts,
    centroids,
    labelled,
    ranked_parts,
    ranks,
    require_size,
    totals,
)

if TYPE_CHECKING:
    from alphamesh._arrays import BoolArray, CountArray, FloatArray, IntArray
    from alphamesh.filtration import Filtration

__all__ = [
    "Holes",
    "Regions",
    "find_holes",
    "find_parts",
    "find_regions",
    "without_holes",
]


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
    return ranked_parts(filtration, found)


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
    areas = parts.region_sizes
    perimeters = totals(rings.regions, rings.lengths, len(areas))
    sizes = filtration.triangle_areas.compress(inside)
    return Regions(
        labels,
        _vertex_labels(filtration, triangles, labels, rings),
        areas,
        read_only(perimeters),
        centroids(filtration.points, triangles, labels, sizes, triangle_areas),
        read_only(np.diff(rings.region_offsets) - 1),
        read_only(np.bincount(labels, minlength=len(areas))),
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


def find_holes(filtration: Filtration, parts: Parts, rings: Rings) -> Holes:
    """Measure the holes of a set of triangles, and find the regions around them.

    Parameters are those of :func:`find_regions`.
    """
    places = ranks(parts.enclosed_sizes)
    # Row -1 reads the last entry.
    labels = np.append(places, np.int32(-1)).take(parts.enclosed, mode="wrap")
    around = outline(filtration, labels)
    areas = np.empty(len(places))
    areas[places] = parts.enclosed_sizes
    perimeters = totals(around.regions, around.lengths, len(places))
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
    require_size("max_hole_area", max_area)
    small = parts.enclosed_sizes <= max_area
    if max_area == 0 or not small.any():
        return parts
    return find_parts(filtration, has_triangle | labelled(parts.enclosed, small))
