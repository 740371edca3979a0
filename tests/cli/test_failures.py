"""What goes wrong, and what is said of it."""

from __future__ import annotations

import json
import os
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from cli_tools import facts, files, ok, process, refused, run


def test_missing_input():
    for command in ("mesh", "info"):
        assert "nothing.csv does not exist" in refused(1, command, "nothing.csv")
        assert "nothing.png does not exist" in refused(1, command, "nothing.png")


def test_empty_mask(folder):
    Image.new("L", (20, 20), 40).save("dark.png")
    text = refused(1, "mesh", "dark.png", "-o", "m.ply")
    assert "dark.png has the same brightness" in text
    assert not Path("m.ply").exists()


def test_damaged_image(folder):
    Path("broken.png").write_bytes(b"\x89PNG\r\n\x1a\n and no more")
    assert "broken.png" in refused(1, "mesh", "broken.png")


def test_bad_coordinates_name_the_row(folder):
    Path("p.csv").write_text("x,y\n0,0\n1,nan\n2,1\n")
    assert "row 1" in refused(1, "mesh", "p.csv")
    Path("q.csv").write_text("x,y\n")
    assert "only the header line" in refused(1, "mesh", "q.csv")
    assert "standard input is empty" in refused(1, "mesh", "-", stdin=b"")


@pytest.mark.parametrize("radius", ["-1", "nan", "best", "", "1e", "1,5"])
def test_bad_radius(table, radius):
    text = refused(2, "mesh", table, f"--radius={radius}")
    assert "--radius" in text
    if radius == "best":
        assert "all-points" in text


@pytest.mark.parametrize("command", ["mesh", "sample"])
def test_missing_output_folder(command):
    text = refused(1, command, "demo:disc", "-o", f"no/such/out.{'npz'}")
    assert "'no/such' does not exist" in text
    assert "create it first" in text
    assert not Path("no").exists()


def test_output_folder_that_is_a_file(table):
    text = refused(1, "mesh", table, "-o", f"{table}/m.ply")
    assert "is a file, not a folder" in text


@pytest.mark.skipif(
    not hasattr(os, "geteuid") or os.geteuid() == 0, reason="root may write everywhere"
)
def test_read_only_output_folder(table):
    Path("locked").mkdir(mode=0o500)
    assert "no permission" in refused(1, "mesh", table, "-o", "locked/m.ply")


def test_unknown_extensions_are_refused_before_the_work(table):
    text = refused(2, "mesh", table, "-o", "mesh.foo")
    assert "'.foo'" in text
    assert ".vtu" in text
    assert "no extension" in refused(2, "mesh", table, "-o", "mesh")
    assert ".png, .pdf, .svg" in refused(2, "mesh", table, "--plot", "p.bmp")
    assert ".csv, .tsv" in refused(2, "sample", "demo:disc", "-o", "p.xlsx")
    Path("odd.foo").write_text("1,2\n")
    assert "--from" in refused(1, "mesh", "odd.foo")


def test_outputs_must_differ_from_each_other_and_the_input(folder):
    assert "given twice" in refused(2, "mesh", "demo:disc", "-o", "m.ply", "-o", "./m.ply")
    np.savez("points.npz", points=np.random.default_rng(0).random((9, 2)))
    before = Path("points.npz").read_bytes()
    assert "is the input" in refused(2, "mesh", "points.npz", "-o", "points.npz")
    assert Path("points.npz").read_bytes() == before


def test_unknown_demo_shape_lists_the_known_ones():
    assert "annulus" in refused(2, "mesh", "demo:blob")
    assert "annulus" in refused(2, "info", "demo:blob")
    assert "annulus" in refused(2, "demo", "--shape", "blob")
    assert files() == set()


def test_messages_speak_of_options_not_of_keywords(table):
    text = refused(1, "mesh", table, "--columns", "a,b")
    assert "choose among these with --columns" in text
    Path("comma.csv").write_text("x;y\n1;2,5\n3;4,5\n")
    text = refused(1, "mesh", "comma.csv")
    assert "--decimal ," in text
    assert facts("mesh", "comma.csv", "--decimal", ",")["points"] == 2
    text = refused(2, "sample", "demo:disc", "-n", "9999999", "--no-jitter", "-o", "p.csv")
    assert "--replace" in text
    assert "=True" not in text


def test_a_mesh_is_no_input_for_a_mesh(table):
    ok("mesh", table, "-o", "m.obj")
    assert "alphamesh info m.obj" in refused(2, "mesh", "m.obj")


def test_debug_shows_where_an_error_arose():
    assert "Traceback" in run("mesh", "nothing.csv", "--debug").stderr


def test_a_failure_of_the_second_output_is_told(table):
    """No file may grow beyond 20 kB: the mesh fits, the picture does not."""
    resource = pytest.importorskip("resource")
    done = process(
        *("mesh", table, "-o", "m.ply", "--plot", "m.png", "-o", "n.npz"),
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (20_000, 20_000)),
    )
    assert done.returncode == 1
    message = done.stderr.decode()
    assert "cannot write 'm.png'" in message
    assert "Written all the same: m.ply" in message
    assert "Traceback" not in message
    assert "m.ply" in done.stdout.decode()
    assert "m.png" not in done.stdout.decode()
    assert files() - {"n.npz"} == {"points.csv", "m.ply"}


def test_json_tells_failures_too(table):
    resource = pytest.importorskip("resource")
    done = process(
        *("mesh", table, "-o", "m.ply", "--plot", "m.png", "--json"),
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (20_000, 20_000)),
    )
    assert done.returncode == 1
    out = json.loads(done.stdout)
    assert [file["path"] for file in out["files"]] == ["m.ply"]
    assert len(out["failures"]) == 1


@pytest.mark.parametrize("command", ["polygons", "voronoi"])
def test_points_in_space_where_there_is_only_the_plane(command):
    np.save("p.npy", np.random.default_rng(0).random((9, 3)))
    said = refused(1, command, "p.npy", "--columns", "0,1,2")
    assert any(word in said for word in ("the plane alone", "in the plane"))
