"""Pairs, diagrams and Betti numbers against matrix reduction, labelling and gudhi."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given

import alphamesh as am
from alphamesh.errors import ParameterError
from complexes import complexes
from reduction import check_pairs

RNG = np.random.default_rng(17)
CLOUDS = {
    "random": RNG.random((400, 2)),
    "grid": np.stack(np.meshgrid(np.arange(9.0), np.arange(9.0)), axis=-1).reshape(-1, 2),
    "few integers": RNG.integers(0, 9, (60, 2)).astype(float),
    "mask": am.demo_cloud("eight", 500, seed=2),
    "line": np.outer(RNG.integers(0, 50, 20), [1.0, 2.0]),
    "one": np.array([[3.0, 4.0]]),
    "two": np.array([[0.0, 0.0], [3.0, 4.0]]),
}


def multiset(rows):
    rows = np.asarray(rows, dtype=float).reshape(-1, 2)
    return rows[np.lexsort((rows[:, 1], rows[:, 0]))]


@given(complexes())
def test_pairs_are_those_of_matrix_reduction(cx):
    check_pairs(cx.persistence())


@pytest.mark.parametrize("name", CLOUDS)
def test_diagrams_are_those_of_gudhi(name):
    gudhi = pytest.importorskip("gudhi")
    points = np.unique(CLOUDS[name], axis=0)
    tree = gudhi.AlphaComplex(points=points, precision="exact").create_simplex_tree()
    tree.compute_persistence(homology_coeff_field=2, persistence_dim_max=True)
    found = am.AlphaComplex(CLOUDS[name]).persistence()
    for k in (0, 1):
        theirs = tree.persistence_intervals_in_dimension(k).reshape(-1, 2)
        mine = found.diagram(k, squared=True)
        # Classes that live for less than gudhi's rounding are of no account.
        lasting = [
            rows[rows[:, 1] - rows[:, 0] > 1e-9 * rows[:, 1].clip(max=1e9)]
            for rows in (mine, theirs)
        ]
        assert len(lasting[0]) == len(lasting[1])
        np.testing.assert_allclose(multiset(lasting[0]), multiset(lasting[1]), rtol=1e-9)


@given(complexes())
def test_betti_numbers_add_up_to_the_euler_characteristic(cx):
    found = cx.persistence()
    radii = cx.critical_radii()
    numbers = found.betti_numbers(radii)
    curve = found.euler_curve()
    for radius, (b0, b1) in zip(radii.tolist(), numbers.tolist(), strict=True):
        shape = cx.at(radius)
        assert shape.betti == (b0, b1)
        assert b0 - b1 == shape.euler_characteristic
        step = int(np.searchsorted(curve.radii, radius, side="right")) - 1
        assert curve.values[step] == b0 - b1


def test_betti_numbers_of_chosen_triangles():
    shape = am.AlphaComplex(am.demo_cloud("target", 3000, seed=2)).at()
    for count in (1, 2, 3):
        kept = shape.filtered(keep_largest=count)
        assert kept.betti == (count, len(kept.holes))


def test_betti_numbers_of_a_grid_of_squares():
    found = am.AlphaComplex(CLOUDS["grid"]).persistence()
    assert found.betti_numbers([0.0, 0.5, 0.7, 1.0]).tolist() == [
        [81, 0],
        [1, 64],
        [1, 64],
        [1, 0],
    ]
    radii, values = found.betti_curve()
    assert radii.tolist() == [0.0, 0.5, 0.5 * np.sqrt(2.0)]
    assert values.tolist() == [[81, 0], [1, 64], [1, 0]]


@pytest.mark.parametrize("name", ["annulus", "eight", "cheese", "islands"])
def test_rings_go_around_the_holes_of_the_shape(name):
    b0, b1 = am.DEMO_SHAPES[name].betti
    cx = am.AlphaComplex(am.demo_cloud(name, 4000, seed=3))
    choice = cx.choose_radius(betti=(b0, b1))
    assert choice.betti == (b0, b1)
    found = cx.persistence()
    alive = found.alive(choice.radius)
    assert len(alive) == b1
    edges = {tuple(row) for row in cx.at(choice.radius).edges.tolist()}
    rings = found.holes(alive)
    outer = {}
    for ring, hole in zip(rings, rings.classes.tolist(), strict=True):
        closed = [*ring.tolist(), int(ring[0])]
        assert all(tuple(sorted(step)) in edges for step in pairwise(closed))
        x, y = cx.points[closed].T
        outer.setdefault(hole, 0.5 * (x[:-1] * y[1:] - x[1:] * y[:-1]).sum())
    # Around each hole of the mask there is a ring, counter-clockwise.
    areas = hole_areas(am.demo_mask(name))
    assert len(outer) == len(areas) == b1
    for mine, theirs in zip(sorted(outer.values()), areas, strict=True):
        assert mine > 0.95 * theirs


def hole_areas(mask):
    """Return the areas of the regions of background that do not reach the border."""
    ndimage = pytest.importorskip("scipy.ndimage")
    labels, _ = ndimage.label(np.pad(~mask, 1, constant_values=True))
    return sorted(np.bincount(labels.ravel())[2:].tolist())


def test_the_result_does_not_depend_on_threads():
    filtration = am.filtration(RNG.random((30_000, 2)))
    one, three = (am.persistence(filtration, threads=n) for n in (1, 3))
    for mine, theirs in zip(one.pairs, three.pairs, strict=True):
        assert np.array_equal(mine, theirs)


def test_what_is_wrong_is_named():
    found = am.AlphaComplex(CLOUDS["two"]).persistence()
    with pytest.raises(ParameterError, match=r"dimension must be 0 .* got 3"):
        found.diagram(3)
    with pytest.raises(ParameterError, match="0 or more"):
        found.betti_numbers([1.0, -1.0])
    with pytest.raises(ParameterError, match="needs a filtration"):
        am.persistence(CLOUDS["two"])
