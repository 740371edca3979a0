"""Queries in space: inside or not is exact, and the nearest point is the nearest."""

from __future__ import annotations

import itertools
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import alphamesh as am
from alphamesh._kernels.surfaces import locate3
from alphamesh.errors import CloudShapeError, CoordinateRangeError, NonFiniteError


def exact(points):
    return [[Fraction(value) for value in row] for row in np.asarray(points).tolist()]


def minus(a, b):
    return [x - y for x, y in zip(a, b, strict=True)]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b, strict=True))


def cross(a, b):
    return [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]


def volume(a, b, c, d):
    return dot(cross(minus(b, a), minus(c, a)), minus(d, a))


def holds(corners, q):
    """Return whether a closed tetrahedron holds a point, with rational numbers."""
    turn = volume(*corners)
    replaced = ([*corners[:k], q, *corners[k + 1 :]] for k in range(4))
    return all(volume(*other) * turn >= 0 for other in replaced)


def ends_sq(p, a, b):
    d = minus(b, a)
    share = min(max(dot(minus(p, a), d) / dot(d, d), Fraction(0)), Fraction(1))
    return dot(*[minus(p, [x + share * y for x, y in zip(a, d, strict=True)])] * 2)


def triangle_sq(p, a, b, c):
    """Return the squared distance to a triangle, with rational numbers."""
    n = cross(minus(b, a), minus(c, a))
    sides = ((a, b), (b, c), (c, a))
    if all(dot(n, cross(minus(e, s), minus(p, s))) >= 0 for s, e in sides):
        return dot(n, minus(p, a)) ** 2 / dot(n, n)
    return min(ends_sq(p, s, e) for s, e in sides)


@st.composite
def shapes_and_queries(draw):
    """Any tetrahedra of a cloud full of ties, and points on and off their faces."""
    cells = st.tuples(*[st.integers(0, 3)] * 3)
    points = np.array(draw(st.lists(cells, min_size=5, max_size=20)), dtype=np.float64)
    filtration = am.filtration(points)
    count = len(filtration.simplices[3])
    seed = draw(st.integers(0, 2**32 - 1))
    rng = np.random.default_rng(seed)
    shape = am.Selection3D(filtration, 1.0, rng.random(count) < 0.6)
    grid = rng.integers(-1, 9, (12, 3)) / 2
    rows = rng.integers(len(points), size=(6, 2))
    return shape, np.concatenate([grid, points[rows].mean(axis=1), points[:4]])


@given(case=shapes_and_queries())
@settings(max_examples=60, deadline=None)
def test_inside_is_decided_exactly(case):
    shape, queries = case
    tetrahedra = exact_tetrahedra = shape.filtration.simplices[3]
    labels = shape._parts.labels
    corners = [exact(shape.points[row]) for row in exact_tetrahedra]
    sides, regions = shape.side_of(queries), shape.region_of(queries)
    for q, side, region in zip(exact(queries), sides, regions, strict=True):
        holding = [t for t in range(len(tetrahedra)) if holds(corners[t], q)]
        inside = [int(labels[t]) for t in holding if labels[t] >= 0]
        assert region == min(inside, default=-1)
        assert (side >= 0) == bool(inside)
        if inside and len(inside) < len(holding):
            assert side == 0
    np.testing.assert_array_equal(shape.contains(queries), sides >= 0)


@given(case=shapes_and_queries())
@settings(max_examples=40, deadline=None)
def test_the_nearest_point_is_the_nearest(case):
    shape, queries = case
    near = shape.nearest(queries)
    signed, distance = shape.distance(queries, signed=True), shape.distance(queries)
    sides = shape.side_of(queries)
    triangles = [exact(shape.points[row]) for row in shape.boundary_triangles]
    if not triangles:
        assert np.isinf(near.distances).all()
        assert np.isinf(distance).all()
        assert (near.triangles == -1).all()
        return
    for i, q in enumerate(exact(queries)):
        best = float(min(triangle_sq(q, *corners) for corners in triangles)) ** 0.5
        assert near.distances[i] == pytest.approx(best, rel=1e-13, abs=0)
        of_found = triangle_sq(q, *triangles[near.triangles[i]])
        assert float(of_found) ** 0.5 == pytest.approx(best, rel=1e-13)
        assert (best == 0) == (sides[i] == 0)
        assert signed[i] == -sides[i] * near.distances[i]
        assert distance[i] == max(signed[i], 0.0)
    gone = np.linalg.norm(queries - near.points, axis=1)
    np.testing.assert_allclose(gone, near.distances, rtol=1e-13, atol=1e-14)


@pytest.fixture(scope="module")
def torus():
    cx = am.AlphaComplex(am.sample_solid("hollow-torus", 4000, seed=1))
    return cx.at(0.16)


def test_many_points_agree_with_brute_force(torus):
    rng = np.random.default_rng(1)
    queries = rng.uniform(-1.6, 1.6, (300, 3)) * [1, 1, 0.4]
    corners = torus.points[torus.tetrahedra]
    inside = np.zeros(len(queries), dtype=bool)
    for tetrahedron in corners:
        bary = np.linalg.solve(
            np.vstack([tetrahedron.T, np.ones(4)]),
            np.vstack([queries.T, np.ones(len(queries))]),
        )
        inside |= (bary >= 0).all(axis=0)
    found = torus.contains(queries)
    assert 30 < np.count_nonzero(inside) < 270
    np.testing.assert_array_equal(found, inside)
    assert np.array_equal(torus.distance(queries, signed=True) < 0, inside)


def test_the_cloud_lies_in_its_own_shape(torus):
    sides = torus.side_of(torus.points)
    used = np.unique(torus.tetrahedra)
    assert (sides[used] >= 0).all()
    np.testing.assert_array_equal(
        np.flatnonzero(sides == 0), np.unique(torus.boundary_triangles)
    )
    np.testing.assert_array_equal(torus.distance(torus.points, signed=True)[sides == 0], 0.0)


def test_cavities_are_outside():
    cube = np.array(list(itertools.product(range(5), repeat=3)), dtype=np.float64)
    cx = am.AlphaComplex(cube)
    centres = cx.points[cx.simplices[3]].mean(axis=1)
    shape = am.Selection3D(cx.filtration, 1.0, np.abs(centres - 2).max(axis=1) > 1)
    queries = [[2, 2, 2], [0.5, 2, 2], [1, 2, 2], [0, 0, 0], [4, 4, 4.0000001], [9, 9, 9]]
    assert shape.side_of(queries).tolist() == [-1, 1, 0, 0, -1, -1]
    assert shape.region_of(queries).tolist() == [-1, 0, 0, 0, -1, -1]
    assert shape.distance(queries, signed=True) == pytest.approx(
        [1, -0.5, 0, 0, 1e-7, np.sqrt(75)]
    )
    near = shape.nearest([[2, 2, 2.5], [9, 2, 2]])
    assert near.points.tolist() == [[2, 2, 3], [4, 2, 2]]
    assert near.distances.tolist() == [0.5, 5.0]
    assert len(near) == 2
    assert "2 queries" in repr(near)


def test_sides_are_told_at_the_last_digit():
    shape = am.AlphaComplex([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]).at(10)
    third = np.array([1 / 3, 1 / 3, 1 / 3])
    above = np.nextafter(third, 1)
    total = sum(Fraction(float(x)) for x in third)
    assert shape.side_of([third])[0] == (0 if total == 1 else 1 if total < 1 else -1)
    assert shape.side_of([above]).tolist() == [-1]
    tiny = 5e-324
    assert shape.side_of([[0.25, 0.25, 1e-30], [0.25, 0.25, -0.0]]).tolist() == [1, 0]
    with pytest.raises(CoordinateRangeError):
        shape.side_of([[0.25, 0.25, tiny], [1e300, 0, 0]])


@pytest.mark.parametrize("scale", [1e-40, 1e-3, 1e3, 1e40])
def test_scale_does_not_matter(scale):
    points = am.sample_solid("torus", 500, seed=1)
    queries = np.random.default_rng(0).uniform(-1.5, 1.5, (200, 3))
    plain = am.AlphaComplex(points).at(0.5)
    scaled = am.AlphaComplex(scale * points).at(0.5 * scale)
    np.testing.assert_allclose(
        scaled.distance(scale * queries, signed=True),
        scale * plain.distance(queries, signed=True),
        rtol=1e-9,
        atol=1e-12 * scale,
    )


def test_far_queries_have_a_distance():
    shape = am.AlphaComplex(am.sample_solid("ball", 300, seed=1)).at(2.0)
    near = shape.nearest([[1e200, 0, 0], [0, -1e250, 0]])
    np.testing.assert_allclose(near.distances, [1e200, 1e250])


def test_threads_do_not_matter():
    cx = am.AlphaComplex(am.sample_solid("ball", 2000, seed=1))
    filtration = cx.filtration
    queries = np.random.default_rng(0).uniform(-1, 1, (15_000, 3))
    labels = np.arange(len(filtration.simplices[3]), dtype=np.int32)
    results = [
        locate3(
            filtration.points,
            filtration.simplices[3],
            filtration.triangle_tetrahedra,
            filtration.tetrahedron_triangles,
            labels,
            queries,
            threads=threads,
        )
        for threads in (1, 2, 4)
    ]
    for labels_found, sides in results[1:]:
        np.testing.assert_array_equal(labels_found, results[0][0])
        np.testing.assert_array_equal(sides, results[0][1])


def test_no_tetrahedra_no_inside():
    flat = am.AlphaComplex([[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]]).at(5)
    assert flat.side_of([[0.5, 0.5, 0]]).tolist() == [-1]
    assert np.isinf(flat.distance([[0.5, 0.5, 0]], signed=True)).all()
    assert np.isnan(flat.nearest([[0.5, 0.5, 0]]).points).all()
    assert len(flat.contains(np.empty((0, 3)))) == 0


def test_queries_are_checked(torus):
    with pytest.raises(CloudShapeError):
        torus.contains([[0.0, 1.0]])
    with pytest.raises(NonFiniteError, match="row 1"):
        torus.distance([[0, 0, 0], [0, np.nan, 0]])
