"""Outlines and polygons: valid by construction, for any cloud."""

from __future__ import annotations

import math
import os
import sys
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import alphamesh as am
import oracles
from alphamesh.errors import CoordinateRangeError, MissingLibraryError, ParameterError
from alphamesh.polygons import smoothed
from planar_samples import (
    from_picture,
    inside_rows,
    planar_shapes,
    random_selection,
    regions_by_definition,
    rows,
)

shapely = pytest.importorskip("shapely")

MANY = 100_000 if os.environ.get("ALPHAMESH_HYPOTHESIS") == "deep" else 1500


def ring_rows(rings):
    return [part.tolist() for part in np.split(rings.rows, rings.offsets[1:-1])][: len(rings)]


def ring_edges(ring):
    return list(zip(ring, ring[1:] + ring[:1], strict=True))


def is_forest(ring_sets):
    """Tell whether rings that share vertices do so without closing a chain."""
    parent = {}

    def root(node):
        while parent.setdefault(node, node) != node:
            node = parent[node]
        return node

    for number, ring in enumerate(ring_sets):
        for row in ring:
            a, b = root(("ring", number)), root(("row", row))
            if a == b:
                return False
            parent[a] = b
    return True


# ---------------------------------------------------------------------- rings


@given(planar_shapes())
def test_rings_are_the_boundary_and_bound_the_regions(shape):
    rings, regions = shape.rings, regions_by_definition(shape)
    exact, _ = oracles.lattice(shape.points)
    areas = {min(part): part for part in regions}
    assert len(shape.regions) == len(regions) == len(rings.region_offsets) - 1
    listed = ring_rows(rings)
    found = [edge for ring in listed for edge in ring_edges(ring)]
    assert sorted(found) == sorted(rows(shape.boundary_edges))
    named = shape.filtration.simplices[1][rings.edges]
    assert rows(named) == [tuple(sorted(edge)) for edge in found]
    triangles = shape.filtration.simplices[2]
    labels = np.full(len(triangles), -1)
    labels[inside_rows(shape)] = shape.regions.labels
    for number in range(len(regions)):
        start, stop = rings.region_offsets[number : number + 2]
        mine = listed[start:stop]
        assert (rings.regions[start:stop] == number).all()
        assert rings.is_hole[start:stop].tolist() == [False] + [True] * (len(mine) - 1)
        # A valid polygon of the OGC: simple rings that touch without cutting it in two.
        assert all(len(set(ring)) == len(ring) for ring in mine)
        assert is_forest(mine)
        doubled = [oracles.doubled_area([exact[row] for row in ring]) for ring in mine]
        assert doubled[0] > 0 and all(area < 0 for area in doubled[1:])
        part = set(np.flatnonzero(labels == number).tolist())
        assert areas.pop(min(part)) == part
        corners = [[exact[row] for row in triangle] for triangle in triangles[sorted(part)]]
        assert sum(doubled) == sum(abs(oracles.doubled_area(triple)) for triple in corners)
        for ring in mine:
            assert exact[ring[0]] == min(exact[row] for row in ring)


@given(planar_shapes())
def test_ring_measures(shape):
    rings = shape.rings
    exact, scale = oracles.lattice(shape.points)
    for number, ring in enumerate(ring_rows(rings)):
        lengths = [math.dist(shape.points[a], shape.points[b]) for a, b in ring_edges(ring)]
        assert rings.lengths[number] == pytest.approx(math.fsum(lengths), rel=1e-12)
        box = np.ptp(np.array([exact[row] for row in ring], dtype=object), axis=0)
        area = Fraction(oracles.doubled_area([exact[row] for row in ring])) * scale**2 / 2
        around = Fraction(int(box[0]) * int(box[1])) * scale**2
        if Fraction(2) ** -900 < around < Fraction(2) ** 900:
            error = abs(Fraction(float(rings.areas[number])) - area)
            assert error <= around * Fraction(1, 10**12)
    assert len(rings.lengths) == len(rings.areas) == len(rings)


def test_rings_cannot_change():
    rings = from_picture(["#.#", "###"]).rings
    for name in ("rows", "edges", "offsets", "regions", "is_hole", "lengths", "areas"):
        assert not getattr(rings, name).flags.writeable, name
    assert repr(rings) == "<Rings: 1 outer, 0 holes, 12 corners>"


# ---------------------------------------------------------------------- pictures

PINCHES = {
    # picture: corners and holes of each polygon, areas
    "a hole at the border": (["###", "#.#", "##."], [(1, 7.0)]),
    "two squares at a corner": (["#.", ".#"], [(0, 1.0), (0, 1.0)]),
    "two holes at a corner": (["####", "#.##", "##.#", "####"], [(2, 14.0)]),
    "an island": (["#####", "#...#", "#.#.#", "#...#", "#####"], [(1, 16.0), (0, 1.0)]),
    "an island at a corner": (["####", "#..#", "#.##", "##.#", "####"], [(2, 16.0)]),
    "an island that divides a hole": (
        ["#####", "##..#", "#.#.#", "#..##", "#####"],
        [(1, 18.0), (0, 1.0)],
    ),
    "a necklace": ([".#.", "#.#", ".#."], [(0, 1.0)] * 4),
    "a chequerboard": (["#.#.", ".#.#", "#.#.", ".#.#"], [(0, 1.0)] * 8),
    "a corridor": (["#####", "#.#.#", "#####"], [(2, 13.0)]),
    "a snail": (["####", "#..#", "#.#.", "#.##", "#..."], [(0, 9.0), (0, 3.0)]),
    "a bitten frame": ([".###", "#..#", "#..#", "###."], [(0, 5.0), (0, 5.0)]),
    "a frame bitten once": (["####", "#..#", "#..#", "###."], [(1, 11.0)]),
}


@pytest.mark.parametrize("name", PINCHES)
def test_pictures(name):
    lines, expected = PINCHES[name]
    shape = from_picture(lines)
    parts = shape.polygons()
    found = [(len(part.interiors), part.area) for part in parts]
    assert found == expected
    assert shapely.is_valid(parts).all() and shape.geometry().is_valid
    squares = [
        shapely.box(x, len(lines) - 1 - y, x + 1, len(lines) - y)
        for y, line in enumerate(lines)
        for x, mark in enumerate(line)
        if mark == "#"
    ]
    assert shapely.equals(shape.geometry(), shapely.union_all(squares))


def test_a_border_that_touches_itself_becomes_a_hole():
    (part,) = from_picture(["###", "#.#", "##."]).polygons()
    assert (2.0, 1.0) in part.exterior.coords and (2.0, 1.0) in part.interiors[0].coords
    assert len(part.interiors[0].coords) == 5


def test_orientation_is_that_of_geojson():
    (part,) = from_picture(["####", "#.##", "##.#", "####"]).polygons()
    assert part.exterior.is_ccw
    assert [ring.is_ccw for ring in part.interiors] == [False, False]
    assert part.exterior.coords[0] == (0.0, 0.0)


def test_a_star_that_meets_in_one_point():
    """Many fans around one vertex: petals, joined in pairs by rims."""
    angles = np.arange(36) * (2 * np.pi / 36)
    rim = np.column_stack((np.cos(angles), np.sin(angles)))
    points = np.concatenate(([[0.0, 0.0]], rim, 2.5 * rim))
    filtration = am.filtration(points)
    middles = points[filtration.simplices[2]].mean(axis=1)
    sector = np.floor(np.arctan2(middles[:, 1], middles[:, 0]) / (2 * np.pi / 36)).astype(int)
    inner = np.hypot(*middles.T) < 0.9
    # Every third petal is in; the rim joins all of them, or none.
    petals = inner & (sector % 3 == 0)
    apart = am.Selection(filtration, np.inf, petals)
    assert len(apart.regions) == 12 and shapely.is_valid(apart.geometry())
    joined = am.Selection(filtration, np.inf, petals | ~inner)
    (part,) = joined.polygons()
    assert len(part.interiors) == 12
    assert all((0.0, 0.0) in ring.coords for ring in part.interiors)
    assert part.is_valid and part.area == pytest.approx(joined.area, rel=1e-14)


# ---------------------------------------------------------------------- shapely


def in_the_reach_of_geos(points):
    """GEOS does not scale: squares of differences must neither over- nor underflow."""
    sizes = np.abs(points[points != 0])
    return len(sizes) == 0 or (sizes.max() < 1e60 and sizes.min() > 1e-60)


def thinnest(shape):
    """Return the least ratio of a triangle's area to the products that it comes from."""
    least = Fraction(1)
    for corners in shape.points[shape.triangles].tolist():
        (ax, ay), (bx, by), (cx, cy) = [tuple(map(Fraction, corner)) for corner in corners]
        left, right = (bx - ax) * (cy - ay), (by - ay) * (cx - ax)
        least = min(least, abs(left - right) / (abs(left) + abs(right)))
    return least


def check_with_geos(shape):
    parts, whole = shape.polygons(), shape.geometry()
    if not (shapely.is_valid(parts).all() and whole.is_valid):
        # GEOS computes with 106 bits: thinner triangles look flat to it.
        assert thinnest(shape) < Fraction(2) ** -104
        return
    assert len(parts) == len(shape.regions)
    rounding = 1e-15 * np.abs(shape.points).max(initial=0) * np.ptp(shape.points, axis=0).max()
    error = abs(shapely.area(parts).sum() - shape.area)
    assert error <= 1e-12 * shape.area + rounding * len(shape.rings.rows)
    corners = {tuple(corner) for corner in shapely.get_coordinates(parts).tolist()}
    assert corners <= {tuple(point) for point in shape.points.tolist()}


@given(planar_shapes())
def test_nasty_clouds_give_valid_polygons(shape):
    if len(shape.points) and in_the_reach_of_geos(shape.points):
        check_with_geos(shape)


def small_cloud(rng):
    n = int(rng.integers(3, 60))
    kind = rng.integers(6)
    if kind == 0:
        return rng.random((n, 2))
    if kind == 1:
        return rng.integers(0, rng.integers(2, 12), (n, 2)).astype(float)
    if kind == 2:
        return np.argwhere(rng.random(rng.integers(2, 9, 2)) < 0.6) + 0.5
    if kind == 3:
        points = rng.random((n, 2))
        return np.concatenate((points, points[rng.integers(0, n, n // 3)]))
    if kind == 4:
        turn = rng.integers(0, 24, n) * (2 * np.pi / 24)
        circle = np.column_stack((np.cos(turn), np.sin(turn)))
        return circle * rng.integers(1, 4, (n, 1)) + 0.1
    return rng.integers(-1, 2, (n, 2)).cumsum(axis=0).astype(float)


def test_many_small_clouds_give_valid_polygons():
    rng = np.random.default_rng(5)
    pinched = 0
    for _ in range(MANY):
        points = small_cloud(rng)
        if len(points) == 0:
            continue
        cx = am.AlphaComplex(points, threads=1)
        radii = cx.critical_radii()
        shape = (
            random_selection(cx.filtration, rng)
            if rng.random() < 0.6
            else cx.at(rng.choice(radii))
        )
        check_with_geos(shape)
        pinched += len(np.unique(shape.rings.rows)) < len(shape.rings.rows)
    assert pinched > MANY // 3


@pytest.mark.parametrize("spacings", [0.6, 0.9, 1.5, math.inf])
def test_large_clouds_give_valid_polygons(spacings):
    cx = am.AlphaComplex(np.random.default_rng(2).random((50_000, 2)))
    shape = cx.at(spacings / math.sqrt(50_000))
    parts = shape.polygons()
    assert shapely.is_valid(parts).all() and shape.geometry().is_valid
    assert shapely.area(parts).sum() == pytest.approx(shape.area, rel=1e-12)
    assert shapely.length(parts).sum() == pytest.approx(shape.perimeter, rel=1e-12)


def test_the_order_of_the_points_does_not_matter():
    points = np.random.default_rng(3).random((400, 2))
    order = np.random.default_rng(4).permutation(400)
    here, there = (am.AlphaComplex(p).at(0.05).polygons() for p in (points, points[order]))
    assert len(here) > 1
    assert [part.wkb for part in here] == [part.wkb for part in there]


@pytest.mark.parametrize("exponent", [-500, 500])
def test_scale_does_not_matter(exponent):
    points = np.random.default_rng(6).random((300, 2))
    plain = am.AlphaComplex(points).at(0.06).rings
    scaled = am.AlphaComplex(np.ldexp(points, exponent)).at(math.ldexp(0.06, exponent)).rings
    np.testing.assert_array_equal(plain.rows, scaled.rows)
    np.testing.assert_array_equal(np.ldexp(plain.lengths, exponent), scaled.lengths)


@pytest.mark.parametrize(
    "points", [np.empty((0, 2)), [[1, 2]], [[0, 0], [1, 1], [2, 2]], [[0, 0], [0, 5], [9, 0]]]
)
def test_nothing_gives_no_polygons(points):
    shape = am.AlphaComplex(points).at(0.5)
    assert shape.polygons().shape == (0,)
    assert shape.polygons(simplify=1, smooth=2).shape == (0,)
    assert shape.geometry().wkt == "MULTIPOLYGON EMPTY"
    assert len(shape.rings) == len(shape.regions) == len(shape.holes) == 0
    assert shape.__geo_interface__ == {"type": "MultiPolygon", "coordinates": ()}


# ---------------------------------------------------------------------- other forms


def test_a_collection_has_what_belongs_to_no_triangle():
    points = [[0, 0], [2, 0], [0, 2], [9, 9], [9, 11], [30, 0], [30, 0]]
    shape = am.AlphaComplex(points).at(1.5)
    whole = shape.geometry(collection=True)
    assert [part.wkt for part in whole.geoms] == [
        "POLYGON ((0 0, 2 0, 0 2, 0 0))",
        "LINESTRING (9 9, 9 11)",
        "POINT (30 0)",
    ]
    assert shape.geometry().geom_type == "MultiPolygon"
    assert am.AlphaComplex(np.empty((0, 2))).at(1).geometry(collection=True).is_empty


@given(planar_shapes())
def test_collections_hold_the_whole_complex(shape):
    if not in_the_reach_of_geos(shape.points):
        return
    parts = shapely.get_parts(shape.geometry(collection=True))
    kinds = shapely.get_type_id(parts)
    assert (kinds == 3).sum() == len(shape.regions)
    assert (kinds == 1).sum() == len(shape.singular_edges)
    lines = shapely.get_coordinates(parts[kinds == 1]).reshape(-1, 2, 2)
    np.testing.assert_array_equal(lines, shape.points[shape.singular_edges])
    alone = shapely.get_coordinates(parts[kinds == 0])
    np.testing.assert_array_equal(alone, shape.points[shape.isolated_vertices])


def test_geo_interface_is_read_by_shapely():
    shape = from_picture(["####.#", "#.##..", "##.#.#", "####.#"])
    read = shapely.geometry.shape(shape)
    assert shapely.equals_exact(read, shape.geometry(), tolerance=0)
    assert shapely.get_num_geometries(read) == 3


def noisy_shape(seed):
    rng = np.random.default_rng(seed)
    points = rng.random((300, 2)) if seed % 2 else rng.integers(0, 12, (150, 2)).astype(float)
    cx = am.AlphaComplex(points)
    if seed % 3 == 0:
        return random_selection(cx.filtration, rng)
    return cx.at(rng.choice(cx.radii[2]))


@pytest.mark.parametrize("seed", range(12))
def test_simplified_polygons_are_valid_and_near(seed):
    shape = noisy_shape(seed)
    parts = shape.polygons()
    for tolerance in (0.02, 0.2):
        made = shape.polygons(simplify=tolerance)
        assert shapely.is_valid(shapely.multipolygons(made))
        assert len(made) == len(parts)
        np.testing.assert_array_equal(
            shapely.get_num_interior_rings(made), shapely.get_num_interior_rings(parts)
        )
        assert (
            shapely.get_num_coordinates(made).sum() <= shapely.get_num_coordinates(parts).sum()
        )
        borders = shapely.boundary(made), shapely.boundary(parts)
        assert (shapely.hausdorff_distance(*borders) <= tolerance * (1 + 1e-9)).all()


def test_simplified_leaves_out_corners_on_a_line():
    (part,) = from_picture(["####", "#.##", "####"]).polygons(simplify=1e-9)
    assert len(part.exterior.coords) == 5 and len(part.interiors[0].coords) == 5


@pytest.mark.parametrize("seed", range(12))
def test_smoothed_polygons_are_valid(seed):
    shape = noisy_shape(seed)
    for simplify in (0.0, 0.05):
        before = shape.polygons(simplify=simplify)
        made = shape.polygons(simplify=simplify, smooth=2)
        assert shapely.is_valid(shapely.multipolygons(made))
        np.testing.assert_array_equal(
            shapely.get_num_interior_rings(made), shapely.get_num_interior_rings(before)
        )
        # Cutting off corners stays within the convex hull of each polygon.
        hulls = shapely.buffer(shapely.convex_hull(before), 1e-9)
        assert shapely.covers(hulls, made).all()


def test_smoothing_a_square_cuts_its_corners():
    (part,) = from_picture(["#"]).polygons(smooth=1)
    quarter = [(0, 0.75), (0, 0.25), (0.25, 0), (0.75, 0), (1, 0.25), (1, 0.75), (0.75, 1)]
    assert set(part.exterior.coords) == {*quarter, (0.25, 1.0)}
    assert part.exterior.is_ccw and part.area == 1 - 4 * 0.25**2 / 2
    (again,) = from_picture(["#"]).polygons(smooth=2)
    assert len(again.exterior.coords) == 17


def test_smoothing_keeps_the_points_where_rings_touch():
    shape = from_picture(["###", "#.#", "##."])
    (part,) = shape.polygons(smooth=3)
    assert (2.0, 1.0) in part.exterior.coords and (2.0, 1.0) in part.interiors[0].coords


def test_smoothing_spares_corners_that_hold_something():
    angle = shapely.Polygon([(0, 0), (8, 0), (8, 2), (2, 2), (2, 8), (0, 8)])
    spike = shapely.Polygon([(2.5, 2.5), (9, 8), (8, 9)])
    alone = smoothed(np.array([angle]), 3)
    both = smoothed(np.array([angle, spike]), 3)
    assert (2.0, 2.0) not in alone[0].exterior.coords
    assert (2.0, 2.0) in both[0].exterior.coords
    assert alone[0].intersects(spike) and not both[0].intersects(both[1])


@pytest.mark.parametrize("tolerance", [-1.0, math.nan, math.inf])
def test_refuses_bad_tolerances(tolerance):
    with pytest.raises(ParameterError, match="simplify must be 0 or more"):
        from_picture(["#"]).polygons(simplify=tolerance)


@pytest.mark.parametrize("times", [-1, 1.5, True, "2"])
def test_refuses_bad_counts_of_smoothing(times):
    with pytest.raises(ParameterError, match="smooth must be a whole number"):
        from_picture(["#"]).geometry(smooth=times)


def test_needs_shapely(monkeypatch):
    monkeypatch.setitem(sys.modules, "shapely", None)
    shape = from_picture(["#"])
    with pytest.raises(MissingLibraryError, match=r"alphamesh\[geo\]"):
        shape.polygons()
    assert shape.regions.areas.tolist() == [1.0]


@given(st.integers(0, 10**6))
def test_crowds_give_valid_polygons(seed):
    from strategies import CROWDS, crowd

    rng = np.random.default_rng(seed)
    kinds = sorted(set(CROWDS) - {"exponential", "smallest"})
    points = crowd(str(rng.choice(kinds)), seed, most=200)
    if len(points) == 0 or not in_the_reach_of_geos(points):
        return
    try:
        cx = am.AlphaComplex(points, threads=1)
    except CoordinateRangeError:
        return
    check_with_geos(random_selection(cx.filtration, rng))
