"""Point location: the first of the closed triangles that hold a query, exactly."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

import oracles
from alphamesh.delaunay import delaunay
from alphamesh.errors import (
    CloudShapeError,
    CoordinateRangeError,
    NonFiniteError,
    ParameterError,
)
from strategies import FAMILIES


def by_definition(points, triangles, queries):
    """Return the first triangle that has each query on no outer side of its sides."""
    cloud, _ = oracles.lattice(np.concatenate((points, queries)))
    corners = [[cloud[row] for row in triangle] for triangle in triangles.tolist()]
    found = []
    for query in cloud[len(points) :]:
        for row, (a, b, c) in enumerate(corners):
            turn = oracles.orient(a, b, c)
            sides = [oracles.orient(p, q, query) * turn for p, q in ((a, b), (b, c), (c, a))]
            if min(sides) >= 0:
                found.append(row)
                break
        else:
            found.append(-1)
    return found


@pytest.mark.parametrize("family", FAMILIES)
@given(data=st.data())
def test_is_the_definition(family, data):
    points = data.draw(FAMILIES[family]).reshape(-1, 2)
    result = delaunay(points)
    queries = data.draw(queries_near(points))
    if not oracles.in_range(np.concatenate((points, queries))):
        assume(oracles.in_range(np.concatenate((points, inside_box(points, queries)))))
    found = result.find(queries)
    assert found.dtype == np.int32
    assert found.tolist() == by_definition(points, result.triangles, queries)


def inside_box(points, queries):
    return queries[
        ((queries >= points.min(axis=0)) & (queries <= points.max(axis=0))).all(axis=1)
    ]


@st.composite
def queries_near(draw, points):
    """Draw points of the cloud, points between them, and points around them."""
    if len(points) == 0:
        return np.array([[0.0, 0.0], [1.0, -2.0]])
    row = st.integers(0, len(points) - 1)
    pairs = draw(st.lists(st.tuples(row, row), min_size=1, max_size=6))
    share = np.array(
        draw(st.lists(st.sampled_from((0.0, 0.5, 0.25, 1.5, -0.5)), min_size=6, max_size=6))
    )
    start, end = points[[a for a, _ in pairs]], points[[b for _, b in pairs]]
    between = start + share[: len(pairs), None] * (end / 2 - start / 2) * 2
    return np.concatenate((points, between[np.isfinite(between).all(axis=1)]))


def test_every_triangle_is_found():
    points = np.random.default_rng(1).normal(size=(3000, 2))
    result = delaunay(points)
    centres = points[result.triangles].mean(axis=1)
    assert np.array_equal(result.find(centres), np.arange(len(result.triangles)))


def lowest_at_vertices(result):
    lowest = np.full(len(result.points), len(result.triangles))
    np.minimum.at(lowest, result.triangles, np.arange(len(result.triangles))[:, None])
    return lowest


@pytest.mark.parametrize("name", ["uniform", "grid", "fan", "circle"])
def test_points_of_the_cloud_are_in_their_first_triangle(name):
    rng = np.random.default_rng(2)
    y, x = np.mgrid[0:60, 0:50]
    angle = np.arange(2000) * 0.1
    points = {
        "uniform": rng.random((3000, 2)),
        "grid": np.column_stack((x.ravel(), y.ravel())).astype(float),
        "fan": np.concatenate(
            ([[0.0, 1e3]], np.column_stack((np.arange(2000.0), np.zeros(2000))))
        ),
        "circle": np.column_stack((np.cos(angle), np.sin(angle))),
    }[name]
    result = delaunay(points)
    order = rng.permutation(len(points))
    assert np.array_equal(result.find(points[order]), lowest_at_vertices(result)[order])


def test_midpoints_of_edges_are_in_their_first_triangle():
    points = np.random.default_rng(3).integers(0, 500, (2000, 2)).astype(float) * 2
    result = delaunay(points)
    first = {}
    for row, (a, b, c) in enumerate(result.triangles.tolist()):
        for edge in ((a, b), (a, c), (b, c)):
            first.setdefault(edge, row)
    edges = result.edges
    middles = points[edges].sum(axis=1) / 2
    expected = [first[edge] for edge in map(tuple, edges.tolist())]
    assert result.find(middles).tolist() == expected


def test_outside():
    result = delaunay(np.random.default_rng(4).random((500, 2)))
    angle = np.linspace(0, 2 * math.pi, 100)
    around = 0.5 + 0.8 * np.column_stack((np.cos(angle), np.sin(angle)))
    assert result.find(around).tolist() == [-1] * 100
    assert result.find([[1e300, 1e300], [0.5, 1e100]]).tolist() == [-1, -1]


@pytest.mark.parametrize("points", [np.empty((0, 2)), [[1.0, 1.0]], [[0.0, 0.0], [1.0, 1.0]]])
def test_nothing_is_found_without_triangles(points):
    assert delaunay(points).find([[1.0, 1.0], [0.5, 0.5]]).tolist() == [-1, -1]


def test_no_queries():
    found = delaunay([[0.0, 0.0], [0.0, 1.0], [1.0, 0.0]]).find(np.empty((0, 2)))
    assert found.shape == (0,)
    assert found.dtype == np.int32


def test_closed_and_exact():
    result = delaunay([[0.0, 0.0], [0.0, 1.0], [1.0, 0.0]])
    above = math.nextafter(0.5, 1)
    queries = [[0.5, 0.5], [0.5, above], [0.0, 0.0], [1.0, 0.0], [-5e-100, 0.5], [0.1, 0.1]]
    assert result.find(queries).tolist() == [0, -1, 0, 0, -1, 0]


@pytest.mark.parametrize("count", [500, 70_000])
def test_threads_and_order_do_not_matter(count):
    rng = np.random.default_rng(5)
    y, x = np.mgrid[0:100, 0:100]
    result = delaunay(np.column_stack((x.ravel(), y.ravel())) * 0.1)
    queries = rng.integers(-20, 220, (count, 2)) * 0.05
    expected = result.find(queries, threads=1)
    assert np.array_equal(result.find(queries, threads=4), expected)
    order = rng.permutation(count)
    assert np.array_equal(result.find(queries[order]), expected[order])
    assert not expected.flags.writeable


def test_scale_does_not_matter():
    rng = np.random.default_rng(6)
    points, queries = rng.integers(0, 50, (300, 2)), rng.integers(-5, 55, (400, 2))
    expected = delaunay(points).find(queries)
    for power in (-1000, -400, 400, 1000):
        result = delaunay(np.ldexp(points, power))
        assert np.array_equal(result.find(np.ldexp(queries, power)), expected)


def test_errors():
    result = delaunay([[0.0, 0.0], [0.0, 1.0], [1.0, 0.0]])
    with pytest.raises(NonFiniteError, match="row 1 "):
        result.find([[0.0, 0.0], [math.nan, 0.0]])
    with pytest.raises(CloudShapeError):
        result.find([0.5, 0.5])
    with pytest.raises(ParameterError, match="threads must be a whole number"):
        result.find([[0.5, 0.5]], threads=0)
    with pytest.raises(
        CoordinateRangeError, match="beside the points for exact arithmetic in row 0 of"
    ):
        result.find([[0.5, 5e-324]])
    with pytest.raises(CoordinateRangeError, match="in row 1 of the queries") as caught:
        result.find([[1e300, 1e-300], [0.5, 1e-300], [0.5, 0.5]])
    assert caught.value.rows == (1,)
