"""A frame of points around the cloud: what touches it is dropped."""

from __future__ import annotations

import copy
import math
import pickle

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

import alphamesh as am
import oracles
from alphamesh.check import check_delaunay
from alphamesh.delaunay import delaunay
from alphamesh.errors import CoordinateRangeError, NonFiniteError, ParameterError
from alphamesh.frame import FRAME_SHAPES, Frame, framed_delaunay
from strategies import FAMILIES


def crescent(n=800, seed=1):
    """Points of a disc with a bite: its triangulation must not fill the bite."""
    points = np.random.default_rng(seed).uniform(-1, 1, (4 * n, 2))
    inside = (np.hypot(*points.T) < 1) & (np.hypot(*(points - [0.7, 0]).T) > 0.6)
    return points[inside][:n]


def distance_to_hull(points, queries):
    shapely = pytest.importorskip("shapely")
    hull = shapely.convex_hull(shapely.MultiPoint(points))
    return shapely.distance(hull, shapely.points(queries))


@pytest.mark.parametrize("shape", FRAME_SHAPES)
@pytest.mark.parametrize(("margin", "spacing"), [(0.5, 0.25), (0.01, 0.3), (7.0, 1.0)])
def test_frames_keep_their_distances(shape, margin, spacing):
    points = np.random.default_rng(2).normal(size=(60, 2)) + 10.0
    frame = Frame(shape, margin=margin, spacing=spacing).around(points)
    assert frame.flags.c_contiguous
    assert not frame.flags.writeable
    steps = np.roll(frame, -1, axis=0) - frame
    assert np.hypot(*steps.T).max() <= spacing * 1.1  # the circle is widened a little
    away = distance_to_hull(points, frame)
    assert away.min() >= margin * (1 - 1e-12)
    if shape == "hull":
        assert away == pytest.approx(margin, rel=1e-9)
    if shape == "box":
        low, high = points.min(axis=0) - margin, points.max(axis=0) + margin
        on_side = np.isclose(frame, low, rtol=1e-14) | np.isclose(frame, high, rtol=1e-14)
        assert on_side.any(axis=1).all()
    doubled = oracles.doubled_area([tuple(p) for p in frame.tolist()])
    assert doubled > 0  # counter-clockwise


@pytest.mark.parametrize("shape", FRAME_SHAPES)
@given(data=st.data())
def test_kept_triangles_are_those_without_the_frame(shape, data):
    points = data.draw(
        st.one_of(
            [
                FAMILIES[name]
                for name in ("generic", "partial grids", "on a line", "offset", "duplicates")
            ]
        )
    )
    try:
        result = framed_delaunay(points, Frame(shape))
    except CoordinateRangeError:
        assume(False)
    count = len(points)
    full = result.full
    check_delaunay(full)
    assert np.array_equal(full.points[:count], result.points)
    assert np.array_equal(full.points[count:], result.frame_points)
    whole = delaunay(np.concatenate((np.asarray(points).reshape(-1, 2), result.frame_points)))
    kept = whole.triangles[(whole.triangles < count).all(axis=1)]
    assert np.array_equal(result.triangles, kept)
    assert np.array_equal(full.triangles[: len(kept)], kept)
    assert (full.triangles[len(kept) :].max(axis=1, initial=count) >= count).all()
    assert result.representative.tolist() == oracles.representatives(points)
    check_neighbors(result)


def check_neighbors(result):
    triangles = [set(t) for t in result.triangles.tolist()]
    for row, beyond in enumerate(result.neighbors.tolist()):
        for corner, other in zip(result.triangles[row].tolist(), beyond, strict=True):
            edge = triangles[row] - {corner}
            holders = [
                t for t, vertices in enumerate(triangles) if edge <= vertices and t != row
            ]
            assert holders == ([] if other < 0 else [other])
    edges = {tuple(sorted((a, b))) for t in triangles for a in t for b in t if a < b}
    assert oracles.row_set(result.edges) == edges


def test_the_bite_stays_open():
    points = crescent()
    whole, framed = delaunay(points), framed_delaunay(points)
    bite = [[0.95, 0.0], [1.0, 0.1], [0.9, -0.05]]
    assert (whole.find([[0.5, 0.0]]) >= 0).all()
    assert (framed.find(bite) == -1).all()
    assert len(framed.triangles) < len(whole.triangles)
    assert framed.neighbors.min() == -1
    hull = am.convex_hull(points)
    area = np.abs(np.linalg.det(np.diff(points[framed.triangles], axis=1))).sum() / 2
    assert area < hull.area


def test_a_closer_frame_cuts_deeper():
    points = crescent()
    areas = []
    for margin in (0.03, 0.3, 3.0):
        framed = framed_delaunay(points, Frame("hull", margin=margin, spacing=0.05))
        corners = points[framed.triangles]
        areas.append(np.abs(np.linalg.det(np.diff(corners, axis=1))).sum() / 2)
    assert areas[0] < areas[1] < areas[2] <= am.convex_hull(points).area * (1 + 1e-12)


def test_find_prefers_what_is_kept():
    points = crescent(300)
    framed = framed_delaunay(points, Frame("circle", margin=0.1, spacing=0.1))
    found = framed.find(points)
    at_kept = np.zeros(len(points), dtype=bool)
    at_kept[framed.triangles] = True
    assert np.array_equal(found >= 0, at_kept)
    assert (
        (framed.triangles[found[at_kept]] == np.flatnonzero(at_kept)[:, None]).any(axis=1).all()
    )
    assert (framed.find(framed.frame_points) == -1).all()
    centres = points[framed.triangles].mean(axis=1)
    assert np.array_equal(framed.find(centres), np.arange(len(framed.triangles)))


@pytest.mark.parametrize("shape", FRAME_SHAPES)
@pytest.mark.parametrize(
    "points", [[[3.0, 4.0]], [[1.0, 1.0], [1.0, 1.0]], [[0.0, 0.0], [5.0, 5.0], [2.0, 2.0]]]
)
def test_clouds_without_triangles(shape, points):
    framed = framed_delaunay(points, Frame(shape))
    assert framed.triangles.shape == framed.neighbors.shape == (0, 3)
    assert framed.edges.shape == (0, 2)
    assert len(framed.frame_points) >= 4
    assert framed.find([[1.0, 1.0]]).tolist() == [-1]


def test_a_cloud_almost_on_a_line_has_few_frame_points():
    for height in (0.0, 1e-45, 1e-12):
        points = np.column_stack((np.arange(100.0), height * (np.arange(100) % 3)))
        for shape in FRAME_SHAPES:
            assert 100 < len(Frame(shape).around(points)) < 700


def test_no_points():
    framed = framed_delaunay(np.empty((0, 2)))
    assert framed.frame_points.shape == (0, 2)
    assert framed.triangles.shape == (0, 3)


def test_defaults_follow_the_scale_of_the_cloud():
    points = crescent(400)
    frame = Frame().around(points)
    for factor in (1e-6, 1e6):
        assert Frame().around(points * factor) == pytest.approx(frame * factor, rel=1e-9)
    # A million is far from where float64 tells a micron apart: the frame is still outside.
    far = Frame().around(points * 1e-6 + 1e9)
    low, high = (points * 1e-6 + 1e9).min(axis=0), (points * 1e-6 + 1e9).max(axis=0)
    assert ((far < low) | (far > high)).any(axis=1).all()


def test_errors():
    points = crescent(50)
    with pytest.raises(
        ParameterError, match="there is no frame shape 'oval'; shapes: 'box', 'ci"
    ):
        Frame("oval")
    for bad in (0, -1.0, math.nan, math.inf, "wide"):
        with pytest.raises(ParameterError, match="margin must be a positive number"):
            Frame(margin=bad)
        with pytest.raises(ParameterError, match="spacing must be a positive number"):
            Frame(spacing=bad)
    for shape in FRAME_SHAPES:
        with pytest.raises(
            ParameterError, match="more than 10,000,000 points; choose a larger"
        ):
            Frame(shape, spacing=1e-9).around(points)
    with pytest.raises(ParameterError, match=r"frame must be an alphamesh\.Frame"):
        framed_delaunay(points, "box")
    with pytest.raises(ParameterError, match="fall on points of the cloud: a margin of 1e-30"):
        framed_delaunay([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]], Frame(margin=1e-30))
    with pytest.raises(NonFiniteError, match="row 1 "):
        framed_delaunay([[0.0, 0.0], [math.inf, 0.0]])


def test_a_record_is_closed_and_travels():
    framed = framed_delaunay(crescent(60), Frame("circle"))
    for name in ("triangles", "neighbors", "frame_points", "edges", "representative"):
        assert not getattr(framed, name).flags.writeable
    assert copy.copy(framed) is framed
    back = pickle.loads(pickle.dumps(framed))
    assert back.frame == framed.frame == Frame("circle")
    assert np.array_equal(back.full.triangles, framed.full.triangles)
    assert repr(framed).startswith("<FramedDelaunay: 60 points, ")
    assert am.framed_delaunay is framed_delaunay
