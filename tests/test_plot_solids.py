"""Figures in space: what is in front hides what is behind, cuts show the inside."""

from __future__ import annotations

import io
import itertools
import subprocess
import sys

import numpy as np
import pytest

pytest.importorskip("matplotlib")

from PIL import Image

import alphamesh as am
from alphamesh.errors import CloudShapeError, NonFiniteError, ParameterError
from alphamesh.plot import (
    COLORS,
    figure_bytes,
    plot_cloud_in_space,
    plot_overview,
    plot_solid,
    plot_surface,
)
from alphamesh.plot.drawing import new_figure
from alphamesh.plot.section import cut_open

DEGENERATE = {
    "none": np.empty((0, 3)),
    "one": np.array([[3.0, 4.0, 5.0]]),
    "equal": np.ones((5, 3)),
    "line": np.outer(np.arange(5.0), [1, 2, 3]),
    "plane": np.array(list(itertools.product(range(3), range(3), [0])), dtype=float),
    "tiny": 1e-60 * np.eye(4, 3),
    "huge": 1e60 * np.eye(4, 3),
    "far": 1e7 + np.eye(4, 3),
}


@pytest.fixture(scope="module")
def shell():
    return am.AlphaComplex(am.sample_solid("shell", 3000, seed=1)).at(0.2)


@pytest.fixture(scope="module")
def ragged():
    """A complex with simplices of every kind."""
    shape = am.AlphaComplex(am.sample_solid("torus", 900, seed=1)).at(0.08)
    assert min(shape.counts.values()) > 0
    return shape


def pixels(drawing, dpi=60):
    with Image.open(io.BytesIO(figure_bytes(drawing.figure, "png", dpi=dpi))) as image:
        return np.asarray(image.convert("RGB")).astype(int)


def painted(image):
    return float((image.min(axis=2) < 250).mean())


def hue_share(image, color):
    """Return the part of the pixels of about this hue, however bright."""
    wanted = np.array([int(COLORS[color][k : k + 2], 16) for k in (1, 3, 5)], dtype=float)
    there = image.min(axis=2) < 250
    lengths = np.linalg.norm(image, axis=2) * np.linalg.norm(wanted)
    cosine = (image @ wanted) / np.maximum(lengths, 1.0)
    return float((there & (cosine > 0.995)).mean())


def scene_of(drawing):
    return drawing.artists["scene"]


def count(drawing):
    return sum(len(artist.get_paths()) for artist in scene_of(drawing))


def test_a_ball_is_a_disc_of_about_half_its_triangles():
    shape = am.AlphaComplex(am.sample_solid("ball", 2000, seed=1)).at(0.5)
    drawing = plot_solid(shape)
    seen, all_of_them = count(drawing), len(shape.boundary_triangles)
    assert 0.35 * all_of_them < seen < 0.5 * all_of_them
    image = pixels(drawing)
    # A disc of 1 / 1.04 of the height, in axes of 0.96 of the figure.
    assert painted(image) == pytest.approx(np.pi / 4 * (0.96 / 1.04) ** 2, rel=0.04)
    assert hue_share(image, "flesh") < 0.01


def test_a_cut_shows_the_cavity(shell):
    closed, opened = pixels(plot_solid(shell)), pixels(plot_solid(shell, cut="-y"))
    assert hue_share(closed, "flesh") < 0.01
    assert hue_share(opened, "flesh") > 0.2
    assert hue_share(opened, "skin") > 0.1


def test_cuts_are_named_or_given(shell):
    by_name = pixels(plot_solid(shell, cut="x"))
    low, high = shell.points[:, 0].min(), shell.points[:, 0].max()
    for cut in ("+x", [1, 0, 0], np.array([1.0, 0, 0, (low + high) / 2])):
        np.testing.assert_array_equal(pixels(plot_solid(shell, cut=cut)), by_name)
    assert (pixels(plot_solid(shell, cut="-x")) != by_name).any()
    whole = plot_solid(shell, cut=(1, 0, 0, 9), view=(20, 30))
    assert (pixels(whole) == pixels(plot_solid(shell, view=(20, 30)))).all()
    assert plot_solid(shell, cut=(1, 0, 0, -9)).artists == {}


@pytest.mark.parametrize("cut", ["w", "", (1, 2), (0, 0, 0), (1, 0, np.nan), "xy", object()])
def test_other_cuts_are_refused(shell, cut):
    with pytest.raises(ParameterError, match="cut must be"):
        plot_solid(shell, cut=cut)


@pytest.mark.parametrize("view", [(1,), (1, np.inf), (1, 2, 3)])
def test_other_views_are_refused(shell, view):
    with pytest.raises(ParameterError, match="view must be"):
        plot_solid(shell, view=view)
    with pytest.raises(ParameterError, match="view must be"):
        plot_surface(shell.surface(), view=view)


def test_sections_fill_what_they_cut(shell):
    normal, offset = np.array([0.3, -1.0, 0.2]), 0.1
    section = cut_open(shell.points, shell.boundary_triangles, shell.tetrahedra, normal, offset)
    corners = section.points[np.concatenate((section.skin, section.flesh))]
    # Skin and flesh together are closed: they enclose as much as is left of the tetrahedra.
    sides = corners[:, 1:] - corners[:, :1]
    areas = np.cross(sides[:, 0], sides[:, 1])
    np.testing.assert_allclose(areas.sum(axis=0), 0, atol=1e-12)
    enclosed = np.einsum("ij,ij->i", areas, corners[:, 0]).sum() / 6
    mirrored = cut_open(
        shell.points, shell.boundary_triangles, shell.tetrahedra, -normal, -offset
    )
    other = mirrored.points[np.concatenate((mirrored.skin, mirrored.flesh))]
    rest = np.einsum(
        "ij,ij->i", np.cross(other[:, 1] - other[:, 0], other[:, 2] - other[:, 0]), other[:, 0]
    )
    assert 0 < enclosed < shell.volume
    assert enclosed + rest.sum() / 6 == pytest.approx(shell.volume, rel=1e-12)
    assert (section.points[np.unique(section.skin)] @ normal <= offset + 1e-12).all()
    np.testing.assert_allclose(section.points[section.flesh] @ normal, offset, atol=1e-12)
    # Seen from the side taken away, the cut is whole: no triangle faces away from it.
    flesh = section.points[section.flesh]
    turns = np.cross(flesh[:, 1] - flesh[:, 0], flesh[:, 2] - flesh[:, 0]) @ normal
    assert (turns >= 0).all()
    lines = section.points[section.lines]
    np.testing.assert_allclose(lines @ normal, offset, atol=1e-12)


def test_what_is_singular_is_drawn(ragged):
    drawing = plot_solid(ragged)
    image = pixels(drawing, dpi=100)
    for role, share in (("skin", 0.01), ("films", 0.01), ("isolated_vertices", 1e-4)):
        assert hue_share(image, role) > share, role
    counts = ragged.counts
    lone = counts["singular_triangles"] + counts["isolated_edges"]
    lone += 8 * counts["isolated_vertices"]
    solid = count(plot_solid(am.Selection3D(ragged.filtration, 0.08, ragged._has_tetrahedron)))
    # Seen from a little nearer, a triangle or two more face away.
    assert count(drawing) == pytest.approx(lone + solid, abs=5)


def test_the_nearer_ball_hides_the_other():
    balls = am.AlphaComplex(am.sample_solid("two-balls", 3000, seed=1)).at(0.4)
    one = balls.select([0])
    aside = painted(pixels(balls.plot(view=(0, -90))))
    behind = pixels(balls.plot(view=(0, 0)))
    # Two discs side by side are half as high each; in a row, the nearer one is seen alone.
    assert aside < 0.6 * painted(behind)
    assert painted(behind) == pytest.approx(painted(pixels(one.plot(view=(0, 0)))), rel=0.15)


@pytest.mark.parametrize("name", DEGENERATE)
def test_any_cloud_can_be_drawn(name):
    cx = am.AlphaComplex(DEGENERATE[name])
    image = pixels(cx.plot(np.inf))
    assert (painted(image) > 0) == (len(cx.points) > 0)
    pixels(cx.plot(np.inf, cut="z"))


def test_on_given_axes(shell):
    figure = new_figure(4, 2)
    ax = figure.subplots(1, 2)[1]
    drawing = shell.surface().plot(ax)
    assert drawing.axes is ax
    assert not drawing.owns_figure
    assert shell.plot().owns_figure
    assert ax.get_aspect() == 1.0


def test_the_overview_of_a_cloud_in_space(shell):
    cx = am.AlphaComplex(np.concatenate([shell.points, shell.points[:2]]))
    figure = plot_overview(cx, 0.2)
    texts = [text.get_text() for ax in figure.axes for text in ax.texts]
    texts += [ax.get_title() for ax in figure.axes] + [
        ax.get_title("left") for ax in figure.axes
    ]
    told = " ".join(texts)
    for words in ("3,002 points, 2 duplicates", "radius 0.2", "tetrahedra", "1 region, 1 void"):
        assert words in told
    cloud = figure.axes[0].collections[0]
    assert len(cloud.get_offsets()) == 3002
    assert len(plot_overview(cx).axes) == 3


def test_points_are_drawn_from_back_to_front():
    points = np.array([[0.0, -1, 0], [0, 1, 0], [1, 0, 0], [-1, 0, 0.5]])
    drawing = plot_cloud_in_space(points, view=(0, -90))
    dots = drawing.artists["points"][0]
    seen = np.asarray(dots.get_offsets())
    # From the front, x runs to the right and z upwards; the nearest point comes last.
    assert np.sign(seen[:, 0].round(9)).tolist() in ([0, 1, -1, 0], [0, -1, 1, 0])
    shades = dots.get_facecolors()[:, 0]
    assert (np.diff(shades) <= 0).all()
    assert shades[0] > shades[-1]
    assert plot_cloud_in_space(np.empty((0, 3))).artists == {}
    with pytest.raises(CloudShapeError):
        plot_cloud_in_space([[0.0, 1.0]])
    with pytest.raises(NonFiniteError):
        plot_cloud_in_space([[0.0, 1.0, np.nan]])


def test_equal_figures_are_equal_bytes(shell):
    first = figure_bytes(shell.plot(cut="x").figure, "png", dpi=50)
    assert first == figure_bytes(shell.plot(cut="x").figure, "png", dpi=50)


def test_large_ones_are_pixels_in_vector_files():
    shape = am.AlphaComplex(am.sample_solid("ball", 60_000, seed=1)).at(0.03)
    drawing = plot_solid(shape)
    assert count(drawing) > 20_000
    assert all(artist.get_rasterized() for artist in scene_of(drawing))


def test_no_screen_is_needed_and_pyplot_stays_away():
    code = (
        "import os, sys; os.environ.pop('DISPLAY', None)\n"
        "import alphamesh as am\n"
        "cx = am.AlphaComplex(am.sample_solid('ball', 100, seed=1))\n"
        "png = cx.plot(1.0)._repr_png_()\n"
        "print(png[:4], 'matplotlib.pyplot' in sys.modules)"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True
    )
    assert done.stdout.strip() == r"b'\x89PNG' False"
