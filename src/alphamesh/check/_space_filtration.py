"""The invariants of a filtration in space: every simplex, and the right value for each."""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING, Any

import numpy as np

from alphamesh.check._mesh import unit_points
from alphamesh.check._space_mesh import check_complex, faces, require_same_rows
from alphamesh.check._tools import LongArray, check_radii, check_table, require
from alphamesh.check._weighted import check_power_values, check_rows, standing_rows
from alphamesh.errors import InvalidResultError

if TYPE_CHECKING:
    from alphamesh._arrays import BoolArray, FloatArray, IntArray
    from alphamesh.delaunay3d import Delaunay3D
    from alphamesh.filtration3d import Filtration3D

#: Relative error up to which `check_filtration` accepts a radius in space.
RADIUS_ERROR_IN_SPACE = 2e-13

_NAMES = ("vertex", "edge", "triangle", "tetrahedron")
_ULP = 2.0**-52
# Above this doubt about the check's own rounding, a simplex is measured in fractions.
_THIN = 1e-11
_CHUNK = 1 << 16


def check_delaunay3d(result: Delaunay3D) -> None:
    """Prove a triangulation in space; see :func:`alphamesh.check.check_delaunay`."""
    standing = result.representative
    if result.weights is not None:
        check_rows(result)
        standing = standing_rows(standing, result.hidden)
    vertices = np.flatnonzero(standing == np.arange(len(result.points)))
    simplices = (
        vertices.astype(np.int32).reshape(-1, 1),
        result.edges,
        result.triangles,
        result.tetrahedra,
    )
    partner = check_complex(result.points, standing, simplices, result.weights)
    check_table(result.neighbors, (len(result.tetrahedra), 4), "neighbors")
    expected = np.where(partner < 0, -1, partner // 4).reshape(-1, 4)
    same = (result.neighbors == expected).all(axis=1)
    require(same, "neighbors: not the tetrahedra opposite to the vertices")


def check_filtration3d(result: Filtration3D) -> None:
    """Prove a filtration in space; see :func:`alphamesh.check.check_filtration`."""
    if not len(result.simplices) == len(result.radii) == 4:
        raise InvalidResultError("simplices and radii: not one array for each dimension")
    signed = result.weights is not None
    standing = result.representative
    if signed:
        check_rows(result)
        standing = standing_rows(standing, result.hidden)
    partner = check_complex(result.points, standing, result.simplices, result.weights)
    _check_cofaces(result, partner)
    for name, rows, radii in zip(_NAMES, result.simplices, result.radii, strict=True):
        check_radii(radii, len(rows), f"{name} radii", signed=signed)
    if signed:
        check_power_values(result)
        return
    require(result.radii[0] == 0, "vertex radii: not zero")
    points, exponent = unit_points(result.points)
    lattice = _lattice(points)
    for k in (3, 2, 1):
        _check_radii(result, k, points, lattice, exponent)


def _check_cofaces(result: Filtration3D, partner: LongArray) -> None:
    triangles, tetrahedra = result.simplices[2], result.simplices[3]
    cofaces = result.triangle_tetrahedra
    check_table(cofaces, (len(triangles), 2), "triangle_tetrahedra")
    expected = np.full((len(triangles), 2), -1, dtype=np.int64)
    if len(tetrahedra):
        rows = require_same_rows(triangles, faces(tetrahedra), "triangles: not those")
        expected[rows, 0] = np.arange(len(rows)) // 4
        expected[rows, 1] = np.where(partner < 0, -1, partner // 4)
    # Either order of two cofaces will do, but a missing one comes last.
    same = (cofaces == expected).all(axis=1)
    swapped = (cofaces == expected[:, ::-1]).all(axis=1) & (expected[:, 1] >= 0)
    require(same | swapped, "triangle_tetrahedra: not the cofaces")
    sides = result.simplices[1][result.triangle_edges]
    good = (sides == faces(triangles).reshape(-1, 3, 2)).all(axis=(1, 2))
    require(good, "triangle_edges: not the edges opposite to the corners")


def _check_radii(
    result: Filtration3D,
    k: int,
    points: FloatArray,
    lattice: FloatArray | None,
    exponent: int,
) -> None:
    """Check the radii of one dimension: of the own sphere if it is empty, else the least above.

    Of the vertices of cofaces alone, one lies inside the sphere if any does.
    """
    simplices, radii, name = result.simplices[k], result.radii[k], _NAMES[k]
    least = np.full(len(simplices), np.inf)
    gabriel = np.ones(len(simplices), dtype=bool)
    if k < 3:
        above = result.simplices[k + 1]
        below = result.tetrahedron_triangles if k == 2 else result.triangle_edges
        for corner in range(k + 2):
            face = below[:, corner]
            np.minimum.at(least, face, result.radii[k + 1])
            rows = np.column_stack((simplices[face], above[:, corner]))
            gabriel[face[_inside(points, lattice, rows)]] = False
    require(radii <= least, f"{name} radii: greater than that of a coface")
    require(gabriel | (radii == least), f"{name} radii: not Gabriel, so the least above")
    claimed = np.ldexp(radii, -exponent)
    slack = float(np.ldexp(1.0, -1074 - exponent))  # what rounding to subnormals costs
    own, doubt = _radii_of_spheres(points, simplices)
    with np.errstate(invalid="ignore"):
        good = np.abs(claimed - own) - slack <= (RADIUS_ERROR_IN_SPACE + doubt) * own
    for row in np.flatnonzero(gabriel & ~(doubt < _THIN)):
        corners = points[simplices[row]].tolist()
        good[row] = _is_radius(claimed[row], slack, corners)
    require(~gabriel | good, f"{name} radii: Gabriel, so that of the smallest sphere")


# ---------------------------------------------------------------- spheres of simplices


def _radii_of_spheres(points: FloatArray, simplices: IntArray) -> tuple[FloatArray, FloatArray]:
    """Return the radii of the smallest spheres, and what rounding may have done to them."""
    radii, doubt = np.empty(len(simplices)), np.empty(len(simplices))
    for start in range(0, len(simplices), _CHUNK):
        part = slice(start, start + _CHUNK)
        sides = points[simplices[part, 1:]] - points[simplices[part, :1]]
        with np.errstate(all="ignore"):  # flat ones, which are looked at again
            radii[part], doubt[part] = _radius(sides)
    return radii, doubt


def _radius(sides: FloatArray) -> tuple[FloatArray, FloatArray]:
    lengths = np.sqrt((sides**2).sum(axis=2))
    if sides.shape[1] == 1:
        return lengths[:, 0] / 2, np.where(lengths[:, 0] > 1e-140, 8 * _ULP, np.inf)
    u, v = sides[:, 0], sides[:, 1]
    normal = np.cross(u, v)
    if sides.shape[1] == 2:
        third = np.sqrt(((u - v) ** 2).sum(axis=1))
        height = np.sqrt((normal**2).sum(axis=1))
        size = lengths[:, 0] * lengths[:, 1]
        error = 16 * _ULP * (size / height + 1)
        return size * (third / height) / 2, np.where(height > 1e-140, error, np.inf)
    w = sides[:, 2]
    squares = (lengths**2)[:, :, np.newaxis]
    top = squares[:, 2] * normal + squares[:, 0] * np.cross(v, w)
    top += squares[:, 1] * np.cross(w, u)
    above = np.sqrt((top**2).sum(axis=1))
    below = np.abs((normal * w).sum(axis=1))
    size = lengths.prod(axis=1)
    error = 32 * _ULP * (size * lengths.sum(axis=1) / above + size / below + 1)
    return above / below / 2, np.where((below > 1e-140) & (above > 1e-140), error, np.inf)


def _is_radius(radius: float, slack: float, corners: list[list[float]]) -> bool:
    """Tell exactly whether `radius` is within the allowed error of the smallest sphere's."""
    a, *others = [[Fraction(x) for x in corner] for corner in corners]
    sides = [[x - y for x, y in zip(corner, a, strict=True)] for corner in others]
    products = [[_dot(u, v) for v in sides] for u in sides]
    weights = _solve([[2 * x for x in row] + [row[i]] for i, row in enumerate(products)])
    square = sum(
        (p * q * products[i][j] for i, p in enumerate(weights) for j, q in enumerate(weights)),
        Fraction(0),
    )
    low = max(Fraction(radius) - Fraction(slack), Fraction(0))
    high, error = Fraction(radius) + Fraction(slack), Fraction(RADIUS_ERROR_IN_SPACE)
    return low**2 <= square * (1 + error) ** 2 and square * (1 - error) ** 2 <= high**2


def _dot(u: list[Fraction], v: list[Fraction]) -> Fraction:
    return sum((x * y for x, y in zip(u, v, strict=True)), Fraction(0))


def _solve(rows: list[list[Fraction]]) -> list[Fraction]:
    """Solve linear equations whose matrix is positive definite."""
    for i in range(len(rows)):
        pivot = rows[i] = [x / rows[i][i] for x in rows[i]]
        for j, row in enumerate(rows):
            if i != j:
                rows[j] = [x - row[i] * y for x, y in zip(row, pivot, strict=True)]
    return [row[-1] for row in rows]


# ---------------------------------------------------------------- Gabriel, exactly


def _lattice(points: FloatArray) -> FloatArray | None:
    """Return the points over their last common binary digit: integers, if they are small."""
    mantissas, exponents = np.frexp(points)
    digits = np.ldexp(mantissas, 53).astype(np.int64)
    lowest = np.frexp((digits & -digits).astype(np.float64))[1] - 1
    last = int((exponents - 53 + lowest).min(initial=0, where=points != 0))
    return np.ldexp(points, -last) if last > -50 else None


def _inside(points: FloatArray, lattice: FloatArray | None, rows: Any) -> BoolArray:
    """Return where the last point is inside the smallest sphere of the others; exact."""
    inside = np.empty(len(rows), dtype=bool)
    source = points if lattice is None else lattice
    for start in range(0, len(rows), _CHUNK):
        part = rows[start : start + _CHUNK]
        power, size = _power(source[part])
        inside[start : start + _CHUNK] = power < 0
        unsure = ~(np.abs(power) > 256 * _ULP * size) | (size < 1e-250)
        if lattice is not None:  # sums of integers, none of which was rounded
            unsure &= ~(size < 2.0**53)
        for row in np.flatnonzero(unsure):
            exact = np.array([[Fraction(x) for x in p] for p in points[part[row]].tolist()])
            inside[start + row] = _power(exact[np.newaxis])[0][0] < 0
    return inside


def _power(corners: Any) -> tuple[Any, Any]:
    """Return a number of the sign of the power of the last point, and the sum of its parts."""
    a, b, c = corners[:, 0], corners[:, 1], corners[:, -1]
    if corners.shape[1] == 3:
        parts = (c - a) * (c - b)
        return parts.sum(axis=1), np.abs(parts).sum(axis=1)
    u, v, w = b - a, corners[:, 2] - a, c - a
    normal = _cross(u, v)
    toward = _square(v) * _cross(normal, u) + _square(u) * _cross(v, normal)
    power = (_square(w) * _square(normal) - (w * toward).sum(axis=1, keepdims=True))[:, 0]
    # No part of the sum is larger, however it is computed.
    size = 64 * (_square(w) * _square(u) * _square(v))[:, 0]
    size += 64 * (_root(w) * (_square(u) * _square(v) * (_root(u) + _root(v))))[:, 0]
    return power, size


def _cross(a: Any, b: Any) -> Any:
    i, j = [1, 2, 0], [2, 0, 1]
    return a[:, i] * b[:, j] - a[:, j] * b[:, i]


def _square(a: Any) -> Any:
    return (a * a).sum(axis=1, keepdims=True)


def _root(a: Any) -> Any:
    return np.sqrt(_square(a).astype(np.float64))
