"""Commands that draw, film and tell: plot, animate, voronoi, delaunay, persistence, radius."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("click")
pytest.importorskip("rich")
pytest.importorskip("matplotlib")

from click.testing import CliRunner, Result
from PIL import Image

import alphamesh as am
from alphamesh.cli.app import app
from alphamesh.cli.delaunay import _FRAMES
from alphamesh.cli.plot import VIEWS
from alphamesh.io.meshes import read_mesh


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Run every test in a folder of its own."""
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def points(folder: Path) -> np.ndarray:
    """A table of 200 points, ``points.csv``."""
    cloud = am.demo_cloud("eight", 200, seed=4)
    np.savetxt("points.csv", cloud, delimiter=",", header="x,y", comments="", fmt="%.17g")
    return cloud


def run(*args: str, stdin: bytes | None = None) -> Result:
    return CliRunner().invoke(app, args, input=stdin, prog_name="alphamesh")


def ok(*args: str, stdin: bytes | None = None) -> str:
    result = run(*args, stdin=stdin)
    assert result.exit_code == 0, result.output
    return result.stdout


def facts(*args: str, stdin: bytes | None = None) -> dict:
    return json.loads(ok(*args, "--json", stdin=stdin))


def refused(code: int, *args: str) -> str:
    result = run(*args)
    assert result.exit_code == code, result.output
    assert "Traceback" not in result.stderr
    return " ".join(result.stderr.split())


# plot


@pytest.mark.parametrize("view", VIEWS)
def test_every_view_makes_a_picture(points, view):
    out = facts("plot", "points.csv", "--view", view, "-o", "a.png", "--dpi", "40", "-r", "30")
    assert out["view"] == view
    assert ("radius" in out) == VIEWS[view]
    with Image.open("a.png") as image:
        assert (np.asarray(image.convert("L")) < 250).any()


def test_plot_chooses_a_radius_and_writes_several_files(points):
    out = facts("plot", "points.csv", "-o", "a.svg", "-o", "a.pdf")
    choice = am.AlphaComplex(points).choose_radius()
    assert out["radius"] == choice.radius
    assert out["rule"] == choice.rule
    assert [file["path"] for file in out["files"]] == ["a.svg", "a.pdf"]
    assert Path("a.svg").read_text().count("<path") > 50


def test_plot_of_what_is_not_there(points):
    assert "--output" in refused(2, "plot", "points.csv")
    assert "story" in refused(2, "plot", "points.csv", "-o", "a.png", "--view", "nice")
    assert "finite" in refused(
        2, "plot", "points.csv", "-o", "a.png", "--view", "union", "-r", "inf"
    )


# animate


def test_animate_writes_films(points):
    out = facts(
        "animate",
        "points.csv",
        "-o",
        "a.gif",
        "-o",
        "a.webp",
        "--frames",
        "3",
        "--width",
        "200",
    )
    assert out["frames"] == 3 == len(out["radii"])
    for name in ("a.gif", "a.webp"):
        with Image.open(name) as film:
            assert film.n_frames == 3
            assert film.size[0] == 200


def test_animate_takes_radii(points):
    said = ok("animate", "points.csv", "-o", "a.gif", "--radii", "5,10,20,40", "--width", "200")
    assert "5 to 40" in said
    with Image.open("a.gif") as film:
        assert film.n_frames == 4
    assert "even, quantiles, log" in refused(
        2, "animate", "points.csv", "-o", "a.gif", "--radii", "cubic"
    )
    assert "no finite radius" in refused(
        2, "animate", "points.csv", "-o", "a.gif", "--radii", "1,-2"
    )


def test_animate_tells_before_the_work_what_cannot_be_written(points, monkeypatch, folder):
    monkeypatch.setenv("PATH", str(folder))
    assert "ffmpeg" in refused(1, "animate", "no-such.csv", "-o", "a.mp4")
    assert ".gif, .webp, .mp4" in refused(2, "animate", "points.csv", "-o", "a.avi")


# voronoi


def test_voronoi_cells_as_a_table_and_as_arrays(points):
    out = facts("voronoi", "points.csv", "-o", "a.csv", "-o", "a.npz", "--plot", "a.svg")
    cells = am.voronoi(points)
    assert out["cells"] == 200
    assert out["bounded"] == np.count_nonzero(cells.bounded)
    assert out["ridges"] == len(cells.ridge_points)
    table = np.genfromtxt("a.csv", delimiter=",", names=True)
    np.testing.assert_array_equal(table["area"], cells.areas)
    np.testing.assert_array_equal(table["neighbors"], np.diff(cells.offset))
    with np.load("a.npz") as arrays:
        for name in arrays.files:
            np.testing.assert_array_equal(arrays[name], getattr(cells, name))
    assert Path("a.svg").stat().st_size > 1000


def test_voronoi_cells_cut_by_discs(points):
    out = facts(
        "voronoi", "points.csv", "-r", "20", "-o", "a.tsv", "-o", "a.npz", "--plot", "a.png"
    )
    cells = am.AlphaComplex(points).restricted_voronoi(20.0)
    assert out["area"] == cells.total_area
    assert out["outer_length"] == cells.outer_length
    assert out["pairs_that_touch"] == len(cells.edges)
    table = np.genfromtxt("a.tsv", delimiter="\t", names=True)
    np.testing.assert_array_equal(table["area"], cells.area)
    assert table["neighbors"].sum() == 2 * len(cells.edges)
    with np.load("a.npz") as arrays:
        np.testing.assert_array_equal(arrays["angles"], cells.angles)
        assert arrays["radius"] == 20.0


def test_voronoi_chooses_a_radius_where_asked(points):
    choice = am.AlphaComplex(points).choose_radius()
    out = facts("voronoi", "points.csv", "-r", "auto")
    assert (out["radius"], out["rule"]) == (choice.radius, choice.rule)
    assert f"({choice.rule})" in ok("voronoi", "points.csv", "-r", "auto")


# delaunay


def test_delaunay_writes_the_triangulation(points):
    out = facts("delaunay", "points.csv", "-o", "a.ply", "--plot", "a.png")
    triangulation = am.delaunay(points)
    assert out["triangles"] == len(triangulation.triangles)
    assert out["area"] == pytest.approx(am.convex_hull(points).area)
    assert out["boundary_edges"] == len(am.convex_hull(points, collinear=True).ring)
    mesh = read_mesh("a.ply")
    assert len(mesh.cells["triangle"]) == len(triangulation.triangles)


@pytest.mark.parametrize("shape", am.FRAME_SHAPES)
def test_delaunay_within_a_frame(points, shape):
    out = facts(
        *("delaunay", "points.csv", "--frame", shape, "--margin", "6", "--spacing", "9"),
        *("-o", "a.vtk", "--plot", "a.png"),
    )
    framed = am.framed_delaunay(points, am.Frame(shape, 6, 9))
    assert out["frame"] == shape
    assert out["triangles"] == len(framed.triangles)
    assert out["frame_points"] == len(framed.frame_points)
    assert out["area"] < am.convex_hull(points).area


def test_frames_of_the_command_are_those_of_the_library(points):
    assert _FRAMES == am.FRAME_SHAPES
    assert "--frame box" in refused(2, "delaunay", "points.csv", "--margin", "3")
    assert "margin" in refused(2, "delaunay", "points.csv", "--frame", "box", "--margin", "-3")


def test_delaunay_of_points_on_a_line_is_a_path(folder):
    out = facts("delaunay", "-", "-o", "a.vtk", stdin=b"x,y\n0,0\n2,2\n1,1\n")
    assert (out["triangles"], out["edges"]) == (0, 2)
    assert len(read_mesh("a.vtk").cells["line"]) == 2


# persistence


def test_persistence_writes_all_classes(points):
    out = facts("persistence", "points.csv", "-o", "a.csv", "-o", "a.npz", "--plot", "a.png")
    components, holes = am.AlphaComplex(points).persistence().diagrams()
    assert (out["components"], out["holes"]) == (len(components), len(holes))
    longest = max(death - birth for birth, death in holes)
    birth, death = out["longest_holes"][0]
    assert death - birth == longest
    table = np.genfromtxt("a.csv", delimiter=",", names=True)
    assert (table["dimension"] == 0).sum() == len(components)
    np.testing.assert_array_equal(table["death"][table["dimension"] == 1], holes[:, 1])
    with np.load("a.npz") as arrays:
        np.testing.assert_array_equal(arrays["dimension_0"], components)


def test_persistence_in_squared_radii(points):
    ok("persistence", "points.csv", "-o", "a.npz", "--squared")
    with np.load("a.npz") as arrays:
        expected = am.AlphaComplex(points).persistence().diagram(1, squared=True)
        np.testing.assert_array_equal(arrays["dimension_1"], expected)


@pytest.mark.parametrize("view", ["diagram", "barcode", "betti"])
def test_persistence_can_be_drawn_in_several_ways(points, view):
    ok("persistence", "points.csv", "--plot", "a.png", "--plot-as", view, "-r", "25")
    assert Path("a.png").stat().st_size > 5000


def test_persistence_of_hardly_anything(folder):
    out = facts("persistence", "-", stdin=b"x,y\n0,0\n")
    assert (out["components"], out["holes"], out["connected_from"]) == (1, 0, 0)
    assert "none" in ok("persistence", "-", stdin=b"x,y\n0,0\n1,0\n")


# radius


def test_radius_tells_what_is_chosen_and_why(points):
    choice = am.AlphaComplex(points).choose_radius()
    out = facts("radius", "points.csv")
    assert out["radius"] == choice.radius
    assert out["reason"] == choice.reason
    assert tuple(out["betti"]) == choice.betti
    said = " ".join(ok("radius", "points.csv").split())
    assert choice.reason in said
    assert f"({choice.rule})" in said


def test_radius_passes_options_to_its_rule(points):
    choice = am.AlphaComplex(points).choose_radius("regions", regions=2)
    out = facts("radius", "points.csv", "--rule", "regions", "--regions", "2")
    assert out["radius"] == choice.radius
    wrong = refused(2, "radius", "points.csv", "--rule", "all-points", "--regions", "2")
    assert "no option 'regions'" in wrong
    assert "all-points" in refused(2, "radius", "points.csv", "--rule", "best")
    assert "such as 1,2" in refused(2, "radius", "points.csv", "--betti", "3")


def test_radius_of_no_points_is_refused(folder):
    Path("none.csv").write_text("x,y\n")
    assert run("radius", "none.csv").exit_code == 1


# demo


def test_demo_films_unless_it_must_be_quick(folder):
    out = facts("demo", "g", "--shapes", "annulus,bars", "-n", "60", "--quick")
    names = {name for shape in out["shapes"] for name in shape["files"]}
    assert [shape["name"] for shape in out["shapes"]] == ["annulus", "bars"]
    assert not any(name.endswith(".gif") for name in names)
    assert names | {"index.html"} == {path.name for path in Path("g").iterdir()}
    out = facts("demo", "h", "--shapes", "disc", "-n", "30")
    film = next(name for name in out["shapes"][0]["files"] if name.endswith(".gif"))
    with Image.open(Path("h") / film) as image:
        assert image.n_frames == 40
    assert film in Path("h/index.html").read_text()
