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
    counts : (3,) int64
        Vertices, edges and triangles that it owns.
    edge_kinds : (4,) int64
        How many edges of each :class:`~alphamesh.classify.SimplexKind`.
    perimeter : float
    region_areas : (r,) float64
    components, regions : Border
    """

    points: int
    counts: CountArray
    edge_kinds: CountArray
    perimeter: float
    region_areas: FloatArray
    components: Border
    regions: Border


@dataclass(frozen=True, slots=True)
class Summary:
    """Facts about the alpha complex of the whole cloud at one radius.

    Attributes
    ----------
    radius : float
    points : int
        Rows of the cloud, duplicates and all.
    vertices, edges, triangles : int
    singular_edges, regular_edges, interior_edges : int
    euler_characteristic : int
    betti : tuple of int
        Components and holes.
    regions : int
        Sets of triangles connected by edges.
    area, perimeter : float
        Of the triangles, in (squared) units of the points.
    """

    radius: float
    points: int
    vertices: int
    edges: int
    triangles: int
    singular_edges: int
    regular_edges: int
    interior_edges: int
    euler_characteristic: int
    betti: tuple[int, int]
    regions: int
    area: float
    perimeter: float


def part_of(piece: Piece) -> Part:
    """Return what the whole needs to know of a piece."""
    return Part(
        len(piece.rows),
        read_only(np.array([len(rows) for rows in piece.simplices])),
        read_only(np.bincount(piece.edge_kinds, minlength=len(SimplexKind))),
        piece.perimeter,
        piece.region_areas,
        piece.components,
        piece.regions,
    )


def merge(parts: Sequence[Part], radius: float) -> tuple[Summary, list[IntArray], FloatArray]:
    """Put the parts of all tiles together.

    Parameters
    ----------
    parts : sequence of Part
        One for each tile, in their order.
    radius : float

    Returns
    -------
    summary : Summary
    region_labels : list of (r_i,) int32
        For each tile, which region of the whole each of its regions is; the largest is 0.
    region_areas : (r,) float64
        Descending.

    Notes
    -----
    In the plane there are no voids, so that the Euler number is components minus holes.
    """
    vertices, edges, triangles = np.sum([part.counts for part in parts], axis=0).tolist()
    kinds = np.sum([part.edge_kinds for part in parts], axis=0).tolist()
    components, _ = join([part.components for part in parts])
    regions, labels = join([part.regions for part in parts])
    areas = np.zeros(regions)
    for part, label in zip(parts, labels, strict=True):
        np.add.at(areas, label, part.region_areas)
    order = np.argsort(-areas, kind="stable")
    ranks = np.empty(regions, dtype=np.int32)
    ranks[order] = np.arange(regions, dtype=np.int32)
    euler = vertices - edges + triangles
    summary = Summary(
        radius=radius,
        points=sum(part.points for part in parts),
        vertices=vertices,
        edges=edges,
        triangles=triangles,
        singular_edges=kinds[SimplexKind.SINGULAR],
        regular_edges=kinds[SimplexKind.REGULAR],
        interior_edges=kinds[SimplexKind.INTERIOR],
        euler_characteristic=euler,
        betti=(components, components - euler),
        regions=regions,
        area=math.fsum(area for part in parts for area in part.region_areas.tolist()),
        perimeter=math.fsum(part.perimeter for part in parts),
    )
    return summary, [ranks.take(label) for label in labels], read_only(areas.take(order))


def outline(boundaries: Sequence[Boundary], region_labels: Sequence[IntArray]) -> Rings:
    """Trace the rings around the regions of the whole.

    Parameters
    ----------
    boundaries : sequence of Boundary
        One for each tile.
    region_labels : sequence of (r_i,) int32
        From :func:`merge`.

    Returns
    -------
    Rings
        Over the corners of boundary edges and of the triangles at them; `edges` counts
        boundary edges.
    """
    rows = np.concatenate([np.column_stack((b.edges, b.apexes)) for b in boundaries])
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
