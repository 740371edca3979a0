"""The convex hull is the one of the definition, collinear points and all."""

from __future__ import annotations

import copy
import math
import pickle
from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import alphamesh as am
import oracles
from alphamesh.delaunay import delaunay
from alphamesh.errors import (
    CloudShapeError,
    CoordinateRangeError,
    NonFiniteError,
    ParameterError,
)
from alphamesh.hull import convex_hull
from strategies import CIRCLES, FAMILIES, beyond_range


def corners_of(points):
    """Return the ring with points between corners, and without, by definition."""
    cloud, _ = oracles.lattice(points)
    rows = sorted(set(oracles.representatives(points)), key=cloud.__getitem__)
    if len(rows) < 2:
        return rows, rows
    following = dict(oracles.hull_edges(points))
    if all(oracles.orient(cloud[rows[0]], cloud[rows[-1]], cloud[r]) == 0 for r in rows):
        return rows, [rows[0], rows[-1]]
    ring = [rows[0]]
    while following[ring[-1]] != rows[0]:
        ring.append(following[ring[-1]])
    closed = [ring[-1], *ring, ring[0]]
    turns = [oracles.orient(*(cloud[r] for r in closed[k : k + 3])) for k in range(len(ring))]
    return ring, [row for row, turn in zip(ring, turns, strict=True) if turn]


@pytest.mark.parametrize("family", FAMILIES)
@given(data=st.data())
def test_is_the_definition(family, data):
    points = data.draw(FAMILIES[family])
    every, corners = corners_of(points)
    assert convex_hull(points, collinear=True).ring.tolist() == every
    hull = convex_hull(points)
    assert hull.ring.tolist() == corners
    assert np.array_equal(hull.corners, np.asarray(points)[corners])
    if len(points) and np.abs(points).max() < 1e100:
        check_measures(hull, points)


def check_measures(hull, points):
    cloud, unit = oracles.lattice(points)
    ring = [cloud[row] for row in hull.ring.tolist()]
    exact = Fraction(oracles.doubled_area(ring), 2) * unit**2 if ring else 0
    assert hull.area == pytest.approx(float(exact), rel=1e-12, abs=1e-300)
    if len(ring) < 300:
        sides = [
            math.dist(hull.points[a], hull.points[b])
            for a, b in pairwise([*hull.ring, *hull.ring[:1]])
        ]
        assert hull.perimeter == pytest.approx(sum(sides), rel=1e-12)


@pytest.mark.parametrize("collinear", [False, True])
@pytest.mark.parametrize("name", ["square", "disc", "circle", "grid", "sliver"])
def test_large_clouds_agree_with_the_triangulation(name, collinear):
    rng = np.random.default_rng(1)
    angle = rng.random(30_000) * 2 * math.pi
    disc = np.sqrt(rng.random(30_000))[:, None] * np.column_stack(
        (np.cos(angle), np.sin(angle))
    )
    y, x = np.mgrid[0:150, 0:200]
    points = {
        "square": rng.random((30_000, 2)),
        "disc": disc,
        "circle": disc / np.hypot(*disc.T)[:, None],
        "grid": rng.permutation(np.column_stack((x.ravel(), y.ravel())) * 0.1),
        "sliver": np.column_stack((x.ravel(), x.ravel() * 0.3 + y.ravel() * 1e-13)),
    }[name]
    triangulated = delaunay(points)
    hull = convex_hull(points, collinear=collinear)
    rows, sides = np.nonzero(triangulated.neighbors < 0)
    border = np.sort(
        np.stack([triangulated.triangles[rows, (sides + k) % 3] for k in (1, 2)], axis=1),
        axis=1,
    )
    if collinear:
        assert oracles.row_set(np.sort(hull.edges, axis=1)) == oracles.row_set(border)
    assert set(hull.ring.tolist()) <= set(border.ravel().tolist())
    for start, end in hull.edges[:: max(1, len(hull.edges) // 50)]:
        corners = np.empty((len(points), 3, 2))
        corners[:, 0], corners[:, 1], corners[:, 2] = points[start], points[end], points
        assert am._kernels.orient2(corners).min() >= 0


def test_degenerate_clouds():
    assert convex_hull(np.empty((0, 2))).ring.tolist() == []
    assert convex_hull([[2.0, 3.0]] * 4).ring.tolist() == [0]
    assert convex_hull([[2.0, 3.0], [1.0, 5.0], [2.0, 3.0]]).ring.tolist() == [1, 0]
    line = [[3.0, 3.0], [1.0, 1.0], [2.0, 2.0], [1.0, 1.0], [0.0, 0.0]]
    assert convex_hull(line).ring.tolist() == [4, 0]
    assert convex_hull(line, collinear=True).ring.tolist() == [4, 1, 2, 0]
    for points, count in ((np.empty((0, 2)), 0), ([[1.0, 1.0]], 0), (line, 1)):
        hull = convex_hull(points)
        assert hull.area == 0.0
        assert len(hull.edges) == count
    assert convex_hull(line).perimeter == pytest.approx(6 * math.sqrt(2))
    assert convex_hull(line, collinear=True).edges.tolist() == [[4, 1], [1, 2], [2, 0]]
    assert convex_hull([[1.0, 1.0]]).perimeter == convex_hull(np.empty((0, 2))).perimeter == 0.0


def test_a_square_with_points_on_its_border():
    points = [[0, 0], [2, 0], [1, 0], [1, 1], [2, 2], [0, 2], [0, 1], [2, 1], [2, 0]]
    hull = convex_hull(points)
    assert hull.ring.tolist() == [0, 1, 4, 5]
    assert (hull.area, hull.perimeter) == (4.0, 8.0)
    assert hull.edges.tolist() == [[0, 1], [1, 4], [4, 5], [5, 0]]
    kept = convex_hull(points, collinear=True)
    assert kept.ring.tolist() == [0, 2, 1, 7, 4, 5, 6]
    assert (kept.area, kept.perimeter) == (4.0, 8.0)


def test_the_area_is_accurate_far_from_the_origin():
    ring = np.array(CIRCLES[65], dtype=float)
    near = convex_hull(ring)
    for shift in (2.0**40, 1e15):
        far = convex_hull(ring + shift)
        assert far.area == near.area
        assert far.perimeter == pytest.approx(near.perimeter, rel=1e-14)


def test_order_does_not_matter():
    points = np.random.default_rng(3).normal(size=(500, 2))
    order = np.random.default_rng(4).permutation(500)
    assert np.array_equal(convex_hull(points).corners, convex_hull(points[order]).corners)


def test_errors():
    with pytest.raises(NonFiniteError, match="row 1 "):
        convex_hull([[0.0, 0.0], [math.nan, 0.0]])
    with pytest.raises(CloudShapeError):
        convex_hull([1.0, 2.0])
    with pytest.raises(ParameterError, match="collinear must be True or False"):
        convex_hull([[0.0, 0.0]], collinear="yes")


@given(points=beyond_range())
def test_beyond_range_is_refused(points):
    with pytest.raises(CoordinateRangeError):
        convex_hull(points)


def test_a_record_is_closed_and_travels():
    hull = convex_hull(np.random.default_rng(1).random((30, 2)))
    assert not hull.ring.flags.writeable
    assert not hull.corners.flags.writeable
    assert copy.copy(hull) is hull
    assert np.array_equal(pickle.loads(pickle.dumps(hull)).ring, hull.ring)
    assert repr(hull) == f"<ConvexHull: {len(hull.ring)} of 30 points>"


def test_the_complex_offers_its_hull():
    points = np.random.default_rng(1).random((30, 2))
    cx = am.AlphaComplex(points)
    assert cx.convex_hull is cx.convex_hull
    assert np.array_equal(cx.convex_hull.ring, am.convex_hull(points).ring)
