"""Queries: in which region, how near; exact where a decision is made."""

from __future__ import annotations

import copy
import math
import pickle
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

import alphamesh as am
import oracles
from alphamesh.errors import CloudShapeError, CoordinateRangeError, NonFiniteError
from planar_samples import from_picture, planar_shapes, random_selection

HALVES = (0.0, 0.25, 0.5, 1.0, 1.5, -0.5)


@st.composite
def queries_near(draw, points):
    """Draw points of the cloud, points between them, and points around them."""
    if len(points) == 0:
        return np.array([[0.0, 0.0], [1.0, -2.0]])
    row = st.integers(0, len(points) - 1)
    drawn = draw(st.lists(st.tuples(row, row, st.sampled_from(HALVES)), max_size=8))
    between = [points[a] + share * (points[b] / 2 - points[a] / 2) * 2 for a, b, share in drawn]
    queries = np.array([*points, *between]).reshape(-1, 2)
    queries = queries[np.isfinite(queries).all(axis=1)]
    assume(oracles.in_range(np.concatenate((points, queries))))
    return queries


def regions_by_definition(shape, queries):
    """Return the lowest region of the closed triangles that hold each query."""
    cloud, _ = oracles.lattice(np.concatenate((shape.points, queries)))
    triangles = [[cloud[row] for row in triangle] for triangle in shape.triangles.tolist()]
    found = []
    for query in cloud[len(shape.points) :]:
        labels = [
            label
            for (a, b, c), label in zip(triangles, shape.regions.labels.tolist(), strict=True)
            if min(oracles.orient(p, q, query) for p, q in ((a, b), (b, c), (c, a))) >= 0
        ]
        found.append(min(labels, default=-1))
    return found


@given(st.data())
def test_regions_are_those_of_the_closed_triangles(data):
    shape = data.draw(planar_shapes())
    queries = data.draw(queries_near(shape.points))
    found = shape.region_of(queries)
    assert found.dtype == np.int32 and not found.flags.writeable
    assert found.tolist() == regions_by_definition(shape, queries)
    inside = shape.contains(queries)
    assert inside.dtype == bool and inside.tolist() == (found >= 0).tolist()


def test_borders_belong_to_the_shape():
    shape = from_picture(["###", "#.#", "##."])
    edges = shape.boundary_edges
    middles = shape.points[edges].mean(axis=1)
    assert shape.contains(middles).all() and shape.contains(shape.points[edges[:, 0]]).all()
    outward = np.diff(shape.points[edges], axis=1)[:, 0] @ [[0, -1], [1, 0]]
    assert not shape.contains(middles + 1e-15 * outward).any()
    assert shape.contains(middles - 1e-15 * outward).all()


def test_the_lower_region_where_two_touch():
    shape = from_picture(["##..", "##..", "..#.", "...#"])
    assert shape.regions.areas.tolist() == [4.0, 1.0, 1.0]
    first, second = shape.region_of([[2, 2], [3, 1]]).tolist()
    assert first == 0 and second == 1
    assert sorted(shape.region_of([[2.5, 1.5], [3.5, 0.5]]).tolist()) == [1, 2]


def test_against_shapely():
    shapely = pytest.importorskip("shapely")
    rng = np.random.default_rng(1)
    shape = random_selection(am.filtration(rng.random((2000, 2))), rng)
    queries = rng.random((20_000, 2)) * 1.2 - 0.1
    places = shapely.points(queries)
    query, region = shapely.STRtree(shape.polygons()).query(places, predicate="intersects")
    expected = np.full(len(queries), -1)
    expected[query] = region
    np.testing.assert_array_equal(shape.region_of(queries), expected)
    border = shapely.boundary(shape.geometry())
    shapely.prepare(border)
    distances = shapely.distance(border, places)
    found = shape.nearest(queries)
    np.testing.assert_allclose(found.distances, distances, rtol=1e-9, atol=1e-15)
    signed = np.where(expected >= 0, -distances, distances)
    np.testing.assert_allclose(
        shape.distance(queries, signed=True), signed, rtol=1e-9, atol=1e-15
    )
    off = np.where(expected >= 0, 0, distances)
    np.testing.assert_allclose(shape.distance(queries), off, rtol=1e-9, atol=1e-15)


def squared_distance(query, start, end):
    """Return the exact squared distance of a point to a segment."""
    u = [b - a for a, b in zip(start, end, strict=True)]
    v = [q - a for a, q in zip(start, query, strict=True)]
    length, along = u[0] ** 2 + u[1] ** 2, u[0] * v[0] + u[1] * v[1]
    share = min(max(Fraction(along, length), 0), 1)
    return sum((w - share * d) ** 2 for w, d in zip(v, u, strict=True))


@given(st.data())
def test_nearest_is_nearest(data):
    shape = data.draw(planar_shapes())
    queries = data.draw(queries_near(shape.points))
    found = shape.nearest(queries)
    edges = shape.boundary_edges.tolist()
    if not edges:
        assert (found.distances == math.inf).all() and np.isnan(found.points).all()
        assert (found.edges == -1).all() and (shape.distance(queries) == math.inf).all()
        return
    cloud, scale = oracles.lattice(np.concatenate((shape.points, queries)))
    for number, query in enumerate(cloud[len(shape.points) :]):
        squares = [squared_distance(query, cloud[a], cloud[b]) for a, b in edges]
        least, row = min(squares), int(found.edges[number])
        # Rounding is relative to how far off the nearer end of the best edge is.
        best = edges[squares.index(least)]
        reach = min(
            sum((q - c) ** 2 for q, c in zip(query, cloud[v], strict=True)) for v in best
        )
        assert squares[row] <= least * (1 + Fraction(1, 10**9)) + Fraction(reach, 10**30)
        exact = oracles.square_root(squares[row] * scale**2)
        assert found.distances[number] == pytest.approx(exact, rel=1e-12, abs=1e-300)
        assert (found.distances[number] == 0) == (squares[row] == 0) or exact < 1e-300
        away = math.dist(found.points[number].tolist(), queries[number].tolist())
        sizes = np.abs(np.vstack((queries[number], shape.points[edges[row]]))).max()
        assert away == pytest.approx(exact, rel=1e-9, abs=8 * np.spacing(sizes))


def test_distance_is_zero_on_the_border_and_signed_inside():
    shape = from_picture(["###", "#.#", "###"])
    queries = [[0, 0], [1.5, 0], [0.5, 0.5], [1.5, 1.5], [1.5, 1.25], [-3, -4], [1, 1.5]]
    assert shape.distance(queries).tolist() == [0, 0, 0, 0.5, 0.25, 5, 0]
    signed = shape.distance(queries, signed=True)
    assert signed.tolist() == [0, 0, -0.5, 0.5, 0.25, 5, 0]
    assert not np.signbit(signed[[0, 1, 6]]).any() and not signed.flags.writeable


def test_the_first_of_equally_near_edges():
    shape = from_picture(["###", "#.#", "###"])
    found = shape.nearest([[1.5, 1.5], [-1, -1]])
    middle = shape.points[shape.boundary_edges].mean(axis=1)
    near = np.hypot(*(middle - [1.5, 1.5]).T) == 0.5
    assert found.edges[0] == np.flatnonzero(near)[0]
    at_corner = (shape.points[shape.boundary_edges] == 0).all(axis=2).any(axis=1)
    assert found.edges[1] == np.flatnonzero(at_corner)[0]
    assert found.points[1].tolist() == [0, 0] and found.distances[1] == math.sqrt(2)


def test_many_queries_are_as_good_as_one():
    """The order, and who asks along with whom, must not matter."""
    rng = np.random.default_rng(2)
    shape = am.AlphaComplex(rng.integers(0, 60, (3000, 2)).astype(float)).at(1.0)
    queries = rng.integers(-4, 130, (60_000, 2)) / 2
    found = shape.nearest(queries)
    order = rng.permutation(len(queries))
    shuffled = shape.nearest(queries[order])
    np.testing.assert_array_equal(shuffled.edges, found.edges[order])
    np.testing.assert_array_equal(shuffled.distances, found.distances[order])
    some = order[:200]
    alone = [shape.nearest(queries[[row]]) for row in some]
    assert [int(one.edges[0]) for one in alone] == found.edges[some].tolist()
    np.testing.assert_array_equal(
        shape.region_of(queries)[order], shape.region_of(queries[order])
    )


@pytest.mark.parametrize("exponent", [-500, -300, 300, 500])
def test_scale_does_not_matter(exponent):
    rng = np.random.default_rng(3)
    points, queries = rng.random((200, 2)), rng.random((100, 2)) * 2 - 0.5
    plain, scaled = (
        am.AlphaComplex(np.ldexp(points, e)).at(math.ldexp(0.08, e)) for e in (0, exponent)
    )
    there = np.ldexp(queries, exponent)
    np.testing.assert_array_equal(plain.region_of(queries), scaled.region_of(there))
    here, found = plain.nearest(queries), scaled.nearest(there)
    np.testing.assert_array_equal(here.edges, found.edges)
    np.testing.assert_array_equal(np.ldexp(here.distances, exponent), found.distances)
    np.testing.assert_array_equal(np.ldexp(here.points, exponent), found.points)


@pytest.mark.parametrize(("size", "place"), [(1.0, 1e200), (1e-200, 1.0), (1e-250, 1e250)])
def test_nearest_of_far_queries(size, place):
    shape = am.AlphaComplex(np.array([[0, 0], [1, 0], [0, 1]]) * size).at(size)
    found = shape.nearest([[place, 0.0], [0.0, -place]])
    assert found.distances == pytest.approx(place, rel=1e-15)
    assert shape.contains([[place, 0.0], [0.0, -place]]).tolist() == [False, False]


def test_refuses_to_decide_beyond_exact_arithmetic():
    shape = am.AlphaComplex([[0, 0], [1, 0], [0, 1]]).at(1)
    with pytest.raises(CoordinateRangeError, match="row 1"):
        shape.contains([[0.5, 0.5], [1e-250, 1e-250]])
    assert shape.nearest([[1e-250, 1e-250]]).distances == pytest.approx(1e-250)


def test_a_shape_without_triangles():
    shape = am.AlphaComplex([[0, 0], [1, 1], [2, 2]]).at(5)
    assert shape.contains([[1, 1], [0, 5]]).tolist() == [False, False]
    assert shape.region_of(np.empty((0, 2))).shape == (0,)
    assert shape.distance([[1, 1]], signed=True).tolist() == [math.inf]
    assert len(shape.nearest(np.empty((0, 2)))) == 0


@pytest.mark.parametrize("method", ["contains", "region_of", "nearest", "distance"])
def test_refuses_bad_queries(method):
    ask = getattr(from_picture(["#"]), method)
    with pytest.raises(NonFiniteError, match="row 1"):
        ask([[0, 0], [math.nan, 1]])
    with pytest.raises(CloudShapeError):
        ask([0.5, 0.5])
    with pytest.raises(CloudShapeError):
        ask([[0.5, 0.5, 0.5]])


def test_answers_cannot_change():
    found = from_picture(["#"]).nearest([[0.5, 2.0], [3.0, 0.25]])
    assert found.points.tolist() == [[0.5, 1.0], [1.0, 0.25]]
    assert found.distances.tolist() == [1.0, 2.0]
    assert repr(found) == "<Nearest: 2 queries>" and copy.copy(found) is found
    thawed = pickle.loads(pickle.dumps(found))
    for name in ("points", "distances", "edges"):
        assert not getattr(thawed, name).flags.writeable
        np.testing.assert_array_equal(getattr(thawed, name), getattr(found, name))
