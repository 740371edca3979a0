"""Filtration values are those of the definition, to a few ulps even on slivers."""

from __future__ import annotations

import math
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import oracles
from alphamesh import AlphaComplex
from alphamesh.check import check_delaunay, check_filtration, check_shape
from alphamesh.delaunay import delaunay
from alphamesh.errors import CoordinateRangeError, NonFiniteError
from alphamesh.filtration import filtration
from alphamesh.shape import AlphaShape
from strategies import CROWDS, FAMILIES, beyond_range, clouds, crowd

#: What the values promise, relative; a radius among subnormals is rounded to their step.
PROMISED = 1e-14
SUBNORMAL = Fraction(5e-324)


def values_of(result):
    """Return a dict of every simplex and its value."""
    return {
        tuple(simplex): value
        for simplices, radii in zip(result.simplices, result.radii, strict=True)
        for simplex, value in zip(simplices.tolist(), radii.tolist(), strict=True)
    }


def greatest_error(values, squares):
    """Return the largest relative error, leaving out what subnormal numbers cannot hold."""
    worst = 0.0
    for simplex, square in squares.items():
        error = oracles.relative_error(values[simplex], square)
        if error > worst and not within_a_subnormal(values[simplex], square):
            worst = error
    return worst


def within_a_subnormal(value, square):
    low, high = max(Fraction(value) - SUBNORMAL, Fraction(0)), Fraction(value) + SUBNORMAL
    return low**2 <= square <= high**2


def assert_by_definition(points, error=PROMISED):
    squares = oracles.filtration_squares(points)
    if oracles.square_root(max(squares.values(), default=Fraction(0))) == math.inf:
        with pytest.raises(CoordinateRangeError, match="too large"):
            filtration(points)
        return
    result = filtration(points)
    values = values_of(result)
    assert values.keys() == squares.keys()
    assert greatest_error(values, squares) <= error
    assert_equal_where_equal(values, squares, points)
    assert_cofaces(result)
    check_filtration(result)


def assert_equal_where_equal(values, squares, points):
    """Where an edge has the value of a triangle, it has it to the last bit.

    Triangles of one circle may differ by their rounding; the edge takes the least.
    """
    exact, unit = oracles.lattice(points)
    for i, j in (simplex for simplex in squares if len(simplex) == 2):
        cofaces = [t for t in squares if len(t) == 3 and i in t and j in t]
        assert all(values[i, j] <= values[t] for t in cofaces)
        length_sq = oracles.squared_distance(exact[i], exact[j]) * unit**2
        if squares[i, j] != length_sq / 4:
            assert values[i, j] == min(values[t] for t in cofaces)
        else:
            right_angled = [t for t in cofaces if squares[t] == length_sq / 4]
            assert all(values[i, j] == values[t] for t in right_angled)


def assert_cofaces(result):
    triangles = result.simplices[2].tolist()
    for edge, found in zip(
        result.simplices[1].tolist(), result.edge_triangles.tolist(), strict=True
    ):
        cofaces = {row for row, t in enumerate(triangles) if set(edge) <= set(t)}
        assert cofaces == set(found) - {-1}
        assert found[0] >= 0 or not triangles


@pytest.mark.parametrize("family", FAMILIES)
@given(data=st.data())
def test_is_the_definition(family, data):
    assert_by_definition(data.draw(FAMILIES[family]))


def thin_triangles(rng, offset):
    """Three points within 1e-9 of a line, so far off that few digits are left of that."""
    slope, height = rng.uniform(-2, 2), rng.uniform(-1e-9, 1e-9, 3)
    x = rng.uniform(-1, 1, 3)
    return np.column_stack((x + offset, slope * x + height + offset))


@pytest.mark.parametrize("offset", [0.0, 1.0, 1e3])
def test_slivers(offset):
    rng = np.random.default_rng(int(offset))
    for _ in range(150):
        assert_by_definition(thin_triangles(rng, offset))


def test_slivers_in_company():
    rng = np.random.default_rng(7)
    for width in (1e-3, 1e-9, 1e-13, 1e-16):
        points = rng.uniform(-1, 1, (12, 2)) * [1.0, width]
        angle = rng.uniform(0, 3)
        turn = np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
        assert_by_definition(points)
        assert_by_definition(points @ turn)


@pytest.mark.parametrize("spread", [1.0, 1e-3, 1e-6])
def test_far_from_the_origin(spread):
    rng = np.random.default_rng(8)
    for _ in range(10):
        assert_by_definition(rng.normal(size=(10, 2)) * spread + 1e8)


@pytest.mark.parametrize("tilt", [1e-3, 1e-8, 1e-13, 1e-20, 1e-100])
def test_flat_triangles_of_known_radius(tilt):
    # The circle through (-1, 0), (1, 0) and (0, h) has the radius (1 + h²) / 2h.
    result = filtration([[-1.0, 0.0], [1.0, 0.0], [0.0, tilt]])
    exact = (1 + Fraction(tilt) ** 2) / (2 * Fraction(tilt))
    assert result.radii[2][0] == pytest.approx(float(exact), rel=4e-16)
    assert values_of(result)[0, 1] == result.radii[2][0]


def test_known_values():
    values = values_of(filtration([[0.0, 0.0], [4.0, 0.0], [0.0, 3.0], [4.0, 3.0]]))
    assert values == {
        **{(row,): 0.0 for row in range(4)},
        (0, 1): 2.0, (2, 3): 2.0, (0, 2): 1.5, (1, 3): 1.5, (1, 2): 2.5,
        (0, 1, 2): 2.5, (1, 2, 3): 2.5,
    }  # fmt: skip


@pytest.mark.parametrize("scale", [2.0**-1000, 1.0, 2.0**1000])
def test_right_angles_share_their_value(scale):
    """Pythagorean triples, turned: the longest side is exactly that of the triangle."""
    for a, b, c in [(3, 4, 5), (5, 12, 13), (20, 21, 29), (696, 697, 985)]:
        for corner in [(0, 0), (17, -5)]:
            points = np.array([(0, 0), (a, 0), (0, b)]) @ np.array([(2, 1), (-1, 2)])
            values = values_of(filtration((points + corner) * scale))
            assert values[1, 2] == values[0, 1, 2]
            exact = Fraction(5 * c * c, 4) * Fraction(scale) ** 2
            assert oracles.relative_error(values[1, 2], exact) <= 2**-52


def test_right_angle_whose_leg_rounds_to_more_than_the_hypotenuse():
    """A leg and the hypotenuse differ by less than the rounding of their lengths."""
    points = np.array([[-1.0, -2.0], [1 + 2.0**-52, -1 - 2.0**-51], [1.0, -1.0]])
    found = filtration(points)
    check_filtration(found)
    assert found.radii[2][0] >= found.radii[1].max()
    space = filtration(np.column_stack((points, points.sum(axis=1))))
    assert space.radii[2][0] >= space.radii[1].max()


def test_no_point():
    result = filtration(np.empty((0, 2)))
    assert [len(simplices) for simplices in result.simplices] == [0, 0, 0]
    assert [simplices.shape[1] for simplices in result.simplices] == [1, 2, 3]
    check_filtration(result)


@pytest.mark.parametrize("count", [1, 4])
def test_one_distinct_point(count):
    result = filtration(np.full((count, 2), -2.5))
    assert values_of(result) == {(0,): 0.0}
    check_filtration(result)


def test_two_distinct_points():
    result = filtration([[0.0, 0.0], [3.0, 4.0], [0.0, 0.0], [3.0, 4.0]])
    assert values_of(result) == {(0,): 0.0, (1,): 0.0, (0, 1): 2.5}
    assert result.edge_triangles.tolist() == [[-1, -1]]


def test_line():
    result = filtration([[5.0, 5.0], [0.0, 0.0], [2.0, 2.0], [2.0, 2.0]])
    values = values_of(result)
    assert values.keys() == {(0,), (1,), (2,), (0, 2), (1, 2)}
    assert values[1, 2] == math.sqrt(2)
    check_filtration(result)


def test_circle_beyond_the_largest_float():
    points = np.array([[0.0, 0.0], [1.0, 1e-18], [2.0, 0.0]]) * 2.0**1000
    with pytest.raises(CoordinateRangeError, match="rows 0, 1, 2 is too large") as caught:
        filtration(points)
    assert set(caught.value.rows) == {0, 1, 2}
    check_filtration(filtration(points * 2.0**-600))


def test_circle_far_larger_than_its_points():
    # As thin as coordinates allow: the radius is 2**1466 units, yet a float.
    unit = 2.0**-1000
    points = np.array([[1.0, 0.0], [2.0**489, 1.0], [-(2.0**489), -1.0]]) * unit
    assert_by_definition(points)


@pytest.mark.parametrize("kind", CROWDS)
@given(seed=st.integers(0, 2**32 - 1))
def test_crowds(kind, seed):
    """Too large for the definition: the validators prove them, triangulation and all."""
    points = crowd(kind, seed)
    result = filtration(points)
    check_filtration(result)
    plain = delaunay(points)
    check_delaunay(plain)
    assert np.array_equal(plain.triangles, result.simplices[2])


@given(points=clouds(), share=st.floats(0, 1))
def test_shapes_of_any_radius(points, share):
    try:
        result = filtration(points)
    except CoordinateRangeError:
        return
    radii = np.concatenate([[0.0, np.inf], *result.radii[1:]])
    for radius in (radii[int(share * (len(radii) - 1))], share):
        check_shape(AlphaShape(result, radius))


@given(points=clouds())
def test_the_complex_is_this_filtration(points):
    squares = oracles.filtration_squares(points)
    if oracles.square_root(max(squares.values(), default=Fraction(0))) == math.inf:
        return
    cloud = AlphaComplex(points)
    assert values_of(cloud).keys() == squares.keys()


@given(points=beyond_range())
def test_the_complex_names_rows_beyond_range(points):
    with pytest.raises(CoordinateRangeError) as caught:
        AlphaComplex(points)
    assert caught.value.rows
    assert f"{caught.value.rows[0]}" in str(caught.value)


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_the_complex_names_rows_that_are_not_finite(bad):
    points = np.zeros((9, 2))
    points[[2, 5], [0, 1]] = bad
    with pytest.raises(NonFiniteError, match="rows 2, 5") as caught:
        AlphaComplex(points)
    assert caught.value.rows == (2, 5)
