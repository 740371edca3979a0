"""The triangulation is the one of the definition, ties and all."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import oracles
from alphamesh import _kernels
from alphamesh.check import check_delaunay
from alphamesh.delaunay import delaunay
from alphamesh.errors import CoordinateRangeError, NonFiniteError
from strategies import CIRCLES, FAMILIES, beyond_range


def assert_by_definition(points):
    result = delaunay(points)
    assert result.representative.tolist() == oracles.representatives(points)
    triangles = oracles.delaunay_triangles(points)
    assert oracles.row_set(result.triangles) == triangles
    assert oracles.row_set(result.edges) == oracles.delaunay_edges(points, triangles)
    assert len(result.path) == (0 if triangles else len(result.edges))
    assert_neighbors(result)
    check_delaunay(result)


def assert_neighbors(result):
    triangles = result.triangles.tolist()
    opposite = {(frozenset(t) - {v}, row) for row, t in enumerate(triangles) for v in t}
    for row, triangle in enumerate(triangles):
        for corner, neighbor in zip(triangle, result.neighbors[row].tolist(), strict=True):
            edge = frozenset(triangle) - {corner}
            others = [t for e, t in opposite if e == edge and t != row]
            assert others == ([] if neighbor < 0 else [neighbor])


@pytest.mark.parametrize("family", FAMILIES)
@given(data=st.data())
def test_is_the_definition(family, data):
    assert_by_definition(data.draw(FAMILIES[family]))


def grid(columns, rows):
    y, x = np.mgrid[0:rows, 0:columns]
    return np.column_stack((x.ravel(), y.ravel())).astype(float)


LARGER = {
    "grid": grid(7, 6),
    "grid of tenths": grid(7, 6) * 0.1,
    "sheared grid": grid(7, 6) @ np.array([[1.0, 0.0], [0.1, 1.0]]),
    "grid far off": grid(7, 6) * 0.1 + 1e8,
    "circle of 25": np.array(CIRCLES[25], dtype=float),
    "circle of 65 and its centre": np.array([*CIRCLES[65], (0, 0)], dtype=float),
    "two circles": np.array([*CIRCLES[25], *((2 * x, 2 * y) for x, y in CIRCLES[5])], float),
    "float circle": np.column_stack((np.cos(np.arange(40)), np.sin(np.arange(40)))),
    "spiral": np.arange(1, 45)[:, np.newaxis]
    * np.column_stack((np.cos(np.arange(44)), np.sin(np.arange(44)))),
    "line and one point": np.array([*((t, 2 * t) for t in range(40)), (5, 3)], dtype=float),
    "two lines": np.array([(t, y) for t in range(20) for y in (0, 1)], dtype=float),
    "two far clusters": np.concatenate((grid(5, 4) * 1e-9, grid(5, 4) * 1e-9 + 1e3)),
    "parabola": np.column_stack((np.arange(-20.0, 21), np.arange(-20.0, 21) ** 2)),
    "exponents": np.column_stack((2.0 ** np.arange(-30, 10), 3.0 ** np.arange(-20, 20))),
}


@pytest.mark.parametrize("name", LARGER)
def test_is_the_definition_on_larger_clouds(name):
    assert_by_definition(LARGER[name])


@pytest.mark.parametrize("seed", range(6))
def test_is_the_definition_on_crowded_integers(seed):
    rng = np.random.default_rng(seed)
    assert_by_definition(rng.integers(0, 8, (40, 2)).astype(float))


def test_no_point():
    result = delaunay(np.empty((0, 2)))
    assert result.representative.shape == (0,)
    assert result.triangles.shape == result.neighbors.shape == (0, 3)
    assert result.edges.shape == (0, 2)


@pytest.mark.parametrize("count", [1, 5])
def test_one_distinct_point(count):
    result = delaunay(np.full((count, 2), 3.0))
    assert result.representative.tolist() == [0] * count
    assert result.triangles.shape == result.neighbors.shape == (0, 3)
    assert result.edges.shape == (0, 2)


def test_two_points():
    result = delaunay([[1.0, 1.0], [0.0, 5.0]])
    assert result.triangles.shape == (0, 3)
    assert result.edges.tolist() == result.path.tolist() == [[0, 1]]


def test_one_triangle():
    result = delaunay([[0.0, 0.0], [0.0, 1.0], [1.0, 0.0]])
    assert result.triangles.tolist() == [[0, 1, 2]]
    assert result.neighbors.tolist() == [[-1, -1, -1]]


@pytest.mark.parametrize("direction", [(1, 0), (0, 1), (1, 1), (3, -7), (0.1, 0.3)])
def test_long_line(direction):
    steps = np.random.default_rng(1).permutation(3000)
    result = delaunay(np.multiply.outer(steps, np.array(direction) * 2.0**10))
    rounded = direction == (0.1, 0.3)  # those floats do not lie on a line
    assert (len(result.triangles) > 0) == rounded
    if not rounded:
        order = np.argsort(steps)
        expected = np.sort(np.column_stack((order[:-1], order[1:])), axis=1)
        assert oracles.row_set(result.path) == oracles.row_set(expected)
    check_delaunay(result)


def test_negative_zero_is_zero():
    result = delaunay([[0.0, -0.0], [-0.0, 0.0], [1.0, 0.0], [-0.0, 1.0]])
    assert result.representative.tolist() == [0, 0, 2, 3]
    assert result.triangles.tolist() == [[0, 2, 3]]


def test_every_tie_of_a_square_goes_to_the_largest_corner():
    # (1, 1) is lifted up, out of the circle of the others: the diagonal avoids it.
    result = delaunay([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]])
    assert oracles.row_set(result.triangles) == {(0, 1, 2), (1, 2, 3)}


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
@pytest.mark.parametrize("count", [1, 3, 70_000])
def test_not_finite(bad, count):
    points = np.random.default_rng(0).uniform(size=(count, 2))
    points[count // 2, 1] = bad
    for kernel in (_kernels.delaunay2, _kernels.alpha2):
        with pytest.raises(_kernels.BadCoordinates):
            kernel(points, 2)
    with pytest.raises(NonFiniteError, match=f"row {count // 2} ") as caught:
        delaunay(points)
    assert caught.value.rows == (count // 2,)


@given(points=beyond_range())
def test_beyond_range_is_refused(points):
    for kernel in (_kernels.delaunay2, _kernels.alpha2):
        with pytest.raises(_kernels.BadCoordinates):
            kernel(points, 1)
    with pytest.raises(CoordinateRangeError) as caught:
        delaunay(points)
    assert all(abs(points[row]).max() > 0 for row in caught.value.rows)


@pytest.mark.parametrize("top", [1023, 500, 0, -400])
def test_edge_of_the_range(top):
    # Odd multiples of 2**(top - 489), and 2**top: the last ratio that is accepted.
    points = np.ldexp([[0.0, 0.0], [1.0, 0.0], [3.0, 1.0], [2.0**489, 1.0]], top - 489)
    assert oracles.in_range(points)
    assert_by_definition(points)
    points[3, 0] *= 2 if top < 1023 else 1
    points[:3] /= 1 if top < 1023 else 2
    assert not oracles.in_range(points)
    with pytest.raises(CoordinateRangeError):
        delaunay(points)
