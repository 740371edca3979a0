"""Shapes in space against their definition: kinds, measures, regions, voids, files."""

from __future__ import annotations

import math
import pickle
from collections import Counter
from fractions import Fraction
from itertools import combinations, permutations, product

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

import alphamesh as am
from alphamesh.check import check_filtration, check_shape
from alphamesh.errors import EmptyCloudError, FileWriteError, ParameterError
from alphamesh.io.meshes import read_mesh
from oracles3 import components, exact, sixfold_volume
from strategies3 import clouds3


@st.composite
def shapes3(draw):
    cx = am.AlphaComplex(draw(clouds3()))
    radius = draw(st.sampled_from([*cx.critical_radii().tolist(), 0.0, math.inf, 1.0]))
    return cx.at(draw(st.sampled_from([radius, math.nextafter(radius, 0), radius * 1.5])))


def blocks(cells):
    """Return the shape of unit cubes of voxels, and the cloud of all their corners."""
    corners = np.array(list(product(range(2), repeat=3)))
    points = np.unique((np.array(cells)[:, np.newaxis] + corners).reshape(-1, 3), axis=0)
    return am.AlphaComplex(points.astype(float))


# ------------------------------------------------------------- what is in it


@given(shapes3())
def test_kinds_boundary_and_measures_by_definition(shape):
    check_shape(shape)
    inside = [tuple(row) for row in np.sort(shape.tetrahedra, axis=1).tolist()]
    facets = Counter(face for row in inside for face in combinations(row, 3))
    once = {face for face, count in facets.items() if count == 1}
    boundary = shape.boundary_triangles.tolist()
    assert {tuple(sorted(row)) for row in boundary} == once
    assert len(boundary) == len(once)
    # The same number of facets runs either way along each edge.
    ways = Counter(pair for a, b, c in boundary for pair in ((a, b), (b, c), (c, a)))
    assert all(ways[a, b] == ways[b, a] for a, b in ways)
    if not boundary:
        assert shape.volume == shape.surface_area == 0
        return
    # By the divergence theorem, outward facets enclose the volume.
    place = exact(shape.points)
    origin = place[boundary[0][0]]
    enclosed = sum((sixfold_volume(origin, *(place[i] for i in row)) for row in boundary), 0)
    assert enclosed > 0
    assert abs(6 * Fraction(shape.volume) - enclosed) <= 1e-12 * enclosed


@given(shapes3())
def test_regions_and_voids_by_definition(shape):
    filtration = shape.filtration
    tetrahedra = filtration.simplices[3].tolist()
    inside = (filtration.radii[3] <= shape.radius).tolist()
    walls = {
        tuple(t)
        for t, r in zip(filtration.simplices[2].tolist(), filtration.radii[2], strict=True)
        if r <= shape.radius
    }
    owners = {}
    for number, row in enumerate(tetrahedra):
        for face in combinations(row, 3):
            owners.setdefault(face, []).append(number)
    everything, joins = len(tetrahedra), []
    for face, (one, *others) in owners.items():
        other = others[0] if others else everything
        both_in = inside[one] and bool(others) and inside[other]
        if both_in or face not in walls:
            joins.append((one, other))
    lowest = components(everything + 1, joins)
    volumes = filtration.tetrahedron_volumes
    parts = {}
    for number, part in enumerate(lowest[:-1]):
        if part != lowest[everything]:
            parts.setdefault(part, []).append(number)
    solid = [rows for rows in parts.values() if inside[rows[0]]]
    void = [rows for rows in parts.values() if not inside[rows[0]]]
    for found, expected, labels in (
        (shape.regions, solid, shape.regions.labels),
        (shape.voids, void, shape.voids.labels[shape.voids.labels >= 0]),
    ):
        sizes = sorted((float(volumes[rows].sum()) for rows in expected), reverse=True)
        np.testing.assert_allclose(found.volumes, sizes, rtol=1e-12)
        assert (np.diff(found.volumes) <= 0).all()
        assert sorted(found.tetrahedron_counts) == sorted(map(len, expected))
        assert np.bincount(labels, minlength=len(found)).tolist() == list(
            found.tetrahedron_counts
        )
    for rows in void:
        assert len(set(shape.voids.labels[rows].tolist())) == 1
    assert (np.count_nonzero(shape.voids.labels >= 0)) == sum(map(len, void))
    assert shape.regions.surface_areas.sum() == pytest.approx(shape.surface_area, rel=1e-12)


@given(shapes3())
def test_the_betti_numbers_of_gudhi(shape):
    gudhi = pytest.importorskip("gudhi")
    tree = gudhi.SimplexTree()
    for k, kinds in enumerate(shape.kinds):
        for row in shape.filtration.simplices[k][kinds > 0].tolist():
            tree.insert(row)
    tree.set_dimension(3)
    tree.compute_persistence(persistence_dim_max=True)
    betti = [*tree.betti_numbers(), 0, 0, 0][:3] if len(shape.points) else [0, 0, 0]
    assert shape.euler_characteristic == betti[0] - betti[1] + betti[2]
    assert len(shape.voids) == betti[2]


def test_shapes_whose_values_are_known():
    cube = am.AlphaComplex(np.array(list(product((0.0, 2.0), repeat=3))))
    assert cube.critical_radii().tolist() == pytest.approx([0, 1, math.sqrt(2), math.sqrt(3)])
    edges = cube.at(1.0)
    assert (edges.volume, len(edges.isolated_edges), len(edges.triangles)) == (0.0, 12, 0)
    assert edges.euler_characteristic == 8 - 12
    faces = cube.at(1.5)
    assert len(faces.singular_triangles) == 12 and len(faces.isolated_edges) == 0
    assert faces.voids.volumes.tolist() == pytest.approx([8.0])
    assert faces.voids.surface_areas.tolist() == pytest.approx([24.0])
    assert len(faces.regions) == 0 and faces.euler_characteristic == 2
    whole = cube.at(1.8)
    assert (whole.volume, whole.surface_area) == pytest.approx((8.0, 24.0))
    assert len(whole.boundary_triangles) == 12 and len(whole.voids) == 0
    assert whole.regions.centroids.tolist() == pytest.approx(np.ones((1, 3)))
    assert whole.euler_characteristic == 1
    assert repr(edges) == "<AlphaShape3D at radius 1: 0 tetrahedra, 12 isolated edges>"
    assert repr(whole.regions) == "<Regions3D: 1, with 6 tetrahedra>"


def shell(n, rng, low=0.8):
    directions = rng.standard_normal((n, 3))
    directions /= np.linalg.norm(directions, axis=1)[:, np.newaxis]
    return directions * rng.uniform(low**3, 1, (n, 1)) ** (1 / 3)


@pytest.fixture(name="two", scope="module")
def make_two():
    """A hollow ball and a full one beside it."""
    rng = np.random.default_rng(3)
    full = shell(800, rng, 0.0) * 0.5 + [3, 0, 0]
    return am.AlphaComplex(np.concatenate([shell(4000, rng), full])).at(0.16)


def test_a_hollow_ball_and_a_full_one(two):
    assert len(two.regions) == 2 and len(two.voids) == 1
    # Samples lie inside of what they are drawn from: solids come out small, voids large.
    thick = 4 / 3 * math.pi * (1 - 0.8**3)
    assert 0.7 * thick < two.regions.volumes[0] < thick
    assert 0.7 * math.pi / 6 < two.regions.volumes[1] < math.pi / 6
    hollow = 4 / 3 * math.pi * 0.8**3
    assert hollow < two.voids.volumes[0] < 1.2 * hollow
    assert two.voids.surface_areas[0] == pytest.approx(4 * math.pi * 0.64, rel=0.25)
    np.testing.assert_allclose(two.regions.centroids, [[0, 0, 0], [3, 0, 0]], atol=0.03)
    assert two.volume == pytest.approx(two.regions.volumes.sum())
    assert two.surface_area == pytest.approx(two.regions.surface_areas.sum())
    labels = two.regions.vertex_labels
    assert set(labels[:4000]) == {0} and set(labels[4000:]) == {1}


def test_regions_and_voids_are_chosen_by_size(two):
    filled = two.filtered(max_void_volume=math.inf)
    assert len(filled.voids) == 0 and len(filled.regions) == 2
    assert filled.volume == pytest.approx(two.volume + two.voids.volumes[0])
    assert two.filtered(max_void_volume=0.1).volume == pytest.approx(two.volume)
    ball = two.filtered(min_region_volume=1)
    assert len(ball.regions) == 1 and len(ball.voids) == 1
    assert ball.volume == pytest.approx(two.regions.volumes[0])
    solid = two.filtered(max_void_volume=math.inf, keep_largest=1)
    assert solid.euler_characteristic == 1 and len(solid.regions) == 1
    assert len(solid.singular_triangles) == len(solid.isolated_edges) == 0
    assert len(two.filtered(keep_largest=0).tetrahedra) == 0
    second = two.select([1])
    assert second.volume == pytest.approx(two.regions.volumes[1])
    assert np.array_equal(second.tetrahedra, two.select([False, True]).tetrahedra)
    assert second.filtered().tetrahedra.tolist() == second.tetrahedra.tolist()
    assert repr(second).startswith("<Selection3D: ")
    again = pickle.loads(pickle.dumps(second))
    assert np.array_equal(again.boundary_triangles, second.boundary_triangles)


@given(shapes3())
def test_a_selection_of_everything_is_the_regularized_shape(shape):
    chosen = shape.filtered()
    for name in ("tetrahedra", "boundary_triangles", "interior_triangles", "interior_edges"):
        assert np.array_equal(getattr(chosen, name), getattr(shape, name))
    for name in ("regular_edges", "regular_vertices", "interior_vertices"):
        assert np.array_equal(getattr(chosen, name), getattr(shape, name))
    for name in ("singular_triangles", "singular_edges", "isolated_edges"):
        assert len(getattr(chosen, name)) == 0
    assert chosen.volume == shape.volume and chosen.surface_area == shape.surface_area
    assert chosen.counts["edges"] == len(chosen.edges)


def test_wrong_choices_say_so(two):
    for options, text in (
        ({"min_region_volume": -1}, "min_region_volume must be 0 or more, in cubed units"),
        ({"max_void_volume": math.nan}, "max_void_volume must be 0 or more"),
        ({"keep_largest": 1.5}, "keep_largest must be a whole number"),
    ):
        with pytest.raises(ParameterError, match=text):
            two.filtered(**options)
    with pytest.raises(ParameterError, match="numbers from 0 to 1, or 2 truth values"):
        two.select([2])
    with pytest.raises(ParameterError, match=r"has_tetrahedron must be .* one for each"):
        am.Selection3D(two.filtration, 1.0, np.ones(3, dtype=bool))
    for radius in (-1, math.nan, "large"):
        with pytest.raises(ParameterError, match="radius must be"):
            am.AlphaShape3D(two.filtration, radius)


def test_regions_that_touch_at_an_edge_or_a_point_are_two():
    # Cubes that share an edge, then a corner only; the corners' tetrahedra fill cubes.
    for touch in ((1, 1, 0), (1, 1, 1)):
        cx = blocks([(0, 0, 0), touch])
        middles = np.floor(cx.points[cx.simplices[3]].mean(axis=1))
        cubes = (middles == 0).all(axis=1) | (middles == touch).all(axis=1)
        shape = am.Selection3D(cx.filtration, 0.9, cubes)
        assert shape.volume == pytest.approx(2)
        assert shape.regions.volumes.tolist() == pytest.approx([1, 1])
        assert shape.surface_area == pytest.approx(12)
        common = [i for i, p in enumerate(cx.points) if (shape.regions.vertex_labels[i] == 0)]
        assert len(common) == 8


def test_duplicates_have_the_labels_of_their_representatives(two):
    twice = am.AlphaComplex(np.concatenate([two.points, two.points[::-1]])).at(two.radius)
    labels, count = twice.regions.vertex_labels, len(two.points)
    assert np.array_equal(labels[:count], two.regions.vertex_labels)
    assert np.array_equal(labels[:count], labels[count:][::-1])
    assert twice.counts == two.counts


def test_orders_and_scales_do_not_matter(two):
    shuffle = np.random.default_rng(0).permutation(len(two.points))
    other = am.AlphaComplex(two.points[shuffle] * 2.0**-40).at(two.radius * 2.0**-40)
    assert other.counts == two.counts
    assert other.volume == pytest.approx(two.volume * 2.0**-120)
    back = np.sort(shuffle[other.tetrahedra], axis=1)
    assert {tuple(r) for r in back.tolist()} == {
        tuple(r) for r in np.sort(two.tetrahedra, axis=1).tolist()
    }


@pytest.mark.parametrize("axes", list(permutations(range(3)))[::2])
def test_clouds_in_a_plane_and_on_a_line(axes):
    flat = np.zeros((30, 3))
    flat[:, :2] = np.random.default_rng(4).random((30, 2))
    shape = am.AlphaComplex(flat[:, axes]).at(0.2)
    plane = am.AlphaComplex(flat[:, :2]).at(0.2)
    check_filtration(shape.filtration)
    check_shape(shape)
    assert len(shape.singular_triangles) == len(plane.triangles) > 0
    assert len(shape.isolated_edges) == len(plane.singular_edges)
    assert len(shape.isolated_vertices) == len(plane.isolated_vertices)
    assert shape.volume == 0 and len(shape.regions) == len(shape.voids) == 0
    line = am.AlphaComplex(np.arange(4.0)[:, np.newaxis] * [1, 2, 2]).at(1.5)
    assert len(line.isolated_edges) == 3 and line.euler_characteristic == 1


@given(clouds3())
def test_measure_curves_are_those_of_shapes(points):
    cx = am.AlphaComplex(points)
    curves = cx.measure_curves()
    radii = np.unique([0.0, 1.0, np.inf, *cx.critical_radii(), *cx.critical_radii() * 0.9])
    shapes = [cx.at(radius) for radius in radii]
    largest = cx.filtration.tetrahedron_volumes.max(initial=0.0)
    for name, slack in (("volume", 1e-13 * largest), ("surface_area", 0.0)):
        expected = np.array([getattr(shape, name) for shape in shapes])
        widest = cx.filtration.triangle_areas.max(initial=0.0)
        np.testing.assert_allclose(
            getattr(curves, name)(radii), expected, rtol=1e-12, atol=slack + 1e-25 * widest
        )
    for name in ("edge", "triangle", "tetrahedron"):
        plural = {"tetrahedron": "tetrahedra"}.get(name, f"{name}s")
        expected = [shape.counts[plural] for shape in shapes]
        assert getattr(curves, f"{name}_count")(radii).tolist() == expected
    euler = [shape.euler_characteristic for shape in shapes]
    assert curves.euler_characteristic(radii).tolist() == euler
    with pytest.raises(ParameterError):
        curves.volume(-1.0)


# ------------------------------------------------------------- rules


def test_rules_that_choose_a_radius(two):
    cx = am.AlphaComplex(two.points)
    choice = cx.choose_radius("all-points")
    row = int(np.argmax(cx.filtration.vertex_intervals.regular_from))
    assert f"row {row} at (" in choice.reason and "tetrahedron" in choice.reason
    at, below = cx.at(choice.radius), cx.at(math.nextafter(choice.radius, 0))
    assert len(np.unique(at.tetrahedra)) == len(cx.points)
    assert len(np.unique(below.tetrahedra)) < len(cx.points)
    assert cx.at().radius == cx.choose_radius().radius
    for rule, options, most in (("one-region", {}, 1), ("regions", {"regions": 2}, 2)):
        radius = cx.choose_radius(rule, **options).radius
        assert len(cx.at(radius).regions) <= most and radius >= choice.radius
        if radius > choice.radius:
            assert len(cx.at(math.nextafter(radius, 0)).regions) > most
    found = cx.at(cx.choose_radius("tetrahedron-count", tetrahedra=5000).radius)
    assert len(found.tetrahedra) == 5000
    with pytest.raises(ParameterError, match="more than the"):
        cx.choose_radius("tetrahedron-count", tetrahedra=10**6)
    with pytest.raises(ParameterError, match=r"did you mean 'tetrahedron-count'"):
        cx.choose_radius("tetrahedra-count")
    with pytest.raises(EmptyCloudError):
        am.AlphaComplex(np.empty((0, 3))).at()


@given(clouds3())
def test_rules_on_every_cloud(points):
    assume(len(points))
    cx = am.AlphaComplex(points)
    everything = cx.choose_radius("all-points").radius
    cells = {0: "isolated_vertices", 1: "edges", 2: "triangles", 3: "tetrahedra"}
    there = getattr(cx.at(everything), cells[cx.dimension])
    assert len(np.unique(there)) == len(cx.simplices[0])
    one = cx.choose_radius("one-region")
    assert one.radius >= everything
    if cx.dimension == 3:
        assert len(cx.at(one.radius).regions) == 1
    elif cx.dimension == 2:
        assert "in one plane, so there are no tetrahedra" in one.reason
        plane = np.argsort(np.ptp(points, axis=0))[1:]
        if len(set(map(tuple, points[:, plane].tolist()))) == len(cx.simplices[0]):
            assert cx.at(one.radius).counts["triangles"] > 0


def test_pieces_in_a_plane_are_joined_across_edges():
    flat = np.array([[0, 0], [1, 0], [0, 1], [1, 1], [4, 0], [5, 0], [4, 1], [5, 1]], float)
    inside = am.AlphaComplex(np.insert(flat, 1, 7.0, axis=1)).choose_radius("one-region")
    assert inside.radius == am.AlphaComplex(flat).choose_radius("one-region").radius


# ------------------------------------------------------------- files


def test_meshes_hold_what_is_there_once(two):
    mesh = two.mesh()
    assert {kind: len(rows) for kind, rows in mesh.cells.items()} == {
        "vertex": two.counts["isolated_vertices"],
        "line": two.counts["isolated_edges"],
        "triangle": two.counts["singular_triangles"],
        "tetra": two.counts["tetrahedra"],
    }
    assert max(values.max(initial=0) for values in mesh.cell_data["radius"].values()) <= 0.16
    surface = two.mesh(surface=True)
    count = two.counts["regular_triangles"] + two.counts["singular_triangles"]
    assert len(surface.cells["triangle"]) == count and "tetra" not in surface.cells


@pytest.mark.parametrize("extension", [".vtu", ".vtk", ".msh", ".npz"])
def test_volume_formats_hold_the_tetrahedra(two, extension, tmp_path):
    if extension != ".npz":
        pytest.importorskip("meshio")
    path = tmp_path / f"two{extension}"
    two.save(path)
    back = read_mesh(path)
    corners = back.points[back.cells["tetra"]]
    assert np.array_equal(corners, two.points[two.tetrahedra])
    volumes = np.einsum(
        "ij,ij->i",
        np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]),
        corners[:, 3] - corners[:, 0],
    )
    assert (volumes > 0).all()
    values = back.cell_data["radius"]["tetra"]
    assert np.array_equal(values, two.filtration.radii[3][two.filtration.radii[3] <= 0.16])


@pytest.mark.parametrize("extension", [".ply", ".stl", ".off", ".obj"])
def test_surface_formats_hold_the_boundary(two, extension, tmp_path):
    pytest.importorskip("meshio")
    path = tmp_path / f"two{extension}"
    ball = two.filtered(keep_largest=1)
    ball.save(path)
    back = read_mesh(path)
    corners = back.points[back.cells["triangle"]]
    assert len(corners) == ball.counts["regular_triangles"]
    signed = np.einsum("ij,ij->i", np.cross(corners[:, 0], corners[:, 1]), corners[:, 2])
    assert signed.sum() / 6 == pytest.approx(ball.volume, rel=1e-5)
    with pytest.raises(FileWriteError, match="no mesh format"):
        ball.save(tmp_path / "ball.xyz")
