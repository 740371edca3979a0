"""The option --weights: the column of squared radii of balls."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

import alphamesh as am
from cli_tools import facts, ok, refused

RNG = np.random.default_rng(8)
POINTS, WEIGHTS = RNG.random((120, 2)), RNG.normal(size=120) * 0.01
IN_SPACE = RNG.random((80, 3))


@pytest.fixture(name="table")
def make_table(folder):
    rows = np.column_stack((np.arange(120), POINTS, WEIGHTS))
    np.savetxt("p.csv", rows, delimiter=",", header="id,x,y,w", comments="", fmt="%.17g")
    return "p.csv"


@pytest.fixture(name="solid")
def make_solid(folder):
    rows = np.column_stack((IN_SPACE, WEIGHTS[:80]))
    np.savetxt("s.csv", rows, delimiter=",", header="x,y,z,w", comments="", fmt="%.17g")
    return "s.csv"


CX = am.AlphaComplex(POINTS, weights=WEIGHTS)


def test_a_mesh_of_balls_as_they_are(table):
    out = facts("mesh", table, "--weights", "w", "-o", "m.ply")
    assert (out["radius"], out["rule"]) == (0.0, "weights")
    assert out["hidden"] == len(CX.hidden) > 0
    assert out["duplicates"] == 0
    assert {name: out[name] for name in CX.at(0).counts} == CX.at(0).counts
    assert f"120 ({len(CX.hidden)} hidden)" in ok("mesh", table, "--weights", "w")
    assert "hidden" not in facts("mesh", table)


@pytest.mark.parametrize("column", ["w", "3"])
def test_the_column_has_a_name_or_a_number(table, column):
    out = facts("mesh", table, "--columns", "1,2", "--weights", column, "-r", "-0.02")
    assert out["radius"] == -0.02
    assert out["vertices"] == CX.at(-0.02).counts["vertices"]


def test_a_table_without_a_header(folder):
    np.savetxt("p.txt", np.column_stack((POINTS, WEIGHTS)), fmt="%.17g")
    out = facts("mesh", "p.txt", "--columns", "0,1", "--weights", "2")
    assert out["hidden"] == len(CX.hidden)


def test_standard_input_has_weights_too(table):
    out = facts("radius", "-", "--weights", "w", stdin=Path(table).read_bytes())
    assert out["hidden"] == len(CX.hidden)


def test_points_in_space_have_weights_too(solid):
    cx = am.AlphaComplex(IN_SPACE, weights=WEIGHTS[:80])
    out = facts("mesh", solid, "--weights", "w", "-r", "0.1")
    assert {name: out[name] for name in cx.at(0.1).counts} == cx.at(0.1).counts


def test_info_tells_of_hidden_points_and_of_spacing(table):
    out = facts("info", table, "--weights", "w")
    assert out["hidden"] == len(CX.hidden)
    # How far points lie apart does not depend on their weights.
    assert out["spacing"] == facts("info", table)["spacing"]


def test_tables_of_simplices_and_diagrams(table):
    out = facts("filtration", table, "--weights", "w", "--squared", "-o", "f.npz")
    assert out["vertices"] == len(CX.simplices[0])
    with np.load("f.npz") as arrays:
        assert np.array_equal(arrays["weights"], WEIGHTS)
        assert np.array_equal(arrays["hidden"], CX.hidden)
        found = arrays["vertex_radii_squared"]
        np.testing.assert_allclose(found[CX.radii[0] < 0], -(CX.radii[0][CX.radii[0] < 0] ** 2))
    early = facts("filtration", table, "--weights", "w", "--max-radius", "-0.01")
    assert early["vertices"] == np.count_nonzero(CX.radii[0] <= -0.01)
    assert early["last_radius"] <= -0.01
    ok("persistence", table, "--weights", "w", "-o", "d.csv")
    births = np.genfromtxt("d.csv", delimiter=",", names=True)["birth"]
    assert births.min() == CX.radii[0].min()


def test_measures_at_negative_radii(table):
    ok("measures", table, "--weights", "w", "--radii=-0.05,0,0.1", "-o", "m.csv")
    found = np.genfromtxt("m.csv", delimiter=",", names=True)
    assert found["radius"].tolist() == [-0.05, 0, 0.1]
    assert found["area"] == pytest.approx([CX.at(r).area for r in (-0.05, 0, 0.1)])


@pytest.mark.parametrize(
    ("code", "args", "message"),
    [
        (2, ("--weights", "mass"), "no column 'mass' besides the coordinates"),
        (2, ("--weights", "9"), "--weights 9: p.csv has no column number 9"),
        (1, ("--weights", "w", "-r", "topology"), "balls of equal size"),
    ],
)
def test_what_cannot_be_met_is_told(table, code, args, message):
    assert message in refused(code, "mesh", table, *args)


@pytest.mark.parametrize(
    "args",
    [("-r", "-0.02"), ("-r", "nan"), ("--weights", "w", "-r", "nan"), ("--weights", "")],
)
def test_usage_errors(table, args):
    assert "Usage" in refused(2, "mesh", table, *args)


def test_images_and_demo_shapes_have_no_weights():
    assert "no meaning" in refused(2, "mesh", "demo:disc", "--weights", "w")


def test_text_is_no_weight(folder):
    Path("t.csv").write_text("x,y,w\n0,0,heavy\n1,0,2\n", encoding="utf-8")
    assert "does not hold numbers" in refused(2, "mesh", "t.csv", "--weights", "w")


def test_a_missing_weight_is_told_with_its_row(folder):
    Path("t.csv").write_text("x,y,w\n0,0,1\n1,0,\n0,1,2\n", encoding="utf-8")
    message = refused(1, "mesh", "t.csv", "--weights", "w")
    assert "NaN or infinite weights in row 1" in message


def test_json_is_json(table):
    assert json.loads(ok("radius", table, "--weights", "w", "--json"))["rule"] == "weights"


def test_power_cells_on_the_command_line(table):
    assert facts("voronoi", table, "--weights", "w")["cells"] == len(CX.simplices[0])
    ok("voronoi", table, "--weights", "w", "-o", "v.npz")
    with np.load("v.npz") as arrays:
        assert np.array_equal(arrays["hidden"], CX.hidden)
    out = facts("restricted", table, "--weights", "w", "-r", "-0.01", "-o", "r.npz")
    assert out["area"] == CX.restricted_voronoi(-0.01).total_area
    with np.load("r.npz") as arrays:
        assert np.array_equal(arrays["disc_radii"], CX.restricted_voronoi(-0.01).disc_radii)
    ok("plot", table, "--weights", "w", "-o", "p.png", "--view", "story")


@pytest.mark.parametrize("view", ["frame", "outlines"])
def test_views_without_a_meaning_are_refused(table, view):
    message = refused(1, "plot", table, "--weights", "w", "--view", view, "-o", "p.png")
    assert "balls of equal size" in message
    assert "take hull or delaunay" in message


def test_pages_and_films_of_weighted_points(table):
    pytest.importorskip("matplotlib")
    out = facts("view", table, "--weights", "w", "-r", "-0.01", "-o", "page.html")
    assert out["radius"] == -0.01
    film = ("--frames", "2", "--width", "200", "-o", "a.gif")
    out = facts("animate", table, "--weights", "w", *film)
    assert out["radii"][0] < 0
