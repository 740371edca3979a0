"""``alphamesh mesh``."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import alphamesh as am
from alphamesh.io.meshes import read_mesh
from cli_tools import facts, files, ok, refused, run


def test_mesh_of_an_image_writes_every_file_asked_for(image):
    out = facts("mesh", image, "-n", "500", "-o", "a.ply", "-o", "b.npz", "--plot", "c.png")
    assert out["points"] == 500
    assert out["input"]["kind"] == "image"
    assert (out["input"]["width"], out["input"]["height"]) == (64, 64)
    assert [file["path"] for file in out["files"]] == ["a.ply", "b.npz", "c.png"]
    assert all(Path(file["path"]).stat().st_size == file["bytes"] for file in out["files"])
    assert len(read_mesh("b.npz").cells["triangle"]) == out["triangles"] > 100
    with Image.open("c.png") as picture:
        assert picture.width > 1500


def test_mesh_is_what_the_library_makes(image):
    out = facts("mesh", image, "-n", "400", "--seed", "7", "--radius", "3.5")
    points = am.sample_mask(image, 400, seed=7)
    shape = am.AlphaComplex(points).at(3.5)
    assert {name: out[name] for name in shape.counts} == shape.counts
    assert (out["area"], out["perimeter"]) == (shape.area, shape.perimeter)
    assert (out["radius"], out["rule"]) == (3.5, "given")


@pytest.mark.parametrize("radius", ["auto", "all-points"])
def test_mesh_chooses_the_radius_and_says_why(table, radius):
    out = facts("mesh", table, "--radius", radius)
    alpha = am.AlphaComplex(am.read_points(table))
    choice = alpha.choose_radius() if radius == "auto" else alpha.choose_radius(radius)
    assert (out["radius"], out["rule"]) == (choice.radius, choice.rule)
    assert out["reason"] == choice.reason
    text = ok("mesh", table, "--radius", radius)
    assert choice.reason in " ".join(text.split())


def test_mesh_tells_duplicates(table):
    out = facts("mesh", table)
    assert (out["points"], out["duplicates"], out["dimension"]) == (300, 5, 2)
    assert "300 (5 duplicates)" in ok("mesh", table)


def test_mesh_summary_for_people(table):
    out = facts("mesh", table, "-o", "m.ply")
    lines = ok("mesh", table, "-o", "m.ply").splitlines()
    entries = dict(line.split(maxsplit=1) for line in lines if not line.startswith(" "))
    assert entries["Triangles"] == f"{out['triangles']:,}"
    assert entries["Area"] == f"{out['area']:.6g}"
    assert entries["Written"].startswith("m.ply  (")


def test_mesh_without_output_says_how_to_write(table):
    assert "-o FILE writes the mesh" in ok("mesh", table)
    assert files() == {"points.csv"}


def test_mesh_reads_standard_input(table):
    piped = facts("mesh", "-", stdin=Path(table).read_bytes())
    named = facts("mesh", table)
    assert piped.pop("input")["name"] == "-"
    named.pop("input")
    assert piped == named


def test_mesh_of_chosen_columns(folder):
    rng = np.random.default_rng(1)
    rows = rng.random((50, 3))
    np.savetxt("t.txt", rows, delimiter=";", header="id;easting;northing", comments="")
    by_name = facts("mesh", "t.txt", "--columns", "northing,easting")
    by_number = facts("mesh", "t.txt", "--columns", "2,1", "--delimiter", ";", "--header")
    assert by_name == by_number
    assert by_name["area"] == am.AlphaComplex(rows[:, [2, 1]]).at().area


def test_mesh_of_a_table_whose_format_the_name_hides(table):
    Path(table).rename("points.odd")
    assert facts("mesh", "points.odd", "--from", "csv")["points"] == 300


def test_mesh_of_a_degenerate_cloud(folder):
    Path("line.csv").write_text("x,y\n0,0\n1,1\n2,2\n")
    out = facts("mesh", "line.csv", "-o", "line.npz", "--plot", "line.png")
    assert (out["dimension"], out["triangles"], out["singular_edges"]) == (1, 0, 2)
    assert len(out["files"]) == 2


def test_mesh_at_an_infinite_radius_is_the_triangulation(table):
    out = facts("mesh", table, "--radius", "inf")
    alpha = am.AlphaComplex(am.read_points(table))
    assert out["triangles"] == len(alpha.simplices[2])
    assert out["radius"] is None  # JSON has no infinity


def test_the_same_command_gives_the_same_bytes(image):
    for name in ("one", "two"):
        ok("mesh", image, "-o", f"{name}.ply", "--plot", f"{name}.svg")
    assert Path("one.ply").read_bytes() == Path("two.ply").read_bytes()
    assert Path("one.svg").read_bytes() == Path("two.svg").read_bytes()
    assert facts("mesh", image, "--seed", "1")["area"] != facts("mesh", image)["area"]


def test_threads_do_not_change_the_result(table):
    assert facts("mesh", table, "--threads", "1") == facts("mesh", table, "--threads", "3")


def test_a_format_that_loses_something_warns(table):
    radius = am.AlphaComplex(am.read_points(table)).choose_radius("all-points").radius
    result = run("mesh", table, "-r", str(radius / 2), "-o", "m.stl")
    assert result.exit_code == 0
    assert "Warning: m.stl: STL files cannot hold" in result.stderr


def test_options_that_have_no_meaning_are_refused(table, image):
    text = refused(2, "mesh", table, "--points", "10")
    assert "--points has no meaning for 'points.csv', which is a table" in text
    assert "--columns has no meaning" in refused(2, "mesh", image, "--columns", "x,y")
    assert "--invert has no meaning" in refused(2, "mesh", "demo:disc", "--invert")


def test_other_columns_can_stay_with_the_vertices(points):
    heights = np.arange(200) % 17
    rows = np.column_stack((points, heights))
    np.savetxt("t.csv", rows, delimiter=",", header="x,y,height", comments="", fmt="%.17g")
    ok("mesh", "t.csv", "-r", "inf", "--keep-columns", "-o", "m.npz")
    np.testing.assert_array_equal(read_mesh("m.npz").point_data["height"], heights)
    ok("mesh", "t.csv", "-r", "inf", "-o", "n.npz")
    assert "height" not in read_mesh("n.npz").point_data


def test_points_in_space_make_tetrahedra(folder):
    points = np.random.default_rng(2).random((60, 3))
    np.savetxt("p.csv", points, delimiter=",", header="x,y,z", comments="", fmt="%.17g")
    args = ("p.csv", "--columns", "x,y,z")
    out = facts("mesh", *args, "-r", "0.3", "-o", "m.npz")
    shape = am.AlphaComplex(points).at(0.3)
    assert (out["dimension"], out["volume"]) == (3, shape.volume)
    assert out["tetrahedra"] == len(shape.tetrahedra) > 0
    assert len(read_mesh("m.npz").cells["tetra"]) == out["tetrahedra"]
    assert f"{shape.volume:.6g} m³" in ok("mesh", *args, "-r", "0.3", "--units", "m")
    chosen = facts("mesh", *args)
    assert chosen["radius"] == am.AlphaComplex(points).choose_radius().radius
    table = ok("mesh", "p.csv", "--output-dir", "o", "--columns", "x,y,z").splitlines()[0]
    assert table.split()[1:6] == ["points", "radius", "triangles", "tetrahedra", "volume"]
    ok("filtration", *args, "-o", "f.csv")
    assert (
        Path("f.csv").read_text().startswith("dimension,vertex_0,vertex_1,vertex_2,vertex_3,")
    )
