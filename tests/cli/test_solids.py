"""Solids and scanned surfaces on the command line: what is written is watertight."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

import alphamesh as am
from alphamesh.check import check_surface
from alphamesh.cli.write_points import POINT_WRITERS
from alphamesh.io.meshes import read_mesh
from cli_tools import facts, ok, refused, run

# Radii at which samples of 4,000 points of the solids have their topology.
_RADII = {
    **{"ball": 0.35, "shell": 0.3, "torus": 0.25, "double-torus": 0.2, "two-balls": 0.4},
    **{"linked-rings": 0.2, "trefoil": 0.14, "hollow-torus": 0.17},
}


def genera_in_trimesh(path: str) -> list[int]:
    """Return the genus of each shell of a file, which must be watertight and oriented."""
    trimesh = pytest.importorskip("trimesh")
    loaded = trimesh.load_mesh(path)
    assert loaded.is_watertight and loaded.is_winding_consistent and loaded.is_volume
    shells = loaded.split(only_watertight=False)
    return sorted((1 - shell.euler_number // 2 for shell in shells), reverse=True)


@pytest.mark.parametrize("name", am.DEMO_SOLIDS)
def test_stl_of_a_solid_is_watertight_and_has_its_genus(name):
    solid = am.DEMO_SOLIDS[name]
    told = facts(
        *("mesh", f"demo:{name}", "-n", "4000", "-r", str(_RADII[name]), "-o", "a.stl"),
        *("--fill-voids", "0.05", "--min-volume", "0.1"),
    )
    assert told["watertight"] and tuple(told["genera"]) == solid.genera
    assert genera_in_trimesh("a.stl") == list(solid.genera)
    assert (told["regions"], told["voids"]) == (solid.betti[0], solid.betti[2])
    assert told["outer_shells"] == solid.betti[0]


@pytest.mark.parametrize("name", ["ball", "torus", "double-torus", "two-balls", "linked-rings"])
def test_scans_of_surfaces_are_found_out_closed_and_filled(name):
    solid = am.DEMO_SOLIDS[name]
    told = facts("mesh", f"demo:{name}-surface", "-n", "3000", "-o", "a.stl", "-o", "a.vtu")
    assert told["scan"] and told["rule"] == "enclosed" and told["voids"] == 0
    assert tuple(told["genera"]) == solid.genera == tuple(genera_in_trimesh("a.stl"))
    assert len(read_mesh("a.vtu").cells["tetra"]) == told["tetrahedra"]
    assert len(np.unique(read_mesh("a.stl").points, axis=0)) > 0.95 * 3000
    assert "Taken for" in ok("mesh", f"demo:{name}-surface", "-n", "3000")


def test_solids_are_not_taken_for_scans_and_strays_hide_none():
    for name in ("ball", "torus", "trefoil", "shell"):
        assert not facts("mesh", f"demo:{name}", "-n", "1000")["scan"]
    scan = am.sample_solid("torus", 3000, seed=1, surface=True)
    np.savetxt("scan.xyz", np.concatenate([scan, [[5.0, 5, 5], [-7, 2, 1]]]))
    told = facts("mesh", "scan.xyz")
    assert told["scan"] and told["genera"] == [1]


def test_grids_are_solids_unless_hollow():
    grid = np.stack(np.meshgrid(*[np.arange(9.0)] * 3), axis=-1).reshape(-1, 3)
    cavity = (np.abs(grid - 4) <= 1).all(axis=1)
    skin = ((grid == 0) | (grid == 8)).any(axis=1)
    expected = {"solid": (False, 512.0), "cavity": (False, 448.0), "skin": (True, 512.0)}
    for name, kept in (("solid", grid[:, 0] >= 0), ("cavity", ~cavity), ("skin", skin)):
        np.savetxt(f"{name}.xyz", grid[kept])
        told = facts("mesh", f"{name}.xyz")
        scan, volume = expected[name]
        assert told["scan"] == scan
        assert told["volume"] == pytest.approx(volume, rel=0.1)


def test_scan_options():
    source = ("mesh", "demo:torus-surface", "-n", "2000")
    as_solid = facts(*source, "--no-scan")
    cloud = am.sample_solid("torus", 2000, seed=0, surface=True)
    cx = am.AlphaComplex(cloud)
    assert not as_solid["scan"] and as_solid["radius"] == cx.choose_radius().radius
    given = facts(*source, "--scan", "--radius", "0.25")
    shape = cx.at(0.25).filtered(max_void_volume=np.inf)
    assert given["radius"] == 0.25 and given["volume"] == shape.volume and given["voids"] == 0
    asked = facts("mesh", "demo:shell", "--scan")
    assert asked["rule"] == "enclosed" and asked["voids"] == 0


def test_filling_and_dropping():
    source = ("mesh", "demo:hollow-torus", "-n", "4000", "-r", "0.17")
    plain, filled = facts(*source), facts(*source, "--fill-voids", "all")
    assert (plain["voids"], filled["voids"]) == (1, 0)
    assert filled["volume"] == pytest.approx(plain["volume"] + plain["void_volumes"][0])
    balls = ("mesh", "demo:two-balls", "-n", "2000", "-r", "0.4")
    first = facts(*balls, "--largest", "1")
    assert first["region_volumes"] == facts(*balls)["region_volumes"][:1]
    assert facts(*balls, "--min-volume", "100")["regions"] == 0


def test_surface_and_complex():
    source = ("mesh", "demo:torus-surface", "-n", "2000", "-r", "0.1")
    done = run(*source, "-o", "a.ply", "-o", "b.ply", "--json")
    shape = am.AlphaComplex(am.sample_solid("torus", 2000, seed=0, surface=True)).at(0.1)
    assert done.stderr.count("singular triangles") == 2
    assert f"{len(shape.singular_triangles):,} singular triangles" in done.stderr
    written = read_mesh("a.ply")
    np.testing.assert_array_equal(written.cells["triangle"], shape.surface().triangles)
    check_surface(shape.surface(), shape)
    ok(*source, "-o", "c.ply", "--complex")
    both = len(shape.boundary_triangles) + len(shape.singular_triangles)
    assert len(read_mesh("c.ply").cells["triangle"]) == both


def test_no_surface_no_file():
    message = refused_but_told("mesh", "demo:ball", "-n", "100", "-r", "0.001", "-o", "a.stl")
    assert "no tetrahedron" in message and "--complex" in message
    assert not Path("a.stl").exists()
    Path("flat.csv").write_text("x,y,z\n0,0,0\n1,0,1\n0,1,1\n1,1,2\n")
    ok("mesh", "flat.csv", "-r", "2", "-o", "flat.ply")
    assert len(read_mesh("flat.ply").cells["triangle"]) == 2


def refused_but_told(*args: str) -> str:
    """Return the message of a command that did its work, but for a file."""
    result = run(*args)
    assert result.exit_code == 1 and "Traceback" not in result.stderr
    return " ".join(result.stderr.split())


def test_stl_that_readers_will_not_find_watertight_is_told_of():
    done = run("mesh", "demo:torus", "-n", "3000", "--radius", "all-points", "-o", "a.stl")
    assert done.exit_code == 0 and "not watertight to them" in done.stderr
    trimesh = pytest.importorskip("trimesh")
    assert not trimesh.load_mesh("a.stl").is_watertight
    done = run("mesh", "demo:torus", "-n", "3000", "--radius", "all-points", "-o", "a.off")
    assert "not watertight" not in done.stderr and facts("info", "a.off")["watertight"]


def test_options_of_solids_are_refused_in_the_plane(points):
    for option in (["--scan"], ["--fill-voids", "1"], ["--largest", "2"], ["--surface"]):
        assert "points in the plane" in refused(2, "mesh", "points.csv", *option)
    assert "nor all" in refused(2, "mesh", "demo:ball", "--fill-voids", "some")
    assert "demo solid" in refused(2, "mesh", "demo:ball", "--no-jitter")
    assert "-surface" in refused(2, "mesh", "demo:cube")
    assert "in space" in refused(1, "voronoi", "demo:ball", "-o", "a.csv")


def test_many_solids_at_once():
    batch = ("mesh", "demo:ball-surface", "demo:torus-surface", "--output-dir", "out")
    told = facts(*batch, "--to", "stl", "-n", "1500")
    assert json.dumps(told).count('"watertight": true') == 2
    assert genera_in_trimesh("out/torus-surface.stl") == [1]


@pytest.mark.parametrize(
    "view", ["overview", "cloud", "complex", "surface", "diagram", "betti"]
)
def test_pictures_of_solids(view):
    from PIL import Image

    out = facts("plot", "demo:torus-surface", "-n", "500", "--view", view, "-o", "a.png")
    assert out["view"] == view
    with Image.open("a.png") as image:
        assert (np.asarray(image.convert("L")) < 200).mean() > 0.001


def test_pictures_in_the_wrong_space(points):
    scan = ("plot", "demo:ball", "-n", "200", "-o", "a.png")
    assert facts(*scan)["view"] == "overview"
    assert "plane" in refused(1, *scan, "--view", "voronoi")
    assert "in space" in refused(1, "plot", "points.csv", "--view", "surface", "-o", "b.png")
    assert "--largest" in refused(2, *scan, "--view", "cloud", "--largest", "1")


def test_the_overview_shows_the_solid_that_is_written():
    from PIL import Image

    source = ("mesh", "demo:torus-surface", "-n", "500")
    ok(*source, "--plot", "scan.png")
    ok(*source, "--no-scan", "--plot", "solid.png")
    with Image.open("scan.png") as scan, Image.open("solid.png") as solid:
        assert scan.size == solid.size
        assert (np.asarray(scan) != np.asarray(solid)).any(axis=2).mean() > 0.01


def test_measures_in_space():
    told = facts("measures", "demo:torus", "--radii", "0.05,0.2,0.3")
    cx = am.AlphaComplex(am.sample_solid("torus", 2000, seed=0))
    for place, radius in enumerate((0.05, 0.2, 0.3)):
        shape = cx.at(radius)
        betti = tuple(told[name][place] for name in ("components", "loops", "voids"))
        assert betti == shape.betti
        assert told["volume"][place] == pytest.approx(shape.volume)
        assert told["surface_area"][place] == pytest.approx(shape.surface_area)
        assert told["tetrahedra"][place] == len(shape.tetrahedra)


def test_info_tells_what_a_surface_is():
    told = facts("info", "demo:hollow-torus")
    assert (told["components"], told["loops"], told["voids"]) == (1, 2, 1)
    source = ("mesh", "demo:hollow-torus", "-n", "4000", "-r", "0.17")
    made = facts(*source, "-o", "a.ply", "-o", "a.stl", "-o", "a.vtu")
    for name in ("a.ply", "a.stl"):
        told = facts("info", name)
        assert told["watertight"] and (told["shells"], told["genus"]) == (2, 2)
        assert told["volume"] == pytest.approx(made["volume"], rel=1e-5)
        assert told["area"] == pytest.approx(made["surface_area"], rel=1e-5)
    assert "watertight" not in facts("info", "a.vtu")
    ok(*source[:-1], "0.08", "--complex", "-o", "open.ply")
    assert not facts("info", "open.ply")["watertight"]
    assert "with one triangle alone" in ok("info", "open.ply")
    assert "watertight" not in facts("info", made_flat())


def made_flat() -> str:
    ok("mesh", "demo:disc", "-n", "300", "-o", "flat.ply")
    return "flat.ply"


@pytest.mark.parametrize("suffix", POINT_WRITERS)
def test_samples_of_solids_come_back(suffix):
    if suffix == ".pcd":
        pytest.importorskip("pypcd4")
    if suffix == ".parquet":
        pytest.importorskip("pyarrow")
    ok("sample", "demo:torus-surface", "-n", "300", "--seed", "3", "-o", f"a{suffix}")
    drawn = am.sample_solid("torus", 300, seed=3, surface=True)
    columns = {} if suffix != ".txt" else {"columns": (0, 1, 2)}
    np.testing.assert_array_equal(am.read_points(f"a{suffix}", **columns), drawn)
    if suffix != ".csv":
        ok("convert", f"a{suffix}", "b.csv", *(["--columns", "0,1,2"] if columns else []))
        np.testing.assert_array_equal(am.read_points("b.csv"), drawn)


def test_pcd_of_points_in_the_plane():
    pytest.importorskip("pypcd4")
    ok("sample", "demo:annulus", "-n", "50", "-o", "a.pcd")
    read = am.read_points("a.pcd", dimension=2)
    np.testing.assert_array_equal(read, am.demo_cloud("annulus", 50, seed=0))


def test_places_are_looked_up_in_solids():
    places = np.random.default_rng(1).uniform(-1.5, 1.5, (60, 3))
    np.savetxt("places.csv", places, delimiter=",", header="x,y,z", comments="", fmt="%.17g")
    shape = am.AlphaComplex(am.sample_solid("torus", 2000, seed=0)).at(0.25)
    ok("query", "demo:torus", "places.csv", "-r", "0.25", "--nearest", "-o", "a.csv")
    table = np.genfromtxt("a.csv", delimiter=",", names=True)
    np.testing.assert_array_equal(np.column_stack([table[name] for name in "xyz"]), places)
    np.testing.assert_array_equal(table["inside"], shape.contains(places))
    np.testing.assert_array_equal(table["region"], shape.region_of(places))
    np.testing.assert_allclose(table["distance"], shape.distance(places, signed=True))
    np.testing.assert_array_equal(table["nearest_z"], shape.nearest(places).points[:, 2])
    scanned = facts("query", "demo:torus-surface", "places.csv")
    assert scanned["rule"] == "enclosed" and 0 < scanned["inside"] < 60


def test_places_and_points_of_other_dimensions(points):
    rows = np.random.default_rng(5).random((20, 3)) * 500
    np.savetxt("places.csv", rows, delimiter=",", header="x,y,z", comments="", fmt="%.17g")
    ok("query", "points.csv", "places.csv", "-r", "30", "-o", "a.csv")
    table = np.genfromtxt("a.csv", delimiter=",", names=True)
    shape = am.AlphaComplex(points).at(30.0)
    np.testing.assert_array_equal(table["inside"], shape.contains(rows[:, :2]))
    np.testing.assert_array_equal(table["z"], rows[:, 2])
    flat = ("query", "demo:ball", "places.csv", "--places-columns", "x,y")
    assert "in space" in refused(1, *flat)


def test_regions_and_voids_of_solids():
    source = ("regions", "demo:hollow-torus", "-n", "4000", "-r", "0.17")
    shape = am.AlphaComplex(am.sample_solid("hollow-torus", 4000, seed=0)).at(0.17)
    (region,) = facts(*source)["regions"]
    assert region["volume"] == pytest.approx(shape.volume)
    assert region["tetrahedra"] == len(shape.tetrahedra)
    assert region["centroid_z"] == pytest.approx(0, abs=0.05)
    (void,) = facts(*source, "--holes")["holes"]
    assert void["volume"] == pytest.approx(shape.voids.volumes[0])
    assert facts(*source, "--fill-voids", "all", "--holes")["holes"] == []
    assert "--fill-voids" in refused(2, *source, "--fill-holes", "3")
    assert "surface_area" in ok(*source)
