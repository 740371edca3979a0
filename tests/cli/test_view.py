"""``alphamesh view``: a page of points."""

from __future__ import annotations

import json

import numpy as np
import pytest

import alphamesh as am


def run(*arguments):
    pytest.importorskip("click")
    pytest.importorskip("rich")
    from click.testing import CliRunner

    from alphamesh.cli.app import app

    return CliRunner().invoke(app, ["view", *arguments], prog_name="alphamesh")


def test_the_command_writes_a_page(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    done = run("demo:eight", "-n", "200", "--title", "An eight", "-o", "page.html", "--json")
    assert done.exit_code == 0, done.output
    facts = json.loads(done.stdout)
    assert facts["rule"] == "topology"
    assert [file["path"] for file in facts["files"]] == ["page.html"]
    assert "<title>An eight</title>" in (tmp_path / "page.html").read_text("utf-8")


def test_the_command_shows_the_page_when_asked(tmp_path, monkeypatch):
    pytest.importorskip("click")
    monkeypatch.chdir(tmp_path)
    opened = []
    monkeypatch.setattr("click.launch", opened.append)
    done = run("demo:disc", "-n", "50", "-r", "20", "-o", "page.html", "--open")
    assert done.exit_code == 0, done.output
    assert opened == [(tmp_path / "page.html").resolve().as_uri()]


def test_the_command_wants_a_page(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert ".html" in run("demo:disc", "-o", "page.png").output
    assert "Missing option" in run("demo:disc").output
    assert list(tmp_path.iterdir()) == []


def test_the_command_shows_points_in_space(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    points = am.sample_solid("torus", 300, seed=1)
    np.save("torus.npy", points)
    done = run("torus.npy", "-r", "0.4", "-o", "page.html", "--title", "A torus")
    assert done.exit_code == 0, done.output
    am.AlphaComplex(points).view("wanted.html", 0.4, title="A torus")
    written, wanted = ((tmp_path / f"{name}.html").read_bytes() for name in ("page", "wanted"))
    assert written == wanted
