"""The interfaces of other libraries in space: the same results as theirs."""

from __future__ import annotations

import math

import numpy as np
import pytest

import alphamesh as am
from alphamesh import migrate
from alphamesh.errors import CloudShapeError, DimensionError, ParameterError

RNG = np.random.default_rng(20261123)
CLOUDS = [RNG.random((int(n), 3)) for n in RNG.integers(5, 60, 20)]


def rows_of(table):
    return sorted(map(tuple, np.sort(np.asarray(table), axis=1).tolist()))


class TestDelaunay:
    @pytest.fixture
    def peer(self):
        return pytest.importorskip("scipy.spatial").Delaunay

    @pytest.mark.parametrize("points", CLOUDS[:8], ids=len)
    def test_the_same_as_in_scipy(self, peer, points):
        mine, theirs = migrate.Delaunay(points), peer(points)
        assert rows_of(mine.simplices) == rows_of(theirs.simplices)
        assert rows_of(mine.convex_hull) == rows_of(theirs.convex_hull)
        assert (mine.ndim, mine.npoints, mine.nsimplex) == (
            theirs.ndim,
            theirs.npoints,
            theirs.nsimplex,
        )
        np.testing.assert_array_equal(mine.min_bound, theirs.min_bound)
        np.testing.assert_array_equal(mine.max_bound, theirs.max_bound)
        queries = RNG.uniform(-0.2, 1.2, (4, 50, 3))
        found, expected = mine.find_simplex(queries), theirs.find_simplex(queries)
        assert found.shape == expected.shape
        np.testing.assert_array_equal(found < 0, expected < 0)
        inside = found >= 0
        assert (
            np.sort(mine.simplices[found[inside]], axis=1)
            == np.sort(theirs.simplices[expected[inside]], axis=1)
        ).all()
        for made in (mine, theirs):
            indptr, _ = made.vertex_neighbor_vertices
            assert indptr.shape == (len(points) + 1,)
        for row in range(len(points)):
            (a, i), (b, k) = mine.vertex_neighbor_vertices, theirs.vertex_neighbor_vertices
            assert set(i[a[row] : a[row + 1]]) == set(k[b[row] : b[row + 1]])

    @pytest.mark.parametrize("points", CLOUDS[:4], ids=len)
    def test_orientation_and_neighbours(self, points):
        mine = migrate.Delaunay(points)
        a, b, c, d = (points[mine.simplices[:, k]] for k in range(4))
        assert (np.linalg.det(np.stack((b - a, c - a, d - a), axis=1)) > 0).all()
        for t, cell in enumerate(mine.simplices):
            for corner, other in enumerate(mine.neighbors[t]):
                if other >= 0:
                    common = set(cell) & set(mine.simplices[other])
                    assert common == set(np.delete(cell, corner))
        p, q, r = (points[mine.convex_hull[:, k]] for k in range(3))
        volume = np.einsum("ij,ij->i", p, np.cross(q, r)).sum() / 6
        assert volume == pytest.approx(am.delaunay(points).convex_hull.volume)

    def test_duplicates_and_clouds_without_volume(self):
        cube = np.array(np.meshgrid([0, 1], [0, 1], [0, 1])).reshape(3, -1).T.astype(float)
        mine = migrate.Delaunay(np.concatenate([cube, cube[:2]]))
        assert mine.coplanar[:, [0, 2]].tolist() == [[8, 0], [9, 1]]
        assert all(same in mine.simplices[cell] for _, cell, same in mine.coplanar)
        assert mine.vertex_to_simplex[8:].tolist() == [-1, -1]
        assert all(row in mine.simplices[mine.vertex_to_simplex[row]] for row in range(8))
        with pytest.raises(CloudShapeError, match="in one plane"):
            migrate.Delaunay(cube * [1, 1, 0])
        with pytest.raises(CloudShapeError, match="three columns"):
            mine.find_simplex([[0, 0]])


@pytest.mark.filterwarnings("ignore:the matrix subclass")
class TestAlphashape:
    @pytest.fixture
    def peer(self):
        pytest.importorskip("trimesh")
        return pytest.importorskip("alphashape").alphashape

    @pytest.mark.parametrize("points", CLOUDS, ids=len)
    def test_the_same_triangles_as_in_alphashape(self, peer, points):
        for alpha in (1.5, 3.0, 5.0):
            mine = migrate.alphashape(points, alpha)
            shape = am.AlphaComplex(points).at(math.nextafter(1 / alpha, 0))
            assert len(mine.faces) == len(shape.boundary_triangles)
            if len(mine.faces) == 0:
                continue  # alphashape fails there
            theirs = peer(points, alpha)
            assert type(mine) is type(theirs)
            assert facets(mine) == facets(theirs)
            assert mine.volume == pytest.approx(shape.volume)

    def test_the_chosen_one_holds_all_points(self):
        pytest.importorskip("trimesh")
        points = am.sample_solid("torus", 400, seed=0)
        mesh = migrate.alphashape(points)
        cx = am.AlphaComplex(points)
        best = cx.at(cx.choose_radius("one-region").radius)
        assert mesh.volume == pytest.approx(best.volume) and len(best.regions) == 1
        assert best.contains(points).all()
        assert migrate.optimizealpha(points) == pytest.approx(1 / best.radius)
        tighter = migrate.alphashape(points, migrate.optimizealpha(points) * (1 + 1e-9))
        assert tighter.volume < mesh.volume

    def test_hulls_and_few_points(self, peer):
        points = CLOUDS[0]
        hull = migrate.alphashape(points, 0)
        assert hull.is_watertight
        assert hull.volume == pytest.approx(am.delaunay(points).convex_hull.volume)
        assert len(migrate.alphashape(points, 1e9).faces) == 0
        for few in (points[:1], points[:2], points[:3]):
            assert migrate.alphashape(few, 1.0).equals(peer(few, 1.0))
        assert migrate.optimizealpha(points * [1, 1, 0]) == 0.0
        with pytest.raises(ParameterError, match="one over the radius"):
            migrate.alphashape(points, "2")


def facets(mesh):
    """Return the triangles of a mesh as sets of corners."""
    corners = np.asarray(mesh.vertices)[np.asarray(mesh.faces)]
    return sorted(sorted(map(tuple, triangle)) for triangle in corners.tolist())


class TestMatlab:
    def test_a_cube_with_a_cavity(self):
        inside = np.array(np.meshgrid(*[np.arange(5.0)] * 3)).reshape(3, -1).T
        points = inside[(inside != 2).any(axis=1)]
        shp = migrate.alphaShape(points, 0.9)
        assert shp.volume() == pytest.approx(64 - 4 / 3)
        assert shp.surfaceArea() == pytest.approx(96 + 8 * math.sqrt(3) / 2)
        assert shp.numRegions() == 1
        assert shp.inShape([[2, 2, 2], [0.5, 0.5, 0.5], [9, 9, 9]]).tolist() == [
            False,
            True,
            False,
        ]
        shp.HoleThreshold = 1.4
        assert shp.volume() == pytest.approx(64) and shp.inShape([[2, 2, 2]]).all()
        facets, corners = shp.boundaryFacets()
        a, b, c = (corners[facets[:, k]] for k in range(3))
        assert np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6 == pytest.approx(64)
        assert len(shp.alphaTriangulation()) == len(shp.alphaTriangulation(0)) > 0
        assert shp.alphaTriangulation().shape[1] == 4
        shp.RegionThreshold = 65
        assert shp.numRegions() == 0 and shp.volume() == 0

    def test_critical_radii_and_spectrum(self):
        points = am.sample_solid("two-balls", 500, seed=2)
        shp = migrate.alphaShape(points)
        cx = am.AlphaComplex(points)
        assert shp.Alpha == cx.choose_radius("all-points").radius
        shp.Alpha = shp.criticalAlpha("one-region")
        assert shp.numRegions() == 1 and shp.Alpha == cx.choose_radius("one-region").radius
        spectrum = shp.alphaSpectrum()
        np.testing.assert_array_equal(spectrum, np.unique(cx.radii[3])[::-1])
        below = spectrum[np.flatnonzero(spectrum == shp.Alpha)[0] + 1]
        assert migrate.alphaShape(points, below).numRegions() > 1

    def test_nearest_neighbours_are_corners_of_the_boundary(self):
        points = am.sample_solid("ball", 300, seed=3)
        shp = migrate.alphaShape(points)
        queries = RNG.uniform(-2, 2, (40, 3))
        rows, distances = shp.nearestNeighbor(queries)
        corners = np.unique(shp.boundaryFacets()[0])
        apart = np.linalg.norm(queries[:, np.newaxis] - points[corners], axis=2)
        np.testing.assert_allclose(distances, apart.min(axis=1), rtol=1e-12)
        np.testing.assert_array_equal(rows, corners[apart.argmin(axis=1)])

    def test_what_is_of_the_other_dimension(self):
        solid, flat = migrate.alphaShape(CLOUDS[0]), migrate.alphaShape(CLOUDS[0][:, :2])
        for shp, names in ((solid, ("area", "perimeter")), (flat, ("volume", "surfaceArea"))):
            for name in names:
                with pytest.raises(DimensionError, match="take "):
                    getattr(shp, name)()
        sheet = migrate.alphaShape(CLOUDS[0] * [1, 1, 0], 1.0)
        assert sheet.volume() == 0 and sheet.numRegions() == 0
        with pytest.raises(ParameterError, match="larger Alpha"):
            sheet.nearestNeighbor([[0, 0, 0]])
