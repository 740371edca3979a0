"""Fronts of a complex in a periodic box of space; see :mod:`alphamesh.tiles.fronts`.

Rows tell triangles apart, and the orientation of their tetrahedra, which no translation
changes, their sides. So tiles on both sides of a border give them the same names.
"""

from __future__ import annotations

from itertools import combinations
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from alphamesh._arrays import read_only
from alphamesh.tiles.labels import Border, labels_of

if TYPE_CHECKING:
    from alphamesh._arrays import BoolArray, CountArray, FloatArray, IntArray

__all__ = ["Solid", "box_fronts", "orientations"]


class Solid(NamedTuple):
    """Tetrahedra at the points of a tile, which fill a neighbourhood of each, and faces."""

    edges: IntArray
    triangles: IntArray
    tetrahedra: IntArray
    """rows ascending"""
    triangle_edges: IntArray
    tetrahedron_triangles: IntArray
    """numbers of the faces opposite to the vertices"""
    triangle_tetrahedra: IntArray
    """one or two, -1 for none"""
    turned: IntArray
    """1 for tetrahedra that are positively oriented as their rows ascend, else -1"""
    radii: tuple[FloatArray, FloatArray, FloatArray]
    """of edges, triangles and tetrahedra"""


def orientations(cells: IntArray, tetrahedra: IntArray) -> IntArray:
    """Return 1 for tetrahedra that are positively oriented as their rows ascend, else -1.

    Parameters
    ----------
    cells : (m, 4) int32
        The same tetrahedra in another order, each positively oriented.
    tetrahedra : (m, 4) int32
        Ascending.
    """
    inversions = sum(
        (cells[:, i] > cells[:, j]).astype(int) for i, j in combinations(range(4), 2)
    )
    signs = np.where(np.asarray(inversions) % 2 == 0, 1, -1)
    found = np.empty(len(cells), dtype=np.int32)
    ascending = np.sort(cells, axis=1)
    found[np.lexsort(tetrahedra.T[::-1])] = signs[np.lexsort(ascending.T[::-1])]
    return found


def box_fronts(
    solid: Solid, rows: CountArray, own: BoolArray, there: BoolArray, radius: float
) -> Border:
    """Return the fronts at the vertices of a tile, and what other tiles know of them.

    Parameters
    ----------
    solid : Solid
    rows : (n,) int32 or int64
        Of points in the whole cloud.
    own, there : (n,) bool
        Whether a point is in the tile, and whether it is one of the tile's vertices.
    radius : float

    Returns
    -------
    Border
        Keys are those of the kernel :func:`alphamesh._kernels.tiles.tile_share3`.
    """
    edge_there, triangle_there, cell_there = (values <= radius for values in solid.radii)
    # A node for each corner of each tetrahedron; only those of what is not there count.
    corners = ~cell_there[:, np.newaxis] & there.take(solid.tetrahedra)
    links = [_across(solid, there, ~triangle_there)]
    edge = _edges_of(solid)
    for k, (i, j) in enumerate(combinations(range(4), 2)):
        both = edge_there.take(edge[:, k]) & corners[:, i] & corners[:, j]
        at = 4 * np.flatnonzero(both)
        links.append(np.column_stack((at + i, at + j)))
    count, labels = labels_of(np.concatenate(links), corners.ravel())
    alone = edge_there.copy()
    alone[solid.triangle_edges.compress(triangle_there, axis=0)] = False
    named = (
        _sides(solid, rows, own, triangle_there, cell_there),
        _lone_edges(solid, edge, rows, own, alone),
    )
    keys, nodes = (np.concatenate(part) for part in zip(*named, strict=True))
    numbers = labels.take(nodes).astype(np.int32)
    return Border(count, read_only(keys.astype(rows.dtype, copy=False)), read_only(numbers))


def _node(solid: Solid, cells: CountArray | IntArray, points: IntArray) -> CountArray:
    """Return the node of a corner of each of some tetrahedra."""
    corner = (solid.tetrahedra.take(cells, axis=0) == points[:, np.newaxis]).argmax(axis=1)
    nodes: CountArray = 4 * cells.astype(np.int64) + corner
    return nodes


def _across(solid: Solid, there: BoolArray, open_: BoolArray) -> CountArray:
    """Link corners at one vertex through triangles that are not there."""
    passed = np.flatnonzero(open_ & (solid.triangle_tetrahedra >= 0).all(axis=1))
    found = []
    for i in range(3):
        at = solid.triangles[:, i].take(passed)
        chosen = there.take(at)
        cells = solid.triangle_tetrahedra.take(passed.compress(chosen), axis=0)
        at = at.compress(chosen)
        found.append(np.column_stack([_node(solid, cells[:, k], at) for k in range(2)]))
    return np.concatenate(found)


def _edges_of(solid: Solid) -> IntArray:
    """Return the six edges of each tetrahedron, ``(m, 6)``, between corners 01, 02, ... 23."""
    found = []
    for i, j in combinations(range(4), 2):
        apex, other = (k for k in range(4) if k not in (i, j))
        triangle = solid.tetrahedron_triangles[:, apex]
        found.append(solid.triangle_edges[triangle, other - (other > apex)])
    return np.column_stack(found)


def _sides(
    solid: Solid,
    rows: CountArray,
    own: BoolArray,
    triangle_there: BoolArray,
    cell_there: BoolArray,
) -> tuple[CountArray, CountArray]:
    """Name the free sides of triangles that other tiles know, too."""
    inside = np.count_nonzero(own.take(solid.triangles), axis=1)
    known = np.flatnonzero(triangle_there & (inside > 0) & (inside < 3))
    keys, nodes = [], []
    for k in range(2):
        cells = solid.triangle_tetrahedra[:, k].take(known)
        free = (cells >= 0) & ~cell_there.take(cells, mode="clip")
        triangles, cells = known.compress(free), cells.compress(free)
        corners = solid.triangles.take(triangles, axis=0)
        apex = (solid.tetrahedron_triangles.take(cells, axis=0) == triangles[:, None]).argmax(1)
        facing = solid.turned.take(cells) * np.where(apex % 2 == 1, 1, -1)
        names = np.column_stack((rows.take(corners), facing))
        for i in range(3):
            mine = own.take(corners[:, i])
            keys.append(names.compress(mine, axis=0))
            nodes.append(_node(solid, cells.compress(mine), corners[:, i].compress(mine)))
    return np.concatenate(keys), np.concatenate(nodes)


def _lone_edges(
    solid: Solid, edge: IntArray, rows: CountArray, own: BoolArray, alone: BoolArray
) -> tuple[CountArray, CountArray]:
    """Name edges in no triangle that other tiles know, too: all around each is joined."""
    inside = own.take(solid.edges)
    wanted = alone & (inside[:, 0] != inside[:, 1])
    cells, places = np.nonzero(wanted.take(edge))
    found, first = np.unique(edge[cells, places], return_index=True)
    ends = solid.edges.take(found, axis=0)
    at = np.where(own.take(ends[:, 0]), ends[:, 0], ends[:, 1])
    keys = np.column_stack(
        (rows.take(ends), np.full(len(found), -1), np.zeros(len(found), int))
    )
    return keys, _node(solid, cells.take(first), at)
