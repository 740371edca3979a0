"""The whole from its tiles: counts, Betti numbers, measures and outlines."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from alphamesh._arrays import Record, read_only
from alphamesh._kernels.outlines import outlines2
from alphamesh.classify import SimplexKind
from alphamesh.measures import kernel_points
from alphamesh.outline import Rings
from alphamesh.tiles.labels import Border, join
from alphamesh.tiles.windings import windings

if TYPE_CHECKING:
    from collections.abc import Sequence

    from alphamesh._arrays import CountArray, FloatArray, IntArray
    from alphamesh.tiles.pieces import Boundary, Piece

__all__ = ["Part", "Summary", "finish", "merge", "outline", "part_of"]


@dataclass(frozen=True, eq=False, repr=False)
class Part(Record):
    """What the whole needs to know of one tile: little more than its border.

    Attributes
    ----------
    points : int
        Points in the tile, duplicates and all.
    counts : (d + 1,) int64
        How many simplices of each dimension it owns.
    facet_kinds : (4,) int64
        How many facets of each :class:`~alphamesh.classify.SimplexKind`.
    boundary_size : float
    region_sizes : (r,) float64
    components, regions, fronts : Border
    """

    points: int
    counts: CountArray
    facet_kinds: CountArray
    boundary_size: float
    region_sizes: FloatArray
    components: Border
    regions: Border
    fronts: Border


@dataclass(frozen=True, slots=True)
class Summary:
    """Facts about the alpha complex of the whole cloud at one radius.

    Attributes
    ----------
    radius : float
    points : int
        Rows of the cloud, duplicates and all.
    counts : tuple of int
        Vertices, edges, triangles (and tetrahedra).
    singular_facets, regular_facets, interior_facets : int
        Facets are edges in the plane, triangles in space.
    euler_characteristic : int
    betti : tuple of int or None
        Components and holes; in space components, tunnels and voids. In a periodic box
        components, loops (voids) and 1 if all is filled. In a box of space, loops and
        voids are None where a component runs around it in more than one direction.
    regions : int
        Sets of cells connected by facets.
    size, boundary_size : float
        Area and perimeter, or volume and surface area, of the cells.
    windings : tuple of int or None
        In a periodic box: how many components run around it in 0, 1, ... independent
        directions.
    """

    radius: float
    points: int
    counts: tuple[int, ...]
    singular_facets: int
    regular_facets: int
    interior_facets: int
    euler_characteristic: int
    betti: tuple[int | None, ...]
    regions: int
    size: float
    boundary_size: float
    windings: tuple[int, ...] | None = None


def part_of(piece: Piece) -> Part:
    """Return what the whole needs to know of a piece."""
    kinds = map(int, SimplexKind)  # with other integers, all would be converted
    return Part(
        len(piece.rows),
        read_only(np.array([len(rows) for rows in piece.simplices])),
        read_only(np.array([np.count_nonzero(piece.facet_kinds == k) for k in kinds])),
        piece.boundary_size,
        piece.region_sizes,
        piece.components,
        piece.regions,
        piece.fronts,
    )


def merge(
    parts: Sequence[Part], radius: float, *, periodic: bool = False
) -> tuple[Summary, list[IntArray], FloatArray]:
    """Put the parts of all tiles together.

    Parameters
    ----------
    parts : sequence of Part
        One for each tile, in their order.
    radius : float
    periodic : bool
        Whether they are those of a periodic box.

    Returns
    -------
    summary : Summary
    region_labels : list of (r_i,) int32
        For each tile, which region of the whole each of its regions is; the largest is 0.
    region_sizes : (r,) float64
        Descending.
    """
    counts = np.sum([part.counts for part in parts], axis=0).tolist()
    kinds = np.sum([part.facet_kinds for part in parts], axis=0).tolist()
    regions, labels = join([part.regions for part in parts])
    sizes = np.zeros(regions)
    for part, label in zip(parts, labels, strict=True):
        np.add.at(sizes, label, part.region_sizes)
    order = np.argsort(-sizes, kind="stable")
    ranks = np.empty(regions, dtype=np.int32)
    ranks[order] = np.arange(regions, dtype=np.int32)
    euler = sum(count if k % 2 == 0 else -count for k, count in enumerate(counts))
    around = windings([part.components for part in parts]) if periodic else None
    summary = Summary(
        radius=radius,
        points=sum(part.points for part in parts),
        counts=tuple(counts),
        singular_facets=kinds[SimplexKind.SINGULAR],
        regular_facets=kinds[SimplexKind.REGULAR],
        interior_facets=kinds[SimplexKind.INTERIOR],
        euler_characteristic=euler,
        betti=(
            _betti(parts, euler)
            if around is None
            else _betti_in_box(parts, euler, kinds, around)
        ),
        regions=regions,
        size=math.fsum(size for part in parts for size in part.region_sizes.tolist()),
        boundary_size=math.fsum(part.boundary_size for part in parts),
        windings=around,
    )
    return summary, [ranks.take(label) for label in labels], read_only(sizes.take(order))


def _betti(parts: Sequence[Part], euler: int) -> tuple[int, ...]:
    """Return the Betti numbers of the whole: the Euler number tells those of loops."""
    components, _ = join([part.components for part in parts])
    if len(parts[0].counts) == 3:
        return components, components - euler
    sides, _ = join([part.fronts for part in parts])
    voids = sides - components
    return components, components + voids - euler, voids


def _betti_in_box(
    parts: Sequence[Part], euler: int, kinds: Sequence[int], around: Sequence[int]
) -> tuple[int | None, ...]:
    """Return the Betti numbers in a periodic box, as far as tiles can tell them.

    In the plane, a part of a surface without a border is all of it. In space, b2 is the
    number of components of the complement less one, and more where the complement does not
    run around the box in all its directions. That it does if no component of the complex
    spans two of them; then sides are counted as in open space.
    """
    components = sum(around)
    filled = int(kinds[SimplexKind.INTERIOR] > 0 and kinds[SimplexKind.REGULAR] == 0)
    if len(parts[0].counts) == 3:
        return components, components + filled - euler, filled
    if filled:
        return 1, 3, 3, 1
    if sum(around[2:]) > 0:
        return components, None, None, 0
    sides, _ = join([part.fronts for part in parts])
    voids = sides - components
    return components, components + voids - euler, voids, 0


def outline(boundaries: Sequence[Boundary], region_labels: Sequence[IntArray]) -> Rings:
    """Trace the rings around the regions of the whole.

    Parameters
    ----------
    boundaries : sequence of Boundary
        One for each tile, in the plane.
    region_labels : sequence of (r_i,) int32
        From :func:`merge`.

    Returns
    -------
    Rings
        Over the corners of boundary edges and of the triangles at them; `edges` counts
        boundary edges.
    """
    rows = np.concatenate([np.column_stack((b.facets, b.apexes)) for b in boundaries])
    places = np.concatenate([b.points for b in boundaries]).reshape(-1, 2)
    regions = np.concatenate(
        [labels.take(b.regions) for b, labels in zip(boundaries, region_labels, strict=True)]
    )
    _, first, corner = np.unique(rows.ravel(), return_index=True, return_inverse=True)
    points = read_only(places.take(first, axis=0))
    triangles = corner.reshape(-1, 3).astype(np.int32)
    numbers = np.arange(len(triangles), dtype=np.int32)
    cofaces = np.stack((numbers, np.full_like(numbers, -1)), axis=1)
    edges = np.ascontiguousarray(np.sort(triangles[:, :2], axis=1))
    scaled, _ = kernel_points(points)
    offsets, ring_rows, ring_edges, ring_regions, holes = outlines2(
        scaled, np.sort(triangles, axis=1), edges, cofaces, regions.astype(np.int32)
    )
    return Rings(points, ring_rows, ring_edges, offsets, ring_regions, holes)


def finish(boundaries: Sequence[Boundary], region_labels: Sequence[IntArray]) -> Any:
    """Return the polygons of the whole, as ``shape.polygons()`` would, largest first.

    Returns
    -------
    (r,) array of shapely.Polygon
    """
    from alphamesh.polygons import polygons

    return polygons(outline(boundaries, region_labels))
