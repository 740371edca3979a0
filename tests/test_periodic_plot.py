"""Figures of periodic boxes: what crosses a border is drawn on both sides."""

from __future__ import annotations

import numpy as np
import pytest

import alphamesh as am
from alphamesh.errors import DimensionError, ParameterError
from alphamesh.plot import plot_periodic


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
    with pytest.raises(DimensionError, match="corners"):
        made.plot(1)
    flat = am.AlphaComplex([[0.1, 0.2]], periods=(1, 1))
    with pytest.raises(ParameterError, match="margin"):
        flat.plot(1, margin=2)
