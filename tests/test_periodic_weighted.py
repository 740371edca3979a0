"""Weighted points in periodic boxes."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import alphamesh as am
from alphamesh.check import check_periodic
from alphamesh.errors import CoordinateRangeError, WeightsError
from periodic_oracle import exact_values, matrix_pairs
from reduction import pair_set
from test_periodic import boxed, boxes, named

weights_like = st.one_of(
    st.sampled_from([0.0, 0.25, -0.25, 0.01, 1.0]),
    st.floats(-1, 1).map(lambda w: w if abs(w) > 2.0**-60 else 0.0),
)


def weighted(points, periods, weights):
    made = am.AlphaComplex(points, periods=periods, weights=weights)
    check_periodic(made.filtration)
    return made


@st.composite
def weighted_boxes(draw):
    points, periods = draw(boxes())
    weights = draw(st.lists(weights_like, min_size=len(points), max_size=len(points)))
    return points, periods, np.array(weights)


def signed_roots(values):
    return [math.copysign(math.sqrt(abs(value)), value) for value in values]


@settings(max_examples=25, deadline=None)
@given(weighted_boxes())
def test_every_value_is_that_of_its_definition(box):
    filtration = weighted(*box).filtration
    size = max(float(np.abs(box[2]).max()), 1e-3)
    for values, radii in zip(exact_values(filtration), filtration.radii, strict=True):
        expected = np.array([float(value) for value in values])
        found = np.copysign(radii**2, radii)
        assert np.allclose(found, expected, rtol=1e-12, atol=1e-14 * size)


@settings(max_examples=25, deadline=None)
@given(weighted_boxes())
def test_pairs_are_those_of_the_matrix(box):
    made = weighted(*box)
    pairs, staying = matrix_pairs(made.filtration)
    found = made.persistence()
    for k in range(len(made.simplices)):
        assert pair_set(found.pairs[k]) == pairs[k]
        assert set(found.essential[k].tolist()) == staying[k]


@pytest.mark.parametrize("d", [2, 3])
def test_equal_weights_change_no_simplex(d):
    points = np.random.default_rng(1).random((60, d))
    plain = boxed(points, (1,) * d)
    zero = weighted(points, (1,) * d, np.zeros(60))
    assert named(zero) == named(plain)
    shifted = weighted(points, (1,) * d, np.full(60, 0.01))
    assert named(shifted).keys() == named(plain).keys()
    for own, other in zip(shifted.radii, plain.radii, strict=True):
        assert own.tolist() == pytest.approx(signed_roots(other**2 - 0.01), abs=1e-12)
    # The general kernel agrees with the shift.
    weights = np.full(60, 0.01)
    weights[0] += 1e-17
    assert named(weighted(points, (1,) * d, weights)).keys() == named(plain).keys()


def test_values_are_those_of_diode():
    diode = pytest.importorskip("diode")
    # Of seeds 2, 3 and 6, diode leaves out points that exact fractions prove to be visible:
    # its Euler characteristic is 1 or 2, which no torus has.
    rng = np.random.default_rng(4)
    points, weights = rng.random((400, 3)), rng.random(400) * 0.01
    made = weighted(points, (1, 1, 1), weights)
    rows, values = diode.fill_weighted_periodic_alpha_shapes_arrays(
        np.column_stack((points, weights)), False, [0.0] * 3, [1.0] * 3
    )
    assert len(made.hidden) > 0
    assert [len(part) for part in rows] == [len(part) for part in made.simplices]
    # Its vertices have their own weight even if another ball covers their centre.
    for own, theirs in zip(made.radii[1:], values[1:], strict=True):
        assert np.allclose(np.sort(np.copysign(own**2, own)), np.sort(theirs), atol=1e-12)


@pytest.mark.parametrize("d", [2, 3])
def test_the_middle_of_a_tiling_has_the_same_values(d):
    rng = np.random.default_rng(3)
    count = 40 if d == 3 else 80
    points = rng.integers(0, 1 << 20, (count, d)) / (1 << 20)
    weights = rng.random(count) * 0.02
    made = weighted(points, (1.0,) * d, weights)
    moves = np.indices((3,) * d).reshape(d, -1).T - 1
    middle = int(np.flatnonzero((moves == 0).all(axis=1))[0])
    whole = am.AlphaComplex(
        np.concatenate([points + move for move in moves]), weights=np.tile(weights, 3**d)
    )
    for k in range(d + 1):
        tile, row = np.divmod(whole.simplices[k], count)
        # All with their lexicographically first vertex in the middle, by row and offset.
        order = np.lexsort((tile, row), axis=1)
        first = np.take_along_axis(tile, order, axis=1)[:, 0]
        seen = np.sort(whole.radii[k][first == middle])
        assert len(seen) == len(made.radii[k])
        assert np.allclose(seen, np.sort(made.radii[k]), rtol=1e-9, atol=1e-9)
    hidden = whole.hidden[whole.hidden // count == middle] % count
    assert made.hidden.tolist() == hidden.tolist()


def test_the_heaviest_stands_for_all_at_one_place():
    points = [[0.1, 0.1], [1.1, 0.1], [0.1, 2.1], [0.6, 0.6]]
    made = weighted(points, (1, 1), [0.0, 0.05, 0.05, 0.0])
    # 1.1 - 1 is not 0.1 in float64, so that row 1 lies beside the others.
    assert made.representative.tolist() == [0, 1, 2, 3]
    points[1][0], points[2][1] = 0.1 + 0, 0.1 + 0
    made = weighted(points, (1, 1), [0.0, 0.05, 0.05, 0.0])
    assert made.representative.tolist() == [1, 1, 1, 3]
    assert made.hidden.tolist() == [0]
    assert made.simplices[0].tolist() == [[1], [3]]


def test_one_heavy_ball_hides_all_others():
    rng = np.random.default_rng(4)
    made = weighted(rng.random((20, 3)), (1, 1, 1), np.append(100.0, np.zeros(19)))
    assert made.hidden.tolist() == list(range(1, 20))
    assert made.at(np.inf).betti == (1, 3, 3, 1)
    assert made.radii[0].tolist() == [-10]
    assert made.at(-9.999).counts["vertices"] == 1
    assert made.at(-10.1).counts["vertices"] == 0
    assert "19 hidden points" in repr(made)
    assert len(made.tiled(2).hidden) == 8 * 19


def test_wrong_weights_are_refused():
    with pytest.raises(WeightsError):
        am.AlphaComplex([[0.1, 0.2]], periods=(1, 1), weights=[1, 2])
    with pytest.raises(CoordinateRangeError, match="weights") as error:
        am.AlphaComplex([[0.1, 0.2], [0.3, 0.4]], periods=(1, 1), weights=[0.5, 1e200])
    assert error.value.rows == (1,)


def test_values_at_the_lower_end_of_what_is_not_scaled():
    """Found by fuzzing: products of eight coordinates left the range of float64."""
    points = np.random.default_rng(3).integers(0, 256, (12, 3)) / 256
    weights = np.random.default_rng(4).integers(0, 16, 12) / 256
    whole = am.AlphaComplex(points, periods=(1, 1, 1), weights=weights)
    tiny = np.ldexp(points, -130), np.ldexp(weights, -260)
    small = am.AlphaComplex(tiny[0], periods=(2.0**-130,) * 3, weights=tiny[1])
    for own, other in zip(whole.filtration.radii, small.filtration.radii, strict=True):
        assert np.array_equal(np.ldexp(own, -130), other)
