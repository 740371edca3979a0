"""Restricted Voronoi cells: borders that close, measures, outlines."""

from __future__ import annotations

import copy
import itertools
import math
import pickle

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

import alphamesh as am
from alphamesh.errors import CoordinateRangeError, MissingLibraryError, ParameterError
from alphamesh.filtration import filtration
from alphamesh.restricted import restricted_voronoi
from cell_samples import cells_of, random_cloud
from strategies import FAMILIES
from textbook import Textbook

FULL = 2 * math.pi


def pieces_of(cells, row):
    return slice(cells.offset[row], cells.offset[row + 1])


# ------------------------------------------------------------------ any cloud


@st.composite
def radii_of(draw, built):
    """Draw a radius well between two critical ones, or beyond them all."""
    critical = np.unique(np.concatenate(built.radii))
    between = [a + (b - a) / 2 for a, b in itertools.pairwise(critical) if b - a > 1e-6 * b]
    if len(critical):
        between.append(float(critical[-1]) * 1.5 or 1.0)
    between = [r for r in between if 1e-100 < r < 1e100]
    assume(between)
    return draw(st.sampled_from(between))


@pytest.mark.parametrize("family", sorted(set(FAMILIES) - {"subnormal"}))
@given(data=st.data())
def test_every_cloud(family, data):
    points = data.draw(FAMILIES[family])
    try:
        built = filtration(points)
    except CoordinateRangeError as error:
        assume("too large for float64" not in str(error))
        raise
    radius = data.draw(radii_of(built))
    cells = restricted_voronoi(built, radius)
    check_borders(cells)
    book = Textbook(points)
    for row, expected in book.measures(book.square(radius)).items():
        area, straight, around = expected
        assert cells.area[row] / radius**2 == pytest.approx(area, rel=1e-9, abs=1e-11)
        assert cells.segment_length[row] / radius == pytest.approx(straight, abs=1e-9)
        assert cells.arc_length[row] / radius == pytest.approx(around, abs=1e-9)


def check_borders(cells):
    """Check that borders close and lie where they should, on circles and on bisectors."""
    for row in range(len(cells.points)):
        border = pieces_of(cells, row)
        if cells.representative[row] != row:
            assert border.stop == border.start
            assert cells.area[row] == cells.border_length[row] == 0
            continue
        start, end = cells.start[border], cells.end[border]
        assert np.array_equal(end, np.roll(start, -1, axis=0))
        neighbor = cells.neighbor[border]
        assert not ((neighbor < 0) & (np.roll(neighbor, -1) < 0)).any() or len(neighbor) == 1
        inside = neighbor[neighbor >= 0]
        assert np.array_equal(cells.neighbors(row), inside)
        assert len(set(inside.tolist())) == len(inside)
        assert cells.is_free[row] == (len(inside) == 0)
    check_positions(cells)


def check_positions(cells):
    radius, arc = cells.radius, cells.is_arc
    centre, other = cells.points[cells.cell], cells.points[cells.neighbor]
    allowed = 1e-9 * radius + 4e-15 * np.abs(cells.points).max()
    turns = cells.angles[arc, 1] - cells.angles[arc, 0]
    assert np.all((turns >= 0) & (turns <= FULL * (1 + 1e-15)))
    assert np.isnan(cells.angles[~arc]).all()
    for k, ends in enumerate((cells.start, cells.end)):
        angle = cells.angles[arc, k]
        on_circle = centre[arc] + radius * np.column_stack((np.cos(angle), np.sin(angle)))
        assert np.all(np.abs(ends[arc] - on_circle) <= allowed)
        near = np.hypot(*(ends - centre).T)
        far = np.hypot(*(ends - other).T)
        assert np.all(np.abs(near - far)[~arc] <= allowed)
        assert np.all(near <= radius + allowed)
    # A segment is walked the other way round from the other side, bit for bit.
    ends = {
        (a, b): (s, e)
        for a, b, s, e in zip(
            cells.cell.tolist(),
            cells.neighbor.tolist(),
            cells.start.tolist(),
            cells.end.tolist(),
            strict=True,
        )
        if b >= 0
    }
    assert all(ends[b, a] == (end, start) for (a, b), (start, end) in ends.items())


# ------------------------------------------------------------------ by hand


def test_a_free_cell_is_a_whole_disc():
    cells = cells_of([[1.0, 2.0], [9.0, 2.0]], 3.0)
    assert cells.offset.tolist() == [0, 1, 2]
    assert cells.start.tolist() == cells.end.tolist() == [[4.0, 2.0], [12.0, 2.0]]
    assert cells.angles.tolist() == [[0.0, FULL]] * 2
    assert cells.is_free.tolist() == [True, True]
    assert cells.area == pytest.approx([9 * math.pi] * 2, rel=1e-15)
    assert cells.arc_length == pytest.approx([6 * math.pi] * 2, rel=1e-15)
    assert cells.neighbors(0).tolist() == []


def test_discs_that_touch_share_a_point():
    cells = cells_of([[0.0, 0.0], [2.0, 0.0]], 1.0)
    assert cells.offset.tolist() == [0, 2, 4]
    assert cells.neighbor.tolist() == [1, -1, 0, -1]
    assert cells.start.tolist() == cells.end.tolist() == [[1.0, 0.0]] * 4
    assert cells.segment_length.tolist() == [0.0, 0.0]
    assert cells.arc_length == pytest.approx([FULL] * 2, rel=1e-15)
    assert cells.total_area == pytest.approx(FULL, rel=1e-15)
    assert cells.is_free.tolist() == [False, False]
    assert cells.edges.tolist() == [[0, 1]]
    before = cells_of([[0.0, 0.0], [2.0, 0.0]], math.nextafter(1, 0))
    assert before.is_free.tolist() == [True, True]
    assert before.edges.shape == (0, 2)


def test_two_discs_share_a_chord():
    cells = cells_of([[0.0, 0.0], [6.0, 0.0]], 5.0)
    assert cells.start[0].tolist() == [3.0, -4.0]
    assert cells.end[0].tolist() == [3.0, 4.0]
    assert cells.segment_length.tolist() == [8.0, 8.0]
    half = math.atan2(4, 3)
    assert cells.angles[1] == pytest.approx([half, FULL - half], rel=1e-15)
    assert cells.area == pytest.approx([12 + 25 * (math.pi - half)] * 2, rel=1e-15)
    assert cells.outer_length == pytest.approx(2 * 5 * (FULL - 2 * half), rel=1e-15)


def test_several_arcs():
    plus = [[0.0, 0.0], [6.0, 0.0], [0.0, 6.0], [-6.0, 0.0], [0.0, -6.0]]
    cells = cells_of(plus, 4.0)
    assert int(cells.is_arc[pieces_of(cells, 0)].sum()) == 4
    assert sorted(cells.neighbors(0).tolist()) == [1, 2, 3, 4]
    assert cells.triangles.shape == (0, 3)
    whole = cells_of(plus, 4.5)
    assert not whole.is_arc[pieces_of(whole, 0)].any()
    assert whole.area[0] == pytest.approx(36.0, rel=1e-14)
    assert whole.arc_length[0] == 0.0
    assert whole.triangles.tolist() == [[0, 1, 2], [0, 1, 4], [0, 2, 3], [0, 3, 4]]


def test_a_grid_of_squares():
    y, x = np.mgrid[0:4, 0:5]
    grid = np.column_stack((x.ravel(), y.ravel())).astype(float)
    cells = cells_of(grid, math.sqrt(0.5))
    inner = cells.arc_length == 0
    assert int(inner.sum()) == 2 * 3
    assert cells.area[inner].tolist() == [1.0] * 6
    # Diagonals are segments without length between the corners that they share.
    diagonal = np.abs(grid[cells.cell] - grid[cells.neighbor]).sum(axis=1) == 2
    diagonal &= ~cells.is_arc
    assert int(diagonal.sum()) == 2 * 12
    assert np.array_equal(cells.start[diagonal], cells.end[diagonal])


def test_collinear_cells_are_slices():
    cells = cells_of([[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]], 5.0)
    assert int(cells.is_arc[pieces_of(cells, 1)].sum()) == 2
    assert cells.segment_length[1] == pytest.approx(4 * math.sqrt(25 - 0.25), rel=1e-15)
    chord, angle = math.sqrt(25 - 0.25), 2 * math.asin(0.5 / 5)
    assert cells.area[1] == pytest.approx(chord + 25 * angle, rel=1e-14)


def test_duplicates_have_one_cell():
    cells = cells_of([[0.0, 0.0], [3.0, 0.0], [0.0, -0.0], [3.0, 0.0]], 2.0)
    assert np.diff(cells.offset).tolist() == [2, 2, 0, 0]
    assert cells.area[2:].tolist() == [0.0, 0.0]
    assert cells.is_free.tolist() == [False] * 4
    assert cells.neighbors(0).tolist() == [1]
    assert [p.is_empty for p in shapes_of(cells)] == [False, False, True, True]
    assert cells.svg_paths()[2:] == ["", ""]


def test_radius_zero_leaves_points():
    cells = cells_of([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]], 0)
    assert cells.area.tolist() == cells.border_length.tolist() == [0.0] * 3
    assert cells.is_free.all()
    assert np.array_equal(cells.start, cells.points)
    assert cells.polygons()[0].shape == (0, 2)
    assert cells.polygons()[1].tolist() == [0] * 4
    assert cells.svg_paths() == [""] * 3
    vertices, codes, offset = cells.bezier_paths()
    assert vertices.shape == (0, 2)
    assert codes.shape == (0,)
    assert offset.tolist() == [0] * 4


def test_no_points():
    cells = cells_of(np.empty((0, 2)), 1.0)
    assert cells.offset.tolist() == [0]
    assert cells.total_area == 0.0
    assert cells.edges.shape == (0, 2)
    assert cells.triangles.shape == (0, 3)
    assert cells.svg_paths() == []
    assert cells.polygons()[0].shape == cells.bezier_paths()[0].shape == (0, 2)
    assert len(shapes_of(cells)) == 0


# ------------------------------------------------------------------ oracles


def shapes_of(cells, tolerance=None):
    pytest.importorskip("shapely")
    return cells.to_shapely(tolerance)


@pytest.mark.parametrize("radius", [0.01, 0.03, 0.05, 0.2])
def test_the_union_has_the_area_that_shapely_finds(radius):
    shapely = pytest.importorskip("shapely")
    points = random_cloud()
    cells = cells_of(points, radius)
    discs = shapely.buffer(shapely.points(points), radius, quad_segs=256)
    union = shapely.union_all(discs)
    # The polygons of shapely are inscribed: too small by this share at most.
    disc = math.pi * radius**2
    lost = 1 - math.sin(FULL / 1024) / (FULL / 1024)
    assert union.area <= cells.total_area <= union.area + lost * len(points) * disc
    assert cells.outer_length == pytest.approx(union.length, rel=1e-4)


@pytest.mark.parametrize("n", [50, 1000])
@pytest.mark.parametrize("share", [0.4, 0.8, 1.5])
def test_areas_are_those_of_pyafv(n, share):
    pyafv = pytest.importorskip("pyafv")
    points = random_cloud(n, seed=n)
    radius = share / math.sqrt(n)
    simulator = pyafv.FiniteVoronoiSimulator(points, pyafv.PhysicalParams(r=radius))
    areas = np.asarray(simulator.build()["areas"])
    cells = cells_of(points, radius)
    assert cells.area == pytest.approx(areas, rel=1e-9)


def test_polygons_are_inscribed_and_close():
    shapely = pytest.importorskip("shapely")
    cells = cells_of(random_cloud(), 0.04)
    for tolerance in (None, 1e-2, 1e-3, 1e-6):
        polygons = shapes_of(cells, tolerance)
        allowed = 4e-5 if tolerance is None else tolerance
        assert shapely.is_valid(polygons).all()
        assert (shapely.get_type_id(polygons) == 3).all()
        missing = cells.area - shapely.area(polygons)
        assert np.all(missing >= -1e-15)
        assert np.all(missing <= allowed * cells.arc_length + 1e-15)
    vertices, offset = cells.polygons(1e-6)
    assert len(offset) == len(cells.points) + 1
    distance = np.hypot(*(vertices - np.repeat(cells.points, np.diff(offset), axis=0)).T)
    assert distance.max() <= 0.04 + 1e-15


def test_polygons_do_not_overlap():
    shapely = pytest.importorskip("shapely")
    polygons = shapes_of(cells_of(random_cloud(150), 0.08))
    union = shapely.union_all(polygons)
    assert union.area == pytest.approx(shapely.area(polygons).sum(), rel=1e-12)
    assert shapely.coverage_is_valid(polygons)


def test_grids_make_valid_polygons():
    shapely = pytest.importorskip("shapely")
    y, x = np.mgrid[0:7, 0:7]
    for factor in (1.0, 0.1, 1 / 3):
        grid = np.column_stack((x.ravel(), y.ravel())) * factor + 17.0
        for share in (0.5, 0.6, math.sqrt(0.5), 0.9):
            cells = cells_of(grid, share * factor)
            polygons = shapes_of(cells)
            assert shapely.is_valid(polygons).all()
            assert shapely.area(polygons).sum() == pytest.approx(cells.total_area, rel=2e-3)


# ------------------------------------------------------------------ invariance


def test_scale_and_place_do_not_matter():
    points = random_cloud(100)
    cells = cells_of(points, 0.07)
    for power in (-900, -300, 300, 900):
        other = cells_of(np.ldexp(points, power), math.ldexp(0.07, power))
        assert np.array_equal(other.offset, cells.offset)
        assert np.array_equal(other.neighbor, cells.neighbor)
        assert np.array_equal(other.angles, cells.angles, equal_nan=True)
        assert np.array_equal(other.start, np.ldexp(cells.start, power))
        assert np.array_equal(other.arc_length, np.ldexp(cells.arc_length, power))
        if abs(power) < 400:
            assert np.array_equal(other.area, np.ldexp(cells.area, 2 * power))
    far = cells_of(points * 2.0**20 + 2.0**40, 0.07 * 2.0**20)
    near = cells_of(far.points - 2.0**40, 0.07 * 2.0**20)
    assert far.area == pytest.approx(near.area, rel=1e-12)
    assert np.array_equal(far.neighbor, near.neighbor)


def test_order_and_threads_do_not_matter():
    points = random_cloud(20_000)
    radius = 0.006
    cells = restricted_voronoi(filtration(points), radius, threads=1)
    threaded = restricted_voronoi(filtration(points), radius, threads=4)
    for name in ("offset", "start", "end", "neighbor", "angles", "area"):
        first, second = getattr(cells, name), getattr(threaded, name)
        assert np.array_equal(first, second, equal_nan=name == "angles")
    order = np.random.default_rng(2).permutation(len(points))
    shuffled = restricted_voronoi(filtration(points[order]), radius)
    assert np.diff(shuffled.offset).tolist() == np.diff(cells.offset)[order].tolist()
    assert shuffled.area == pytest.approx(cells.area[order], rel=1e-12)


def test_progress_is_told_and_can_stop_the_work():
    built = filtration(random_cloud(120_000))
    told = []
    cells = restricted_voronoi(built, 0.002, progress=told.append)
    assert told[-1] == 1.0
    assert told == sorted(told)
    assert len(cells.points) == 120_000

    def stop(done):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        restricted_voronoi(built, 0.002, threads=1, progress=stop)
    with pytest.raises(ParameterError, match="progress must be None or a function"):
        restricted_voronoi(built, 0.002, progress=3)


def test_beyond_the_range_of_floats():
    huge = cells_of([[0.0, 0.0], [1.0, 0.0]], 1e300)
    assert huge.area.tolist() == [math.inf] * 2
    assert huge.segment_length == pytest.approx([2e300] * 2)
    assert huge.total_area == math.inf
    with pytest.raises(ParameterError, match="too large beside coordinates as small as these"):
        cells_of(np.array([[0.0, 0.0], [1.0, 0.0]]) * 2.0**-1000, 1e200)


# ------------------------------------------------------------------ the rest


@pytest.mark.parametrize("bad", [-1, -0.5, math.nan, math.inf, "1", None, 1j, [1.0]])
def test_bad_radii(bad):
    with pytest.raises(ParameterError, match="radius must be a finite number of at least 0"):
        cells_of([[0.0, 0.0]], bad)


def test_needs_a_filtration():
    with pytest.raises(ParameterError, match="needs a filtration, not list"):
        restricted_voronoi([[0.0, 0.0]], 1.0)


@pytest.mark.parametrize("bad", [0, -1, math.nan, "fine"])
def test_bad_tolerances(bad):
    with pytest.raises(ParameterError, match="tolerance must be a positive number"):
        cells_of([[0.0, 0.0]], 1.0).polygons(bad)


@pytest.mark.parametrize("bad", [0, 18, 2.5])
def test_bad_digits(bad):
    with pytest.raises(ParameterError, match="digits must be a whole number from 1 to 17"):
        cells_of([[0.0, 0.0]], 1.0).svg_paths(bad)


@pytest.mark.parametrize("bad", [-1, 2])
def test_bad_rows(bad):
    with pytest.raises(ParameterError, match="row must be 0 to 1"):
        cells_of([[0.0, 0.0], [1.0, 1.0]], 1.0).neighbors(bad)


def test_shapely_is_needed_for_its_polygons_alone(monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "shapely", None)
    cells = cells_of([[0.0, 0.0]], 1.0)
    assert len(cells.polygons()[0]) > 30
    with pytest.raises(MissingLibraryError, match=r'pip install "alphamesh\[geo\]"'):
        cells.to_shapely()


def test_a_record_is_closed_and_travels():
    cells = cells_of(random_cloud(30), 0.1)
    for name in ("start", "end", "neighbor", "angles", "area", "cell", "is_free", "edges"):
        assert not getattr(cells, name).flags.writeable
    assert copy.deepcopy(cells) is cells
    back = pickle.loads(pickle.dumps(cells))
    assert back.radius == cells.radius
    assert np.array_equal(back.start, cells.start)
    assert not back.start.flags.writeable
    assert repr(cells).startswith("<RestrictedVoronoi at radius 0.1: 30 cells, ")


def test_the_complex_offers_its_cells():
    cx = am.AlphaComplex(random_cloud(60))
    cells = cx.restricted_voronoi(0.1)
    assert np.array_equal(cells.area, restricted_voronoi(cx.filtration, 0.1).area)
    assert cx.restricted_voronoi().radius == cx.choose_radius().radius
    assert am.restricted_voronoi(cx.filtration, 0.1).radius == 0.1
