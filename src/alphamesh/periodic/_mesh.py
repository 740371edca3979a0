"""The complex of a periodic box as a mesh for files: one box, each simplex in one piece."""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING

import numpy as np

from alphamesh._arrays import read_only

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from alphamesh._arrays import BoolArray, IntArray
    from alphamesh.io.meshes import Mesh
    from alphamesh.periodic._filtration import PeriodicFiltration
    from alphamesh.periodic._shape import PeriodicShape

__all__ = ["periodic_mesh", "singular"]

_KINDS = ("vertex", "line", "triangle", "tetra")
_AXES = ("offset_x", "offset_y", "offset_z")
# Determinants of float64 that are this small, beside their arms, tell no sign.
_DOUBTFUL = 1e-12


def singular(shape: PeriodicShape, dimension: int) -> IntArray:
    """Return the numbers of simplices that are a face of no other one that is there."""
    filtration = shape.filtration
    numbers = shape.numbers(dimension)
    if dimension + 1 >= len(filtration.faces):
        return numbers
    used = np.zeros(len(filtration.radii[dimension]), dtype=bool)
    used[filtration.faces[dimension + 1][shape.numbers(dimension + 1)]] = True
    return read_only(numbers[~used[numbers]])


def periodic_mesh(shape: PeriodicShape, *, surface: bool = False) -> Mesh:
    """Return the simplices of one box as a mesh; see :meth:`PeriodicShape.mesh`."""
    from alphamesh.io.meshes import Mesh

    filtration, d = shape.filtration, shape.points.shape[1]
    numbers = {_KINDS[k]: singular(shape, k) for k in range(d + 1)}
    if surface:
        del numbers["tetra"]
        border = shape.boundary_triangles
        numbers["triangle"] = np.concatenate((border, numbers["triangle"]))
        turned = _inward(shape, border, len(numbers["triangle"]))
    else:
        turned = _negative(filtration, numbers[_KINDS[d]], np.full(1, d))
    sites = [_sites(filtration, k, rows) for k, rows in enumerate(numbers.values())]
    sites[-1][turned, :2] = sites[-1][turned, 1::-1]
    places, where = np.unique(
        np.concatenate([site.reshape(-1, 1 + d) for site in sites]), axis=0, return_inverse=True
    )
    pieces = np.split(where.ravel(), np.cumsum([site[..., 0].size for site in sites])[:-1])
    rows, offsets = places[:, 0], places[:, 1:]
    return Mesh(
        filtration.positions.take(rows, axis=0) + offsets * filtration.lattice,
        {
            kind: piece.reshape(site.shape[:2])
            for kind, piece, site in zip(numbers, pieces, sites, strict=True)
        },
        {
            "input_row": rows.astype(np.int32),
            **{_AXES[k]: offsets[:, k].astype(np.int8) for k in range(d)},
        },
        {
            "radius": {
                kind: filtration.radii[k].take(numbers[kind]) for k, kind in enumerate(numbers)
            }
        },
    )


def _sites(
    filtration: PeriodicFiltration, dimension: int, numbers: IntArray
) -> NDArray[np.int64]:
    """Return row and offset of each corner of simplices, ``(m, k + 1, 1 + d)``."""
    rows = filtration.simplices[dimension].take(numbers, axis=0)
    offsets = filtration.offsets[dimension].take(numbers, axis=0)
    return np.concatenate((rows[..., None].astype(np.int64), offsets), axis=2)


def _inward(shape: PeriodicShape, border: IntArray, count: int) -> BoolArray:
    """Return which of `count` triangles, first those at the border, face their cell."""
    filtration = shape.filtration
    cells = filtration.facet_cells.take(border, axis=0)
    there = (cells >= 0) & (filtration.radii[3] <= shape.radius)[cells]
    inside = cells[there]
    _, opposite = np.nonzero(filtration.faces[3].take(inside, axis=0) == border[:, None])
    turned = np.zeros(count, dtype=bool)
    # Seen from outside, the vertex inside is behind: with it in the last place, a triangle
    # that is counter-clockwise from there makes a negative cell.
    turned[: len(border)] = ~_negative(filtration, inside, opposite)
    return turned


def _negative(
    filtration: PeriodicFiltration, cells: IntArray, last: NDArray[np.integer]
) -> BoolArray:
    """Return which cells are negatively oriented when vertex `last` of each is put last."""
    d = filtration.points.shape[1]
    order = np.array([[k for k in range(d + 1) if k != j] + [j] for j in range(d + 1)])
    order = order[np.broadcast_to(last, len(cells))]
    corners = np.take_along_axis(filtration.corners(d, cells), order[..., None], axis=1)
    arms = corners[:, 1:] - corners[:, :1]
    determinants = np.linalg.det(arms)
    size = np.abs(filtration.positions).max(initial=0.0) + filtration.lattice.max(initial=0.0)
    scale = (
        size
        * np.prod(np.linalg.norm(arms, axis=2), axis=1)
        / np.abs(arms).max(axis=(1, 2), initial=np.finfo(float).tiny)
    )
    negative: BoolArray = determinants < 0
    for i in np.flatnonzero(~(np.abs(determinants) > _DOUBTFUL * scale)):
        negative[i] = _exact_sign(filtration, int(cells[i]), order[i].tolist()) < 0
    return negative


def _exact_sign(filtration: PeriodicFiltration, cell: int, order: list[int]) -> int:
    """Return the sign of the determinant of a cell, in fractions, with vertices in `order`."""
    d = filtration.points.shape[1]
    rows, offsets = filtration.simplices[d][cell], filtration.offsets[d][cell]
    sides = [None if side is None else Fraction(side) for side in filtration.periods]
    places = []
    for j in order:
        place = []
        for side, x, offset in zip(
            sides, filtration.points[rows[j]].tolist(), offsets[j].tolist(), strict=True
        ):
            exact = Fraction(x)
            place.append(exact if side is None else exact % side + offset * side)
        places.append(place)
    a = [[x - x0 for x, x0 in zip(place, places[0], strict=True)] for place in places[1:]]
    if d == 2:
        value = a[0][0] * a[1][1] - a[0][1] * a[1][0]
    else:
        value = sum(
            a[0][i] * (a[1][j] * a[2][k] - a[1][k] * a[2][j])
            for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1))
        )
    return (value > 0) - (value < 0)
