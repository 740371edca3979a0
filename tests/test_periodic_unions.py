"""Measures of unions of balls in periodic boxes: closed forms, sampling, tilings, channels."""

from __future__ import annotations

import itertools
import math
import pickle

import numpy as np
import pytest

import alphamesh as am
from alphamesh.errors import ParameterError
from alphamesh.periodic import periodic_union
from union_samples import holes, measures

PI = math.pi
TURN = 2 * PI


def channels(found):
    if isinstance(found, am.PeriodicUnionOfDiscs):
        return found.channels.areas, found.channels.perimeters
    return found.channels.volumes, found.channels.surface_areas


def box(points, periods, weights=None):
    return am.AlphaComplex(np.asarray(points, dtype=float), periods=periods, weights=weights)


# ------------------------------------------------------------------ closed forms


@pytest.mark.parametrize("radius", [0.0, 1e-30, 0.2, 0.5, 0.6, math.sqrt(0.5)])
def test_a_cubic_lattice_of_one_ball(radius):
    found = box([[0.1, -7.3, 0.6]], (1, 1, 1)).union(radius)
    height = max(0.0, radius - 0.5)  # of the cap beyond each face
    volume = 4 / 3 * PI * radius**3 - 6 * PI * height**2 * (3 * radius - height) / 3
    area = 4 * PI * radius**2 - 6 * TURN * radius * height
    assert found.volume == pytest.approx(volume, rel=1e-13)
    assert found.surface_area == pytest.approx(area, rel=1e-13)
    assert found.filled_share == found.volume
    assert found.ball_volumes == pytest.approx([volume], rel=1e-13)


def test_a_lattice_of_discs_fills_its_gaps():
    made = box([[0.3, 0.9]], (1, 1))
    for radius in (0.2, 0.5, 0.6, 0.7):
        found = made.union(radius)
        half = math.acos(0.5 / max(0.5, radius))
        lens = 2 * radius**2 * half - 0.5 * math.tan(half)
        area = PI * radius**2 - 2 * lens
        assert found.area == pytest.approx(area, rel=1e-13)
        assert found.perimeter == pytest.approx(radius * (TURN - 8 * half), rel=1e-12)
        rest = found.channels if radius < 0.5 else found.holes
        assert rest.areas == pytest.approx([1 - area], rel=1e-9)
        assert rest.perimeters == pytest.approx([found.perimeter], rel=1e-12)
        assert found.channels.ranks.tolist() == ([2] if radius < 0.5 else [])


@pytest.mark.parametrize("dimension", [2, 3])
@pytest.mark.parametrize("radius", [0.8661, 1.0, 1e80, 1e300])
def test_what_is_covered_is_the_box(dimension, radius):
    points = np.random.default_rng(0).random((7, dimension)) * 3
    found = box(points, (1, 2, 0.5)[:dimension]).union(radius)
    content, boundary, parts, _ = measures(found)
    assert content == pytest.approx((2, 1)[dimension - 2], rel=1e-14)
    assert boundary == 0
    assert parts.sum() == pytest.approx(content, rel=1e-13)
    assert found.filled_share == pytest.approx(1, rel=1e-14)
    assert len(holes(found)[0]) == len(channels(found)[0]) == 0


def test_open_directions_reach_into_the_open():
    row = box([[0.2, 0, 0]], (1, None, None)).union(0.6)
    ball = 4 / 3 * PI * 0.6**3 - 2 * PI * 0.1**2 * (3 * 0.6 - 0.1) / 3
    assert row.volume == pytest.approx(ball, rel=1e-13)
    assert row.surface_area == pytest.approx(TURN * 0.6, rel=1e-13)  # a zone of height 1
    assert len(row.channels) == len(row.voids) == 0
    assert row.filled_share == 0
    strip = box([[0.2, 5]], (None, 1)).union(50)
    area = math.sqrt(2500 - 0.25) + 5000 * math.asin(0.01)
    assert strip.area == pytest.approx(area, rel=1e-12)


# ------------------------------------------------------------------ other ways to measure


def sampled(points, periods, weights, power, count):
    """Estimate content and parts by sampling the box, and standard errors of both."""
    rng = np.random.default_rng(1)
    sides = np.array([side or 0.0 for side in periods])
    most = math.sqrt(weights.max() + power)
    low = np.where(sides > 0, 0, points.min(axis=0) - most)
    high = np.where(sides > 0, sides, points.max(axis=0) + most)
    reach = [math.ceil(most / side) + 1 if side else 0 for side in sides]
    moves = np.array(list(itertools.product(*(range(-k, k + 1) for k in reach)))) * sides
    queries = rng.uniform(low, high, size=(count, len(sides)))
    powers = [
        ((queries[:, None] - (points + move)) ** 2).sum(axis=2) - weights for move in moves
    ]
    nearest = np.min(powers, axis=0)
    owner = nearest.argmin(axis=1)[nearest.min(axis=1) <= power]
    share = np.bincount(owner, minlength=len(points)) / count
    size = np.prod(high - low)
    errors = size * np.sqrt(share * (1 - share) / count + 1 / count**2)
    total = share.sum()
    return size * total, size * share, size * math.sqrt(total * (1 - total) / count), errors


@pytest.mark.parametrize(
    "periods", [(1, 0.8), (None, 0.6), (1, 0.7, 0.9), (0.6, None, 0.7), (None, 0.5, None)]
)
@pytest.mark.parametrize("count", [1, 2, 9])
@pytest.mark.parametrize("heaviest", [0, 0.05])
def test_sampling_agrees(periods, count, heaviest):
    rng = np.random.default_rng(count)
    weights = rng.random(count) * heaviest
    made = box(rng.random((count, len(periods))), periods, weights if heaviest else None)
    found = made.union(0.22)
    content, boundary, parts, _ = measures(found)
    expected, shares, error, errors = sampled(made.positions, periods, weights, 0.22**2, 8_000)
    assert abs(content - expected) < 4 * error
    assert (np.abs(parts - shares) < 5 * errors).all()
    assert parts.sum() == pytest.approx(content, rel=1e-13)
    if None not in periods:
        rest = holes(found)[0].sum() + channels(found)[0].sum()
        assert content + rest == pytest.approx(np.prod(periods), rel=1e-13)
        around = holes(found)[1].sum() + channels(found)[1].sum()
        assert around == pytest.approx(boundary, rel=1e-11)


@pytest.mark.parametrize("dimension", [2, 3])
@pytest.mark.parametrize("heaviest", [0.0, 0.01])
@pytest.mark.parametrize("thickness", [1.0, 2.0**-30])
def test_parts_are_those_of_an_open_tiling(dimension, heaviest, thickness):
    rng = np.random.default_rng(dimension)
    # Copies are float64 again.
    points = np.round(rng.random((25, dimension)) * 2**20) / 2**20
    if thickness < 1:
        points[:15, -1] = 0.875 + np.round(points[:15, -1] * 2**10) / 2**10 * thickness
    weights = rng.random(25) * heaviest
    moves = np.array(list(itertools.product((0, -1, 1), repeat=dimension)))
    tiling = am.AlphaComplex(
        (points + moves[:, None]).reshape(-1, dimension),
        weights=np.tile(weights, len(moves)) if heaviest else None,
    )
    made = box(points, (1,) * dimension, weights if heaviest else None)
    for radius in (0.06, 0.13, 0.2, 0.3):
        _, _, parts, borders = measures(made.union(radius))
        _, _, expected, expected_borders = measures(tiling.union(radius))
        assert parts == pytest.approx(expected[:25], abs=1e-12)
        assert borders == pytest.approx(expected_borders[:25], abs=1e-12)


@pytest.mark.parametrize(
    ("count", "periods", "radii"),
    [
        (1, (1, 0.7), (0.3, 0.4, 0.55)),
        (2, (0.3, None), (0.1, 0.2, 0.5)),
        (1, (1, 1, 1), (0.45, 0.55, 0.75)),
        (2, (0.1, 0.7, 0.3), (0.06, 0.16, 0.3)),
        (3, (0.3, None, 0.1), (0.06, 0.2, 0.4)),
        (1, (None, 0.1, None), (0.04, 0.2, 3)),
    ],
)
def test_few_points_are_as_many_boxes_tell(count, periods, radii):
    made = box(np.random.default_rng(5).random((count, len(periods))), periods)
    larger = made.tiled(3)
    boxes = len(larger.points) // count
    assert not made.is_simplicial
    for radius in radii:
        one, all_ = made.union(radius), larger.union(radius)
        for mine, theirs in zip(measures(one)[:2], measures(all_)[:2], strict=True):
            assert boxes * mine == pytest.approx(theirs, rel=1e-11)
        for mine, theirs in zip(measures(one)[2:], measures(all_)[2:], strict=True):
            assert np.tile(mine, boxes) == pytest.approx(theirs, rel=1e-9, abs=1e-13)
        for mine, theirs in zip(holes(one), holes(all_), strict=True):
            assert np.repeat(mine, boxes) == pytest.approx(theirs, abs=1e-12)
        # Many interwoven networks may be one in the small box.
        assert boxes * channels(one)[0].sum() == pytest.approx(channels(all_)[0].sum())


@pytest.mark.parametrize("periods", [(0.1, 0.7), (0.1, 0.3, 0.7)])
def test_translations_change_nothing(periods):
    rng = np.random.default_rng(8)
    points = rng.random((40, len(periods))) * np.array(periods)
    points[:20, -1] = 0.02 + 1e-9 * rng.random(20)  # slivers across all borders
    radius = 0.07 if len(periods) == 3 else 0.02
    expected = measures(box(points, periods).union(radius))
    for move in (0.05, np.array(periods) / 2, rng.random(len(periods))):
        found = measures(box(points + move, periods).union(radius))
        for mine, theirs in zip(found, expected, strict=True):
            # What moving the points rounds away is all that differs.
            assert mine == pytest.approx(theirs, abs=1e-9)


def test_copies_that_float64_cannot_hold():
    """Points far closer together than the last digit of their copies."""
    tiny = np.array([[0, 0, 0], [1e-20, 0, 0], [0, 3e-20, 1e-20], [1e-20, 1e-20, 4e-20]])
    made = box(tiny, (1, 1, 1))
    single = box(tiny[:1], (1, 1, 1))
    for radius in (0.3, 0.55, 0.75):
        found = made.union(radius)
        assert found.volume == pytest.approx(single.union(radius).volume, rel=1e-12)
        assert found.ball_volumes.sum() == pytest.approx(found.volume, rel=1e-12)
        assert (found.ball_volumes > 0.01 * found.volume).all()


@pytest.mark.parametrize("dimension", [2, 3])
def test_lattices_are_continuous_in_the_radius(dimension):
    points = np.array(list(itertools.product(range(3), repeat=dimension))) * 0.1
    made = box(points, (0.3,) * dimension)
    for radius in (0.05, math.sqrt(0.005), math.sqrt(0.0075)):
        contents = [made.union(radius * (1 + k * 1e-13)) for k in (-1000, -1, 0, 1, 1000)]
        values = [measures(found)[0] for found in contents]
        assert values == pytest.approx([values[2]] * 5, rel=1e-8)


# ------------------------------------------------------------------ channels and voids


def test_layers_tubes_and_networks():
    grid = np.linspace(0, 1, 8, endpoint=False)
    plane = np.array([(x, y, 0.5) for x in grid for y in grid])
    layer = box(plane, (1, 1, 1)).union(0.1)
    assert layer.channels.ranks.tolist() == [2]
    assert len(layer.channel_balls(0)) == 64
    rods = np.concatenate((plane, plane[:, [0, 2, 1]]))
    tube = box(rods, (1, 1, 1)).union(0.1)
    assert tube.channels.ranks.tolist() == [1]
    assert tube.volume + tube.channels.volumes[0] == pytest.approx(1, rel=1e-13)
    closed = box(np.concatenate((rods, plane[:, [2, 0, 1]])), (1, 1, 1)).union(0.1)
    assert (len(closed.channels), len(closed.voids)) == (0, 1)  # a cell that crosses borders
    assert closed.volume + closed.voids.volumes[0] == pytest.approx(1, rel=1e-13)
    network = box(np.column_stack((grid, grid * 0, grid * 0)), (1, 1, 1)).union(0.1)
    assert network.channels.ranks.tolist() == [3]
    # A wall between two halves of the open, and one that bounds a channel with another.
    assert len(box(plane, (1, 1, None)).union(0.1).channels) == 0
    double = np.concatenate((plane, plane + np.array([0, 0, 0.4])))
    between = box(double, (1, 1, None)).union(0.1)
    assert between.channels.ranks.tolist() == [2]
    assert between.channels.volumes[0] < 0.4
    assert between.channel_balls(0).tolist() == list(range(128))


@pytest.mark.parametrize(("winding", "rank"), [((1, 0), 1), ((2, 3), 1), ((5, -7), 1)])
def test_strips_wind_around_the_box(winding, rank):
    steps = np.linspace(0, 1, 60 * sum(map(abs, winding)), endpoint=False)[:, None]
    found = box(steps * winding, (1, 1)).union(0.02)
    assert found.channels.ranks.tolist() == [rank]
    assert found.area + found.channels.areas[0] == pytest.approx(1, rel=1e-13)
    assert repr(found).endswith(", 0 holes, 1 channel>")


def test_the_largest_comes_first():
    heights = np.array([0.1, 0.2, 0.5, 0.9])
    grid = np.linspace(0, 1, 40, endpoint=False)
    lines = np.array([(x, y) for y in heights for x in grid])
    found = box(lines, (1, 1)).union(0.02)
    assert found.channels.ranks.tolist() == [1, 1, 1, 1]
    assert np.array_equal(np.sort(found.channels.areas)[::-1], found.channels.areas)
    assert found.channel_discs(0).tolist() == list(range(80, 160))  # from 0.5 to 0.9
    assert found.channel_discs(-1).tolist() == list(range(80))
    with pytest.raises(IndexError, match="channel 4 of 4"):
        found.channel_discs(4)


# ------------------------------------------------------------------ the face


@pytest.mark.parametrize("dimension", [2, 3])
def test_complexes_have_it(dimension):
    made = box(np.random.default_rng(0).random((60, dimension)) * 4, (1,) * dimension)
    found = made.union(0.1)
    kinds = am.PeriodicUnionOfDiscs, am.PeriodicUnionOfBalls
    assert type(found) is kinds[dimension - 2]
    assert np.array_equal(found.points, made.positions)
    assert made.union().radius == made.choose_radius().radius
    again = pickle.loads(pickle.dumps(found))
    other = made.union(0.1, threads=2)
    for mine, same, twin in zip(measures(found), measures(again), measures(other), strict=True):
        assert np.array_equal(mine, same)
        assert np.array_equal(mine, twin)
    assert not measures(found)[2].flags.writeable
    assert not found.channels.ranks.flags.writeable


def test_weights_may_shrink_and_hide():
    weights = np.array([0.04, 0.01, 0.0001, 0.0001])
    points = [[0.1, 0.1], [0.5, 0.5], [0.11, 0.1], [0.5, 0.1]]
    made = box(points, (1, 1), weights)
    assert made.hidden.tolist() == [2]
    assert made.union(0).disc_areas == pytest.approx(
        PI * np.array([0.04, 0.01, 0, 0.0001]), rel=1e-13
    )
    smaller = made.union(-0.05)
    assert smaller.disc_areas == pytest.approx(PI * np.array([0.0375, 0.0075, 0, 0]), rel=1e-13)
    assert smaller.area + smaller.channels.areas.sum() == pytest.approx(1, rel=1e-14)


@pytest.mark.parametrize("dimension", [2, 3])
def test_no_points(dimension):
    found = box(np.empty((0, dimension)), (1,) * dimension).union(1)
    assert measures(found)[:2] == (0, 0)
    assert len(found.channels) == 0


@pytest.mark.parametrize("radius", [-1.0, math.nan, math.inf, "1"])
def test_bad_radius(radius):
    with pytest.raises(ParameterError, match="radius must be"):
        box([[0, 0]], (1, 1)).union(radius)


def test_bad_filtrations():
    with pytest.raises(ParameterError, match="needs a periodic filtration, not list"):
        periodic_union([[0, 0]], 1.0)
    with pytest.raises(ParameterError, match="not PeriodicFiltration"):
        am.union_of_balls(box([[0, 0]], (1, 1)).filtration, 1.0)
