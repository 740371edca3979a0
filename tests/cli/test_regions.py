"""``alphamesh regions``, and what drops small ones."""

from __future__ import annotations

import numpy as np

import alphamesh as am
from cli_tools import facts, ok, refused


def test_regions_as_a_table(points):
    out = facts("regions", "points.csv", "-r", "15", "-o", "a.csv")
    regions = am.AlphaComplex(points).at(15.0).regions
    assert len(regions) == out["region_count"] == len(out["regions"]) > 1
    table = np.genfromtxt("a.csv", delimiter=",", names=True)
    np.testing.assert_array_equal(table["area"], regions.areas)
    np.testing.assert_array_equal(table["perimeter"], regions.perimeters)
    np.testing.assert_array_equal(table["centroid_x"], regions.centroids[:, 0])
    np.testing.assert_array_equal(table["centroid_y"], regions.centroids[:, 1])
    np.testing.assert_array_equal(table["holes"], regions.hole_counts)
    np.testing.assert_array_equal(table["triangles"], regions.triangle_counts)
    assert out["regions"][0]["area"] == regions.areas[0]


def test_holes_as_a_table(points):
    out = facts("regions", "points.csv", "-r", "30", "--holes", "-o", "a.csv")
    holes = am.AlphaComplex(points).at(30.0).holes
    assert out["hole_count"] == len(holes) == len(out["holes"]) > 1
    table = np.genfromtxt("a.csv", delimiter=",", names=True)
    np.testing.assert_array_equal(table["area"], holes.areas)
    np.testing.assert_array_equal(table["region"], holes.regions)


def test_small_regions_and_holes_can_go(points):
    shape = am.AlphaComplex(points).at(15.0)
    least = float(np.median(shape.regions.areas))
    kept = facts("regions", "points.csv", "-r", "15", "--min-area", repr(least))
    assert kept["region_count"] == np.count_nonzero(shape.regions.areas >= least)
    assert kept["region_count"] < len(shape.regions)
    assert facts("regions", "points.csv", "-r", "15", "--largest", "2")["region_count"] == 2
    filled = facts("regions", "points.csv", "-r", "30", "--fill-holes", "inf")
    assert filled["hole_count"] == 0
    wanted = am.AlphaComplex(points).at(30.0).filtered(max_hole_area=np.inf)
    assert filled["area"] == wanted.area


def test_regions_are_shown_where_no_file_is_asked_for(folder):
    corners = np.array([[0.0, 0], [1, 0], [0, 1]])
    points = np.concatenate([corners + 9 * k for k in range(25)])
    np.savetxt("points.csv", points, delimiter=",")
    shape = am.AlphaComplex(points).at(1.0)
    text = ok("regions", "points.csv", "-r", "1")
    assert f"{shape.regions.areas[0]:.6g}" in text
    assert len(shape.regions) > 20
    assert f"... and {len(shape.regions) - 20} more; -o FILE writes them all" in text
    assert "centroid_x" in text
    assert "centroid_x" not in ok("regions", "points.csv", "-r", "1", "-o", "a.csv")
    assert "centroid_x" not in ok("regions", "points.csv", "-r", "0")


def test_negative_areas_are_refused(points):
    assert "--min-area" in refused(2, "regions", "points.csv", "--min-area", "-1")
