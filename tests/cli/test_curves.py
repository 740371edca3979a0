"""``alphamesh betti`` and ``alphamesh measures``: curves over all radii."""

from __future__ import annotations

from pathlib import Path

import numpy as np

import alphamesh as am
from cli_tools import facts, ok, refused


def test_betti_writes_the_exact_curve(points):
    out = facts("betti", "points.csv", "-r", "20", "-o", "a.csv", "--plot", "a.png")
    pairs = am.AlphaComplex(points).persistence()
    assert [out["components"], out["holes"]] == pairs.betti_numbers(20.0).tolist()
    radii, numbers = pairs.betti_curve()
    table = np.genfromtxt("a.csv", delimiter=",", names=True)
    np.testing.assert_array_equal(table["radius"], radii)
    np.testing.assert_array_equal(np.column_stack((table["b0"], table["b1"])), numbers)
    assert out["steps"] == len(radii)
    assert Path("a.png").stat().st_size > 5000


def test_betti_chooses_the_radius_unless_given(points):
    choice = am.AlphaComplex(points).choose_radius()
    out = facts("betti", "points.csv")
    assert (out["radius"], out["rule"]) == (choice.radius, choice.rule)
    assert (out["components"], out["holes"]) == choice.betti


def test_measures_at_given_radii(points):
    cx = am.AlphaComplex(points)
    out = facts("measures", "points.csv", "--radii", "5,20,60", "-o", "a.csv")
    table = np.genfromtxt("a.csv", delimiter=",", names=True)
    for k, radius in enumerate((5.0, 20.0, 60.0)):
        shape = cx.at(radius)
        b0, b1 = cx.persistence().betti_numbers(radius)
        assert out["area"][k] == table["area"][k]
        np.testing.assert_allclose(table["area"][k], shape.area, rtol=1e-12)
        np.testing.assert_allclose(table["perimeter"][k], shape.perimeter, rtol=1e-12)
        assert table["triangles"][k] == len(shape.triangles)
        assert table["edges"][k] == len(shape.edges)
        assert (table["components"][k], table["holes"][k]) == (b0, b1)
        assert table["euler"][k] == b0 - b1 == shape.euler_characteristic


def test_measures_choose_radii_and_show_them(points):
    text = ok("measures", "points.csv", "--steps", "7")
    lines = text.splitlines()
    start = next(k for k, line in enumerate(lines) if line.split()[:1] == ["radius"])
    assert len(lines[start + 1 :]) == 7
    radii = np.genfromtxt(
        ok("measures", "points.csv", "--radii", "log", "--steps", "9", "-o", "-").splitlines(),
        delimiter=",",
        names=True,
    )["radius"]
    assert len(radii) == 9 and (np.diff(radii) > 0).all()
    assert "quantiles" in refused(2, "measures", "points.csv", "--radii", "some")
