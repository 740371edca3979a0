"""Regions and holes: which there are, how large, and shapes without the small ones."""

from __future__ import annotations

import copy
import math
import pickle
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given

import alphamesh as am
import oracles
from alphamesh.classify import SimplexKind
from alphamesh.errors import ParameterError
from planar_samples import (
    components,
    from_picture,
    holes_by_definition,
    inside_rows,
    planar_shapes,
    random_selection,
    regions_by_definition,
    rows,
    selections,
)

# Two squares joined by an edge, a hole with an island, a bar with two holes.
FIGURE = [
    "##.######",
    "##.#....#",
    "...#.##.#",
    "...#....#",
    "##.######",
    ".........",
    "#########",
    "#.##..###",
    "#########",
]

NECKLACE_IN_A_FRAME = [
    "#######",
    "#.....#",
    "#..#..#",
    "#.#.#.#",
    "#..#..#",
    "#.....#",
    "#######",
]


def areas_of(shape, part):
    """Return the exact area of a set of triangles and its rounding to float."""
    exact, scale = oracles.lattice(shape.points)
    triangles = shape.filtration.simplices[2]
    doubled = (
        abs(oracles.doubled_area([exact[row] for row in triangles[t].tolist()])) for t in part
    )
    return sum(doubled, Fraction(0)) * scale**2 / 2


def measurable(area):
    return Fraction(2) ** -900 < area < Fraction(2) ** 900


# ---------------------------------------------------------------------- what there is


@given(planar_shapes())
def test_regions_are_sets_of_triangles_connected_by_edges(shape):
    regions, expected = shape.regions, regions_by_definition(shape)
    inside = np.array(inside_rows(shape), dtype=int)
    found = [set(inside[regions.labels == number].tolist()) for number in range(len(regions))]
    assert sorted(map(min, found)) == sorted(map(min, expected))
    assert all(part in expected for part in found)
    assert regions.triangle_counts.tolist() == [len(part) for part in found]
    assert (regions.areas[1:] <= regions.areas[:-1]).all()
    for number, part in enumerate(found):
        area = areas_of(shape, part)
        if measurable(area):
            assert abs(Fraction(float(regions.areas[number])) - area) <= area / 10**12
        corners = {row for t in part for row in shape.filtration.simplices[2][t].tolist()}
        edges = {
            edge
            for t in part
            for edge in oracles.faces({tuple(shape.filtration.simplices[2][t].tolist())})
        }
        euler = len(corners) - len(edges) + len(part)
        assert regions.euler_characteristics[number] == euler


@given(planar_shapes())
def test_labels_of_vertices_are_the_lowest_around(shape):
    regions = shape.regions
    around = {}
    for triangle, label in zip(shape.triangles.tolist(), regions.labels.tolist(), strict=True):
        for row in triangle:
            around.setdefault(row, set()).add(label)
    for row, stands_for in enumerate(oracles.representatives(shape.points)):
        assert regions.vertex_labels[row] == min(around.get(stands_for, {-1}))


@given(planar_shapes())
def test_measures_of_regions_add_up(shape):
    regions = shape.regions
    if math.isfinite(shape.area) and shape.area > 1e-250:
        assert math.fsum(regions.areas) == pytest.approx(shape.area, rel=1e-12)
    assert math.fsum(regions.perimeters) == pytest.approx(shape.perimeter, rel=1e-12, abs=0)
    assert np.isfinite(regions.centroids).all()
    for number, centroid in enumerate(regions.centroids):
        corners = shape.points[shape.triangles[regions.labels == number]].reshape(-1, 2)
        with np.errstate(over="ignore"):
            slack = 1e-12 * np.ptp(corners, axis=0) + 4 * np.spacing(np.abs(corners).max())
        assert (centroid >= corners.min(axis=0) - slack).all()
        assert (centroid <= corners.max(axis=0) + slack).all()


@given(planar_shapes())
def test_holes_are_what_the_outside_does_not_reach(shape):
    holes, expected = shape.holes, holes_by_definition(shape)
    assert len(holes) == len(expected)
    exact = sorted((areas_of(shape, part) for part in expected), reverse=True)
    assert (holes.areas[1:] <= holes.areas[:-1]).all()
    for area, wanted in zip(holes.areas.tolist(), exact, strict=True):
        if measurable(wanted):
            assert abs(Fraction(area) - wanted) <= wanted / 10**11
    # The border of all holes is a part of the border of the shape, turned around.
    border = {(b, a) for a, b in rows(shape.boundary_edges)}
    directed = []
    for start, stop in zip(holes.rings.offsets, holes.rings.offsets[1:], strict=False):
        ring = holes.rings.rows[start:stop].tolist()
        directed += zip(ring, ring[1:] + ring[:1], strict=True)
    assert set(directed) <= border and len(set(directed)) == len(directed)
    regular = {edge for part in expected for edge in border_of(shape, part)}
    assert {tuple(sorted(edge)) for edge in directed} == regular


def border_of(shape, part):
    edges, cofaces = (shape.filtration.simplices[1], shape.filtration.edge_triangles)
    one_side = [(s in part) != (t in part) for s, t in cofaces.tolist()]
    return rows(edges[np.array(one_side, dtype=bool)])


@given(planar_shapes())
def test_the_region_around_a_hole_has_it_in_its_own(shape):
    """By definition: what the region alone leaves, seen as a shape of its own."""
    holes, count = shape.holes, len(shape.regions)
    assert ((holes.regions >= -1) & (holes.regions < count)).all()
    inside = np.array(inside_rows(shape), dtype=int)
    middles = [set(part) for part in holes_by_definition(shape)]
    enclosed = []
    for number in range(count):
        alone = am.Selection(shape.filtration, shape.radius, marks(shape, inside, number))
        assert len(alone.holes) == shape.regions.hole_counts[number]
        assert (alone.holes.regions == 0).all()
        enclosed.append(set().union(*holes_by_definition(alone)))
    # Every hole that says so lies in a hole of that region; others meet none directly.
    claimed = np.bincount(holes.regions[holes.regions >= 0], minlength=count)
    for number in range(count):
        possible = sum(part <= enclosed[number] for part in middles)
        assert (claimed[number] > 0) == (shape.regions.hole_counts[number] > 0)
        assert claimed[number] <= possible


def marks(shape, inside, number):
    mask = np.zeros(len(shape.filtration.simplices[2]), dtype=bool)
    mask[inside[shape.regions.labels == number]] = True
    return mask


def test_a_figure_by_hand():
    shape = from_picture(FIGURE)
    regions, holes = shape.regions, shape.holes
    assert regions.areas.tolist() == [24.0, 18.0, 4.0, 2.0, 2.0]
    assert regions.perimeters.tolist() == [24 + 4 + 6, 22 + 14, 8, 6, 6]
    assert regions.hole_counts.tolist() == [2, 1, 0, 0, 0]
    assert regions.triangle_counts.tolist() == [48, 36, 8, 4, 4]
    assert regions.euler_characteristics.tolist() == [-1, 0, 1, 1, 1]
    assert regions.centroids[2].tolist() == [1.0, 8.0]
    assert holes.areas.tolist() == [10.0, 2.0, 1.0]
    assert holes.regions.tolist() == [1, 0, 0]
    assert holes.perimeters.tolist() == [14.0 + 6.0, 6.0, 4.0]
    assert holes.rings.is_hole.tolist() == [False, True, False, False]
    assert (holes.rings.areas > 0).tolist() == [True, False, True, True]
    assert shape.euler_characteristic == 5 - 3
    assert repr(regions) == "<Regions: 5, with 3 holes>" and repr(holes) == "<Holes: 3>"


@pytest.mark.parametrize(
    ("lines", "around"),
    [
        ([".#.", "#.#", ".#."], [-1]),  # a necklace
        (["#####", "##..#", "#.#.#", "#..##", "#####"], [0, 0]),  # an island divides it
        (
            ["#######", "#.....#", "#..#..#", "#.#.#.#", "#..#..#", "#.....#", "#######"],
            [0, -1],
        ),
        (["###", "#.#", "##."], [0]),
    ],
)
def test_regions_around_holes(lines, around):
    assert from_picture(lines).holes.regions.tolist() == around


def test_against_labelled_pictures():
    ndimage = pytest.importorskip("scipy.ndimage")
    rng = np.random.default_rng(8)
    for _ in range(60):
        mask = rng.random(rng.integers(1, 12, 2)) < rng.choice([0.4, 0.6, 0.8])
        shape = from_picture(["".join(line) for line in np.where(mask, "#", ".")])
        labels, count = ndimage.label(mask)
        sizes = sorted(np.bincount(labels.ravel())[1:].tolist(), reverse=True)
        assert shape.regions.areas.tolist() == sizes and len(shape.regions) == count
        gaps, _ = ndimage.label(~np.pad(mask, 1))
        sizes = sorted(np.bincount(gaps.ravel())[2:].tolist(), reverse=True)
        assert shape.holes.areas.tolist() == sizes


def test_centroids_far_from_the_origin():
    near, far = (
        am.AlphaComplex(np.random.default_rng(1).random((500, 2)) * 2.0**-10 + offset).at(1)
        for offset in (0, 2.0**20)
    )
    moved = near.regions.centroids + 2.0**20
    np.testing.assert_allclose(far.regions.centroids, moved, rtol=0, atol=2.0**-28)


@pytest.mark.parametrize("exponent", [-500, 500])
def test_measures_scale_with_the_points(exponent):
    points = np.random.default_rng(2).random((200, 2))
    plain = am.AlphaComplex(points).at(0.06).regions
    scaled = am.AlphaComplex(np.ldexp(points, exponent)).at(math.ldexp(0.06, exponent)).regions
    np.testing.assert_array_equal(np.ldexp(plain.centroids, exponent), scaled.centroids)
    np.testing.assert_array_equal(np.ldexp(plain.areas, 2 * exponent), scaled.areas)


# ---------------------------------------------------------------------- selections


@given(planar_shapes())
def test_filtering_drops_and_fills_what_it_says(shape):
    regions, holes = shape.regions, shape.holes
    least = float(np.median(regions.areas)) if len(regions) else 1.0
    most = float(np.median(holes.areas)) if len(holes) else 1.0
    for options in (
        {"min_region_area": least},
        {"max_hole_area": most},
        {"keep_largest": 1},
        {"min_region_area": least, "max_hole_area": most, "keep_largest": 2},
    ):
        made = shape.filtered(**options)
        assert set(inside_rows(made)) == filtered_by_definition(shape, **options)
        again = made.filtered(**options)
        np.testing.assert_array_equal(again.has_triangle, made.has_triangle)
    assert len(shape.filtered(max_hole_area=math.inf).holes) == 0
    same = shape.filtered()
    assert inside_rows(same) == inside_rows(shape) and same.radius == shape.radius


def filtered_by_definition(shape, min_region_area=0.0, max_hole_area=0.0, keep_largest=None):
    areas = shape.filtration.triangle_areas
    inside = set(inside_rows(shape))
    if max_hole_area > 0:
        for part in holes_by_definition(shape):
            if areas[sorted(part)].sum() <= max_hole_area:
                inside |= part
    parts = components(inside, shape.filtration.edge_triangles)
    parts.sort(key=lambda part: (-float(sum_of(areas, part)), min(part)))
    parts = [part for part in parts if sum_of(areas, part) >= min_region_area]
    return set().union(*parts[:keep_largest])


def sum_of(areas, part):
    total = 0.0  # in the order of the rows, as the areas of regions
    for value in areas[sorted(part)].tolist():
        total += value
    return total


def test_filtering_a_figure():
    shape = from_picture(FIGURE)
    assert shape.filtered(min_region_area=4).regions.areas.tolist() == [24.0, 18.0, 4.0]
    assert shape.filtered(keep_largest=1).area == 24.0
    assert shape.filtered(keep_largest=0).area == 0.0
    assert shape.filtered(max_hole_area=2).holes.areas.tolist() == [10.0]
    filled = shape.filtered(max_hole_area=10)
    assert filled.regions.areas.tolist() == [30.0, 27.0, 4.0, 2.0]
    assert shape.filtered(max_hole_area=10, min_region_area=28).area == 30.0


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"min_region_area": -1}, "min_region_area must be 0 or more"),
        ({"max_hole_area": math.nan}, "max_hole_area must be 0 or more"),
        ({"keep_largest": -1}, "keep_largest must be a whole number"),
        ({"keep_largest": 1.5}, "keep_largest must be a whole number"),
        ({"keep_largest": True}, "keep_largest must be a whole number"),
    ],
)
def test_refuses_bad_limits(options, message):
    with pytest.raises(ParameterError, match=message):
        from_picture(FIGURE).filtered(**options)


def test_selecting_regions():
    shape = from_picture(FIGURE)
    assert shape.select([0, 2]).regions.areas.tolist() == [24.0, 4.0]
    assert shape.select(shape.regions.hole_counts == 0).area == 8.0
    assert shape.select(np.uint8(1)).area == 18.0
    assert shape.select([]).area == 0.0
    assert len(am.AlphaComplex([[0, 0]]).at(1).select([]).triangles) == 0


@pytest.mark.parametrize("which", [5, [-1], [0.0], [True, False], "0", [[True] * 5]])
def test_refuses_regions_that_are_not_there(which):
    with pytest.raises(ParameterError, match="regions must be numbers from 0 to 4"):
        from_picture(FIGURE).select(which)


@given(selections())
def test_kinds_in_a_selection(selection):
    """Regular: at the border; interior: surrounded; nothing is singular."""
    inside = set(inside_rows(selection))
    filtration = selection.filtration
    uses = [sum(t in inside for t in pair) for pair in filtration.edge_triangles.tolist()]
    kinds = [SimplexKind.EXTERIOR, SimplexKind.REGULAR, SimplexKind.INTERIOR]
    assert selection.kinds[1].tolist() == [kinds[use] for use in uses]
    edges = filtration.simplices[1]
    border = {v for edge, use in zip(rows(edges), uses, strict=True) if use == 1 for v in edge}
    corners = {v for t in inside for v in filtration.simplices[2][t].tolist()}
    assert selection.regular_vertices.tolist() == sorted(border)
    assert selection.interior_vertices.tolist() == sorted(corners - border)
    used = np.array(uses) > 0 if uses else np.zeros(0, dtype=bool)
    np.testing.assert_array_equal(selection.edges, edges[used])
    nothing = ("singular_edges", "singular_vertices", "isolated_vertices")
    assert all(len(getattr(selection, name)) == 0 for name in nothing)
    assert selection.counts["vertices"] == len(corners)
    assert selection.euler_characteristic == int(
        selection.regions.euler_characteristics.sum()
    ) - shared_corners(selection)


def shared_corners(selection):
    """Return how often regions meet at a vertex, beyond the first time."""
    pairs = np.column_stack(
        (selection.triangles.ravel(), np.repeat(selection.regions.labels, 3))
    )
    meetings = np.unique(pairs, axis=0)
    return len(meetings) - len(np.unique(meetings[:, 0]))


def test_a_selection_of_all_triangles_is_the_regularized_shape():
    shape = am.AlphaComplex(np.random.default_rng(3).random((500, 2))).at(0.03)
    same = shape.filtered()
    for name in ("triangles", "boundary_edges", "regular_edges", "interior_edges"):
        np.testing.assert_array_equal(getattr(same, name), getattr(shape, name))
    assert same.area == shape.area and same.perimeter == shape.perimeter
    assert [p.wkb for p in same.polygons()] == [p.wkb for p in shape.polygons()]
    assert (
        repr(same)
        == f"<Selection: {len(shape.triangles)} triangles, {len(shape.regions)} regions>"
    )


def test_a_selection_is_saved_and_drawn(tmp_path):
    selection = from_picture(FIGURE).filtered(keep_largest=2)
    selection.save(tmp_path / "two.npz")
    with np.load(tmp_path / "two.npz") as saved:
        assert len(saved["triangles"]) == 84
    pytest.importorskip("matplotlib")
    assert "triangles" in selection.plot().artists


def test_a_selection_cannot_change():
    mask = np.ones(len(from_picture(FIGURE).filtration.simplices[2]), dtype=bool)
    selection = am.Selection(from_picture(FIGURE).filtration, 1.0, mask)
    mask[:] = False
    assert selection.area == 81.0 and not selection.has_triangle.flags.writeable
    thawed = pickle.loads(pickle.dumps(selection))
    assert thawed.area == 81.0 and not thawed.has_triangle.flags.writeable
    assert copy.copy(selection) is selection


@pytest.mark.parametrize("mask", [np.ones(3, bool), np.ones(162, int), None, [True]])
def test_refuses_a_wrong_mask(mask):
    with pytest.raises(ParameterError, match="has_triangle must be 162 truth values"):
        am.Selection(from_picture(FIGURE).filtration, 1.0, mask)


def test_random_selections_of_a_large_cloud():
    rng = np.random.default_rng(9)
    filtration = am.filtration(rng.random((20_000, 2)))
    selection = random_selection(filtration, rng)
    regions, holes = selection.regions, selection.holes
    assert regions.areas.sum() == pytest.approx(selection.area, rel=1e-12)
    assert regions.perimeters.sum() == pytest.approx(selection.perimeter, rel=1e-12)
    whole = am.Selection(filtration, 0.0, np.ones(len(selection.has_triangle), dtype=bool))
    filled = selection.filtered(max_hole_area=math.inf)
    assert filled.area == pytest.approx(selection.area + holes.areas.sum(), rel=1e-12)
    assert filled.area < whole.area
