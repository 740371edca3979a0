"""Proof that simplices in space are a Delaunay triangulation with all its faces."""

from __future__ import annotations

from itertools import combinations
from typing import TYPE_CHECKING, Any

import numpy as np

from alphamesh._kernels import orient2
from alphamesh._kernels.space import insphere3, orient3
from alphamesh.check._mesh import (
    Mesh,
    check_hull,
    check_regular_path,
    check_representative,
    check_simplices,
    collinear_path,
    partners,
    unit_points,
)
from alphamesh.check._powers import lifted_sides
from alphamesh.check._tools import LongArray, check_table, require, signs
from alphamesh.errors import InvalidResultError

if TYPE_CHECKING:
    from alphamesh._arrays import BoolArray, FloatArray, IntArray, KindArray

__all__ = ["check_complex", "order_of_rows", "require_same_rows"]

_NAMES = ("vertices", "edges", "triangles", "tetrahedra")
_PLANES = ((0, 1), (1, 2), (2, 0))


def check_complex(
    points: FloatArray,
    representative: IntArray,
    simplices: tuple[IntArray, ...],
    weights: FloatArray | None = None,
) -> LongArray:
    """Check that simplices are those of the canonical Delaunay triangulation.

    With weights, of the canonical regular one of the rows that represent themselves. In a
    plane, ties between points without weights may be broken either way.

    Returns
    -------
    (4T,) int64
        The other one of each facet 4t + k, which lies opposite to vertex k of
        tetrahedron t; -1 on the hull.
    """
    if weights is None:
        check_representative(points, representative, 3)
    vertices = np.flatnonzero(representative == np.arange(len(points)))
    for k, rows in enumerate(simplices):
        check_table(rows, (len(rows), k + 1), _NAMES[k])
        check_simplices(rows, representative, _NAMES[k])
    if not np.array_equal(simplices[0][:, 0], vertices):
        raise InvalidResultError("vertices: not the representatives in ascending order")
    for k in (1, 2):
        if len(simplices[k + 1]):
            require_same_rows(simplices[k], faces(simplices[k + 1]), f"{_NAMES[k]}: not those")
    unit, exponent = unit_points(points)
    masses = None if weights is None else np.ldexp(weights, -2 * exponent)
    dimension = max((k for k in range(4) if len(simplices[k])), default=-1)
    if dimension >= 1:
        used = np.zeros(len(points), dtype=bool)
        used[simplices[dimension]] = True
        require(used[vertices], f"points: in none of the {_NAMES[dimension]}", vertices)
    if dimension == 3:
        return _check_solid(unit, simplices, masses)
    if dimension == 2:
        _check_sheet(unit, vertices, simplices[2], masses)
    else:
        _check_path(unit, vertices, simplices[1])
        if masses is not None:
            check_regular_path(unit, masses, vertices)
    return np.empty(0, dtype=np.int64)


def faces(simplices: IntArray) -> IntArray:
    """Return the faces of each simplex, the one opposite to its first vertex first."""
    size = simplices.shape[1]
    columns = [[i for i in range(size) if i != k] for k in range(size)]
    return simplices[:, columns].reshape(-1, size - 1)


def order_of_rows(rows: Any) -> LongArray:
    """Return the order in which rows are lexicographically sorted."""
    return np.lexsort(rows.T[::-1])


def require_same_rows(rows: IntArray, expected: IntArray, problem: str) -> LongArray:
    """Raise unless `rows` holds each row of `expected` once; return the row of each of them."""
    order, where = order_of_rows(rows), order_of_rows(expected)
    wanted = expected[where]
    first = np.append(True, (wanted[1:] != wanted[:-1]).any(axis=1))[: len(wanted)]
    distinct = wanted[first]
    if len(distinct) != len(rows):
        raise InvalidResultError(f"{problem} ({len(rows)} rows in place of {len(distinct)})")
    require((rows[order] == distinct).all(axis=1), problem, order)
    found = np.empty(len(expected), dtype=np.int64)
    found[where] = order[np.cumsum(first) - 1]
    return found


# ---------------------------------------------------------------------- in space


def _check_solid(
    points: FloatArray, simplices: tuple[IntArray, ...], masses: FloatArray | None
) -> LongArray:
    tetrahedra = simplices[3]
    turns = signs(orient3, points, tetrahedra)
    require(turns != 0, "tetrahedra: flat")
    facets = faces(tetrahedra)
    partner = _partners_of_rows(facets)
    counts = [len(rows) for rows in simplices]
    if counts[0] - counts[1] + counts[2] - counts[3] != 1:
        raise InvalidResultError(
            f"not a ball: {counts[0]} points - {counts[1]} edges + {counts[2]} triangles - "
            f"{counts[3]} tetrahedra must be 1 (Euler)"
        )
    _check_inner_facets((points, masses), tetrahedra, turns, facets, partner)
    # Opposite to vertex k, an ascending row runs outwards if k is even and it is positive.
    hull = np.flatnonzero(partner < 0)
    outward = facets[hull].copy()
    inward = (turns[hull // 4] > 0) != (hull % 2 == 0)
    outward[inward, 1:] = outward[inward, :0:-1]
    _check_convex(points, outward, hull // 4)
    return partner


def _partners_of_rows(rows: IntArray) -> LongArray:
    """Match equal rows; refuse those that come more than twice."""
    order = order_of_rows(rows)
    same = np.flatnonzero((rows[order[1:]] == rows[order[:-1]]).all(axis=1))
    crowded = order[same[1:][np.diff(same) == 1]] // 4
    require(
        ~np.isin(np.arange(len(rows) // 4), crowded),
        "tetrahedra: a triangle in more than two of them",
    )
    partner = np.full(len(rows), -1, dtype=np.int64)
    here, there = order[same], order[same + 1]
    partner[here], partner[there] = there, here
    return partner


def _check_inner_facets(
    balls: tuple[FloatArray, FloatArray | None],
    tetrahedra: IntArray,
    turns: KindArray,
    facets: IntArray,
    partner: LongArray,
) -> None:
    """Check that tetrahedra lie on both sides of a facet and are locally regular."""
    points, masses = balls
    facet = np.flatnonzero(partner > np.arange(len(partner)))
    apex, beyond = tetrahedra.ravel()[facet], tetrahedra.ravel()[partner[facet]]
    side = signs(orient3, points, np.column_stack((facets[facet], apex)))
    across = signs(orient3, points, np.column_stack((facets[facet], beyond)))
    require(side != across, "tetrahedra: folded over their neighbour", facet // 4)
    five = np.column_stack((tetrahedra[facet // 4], beyond))
    if masses is not None:
        outside = lifted_sides((points, masses), five, (0, 1, 2)) < 0
        problem = "tetrahedra: a point inside their power sphere (ties included)"
        require(outside, problem, facet // 4)
        return
    negative = turns[facet // 4] < 0
    five[negative, :2] = five[negative, 1::-1]
    outside = signs(_in_sphere, points, five) < 0
    problem = "tetrahedra: a point inside their circumsphere (ties included)"
    require(outside, problem, facet // 4)


def _in_sphere(corners: FloatArray) -> KindArray:
    return insphere3(corners, perturb=True)


def _check_convex(points: FloatArray, outward: IntArray, owners: LongArray) -> None:
    """Check that triangles are the border of one convex body."""
    start = outward[:, [0, 1, 2]].ravel().astype(np.int64)
    end = outward[:, [1, 2, 0]].ravel().astype(np.int64)
    apex = outward[:, [2, 0, 1]].ravel()
    forward, back = (start << 32) | end, (end << 32) | start
    order, mirror = np.argsort(forward), np.argsort(back)
    if not np.array_equal(forward[order], back[mirror]) or (np.diff(forward[order]) == 0).any():
        raise InvalidResultError("tetrahedra: their border is not a closed surface")
    beyond = np.empty(len(start), dtype=np.int64)
    beyond[order] = apex[mirror]
    quads = np.column_stack((start, end, apex, beyond))
    bend = signs(orient3, points, quads)
    flat = np.flatnonzero(bend == 0)
    good = bend < 0
    good[flat] = _on_both_sides(points, quads[flat])
    require(good, "tetrahedra: the hull is not convex", np.repeat(owners, 3))
    # Each piece of the border has a lexicographically least corner of its own.
    rank = np.empty(len(points), dtype=np.int64)
    rank[order_of_rows(points)] = np.arange(len(points))
    least = np.full(len(points), len(points))
    np.minimum.at(least, start, rank[end])
    if np.count_nonzero(rank[np.unique(start)] < least[np.unique(start)]) != 1:
        raise InvalidResultError("tetrahedra: the hull is not one surface")


def _on_both_sides(points: FloatArray, quads: Any) -> BoolArray:
    """Return where c and d lie on different sides of ab, for coplanar rows a, b, c, d."""
    apart = np.zeros(len(quads), dtype=bool)
    for plane in _PLANES:
        flat = points[:, plane]
        one, other = (
            signs(orient2, flat, quads[:, :3]),
            signs(orient2, flat, quads[:, [0, 1, 3]]),
        )
        apart |= one * other < 0
    return apart


# ------------------------------------------------------------- in a plane, on a line


def _check_sheet(
    points: FloatArray,
    vertices: LongArray,
    triangles: IntArray,
    masses: FloatArray | None,
) -> None:
    """Check triangles of points in one plane: in a projection, but for the circles."""
    four = np.empty((len(vertices), 4), dtype=np.int64)
    four[:, :3], four[:, 3] = triangles[0], vertices
    level = signs(orient3, points, four) == 0
    require(level, "points: not in one plane, yet there is no tetrahedron", vertices)
    plane = next(p for p in _PLANES if orient2(points[triangles[:1]][..., p])[0] != 0)
    flat = np.ascontiguousarray(points[:, plane])
    turns = signs(orient2, flat, triangles)
    require(turns != 0, "triangles: flat")
    ends = triangles[:, [1, 2, 0, 2, 0, 1]].reshape(-1, 2).astype(np.int64)
    mesh = Mesh(flat, 0, vertices, triangles, ends, partners(ends))
    check_hull(mesh, turns)
    edges = len(mesh.first)
    if len(vertices) - edges + len(triangles) != 1:
        raise InvalidResultError(
            f"not a disc: {len(vertices)} points - {edges} edges + {len(triangles)} triangles "
            "must be 1 (Euler)"
        )
    half = np.flatnonzero(mesh.partner > np.arange(len(mesh.partner)))
    apex = triangles.ravel()[half]
    beyond = triangles.ravel()[mesh.partner[half]]
    quads = np.column_stack((ends[half], apex, beyond))
    problem = "triangles: folded over their neighbour"
    require(_on_both_sides(points, quads), problem, half // 3)
    if masses is not None:
        outside = lifted_sides((points, masses), quads[:, [0, 1, 2, 3]], plane) < 0
        require(outside, "triangles: a point inside their power circle", half // 3)
        return
    # The sphere through a triangle and any point off the plane cuts it in the circle.
    five = points[quads][:, [0, 1, 2, 2, 3]]
    five[:, 3, 3 - sum(plane)] += 1.0
    negative = orient3(five[:, :4]) < 0
    five[negative, :2] = five[negative, 1::-1]
    outside = insphere3(five, perturb=False) <= 0
    require(outside, "triangles: a point inside their circumcircle", half // 3)


def _check_path(points: FloatArray, vertices: LongArray, edges: IntArray) -> None:
    """Check that points without a triangle lie on one line, and the edges between them."""
    order = vertices[order_of_rows(points[vertices])]
    if len(vertices) > 2:
        triples = np.empty((len(vertices), 3), dtype=np.int64)
        triples[:, 0], triples[:, 1], triples[:, 2] = order[0], order[-1], vertices
        for plane in combinations(range(3), 2):
            on_line = signs(orient2, points[:, plane], triples) == 0
            require(on_line, "points: not on one line, yet there is no triangle", vertices)
    path = collinear_path(points, vertices)
    require_same_rows(edges, path.astype(np.int32), "edges: not those between neighbours")
