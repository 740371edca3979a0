"""The command line: what it writes, what it says, and how it ends."""

from __future__ import annotations

import io
import json
import os
import shlex
import signal
import subprocess
import sys
import time
from pathlib import Path

import click
import numpy as np
import pytest

pytest.importorskip("click")
pytest.importorskip("rich")
pytest.importorskip("matplotlib")

from click.testing import CliRunner, Result
from PIL import Image
from rich.console import Console

import alphamesh as am
from alphamesh.cli.app import app
from alphamesh.cli.command import Command
from alphamesh.cli.info import nearest_distances
from alphamesh.cli.progress import Steps
from alphamesh.cli.summary import size_text
from alphamesh.cli.types import FigureFile
from alphamesh.cli.write_points import POINT_WRITERS
from alphamesh.io.meshes import read_mesh
from alphamesh.plot import FIGURE_FORMATS

COMMANDS = tuple(app.list_commands(None))


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Run every test in a folder of its own."""
    monkeypatch.chdir(tmp_path)
    return tmp_path


def run(*args: str, stdin: bytes | None = None) -> Result:
    return CliRunner().invoke(app, args, input=stdin, prog_name="alphamesh")


def ok(*args: str, stdin: bytes | None = None) -> str:
    result = run(*args, stdin=stdin)
    assert result.exit_code == 0, result.output
    return result.stdout


def facts(*args: str, stdin: bytes | None = None) -> dict:
    return json.loads(ok(*args, "--json", stdin=stdin))


def refused(code: int, *args: str, stdin: bytes | None = None) -> str:
    """Return the message of a command that fails without a traceback."""
    result = run(*args, stdin=stdin)
    assert result.exit_code == code, result.output
    assert isinstance(result.exception, SystemExit)
    assert result.stdout == ""
    assert "Traceback" not in result.stderr
    return " ".join(result.stderr.split())


def files(folder: str = ".") -> set[str]:
    return {path.name for path in Path(folder).iterdir()}


def process(*args: str, **options) -> subprocess.CompletedProcess:
    return subprocess.run(
        [sys.executable, "-m", "alphamesh", *args],
        capture_output=True,
        check=False,
        timeout=60,
        **options,
    )


@pytest.fixture
def table(folder: Path) -> str:
    """A table of 300 points, of which five are duplicates."""
    points = am.demo_cloud("annulus", 295, seed=4)
    points = np.concatenate([points, points[:5]])
    np.savetxt("points.csv", points, delimiter=",", header="x,y", comments="", fmt="%.17g")
    return "points.csv"


@pytest.fixture
def image(folder: Path) -> str:
    """A small mask image."""
    Image.fromarray(am.demo_mask("eight", 64)).save("mask.png")
    return "mask.png"


# mesh


def test_mesh_of_an_image_writes_every_file_asked_for(image):
    out = facts("mesh", image, "-n", "500", "-o", "a.ply", "-o", "b.npz", "--plot", "c.png")
    assert out["points"] == 500
    assert out["input"]["kind"] == "image"
    assert (out["input"]["width"], out["input"]["height"]) == (64, 64)
    assert [file["path"] for file in out["files"]] == ["a.ply", "b.npz", "c.png"]
    assert all(Path(file["path"]).stat().st_size == file["bytes"] for file in out["files"])
    assert len(read_mesh("b.npz").cells["triangle"]) == out["triangles"] > 100
    with Image.open("c.png") as picture:
        assert picture.width > 1500


def test_mesh_is_what_the_library_makes(image):
    out = facts("mesh", image, "-n", "400", "--seed", "7", "--radius", "3.5")
    points = am.sample_mask(image, 400, seed=7)
    shape = am.AlphaComplex(points).at(3.5)
    assert {name: out[name] for name in shape.counts} == shape.counts
    assert (out["area"], out["perimeter"]) == (shape.area, shape.perimeter)
    assert (out["radius"], out["rule"]) == (3.5, "given")


@pytest.mark.parametrize("radius", ["auto", "all-points"])
def test_mesh_chooses_the_radius_and_says_why(table, radius):
    out = facts("mesh", table, "--radius", radius)
    alpha = am.AlphaComplex(am.read_points(table))
    choice = alpha.choose_radius() if radius == "auto" else alpha.choose_radius(radius)
    assert (out["radius"], out["rule"]) == (choice.radius, choice.rule)
    assert out["reason"] == choice.reason
    text = ok("mesh", table, "--radius", radius)
    assert choice.reason in " ".join(text.split())


def test_mesh_tells_duplicates(table):
    out = facts("mesh", table)
    assert (out["points"], out["duplicates"], out["dimension"]) == (300, 5, 2)
    assert "300 (5 duplicates)" in ok("mesh", table)


def test_mesh_summary_for_people(table):
    out = facts("mesh", table, "-o", "m.ply")
    lines = ok("mesh", table, "-o", "m.ply").splitlines()
    entries = dict(line.split(maxsplit=1) for line in lines if not line.startswith(" "))
    assert entries["Triangles"] == f"{out['triangles']:,}"
    assert entries["Area"] == f"{out['area']:.6g}"
    assert entries["Written"].startswith("m.ply  (")


def test_mesh_without_output_says_how_to_write(table):
    assert "-o FILE writes the mesh" in ok("mesh", table)
    assert files() == {"points.csv"}


def test_mesh_reads_standard_input(table):
    piped = facts("mesh", "-", stdin=Path(table).read_bytes())
    named = facts("mesh", table)
    assert piped.pop("input")["name"] == "-"
    named.pop("input")
    assert piped == named


def test_mesh_of_chosen_columns(folder):
    rng = np.random.default_rng(1)
    rows = rng.random((50, 3))
    np.savetxt("t.txt", rows, delimiter=";", header="id;easting;northing", comments="")
    by_name = facts("mesh", "t.txt", "--columns", "northing,easting")
    by_number = facts("mesh", "t.txt", "--columns", "2,1", "--delimiter", ";", "--header")
    assert by_name == by_number
    assert by_name["area"] == am.AlphaComplex(rows[:, [2, 1]]).at().area


def test_mesh_of_a_table_whose_format_the_name_hides(table):
    Path(table).rename("points.odd")
    assert facts("mesh", "points.odd", "--format", "csv")["points"] == 300


def test_mesh_of_a_degenerate_cloud(folder):
    Path("line.csv").write_text("x,y\n0,0\n1,1\n2,2\n")
    out = facts("mesh", "line.csv", "-o", "line.npz", "--plot", "line.png")
    assert (out["dimension"], out["triangles"], out["singular_edges"]) == (1, 0, 2)
    assert len(out["files"]) == 2


def test_mesh_at_an_infinite_radius_is_the_triangulation(table):
    out = facts("mesh", table, "--radius", "inf")
    alpha = am.AlphaComplex(am.read_points(table))
    assert out["triangles"] == len(alpha.simplices[2])
    assert out["radius"] is None  # JSON has no infinity


def test_the_same_command_gives_the_same_bytes(image):
    for name in ("one", "two"):
        ok("mesh", image, "-o", f"{name}.ply", "--plot", f"{name}.svg")
    assert Path("one.ply").read_bytes() == Path("two.ply").read_bytes()
    assert Path("one.svg").read_bytes() == Path("two.svg").read_bytes()
    assert facts("mesh", image, "--seed", "1")["area"] != facts("mesh", image)["area"]


def test_threads_do_not_change_the_result(table):
    assert facts("mesh", table, "--threads", "1") == facts("mesh", table, "--threads", "3")


def test_a_format_that_loses_something_warns(table):
    radius = am.AlphaComplex(am.read_points(table)).choose_radius("all-points").radius
    result = run("mesh", table, "-r", str(radius / 2), "-o", "m.stl")
    assert result.exit_code == 0
    assert "Warning: m.stl: STL files cannot hold" in result.stderr


def test_options_that_have_no_meaning_are_refused(table, image):
    text = refused(2, "mesh", table, "--points", "10")
    assert "--points has no meaning for 'points.csv', which is a table" in text
    assert "--columns has no meaning" in refused(2, "mesh", image, "--columns", "x,y")
    assert "--invert has no meaning" in refused(2, "mesh", "demo:disc", "--invert")


# What goes wrong


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
    assert "--format" in refused(1, "mesh", "odd.foo")


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


# sample


@pytest.mark.parametrize("suffix", POINT_WRITERS)
def test_sampled_points_survive_every_format(image, suffix):
    ok("sample", image, "-n", "123", "--seed", "9", "-o", f"p{suffix}")
    expected = am.sample_mask(image, 123, seed=9)
    np.testing.assert_array_equal(am.read_points(f"p{suffix}"), expected)


def test_sample_options_reach_the_sampler(image):
    ok("sample", image, "-n", "50", "--no-jitter", "--replace", "--invert", "-o", "p.npy")
    expected = am.sample_mask(image, 50, seed=0, jitter=False, replace=True, invert=True)
    np.testing.assert_array_equal(np.load("p.npy"), expected)
    Image.fromarray(np.array([[60, 200]], np.uint8)).save("grey.png")
    for threshold, columns in (("0.1", {0.0, 1.0}), ("0.5", {1.0})):
        args = ("--threshold", threshold, "-n", "9", "--replace", "--no-jitter")
        ok("sample", "grey.png", *args, "-o", "g.npy")
        assert set(np.load("g.npy")[:, 0]) == columns


def test_sample_to_standard_output_can_be_read_again():
    text = ok("sample", "demo:gear", "-n", "200", "-o", "-")
    assert text.startswith("x,y\n")
    out = facts("info", "-", stdin=text.encode())
    assert out["points"] == 200
    ok("sample", "demo:gear", "-n", "200", "-o", "p.csv")
    assert Path("p.csv").read_text() == text


def test_sample_writes_several_files_and_tells():
    out = facts("sample", "demo:bars", "-n", "70", "-o", "p.csv", "-o", "p.npy")
    assert out["points"] == 70
    assert [file["path"] for file in out["files"]] == ["p.csv", "p.npy"]
    np.testing.assert_array_equal(am.read_points("p.csv"), np.load("p.npy"))


def test_sample_needs_an_image_and_an_output(table):
    assert "is no image" in refused(2, "sample", table, "-o", "p.npy")
    assert "--output" in refused(2, "sample", "demo:disc")
    assert "standard output" in refused(2, "sample", "demo:disc", "-o", "-", "--json")


# info


def test_info_of_points(table):
    out = facts("info", table)
    alpha = am.AlphaComplex(am.read_points(table))
    assert (out["points"], out["duplicates"], out["dimension"]) == (300, 5, 2)
    assert out["bounds"] == [
        alpha.points.min(axis=0).tolist(),
        alpha.points.max(axis=0).tolist(),
    ]
    assert out["radius"] == alpha.choose_radius().radius
    assert 0 < out["spacing"]["smallest"] < out["spacing"]["median"] < out["spacing"]["largest"]
    text = ok("info", table)
    assert "300 (5 duplicates)" in text
    assert f"{out['radius']:.6g}" in text


def test_nearest_distances_are_those_of_all_pairs():
    points = np.random.default_rng(3).integers(0, 30, (80, 2)).astype(float)
    distinct = np.unique(points, axis=0)
    apart = np.hypot(*(distinct[:, np.newaxis] - distinct).transpose(2, 0, 1))
    np.fill_diagonal(apart, np.inf)
    found = nearest_distances(am.AlphaComplex(points).filtration)
    np.testing.assert_allclose(np.sort(found), np.sort(apart.min(axis=1)), rtol=1e-15)


@pytest.mark.parametrize(
    ("rows", "dimension", "said"),
    [("5,5\n5,5\n", 0, "all at one place"), ("0,0\n1,1\n5,5\n", 1, "all on one line")],
)
def test_info_of_degenerate_points(rows, dimension, said):
    Path("p.csv").write_text("x,y\n" + rows)
    assert facts("info", "p.csv")["dimension"] == dimension
    assert said in ok("info", "p.csv")


def test_info_of_an_image(image):
    out = facts("info", image)
    assert (out["kind"], out["width"], out["height"]) == ("image", 64, 64)
    assert out["pixels_inside"] == am.demo_mask("eight", 64).sum()
    assert "64 x 64" in ok("info", image)


@pytest.mark.parametrize("suffix", [".ply", ".npz", ".obj", ".off", ".stl"])
def test_info_of_a_mesh(table, suffix):
    made = facts("mesh", table, "-o", f"m{suffix}")
    out = facts("info", f"m{suffix}")
    assert out["kind"] == "mesh"
    assert out["cells"]["face" if suffix == ".ply" else "triangle"] == made["triangles"]
    assert f"{made['triangles']:,} " in ok("info", f"m{suffix}")


def test_info_of_files_that_hold_points_or_meshes(folder):
    points = np.random.default_rng(0).random((20, 2))
    np.savez("p.npz", points=points)
    assert facts("info", "p.npz")["kind"] == "points"
    header = "ply\nformat ascii 1.0\nelement vertex 20\nproperty double x\nproperty double y\n"
    body = "\n".join(f"{x!r} {y!r}" for x, y in points.tolist())
    Path("p.ply").write_text(f"{header}end_header\n{body}\n")
    assert facts("info", "p.ply")["points"] == 20
    Path("bad.npz").write_bytes(b"PK but no archive")
    assert "bad.npz" in refused(1, "info", "bad.npz")


def test_info_of_a_demo_shape():
    out = facts("info", "demo:target")
    assert (out["components"], out["holes"]) == am.DEMO_SHAPES["target"].betti


# demo


def test_demo_writes_a_gallery(folder):
    out = facts("demo", "g", "-s", "annulus", "-s", "bars", "-n", "300", "--quick")
    assert [shape["name"] for shape in out["shapes"]] == ["annulus", "bars"]
    page = Path(out["page"]).read_text()
    names = [name for shape in out["shapes"] for name in shape["files"]]
    assert files("g") == {"index.html", *names}
    assert all(f'"{name}"' in page for name in names)
    with Image.open("g/annulus-mask.png") as mask:
        assert (np.asarray(mask) == am.demo_mask("annulus")).all()
    assert len(am.read_points("g/bars-cloud.csv")) == 300
    assert "1 component, 1 hole" in page
    assert page.count("At radius ") == page.count("<section") == 2


def test_demo_can_be_run_again(folder):
    for _ in range(2):
        assert "1 shape drawn; open" in ok("demo", "g", "-s", "disc", "-n", "50", "--quick")


def test_demo_needs_a_place():
    assert "does not exist; create it first" in refused(1, "demo", "no/such", "-s", "disc")
    Path("file").touch()
    assert "is a file" in refused(2, "demo", "file", "-s", "disc")


# The program


@pytest.mark.parametrize("command", COMMANDS)
def test_help_has_examples_that_parse(command):
    text = ok(command, "--help")
    lines = text.partition("Examples:\n")[2].splitlines()
    examples = [line.strip() for line in lines if line.strip()]
    assert examples
    for example in examples:
        for part in example.split(" | "):
            name, *args = shlex.split(part)[1:]
            parsed = app.get_command(None, name).make_context(name, args)
            assert isinstance(parsed.command, Command | click.Group)


def test_top_help_names_commands_and_exit_codes():
    text = ok("--help")
    assert all(f"  {command} " in text for command in COMMANDS)
    assert all(f"  {code} " in text for code in ("0", "1", "2", "130"))
    assert ok("-h") == text


def test_unknown_commands_and_options_are_usage_errors():
    assert "No such command 'frobnicate'" in refused(2, "frobnicate")
    assert "--frob" in refused(2, "mesh", "demo:disc", "--frob")
    assert "INPUT" in refused(2, "mesh")


def test_version():
    assert ok("--version").startswith("alphamesh ")


def test_figure_formats_are_those_of_the_plots():
    assert FigureFile().formats() == tuple(f".{name}" for name in FIGURE_FORMATS)


def test_module_runs_without_colours_into_a_pipe(table):
    done = process("mesh", table)
    assert done.returncode == 0
    assert done.stderr == b""
    assert b"Triangles" in done.stdout
    assert b"\x1b" not in done.stdout


def test_errors_of_the_program_end_it_with_their_code():
    for args, code in ((("mesh", "nothing.csv"), 1), (("mesh", "demo:disc", "-r", "x"), 2)):
        done = process(*args)
        assert done.returncode == code
        assert done.stderr.startswith((b"Error: ", b"Usage: "))
        assert b"Traceback" not in done.stderr
        assert done.stdout == b""


@pytest.mark.parametrize("library", ["click", "rich"])
def test_without_its_libraries_the_program_says_what_to_install(library):
    code = (
        f"import sys; sys.modules[{library!r}] = None; from alphamesh.cli import main; main([])"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=False
    )
    assert done.returncode == 1
    assert done.stderr.count("\n") == 1
    assert f"needs {library}" in done.stderr
    assert 'pip install "alphamesh[cli]"' in done.stderr


def test_a_missing_plot_library_is_told_before_the_work(table):
    code = (
        "import sys; sys.modules['matplotlib'] = None; from alphamesh.cli import main;"
        f"main(['mesh', {table!r}, '-o', 'm.ply', '--plot', 'm.png'])"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=False
    )
    assert done.returncode == 1
    assert 'pip install "alphamesh[plot]"' in done.stderr
    assert files() == {table}


@pytest.mark.skipif(os.name == "nt", reason="signals of another kind")
@pytest.mark.parametrize("delay", [0.05, 0.8])
def test_interrupting_ends_soon_and_leaves_nothing(delay):
    args = ("mesh", "demo:disc", "-n", "2000000", "-o", "m.vtu", "--plot", "m.png")
    with subprocess.Popen(
        [sys.executable, "-m", "alphamesh", *args],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
    ) as running:
        time.sleep(delay)
        running.send_signal(signal.SIGINT)
        start = time.monotonic()
        out, err = running.communicate(timeout=20)
        waited = time.monotonic() - start
    assert b"Traceback" not in err or delay < 0.1  # before the program is loaded
    assert files() == set()
    assert out == b""
    assert waited < 2
    if delay > 0.1:
        assert running.returncode == 130
        assert b"no half-written file" in err


@pytest.mark.skipif(os.name == "nt", reason="pipes of another kind")
def test_a_reader_that_stops_listening_is_no_error_to_speak_of():
    with subprocess.Popen(
        [sys.executable, "-m", "alphamesh", "sample", "demo:disc", "-n", "200000", "-o", "-"],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
    ) as running:
        assert running.stdout.readline() == b"x,y\n"
        running.stdout.close()
        assert running.stderr.read() == b""
        assert running.wait(timeout=20) == 1


# Progress


def shown(monkeypatch, *, terminal: bool, quiet: bool = False) -> str:
    monkeypatch.setattr("alphamesh.cli.progress._PATIENCE", 0.0)
    target = io.StringIO()
    console = Console(file=target, force_terminal=terminal, width=100)
    with Steps(quiet=quiet, console=console) as steps, steps.step("Thinking hard") as done:
        time.sleep(0.05)
        done(0.5)
        time.sleep(0.25)
    return target.getvalue()


def test_progress_is_shown_on_a_terminal_only(monkeypatch):
    text = shown(monkeypatch, terminal=True)
    assert "Thinking hard" in text
    assert "50%" in text
    assert shown(monkeypatch, terminal=False) == ""
    assert shown(monkeypatch, terminal=True, quiet=True) == ""


def test_short_work_shows_no_progress():
    target = io.StringIO()
    with Steps(console=Console(file=target, force_terminal=True)) as steps, steps.step("Short"):
        pass
    assert "Short" not in target.getvalue()


def test_file_sizes_are_said_as_people_say_them():
    assert [size_text(n) for n in (0, 999, 1500, 2_340_000, 7e9)] == [
        "0 bytes",
        "999 bytes",
        "1.5 kB",
        "2.34 MB",
        "7 GB",
    ]
