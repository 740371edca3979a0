"""The interfaces of other libraries: the same results as theirs, but for known differences."""

from __future__ import annotations

import itertools
import math
import warnings

import numpy as np
import pytest
from hypothesis import given, settings

import alphamesh as am
from alphamesh import migrate
from alphamesh.errors import CloudShapeError, ParameterError
from strategies import clouds

shapely = pytest.importorskip("shapely")

RNG = np.random.default_rng(20261122)
RANDOM = [(RNG.random((RNG.integers(4, 60), 2)), RNG.uniform(0.5, 12)) for _ in range(40)]


def ours(points, alpha, **options):
    """Return the shape of radii below 1 / alpha."""
    return am.AlphaComplex(points).at(math.nextafter(1 / alpha, 0)).filtered(**options)


@pytest.mark.filterwarnings("ignore:the matrix subclass")
class TestAlphashape:
    def test_the_same_once_holes_are_filled(self):
        peer = pytest.importorskip("alphashape")
        for points, alpha in RANDOM:
            theirs = peer.alphashape(points, alpha)
            filled = ours(points, alpha, max_hole_area=np.inf).geometry()
            assert theirs.symmetric_difference(filled).area < 1e-12
            mine = migrate.alphashape(points, alpha)
            assert mine.equals(ours(points, alpha).geometry())

    def test_the_chosen_one_holds_all_points_in_one_piece(self):
        for points, _ in RANDOM:
            shape = migrate.alphashape(points)
            assert shape.geom_type == "Polygon"
            assert shapely.covers(shape, shapely.points(points)).all()
            tighter = migrate.alphashape(points, migrate.optimizealpha(points) * (1 + 1e-9))
            assert tighter.area < shape.area

    def test_holes_are_kept(self):
        ring = am.demo_cloud("annulus", 800, seed=1)
        peer = pytest.importorskip("alphashape")
        radius = am.AlphaComplex(ring).choose_radius().radius
        mine, theirs = (f(ring, 1 / radius) for f in (migrate.alphashape, peer.alphashape))
        assert len(mine.interiors) == 1 and len(theirs.interiors) == 0
        assert shapely.Polygon(mine.exterior).area == pytest.approx(theirs.area)

    def test_few_points_and_convex_hulls(self):
        peer = pytest.importorskip("alphashape")
        for points in ([[1, 2]], [[1, 2], [3, 4]], [[0, 0], [1, 0], [0, 1]]):
            assert migrate.alphashape(points, 1.0).equals(peer.alphashape(points, 1.0))
        for alpha in (0, -1):
            points = RANDOM[0][0]
            assert migrate.alphashape(points, alpha).equals(peer.alphashape(points, alpha))
        assert migrate.alphashape(RANDOM[0][0], 1e9).is_empty
        line = migrate.alphashape([[0, 0], [1, 1], [2, 2], [5, 5]])
        assert line.equals(shapely.LineString([(0, 0), (5, 5)]))

    def test_frames_keep_their_reference_system(self):
        geopandas = pytest.importorskip("geopandas")
        points = RANDOM[0][0]
        frame = geopandas.GeoDataFrame(geometry=geopandas.points_from_xy(*points.T), crs=25832)
        found = migrate.alphashape(frame, 2.0)
        assert found.crs == frame.crs
        assert found.geometry[0].equals(migrate.alphashape(points, 2.0))
        assert migrate.alphashape(shapely.MultiPoint(points), 2.0).equals(found.geometry[0])

    @pytest.mark.parametrize("alpha", ["2", math.nan, lambda *_: 1])
    def test_other_alphas_are_refused(self, alpha):
        with pytest.raises(ParameterError, match="one over the radius"):
            migrate.alphashape(RANDOM[0][0], alpha)


class TestLibpysal:
    @pytest.fixture
    def peer(self):
        pytest.importorskip("geopandas")
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            peer = pytest.importorskip("libpysal.cg.alpha_shapes")
            yield peer

    def test_the_same_but_for_enclosed_gaps(self, peer):
        gaps = 0
        for points, alpha in RANDOM:
            shape = ours(points, alpha)
            open_gap = shape.holes.areas[shape.holes.regions < 0].sum()
            theirs = peer.alpha_shape(points, alpha)
            mine = migrate.alpha_shape(points, alpha)
            assert theirs.area.sum() == pytest.approx(mine.area.sum() + open_gap)
            assert mine.union_all().difference(theirs.union_all()).area < 1e-12
            gaps += open_gap > 0
        assert 0 < gaps < len(RANDOM)

    def test_the_tightest_polygon(self, peer):
        for points, _ in RANDOM:
            scaled = points * 1024  # its steps are right at radii above 1
            theirs, their_radius = peer.alpha_shape_auto(scaled, return_radius=True)
            mine, radius = migrate.alpha_shape_auto(scaled, return_radius=True)
            assert radius == pytest.approx(their_radius)
            assert mine.symmetric_difference(theirs).area < 1e-6
            assert mine.geom_type == "Polygon" and len(mine.interiors) == 0

    def test_few_points(self, peer):
        triangle = np.array([[0, 0], [1, 0], [0, 1.0]])
        assert migrate.alpha_shape_auto(triangle).equals(peer.alpha_shape_auto(triangle))
        assert migrate.alpha_shape_auto(triangle[:2]).is_empty
        assert len(migrate.alpha_shape(triangle[:2], 1.0)) == 0
        assert migrate.alpha_shape_auto([[0, 0], [1, 1], [3, 3], [4, 4]]).is_empty

    def test_says_what_it_chose(self, capsys):
        points = RANDOM[0][0]
        _, radius = migrate.alpha_shape_auto(points, 5, True, True)
        assert capsys.readouterr().out == f"radius {radius:.6g}, alpha {1 / radius:.6g}\n"

    @settings(max_examples=60)
    @given(clouds())
    def test_the_radius_is_that_of_its_definition(self, points):
        cx = am.AlphaComplex(points)
        best = 0.0
        for radius in np.unique(cx.radii[2])[::-1].tolist():
            shape = cx.at(radius)
            alone = len(shape.regions) == 1 and shape.regions.hole_counts[0] == 0
            if not (alone and len(np.unique(shape.triangles)) == len(cx.simplices[0])):
                break
            best = radius
        assert migrate.alpha_shape_auto(points, return_radius=True)[1] == best


class TestDelaunay:
    def peers(self, points):
        spatial = pytest.importorskip("scipy.spatial")
        return migrate.Delaunay(points), spatial.Delaunay(points)

    def test_the_same_triangles_and_answers(self):
        for points, _ in RANDOM[:12]:
            mine, theirs = self.peers(points)
            sets = [{frozenset(t) for t in d.simplices.tolist()} for d in (mine, theirs)]
            assert sets[0] == sets[1] and mine.nsimplex == theirs.nsimplex
            hulls = [{frozenset(e) for e in d.convex_hull.tolist()} for d in (mine, theirs)]
            assert hulls[0] == hulls[1]
            queries = RNG.uniform(-0.2, 1.2, (5, 10, 2))
            at, at_theirs = (d.find_simplex(queries) for d in (mine, theirs))
            assert at.shape == (5, 10) and ((at < 0) == (at_theirs < 0)).all()
            for i, j in zip(at.ravel(), at_theirs.ravel(), strict=True):
                assert i < 0 or set(mine.simplices[i]) == set(theirs.simplices[j])
            (starts, found), (their_starts, their_found) = (
                d.vertex_neighbor_vertices for d in (mine, theirs)
            )
            assert starts.tolist() == their_starts.tolist()
            for i, j in itertools.pairwise(starts.tolist()):
                assert set(found[i:j]) == set(their_found[i:j])
            for k, t in enumerate(mine.vertex_to_simplex):
                assert k in mine.simplices[t]
            assert (mine.min_bound == theirs.min_bound).all() and mine.ndim == theirs.ndim
            assert (mine.max_bound == theirs.max_bound).all() and mine.npoints == len(points)

    def test_triangles_turn_left_and_know_their_neighbours(self):
        made = migrate.Delaunay(RANDOM[3][0])
        a, b, c = (made.points[made.simplices[:, k]] for k in range(3))
        (ux, uy), (vx, vy) = (b - a).T, (c - a).T
        assert (ux * vy - uy * vx > 0).all()
        for t, row in enumerate(made.neighbors.tolist()):
            for k, other in enumerate(row):
                if other >= 0:
                    opposite = set(made.simplices[t].tolist()) - {made.simplices[t, k]}
                    assert opposite < set(made.simplices[other].tolist())
                    assert t in made.neighbors[other]

    def test_duplicates_are_coplanar(self):
        points = [[0, 0], [1, 0], [0, 1], [1, 0], [1, 0]]
        mine, theirs = self.peers(points)
        assert mine.coplanar[:, [0, 2]].tolist() == [[3, 1], [4, 1]]
        assert len(theirs.coplanar) == 2
        assert mine.vertex_to_simplex.tolist() == [0, 0, 0, -1, -1]

    def test_points_on_a_line_are_refused(self):
        with pytest.raises(CloudShapeError, match="on one line"):
            migrate.Delaunay([[0, 0], [1, 1], [2, 2]])
        with pytest.raises(CloudShapeError, match=r"two columns.*\(3,\)"):
            migrate.Delaunay([[0, 0], [1, 0], [0, 1]]).find_simplex([1, 2, 3])


class TestMatlab:
    def test_a_square_and_a_point(self):
        shp = migrate.alphaShape([[0, 0], [2, 0], [0, 2], [2, 2], [9, 1]], 1.5)
        assert (shp.area(), shp.perimeter(), shp.numRegions(), shp.Alpha) == (4, 8, 1, 1.5)
        assert shp.inShape([[1, 1], [2, 2], [5, 1]]).tolist() == [True, True, False]
        edges, points = shp.boundaryFacets()
        steps = points[edges[:, 1]] - points[edges[:, 0]]
        assert len(edges) == 4 and np.abs(steps).sum() == 8
        assert sorted(shp.alphaTriangulation().ravel().tolist()).count(4) == 0
        rows, distances = shp.nearestNeighbor([[9, 1], [-1, 0], [1.5, 0.1]])
        assert rows.tolist() in ([1, 0, 1], [3, 0, 1])
        assert distances.tolist() == pytest.approx([math.hypot(7, 1), 1, math.hypot(0.5, 0.1)])
        assert "5 points, Alpha 1.5, 1 region>" in repr(shp)

    def test_the_radius_can_be_set(self):
        points = am.demo_cloud("islands", 900, seed=2)
        shp = migrate.alphaShape(points)
        all_points, one = (shp.criticalAlpha(w) for w in ("all-points", "one-region"))
        assert shp.Alpha == all_points and shp.inShape(points).all()
        shp.Alpha = one
        assert shp.numRegions() == 1
        shp.Alpha = np.inf
        assert shp.area() == pytest.approx(am.convex_hull(points).area)
        spectrum = shp.alphaSpectrum()
        assert (np.diff(spectrum) < 0).all() and all_points in spectrum
        shp.Alpha = 0
        assert shp.numRegions() == 0 and shp.area() == 0
        with pytest.raises(ParameterError, match="no boundary"):
            shp.nearestNeighbor([[0, 0]])
        with pytest.raises(ParameterError, match="0 or more"):
            shp.Alpha = -1
        assert shp.Alpha == 0

    def test_thresholds(self):
        points = am.demo_cloud("target", 2500, seed=1)
        shp = migrate.alphaShape(points, am.AlphaComplex(points).choose_radius().radius)
        assert shp.numRegions() == 3
        areas = [shp.area(k) for k in range(3)]
        assert areas == sorted(areas, reverse=True) and sum(areas) == pytest.approx(shp.area())
        assert shp.perimeter(2) < shp.perimeter(0)
        shp.RegionThreshold = (areas[1] + areas[2]) / 2
        assert shp.numRegions() == 2
        shp.HoleThreshold = np.inf
        assert shp.numRegions() == 1 and shp.area() > sum(areas)
        assert (shp.HoleThreshold, shp.RegionThreshold) == (np.inf, (areas[1] + areas[2]) / 2)
        assert shp.inShape(points[:5], 0).all()
        with pytest.raises(ParameterError, match="max_hole_area"):
            shp.HoleThreshold = -1
        assert shp.HoleThreshold == np.inf

    def test_degenerate_points(self):
        assert migrate.alphaShape(np.empty((0, 2))).numRegions() == 0
        assert migrate.alphaShape([[0, 0], [1, 1], [2, 2]]).area() == 0
        with pytest.raises(ParameterError, match="type must be one of"):
            migrate.alphaShape([[0, 0]]).criticalAlpha("all")


class TestOpen3D:
    def facets(self, points, alpha):
        """Return the triangles of one filled tetrahedron, by definition."""
        spatial = pytest.importorskip("scipy.spatial")
        found = {}
        for corners in spatial.Delaunay(points).simplices:
            a, *rest = points[corners]
            sides = np.array(rest) - a
            centre = np.linalg.solve(2 * sides, (sides**2).sum(axis=1))
            if np.linalg.norm(centre) <= alpha:
                for facet in itertools.combinations(sorted(corners.tolist()), 3):
                    found[facet] = found.get(facet, 0) + 1
        return {facet for facet, times in found.items() if times == 1}

    def test_the_surface_of_the_filled_tetrahedra(self):
        class Cloud:  # as that of Open3D has it
            points = RNG.random((80, 3)).tolist()

        points = np.array(Cloud.points)
        for alpha in (0.12, 0.2, 0.5, 9):
            mesh = migrate.create_from_point_cloud_alpha_shape(Cloud, alpha)
            rows = mesh.point_data["input_row"][mesh.cells["triangle"]]
            assert {tuple(sorted(row)) for row in rows.tolist()} == self.facets(points, alpha)
            assert np.array_equal(mesh.points, points[mesh.point_data["input_row"]])

    def test_triangles_look_outward(self):
        points = RNG.random((200, 3))
        shape = am.AlphaComplex(points).at(np.inf)
        mesh = migrate.create_from_point_cloud_alpha_shape(points, np.inf)
        a, b, c = (mesh.points[mesh.cells["triangle"][:, k]] for k in range(3))
        inside = np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6
        assert inside == pytest.approx(shape.volume)

    def test_points_in_the_plane_are_refused(self):
        with pytest.raises(CloudShapeError, match="three columns"):
            migrate.create_from_point_cloud_alpha_shape(RANDOM[0][0], 1)


@pytest.mark.parametrize("name", ["alpha_shape", "alpha_shape_auto"])
def test_points_in_space_are_refused_by_those_in_the_plane(name):
    with pytest.raises(CloudShapeError, match="two columns"):
        getattr(migrate, name)(RNG.random((9, 3)), 1.0)
