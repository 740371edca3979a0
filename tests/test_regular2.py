"""Weighted clouds in the plane: triangulation, values and hidden points by definition."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from alphamesh._kernels import _core
from oracles_weighted import (
    orthocentre,
    relative_error,
    weighted_complex,
    within_a_subnormal,
)
from strategies import CROWDS, FAMILIES, crowd
from weighted_samples import NAMES_2, WEIGHTS, prove_regular, regular2, values_of

#: Relative, of a radius.
PROMISED = 1e-14


def grid(side, scale=1.0):
    return np.indices((side, side)).reshape(2, -1).T * scale


def in_range(points, weights):
    """Tell whether all lies in the narrower range of weighted clouds, with room to spare."""
    sizes = np.concatenate([np.abs(points).ravel(), np.sqrt(np.abs(weights))])
    sizes = sizes[sizes > 0]
    return not sizes.size or sizes.max() < 2.0**200 * sizes.min()


def assert_by_definition(points, weights):
    result = regular2(points, weights)
    truth = weighted_complex(points, weights)
    assert result["dimension"] == truth.dimension
    assert representatives(result, len(points)) == truth.representative
    assert result["hidden"].tolist() == truth.hidden
    values = values_of(result)
    assert values.keys() == truth.powers.keys()
    for simplex, power in truth.powers.items():
        error = relative_error(values[simplex], power)
        assert error <= PROMISED or within_a_subnormal(values[simplex], power)
    assert_equal_where_equal(values, truth.powers)
    assert_flat_arrays(result)


def assert_equal_where_equal(values, powers):
    """Where an edge enters with a triangle, it has its value to the last bit."""
    for edge in (s for s in powers if len(s) == 2):
        cofaces = [t for t in powers if len(t) == 3 and {*edge} <= {*t}]
        if cofaces and powers[edge] == min(powers[t] for t in cofaces):
            assert values[edge] == min(values[t] for t in cofaces)


def representatives(result, n):
    merged = result["representative"]
    return list(range(n)) if merged is None else merged.tolist()


def assert_flat_arrays(result):
    """Rows ascend, cofaces are right, and values never decrease from face to coface."""
    edges, triangles = result["edges"], result["triangles"]
    assert (np.diff(edges) > 0).all() and (np.diff(triangles) > 0).all()
    assert (np.diff(result["vertices"]) > 0).all() and (np.diff(result["hidden"]) > 0).all()
    at = {edge: i for i, edge in enumerate(map(tuple, edges.tolist()))}
    found = [[] for _ in at]
    for t, (a, b, c) in enumerate(triangles.tolist()):
        for edge in ((a, b), (b, c), (a, c)):
            found[at[edge]].append(t)
            assert result["edge_radii"][at[edge]] <= result["triangle_radii"][t]
    for cofaces, row in zip(found, result["edge_triangles"].tolist(), strict=True):
        assert sorted(cofaces) == sorted(t for t in row if t >= 0)
    place = np.searchsorted(result["vertices"], edges)
    assert np.array_equal(result["vertices"][place], edges)
    if len(edges):
        assert (result["vertex_radii"][place].max(axis=1) <= result["edge_radii"]).all()


# --------------------------------------------------------------- by the definition


@pytest.mark.parametrize("kind", WEIGHTS)
@given(points=st.one_of(*FAMILIES.values()), seed=st.integers(0, 2**32 - 1))
def test_is_the_definition(kind, points, seed):
    points = points[:9]
    # Squares of coordinates must be floats for some of the weights.
    points = points[np.abs(points).max(axis=1, initial=0) < 1e150]
    weights = WEIGHTS[kind](np.random.default_rng(seed), points)
    if in_range(points, weights):
        assert_by_definition(points, weights)


@given(
    cells=st.lists(st.tuples(st.integers(0, 3), st.integers(0, 3)), max_size=10),
    slope=st.tuples(st.integers(-3, 3), st.integers(-3, 3)),
    off=st.lists(st.integers(-1, 1), min_size=10, max_size=10),
    scale=st.sampled_from([1.0, 0.5, 2.0**-90, 2.0**60]),
)
def test_lattices_lifted_onto_a_plane(cells, slope, off, scale):
    """Nothing but ties, three on a line among them; `off` moves some off the plane."""
    points = np.array(cells, dtype=float).reshape(-1, 2)
    weights = (points**2).sum(axis=1) + points @ slope
    assert_by_definition(points * scale, weights * scale**2)
    assert_by_definition(points * scale, (weights + off[: len(points)]) * scale**2)


@pytest.mark.parametrize("kind", CROWDS)
@given(seed=st.integers(0, 2**32 - 1), weights=st.sampled_from(sorted(WEIGHTS)))
@settings(max_examples=settings.default.max_examples // 10)
def test_crowds(kind, seed, weights):
    """Too large for the definition: a proof that nothing is below any triangle."""
    points = crowd(kind, seed, most=60)
    points = points[np.abs(points).max(axis=1) < 1e70]
    weights = WEIGHTS[weights](np.random.default_rng(seed), points)
    if in_range(points, weights):
        result = regular2(points, weights)
        prove_regular(points, weights, result)
        assert_flat_arrays(result)


@pytest.mark.parametrize("height", [1.0, 1e-4, 1e-9, 1e-13])
def test_values_of_slivers(height):
    """Thin triangles, and weights for which the power value is next to nothing."""
    rng = np.random.default_rng(6)
    for _ in range(60):
        points = rng.uniform(-1, 1, (3, 2)) * [1, height]
        weights = rng.uniform(-1, 1, 3) * height
        exact = [tuple(map(Fraction, p)) for p in points.tolist()]
        _, power = orthocentre(exact, [Fraction(w) for w in weights.tolist()])
        for shift in (0.0, float(power), float(power) * (1 + 1e-9)):
            shifted = weights + shift
            heavy = [Fraction(w) for w in shifted.tolist()]
            result = regular2(points, shifted)
            for value in result["triangle_radii"]:
                assert relative_error(value, orthocentre(exact, heavy)[1]) <= PROMISED


def test_an_orthocentre_on_an_edge():
    """Right angles whose squares are no floats: one value, to the last bit."""
    rng = np.random.default_rng(7)
    for _ in range(200):
        p, q = rng.integers(2**29, 2**31, 2).tolist()
        k, (x, y) = int(rng.integers(1, 4)), rng.integers(-(2**30), 2**30, 2).tolist()
        points = [[x, y], [x + p, y + q], [x - k * q, y + k * p]]
        values = values_of(regular2(points, [0, 0, 0]))
        assert values[1, 2] == values[0, 1, 2]
        power = Fraction((p * p + q * q) * (1 + k * k), 4)
        assert relative_error(values[1, 2], power) <= PROMISED


# ------------------------------------------------------------------- known answers


def test_two_points_on_their_common_tangent():
    """Balls of radius 1 at a distance of 4: the edge's orthocentre is in the middle."""
    result = regular2([[0, 0], [4, 0]], [1, 1])
    assert values_of(result) == {(0,): -1.0, (1,): -1.0, (0, 1): np.sqrt(3.0)}


def test_touching_balls_meet_at_zero():
    result = regular2([[0, 0], [3, 0], [0, 4]], [1, 4, 9])
    values = values_of(result)
    assert values[0, 1] == values[0, 2] == values[1, 2] == 0.0
    assert values[0, 1, 2] > 0


def test_a_vertex_inside_a_larger_ball_enters_with_its_edge():
    result = regular2([[0, 0], [1, 0]], [4, 0])
    # z = 2.5 lies beyond the second point, at power 6.25 - 4 from either.
    assert values_of(result) == {(0,): -2.0, (1,): 1.5, (0, 1): 1.5}
    assert result["hidden"].tolist() == []


def test_a_large_ball_hides_all_but_the_hull():
    points = grid(9)
    weights = np.zeros(81)
    weights[40] = 1e4
    result = regular2(points, weights)
    inner = ((points > 0) & (points < 8)).all(axis=1)
    inner[40] = False
    assert result["hidden"].tolist() == np.flatnonzero(inner).tolist()
    assert len(result["triangles"]) == 32  # a fan over the points of the border
    assert (result["triangles"] == 40).any(axis=1).all()


def test_a_flat_power_cell_is_enough():
    """A point on the plane of the others is none of them; a hair above, it is hidden."""
    square = [[0.0, 0.0], [2.0, 0.0], [0.0, 2.0], [2.0, 2.0], [1.0, 1.0]]
    assert regular2(square, [0, 0, 0, 0, -2.0])["hidden"].tolist() == []
    assert regular2(square, [0, 0, 0, 0, -2.0 - 2.0**-50])["hidden"].tolist() == [4]


def test_duplicates_stand_for_the_heaviest():
    points = [[0, 0], [1, 0], [0, 0], [0, 1], [0, 0], [1, 0], [0.25, 0.25], [0.25, 0.25]]
    weights = [0.0, 0.25, 0.5, 0.0, 0.5, 0.25, -9.0, -9.0]
    result = regular2(points, weights)
    assert result["representative"].tolist() == [2, 1, 2, 3, 2, 1, 6, 6]
    assert result["vertices"].tolist() == [1, 2, 3]
    # Lighter, or with an empty cell; row 7 is merely equal to row 6.
    assert result["hidden"].tolist() == [0, 6]


def test_a_line_in_any_direction():
    for step in ([1.0, 0.0], [0.0, 1.0], [3.0, -2.0]):
        points = np.outer([4, 0, 1, 2, 3], step)
        result = regular2(points, [0, 0, 0, 9.0 * np.dot(step, step), 0])
        assert result["dimension"] == 1
        assert {tuple(e) for e in result["edges"].tolist()} == {(1, 3), (0, 3)}
        assert result["hidden"].tolist() == [2, 4]
        assert result["edge_triangles"].tolist() == [[-1, -1]] * 2


@pytest.mark.parametrize("count", [0, 1, 3])
def test_a_point_or_none(count):
    result = regular2(np.full((count, 2), 7.0), np.arange(count) - 9.0)
    assert result["dimension"] == (0 if count else -1)
    assert result["vertices"].tolist() == [*range(count)][-1:]
    assert result["vertex_radii"].tolist() == [np.sqrt(10.0 - count)][:count]
    assert result["hidden"].tolist() == [*range(count - 1)]
    for name in ("triangles", "edges", "edge_triangles"):
        assert result[name].shape == (0, 3 if name == "triangles" else 2)


# -------------------------------------------------------------------- other kernels


@pytest.mark.parametrize("cloud", ["random", "grid", "tenths"])
def test_zero_weights_are_no_weights(cloud):
    points = {"random": np.random.default_rng(1).random((3000, 2)), "grid": grid(40),
              "tenths": grid(40, 0.1)}[cloud]  # fmt: skip
    representative, *plain = _core.alpha2(points, 1, None)
    weighted = regular2(points, np.zeros(len(points)))
    assert weighted["representative"] is representative is None
    assert weighted["vertices"].tolist() == [*range(len(points))]
    assert not weighted["vertex_radii"].any() and not weighted["hidden"].size
    triangles, triangle_radii, edges, edge_radii, _ = plain
    for rows, radii, mine in (
        (triangles, triangle_radii, "triangle"),
        (edges, edge_radii, "edge"),
    ):
        theirs, found = np.lexsort(rows.T), np.lexsort(weighted[f"{mine}s"].T)
        assert np.array_equal(weighted[f"{mine}s"][found], rows[theirs])
        np.testing.assert_allclose(
            weighted[f"{mine}_radii"][found], radii[theirs], rtol=PROMISED
        )


def test_a_common_weight_shifts_all_powers():
    points = np.random.default_rng(2).random((2000, 2))
    plain, shifted = regular2(points, np.zeros(2000)), regular2(points, np.full(2000, 2.0**-12))
    for name in ("triangle_radii", "edge_radii", "vertex_radii"):
        power = shifted[name] * np.abs(shifted[name])
        np.testing.assert_allclose(power, plain[name] ** 2 - 2.0**-12, rtol=1e-9, atol=1e-18)


@pytest.mark.parametrize("kind", WEIGHTS)
@pytest.mark.parametrize("cloud", ["random", "grid"])
def test_values_are_those_of_gudhi(cloud, kind):
    gudhi = pytest.importorskip("gudhi")
    rng = np.random.default_rng(4)
    points = rng.random((400, 2)) if cloud == "random" else grid(12)
    weights = WEIGHTS[kind](rng, points)
    theirs = gudhi.AlphaComplex(points=points, weights=weights, precision="exact")
    tree = theirs.create_simplex_tree()  # which must outlive its iterator
    powers = {tuple(s): a for s, a in tree.get_filtration()}
    mine = values_of(regular2(points, weights))
    if "tied" in kind:  # among ties, gudhi takes other simplices
        powers = {round(a, 9) for s, a in powers.items() if len(s) == 3}
        assert {round(r * abs(r), 9) for s, r in mine.items() if len(s) == 3} == powers
        return
    assert mine.keys() == powers.keys()
    # The values of gudhi are rounded when they are near zero.
    scale = max(np.abs(weights).max(), 1.0) * 1e-15
    for simplex, radius in mine.items():
        assert radius * abs(radius) == pytest.approx(powers[simplex], rel=1e-9, abs=scale)


# ------------------------------------------------------------------------ one result


def assert_same(one, other, rows):
    """Compare results up to the numbers of rows: row i of `other` is row rows[i] of `one`."""
    for name in ("triangles", "edges", "vertices", "hidden"):
        mapped = rows[other[name]]
        assert np.array_equal(np.sort(mapped, axis=-1 if mapped.ndim == 2 else 0), one[name])
    for name in ("triangle_radii", "edge_radii", "edge_triangles"):
        assert np.array_equal(one[name], other[name])


@pytest.mark.parametrize("kind", ["small", "integers", "hiding many", "half tied"])
def test_neither_order_nor_threads_matter(kind):
    rng = np.random.default_rng(3)
    points = grid(180, 0.5)
    weights = WEIGHTS[kind](rng, points)
    expected = regular2(points, weights)
    for threads in (1, 2, 3):
        rows = rng.permutation(len(points))
        assert_same(expected, regular2(points[rows], weights[rows], threads), rows)


@pytest.mark.parametrize("share", [0.01, 0.3, 3.0, 300.0])
def test_threads_agree_on_a_large_cloud(share):
    """From few hidden points to nearly all."""
    rng = np.random.default_rng(5)
    points, weights = rng.random((60_000, 2)), rng.random(60_000) * share / 60_000
    one, two, five = (regular2(points, weights, threads) for threads in (1, 2, 5))
    assert one["hidden"].size > 0
    for name in NAMES_2[2:]:
        assert np.array_equal(one[name], two[name]) and np.array_equal(one[name], five[name])


@pytest.mark.parametrize("exponent", [-400, 300])
def test_powers_of_two_scale_all(exponent):
    rng = np.random.default_rng(8)
    points, weights = rng.random((200, 2)), rng.random(200) * 0.01
    plain = regular2(points, weights)
    far = regular2(np.ldexp(points, exponent), np.ldexp(weights, 2 * exponent))
    for name in NAMES_2[2:]:
        moved = np.ldexp(plain[name], exponent) if name.endswith("radii") else plain[name]
        assert np.array_equal(far[name], moved)


# ---------------------------------------------------------------------------- refusals


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_weights_that_are_no_numbers(bad):
    with pytest.raises(_core.BadCoordinates, match="weight"):
        regular2(grid(3), [0.0] * 8 + [bad])


@pytest.mark.parametrize(
    ("size", "weight"), [(1.0, 1e-250), (2.0**-20, 1e200), (1e-180, 1.0), (2.0**340, 1.0)]
)
def test_scales_too_far_apart(size, weight):
    with pytest.raises(_core.BadCoordinates, match="range"):
        regular2(grid(3) * size, np.full(9, weight) * [1, 1, 1, 1, 1 / 3, 1, 1, 1, 1])


def test_as_many_weights_as_points():
    with pytest.raises(ValueError, match="as many weights as points"):
        regular2(grid(3), np.zeros(8))


def test_progress_is_told_and_errors_stop_it():
    rng = np.random.default_rng(9)
    points, weights = rng.random((300_000, 2)), np.zeros(300_000)
    told = []
    _core.regular2(points, weights, 1, told.append)
    assert told == sorted(told) and told[-1] == 1.0 and told[0] < 1.0

    def stop(share):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        _core.regular2(points, weights, 1, stop)
