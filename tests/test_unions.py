"""Measures of unions of discs and of balls: closed forms, sampling, 50 digits, invariance."""

from __future__ import annotations

import copy
import itertools
import math
import pickle

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

import alphamesh as am
from alphamesh.errors import CoordinateRangeError, ParameterError
from alphamesh.filtration import filtration
from alphamesh.restricted import restricted_voronoi
from alphamesh.unions import UnionOfBalls, UnionOfDiscs, union_of_balls
from strategies import FAMILIES
from strategies3 import FAMILIES as FAMILIES_IN_SPACE
from union_samples import holes, measures, sampled, union, volume_of_balls

PI = math.pi
TURN = 2 * PI


# ------------------------------------------------------------------ closed forms


@pytest.mark.parametrize("dimension", [2, 3])
def test_no_points(dimension):
    found = union(np.empty((0, dimension)), 1)
    assert measures(found)[:2] == (0, 0)
    assert all(len(array) == 0 for array in (*measures(found)[2:], *holes(found)))


@pytest.mark.parametrize("radius", [0.0, 1e-30, 0.25, 1.0, 7.5e20])
def test_one_ball(radius):
    disc, ball = union([[3, 4]], radius), union([[3, 4, 5]], radius)
    assert disc.area == pytest.approx(PI * radius**2, rel=1e-15)
    assert disc.perimeter == pytest.approx(TURN * radius, rel=1e-15)
    assert ball.volume == pytest.approx(4 / 3 * PI * radius**3, rel=1e-15)
    assert ball.surface_area == pytest.approx(4 * PI * radius**2, rel=1e-15)


GAPS = [1e-12, 1e-6, 0.1, 0.5, 1, 1.5, 1.9, 2 - 1e-6, 2 - 1e-12, 2, 2 + 1e-12, 2.5, 100]


@pytest.mark.parametrize("gap", GAPS)
@pytest.mark.parametrize("direction", [(1, 0, 0), (0.48, 0.6, 0.64)])
def test_two_balls(gap, direction):
    found = union([[0, 0, 0], gap * np.array(direction)], 1)
    met = min(gap / 2, 1)
    cap = PI * (1 - met) ** 2 * (2 + met) / 3
    assert found.volume == pytest.approx(8 / 3 * PI - 2 * cap, rel=1e-12)
    assert found.surface_area == pytest.approx(4 * PI * (1 + met), rel=1e-12)
    assert found.ball_volumes == pytest.approx([found.volume / 2] * 2, rel=1e-12)


@pytest.mark.parametrize("gap", GAPS)
def test_two_discs(gap):
    found = union([[0, 0], [0, gap]], 1)
    met = min(gap / 2, 1)
    half = math.atan2(math.sqrt((1 - met) * (1 + met)), met)
    assert found.area == pytest.approx(TURN - 2 * (half - met * math.sin(half)), rel=1e-12)
    assert found.perimeter == pytest.approx(2 * (TURN - 2 * half), rel=1e-12)


@pytest.mark.parametrize("sides", [(1, 1, 1), (1.2, 1, 0.7), (1.5, 1.5, 0.1), (1.4, 1, 1)])
@pytest.mark.parametrize("radius", [0.9, 1.0, 3.0])
def test_three_balls_with_a_common_part(sides, radius):
    a, b, c = sides
    x = (c * c + b * b - a * a) / (2 * c)
    y = math.sqrt(b * b - x * x)
    heights = [math.sqrt(radius**2 - d**2 / 4) for d in sides]
    heights.append(math.sqrt(radius**2 - (a * b / (2 * y)) ** 2))
    expected = volume_of_balls([(0, 0), (c, 0), (x, y)], [radius] * 3, heights)
    found = union([[0, 0, 0], [c, 0, 0], [x, y, 0]], radius)
    assert found.volume == pytest.approx(expected, rel=1e-12)


def test_three_balls_that_meet_in_pairs_only():
    found = union([[0, 0, 0], [1.8, 0, 0], [0.9, 0.9 * math.sqrt(3), 0]], 1)
    cap = PI * 0.1**2 * 2.9 / 3
    assert found.volume == pytest.approx(4 * PI - 6 * cap, rel=1e-12)
    assert found.surface_area == pytest.approx(12 * PI - 6 * TURN * 0.1, rel=1e-12)
    assert len(found.voids.volumes) == 0


def test_three_discs():
    corners = [[0, 0], [1, 0], [0.5, math.sqrt(3) / 2]]
    for radius in (0.52, 0.57, 1 / math.sqrt(3), 0.6, 1.0):
        found = union(corners, radius)
        half = math.acos(0.5 / radius)
        lens = 2 * radius**2 * half - 0.5 * math.tan(half)
        pairs = 3 * PI * radius**2 - 3 * lens
        gap = 0.0
        if radius < 1 / math.sqrt(3):
            gap = math.sqrt(3) / 4 - PI * radius**2 / 2 + 1.5 * lens
            assert found.area == pytest.approx(pairs, rel=1e-12)
            assert found.holes.areas == pytest.approx([gap], abs=1e-13)
            assert found.hole_discs(0).tolist() == [0, 1, 2]
            arc = 3 * radius * (PI / 3 - 2 * half)
            assert found.holes.perimeters == pytest.approx([arc], abs=1e-12)
        else:
            outside = math.sqrt(3) / 4 + 1.5 * radius**2 * (5 / 3 * PI - 2 * half)
            outside += 1.5 * math.sqrt(radius**2 - 0.25)
            assert found.area == pytest.approx(outside, rel=1e-12)
            assert len(found.holes.areas) == 0


def test_a_cube_of_balls():
    cube = np.array(list(itertools.product((0, 1), repeat=3)))
    touching = union(cube, 0.5)
    assert touching.volume == pytest.approx(8 * PI / 6, rel=1e-14)
    assert touching.ball_surface_areas == pytest.approx([PI] * 8, rel=1e-14)
    found = union(cube, 0.8)  # faces are covered, the middle is not
    assert len(found.voids.volumes) == 1
    assert found.void_balls(0).tolist() == list(range(8))
    assert found.void_balls(-1).tolist() == list(range(8))
    with pytest.raises(IndexError, match="void 1 of 1"):
        found.void_balls(1)
    outside = found.surface_area - found.voids.surface_areas[0]
    assert outside > found.voids.surface_areas[0] > 0


def test_nested_and_merged():
    points = [[0, 0, 0], [0, 0, 0], [1, 0, 0], [1, 0, 0], [0, 0, 0]]
    found = union(points, 1)
    assert found.ball_volumes[[1, 3, 4]].tolist() == [0, 0, 0]
    assert found.volume == union([[0, 0, 0], [1, 0, 0]], 1).volume


# ------------------------------------------------------------------ against others


@pytest.mark.parametrize("dimension", [2, 3])
@pytest.mark.parametrize(("n", "radius"), [(4, 0.5), (30, 0.12), (30, 0.3)])
def test_equals_sampling(dimension, n, radius):
    points = np.random.default_rng(n).random((n, dimension))
    content, _, parts, _ = measures(union(points, radius))
    total, each, error = sampled(points, np.zeros(n), radius**2, 200_000, seed=1)
    assert content == pytest.approx(total, abs=4 * error)
    assert parts == pytest.approx(each, abs=4 * error)
    assert error < 0.01 * content


@pytest.mark.parametrize("radius", [0.02, 0.05, 0.1, 0.3])
def test_equals_restricted_cells(radius):
    built = filtration(np.random.default_rng(5).random((300, 2)))
    cells, found = restricted_voronoi(built, radius), union_of_balls(built, radius)
    assert found.area == pytest.approx(cells.total_area, rel=1e-13)
    assert found.disc_areas == pytest.approx(cells.area, rel=1e-11, abs=1e-17)
    assert found.disc_perimeters == pytest.approx(cells.arc_length, rel=1e-11, abs=1e-14)


@pytest.mark.parametrize("radius", [0.04, 0.08, 0.15])
def test_equals_buffers_of_shapely(radius):
    shapely = pytest.importorskip("shapely")
    points = np.random.default_rng(6).random((80, 2))
    found = union(points, radius)
    coarse, fine = (
        shapely.union_all(shapely.buffer(shapely.points(points), radius, quad_segs=k))
        for k in (128, 256)
    )
    # Chords lose in proportion to their squared length; what is left goes with the fourth.
    assert found.area == pytest.approx((4 * fine.area - coarse.area) / 3, rel=1e-7)
    assert found.perimeter == pytest.approx((4 * fine.length - coarse.length) / 3, rel=1e-6)
    parts = shapely.get_parts(fine)
    inner = [shapely.Polygon(ring).area for part in parts for ring in part.interiors]
    assert len(inner) == len(found.holes.areas)
    assert found.holes.areas == pytest.approx(sorted(inner, reverse=True), rel=1e-2)


# ------------------------------------------------------------------ any cloud


def between(values, data):
    """Draw a radius well between two critical ones, or beyond them all."""
    critical = np.unique(np.concatenate(values))
    middle = [a + (b - a) / 2 for a, b in itertools.pairwise(critical) if b - a > 1e-6 * b]
    if len(critical):
        middle.append(float(critical[-1]) * 1.5 or 1.0)
    middle = [r for r in middle if 1e-60 < r < 1e60]
    assume(middle)
    return data.draw(st.sampled_from(middle))


CLOUDS = [(2, name) for name in sorted(FAMILIES)] + [
    (3, name) for name in sorted(FAMILIES_IN_SPACE)
]


@pytest.mark.parametrize(("dimension", "family"), CLOUDS)
@settings(max_examples=25)
@given(data=st.data())
def test_every_cloud(dimension, family, data):
    if dimension == 2:
        points = data.draw(FAMILIES[family])
    else:
        rng = np.random.default_rng(data.draw(st.integers(0, 2**32 - 1)))
        points = FAMILIES_IN_SPACE[family](rng, data.draw(st.integers(0, 14)))
        points = np.asarray(points, dtype=float).reshape(-1, 3)
    try:
        built = filtration(points)
    except CoordinateRangeError:
        assume(False)
    radius = between(built.radii, data)
    try:
        found = union_of_balls(built, radius)
    except ParameterError as error:
        assert "too large beside" in str(error)
        return
    content, boundary, parts, borders = measures(found)
    unit = radius**dimension
    assert np.isfinite([content, boundary]).all()
    assert (parts >= 0).all()
    assert (borders >= 0).all()
    assert parts.sum() / unit == pytest.approx(content / unit, rel=1e-10)
    balls = len(built.simplices[0])
    ball = PI * unit * (1 if dimension == 2 else 4 / 3)
    assert ball * (1 - 1e-12) <= content <= balls * ball * (1 + 1e-12)
    grown = union_of_balls(built, radius * (1 + 1e-7))
    slack = 1e-7 * (dimension + 1) * balls * ball
    assert content - 1e-9 * unit <= measures(grown)[0] <= content + slack


@pytest.mark.parametrize("dimension", [2, 3])
def test_boundary_is_the_derivative(dimension):
    built = filtration(np.random.default_rng(8).random((150, dimension)))
    for radius in np.geomspace(0.03, 0.4, 7):
        step = 1e-6 * radius
        less, found, more = (union_of_balls(built, radius + k * step) for k in (-1, 0, 1))
        slope = (measures(more)[0] - measures(less)[0]) / (2 * step)
        assert slope == pytest.approx(measures(found)[1], rel=1e-4)
        sizes, borders = holes(found)
        if len(sizes) == len(holes(less)[0]) == len(holes(more)[0]) and len(sizes):
            slope = (holes(more)[0] - holes(less)[0]) / (2 * step)
            assert -slope[0] == pytest.approx(borders[0], rel=1e-3)


@pytest.mark.parametrize("dimension", [2, 3])
def test_holes_and_union_fill_the_box(dimension):
    side = np.linspace(0, 1, 7)
    points = np.array(list(itertools.product(side, repeat=dimension)))
    step = side[1]
    found = union(points, 0.5 * step * (1.2 if dimension == 2 else 1.5))
    sizes, _ = holes(found)
    assert len(sizes) == 6**dimension  # the middle of each cell is free
    assert sizes == pytest.approx([sizes[0]] * len(sizes), rel=1e-10)
    assert sizes[0] < step**dimension
    labels = found.holes.labels if dimension == 2 else found.voids.labels
    assert set(labels.tolist()) == set(range(6**dimension)) | ({-1} & set(labels.tolist()))
    parts = (measures(found)[2]).reshape((7,) * dimension)
    inner = parts[(slice(1, -1),) * dimension]
    assert inner + sizes[0] == pytest.approx(step**dimension, rel=1e-12)


@pytest.mark.parametrize("dimension", [2, 3])
@pytest.mark.parametrize("exponent", [-250, -100, -60, 30, 100])
def test_scale(dimension, exponent):
    points = np.random.default_rng(1).random((60, dimension))
    content, boundary, parts, borders = measures(union(points, 0.2))
    scaled = measures(union(np.ldexp(points, exponent), math.ldexp(0.2, exponent)))
    assert scaled[0] == math.ldexp(content, dimension * exponent)
    assert scaled[1] == pytest.approx(
        math.ldexp(boundary, (dimension - 1) * exponent), rel=1e-15
    )
    assert np.array_equal(scaled[2], np.ldexp(parts, dimension * exponent))
    assert np.array_equal(scaled[3], np.ldexp(borders, (dimension - 1) * exponent))


@pytest.mark.parametrize("dimension", [2, 3])
def test_translation_and_order(dimension):
    rng = np.random.default_rng(4)
    points = np.round(rng.random((80, dimension)), 3)
    order = rng.permutation(80)
    shifted = measures(union(np.round(points + 1000, 3)[order], 0.15))
    here = measures(union(points, 0.15))
    assert shifted[0] == pytest.approx(here[0], rel=1e-9)
    assert shifted[2] == pytest.approx(here[2][order], rel=1e-8, abs=1e-12)
    assert shifted[3] == pytest.approx(here[3][order], rel=1e-7, abs=1e-10)


@pytest.mark.parametrize("dimension", [2, 3])
def test_threads_change_nothing(dimension):
    n = 40_000 if dimension == 2 else 10_000
    built = filtration(np.random.default_rng(4).random((n, dimension)))
    radius = 0.7 * n ** (-1 / dimension)
    seen = []
    one = union_of_balls(built, radius, threads=1, progress=seen.append)
    two = union_of_balls(built, radius, threads=2)
    assert seen[-1] == 1.0
    for a, b in zip((*measures(one), *holes(one)), (*measures(two), *holes(two)), strict=True):
        assert np.array_equal(a, b)


def test_it_can_be_stopped():
    def stop(share):
        raise InterruptedError

    built = filtration(np.random.default_rng(4).random((60_000, 3)))
    with pytest.raises(InterruptedError):
        union_of_balls(built, 0.7 * 60_000 ** (-1 / 3), threads=1, progress=stop)


# ------------------------------------------------------------------ the face


@pytest.mark.parametrize("dimension", [2, 3])
def test_complexes_have_it(dimension):
    cx = am.AlphaComplex(np.random.default_rng(0).random((100, dimension)))
    found = cx.union(0.2)
    assert type(found) is (UnionOfDiscs if dimension == 2 else UnionOfBalls)
    assert found.radius == 0.2
    assert measures(found)[0] == measures(union_of_balls(cx.filtration, 0.2))[0]
    assert cx.union().radius == cx.choose_radius().radius
    assert found.ball_radii.tolist() == [0.2] * 100
    assert copy.deepcopy(found) is found
    again = pickle.loads(pickle.dumps(found))
    assert np.array_equal(measures(again)[2], measures(found)[2])
    assert not measures(again)[2].flags.writeable
    assert repr(found).startswith(f"<{type(found).__name__} at radius 0.2: ")


@pytest.mark.parametrize("radius", [-1.0, math.nan, math.inf, "1", None, 1j])
def test_bad_radius(radius):
    with pytest.raises(ParameterError, match="radius must be"):
        union([[0, 0], [1, 1]], radius)


def test_bad_filtration():
    with pytest.raises(ParameterError, match=r"union_of_balls needs a filtration, not list"):
        union_of_balls([[0, 0], [1, 1]], 1.0)
    with pytest.raises(ParameterError, match="threads must be"):
        union([[0, 0], [1, 1]], 1.0, threads=0)
