"""What the tests of the commands start from: a folder of their own, and files in it."""

from __future__ import annotations

from importlib.util import find_spec
from pathlib import Path

import numpy as np
import pytest

import alphamesh as am

_NEEDED = ("click", "rich", "matplotlib", "PIL")
collect_ignore_glob = [] if all(map(find_spec, _NEEDED)) else ["test_*.py"]


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Run every test in a folder of its own."""
    monkeypatch.chdir(tmp_path)
    return tmp_path


def save_table(points: np.ndarray) -> None:
    np.savetxt("points.csv", points, delimiter=",", header="x,y", comments="", fmt="%.17g")


@pytest.fixture
def table(folder: Path) -> str:
    """A table of 300 points, of which five are duplicates."""
    points = am.demo_cloud("annulus", 295, seed=4)
    save_table(np.concatenate([points, points[:5]]))
    return "points.csv"


@pytest.fixture
def points(folder: Path) -> np.ndarray:
    """A table of 200 points, ``points.csv``."""
    cloud = am.demo_cloud("eight", 200, seed=4)
    save_table(cloud)
    return cloud


@pytest.fixture
def image(folder: Path) -> str:
    """A small mask image."""
    from PIL import Image

    Image.fromarray(am.demo_mask("eight", 64)).save("mask.png")
    return "mask.png"
