"""The bare triangulation in space, and finding tetrahedra in it."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings

import alphamesh as am
from alphamesh.check import check_delaunay
from alphamesh.errors import CoordinateRangeError, NonFiniteError
from strategies3 import clouds3


def rows_of(table):
    return sorted(map(tuple, table.tolist()))


@settings(max_examples=60)
@given(clouds3())
def test_the_bare_triangulation_is_that_of_the_complex(points):
    bare, full = am.delaunay(points), am.AlphaComplex(points).delaunay
    np.testing.assert_array_equal(bare.tetrahedra, full.tetrahedra)
    np.testing.assert_array_equal(bare.neighbors, full.neighbors)
    np.testing.assert_array_equal(bare.representative, full.representative)
    assert rows_of(bare.triangles) == rows_of(full.triangles)
    assert rows_of(bare.edges) == rows_of(full.edges)
    check_delaunay(bare)


def exact_sign(corners, query):
    """Return the sign of the volume of the three corners and the query."""
    base = [Fraction(float(q)) for q in query]
    rows = [[Fraction(float(p[k])) - base[k] for k in range(3)] for p in corners]
    (a, b, c), (d, e, f), (g, h, i) = rows
    volume = a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)
    return (volume > 0) - (volume < 0)


def found_slowly(points, tetrahedra, query):
    """Return the first closed tetrahedron that holds the query, by the definition."""
    for row, cell in enumerate(tetrahedra):
        corners = points[cell]
        for k in range(4):
            others = np.delete(corners, k, axis=0)
            if exact_sign(others, query) * exact_sign(others, corners[k]) < 0:
                break
        else:
            return row
    return -1


@settings(max_examples=25)
@given(clouds3())
def test_find_is_right_by_the_definition(points):
    points = np.asarray(points, dtype=np.float64)[:14]
    made = am.delaunay(points)
    middles = [points[list(face)].mean(axis=0) for face in made.triangles[:8]]
    queries = np.concatenate([points, np.reshape(middles, (-1, 3)), [[0.3, 0.4, 0.5]]])
    expected = [found_slowly(points, made.tetrahedra, query) for query in queries]
    assert made.find(queries).tolist() == expected
    assert am.AlphaComplex(points).delaunay.find(queries).tolist() == expected


def test_find_in_many_tetrahedra():
    rng = np.random.default_rng(5)
    made = am.delaunay(rng.random((3000, 3)))
    centres = made.points[made.tetrahedra].mean(axis=1)
    inside = made.find(centres)
    wrong = inside != np.arange(len(made.tetrahedra))  # centres of the flattest are rounded
    assert wrong.mean() < 1e-3
    np.testing.assert_array_equal(inside, made.find(centres, threads=1))
    assert (made.find(centres + 2) == -1).all()
    corner = made.find(made.points[:50])
    assert (made.tetrahedra[corner] == np.arange(50)[:, np.newaxis]).any(axis=1).all()
    first = [int(np.flatnonzero((made.tetrahedra == row).any(axis=1))[0]) for row in range(50)]
    assert corner.tolist() == first


def test_find_where_there_is_nothing():
    flat = am.delaunay([[0, 0, 0], [1, 0, 1], [0, 1, 1], [1, 1, 2]])
    assert len(flat.triangles) == 2 and len(flat.edges) == 5
    assert flat.find([[0, 0, 0], [5, 5, 5]]).tolist() == [-1, -1]
    assert am.delaunay(np.empty((0, 3))).find([[0, 0, 0]]).tolist() == [-1]
    assert am.delaunay(np.eye(4, 3)).find(np.empty((0, 3))).shape == (0,)


def test_queries_out_of_scale():
    made = am.delaunay([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
    assert made.find([[1e300, 0.1, 0.1], [0.1, 0.1, 0.1], [-1e300, 0, 0]]).tolist() == [
        -1,
        0,
        -1,
    ]
    shape = am.AlphaComplex(made.points).at(9)
    assert shape.region_of([[1e300, 1e-300, 0.1], [0.1, 0.1, 0.1]]).tolist() == [-1, 0]
    for ask in (made.find, shape.side_of):
        with pytest.raises(CoordinateRangeError, match="row 1 of the queries"):
            ask([[0.1, 0.1, 0.1], [0.1, 0.1, 1e-300]])
        with pytest.raises(NonFiniteError):
            ask([[0.1, 0.1, np.nan]])
