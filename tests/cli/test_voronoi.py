"""``alphamesh voronoi``."""

from __future__ import annotations

from pathlib import Path

import numpy as np

import alphamesh as am
from cli_tools import facts, ok


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
