"""The oracles agree with one another, with scipy and with gudhi."""

from __future__ import annotations

import math
from collections import Counter
from decimal import Decimal, localcontext
from fractions import Fraction
from itertools import combinations, permutations

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

import oracles
from strategies import CIRCLES, FAMILIES, beyond_range, clouds

small = st.integers(-6, 6)
spots = st.tuples(small, small)
DISTINCT_FOUR = st.lists(spots, min_size=4, max_size=4, unique=True)


@given(st.lists(spots, min_size=3, max_size=3))
def test_orient_is_the_sign_of_the_shoelace_area(corners):
    assert oracles.orient(*corners) == oracles.sign(oracles.doubled_area(corners))


@given(DISTINCT_FOUR)
def test_in_circle_compares_distances_to_the_circumcentre(corners):
    a, b, c, d = corners
    turn = oracles.orient(a, b, c)
    assume(turn != 0)
    if turn < 0:
        b, c = c, b
    centre = oracles.circumcentre(a, b, c)
    reach = oracles.squared_distance(centre, a)
    assert reach == oracles.squared_distance(centre, b) == oracles.squared_distance(centre, c)
    assert oracles.in_circle(a, b, c, d) == oracles.sign(
        reach - oracles.squared_distance(centre, d)
    )


@given(st.lists(st.tuples(st.floats(-1e9, 1e9), st.floats(-1e9, 1e9)), min_size=3, max_size=3))
def test_circumradius_is_the_product_of_sides_over_four_areas(corners):
    (a, b, c), _ = oracles.lattice(corners)
    doubled = oracles.doubled_area([a, b, c])
    assume(doubled != 0)
    sides = math.prod(oracles.squared_distance(p, q) for p, q in ((a, b), (b, c), (c, a)))
    assert oracles.squared_distance(oracles.circumcentre(a, b, c), a) == Fraction(
        sides, 4 * doubled**2
    )


@given(st.lists(spots, min_size=3, max_size=3))
def test_diametral_disc_and_angle_agree(corners):
    a, b, p = corners
    assert oracles.in_open_diametral_disc(a, b, p) == (oracles.dot(a, b, p) < 0)


def lifted(points):
    """Lift points, raising each far more than all that are lexicographically smaller."""
    hair = Fraction(1, 10**40)
    order = sorted(points)
    return {p: p[0] ** 2 + p[1] ** 2 + hair ** (len(points) - order.index(p)) for p in points}


def below_plane(a, b, c, d, height):
    """Tell on which side of the lifted plane of counter-clockwise a, b, c the lifted d is."""
    rows = [(p[0] - d[0], p[1] - d[1], height[p] - height[d]) for p in (a, b, c)]
    first, second, third = rows
    normal = (
        second[1] * third[2] - second[2] * third[1],
        second[2] * third[0] - second[0] * third[2],
        second[0] * third[1] - second[1] * third[0],
    )
    return oracles.sign(sum(x * y for x, y in zip(first, normal, strict=True)))


@pytest.mark.parametrize("radius", CIRCLES)
def test_perturbation_is_a_real_lift(radius):
    ring = CIRCLES[radius]
    height = lifted(ring)
    rng = np.random.default_rng(radius)
    for _ in range(300):
        a, b, c, d = (ring[i] for i in rng.choice(len(ring), 4, replace=False))
        if oracles.orient(a, b, c) < 0:
            b, c = c, b
        assert oracles.in_circle(a, b, c, d) == 0
        assert oracles.in_circle_perturbed(a, b, c, d) == below_plane(a, b, c, d, height) != 0


def test_perturbation_does_not_depend_on_the_names_of_the_points():
    square = [(0, 0), (1, 0), (1, 1), (0, 1)]
    kept = {
        frozenset((a, b, c))
        for a, b, c, d in permutations(square)
        if oracles.orient(a, b, c) > 0 and oracles.in_circle_perturbed(a, b, c, d) < 0
    }
    # The lexicographically largest corner, (1, 1), is lifted up: it loses the diagonal.
    assert kept == {frozenset(((0, 0), (1, 0), (0, 1))), frozenset(((1, 0), (1, 1), (0, 1)))}


@given(points=clouds())
def test_triangulation_tiles_the_hull(points):
    cloud, _ = oracles.lattice(points)
    rows = set(oracles.representatives(points))
    triangles = oracles.delaunay_triangles(points)
    hull = oracles.hull_edges(points)
    if not triangles:
        assert len(oracles.collinear_path(points)) == max(0, len(rows) - 1)
        return
    edges = oracles.faces(triangles)
    assert len(rows) - len(edges) + len(triangles) == 1
    assert {row for triangle in triangles for row in triangle} == rows
    uses = Counter(edge for t in triangles for edge in combinations(t, 2))
    assert {edge for edge, count in uses.items() if count == 1} == {
        (min(edge), max(edge)) for edge in hull
    }
    area = sum(abs(oracles.doubled_area([cloud[row] for row in t])) for t in triangles)
    following = dict(hull)
    ring = [min(following)]
    while following[ring[-1]] != ring[0]:
        ring.append(following[ring[-1]])
    assert len(ring) == len(hull)
    assert area == oracles.doubled_area([cloud[row] for row in ring])


@given(points=clouds())
def test_values_never_decrease_from_face_to_coface(points):
    squares = oracles.filtration_squares(points)
    for simplex, square in squares.items():
        for face in combinations(simplex, len(simplex) - 1):
            assert not face or squares[face] <= square


def test_known_values():
    # A right-angled triangle: its longest side and itself share the value 5/2.
    squares = oracles.filtration_squares([(0, 0), (4, 0), (0, 3)])
    assert squares[0, 1, 2] == squares[1, 2] == Fraction(25, 4)
    assert squares[0, 1] == 4
    assert squares[0, 2] == Fraction(9, 4)
    # An obtuse one: the long side waits for the triangle.
    squares = oracles.filtration_squares([(0, 0), (8, 0), (4, 1)])
    assert squares[0, 1] == squares[0, 1, 2] > 16


@given(st.fractions(min_value=0, max_value=10**30, max_denominator=10**12))
def test_square_root_is_correctly_rounded(square):
    root = oracles.square_root(square)
    with localcontext() as context:
        context.prec = 100
        exact = (Decimal(square.numerator) / Decimal(square.denominator)).sqrt()
        best = min(
            (math.nextafter(root, 0), root, math.nextafter(root, math.inf)),
            key=lambda candidate: abs(Decimal(candidate) - exact),
        )
    assert root == best


@given(st.floats(0, 1e300))
def test_square_root_undoes_squares(value):
    assert oracles.square_root(Fraction(value) ** 2) == value


def test_square_root_at_the_ends_of_the_range():
    assert oracles.square_root(Fraction(5e-324) ** 2) == 5e-324
    assert oracles.square_root(Fraction(2) ** 2050) == math.inf


def test_relative_error():
    assert oracles.relative_error(3.0, Fraction(9)) == 0
    assert oracles.relative_error(3.0 * (1 + 2**-40), Fraction(9)) == pytest.approx(
        2**-40, rel=1e-3
    )
    assert oracles.relative_error(1e-320, Fraction(0)) == math.inf


def test_representatives_are_the_lowest_equal_rows():
    points = [(0.0, 1.0), (2.0, 2.0), (-0.0, 1.0), (2.0, 2.0), (5.0, 5.0)]
    assert oracles.representatives(points) == [0, 1, 0, 1, 4]


@pytest.mark.parametrize("family", FAMILIES)
@given(data=st.data())
def test_families_stay_in_range(family, data):
    points = data.draw(FAMILIES[family])
    assert points.shape == (len(points), 2)
    assert np.isfinite(points).all()
    assert oracles.in_range(points)


@given(points=beyond_range())
def test_beyond_range_is_beyond_range(points):
    assert not oracles.in_range(points)


def test_delaunay_agrees_with_scipy():
    spatial = pytest.importorskip("scipy.spatial")
    for seed in range(20):
        points = np.random.default_rng(seed).normal(size=(14, 2))
        peer = {tuple(sorted(t)) for t in spatial.Delaunay(points).simplices.tolist()}
        assert oracles.delaunay_triangles(points) == peer
        hull = {tuple(sorted(edge)) for edge in oracles.hull_edges(points)}
        assert hull == {tuple(sorted(e)) for e in spatial.ConvexHull(points).simplices.tolist()}


def test_values_agree_with_gudhi():
    gudhi = pytest.importorskip("gudhi")
    for seed in range(20):
        points = np.random.default_rng(seed).uniform(size=(14, 2))
        tree = gudhi.AlphaComplex(points=points, precision="exact").create_simplex_tree()
        peer = {tuple(simplex): value for simplex, value in tree.get_filtration()}
        ours = oracles.filtration_squares(points)
        assert peer.keys() == ours.keys()
        for simplex, value in peer.items():
            assert value == pytest.approx(float(ours[simplex]), rel=1e-13)
