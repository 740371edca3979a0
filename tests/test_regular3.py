"""The compiled core for weighted points in space, before any Python stands on it."""

from __future__ import annotations

from fractions import Fraction
from itertools import combinations, permutations, product

import numpy as np
import pytest

from alphamesh._kernels import _core
from oracles3 import exact
from oracles_weighted import affine_dimension, relative_error, weighted_complex
from space_core import WEIGHTED, alpha3, regular3, row_set
from weighted_space import (
    check_weighted_cloud,
    nasty_weighted_cloud,
    orthocentre,
    root_error,
    simplices_of,
)

SIMPLICES = ("tetrahedra", "triangles", "edges")
RADII = ("tetrahedron_radii", "triangle_radii", "edge_radii")


def grid(size):
    return np.array(list(product(range(size), repeat=3)), dtype=float)


CLOUDS = {
    "light": lambda rng: (rng.random((300, 3)), rng.random(300) * 1e-3),
    "middling": lambda rng: (rng.random((300, 3)), rng.random(300) * 0.05),
    "heavy": lambda rng: (rng.random((300, 3)), rng.random(300) * 10),
    "negative": lambda rng: (rng.random((300, 3)), -rng.random(300) * 0.1),
    "few heavy": lambda rng: (rng.random((300, 3)), 0.2 * (rng.random(300) < 0.02)),
    "grid of zeros and ones": lambda rng: (grid(6), rng.integers(0, 2, 216)),
    "grid of integers": lambda rng: (grid(6), rng.integers(-3, 4, 216)),
    "grid of any": lambda rng: (grid(6) / 3, rng.random(216)),
    "sphere": lambda rng: (
        (v := rng.normal(size=(200, 3))) / np.linalg.norm(v, axis=1)[:, None],
        rng.random(200) * 0.1,
    ),
    "far from the origin": lambda rng: (rng.random((200, 3)) + 1e6, rng.random(200) * 0.05),
    "scales": lambda rng: (
        np.concatenate([rng.random((60, 3)) * 10.0**-k for k in (0, 3, 6)]),
        np.concatenate([rng.random(60) * 100.0**-k for k in (1, 4, 7)]),
    ),
}


@pytest.fixture(params=CLOUDS, name="cloud")
def make_cloud(request):
    points, weights = CLOUDS[request.param](np.random.default_rng(7))
    return points, np.asarray(weights, dtype=float)


def powers_of(result):
    return {s: r * abs(r) for s, r in simplices_of(result).items()}


@pytest.mark.parametrize("seed", range(100))
def test_nasty_clouds_by_the_definition(seed):
    points, weights, exponent = nasty_weighted_cloud(seed)
    if affine_dimension(exact(points)) == 3:
        check_weighted_cloud(points, weights, exponent)
    else:
        scaled = np.ldexp(np.array(weights, dtype=float), 2 * exponent)
        check_flat_cloud(np.ldexp(points.astype(float), exponent), scaled)


def check_flat_cloud(points, weights):
    result, expected = regular3(points, weights), weighted_complex(points, weights)
    assert result["dimension"] == expected.dimension < 3
    if result["representative"] is not None:
        assert result["representative"].tolist() == expected.representative
    assert result["hidden"].tolist() == expected.hidden
    radii = simplices_of(result)
    assert radii.keys() == expected.powers.keys()
    for s, power in expected.powers.items():
        assert relative_error(radii[s], power) < 1e-13, s
    assert (result["triangle_tetrahedra"] == -1).all()


def test_simplices_and_values_are_those_of_gudhi(cloud):
    gudhi = pytest.importorskip("gudhi")
    points, weights = cloud
    complex_ = gudhi.AlphaComplex(points=points, weights=weights, precision="exact")
    tree = complex_.create_simplex_tree()
    theirs = {tuple(s): v for s, v in tree.get_filtration()}
    mine = powers_of(regular3(points, weights))
    if set(mine) == set(theirs):
        # The values of gudhi are exact but for those of vertices.
        scale = np.abs(weights).max()
        for s, power in mine.items():
            assert power == pytest.approx(theirs[s], rel=1e-9, abs=1e-12 * scale)
    else:  # ties broken otherwise: what is born and does not die at once is the same
        for size in (1, 2, 3, 4):
            values = [
                {round(v, 9) for s, v in f.items() if len(s) == size} for f in (mine, theirs)
            ]
            assert not values[0] ^ values[1]


@pytest.mark.parametrize("kind", ["light", "middling", "heavy", "negative", "sphere"])
def test_simplices_and_values_are_those_of_diode(kind):
    diode = pytest.importorskip("diode")
    points, weights = CLOUDS[kind](np.random.default_rng(8))
    balls = np.column_stack([points, weights])
    levels = zip(*diode.fill_weighted_alpha_shapes_arrays(balls, True), strict=True)
    theirs = {
        tuple(sorted(row)): value
        for rows, values in levels
        for row, value in zip(rows.tolist(), values.tolist(), strict=True)
    }
    mine = powers_of(regular3(points, weights))
    assert mine.keys() == theirs.keys()
    for s, power in mine.items():
        assert power == pytest.approx(theirs[s], rel=1e-9, abs=1e-15)


def test_zero_weights_are_no_weights(cloud):
    points, _ = cloud
    weighted, plain = regular3(points, np.zeros(len(points))), alpha3(points)
    assert weighted["hidden"].size == 0
    assert weighted["vertices"].tolist() == [*range(len(points))]
    assert not weighted["vertex_radii"].any()
    for name in (*SIMPLICES, "triangle_tetrahedra"):
        assert np.array_equal(weighted[name], plain[name])
    for name in RADII:
        np.testing.assert_allclose(weighted[name], plain[name], rtol=1e-13)


def test_a_common_weight_shifts_all_powers():
    rng = np.random.default_rng(3)
    points = rng.random((200, 3))
    weighted, plain = regular3(points, np.full(200, 0.25)), alpha3(points)
    for name in SIMPLICES:
        assert np.array_equal(weighted[name], plain[name])
    for name in RADII:
        power = weighted[name] * np.abs(weighted[name])
        np.testing.assert_allclose(power, plain[name] ** 2 - 0.25, rtol=1e-12, atol=1e-15)


@pytest.mark.parametrize("weights", ["integers", "any", "tied"])
def test_neither_order_nor_threads_matter(weights):
    rng = np.random.default_rng(3)
    points = grid(25)
    n = len(points)
    weights = {
        "integers": lambda: rng.integers(-1, 3, n).astype(float),
        "any": lambda: rng.random(n) * 3,
        "tied": lambda: (points**2).sum(axis=1) - rng.integers(0, 2, n),
    }[weights]()
    expected = None
    for threads in (1, 2, 4):
        shuffle = rng.permutation(n)
        result = regular3(points[shuffle], weights[shuffle], threads)
        arrays = [np.sort(shuffle[result[name]], axis=1) for name in SIMPLICES]
        arrays += [result[name] for name in RADII]
        arrays += [np.sort(shuffle[result[name]]) for name in ("hidden", "vertices")]
        if expected is None:
            expected = arrays
        for mine, first in zip(arrays, expected, strict=True):
            assert np.array_equal(mine, first)


@pytest.mark.parametrize("scale", [1e-4, 1e-3, 0.1, 1.0])
def test_threads_agree_on_a_large_cloud(scale):
    """From few hidden points to nearly all."""
    rng = np.random.default_rng(5)
    points, weights = rng.random((40_000, 3)), rng.random(40_000) * scale
    one, three = (regular3(points, weights, threads) for threads in (1, 3))
    assert one["hidden"].size > 0
    for name in WEIGHTED[2:]:
        assert np.array_equal(one[name], three[name]), name


def test_duplicates_stand_for_the_heaviest():
    points = np.concatenate([grid(3), grid(3), grid(3)])
    weights = np.concatenate([np.zeros(27), np.full(27, 0.5), np.full(27, 0.5)])
    weights[5] = 1.0
    result = regular3(points, weights)
    heaviest = np.arange(27) + 27
    heaviest[5] = 5
    assert result["representative"].tolist() == [*heaviest, *heaviest, *heaviest]
    assert result["vertices"].tolist() == sorted(heaviest)
    # The lighter ones are hidden; those that are as heavy are merely equal.
    assert result["hidden"].tolist() == [*(set(range(27)) - {5}), 27 + 5, 54 + 5]
    alone = regular3(grid(3), weights[heaviest])
    assert row_set(heaviest[alone["tetrahedra"]]) == row_set(result["tetrahedra"])


def test_a_ball_swallows_all_inside_the_hull():
    points = np.concatenate([grid(5), [[1.9, 2.1, 2.0]]])
    weights = np.zeros(len(points))
    weights[-1] = 100.0
    result = regular3(points, weights)
    inside = ((points > 0) & (points < 4)).all(axis=1)
    inside[-1] = False
    assert result["hidden"].tolist() == np.flatnonzero(inside).tolist()
    assert result["vertices"].tolist() == np.flatnonzero(~inside).tolist()
    # The others are deep in the ball: none enters before the edge to its centre could, and
    # those at the corners enter with it.
    assert result["vertex_radii"][-1] == -10.0
    length_sq = ((points[~inside][:-1] - points[-1]) ** 2).sum(axis=1)
    enters = (100 - length_sq) / (2 * np.sqrt(length_sq))
    late = result["vertex_radii"][:-1] / enters
    assert (late > 1 - 1e-12).all()
    np.testing.assert_allclose(late[[0, 4, -5, -1]], 1.0, rtol=1e-12)


def test_a_point_with_a_flat_power_cell_is_a_vertex():
    """A point that only just reaches the surface of its power diagram is not hidden."""
    points = np.concatenate([grid(2) * 2, [[1.0, 1.0, 1.0]]])
    on, under = np.zeros(9), np.zeros(9)
    on[8], under[8] = -3.0, -3.0 - 2.0**-50
    assert regular3(points, on)["hidden"].tolist() == []
    assert regular3(points, under)["hidden"].tolist() == [8]


def test_bad_numbers():
    points, weights = grid(2), np.zeros(8)
    for bad in (np.nan, np.inf, -np.inf):
        weights[3] = bad
        with pytest.raises(_core.BadCoordinates):
            regular3(points, weights)
    weights[3:5] = 1e300, 1e-300
    with pytest.raises(_core.BadCoordinates):
        regular3(points, weights)


def flat_cloud(seed):
    """Return up to eight integer points in a plane or on a line of space, and weights."""
    rng = np.random.default_rng(seed)
    n = int(rng.integers(0, 9))
    dimension = seed % 3
    base = rng.integers(-3, 4, (dimension, 3))
    points = rng.integers(-3, 4, (n, dimension)) @ base + rng.integers(-5, 6, 3)
    weights = rng.integers(-2, 3, n) * rng.choice([0, 1, 20])
    if seed % 2:
        weights += (points**2).sum(axis=1)  # all tied, or nearly
    return points.astype(float), weights.astype(float)


@pytest.mark.parametrize("seed", range(60))
def test_flat_clouds_by_the_definition(seed):
    check_flat_cloud(*flat_cloud(seed))


def about_zero(rng):
    return rng.random((60, 3)), 0.0045 * 5 + rng.random(60) * 1e-12


HARD = {
    "powers that cancel": about_zero,
    "flat": lambda rng: (rng.random((60, 3)) * [1, 1, 1e-12], rng.random(60) * 1e-2),
    "needles": lambda rng: (rng.random((60, 3)) * [1, 1e-7, 1e-7], rng.random(60) * 1e-3),
    "slope": lambda rng: ((p := rng.random((60, 3))), p @ [1e8, 1e8, -3e8]),
    "far": lambda rng: (rng.random((60, 3)) + 1e6, rng.random(60) * 0.02),
    "large": lambda rng: (rng.random((60, 3)) * 2.0**400, rng.random(60) * 2.0**792),
    "small": lambda rng: (rng.random((60, 3)) * 2.0**-300, rng.random(60) * 2.0**-608),
}


@pytest.mark.parametrize("kind", HARD)
def test_values_are_good_to_the_last_digits_however_small(kind):
    points, weights = HARD[kind](np.random.default_rng(2))
    places = [[Fraction(v) for v in p] for p in points.tolist()]
    heavy = [Fraction(w) for w in weights.tolist()]
    radii = simplices_of(regular3(points, weights))
    least = {}
    for s, radius in radii.items():
        for face in combinations(s, len(s) - 1):
            assert not face or radii[face] <= radius
            least[face] = min(least.get(face, radius), radius)
    checked = 0
    for s, radius in radii.items():
        if radius == least.get(s):  # attached, or as good as
            continue
        _, power = orthocentre([places[i] for i in s], [heavy[i] for i in s])
        assert root_error(radius, power) < 5e-13, s
        checked += 1
    assert checked > 100


# A volume that rounding hides, and an orthocentre that comes out at the first vertex by chance.
NEARLY_FLAT = (
    (
        [
            [0.6944314349359383, 0.029913308585573832, 0.9776347602249704],
            [0.6944314349359385, 0.02991330858557384, 0.9776347602249704],
            [0.5557598046184459, 0.7604032995030882, 0.8544854575534176],
            [0.6944314349359387, 0.02991330858557384, 0.9776347602249704],
        ],
        [1.4388995482578575, 1.4388995482578577, 1.6172275354949899, 1.4388995482578582],
    ),
    (
        [
            [0.5596095943066114, 0.13744768394333967, 0.36586601180675027],
            [0.5854708076258571, -1.1773785270688748, -0.6401188757951685],
            [0.6700290823786391, -0.8887122179007592, -0.377421915314748],
            [-2.612054758824922, 2.0277507179939067, 0.358921191823474],
        ],
        [0.4659127024567755, 2.1387484377342165, 1.3811956796391005, 11.063427459364709],
    ),
)


@pytest.mark.parametrize(("points", "weights"), NEARLY_FLAT)
def test_nearly_flat_tetrahedra_whatever_their_first_vertex(points, weights):
    places = [[Fraction(v) for v in p] for p in points]
    _, power = orthocentre(places, [Fraction(w) for w in weights])
    for order in permutations(range(4)):
        found = regular3(np.array(points)[list(order)], np.array(weights)[list(order)])
        assert root_error(found["tetrahedron_radii"][0], power) < 5e-13


def test_campaigns_of_weighted_clouds():
    from trust.clouds import _prove

    for seed in (272, 295, 316, 393, 492, 691, 716, 767, 865, 906, 933):
        assert _prove(seed, 3, "weighted") == "proved"
