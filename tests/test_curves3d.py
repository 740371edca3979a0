"""Sizes in space at all radii in one pass, against the shapes at those radii."""

from __future__ import annotations

import math
import pickle

import numpy as np
import pytest
from hypothesis import given

import alphamesh as am
from alphamesh.errors import ParameterError
from strategies3 import clouds3, complex_of


@given(clouds3())
def test_curves_say_what_the_shapes_say(points):
    cx = complex_of(points)
    curves = cx.measure_curves()
    critical = cx.critical_radii().tolist()
    radii = [0.0, *critical, *(math.nextafter(r, 0) for r in critical[:20]), math.inf]
    shapes = [cx.at(r) for r in radii]
    counts = [shape.counts for shape in shapes]
    for kind in ("tetrahedra", "triangles", "edges"):
        name = {"tetrahedra": "tetrahedron", "triangles": "triangle", "edges": "edge"}[kind]
        found = getattr(curves, f"{name}_count")(radii)
        assert found.tolist() == [count[kind] for count in counts]
    euler = [shape.euler_characteristic for shape in shapes]
    assert curves.euler_characteristic(radii).tolist() == euler
    for name in ("volume", "surface_area"):
        exact = [getattr(shape, name) for shape in shapes]
        most = max(exact)
        for mine, theirs in zip(getattr(curves, name)(radii).tolist(), exact, strict=True):
            assert mine == pytest.approx(theirs, rel=1e-12, abs=1e-20 * most)
            assert mine >= 0


def test_a_unit_cube():
    curves = am.AlphaComplex(np.indices((2, 2, 2)).reshape(3, -1).T).measure_curves()
    half = math.sqrt(3) / 2
    assert curves.volume([0.0, 0.8, half, math.inf]).tolist() == [0.0, 0.0, 1.0, 1.0]
    assert curves.surface_area([0.8, half]).tolist() == [0.0, 6.0]
    assert curves.tetrahedron_radii.tolist() == [half] * len(curves.tetrahedron_radii)
    assert curves.vertex_count == 8
    assert repr(curves) == "<MeasureCurves3D: 43 simplices come>"


@pytest.mark.parametrize("exponent", [-300, 300])
def test_sizes_beyond_float64_are_scaled_powers_of_two(exponent):
    points = np.random.default_rng(7).random((60, 3))
    one, other = (am.AlphaComplex(np.ldexp(points, e)).measure_curves() for e in (0, exponent))
    radii = np.array([0.1, 0.2, 0.5])
    area = other.surface_area(np.ldexp(radii, exponent))
    assert np.array_equal(area, np.ldexp(one.surface_area(radii), 2 * exponent))
    assert np.array_equal(
        other.euler_characteristic(np.ldexp(radii, exponent)),
        [*one.euler_characteristic(radii)],
    )


def test_no_rounding_is_left_over():
    points = np.random.default_rng(1).random((3000, 3))
    points[0] = 1e4, 1e4, 1e4
    cx = am.AlphaComplex(points)
    curves = cx.measure_curves()
    for radius in (0.03, 0.05, 0.1, 0.3):
        shape = cx.at(radius)
        assert float(curves.volume(radius)) == pytest.approx(shape.volume, rel=1e-12)
        area = float(curves.surface_area(radius))
        assert area == pytest.approx(shape.surface_area, rel=1e-12)


def test_curves_pickle_and_refuse_what_is_no_radius():
    curves = am.AlphaComplex(np.eye(3)).measure_curves()
    again = pickle.loads(pickle.dumps(curves))
    assert again.edge_count(1.0) == curves.edge_count(1.0) == 3
    with pytest.raises(ParameterError, match="0 or more"):
        curves.volume(-1.0)
