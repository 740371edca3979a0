"""One tile's share of an alpha complex: plain arrays in, plain arrays out."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from alphamesh._arrays import Record, read_only
from alphamesh._kernels import BadCoordinates
from alphamesh._kernels.tiles import tile2, tile_share3
from alphamesh.filtration import filtration
from alphamesh.filtration3d import Filtration3D
from alphamesh.measures import total_length, triangle_areas
from alphamesh.points import coordinate_error
from alphamesh.tiles.fronts import FRAME, with_frame
from alphamesh.tiles.labels import Border
from alphamesh.tiles.tiling import Tiling, halo_width

if TYPE_CHECKING:
    from alphamesh._arrays import CountArray, FloatArray, IntArray, KindArray
    from alphamesh._kernels import Progress

__all__ = ["Boundary", "Piece", "solve"]


@dataclass(frozen=True, eq=False, repr=False)
class Boundary(Record):
    """Boundary facets, each with the cell that it bounds.

    Attributes
    ----------
    facets : (b, d) int64
        Rows of the whole cloud. Edges have the shape on their left; triangles run
        counter-clockwise as seen from outside.
    apexes : (b,) int64
        The last corner of the cell.
    points : (b, d + 1, d) float64
        Coordinates of the facet and the apex.
    regions : (b,) int32
        Number of the region among those that the tile knows.
    """

    facets: CountArray
    apexes: CountArray
    points: FloatArray
    regions: IntArray


@dataclass(frozen=True, eq=False, repr=False)
class Piece(Record):
    """The simplices that one tile owns, in rows of the whole cloud.

    A simplex belongs to the tile of its lexicographically first vertex. Cells are
    triangles in the plane, tetrahedra in space; facets are their faces.

    Attributes
    ----------
    tile : int
    rows : (n,) int64
        The tile's own points, ascending. All rows of the cloud are int32 instead if those
        given to :func:`solve` are.
    points : (n, d) float64
    representative : (n,) int64
        The lowest row with the same coordinates.
    simplices : tuple of (m_k, k + 1) int64
        Vertices, edges, triangles (and tetrahedra), ascending within a simplex.
    radii : tuple of (m_k,) float64
        Their filtration values, at most the radius.
    facet_kinds : (m_(d-1),) int8
        :class:`~alphamesh.classify.SimplexKind` of each facet at the radius.
    boundary : Boundary
        Of the cells, as far as the tile owns the facets.
    boundary_size : float
        Length or area of the boundary.
    region_sizes : (r,) float64
        Area or volume of the cells that the tile owns, for each region that it knows.
    components, regions, fronts : Border
        How what the tile knows hangs together: vertices by edges, cells by facets, and
        in space the parts of the complement around vertices (see
        :mod:`alphamesh.tiles.fronts`); in the plane these are none.
    """

    tile: int
    rows: CountArray
    points: FloatArray
    representative: CountArray
    simplices: tuple[CountArray, ...]
    radii: tuple[FloatArray, ...]
    facet_kinds: KindArray
    boundary: Boundary
    boundary_size: float
    region_sizes: FloatArray
    components: Border
    regions: Border
    fronts: Border

    def __repr__(self) -> str:
        counts = ", ".join(f"{len(rows):,}" for rows in self.simplices)
        return f"<Piece: tile {self.tile}, {counts} simplices>"


def solve(  # noqa: PLR0913 (a tile, its points and the radius)
    tiling: Tiling,
    tile: int,
    rows: CountArray,
    points: FloatArray,
    radius: float,
    *,
    threads: int | None = 1,
    progress: Progress | None = None,
) -> Piece:
    """Compute the simplices of value at most `radius` that one tile owns.

    They are those of the whole cloud, and their values the same to the last bit: what
    decides upon them is within the halo, and ties between cocircular or cospherical
    points are broken by their coordinates alone.

    Parameters
    ----------
    tiling : Tiling
    tile : int
    rows : (n,) int64 or int32
        Rows in the whole cloud, ascending: of the tile and its halo.
    points : (n, d) float64
    radius : float
        Finite.
    threads : int, optional
    progress : callable, optional

    Returns
    -------
    Piece
    """
    bounds = tiling.bounds(tile, radius)
    solved = _in_space if tiling.dimension == 3 else _in_plane
    return solved(tile, rows, points, bounds, radius, threads, progress)


def _in_plane(  # noqa: PLR0913, PLR0917 (see solve)
    tile: int,
    rows: CountArray,
    points: FloatArray,
    bounds: FloatArray,
    radius: float,
    threads: int | None,
    progress: Progress | None,
) -> Piece:
    try:
        share = tile2(points, rows, bounds, radius, threads, progress)
    except BadCoordinates:
        raise coordinate_error(points) from None
    edges = share.boundary[:, :2]
    return Piece(
        tile,
        *share.own,
        (share.vertices[:, np.newaxis], share.edges, share.triangles),
        (read_only(np.zeros(len(share.vertices))), share.edge_radii, share.triangle_radii),
        share.edge_kinds,
        Boundary(
            read_only(rows.take(edges)),
            read_only(rows.take(share.boundary[:, 2])),
            read_only(points.take(share.boundary, axis=0)),
            share.boundary_regions,
        ),
        total_length(points, edges),
        share.region_sizes,
        Border(*share.components),
        Border(*share.regions),
        Border(0, np.empty((0, 4), dtype=np.int64), np.empty(0, dtype=np.int64)),
    )


def _in_space(  # noqa: PLR0913, PLR0917 (see solve)
    tile: int,
    rows: CountArray,
    points: FloatArray,
    bounds: FloatArray,
    radius: float,
    threads: int | None,
    progress: Progress | None,
) -> Piece:
    # Too far away to matter, except for what is outside.
    framed = with_frame(points, halo_width(radius))
    frame = np.full(FRAME, np.iinfo(rows.dtype).max, dtype=rows.dtype)
    found = filtration(framed, threads=threads, progress=progress)
    assert isinstance(found, Filtration3D)
    share = tile_share3(
        found.points,
        len(points),
        np.append(rows, frame),
        found.representative,
        found.simplices,
        found.radii,
        found.triangle_tetrahedra,
        bounds,
        radius,
        progress,
    )
    facets = share.boundary[:, :3]
    return Piece(
        tile,
        *share.own,
        (share.vertices[:, np.newaxis], share.edges, share.triangles, share.tetrahedra),
        (
            read_only(np.zeros(len(share.vertices))),
            share.edge_radii,
            share.triangle_radii,
            share.tetrahedron_radii,
        ),
        share.triangle_kinds,
        Boundary(
            read_only(rows.take(facets)),
            read_only(rows.take(share.boundary[:, 3])),
            read_only(points.take(share.boundary, axis=0)),
            share.boundary_regions,
        ),
        float(triangle_areas(points, facets).sum()),
        share.region_sizes,
        Border(*share.components),
        Border(*share.regions),
        Border(*share.fronts),
    )
