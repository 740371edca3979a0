"""Figures of cells, hull, frame and their compositions: counted against the data."""

from __future__ import annotations

import numpy as np
import pytest

pytest.importorskip("matplotlib")

from hypothesis import given
from hypothesis import strategies as st
from matplotlib.path import Path as Outline

import alphamesh as am
from alphamesh.errors import ParameterError
from alphamesh.plot import (
    cell_coloring,
    figure_bytes,
    plot_frame,
    plot_hull,
    plot_outlines,
    plot_radii,
    plot_restricted_voronoi,
    plot_story,
    plot_union,
    plot_voronoi,
    three_radii,
)
from alphamesh.plot.paths import closed_rings, drawn_count, outline_paths
from alphamesh.plot.style import CELL_COLORS

DEGENERATE = {
    "none": np.empty((0, 2)),
    "one": np.array([[3.0, 4.0]]),
    "two": np.array([[0.0, 0.0], [1.0, 2.0]]),
    "all equal": np.full((7, 2), 2.5),
    "horizontal": np.column_stack([np.arange(9.0), np.zeros(9)]),
    "slanted": np.column_stack([np.arange(9.0), 2 * np.arange(9.0)]),
    "square": np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]]),
    "duplicates": np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 0.0]]),
    "tiny": 1e-30 * np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]),
    "huge": 1e30 * np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]),
    "far away": 1e8 + np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]),
}


@pytest.fixture(scope="module")
def alpha() -> am.AlphaComplex:
    return am.AlphaComplex(am.demo_cloud("cheese", 600, seed=1))


@pytest.fixture(scope="module")
def cells(alpha):
    """Cells of which some are free and some meet."""
    cells = alpha.restricted_voronoi(9.0)
    assert cells.is_free.any()
    assert len(cells.triangles)
    return cells


def drawn(artists) -> int:
    return sum(drawn_count(artist.get_paths()) for artist in artists)


def marked(artists) -> np.ndarray:
    return np.concatenate([artist.get_offsets() for artist in artists])


def enclosed(artists) -> float:
    """Return the area within the outlines of filled artists, curves followed finely."""
    total = 0.0
    for artist in artists:
        for path in artist.get_paths():
            for corners in path.to_polygons(closed_only=True):
                x, y = np.asarray(corners).T
                total += float(x[:-1] @ y[1:] - x[1:] @ y[:-1]) / 2
    return total


# Colours


@given(st.integers(1, 60), st.data())
def test_cells_that_meet_have_different_colours(count, data):
    row = st.integers(0, count - 1)
    edges = data.draw(
        st.lists(st.tuples(row, row).filter(lambda e: e[0] != e[1]), max_size=200)
    )
    edges = np.array(edges, dtype=np.int32).reshape(-1, 2)
    colors = cell_coloring(count, edges)
    assert len(colors) == count
    assert (colors >= 0).all()
    assert (colors[edges[:, 0]] != colors[edges[:, 1]]).all()
    degree = np.bincount(edges.ravel(), minlength=count)
    assert (colors <= degree).all()


def test_few_colours_are_enough_for_many_cells():
    alpha = am.AlphaComplex(am.demo_cloud("disc", 20_000, seed=2))
    colors = cell_coloring(20_000, alpha.simplices[1])
    assert colors.max() <= 7
    np.testing.assert_array_equal(colors, cell_coloring(20_000, alpha.simplices[1]))


# How dichromats see linear RGB (Machado, Oliveira and Fernandes 2009).
VISION = {
    "usual": np.eye(3),
    "deuteranope": [[0.367, 0.861, -0.228], [0.280, 0.673, 0.047], [-0.012, 0.043, 0.969]],
    "protanope": [[0.152, 1.053, -0.205], [0.115, 0.786, 0.099], [-0.004, -0.048, 1.052]],
    "tritanope": [[1.256, -0.077, -0.179], [-0.078, 0.931, 0.148], [0.005, 0.691, 0.304]],
}
TO_XYZ = np.array(
    [[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]]
)


@pytest.mark.parametrize("reader", VISION)
def test_colours_of_cells_are_apart_for_every_reader(reader):
    shades = [[int(color[k : k + 2], 16) / 255 for k in (1, 3, 5)] for color in CELL_COLORS]
    linear = ((np.array(shades) + 0.055) / 1.055) ** 2.4
    seen = np.clip(linear @ np.transpose(VISION[reader]), 0, 1)
    x, y, z = np.cbrt(seen @ TO_XYZ.T / TO_XYZ.sum(axis=1)).T
    lab = np.column_stack((116 * y - 16, 500 * (x - y), 200 * (y - z)))
    apart = np.hypot(*(lab[:, None] - lab).transpose(2, 0, 1)[1:])
    apart = np.hypot(apart, lab[:, None, 0] - lab[:, 0])[np.triu_indices(len(lab), 1)]
    # Two of a colour difference are what can just be told side by side.
    assert apart.min() > 10
    assert lab[:, 0].min() > 70


# Voronoi


def test_voronoi_fills_the_axes_and_draws_the_ridges_that_cross_them(alpha):
    drawing = plot_voronoi(alpha.voronoi)
    ax = drawing.axes
    (xmin, xmax), (ymin, ymax) = ax.get_xlim(), ax.get_ylim()
    area = (xmax - xmin) * (ymax - ymin)
    assert drawn(drawing.artists["cells"]) == len(alpha.points)
    assert enclosed(drawing.artists["cells"]) == pytest.approx(area, rel=1e-9)
    segments, _ = alpha.voronoi.segments((xmin, ymin, xmax, ymax))
    assert 0 < drawn(drawing.artists["ridges"]) == len(segments)
    assert len(marked(drawing.artists["points"])) == len(alpha.points)


def test_voronoi_without_colours(alpha):
    artists = plot_voronoi(alpha.voronoi, fill=False).artists
    assert "cells" not in artists
    assert drawn(artists["ridges"])


def test_reach_shows_more_around_the_points(alpha):
    near, far = (plot_voronoi(alpha.voronoi, reach=reach).axes for reach in (0, 40))
    np.testing.assert_allclose(far.get_xlim(), np.add(near.get_xlim(), (-40, 40)))
    same = plot_restricted_voronoi(alpha.restricted_voronoi(40.0)).axes
    assert same.get_xlim() == far.get_xlim()


# Restricted cells


def test_restricted_cells_are_drawn_once_each(cells):
    artists = plot_restricted_voronoi(cells).artists
    assert drawn(artists["cells"]) == len(cells.points)
    assert drawn(artists["segments"]) == len(cells.edges)
    assert drawn(artists["arcs"]) >= np.count_nonzero(cells.is_arc)
    np.testing.assert_array_equal(marked(artists["points"]), cells.points)


def test_the_filled_cells_have_the_area_of_the_union(cells):
    for drawing in (plot_restricted_voronoi(cells), plot_union(cells)):
        role = "cells" if "cells" in drawing.artists else "union"
        # Curves are turned into polygons within a fraction of a unit.
        assert enclosed(drawing.artists[role]) == pytest.approx(cells.total_area, rel=5e-3)


def test_arcs_are_curves_on_their_circles(cells):
    paths = [
        path
        for artist in plot_restricted_voronoi(cells).artists["arcs"]
        for path in artist.get_paths()
    ]
    assert {code for path in paths for code in path.codes} == {Outline.MOVETO, Outline.CURVE4}
    ends = np.concatenate([path.vertices[[0, 3]] for path in paths])
    nearest = np.hypot(*(ends[:, None] - cells.points).transpose(2, 0, 1)).min(axis=1)
    np.testing.assert_allclose(nearest, cells.radius, rtol=1e-9)


def test_cells_keep_the_colours_that_are_given(alpha, cells):
    coloring = np.zeros(len(cells.points), dtype=np.int64)
    coloring[:10] = 1
    first, second = plot_restricted_voronoi(cells, coloring=coloring).artists["cells"]
    assert drawn([first]) == len(cells.points) - 10
    assert drawn([second]) == 10
    with pytest.raises(ParameterError, match="600 whole numbers"):
        plot_restricted_voronoi(cells, coloring=coloring[:-1])
    with pytest.raises(ParameterError, match="cell_coloring"):
        plot_voronoi(alpha.voronoi, coloring=coloring + 0.5)


def test_at_radius_zero_there_are_points_alone(alpha):
    artists = plot_restricted_voronoi(alpha.restricted_voronoi(0.0)).artists
    assert set(artists) == {"points"}


def test_small_discs_are_not_hidden_by_their_outlines(alpha):
    widths = [
        plot_restricted_voronoi(alpha.restricted_voronoi(radius))
        .artists["arcs"][0]
        .get_linewidths()[0]
        for radius in (0.5, 9.0)
    ]
    assert widths[0] < widths[1]


def test_outlines_of_any_rows_are_gathered():
    rings = np.arange(14.0).reshape(7, 2)
    outlines = closed_rings(rings, np.array([0, 3, 3, 7]))
    assert outlines[2].tolist() == [0, 4, 4, 9]
    (path,) = outline_paths(*outlines, np.array([2, 1]))
    np.testing.assert_array_equal(path.vertices, rings[[3, 4, 5, 6, 3]])
    assert path.codes.tolist() == [1, 2, 2, 2, 79]
    assert outline_paths(*outlines, np.array([1])) == []


# Hull and frame


def test_hull_draws_ring_corners_and_points(alpha):
    hull = alpha.convex_hull
    artists = plot_hull(hull).artists
    assert drawn(artists["hull_edges"]) == len(hull.ring)
    np.testing.assert_array_equal(marked(artists["corners"]), hull.corners)
    assert enclosed(artists["hull"]) == pytest.approx(hull.area)


def test_frame_draws_what_is_kept_and_what_is_dropped(alpha):
    framed = am.framed_delaunay(alpha.points, am.Frame("circle"))
    artists = plot_frame(framed).artists
    assert drawn(artists["triangles"]) == len(framed.triangles)
    assert drawn(artists["edges"]) == len(framed.edges)
    np.testing.assert_array_equal(marked(artists["frame_points"]), framed.frame_points)
    kept = {tuple(edge) for edge in np.sort(framed.edges, axis=1).tolist()}
    everything = {tuple(edge) for edge in np.sort(framed.full.edges, axis=1).tolist()}
    border = np.count_nonzero(framed.neighbors < 0)
    assert drawn(artists["boundary_edges"]) == border
    dropped = drawn(artists["frame_edges"])
    assert len(everything - kept) <= dropped <= len(everything - kept) + border


# Composed views


def test_story_has_six_panels_with_the_same_limits(alpha):
    figure = plot_story(alpha, 20.0)
    said = [ax.get_title(loc="left") for ax in figure.axes]
    assert said[:4] == ["Cloud", "Convex hull", "Voronoi cells", "Delaunay triangulation"]
    assert said[4:] == ["Cells within radius 20", "Alpha complex, radius 20"]
    assert len({(ax.get_xlim(), ax.get_ylim()) for ax in figure.axes}) == 1
    assert f"{len(alpha.at(20.0).triangles):,} triangles" in figure.axes[5].texts[0].get_text()
    assert f"{len(alpha.at(20.0).edges):,} pairs" in figure.axes[4].texts[0].get_text()


def test_a_cell_has_one_colour_in_all_panels_of_the_story(alpha):
    figure = plot_story(alpha, 20.0)

    def shades(ax):
        return [
            (tuple(artist.get_facecolor()[0]), drawn([artist]))
            for artist in ax.collections
            if artist.get_zorder() == figure.axes[2].collections[0].get_zorder()
        ]

    assert shades(figure.axes[2]) == shades(figure.axes[4])


@pytest.mark.parametrize(("columns", "wide"), [(6, 6.0), (3, 1.4), (1, 0.2)])
def test_story_stands_in_any_number_of_columns(alpha, columns, wide):
    width, height = plot_story(alpha, 20.0, columns=columns).get_size_inches()
    assert 0.6 * wide < width / height < 1.2 * wide
    for wrong in (0, 7, 1.5):
        with pytest.raises(ParameterError, match="from 1 to 6"):
            plot_story(alpha, 20.0, columns=wrong)


def test_radii_shows_betti_numbers_that_tell_the_story(alpha):
    figure = plot_radii(alpha)
    assert len(figure.axes) == 6
    radii = three_radii(alpha.filtration)
    numbers = alpha.persistence().betti_numbers(radii).tolist()
    assert numbers[2][1] == 0 < numbers[1][1]
    said = [ax.texts[0].get_text() for ax in figure.axes[:3]]
    for (b0, b1), text in zip(numbers, said, strict=True):
        assert text.startswith(f"{b0:,} component")
        assert f", {b1:,} hole" in text
    assert len(plot_radii(alpha, [5.0]).axes) == 2
    for wrong in ([], [1.0] * 7, [np.inf], [-1.0]):
        with pytest.raises(ParameterError):
            plot_radii(alpha, wrong)


def test_outlines_tells_what_the_frame_drops(alpha):
    framed = am.framed_delaunay(alpha.points)
    figure = plot_outlines(alpha)
    fewer = len(alpha.simplices[2]) - len(framed.triangles)
    assert figure.axes[2].texts[0].get_text() == f"{fewer} triangles fewer"


@pytest.mark.parametrize("points", DEGENERATE.values(), ids=DEGENERATE)
def test_degenerate_clouds_are_drawn(points):
    alpha = am.AlphaComplex(points)
    radius = 0.3 * float(np.ptp(points)) if len(points) else 0.5
    cells = alpha.restricted_voronoi(radius)
    figures = [
        plot_hull(alpha.convex_hull).figure,
        plot_voronoi(alpha.voronoi).figure,
        plot_restricted_voronoi(cells).figure,
        plot_union(cells).figure,
        plot_story(alpha, radius),
        plot_radii(alpha, [radius]),
    ]
    if np.ptp(points, axis=0).any() if len(points) else False:
        figures.append(plot_outlines(alpha))
    for figure in figures:
        assert figure_bytes(figure, dpi=20).startswith(b"\x89PNG")
