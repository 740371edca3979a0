"""Slow, obvious, exact weighted geometry in any dimension: the definitions, written down.

Nothing here is shared with the compiled core. Every float is a fraction. A point p of
weight w is lifted to the height |p|² - w; the regular triangulation is the lower hull of
the lifted points, found by trying every set of points against every other point.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations
from typing import Any

from oracles3 import Simplex, Vector, dot, exact, faces, minus, solve


@dataclass(frozen=True)
class WeightedComplex:
    """The weighted alpha filtration: the power value of each simplex, and who has none."""

    dimension: int
    representative: list[int]
    hidden: list[int]
    powers: dict[Simplex, Fraction]

    def of_size(self, size: int) -> dict[Simplex, Fraction]:
        return {s: power for s, power in self.powers.items() if len(s) == size}


def heaviest(points: Any, weights: Any) -> list[int]:
    """Return for each row the heaviest, then lowest, row with the same coordinates."""
    place = exact(points)
    best: dict[Vector, int] = {}
    for row, p in enumerate(place):
        if p not in best or weights[row] > weights[best[p]]:
            best[p] = row
    return [best[p] for p in place]


def independent(rows: list[Vector]) -> bool:
    """Tell whether vectors are linearly independent (by elimination)."""
    rows = [tuple(row) for row in rows]
    for k in range(len(rows)):
        pivot = next((c for c, value in enumerate(rows[k]) if value != 0), None)
        if pivot is None:
            return False
        for m in range(k + 1, len(rows)):
            factor = rows[m][pivot] / rows[k][pivot]
            pairs = zip(rows[m], rows[k], strict=True)
            rows[m] = tuple(value - factor * other for value, other in pairs)
    return True


def affine_dimension(place: list[Vector]) -> int:
    if not place:
        return -1
    sides: list[Vector] = []
    for p in place[1:]:
        if independent([*sides, minus(p, place[0])]):
            sides.append(minus(p, place[0]))
    return len(sides)


def kept_axes(place: list[Vector], dimension: int) -> tuple[int, ...]:
    """Return the first coordinates by which all points can be told apart."""
    for axes in combinations(range(len(place[0])), dimension):
        if affine_dimension([tuple(p[k] for k in axes) for p in place]) == dimension:
            return axes
    raise AssertionError("some axes always serve")


def barycentric(corners: list[Vector], p: Vector) -> list[Fraction]:
    """Return the numbers that sum to one and combine the corners to p."""
    rows = [[corner[k] for corner in corners] + [p[k]] for k in range(len(p))]
    return solve([*rows, [Fraction(1)] * (len(corners) + 1)])


def is_below(
    corners: list[Vector], heights: list[Fraction], order: list[Vector], q: Any
) -> bool:
    """Tell whether a lifted point is below the plane of the lifted corners.

    `q` is its place, its height and its rank; `order` holds the corners' ranks. At a tie,
    the point with the highest rank is raised by a hair, then, if that changes nothing, the
    second, and so on.
    """
    place, height, rank = q
    shares = barycentric(corners, place)
    plane = sum((s * h for s, h in zip(shares, heights, strict=True)), Fraction(0))
    if plane != height:
        return height < plane
    for top, share in sorted(zip(order, shares, strict=True), reverse=True):
        if rank > top:
            return False
        if share != 0:
            return share > 0
    raise AssertionError("shares sum to one")


def regular_cells(points: Any, weights: Any) -> set[Simplex]:
    """Return every set of distinct points that no other point is lifted below."""
    place = exact(points)
    rows = sorted(set(heaviest(points, weights)))
    if not rows:
        return set()
    dimension = affine_dimension([place[row] for row in rows])
    axes = kept_axes([place[row] for row in rows], dimension)
    flat = {row: tuple(place[row][k] for k in axes) for row in rows}
    height = {row: dot(place[row], place[row]) - Fraction(float(weights[row])) for row in rows}
    found = set()
    for cell in combinations(rows, dimension + 1):
        corners = [flat[row] for row in cell]
        if not independent([minus(corner, corners[0]) for corner in corners[1:]]):
            continue
        heights, order = [height[row] for row in cell], [place[row] for row in cell]
        others = ((flat[row], height[row], place[row]) for row in rows if row not in cell)
        if not any(is_below(corners, heights, order, q) for q in others):
            found.add(cell)
    return found


def orthocentre(corners: list[Vector], weights: list[Fraction]) -> tuple[Vector, Fraction]:
    """Return the nearest point of equal power distance to all corners, and that distance."""
    first, *others = corners
    sides = [minus(corner, first) for corner in others]
    # first + sum of x_i * sides_i, with |z - p_i|² - w_i the same for all i.
    shares = solve(
        [
            [2 * dot(u, v) for v in sides] + [dot(u, u) - (w - weights[0])]
            for u, w in zip(sides, weights[1:], strict=True)
        ]
    )
    centre = first
    for share, side in zip(shares, sides, strict=True):
        centre = tuple(x + share * y for x, y in zip(centre, side, strict=True))
    offset = minus(centre, first)
    return centre, dot(offset, offset) - weights[0]


def weighted_complex(points: Any, weights: Any) -> WeightedComplex:
    """Return the weighted alpha filtration of a cloud by its definition."""
    place, heavy = exact(points), exact([weights])[0] if len(points) else ()
    representative = heaviest(points, weights)
    rows = sorted(set(representative))
    level = regular_cells(points, weights)
    powers: dict[Simplex, Fraction] = {}
    above: dict[Simplex, Fraction] = {}
    while level:
        least: dict[Simplex, Fraction] = {}
        for coface, power in above.items():
            for face in combinations(coface, len(coface) - 1):
                least[face] = min(least.get(face, power), power)
        above = {}
        for s in level:
            centre, power = orthocentre([place[i] for i in s], [heavy[i] for i in s])
            offsets = ((row, minus(place[row], centre)) for row in rows if row not in s)
            nearer = any(dot(e, e) - heavy[row] < power for row, e in offsets)
            above[s] = least[s] if nearer else power
        powers |= above
        level = faces(level) if len(next(iter(level))) > 1 else set()
    vertices = {s[0] for s in powers if len(s) == 1}
    hidden = [
        row
        for row, stands in enumerate(representative)
        if heavy[row] < heavy[stands] or (stands == row and row not in vertices)
    ]
    dimension = max((len(s) for s in powers), default=0) - 1
    return WeightedComplex(dimension, representative, hidden, powers)


def signed_square(radius: float) -> Fraction:
    """Return the power value that a signed root stands for."""
    square = Fraction(radius) ** 2
    return -square if radius < 0 else square


def relative_error(radius: float, power: Fraction) -> float:
    """Return the relative error of `radius` as the signed root of `power`."""
    if power == 0:
        return 0.0 if radius == 0 else math.inf
    ratio = signed_square(radius) / power
    if ratio <= 0:
        return math.inf
    return float(abs(ratio - 1)) / (1 + math.sqrt(ratio))


def within_a_subnormal(radius: float, power: Fraction) -> bool:
    """Tell whether no float is nearer to the signed root than the smallest one there is."""
    low, high = Fraction(radius) - Fraction(5e-324), Fraction(radius) + Fraction(5e-324)
    return low * abs(low) <= power <= high * abs(high)
