"""The invariants of weighted complexes: regular triangulations and power values."""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING, Any

import numpy as np

from alphamesh._weights import equal_weight, signed_square
from alphamesh.check._mesh import unit_points
from alphamesh.check._powers import lifted_sides, orthocentres, power_value, powers
from alphamesh.check._tools import check_table, require
from alphamesh.delaunay import Delaunay
from alphamesh.errors import InvalidResultError
from alphamesh.filtration3d import Filtration3D

if TYPE_CHECKING:
    from alphamesh._arrays import FloatArray, IntArray
    from alphamesh.check._powers import Balls
    from alphamesh.delaunay3d import Delaunay3D
    from alphamesh.filtration import AnyFiltration

__all__ = ["RADIUS_ERROR_WITH_WEIGHTS", "check_power_values", "check_rows", "standing_rows"]

#: Relative error up to which `check_filtration` accepts a radius of a weighted complex.
RADIUS_ERROR_WITH_WEIGHTS = 5e-13

_NAMES = ("vertex", "edge", "triangle", "tetrahedron")


# ---------------------------------------------------------------------- rows


def standing_rows(representative: IntArray, hidden: IntArray) -> IntArray:
    """Return `representative` with -1 for hidden rows: the others stand for themselves."""
    standing = representative.copy()
    standing[hidden] = -1
    return standing


def check_rows(result: AnyFiltration | Delaunay | Delaunay3D) -> None:
    """Check weights, representatives and that what is hidden is a row once."""
    points, representative, hidden = result.points, result.representative, result.hidden
    weights: Any = result.weights
    n = len(points)
    if not isinstance(weights, np.ndarray) or weights.shape != (n,):
        raise InvalidResultError(f"weights: not a float64 array of shape ({n},)")
    require(np.isfinite(points).all(axis=1) & np.isfinite(weights), "points: not finite")
    check_table(representative, (n,), "representative")
    order = np.lexsort((np.arange(n), -weights, *points.T[::-1]))
    new = np.append(True, (points[order[1:]] != points[order[:-1]]).any(axis=1))[:n]
    expected = np.empty(n, dtype=np.int64)
    expected[order] = order[new][np.cumsum(new) - 1]
    problem = "representative: not the lowest of the heaviest of equal points"
    require(representative == expected, problem)
    check_table(hidden, (len(hidden),), "hidden")
    require((hidden >= 0) & (hidden < n), "hidden: no such point")
    require(np.append(True, np.diff(hidden) > 0)[: len(hidden)], "hidden: not ascending")
    lighter = np.flatnonzero(weights < weights[representative])
    require(np.isin(lighter, hidden), "hidden: a heavier equal point is not told of", lighter)


def check_hidden(result: AnyFiltration, balls: Balls, axes: tuple[int, ...]) -> None:
    """Check that hidden rows have no part of the power diagram.

    Parameters
    ----------
    result : Filtration or Filtration3D
    balls : Balls
    axes : tuple of int
        Columns in which the points have the dimension that they have.
    """
    own = result.hidden[result.representative[result.hidden] == result.hidden]
    if len(own) == 0:
        return
    cells = result.simplices[result.dimension]
    where = _cells_at(result, own, axes)
    require(where >= 0, "hidden: a point outside of the triangulation", own)
    side = lifted_sides(balls, np.column_stack((cells[where], own)), axes)
    require(side < 0, "hidden: a point with a part of the power diagram", own)


def _cells_at(result: AnyFiltration, rows: IntArray, axes: tuple[int, ...]) -> IntArray:
    """Return the cell that each of some rows lies in."""
    if len(axes) == result.points.shape[1]:
        return result.delaunay.find(result.points[rows])
    flat = np.ascontiguousarray(result.points[:, axes])
    if len(axes) == 2:
        assert isinstance(result, Filtration3D)
        triangles = result.simplices[2]
        neighbors = _neighbors(triangles)
        none = triangles[:0, :2]
        plane = Delaunay(flat, result.representative, triangles, neighbors, none)
        return plane.find(flat[rows])
    if len(axes) == 0:
        return np.full(len(rows), -1, dtype=np.int32)
    low, high = (flat[result.simplices[1], 0].T[k] for k in (0, 1))
    low, high = np.minimum(low, high), np.maximum(low, high)
    order = np.argsort(low)
    place = np.searchsorted(low[order], flat[rows, 0], side="right") - 1
    found = order[np.maximum(place, 0)]
    within = (place >= 0) & (flat[rows, 0] <= high[found])
    return np.where(within, found, -1).astype(np.int32)


def _neighbors(triangles: IntArray) -> IntArray:
    """Return the triangle beyond the edge opposite to each corner, -1 for none."""
    from alphamesh.check._mesh import partners

    ends = triangles[:, [1, 2, 0, 2, 0, 1]].reshape(-1, 2).astype(np.int64)
    partner = partners(ends)
    return np.where(partner < 0, -1, partner // 3).reshape(-1, 3).astype(np.int32)


# ---------------------------------------------------------------------- values


def check_power_values(result: AnyFiltration) -> None:
    """Check hidden rows and all values.

    They are those of the own orthosphere if Gabriel, else the least above. Of the vertices
    of cofaces alone, one lies inside the orthosphere if any does.
    """
    assert result.weights is not None
    points, exponent = unit_points(result.points)
    balls = points, np.ldexp(result.weights, -2 * exponent)
    check_hidden(result, balls, full_axes(result))
    values = [signed_square(np.ldexp(radii, -exponent)) for radii in result.radii]
    for k in range(len(result.simplices)):
        if len(result.simplices[k]):
            _check_values(result, k, balls, values[k])


def full_axes(result: AnyFiltration) -> tuple[int, ...]:
    """Return columns in which the first cell is not flat, so that none is."""
    from itertools import combinations

    cells = result.simplices[max(result.dimension, 0)]
    if len(cells) == 0 or result.dimension < 1:
        return ()
    corners = [[Fraction(x) for x in p] for p in result.points[cells[0]].tolist()]
    for axes in combinations(range(result.points.shape[1]), result.dimension):
        sides = [[p[a] - corners[0][a] for a in axes] for p in corners[1:]]
        if _determinant(sides) != 0:
            return axes
    raise InvalidResultError("cells: the first one is flat", rows=[0])


def _determinant(rows: list[list[Fraction]]) -> Fraction:
    if len(rows) == 1:
        return rows[0][0]
    total = Fraction(0)
    for k, top in enumerate(rows[0]):
        minor = [row[:k] + row[k + 1 :] for row in rows[1:]]
        total += (-1) ** k * top * _determinant(minor)
    return total


def _check_values(result: AnyFiltration, k: int, balls: Balls, values: FloatArray) -> None:
    simplices, radii, name = result.simplices[k], result.radii[k], _NAMES[k]
    least = np.full(len(simplices), np.inf)
    gabriel = np.ones(len(simplices), dtype=bool)
    centres = orthocentres(balls, simplices)
    if k + 1 < len(result.simplices) and len(result.simplices[k + 1]):
        above, faces = result.simplices[k + 1], _faces(result, k + 1)
        for corner in range(k + 2):
            face = faces[:, corner]
            np.minimum.at(least, face, result.radii[k + 1])
            inside = powers(balls, simplices, centres, face, above[:, corner]) < 0
            gabriel[face[inside]] = False
    require(radii <= least, f"{name} radii: greater than that of a coface")
    require(gabriel | (radii == least), f"{name} radii: not Gabriel, so the least above")
    own, doubt = centres.value, centres.doubt
    # Radii of balls that are all alike are shifted, and their squares have been rounded.
    equal = equal_weight(balls[1])
    slack = np.zeros(len(own)) + (0.0 if equal is None else 1e-13 * abs(equal))
    error = 2 * RADIUS_ERROR_WITH_WEIGHTS
    good = np.abs(values - own) <= error * np.abs(own) + slack + doubt
    unsure = gabriel & ~(doubt <= error * np.abs(own) + slack)
    for row in np.flatnonzero(unsure):
        exact = power_value(balls, simplices[row])
        off = abs(Fraction(float(values[row])) - exact)
        good[row] = off <= Fraction(error) * abs(exact) + Fraction(float(slack[row]))
    require(~gabriel | good, f"{name} radii: Gabriel, so that of the orthosphere")


def _faces(result: AnyFiltration, k: int) -> IntArray:
    """Return the face opposite to each corner of each simplex of a dimension."""
    if k == 1:
        ends = result.simplices[1][:, ::-1]
        return np.searchsorted(result.simplices[0][:, 0], ends).astype(np.int32)
    if k == 2:
        return result.triangle_edges
    assert isinstance(result, Filtration3D)
    return result.tetrahedron_triangles
