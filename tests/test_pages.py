"""The tutorial as a notebook, and the pictures of the pages."""

from __future__ import annotations

import importlib.util
import json
import re
import shutil
import subprocess
from pathlib import Path

import pytest

DOCS = Path(__file__).resolve().parent.parent / "docs"


def script(name):
    spec = importlib.util.spec_from_file_location(name, DOCS / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_the_notebook_is_that_of_the_page():
    made = script("make_notebook").notebook_of((DOCS / "tutorial.md").read_text("utf-8"))
    kept = (DOCS / "tutorial.ipynb").read_text("utf-8")
    assert kept == made, "run python docs/make_notebook.py"


def test_the_notebook_has_every_line_of_code_and_no_output():
    page = (DOCS / "tutorial.md").read_text("utf-8")
    blocks = re.findall(r"^```python\n(.*?)^```", page, re.MULTILINE | re.DOTALL)
    book = json.loads((DOCS / "tutorial.ipynb").read_text("utf-8"))
    code = [cell for cell in book["cells"] if cell["cell_type"] == "code"]
    assert ["".join(cell["source"]) for cell in code] == [text.strip() for text in blocks]
    assert len(code) > 10
    assert all(cell["outputs"] == [] for cell in code)
    told = "".join("".join(cell["source"]) for cell in book["cells"])
    assert "<!-- output -->" not in told
    assert len({cell["id"] for cell in book["cells"]}) == len(book["cells"])


def test_pictures_are_small_and_each_has_a_maker():
    pytest.importorskip("matplotlib")
    pytest.importorskip("PIL")
    makers = script("make_pictures").MAKERS
    kept = {path.name: path.stat().st_size for path in (DOCS / "pictures").iterdir()}
    assert set(makers) <= set(kept)
    assert max(kept.values()) < 300_000


@pytest.mark.parametrize("name", ["topology.png", "cells.svg", "outlines.png"])
def test_makers_still_draw(name):
    pytest.importorskip("matplotlib")
    pytest.importorskip("PIL")
    content = script("make_pictures").MAKERS[name]()
    assert content.startswith(b"<?xml" if name.endswith("svg") else b"\x89PNG")
    assert len(content) < 300_000


def test_the_reference_of_the_commands_is_that_of_the_code():
    pytest.importorskip("click")
    pytest.importorskip("rich")
    made = script("make_commands").page()
    kept = (DOCS / "commands.md").read_text("utf-8")
    assert kept == made, "run python docs/make_commands.py"


def test_every_command_has_a_manual_page(tmp_path):
    pytest.importorskip("click")
    pytest.importorskip("rich")
    made = script("make_commands")
    made.write_manuals(tmp_path / "man")
    names = {path.name for path in (tmp_path / "man").iterdir()}
    commands = {name for name, _, _ in made.commands()}
    assert {name.split()[0] for name in commands} == set(made.COMMANDS)
    pages = {f"alphamesh-{name.replace(' ', '-')}.1" for name in commands}
    assert names == {"alphamesh.1", *pages}
    page = (tmp_path / "man" / "alphamesh-mesh.1").read_text("utf-8")
    for part in (".TH", ".SH NAME", ".SH SYNOPSIS", ".SH EXAMPLES", "\\-\\-output\\-dir"):
        assert part in page
    # A line that begins with a dot is a request; these are all that the pages need.
    for path in (tmp_path / "man").iterdir():
        requests = re.findall(r"^([.'][A-Za-z]*)", path.read_text("utf-8"), re.MULTILINE)
        assert set(requests) <= {".TH", ".SH", ".PP", ".TP", ".nf", ".fi"}


@pytest.mark.skipif(shutil.which("groff") is None, reason="groff is not installed")
def test_manual_pages_are_set_without_a_warning(tmp_path):
    pytest.importorskip("click")
    pytest.importorskip("rich")
    script("make_commands").write_manuals(tmp_path)
    for path in tmp_path.iterdir():
        done = subprocess.run(
            ["groff", "-man", "-Tascii", "-ww", str(path)], capture_output=True, check=True
        )
        assert done.stderr == b""
        assert b"alphamesh" in done.stdout
