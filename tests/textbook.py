"""The alpha complex as a textbook draws it: Voronoi cells, discs, and what they share.

Nothing of the library is used, nor a triangulation of any kind. The ridge between two
points is what all other points leave of their bisector; a disc cuts it where it must; the
ridges and Voronoi vertices that survive are the edges and triangles. All in fractions.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import Enum
from fractions import Fraction
from itertools import combinations
from typing import Any

from oracles import lattice, representatives, squared_distance

Centre = tuple[Fraction, Fraction]


class Cut(Enum):
    """What the two discs, which meet the bisector in the same points, leave of a ridge."""

    OUTSIDE = "nothing"
    INSIDE = "all of it: both of its ends are Voronoi vertices in the discs"
    ONE_CROSSING = "from a Voronoi vertex in the discs to the circles"
    TWO_CROSSINGS = "a chord, from circle to circle"
    TANGENT = "the midpoint, where the two circles touch"


@dataclass(frozen=True)
class Ridge:
    """The part of a bisector that is nearest to its two points: from `low` to `high`.

    Positions are numbers t: the point is the midpoint plus t times the vector from the first
    to the second point, turned left. None means infinity.
    """

    first: int
    second: int
    low: Fraction | None
    high: Fraction | None
    width: int  # squared distance of the two points

    @property
    def is_point(self) -> bool:
        return self.low is not None and self.low == self.high

    def squared_distance(self, t: Fraction) -> Fraction:
        """Return how far the two points are from position t."""
        return self.width * (t * t + Fraction(1, 4))

    def ends_in(self, square: Fraction) -> list[Fraction]:
        """Return the ends that are in the closed discs."""
        ends = [t for t in (self.low, self.high) if t is not None]
        return [t for t in ends if self.squared_distance(t) <= square]

    def cut(self, square: Fraction) -> Cut:
        """Classify the ridge for discs of this squared radius."""
        reach = square / self.width - Fraction(1, 4)
        if reach < 0:
            return Cut.OUTSIDE
        inside = self.ends_in(square)
        if len(inside) == 2:
            return Cut.INSIDE
        if inside:
            return Cut.ONE_CROSSING
        # No end is in the discs: the chord is on the ridge, or it is beyond one end.
        if (self.low is not None and self.low > 0) or (self.high is not None and self.high < 0):
            return Cut.OUTSIDE
        return Cut.TANGENT if reach == 0 else Cut.TWO_CROSSINGS

    def span(self, square: Fraction) -> tuple[float, float]:
        """Return from where to where the ridge is in the discs, in radii from the midpoint."""
        reach = math.sqrt(1 - self.width / (4 * square))
        ends = (self.low, self.high)
        inside = [t is not None and self.squared_distance(t) <= square for t in ends]
        low, high = (
            math.copysign(math.sqrt(t * t * self.width / square), t)
            if within and t is not None
            else sign * reach
            for t, within, sign in zip(ends, inside, (-1, 1), strict=True)
        )
        return low, high


class Textbook:
    """The Voronoi diagram of a small cloud, in the lattice of its coordinates."""

    def __init__(self, points: Any) -> None:
        self.sites, self.unit = lattice(points)
        self.representative = representatives(points)
        self.rows = sorted(set(self.representative))
        found = (self._ridge(i, j) for i, j in combinations(self.rows, 2))
        self.ridges = [ridge for ridge in found if ridge is not None]
        self.vertices = self._vertices()

    def square(self, radius: float) -> Fraction:
        """Return the square of a radius in units of the lattice."""
        return (Fraction(radius) / self.unit) ** 2

    def _ridge(self, i: int, j: int) -> Ridge | None:
        (ax, ay), (bx, by) = self.sites[i], self.sites[j]
        left = (ay - by, bx - ax)
        low: Fraction | None = None
        high: Fraction | None = None
        for k in self.rows:
            if k in (i, j):
                continue
            x, y = self.sites[k]
            wx, wy = x - ax, y - ay
            # As near to i as to k, or nearer: slope * t <= room.
            slope = 2 * (left[0] * wx + left[1] * wy)
            room = x * x + y * y - ax * ax - ay * ay - (ax + bx) * wx - (ay + by) * wy
            if slope == 0:
                if room < 0:
                    return None
            elif slope > 0:
                bound = Fraction(room, slope)
                high = bound if high is None or bound < high else high
            else:
                bound = Fraction(room, slope)
                low = bound if low is None or bound > low else low
            if low is not None and high is not None and low > high:
                return None
        return Ridge(i, j, low, high, left[0] * left[0] + left[1] * left[1])

    def place(self, ridge: Ridge, t: Fraction) -> Centre:
        """Return the point at position t of a ridge."""
        (ax, ay), (bx, by) = self.sites[ridge.first], self.sites[ridge.second]
        return Fraction(ax + bx, 2) + t * (ay - by), Fraction(ay + by, 2) + t * (bx - ax)

    def _vertices(self) -> dict[Centre, tuple[frozenset[int], Fraction]]:
        """Return each Voronoi vertex with the rows around it and its squared distance."""
        found: dict[Centre, tuple[frozenset[int], Fraction]] = {}
        for ridge in self.ridges:
            for t in {ridge.low, ridge.high} - {None}:
                centre, square = self.place(ridge, t), ridge.squared_distance(t)
                if centre not in found:
                    around = (
                        row
                        for row in self.rows
                        if squared_distance(centre, self.sites[row]) == square
                    )
                    found[centre] = frozenset(around), square
        return found

    # What is left at a radius

    def edges(self, square: Fraction) -> set[tuple[int, int]]:
        """Return the pairs whose cells share more than a Voronoi vertex, if discs grow on."""
        return {
            (ridge.first, ridge.second)
            for ridge in self.ridges
            if not ridge.is_point and ridge.cut(square) is not Cut.OUTSIDE
        }

    def groups(self, square: Fraction) -> dict[frozenset[int], Fraction]:
        """Return the rows around each Voronoi vertex that survives, with its square."""
        return {around: s for around, s in self.vertices.values() if s <= square}

    def arc_counts(self, square: Fraction) -> dict[int, int]:
        """Return how many arcs each cell has."""
        counts = dict.fromkeys(self.rows, 0)
        touched = set()
        for ridge in self.ridges:
            cut = ridge.cut(square)
            if ridge.is_point or cut is Cut.OUTSIDE:
                continue
            # An arc begins where a border leaves the ridge, once on either side.
            inside = ridge.ends_in(square)
            low_in = ridge.low is not None and ridge.low in inside
            high_in = ridge.high is not None and ridge.high in inside
            counts[ridge.first] += not high_in
            counts[ridge.second] += not low_in
            touched |= {ridge.first, ridge.second}
        return {row: counts[row] if row in touched else 1 for row in self.rows}

    def measures(self, square: Fraction) -> dict[int, tuple[float, float, float]]:
        """Return area, straight and round length of each cell's border, in units of the radius.

        A cell is made of triangles over its ridges and of sectors, which have the angles
        that the triangles leave.
        """
        cells = {row: [0.0, 0.0, 2 * math.pi] for row in self.rows}
        for ridge in self.ridges:
            if ridge.is_point or ridge.cut(square) is Cut.OUTSIDE:
                continue
            low, high = ridge.span(square)
            half = math.sqrt(ridge.width / (4 * square))
            for row in (ridge.first, ridge.second):
                cells[row][0] += half * (high - low) / 2
                cells[row][1] += high - low
                cells[row][2] -= math.atan2(high, half) - math.atan2(low, half)
        return {
            row: (straight + angle / 2, length, angle)
            for row, (straight, length, angle) in cells.items()
        }
