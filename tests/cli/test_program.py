"""The program as a whole: help, exit codes, interrupts, pipes, progress."""

from __future__ import annotations

import io
import os
import shlex
import signal
import subprocess
import sys
import time

import click
import pytest
from rich.console import Console

from alphamesh.cli.app import app
from alphamesh.cli.command import Command
from alphamesh.cli.files import FigureFile
from alphamesh.cli.progress import Steps
from alphamesh.cli.summary import size_text
from alphamesh.plot import FIGURE_FORMATS
from cli_tools import files, ok, process, refused

COMMANDS = tuple(app.list_commands(None))


@pytest.mark.parametrize("command", COMMANDS)
def test_help_has_examples_that_parse(command):
    if isinstance(app.get_command(None, command), click.Group):
        pytest.skip("a group of commands")
    text = ok(command, "--help")
    lines = text.partition("Examples:\n")[2].splitlines()
    examples = [line.strip() for line in lines if line.strip()]
    assert examples
    for example in examples:
        for part in example.partition(" > ")[0].partition(" >> ")[0].split(" | "):
            if not part.startswith("alphamesh "):
                continue
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
