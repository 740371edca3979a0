"""Tiles in space: their union is the complex of the whole cloud, voids and tunnels too."""

from __future__ import annotations

from itertools import pairwise

import gudhi
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import alphamesh as am
from alphamesh import tiles

NAMES = ("vertices", "edges", "triangles", "tetrahedra")


def solved(points, radius, count):
    tiling = tiles.plan(points[np.random.default_rng(0).permutation(len(points))[:500]], count)
    offsets, rows = tiling.with_halo(points, radius)
    parts = [rows[a:b] for a, b in pairwise(offsets)]
    return [
        tiles.solve(tiling, tile, part, points[part], radius) for tile, part in enumerate(parts)
    ]


def betti_numbers(cx, radius):
    """Return the Betti numbers that gudhi finds by matrix reduction."""
    tree = gudhi.SimplexTree()
    for simplices, radii in zip(cx.simplices, cx.radii, strict=True):
        for simplex in simplices[radii <= radius].tolist():
            tree.insert(simplex, 0.0)
    tree.compute_persistence(
        homology_coeff_field=2, persistence_dim_max=True, min_persistence=-1
    )
    return tuple([*tree.betti_numbers(), 0, 0, 0][:3])


def assert_whole(points, radius, count):
    cx = am.AlphaComplex(points)
    shape = cx.at(radius)
    pieces = solved(points, radius, count)
    for k in range(4):
        there = cx.radii[k] <= radius
        wanted = cx.simplices[k][there]
        got = np.concatenate([piece.simplices[k] for piece in pieces])
        radii = np.concatenate([piece.radii[k] for piece in pieces])
        order, found = np.lexsort(wanted.T[::-1]), np.lexsort(got.T[::-1])
        np.testing.assert_array_equal(got[found], wanted[order])
        np.testing.assert_array_equal(radii[found], cx.radii[k][there][order])
    summary, _, sizes = tiles.merge([tiles.part_of(piece) for piece in pieces], radius)
    counts = shape.counts
    assert summary.counts == tuple(counts[name] for name in NAMES)
    for kind in ("singular", "regular", "interior"):
        assert getattr(summary, f"{kind}_facets") == counts[f"{kind}_triangles"]
    assert summary.size == pytest.approx(shape.volume, rel=1e-12)
    assert summary.boundary_size == pytest.approx(shape.surface_area, rel=1e-12)
    assert sizes.sum() == pytest.approx(shape.volume, rel=1e-12)
    assert summary.betti == betti_numbers(cx, radius)


def clouds():
    rng = np.random.default_rng(1)
    grid = np.stack(np.meshgrid(*[np.arange(8.0)] * 3), axis=-1).reshape(-1, 3)
    ball = rng.normal(size=(700, 3))
    ball /= np.linalg.norm(ball, axis=1)[:, np.newaxis]
    return {
        "uniform": (rng.random((900, 3)), (0.06, 0.09, 0.12, 0.2)),
        "grid": (rng.permutation(grid), (0.5, 0.72, 0.87)),
        "holed grid": (rng.permutation(grid)[:330], (0.5, 0.72, 0.87)),
        "tenths": (rng.permutation(grid)[:330] * 0.1, (0.05, 0.08)),
        "sphere": (ball, (0.1, 0.2, 0.3)),
        "sphere in a sphere": (np.concatenate((ball, ball / 4)), (0.25,)),
        "duplicates": (np.round(rng.random((700, 3)) * 6), (0.72, 0.87)),
        "plane": (np.column_stack((rng.random((300, 2)), np.zeros(300))), (0.05, 0.1)),
        "oblique plane": (
            rng.integers(0, 4096, (500, 2)) @ [(3, 1, 2), (1, -2, 5)] / 4096,
            (0.2, 0.4),
        ),
        "upright plane": (rng.random((300, 2)) @ [(1, 0.5, 0), (0, 0, 1)], (0.05, 0.1)),
        "line": (np.outer(np.arange(40.0), (1, 2, 3)), (1.0, 2.0)),
    }


@pytest.mark.parametrize("count", [1, 4, 9])
@pytest.mark.parametrize("name", list(clouds()))
def test_union_is_the_whole(name, count):
    points, radii = clouds()[name]
    for radius in radii:
        assert_whole(points, radius, count)


coordinates = st.integers(-2, 2).map(float)


@settings(max_examples=60, deadline=None)
@given(
    st.lists(st.tuples(coordinates, coordinates, coordinates), min_size=1, max_size=30),
    st.sampled_from([0.0, 0.5, 0.75, 0.9, 1.2, 3.0]),
    st.integers(1, 6),
)
def test_union_is_the_whole_for_nasty_clouds(rows, radius, count):
    assert_whole(np.array(rows), radius, count)
