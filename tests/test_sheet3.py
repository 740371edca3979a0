"""Clouds in space that lie in a plane, on a line or in a point: exact, whatever the tilt."""

from __future__ import annotations

from fractions import Fraction
from itertools import combinations, pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from alphamesh._kernels import _core
from oracles import relative_error
from space_core import alpha3, row_set

BOUND = 1e-14


def minus(p, q):
    return [x - y for x, y in zip(p, q, strict=True)]


def dot(u, v):
    return sum(x * y for x, y in zip(u, v, strict=True))


def cross(u, v):
    return [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]


def same_side(axis, p, q):
    """Tell whether p and q, in one plane with the axis, lie on the same side of it."""
    direction = minus(axis[1], axis[0])
    return dot(cross(direction, minus(p, axis[0])), cross(direction, minus(q, axis[0]))) > 0


def circumcentre(a, b, c):
    """Return the centre in the plane of the three, and the squared radius."""
    u, v = minus(b, a), minus(c, a)
    n = cross(u, v)
    scale = Fraction(1, 2 * dot(n, n))
    into = [
        dot(u, u) * x - dot(v, v) * y for x, y in zip(cross(v, n), cross(u, n), strict=True)
    ]
    centre = [x + scale * y for x, y in zip(a, into, strict=True)]
    return centre, dot(minus(centre, a), minus(centre, a))


def inside(corners, centre, square, d):
    """Tell whether d is in the circle; of cocircular points the largest is lifted."""
    distance = dot(minus(d, centre), minus(d, centre))
    if distance != square:
        return distance < square
    top = max(*corners, d)
    return top != d and same_side([p for p in corners if p != top], top, d)


def slow_filtration(points):
    """Return every simplex with its squared value by trying all triples of distinct points."""
    cloud = [tuple(Fraction(x) for x in p) for p in points.tolist()]
    triangles = {}
    for rows in combinations(range(len(cloud)), 3):
        corners = [cloud[i] for i in rows]
        if not any(cross(minus(corners[1], corners[0]), minus(corners[2], corners[0]))):
            continue
        centre, square = circumcentre(*corners)
        others = (p for i, p in enumerate(cloud) if i not in rows)
        if not any(inside(corners, centre, square, p) for p in others):
            triangles[rows] = square
    edges = {}
    path = pairwise(sorted(range(len(cloud)), key=cloud.__getitem__))
    faces = {edge for rows in triangles for edge in combinations(rows, 2)}
    for i, j in faces if triangles else {(min(e), max(e)) for e in path}:
        a, b = cloud[i], cloud[j]
        apexes = [cloud[k] for k in range(len(cloud)) if k not in (i, j)]
        if any(dot(minus(a, p), minus(b, p)) < 0 for p in apexes):
            edges[i, j] = min(v for t, v in triangles.items() if {i, j} <= {*t})
        else:
            edges[i, j] = dot(minus(a, b), minus(a, b)) / 4
    return triangles, edges


def check_against_definition(points):
    result = alpha3(points)
    triangles, edges = slow_filtration(np.asarray(points, dtype=float))
    assert result["dimension"] == (2 if triangles else min(1, len(points) - 1))
    for name, radii, expected in (
        ("triangles", "triangle_radii", triangles),
        ("edges", "edge_radii", edges),
    ):
        assert row_set(result[name]) == set(expected)
        for row, value in zip(result[name].tolist(), result[radii], strict=True):
            assert relative_error(value, expected[tuple(row)]) < BOUND
    assert result["tetrahedra"].shape == (0, 4)
    assert result["tetrahedron_radii"].shape == (0,)
    assert result["triangle_tetrahedra"].tolist() == [[-1, -1]] * len(triangles)


coordinate = st.integers(-4, 4)
vector = st.tuples(coordinate, coordinate, coordinate)


@settings(deadline=None, max_examples=150)
@given(
    basis=st.tuples(vector, vector, vector),
    steps=st.lists(st.tuples(coordinate, coordinate), min_size=1, max_size=12, unique=True),
    scale=st.sampled_from([1.0, 0.25, 2.0**-200, 2.0**200, 3.0]),
)
def test_tilted_lattices(basis, steps, scale):
    """Any plane and any line through integer points, with ties of every kind."""
    points = np.array(steps) @ np.array(basis[:2]) + np.array(basis[2])
    check_against_definition(np.unique(points, axis=0)[::-1] * scale)


@pytest.mark.parametrize("height", [0.0, 1e-3, -7.0])
@pytest.mark.parametrize("axis", [0, 1, 2])
def test_a_plane_along_two_axes_is_the_plane(axis, height):
    rng = np.random.default_rng(5)
    flat = np.concatenate(
        [
            rng.random((400, 2)),
            np.indices((12, 12)).reshape(2, -1).T / 8,
            np.column_stack([rng.random(50), 1e-9 * rng.random(50)]),  # slivers
        ]
    )
    _, triangles, triangle_radii, edges, edge_radii, _ = _core.alpha2(flat, 1, None)
    result = alpha3(np.insert(flat, axis, height, axis=1))
    assert result["dimension"] == 2
    assert np.array_equal(result["triangles"], triangles)
    assert np.array_equal(result["triangle_radii"], triangle_radii)
    assert np.array_equal(result["edges"], edges)
    assert np.array_equal(result["edge_radii"], edge_radii)


def tilted(steps, u, v):
    return np.asarray(steps, dtype=float) @ np.array([u, v], dtype=float)


SHEETS = {
    "steep": lambda rng: tilted(rng.integers(-900, 900, (150, 2)), [1, 2, 300], [2, 1, -400]),
    "upright": lambda rng: tilted(rng.integers(-900, 900, (150, 2)), [0, 0, 1], [3, 1, 0]),
    "falling": lambda rng: tilted(rng.integers(0, 9, (60, 2)), [1, 1, 0], [0, -1, 1]),
    "sheared grid": lambda _: tilted(
        np.indices((9, 9)).reshape(2, -1).T, [2, -1, 1], [1, 3, 1]
    ),
    "square grid": lambda _: tilted(np.indices((9, 9)).reshape(2, -1).T, [1, 2, 2], [2, 1, -2]),
}


@pytest.mark.parametrize("name", SHEETS)
def test_values_are_those_of_gudhi(name):
    gudhi = pytest.importorskip("gudhi")
    points = np.unique(SHEETS[name](np.random.default_rng(2)), axis=0)
    tree = gudhi.AlphaComplex(points=points, precision="exact").create_simplex_tree()
    theirs = {tuple(simplex): value**0.5 for simplex, value in tree.get_filtration()}
    result = alpha3(points)
    for rows, radii in (("triangles", "triangle_radii"), ("edges", "edge_radii")):
        size = result[rows].shape[1]
        if row_set(result[rows]) == {s for s in theirs if len(s) == size}:
            values = [theirs[tuple(row)] for row in result[rows].tolist()]
            np.testing.assert_allclose(result[radii], values, rtol=1e-9)
        else:  # ties broken otherwise: the values that count are the same all the same
            values = {round(v, 9) for s, v in theirs.items() if len(s) == size}
            assert {round(v, 9) for v in result[radii].tolist()} == values


@pytest.mark.parametrize("name", SHEETS)
def test_neither_order_nor_threads_matter(name):
    points = np.unique(SHEETS[name](np.random.default_rng(2)), axis=0)
    rng = np.random.default_rng(3)
    expected = alpha3(points)
    for threads in (1, 3):
        shuffle = rng.permutation(len(points))
        result = alpha3(points[shuffle], threads)
        for rows in ("triangles", "edges"):
            assert np.array_equal(np.sort(shuffle[result[rows]], axis=1), expected[rows])
        for radii in ("triangle_radii", "edge_radii"):
            assert np.array_equal(result[radii], expected[radii])


def test_a_large_sheet_in_threads():
    steps = np.random.default_rng(4).integers(-(2**20), 2**20, (30_000, 2))
    points = tilted(np.unique(steps, axis=0), [3, 1, -2], [1, -4, 2])
    one, two = alpha3(points, 1), alpha3(points, 2)
    assert one["dimension"] == 2
    assert len(points) - len(one["edges"]) + len(one["triangles"]) == 1
    for name in ("triangles", "triangle_radii", "edges", "edge_radii"):
        assert np.array_equal(one[name], two[name])


def test_duplicates_on_a_sheet_and_a_line():
    points = np.array([[0, 0, 1], [2, 0, 3], [0, 0, 1], [2, 2, 3], [2, 0, 3.0]])
    result = alpha3(points)
    assert result["representative"].tolist() == [0, 1, 0, 3, 1]
    assert result["triangles"].tolist() == [[0, 1, 3]]
    line = alpha3(points[:3])
    assert line["edges"].tolist() == [[0, 1]]
    assert line["edge_radii"].tolist() == [np.sqrt(2.0)]
