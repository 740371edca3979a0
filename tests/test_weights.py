"""Weighted clouds through all stages: complexes, shapes, persistence, curves, export."""

from __future__ import annotations

import copy
import pickle

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import alphamesh as am
from alphamesh._weights import signed_root, signed_square
from alphamesh.check import check_delaunay, check_filtration, check_shape
from alphamesh.errors import (
    CoordinateRangeError,
    ParameterError,
    UnweightedOnlyError,
    WeightsError,
)
from reduction import check_pairs

RNG = np.random.default_rng(11)
DIMENSIONS = (2, 3)


def cloud(n, d, scale=0.02, seed=0):
    """Return random points, and weights of both signs that hide some of them."""
    rng = np.random.default_rng(seed)
    return rng.random((n, d)), rng.normal(size=n) * scale


def lattice(n, d, seed=0):
    """Return points of a small lattice, some of them twice, and small whole weights."""
    rng = np.random.default_rng(seed)
    return rng.integers(0, 4, (n, d)).astype(float), rng.integers(-1, 3, n).astype(float)


CLOUDS = {
    "few hidden": lambda d: cloud(200, d, 0.004),
    "many hidden": lambda d: cloud(200, d, 0.1),
    "lattice": lambda d: lattice(60, d),
    "line": lambda d: (np.repeat(np.arange(12.0), d).reshape(12, d), RNG.normal(size=12) * 2),
    "one place": lambda d: (np.ones((4, d)), np.array([1.0, 3.0, 3.0, -2.0])),
    "one": lambda d: (np.ones((1, d)), np.array([2.0])),
    "none": lambda d: (np.empty((0, d)), np.empty(0)),
}


@pytest.fixture(name="cx", params=[(name, d) for name in CLOUDS for d in DIMENSIONS], ids=str)
def make_complex(request):
    name, d = request.param
    points, weights = CLOUDS[name](d)
    return am.AlphaComplex(points, weights=weights)


# ---------------------------------------------------------------- the complex


def test_every_result_is_proved(cx):
    check_filtration(cx.filtration)
    check_delaunay(cx.delaunay)
    check_delaunay(am.delaunay(cx.points, weights=cx.weights))
    radii = cx.critical_radii()
    for radius in (-np.inf, -1.0, 0.0, np.inf, *radii[:: max(1, len(radii) // 6)]):
        check_shape(cx.at(radius))


@given(st.integers(0, 10**6), st.sampled_from(DIMENSIONS), st.integers(0, 14))
def test_small_lattices_are_proved(seed, d, n):
    points, weights = lattice(n, d, seed)
    check_filtration(am.filtration(points, weights=weights))


@pytest.mark.parametrize("d", DIMENSIONS)
@pytest.mark.parametrize("weight", [0.0, 0.01, -0.01, 1e-30, 4.0])
def test_equal_weights_shift_the_values(d, weight):
    points, _ = cloud(100, d)
    plain = am.AlphaComplex(points)
    cx = am.AlphaComplex(points, weights=np.full(100, weight))
    for one, other in zip(cx.simplices, plain.simplices, strict=True):
        assert np.array_equal(one, other)
    for one, other in zip(cx.radii, plain.radii, strict=True):
        if weight == 0:
            assert np.array_equal(one, other)
        shifted = signed_square(one) + weight
        np.testing.assert_allclose(shifted, other**2, rtol=1e-12, atol=1e-13 * abs(weight))
    for one, other in zip(cx.persistence().pairs, plain.persistence().pairs, strict=True):
        assert np.array_equal(one, other)
    assert len(cx.hidden) == 0
    check_filtration(cx.filtration)


@pytest.mark.parametrize("d", DIMENSIONS)
def test_a_common_addition_to_all_weights_shifts_the_values(d):
    points, weights = lattice(50, d)
    one = am.AlphaComplex(points, weights=weights)
    other = am.AlphaComplex(points, weights=weights + 5)
    assert np.array_equal(one.hidden, other.hidden)
    for k in range(d + 1):
        assert np.array_equal(one.simplices[k], other.simplices[k])
        shifted = signed_root(signed_square(one.radii[k]) - 5)
        np.testing.assert_allclose(other.radii[k], shifted, rtol=1e-12, atol=1e-7)


@pytest.mark.parametrize("d", DIMENSIONS)
@pytest.mark.parametrize("exponent", [-40, 3, 60])
def test_powers_of_two_and_translations_of_lattices_change_nothing_else(d, exponent):
    points, weights = lattice(50, d)
    one = am.AlphaComplex(points, weights=weights)
    moved = np.ldexp(points + np.arange(d) * 17 - 5, exponent)
    other = am.AlphaComplex(moved, weights=np.ldexp(weights, 2 * exponent))
    assert np.array_equal(one.hidden, other.hidden)
    for k in range(d + 1):
        assert np.array_equal(one.simplices[k], other.simplices[k])
        np.testing.assert_allclose(
            np.ldexp(one.radii[k], exponent), other.radii[k], rtol=1e-13, atol=0
        )


@pytest.mark.parametrize("d", DIMENSIONS)
def test_the_order_of_rows_and_threads_change_nothing(d):
    points, weights = cloud(400, d)
    order = RNG.permutation(400)
    one = am.AlphaComplex(points, weights=weights, threads=1)
    other = am.AlphaComplex(points[order], weights=weights[order], threads=2)
    assert np.array_equal(np.sort(order[other.hidden]), one.hidden)
    for k in range(d + 1):
        rows = np.sort(order[other.simplices[k]], axis=1)
        assert _values(one.simplices[k], one.radii[k]) == _values(rows, other.radii[k])


def _values(rows, radii):
    return {tuple(row): radius for row, radius in zip(rows.tolist(), radii, strict=True)}


def test_a_point_without_a_part_of_the_power_diagram_is_hidden():
    points = [[0, 0], [4, 0], [0, 4], [0.5, 0.5]]
    # Lifted to |p|**2 - w, the last is at 1.5, and the others span 0.75 at its place.
    cx = am.AlphaComplex(points, weights=[4, 1, 1, -1])
    assert cx.hidden.tolist() == [3]
    assert cx.simplices[0][:, 0].tolist() == [0, 1, 2]
    assert cx.representative.tolist() == [0, 1, 2, 3]
    assert repr(cx) == "<AlphaComplex: 3 vertices, 3 edges, 1 triangles, 1 hidden point>"
    assert cx.at(0).isolated_vertices.tolist() == [0, 1, 2]


def test_the_heaviest_of_equal_points_stands_for_them():
    cx = am.AlphaComplex([[0, 0], [0, 0], [0, 0], [1, 0]], weights=[1, 4, 4, 0])
    assert cx.representative.tolist() == [1, 1, 1, 3]
    assert cx.hidden.tolist() == [0]  # row 2 is a mere duplicate
    assert cx.simplices[0].tolist() == [[1], [3]]
    # The last lies within the ball of the others until 4 + a = 2.5**2, 0 + a = 1.5**2.
    assert cx.radii[0].tolist() == [-2.0, 1.5]
    assert cx.radii[1].tolist() == [1.5]


def test_values_of_two_balls():
    cx = am.AlphaComplex([[0, 0], [3, 0]], weights=[4, 1])
    assert cx.radii[0].tolist() == [-2.0, -1.0]
    # The balls touch where 4 + a = x**2 and 1 + a = (3 - x)**2: at x = 2.
    assert cx.radii[1].tolist() == [0.0]
    assert cx.at(-1.5).isolated_vertices.tolist() == [0]
    assert cx.at(-1).isolated_vertices.tolist() == [0, 1]
    assert cx.at(0).edges.tolist() == [[0, 1]]
    assert cx.critical_radii().tolist() == [-2.0, -1.0, 0.0]


# ---------------------------------------------------------------- against gudhi


@pytest.mark.parametrize("d", DIMENSIONS)
@pytest.mark.parametrize("scale", [0.001, 0.01, 0.1])
def test_values_and_persistence_are_those_of_gudhi(d, scale):
    gudhi = pytest.importorskip("gudhi")
    points, weights = cloud(250, d, scale, seed=5)
    cx = am.AlphaComplex(points, weights=weights)
    tree = gudhi.AlphaComplex(
        points=points, weights=weights, precision="exact"
    ).create_simplex_tree()
    expected = {tuple(sorted(rows)): value for rows, value in tree.get_filtration()}
    exported = cx.to_gudhi(squared=True)
    mine = {tuple(sorted(rows)): value for rows, value in exported.get_filtration()}
    assert mine.keys() == expected.keys()
    for rows, value in expected.items():
        assert mine[rows] == pytest.approx(value, rel=1e-9, abs=1e-9)
    tree.persistence(homology_coeff_field=2, min_persistence=-1)
    for k in range(d):
        theirs = _lasting(tree.persistence_intervals_in_dimension(k).reshape(-1, 2))
        ours = _lasting(cx.persistence().diagram(k, squared=True))
        np.testing.assert_allclose(ours, theirs, rtol=1e-9, atol=1e-9)


def _lasting(diagram):
    rows = diagram[diagram[:, 1] - diagram[:, 0] > 1e-8]
    return rows[np.lexsort((rows[:, 1], rows[:, 0]))]


# ---------------------------------------------------------------- persistence


def test_pairs_are_those_of_matrix_reduction(cx):
    check_pairs(cx.persistence())


@given(st.integers(0, 10**6), st.sampled_from(DIMENSIONS), st.integers(0, 16))
def test_pairs_of_small_lattices_are_those_of_matrix_reduction(seed, d, n):
    points, weights = lattice(n, d, seed)
    check_pairs(am.AlphaComplex(points, weights=weights).persistence())


def test_betti_numbers_and_curves_are_those_of_shapes(cx):
    found, curves = cx.persistence(), cx.measure_curves()
    radii = cx.critical_radii()
    between = np.concatenate((radii - 1e-9, radii))[:: max(1, len(radii) // 10)]
    for radius in (-np.inf, *between, np.inf):
        shape = cx.at(radius)
        assert tuple(found.betti_numbers(radius)) == shape.betti
        assert curves.euler_characteristic(radius) == shape.euler_characteristic
        assert curves.edge_count(radius) == len(shape.edges)
        if cx.points.shape[1] == 2:
            assert curves.area(radius) == pytest.approx(shape.area, abs=1e-12)
            assert curves.perimeter(radius) == pytest.approx(shape.perimeter, abs=1e-9)
        else:
            assert curves.volume(radius) == pytest.approx(shape.volume, abs=1e-12)
            assert curves.surface_area(radius) == pytest.approx(shape.surface_area, abs=1e-9)


def test_curves_start_where_the_first_point_appears(cx):
    betti, euler = cx.persistence().betti_curve(), cx.persistence().euler_curve()
    if len(cx.points) == 0:
        assert betti.radii.tolist() == [0.0]
        return
    first = cx.radii[0].min()
    assert betti.radii[0] == euler.radii[0] == first
    assert betti.values[0, 0] == np.count_nonzero(cx.radii[0] == first)
    for radius, numbers in zip(betti.radii[::7], betti.values[::7], strict=True):
        assert tuple(numbers) == cx.at(radius).betti


def test_classes_alive_at_a_negative_radius():
    cx = am.AlphaComplex([[0, 0], [3, 0], [9, 0]], weights=[4, 1, 9])
    found = cx.persistence()
    assert found.betti_numbers(-1.5).tolist() == [2, 0]
    assert len(found.alive(-1.5, 0)) == 1
    # Of two components that meet, the older stays: born at -3, -2 and -1.
    assert found.diagram(0)[0].tolist() == [-3.0, np.inf]
    assert found.diagram(0)[1:, 0].tolist() == [-2.0, -1.0]
    with pytest.raises(ParameterError, match="dimension"):
        found.alive(-1.5, 5)


@pytest.mark.parametrize("d", DIMENSIONS)
def test_cycles_are_born_with_their_last_simplex(d):
    points, weights = cloud(150, d, 0.004)
    cx = am.AlphaComplex(points, weights=weights + 0.02)
    found = cx.persistence()
    lasting = np.flatnonzero(found.births[1] < found.deaths[1])
    assert (found.births[1][lasting] < 0).any()
    values = _values(cx.simplices[1], cx.radii[1])
    for ring, birth in zip(found.loops(lasting), found.births[1][lasting], strict=True):
        sides = np.sort(np.column_stack((ring, np.roll(ring, -1))), axis=1).tolist()
        assert max(values[tuple(side)] for side in sides) == birth
    if d == 3:
        voids = np.flatnonzero(found.births[2] < found.deaths[2])
        values = _values(cx.simplices[2], cx.radii[2])
        for void in voids[:10]:
            triangles = np.sort(found.voids([void]).triangles, axis=1).tolist()
            assert max(values[tuple(row)] for row in triangles) == found.births[2][void]


# ---------------------------------------------------------------- radii of both signs


def test_negative_radii_are_for_weights_alone():
    plain = am.AlphaComplex([[0, 0], [1, 0], [0, 1]])
    for ask in (
        plain.at,
        plain.persistence().betti_numbers,
        plain.measure_curves().area,
        plain.measure_curves().euler_characteristic,
    ):
        with pytest.raises(ParameterError, match="0 or more"):
            ask(-0.5)
    with pytest.raises(ParameterError, match="got nan"):
        am.AlphaComplex([[0, 0]], weights=[1.0]).at(float("nan"))


def test_isolated_vertices_of_a_mesh_have_their_own_values():
    cx = am.AlphaComplex([[0, 0], [3, 0]], weights=[4, 1])
    mesh = cx.at(-1).mesh()
    assert mesh.cell_data["radius"]["vertex"].tolist() == [-2.0, -1.0]


# ---------------------------------------------------------------- what comes in and out


@pytest.mark.parametrize(
    ("weights", "message", "rows"),
    [
        ([1.0, 2.0], "one weight for each of the 3 points; got 2", ()),
        (5.0, "numpy.full", ()),
        ("w", "give the column itself", ()),
        ([[1.0], [2.0], [3.0]], "ravel", ()),
        (np.ones((3, 2)), "shape", ()),
        (["a", "b", "c"], "must be numbers", ()),
        ([1.0, None, "x"], "not numbers in rows 1, 2", (1, 2)),
        ([1.0, np.nan, np.inf], "NaN or infinite weights in rows 1, 2", (1, 2)),
        ([2**53 + 1, 0, 0], "float64 would round in row 0", (0,)),
        (np.ma.masked_array([1.0, 2.0, 3.0], [False, False, True]), "masked", (2,)),
        ([True, False, True], "must be numbers", ()),
    ],
)
@pytest.mark.parametrize("build", [am.AlphaComplex, am.filtration, am.delaunay])
def test_wrong_weights_are_named(build, weights, message, rows):
    with pytest.raises(WeightsError, match=message) as caught:
        build([[0, 0], [1, 0], [0, 1]], weights=weights)
    assert caught.value.rows == rows


@pytest.mark.parametrize("d", DIMENSIONS)
@pytest.mark.parametrize(("weight", "word"), [(1e300, "too large"), (1e-300, "too small")])
def test_weights_beyond_exact_arithmetic_are_named(d, weight, word):
    points, weights = cloud(30, d)
    weights[7] = weight
    with pytest.raises(CoordinateRangeError, match=f"weights {word}") as caught:
        am.AlphaComplex(points, weights=weights)
    assert caught.value.rows == (7,)


def test_weights_are_copied_and_closed():
    weights = np.array([1.0, 2.0, 3.0])
    cx = am.AlphaComplex([[0, 0], [5, 0], [0, 5]], weights=weights)
    weights[:] = 7
    assert cx.weights.tolist() == [1, 2, 3]
    assert not cx.weights.flags.writeable
    assert not cx.hidden.flags.writeable
    assert am.AlphaComplex([[0, 0]]).weights is None
    assert am.AlphaComplex([[0, 0]]).hidden.tolist() == []


def test_weights_of_many_kinds():
    pd = pytest.importorskip("pandas")
    points = [[0, 0], [5, 0], [0, 5]]
    expected = am.AlphaComplex(points, weights=[1, 2, 3]).radii[2]
    for weights in ((1, 2, 3), np.array([1, 2, 3], np.int8), pd.Series([1.0, 2.0, 3.0])):
        assert np.array_equal(am.AlphaComplex(points, weights=weights).radii[2], expected)
    frame = pd.DataFrame({"x": [0, 5, 0], "y": [0, 0, 5], "r": [1.0, 1.5, 2.0]})
    assert am.AlphaComplex(frame[["x", "y"]], weights=frame.r**2).weights.tolist() == [
        1,
        2.25,
        4,
    ]


def test_a_cloud_keeps_its_weights():
    from alphamesh.points import as_cloud

    kept = as_cloud([[0, 0], [5, 0]], weights=[1, 2])
    assert am.AlphaComplex(kept).weights.tolist() == [1, 2]
    assert am.AlphaComplex(kept, weights=[3, 4]).weights.tolist() == [3, 4]


def test_results_can_be_copied_and_pickled():
    points, weights = cloud(40, 2)
    cx = am.AlphaComplex(points, weights=weights)
    assert copy.deepcopy(cx) is cx
    again = pickle.loads(pickle.dumps(cx))
    assert np.array_equal(again.weights, weights)
    assert np.array_equal(again.hidden, cx.hidden)
    assert not again.hidden.flags.writeable


@pytest.mark.parametrize("d", DIMENSIONS)
def test_exports_hold_weights_and_hidden_points(d, tmp_path):
    points, weights = cloud(80, d, 0.1)
    cx = am.AlphaComplex(points, weights=weights)
    cx.save_npz(tmp_path / "a.npz")
    with np.load(tmp_path / "a.npz") as found:
        assert np.array_equal(found["weights"], weights)
        assert np.array_equal(found["hidden"], cx.hidden)
        assert np.array_equal(found["vertex_radii"], cx.radii[0])
    assert "weights" not in am.AlphaComplex(points).to_numpy()


@pytest.mark.parametrize("d", DIMENSIONS)
def test_queries_lie_in_cells_of_the_regular_triangulation(d):
    points, weights = cloud(120, d, 0.05)
    found = am.delaunay(points, weights=weights)
    queries = np.random.default_rng(2).random((60, d))
    cells = found.triangles if d == 2 else found.tetrahedra
    assert len(found.hidden) > 20
    for query, cell in zip(queries, found.find(queries), strict=True):
        if cell < 0:
            continue
        corners = points[cells[cell]]
        shares = np.linalg.solve((corners[1:] - corners[0]).T, query - corners[0])
        assert shares.min() > -1e-9 and shares.sum() < 1 + 1e-9
    assert (found.find(queries) >= 0).mean() > 0.5


# ---------------------------------------------------------------- what is not there


def test_what_needs_equal_balls_says_so():
    points, weights = cloud(40, 2)
    cx = am.AlphaComplex(points, weights=weights)
    for ask, remedy in (
        (lambda: am.framed_delaunay(_weighted(points, weights)), "frame"),
        (lambda: cx.choose_radius("topology"), "'longest-interval'"),
    ):
        with pytest.raises(UnweightedOnlyError, match=remedy):
            ask()


def _weighted(points, weights):
    from alphamesh.points import as_cloud

    return as_cloud(points, weights=weights)
