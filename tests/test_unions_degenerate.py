"""Unions of balls that hardly touch, or touch all at once; slivers and near-duplicates."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest

from alphamesh.filtration import filtration
from alphamesh.unions import union_of_balls
from union_oracle import Balls
from union_samples import measures, union

PI = math.pi


def check_against_oracle(points, radius, rel=1e-11):
    built = filtration(points)
    found, exact = union_of_balls(built, radius), Balls(built, radius)
    size = radius**3
    assert found.volume == pytest.approx(exact.volume, rel=rel)
    assert found.ball_volumes / size == pytest.approx(exact.volumes / size, abs=rel)
    areas = found.ball_surface_areas / radius**2
    assert areas == pytest.approx(exact.areas / radius**2, abs=rel)


@pytest.mark.parametrize("thickness", [1, 1e-3, 1e-8, 1e-15])
def test_slivers_in_fifty_digits(thickness):
    points = np.random.default_rng(2).random((12, 3)) * [1, 1, thickness]
    for radius in (0.2, 0.35, 1.0, 30.0):
        check_against_oracle(points, radius)


@pytest.mark.parametrize("noise", [1e-3, 1e-9, 1e-15])
def test_almost_lattices_and_almost_duplicates_in_fifty_digits(noise):
    rng = np.random.default_rng(3)
    points = rng.integers(0, 3, (14, 3)) + noise * rng.normal(size=(14, 3))
    for radius in (0.55, 0.8, 0.95, 1.7):
        check_against_oracle(points, radius, rel=1e-10)


@pytest.mark.parametrize("seed", [220, 324])
def test_faces_of_two_corners_that_almost_coincide(seed):
    """Seen from the third, far away, they lie in one direction to all digits but the last."""
    rng = np.random.default_rng(seed)
    points = rng.integers(0, 2, (6, 3)) * 0.1 + 1e-16 * rng.integers(-3, 4, (6, 3)) + 0.1
    check_against_oracle(points, 0.08)


@pytest.mark.parametrize("radius", [0.5, math.sqrt(0.5), math.sqrt(0.75), 0.9, 1.0, 40.0])
@pytest.mark.parametrize("dimension", [2, 3])
def test_lattices_are_continuous_in_the_radius(dimension, radius):
    built = filtration(np.array(list(itertools.product(range(4), repeat=dimension))))
    contents, boundaries, parts, _ = zip(
        *(
            measures(union_of_balls(built, radius * (1 + k * 1e-13)))
            for k in (-1000, -1, 0, 1, 1000)
        ),
        strict=True,
    )
    assert contents == pytest.approx([contents[2]] * 5, rel=1e-8)
    assert np.ptp(parts, axis=0).max() < 1e-8 * radius**dimension
    # Contacts begin with the square root of the radius in the plane.
    assert boundaries == pytest.approx([boundaries[2]] * 5, rel=1e-4)


@pytest.mark.parametrize("seed", range(4))
def test_many_on_one_sphere(seed):
    points = np.random.default_rng(seed).normal(size=(30, 3))
    points /= np.linalg.norm(points, axis=1)[:, None]
    built = filtration(points)
    at, less, more = (union_of_balls(built, r) for r in (1.0, 1 - 1e-9, 1 + 1e-9))
    assert less.volume <= at.volume * (1 + 1e-12)
    assert at.volume <= more.volume * (1 + 1e-12)
    assert more.volume == pytest.approx(less.volume, rel=1e-7)
    assert more.ball_volumes == pytest.approx(at.ball_volumes, abs=1e-7)


def test_one_line_and_one_plane_in_space():
    line = union([[k, 2 * k, 2 * k] for k in range(5)], 2.5)
    cap = PI * 1**2 * (3 * 2.5 - 1) / 3
    ball = 4 / 3 * PI * 2.5**3
    assert line.volume == pytest.approx(5 * ball - 8 * cap, rel=1e-13)
    plane = union([[x, y, x + y] for x in range(4) for y in range(4)], 0.9)
    exact = Balls(plane.filtration, 0.9)
    assert plane.volume == pytest.approx(exact.volume, rel=1e-13)
    assert len(line.voids.volumes) == len(plane.voids.volumes) == 0


@pytest.mark.parametrize("dimension", [2, 3])
def test_radius_zero(dimension):
    found = union(np.random.default_rng(0).random((50, dimension)), 0)
    assert measures(found)[:2] == (0, 0)
    assert not measures(found)[2].any()
