"""The compiled core in space: triangulation and values, before any Python stands on them."""

from __future__ import annotations

from fractions import Fraction
from itertools import product

import numpy as np
import pytest

from alphamesh._kernels import _core
from space_core import NAMES, alpha3, row_set


def grid(size, scale=1.0):
    return np.array(list(product(range(size), repeat=3)), dtype=float) * scale


CLOUDS = {
    "random": lambda rng: rng.random((300, 3)),
    "sphere": lambda rng: (v := rng.normal(size=(200, 3))) / np.linalg.norm(v, axis=1)[:, None],
    "grid": lambda _: grid(5),
    "tenths": lambda _: grid(5, 0.1),
    "few integers": lambda rng: np.unique(rng.integers(0, 6, (150, 3)), axis=0),
    "far from the origin": lambda rng: rng.random((200, 3)) + 1e8,
    "huge": lambda rng: rng.random((150, 3)) * 2.0**300,
    "tiny": lambda rng: rng.random((150, 3)) * 2.0**-300,
    "flat": lambda rng: rng.random((200, 3)) * [1, 1, 1e-9],
    "scales": lambda rng: np.concatenate([rng.random((60, 3)) * 10.0**-k for k in (0, 3, 6)]),
}


@pytest.fixture(params=CLOUDS, name="cloud")
def make_cloud(request):
    return np.asarray(CLOUDS[request.param](np.random.default_rng(7)), dtype=float)


def corners(points, rows):
    return np.ascontiguousarray(points[rows])


def signed(points, tetrahedra):
    """Return the tetrahedra with a positive orientation."""
    rows = tetrahedra.copy()
    negative = _core.orient3(corners(points, rows)) < 0
    rows[negative, :2] = rows[negative, 1::-1]
    return rows


def test_tetrahedra_are_delaunay_and_fill_the_hull(cloud):
    result = alpha3(cloud)
    positive = signed(cloud, result["tetrahedra"])
    assert (_core.orient3(corners(cloud, positive)) > 0).all()
    # A triangle has one or two tetrahedra; across an inner one, the far vertex is outside,
    # ties broken.
    inner = result["triangle_tetrahedra"][:, 1] >= 0
    first, second = result["triangle_tetrahedra"][inner].T
    facets = result["triangles"][inner]
    far = positive[second].sum(axis=1) - facets.sum(axis=1)
    five = np.concatenate([positive[first], far[:, None]], axis=1)
    assert (_core.insphere3(corners(cloud, five), True) == -1).all()
    # The hull is a sphere, and everything inside a ball.
    hull = result["triangles"][~inner]
    edges, times = np.unique(
        np.sort(hull[:, [[0, 1], [0, 2], [1, 2]]].reshape(-1, 2)), axis=0, return_counts=True
    )
    assert (times == 2).all()
    assert len(np.unique(hull)) - len(edges) + len(hull) == 2
    counts = [len(cloud), *(len(result[name]) for name in ("edges", "triangles", "tetrahedra"))]
    assert counts[0] - counts[1] + counts[2] - counts[3] == 1
    if np.abs(cloud).max() < 1e3:
        exact = [[Fraction(v) for v in point] for point in cloud.tolist()]
        assert sum(volume(exact, row) for row in positive) == hull_volume(exact, positive, hull)


def volume(points, row):
    a, b, c, d = (points[i] for i in row)
    u, v, w = ([x - y for x, y in zip(p, a, strict=True)] for p in (b, c, d))
    return (
        (u[1] * v[2] - u[2] * v[1]) * w[0]
        + (u[2] * v[0] - u[0] * v[2]) * w[1]
        + (u[0] * v[1] - u[1] * v[0]) * w[2]
    )


def hull_volume(points, tetrahedra, hull):
    """Return the volume within the hull by cones from the first point."""
    outside = {}
    for row in tetrahedra.tolist():
        for k in range(4):
            outside[tuple(sorted(row[:k] + row[k + 1 :]))] = row[k]
    total = Fraction(0)
    for facet in np.sort(hull, axis=1).tolist():
        apex = outside[tuple(facet)]
        sign = 1 if volume(points, [*facet, apex]) > 0 else -1
        total += sign * volume(points, [*facet, 0])
    return total


def test_simplices_and_values_are_those_of_gudhi(cloud):
    gudhi = pytest.importorskip("gudhi")
    scale = np.abs(cloud).max()
    tree = gudhi.AlphaComplex(points=cloud / scale, precision="exact").create_simplex_tree()
    theirs = {tuple(simplex): value**0.5 for simplex, value in tree.get_filtration()}
    result = alpha3(cloud / scale)
    for name, radii in (
        ("tetrahedra", "tetrahedron_radii"),
        ("triangles", "triangle_radii"),
        ("edges", "edge_radii"),
    ):
        size = result[name].shape[1]
        values = [value for simplex, value in theirs.items() if len(simplex) == size]
        if row_set(result[name]) == {s for s in theirs if len(s) == size}:
            values = [theirs[tuple(row)] for row in result[name].tolist()]
            np.testing.assert_allclose(result[radii], values, rtol=1e-9)
        else:  # ties broken otherwise: the values that count are the same all the same
            kept = {round(v, 9) for v in values} ^ {round(v, 9) for v in result[radii].tolist()}
            assert not kept


def test_values_never_decrease(cloud):
    result = alpha3(cloud)
    triangles = {
        tuple(row): v
        for row, v in zip(result["triangles"].tolist(), result["triangle_radii"], strict=True)
    }
    edges = {
        tuple(row): v
        for row, v in zip(result["edges"].tolist(), result["edge_radii"], strict=True)
    }
    for row, value in zip(
        result["tetrahedra"].tolist(), result["tetrahedron_radii"], strict=True
    ):
        for k in range(4):
            assert triangles[tuple(row[:k] + row[k + 1 :])] <= value
    for row, value in triangles.items():
        for k in range(3):
            assert edges[row[:k] + row[k + 1 :]] <= value


@pytest.mark.parametrize("size", [8, 25])
def test_neither_order_nor_threads_matter(size):
    points = grid(size)
    rng = np.random.default_rng(3)
    expected = None
    for threads in (1, 2, 4):
        shuffle = rng.permutation(len(points))
        result = alpha3(points[shuffle], threads)
        arrays = [
            np.sort(shuffle[result[name]], axis=1)
            for name in ("tetrahedra", "triangles", "edges")
        ]
        arrays += [result[f"{name}_radii"] for name in ("tetrahedron", "triangle", "edge")]
        if expected is None:
            expected = arrays
        for mine, first in zip(arrays, expected, strict=True):
            assert np.array_equal(mine, first)


def test_threads_agree_on_a_large_cloud():
    points = np.random.default_rng(5).random((60_000, 3))
    one, three = alpha3(points, 1), alpha3(points, 3)
    for name in NAMES[2:]:
        assert np.array_equal(one[name], three[name])


@pytest.mark.parametrize("threads", [1, 2])
def test_more_tetrahedra_than_room_was_made_for(threads):
    """Two skew lines: each step along one is joined to each step along the other."""
    steps, zero = np.arange(400.0), np.zeros(400)
    first = np.column_stack([steps, zero, zero])
    points = np.concatenate([first, np.column_stack([zero, steps, zero + 1])])
    result = alpha3(points, threads)
    assert len(result["tetrahedra"]) == 399**2
    counts = [len(points), *(len(result[name]) for name in ("edges", "triangles"))]
    assert counts[0] - counts[1] + counts[2] - 399**2 == 1
    positive = signed(points, result["tetrahedra"])
    assert (_core.orient3(corners(points, positive)) > 0).all()


def test_bare_triangulation(cloud):
    dimension, representative, tetrahedra, neighbors = _core.delaunay3(cloud, 1, None)
    assert (dimension, representative) == (3, None)
    result = alpha3(cloud)
    assert np.array_equal(tetrahedra, result["tetrahedra"])
    facets = {}
    for row, pair in zip(result["triangles"], result["triangle_tetrahedra"], strict=True):
        facets[tuple(row.tolist())] = set(pair.tolist())
    for t, (row, across) in enumerate(
        zip(tetrahedra.tolist(), neighbors.tolist(), strict=True)
    ):
        for k in range(4):
            assert facets[tuple(row[:k] + row[k + 1 :])] == {t, across[k]}


def test_bare_triangulation_of_a_flat_cloud():
    dimension, representative, tetrahedra, neighbors = _core.delaunay3(grid(3)[:9], 1, None)
    assert (dimension, representative) == (2, None)
    assert tetrahedra.shape == neighbors.shape == (0, 4)


def test_duplicates_are_merged():
    points = np.concatenate([grid(3), grid(3)[::-1]])
    result = alpha3(points)
    assert result["representative"].tolist() == [*range(27), *range(26, -1, -1)]
    assert row_set(result["tetrahedra"]) == row_set(alpha3(grid(3))["tetrahedra"])


@pytest.mark.parametrize(
    ("points", "dimension"),
    [
        (np.empty((0, 3)), -1),
        (np.ones((4, 3)), 0),
        (np.outer(np.arange(5), [1.0, 2.0, 3.0]), 1),
        (grid(4)[:16] * 1.5, 2),
        (grid(2), 3),
    ],
)
def test_dimension_of_the_cloud(points, dimension):
    result = alpha3(points)
    assert result["dimension"] == dimension
    assert (len(result["tetrahedra"]) > 0) == (dimension == 3)


def test_predicates_on_exact_ties():
    rng = np.random.default_rng(11)
    base = rng.integers(-50, 50, (2000, 4, 3)).astype(float)
    base[:1000, 3] = base[:1000, 0] + base[:1000, 1] - base[:1000, 2]  # coplanar
    base[500:, 3, 2] += 2.0**-40
    exact = [
        int(np.sign(volume([[Fraction(v) for v in p] for p in row], range(4))))
        for row in base.tolist()
    ]
    assert _core.orient3(base).tolist() == exact


def test_bad_coordinates():
    points = grid(2)
    points[3, 1] = np.nan
    with pytest.raises(_core.BadCoordinates):
        alpha3(points)
    with pytest.raises(_core.BadCoordinates):
        alpha3([[0, 0, 2.0**400], [0, 0, 0], [2.0**-400, 0, 0], [0, 1, 0]])
