"""One tile's share of an alpha complex: plain arrays in, plain arrays out."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from alphamesh._arrays import Record, read_only
from alphamesh._kernels import orient2
from alphamesh.classify import SimplexKind
from alphamesh.filtration import Filtration, filtration
from alphamesh.measures import scaled_points, total_length
from alphamesh.tiles.labels import Border, border_of
from alphamesh.tiles.tiling import Tiling, halo_width

if TYPE_CHECKING:
    from alphamesh._arrays import BoolArray, CountArray, FloatArray, IntArray, KindArray

__all__ = ["Boundary", "Piece", "solve"]


@dataclass(frozen=True, eq=False, repr=False)
class Boundary(Record):
    """Boundary edges, each with the triangle on its left.

    Attributes
    ----------
    edges : (b, 2) int64
        From and to, as rows of the whole cloud: the shape is on the left.
    apexes : (b,) int64
        The third corner of the triangle.
    points : (b, 3, 2) float64
        Coordinates of from, to and apex.
    regions : (b,) int64
        Number of the region among those that the tile knows.
    """

    edges: CountArray
    apexes: CountArray
    points: FloatArray
    regions: CountArray


@dataclass(frozen=True, eq=False, repr=False)
class Piece(Record):
    """The simplices that one tile owns, in rows of the whole cloud.

    A simplex belongs to the tile of its lexicographically first vertex.

    Attributes
    ----------
    tile : int
    rows : (n,) int64
        The tile's own points, ascending.
    points : (n, 2) float64
    representative : (n,) int64
        The lowest row with the same coordinates.
    simplices : tuple of (m_k, k + 1) int64
        Vertices, edges and triangles, ascending within a simplex.
    radii : tuple of (m_k,) float64
        Their filtration values, at most the radius.
    edge_kinds : (m_1,) int8
        :class:`~alphamesh.classify.SimplexKind` of each edge at the radius.
    boundary : Boundary
        Of the triangles, as far as the tile owns the edges.
    perimeter : float
        Length of the boundary.
    region_areas : (r,) float64
        Area of the triangles that the tile owns, for each region that it knows.
    components, regions : Border
        How what the tile knows hangs together: vertices by edges, triangles by edges.
    """

    tile: int
    rows: CountArray
    points: FloatArray
    representative: CountArray
    simplices: tuple[CountArray, ...]
    radii: tuple[FloatArray, ...]
    edge_kinds: KindArray
    boundary: Boundary
    perimeter: float
    region_areas: FloatArray
    components: Border
    regions: Border

    def __repr__(self) -> str:
        vertices, edges, triangles = (f"{len(rows):,}" for rows in self.simplices)
        return (
            f"<Piece: tile {self.tile}, {vertices} vertices, {edges} edges, "
            f"{triangles} triangles>"
        )


def solve(  # noqa: PLR0913 (a tile, its points and the radius)
    tiling: Tiling,
    tile: int,
    rows: CountArray,
    points: FloatArray,
    radius: float,
    *,
    threads: int | None = 1,
) -> Piece:
    """Compute the simplices of value at most `radius` that one tile owns.

    They are those of the whole cloud, and their values the same to the last bit: what
    decides upon them is within the halo, and ties between cocircular points are broken
    by their coordinates alone.

    Parameters
    ----------
    tiling : Tiling
    tile : int
    rows : (n,) int64
        Rows in the whole cloud, ascending: of the tile and its halo.
    points : (n, 2) float64
    radius : float
        Finite.
    threads : int, optional

    Returns
    -------
    Piece
    """
    found = filtration(points, threads=threads)
    share = _Share(found, tiling, tile, radius)
    triples, cells = share.boundary()
    components = share.components(rows)
    region_labels, regions = share.regions(rows)
    local = np.flatnonzero(share.inside)
    return Piece(
        tile,
        read_only(rows.take(local)),
        read_only(found.points.take(local, axis=0)),
        read_only(rows.take(found.representative.take(local))),
        tuple(
            read_only(rows.take(simplices.take(kept, axis=0)))
            for simplices, kept in zip(found.simplices, share.mine, strict=True)
        ),
        tuple(
            read_only(radii.take(kept))
            for radii, kept in zip(found.radii, share.mine, strict=True)
        ),
        share.edge_kinds,
        Boundary(
            read_only(rows.take(triples[:, :2])),
            read_only(rows.take(triples[:, 2])),
            read_only(found.points.take(triples, axis=0)),
            read_only(region_labels.take(cells)),
        ),
        total_length(found.points, triples[:, :2]),
        share.region_areas(region_labels, regions.count),
        components,
        regions,
    )


class _Share:
    """The filtration of a tile with its halo, and which of its simplices are the tile's."""

    def __init__(self, found: Filtration, tiling: Tiling, tile: int, radius: float) -> None:
        self.found = found
        self.radius = radius
        self.inside = tiling.tile_of(found.points) == tile
        self.near = _near_border(found.points, tiling.boxes[tile], halo_width(radius))
        self.mine = tuple(
            np.flatnonzero(
                (radii <= radius) & self.inside.take(_first(found.points, simplices))
            )
            for simplices, radii in zip(found.simplices, found.radii, strict=True)
        )
        # One more entry, which row -1 reads: no triangle.
        self.has_triangle = np.append(found.radii[2] <= radius, False)
        cofaces = found.edge_triangles.take(self.mine[1], axis=0)
        self.coface_there = self.has_triangle.take(cofaces)
        self.cofaces = cofaces
        kinds = SimplexKind.SINGULAR + self.coface_there.sum(axis=1, dtype=np.int8)
        self.edge_kinds: KindArray = read_only(kinds.astype(np.int8))

    def boundary(self) -> tuple[IntArray, CountArray]:
        """Return the tile's boundary, and the triangle at each edge.

        The boundary is ``(b, 3)``: from, to, with the shape on the left, and the third
        corner of the triangle there.
        """
        regular = self.edge_kinds == SimplexKind.REGULAR
        there, cofaces = (
            array.compress(regular, axis=0) for array in (self.coface_there, self.cofaces)
        )
        cells = np.where(there[:, 0], cofaces[:, 0], cofaces[:, 1]).astype(np.int64)
        edges = self.found.simplices[1].take(self.mine[1].compress(regular), axis=0)
        # The corner that is neither end; rows are small enough for their sums.
        corners = self.found.simplices[2].take(cells, axis=0)
        apexes = corners.sum(axis=1, dtype=np.int64) - edges.sum(axis=1, dtype=np.int64)
        triples = np.column_stack((edges, apexes)).astype(np.int32)
        points, _ = scaled_points(self.found.points)
        right = orient2(points.take(triples, axis=0)) < 0
        triples[right, :2] = triples[right, 1::-1]
        return triples, cells

    def components(self, rows: CountArray) -> Border:
        """Divide the vertices that the tile knows by its edges."""
        own, edges, _ = self.mine
        ends = self.found.simplices[1].take(edges, axis=0)
        known = np.zeros(len(self.found.points), dtype=np.bool_)
        known[self.found.simplices[0][own, 0]] = True
        known[ends] = True
        place = np.cumsum(known) - 1
        vertices = np.flatnonzero(known)
        shared = ~self.inside.take(vertices) | self.near.take(vertices)
        return border_of(rows.take(vertices)[:, np.newaxis], place.take(ends), shared)[1]

    def regions(self, rows: CountArray) -> tuple[CountArray, Border]:
        """Divide the triangles that the tile knows by its edges; -1 for the others."""
        both = self.coface_there.all(axis=1)
        links = self.cofaces.compress(both, axis=0)
        known = np.zeros(len(self.found.simplices[2]), dtype=np.bool_)
        known[self.mine[2]] = True
        known[self.cofaces[self.coface_there]] = True
        place = np.cumsum(known) - 1
        triangles = np.flatnonzero(known)
        corners = self.found.simplices[2].take(triangles, axis=0)
        shared = ~self.inside.take(corners).all(axis=1)
        labels, border = border_of(rows.take(corners), place.take(links), shared)
        everywhere = np.full(len(known), -1, dtype=np.int64)
        everywhere[triangles] = labels
        return everywhere, border

    def region_areas(self, labels: CountArray, count: int) -> FloatArray:
        """Return the area of the tile's triangles for each region."""
        triangles = self.mine[2]
        areas = self.found.triangle_areas.take(triangles)
        sums = np.bincount(labels.take(triangles), areas, count)
        return read_only(np.asarray(sums, dtype=np.float64))


def _first(points: FloatArray, simplices: IntArray) -> IntArray:
    """Return the lexicographically first vertex of each simplex."""
    x = np.ascontiguousarray(points[:, 0])
    first, least = simplices[:, 0].copy(), x.take(simplices[:, 0])
    for other in simplices.T[1:]:
        its = x.take(other)
        less = its < least
        tied = np.flatnonzero(its == least)
        mine, theirs = (points.take(rows.take(tied), axis=0) for rows in (first, other))
        less[tied] = theirs[:, 1] < mine[:, 1]
        np.copyto(first, other, where=less)
        np.copyto(least, its, where=less)
    return first


def _near_border(points: FloatArray, box: FloatArray, width: float) -> BoolArray:
    """Return which points lie so near to the border of a box that other tiles see them."""
    low = points <= np.nextafter(box[0] + width, np.inf)
    high = points >= np.nextafter(box[1] - width, -np.inf)
    near: BoolArray = (low | high).any(axis=1)
    return near
