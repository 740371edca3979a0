"""``alphamesh query``."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import alphamesh as am
from cli_tools import facts, ok, refused


@pytest.fixture
def places(folder: Path) -> np.ndarray:
    """A table of 50 places, ``places.csv``."""
    rows = np.random.default_rng(5).random((50, 2)) * 500
    np.savetxt("places.csv", rows, delimiter=",", header="x,y", comments="", fmt="%.17g")
    return rows


def test_answers_are_those_of_the_shape(points, places):
    out = facts("query", "points.csv", "places.csv", "-r", "30", "--nearest", "-o", "a.csv")
    shape = am.AlphaComplex(points).at(30.0)
    table = np.genfromtxt("a.csv", delimiter=",", names=True)
    np.testing.assert_array_equal(np.column_stack((table["x"], table["y"])), places)
    np.testing.assert_array_equal(table["inside"], shape.contains(places))
    np.testing.assert_array_equal(table["region"], shape.region_of(places))
    np.testing.assert_array_equal(table["distance"], shape.distance(places, signed=True))
    np.testing.assert_array_equal(table["nearest_x"], shape.nearest(places).points[:, 0])
    assert out["inside"] == np.count_nonzero(shape.contains(places)) > 0
    assert out["places"] == 50
    assert out["least_distance"] == table["distance"].min()


def test_places_from_standard_input_and_their_columns(points, places):
    ok("query", "points.csv", "places.csv", "-o", "a.csv")
    piped = ok("query", "points.csv", "-", "-o", "-", stdin=Path("places.csv").read_bytes())
    assert piped == Path("a.csv").read_text()
    swapped = "\n".join(f"{y!r};{x!r}" for x, y in places.tolist())
    Path("b.csv").write_text("north;east\n" + swapped)
    args = ("query", "points.csv", "b.csv", "--places-columns", "east,north", "-o", "-")
    assert ok(*args) == piped


def test_small_regions_do_not_answer(points, places):
    shape = am.AlphaComplex(points).at(15.0).filtered(keep_largest=1)
    out = facts("query", "points.csv", "places.csv", "-r", "15", "--largest", "1")
    assert out["inside"] == np.count_nonzero(shape.contains(places))


def test_one_standard_input_is_all_there_is(points):
    assert "cannot both" in refused(2, "query", "-", "-")
    assert "no.csv does not exist" in refused(1, "query", "points.csv", "no.csv")


def test_the_places_are_not_overwritten(points, places):
    text = refused(2, "query", "points.csv", "places.csv", "-o", "places.csv")
    assert "writing there would destroy it" in text


def test_other_columns_of_the_places_are_kept(points):
    Path("named.csv").write_text('name,x,y\n"here, there",250,250\nfar,9999,0\n')
    lines = ok("query", "points.csv", "named.csv", "-r", "inf", "-o", "-").splitlines()
    assert lines[0] == "x,y,name,inside,region,distance"
    assert lines[1].startswith('250.0,250.0,"here, there",1,0,-')
    assert lines[2].startswith("9999.0,0.0,far,0,-1,")
    Path("twin.csv").write_text("x,y,region\n1,2,3\n")
    assert "has a column 'region'" in refused(2, "query", "points.csv", "twin.csv")
