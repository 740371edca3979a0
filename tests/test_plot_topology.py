"""Diagrams, barcodes and Betti curves: every class where it belongs, long ones thinned."""

from __future__ import annotations

import numpy as np
import pytest

pytest.importorskip("matplotlib")

from matplotlib.figure import Figure

import alphamesh as am
from alphamesh.errors import DimensionError, ParameterError
from alphamesh.plot import (
    figure_bytes,
    plot_barcode,
    plot_betti,
    plot_complex,
    plot_cycles,
    plot_diagram,
)


@pytest.fixture(scope="module")
def alpha():
    return am.AlphaComplex(am.demo_cloud("cheese", 500, seed=1))


@pytest.fixture(scope="module")
def pairs(alpha):
    return alpha.persistence()


def texts(drawing) -> list[str]:
    return [text.get_text() for text in drawing.axes.texts]


def test_diagram_marks_the_classes(pairs):
    drawing = plot_diagram(pairs)
    (holes,) = drawing.artists["holes"]
    marked = {tuple(place) for place in np.asarray(holes.get_offsets()).tolist()}
    wanted = {tuple(row) for row in pairs.diagram(1).tolist()}
    assert marked <= wanted
    # Of marks on one another, one is left.
    for birth, death in wanted - marked:
        near = min(max(abs(birth - b), abs(death - d)) for b, d in marked)
        assert near < 0.001 * drawing.axes.get_xlim()[1]


def test_diagram_shows_what_never_ends_above_all_others(pairs):
    drawing = plot_diagram(pairs)
    (components,) = drawing.artists["components"]
    top = np.asarray(components.get_offsets())[:, 1].max()
    finite = np.concatenate(pairs.diagrams())
    assert top > finite[np.isfinite(finite)].max()
    assert top < drawing.axes.get_ylim()[1]
    assert "never ends" in texts(drawing)


def test_long_diagrams_are_thinned():
    pairs = am.AlphaComplex(am.demo_cloud("disc", 60_000, seed=1)).persistence()
    drawing = plot_diagram(pairs)
    marks = sum(len(dots.get_offsets()) for dots in drawing.artists["components"])
    assert marks < 2000 < 0.1 * len(pairs.diagram(0))
    steps = [len(line.get_xdata()) for line in plot_betti(pairs).artists["holes"]]
    assert max(steps) < 4000 < len(pairs.betti_curve().radii)


def test_barcode_draws_the_longest_bars_and_counts_the_others(pairs):
    drawing = plot_barcode(pairs, most=7)
    diagram = pairs.diagram(1)
    longest = diagram[np.argsort(diagram[:, 0] - diagram[:, 1], kind="stable")[:7]]
    (lines,) = drawing.artists["holes"]
    shown = np.array([segment[:, 0] for segment in lines.get_segments()])
    np.testing.assert_allclose(shown, longest)
    assert f"and {len(diagram) - 7} shorter holes" in texts(drawing)
    assert f"and {len(pairs.diagram(0)) - 7} shorter components" in texts(drawing)
    for wrong in (0, 2.5, "all"):
        with pytest.raises(ParameterError, match="at least 1"):
            plot_barcode(pairs, most=wrong)


def test_bars_of_one_chart_do_not_lie_on_one_another(pairs):
    artists = plot_barcode(pairs).artists
    levels = [
        segment[0, 1]
        for role in ("components", "holes")
        for segment in artists[role][0].get_segments()
    ]
    assert len(set(levels)) == len(levels) == 80


def test_betti_curves_have_the_numbers_of_every_radius(pairs):
    artists = plot_betti(pairs).artists
    for column, role in enumerate(("components", "holes")):
        (line,) = artists[role]
        x, y = line.get_data()
        inner = (x > x[0]) & (x < x[-1])
        at = pairs.betti_numbers(np.asarray(x)[inner])[:, column]
        np.testing.assert_array_equal(np.asarray(y)[inner], at)


def test_the_chosen_radius_is_marked_with_what_it_gives(pairs):
    for draw in (plot_diagram, plot_barcode, plot_betti):
        drawing = draw(pairs, radius=20.0)
        (line,) = drawing.artists["radius"]
        assert 20.0 in line.get_xdata()
        assert any(text.startswith("r = 20") for text in texts(drawing))
    b0, b1 = pairs.betti_numbers(20.0)
    noun = "component" if b0 == 1 else "components"
    assert texts(plot_betti(pairs, radius=20.0)) == [f"r = 20: {b0} {noun}, {b1} holes"]
    assert "radius" not in plot_diagram(pairs).artists


def test_given_axes_are_used(pairs):
    figure = Figure()
    for draw, ax in zip(
        (plot_diagram, plot_barcode, plot_betti), figure.subplots(1, 3), strict=True
    ):
        drawing = draw(pairs, ax)
        assert drawing.axes is ax
        assert not drawing.owns_figure


@pytest.mark.parametrize(
    "points",
    [
        np.empty((0, 2)),
        np.zeros((1, 2)),
        np.zeros((4, 2)),
        np.array([[0.0, 0.0], [1.0, 0.0]]),
        1e-200 * np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]),
        1e140 * np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]]),
    ],
    ids=["none", "one", "equal", "two", "tiny", "huge"],
)
def test_degenerate_clouds_have_charts(points):
    pairs = am.AlphaComplex(points).persistence()
    for draw in (plot_diagram, plot_barcode, plot_betti):
        assert figure_bytes(draw(pairs, radius=0.5).figure, dpi=30).startswith(b"\x89PNG")


def test_charts_of_classes_in_space_have_loops_and_voids():
    rng = np.random.default_rng(4)
    sphere = rng.standard_normal((800, 3))
    sphere /= np.linalg.norm(sphere, axis=1)[:, np.newaxis]
    pairs = am.AlphaComplex(sphere).persistence()
    for plot in (plot_diagram, plot_barcode, plot_betti):
        drawing = plot(pairs, radius=0.5)
        assert {"components", "loops", "voids", "radius"} <= set(drawing.artists)
        assert "holes" not in drawing.artists
        legend = drawing.axes.get_legend()
        assert [text.get_text()[:4] for text in legend.get_texts()] == ["comp", "loop", "void"]
    assert "r = 0.5: 1 component, 0 loops, 1 void" in texts(drawing)
    (bars,) = plot_barcode(pairs).artists["voids"]
    (birth, _), (death, _) = bars.get_segments()[0]
    longest = pairs.diagram(2)[np.argmax(np.diff(pairs.diagram(2), axis=1))]
    assert [birth, death] == longest.tolist()


def test_cycles_are_drawn_around_the_holes_on_the_mesh(alpha, pairs):
    radius = alpha.choose_radius(holes=5).radius
    drawing = plot_cycles(pairs, radius)
    mesh = plot_complex(alpha.at(radius))
    assert set(drawing.artists) == {*mesh.artists, "cycles"}
    rings = list(pairs.holes(pairs.alive(radius)))
    assert len(rings) >= 5
    drawn = [
        {tuple(place) for path in artist.get_paths() for place in path.vertices.tolist()}
        for artist in drawing.artists["cycles"]
    ]
    assert drawn == [{tuple(place) for place in alpha.points[ring].tolist()} for ring in rings]
    assert len(plot_cycles(pairs, radius, most=1).artists["cycles"]) < len(drawn)
    with pytest.raises(ParameterError, match="most must be"):
        plot_cycles(pairs, radius, most=0)
    with pytest.raises(DimensionError, match="in the plane alone"):
        plot_cycles(am.AlphaComplex(np.eye(3)).persistence(), 1.0)
