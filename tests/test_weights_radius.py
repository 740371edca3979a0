"""Rules that choose a radius for weighted clouds, and charts of radii of both signs."""

from __future__ import annotations

import numpy as np
import pytest

import alphamesh as am
from alphamesh.errors import ParameterError, UnweightedOnlyError
from alphamesh.film import film_radii
from alphamesh.radius import rule_names


def cloud(n=150, d=2, scale=0.004, shift=0.0):
    rng = np.random.default_rng(4)
    return am.AlphaComplex(rng.random((n, d)), weights=rng.normal(size=n) * scale + shift)


CX, SOLID = cloud(), cloud(d=3)


def test_by_default_balls_are_as_large_as_their_weights_say():
    choice = CX.choose_radius()
    assert (choice.radius, choice.rule) == (0.0, "weights")
    low, high = choice.interval
    assert low <= 0 < high
    assert choice.betti == CX.at(0).betti == CX.at().betti
    empty = np.count_nonzero(CX.weights < 0)
    assert f"{empty} points of negative weight" in choice.reason
    assert SOLID.choose_radius().rule == "weights"


def test_where_no_weight_is_positive_the_widest_range_is_chosen():
    assert cloud(shift=-1).choose_radius().rule == "longest-interval"
    assert cloud(d=3, shift=-1).choose_radius().rule == "all-points"
    far = cloud(shift=-100).choose_radius("weights")
    assert far.interval[0] == -np.inf and far.betti == (0, 0)


def test_weights_of_zero_change_no_choice():
    points = am.demo_cloud("eight", 300, seed=1)
    plain = am.AlphaComplex(points).choose_radius()
    assert am.AlphaComplex(points, weights=np.zeros(300)).choose_radius() == plain


def test_the_longest_interval_may_begin_below_zero():
    # Two balls of radius 5 that touch at -4: 25 - 16 = 3**2.
    cx = am.AlphaComplex([[0, 0], [6, 0]], weights=[25, 25])
    choice = cx.choose_radius("longest-interval")
    assert choice.interval == (-5.0, -4.0)
    assert choice.betti == (2, 0)


@pytest.mark.parametrize("cx", [CX, SOLID, cloud(shift=2), cloud(d=3, shift=2)], ids=repr)
def test_all_points_are_covered_from_the_chosen_radius_on(cx):
    shown = cx.choose_radius("all-points")
    before = cx.at(np.nextafter(shown.radius, -np.inf))
    assert len(cx.at(shown.radius).singular_vertices) == 0
    assert np.count_nonzero(cx.filtration.radii[0] > shown.radius) == 0
    assert len(before.singular_vertices) > 0
    if len(cx.hidden):
        assert "that are not hidden" in shown.reason
    assert cx.choose_radius("one-region").radius >= shown.radius
    pieces = cx.choose_radius("regions", regions=2)
    assert len(cx.at(pieces.radius).regions) <= 2


def test_the_number_of_cells_is_met():
    choice = CX.choose_radius("triangle-count", triangles=40)
    assert CX.at(choice.radius).counts["triangles"] == 40
    choice = SOLID.choose_radius("tetrahedron-count", tetrahedra=40)
    assert SOLID.at(choice.radius).counts["tetrahedra"] == 40
    assert SOLID.choose_radius("enclosed").radius <= SOLID.choose_radius("all-points").radius


def test_a_single_place_has_one_piece_from_its_own_value_on():
    cx = am.AlphaComplex([[1, 1], [1, 1]], weights=[4, 1])
    for rule in ("all-points", "regions", "longest-interval"):
        assert cx.choose_radius(rule).radius == -2.0
    assert "from here on" in cx.choose_radius("regions").reason


def test_pieces_of_points_on_a_line():
    cx = am.AlphaComplex([[0, 0], [3, 0], [9, 0]], weights=[4, 1, 0])
    # The first two touch at 0, the last joins where 1 + a = (9 - 3 - x)**2 and a = x**2.
    x = 35 / 12
    assert cx.choose_radius("regions", regions=2).radius == pytest.approx(x)
    assert cx.choose_radius("all-points").radius == pytest.approx(x)


def test_rules_without_a_meaning_name_those_that_have_one():
    with pytest.raises(UnweightedOnlyError, match="'weights', 'all-points'"):
        CX.choose_radius("topology")
    with pytest.raises(ParameterError, match="for points with weights"):
        am.AlphaComplex([[0, 0], [1, 0]]).choose_radius("weights")
    assert "topology" not in rule_names(weighted=True)
    assert "weights" not in rule_names()


# ---------------------------------------------------------------- films and charts


def test_radii_of_a_film_begin_with_the_first_point():
    pairs = CX.persistence()
    for rule in ("even", "quantiles"):
        radii = film_radii(pairs, rule, 30)
        assert len(radii) == 30
        assert radii[0] == CX.critical_radii()[0] < 0
        assert (np.diff(radii) > 0).all()
        assert np.isin(radii, CX.critical_radii()).all()
    assert film_radii(pairs, [-0.01, 0.5]).tolist() == [-0.01, 0.5]
    with pytest.raises(UnweightedOnlyError, match="quantiles"):
        film_radii(pairs, "log", 30)


@pytest.mark.parametrize("points", [[[0, 0]], [[0, 0], [1, 0]], [[0, 0], [1, 0], [5, 5]]])
def test_radii_of_a_film_of_few_points(points):
    cx = am.AlphaComplex(points, weights=np.arange(len(points)) - 1.0)
    radii = film_radii(cx.persistence(), None, 12)
    assert len(radii) == 12
    assert radii[0] == cx.critical_radii()[0]
    assert (np.diff(radii) > 0).all()


@pytest.mark.parametrize("cx", [CX, SOLID, cloud(shift=-1)], ids=repr)
def test_charts_show_all_radii(cx):
    plot = pytest.importorskip("alphamesh.plot")
    pairs = cx.persistence()
    radii = cx.critical_radii()
    low = radii[0]
    ends = plot.plot_diagram(pairs, radius=0.01).axes.get_xlim()
    assert ends[0] <= min(low, 0)
    barcode = plot.plot_barcode(pairs, radius=-0.01).axes
    assert barcode.get_xlim()[0] <= min(low, -0.01)
    betti = plot.plot_betti(pairs, radius=0.01)
    assert betti.axes.get_xscale() == "linear"
    assert betti.axes.get_xlim()[0] < low
    x, y = betti.artists["components"][0].get_data()
    assert y[0] == 0 and x[1] == low
    assert cx.at(0.05).plot().axes is not None


def test_cards_tell_of_hidden_points():
    assert "hidden points" in CX._repr_html_()
    assert str(len(CX.hidden)) in CX._repr_html_()
