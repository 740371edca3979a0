"""Points from pixels, demo shapes and noise."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp
from scipy import ndimage

from alphamesh.errors import CloudError, EmptyMaskError, ParameterError
from alphamesh.sampling import (
    DEMO_SHAPES,
    add_noise,
    add_outliers,
    demo_cloud,
    demo_mask,
    sample_pixels,
)
from alphamesh.shapes import MAX_SIZE, MIN_SIZE

EIGHT = np.ones((3, 3), dtype=bool)
FOUR = None  # scipy's default neighbourhood

masks = hnp.arrays(bool, hnp.array_shapes(min_dims=2, max_dims=2, max_side=9)).filter(np.any)


def pixels_of(points: np.ndarray, mask: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the row and column of the pixel that each point lies in."""
    columns, up = np.floor(points).astype(int).T
    return mask.shape[0] - 1 - up, columns


# Sampling


@given(masks, st.integers(1, 60), st.booleans(), st.integers(0, 2**32))
def test_every_point_lies_in_a_chosen_pixel(mask, n, replace, seed):
    points = sample_pixels(mask, n, seed=seed, replace=replace)
    assert points.shape == (n, 2)
    assert points.dtype == np.float64
    assert mask[pixels_of(points, mask)].all()


@given(masks, st.integers(0, 2**32))
def test_without_jitter_every_pixel_gives_its_lower_left_corner(mask, seed):
    points = sample_pixels(mask, np.count_nonzero(mask), seed=seed, jitter=False)
    assert np.array_equal(points, np.floor(points))
    again = np.zeros_like(mask)
    again[pixels_of(points, mask)] = True
    assert np.array_equal(again, mask)


@given(masks, st.integers(1, 60), st.integers(0, 2**32))
def test_pixels_are_used_as_evenly_as_can_be(mask, n, seed):
    points = sample_pixels(mask, n, seed=seed)
    uses = np.zeros(mask.shape, dtype=int)
    np.add.at(uses, pixels_of(points, mask), 1)
    assert set(uses[mask]) <= {n // mask.sum(), n // mask.sum() + 1}
    assert len(np.unique(points, axis=0)) == n


@given(masks, st.integers(1, 60), st.booleans(), st.booleans(), st.integers(0, 2**64))
def test_a_seed_gives_the_same_points_again(mask, n, jitter, replace, seed):
    n = n if jitter or replace else min(n, np.count_nonzero(mask))
    first = sample_pixels(mask, n, seed=seed, jitter=jitter, replace=replace)
    assert np.array_equal(
        first, sample_pixels(mask, n, seed=seed, jitter=jitter, replace=replace)
    )
    generator = np.random.default_rng(seed)
    assert np.array_equal(
        first, sample_pixels(mask, n, seed=generator, jitter=jitter, replace=replace)
    )


def test_other_seeds_and_no_seed_give_other_points():
    mask = np.ones((20, 20), dtype=bool)
    clouds = [sample_pixels(mask, 50, seed=seed) for seed in (0, 1, None, None)]
    generator = np.random.default_rng(0)
    clouds += [sample_pixels(mask, 50, seed=generator) for _ in range(2)]
    distinct = {cloud.tobytes() for cloud in clouds}
    assert len(distinct) == 5  # the fresh generator repeats seed 0, and nothing else does


def test_y_points_up_and_x_right():
    mask = np.zeros((3, 5), dtype=bool)
    mask[0, 4] = True  # top right
    assert sample_pixels(mask, 1, jitter=False).tolist() == [[4, 2]]
    x, y = sample_pixels(mask, 500, seed=0).T
    assert 4 <= x.min() < 4.05 < 4.95 < x.max() < 5
    assert 2 <= y.min() < 2.05 < 2.95 < y.max() < 3


def test_points_are_spread_evenly():
    mask = np.ones((10, 10), dtype=bool)
    points = sample_pixels(mask, 100_000, seed=3, replace=True)
    counts = np.histogram2d(*points.T, bins=20, range=[[0, 10], [0, 10]])[0]
    # 250 points expected in each of 400 cells, with a standard deviation of 16.
    assert 170 < counts.min() < 235
    assert 265 < counts.max() < 330


def test_points_come_in_random_order():
    mask = np.ones((100, 100), dtype=bool)
    for n in (5_000, 25_000):
        points = sample_pixels(mask, n, seed=0)
        assert abs(points[: n // 10].mean() - 50) < 2


def test_replacement_may_repeat_a_pixel_corner():
    mask = np.ones((2, 2), dtype=bool)
    points = sample_pixels(mask, 50, seed=0, jitter=False, replace=True)
    assert len(np.unique(points, axis=0)) == 4


def test_a_point_does_not_round_onto_the_next_pixel():
    mask = np.zeros((1, 1_000_003), dtype=bool)
    mask[0, -1] = True
    x = sample_pixels(mask, 100_000, seed=0)[:, 0]
    assert x.max() < 1_000_003
    assert np.array_equal((x * 2**30) % 1, np.zeros(len(x)))


def test_more_points_than_pixels_need_jitter_or_replacement():
    mask = np.eye(7, dtype=bool)
    message = r"n=8 exceeds the 7 chosen pixels.*n <= 7, jitter=True.*replace=True"
    with pytest.raises(ParameterError, match=message):
        sample_pixels(mask, 8, jitter=False)
    assert len(sample_pixels(mask, 8)) == 8
    assert len(sample_pixels(mask, 8, jitter=False, replace=True)) == 8


@pytest.mark.parametrize("n", [0, -3, 2.0, 2.5, "5", None, True, np.nan, 2**31, 10**30])
def test_bad_numbers_of_points(n):
    with pytest.raises(ParameterError, match=r"n must be an integer from 1 to .* not "):
        sample_pixels(np.ones((2, 2), dtype=bool), n)


def test_numpy_integers_are_numbers_of_points():
    assert len(sample_pixels(np.ones((2, 2), dtype=bool), np.int16(3))) == 3


@pytest.mark.parametrize("seed", [-1, "one", 1.5])
def test_bad_seeds(seed):
    with pytest.raises(ParameterError, match="seed must be a non-negative integer"):
        sample_pixels(np.ones((2, 2), dtype=bool), 2, seed=seed)


def test_an_empty_mask_is_an_error():
    with pytest.raises(EmptyMaskError, match="none of the 12 pixels of the mask is True"):
        sample_pixels(np.zeros((3, 4), dtype=bool), 2)


@pytest.mark.parametrize("mask", [np.ones((2, 2)), np.ones(4, dtype=bool)])
def test_a_mask_is_a_2d_bool_array(mask):
    with pytest.raises(ParameterError, match="mask must be a 2D bool array"):
        sample_pixels(mask, 2)


# Demo shapes


def betti(mask: np.ndarray, foreground: object, background: object) -> tuple[int, int]:
    around = np.pad(~mask, 1, constant_values=True)
    components = ndimage.label(mask, foreground)[1]
    return components, ndimage.label(around, background)[1] - 1


@pytest.mark.parametrize("size", [MIN_SIZE, 77, 130, 256, 511])
@pytest.mark.parametrize("name", DEMO_SHAPES)
def test_shapes_have_the_betti_numbers_they_state(name, size):
    mask = demo_mask(name, size)
    assert mask.shape == (size, size)
    assert mask.dtype == bool
    # Both ways to join pixels at corners agree, so no shape hangs on a corner.
    assert betti(mask, EIGHT, FOUR) == DEMO_SHAPES[name].betti
    assert betti(mask, FOUR, EIGHT) == DEMO_SHAPES[name].betti


def test_shapes_cover_the_topologies():
    stated = {shape.betti for shape in DEMO_SHAPES.values()}
    assert {(1, 0), (1, 1), (1, 2), (5, 0), (3, 2), (1, 5)} <= stated
    for name, shape in DEMO_SHAPES.items():
        assert shape.name == name
        assert shape.description


def test_shapes_keep_off_the_border_of_the_image():
    for name in DEMO_SHAPES:
        mask = demo_mask(name, 100)
        frame = np.concatenate([mask[0], mask[-1], mask[:, 0], mask[:, -1]])
        assert not frame.any(), name


def test_the_letter_i_has_its_dot_on_top():
    mask = demo_mask("letter-i", 100)
    assert ndimage.label(mask[:40])[1] == 2
    assert ndimage.label(mask[50:])[1] == 1


def test_an_unknown_shape_lists_the_known_ones():
    with pytest.raises(ParameterError, match=r"no demo shape is called 'heart'; choose .*disc"):
        demo_mask("heart")
    with pytest.raises(ParameterError, match="no demo shape is called None"):
        demo_mask(None)


@pytest.mark.parametrize("size", [0, -5, MIN_SIZE - 1, MAX_SIZE + 1])
def test_sizes_out_of_range(size):
    with pytest.raises(ParameterError, match=f"size={size} is out of range; take 64 to 16384"):
        demo_mask("disc", size)


def test_a_size_is_an_integer():
    with pytest.raises(ParameterError, match=r"size must be an integer, not 100\.5"):
        demo_mask("disc", 100.5)


def test_demo_shapes_cannot_be_changed():
    with pytest.raises(TypeError):
        DEMO_SHAPES["disc"] = DEMO_SHAPES["gear"]


def test_demo_cloud_lies_in_its_shape():
    mask = demo_mask("annulus", 128)
    points = demo_cloud("annulus", 500, seed=1, size=128)
    assert points.shape == (500, 2)
    assert mask[pixels_of(points, mask)].all()
    assert np.array_equal(points, demo_cloud("annulus", 500, seed=1, size=128))


# Noise


def test_noise_has_the_spread_asked_for():
    points = np.full((20_000, 2), 7.0)
    moved = add_noise(points, 0.5, seed=0)
    assert np.allclose(moved.mean(axis=0), 7, atol=0.02)
    assert np.allclose(moved.std(axis=0), 0.5, atol=0.02)
    assert np.array_equal(points, np.full((20_000, 2), 7.0))
    assert np.array_equal(moved, add_noise(points, 0.5, seed=0))


def test_no_noise_leaves_the_cloud_as_it_is():
    points = [[1, 2], [3, 4]]
    assert add_noise(points, 0).tolist() == points


def test_outliers_follow_the_cloud_and_fill_its_box():
    points = demo_cloud("disc", 300, seed=0)
    low, high = points.min(axis=0), points.max(axis=0)
    reach = 0.25 * (high - low)
    more = add_outliers(points, 4000, margin=0.25, seed=1)
    assert np.array_equal(more[:300], points)
    outliers = more[300:]
    assert len(outliers) == 4000
    assert (outliers >= low - reach).all()
    assert (outliers <= high + reach).all()
    assert np.allclose(outliers.min(axis=0), low - reach, atol=1)
    assert np.allclose(outliers.max(axis=0), high + reach, atol=1)


@pytest.mark.parametrize("sigma", [-1, np.nan, np.inf, "wide", None])
def test_bad_noise(sigma):
    with pytest.raises(ParameterError, match="sigma must be a finite number of at least 0"):
        add_noise([[0, 0]], sigma)


def test_bad_outliers():
    with pytest.raises(ParameterError, match="count must be an integer from 1"):
        add_outliers([[0, 0]], 0)
    with pytest.raises(ParameterError, match="margin must be a finite number"):
        add_outliers([[0, 0]], 1, margin=-1)
    with pytest.raises(ParameterError, match="an empty cloud has no bounding box"):
        add_outliers(np.empty((0, 2)), 1)
    with pytest.raises(CloudError):
        add_outliers([1, 2, 3], 1)
