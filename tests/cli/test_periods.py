"""The option ``--periods``: points in a box that repeats."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import alphamesh as am
from alphamesh.io.meshes import read_mesh
from cli_tools import facts, ok, refused


@pytest.fixture
def boxed():
    """Return points in a file ``box.csv`` of a box of 10 x 10 x 10, and ``flat.csv``."""
    points = np.random.default_rng(1).random((120, 3)) * 10
    np.savetxt("box.csv", points, "%.17g", delimiter=",", header="x,y,z", comments="")
    flat = points[:, :2]
    np.savetxt("flat.csv", flat, "%.17g", delimiter=",", header="x,y", comments="")
    return points


def test_betti_numbers_on_the_torus(boxed):
    out = facts("betti", "box.csv", "--periods", "10,10,10", "-r", "9", "-o", "a.csv")
    assert out["periods"] == [10, 10, 10]
    assert [out[name] for name in ("components", "loops", "voids", "whole_boxes")] == [
        1,
        3,
        3,
        1,
    ]
    table = np.genfromtxt("a.csv", delimiter=",", names=True)
    curve = am.AlphaComplex(boxed, periods=(10, 10, 10)).persistence().betti_curve()
    np.testing.assert_array_equal(table["b3"], curve.values[:, 3])
    text = ok("betti", "flat.csv", "--periods", "10,10", "-r", "9")
    assert "1 component, 2 loops, 1 whole box" in text
    assert "10 x 10" in text
    assert "1 component, 1 loop\n" in ok("betti", "flat.csv", "--periods", "10,", "-r", "9")


def test_persistence_tells_what_stays(boxed):
    out = facts("persistence", "box.csv", "--periods", "10,,10", "-o", "a.npz")
    diagrams = am.AlphaComplex(boxed, periods=(10, None, 10)).persistence().diagrams()
    assert (out["loops"], out["voids"]) == (len(diagrams[1]), len(diagrams[2]))
    assert "2 that stay" in ok("persistence", "box.csv", "--periods", "10,,10")
    with np.load("a.npz") as arrays:
        np.testing.assert_array_equal(arrays["dimension_2"], diagrams[2])


@pytest.mark.parametrize("view", ["diagram", "barcode", "betti"])
@pytest.mark.parametrize(("name", "periods"), [("flat", "10,10"), ("box", "10,10,10")])
def test_persistence_can_be_drawn(boxed, view, name, periods):
    ok("persistence", f"{name}.csv", "--periods", periods, "--plot", "a.png", "--plot-as", view)
    assert Path("a.png").stat().st_size > 5000


def test_filtration_lists_offsets(boxed):
    ok("filtration", "flat.csv", "--periods", "10,10", "-o", "a.csv", "-o", "a.npz")
    made = am.AlphaComplex(boxed[:, :2], periods=(10, 10))
    table = np.genfromtxt("a.csv", delimiter=",", names=True)
    triangles = table[table["dimension"] == 2]
    listed = {
        tuple(int(row[f"vertex_{k}"]) for k in range(3))
        + tuple(int(row[f"offset_{k}_{axis}"]) for k in (1, 2) for axis in "xy")
        for row in triangles
    }
    rows, offsets = made.simplices[2], made.offsets[2]
    assert listed == {
        (*r, *o[1], *o[2]) for r, o in zip(rows.tolist(), offsets.tolist(), strict=True)
    }
    with np.load("a.npz") as arrays:
        np.testing.assert_array_equal(arrays["triangle_offsets"], offsets)
        np.testing.assert_array_equal(arrays["periods"], [10, 10])


def test_radius_by_homology(boxed):
    out = facts("radius", "flat.csv", "--periods", "10,10", "--rule", "percolation")
    made = am.AlphaComplex(boxed[:, :2], periods=(10, 10))
    assert out["radius"] == made.choose_radius("percolation").radius
    out = facts("betti", "flat.csv", "--periods", "10,10", "-r", "connected")
    assert out["components"] == 1
    assert "without periods" in refused(
        1, "radius", "flat.csv", "--periods", "10,10", "--rule", "all-points"
    )
    assert "percolation" in refused(2, "radius", "flat.csv", "--rule", "percolation")


def test_boxes_can_be_plotted(boxed):
    out = facts("plot", "flat.csv", "--periods", "10,10", "-o", "a.png", "-r", "1")
    assert (out["view"], out["radius"]) == ("complex", 1)
    assert Path("a.png").stat().st_size > 5000
    ok("plot", "box.csv", "--periods", "10,10,10", "--view", "barcode", "-o", "b.png")
    message = refused(
        1, "plot", "flat.csv", "--periods", "10,10", "--view", "story", "-o", "c.png"
    )
    assert "complex, diagram, barcode, betti" in message
    assert not Path("c.png").exists()


def test_info_of_a_box(boxed):
    out = facts("info", "box.csv", "--periods", "10,10,10")
    assert out["simplicial"]
    assert out["rule"] == "connected"
    assert "meet themselves" in ok("info", "box.csv", "--periods", "0.5,10,10")
    assert "files of points" in refused(2, "info", "demo:cheese", "--periods", "1,1")


def test_wrong_boxes_are_refused(boxed):
    for text in ("10,x", "0,10", ",", "-1,1", "nan,1"):
        assert "10,,10" in refused(2, "betti", "flat.csv", "--periods", text)
    assert "need 3 periods" in refused(2, "betti", "box.csv", "--periods", "10,10")
    assert "no such option" in refused(2, "polygons", "flat.csv", "--periods", "1,1").lower()


def test_meshes_of_boxes(boxed):
    out = facts("mesh", "box.csv", "--periods", "10,10,10", "-r", "1.5", "-o", "a.npz")
    shape = am.AlphaComplex(boxed, periods=(10, 10, 10)).at(1.5)
    assert out["volume"] == shape.volume
    assert out["tetrahedra"] == len(shape.tetrahedra)
    assert len(read_mesh("a.npz").cells["tetra"]) == len(shape.tetrahedra)
    text = ok("mesh", "flat.csv", "--periods", "10,10", "-r", "0.9", "--plot", "a.png")
    flat = am.AlphaComplex(boxed[:, :2], periods=(10, 10)).at(0.9)
    assert f"{flat.filled_share:.1%} of the box" in text
    assert Path("a.png").stat().st_size > 5000
    assert "of the box" not in ok("mesh", "flat.csv", "--periods", "10,", "-r", "0.9")


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["--keep-columns"], "--keep-columns does not go with --periods"),
        (["--largest", "1"], "--largest is for solids in space"),
        (["--surface"], "has no meaning for points in a periodic box"),
    ],
)
def test_meshes_of_boxes_leave_nothing_out_in_silence(boxed, arguments, said):
    assert said in refused(2, "mesh", "flat.csv", "--periods", "10,10", *arguments)


def test_boxes_are_shown_live_drawn_in_space_and_filmed(boxed):
    pytest.importorskip("matplotlib")
    box = ("box.csv", "--periods", "10,10,10")
    assert facts("view", *box, "-o", "page.html")["periods"] == [10, 10, 10]
    assert facts("plot", *box, "-o", "box.png")["view"] == "complex"
    film = ("--frames", "2", "--width", "200", "-o", "a.gif")
    assert len(facts("animate", *box, *film)["radii"]) == 2
