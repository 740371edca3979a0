"""AlphaComplex, Filtration and Delaunay as users hold them."""

from __future__ import annotations

import copy
import pickle
from dataclasses import FrozenInstanceError, fields
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given

import alphamesh as am
import oracles
from alphamesh import _kernels
from alphamesh.errors import CloudTooLargeError, ParameterError
from complexes import complexes

SQUARE = [[0, 0], [2, 0], [0, 2], [2, 2], [9, 1]]
RNG = np.random.default_rng(20240501)
UNIFORM = RNG.random((500, 2))

DEGENERATE = {
    "none": (np.empty((0, 2)), -1, (0, 0, 0)),
    "one": ([[3, 4]], 0, (1, 0, 0)),
    "equal": ([[3, 4]] * 5, 0, (1, 0, 0)),
    "two": ([[3, 4], [5, 6]], 1, (2, 1, 0)),
    "on a line": ([[0, 0], [3, 3], [1, 1], [3, 3]], 1, (3, 2, 0)),
    "triangle": ([[0, 0], [1, 0], [0, 1]], 2, (3, 3, 1)),
    "square": (SQUARE, 2, (5, 7, 3)),
}


def arrays_of(result):
    """Return the arrays of a record by name, tuples taken apart."""
    found = {}
    for field in fields(result):
        value = getattr(result, field.name)
        if field.name == "crs" or value is None:  # what came with the points, or did not
            continue
        parts = value if isinstance(value, tuple) else (value,)
        found |= {f"{field.name}[{k}]": part for k, part in enumerate(parts)}
    return found


def assert_same(first, second):
    mine, other = arrays_of(first), arrays_of(second)
    assert mine.keys() == other.keys()
    for name in mine:
        assert mine[name].dtype == other[name].dtype, name
        np.testing.assert_array_equal(mine[name], other[name], err_msg=name)


@pytest.mark.parametrize("name", DEGENERATE)
def test_every_cloud_has_a_complex(name):
    points, dimension, sizes = DEGENERATE[name]
    cx = am.AlphaComplex(points)
    assert cx.dimension == dimension
    assert tuple(map(len, cx.simplices)) == tuple(map(len, cx.radii)) == sizes
    for k, (simplices, radii) in enumerate(zip(cx.simplices, cx.radii, strict=True)):
        assert simplices.shape == (sizes[k], k + 1) and simplices.dtype == np.int32
        assert radii.dtype == np.float64
    assert cx.filtration.edge_triangles.shape == (sizes[1], 2)
    assert cx.representative.shape == (len(points),)
    assert cx.representative.dtype == np.int32
    assert cx.delaunay.triangles.shape == cx.delaunay.neighbors.shape == (sizes[2], 3)
    assert len(cx.delaunay.edges) == sizes[1]


@given(complexes())
def test_simplices_are_those_of_the_definition(cx):
    points = cx.points
    assert cx.representative.tolist() == oracles.representatives(points)
    vertices, edges, triangles = ([tuple(row) for row in s.tolist()] for s in cx.simplices)
    assert vertices == [(row,) for row in sorted(set(oracles.representatives(points)))]
    expected = oracles.delaunay_triangles(points)
    assert len(triangles) == len(set(triangles)) and set(triangles) == expected
    assert len(edges) == len(set(edges))
    assert set(edges) == oracles.delaunay_edges(points, expected)
    for k in range(3):
        assert (np.diff(cx.simplices[k], axis=1) > 0).all()


@given(complexes())
def test_values_never_decrease_from_face_to_coface(cx):
    _, edges, triangles = cx.radii
    assert (cx.radii[0] == 0).all()
    assert (edges >= 0).all() and (triangles >= 0).all()
    cofaces = cx.filtration.edge_triangles
    for side in range(2):
        has = cofaces[:, side] >= 0
        assert (edges[has] <= triangles[cofaces[has, side]]).all()
    corners = cx.simplices[2]
    seen = np.zeros(len(corners), dtype=int)
    for edge, (first, second) in zip(cx.simplices[1], cofaces, strict=True):
        for triangle in {int(first), int(second)} - {-1}:
            assert set(edge) <= set(corners[triangle])
            seen[triangle] += 1
    assert (seen == 3).all()


@given(complexes())
def test_the_triangulation_of_a_complex_is_that_of_its_points(cx):
    direct = am.delaunay(cx.points)
    assert_same(cx.delaunay, direct)
    np.testing.assert_array_equal(cx.delaunay.edges, direct.edges)
    assert cx.delaunay is cx.delaunay
    edges = {tuple(edge) for edge in direct.edges.tolist()}
    assert edges == {tuple(edge) for edge in cx.simplices[1].tolist()}
    assert len(edges) == len(direct.edges)


def test_neighbors_lie_opposite():
    mesh = am.delaunay(UNIFORM)
    for t, (row, across) in enumerate(zip(mesh.triangles, mesh.neighbors, strict=True)):
        for j in range(3):
            if across[j] >= 0:
                shared = set(mesh.triangles[across[j]]) & set(row)
                assert shared == set(np.delete(row, j))
                assert t in mesh.neighbors[across[j]]
    # Euler: a triangulation of n points with h on the hull has 2n - 2 - h triangles.
    hull = np.count_nonzero(mesh.neighbors < 0)
    assert len(mesh.triangles) == 2 * len(UNIFORM) - 2 - hull


def test_duplicates_stand_for_the_lowest_row():
    points = np.vstack([UNIFORM, UNIFORM[::-1], [[-0.0, 5], [0.0, 5]]])
    cx = am.AlphaComplex(points)
    rows = np.arange(500)
    expected = np.concatenate([rows, rows[::-1], [1000, 1000]])
    np.testing.assert_array_equal(cx.representative, expected)
    np.testing.assert_array_equal(cx.simplices[0][:, 0], np.append(rows, 1000))
    assert cx.simplices[2].max() == 1000


@given(complexes())
def test_critical_radii_are_where_the_complex_changes(cx):
    critical = cx.critical_radii()
    everything = {0.0} if len(cx.points) else set()
    everything |= set(cx.radii[1].tolist()) | set(cx.radii[2].tolist())
    assert critical.tolist() == sorted(everything)
    sizes = [sum((radii <= r).sum() for radii in cx.radii) for r in critical]
    assert all(low < high for low, high in pairwise(sizes))
    shapes = [cx.at(r) for r in critical[:20]]
    for lower, upper in pairwise(shapes):
        between = (lower.radius + upper.radius) / 2
        if lower.radius < between < upper.radius:
            np.testing.assert_array_equal(cx.at(between).edges, lower.edges)
            np.testing.assert_array_equal(cx.at(between).triangles, lower.triangles)


@pytest.mark.parametrize("threads", [1, 2, 3, 7, 10**9, np.int64(2)])
def test_threads_do_not_change_the_result(threads):
    assert_same(am.filtration(UNIFORM, threads=threads), am.filtration(UNIFORM, threads=None))
    assert_same(am.delaunay(UNIFORM, threads=threads), am.delaunay(UNIFORM))


@pytest.mark.parametrize("threads", [0, -1, 1.5, "2", True])
@pytest.mark.parametrize("build", [am.AlphaComplex, am.filtration, am.delaunay])
def test_refuses_wrong_threads(build, threads):
    with pytest.raises(ParameterError, match="threads must be a whole number of at least 1"):
        build(SQUARE, threads=threads)


@pytest.mark.parametrize("build", [am.AlphaComplex, am.filtration, am.delaunay])
def test_refuses_wrong_progress(build):
    with pytest.raises(ParameterError, match="progress must be None or a function"):
        build(SQUARE, progress=3)


def test_reports_progress_as_a_fraction():
    seen = []
    am.AlphaComplex(RNG.random((400_000, 2)), threads=1, progress=seen.append)
    assert seen, "nothing reported in a job of some tenths of a second"
    assert all(0 <= fraction <= 1 for fraction in seen)
    assert seen == sorted(seen)


def test_an_error_in_progress_stops_the_work():
    def stop(fraction):
        raise KeyError("enough")

    with pytest.raises(KeyError, match="enough"):
        am.AlphaComplex(RNG.random((400_000, 2)), threads=2, progress=stop)


@pytest.mark.parametrize("kernel", [_kernels.alpha2, _kernels.delaunay2])
def test_refuses_more_points_than_triangle_numbers(kernel):
    try:
        points = np.zeros((2**27 + 1, 2))
    except MemoryError:
        pytest.skip("no address space for such a cloud")
    with pytest.raises(CloudTooLargeError, match=r"134,217,729 points.*thin"):
        kernel(points)


def test_the_users_array_is_neither_changed_nor_followed():
    points = UNIFORM.copy()
    cx = am.AlphaComplex(points)
    np.testing.assert_array_equal(points, UNIFORM)
    points[:] = 0
    np.testing.assert_array_equal(cx.points, UNIFORM)


@pytest.mark.parametrize("name", DEGENERATE)
def test_everything_is_read_only(name):
    cx = am.AlphaComplex(DEGENERATE[name][0])
    held = arrays_of(cx.filtration) | arrays_of(cx.delaunay)
    for record in (cx.filtration.vertex_intervals, cx.filtration.edge_intervals):
        held |= {str(id(record)) + name: array for name, array in arrays_of(record).items()}
    held |= {"edges": cx.delaunay.edges, "critical": cx.critical_radii()}
    held |= {"oriented": cx.filtration.oriented_triangles, "joined": cx.filtration.joined_from}
    for label, array in held.items():
        assert not array.flags.writeable, label
    with pytest.raises(AttributeError):
        cx.points = np.zeros((3, 2))
    with pytest.raises(AttributeError):
        cx.extra = 1
    for record in (cx.filtration, cx.delaunay):
        with pytest.raises(FrozenInstanceError):
            record.points = np.zeros((3, 2))


@pytest.mark.parametrize("name", DEGENERATE)
def test_survives_copies_and_pickles(name):
    cx = am.AlphaComplex(DEGENERATE[name][0])
    assert copy.copy(cx) is cx and copy.deepcopy(cx) is cx
    for protocol in range(2, pickle.HIGHEST_PROTOCOL + 1):
        thawed = pickle.loads(pickle.dumps(cx, protocol))
        assert type(thawed) is am.AlphaComplex
        assert_same(thawed.filtration, cx.filtration)
        assert_same(thawed.delaunay, cx.delaunay)
        for label, array in arrays_of(thawed.filtration).items():
            assert not array.flags.writeable, label


def test_tells_the_facts():
    cx = am.AlphaComplex(SQUARE)
    assert repr(cx) == "<AlphaComplex: 5 vertices, 7 edges, 3 triangles>"
    assert repr(cx.filtration) == "<Filtration: 5 vertices, 7 edges, 3 triangles>"
    assert repr(cx.delaunay) == "<Delaunay: 5 points, 3 triangles>"
    assert repr(am.delaunay([[0, 0], [1, 1]])) == (
        "<Delaunay: 2 points, 0 triangles, on one line>"
    )


def test_results_outlive_the_complex():
    radii = am.AlphaComplex(UNIFORM).radii
    before = [array.copy() for array in radii]
    am.AlphaComplex(UNIFORM * 2)
    for kept, copied in zip(radii, before, strict=True):
        np.testing.assert_array_equal(kept, copied)
