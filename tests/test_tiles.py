"""Tiles: their union is the complex of the whole cloud, bit for bit."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import alphamesh as am
from alphamesh import tiles
from alphamesh.errors import ParameterError

shapely = pytest.importorskip("shapely")


def solved(points, radius, count, seed=0):
    """Return the pieces of a plain loop over tiles."""
    rng = np.random.default_rng(seed)
    sample = points[rng.permutation(len(points))[:500]]
    tiling = tiles.plan(sample, count)
    offsets, rows = tiling.with_halo(points, radius)
    pieces = []
    for tile in range(len(tiling)):
        part = rows[offsets[tile] : offsets[tile + 1]]
        pieces.append(tiles.solve(tiling, tile, part, points[part], radius))
    return tiling, pieces


def ordered(simplices, radii):
    order = np.lexsort(simplices.T[::-1])
    return simplices[order], radii[order]


def assert_whole(points, radius, pieces):
    """Compare the union of pieces with the complex in memory."""
    cx = am.AlphaComplex(points)
    shape = cx.at(radius)
    for k in range(3):
        there = cx.radii[k] <= radius
        want = ordered(cx.simplices[k][there], cx.radii[k][there])
        got = ordered(
            np.concatenate([piece.simplices[k] for piece in pieces]),
            np.concatenate([piece.radii[k] for piece in pieces]),
        )
        np.testing.assert_array_equal(got[0], want[0])
        np.testing.assert_array_equal(got[1], want[1])
    summary, labels, areas = tiles.merge([tiles.part_of(piece) for piece in pieces], radius)
    counts = shape.counts
    assert summary.counts == tuple(counts[name] for name in ("vertices", "edges", "triangles"))
    for kind in ("singular", "regular", "interior"):
        assert getattr(summary, f"{kind}_facets") == counts[f"{kind}_edges"]
    assert summary.points == len(points)
    assert summary.betti == tuple(cx.persistence().betti_numbers(radius)[:2])
    assert summary.euler_characteristic == shape.euler_characteristic
    assert summary.regions == len(shape.regions) == len(areas)
    assert summary.size == pytest.approx(shape.area, rel=1e-12)
    assert summary.boundary_size == pytest.approx(shape.perimeter, rel=1e-12)
    np.testing.assert_allclose(areas, shape.regions.areas, rtol=1e-12)
    made = tiles.finish([piece.boundary for piece in pieces], labels)
    assert normal(made) == normal(shapely.get_parts(shape.polygons()))


def normal(polygons):
    return sorted(shapely.to_wkb(shapely.normalize(polygon)) for polygon in polygons)


def clouds():
    rng = np.random.default_rng(7)
    grid = np.stack(np.meshgrid(np.arange(40.0), np.arange(40.0)), axis=-1).reshape(-1, 2)
    centres = rng.random((12, 2)) * 30
    mask = am.demo_mask("annulus", size=64)
    pixels = np.argwhere(mask).astype(float)
    return {
        "uniform": (rng.random((3000, 2)) * 50, (0.4, 0.8, 3.0)),
        "clusters": (
            np.concatenate([c + rng.normal(0, 0.7, (250, 2)) for c in centres]),
            (0.1, 0.5),
        ),
        "grid": (rng.permutation(grid), (0.5, 0.7, 0.71, 2.0)),
        "holed grid": (rng.permutation(grid)[:900], (0.5, 0.75, 1.2)),
        "tenths": (rng.permutation(grid)[:1200] * 0.1, (0.05, 0.08)),
        "pixels": (rng.permutation(pixels), (0.5, 0.72)),
        "duplicates": (np.round(rng.random((2000, 2)) * 25), (0.6, 0.75)),
    }


@pytest.mark.parametrize("count", [1, 2, 5, 12])
@pytest.mark.parametrize("name", list(clouds()))
def test_union_is_the_whole(name, count):
    points, radii = clouds()[name]
    for radius in radii:
        _, pieces = solved(points, radius, count)
        assert_whole(points, radius, pieces)


coordinates = st.one_of(
    st.integers(-4, 4).map(float), st.floats(-4, 4, allow_subnormal=False, width=16)
)


@settings(max_examples=80, deadline=None)
@given(
    st.lists(st.tuples(coordinates, coordinates), max_size=40),
    st.sampled_from([0.0, 0.5, 0.75, 1.0, 1.5, 6.0]),
    st.integers(1, 8),
)
def test_union_is_the_whole_for_nasty_clouds(rows, radius, count):
    points = np.array(rows, dtype=np.float64).reshape(-1, 2)
    _, pieces = solved(points, radius, count)
    assert_whole(points, radius, pieces)


@settings(max_examples=60, deadline=None)
@given(
    st.lists(st.tuples(coordinates, coordinates), min_size=1, max_size=64), st.integers(1, 9)
)
def test_boxes_hold_the_points_of_their_tiles(rows, count):
    points = np.array(rows, dtype=np.float64)
    tiling = tiles.plan(points, count)
    owner = tiling.tile_of(points)
    low, high = tiling.boxes[owner, 0], tiling.boxes[owner, 1]
    assert (low <= points).all()
    assert (points < high).all()
    assert len(tiling.boxes) == len(tiling) <= count


def test_halo_holds_what_is_near_and_little_more():
    rng = np.random.default_rng(3)
    points = rng.random((2000, 2))
    tiling = tiles.plan(points, 6)
    offsets, rows = tiling.with_halo(points, 0.05)
    for tile, (low, high) in enumerate(tiling.boxes):
        part = rows[offsets[tile] : offsets[tile + 1]]
        assert (np.diff(part) > 0).all()
        distance = np.maximum(np.maximum(low - points, points - high), 0).max(axis=1)
        np.testing.assert_array_equal(part, np.flatnonzero(distance <= 0.1))


@pytest.mark.parametrize("count", [3, 8, 10])
def test_skewed_clouds_are_balanced(count):
    rng = np.random.default_rng(5)
    city = rng.normal(0, 0.001, (9000, 2))
    desert = rng.random((1000, 2)) * 1000
    points = np.concatenate((city, desert))
    tiling = tiles.plan(points, count)
    sizes = np.bincount(tiling.tile_of(points), minlength=count)
    assert sizes.min() > 0.7 * len(points) / count
    assert sizes.max() < 1.4 * len(points) / count


def test_equal_points_make_one_tile():
    assert len(tiles.plan(np.ones((50, 2)), 4)) == 1
    assert len(tiles.plan(np.empty((0, 2)), 4)) == 1
    with pytest.raises(ParameterError, match="at least 1"):
        tiles.plan(np.ones((5, 2)), 0)
