"""Sizes at all radii in one pass, against the shapes at those radii."""

from __future__ import annotations

import math
import pickle

import numpy as np
import pytest
from hypothesis import given

import alphamesh as am
from alphamesh.errors import ParameterError
from complexes import complexes


@given(complexes())
def test_curves_say_what_the_shapes_say(cx):
    curves = cx.measure_curves()
    critical = cx.critical_radii().tolist()
    radii = [0.0, *critical, *(math.nextafter(r, 0) for r in critical[:20]), math.inf]
    shapes = [cx.at(r) for r in radii]
    counts = [shape.counts for shape in shapes]
    assert curves.triangle_count(radii).tolist() == [count["triangles"] for count in counts]
    assert curves.edge_count(radii).tolist() == [count["edges"] for count in counts]
    euler = [shape.euler_characteristic for shape in shapes]
    assert curves.euler_characteristic(radii).tolist() == euler
    total = max(shape.area for shape in shapes)
    slack = 5e-324 * len(cx.simplices[2])
    for area, shape in zip(curves.area(radii).tolist(), shapes, strict=True):
        assert area == pytest.approx(shape.area, rel=1e-12, abs=1e-20 * total + slack)
    longest = sum_of_lengths(cx)
    for perimeter, shape in zip(curves.perimeter(radii).tolist(), shapes, strict=True):
        assert perimeter == pytest.approx(
            shape.perimeter, rel=1e-12, abs=1e-24 * longest + slack
        )
        assert perimeter >= 0 and (perimeter == 0 or shape.perimeter > 0)


def sum_of_lengths(cx):
    if cx.dimension < 1:
        return 0.0
    with np.errstate(over="ignore"):
        steps = np.diff(cx.points[cx.simplices[1]], axis=1)[:, 0]
        return float(np.minimum(np.hypot(*steps.T).sum(), 1e300))


def test_no_rounding_is_left_over():
    """A perimeter is a difference of long sums: of all edges that came, and that went."""
    points = np.random.default_rng(1).random((20_000, 2))
    points[0] = 1e6, 1e6
    cx = am.AlphaComplex(points)
    curves = cx.measure_curves()
    for radius in (0.001, 0.004, 0.01, 0.05):
        shape = cx.at(radius)
        assert float(curves.perimeter(radius)) == pytest.approx(shape.perimeter, rel=1e-14)
        assert float(curves.area(radius)) == pytest.approx(shape.area, rel=1e-14)


def test_shapes_of_radii_are_kept():
    curves = am.AlphaComplex([[0, 0], [2, 0], [0, 2], [2, 2]]).measure_curves()
    table = np.array([[0.0, 1.0, 1.4], [1.5, 2.0, math.inf]])
    assert curves.area(table).tolist() == [[0, 0, 0], [4, 4, 4]]
    assert curves.perimeter(table).tolist() == [[0, 0, 0], [8, 8, 8]]
    assert curves.triangle_count(table).tolist() == [[0, 0, 0], [2, 2, 2]]
    assert curves.edge_count(1).shape == () and int(curves.edge_count(1)) == 4
    assert curves.euler_characteristic([0, 1, 2]).tolist() == [4, 0, 1]
    assert curves.vertex_count == 4
    assert curves.triangle_radii.tolist() == [math.sqrt(2)] * 2
    assert repr(curves) == "<MeasureCurves: 7 simplices come>"


@pytest.mark.parametrize("exponent", [-500, 500])
def test_curves_scale_with_the_points(exponent):
    points = np.random.default_rng(2).random((100, 2))
    plain, scaled = (
        am.AlphaComplex(np.ldexp(points, e)).measure_curves() for e in (0, exponent)
    )
    radii = np.linspace(0, 0.3, 50)
    there = np.ldexp(radii, exponent)
    np.testing.assert_array_equal(np.ldexp(plain.area(radii), 2 * exponent), scaled.area(there))
    np.testing.assert_array_equal(
        np.ldexp(plain.perimeter(radii), exponent), scaled.perimeter(there)
    )


@pytest.mark.parametrize("method", ["area", "perimeter", "triangle_count", "edge_count"])
@pytest.mark.parametrize("radius", [-1.0, math.nan, "1", [0.5, -0.5]])
def test_refuses_what_is_no_radius(method, radius):
    curves = am.measure_curves(am.filtration([[0, 0], [1, 0], [0, 1]]))
    with pytest.raises(ParameterError, match="radius must be"):
        getattr(curves, method)(radius)


def test_survives_a_pickle():
    curves = am.AlphaComplex(np.random.default_rng(3).random((50, 2))).measure_curves()
    thawed = pickle.loads(pickle.dumps(curves))
    radii = np.linspace(0, 0.2, 20)
    np.testing.assert_array_equal(thawed.perimeter(radii), curves.perimeter(radii))
    assert not thawed.edge_radii.flags.writeable
