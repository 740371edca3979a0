"""The Voronoi diagram is the one of the textbook."""

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
from alphamesh.delaunay import delaunay
from alphamesh.errors import (
    CoordinateRangeError,
    MissingLibraryError,
    NonFiniteError,
    ParameterError,
)
from alphamesh.voronoi import voronoi
from cell_samples import grid
from strategies import CIRCLES, FAMILIES
from textbook import Textbook


def diagram_of(points):
    try:
        return voronoi(points)
    except CoordinateRangeError as error:
        assume("too large for float64" not in str(error))
        raise


# ------------------------------------------------------------------ the diagram


@pytest.mark.parametrize("family", FAMILIES)
@given(data=st.data())
def test_is_the_textbook(family, data):
    points = data.draw(FAMILIES[family])
    diagram, book = diagram_of(points), Textbook(points)
    check_ridges(diagram, book)
    check_vertices(diagram, book)
    check_cells(diagram)


def check_ridges(diagram, book):
    ridges = {(ridge.first, ridge.second): ridge for ridge in book.ridges}
    rows = [tuple(pair) for pair in diagram.ridge_points.tolist()]
    assert {pair for pair, ridge in ridges.items() if not ridge.is_point} <= set(rows)
    for pair, ends, direction, is_point in zip(
        rows,
        diagram.ridge_vertices.tolist(),
        diagram.ridge_directions.tolist(),
        diagram.is_zero_length.tolist(),
        strict=True,
    ):
        ridge = ridges[pair]
        assert is_point == ridge.is_point
        # The first row on the left means: from the low to the high position.
        for vertex, t in zip(ends, (ridge.low, ridge.high), strict=True):
            assert (vertex < 0) == (t is None)
            if t is not None:
                near = book.vertices[book.place(ridge, t)][0]
                assert near.issuperset(diagram.triangles[vertex].tolist())
        (ax, ay), (bx, by) = (book.sites[row] for row in pair)
        left, length = (ay - by, bx - ax), math.isqrt(ridge.width << 200) / 2**100
        assert direction == pytest.approx(
            [float(c / Fraction(length)) for c in left], abs=1e-14
        )


def check_vertices(diagram, book):
    unit = book.unit
    scale = max((abs(c) for site in book.sites for c in site), default=0) * unit
    exact = []
    for triangle in diagram.triangles.tolist():
        centre = oracles.circumcentre(*(book.sites[row] for row in triangle))
        exact.append(centre)
    groups = diagram.vertex_group.tolist()
    for vertex, (centre, group) in enumerate(zip(exact, groups, strict=True)):
        assert group == exact.index(centre)
        assert np.array_equal(diagram.vertices[vertex], diagram.vertices[group])
        radius = Fraction(oracles.square_root(book.vertices[centre][1] * unit**2))
        for found, wanted in zip(diagram.vertices[vertex].tolist(), centre, strict=True):
            assert abs(Fraction(found) - wanted * unit) <= (radius + scale) / 2**48 + unit / 2


def check_cells(diagram):
    """Check that ridges and vertices follow one another around each cell."""
    ends = diagram.ridge_vertices.tolist()
    for row in range(len(diagram.points)):
        part = slice(diagram.offset[row], diagram.offset[row + 1])
        ridges, after = diagram.cell_ridges[part].tolist(), diagram.cell_vertices[part].tolist()
        assert diagram.bounded[row] == (bool(after) and -1 not in after)
        for k, ridge in enumerate(ridges):
            pair = diagram.ridge_points[ridge].tolist()
            start, end = ends[ridge] if pair[0] == row else ends[ridge][::-1]
            assert row in pair
            assert end == after[k]
            assert start == after[k - 1]
        if -1 in after and len(diagram.triangles):
            assert after[-1] == -1
            assert after.count(-1) == 1


@pytest.mark.parametrize(
    "points",
    [
        np.random.default_rng(1).random((500, 2)),
        grid(12, 9),
        np.array([*CIRCLES[65], (0, 0)], dtype=float),
        np.random.default_rng(2).integers(0, 30, (400, 2)).astype(float),
    ],
    ids=["uniform", "grid", "circle", "integers"],
)
def test_the_dual_is_the_triangulation(points):
    """Neighbouring cells give the edges; cells around a vertex give the triangles."""
    diagram, triangulated = voronoi(points), delaunay(points)
    owner = np.repeat(np.arange(len(points)), np.diff(diagram.offset))
    pairs = diagram.ridge_points[diagram.cell_ridges]
    across = pairs.sum(axis=1) - owner
    edges = np.sort(np.column_stack((owner, across)), axis=1)
    assert oracles.row_set(np.unique(edges, axis=0)) == oracles.row_set(triangulated.edges)
    around = {}
    for row, vertex in zip(owner.tolist(), diagram.cell_vertices.tolist(), strict=True):
        if vertex >= 0:
            around.setdefault(vertex, []).append(row)
    triangles = {tuple(sorted(rows)) for rows in around.values()}
    assert triangles == oracles.row_set(triangulated.triangles)
    assert int(diagram.is_zero_length.sum()) == len(triangles) - len(
        set(diagram.vertex_group.tolist())
    )


def test_two_points_have_one_line():
    diagram = voronoi([[0.0, 0.0], [4.0, 0.0]])
    assert diagram.vertices.shape == (0, 2)
    assert diagram.ridge_vertices.tolist() == [[-1, -1]]
    assert diagram.ridge_directions.tolist() == [[0.0, 1.0]]
    assert diagram.ridge_midpoints.tolist() == [[2.0, 0.0]]
    assert diagram.bounded.tolist() == [False, False]
    assert diagram.areas.tolist() == [math.inf, math.inf]
    segments, ridge = diagram.segments((-1, -1, 5, 3))
    assert segments.tolist() == [[[2.0, -1.0], [2.0, 3.0]]]
    assert ridge.tolist() == [0]


def test_lines_beside_the_box_are_left_out():
    for points in ([[0.0, 0.0], [4.0, 0.0]], [[0.0, 0.0], [0.0, 4.0]]):
        diagram = voronoi(points)
        assert diagram.segments((3, 3, 5, 5))[0].shape == (0, 2, 2)
        assert len(diagram.segments((2, 2, 5, 5))[0]) == 1  # along its side


def test_collinear_points_have_parallel_lines():
    diagram = voronoi([[2.0, 2.0], [0.0, 0.0], [6.0, 6.0], [2.0, 2.0]])
    assert diagram.ridge_points.tolist() == [[0, 1], [0, 2]]
    assert diagram.ridge_vertices.tolist() == [[-1, -1]] * 2
    root = math.sqrt(0.5)
    assert diagram.ridge_directions == pytest.approx(np.array([[root, -root], [-root, root]]))
    assert diagram.areas.tolist() == [math.inf, math.inf, math.inf, 0.0]
    assert np.diff(diagram.offset).tolist() == [2, 1, 1, 0]
    assert not diagram.bounded.any()


@pytest.mark.parametrize("points", [np.empty((0, 2)), [[1.0, 2.0]], [[1.0, 2.0]] * 3])
def test_no_ridges(points):
    diagram = voronoi(points)
    assert len(diagram.ridge_points) == len(diagram.vertices) == len(diagram.cell_ridges) == 0
    assert diagram.segments((0, 0, 1, 1))[0].shape == (0, 2, 2)
    assert diagram.areas.tolist() == [math.inf, 0.0, 0.0][: len(points)]
    clipped = diagram.clip((0, 0, 2, 3))
    assert clipped.areas.tolist() == [6.0, 0.0, 0.0][: len(points)]


def test_cocircular_points_share_one_vertex():
    diagram = voronoi(np.array(CIRCLES[25], dtype=float) * 0.1 + 7.3)
    nearly = voronoi(np.array(CIRCLES[25], dtype=float))
    assert set(nearly.vertex_group.tolist()) == {0}
    assert (nearly.vertices == nearly.vertices[0]).all()
    assert np.abs(nearly.vertices).max() < 1e-14
    assert int(nearly.is_zero_length.sum()) == len(CIRCLES[25]) - 3
    assert np.abs(diagram.vertices - 7.3).max() < 1e-13


def test_areas_are_exact_on_a_grid():
    diagram = voronoi(grid(6, 5, 0.5))
    inner = diagram.bounded.reshape(5, 6)
    assert inner[1:-1, 1:-1].all()
    assert int(inner.sum()) == 4 * 3
    assert diagram.areas[diagram.bounded].tolist() == [0.25] * 12


def test_areas_are_accurate_far_from_the_origin():
    points = np.random.default_rng(3).integers(0, 1000, (200, 2)).astype(float)
    near, far = voronoi(points), voronoi(points + 2.0**45)
    assert np.array_equal(near.bounded, far.bounded)
    assert np.array_equal(near.areas, far.areas)
    polygons = {}
    for row in np.flatnonzero(near.bounded).tolist():
        part = slice(near.offset[row], near.offset[row + 1])
        corners = [
            oracles.circumcentre(*(tuple(map(int, points[k])) for k in near.triangles[v]))
            for v in near.cell_vertices[part]
        ]
        polygons[row] = float(oracles.doubled_area(corners) / 2)
    for row, area in polygons.items():
        assert near.areas[row] == pytest.approx(area, rel=1e-12)


# ------------------------------------------------------------------ segments


@pytest.mark.parametrize(
    "box", [(0, 0, 1, 1), (-3, -2, 4, 5), (0.4, 0.4, 0.45, 0.6), (2, 2, 3, 3)]
)
@pytest.mark.parametrize("name", ["uniform", "grid", "line", "nearly a line"])
def test_segments_are_the_ridges_in_the_box(name, box):
    shapely = pytest.importorskip("shapely")
    rng = np.random.default_rng(4)
    x = rng.random(30)
    points = {
        "uniform": rng.random((80, 2)),
        "grid": grid(5, 5, 0.25),
        "line": np.column_stack((np.arange(12), np.arange(12) * 0.5)) / 8,
        "nearly a line": np.column_stack((x, x + rng.normal(size=30) * 1e-12)),
    }[name]
    diagram = voronoi(points)
    segments, ridge = diagram.segments(box)
    pairs = points[diagram.ridge_points[ridge]]
    for k in (0, 1):
        ends = segments[:, k]
        assert (ends >= np.array(box[:2]) - 1e-12).all()
        assert (ends <= np.array(box[2:]) + 1e-12).all()
        distances = [np.hypot(*(ends - pairs[:, side]).T) for side in (0, 1)]
        assert distances[0] == pytest.approx(distances[1], abs=1e-9)
    cells = diagram.clip(box).to_shapely()
    borders = shapely.union_all(shapely.boundary(cells[~shapely.is_empty(cells)]))
    frame = shapely.boundary(shapely.box(*box))
    expected = shapely.difference(borders, shapely.buffer(frame, 1e-9)).length
    inside = shapely.difference(
        shapely.union_all(shapely.linestrings(segments)), shapely.buffer(frame, 1e-9)
    )
    assert inside.length == pytest.approx(expected, rel=1e-6, abs=1e-8)


# ------------------------------------------------------------------ the rest

BAD_BOXES = [(0, 0, 1), (0, 0, 0, 1), (0, 1, 1, 0), (0, 0, math.inf, 1), ("a", 0, 1, 1), None]


@pytest.mark.parametrize("bad", BAD_BOXES)
def test_bad_boxes(bad):
    diagram = voronoi(grid(3, 3))
    with pytest.raises(ParameterError, match="a box is four finite numbers"):
        diagram.segments(bad)
    with pytest.raises(ParameterError, match=r"a box is four|region must be a box"):
        diagram.clip(bad)


@pytest.mark.parametrize(
    "bad",
    [
        [[0, 0], [1, 0]],
        [[0, 0], [0, 1], [1, 0]],
        [[0, 0], [2, 0], [1, 0.5], [2, 2], [0, 2]],
        [[0, 0], [1, 1], [2, 2]],
        [[0, 0], [1, 0], [math.nan, 1]],
        [[1, 0], [0, 1], [-1, -1], [1, -1], [0, 1], [-1, 0]],
    ],
)
def test_bad_corners(bad):
    with pytest.raises(ParameterError, match="in convex position and counter-clockwise"):
        voronoi(grid(3, 3)).clip(bad)


@pytest.mark.parametrize("bad", ["box", [[0, 0, 0]], [[0, 0], [1]], 5.0])
def test_bad_regions(bad):
    with pytest.raises(ParameterError, match="region must be a box"):
        voronoi(grid(3, 3)).clip(bad)


def test_bad_shapes():
    shapely = pytest.importorskip("shapely")
    diagram = voronoi(grid(3, 3))
    for bad in (shapely.Point(0, 0), shapely.Polygon(), shapely.LineString([(0, 0), (1, 1)])):
        with pytest.raises(ParameterError, match="got an empty one or a"):
            diagram.clip(bad)
    with pytest.raises(ParameterError, match="not a valid polygon"):
        diagram.clip(shapely.Polygon([(0, 0), (1, 1), (1, 0), (0, 1)]))


def test_a_region_out_of_scale():
    with pytest.raises(ParameterError, match="too large, too small or too far away"):
        voronoi(grid(3, 3, 1e-200)).clip((0, 0, 1, 1))


def test_bad_clouds():
    with pytest.raises(NonFiniteError, match="row 0 "):
        voronoi([[math.nan, 0.0], [1.0, 1.0]])
    with pytest.raises(ParameterError, match="threads must be"):
        voronoi(grid(3, 3), threads=-1)


def test_shapely_is_needed_for_its_polygons_alone(monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "shapely", None)
    clipped = voronoi(grid(3, 3)).clip((0, 0, 1, 1))
    with pytest.raises(MissingLibraryError, match=r'pip install "alphamesh\[geo\]"'):
        clipped.to_shapely()


def test_order_and_threads_do_not_matter():
    points = np.random.default_rng(9).integers(0, 200, (15_000, 2)).astype(float)
    one, four = voronoi(points, threads=1), voronoi(points, threads=4)
    for name in ("vertices", "vertex_group", "ridge_vertices", "cell_ridges", "cell_vertices"):
        assert np.array_equal(getattr(one, name), getattr(four, name))
    order = np.random.default_rng(10).permutation(len(points))
    shuffled = voronoi(points[order])
    assert np.array_equal(one.vertices, shuffled.vertices)
    assert np.array_equal(one.vertex_group, shuffled.vertex_group)


def test_records_are_closed_and_travel():
    diagram = voronoi(np.random.default_rng(11).random((30, 2)))
    names = ("vertices", "vertex_group", "ridge_vertices", "cell_ridges", "areas", "bounded")
    for name in (*names, "ridge_directions", "ridge_midpoints", "is_zero_length"):
        assert not getattr(diagram, name).flags.writeable
    assert copy.deepcopy(diagram) is diagram
    back = pickle.loads(pickle.dumps(diagram))
    assert np.array_equal(back.areas, diagram.areas)
    clipped = diagram.clip((0, 0, 1, 1))
    for name in ("offset", "ring_offset", "hole", "vertices", "areas"):
        assert not getattr(clipped, name).flags.writeable
    assert np.array_equal(pickle.loads(pickle.dumps(clipped)).areas, clipped.areas)
    assert repr(clipped) == "<ClippedVoronoi: 30 of 30 cells>"
    assert repr(diagram).startswith(f"<Voronoi: {len(diagram.vertices)} vertices, ")


def test_the_complex_offers_its_diagram():
    points = np.random.default_rng(12).random((40, 2))
    cx = am.AlphaComplex(points)
    assert cx.voronoi is cx.voronoi
    assert np.array_equal(cx.voronoi.vertices, am.voronoi(points).vertices)


def test_vertices_are_the_corners_of_restricted_cells():
    points = grid(5, 4, 0.1)
    cx = am.AlphaComplex(points)
    cells = cx.restricted_voronoi(0.08)
    inner = ~cells.is_arc & ~np.roll(cells.is_arc, -1)
    corners = {tuple(v) for v in cells.end[inner].tolist()}
    assert corners <= {tuple(v) for v in cx.voronoi.vertices.tolist()}
    assert len(corners) == 4 * 3
