"""Many files at once: ``alphamesh mesh a.csv b.csv --output-dir out``."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

import alphamesh as am
from alphamesh.cli.workers import Task, run_tasks
from alphamesh.io.meshes import read_mesh
from cli_tools import facts, files, ok, refused, run

NAMES = ("annulus", "disc", "eight")


@pytest.fixture
def clouds(folder: Path) -> tuple[str, ...]:
    """Three tables of points."""
    for name in NAMES:
        ok("sample", f"demo:{name}", "-n", "300", "-o", f"{name}.csv")
    return tuple(f"{name}.csv" for name in NAMES)


@pytest.mark.parametrize("jobs", ["1", "2"])
def test_each_mesh_is_the_one_made_alone(clouds, jobs):
    out = facts("mesh", *clouds, "--output-dir", "out", "--format", "npz", "-j", jobs)
    assert files("out") == {f"{name}.npz" for name in NAMES}
    assert [made["path"] for made in out["files"]] == [f"out/{name}.npz" for name in NAMES]
    assert (out["failures"], out["kept"], out["not_begun"]) == ([], [], 0)
    for name, made in zip(NAMES, out["files"], strict=True):
        ok("mesh", f"{name}.csv", "-o", "alone.npz")
        assert Path(f"out/{name}.npz").read_bytes() == Path("alone.npz").read_bytes()
        assert made["triangles"] == len(read_mesh("alone.npz").cells["triangle"])
        assert made["input"]["name"] == f"{name}.csv"


def test_the_summary_is_a_table(clouds):
    lines = ok("mesh", *clouds, "--output-dir", "out", "-r", "30").splitlines()
    assert lines[0].split() == [
        *("input", "points", "radius", "triangles", "area", "written", "size")
    ]
    shape = am.AlphaComplex(am.read_points("disc.csv")).at(30.0)
    row = next(line for line in lines if line.startswith("disc.csv")).split()
    assert row[:6] == [
        *("disc.csv", "300", "30", str(len(shape.triangles))),
        *(f"{shape.area:.6g}", "out/disc.ply"),
    ]
    assert len({len(line) for line in lines}) == 1


@pytest.mark.parametrize("jobs", ["1", "2"])
def test_failures_are_listed_and_the_others_made(clouds, jobs):
    Path("bad.csv").write_text("x,y\n0,0\n1,nan\n2,1\n")
    args = ("mesh", "bad.csv", *clouds, "no.csv", "--output-dir", "out", "--jobs", jobs)
    result = run(*args, "--keep-going")
    assert result.exit_code == 1
    assert "2 of 5 files failed" in result.stderr
    assert "bad.csv: " in result.stderr and "row 1" in result.stderr
    assert "no.csv does not exist" in result.stderr
    assert files("out") == {f"{name}.ply" for name in NAMES}
    out = json.loads(run(*args, "--keep-going", "--json").stdout)
    assert [failure["input"] for failure in out["failures"]] == ["bad.csv", "no.csv"]
    assert len(out["files"]) == 3


def test_the_first_failure_ends_the_work_unless_it_must_go_on(clouds):
    result = run("mesh", clouds[0], "no.csv", *clouds[1:], "--output-dir", "out")
    assert result.exit_code == 1
    assert "(2 files not begun; --keep-going goes on after a failure)" in result.stderr
    assert files("out") == {"annulus.ply"}


def test_what_is_there_can_stay(clouds):
    Path("out").mkdir()
    Path("out/disc.ply").write_text("mine")
    out = facts("mesh", *clouds, "--output-dir", "out", "--no-overwrite")
    assert out["kept"] == ["out/disc.ply"]
    assert Path("out/disc.ply").read_text() == "mine"
    assert len(out["files"]) == 2
    assert "3 files left as they were" in ok(
        "mesh", *clouds, "--output-dir", "out", "--no-overwrite"
    )
    ok("mesh", *clouds, "--output-dir", "out")
    assert Path("out/disc.ply").read_bytes()[:3] == b"ply"


def test_losses_are_told_for_each_file(clouds):
    result = run("mesh", *clouds, "--output-dir", "out", "--to", "stl", "-r", "9", "-j", "2")
    for name in NAMES:
        assert f"Warning: out/{name}.stl: STL files cannot hold" in result.stderr
    assert ".alphamesh-" not in result.stderr


def test_names_that_clash_are_refused_before_the_work(clouds):
    Path("more").mkdir()
    Path("more/disc.txt").write_text("0 0\n1 1\n")
    text = refused(2, "mesh", "disc.csv", "more/disc.txt", "--output-dir", "out")
    assert "'disc.csv' and 'more/disc.txt' would both become 'out/disc.ply'" in text
    assert not Path("out").exists()
    np.savez("p.npz", points=np.random.default_rng(0).random((9, 2)))
    text = refused(2, "mesh", "p.npz", "--output-dir", ".", "--to", "npz")
    assert "is the input" in text


def test_options_of_many_files_need_a_folder_and_others_forbid_it(clouds):
    assert "--output-dir DIR" in refused(2, "mesh", *clouds)
    assert "--output-dir" in refused(2, "mesh", clouds[0], "--jobs", "2")
    assert "for one input" in refused(2, "mesh", *clouds, "--output-dir", "o", "-o", "m.ply")
    assert "standard input" in refused(2, "mesh", "-", clouds[0], "--output-dir", "o")
    assert "create it first" in refused(1, "mesh", *clouds, "--output-dir", "no/such")


def test_a_demo_shape_gives_its_name(folder):
    ok("mesh", "demo:disc", "demo:gear", "-n", "100", "--output-dir", "out")
    assert files("out") == {"disc.ply", "gear.ply"}


def _fatal(source: str, path: Path) -> dict:
    if source == "bad":
        os._exit(3)
    path.write_text(source)
    return {}


def test_a_process_that_dies_is_a_failure_and_no_more(folder):
    """Such as one that the system kills because memory is short."""
    tasks = [Task(name, Path(f"{name}.txt").resolve()) for name in ("a", "bad", "b", "c")]
    done = []
    outcomes = run_tasks(_fatal, tasks, jobs=2, keep_going=True, done=done.append)
    assert [outcome.error is None for outcome in outcomes] == [True, False, True, True]
    assert "code 3" in outcomes[1].error
    assert files() == {"a.txt", "b.txt", "c.txt"}
    assert done == [0.25, 0.5, 0.75, 1.0]


@pytest.mark.skipif(os.name == "nt", reason="signals of another kind")
@pytest.mark.parametrize("whole_group", [False, True], ids=["kill", "keyboard"])
@pytest.mark.parametrize("jobs", ["1", "2"])
def test_interrupting_ends_within_a_second_and_leaves_nothing_partial(jobs, whole_group):
    shapes = [f"demo:{name}" for name in ("annulus", "disc", "eight", "gear")]
    with subprocess.Popen(
        [
            *(sys.executable, "-m", "alphamesh", "mesh", *shapes, "-n", "120000", "-r", "5"),
            *("--output-dir", "out", "--jobs", jobs, "--threads", "1"),
        ],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        start_new_session=True,
    ) as running:
        deadline = time.monotonic() + 30
        while not (Path("out").exists() and any(Path("out").glob(".alphamesh-*/*"))):
            assert time.monotonic() < deadline and running.poll() is None
            time.sleep(0.01)
        (os.killpg if whole_group else os.kill)(running.pid, signal.SIGINT)
        start = time.monotonic()
        out, err = running.communicate(timeout=20)
        waited = time.monotonic() - start
    assert running.returncode == 130, err
    assert err == b"Interrupted; no half-written file is left.\n"
    assert out == b""
    assert waited < 1
    assert all(read_mesh(path).cells["triangle"].size for path in Path("out").iterdir())
    with pytest.raises(ProcessLookupError):  # soon none of its processes is left
        while time.monotonic() < start + 5:
            os.killpg(running.pid, 0)
            time.sleep(0.02)
