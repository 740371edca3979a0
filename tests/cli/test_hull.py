"""``alphamesh hull``."""

from __future__ import annotations

from pathlib import Path

import numpy as np

import alphamesh as am
from cli_tools import facts, ok


def test_hull_writes_its_corners(points):
    out = facts("hull", "points.csv", "-o", "a.csv", "-o", "a.parquet", "--plot", "a.png")
    hull = am.convex_hull(points)
    assert (out["corners"], out["area"]) == (len(hull.ring), hull.area)
    assert out["perimeter"] == hull.perimeter
    table = np.genfromtxt("a.csv", delimiter=",", names=True)
    np.testing.assert_array_equal(table["row"], hull.ring)
    np.testing.assert_array_equal(table["x"], points[hull.ring, 0])
    np.testing.assert_array_equal(am.read_points("a.parquet"), hull.corners)
    assert Path("a.png").stat().st_size > 5000


def test_hull_keeps_points_between_corners_where_asked(folder):
    Path("p.csv").write_text("0,0\n1,0\n2,0\n2,2\n0,2\n")
    assert facts("hull", "p.csv")["corners"] == 4
    assert facts("hull", "p.csv", "--collinear")["corners"] == 5


def test_units_are_told(points):
    text = ok("hull", "points.csv", "--units", "km")
    hull = am.convex_hull(points)
    assert f"{hull.area:.6g} km²" in text
    assert f"{hull.perimeter:.6g} km\n" in text
    assert facts("hull", "points.csv", "--units", "km")["units"] == "km"
    assert "units" not in facts("hull", "points.csv")
