"""The filtration in space against its definition and gudhi, also on clouds that are flat."""

from __future__ import annotations

import copy
import pickle
from fractions import Fraction
from itertools import combinations, product

import numpy as np
import pytest
from hypothesis import assume, given

import alphamesh as am
from alphamesh._kernels.space import orient3
from alphamesh.errors import (
    CloudShapeError,
    CoordinateRangeError,
    DimensionError,
    NonFiniteError,
    ParameterError,
)
from oracles3 import exact, filtration_squares, sixfold_volume
from strategies3 import clouds3


def grid(*sizes):
    return np.array(list(product(*map(range, sizes))), dtype=float)


@pytest.fixture(name="random", scope="module")
def make_random():
    return am.filtration(np.random.default_rng(5).random((400, 3)))


def cells_of(filtration):
    return [tuple(row) for row in filtration.simplices[filtration.dimension].tolist()]


@given(clouds3())
def test_simplices_and_values_by_definition(points):
    found = am.filtration(points)
    first = {}
    stands = [first.setdefault(tuple(p), row) for row, p in enumerate(exact(points))]
    assert found.representative.tolist() == stands
    assert found.simplices[0][:, 0].tolist() == sorted(set(stands))
    if len(points) == 0:
        assert found.dimension == -1
        return
    distinct = [p if stands[i] == i else points[stands[i]] for i, p in enumerate(points)]
    expected = filtration_squares(np.array(distinct), cells_of(found))
    # Duplicates count once: they lie on the spheres of their representatives.
    for rows, radii in zip(found.simplices, found.radii, strict=True):
        named = [tuple(row) for row in rows.tolist()]
        assert len(set(named)) == len(named)
        assert set(named) == {s for s in expected if len(s) == rows.shape[1]}
        for simplex, radius in zip(named, radii.tolist(), strict=True):
            square = expected[simplex]
            error = abs(Fraction(radius) ** 2 - square)
            assert error <= 4e-13 * square, (simplex, radius)


@given(clouds3())
def test_faces_cofaces_and_intervals_by_definition(points):
    found = am.filtration(points)
    vertices, edges, triangles, tetrahedra = (rows.tolist() for rows in found.simplices)
    for number, row in enumerate(tetrahedra):
        for k in range(4):
            face = found.tetrahedron_triangles[number, k]
            assert triangles[face] == row[:k] + row[k + 1 :]
            assert number in found.triangle_tetrahedra[face]
    for number, row in enumerate(triangles):
        sides = [edges[edge] for edge in found.triangle_edges[number]]
        assert sides == [row[:k] + row[k + 1 :] for k in range(3)]
    cofaces = {}
    for number, row in enumerate(tetrahedra):
        for size in (1, 2, 3):
            for face in combinations(row, size):
                cofaces.setdefault(face, []).append(number)
    counts = found.triangle_tetrahedra >= 0
    assert counts.sum(axis=1).tolist() == [len(cofaces.get(tuple(t), ())) for t in triangles]
    hull = {
        face
        for row in triangles
        if len(cofaces.get(tuple(row), ())) == 1
        for size in (1, 2, 3)
        for face in combinations(row, size)
    }
    values = found.radii[3]
    intervals = (found.vertex_intervals, found.edge_intervals, found.triangle_intervals)
    for rows, radii, interval in zip(
        (vertices, edges, triangles), found.radii[:3], intervals, strict=True
    ):
        around = [values[cofaces.get(tuple(row), [])] for row in rows]
        assert np.array_equal(interval.singular_from, radii)
        least = [part.min(initial=np.inf) for part in around]
        assert interval.regular_from.tolist() == least
        greatest = [
            np.inf if tuple(row) in hull or len(part) == 0 else part.max()
            for row, part in zip(rows, around, strict=True)
        ]
        assert interval.interior_from.tolist() == greatest


@given(clouds3())
def test_when_vertices_and_edges_get_their_first_cofaces(points):
    found = am.filtration(points)
    vertices, edges, triangles, _ = (rows.tolist() for rows in found.simplices)
    for wanted, rows, above, radii in (
        (found.joined_from, vertices, edges, found.radii[1]),
        (found.filled_from, edges, triangles, found.radii[2]),
    ):
        for row, value in zip(rows, wanted.tolist(), strict=True):
            own = [r for s, r in zip(above, radii, strict=True) if set(row) <= set(s)]
            assert value == min(own, default=np.inf)


@given(clouds3())
def test_volumes_areas_and_orientation_are_good_on_slivers(points):
    found = am.filtration(points)
    place = exact(points)
    for row, oriented, volume in zip(
        found.simplices[3].tolist(),
        found.oriented_tetrahedra.tolist(),
        found.tetrahedron_volumes.tolist(),
        strict=True,
    ):
        assert sorted(oriented) == row and oriented[0] == row[0]
        expected = sixfold_volume(*(place[i] for i in oriented))
        assert expected > 0
        assert abs(6 * Fraction(volume) - expected) <= 2e-13 * expected
    for row, area in zip(found.simplices[2].tolist(), found.triangle_areas, strict=True):
        a, b, c = (place[i] for i in row)
        u, v = ([x - y for x, y in zip(p, a, strict=True)] for p in (b, c))
        parts = [u[j] * v[k] - u[k] * v[j] for j, k in ((1, 2), (2, 0), (0, 1))]
        square = sum(part * part for part in parts)
        assert abs(4 * Fraction(float(area)) ** 2 - square) <= 4e-13 * square


def test_volumes_beyond_the_usual_range():
    corners = grid(2, 2, 2)
    for exponent in (-300, 300, 330, 400):
        found = am.filtration(np.ldexp(corners, exponent))
        with np.errstate(over="ignore"):
            whole = np.ldexp(1.0, 3 * exponent)
        assert found.tetrahedron_volumes.sum() == pytest.approx(whole, rel=1e-15)
        largest = np.ldexp(found.triangle_areas.max(), -2 * exponent)
        assert largest == pytest.approx(np.sqrt(0.75), rel=1e-15)


def test_volumes_where_twice_the_digits_of_floats_cancel():
    a, b, c = [0.0, 0.0, 0.0], [1.0, 2.0**-60, 3.0**40], [2.0**-55, 1.0, 7.0]
    d = [1 + 2.0**-52, 1 + 2.0**-52, 3.0**40 + 4096.0]
    corners = np.array([a, b, c, d])
    found = am.filtration(corners)
    (row,), (volume,) = found.simplices[3], found.tetrahedron_volumes
    expected = abs(sixfold_volume(*(exact(corners)[i] for i in row)))
    assert float(volume) == pytest.approx(float(expected / 6), rel=1e-13)


def test_neighbours_and_hull(random):
    delaunay = random.delaunay
    for t, row in enumerate(delaunay.neighbors.tolist()):
        for k, other in enumerate(row):
            face = set(delaunay.tetrahedra[t].tolist()) - {int(delaunay.tetrahedra[t, k])}
            if other >= 0:
                assert face <= set(delaunay.tetrahedra[other].tolist()) and other != t
    hull = delaunay.hull_triangles
    assert len(hull) == np.count_nonzero(delaunay.neighbors < 0)
    # Every point lies behind each triangle of the hull.
    for triangle in hull.tolist():
        corners = np.empty((len(random.points), 4, 3))
        corners[:, :3], corners[:, 3] = random.points[triangle], random.points
        assert (orient3(corners) <= 0).all()
    assert (
        repr(delaunay) == f"<Delaunay3D: 400 points, {len(delaunay.tetrahedra):,} tetrahedra>"
    )


@given(clouds3())
def test_triangulations_without_values_are_the_same(points):
    alone, whole = am.delaunay(points, threads=1), am.filtration(points).delaunay
    for name in ("tetrahedra", "neighbors", "triangles", "edges", "representative"):
        assert np.array_equal(getattr(alone, name), getattr(whole, name))
        assert not getattr(alone, name).flags.writeable
    with pytest.raises(NonFiniteError, match="row 0"):
        am.delaunay(np.full((1, 3), np.nan))


def test_the_volume_is_that_of_the_hull(random):
    spatial = pytest.importorskip("scipy.spatial")
    hull = spatial.ConvexHull(random.points)
    assert random.tetrahedron_volumes.sum() == pytest.approx(hull.volume, rel=1e-12)
    mine = random.delaunay.convex_hull
    assert (mine.volume, mine.area) == pytest.approx((hull.volume, hull.area), rel=1e-12)
    assert mine.vertices.tolist() == sorted(hull.vertices.tolist())
    assert repr(mine) == f"<ConvexHull3D: {len(hull.vertices)} of 400 points>"
    corners = {frozenset(row) for row in random.delaunay.hull_triangles.tolist()}
    assert corners == {frozenset(row) for row in hull.simplices.tolist()}


def torus(n, rng):
    u, v = rng.random((2, n)) * 2 * np.pi
    ring = 2 + 0.7 * np.cos(v)
    return np.column_stack([ring * np.cos(u), ring * np.sin(u), 0.7 * np.sin(v)])


def sphere_on_grid(_, __):
    points = grid(13, 13, 13) - 6
    return points[np.abs((points**2).sum(axis=1) - 30) < 7]


PEERS = {
    "random": lambda n, rng: rng.random((n, 3)),
    "torus": torus,
    "sphere on a grid": sphere_on_grid,
    "integer grid": lambda *_: grid(6, 5, 4),
    "coplanar": lambda n, rng: rng.integers(0, 200, (n // 3, 2)) @ [[3, 1, 2], [-1, 4, 1]],
}


@pytest.mark.parametrize("name", PEERS)
def test_values_are_those_of_gudhi(name):
    gudhi = pytest.importorskip("gudhi")
    points = np.asarray(PEERS[name](600, np.random.default_rng(1)), dtype=float)
    tree = gudhi.AlphaComplex(points=points, precision="exact").create_simplex_tree()
    theirs = {tuple(simplex): value**0.5 for simplex, value in tree.get_filtration()}
    found = am.filtration(points)
    for rows, radii in zip(found.simplices, found.radii, strict=True):
        named = [tuple(row) for row in rows.tolist()]
        values = [theirs.get(simplex, -1.0) for simplex in named]
        if min(values, default=0) < 0 or "grid" in name:
            # Ties broken otherwise change neither the values there are nor the complex of
            # any radius, up to simplices that come and go together.
            assert name not in {"random", "torus"}
            own = {round(value, 9) for value in radii.tolist()}
            other = {round(v, 9) for s, v in theirs.items() if len(s) == rows.shape[1]}
            assert own == other
        else:
            assert len(named) == sum(len(s) == rows.shape[1] for s in theirs)
            np.testing.assert_allclose(radii, values, rtol=1e-9)


def test_a_plane_in_space_is_the_complex_of_the_plane():
    rng = np.random.default_rng(2)
    flat = np.concatenate([rng.random((200, 2)), rng.integers(0, 4, (60, 2)) / 4.0])
    expected = am.filtration(flat)
    for axis in range(3):
        found = am.filtration(np.insert(flat, axis, 0.5, axis=1))
        assert found.dimension == 2 and found.simplices[3].shape == (0, 4)
        assert np.array_equal(found.representative, expected.representative)
        assert (found.triangle_tetrahedra == -1).all()
        for k in range(3):
            mine = dict(zip(map(tuple, found.simplices[k]), found.radii[k], strict=True))
            theirs = dict(
                zip(map(tuple, expected.simplices[k]), expected.radii[k], strict=True)
            )
            assert mine.keys() == theirs.keys()
            np.testing.assert_allclose(
                list(mine.values()), [theirs[key] for key in mine], rtol=1e-14
            )
        assert found.delaunay.tetrahedra.shape == found.delaunay.neighbors.shape == (0, 4)
        assert np.isinf(found.triangle_intervals.regular_from).all()
        assert np.isinf(found.edge_intervals.interior_from).all()


@pytest.mark.parametrize(
    ("points", "dimension", "counts"),
    [
        (np.empty((0, 3)), -1, [0, 0, 0, 0]),
        (np.ones((4, 3)), 0, [1, 0, 0, 0]),
        (np.outer([3, 1, 2, 0, 1], [1.0, 2.0, 3.0]), 1, [4, 3, 0, 0]),
        (grid(2, 2, 1), 2, [4, 5, 2, 0]),
        (grid(2, 2, 2)[[0, 1, 2, 4]], 3, [4, 6, 4, 1]),
    ],
)
def test_clouds_of_every_dimension(points, dimension, counts):
    found = am.filtration(points)
    assert found.dimension == dimension
    assert [len(rows) for rows in found.simplices] == counts
    for name in ("tetrahedron_triangles", "triangle_edges", "oriented_tetrahedra"):
        array = getattr(found, name)
        assert array.dtype == np.int32 and not array.flags.writeable
        assert array.shape == (counts[2 if name == "triangle_edges" else 3], array.shape[1])
    assert len(found.vertex_intervals.regular_from) == counts[0]


def test_arrays_are_read_only_and_pickle():
    found = am.filtration(grid(3, 2, 2))
    assert copy.deepcopy(found) is found
    again = pickle.loads(pickle.dumps(found))
    for array in (*again.simplices, *again.radii, again.points, again.triangle_tetrahedra):
        assert not array.flags.writeable
    assert np.array_equal(again.simplices[3], found.simplices[3])
    with pytest.raises(ValueError, match="read-only"):
        found.triangle_edges[0, 0] = 1
    assert repr(found) == "<Filtration3D: 12 vertices, 33 edges, 34 triangles, 12 tetrahedra>"


def test_complexes_know_their_dimension():
    cx = am.AlphaComplex(grid(3, 2, 2))
    assert type(cx) is am.AlphaComplex3D and isinstance(cx, am.AlphaComplex)
    assert type(am.AlphaComplex(grid(3, 2, 2)[:, :2])) is am.AlphaComplex
    assert repr(cx) == "<AlphaComplex3D: 12 vertices, 33 edges, 34 triangles, 12 tetrahedra>"
    again = pickle.loads(pickle.dumps(cx))
    assert type(again) is am.AlphaComplex3D and copy.copy(cx) is cx
    assert np.array_equal(again.at(0.9).tetrahedra, cx.at(0.9).tetrahedra)
    with pytest.raises(CloudShapeError, match="in space alone"):
        am.AlphaComplex3D(np.zeros((4, 2)))
    for wrong in ({"threads": 0}, {"progress": "bar"}):
        with pytest.raises(ParameterError, match=next(iter(wrong))):
            am.AlphaComplex(grid(2, 2, 2), **wrong)


def test_progress_is_told_of_large_clouds():
    seen = []
    points = np.random.default_rng(0).random((50_000, 3))
    found = am.filtration(points, threads=2, progress=seen.append)
    assert seen == sorted(seen) and seen[-1] == 1.0
    assert found.tetrahedron_volumes.sum() == pytest.approx(
        found.delaunay.convex_hull.volume, rel=1e-12
    )


@given(clouds3())
def test_the_ball_of_simplices_has_euler_number_one(points):
    found = am.filtration(points)
    assume(len(points))
    counts = [len(rows) for rows in found.simplices]
    assert counts[0] - counts[1] + counts[2] - counts[3] == 1


def test_refuses_what_has_no_exact_filtration():
    points = grid(2, 2, 2)
    points[3, 1] = np.nan
    with pytest.raises(NonFiniteError, match="row 3 of 8"):
        am.filtration(points)
    with pytest.raises(CoordinateRangeError, match="too far apart"):
        am.filtration([[0, 0, 2.0**400], [0, 0, 0], [2.0**-400, 0, 0], [0, 1, 0]])
    # Exact sums in space hold 325 binary digits, in the plane 490.
    with pytest.raises(CoordinateRangeError, match="too small in row 2 of 4") as caught:
        am.filtration([[0, 0, 1], [0, 0, 0], [2.0**-326, 0, 0], [0, 1, 0]])
    assert caught.value.rows == (2,)
    assert am.filtration([[0, 0, 1], [0, 0, 0], [2.0**-320, 0, 0], [0, 1, 0]]).dimension == 3
    with pytest.raises(CloudShapeError, match="or three, x, y and z"):
        am.filtration(np.ones((4, 4)))
    large = 2.0**1000
    far = [[0, 0, 0], [large, 0, 0], [large / 2, 2.0**690, 0], [large / 2, 0, 2.0**690]]
    with pytest.raises(CoordinateRangeError, match=r"sphere through rows 0, 1, 2, 3 is too l"):
        am.filtration(far)
    with pytest.raises(CoordinateRangeError, match=r"circle through rows 0, 1, 2 is too l"):
        am.filtration(far[:3])


def test_what_there_is_in_the_plane_alone_says_so():
    cx = am.AlphaComplex(grid(2, 2, 2))
    with pytest.raises(DimensionError, match="in the plane"):
        _ = cx.voronoi
    with pytest.raises(DimensionError, match="in the plane alone; project"):
        cx.restricted_voronoi(1.0)
    with pytest.raises(DimensionError, match="'all-points', 'enclosed', 'one-region'"):
        cx.choose_radius("triangle-count", triangles=3)
    with pytest.raises(DimensionError, match="in space alone"):
        am.AlphaComplex(grid(2, 2, 1)[:, :2]).choose_radius("tetrahedron-count", tetrahedra=3)
