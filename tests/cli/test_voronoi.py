"""``alphamesh voronoi``."""

from __future__ import annotations

from pathlib import Path

import numpy as np

import alphamesh as am
from cli_tools import facts


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
