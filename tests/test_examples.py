"""Every example runs as it is, without a warning, and makes what it says."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import alphamesh as am

EXAMPLES = Path(__file__).parent.parent / "examples"

MADE = {
    "mask_to_mesh.py": {"mesh.ply", "overview.png"},
    "growing_radius.py": {"growing_radius.png"},
    "outline_of_points.py": {"points.csv"},
}


def run(name: str, folder: Path, *args: str) -> str:
    if name != "outline_of_points.py":
        pytest.importorskip("matplotlib")
    done = subprocess.run(
        [sys.executable, "-W", "error", str(EXAMPLES / name), *args],
        cwd=folder,
        capture_output=True,
        text=True,
        check=False,
        timeout=60,
    )
    assert done.returncode == 0, done.stderr
    assert done.stderr == ""
    return done.stdout


def test_every_example_is_listed_here():
    assert {path.name for path in EXAMPLES.glob("*.py")} == set(MADE)


@pytest.mark.parametrize("name", MADE)
def test_example_makes_its_files(name, tmp_path):
    assert run(name, tmp_path)
    assert {path.name for path in tmp_path.iterdir()} == MADE[name]
    assert all(path.stat().st_size > 1000 for path in tmp_path.iterdir())


def test_mask_example_takes_an_image(tmp_path):
    image = pytest.importorskip("PIL.Image")
    mask = np.zeros((40, 60), np.uint8)
    mask[5:35, 10:50] = 255
    image.fromarray(mask).save(tmp_path / "box.png")
    (tmp_path / "out").mkdir()
    run("mask_to_mesh.py", tmp_path, "box.png", "out")
    assert (tmp_path / "out" / "mesh.ply").exists()


def test_outline_example_finds_the_area_of_the_shape(tmp_path):
    lines = run("outline_of_points.py", tmp_path, *()).splitlines()
    shape = am.AlphaComplex(am.read_points(tmp_path / "points.csv")).at()
    assert lines[-1].split()[-1] == f"{shape.area:.3f}"
    rings = [line for line in lines if " points: " in line]
    total = sum(float(line.split()[-1]) for line in rings)
    assert total == pytest.approx(shape.area, abs=0.001 * len(rings))
    assert rings[0].startswith("outline")
    assert rings[1].startswith("hole")
