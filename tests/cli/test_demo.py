"""``alphamesh demo``."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
from PIL import Image

import alphamesh as am
from cli_tools import facts, files, ok, refused


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
    assert page.count("<section") == 2
    assert len(re.findall(r"At radius [\d.]+, \d+ triangles", page)) == 2


def test_demo_can_be_run_again(folder):
    for _ in range(2):
        assert "1 shape drawn; open" in ok("demo", "g", "-s", "disc", "-n", "50", "--quick")


def test_demo_needs_a_place():
    assert "does not exist; create it first" in refused(1, "demo", "no/such", "-s", "disc")
    Path("file").touch()
    assert "is a file" in refused(2, "demo", "file", "-s", "disc")


def test_demo_films_unless_it_must_be_quick(folder):
    out = facts("demo", "g", "--shapes", "annulus,bars", "-n", "60", "--quick")
    names = {name for shape in out["shapes"] for name in shape["files"]}
    assert [shape["name"] for shape in out["shapes"]] == ["annulus", "bars"]
    assert not any(name.endswith(".gif") for name in names)
    assert names | {"index.html"} == {path.name for path in Path("g").iterdir()}
    out = facts("demo", "h", "--shapes", "disc", "-n", "30")
    film = next(name for name in out["shapes"][0]["files"] if name.endswith(".gif"))
    with Image.open(Path("h") / film) as image:
        assert image.n_frames == 40
    assert film in Path("h/index.html").read_text()
