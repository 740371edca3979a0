"""Slow, obvious, exact geometry in the plane: the definitions, written down.

Nothing here is shared with the compiled core. Coordinates become integers (every
float is an integer times a power of two), predicates are textbook formulas, and a
triangulation is found by trying every triple of points against every other point.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from fractions import Fraction
from itertools import combinations, pairwise
from typing import Any

Number = int | Fraction
Point = tuple[Number, Number]
Edge = tuple[int, int]
Triangle = tuple[int, int, int]


def sign(value: Number) -> int:
    return (value > 0) - (value < 0)


def row_set(rows: Any) -> set[tuple[int, ...]]:
    """Return the rows of an integer array as a set of tuples; none may come twice."""
    found = {tuple(row) for row in rows.tolist()}
    assert len(found) == len(rows)
    return found


# ---------------------------------------------------------------- coordinates


def lattice(points: Any) -> tuple[list[tuple[int, int]], Fraction]:
    """Return integer points and the unit (a power of two): point = integers * unit."""
    exact = [(Fraction(float(x)), Fraction(float(y))) for x, y in points]
    finest = max((c.denominator for p in exact for c in p), default=1)
    return [(int(x * finest), int(y * finest)) for x, y in exact], Fraction(1, finest)


def representatives(points: Any) -> list[int]:
    """Return, for each row, the lowest row with the same coordinates (-0.0 equals 0.0)."""
    first: dict[tuple[int, int], int] = {}
    return [first.setdefault(p, row) for row, p in enumerate(lattice(points)[0])]


def in_range(points: Any) -> bool:
    """Tell whether the kernels promise to accept these finite coordinates.

    The largest absolute coordinate over the least significant bit of any non-zero
    coordinate must be less than 2**490.
    """
    values = [abs(c) for p in lattice(points)[0] for c in p if c]
    if not values:
        return True
    return max(values) < 2**490 * min(v & -v for v in values)


# ----------------------------------------------------------------- predicates


def orient(a: Point, b: Point, c: Point) -> int:
    """Return +1 where a, b, c turn counter-clockwise, -1 clockwise, 0 on a line."""
    return sign((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))


def squared_distance(a: Point, b: Point) -> Number:
    return (a[0] - b[0]) ** 2 + (a[1] - b[1]) ** 2


def in_circle(a: Point, b: Point, c: Point, d: Point) -> int:
    """Return +1 where d is inside the circle through counter-clockwise a, b, c."""
    rows = [
        (p[0] - d[0], p[1] - d[1], (p[0] - d[0]) ** 2 + (p[1] - d[1]) ** 2) for p in (a, b, c)
    ]
    (ax, ay, az), (bx, by, bz), (cx, cy, cz) = rows
    return sign(ax * (by * cz - bz * cy) - ay * (bx * cz - bz * cx) + az * (bx * cy - by * cx))


def in_circle_perturbed(a: Point, b: Point, c: Point, d: Point) -> int:
    """Return `in_circle`, ties broken by lifting the lexicographically largest point.

    The lifting map sends (x, y) to (x, y, x² + y²); d is inside the circle of a, b, c
    where it is lifted below their plane. A tie means one common plane. Raising the
    largest point by a hair raises d itself (outside), or turns the plane about the
    two others of a, b, c: d is then below it on the raised point's side of that axis.
    """
    plain = in_circle(a, b, c, d)
    if plain:
        return plain
    largest = max(a, b, c, d)
    if largest == d:
        return -1
    others = {a: (b, c), b: (c, a), c: (a, b)}[largest]
    return orient(*others, d)


def in_open_diametral_disc(a: Point, b: Point, p: Point) -> bool:
    """Tell whether p is nearer to the midpoint of a, b than a and b are."""
    double = (2 * p[0], 2 * p[1])
    return squared_distance(double, (a[0] + b[0], a[1] + b[1])) < squared_distance(a, b)


def dot(a: Point, b: Point, c: Point) -> int:
    """Return the sign of (a - c).(b - c): that of the cosine of the angle at c."""
    return sign((a[0] - c[0]) * (b[0] - c[0]) + (a[1] - c[1]) * (b[1] - c[1]))


def circumcentre(a: Point, b: Point, c: Point) -> tuple[Fraction, Fraction]:
    """Return the point at equal distance from a, b and c (by Cramer's rule)."""
    bx, by, cx, cy = b[0] - a[0], b[1] - a[1], c[0] - a[0], c[1] - a[1]
    det = Fraction(2 * (bx * cy - by * cx))
    bb, cc = bx * bx + by * by, cx * cx + cy * cy
    return a[0] + (bb * cy - cc * by) / det, a[1] + (cc * bx - bb * cx) / det


# -------------------------------------------------------------- triangulation


def delaunay_triangles(points: Any) -> set[Triangle]:
    """Return every triple of distinct points whose perturbed circumcircle is empty."""
    cloud, _ = lattice(points)
    rows = sorted(set(representatives(points)))
    found = set()
    for i, j, k in combinations(rows, 3):
        turn = orient(cloud[i], cloud[j], cloud[k])
        if turn == 0:
            continue
        a, b, c = cloud[i], cloud[j if turn > 0 else k], cloud[k if turn > 0 else j]
        others = (cloud[row] for row in rows if row not in (i, j, k))
        if all(in_circle_perturbed(a, b, c, d) < 0 for d in others):
            found.add((i, j, k))
    return found


def collinear_path(points: Any) -> list[Edge]:
    """Return the edges between neighbours on the line, in order along it.

    Only for clouds whose points all lie on one line.
    """
    cloud, _ = lattice(points)
    rows = sorted(set(representatives(points)), key=cloud.__getitem__)
    if any(orient(cloud[rows[0]], cloud[rows[-1]], cloud[row]) for row in rows):
        raise ValueError("the points are not on one line")
    return [(min(edge), max(edge)) for edge in pairwise(rows)]


def faces(triangles: set[Triangle]) -> set[Edge]:
    return {edge for triangle in triangles for edge in combinations(triangle, 2)}


def delaunay_edges(points: Any, triangles: set[Triangle]) -> set[Edge]:
    """Return the edges of the triangulation; of a cloud on a line, those of its path."""
    return faces(triangles) if triangles else set(collinear_path(points))


def hull_edges(points: Any) -> set[Edge]:
    """Return the directed hull edges, every point on the left of each or beyond its ends."""
    cloud, _ = lattice(points)
    rows = sorted(set(representatives(points)))
    found = set()
    for i in rows:
        for j in rows:
            rest = [cloud[row] for row in rows if row not in (i, j)]
            turns = [(orient(cloud[i], cloud[j], p), p) for p in rest]
            on_left = all(
                turn > 0 or (turn == 0 and dot(cloud[i], cloud[j], p) > 0) for turn, p in turns
            )
            if i != j and on_left:
                found.add((i, j))
    return found


def doubled_area(ring: Sequence[Point]) -> Number:
    """Return twice the signed area of a polygon (shoelace formula)."""
    closed = [*ring, ring[0]]
    return sum(p[0] * q[1] - q[0] * p[1] for p, q in pairwise(closed))


# ----------------------------------------------------------------- filtration


def filtration_squares(points: Any) -> dict[tuple[int, ...], Fraction]:
    """Return every simplex of the canonical triangulation with its squared value."""
    cloud, unit = lattice(points)
    rows = sorted(set(representatives(points)))
    triangles = delaunay_triangles(points)
    squares: dict[tuple[int, ...], Fraction] = {(row,): Fraction(0) for row in rows}
    for triangle in triangles:
        corners = [cloud[row] for row in triangle]
        squares[triangle] = Fraction(squared_distance(circumcentre(*corners), corners[0]))
    for i, j in delaunay_edges(points, triangles):
        others = (cloud[row] for row in rows if row not in (i, j))
        if any(in_open_diametral_disc(cloud[i], cloud[j], p) for p in others):
            cofaces = [t for t in triangles if i in t and j in t]
            squares[i, j] = min(squares[t] for t in cofaces)
        else:
            squares[i, j] = Fraction(squared_distance(cloud[i], cloud[j]), 4)
    return {simplex: square * unit**2 for simplex, square in squares.items()}


def square_root(square: Fraction) -> float:
    """Return the square root as a float, correctly rounded (infinite beyond the range)."""
    if square == 0:
        return 0.0
    top, bottom = square.numerator, square.denominator
    # Scale by 4**shift so that the integer root has at least 70 bits, more than a
    # double and its rounding bit; a last bit tells "inexact" and decides near-ties.
    shift = max(0, 70 - (top.bit_length() - bottom.bit_length()) // 2)
    scaled, remainder = divmod(top << (2 * shift), bottom)
    root = math.isqrt(scaled)
    inexact = remainder != 0 or root * root != scaled
    try:
        return (2 * root + inexact) / (1 << (shift + 1))
    except OverflowError:
        return math.inf


def relative_error(value: float, square: Fraction) -> float:
    """Return the relative error of `value` as the square root of `square`."""
    if square == 0:
        return 0.0 if value == 0 else math.inf
    # |v/s - 1| = |v²/s² - 1| / (v/s + 1), and v/s + 1 >= 1.5 where it matters.
    ratio = Fraction(value) ** 2 / square
    return float(abs(ratio - 1)) / (1 + math.sqrt(ratio))
