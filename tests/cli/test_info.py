"""``alphamesh info``."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import alphamesh as am
from alphamesh.cli.info import nearest_distances
from cli_tools import facts, ok, refused


def test_info_of_points(table):
    out = facts("info", table)
    alpha = am.AlphaComplex(am.read_points(table))
    assert (out["points"], out["duplicates"], out["dimension"]) == (300, 5, 2)
    assert out["bounds"] == [
        alpha.points.min(axis=0).tolist(),
        alpha.points.max(axis=0).tolist(),
    ]
    assert out["radius"] == alpha.choose_radius().radius
    assert 0 < out["spacing"]["smallest"] < out["spacing"]["median"] < out["spacing"]["largest"]
    text = ok("info", table)
    assert "300 (5 duplicates)" in text
    assert f"{out['radius']:.6g}" in text


def test_nearest_distances_are_those_of_all_pairs():
    points = np.random.default_rng(3).integers(0, 30, (80, 2)).astype(float)
    distinct = np.unique(points, axis=0)
    apart = np.hypot(*(distinct[:, np.newaxis] - distinct).transpose(2, 0, 1))
    np.fill_diagonal(apart, np.inf)
    found = nearest_distances(am.AlphaComplex(points).filtration)
    np.testing.assert_allclose(np.sort(found), np.sort(apart.min(axis=1)), rtol=1e-15)


@pytest.mark.parametrize(
    ("rows", "dimension", "said"),
    [("5,5\n5,5\n", 0, "all at one place"), ("0,0\n1,1\n5,5\n", 1, "all on one line")],
)
def test_info_of_degenerate_points(rows, dimension, said):
    Path("p.csv").write_text("x,y\n" + rows)
    assert facts("info", "p.csv")["dimension"] == dimension
    assert said in ok("info", "p.csv")


def test_info_of_an_image(image):
    out = facts("info", image)
    assert (out["kind"], out["width"], out["height"]) == ("image", 64, 64)
    assert out["pixels_inside"] == am.demo_mask("eight", 64).sum()
    assert "64 x 64" in ok("info", image)


@pytest.mark.parametrize("suffix", [".ply", ".npz", ".obj", ".off", ".stl"])
def test_info_of_a_mesh(table, suffix):
    made = facts("mesh", table, "-o", f"m{suffix}")
    out = facts("info", f"m{suffix}")
    assert out["kind"] == "mesh"
    assert out["cells"]["face" if suffix == ".ply" else "triangle"] == made["triangles"]
    assert f"{made['triangles']:,} " in ok("info", f"m{suffix}")


def test_info_of_files_that_hold_points_or_meshes(folder):
    points = np.random.default_rng(0).random((20, 2))
    np.savez("p.npz", points=points)
    assert facts("info", "p.npz")["kind"] == "points"
    header = "ply\nformat ascii 1.0\nelement vertex 20\nproperty double x\nproperty double y\n"
    body = "\n".join(f"{x!r} {y!r}" for x, y in points.tolist())
    Path("p.ply").write_text(f"{header}end_header\n{body}\n")
    assert facts("info", "p.ply")["points"] == 20
    Path("bad.npz").write_bytes(b"PK but no archive")
    assert "bad.npz" in refused(1, "info", "bad.npz")


def test_info_of_a_demo_shape():
    out = facts("info", "demo:target")
    assert (out["components"], out["holes"]) == am.DEMO_SHAPES["target"].betti
