"""The same cloud gives the same arrays, however it is ordered, threaded, moved or scaled."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import oracles
from alphamesh.check import check_delaunay, check_filtration
from alphamesh.delaunay import delaunay
from alphamesh.errors import CoordinateRangeError
from alphamesh.filtration import filtration
from strategies import CROWDS, clouds, crowd


def grid(side, step=1.0):
    y, x = np.mgrid[0:side, 0:side]
    return np.column_stack((x.ravel(), y.ravel())) * step


def mask_pixels(side):
    """Pixel corners of two rings and a bar, as a mask image gives them."""
    points = grid(side)
    x, y = points.T / side - 0.5
    r = np.hypot(x, y)
    inside = ((r > 0.35) & (r < 0.45)) | ((r > 0.1) & (r < 0.22)) | (abs(y - x) < 0.02)
    return points[inside]


def with_duplicates(count):
    return np.random.default_rng(1).integers(0, 250, (count, 2)).astype(float)


LARGE = {
    "300 x 300 grid": grid(300),
    "300 x 300 grid of tenths": grid(300, 0.1),
    "mask pixels": mask_pixels(500),
    "duplicates": with_duplicates(80_000),
    "uniform": np.random.default_rng(2).uniform(size=(60_000, 2)),
    "circle": np.exp(1j * np.arange(20_000)).view(float).reshape(-1, 2),
    "line": np.arange(30_000.0)[:, np.newaxis] * [3.0, -7.0],
    "clusters": np.random.default_rng(3).normal(size=(40_000, 2))
    * 10.0 ** np.random.default_rng(4).integers(-8, 9, (40_000, 1)),
}


def renumbered(simplices, order, representative):
    """Turn rows of ``points[order]`` into representative rows of ``points``."""
    return np.sort(representative[order[simplices]], axis=1)


def assert_same_filtration(first, second):
    for k in range(3):
        assert np.array_equal(first.simplices[k], second.simplices[k])
        assert first.radii[k].tobytes() == second.radii[k].tobytes()
    assert np.array_equal(first.edge_triangles, second.edge_triangles)


def assert_shuffled_alike(points, order, threads=None):
    """Shuffling changes the numbers of points and nothing else, not even the row order."""
    first, second = filtration(points), filtration(points[order], threads=threads)
    for k in (1, 2):
        found = renumbered(second.simplices[k], order, first.representative)
        assert np.array_equal(found, first.simplices[k])
        assert second.radii[k].tobytes() == first.radii[k].tobytes()
    assert np.array_equal(second.edge_triangles, first.edge_triangles)
    vertices = renumbered(second.simplices[0], order, first.representative)
    assert np.array_equal(np.sort(vertices, axis=0), first.simplices[0])


@pytest.mark.parametrize("name", LARGE)
def test_order_of_the_points(name):
    points = LARGE[name]
    for seed in range(2):
        order = np.random.default_rng(seed).permutation(len(points))
        assert_shuffled_alike(points, order, threads=1 + seed)
    assert_shuffled_alike(points, np.arange(len(points))[::-1])


@given(points=clouds(), data=st.data())
def test_order_of_few_points(points, data):
    order = np.array(data.draw(st.permutations(range(len(points)))), dtype=np.intp)
    try:
        filtration(points)
    except CoordinateRangeError:
        return
    assert_shuffled_alike(points, order)


@pytest.mark.parametrize("kind", CROWDS)
@given(seed=st.integers(0, 2**32 - 1))
def test_order_of_crowds(kind, seed):
    points = crowd(kind, seed)
    assert_shuffled_alike(points, np.random.default_rng(seed).permutation(len(points)))


@pytest.mark.parametrize("name", LARGE)
def test_number_of_threads(name):
    points = LARGE[name]
    one = filtration(points, threads=1)
    plain = delaunay(points, threads=1)
    for threads in (2, 3, 4, 16):
        assert_same_filtration(one, filtration(points, threads=threads))
        other = delaunay(points, threads=threads)
        assert np.array_equal(other.triangles, plain.triangles)
        assert np.array_equal(other.neighbors, plain.neighbors)
        assert np.array_equal(other.path, plain.path)


@pytest.mark.parametrize("name", LARGE)
def test_large_results_pass_their_check(name):
    result = filtration(LARGE[name])
    check_filtration(result)
    plain = delaunay(LARGE[name])
    check_delaunay(plain)
    assert np.array_equal(plain.triangles, result.simplices[2])


def test_shuffled_neighbors_stay_opposite():
    points = LARGE["mask pixels"]
    order = np.random.default_rng(5).permutation(len(points))
    first, second = delaunay(points), delaunay(points[order])
    triangles = order[second.triangles]
    turn = np.argsort(triangles, axis=1)
    assert np.array_equal(np.take_along_axis(triangles, turn, axis=1), first.triangles)
    assert np.array_equal(np.take_along_axis(second.neighbors, turn, axis=1), first.neighbors)


def test_many_calls_at_once():
    clouds_ = [np.random.default_rng(seed).uniform(size=(3000, 2)) for seed in range(8)]
    alone = [filtration(points, threads=1) for points in clouds_]
    with ThreadPoolExecutor(4) as pool:
        together = list(pool.map(lambda p: filtration(p, threads=2), clouds_ * 4))
    for result, expected in zip(together, alone * 4, strict=True):
        assert_same_filtration(result, expected)


# Scaling by powers of two is exact, so that everything must scale with it.

EXPONENTS = (-700, -300, -37, 1, 200, 700)


@pytest.mark.parametrize("name", ["300 x 300 grid of tenths", "mask pixels", "uniform"])
@pytest.mark.parametrize("exponent", EXPONENTS)
def test_powers_of_two(name, exponent):
    points = LARGE[name][:20_000]
    first, second = filtration(points), filtration(np.ldexp(points, exponent))
    for k in range(3):
        assert np.array_equal(first.simplices[k], second.simplices[k])
        assert np.array_equal(np.ldexp(first.radii[k], exponent), second.radii[k])


@given(points=clouds(), exponent=st.sampled_from(EXPONENTS))
def test_powers_of_two_of_few_points(points, exponent):
    scaled = np.ldexp(points, exponent)
    if not np.isfinite(scaled).all() or not np.array_equal(np.ldexp(scaled, -exponent), points):
        return
    try:
        first, second = filtration(points), filtration(scaled)
    except CoordinateRangeError:
        return
    for k in range(3):
        assert np.array_equal(first.simplices[k], second.simplices[k])
        radii = np.ldexp(first.radii[k], exponent)
        normal = (radii > 1e-300) & (first.radii[k] > 1e-300)
        assert np.array_equal(radii[normal], second.radii[k][normal])


# Offsets that are exactly representable change no difference, hence nothing.


@pytest.mark.parametrize("offset", [(1.0, 1.0), (-(2.0**20), 2.0**20), (0.5, -1e6)])
@pytest.mark.parametrize("name", ["300 x 300 grid", "mask pixels", "dyadic"])
def test_exact_offsets(name, offset):
    dyadic = np.random.default_rng(6).integers(0, 2**20, (20_000, 2)) * 2.0**-10
    points = dyadic if name == "dyadic" else LARGE[name]
    moved = points + offset
    assert np.array_equal(moved - offset, points)
    first, second = filtration(points), filtration(moved)
    for k in range(3):
        assert np.array_equal(first.simplices[k], second.simplices[k])
        assert np.array_equal(first.radii[k], second.radii[k])


@given(
    cells=st.lists(st.tuples(st.integers(-20, 20), st.integers(-20, 20)), max_size=12),
    offset=st.tuples(st.integers(-(2**40), 2**40), st.integers(-(2**40), 2**40)),
)
def test_exact_offsets_of_few_points(cells, offset):
    points = np.array(cells, dtype=float).reshape(-1, 2)
    first, second = filtration(points), filtration(points + offset)
    for k in range(3):
        assert np.array_equal(first.simplices[k], second.simplices[k])
        assert np.array_equal(first.radii[k], second.radii[k])


def test_quarter_turns_keep_the_values():
    """A quarter turn is exact; it keeps a triangulation without ties, and its values."""
    points = np.random.default_rng(7).uniform(-1, 1, (5000, 2))
    first, second = filtration(points), filtration(points[:, ::-1] * [-1.0, 1.0])
    for k in (1, 2):
        rows = [np.lexsort(result.simplices[k].T) for result in (first, second)]
        assert np.array_equal(first.simplices[k][rows[0]], second.simplices[k][rows[1]])
        error = abs(first.radii[k][rows[0]] / second.radii[k][rows[1]] - 1)
        assert error.max() <= 1e-14


def test_a_subset_keeps_the_triangles_whose_circles_it_leaves_empty():
    """What canonical ties are for: far points do not change which diagonal is chosen."""
    points = grid(12)
    part = points[:, 0] < 8
    whole = oracles.row_set(delaunay(points).triangles)
    rows = np.flatnonzero(part)
    alone = {tuple(rows[list(t)]) for t in oracles.row_set(delaunay(points[part]).triangles)}
    inside = {t for t in whole if set(t) <= set(rows.tolist())}
    assert alone == inside
