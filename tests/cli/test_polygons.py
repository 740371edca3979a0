"""``alphamesh polygons``."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

import alphamesh as am
from cli_tools import facts, files, ok, process, refused, run

pytest.importorskip("geopandas")
pytest.importorskip("pyogrio")
shapely = pytest.importorskip("shapely")


def features(name: str) -> tuple[list, list]:
    """Return the geometries of a GeoJSON file, and their properties."""
    made = json.loads(Path(name).read_text())["features"]
    drawn = [shapely.from_geojson(json.dumps(feature["geometry"])) for feature in made]
    return drawn, [feature["properties"] for feature in made]


def test_polygons_are_those_of_the_shape(points):
    out = facts("polygons", "points.csv", "-r", "18", "-o", "a.geojson", "-o", "a.wkt")
    shape = am.AlphaComplex(points).at(18.0)
    wanted = shape.polygons()
    drawn, told = features("a.geojson")
    assert len(wanted) == out["regions"] > 1
    assert all(a.equals_exact(b, 0.0) for a, b in zip(drawn, wanted, strict=True))
    assert [row["area"] for row in told] == shape.regions.areas.tolist()
    assert [row["holes"] for row in told] == shape.regions.hole_counts.tolist()
    lines = Path("a.wkt").read_text().splitlines()
    assert all(
        shapely.from_wkt(a).equals_exact(b, 0.0) for a, b in zip(lines, wanted, strict=True)
    )
    assert out["area"] == shape.area


def test_the_reference_system_is_kept(points):
    for given, code in (("EPSG:25832", 25832), ("25832", 25832), ("epsg:3857", 3857)):
        ok("polygons", "points.csv", "--crs", given, "-o", "a.geojson")
        kept = json.loads(Path("a.geojson").read_text())["crs"]["properties"]["name"]
        assert kept == f"urn:ogc:def:crs:EPSG::{code}"
    ok("polygons", "points.csv", "-o", "a.geojson")
    assert "crs" not in json.loads(Path("a.geojson").read_text())
    assert "EPSG:25832" in refused(2, "polygons", "points.csv", "--crs", "moon base")


def test_degrees_are_warned_of(folder):
    Path("p.csv").write_text("lon,lat\n8,50\n9,50\n8,51\n")
    result = run("polygons", "p.csv", "--crs", "EPSG:4326")
    assert result.exit_code == 0
    assert result.stderr.startswith("Warning: ")
    assert "to_crs" in result.stderr


def test_files_of_a_gis_go_in_and_out(points):
    args = ("--crs", "EPSG:25832", "--as", "points")
    ok("polygons", "points.csv", *args, "-o", "p.gpkg")
    out = facts("polygons", "p.gpkg", "-o", "a.parquet")
    assert out["input"]["crs"] == "EPSG:25832"
    made = am.read_geo("a.parquet")
    assert made.crs.to_epsg() == 25832
    shape = am.AlphaComplex(points).at()
    assert made["area"].tolist() == shape.regions.areas.tolist()
    piped = facts("polygons", "-", stdin=Path("p.gpkg").read_bytes())
    assert piped["area"] == out["area"]
    assert "not in EPSG:3857: leave --crs out" in refused(
        2, "polygons", "p.gpkg", "--crs", "EPSG:3857"
    )
    assert "several files" in refused(2, "polygons", "points.csv", "-o", "-", "--to", "shp")


def test_columns_become_aggregates_and_elevations(points):
    heights = np.arange(200) % 17
    rows = np.column_stack((points, heights))
    np.savetxt("t.csv", rows, delimiter=",", header="x,y,height", comments="", fmt="%.17g")
    args = ("--aggregate", "height:max", "--aggregate", "height:mean")
    ok("polygons", "t.csv", "-r", "20", *args, "--elevation", "height", "-o", "a.geojson")
    shape = am.AlphaComplex(points).at(20.0)
    drawn, told = features("a.geojson")
    assert [row["height_max"] for row in told] == shape.region_values(heights, "max").tolist()
    assert told[0]["height_mean"] == shape.region_values(heights, "mean")[0]
    corners = shapely.get_coordinates(drawn[0], include_z=True)
    assert set(corners[:, 2]) <= set(heights)
    result = run("polygons", "t.csv", "--aggregate", "size:max", "-o", "b.geojson")
    assert result.exit_code == 1
    assert "no column 'size'" in result.stderr
    assert not Path("b.geojson").exists()


def test_all_in_one_and_all_that_there_is(points):
    shape = am.AlphaComplex(points).at(12.0)
    ok("polygons", "points.csv", "-r", "12", "--as", "shape", "-o", "a.geojson")
    (whole,), (told,) = features("a.geojson")
    assert whole.geom_type == "MultiPolygon"
    assert told["regions"] == len(shape.regions) == len(whole.geoms)
    assert told["radius"] == 12.0
    ok("polygons", "points.csv", "-r", "12", "--as", "collection", "-o", "b.wkt")
    made = shapely.from_wkt(Path("b.wkt").read_text())
    assert made.equals_exact(shape.geometry(collection=True), 0.0)
    assert len(made.geoms) > len(whole.geoms)


def test_outlines_can_be_simpler_or_smoother(points):
    shape = am.AlphaComplex(points).at(30.0)
    ok("polygons", "points.csv", "-r", "30", "--simplify", "4", "--smooth", "2", "-o", "a.wkt")
    wanted = shape.polygons(simplify=4.0, smooth=2)
    made = shapely.from_wkt(Path("a.wkt").read_text().splitlines())
    assert all(a.equals_exact(b, 0.0) for a, b in zip(made, wanted, strict=True))
    assert (
        shapely.get_num_coordinates(made).sum()
        != shapely.get_num_coordinates(shape.polygons()).sum()
    )


def test_polygons_through_pipes():
    text = ok("sample", "demo:eight", "-o", "-")
    piped = ok("polygons", "-", "-o", "-", stdin=text.encode())
    made = json.loads(piped)
    assert made["type"] == "FeatureCollection"
    assert made["features"][0]["properties"]["holes"] == 2
    assert ok("polygons", "-", "-o", "-", "--to", "wkt", stdin=text.encode())[:7] == "POLYGON"


def test_polygons_of_nothing_are_an_empty_collection(folder):
    Path("p.csv").write_text("0,0\n9,9\n")
    assert facts("polygons", "p.csv", "-o", "a.geojson", "-o", "a.wkt")["regions"] == 0
    assert json.loads(Path("a.geojson").read_text())["features"] == []
    assert Path("a.wkt").read_text() == ""


def test_polygons_of_many_files(folder):
    for name in ("annulus", "eight"):
        ok("sample", f"demo:{name}", "-o", f"{name}.csv")
    out = facts("polygons", "annulus.csv", "eight.csv", "--output-dir", "out")
    assert [made["holes"] for made in out["files"]] == [1, 2]
    assert files("out") == {"annulus.geojson", "eight.geojson"}


def test_without_geopandas_it_says_what_to_install(points):
    Path("sitecustomize.py").write_text("import sys; sys.modules['geopandas'] = None\n")
    import os

    env = {**os.environ}
    env["PYTHONPATH"] = os.pathsep.join(
        [str(Path.cwd()), *filter(None, [env.get("PYTHONPATH")])]
    )
    done = process("polygons", "points.csv", "-o", "a.wkt", env=env)
    assert done.returncode == 1
    assert 'pip install "alphamesh[geo]"' in done.stderr.decode()
    assert not Path("a.wkt").exists()
    assert np.loadtxt("points.csv", delimiter=",", skiprows=1).shape == (200, 2)
