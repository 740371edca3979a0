"""``alphamesh sample``."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import alphamesh as am
from alphamesh.cli.write_points import POINT_WRITERS
from cli_tools import facts, ok, refused


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
