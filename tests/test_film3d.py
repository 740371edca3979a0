"""Films of clouds in space."""

from itertools import pairwise

import numpy as np
import pytest
from PIL import Image, ImageSequence

import alphamesh as am
from alphamesh.errors import DimensionError, ParameterError
from alphamesh.film import film_radii

pytest.importorskip("matplotlib")

SHELL = np.random.default_rng(5).normal(size=(120, 3))
SHELL /= np.linalg.norm(SHELL, axis=1, keepdims=True)


def frames_of(path):
    with Image.open(path) as film:
        return [
            np.asarray(frame.convert("RGB")).astype(int)
            for frame in ImageSequence.Iterator(film)
        ]


def test_film_in_space_tells_components_loops_and_voids(tmp_path):
    alpha = am.AlphaComplex(SHELL)
    film = alpha.animate(tmp_path / "a.gif", frames=16, width=240)
    pairs = alpha.persistence()
    np.testing.assert_array_equal(film.betti, pairs.betti_numbers(film.radii))
    assert film.betti.shape == (16, 3) and film.betti[0].tolist() == [120, 0, 0]
    assert film.betti[:, 2].max() == 1  # the hollow of the sphere
    pictures = frames_of(film.path)
    assert len(pictures) == 16 and pictures[0].shape[:2] == film.size[::-1]
    changed = [np.abs(b - a).sum() for a, b in pairwise(pictures)]
    assert min(changed) > 0


def test_the_last_frame_comes_after_the_longest_void():
    pairs = am.AlphaComplex(SHELL).persistence()
    born, filled = pairs.births[2], pairs.deaths[2]
    assert film_radii(pairs, frames=20)[-1] >= filled[np.argmax(filled - born)]


def test_the_camera_turns_left_and_stands_still_right(tmp_path):
    alpha = am.AlphaComplex(SHELL)
    last = alpha.critical_radii()[-1]

    def halves(turn):
        film = alpha.animate(
            tmp_path / "a.gif", radii=[last, 2 * last], width=240, turn=turn, fps=1
        )
        first, second = frames_of(film.path)
        # Without the headline, which tells the radius, and the curves with their mark.
        height, width = first.shape[:2]
        difference = np.abs(second - first)[height // 6 : 2 * height // 3] > 40
        return difference[:, : width // 2].sum(), difference[:, width // 2 :].sum()

    left, right = halves(90.0)
    assert left > 100 and right == 0
    assert halves(0.0) == (0, 0)


def test_turns_are_for_space_and_are_numbers(tmp_path):
    with pytest.raises(ParameterError, match="turn must be degrees"):
        am.AlphaComplex(SHELL).animate(tmp_path / "a.gif", turn="left")
    with pytest.raises(ParameterError, match="only films of clouds in space turn"):
        am.AlphaComplex(SHELL[:, :2]).animate(tmp_path / "a.gif", turn=10)


@pytest.mark.parametrize(
    "points", [np.empty((0, 3)), np.zeros((1, 3)), np.eye(3)[:2], np.eye(3), np.zeros((3, 3))]
)
def test_degenerate_clouds_in_space_are_filmed(points, tmp_path):
    film = am.AlphaComplex(points).animate(tmp_path / "a.gif", frames=3, width=200)
    assert len(frames_of(film.path)) >= 1 and film.betti.shape[1] == 3


def test_views_are_each_for_one_kind_of_cloud():
    from alphamesh.plot import GrowthView, GrowthView3D

    with pytest.raises(DimensionError, match="in the plane alone"):
        GrowthView(am.AlphaComplex(SHELL).persistence(), (0.1, 1.0))
    with pytest.raises(DimensionError, match="points in space"):
        GrowthView3D(am.AlphaComplex(SHELL[:, :2]).persistence(), (0.1, 1.0))
