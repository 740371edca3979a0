"""The compiled predicates have the exact sign on tables of near-degenerate cases."""

from __future__ import annotations

import itertools

import numpy as np
import pytest

import oracles
from alphamesh._kernels import _core
from strategies import CIRCLES

COUNT = 3000


def nudged(rng, cases, most=2):
    """Move coordinates of half of the cases by up to `most` ulps."""
    steps = rng.integers(-most, most + 1, cases.shape) * rng.integers(0, 2, (len(cases), 1, 1))
    return cases + steps * np.spacing(cases)


def integer_lines(rng, size=2**20):
    start = rng.integers(-size, size, (COUNT, 1, 2))
    step = rng.integers(-size, size, (COUNT, 1, 2))
    return (start + step * rng.integers(-50, 50, (COUNT, 3, 1))).astype(float)


def float_lines(rng):
    start, end = rng.normal(size=(2, COUNT, 1, 2))
    return start + (end - start) * rng.uniform(-2, 2, (COUNT, 3, 1))


def tiny_steps(rng):
    """Points a few ulps from (0.5, 0.5) against (12, 12) and (24, 24)."""
    cases = np.tile(np.array([[0.5, 0.5], [12.0, 12.0], [24.0, 24.0]]), (COUNT, 1, 1))
    cases[:, 0] += rng.integers(-32, 33, (COUNT, 2)) * 2.0**-53
    return cases


def mixed_scales(rng, corners=3):
    """Every coordinate of its own scale, over all of the legal range."""
    mantissa = rng.integers(-(2**52), 2**52, (COUNT, corners, 2)).astype(float)
    return np.ldexp(mantissa, rng.integers(0, 437, mantissa.shape))


def short_and_long(rng):
    """Two near points and one far away."""
    cases = rng.normal(size=(COUNT, 3, 2))
    cases[:, 1] = cases[:, 0] + np.ldexp(
        rng.normal(size=(COUNT, 2)), -rng.integers(0, 60, (COUNT, 1))
    )
    return cases


def right_angles(rng, size=2**15):
    corner = rng.integers(-size, size, (COUNT, 2))
    u, v = rng.integers(-size, size, (2, COUNT))
    s, t = rng.integers(-9, 10, (2, COUNT, 1))
    first, second = np.column_stack((u, v)), np.column_stack((-v, u))
    return np.stack((corner + s * first, corner + t * second, corner), axis=1).astype(float)


THREE = {
    "integer lines": integer_lines,
    "integer lines, nudged": lambda rng: nudged(rng, integer_lines(rng)),
    "small integers": lambda rng: rng.integers(-3, 4, (COUNT, 3, 2)).astype(float),
    "tenths": lambda rng: rng.integers(-9, 10, (COUNT, 3, 2)) * 0.1,
    "float lines": float_lines,
    "float lines far off": lambda rng: float_lines(rng) + 1e8,
    "tiny steps": tiny_steps,
    "mixed scales": mixed_scales,
    "short and long": short_and_long,
    "right angles": right_angles,
    "right angles, nudged": lambda rng: nudged(rng, right_angles(rng)),
    "huge": lambda rng: nudged(rng, integer_lines(rng)) * 2.0**900,
    "tiny": lambda rng: nudged(rng, right_angles(rng)) * 2.0**-950,
    "subnormal": lambda rng: integer_lines(rng, 40) * 5e-324,
}


def integer_circles(rng):
    """Four distinct integer points of a circle, moved and enlarged exactly."""
    cases = np.empty((COUNT, 4, 2))
    radii = sorted(CIRCLES)
    for case in cases:
        ring = CIRCLES[radii[rng.integers(len(radii))]]
        case[:] = np.array(ring)[rng.choice(len(ring), 4, replace=False)]
    return cases * rng.integers(1, 2**16, (COUNT, 1, 1)) + rng.integers(
        -(2**22), 2**22, (COUNT, 1, 2)
    )


def float_circles(rng):
    angles = rng.uniform(0, 2 * np.pi, (COUNT, 4))
    circle = np.stack((np.cos(angles), np.sin(angles)), axis=2)
    return circle * rng.uniform(0.1, 10, (COUNT, 1, 1)) + rng.normal(size=(COUNT, 1, 2))


def flat_quadrilaterals(rng):
    """Four points almost on a line, hence almost on a circle of any size."""
    start, end = rng.normal(size=(2, COUNT, 1, 2))
    return start + (end - start) * rng.uniform(-2, 2, (COUNT, 4, 1))


def rotated_squares(rng, size=2**12):
    corner = rng.integers(-size, size, (COUNT, 2))
    u, v = rng.integers(1, size, (2, COUNT))
    first, second = np.column_stack((u, v)), np.column_stack((-v, u))
    return np.stack((corner, corner + first, corner + first + second, corner + second), 1) * 1.0


FOUR = {
    "integer circles": integer_circles,
    "integer circles, nudged": lambda rng: nudged(rng, integer_circles(rng)),
    "rotated squares": rotated_squares,
    "rotated squares, tenths": lambda rng: rotated_squares(rng, 30) * 0.1,
    "small integers": lambda rng: rng.integers(-3, 4, (COUNT, 4, 2)).astype(float),
    "tenths": lambda rng: rng.integers(-5, 6, (COUNT, 4, 2)) * 0.1,
    "float circles": float_circles,
    "float circles far off": lambda rng: float_circles(rng) + 1e8,
    "flat": flat_quadrilaterals,
    "flat, nudged integers": lambda rng: nudged(rng, np.rint(flat_quadrilaterals(rng) * 2**30)),
    "mixed scales": lambda rng: mixed_scales(rng, 4),
    "huge": lambda rng: nudged(rng, integer_circles(rng)) * 2.0**900,
    "tiny": lambda rng: nudged(rng, integer_circles(rng)) * 2.0**-950,
    "subnormal": lambda rng: rotated_squares(rng, 9) * 5e-324,
}


def exact_signs(predicate, cases):
    return np.array([predicate(*oracles.lattice(case)[0]) for case in cases], dtype=np.int8)


def assert_signs(found, expected, cases):
    wrong = np.flatnonzero(found != expected)
    assert not len(wrong), [
        (cases[i].tolist(), int(found[i]), int(expected[i])) for i in wrong[:3]
    ]


def counter_clockwise(cases):
    """Drop flat cases and turn the first three points of the others counter-clockwise."""
    turns = exact_signs(lambda a, b, c, _: oracles.orient(a, b, c), cases)
    cases = cases[turns != 0]
    clockwise = turns[turns != 0] < 0
    cases[clockwise] = cases[clockwise][:, [0, 2, 1, 3]]
    return cases


def test_arithmetic_is_as_the_kernels_need_it():
    assert _core.self_test() == ""


@pytest.mark.parametrize("name", THREE)
def test_orient(name):
    cases = THREE[name](np.random.default_rng(1))
    expected = exact_signs(oracles.orient, cases)
    found = _core.orient2(cases)
    assert found.dtype == np.int8
    assert_signs(found, expected, cases)


@pytest.mark.parametrize("name", THREE)
def test_dot(name):
    cases = THREE[name](np.random.default_rng(2))
    assert_signs(_core.dot2(cases), exact_signs(oracles.dot, cases), cases)


@pytest.mark.parametrize("name", FOUR)
def test_in_circle(name):
    cases = counter_clockwise(FOUR[name](np.random.default_rng(3)))
    assert_signs(_core.incircle2(cases, False), exact_signs(oracles.in_circle, cases), cases)


@pytest.mark.parametrize("name", FOUR)
def test_in_circle_with_ties_broken(name):
    cases = counter_clockwise(FOUR[name](np.random.default_rng(4)))
    distinct = np.array([len({tuple(p) for p in case.tolist()}) == 4 for case in cases])
    cases = cases[distinct]
    found = _core.incircle2(cases, True)
    assert (found != 0).all()
    assert_signs(found, exact_signs(oracles.in_circle_perturbed, cases), cases)


@pytest.mark.parametrize("name", ["integer lines, nudged", "mixed scales", "right angles"])
def test_tables_reach_ties_and_both_sides(name):
    cases = THREE[name](np.random.default_rng(5))
    signs = set(exact_signs(oracles.orient, cases).tolist())
    signs |= set(exact_signs(oracles.dot, cases).tolist())
    assert signs == {-1, 0, 1} or name == "mixed scales"
    assert {-1, 1} <= signs


def test_every_order_of_a_cocircular_square():
    square = [(0.0, 0.0), (0.1, 0.0), (0.1, 0.1), (0.0, 0.1)]
    cases = counter_clockwise(np.array(list(itertools.permutations(square))))
    assert len(cases) == 24
    assert (_core.incircle2(cases, False) == 0).all()
    assert_signs(
        _core.incircle2(cases, True), exact_signs(oracles.in_circle_perturbed, cases), cases
    )


def test_no_cases_no_signs():
    assert _core.orient2(np.empty((0, 3, 2))).shape == (0,)
    assert _core.dot2(np.empty((0, 3, 2))).shape == (0,)
    assert _core.incircle2(np.empty((0, 4, 2)), True).shape == (0,)
