"""GIS files: the same geometries and columns come back, and damage is told."""

from __future__ import annotations

import shutil
import sys
import tempfile
import warnings
from pathlib import Path

import numpy as np
import pytest
from hypothesis import Phase, given, settings

import alphamesh as am
from alphamesh.errors import (
    FileReadError,
    FileWriteError,
    LossyFormatWarning,
    MissingLibraryError,
    ParameterError,
)
from geo_samples import (
    FIGURE,
    FORMATS,
    OF_POINTS,
    SHAPEFILES,
    UTM,
    WITH_COLUMNS,
    geopandas,
    shapely,
    tables,
)
from planar_samples import planar_shapes


def names(folder):
    return sorted(path.name for path in folder.iterdir())


def comparable(frame, extension):
    """Return geometries in a form that does not depend on how a format turns rings."""
    found = frame.geometry.to_numpy()
    if extension in SHAPEFILES:  # one kind for a polygon and several; rings clockwise
        found = np.array([None if g is None or g.is_empty else g for g in found])
    if extension == ".wkb" and len(found) == 1 and hasattr(found[0], "geoms"):
        found = shapely.get_parts(found)
    with np.errstate(all="ignore"):  # shapely's squares of huge coordinates
        return shapely.normalize(found)


@pytest.mark.parametrize("extension", FORMATS)
def test_regions_come_back(tmp_path, extension):
    shape = FIGURE
    path = tmp_path / f"regions{extension}"
    shape.save_outlines(path, crs=UTM)
    wanted, found = shape.to_geopandas(crs=UTM), am.read_geo(path)
    assert (comparable(found, extension) == comparable(wanted, extension)).all()
    if extension in WITH_COLUMNS:
        assert found.crs == wanted.crs
        for name in ("region", "area", "perimeter", "holes", "triangles", "points"):
            assert found[name].tolist() == wanted[name].tolist()


@pytest.mark.parametrize("extension", [".geojson", ".gpkg", ".fgb", ".parquet", ".wkt", ".wkb"])
@settings(max_examples=10, phases=[Phase.explicit, Phase.generate])
@given(shape=planar_shapes().filter(lambda s: len(s.triangles) > 0))
def test_outlines_of_any_cloud_come_back_bit_for_bit(extension, shape):
    wanted = shape.to_geopandas(crs=UTM)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, f"a{extension}")
        am.write_geo(wanted, path)
        found = comparable(am.read_geo(path), extension)
    corners = [shapely.get_coordinates(g).tolist() for g in (found, comparable(wanted, ""))]
    assert corners[0] == corners[1]


@pytest.mark.parametrize("extension", OF_POINTS)
@settings(max_examples=10, phases=[Phase.explicit, Phase.generate])
@given(table=tables())
def test_points_and_their_columns_come_back(extension, table):
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, f"a{extension}")
        am.write_geo(table, path)
        found = am.read_table(path, dimension=3)
        flat = am.read_points(path)
    assert np.array_equal(found.points, table.points)
    assert np.array_equal(flat, table.points[:, :2])
    if extension in WITH_COLUMNS:
        assert found.crs == table.crs
        assert list(found.columns) == list(table.columns)
        for name, column in table.columns.items():
            if extension in SHAPEFILES and column.dtype.kind == "f":
                np.testing.assert_allclose(found.columns[name], column, rtol=0, atol=1e-9)
            else:
                assert found.columns[name].tolist() == column.tolist()


def test_without_a_reference_system_there_is_none(tmp_path):
    for extension in (".gpkg", ".fgb", ".parquet", ".shp"):
        FIGURE.save_outlines(tmp_path / f"a{extension}")
        assert am.read_geo(tmp_path / f"a{extension}").crs is None


@pytest.mark.parametrize("extension", FORMATS)
def test_a_file_that_is_cut_off_is_told(tmp_path, extension):
    path = tmp_path / f"a{extension}"
    FIGURE.save_outlines(path, crs=UTM)
    whole = path.read_bytes()
    # The last byte of some formats says nothing.
    for size in {0, 1, *np.linspace(2, len(whole) - 4, 25).astype(int).tolist()}:
        path.write_bytes(whole[:size])
        with pytest.raises(FileReadError, match=r"a\.\w+ (is|has|holds)") as caught:
            am.read_geo(path)
        assert "DRIVER" not in str(caught.value)


@pytest.mark.parametrize("extension", FORMATS)
@pytest.mark.parametrize("content", ["gpkg", "fgb", "geojson", "parquet", "png"])
def test_a_foreign_file_is_told(tmp_path, extension, content):
    if content in extension or (extension == ".json" and content == "geojson"):
        pytest.skip("that is no foreign format")
    foreign = tmp_path / f"b.{content}"
    if content == "png":
        foreign.write_bytes(b"\x89PNG\r\n\x1a\n" + bytes(range(256)))
    else:
        FIGURE.save_outlines(foreign)
    path = tmp_path / f"a{extension}"
    shutil.copy(foreign, path)
    with pytest.raises(FileReadError, match=r"a\.\w+ (is|has|holds)"):
        am.read_geo(path)


def test_missing_files_and_unknown_names(tmp_path):
    with pytest.raises(FileReadError, match="does not exist"):
        am.read_geo(tmp_path / "no.gpkg")
    with pytest.raises(FileReadError, match="is a folder"):
        (tmp_path / "folder.gpkg").mkdir()
        am.read_geo(tmp_path / "folder.gpkg")
    with pytest.raises(FileReadError, match=r"'\.abc' is none of a GIS"):
        am.read_geo(tmp_path / "a.abc")
    with pytest.raises(FileWriteError, match=r"no extension.*gpkg"):
        FIGURE.save_outlines(tmp_path / "a")
    with pytest.raises(ParameterError, match="unknown format 'abc'"):
        FIGURE.save_outlines(tmp_path / "a", file_format="abc")
    with pytest.raises(ParameterError, match="not a list"):
        am.write_geo([1, 2], tmp_path / "a.gpkg")
    FIGURE.save_outlines(tmp_path / "named.data", file_format="fgb")
    assert len(am.read_geo(tmp_path / "named.data", file_format=".fgb")) == len(FIGURE.regions)


class TestLayers:
    def test_other_layers_stay(self, tmp_path):
        path = tmp_path / "a.gpkg"
        FIGURE.save_outlines(path, layer="one")
        FIGURE.save_outlines(path, "triangles", layer="two")
        FIGURE.save_outlines(path, "shape", layer="one")
        assert len(am.read_geo(path, layer="one")) == 1
        assert len(am.read_geo(path, layer="two")) == len(FIGURE.triangles)
        with pytest.raises(FileReadError, match=r"several layers.*'\w+', '\w+'"):
            am.read_geo(path)

    def test_without_a_layer_the_file_is_new(self, tmp_path):
        path = tmp_path / "a.gpkg"
        FIGURE.save_outlines(path, layer="one")
        FIGURE.save_outlines(path, layer="two")
        FIGURE.save_outlines(path)
        assert len(am.read_geo(path)) == len(am.read_geo(path, layer="a"))

    def test_points_of_a_layer(self, tmp_path):
        path = tmp_path / "a.gpkg"
        am.write_geo(am.PointTable([[1, 2]]), path, layer="points")
        FIGURE.save_outlines(path, layer="shape")
        assert am.read_points(path, layer="points").tolist() == [[1, 2]]
        with pytest.raises(FileReadError, match=r"not points in rows.*Polygon"):
            am.read_points(path, layer="shape")

    @pytest.mark.parametrize("path", ["a.geojson", "a.parquet"])
    def test_only_geopackages_have_them(self, tmp_path, path):
        with pytest.raises(ParameterError, match="layer= is for GeoPackages"):
            FIGURE.save_outlines(tmp_path / path, layer="one")
        with pytest.raises(ParameterError, match="layer= is for GeoPackages"):
            am.read_points(tmp_path / path, layer="one")


class TestWholeOrNot:
    @pytest.mark.parametrize("extension", [e for e in FORMATS if e not in (".wkt", ".wkb")])
    def test_a_table_that_does_not_fit_leaves_the_old_file(self, tmp_path, extension):
        path = tmp_path / f"a{extension}"
        FIGURE.save_outlines(path, crs=UTM)
        before = {name: (tmp_path / name).read_bytes() for name in names(tmp_path)}
        frame = FIGURE.to_geopandas(crs=UTM)
        frame["bad"] = [complex(1, 2)] * len(frame)
        with pytest.raises(FileWriteError, match=rf"cannot write .*a\{extension}"):
            am.write_geo(frame, path)
        assert {name: (tmp_path / name).read_bytes() for name in names(tmp_path)} == before

    @pytest.mark.parametrize("extension", FORMATS)
    def test_a_missing_folder_is_told(self, tmp_path, extension):
        with pytest.raises(FileWriteError, match="does not exist"):
            FIGURE.save_outlines(tmp_path / "no" / f"a{extension}")
        assert names(tmp_path) == []

    def test_an_older_shapefile_leaves_nothing_behind(self, tmp_path):
        FIGURE.save_outlines(tmp_path / "a.shp", crs=UTM)
        (tmp_path / "a.qix").write_bytes(b"an index of the older file")
        FIGURE.save_outlines(tmp_path / "a.shp")
        assert names(tmp_path) == ["a.cpg", "a.dbf", "a.shp", "a.shx"]
        assert am.read_geo(tmp_path / "a.shp").crs is None


class TestLosses:
    def test_what_a_shapefile_cannot_hold_is_told(self, tmp_path):
        table = am.PointTable(
            [[1, 2]],
            {"a_long_name_for_it": [1.0], "when": np.array(["2020-01-01T03:04"], "M8[s]")},
        )
        with pytest.warns(LossyFormatWarning) as told:
            am.write_geo(table, tmp_path / "a.shp")
        text = " ".join(str(one.message) for one in told)
        assert "a_long_name_for_it" in text and "when" in text
        assert all(Path(one.filename) == Path(__file__) for one in told)
        with pytest.warns(LossyFormatWarning) as told:
            values = {"a_long_name_for_it": np.zeros(len(FIGURE.points))}
            FIGURE.save_outlines(tmp_path / "b.shp", "points", data=values)
        assert all(Path(one.filename) == Path(__file__) for one in told)

    def test_mixed_geometries_are_refused_by_shapefiles(self, tmp_path):
        mixed = geopandas.GeoSeries([shapely.Point(0, 0), shapely.box(0, 0, 1, 1)])
        with pytest.raises(FileWriteError, match=r"shapefile.*gpkg"):
            am.write_geo(mixed, tmp_path / "a.shp")
        am.write_geo(mixed, tmp_path / "a.geojson")
        assert am.read_geo(tmp_path / "a.geojson").geom_type.tolist() == ["Point", "Polygon"]


@pytest.mark.parametrize(
    ("library", "extension"),
    [("pyogrio", ".gpkg"), ("geopandas", ".wkt"), ("pyarrow", ".parquet"), ("pyogrio", ".shp")],
)
def test_a_missing_library_is_named(tmp_path, monkeypatch, library, extension):
    path = tmp_path / f"a{extension}"
    FIGURE.save_outlines(path)
    monkeypatch.setitem(sys.modules, library, None)
    with pytest.raises(MissingLibraryError, match=rf"{library}.*alphamesh\[(geo|io)\]"):
        am.read_geo(path)
    if library != "geopandas":
        frame = FIGURE.to_geopandas()
        with pytest.raises(MissingLibraryError, match=rf"{library}.*alphamesh\[(geo|io)\]"):
            am.write_geo(frame, tmp_path / f"b{extension}")
    else:
        with pytest.raises(MissingLibraryError, match=r"geopandas.*alphamesh\[geo\]"):
            FIGURE.to_geopandas()


def test_nothing_else_is_warned_of(tmp_path):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for extension in FORMATS:
            FIGURE.save_outlines(tmp_path / f"a{extension}")
            am.read_geo(tmp_path / f"a{extension}")


def test_text_that_is_none_is_told_by_the_reader(tmp_path):
    """Found by damaging files: pandas looks at text when it is used."""
    path = tmp_path / "a.parquet"
    points = shapely.points([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])
    frame = geopandas.GeoDataFrame({"name": ["first", "second", "third"]}, geometry=points)
    frame.to_parquet(path, compression=None)
    path.write_bytes(path.read_bytes().replace(b"second", b"se\xffond"))
    with pytest.raises(FileReadError, match="not a complete GeoParquet file"):
        am.read_geo(path)
