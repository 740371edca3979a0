"""Voronoi cells clipped by a box or a region are what is nearest."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest

import alphamesh as am
import oracles
from alphamesh.voronoi import voronoi
from cell_samples import grid


def nearest(points, queries):
    distance = np.hypot(*(queries[:, None, :] - points[None]).T)
    return distance.argmin(axis=0)


REGIONS = {
    "box": lambda shapely: (-0.2, 0.1, 1.3, 0.9),
    "inner box": lambda shapely: (0.45, 0.45, 0.5, 0.48),
    "outer box": lambda shapely: (-9, -5, 7, 8),
    "far box": lambda shapely: (100, 100, 103, 101),
    "triangle": lambda shapely: [[-0.5, 0.2], [1.1, 0.1], [0.4, 1.7]],
    "disc": lambda shapely: shapely.Point(0.5, 0.5).buffer(0.4),
    "ring": lambda shapely: (
        shapely.Point(0.5, 0.5).buffer(0.7) - shapely.box(0.3, 0.3, 0.7, 0.7)
    ),
    "two": lambda shapely: shapely.MultiPolygon(
        [shapely.box(0, 0, 0.3, 1), shapely.box(0.6, -1, 2, 2)]
    ),
    "comb": lambda shapely: shapely.union_all(
        [shapely.box(k / 20, 0.1, k / 20 + 0.02, 1) for k in range(20)]
        + [shapely.box(0, 0, 1, 0.1)]
    ),
}


def as_shape(shapely, region):
    if hasattr(region, "geom_type"):
        return region
    return shapely.box(*region) if np.ndim(region) == 1 else shapely.Polygon(region)


@pytest.mark.parametrize("region", REGIONS)
@pytest.mark.parametrize("name", ["uniform", "grid", "line", "one", "nearly a line"])
def test_clipped_cells_are_what_is_nearest(name, region):
    shapely = pytest.importorskip("shapely")
    rng = np.random.default_rng(5)
    x = rng.random(20)
    points = {
        "uniform": rng.random((60, 2)),
        "grid": grid(6, 6, 0.2),
        "line": np.column_stack((np.full(9, 0.5), np.arange(9) / 8)),
        "one": np.array([[0.3, 0.4]]),
        "nearly a line": np.column_stack((x, 0.7 * x + rng.normal(size=20) * 1e-9)),
    }[name]
    region = REGIONS[region](shapely)
    whole = as_shape(shapely, region)
    clipped = voronoi(points).clip(region)
    cells = clipped.to_shapely()
    assert shapely.is_valid(cells).all()
    assert clipped.areas.sum() == pytest.approx(whole.area, rel=1e-9)
    assert shapely.area(cells) == pytest.approx(clipped.areas, rel=1e-9, abs=1e-14)
    # Each point of the region is in the cell of the nearest point of the cloud.
    low, high = np.reshape(whole.bounds, (2, 2))
    queries = low + rng.random((400, 2)) * (high - low)
    queries = queries[shapely.contains_xy(whole, *queries.T)]
    expected = cells[nearest(points, queries)]
    away = shapely.distance(expected, shapely.points(queries))
    assert away.max() <= 1e-9
    check_rings(clipped)


def check_rings(clipped):
    assert clipped.offset[-1] == len(clipped.hole)
    assert clipped.ring_offset[-1] == len(clipped.vertices)
    assert (np.diff(clipped.ring_offset) >= 3).all()
    for ring in range(len(clipped.hole)):
        part = slice(clipped.ring_offset[ring], clipped.ring_offset[ring + 1])
        corners = clipped.vertices[part].tolist()
        doubled = oracles.doubled_area([tuple(map(Fraction, c)) for c in corners])
        assert (doubled < 0) == clipped.hole[ring]
    firsts = clipped.offset[:-1][np.diff(clipped.offset) > 0]
    assert not clipped.hole[firsts].any()


def test_cells_that_only_touch_the_box_are_left_out():
    """Box and ridges coincide: no flat cells, no lost or doubled area."""
    diagram = voronoi(grid(6, 6))
    clipped = diagram.clip((0.5, 0.5, 3.5, 2.5))
    inside = np.zeros((6, 6))
    inside[1:3, 1:4] = 1.0
    assert clipped.areas.reshape(6, 6).tolist() == inside.tolist()
    assert np.diff(clipped.offset).reshape(6, 6).tolist() == inside.tolist()
    through = diagram.clip((1.0, 1.0, 3.0, 3.0))
    assert through.areas.sum() == 4.0
    assert sorted(set(through.areas.tolist())) == [0.0, 0.25, 0.5, 1.0]
    check_rings(through)


def test_clipped_cells_meet_without_gaps():
    shapely = pytest.importorskip("shapely")
    points = np.random.default_rng(6).random((300, 2))
    for region in ((0.1, 0.2, 0.9, 0.8), am.convex_hull(points).corners):
        cells = voronoi(points).clip(region).to_shapely()
        cells = cells[~shapely.is_empty(cells)]
        assert shapely.coverage_is_valid(cells)
        border = shapely.get_coordinates(shapely.boundary(shapely.union_all(cells)))
        away = shapely.distance(
            shapely.boundary(as_shape(shapely, region)), shapely.points(border)
        )
        assert away.max() < 1e-15


def test_the_corners_of_a_box_are_kept_to_the_last_bit():
    box = (0.1, 0.3, 0.7, 0.9)
    clipped = voronoi(np.random.default_rng(7).random((50, 2))).clip(box)
    corners = {tuple(v) for v in clipped.vertices.tolist()}
    assert {(x, y) for x in box[::2] for y in box[1::2]} <= corners
    on_side = [np.isin(clipped.vertices[:, k], (box[k], box[k + 2])) for k in (0, 1)]
    close = [
        np.abs(clipped.vertices[:, [k]] - np.array([box[k], box[k + 2]])).min(axis=1) < 1e-12
        for k in (0, 1)
    ]
    assert np.array_equal(on_side, close)


def test_scale_does_not_matter():
    points = np.random.default_rng(8).integers(0, 100, (60, 2)).astype(float)
    diagram, box = voronoi(points), (-10, 3, 90, 120)
    clipped = diagram.clip(box)
    for power in (-900, -300, 300, 900):
        other = voronoi(np.ldexp(points, power))
        assert np.array_equal(other.vertices, np.ldexp(diagram.vertices, power))
        assert np.array_equal(other.ridge_directions, diagram.ridge_directions)
        assert np.array_equal(other.cell_vertices, diagram.cell_vertices)
        if abs(power) < 400:
            assert np.array_equal(other.areas, np.ldexp(diagram.areas, 2 * power))
        cut = other.clip(np.ldexp(box, power))
        assert np.array_equal(cut.vertices, np.ldexp(clipped.vertices, power))
