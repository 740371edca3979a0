"""The page looks as it did.

``ALPHAMESH_BASELINES=anew pytest tests/view/test_looks.py`` draws the baselines anew; look
at them.
"""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from view_page import Visit, image_of

BASELINE = Path(__file__).parent.parent / "baseline" / "view"
PICTURES = {
    "early": {"radius": 9.0, "layers": "dtebsp"},
    "cells": {"radius": 14.0, "layers": "vp"},
    "chosen": {"radius": 19.0, "layers": "tebsp"},
}
SOLIDS = {
    "solid-early": {"radius": 0.13, "layers": "besnp"},
    "solid-chosen": {"radius": 0.3, "layers": "besnp"},
    "solid-cut": {"radius": 0.3, "layers": "besnpx"},
}


WEIGHTED = {
    "crowns-small": {"radius": -1.5, "layers": "dtebsph"},
    "crowns-cells": {"radius": 2.0, "layers": "dvph"},
    "atoms": {"radius": -0.5, "layers": "besnpoh"},
    "atoms-cut": {"radius": 0.5, "layers": "besnox"},
}
BOXES = {
    "tile": {"radius": 0.55, "layers": "dtebsp"},
    "tile-cells": {"radius": 0.45, "layers": "vp"},
    "block": {"radius": 0.12, "layers": "besnp"},
    "block-cut": {"radius": 0.12, "layers": "besnxo"},
}
ALL = PICTURES | SOLIDS | WEIGHTED | BOXES


@pytest.fixture(scope="module")
def pages(file, solid, crowns, atoms, tile, block):
    plane = dict.fromkeys(PICTURES, file)
    weighted = {name: atoms if name.startswith("atoms") else crowns[1] for name in WEIGHTED}
    boxes = {name: tile[1] if name.startswith("tile") else block[1] for name in BOXES}
    return plane | dict.fromkeys(SOLIDS, solid) | weighted | boxes


def drawn(visit, radius, layers):
    visit.page.evaluate(
        "([r, show]) => alphamesh._restore({radius: r, layers: show})", [radius, layers]
    )
    return image_of(visit.picture())


def small(browser, file):
    return Visit(browser, file, viewport={"width": 840, "height": 480})


@pytest.mark.parametrize("name", ALL)
def test_pictures_look_as_they_did(name, browser, pages):
    from PIL import Image

    from test_pictures import MOST_OF_A_PIXEL, MOST_ON_AVERAGE, difference

    page = pages[name]
    if os.environ.get("ALPHAMESH_BASELINES") == "anew":
        draw_baselines(browser, page, {name: ALL[name]})
    with small(browser, page) as visit, Image.open(BASELINE / f"{name}.png") as kept:
        now = Image.fromarray(drawn(visit, **ALL[name]))
        assert now.size == kept.size
        apart = difference(now, kept.convert("RGB"))
    assert apart.mean() < MOST_ON_AVERAGE
    assert apart.max() < MOST_OF_A_PIXEL


def test_no_baseline_is_left_over():
    assert {path.stem for path in BASELINE.glob("*.png")} == set(ALL)


def draw_baselines(browser, file, pictures):
    from PIL import Image

    BASELINE.mkdir(parents=True, exist_ok=True)
    with small(browser, file) as visit:
        for name, state in pictures.items():
            image = Image.fromarray(drawn(visit, **state))
            image.quantize(255).save(BASELINE / f"{name}.png", optimize=True)
