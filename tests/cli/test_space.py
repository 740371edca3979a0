"""Commands on points in space, and in the plane where a third column is left out."""

from __future__ import annotations

import json

import numpy as np
import pytest
from click.testing import CliRunner

import alphamesh as am
from alphamesh.cli.app import app
from alphamesh.io.meshes import read_mesh


@pytest.fixture(name="run")
def make_run():
    """Return a function that runs a command in an empty folder with clouds in it."""
    rng = np.random.default_rng(0)
    directions = rng.standard_normal((1500, 3))
    directions /= np.linalg.norm(directions, axis=1)[:, np.newaxis]
    shell = directions * rng.uniform(0.75, 1.0, (1500, 1))
    np.savetxt("scan.xyz", shell)
    np.savetxt("scan.csv", shell, delimiter=",", header="x,y,z", comments="")

    def run(*arguments, code=0):
        done = CliRunner().invoke(app, [*arguments, "--quiet"], catch_exceptions=False)
        assert done.exit_code == code, done.output
        return done.stdout

    return run


@pytest.mark.parametrize("name", ["scan.xyz", "scan.csv"])
def test_meshes_of_solids(run, name):
    pytest.importorskip("meshio")
    told = json.loads(
        run("mesh", name, "-o", "solid.vtu", "-o", "solid.off", "--complex", "--json")
    )
    shape = am.AlphaComplex(am.read_points(name)).at()
    assert told["dimension"] == 3 and told["rule"] == "topology"
    assert told["radius"] == shape.radius
    assert (
        told["tetrahedra"]
        == len(shape.tetrahedra)
        == len(read_mesh("solid.vtu").cells["tetra"])
    )
    assert told["volume"] == shape.volume and told["surface_area"] == shape.surface_area
    assert told["regions"] == len(shape.regions) and told["voids"] == len(shape.voids)
    assert told["void_volumes"] == shape.voids.volumes.tolist()
    triangles = shape.counts["regular_triangles"] + shape.counts["singular_triangles"]
    assert len(read_mesh("solid.off").cells["triangle"]) == triangles
    lines = run("mesh", name, "--radius", "0.3")
    volume = f"{am.AlphaComplex(am.read_points(name)).at(0.3).volume:.6g}"
    assert f"{'Volume':19}{volume}" in lines and f"{'Voids':19}1\n" in lines


def test_what_commands_tell_of_clouds_in_space(run):
    told = json.loads(run("info", "scan.xyz", "--json"))
    assert told["dimension"] == 3 and len(told["bounds"][0]) == 3
    told = json.loads(
        run("radius", "scan.xyz", "--rule", "tetrahedron-count", "--tetrahedra", "99", "--json")
    )
    cx = am.AlphaComplex(am.read_points("scan.xyz"))
    assert told["radius"] == cx.choose_radius("tetrahedron-count", tetrahedra=99).radius
    np.savetxt("flat.csv", [[0, 0, 1], [1, 0, 2], [0, 1, 2], [1, 1, 3]], delimiter=",")
    assert "2, all in one plane" in run("info", "flat.csv", "--columns", "0,1,2")


def test_the_radius_in_space(run):
    cx = am.AlphaComplex(am.read_points("scan.xyz"))
    choice = cx.choose_radius()
    assert choice.betti == (1, 0, 1)
    told = json.loads(run("radius", "scan.xyz", "--json"))
    assert told["betti"] == [1, 0, 1] and told["interval"] == list(choice.interval)
    assert told["radius"] == choice.radius and told["reason"] == choice.reason
    assert "1 component, 0 tunnels, 1 void\n" in run("radius", "scan.xyz")
    told = json.loads(run("radius", "scan.xyz", "--voids", "0", "--solid", "--json"))
    assert told["radius"] == cx.choose_radius(voids=0, surface=False).radius
    told = json.loads(run("mesh", "scan.xyz", "-r", "topology:betti=1,0,1", "--json"))
    assert told["radius"] == cx.choose_radius(betti=(1, 0, 1)).radius
    assert "not components and holes" in CliRunner().invoke(
        app, ["radius", "scan.xyz", "--betti", "1"]
    ).output  # fmt: skip
    flat = CliRunner().invoke(app, ["radius", "demo:eight", "-n", "300", "--voids", "1"])
    assert flat.exit_code == 2 and "voids= and surface= are for points in space" in flat.output


def test_commands_of_the_plane_leave_z_out(run):
    flat = json.loads(run("mesh", "scan.csv", "--columns", "x,y", "--json"))
    assert flat["dimension"] == 2 and flat["area"] > 0
    told = json.loads(run("voronoi", "scan.csv", "--json"))
    assert told["cells"] == len(am.read_points("scan.csv", dimension=2))


def test_what_does_not_go_in_space_says_so(run):
    done = CliRunner().invoke(app, ["mesh", "scan.xyz", "--radius", "longest-interval"])
    assert "in the plane alone" in done.output + str(done.exception)
    done = CliRunner().invoke(app, ["info", "scan.csv", "--columns", "x,y,z,x"])
    assert done.exit_code == 2 and "not two or three columns" in done.output
