"""``alphamesh delaunay``."""

from __future__ import annotations

import pytest

import alphamesh as am
from alphamesh.cli.delaunay import _FRAMES
from alphamesh.io.meshes import read_mesh
from cli_tools import facts, refused


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
