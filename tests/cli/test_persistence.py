"""``alphamesh persistence``."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import alphamesh as am
from cli_tools import facts, ok


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
