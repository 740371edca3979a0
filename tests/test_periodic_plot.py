"""Figures of periodic boxes: what crosses a border is drawn on both sides."""

from __future__ import annotations

import matplotlib.colors
import numpy as np
import pytest

import alphamesh as am
from alphamesh.errors import DimensionError, ParameterError
from alphamesh.plot import COLORS, plot_periodic, plot_periodic_in_space
from alphamesh.plot.periodic3d import _Block, _sides
from alphamesh.plot.section import block_of, clipped_lines, clipped_triangles


def vertices_of(drawing, role):
    paths = [path for artist in drawing.artists[role] for path in artist.get_paths()]
    return np.concatenate([path.vertices for path in paths])


def test_an_edge_across_the_border_is_drawn_twice():
    made = am.AlphaComplex([[0.0625, 0.5], [0.9375, 0.5]], periods=(1, 1))
    drawing = plot_periodic(made.at(0.1), margin=0.25)
    assert set(drawing.artists) == {"singular_edges", "vertices"}
    ends = vertices_of(drawing, "singular_edges").reshape(-1, 2, 2)
    assert sorted(ends[:, :, 0].min(axis=1).tolist()) == [-0.0625, 0.9375]
    low, high = drawing.axes.get_xlim()
    assert low <= -0.25
    assert high >= 1.25


def test_a_whole_torus_fills_the_window():
    made = am.AlphaComplex(np.random.default_rng(1).random((30, 2)), periods=(1, 1))
    drawing = made.plot(10, margin=0.1)
    # Closed outlines of four corners each; their areas fill the window at least.
    corners = vertices_of(drawing, "triangles").reshape(-1, 4, 2)[:, :3]
    a, b = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    areas = (a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]) / 2
    assert (areas > 0).all()
    assert areas.sum() >= 1.2**2
    assert "boundary_edges" not in drawing.artists


def test_open_directions_and_lone_points():
    made = am.AlphaComplex([[0.25, 3.0], [1.25, 8.0]], periods=(2, None))
    drawing = made.plot(0.1)
    assert set(drawing.artists) == {"isolated_vertices"}
    assert len(drawing.axes.lines) == 2
    assert am.AlphaComplex(np.empty((0, 2)), periods=(2, None)).plot(1).artists == {}


def test_what_cannot_be_drawn_says_so():
    made = am.AlphaComplex([[0.1, 0.2, 0.3]], periods=(1, 1, 1))
    with pytest.raises(DimensionError, match="plot_periodic_in_space"):
        plot_periodic(made.at(1))
    with pytest.raises(ParameterError, match="cut"):
        made.plot(1, cut="up")
    flat = am.AlphaComplex([[0.1, 0.2]], periods=(1, 1))
    with pytest.raises(DimensionError, match="plot_periodic"):
        plot_periodic_in_space(flat.at(1))
    with pytest.raises(ParameterError, match="margin"):
        flat.plot(1, margin=2)


# In space

BOXES = {
    "cube": ((1, 1, 1), 60, False),
    "layer": ((1, 2, None), 80, False),
    "tube": ((None, 0.5, None), 40, False),
    "weighted": ((1, 1, 1), 60, True),
    "few": ((1, 1, 1), 2, False),
    "one": ((2, 1, 1), 1, False),
}


def box_of(name):
    periods, count, weighted = BOXES[name]
    rng = np.random.default_rng(5)
    sides = np.array([side or 1.0 for side in periods])
    weights = rng.random(count) / 40 if weighted else None
    return am.AlphaComplex(rng.random((count, 3)) * sides, periods=periods, weights=weights)


def signed_volume(points, triangles):
    a, b, c = points[triangles].transpose(1, 0, 2)
    return np.einsum("ij,ij->", a, np.cross(b, c)) / 6


@pytest.mark.parametrize("name", BOXES)
def test_the_block_holds_what_one_box_holds(name):
    made = box_of(name)
    middle = np.quantile(made.radii[3], 0.6)
    for radius in (middle, 10.0):
        shape = made.at(radius)
        block, walls = _Block(shape), _sides(made.filtration)
        points, skin, flesh, lines = block_of(*block.solid(), walls)
        seen = np.concatenate([skin, *flesh])
        # Skin and cuts close the block: its volume is that of the complex on the torus.
        assert signed_volume(points, seen) == pytest.approx(shape.volume, rel=1e-9)
        for (normal, offset), cut in zip(walls, flesh, strict=True):
            assert points[cut] @ normal == pytest.approx(offset, abs=1e-12)
            assert (points[np.concatenate((seen.ravel(), lines.ravel()))] @ normal).max() <= (
                offset + 1e-12
            )


@pytest.mark.parametrize("name", BOXES)
def test_every_box_in_space_is_drawn(name):
    made = box_of(name)
    lowest = min(values.min() for values in made.radii)
    for radius in (lowest, np.quantile(made.radii[2], 0.5), np.inf):
        drawing = made.plot(radius)
        assert set(drawing.artists) == {"scene"}
        drawing.figure.canvas.draw()


def test_lone_points_and_edges_are_seen_in_the_box():
    made = am.AlphaComplex([[0.0, 0.5, 0.5], [0.9, 0.5, 0.5]], periods=(1, 1, 1))
    assert len(_Block(made.at(0)).corners(0, _Block(made.at(0)).alone)) == 2
    shape = made.at(0.06)
    block = _Block(shape)
    ends = clipped_lines(block.corners(1, block.lone), _sides(made.filtration))
    # The short edge is seen at the right, and touches the box at the left.
    lengths = np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1)
    assert lengths.sum() == pytest.approx(0.1)
    assert ends.min() >= 0
    assert ends.max() <= 1


def test_triangles_are_clipped_on_all_sides():
    corners = np.array([[[-1.0, -1, 0], [3, -1, 0], [-1, 3, 0]]])
    x, y = np.eye(3)[:2]
    left = clipped_triangles(corners, [(-x, 0.0), (x, 1.0), (-y, 0.0), (y, 1.0)])
    sides = left[:, 1:] - left[:, :1]
    assert np.cross(sides[:, 0], sides[:, 1])[:, 2].sum() / 2 == pytest.approx(1)


def test_a_cut_takes_half_of_the_box_away():
    made = box_of("cube")

    def share(drawing, role):
        wanted = np.array(matplotlib.colors.to_rgb(COLORS[role]))
        drawing.figure.canvas.draw()
        picture = np.asarray(drawing.figure.canvas.buffer_rgba())[..., :3] / 255
        return (np.abs(picture - wanted).max(axis=2) < 0.2).mean()

    view = (24.0, -58.0)
    whole, half = made.plot(10, view=view), made.plot(10, cut="z", view=view)
    assert 0 < share(half, "flesh") < 0.8 * share(whole, "flesh")


@pytest.mark.parametrize("periods", [(1, 1, 1), (1, 1, None)])
def test_boxes_with_nothing_to_fill_are_drawn(periods):
    empty = am.AlphaComplex(np.empty((0, 3)), periods=periods)
    assert set(empty.plot(1).artists) == {"scene"}  # the frame
    flat = am.AlphaComplex(np.random.default_rng(2).random((9, 3)) * [1, 1, 0], periods=periods)
    assert set(flat.plot(10).artists) == {"scene"}
