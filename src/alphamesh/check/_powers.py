"""Orthospheres and lifted points: in floats where these tell, else in fractions.

F. Aurenhammer, Power diagrams: properties, algorithms and applications, SIAM Journal on
Computing 16 (1987) 78-96.
"""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

import numpy as np

if TYPE_CHECKING:
    from alphamesh._arrays import FloatArray, IntArray, KindArray

    Balls: TypeAlias = "tuple[FloatArray, FloatArray]"

__all__ = ["Orthocentres", "lifted_sides", "orthocentres", "power_value", "powers"]

_ULP = 2.0**-52
_CHUNK = 1 << 16


class Orthocentres(NamedTuple):
    """Where simplices have their orthocentres.

    Attributes
    ----------
    offset : (m, d) float64
        From the first corner.
    value : (m,) float64
        The power value: the squared distance to the corner less its weight.
    doubt : (m,) float64
        What rounding may have done to the value.
    error : (m,) float64
        What it may have done to the offset.
    """

    offset: FloatArray
    value: FloatArray
    doubt: FloatArray
    error: FloatArray


def orthocentres(balls: Balls, simplices: IntArray) -> Orthocentres:
    """Return the orthocentres of simplices, within their own flats.

    Parameters
    ----------
    balls : ((n, d) float64, (n,) float64)
        Points and weights, both within [-1, 1] or so.
    simplices : (m, k + 1) int32
    """
    points, weights = balls
    first = weights[simplices[:, 0]]
    if simplices.shape[1] == 1:
        zero = np.zeros((len(simplices), points.shape[1]))
        return Orthocentres(zero, -first, 0 * first, 0 * first)
    sides = points[simplices[:, 1:]] - points[simplices[:, :1]]
    gram = np.einsum("mid,mjd->mij", sides, sides)
    squares = np.einsum("mii->mi", gram)
    drops = first[:, np.newaxis] - weights[simplices[:, 1:]]
    right = (squares + drops) / 2
    with np.errstate(all="ignore"):
        inverse, singular = _inverse(gram)
        shares = np.einsum("mij,mj->mi", inverse, right)
        offset = np.einsum("mi,mid->md", shares, sides)
        value = (offset**2).sum(axis=1) - first
        # Relative errors grow with the condition of the matrix.
        sizes = (squares + np.abs(drops)).max(axis=1)
        norm = np.abs(inverse).sum(axis=2).max(axis=1)
        condition = np.abs(gram).sum(axis=2).max(axis=1) * norm
        spread = norm * sizes * np.sqrt(squares.max(axis=1))
        error = 256 * _ULP * condition * spread
        error[singular | ~np.isfinite(error)] = np.inf
        length = np.sqrt((offset**2).sum(axis=1))
        doubt = error * (2 * length + error) + 64 * _ULP * (length**2 + np.abs(first))
    doubt[~np.isfinite(doubt)] = np.inf
    return Orthocentres(offset, value, doubt, error)


def _inverse(gram: FloatArray) -> tuple[FloatArray, Any]:
    """Return inverses of symmetric matrices, and which have none that floats can tell."""
    singular = ~(np.linalg.det(gram) > 0)
    safe = gram.copy()
    safe[singular] = np.eye(gram.shape[1])
    return np.asarray(np.linalg.inv(safe), dtype=np.float64), singular


def powers(
    balls: Balls, simplices: IntArray, centres: Orthocentres, rows: IntArray, others: IntArray
) -> KindArray:
    """Return the exact sign of the power of other points: -1 inside the orthosphere.

    Parameters
    ----------
    balls : see `orthocentres`
    simplices : (m, k + 1) int32
    centres : Orthocentres
        Those of `simplices`.
    rows : (q,) int32
        Which of the simplices are meant.
    others : (q,) int32
        A point for each of them.
    """
    points, weights = balls
    first = simplices[rows, 0]
    away = points[others] - points[first]
    square = (away**2).sum(axis=1)
    drop = weights[first] - weights[others]
    along = (away * centres.offset[rows]).sum(axis=1)
    with np.errstate(all="ignore"):
        power = square - 2 * along + drop
        length = np.sqrt(square)
        reach = np.sqrt((centres.offset[rows] ** 2).sum(axis=1))
        error = 64 * _ULP * (square + np.abs(drop) + 2 * length * reach)
        error += 2 * length * centres.error[rows]
        signs: KindArray = np.sign(power).astype(np.int8)
        unsure = ~(np.abs(power) > error)
    for q in np.flatnonzero(unsure):
        signs[q] = _exact_power(balls, simplices[rows[q]], int(others[q]))
    return signs


def _exact_ball(balls: Balls, row: int) -> tuple[list[Fraction], Fraction]:
    return [Fraction(x) for x in balls[0][row].tolist()], Fraction(float(balls[1][row]))


def _exact_centre(balls: Balls, simplex: Any) -> tuple[list[Fraction], Fraction]:
    """Return the offset of the orthocentre from the first corner, and its power value."""
    (a, weight), *others = (_exact_ball(balls, int(row)) for row in simplex)
    sides = [[x - y for x, y in zip(p, a, strict=True)] for p, _ in others]
    products = [[_dot(u, v) for v in sides] for u in sides]
    shares = _solve(
        [
            [2 * x for x in row] + [row[i] + weight - others[i][1]]
            for i, row in enumerate(products)
        ]
    )
    offset = [
        sum((s * u[axis] for s, u in zip(shares, sides, strict=True)), Fraction(0))
        for axis in range(len(a))
    ]
    return offset, _dot(offset, offset) - weight


def power_value(balls: Balls, simplex: Any) -> Fraction:
    """Return the exact power value of one simplex."""
    return _exact_centre(balls, simplex)[1]


def _exact_power(balls: Balls, simplex: Any, other: int) -> int:
    offset, _ = _exact_centre(balls, simplex)
    a, weight = _exact_ball(balls, int(simplex[0]))
    c, mass = _exact_ball(balls, other)
    away = [x - y for x, y in zip(c, a, strict=True)]
    power = _dot(away, away) - 2 * _dot(away, offset) + weight - mass
    return (power > 0) - (power < 0)


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


# ---------------------------------------------------------------------- lifted points


def lifted_sides(balls: Balls, rows: Any, axes: tuple[int, ...]) -> KindArray:
    """Return on which side of a cell's lifted flat another point lies: +1 below, inside.

    Points are lifted by ``|p|**2 - w``. Ties are broken as in the triangulation: the
    lexicographically largest point is lifted most of all, then the second, and so on.

    Parameters
    ----------
    balls : see `orthocentres`
    rows : (k, D + 2) int32
        The corners of a cell of dimension D, then the other point.
    axes : tuple of int
        D columns in which no cell is flat.

    Returns
    -------
    (k,) int8
        Never 0 unless all of them are flat.
    """
    out = np.empty(len(rows), dtype=np.int8)
    for start in range(0, len(rows), _CHUNK):
        part = rows[start : start + _CHUNK]
        points, weights = balls[0][part], balls[1][part]
        flat, heights, terms = _raised(points, weights, axes)
        total, size = _lifted(flat, heights, terms)
        turn, turn_size = _turn(flat)
        sign = np.sign(total) * np.sign(turn) * (-1) ** len(axes)
        sure = (np.abs(total) > 256 * _ULP * size) & (np.abs(turn) > 64 * _ULP * turn_size)
        out[start : start + _CHUNK] = sign
        for row in np.flatnonzero(~sure):
            out[start + row] = _exact_side(points[row].tolist(), weights[row].tolist(), axes)
    return out


def _raised(points: Any, weights: Any, axes: tuple[int, ...]) -> tuple[Any, Any, Any]:
    """Return corners less the last point, in some axes, and how much higher they are.

    The height is a difference: what it was made of says what rounding has done to it.
    """
    away = points[:, :-1] - points[:, -1:]
    squares, heavier = (away**2).sum(axis=2), weights[:, :-1] - weights[:, -1:]
    return away[..., list(axes)], squares - heavier, squares + abs(heavier)


def _minor(flat: Any, left_out: int) -> tuple[Any, Any]:
    """Return the determinant of all rows but one, and the sum of its absolute terms."""
    kept = [i for i in range(flat.shape[1]) if i != left_out]
    return _determinants(flat[:, kept])


def _determinants(rows: Any) -> tuple[Any, Any]:
    if rows.shape[1] == 1:
        return rows[:, 0, 0], abs(rows[:, 0, 0])
    total = size = 0
    for k in range(rows.shape[1]):
        others = [j for j in range(rows.shape[1]) if j != k]
        minor, most = _determinants(rows[:, 1:][:, :, others])
        total = total + (-1) ** k * rows[:, 0, k] * minor
        size = size + abs(rows[:, 0, k]) * most
    return total, size


def _lifted(flat: Any, heights: Any, terms: Any) -> tuple[Any, Any]:
    total = size = 0
    last = flat.shape[2]
    for i in range(flat.shape[1]):
        minor, most = _minor(flat, i)
        total = total + (-1) ** (i + last) * heights[:, i] * minor
        size = size + terms[:, i] * most
    return total, size


def _turn(flat: Any) -> tuple[Any, Any]:
    """Return the orientation of each cell.

    Not from differences of `flat`: where the last point is near to all corners but one, what
    they round is more than the terms tell.
    """
    total = size = 0
    for i in range(flat.shape[1]):
        minor, most = _minor(flat, i)
        total = total + (-1) ** i * minor
        size = size + most
    return total, size


def _exact_side(points: list[Any], weights: list[float], axes: tuple[int, ...]) -> int:
    exact = np.array([[[Fraction(x) for x in p] for p in points]])
    flat, *heights = _raised(exact, np.array([[Fraction(w) for w in weights]]), axes)
    total, turn = _lifted(flat, *heights)[0][0], _turn(flat)[0][0]
    odd = (-1) ** len(axes)
    if total == 0:
        # What raising each point alone does to the sum.
        gains = [
            (-1) ** (i + len(axes)) * _minor(flat, i)[0][0] for i in range(len(points) - 1)
        ]
        gains.append(-sum(gains))
        order = sorted(range(len(points)), key=points.__getitem__, reverse=True)
        total = next((gains[i] for i in order if gains[i] != 0), Fraction(0))
    side = total * turn * odd
    return int((side > 0) - (side < 0))
