"""``alphamesh plot``."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import alphamesh as am
from alphamesh.cli.plot import VIEWS
from cli_tools import facts, refused


@pytest.mark.parametrize("view", [view for view in VIEWS if view != "surface"])
def test_every_view_makes_a_picture(points, view):
    out = facts("plot", "points.csv", "--view", view, "-o", "a.png", "--dpi", "40", "-r", "30")
    assert out["view"] == view
    assert ("radius" in out) == VIEWS[view]
    with Image.open("a.png") as image:
        assert (np.asarray(image.convert("L")) < 250).any()


def test_plot_chooses_a_radius_and_writes_several_files(points):
    out = facts("plot", "points.csv", "-o", "a.svg", "-o", "a.pdf")
    choice = am.AlphaComplex(points).choose_radius()
    assert out["radius"] == choice.radius
    assert out["rule"] == choice.rule
    assert [file["path"] for file in out["files"]] == ["a.svg", "a.pdf"]
    assert Path("a.svg").read_text().count("<path") > 50


def test_plot_of_what_is_not_there(points):
    assert "--output" in refused(2, "plot", "points.csv")
    assert "story" in refused(2, "plot", "points.csv", "-o", "a.png", "--view", "nice")
    assert "finite" in refused(
        2, "plot", "points.csv", "-o", "a.png", "--view", "union", "-r", "inf"
    )
