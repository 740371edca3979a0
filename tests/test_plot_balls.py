"""Pictures of unions of balls: who is in front, and in which color."""

from __future__ import annotations

import numpy as np
import pytest

import alphamesh as am
from alphamesh.errors import ParameterError

pytest.importorskip("matplotlib")

from alphamesh.plot import figure_bytes, plot_balls

TOP = (90.0, -90.0)  # x to the right, y up


def picture(points, weights, colors, view=TOP):
    balls = am.AlphaComplex(np.asarray(points, dtype=float), weights=weights).union(0)
    drawing = plot_balls(balls, colors=colors, view=view)
    (image,) = drawing.artists["balls"]
    assert figure_bytes(drawing.figure, "png").startswith(b"\x89PNG")
    return np.asarray(image.get_array()), image.get_extent()


def hue(pixel):
    return int(np.argmax(pixel)) if np.ptp(pixel) > 0.1 else None


def test_the_nearest_ball_is_seen():
    points = [[0, 0, 0], [0, 0, 3], [4, 0, 0], [0.5, 4, 1]]
    shown, extent = picture(points, [4, 1, 1, 1], ["red", "lime", "blue", "blue"])
    middle, scale = (len(shown) - 1) / 2, len(shown) / (extent[1] - extent[0])
    centre = (np.min(points, axis=0) + np.max(points, axis=0)) / 2

    def at(x, y):
        column, row = (middle + scale * (np.array([x, y]) - centre[:2])).round().astype(int)
        return hue(shown[row, column])

    assert at(0, 0) == 1  # the small ball on top of the large one
    assert at(1.4, 0) == 0
    assert at(4, 0) == 2
    assert at(0.5, 4) == 2
    assert at(4, 4) is None  # white
    below, _ = picture(points, [4, 1, 1, 1], ["red", "lime", "blue", "blue"], (-90.0, -90.0))
    assert not any(hue(pixel) == 1 for pixel in below.reshape(-1, 3))


def test_the_outline_is_a_circle():
    shown, extent = picture([[0, 0, 0], [9, 9, 9]], [4, -1], "red")
    covered = (shown[..., 1] < 0.99).mean() * (extent[1] - extent[0]) ** 2
    assert covered == pytest.approx(4 * np.pi, rel=0.02)


def test_nothing_and_what_is_refused():
    nothing = am.AlphaComplex(np.empty((0, 3))).union(1)
    assert np.all(np.asarray(plot_balls(nothing).artists["balls"][0].get_array()) == 1)
    balls = am.AlphaComplex(np.eye(3)).union(1)
    with pytest.raises(ParameterError, match="one for each of 3 points; got 2"):
        plot_balls(balls, colors=["red", "blue"])
    with pytest.raises(ParameterError, match="colors must be colors of matplotlib"):
        plot_balls(balls, colors="no such color")
    with pytest.raises(ParameterError, match="view must be two angles"):
        plot_balls(balls, view=(1, 2, 3))
