"""Standard input and output: formats, pipes of commands, readers that stop listening."""

from __future__ import annotations

import io
import json
import os
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import alphamesh as am
from alphamesh.cli.streams import sniffed
from alphamesh.cli.write_points import POINT_WRITERS
from alphamesh.io.meshes import MESH_FORMATS
from cli_tools import facts, ok, refused, run


def piped(*args: str, stdin: bytes | None = None) -> bytes:
    result = run(*args, stdin=stdin)
    assert result.exit_code == 0, result.output
    return result.stdout_bytes


@pytest.mark.parametrize("suffix", sorted(set(POINT_WRITERS) - {".txt", ".xyz"}))
def test_points_pass_a_pipe_in_every_format(suffix):
    content = piped("sample", "demo:disc", "-n", "60", "-o", "-", "--to", suffix[1:])
    out = facts("hull", "-", stdin=content)
    hull = am.convex_hull(am.demo_cloud("disc", 60, seed=0))
    assert (out["points"], out["corners"], out["area"]) == (60, len(hull.ring), hull.area)


@pytest.mark.parametrize("suffix", MESH_FORMATS)
def test_meshes_pass_a_pipe_in_every_format(points, suffix):
    content = piped("mesh", "points.csv", "-r", "inf", "-o", "-", "--to", suffix[1:])
    ok("mesh", "points.csv", "-r", "inf", "-o", f"m{suffix}")
    assert content == Path(f"m{suffix}").read_bytes()
    out = facts("info", "-", stdin=content)
    assert (out["kind"], out["name"]) == ("mesh", "-")
    assert out["cells"] == facts("info", f"m{suffix}")["cells"]


def test_an_image_on_standard_input_is_sampled(image):
    content = Path(image).read_bytes()
    assert facts("mesh", "-", stdin=content)["area"] == facts("mesh", image)["area"]
    assert "standard input (image" in ok("mesh", "-", "-n", "100", stdin=content)
    bitmap = io.BytesIO()
    Image.open(image).save(bitmap, "bmp")
    assert facts("mesh", "-", stdin=bitmap.getvalue())["area"] == facts("mesh", image)["area"]


def test_the_format_of_standard_input_can_be_said(points):
    text = Path("points.csv").read_text().replace(",", "\t").encode()
    assert facts("info", "-", "--from", "tsv", stdin=text)["points"] == 200
    message = refused(1, "info", "-", "--from", "npy", stdin=text)
    assert "standard input" in message and os.sep + "alphamesh-" not in message
    assert "choose one of csv" in refused(2, "info", "-", "--from", "foo", stdin=text)


def test_what_comes_is_known_by_how_it_begins():
    assert sniffed(b"ply\r\nformat") == ".ply"
    assert sniffed(b"plywood,y\n") == ".csv"
    assert sniffed(b"1 2\n3 4\n") == ".csv"
    assert sniffed(b"{\n") == ".geojson"


def test_damaged_input_is_told_of_standard_input(points):
    content = piped("sample", "demo:disc", "-o", "-", "--to", "npy")
    message = refused(1, "hull", "-", stdin=content[:-9])
    assert "standard input is cut off" in message
    assert "standard input is empty" in refused(1, "polygons", "-", stdin=b"")


def test_streams_that_make_no_sense_are_refused(points):
    assert "both use standard output" in refused(2, "hull", "points.csv", "-o", "-", "--json")
    twice = refused(2, "hull", "points.csv", "-o", "-", "-o", "-")
    assert "given twice" in twice
    assert "add -o -" in refused(2, "hull", "points.csv", "--to", "npz")
    assert "formats: csv, tsv, npz" in refused(2, "hull", "points.csv", "-o", "-", "--to", "x")


def test_a_file_and_a_stream_together(points):
    text = ok("hull", "points.csv", "-o", "a.csv", "-o", "-")
    assert text == Path("a.csv").read_text()


@pytest.fixture
def shell(folder: Path):
    """Return a function that runs a line of bash with this interpreter's alphamesh."""
    bash = shutil.which("bash")
    if bash is None:
        pytest.skip("pipes of bash")
    programs = folder / "programs"
    programs.mkdir()
    script = programs / "alphamesh"
    script.write_text(f'#!{bash}\nexec {shlex.quote(sys.executable)} -m alphamesh "$@"\n')
    script.chmod(0o755)
    path = f"{programs}{os.pathsep}{os.environ['PATH']}"

    def line(command: str) -> subprocess.CompletedProcess:
        return subprocess.run(
            [bash, "-o", "pipefail", "-c", command],
            capture_output=True,
            text=True,
            check=False,
            env={**os.environ, "PATH": path},
            timeout=60,
        )

    return line


def test_a_chain_of_commands(shell):
    done = shell(
        "alphamesh sample demo:eight -n 900 -o - --to npy | alphamesh mesh - -o - --to vtu"
        " | alphamesh convert - - --to csv | alphamesh betti - --json"
    )
    assert done.returncode == 0, done.stderr
    out = json.loads(done.stdout)
    cloud = am.demo_cloud("eight", 900, seed=0)
    choice = am.AlphaComplex(cloud).choose_radius()
    assert out["radius"] == pytest.approx(choice.radius)
    assert (out["components"], out["holes"]) == (1, 2)
    assert "vertices alone" in done.stderr


@pytest.mark.parametrize(
    "command",
    [
        "sample demo:disc -n 60000 -o -",
        "filtration demo:disc -n 20000 -o -",
        "polygons demo:disc -n 60000 -r 2 -o - --to wkt",
    ],
)
def test_a_reader_that_stops_listening_is_silent(shell, command):
    done = shell(f"alphamesh {command} | head -c 5")
    assert done.stderr == ""
    assert len(done.stdout) == 5
    assert done.returncode == 1  # pipefail: that of alphamesh


def test_completion_in_bash(shell):
    def completed(*words: str) -> set[str]:
        listed = " ".join(shlex.quote(word) for word in words)
        done = shell(
            "source <(alphamesh completion bash); "
            f"COMP_WORDS=({listed}); COMP_CWORD={len(words) - 1}; "
            '_alphamesh_completion alphamesh; printf "%s\\n" "${COMPREPLY[@]}"'
        )
        assert (done.returncode, done.stderr) == (0, "")
        return set(done.stdout.split())

    assert completed("alphamesh", "me") == {"mesh", "measures"}
    assert completed("alphamesh", "mesh", "a.csv", "--rad") == {"--radius"}
    assert completed("alphamesh", "mesh", "a.csv", "--to", "v") == {"vtu", "vtk"}
    rules = completed("alphamesh", "mesh", "a.csv", "--radius", "t")
    assert rules == {"topology", "triangle-count", "tetrahedron-count"}


def test_completion_scripts_of_all_shells():
    for shell_name, mark in (
        ("bash", "complete -o nosort"),
        ("zsh", "#compdef alphamesh"),
        ("fish", "complete --no-files"),
    ):
        text = ok("completion", shell_name)
        assert mark in text
        assert f"_ALPHAMESH_COMPLETE={shell_name}_complete" in text
    assert "zsh" in refused(2, "completion", "cmd")


def test_numbers_lose_nothing_on_the_way(folder):
    points = np.array([[0.1, 1 / 3], [1e-300, 1e300], [-0.0, 7.0]])
    np.save("p.npy", points)
    ok("convert", "p.npy", "p.csv")
    again = piped("convert", "p.csv", "-", "--to", "npy")
    np.testing.assert_array_equal(np.load(io.BytesIO(again)), points)
