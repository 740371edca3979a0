"""Proof that triangles are the canonical Delaunay triangulation of a cloud."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from alphamesh._kernels import dot2, incircle2, orient2
from alphamesh.check._powers import lifted_sides
from alphamesh.check._tools import LongArray, check_table, edge_keys, require, signs
from alphamesh.errors import InvalidResultError, rows_text

if TYPE_CHECKING:
    from alphamesh._arrays import BoolArray, FloatArray, IntArray, KindArray


@dataclass(frozen=True)
class Mesh:
    """A triangulation that has been proved, with what follows from its triangles.

    Half-edge 3t + j is the edge of triangle t opposite to its vertex j.
    """

    points: FloatArray  # over a power of two, so that they lie in [-1, 1]
    exponent: int  # of that power
    vertices: LongArray  # the representatives, ascending
    triangles: IntArray
    ends: LongArray  # (3T, 2) the ends of each half-edge, ascending
    partner: LongArray  # (3T,) the other half-edge, -1 on the hull

    @property
    def neighbors(self) -> LongArray:
        return np.where(self.partner < 0, -1, self.partner // 3).reshape(-1, 3)

    @property
    def edges(self) -> LongArray:
        """Every edge once, its ends ascending."""
        if len(self.triangles) == 0:
            return collinear_path(self.points, self.vertices)
        return self.ends[self.first]

    @property
    def first(self) -> LongArray:
        """The half-edges that stand for their edge: one of each pair, all of the hull."""
        return np.flatnonzero(self.partner < np.arange(len(self.partner)))


def unit_points(points: FloatArray) -> tuple[FloatArray, int]:
    """Return the points over a power of two, within [-1, 1], and its exponent."""
    exponent = int(np.frexp(np.abs(points).max(initial=0.0))[1])
    return np.ldexp(points, -exponent), exponent


def proved_mesh(
    points: FloatArray,
    representative: IntArray,
    triangles: IntArray,
    weights: FloatArray | None = None,
) -> Mesh:
    """Return the mesh of `triangles` if it is the canonical Delaunay triangulation.

    With weights, the canonical regular triangulation of the rows that represent themselves.
    """
    vertices = np.flatnonzero(representative == np.arange(len(points)))
    points, exponent = unit_points(points)
    check_table(triangles, (len(triangles), 3), "triangles")
    check_simplices(triangles, representative, "triangles")
    ends = triangles[:, [1, 2, 0, 2, 0, 1]].reshape(-1, 2).astype(np.int64)
    mesh = Mesh(points, exponent, vertices, triangles, ends, partners(ends))
    masses = None if weights is None else np.ldexp(weights, -2 * exponent)
    if len(triangles) == 0:
        _check_line(points, vertices)
        if masses is not None:
            check_regular_path(points, masses, vertices)
        return mesh
    used = np.zeros(len(points), dtype=bool)
    used[triangles] = True
    require(used[vertices], "points: in no triangle", vertices)
    turns = signs(orient2, points, triangles)
    require(turns != 0, "triangles: flat")
    check_hull(mesh, turns)
    edges = len(mesh.first)
    if len(vertices) - edges + len(triangles) != 1:
        raise InvalidResultError(
            f"not a disc: {len(vertices)} points - {edges} edges + {len(triangles)} triangles "
            "must be 1 (Euler)"
        )
    _check_inner_edges(mesh, turns, masses)
    return mesh


def check_simplices(simplices: IntArray, representative: IntArray, name: str) -> None:
    """Check ids and their order inside rows; a row that comes twice folds over itself."""
    n = len(representative)
    require(((simplices >= 0) & (simplices < n)).all(axis=1), f"{name}: no such point")
    require((np.diff(simplices, axis=1) > 0).all(axis=1), f"{name}: not ascending")
    own = (representative[simplices] == simplices).all(axis=1)
    require(own, f"{name}: a duplicate in the place of its representative")


def partners(ends: LongArray) -> LongArray:
    """Match the half-edges; refuse edges of more than two triangles."""
    partner = np.full(len(ends), -1, dtype=np.int64)
    if len(ends) == 0:
        return partner
    keys = edge_keys(ends)
    order = np.argsort(keys, kind="stable")
    same = np.flatnonzero(keys[order[1:]] == keys[order[:-1]])
    crowded = same[1:][np.diff(same) == 1]
    if len(crowded):
        rows = np.unique(order[crowded] // 3)
        raise InvalidResultError(
            f"triangles: an edge in more than two of them ({rows_text(rows)})", rows=rows
        )
    here, there = order[same], order[same + 1]
    partner[here], partner[there] = there, here
    return partner


def check_hull(mesh: Mesh, turns: KindArray) -> None:
    """Check that the border is one convex ring that goes round once."""
    half = np.flatnonzero(mesh.partner < 0)
    ends = mesh.ends[half]
    # (v1, v2), (v0, v2), (v0, v1) run counter-clockwise but for the second.
    against = (turns[half // 3] > 0) == (half % 3 == 1)
    start, end = np.where(against, ends.T[::-1], ends.T)
    order, back = np.argsort(start), np.argsort(end)
    ring = np.array_equal(start[order], end[back]) and len(np.unique(start)) == len(start)
    if not ring:
        raise InvalidResultError("triangles: their border is not a ring")
    following = np.empty(len(mesh.points), dtype=np.int64)
    following[start] = end
    previous, here, next_ = start, end, following[end]
    turn = signs(orient2, mesh.points, np.column_stack((previous, here, next_)))
    ahead = signs(dot2, mesh.points, np.column_stack((previous, next_, here))) < 0
    require((turn > 0) | ((turn == 0) & ahead), "triangles: the hull is not convex", half // 3)
    # A convex ring has one lexicographically least corner for each time it goes round.
    points = mesh.points
    lowest = _precedes(points[here], points[previous]) & _precedes(points[here], points[next_])
    if np.count_nonzero(lowest) != 1:
        raise InvalidResultError("triangles: the hull is not one ring that goes round once")


def _precedes(a: FloatArray, b: FloatArray) -> BoolArray:
    """Return where a comes before b in lexicographic order."""
    first: BoolArray = (a[:, 0] < b[:, 0]) | ((a[:, 0] == b[:, 0]) & (a[:, 1] < b[:, 1]))
    return first


def _check_inner_edges(mesh: Mesh, turns: KindArray, masses: FloatArray | None) -> None:
    """Check that triangles lie on both sides of each inner edge and are locally Delaunay."""
    half = np.flatnonzero(mesh.partner > np.arange(len(mesh.partner)))
    other = mesh.partner[half]
    apex, beyond = mesh.triangles.ravel()[half], mesh.triangles.ravel()[other]
    corners = np.column_stack((mesh.ends[half], apex))
    side = signs(orient2, mesh.points, corners)
    across = np.column_stack((mesh.ends[half], beyond))
    folded = signs(orient2, mesh.points, across) == side
    require(~folded, "triangles: folded over their neighbour", half // 3)
    clockwise = side < 0
    corners[clockwise] = corners[clockwise][:, [1, 0, 2]]
    quads = np.column_stack((corners, beyond))
    if masses is None:
        outside = signs(_in_circle, mesh.points, quads) < 0
        problem = "triangles: a point inside their circumcircle (ties included)"
    else:
        outside = lifted_sides((mesh.points, masses), quads, (0, 1)) < 0
        problem = "triangles: a point inside their power circle (ties included)"
    require(outside, problem, half // 3)


def _in_circle(corners: FloatArray) -> KindArray:
    return incircle2(corners, perturb=True)


def _check_line(points: FloatArray, vertices: LongArray) -> None:
    """Check that points without a triangle lie on one line."""
    if len(vertices) < 3:
        return
    order = vertices[np.lexsort(points[vertices].T[::-1])]
    triples = np.empty((len(vertices), 3), dtype=np.int64)
    triples[:] = order[0], order[-1], 0
    triples[:, 2] = vertices
    on_line = signs(orient2, points, triples) == 0
    require(on_line, "points: not on one line, yet there is no triangle", vertices)


def check_regular_path(points: FloatArray, masses: FloatArray, vertices: Any) -> None:
    """Check that each of several points on a line has a part of their power diagram."""
    order = vertices[np.lexsort(points[vertices].T[::-1])]
    if len(order) < 3:
        return
    widest = int(np.argmax(np.ptp(points[vertices], axis=0)))
    triples = np.column_stack((order[:-2], order[2:], order[1:-1]))
    inside = lifted_sides((points, masses), triples, (widest,)) > 0
    require(inside, "vertices: one without a part of the power diagram", order[1:-1])


def collinear_path(points: FloatArray, vertices: Any) -> LongArray:
    """Return the edges between lexicographic neighbours: the path of collinear points."""
    order = vertices[np.lexsort(points[vertices].T[::-1])].astype(np.int64)
    return np.sort(np.column_stack((order[:-1], order[1:])), axis=1)


def check_representative(
    points: FloatArray, representative: IntArray, columns: int = 2
) -> None:
    """Check that each row points to the lowest row with equal coordinates."""
    if points.ndim != 2 or points.shape[1] != columns or points.dtype != np.float64:
        raise InvalidResultError(f"points: not an (n, {columns}) float64 array")
    require(np.isfinite(points).all(axis=1), "points: not finite")
    n = len(points)
    check_table(representative, (n,), "representative")
    lower = (representative >= 0) & (representative <= np.arange(n))
    require(lower, "representative: neither the row itself nor a lower one")
    require(
        representative[representative] == representative,
        "representative: of a row that does not represent itself",
    )
    same = (points[representative] == points).all(axis=1)
    require(same, "representative: of other coordinates")
    vertices = np.flatnonzero(representative == np.arange(n))
    order = vertices[np.lexsort(points[vertices].T[::-1])]
    distinct = (points[order[1:]] != points[order[:-1]]).any(axis=1)
    require(distinct, "representative: not the lowest of equal points", order[1:])


def check_edges(edges: IntArray, mesh: Mesh) -> LongArray:
    """Check that `edges` are those of the mesh; return the row of each edge of the mesh."""
    check_table(edges, (len(mesh.edges), 2), "edges")
    keys, expected = edge_keys(edges), edge_keys(mesh.edges)
    order, where = np.argsort(keys), np.argsort(expected)
    require(keys[order] == expected[where], "edges: not those of the triangles", order)
    rows = np.empty(len(edges), dtype=np.int64)
    rows[where] = order
    return rows
