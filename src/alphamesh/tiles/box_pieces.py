"""One tile's share of a periodic box: plain arrays in, plain arrays out."""

from __future__ import annotations

from dataclasses import replace
from itertools import product
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from alphamesh._arrays import read_only
from alphamesh._kernels.periodic import periodic_complex, periodic_star
from alphamesh._weights import shifted_radii, signed_root
from alphamesh.errors import ParameterError
from alphamesh.measures import edge_lengths, tetrahedron_volumes, triangle_areas
from alphamesh.periodic import box_cloud, wrapped_points
from alphamesh.tiles.box_fronts import Solid, box_fronts, orientations
from alphamesh.tiles.boxes import Periods, check_box, closed_box, reach_in_box
from alphamesh.tiles.fronts import FRAME
from alphamesh.tiles.labels import Border, labels_of
from alphamesh.tiles.pieces import Boundary, Piece
from alphamesh.tiles.tiling import halo_width
from alphamesh.tiles.weighing import limits_of

if TYPE_CHECKING:
    from alphamesh._arrays import BoolArray, CountArray, FloatArray, IntArray, KindArray
    from alphamesh._kernels import Progress
    from alphamesh._kernels.periodic import Layer
    from alphamesh.periodic import BoxCloud
    from alphamesh.tiles.tiling import Tiling
    from alphamesh.tiles.weighing import WeightRange

__all__ = ["solve_in_box"]


class _Known(NamedTuple):
    """What a tile knows: sites are points that stand for themselves, the tile's own first."""

    rows: CountArray
    """of the points, in the whole cloud, ascending"""
    own: BoolArray
    """of the points: in the tile"""
    near: BoolArray
    """of the points: other tiles may know them"""
    box: BoxCloud | None
    """None if there are no points"""
    moves: KindArray
    """of the points"""
    places: FloatArray
    """of the points, where they are moved to, rounded"""
    radius: float


def solve_in_box(  # noqa: PLR0913, PLR0917 (a tile, its points, the box and the radius)
    tiling: Tiling,
    tile: int,
    rows: CountArray,
    points: FloatArray,
    moves: KindArray,
    periods: Periods,
    radius: float,
    *,
    weights: FloatArray | None = None,
    weight_range: WeightRange | None = None,
    threads: int | None = 1,
    progress: Progress | None = None,
) -> Piece:
    """Compute the simplices of value at most `radius` that one tile of a box owns.

    They are those of :func:`alphamesh.periodic.periodic_filtration`, with the same offsets
    and, to the last bit, the same values.

    Parameters
    ----------
    tiling : Tiling
        From :func:`plan_in_box`.
    tile : int
    rows : (n,) int64 or int32
        Rows in the whole cloud, in any order, none twice: of the tile and its halo.
    points : (n, d) float64
        As they come.
    moves : (n, d) int8
        From :func:`spread_in_box`.
    periods : tuple of float or None
    radius : float
    weights, weight_range, threads, progress : optional
        See :func:`alphamesh.tiles.solve`.

    Returns
    -------
    Piece
        Its points are their places in the box. There is no boundary, but its size.

    Raises
    ------
    WeightsError
        If weights come without their range, or do not lie in it.
    PeriodsError
        If the box is too small for the radius.
    ParameterError
        If the tile is wider than those of :func:`plan_in_box`.
    """
    reach, plain = limits_of(radius, weights, weight_range)
    check_box(periods, reach)
    order = np.argsort(rows, kind="stable")
    rows, points, moves = rows.take(order), points.take(order, 0), moves.take(order, 0)
    if (rows[1:] == rows[:-1]).any():
        raise ParameterError(
            "the tile is so wide that it knows a point twice; make tiles with plan_in_box()"
        )
    heavy = None if weights is None else weights.take(order)
    known = _known(
        tiling, tile, rows, points, moves, periods, reach,
        heavy if plain is None else None, radius if plain is None else plain,
    )  # fmt: skip
    piece = _piece(tile, known, wrapped_points(points, periods), threads, progress)
    if heavy is None or weight_range is None:
        return piece
    if plain is not None:
        equal = weight_range.greatest
        radii = tuple(shifted_radii(values, equal) for values in piece.radii)
        piece = replace(piece, radii=radii)
    return replace(piece, weights=read_only(heavy.compress(known.own[: len(heavy)])))


def _known(  # noqa: PLR0913, PLR0917 (see solve_in_box)
    tiling: Tiling,
    tile: int,
    rows: CountArray,
    points: FloatArray,
    moves: KindArray,
    periods: Periods,
    reach: float,
    weights: FloatArray | None,
    radius: float,
) -> _Known:
    places = wrapped_points(points, periods)
    low, high = tiling.boxes[tile]
    own = ((places >= low) & (places < high) & (moves == 0)).all(axis=1)
    # Those near to any border of the tile, where others may know them.
    ends = closed_box(tiling.boxes[tile], periods)
    inner = tiling.bounds_of(ends, reach_in_box(reach, periods))[2:]
    near = ~own | ((places <= inner[0]) | (places >= inner[1])).any(axis=1)
    sides = np.array([0.0 if side is None else side for side in periods])
    box = box_cloud(points, periods, weights) if len(points) else None
    known = _Known(rows, own, near, box, moves, places + moves * sides, radius)
    return known if box is None or tiling.dimension == 2 else _framed(known, box, reach)


def _framed(known: _Known, box: BoxCloud, reach: float) -> _Known:
    """Return the same with the corners of a box far around; they are no points of the cloud.

    With these, tetrahedra fill a neighbourhood of each point.
    """
    most = float(max(np.abs(box.anchors).max(), 2 * box.periods.max(), box.unit))
    most = max(most, float(np.ldexp(halo_width(reach), box.exponent)))
    # A power of two rounds nothing, and is a multiple of the unit.
    far = float(np.ldexp(1.0, int(np.frexp(most)[1]) + 2))
    corners = far * np.array(list(product((-1.0, 1.0), repeat=3)))
    count = len(known.rows)
    weights = box.weights
    if weights is not None:  # no heavier than the others
        weights = np.append(weights, np.full(FRAME, weights.min()))
    numbers = np.arange(count, count + FRAME, dtype=np.int32)
    framed = replace(
        box,
        anchors=np.concatenate((box.anchors, corners)),
        shifts=np.concatenate((box.shifts, np.zeros((FRAME, 3), dtype=np.int8))),
        representative=np.append(box.representative, numbers),
        weights=weights,
    )
    nothing = np.zeros(FRAME, dtype=bool)
    return known._replace(
        rows=np.append(known.rows, np.full(FRAME, np.iinfo(known.rows.dtype).max)).astype(
            known.rows.dtype
        ),
        own=np.append(known.own, nothing),
        near=np.append(known.near, nothing),
        box=framed,
        moves=np.concatenate((known.moves, np.zeros((FRAME, 3), dtype=np.int8))),
        places=np.concatenate((known.places, np.ldexp(corners, -box.exponent))),
    )


class _Layers(NamedTuple):
    """Simplices by dimension, in numbers of points, with offsets and radii."""

    simplices: list[IntArray]
    offsets: list[KindArray]
    radii: list[FloatArray]
    cofaces: IntArray
    solid: Solid | None
    """in space"""


def _layers(known: _Known, threads: int | None, progress: Progress | None) -> _Layers:
    """Return the simplices at the points of the tile, and others that are not right."""
    d = known.places.shape[1]
    made = _Layers(
        [np.empty((0, k + 1), dtype=np.int32) for k in range(d + 1)],
        [np.empty((0, k + 1, d), dtype=np.int8) for k in range(d + 1)],
        [np.empty(0) for _ in range(d + 1)],
        np.empty((0, 2), dtype=np.int32),
        None,
    )
    if known.box is None or not known.own.any():
        return made
    box, own = known.box, known.own.take(known.box.rows)
    sites = np.concatenate((box.rows.compress(own), box.rows.compress(~own)))
    moves = np.zeros((len(sites), 3), dtype=np.int8)
    moves[:, :d] = known.moves.take(sites, axis=0)
    copies = box.moved(sites, moves)
    weights = np.zeros(len(sites)) if box.weights is None else box.weights.take(sites)
    base = int(np.count_nonzero(own))
    star = periodic_star(copies.high, copies.low, weights, box.unit, base, progress)
    if star.dimension == 0:
        return _alone(made, box, int(sites[0]))
    # No point comes twice, so that each cell is met once: all count as in the box.
    layers, cofaces = periodic_complex(
        copies.rows, copies.offsets, len(sites), star.cells, box.anchors, box.shifts,
        box.weights, box.periods, box.exponent, threads,
    )  # fmt: skip
    for k, layer in enumerate(layers):
        made.simplices[k] = layer.rows
        made.offsets[k] = layer.offsets[:, :, :d]
        made.radii[k] = layer.radii
    if star.dimension < d:
        return made
    solid = None if d == 2 else _solid(layers, cofaces, copies.rows.take(star.cells))
    return made._replace(cofaces=cofaces, solid=solid)


def _alone(made: _Layers, box: BoxCloud, point: int) -> _Layers:
    """Return the layers of a single point of the plane, whose neighbours are all far away."""
    made.simplices[0] = np.array([[point]], dtype=np.int32)
    made.offsets[0] = np.zeros((1, 1, 2), dtype=np.int8)
    value = 0.0
    if box.weights is not None:
        value = -float(np.ldexp(box.weights[point], -2 * box.exponent))
    made.radii[0] = signed_root(np.array([value]))
    return made


def _solid(layers: list[Layer], cofaces: IntArray, cells: IntArray) -> Solid:
    """Return the tetrahedra and their faces; `cells` are the same, positively oriented."""
    _, edges, triangles, tetrahedra = layers
    return Solid(
        edges.rows,
        triangles.rows,
        tetrahedra.rows,
        triangles.faces,
        tetrahedra.faces,
        cofaces,
        orientations(cells, tetrahedra.rows),
        (edges.radii, triangles.radii, tetrahedra.radii),
    )


def _piece(
    tile: int,
    known: _Known,
    places: FloatArray,
    threads: int | None,
    progress: Progress | None,
) -> Piece:
    rows, own = known.rows, known.own
    layers, d = _layers(known, threads, progress), places.shape[1]
    mine = [
        (values <= known.radius) & own.take(simplices[:, 0])
        for values, simplices in zip(layers.radii, layers.simplices, strict=True)
    ]
    cells = _cells_at(layers, mine[d - 1], known.radius)
    beside = np.count_nonzero(cells >= 0, axis=1)
    border = layers.simplices[d - 1].compress(mine[d - 1], axis=0).compress(beside == 1, axis=0)
    regions, region_sizes = _regions(known, layers, mine[d], cells)
    representative = np.arange(len(rows)) if known.box is None else known.box.representative
    return Piece(
        tile=tile,
        rows=read_only(rows.compress(own)),
        points=read_only(places.compress(own[: len(places)], axis=0)),
        representative=read_only(rows.take(representative.compress(own))),
        simplices=tuple(read_only(rows.take(found)) for found in _kept(layers.simplices, mine)),
        radii=tuple(_kept(layers.radii, mine)),
        facet_kinds=read_only((1 + beside).astype(np.int8)),
        boundary=_no_boundary(d, rows.dtype),
        boundary_size=float(_sizes(known.places, border).sum()),
        region_sizes=region_sizes,
        components=_components(known, layers, mine),
        regions=regions,
        fronts=_fronts(known, layers, mine[0]),
        offsets=tuple(_kept(layers.offsets, mine)),
    )


def _fronts(known: _Known, layers: _Layers, mine: BoolArray) -> Border:
    """Return the parts of the complement around the tile's vertices; none in the plane."""
    if layers.solid is None:
        nothing = np.empty((0, 4), dtype=known.rows.dtype)
        return Border(0, nothing, np.empty(0, dtype=np.int32))
    there = np.zeros(len(known.rows), dtype=bool)
    there[layers.simplices[0].compress(mine, axis=0)] = True
    return box_fronts(layers.solid, known.rows, known.own, there, known.radius)


def _kept(arrays: list[Any], kept: list[BoolArray]) -> list[Any]:
    return [
        read_only(array.compress(keep, axis=0))
        for array, keep in zip(arrays, kept, strict=True)
    ]


def _cells_at(layers: _Layers, facets: BoolArray, radius: float) -> IntArray:
    """Return the two cells of each of some facets, -1 for what is not there at the radius."""
    if not len(layers.cofaces):
        return np.full((np.count_nonzero(facets), 2), -1, dtype=np.int32)
    cells = layers.cofaces.compress(facets, axis=0)
    there = (cells >= 0) & (layers.radii[-1] <= radius).take(cells, mode="clip")
    return np.where(there, cells, np.int32(-1))


def _sizes(places: FloatArray, simplices: IntArray) -> FloatArray:
    """Return lengths, areas or volumes."""
    measured: dict[int, Any] = {2: edge_lengths, 3: triangle_areas, 4: tetrahedron_volumes}
    sizes: FloatArray = measured[simplices.shape[1]](places, simplices)
    return sizes


def _no_boundary(d: int, dtype: Any) -> Boundary:
    return Boundary(
        np.empty((0, d), dtype=dtype),
        np.empty(0, dtype=dtype),
        np.empty((0, d + 1, d)),
        np.empty(0, dtype=np.int32),
    )


def _components(known: _Known, layers: _Layers, mine: list[BoolArray]) -> Border:
    """Return how the vertices that the tile knows hang together by its edges."""
    edges = layers.simplices[1].compress(mine[1], axis=0)
    seen = np.zeros(len(known.rows), dtype=bool)
    seen[layers.simplices[0].compress(mine[0], axis=0)] = True
    seen[edges] = True
    count, labels = labels_of(edges, seen)
    shared = seen & known.near
    border = _border(count, known.rows.compress(shared)[:, np.newaxis], labels.compress(shared))
    return replace(border, moves=read_only(known.moves.compress(shared, axis=0)))


def _regions(
    known: _Known, layers: _Layers, mine: BoolArray, cells: IntArray
) -> tuple[Border, FloatArray]:
    """Return how the cells that the tile knows hang together, and what it owns of each part."""
    corners = layers.simplices[-1]
    seen = mine.copy()
    seen[cells[cells >= 0]] = True
    count, labels = labels_of(cells.compress((cells >= 0).all(axis=1), axis=0), seen)
    own_sizes = _sizes(known.places, corners.compress(mine, axis=0))
    sizes = np.zeros(count)
    np.add.at(sizes, labels.compress(mine), own_sizes)
    shared = seen & ~known.own.take(corners).all(axis=1)
    keys = known.rows.take(corners.compress(shared, axis=0))
    return _border(count, keys, labels.compress(shared)), read_only(sizes)


def _border(count: int, keys: CountArray, labels: CountArray) -> Border:
    return Border(count, read_only(keys), read_only(labels.astype(np.int32, copy=False)))
