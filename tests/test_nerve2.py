"""The nerve of the restricted cells is the alpha complex, and what a textbook draws.

Clouds by the thousand, drawn by NumPy from seeds; radii between the filtration values and
exactly equal to them.
"""

from __future__ import annotations

import itertools
from fractions import Fraction

import numpy as np
import pytest

from alphamesh.filtration import filtration
from alphamesh.restricted import restricted_voronoi
from oracles import row_set
from strategies import CIRCLES
from textbook import Cut, Textbook

ROUNDS = 300


def generic(rng):
    return rng.random((rng.integers(0, 9), 2))


def grid(rng):
    return rng.integers(0, 4, (rng.integers(1, 10), 2)).astype(float)


def scaled_grid(rng):
    return grid(rng) * rng.choice([0.1, 1 / 3, 2.0**-30]) + rng.choice([0.0, 100.0])


def cocircular(rng):
    ring = np.array(CIRCLES[int(rng.choice([5, 25]))], dtype=float)
    chosen = ring[rng.permutation(len(ring))[: rng.integers(3, 8)]]
    inside = rng.integers(-3, 4, (rng.integers(0, 3), 2))
    return np.concatenate((chosen, inside)) + rng.integers(-9, 9)


def rectangle(rng):
    """A block of a grid: nothing but cocircular quadruples and shared sides."""
    columns, rows = rng.integers(1, 5), rng.integers(1, 4)
    y, x = np.mgrid[0:rows, 0:columns]
    points = np.column_stack((x.ravel(), y.ravel())).astype(float)
    return rng.permutation(points)[:9]


def collinear(rng):
    steps = rng.integers(-9, 10, rng.integers(0, 8))
    return np.outer(steps, rng.integers(-3, 4, 2)) + rng.integers(-5, 5, 2).astype(float)


def duplicates(rng):
    return rng.integers(0, 3, (rng.integers(2, 12), 2)).astype(float) * 0.5


def nearly_cocircular(rng):
    points = cocircular(rng)
    return points + rng.integers(-1, 2, points.shape) * np.spacing(np.abs(points) + 1)


def nearly_collinear(rng):
    points = collinear(rng)
    return points + rng.integers(-1, 2, points.shape) * 2.0 ** -int(rng.integers(10, 45))


FAMILIES = (
    generic,
    grid,
    scaled_grid,
    cocircular,
    rectangle,
    collinear,
    duplicates,
    nearly_cocircular,
    nearly_collinear,
)


def values_of(built):
    """Return the filtration value of each simplex of a filtration."""
    return {
        tuple(simplex): value
        for simplices, radii in zip(built.simplices, built.radii, strict=True)
        for simplex, value in zip(simplices.tolist(), radii.tolist(), strict=True)
    }


def check_nerve(cells, built, book, square, later=frozenset()):
    """Compare the cells at a radius with the complex and with the book at its square.

    `later` are the simplices whose value is the radius, or less, but for rounding, which
    made it a float above.
    """
    edges, triangles = row_set(cells.edges), row_set(cells.triangles)
    for k, nerve in ((1, edges), (2, triangles)):
        assert nerve == row_set(built.simplices[k][built.radii[k] <= cells.radius])
    proper = book.edges(square)
    assert proper - edges <= later
    groups = book.groups(square)
    # Where more than three cells meet, ridges without length make up triangles.
    extra = edges - proper
    for around in groups:
        inside = {t for t in triangles | later if len(t) == 3 and around.issuperset(t)}
        assert len(inside) == len(around) - 2
        across = {e for e in extra if around.issuperset(e)}
        assert len(across) <= len(around) - 3
        if not later:
            assert len(across) == len(around) - 3
    for simplex in extra | triangles:
        assert any(around.issuperset(simplex) for around in groups)


def radii_between(built):
    """Return radii well between the critical ones, below the first, and beyond the last."""
    critical = np.unique(np.concatenate(built.radii))
    if len(critical) == 0:
        return [1.0]
    between = [a + (b - a) / 2 for a, b in itertools.pairwise(critical) if b - a > 1e-9 * b]
    return [*between, float(critical[-1]) * 1.5 or 1.0]


def sampled(rng, values, most):
    return [values[k] for k in rng.permutation(len(values))[:most].tolist()]


@pytest.mark.parametrize("family", FAMILIES, ids=lambda family: family.__name__)
def test_between_the_values(family):
    rng = np.random.default_rng(1)
    for _ in range(ROUNDS):
        points = family(rng).reshape(-1, 2)
        built, book = filtration(points), Textbook(points)
        for radius in sampled(rng, radii_between(built), 2):
            cells = restricted_voronoi(built, radius)
            square = book.square(radius)
            check_nerve(cells, built, book, square)
            check_cells(cells, book, square)


def check_cells(cells, book, square):
    """Compare the outlines and the measures of the cells with the book."""
    arcs = np.bincount(cells.cell[cells.is_arc], minlength=len(cells.points))
    expected = book.arc_counts(square)
    for row in range(len(cells.points)):
        assert arcs[row] == expected.get(row, 0)
    radius = cells.radius
    for row, (area, straight, around) in book.measures(square).items():
        assert cells.area[row] / radius**2 == pytest.approx(area, rel=1e-9, abs=1e-12)
        assert cells.segment_length[row] / radius == pytest.approx(straight, abs=1e-10)
        assert cells.arc_length[row] / radius == pytest.approx(around, abs=1e-10)


@pytest.mark.parametrize("family", FAMILIES, ids=lambda family: family.__name__)
def test_exactly_at_the_values(family):
    """Discs are closed: at its own value a simplex is there, as a point if need be."""
    rng = np.random.default_rng(2)
    for _ in range(ROUNDS):
        points = family(rng).reshape(-1, 2)
        built, book = filtration(points), Textbook(points)
        values = values_of(built)
        squares = exact_squares(book, values)
        for simplex in sampled(rng, [s for s in values if len(s) > 1], 2):
            radius, square = values[simplex], squares[simplex]
            # Floats may put values in another order that differ, if at all, in the last digits.
            later = {s for s in squares if squares[s] <= square and values[s] > radius}
            sooner = {s for s in squares if squares[s] > square and values[s] <= radius}
            for other in later | sooner:
                assert abs(squares[other] / square - 1) < Fraction(1, 2**45)
            if sooner:
                continue
            cells = restricted_voronoi(built, radius)
            check_nerve(cells, built, book, square, frozenset(later))
            assert simplex in row_set(cells.edges if len(simplex) == 2 else cells.triangles)
            if family in (rectangle, duplicates):
                assert not later


def exact_squares(book, values):
    """Return the exact squared value of each edge and triangle, by the book."""
    ridges = {(ridge.first, ridge.second): ridge for ridge in book.ridges}
    squares = {}
    for simplex in values:
        if len(simplex) == 2:
            ridge = ridges[simplex]
            # The discs first meet the ridge at its point nearest to the midpoint.
            nearest = Fraction(0)
            if ridge.low is not None and ridge.low > 0:
                nearest = ridge.low
            elif ridge.high is not None and ridge.high < 0:
                nearest = ridge.high
            squares[simplex] = ridge.squared_distance(nearest)
        elif len(simplex) == 3:
            (squares[simplex],) = {
                s for around, s in book.vertices.values() if around.issuperset(simplex)
            }
    return squares


def test_every_cut_of_the_book_is_met():
    points = np.array([[0.0, 0.0], [2.0, 0.0], [1.0, 1.5], [1.0, -6.0]])
    book = Textbook(points)
    (ridge,) = [r for r in book.ridges if (r.first, r.second) == (0, 1)]
    cuts = [ridge.cut(book.square(r)) for r in (0.9, 1.0, 1.01, 1.3, 5.0)]
    assert cuts == [
        Cut.OUTSIDE,
        Cut.TANGENT,
        Cut.TWO_CROSSINGS,
        Cut.ONE_CROSSING,
        Cut.INSIDE,
    ]
