"""``alphamesh convert``."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import alphamesh as am
from alphamesh.cli.write_points import POINT_WRITERS
from alphamesh.io.meshes import MESH_FORMATS, Mesh, read_mesh, write_mesh
from cli_tools import facts, files, ok, refused, run

MESHES = sorted(set(MESH_FORMATS) - {".stl"})


def warned(*args: str) -> str:
    """Return the warnings of a command that does what it is asked for."""
    result = run(*args)
    assert result.exit_code == 0, result.output
    return " ".join(result.stderr.split())


@pytest.mark.parametrize("suffix", POINT_WRITERS)
def test_points_survive_every_format_and_the_way_back(points, suffix):
    there = facts("convert", "points.csv", f"p{suffix}")
    assert (there["kind"], there["points"]) == ("points", 200)
    ok("convert", f"p{suffix}", "back.csv")
    np.testing.assert_array_equal(am.read_points("back.csv"), points)
    assert Path("back.csv").read_text().startswith("x,y\n")


@pytest.mark.parametrize("suffix", MESHES)
@pytest.mark.parametrize("end", [".npz", ".vtu"])
def test_meshes_survive_every_format(points, suffix, end):
    """A shape without singular edges and isolated vertices: what all formats hold."""
    cx = am.AlphaComplex(points)
    shape = cx.at(cx.choose_radius("all-points").radius).filtered()
    write_mesh(Mesh(points, {"triangle": shape.triangles}), f"m{suffix}", keep_all=True)
    out = facts("convert", f"m{suffix}", f"n{end}")
    assert (out["kind"], out["points"], out["cells"]) == ("mesh", 200, len(shape.triangles))
    made = read_mesh(f"n{end}")
    np.testing.assert_array_equal(made.points[:, :2], points)
    np.testing.assert_array_equal(made.cells["triangle"], shape.triangles)


def test_losses_are_named(points):
    ok("mesh", "points.csv", "-r", "12", "-o", "m.vtu", "-o", "m.ply", "-o", "m.obj")
    out = warned("convert", "m.vtu", "m.stl")
    assert "STL files cannot hold numbers of cells, left out: radius; these formats can:" in out
    assert "singular edges" in out
    assert "32-bit" in out
    assert "32-bit" not in warned("convert", "m.vtu", "m.off")
    shape = am.AlphaComplex(points).at(12.0)
    count = len(shape.singular_edges)
    assert count > 1
    lost = count + len(shape.isolated_vertices)
    assert f"m.obj: its {lost} edges and single vertices" in warned("convert", "m.obj", "n.off")
    ok("convert", "m.ply", "n.npz")
    assert len(read_mesh("n.npz").cells["line"]) == count
    assert warned("convert", "m.vtu", "n.vtk") == ""


def test_a_mesh_gives_its_vertices_as_points(points):
    ok("mesh", "points.csv", "-r", "inf", "-o", "m.vtu")
    triangles = len(am.delaunay(points).triangles)
    assert f"p.csv: a file of points holds the vertices alone; {triangles}" in warned(
        "convert", "m.vtu", "p.csv"
    )
    np.testing.assert_array_equal(am.read_points("p.csv"), points)


def test_points_do_not_become_a_mesh_by_themselves(points):
    text = refused(1, "convert", "points.csv", "m.vtu")
    assert "alphamesh mesh points.csv -o m.vtu" in text
    assert files() == {"points.csv"}


def test_standard_streams(points):
    ok("convert", "points.csv", "p.ply")
    stdin = Path("p.ply").read_bytes()
    text = ok("convert", "-", "-", "--to", "csv", stdin=stdin)
    np.testing.assert_array_equal(np.loadtxt(text.splitlines()[1:], delimiter=","), points)
    ok("mesh", "points.csv", "-o", "m.vtu", "-o", "m.stl")
    for name in ("m.vtu", "m.stl"):
        text = ok("convert", "-", "-", "--to", "off", stdin=Path(name).read_bytes())
        assert text.startswith("OFF\n")
    assert "tell its format with --to" in refused(2, "convert", "points.csv", "-")
    assert "--to is for" in refused(2, "convert", "points.csv", "a.csv", "--to", "csv")


def test_table_options_are_those_of_points(folder):
    Path("t.txt").write_text("id;north;east\n7;1,5;2,5\n8;3,5;4,5\n")
    ok("convert", "t.txt", "p.csv", "--columns", "east,north", "--decimal", ",")
    assert Path("p.csv").read_text() == "x,y,id\n2.5,1.5,7\n4.5,3.5,8\n"


def test_what_cannot_be_converted(points, image):
    assert "alphamesh sample" in refused(1, "convert", image, "p.csv")
    assert "no.csv does not exist" in refused(1, "convert", "no.csv", "p.ply")
    assert "is the input" in refused(2, "convert", "points.csv", "./points.csv")
    assert "one INPUT and one OUTPUT" in refused(2, "convert", "points.csv")
    assert "'.foo'" in refused(2, "convert", "points.csv", "p.foo")
    Path("bad.vtu").write_text("<VTKFile type=")
    assert "bad.vtu" in refused(1, "convert", "bad.vtu", "p.obj")
    assert files() == {"points.csv", image, "bad.vtu"}


def test_many_files(points):
    for name in ("a", "b"):
        ok("convert", "points.csv", f"{name}.csv")
    assert "--to" in refused(2, "convert", "a.csv", "b.csv", "--output-dir", "out")
    out = facts("convert", "a.csv", "b.csv", "--output-dir", "out", "--to", "npy")
    assert files("out") == {"a.npy", "b.npy"}
    assert [made["points"] for made in out["files"]] == [200, 200]
    np.testing.assert_array_equal(np.load("out/a.npy"), points)


def test_other_columns_travel(folder):
    pytest.importorskip("pyogrio")
    Path("t.csv").write_text('id,east,north,kind\n7,1.5,2.5,"oak, red"\n8,3.5,4.5,\n')
    ok("convert", "t.csv", "t.gpkg", "--columns", "east,north", "--crs", "EPSG:25832")
    frame = am.read_geo("t.gpkg")
    assert frame.crs.to_epsg() == 25832
    assert frame["id"].tolist() == [7, 8]
    assert "the reference system is not kept" in warned("convert", "t.gpkg", "back.csv")
    lines = Path("back.csv").read_text().splitlines()
    assert lines[:2] == ["x,y,id,kind", '1.5,2.5,7,"oak, red"']
    out = warned("convert", "t.csv", "p.npy", "--columns", "east,north")
    assert "left out: id, kind" in out


def test_geometries_go_from_gis_to_gis(points):
    pytest.importorskip("pyogrio")
    ok("polygons", "points.csv", "--crs", "EPSG:25832", "-o", "a.gpkg")
    assert facts("convert", "a.gpkg", "a.fgb")["kind"] == "geometries"
    ok("convert", "a.fgb", "b.gpkg")
    first, again = am.read_geo("a.gpkg"), am.read_geo("b.gpkg")
    assert first.crs == again.crs
    assert first.geometry.geom_equals_exact(again.geometry, 0.0).all()
    assert first["area"].tolist() == again["area"].tolist()


def test_a_column_z_is_a_coordinate(folder):
    Path("t.csv").write_text("x,y,z\n1,2,3\n4,5,6\n")
    assert warned("convert", "t.csv", "p.npy") == ""
    assert np.load("p.npy").tolist() == [[1, 2, 3], [4, 5, 6]]
    ok("convert", "p.npy", "p.ply")
    ok("convert", "p.ply", "back.csv")
    assert Path("back.csv").read_text() == "x,y,z\n1.0,2.0,3.0\n4.0,5.0,6.0\n"
