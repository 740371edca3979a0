"""Surfaces in space: closed, oriented, manifold, and of the topology that they must have."""

from __future__ import annotations

import copy
import itertools
import pickle
from collections import Counter
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import alphamesh as am
from alphamesh._kernels.surfaces import surface3
from alphamesh.check import check_surface
from alphamesh.errors import InvalidResultError, ParameterError
from alphamesh.sampling import DEMO_SOLIDS

# A radius that suits 4,000 points of each solid, well within the range that does.
RADII = {
    "ball": 0.3,
    "shell": 0.25,
    "torus": 0.2,
    "double-torus": 0.22,
    "two-balls": 0.3,
    "linked-rings": 0.17,
    "trefoil": 0.16,
    "hollow-torus": 0.16,
}


@pytest.fixture(scope="module", params=sorted(DEMO_SOLIDS))
def solid(request):
    name = request.param
    cx = am.AlphaComplex(am.sample_solid(name, 4000, seed=1))
    return DEMO_SOLIDS[name], cx.at(RADII[name])


def lattice(*sizes):
    return np.array(list(itertools.product(*map(range, sizes))), dtype=np.float64)


def cubes(*corners, among=(5, 5, 5)):
    """Return a selection: the unit cubes with these lowest corners, of a lattice."""
    cx = am.AlphaComplex(lattice(*among))
    centres = cx.points[cx.simplices[3]].mean(axis=1)
    lowest = {tuple(corner) for corner in corners}
    chosen = np.array([tuple(row) in lowest for row in np.floor(centres).astype(int)])
    return am.Selection3D(cx.filtration, 1.0, chosen)


def side_counts(surface):
    """How many triangles each edge has, by brute force."""
    return Counter(
        frozenset(pair)
        for triangle in surface.triangles.tolist()
        for pair in itertools.combinations(triangle, 2)
    )


def topology(surface):
    """Return what of the shells depends on no order: outer or not, genus and volume."""
    shells = surface.shells
    rows = zip(shells.is_outer, shells.genera, np.round(shells.volumes, 9), strict=True)
    return sorted((bool(outer), int(genus), float(volume)) for outer, genus, volume in rows)


# ---------------------------------------------------------------------- demo solids


def test_demo_solids_have_the_surface_that_they_must_have(solid):
    demo, shape = solid
    surface = shape.surface()
    check_surface(surface, shape)
    assert surface.is_closed
    assert surface.is_oriented
    assert surface.is_manifold
    assert tuple(sorted(surface.shells.genera.tolist(), reverse=True)) == demo.genera
    components, _, voids = demo.betti
    assert np.count_nonzero(surface.shells.is_outer) == components
    assert len(surface.shells) == components + voids
    assert set(side_counts(surface).values()) == {2}
    assert surface.volume == pytest.approx(shape.volume, rel=1e-12)
    assert surface.area == pytest.approx(shape.surface_area, rel=1e-12)


def test_trimesh_finds_them_watertight(solid):
    pytest.importorskip("trimesh")
    _, shape = solid
    mesh = shape.to_trimesh()
    assert mesh.is_watertight
    assert mesh.is_winding_consistent
    assert mesh.is_volume
    assert mesh.volume == pytest.approx(shape.volume, rel=1e-9)
    shells = shape.surface().shells
    assert mesh.body_count == len(shells)
    assert mesh.euler_number == shells.euler_characteristics.sum()


def test_surfaces_show_the_boundary_triangles(solid):
    _, shape = solid
    for manifold in (True, False):
        surface = shape.surface(manifold=manifold)
        rows = surface.source_rows[surface.triangles]
        np.testing.assert_array_equal(rows, shape.boundary_triangles)
        np.testing.assert_array_equal(surface.points, shape.points[surface.source_rows])
    assert len(np.unique(surface.source_rows)) == len(surface.source_rows)


@pytest.mark.parametrize("name", sorted(DEMO_SOLIDS))
def test_samples_of_a_solid_lie_where_they_should(name):
    demo = DEMO_SOLIDS[name]
    inside = am.sample_solid(name, 500, seed=3)
    assert inside.shape == (500, 3)
    assert demo.contains(inside).all()
    on = am.sample_solid(name, 500, seed=3, surface=True)
    distance = demo.distance(on)
    levels = [level for level in (demo.low, demo.high) if level]
    off = np.min([np.abs(distance - level) for level in levels], axis=0)
    assert off.max() < 1e-9
    assert all((np.abs(distance - level) < 1e-9).any() for level in levels)
    np.testing.assert_array_equal(inside, am.sample_solid(name, 500, seed=3))


def test_samples_are_uniform():
    distance = np.linalg.norm(am.sample_solid("ball", 20_000, seed=1), axis=1)
    # In a ball the cube of the distance is uniform; 4 standard errors.
    counts = np.histogram(distance**3, bins=10, range=(0, 1))[0]
    assert np.abs(counts - 2000).max() < 4 * np.sqrt(1800)
    shell = am.sample_solid("shell", 20_000, seed=1, surface=True)
    outer = np.count_nonzero(np.linalg.norm(shell, axis=1) > 0.8)
    share = 1 / (1 + 0.6**2)
    assert abs(outer - 20_000 * share) < 4 * np.sqrt(20_000 * share * (1 - share))


def test_unknown_solids_are_named():
    with pytest.raises(ParameterError, match="torus"):
        am.sample_solid("doughnut", 10)


# ---------------------------------------------------------------------- pinched ones


@pytest.mark.parametrize(
    ("corners", "vertices", "shells"),
    [
        ([(1, 1, 1), (2, 2, 1)], (14, 16), [0, 0]),  # a common edge
        ([(1, 1, 1), (2, 2, 2)], (15, 16), [0, 0]),  # a common point
        ([(1, 1, 1), (2, 1, 1)], (12, 12), [0]),  # a common face
    ],
)
def test_cubes_that_touch_come_apart(corners, vertices, shells):
    shape = cubes(*corners)
    merged, split = shape.surface(manifold=False), shape.surface()
    assert (len(merged.points), len(split.points)) == vertices
    assert split.shells.genera.tolist() == shells
    assert split.shells.volumes == pytest.approx([2 / len(shells)] * len(shells))
    assert merged.is_closed
    assert merged.is_oriented
    assert merged.is_manifold == (vertices[0] == vertices[1])
    check_surface(split, shape)
    check_surface(merged, shape)
    np.testing.assert_array_equal(np.sort(split.source_rows), split.source_rows)


def test_an_edge_in_four_triangles_is_still_even():
    counts = Counter(side_counts(cubes((1, 1, 1), (2, 2, 1)).surface(manifold=False)).values())
    assert counts == {2: 34, 4: 1}


def test_a_gap_of_no_width_is_closed():
    # Two dents meet at an edge; both sheets there would lead from one point to one other.
    middle = [(0, 0, 1), (1, 1, 1)]
    block = [(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 2)]
    shape = cubes(*block, *middle, among=(3, 3, 4))
    surface = shape.surface()
    check_surface(surface, shape)
    assert set(side_counts(surface).values()) == {2}
    assert surface.shells.genera.tolist() == [0]


def test_cavities_that_touch_at_an_edge_are_two():
    holes = {(1, 1, 1), (2, 2, 1)}
    block = [c for c in itertools.product(range(4), range(4), range(3)) if c not in holes]
    shape = cubes(*block, among=(5, 5, 4))
    surface = shape.surface()
    check_surface(surface, shape)
    assert topology(surface) == [(False, 0, -1.0), (False, 0, -1.0), (True, 0, 48.0)]


def test_nested_regions_each_have_an_outer_shell():
    whole = set(itertools.product(range(7), repeat=3))
    gap = {c for c in whole if max(abs(x - 3) for x in c) == 2}
    hollow = {(3, 3, 3)}
    shape = cubes(*(whole - gap - hollow), among=(8, 8, 8))
    surface = shape.surface()
    check_surface(surface, shape)
    assert topology(surface) == [
        (False, 0, -125.0),
        (False, 0, -1.0),
        (True, 0, 27.0),
        (True, 0, 343.0),
    ]
    outer = shape.surface(outer_only=True)
    assert outer.shells.volumes == pytest.approx([343, 27])
    assert outer.is_manifold
    filled = shape.filtered(max_void_volume=10.0).surface()
    assert topology(filled) == [(False, 0, -125.0), (True, 0, 27.0), (True, 0, 343.0)]
    alone = shape.filtered(min_region_volume=100.0).surface()
    assert topology(alone) == [(False, 0, -125.0), (True, 0, 343.0)]


def test_a_ring_of_cubes_is_a_torus():
    ring = [(x, y, 1) for x in range(3) for y in range(3) if (x, y) != (1, 1)]
    surface = cubes(*ring).surface()
    assert surface.shells.genera.tolist() == [1]
    # Without one side, its ends meet at an edge: that is no way through.
    opened = cubes(*[c for c in ring if c not in {(0, 0, 1), (1, 0, 1), (2, 0, 1)}], (1, 0, 1))
    assert opened.surface().shells.genera.tolist() == [0, 0]


# ---------------------------------------------------------------------- any selection


@st.composite
def selections(draw):
    """Any tetrahedra of a cloud full of ties."""
    size = draw(st.integers(2, 4))
    cells = st.tuples(*[st.integers(0, size)] * 3)
    points = np.array(draw(st.lists(cells, min_size=5, max_size=40)), dtype=np.float64)
    filtration = am.filtration(points)
    count = len(filtration.simplices[3])
    share = draw(st.sampled_from([0.2, 0.5, 0.8, 1.0]))
    seed = draw(st.integers(0, 2**32 - 1))
    chosen = np.random.default_rng(seed).random(count) < share
    return am.Selection3D(filtration, 1.0, chosen)


@given(shape=selections())
@settings(max_examples=150, deadline=None)
def test_any_tetrahedra_have_a_manifold_boundary(shape):
    split, merged = shape.surface(), shape.surface(manifold=False)
    check_surface(split, shape)
    check_surface(merged, shape)
    assert split.is_closed
    assert split.is_oriented
    assert split.is_manifold
    assert set(side_counts(split).values()) <= {2}
    assert all(count % 2 == 0 for count in side_counts(merged).values())
    # Volumes of such clouds are exact: outer shells enclose something, cavities take away.
    np.testing.assert_array_equal(split.shells.volumes > 0, split.shells.is_outer)
    assert np.count_nonzero(split.shells.is_outer) == len(shape.regions)
    assert split.volume == pytest.approx(shape.volume)
    assert (split.shells.genera >= 0).all()


@given(shape=selections(), seed=st.integers(0, 1000))
@settings(max_examples=60, deadline=None)
def test_the_order_of_the_points_changes_nothing(shape, seed):
    order = np.random.default_rng(seed).permutation(len(shape.points))
    other = am.filtration(shape.points[order])
    wanted = {frozenset(map(tuple, shape.points[row].tolist())) for row in shape.tetrahedra}
    chosen = np.array(
        [
            frozenset(map(tuple, other.points[row].tolist())) in wanted
            for row in other.simplices[3]
        ],
        dtype=bool,
    )
    shuffled = am.Selection3D(other, 1.0, chosen).surface()
    surface = shape.surface()
    assert topology(shuffled) == topology(surface)
    assert sorted(map(tuple, shuffled.points.tolist())) == sorted(
        map(tuple, surface.points.tolist())
    )


@pytest.mark.parametrize(
    "points",
    [
        np.empty((0, 3)),
        np.zeros((4, 3)),
        lattice(5, 1, 1),
        lattice(4, 4, 1),
        lattice(2, 2, 2),
    ],
    ids=["none", "one", "line", "plane", "cube"],
)
def test_flat_clouds_have_an_empty_surface(points):
    shape = am.AlphaComplex(points).at(10.0)
    surface = shape.surface()
    check_surface(surface, shape)
    assert len(surface.triangles) == (12 if len(shape.tetrahedra) else 0)
    assert surface.is_closed
    assert surface.is_manifold
    assert surface.volume == pytest.approx(shape.volume)


@pytest.mark.parametrize("scale", [1e-40, 1e-9, 1e9, 1e40])
def test_scale_does_not_matter(scale):
    shape = am.AlphaComplex(scale * am.sample_solid("torus", 800, seed=1)).at(0.4 * scale)
    surface = shape.surface()
    check_surface(surface, shape)
    assert surface.shells.genera.tolist() == [1]
    assert surface.volume == pytest.approx(shape.volume, rel=1e-9)


def test_threads_do_not_matter():
    cx = am.AlphaComplex(am.sample_solid("hollow-torus", 20_000, seed=2))
    filtration, inside = cx.filtration, cx.radii[3] <= 0.04
    arrays = (
        filtration.points,
        filtration.simplices[3],
        filtration.simplices[2],
        filtration.triangle_tetrahedra,
        filtration.tetrahedron_triangles,
        inside,
    )
    one, *others = (surface3(*arrays, threads=threads) for threads in (1, 2, 4))
    assert len(one.rows) > len(np.unique(one.rows))
    for other in others:
        for left, right in zip(one, other, strict=True):
            np.testing.assert_array_equal(left, right)


# ---------------------------------------------------------------------- validators, records


def broken(surface, **changes):
    return replace(surface, **{k: np.ascontiguousarray(v) for k, v in changes.items()})


def test_the_validators_find_what_is_wrong():
    shape = cubes((1, 1, 1), (3, 3, 3))
    surface = shape.surface()
    check_surface(surface, shape)
    flipped = surface.triangles.copy()
    flipped[3] = flipped[3, ::-1]
    inverted = surface.triangles[:, ::-1]
    cases = {
        "other way": broken(surface, triangles=flipped),
        "counter-clockwise": broken(surface, triangles=inverted),
        "no such vertex": broken(surface, triangles=surface.triangles + np.int32(1)),
        "shell_labels": broken(surface, shell_labels=np.roll(surface.shell_labels, 1)),
        "other coordinates": broken(surface, points=surface.points + 1e-9),
    }
    for message, wrong in cases.items():
        with pytest.raises(InvalidResultError, match=f"{message}|volumes"):
            check_surface(wrong, shape)
    assert not cases["other way"].is_oriented
    assert not cases["other way"].is_manifold
    hole = surface.triangles[1:]
    opened = broken(
        surface,
        triangles=hole,
        facets=surface.facets[1:],
        shell_labels=surface.shell_labels[1:],
    )
    assert not opened.is_closed
    with pytest.raises(InvalidResultError, match="the other way"):
        check_surface(opened)
    merged = cubes((1, 1, 1), (2, 2, 1)).surface(manifold=False)
    with pytest.raises(InvalidResultError, match="more than two"):
        check_surface(replace(merged, is_split=True))
    touching = cubes((1, 1, 1), (2, 2, 2)).surface(manifold=False)
    with pytest.raises(InvalidResultError, match="several fans"):
        check_surface(replace(touching, is_split=True))


def test_shells_are_selected():
    surface = cubes((0, 0, 0), (2, 2, 2), (2, 2, 3)).surface()
    assert surface.shells.volumes == pytest.approx([2, 1])
    for chosen in (1, [1], np.array([False, True])):
        one = surface.select(chosen)
        assert one.volume == pytest.approx(1)
        assert len(one.points) == 8
        assert one.shell_labels.tolist() == [0] * 12
        check_surface(one)
    assert len(surface.select([]).triangles) == 0
    for wrong in ([2], [-1], [0.5], [True]):
        with pytest.raises(ParameterError, match="shells must be"):
            surface.select(wrong)


def test_surfaces_are_records():
    surface = cubes((0, 0, 0)).surface()
    assert copy.deepcopy(surface) is surface
    again = pickle.loads(pickle.dumps(surface))
    np.testing.assert_array_equal(again.triangles, surface.triangles)
    assert not again.points.flags.writeable
    assert "12 triangles, 1 shell" in repr(surface)
    assert "1 outer, 0 around" in repr(surface.shells)
    assert surface.euler_characteristic == 2
    assert len(surface.edges) == 18
    for array in (surface.points, surface.triangles, surface.facets, surface.edges):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 0


# ---------------------------------------------------------------------- scans


@pytest.mark.parametrize(
    "name", ["ball", "torus", "double-torus", "two-balls", "linked-rings", "trefoil"]
)
def test_a_scan_of_a_surface_becomes_that_surface(name):
    cx = am.AlphaComplex(am.sample_solid(name, 4000, seed=2, surface=True))
    choice = cx.choose_radius("enclosed")
    shape = cx.at(choice.radius).filtered(max_void_volume=np.inf)
    surface = shape.surface()
    check_surface(surface, shape)
    assert (
        tuple(sorted(surface.shells.genera.tolist(), reverse=True)) == DEMO_SOLIDS[name].genera
    )
    assert surface.shells.is_outer.all()
    # Hardly a point of the scan lies inside of its surface.
    assert len(surface.source_rows) > 0.97 * len(cx.points)
    before = np.nextafter(choice.radius, 0)
    left_out = cx.at(before).filtered(max_void_volume=np.inf)
    assert len(np.unique(left_out.tetrahedra)) < len(cx.points)
    assert "4,000 of the 4,000 points" in choice.reason


def test_scans_may_have_outliers():
    points = am.sample_solid("torus", 3000, seed=1, surface=True)
    cx = am.AlphaComplex(np.concatenate([points, [[3.0, 3.0, 3.0], [0.0, 0.0, 2.0]]]))
    whole = cx.choose_radius("enclosed").radius
    most = cx.choose_radius("enclosed", share=0.99).radius
    assert most < 0.3 < whole
    surface = cx.at(most).filtered(max_void_volume=np.inf, keep_largest=1).surface()
    assert surface.shells.genera.tolist() == [1]
    for share in (0, -1, 1.5, np.nan, "all"):
        with pytest.raises(ParameterError, match="share must be"):
            cx.choose_radius("enclosed", share=share)


def test_what_is_flat_encloses_nothing():
    for points in (lattice(3, 3, 1), lattice(3, 1, 1), np.zeros((2, 3))):
        choice = am.AlphaComplex(points).choose_radius("enclosed")
        assert choice.radius == 0
        assert "Nothing can be enclosed" in choice.reason
