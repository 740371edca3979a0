"""``alphamesh hull``, ``delaunay`` and ``animate`` of points in space."""

import numpy as np
import pytest

import alphamesh as am
from alphamesh.io.meshes import read_mesh
from cli_tools import facts, ok, refused, run

CUBE = np.array([[x, y, z] for x in (0, 2) for y in (0, 2) for z in (0, 2)] + [[1, 1, 1]])


@pytest.fixture
def cube(folder):
    lines = "".join("{},{},{}\n".format(*row) for row in CUBE.tolist())
    (folder / "cube.csv").write_text("x,y,z\n" + lines)
    return folder


def test_hull_in_space(cube):
    out = facts(
        "hull", "cube.csv", "-o", "a.stl", "-o", "a.csv", "-o", "a.ply", "--plot", "a.png"
    )
    assert (out["corners"], out["triangles"]) == (8, 12)
    assert out["volume"] == pytest.approx(8.0) and out["area"] == pytest.approx(24.0)
    table = np.genfromtxt("a.csv", delimiter=",", names=True)
    assert table["row"].tolist() == list(range(8))
    np.testing.assert_array_equal(np.column_stack([table[name] for name in "xyz"]), CUBE[:8])
    assert len(read_mesh("a.ply").cells["triangle"]) == 12
    assert (cube / "a.png").stat().st_size > 5_000


def test_hull_in_space_says_what_it_cannot(cube):
    assert "--collinear is for points in the plane" in refused(
        2, "hull", "cube.csv", "--collinear"
    )
    (cube / "flat.csv").write_text("x,y,z\n0,0,0\n1,0,1\n0,1,1\n1,1,2\n")
    done = run("hull", "flat.csv", "-o", "a.stl")
    assert done.exit_code == 1 and "all points lie in one plane" in done.stderr
    assert not (cube / "a.stl").exists()
    (cube / "plane.csv").write_text("x,y\n0,0\n1,0\n0,1\n")
    assert "is a ring, not a mesh" in refused(2, "hull", "plane.csv", "-o", "a.stl")


def test_delaunay_in_space(cube):
    out = facts("delaunay", "cube.csv", "-o", "a.vtu", "--plot", "a.png")
    made = am.delaunay(CUBE.astype(float))
    assert out["tetrahedra"] == len(made.tetrahedra) == 12
    assert out["boundary_triangles"] == 12 and out["volume"] == pytest.approx(8.0)
    assert len(read_mesh("a.vtu").cells["tetra"]) == 12
    assert "points in the plane" in refused(2, "delaunay", "cube.csv", "--frame", "box")


def test_film_in_space(cube):
    said = ok(
        *("animate", "cube.csv", "-o", "a.gif", "--frames", "3", "--width", "200"),
        *("--turn", "30"),
    )
    assert "Frames" in said and (cube / "a.gif").stat().st_size > 5_000
