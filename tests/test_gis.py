"""Points of geopandas in, tables of geopandas out, and one shape for each group."""

from __future__ import annotations

import copy
import pickle
import sys
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given

import alphamesh as am
from alphamesh.errors import (
    CloudShapeError,
    FileWriteError,
    GeographicCoordinatesWarning,
    MissingLibraryError,
    NonFiniteError,
    ParameterError,
)
from geo_samples import FIGURE, UTM, geopandas, placed, shapely
from planar_samples import planar_shapes

POINTS = am.demo_cloud("eight", 300, seed=1)
FRAME = geopandas.GeoDataFrame(
    {"name": [f"p{i}" for i in range(300)], "height": POINTS[:, 0] - POINTS[:, 1]},
    geometry=geopandas.points_from_xy(*POINTS.T),
    crs=UTM,
    index=np.arange(300) * 7 % 300,
)


class TestPointsIn:
    @pytest.mark.parametrize(
        ("given", "crs"),
        [
            (FRAME, True),
            (FRAME.geometry, True),
            (FRAME.geometry.values, True),
            (FRAME.rename_geometry("place"), True),
            (list(FRAME.geometry), False),
            (FRAME.geometry.to_numpy(), False),
            (shapely.MultiPoint(POINTS), False),
            (am.PointTable(POINTS, FRAME, UTM), True),
        ],
        ids=lambda value: type(value).__name__,
    )
    def test_points_in_their_order(self, given, crs):
        cx = am.AlphaComplex(given)
        assert np.array_equal(cx.points, POINTS)
        assert cx.crs == (FRAME.crs if crs else None)
        shape = cx.at(20)
        for one in (shape, shape.filtered(keep_largest=1), copy.deepcopy(shape)):
            assert one.crs == cx.crs
        assert pickle.loads(pickle.dumps(shape)).crs == cx.crs

    def test_one_point_and_none(self):
        assert am.AlphaComplex(FRAME[:0]).points.shape == (0, 2)
        assert am.AlphaComplex(shapely.Point(1, 2)).points.tolist() == [[1, 2]]

    def test_elevations_are_left_out(self):
        lifted = geopandas.GeoSeries(shapely.force_3d(FRAME.geometry.to_numpy(), 5.0))
        assert np.array_equal(am.AlphaComplex(lifted).points, POINTS)

    def test_tables_in_space_are_taken_in_space(self):
        table = am.PointTable(np.random.default_rng(1).random((30, 3)), crs=UTM)
        cx = am.AlphaComplex(table)
        assert isinstance(cx, am.AlphaComplex3D)
        assert np.array_equal(cx.points, table.points)
        assert cx.crs == cx.at(1).crs == table.crs

    @pytest.mark.parametrize(
        ("geometries", "message", "rows"),
        [
            ([None], r"missing geometry in row 2 of 4.*frame\[~", (2,)),
            ([shapely.Point(), None], r"rows 2, 3 of 5", (2, 3)),
            ([shapely.box(0, 0, 1, 1)], r"row 2 holds a Polygon.*representative_point", (2,)),
            ([shapely.MultiPoint([(0, 0), (1, 1)])], r"MultiPoint.*explode", (2,)),
            ([shapely.LineString([(0, 0), (1, 1)])], r"LineString.*get_coordinates", (2,)),
        ],
    )
    def test_other_geometries_are_named(self, geometries, message, rows):
        column = [shapely.Point(0, 0), shapely.Point(1, 0), *geometries, shapely.Point(0, 1)]
        for points in (column, geopandas.GeoSeries(column), np.array(column, dtype=object)):
            with pytest.raises(CloudShapeError, match=message) as caught:
                am.AlphaComplex(points)
            assert caught.value.rows == rows

    def test_plain_tables_with_a_column_of_points(self):
        plain = FRAME.to_wkb().assign(geometry=FRAME.geometry.to_numpy())
        assert not hasattr(plain, "crs")
        assert np.array_equal(am.AlphaComplex(plain).points, POINTS)
        assert am.alpha_shapes(plain, radius=20).crs is None
        with pytest.raises(ParameterError, match="needs a GeoDataFrame"):
            am.write_geo(plain, "never.gpkg")

    def test_numbers_among_geometries_are_named(self):
        with pytest.raises(CloudShapeError, match="no geometry but a int in row 1"):
            am.AlphaComplex([shapely.Point(0, 0), 3])

    def test_degrees_are_warned_of_where_the_user_stands(self):
        degrees = FRAME.set_crs(4326, allow_override=True)
        with pytest.warns(GeographicCoordinatesWarning, match="estimate_utm_crs") as told:
            am.AlphaComplex(degrees)
        assert [Path(one.filename) for one in told] == [Path(__file__)]
        with pytest.warns(GeographicCoordinatesWarning, match="WGS 84") as told:
            am.alpha_shapes(degrees, radius=20)
        assert [Path(one.filename) for one in told] == [Path(__file__)]


class TestQueries:
    def test_points_of_the_same_system(self):
        shape = am.AlphaComplex(FRAME).at(20)
        inside = shape.contains(FRAME)
        assert np.array_equal(inside, shape.contains(POINTS)) and inside.any()
        assert np.array_equal(shape.nearest(FRAME.geometry).edges, shape.nearest(POINTS).edges)
        plain = am.AlphaComplex(POINTS).at(20)  # nobody knows where it is
        assert np.array_equal(plain.distance(FRAME), shape.distance(FRAME))

    @pytest.mark.parametrize("method", ["contains", "region_of", "nearest", "distance"])
    def test_points_of_another_system_are_refused(self, method):
        shape = am.AlphaComplex(FRAME).at(20)
        with pytest.raises(ParameterError, match=r"UTM zone 33N.*UTM zone 32N.*to_crs"):
            getattr(shape, method)(FRAME.to_crs(25833))


class TestTables:
    def test_regions(self):
        shape = am.AlphaComplex(FRAME).at()
        frame = shape.to_geopandas()
        regions = shape.regions
        assert frame.crs == FRAME.crs and frame.geom_type.eq("Polygon").all()
        assert frame.area.tolist() == pytest.approx(regions.areas.tolist())
        assert frame["area"].tolist() == regions.areas.tolist()
        assert frame["holes"].tolist() == [len(g.interiors) for g in frame.geometry]
        assert frame["perimeter"].tolist() == pytest.approx(frame.length.tolist())
        inside = [shapely.intersects(g, shapely.points(POINTS)).sum() for g in frame.geometry]
        assert frame["points"].tolist() == inside

    @given(planar_shapes())
    def test_each_table_covers_the_shape(self, shape):
        area = pytest.approx(shape.area, rel=1e-9)
        for what in ("regions", "shape", "triangles"):
            frame = shape.to_geopandas(what, crs=UTM)
            assert frame["area"].sum() == area
            assert frame.crs == UTM
        points = shape.to_geopandas("points")
        assert np.array_equal(shapely.get_coordinates(points.geometry), shape.points)
        assert points["region"].tolist() == shape.regions.vertex_labels.tolist()

    def test_triangles_have_their_numbers(self):
        shape = am.AlphaComplex(FRAME).at(20)
        frame = shape.to_geopandas(
            "triangles", data=FRAME, aggregate={"height": ["min", "max"]}
        )
        at_corners = FRAME["height"].to_numpy()[shape.triangles]
        assert frame["height_min"].tolist() == at_corners.min(axis=1).tolist()
        assert frame["height_max"].tolist() == at_corners.max(axis=1).tolist()
        assert frame["region"].tolist() == shape.regions.labels.tolist()
        assert frame["radius"].max() <= 20

    def test_columns_stay_with_points(self):
        frame = am.AlphaComplex(FRAME).at(20).to_geopandas("points", data=FRAME)
        assert frame["name"].tolist() == FRAME["name"].tolist()
        assert frame["height"].tolist() == FRAME["height"].tolist()

    def test_the_whole_shape_in_one_row(self):
        shape = FIGURE
        values = np.arange(len(shape.points), dtype=float)
        frame = shape.to_geopandas("shape", data={"v": values}, aggregate={"v": "sum"})
        used = np.unique(shape.triangles)
        assert len(frame) == 1
        assert frame["points"][0] == len(used) and frame["v_sum"][0] == values[used].sum()
        assert frame.geometry[0].equals(shape.geometry())

    @pytest.mark.parametrize("what", ["regions", "shape", "triangles", "points"])
    def test_elevations(self, what):
        filtration = am.filtration(placed(FIGURE))
        shape = am.AlphaShape(filtration, np.inf)
        z = np.random.default_rng(1).random(len(shape.points))
        frame = shape.to_geopandas(what, elevation="z", data={"z": z})
        corners = shapely.get_coordinates(frame.geometry, include_z=True)
        wanted = {
            (x, y): h for (x, y), h in zip(shape.points.tolist(), z.tolist(), strict=True)
        }
        assert len(corners) and all(wanted[x, y] == h for x, y, h in corners.tolist())
        assert frame.geometry.has_z.all()
        flat = shape.to_geopandas(what)
        assert frame.geometry.force_2d().geom_equals_exact(flat.geometry, 0).all()

    def test_elevations_of_simplified_outlines(self):
        shape = am.AlphaComplex(FRAME).at(20)
        frame = shape.to_geopandas(elevation=FRAME["height"], simplify=10)
        corners = shapely.get_coordinates(frame.geometry, include_z=True)
        assert np.array_equal(corners[:, 2], corners[:, 0] - corners[:, 1])

    def test_of_nothing(self):
        shape = am.AlphaComplex(FRAME).at(0)
        for what, rows in (("regions", 0), ("shape", 1), ("triangles", 0), ("points", 300)):
            frame = shape.to_geopandas(what, elevation=FRAME["height"])
            assert len(frame) == rows and frame.crs == FRAME.crs
        assert shape.to_geopandas("shape").geometry[0].is_empty

    @pytest.mark.parametrize(
        ("what", "options", "message"),
        [
            ("region", {}, "no table of 'region'.*'regions'"),
            ("triangles", {"smooth": 1}, "not for triangles"),
            ("regions", {"smooth": 1, "elevation": POINTS[:, 0]}, "no elevation"),
            ("regions", {"elevation": [1, 2]}, r"one for each of the 300 points.*\(2,\)"),
            ("regions", {"elevation": FRAME["name"]}, "must be numbers"),
            ("regions", {"elevation": "depth", "data": FRAME}, "no column 'depth'"),
            ("regions", {"aggregate": {"height": "mean"}}, "no column 'height'.*data="),
            ("regions", {"aggregate": {"height": "mode"}, "data": FRAME}, "aggregate 'mode'"),
            ("regions", {"aggregate": {"name": "mean"}, "data": FRAME}, "have no mean"),
            ("points", {"aggregate": {"height": "mean"}, "data": FRAME}, "own values"),
            ("points", {"data": {"region": POINTS[:, 0]}}, "column 'region' of its own"),
            ("points", {"data": {"a": [1]}}, "'a' must have one value for each"),
            ("regions", {"crs": 4326}, "points are in ETRS89.*to_crs"),
            ("regions", {"crs": "nonsense"}, "no coordinate reference system"),
        ],
    )
    def test_what_does_not_go_together_is_told(self, what, options, message):
        shape = am.AlphaComplex(FRAME).at(20)
        with pytest.raises(ParameterError, match=message):
            shape.to_geopandas(what, **options)


def test_an_unknown_option_is_told(tmp_path):
    shape = am.AlphaComplex(FRAME).at(20)
    with pytest.raises(ParameterError, match=r"no option 'simplfy'.*simplify"):
        shape.save_outlines(tmp_path / "a.gpkg", simplfy=3)
    with pytest.raises(TypeError, match="simplfy"):
        shape.to_geopandas(simplfy=3)


def test_outlines_are_not_taken_for_meshes(tmp_path):
    shape = am.AlphaComplex(FRAME).at(20)
    with pytest.raises(FileWriteError, match=r"no mesh format.*save_outlines"):
        shape.save(tmp_path / "a.geojson")


class TestPointTable:
    def test_holds_what_it_is_given(self):
        table = am.PointTable(POINTS, FRAME, "EPSG:25832")
        assert list(table.columns) == ["name", "height"]
        assert len(table) == 300 and "300 points; columns: name, height; ETRS89" in repr(table)
        for same in (copy.copy(table), pickle.loads(pickle.dumps(table))):
            assert np.array_equal(same.points, POINTS) and same.crs == table.crs
            assert same.columns["name"].tolist() == FRAME["name"].tolist()
        with pytest.raises(ValueError, match="read-only"):
            table.columns["height"][0] = 0

    def test_becomes_a_frame(self):
        table = am.PointTable(np.column_stack((POINTS, POINTS[:, 0])), FRAME, UTM)
        frame = table.to_geopandas()
        assert np.array_equal(
            shapely.get_coordinates(frame.geometry, include_z=True), table.points
        )
        assert frame["name"].tolist() == FRAME["name"].tolist() and frame.crs == FRAME.crs

    @pytest.mark.parametrize(
        ("points", "columns", "message"),
        [
            (POINTS[:, 0], {}, r"\(n, 2\) or \(n, 3\)"),
            ([["a", "b"]], {}, "table of numbers"),
            (POINTS, {"a": [1, 2]}, "column 'a'.*300 points"),
            (POINTS, [1, 2], "mapping of names"),
        ],
    )
    def test_refuses_what_is_none(self, points, columns, message):
        with pytest.raises(ParameterError, match=message):
            am.PointTable(points, columns)


class TestGroups:
    def frame(self):
        one, line = [[5, 5]], [[0, 0], [2, 1], [4, 2]]
        square = [[0, 0], [1, 0], [0, 1], [1, 1.01]]
        points = np.array([*square, *one, *line, [3, 3], *np.add(square, 9)], dtype=float)
        groups = ["b"] * 4 + ["one"] + ["line"] * 3 + [None] + ["a"] * 4
        order = np.random.default_rng(3).permutation(len(points))
        points, groups = points[order], np.array(groups, dtype=object)[order]
        return geopandas.GeoDataFrame(
            {"group": groups, "half": order % 2},
            geometry=geopandas.points_from_xy(*points.T),
            crs=UTM,
        )

    def test_one_row_for_each(self):
        found = am.alpha_shapes(self.frame(), by="group", radius="all-points")
        assert found["group"].tolist() == ["a", "b", "line", "one"]
        assert found["points"].tolist() == [4, 4, 3, 1]
        assert found["regions"].tolist() == [1, 1, 0, 0]
        assert found["area"].tolist() == pytest.approx([1.005, 1.005, 0, 0])
        assert found.area.tolist() == pytest.approx(found["area"].tolist())
        assert found.geom_type.eq("MultiPolygon").all() and found.is_valid.all()
        assert found.crs == UTM

    def test_with_what_is_no_area(self):
        found = am.alpha_shapes(self.frame(), "group", "all-points", collection=True)
        shapes = dict(zip(found["group"], found.geometry, strict=True))
        assert shapes["one"].equals(shapely.Point(5, 5))
        assert shapes["line"].equals(shapely.LineString([(0, 0), (4, 2)]))
        assert shapes["a"].geom_type == "Polygon"
        found = am.alpha_shapes(self.frame(), "group", 0.0, collection=True)
        assert found.geom_type.tolist() == ["MultiPoint", "MultiPoint", "MultiPoint", "Point"]

    def test_each_is_the_shape_of_its_points(self):
        frame = FRAME.assign(side=np.where(POINTS[:, 0] < 200, "left", "right"))
        found = am.alpha_shapes(frame, "side")
        for row, side in enumerate(["left", "right"]):
            shape = am.AlphaComplex(frame[frame["side"] == side]).at()
            assert found["radius"][row] == shape.radius
            assert found["holes"][row] == shape.regions.hole_counts.sum()
            assert found.geometry[row].equals(shape.geometry())

    def test_by_several_columns(self):
        found = am.alpha_shapes(self.frame(), ["group", "half"], 1.0)
        assert found[["group", "half"]].drop_duplicates().shape[0] == len(found)
        assert found["points"].sum() == 12

    def test_all_in_one(self):
        found = am.alpha_shapes(FRAME, radius=20)
        assert len(found) == 1 and found["points"][0] == 300
        assert am.alpha_shapes(FRAME.geometry, radius=20).equals(found)
        assert am.alpha_shapes(FRAME[:0], radius=1)["points"].tolist() == [0]
        assert len(am.alpha_shapes(FRAME[:0], "name", 1)) == 0

    def test_progress_ascends_to_one(self):
        told = []
        am.alpha_shapes(FRAME.assign(g=np.arange(300) % 7), "g", 20, progress=told.append)
        assert told == sorted(told) and told[-1] == 1 and all(0 <= t <= 1 for t in told)

    @pytest.mark.parametrize(
        ("options", "error", "message"),
        [
            ({"by": "species"}, ParameterError, "no column 'species'.*'name', 'height'"),
            ({"by": "geometry"}, ParameterError, "no column 'geometry' to group by"),
            ({"radius": "tight"}, ParameterError, "neither a number nor a rule: 'auto'"),
            ({"radius": -1.0}, ParameterError, "radius must be 0 or more"),
        ],
    )
    def test_what_is_wrong_is_told(self, options, error, message):
        with pytest.raises(error, match=message):
            am.alpha_shapes(FRAME, **options)

    def test_tables_that_are_none(self):
        with pytest.raises(CloudShapeError, match=r"not a ndarray.*points_from_xy"):
            am.alpha_shapes(POINTS)
        with pytest.raises(ParameterError, match="column 'area' of its own"):
            am.alpha_shapes(FRAME.assign(area=1), "area")
        broken = FRAME.copy()
        broken.iloc[5, 2] = shapely.Point(np.inf, 0)
        with pytest.raises(NonFiniteError, match="row 5 of 300"):
            am.alpha_shapes(broken, radius=1)
        broken.iloc[5, 2] = None
        with pytest.raises(CloudShapeError, match="row 5 of 300"):
            am.alpha_shapes(broken, radius=1)


@pytest.mark.parametrize("library", ["geopandas", "shapely", "pyproj"])
def test_a_missing_library_is_named(monkeypatch, library):
    shape = am.AlphaComplex(POINTS).at(20)
    monkeypatch.setitem(sys.modules, library, None)
    with pytest.raises(MissingLibraryError, match=rf"{library}.*alphamesh\[geo\]"):
        shape.to_geopandas(crs="EPSG:25832")
