"""One tile's share of an alpha complex: plain arrays in, plain arrays out."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from alphamesh._arrays import Record, read_only
from alphamesh._kernels import BadCoordinates
from alphamesh._kernels.tiles import tile2, tile_share3
from alphamesh._kernels.weighted import regular3
from alphamesh._weights import shifted_radii
from alphamesh.filtration import filtration
from alphamesh.filtration3d import Filtration3D
from alphamesh.measures import total_length, triangle_areas
from alphamesh.points import births_of_rows, coordinate_error, merged_rows
from alphamesh.tiles.fronts import FRAME, with_frame
from alphamesh.tiles.labels import Border
from alphamesh.tiles.tiling import Tiling, halo_width
from alphamesh.tiles.weighing import limits_of

if TYPE_CHECKING:
    from alphamesh._arrays import CountArray, FloatArray, IntArray, KindArray
    from alphamesh._kernels import Progress
    from alphamesh._kernels.tiles import Share2, Share3
    from alphamesh.tiles.weighing import WeightRange

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
        The lowest row with the same coordinates; with weights, the lowest of the heaviest.
    simplices : tuple of (m_k, k + 1) int64
        Vertices, edges, triangles (and tetrahedra), ascending within a simplex. With
        weights, points that are hidden or come later than the radius are no vertices.
    radii : tuple of (m_k,) float64
        Their filtration values, at most the radius; see :class:`alphamesh.Filtration`.
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
    weights : (n,) float64 or None
        Those of `points`.
    offsets : tuple of (m_k, k + 1, d) int8, or None
        In a periodic box: how many periods each vertex lies from its place there, see
        :class:`alphamesh.PeriodicComplex`.
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
    weights: FloatArray | None = None
    offsets: tuple[KindArray, ...] | None = None

    def __repr__(self) -> str:
        counts = ", ".join(f"{len(rows):,}" for rows in self.simplices)
        return f"<Piece: tile {self.tile}, {counts} simplices>"


class _Known(NamedTuple):
    """What a tile knows: its points and those of its halo, the box, and up to where to go."""

    rows: CountArray
    points: FloatArray
    weights: FloatArray | None
    """None if balls are of equal size in the whole cloud"""
    bounds: FloatArray
    reach: float
    radius: float
    """of the complex without weights if all are equal"""
    threads: int | None
    progress: Progress | None


def solve(  # noqa: PLR0913 (a tile, its points and the radius)
    tiling: Tiling,
    tile: int,
    rows: CountArray,
    points: FloatArray,
    radius: float,
    *,
    weights: FloatArray | None = None,
    weight_range: WeightRange | None = None,
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
        Rows in the whole cloud, ascending: of the tile and its halo, which is twice as wide
        as `radius`, or with weights as ``weight_range.reach(radius)``.
    points : (n, d) float64
    radius : float
        Finite; with weights a signed root of a power value, see
        :class:`alphamesh.Filtration`.
    weights : (n,) float64, optional
        Squared radii of balls.
    weight_range : WeightRange, optional
        Of the whole cloud; needed with `weights`.
    threads : int, optional
    progress : callable, optional

    Returns
    -------
    Piece

    Raises
    ------
    WeightsError
        If weights come without their range, or do not lie in it.
    """
    reach, plain = limits_of(radius, weights, weight_range)
    known = _Known(
        rows,
        points,
        weights if plain is None else None,
        tiling.bounds(tile, reach),
        reach,
        radius if plain is None else plain,
        threads,
        progress,
    )
    solved = _in_space if tiling.dimension == 3 else _in_plane
    fields = solved(known)
    own_rows = fields["rows"]
    weight = None
    if weights is not None and weight_range is not None:
        weight = read_only(weights.take(np.searchsorted(rows, own_rows)))
        if plain is not None:
            equal = weight_range.greatest
            fields["radii"] = tuple(shifted_radii(r, equal) for r in fields["radii"])
    return Piece(tile=tile, weights=weight, **fields)


def _in_plane(known: _Known) -> dict[str, Any]:
    rows, points, weights, bounds, _, radius, threads, progress = known
    try:
        share = tile2(points, rows, bounds, radius, threads, progress, weights)
    except BadCoordinates:
        raise coordinate_error(points, weights) from None
    simplices = share.edges, share.triangles
    radii = share.edge_radii, share.triangle_radii
    nothing = Border(0, np.empty((0, 4), dtype=np.int64), np.empty(0, dtype=np.int64))
    return _fields(known, share, simplices, radii) | {
        "facet_kinds": share.edge_kinds,
        "boundary_size": total_length(points, share.boundary[:, :2]),
        "fronts": nothing,
    }


def _in_space(known: _Known) -> dict[str, Any]:
    rows, points, _, bounds, reach, radius, _, progress = known
    # Too far away to matter, except for what is outside.
    framed = with_frame(points, halo_width(reach))
    frame = np.full(FRAME, np.iinfo(rows.dtype).max, dtype=rows.dtype)
    representative, simplices, radii, cofaces, births = _filtered(known, framed)
    share = tile_share3(
        framed,
        len(points),
        np.append(rows, frame),
        representative,
        simplices,
        radii,
        cofaces,
        bounds,
        radius,
        progress,
        births,
    )
    own = share.edges, share.triangles, share.tetrahedra
    values = share.edge_radii, share.triangle_radii, share.tetrahedron_radii
    return _fields(known, share, own, values) | {
        "facet_kinds": share.triangle_kinds,
        "boundary_size": float(triangle_areas(points, share.boundary[:, :3]).sum()),
        "fronts": Border(*share.fronts),
    }


def _filtered(known: _Known, framed: FloatArray) -> tuple[Any, ...]:
    """Return representatives, simplices, radii and cofaces of framed points, and births."""
    if known.weights is None:
        found = filtration(framed, threads=known.threads, progress=known.progress)
        assert isinstance(found, Filtration3D)
        parts = found.representative, found.simplices, found.radii
        return *parts, found.triangle_tetrahedra, None
    # The corners of the frame are no heavier than the rest, and on the hull: never hidden.
    least = float(known.weights.min(initial=np.inf)) if len(known.weights) else 0.0
    weights = np.append(known.weights, np.full(FRAME, least))
    try:
        merged, _, simplices, radii, cofaces = regular3(
            framed, weights, known.threads, known.progress
        )
    except BadCoordinates:
        raise coordinate_error(framed, weights) from None
    births = births_of_rows(weights, simplices[0].reshape(-1, 1), radii[0], len(framed))
    return merged_rows(merged, len(framed))[0], simplices, radii, cofaces, births


def _fields(
    known: _Known,
    share: Share2 | Share3,
    simplices: tuple[CountArray, ...],
    radii: tuple[FloatArray, ...],
) -> dict[str, Any]:
    """Return what pieces in the plane and in space have in common."""
    own, points, representative = share.own
    first = share.vertex_radii
    if first is None:
        first = read_only(np.zeros(len(share.vertices)))
    boundary = Boundary(
        read_only(known.rows.take(share.boundary[:, :-1])),
        read_only(known.rows.take(share.boundary[:, -1])),
        read_only(known.points.take(share.boundary, axis=0)),
        share.boundary_regions,
    )
    return {
        "rows": own,
        "points": points,
        "representative": representative,
        "simplices": (share.vertices[:, np.newaxis], *simplices),
        "radii": (first, *radii),
        "boundary": boundary,
        "region_sizes": share.region_sizes,
        "components": Border(*share.components),
        "regions": Border(*share.regions),
    }
