"""A handful of pictures compared with those in ``tests/baseline``, which have no text.

``python tests/test_pictures.py`` draws the baselines anew; look at them before you keep them.
"""

from __future__ import annotations

import io
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("matplotlib")
pytest.importorskip("PIL")

from matplotlib.figure import Figure
from PIL import Image, ImageFilter

import alphamesh as am
from alphamesh import plot

BASELINE = Path(__file__).parent / "baseline"
SIDE = 180  # pixels
# Rasterisers differ in the last shade along a line; a line that is missing differs in all.
MOST_OF_A_PIXEL = 48
MOST_ON_AVERAGE = 0.6


def small():
    return am.AlphaComplex(am.demo_cloud("annulus", 60, seed=3))


DRAWN = {
    "hull": lambda ax: plot.plot_hull(small().convex_hull, ax),
    "voronoi": lambda ax: plot.plot_voronoi(small().voronoi, ax),
    "delaunay": lambda ax: plot.plot_delaunay(small().delaunay, ax),
    "restricted": lambda ax: plot.plot_restricted_voronoi(small().restricted_voronoi(30), ax),
    "union": lambda ax: plot.plot_union(small().restricted_voronoi(30), ax),
    "complex": lambda ax: plot.plot_complex(small().at(30), ax),
    "frame": lambda ax: plot.plot_frame(am.framed_delaunay(small().points), ax),
    "dense": lambda ax: plot.plot_restricted_voronoi(
        am.AlphaComplex(am.demo_cloud("eight", 3000, seed=1)).restricted_voronoi(9), ax
    ),
}


def draw(name: str) -> Image.Image:
    figure = Figure(figsize=(3, 3), dpi=SIDE / 3, facecolor="white")
    ax = figure.add_axes((0, 0, 1, 1))
    ax.set_axis_off()
    DRAWN[name](ax)
    return Image.open(io.BytesIO(plot.figure_bytes(figure, "png"))).convert("RGB")


def difference(first: Image.Image, second: Image.Image) -> np.ndarray:
    """Return how far two pictures are apart, both blurred by about a pixel."""
    one, two = (
        np.asarray(image.filter(ImageFilter.GaussianBlur(1.2))).astype(float)
        for image in (first, second)
    )
    return np.abs(one - two).max(axis=2)


@pytest.mark.parametrize("name", DRAWN)
def test_pictures_look_as_they_did(name):
    with Image.open(BASELINE / f"{name}.png") as kept:
        apart = difference(draw(name), kept.convert("RGB"))
    assert apart.shape == (SIDE, SIDE)
    assert apart.mean() < MOST_ON_AVERAGE
    assert apart.max() < MOST_OF_A_PIXEL


def test_the_comparison_sees_a_single_missing_line():
    picture = draw("complex")
    edited = np.asarray(picture).copy()
    edited[88:91, 15:60] = 255
    edited[45:48, 15:165] = (11, 79, 138)
    assert difference(picture, Image.fromarray(edited)).max() > MOST_OF_A_PIXEL
    assert difference(picture, picture).max() == 0


def test_no_baseline_is_left_over():
    assert {path.stem for path in BASELINE.glob("*.png")} == set(DRAWN)


if __name__ == "__main__":
    BASELINE.mkdir(exist_ok=True)
    for name in DRAWN:
        draw(name).save(BASELINE / f"{name}.png", optimize=True)
