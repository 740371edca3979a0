"""``alphamesh restricted``."""

from __future__ import annotations

import numpy as np

import alphamesh as am
from cli_tools import facts, ok


def test_cells_as_a_table_and_as_arrays(points):
    out = facts(
        "restricted", "points.csv", "-r", "20", "-o", "a.tsv", "-o", "a.npz", "--plot", "a.png"
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


def test_restricted_chooses_the_radius_unless_given(points):
    choice = am.AlphaComplex(points).choose_radius()
    out = facts("restricted", "points.csv", "-r", "auto")
    assert (out["radius"], out["rule"]) == (choice.radius, choice.rule)
    assert f"({choice.rule})" in ok("restricted", "points.csv", "-r", "auto")
