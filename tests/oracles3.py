"""Slow, obvious, exact geometry in space: the definitions, written down.

Nothing here is shared with the compiled core. Every float is a fraction; predicates are
determinants of fractions, and values follow from their definition.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from fractions import Fraction
from itertools import combinations
from typing import Any

Vector = tuple[Fraction, ...]
Simplex = tuple[int, ...]


def exact(points: Any) -> list[Vector]:
    return [tuple(Fraction(float(x)) for x in point) for point in points]


def minus(a: Vector, b: Vector) -> Vector:
    return tuple(x - y for x, y in zip(a, b, strict=True))


def dot(a: Vector, b: Vector) -> Fraction:
    return sum((x * y for x, y in zip(a, b, strict=True)), Fraction(0))


def cross(a: Vector, b: Vector) -> Vector:
    return (
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    )


def sixfold_volume(a: Vector, b: Vector, c: Vector, d: Vector) -> Fraction:
    """Return the signed volume, positive where d sees a, b, c counter-clockwise."""
    return dot(cross(minus(b, a), minus(c, a)), minus(d, a))


def squared_doubled_area(a: Vector, b: Vector, c: Vector) -> Fraction:
    normal = cross(minus(b, a), minus(c, a))
    return dot(normal, normal)


def solve(rows: list[list[Fraction]]) -> list[Fraction]:
    """Solve linear equations, given as rows with the right-hand side last."""
    size = len(rows)
    for column in range(size):
        pivot = next(row for row in range(column, size) if rows[row][column] != 0)
        rows[column], rows[pivot] = rows[pivot], rows[column]
        rows[column] = [value / rows[column][column] for value in rows[column]]
        for row in range(size):
            if row != column:
                factor = rows[row][column]
                pairs = zip(rows[row], rows[column], strict=True)
                rows[row] = [value - factor * other for value, other in pairs]
    return [row[-1] for row in rows]


def smallest_sphere(corners: Sequence[Vector]) -> tuple[Vector, Fraction]:
    """Return the centre and squared radius of the smallest sphere through all corners."""
    first, *others = corners
    sides = [minus(corner, first) for corner in others]
    # The centre is first + sum of x_i * sides_i, at the same distance from all of them.
    weights = solve([[2 * dot(u, v) for v in sides] + [dot(u, u)] for u in sides])
    centre = first
    for weight, side in zip(weights, sides, strict=True):
        centre = tuple(x + weight * y for x, y in zip(centre, side, strict=True))
    offset = minus(centre, first)
    return centre, dot(offset, offset)


def faces(simplices: Iterable[Simplex]) -> set[Simplex]:
    """Return all simplices one dimension down."""
    return {face for s in simplices for face in combinations(s, len(s) - 1)}


def filtration_squares(points: Any, cells: Iterable[Simplex]) -> dict[Simplex, Fraction]:
    """Return the squared value of each face of `cells`, which are Delaunay and ascending.

    A value is that of the smallest sphere if it is empty, else the least of the cofaces.
    """
    place = exact(points)
    level = set(cells)
    values: dict[Simplex, Fraction] = {}
    above: dict[Simplex, Fraction] = {}
    while level:
        least: dict[Simplex, Fraction] = {}
        for coface, value in above.items():
            for face in combinations(coface, len(coface) - 1):
                least[face] = min(least.get(face, value), value)
        above = {s: value_of(place, s, least.get(s)) for s in level}
        values |= above
        level = faces(level) if len(next(iter(level))) > 1 else set()
    return values


def value_of(place: list[Vector], simplex: Simplex, least: Fraction | None) -> Fraction:
    centre, square = smallest_sphere([place[i] for i in simplex])
    for row, point in enumerate(place):
        offset = minus(point, centre)
        if row not in simplex and dot(offset, offset) < square:
            assert least is not None, "a cell that is not Delaunay"
            return least
    return square


def components(count: int, joins: Iterable[tuple[int, int]]) -> list[int]:
    """Return for each of `count` things the lowest one that it is joined to."""
    lowest = list(range(count))
    joins = list(joins)
    changed = True
    while changed:
        changed = False
        for a, b in joins:
            least = min(lowest[a], lowest[b])
            if lowest[a] != least or lowest[b] != least:
                lowest[a] = lowest[b] = least
                changed = True
    return lowest
