"""What a view of a periodic box needs besides: offsets, sizes, and where solids are cut."""

from __future__ import annotations

import itertools
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from alphamesh._arrays import BoolArray, FloatArray, IntArray
    from alphamesh.periodic import PeriodicFiltration
    from alphamesh.view.placing import Frame, Order

__all__ = ["box_arrays", "box_facts"]

Arrays = dict[str, np.ndarray[Any, Any]]


def box_facts(filtration: PeriodicFiltration, frame: Frame) -> dict[str, Any]:
    """Return the box, in units of the picture."""
    return {
        "periods": [side and side / frame.scale for side in filtration.periods],
        "low": ((frame.low - frame.centre) / frame.scale).tolist(),
        "high": ((frame.high - frame.centre) / frame.scale).tolist(),
    }


def box_arrays(
    filtration: PeriodicFiltration,
    orders: list[Order],
    frame: Frame,
    vertices: np.ndarray[Any, Any],
) -> Arrays:
    """Return what facets do not tell in a box.

    Parameters
    ----------
    filtration : PeriodicFiltration
    orders : list of Order
    frame : Frame
    vertices : (n,) uint32
        The number of each row of the points as a vertex of the view.
    """
    d = filtration.points.shape[1]
    offsets = filtration.offsets[1].take(orders[1].order, axis=0)
    triangles = filtration.simplices[2].take(orders[2].order, axis=0)
    moved = filtration.offsets[2].take(orders[2].order, axis=0)
    if d == 3:
        turned = _turned(filtration, orders[3].rank)[orders[2].order]
        triangles[turned] = triangles[turned][:, [0, 2, 1]]
        moved[turned] = moved[turned][:, [0, 2, 1]]
    cells = filtration.cell_sizes.take(orders[d].order)
    facets = filtration.facet_sizes.take(orders[d - 1].order)
    arrays: Arrays = {
        # The first corner of a simplex is that in the box.
        "edge_offsets": _bytes(offsets[:, 1:]),
        "triangle_corners": vertices.take(triangles).ravel(),
        "triangle_offsets": _bytes(moved[:, 1:]),
        "cell_sizes": (cells / frame.scale**d).astype(np.float32),
        "facet_sizes": (facets / frame.scale ** (d - 1)).astype(np.float32),
    }
    return arrays | (_caps(filtration, orders[3], frame) if d == 3 else {})


def _bytes(offsets: np.ndarray[Any, Any]) -> np.ndarray[Any, np.dtype[np.uint8]]:
    """Return offsets of -1, 0 and 1 as 0, 1 and 2."""
    return (offsets.ravel() + 1).astype(np.uint8)


def _turned(filtration: PeriodicFiltration, rank: np.ndarray[Any, Any]) -> BoolArray:
    """Return which triangles run clockwise seen from outside their first tetrahedron."""
    turned = np.zeros(len(filtration.simplices[2]), dtype=bool)
    cells = filtration.facet_cells
    some = np.flatnonzero(cells.max(axis=1, initial=-1) >= 0)
    one, two = cells.take(some, axis=0).T
    ranks = np.append(rank.astype(np.int64), len(rank))  # row -1, none, reads the last entry
    inner = np.where(ranks.take(one) < ranks.take(two), one, two)
    opposite = filtration.tetrahedron_triangles.take(inner, axis=0) == some[:, np.newaxis]
    apex = opposite.argmax(axis=1)
    corners = filtration.corners(3, inner)
    # All corners but the apex, in their order.
    others = np.arange(3) + (np.arange(3) >= apex[:, np.newaxis])
    faces = np.take_along_axis(corners, others[:, :, np.newaxis], axis=1)
    tips = np.take_along_axis(corners, apex[:, np.newaxis, np.newaxis], axis=1)[:, 0]
    arms = faces[:, 1:] - faces[:, :1]
    normals = np.cross(arms[:, 0], arms[:, 1])
    turned[some] = np.einsum("ij,ij->i", normals, tips - faces[:, 0]) > 0
    return turned


def _caps(filtration: PeriodicFiltration, order: Order, frame: Frame) -> Arrays:
    """Return where the walls of the box cut tetrahedra: triangles, and when they come.

    What of them is beyond the box is still there: a shader leaves it out.
    """
    parts, ranks = [np.empty((0, 3, 3))], [np.empty(0, dtype=np.uint32)]
    corners = filtration.corners(3)
    for axis in np.flatnonzero(filtration.periodic).tolist():
        side = float(filtration.lattice[axis])
        for wall in (0.0, side):
            cuts, which = _sections(corners, axis, wall)
            cuts[..., axis] = 0.0
            for move in _moves(filtration, axis):
                shifted = cuts + move
                seen = _meets(filtration, shifted, axis)
                for place in (0.0, side):
                    shown = shifted[seen]
                    shown[..., axis] = place
                    parts.append(shown)
                    ranks.append(order.rank.take(which[seen]))
    triangles, rank = np.concatenate(parts), np.concatenate(ranks)
    first = np.argsort(rank, kind="stable")
    return {"caps": frame.placed(triangles[first]), "cap_ranks": rank[first]}


def _moves(filtration: PeriodicFiltration, axis: int) -> FloatArray:
    """Return the moves along a wall to the boxes around it."""
    steps = [(0,) if k == axis or not filtration.periodic[k] else (-1, 0, 1) for k in range(3)]
    return np.array(list(itertools.product(*steps))) * filtration.lattice


def _meets(filtration: PeriodicFiltration, triangles: FloatArray, axis: int) -> BoolArray:
    """Return which triangles in a wall meet the box."""
    free = ~filtration.periodic | (np.arange(3) == axis)
    low, high = triangles.min(axis=1), triangles.max(axis=1)
    return np.asarray((free | ((high > 0) & (low < filtration.lattice))).all(axis=1))


def _sections(corners: FloatArray, axis: int, wall: float) -> tuple[FloatArray, IntArray]:
    """Return the cuts of tetrahedra by a plane as triangles, and whose each is."""
    heights = corners[:, :, axis] - wall
    above = (heights > 0).sum(axis=1)
    parts, whose = [np.empty((0, 3, 3))], [np.empty(0, dtype=np.int32)]
    # Highest corners first: the edges between the two sides, in turn around the cut.
    for count, edges in (
        (1, [(0, 1), (0, 2), (0, 3)]),
        (2, [(0, 2), (0, 3), (1, 3), (1, 2)]),
        (3, [(0, 3), (1, 3), (2, 3)]),
    ):
        cut = np.flatnonzero(above == count).astype(np.int32)
        down = np.argsort(-heights[cut], axis=1, kind="stable")
        places = np.take_along_axis(corners[cut], down[:, :, np.newaxis], axis=1)
        levels = np.take_along_axis(heights[cut], down, axis=1)
        polygon = []
        for high, low in edges:
            share = (levels[:, high] / (levels[:, high] - levels[:, low]))[:, np.newaxis]
            polygon.append(places[:, high] * (1 - share) + places[:, low] * share)
        for k in range(1, len(edges) - 1):
            parts.append(np.stack((polygon[0], polygon[k], polygon[k + 1]), axis=1))
            whose.append(cut)
    return np.concatenate(parts), np.concatenate(whose)
