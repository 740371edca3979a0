"""Figures: as many simplices drawn as there are, legible at any size, no state left behind."""

from __future__ import annotations

import io
import subprocess
import sys

import numpy as np
import pytest

pytest.importorskip("matplotlib")

from matplotlib.figure import Figure
from PIL import Image

import alphamesh as am
from alphamesh.errors import CloudShapeError, NonFiniteError, ParameterError
from alphamesh.plot import (
    COLORS,
    FIGURE_FORMATS,
    figure_bytes,
    plot_cloud,
    plot_complex,
    plot_delaunay,
    plot_filtration,
    plot_overview,
)
from alphamesh.plot.paths import drawn_count
from alphamesh.plot.style import point_spacing

DEGENERATE = {
    "none": np.empty((0, 2)),
    "one": np.array([[3.0, 4.0]]),
    "origin": np.zeros((1, 2)),
    "two": np.array([[0.0, 0.0], [1.0, 2.0]]),
    "all equal": np.full((7, 2), 2.5),
    "horizontal": np.column_stack([np.arange(9.0), np.zeros(9)]),
    "vertical": np.column_stack([np.zeros(9), np.arange(9.0)]),
    "slanted": np.column_stack([np.arange(9.0), 2 * np.arange(9.0)]),
    "square": np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]]),
    "tiny": 1e-30 * np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]),
    "huge": 1e30 * np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]),
    "far away": 1e8 + np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]),
}


@pytest.fixture(scope="module")
def alpha() -> am.AlphaComplex:
    return am.AlphaComplex(am.demo_cloud("cheese", 600, seed=1))


@pytest.fixture(scope="module")
def ragged(alpha: am.AlphaComplex) -> am.AlphaShape:
    """A complex with simplices of every kind."""
    shape = alpha.at(0.5 * alpha.choose_radius("all-points").radius)
    assert min(shape.counts.values()) > 0
    return shape


def drawn(artists) -> int:
    return sum(drawn_count(artist.get_paths()) for artist in artists)


def marked(artists) -> np.ndarray:
    return np.concatenate([artist.get_offsets() for artist in artists])


def pixels(figure: Figure, dpi: float | None = None) -> np.ndarray:
    with Image.open(io.BytesIO(figure_bytes(figure, "png", dpi=dpi))) as image:
        return np.asarray(image.convert("RGB")).astype(int)


def share_of(image: np.ndarray, color: str) -> float:
    """Return the part of the pixels that have nearly this colour."""
    rgb = [int(color[k : k + 2], 16) for k in (1, 3, 5)]
    return float((np.abs(image - rgb).max(axis=2) < 12).mean())


# As many as there are


def test_cloud_marks_every_point_where_it_is(alpha):
    drawing = plot_cloud(alpha.points)
    np.testing.assert_array_equal(marked(drawing.artists["points"]), alpha.points)


def test_delaunay_draws_every_edge_once(alpha):
    for source in (alpha.delaunay, alpha.filtration):
        drawing = plot_delaunay(source)
        assert drawn(drawing.artists["edges"]) == len(alpha.simplices[1])
        assert len(marked(drawing.artists["points"])) == len(alpha.points)


def test_complex_draws_each_kind_of_simplex(ragged):
    artists = plot_complex(ragged).artists
    assert drawn(artists["triangles"]) == len(ragged.triangles)
    for role in ("interior_edges", "boundary_edges", "singular_edges"):
        assert drawn(artists[role]) == len(getattr(ragged, role)), role
    np.testing.assert_array_equal(
        marked(artists["isolated_vertices"]), ragged.points[ragged.isolated_vertices]
    )
    assert len(marked(artists["vertices"])) == len(np.unique(ragged.edges))


def test_drawn_triangles_have_the_corners_of_the_shape(ragged):
    (artist,) = plot_complex(ragged).artists["triangles"]
    corners = np.concatenate([path.vertices for path in artist.get_paths()])
    expected = ragged.points[ragged.triangles[:, [0, 1, 2, 0]]].reshape(-1, 2)
    np.testing.assert_array_equal(corners, expected)


def test_kinds_that_are_missing_have_no_artist(alpha):
    artists = plot_complex(alpha.at(np.inf)).artists
    assert "triangles" in artists
    assert "singular_edges" not in artists
    assert "isolated_vertices" not in artists


def test_filtration_draws_every_simplex_in_a_colour_that_grows_with_its_value(alpha):
    drawing = plot_filtration(alpha.filtration)
    assert drawn(drawing.artists["edges"]) == len(alpha.simplices[1])
    assert drawn(drawing.artists["triangles"]) == len(alpha.simplices[2])
    (artist,) = drawing.artists["triangles"]
    # The paths go up in value, and viridis gets lighter all the way.
    lightness = artist.get_facecolor()[:, :3] @ [0.2126, 0.7152, 0.0722]
    assert len(lightness) > 20
    assert np.all(np.diff(lightness) >= 0)


def test_more_simplices_than_one_path_or_artist_takes(monkeypatch):
    monkeypatch.setattr("alphamesh.plot.drawing._PER_ARTIST", 1000)
    alpha = am.AlphaComplex(am.demo_cloud("disc", 3000, seed=5))
    artists = plot_complex(alpha.at(np.inf)).artists
    assert len(artists["triangles"]) > 3
    assert drawn(artists["triangles"]) == len(alpha.simplices[2])
    assert len(marked(plot_cloud(alpha.points).artists["points"])) == 3000


# What the eye sees


def test_the_filled_area_is_the_area_of_the_shape(alpha):
    shape = alpha.at()
    drawing = plot_complex(shape)
    ax = drawing.axes
    box = ax.get_window_extent()
    inch = (ax.get_xlim()[1] - ax.get_xlim()[0]) / box.width
    image = pixels(drawing.figure)
    inside = 1 - (image.min(axis=2) > 250).mean()
    drawn_area = inside * image.shape[0] * image.shape[1] * inch**2
    # Singular edges and the width of the boundary add a little.
    assert shape.area < drawn_area < 1.12 * shape.area


def test_neighbouring_triangles_are_filled_without_a_seam():
    side = np.arange(60.0)
    grid = np.stack(np.meshgrid(side, side), axis=-1).reshape(-1, 2)
    shape = am.AlphaComplex(grid).at(np.inf)
    figure = Figure(figsize=(3, 3), dpi=100)
    ax = figure.add_axes((0, 0, 1, 1))
    drawing = plot_complex(shape, ax)
    for artist in drawing.artists["interior_edges"]:
        artist.remove()
    middle = pixels(figure)[50:250, 50:250]
    assert share_of(middle, COLORS["triangles"]) == 1.0


@pytest.mark.parametrize("count", [50, 2000, 60_000])
def test_legible_at_any_size(count):
    points = am.demo_cloud("disc", count, seed=2)
    cloud = pixels(plot_cloud(points).figure)
    ink = (cloud.min(axis=2) < 200).mean()
    # Neither invisible nor one black blob (the disc is about two thirds of the picture).
    assert 0.002 < ink < 0.62
    alpha = am.AlphaComplex(points)
    shape = pixels(plot_complex(alpha.at(alpha.choose_radius("all-points").radius)).figure)
    assert share_of(shape, COLORS["triangles"]) > 0.15
    assert share_of(shape, COLORS["boundary_edges"]) > 0.001


def test_long_edges_across_a_gap_stay_visible_in_a_dense_cloud():
    gap = am.demo_cloud("annulus", 40_000, seed=1)
    drawing = plot_delaunay(am.delaunay(gap))
    widths = [artist.get_linewidths()[0] for artist in drawing.artists["edges"]]
    assert widths[-1] >= 0.3 > widths[0]


def test_roles_are_told_apart_without_colour():
    """Grey levels of what lies on each other differ by at least a tenth."""
    rgb = {
        role: np.array([int(color[k : k + 2], 16) for k in (1, 3, 5)]) / 255
        for role, color in COLORS.items()
    }
    grey = {role: float(value @ [0.2126, 0.7152, 0.0722]) for role, value in rgb.items()}
    layered = ["boundary_edges", "interior_edges", "triangles"]
    levels = [grey[role] for role in layered] + [1.0]
    assert min(np.diff(levels)) > 0.1
    assert abs(grey["singular_edges"] - grey["boundary_edges"]) > 0.1


def test_spacing_ignores_holes_and_gaps():
    rng = np.random.default_rng(0)
    square = rng.random((40_000, 2))
    assert point_spacing(square) == pytest.approx(1 / 200, rel=0.05)
    two = np.concatenate([square, square + np.array([50.0, 0.0])])
    assert point_spacing(two) == pytest.approx(1 / 200, rel=0.6)
    assert point_spacing(7 * square) == pytest.approx(7 * point_spacing(square))
    line = np.column_stack([np.linspace(0, 99, 100), np.zeros(100)])
    assert point_spacing(line) == pytest.approx(1.0, rel=0.05)
    assert point_spacing(square[:1]) == np.inf
    assert point_spacing(np.empty((0, 2))) == np.inf


# The composed view


def test_overview_has_three_panels_and_tells_radius_and_counts(alpha, ragged):
    figure = plot_overview(alpha, ragged.radius)
    assert len(figure.axes) == 3
    said = [ax.get_title(loc="left") for ax in figure.axes]
    said += [text.get_text() for ax in figure.axes for text in ax.texts]
    assert said[:3] == [
        "Cloud",
        "Delaunay triangulation",
        f"Alpha complex, radius {ragged.radius:.4g}",
    ]
    assert said[3] == "600 points"
    assert f"{len(alpha.simplices[2]):,} triangles" in said[4]
    assert f"{len(ragged.triangles)} triangles" in said[5]
    assert f"{len(ragged.singular_edges)} singular edges" in said[5]
    assert all(ax.get_aspect() == 1 for ax in figure.axes)


def test_overview_text_stays_inside_the_figure(alpha, ragged):
    for figure in (plot_overview(alpha, ragged.radius), plot_overview(alpha, 0)):
        figure.draw_without_rendering()
        texts = [text for ax in figure.axes for text in (*ax.texts, ax._left_title)]
        texts += [text for legend in figure.legends for text in legend.get_texts()]
        for text in texts:
            box = text.get_window_extent()
            assert 0 <= box.x0 < box.x1 <= figure.bbox.x1, text.get_text()
            assert 0 <= box.y0 < box.y1 <= figure.bbox.y1, text.get_text()


def test_overview_legend_names_only_what_is_drawn(alpha, ragged):
    def names(figure):
        return [text.get_text() for legend in figure.legends for text in legend.get_texts()]

    assert names(plot_overview(alpha, np.inf)) == ["triangle", "boundary edge"]
    assert len(names(plot_overview(alpha, ragged.radius))) == 4
    assert names(plot_overview(alpha, 0)) == ["isolated vertex"]


def test_overview_chooses_a_radius_if_none_is_given(alpha):
    choice = alpha.choose_radius()
    assert f"{choice.radius:.4g}" in plot_overview(alpha.filtration).axes[2].get_title(
        loc="left"
    )


def test_overview_tells_duplicates():
    points = np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 0.0]])
    figure = plot_overview(am.AlphaComplex(points), 1.0)
    assert figure.axes[0].texts[0].get_text() == "4 points, 1 duplicate"


@pytest.mark.parametrize("stretch", [(1, 1), (20, 1), (1, 20), (3, 1)])
def test_overview_follows_the_proportions_of_the_cloud(alpha, stretch):
    figure = plot_overview(am.AlphaComplex(alpha.points * stretch), 30.0)
    width, height = figure.get_size_inches()
    assert 12 < width < 15
    assert 2 < height < 9
    assert len(figure_bytes(figure, "png", dpi=40)) > 1000


# Degenerate clouds


@pytest.mark.parametrize("name", DEGENERATE)
def test_degenerate_clouds_draw(name):
    points = DEGENERATE[name]
    alpha = am.AlphaComplex(points)
    radius = alpha.choose_radius().radius if len(points) else 1.0
    figures = [
        plot_cloud(points).figure,
        plot_delaunay(alpha.delaunay).figure,
        plot_filtration(alpha.filtration).figure,
        plot_complex(alpha.at(radius)).figure,
        plot_overview(alpha, radius),
    ]
    for figure in figures:
        ink = (pixels(figure, dpi=40).min(axis=2) < 250).any()
        assert ink or len(points) == 0


def test_a_collinear_cloud_shows_its_path():
    alpha = am.AlphaComplex(DEGENERATE["slanted"])
    artists = plot_complex(alpha.at()).artists
    assert drawn(artists["singular_edges"]) == 8
    assert "triangles" not in artists


def test_points_that_are_no_cloud_are_refused():
    with pytest.raises(NonFiniteError, match="row 1"):
        plot_cloud([[0.0, 0.0], [np.nan, 1.0]])
    with pytest.raises(CloudShapeError):
        plot_cloud([1.0, 2.0, 3.0])


# Axes, figures, files


def test_given_axes_are_used_and_kept_equal(ragged):
    figure = Figure()
    left, right = figure.subplots(1, 2)
    drawing = plot_complex(ragged, right)
    assert drawing.axes is right
    assert drawing.figure is figure
    assert not left.collections
    assert right.get_aspect() == 1
    low, high = ragged.points.min(axis=0), ragged.points.max(axis=0)
    assert right.get_xlim()[0] < low[0] < high[0] < right.get_xlim()[1]
    assert right.get_ylim()[0] < low[1] < high[1] < right.get_ylim()[1]
    assert drawing._repr_png_() is None


def test_a_drawing_of_its_own_shows_itself_in_a_notebook(ragged):
    drawing = plot_complex(ragged)
    assert drawing._repr_png_().startswith(b"\x89PNG")


def test_shapes_and_complexes_plot_themselves(alpha, ragged):
    for drawing in (ragged.plot(), alpha.plot(ragged.radius)):
        assert drawn(drawing.artists["triangles"]) == len(ragged.triangles)


@pytest.mark.parametrize("name", FIGURE_FORMATS)
def test_equal_figures_give_equal_bytes(ragged, name):
    first, second = (figure_bytes(plot_complex(ragged).figure, name) for _ in range(2))
    assert first == second
    start = {"png": b"\x89PNG", "pdf": b"%PDF", "svg": b"<?xml"}[name]
    assert first.startswith(start)


def test_many_simplices_become_pixels_in_vector_files():
    alpha = am.AlphaComplex(am.demo_cloud("disc", 12_000, seed=1))
    drawing = plot_complex(alpha.at())
    assert all(artist.get_rasterized() for artist in drawing.artists["triangles"])
    assert not any(artist.get_rasterized() for artist in drawing.artists["boundary_edges"])
    assert len(figure_bytes(drawing.figure, "svg")) < 2_000_000


def test_unknown_figure_format_lists_the_known_ones(ragged):
    with pytest.raises(ParameterError, match="png, pdf, svg"):
        figure_bytes(plot_complex(ragged).figure, "bmp")


def test_dpi_scales_the_picture(ragged):
    figure = plot_complex(ragged).figure
    sizes = []
    for dpi in (50, 100):
        with Image.open(io.BytesIO(figure_bytes(figure, dpi=dpi))) as image:
            sizes.append(image.size)
    assert sizes == [(300, 300), (600, 600)]


def run(code: str) -> str:
    return subprocess.run(
        [sys.executable, "-W", "error", "-c", code], check=True, capture_output=True, text=True
    ).stdout


def test_pyplot_is_never_loaded():
    out = run(
        "import sys, alphamesh as am\n"
        "alpha = am.AlphaComplex(am.demo_cloud('disc', 100, seed=0))\n"
        "am.plot.figure_bytes(am.plot.plot_overview(alpha))\n"
        "print('matplotlib.pyplot' in sys.modules)"
    )
    assert out == "False\n"


def test_without_matplotlib_the_error_names_the_extra():
    out = run(
        "import sys\n"
        "sys.modules['matplotlib'] = None\n"
        "import alphamesh as am\n"
        "alpha = am.AlphaComplex([[0, 0], [1, 0], [0, 1]])\n"
        "try:\n"
        "    alpha.plot(1.0)\n"
        "except am.errors.MissingLibraryError as error:\n"
        "    print(error)\n"
    )
    assert 'pip install "alphamesh[plot]"' in out
