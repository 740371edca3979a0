"""Measures of unions of discs and of balls of different sizes."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest

import alphamesh as am
from alphamesh.unions import union_of_balls
from union_oracle import Balls
from union_samples import area_of_discs, measures, sampled, volume_of_balls
from weighted_samples import WEIGHTS

PI = math.pi


@pytest.mark.parametrize("gap", [0.1, 0.59, 0.6, 0.61, 0.9, 1.0, 1.3, 1.6 - 1e-9, 1.6, 2.0])
def test_two_balls_of_different_size(gap):
    big, small = 1.1, 0.5
    ball = 4 / 3 * PI * (big**3 + (small**3 if gap > big - small else 0))
    lens = 0.0
    if big - small < gap < big + small:
        square = gap**2 + 2 * gap * (big + small) - 3 * (big - small) ** 2
        lens = PI * (big + small - gap) ** 2 * square / (12 * gap)
    cx = am.AlphaComplex([[0, 0, 0], [0, gap, 0]], weights=[big**2, small**2])
    assert cx.union(0).volume == pytest.approx(ball - lens, rel=1e-12)
    assert cx.union(0).ball_radii == pytest.approx([big, small], rel=1e-15)
    # The same balls, of other weights at another radius.
    grown = am.AlphaComplex([[0, 0, 0], [0, gap, 0]], weights=[big**2 + 1, small**2 + 1])
    assert grown.union(-1).volume == pytest.approx(ball - lens, rel=1e-12)
    discs = am.AlphaComplex([[0, 0], [0, gap]], weights=[big**2, small**2]).union()
    area = area_of_discs([(0, 0), (0, gap)], [big, small])
    assert discs.area == pytest.approx(area, rel=1e-9)


def test_three_balls_of_different_size():
    centres, radii = [(0, 0), (1.3, 0.1), (0.4, 0.9)], [1.1, 0.7, 0.8]
    points = np.column_stack((centres, np.zeros(3)))
    found = am.AlphaComplex(points, weights=np.square(radii)).union(0)
    kinks = []
    for i, j in itertools.combinations(range(3), 2):
        length = math.dist(centres[i], centres[j])
        near = (length**2 + radii[i] ** 2 - radii[j] ** 2) / (2 * length)
        kinks.append(math.sqrt(radii[i] ** 2 - near**2))
    square = found.filtration.radii[2][0]
    kinks.append(math.sqrt(-square * abs(square)))  # where the three spheres meet
    assert found.volume == pytest.approx(volume_of_balls(centres, radii, kinks), rel=1e-12)


@pytest.mark.parametrize("kind", sorted(WEIGHTS))
@pytest.mark.parametrize("seed", range(3))
def test_weights_in_fifty_digits(kind, seed):
    rng = np.random.default_rng(seed)
    points = rng.random((16, 3))
    built = am.AlphaComplex(points, weights=WEIGHTS[kind](rng, points)).filtration
    critical = np.unique(np.concatenate(built.radii))
    apart = np.flatnonzero(np.diff(critical) > 1e-9)
    for radius in rng.choice((critical[apart] + critical[apart + 1]) / 2, 4):
        found, exact = union_of_balls(built, radius), Balls(built, radius)
        size = found.ball_radii.max()
        assert found.volume == pytest.approx(exact.volume, rel=1e-11)
        assert found.ball_volumes == pytest.approx(exact.volumes, abs=1e-11 * size**3)
        assert found.ball_surface_areas == pytest.approx(exact.areas, abs=1e-11 * size**2)


@pytest.mark.parametrize("noise", [1e-3, 1e-8, 1e-13])
def test_almost_duplicates_of_different_weights_in_fifty_digits(noise):
    rng = np.random.default_rng(7)
    points = rng.integers(0, 3, (16, 3)) + noise * rng.normal(size=(16, 3))
    built = am.AlphaComplex(points, weights=rng.integers(2, 5, 16) / 4).filtration
    for radius in (-0.45, 0.05, 0.6, 4.0):
        found, exact = union_of_balls(built, radius), Balls(built, radius)
        size = found.ball_radii.max()
        assert found.volume == pytest.approx(exact.volume, rel=1e-11)
        assert found.ball_volumes == pytest.approx(exact.volumes, abs=1e-11 * size**3)
        assert found.ball_surface_areas == pytest.approx(exact.areas, abs=1e-11 * size**2)


@pytest.mark.parametrize("seed", range(5))
def test_spheres_that_all_meet_in_one_point(seed):
    points = np.random.default_rng(seed).normal(size=(25, 3))
    built = am.AlphaComplex(points, weights=(points**2).sum(axis=1)).filtration
    less, found, more = (union_of_balls(built, radius) for radius in (-1e-5, 0.0, 1e-5))
    size = found.ball_radii.max()
    assert found.volume == pytest.approx(less.volume, rel=1e-8)
    assert found.volume == pytest.approx(more.volume, rel=1e-8)
    assert found.ball_volumes == pytest.approx(more.ball_volumes, abs=1e-8 * size**3)
    assert found.ball_volumes.sum() == pytest.approx(found.volume, rel=1e-12)


@pytest.mark.parametrize("dimension", [2, 3])
@pytest.mark.parametrize("kind", sorted(WEIGHTS))
def test_weights_equal_sampling(dimension, kind):
    rng = np.random.default_rng(3)
    points = rng.random((20, dimension))
    weights = WEIGHTS[kind](rng, points)
    cx = am.AlphaComplex(points, weights=weights)
    for radius in (0.0, 0.15, -0.1):
        found = cx.union(radius)
        content, _, parts, borders = measures(found)
        power = radius * abs(radius)
        if (weights + power <= 0).all():
            assert content == parts.sum() == borders.sum() == 0
            continue
        total, each, error = sampled(points, weights, power, 100_000, seed=2)
        error += 1e-9  # balls too small to be hit
        assert content == pytest.approx(total, abs=4 * error)
        assert parts == pytest.approx(each, abs=4 * error)
        assert not parts[cx.hidden].any()


@pytest.mark.parametrize("dimension", [2, 3])
def test_equal_weights_are_a_radius(dimension):
    points = np.random.default_rng(3).random((200, dimension))
    plain = measures(am.AlphaComplex(points).union(0.15))
    weighted = measures(am.AlphaComplex(points, weights=np.full(200, 0.15**2)).union(0.0))
    for a, b in zip(plain, weighted, strict=True):
        assert b == pytest.approx(a, rel=1e-9, abs=1e-12)


def test_parts_of_discs_at_a_triangle_of_almost_no_height():
    """Found by fuzzing: the middle point is off the line of the others by an ulp."""
    points = np.array(
        [
            [-6.7834626804597065e-14, -9.9628638672299985e-14],
            [4.3659520443384281e-14, 6.6183170055467144e-14],
            [1.4974133044631799e-14, 2.3522850334245498e-14],
        ]
    )
    weights = [1.4527402237414672e-26, 6.2863657239371714e-27, 7.7754914828564737e-28]
    built = am.filtration(points, weights=weights)
    found = union_of_balls(built, float(built.radii[2][0]))
    assert found.disc_areas.sum() == pytest.approx(found.area, rel=1e-12, abs=0)


def test_a_ball_that_is_not_there_for_its_weight_changes_nothing():
    """Found by fuzzing: what its weight rounds was taken for what others' values do."""
    points = np.array([[0, 0, 0], [3, 0, 0], [0, 3, 0], [0, 0, 3.0], [5, 5, 5]])
    alone = am.AlphaComplex(points[:4], weights=[0, 1, 0, 0]).union(1.75)
    found = am.AlphaComplex(points, weights=[0, 1, 0, 0, -1e30]).union(1.75)
    assert found.volume == pytest.approx(alone.volume, rel=1e-14)
    assert found.ball_volumes[:4] == pytest.approx(alone.ball_volumes, rel=1e-14)
