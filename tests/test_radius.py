"""Rules that choose a radius, and their reasons."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given

import alphamesh as am
from alphamesh import radius as rules
from alphamesh.errors import EmptyCloudError, ParameterError
from alphamesh.radius import _registry
from alphamesh.sampling import add_outliers
from complexes import complexes

RNG = np.random.default_rng(3)


@given(complexes().filter(lambda cx: len(cx.points)))
def test_all_points_is_the_smallest_radius_that_leaves_none_out(cx):
    choice = cx.choose_radius("all-points")
    assert choice == am.choose_radius(cx.filtration, "all-points")
    assert choice.rule == "all-points"
    left_out = {2: "singular_vertices", 1: "isolated_vertices", 0: "interior_vertices"}
    name = left_out[cx.dimension]
    assert len(getattr(cx.at(choice.radius), name)) == 0
    # (Between the smallest floats that there are, a radius can round to 0.)
    if choice.radius > 0:
        assert len(getattr(cx.at(math.nextafter(choice.radius, 0)), name)) > 0
        assert choice.radius in cx.critical_radii()
    else:
        assert cx.dimension == 0 or np.abs(cx.points).max() < 1e-300


def test_all_points_against_a_plain_loop():
    cx = am.AlphaComplex(RNG.random((200, 2)))
    least = {}
    for triangle, radius in zip(cx.simplices[2].tolist(), cx.radii[2].tolist(), strict=True):
        for vertex in triangle:
            least[vertex] = min(least.get(vertex, math.inf), radius)
    assert cx.choose_radius("all-points").radius == max(least.values())


def test_the_reason_names_the_point_that_decides():
    choice = am.AlphaComplex([[0, 0], [2, 0], [0, 2], [2, 2], [9, 1]]).choose_radius(
        "all-points"
    )
    assert choice.radius == pytest.approx(50 / 14, rel=1e-15)
    assert "each of the 5 points is a corner of a triangle" in choice.reason
    assert "row 4 at (9, 1)" in choice.reason
    assert str(choice) == f"radius 3.57143 (rule 'all-points'): {choice.reason}"


def test_the_reason_counts_distinct_points():
    points = np.repeat([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]], 2, axis=0)
    assert "each of the 3 points" in am.AlphaComplex(points).choose_radius("all-points").reason


def test_points_on_a_line_are_joined_by_edges():
    choice = am.AlphaComplex([[0, 0], [1, 1], [4, 4], [5, 5], [11, 11]]).choose_radius(
        "all-points"
    )
    assert choice.radius == pytest.approx(3 * math.sqrt(2), rel=1e-15)
    assert "on one line" in choice.reason and "row 4 at (11, 11)" in choice.reason


@pytest.mark.parametrize("points", [[[3, 4]], [[3, 4]] * 9])
@pytest.mark.parametrize(
    "rule", [rule for rule in rules.rule_names() if rule != "triangle-count"]
)
def test_one_place_needs_no_radius(points, rule):
    choice = am.AlphaComplex(points).choose_radius(rule)
    assert choice.radius == 0.0 and "at one place" in choice.reason
    assert choice.betti == (1, 0)


def test_no_points_no_radius():
    cx = am.AlphaComplex(np.empty((0, 2)))
    for choose in (cx.choose_radius, cx.at, lambda: am.choose_radius(cx.filtration)):
        with pytest.raises(EmptyCloudError, match="without points"):
            choose()
    assert cx.at(1.0).counts["vertices"] == 0


@pytest.mark.parametrize(
    ("rule", "hint"),
    [
        ("all_points", "did you mean 'all-points'"),
        ("largest", "rules: 'topology', 'all-points'"),
        (3, "3"),
    ],
)
def test_an_unknown_rule_lists_the_rules(rule, hint):
    with pytest.raises(ParameterError, match="there is no radius rule") as caught:
        am.AlphaComplex([[0, 0], [1, 0], [0, 1]]).choose_radius(rule)
    assert hint in str(caught.value) and "'all-points'" in str(caught.value)


def test_points_are_not_a_filtration():
    with pytest.raises(ParameterError, match=r"alphamesh\.filtration\(points\)"):
        am.choose_radius(np.zeros((3, 2)))


def test_a_rule_can_be_added(monkeypatch):
    monkeypatch.setattr(_registry, "_RULES", dict(_registry._RULES))

    @rules.radius_rule("a-half")
    def a_half(filtration):
        return am.RadiusChoice(0.5, "a-half", f"Half, for {len(filtration.points)} points.")

    assert rules.rule_names()[:3] == ("topology", "a-half", "all-points")
    choice = am.AlphaComplex([[0, 0], [1, 0], [0, 1]]).choose_radius("a-half")
    assert choice.radius == 0.5 and choice.reason == "Half, for 3 points."
    with pytest.raises(ParameterError, match="already"):
        rules.radius_rule("a-half")(a_half)


def test_a_choice_cannot_change():
    choice = am.RadiusChoice(1.0, "rule", "reason")
    with pytest.raises(AttributeError):
        choice.radius = 2.0


@pytest.mark.parametrize("name", am.DEMO_SHAPES)
def test_topology_finds_the_shape_or_says_that_it_is_unsure(name):
    cx = am.AlphaComplex(am.demo_cloud(name, 5000, seed=1))
    choice = cx.choose_radius()
    assert choice.rule == "topology"
    assert choice.betti == am.DEMO_SHAPES[name].betti or not choice.clear
    low, high = choice.interval
    assert low <= choice.radius < high
    for radius in (low, choice.radius, math.nextafter(high, 0)):
        assert tuple(cx.persistence().betti_numbers(radius).tolist()) == choice.betti


@given(complexes().filter(lambda cx: len(cx.points)))
def test_topology_keeps_its_word(cx):
    choice = cx.choose_radius()
    low, high = choice.interval
    assert low <= choice.radius < high or cx.dimension == 0
    b0, b1 = cx.persistence().betti_numbers(choice.radius).tolist()
    assert (b0 - choice.strays, b1) == choice.betti
    assert 0.0 <= (choice.confidence or 0.0) <= 1.0
    for rival in choice.runners_up:
        assert rival.betti != choice.betti
        assert tuple(cx.persistence().betti_numbers(rival.low).tolist()) == rival.betti


def test_topology_does_as_it_is_told():
    cx = am.AlphaComplex(am.demo_cloud("eight", 3000, seed=4))
    assert cx.choose_radius(holes=1).betti[1] == 1
    assert cx.choose_radius(components=1, holes=2) == cx.choose_radius(betti=(1, 2))
    largest = cx.persistence().diagram(1)[:, 1].max()
    assert cx.choose_radius(min_hole=0.99 * largest).betti == (1, 1)
    with pytest.raises(ParameterError, match="no radius gives 1 component and 5,000 holes"):
        cx.choose_radius(betti=(1, 5000))
    with pytest.raises(ParameterError, match="not both"):
        cx.choose_radius(betti=(1, 2), holes=2)
    with pytest.raises(ParameterError, match="has no option 'hole'; its options: betti"):
        cx.choose_radius(hole=2)


def test_topology_follows_what_is_asked_for():
    cx = am.AlphaComplex(am.demo_cloud("percent", 3000, seed=4))  # two rings and a bar
    assert cx.choose_radius().betti == (3, 2)
    for wanted in ({"components": 1}, {"holes": 1}, {"betti": (2, 2)}, {"components": 5}):
        choice = cx.choose_radius(**wanted)
        b0, b1 = choice.betti
        for name, value in wanted.items():
            assert {"components": b0, "holes": b1, "betti": (b0, b1)}[name] == value
        assert "asked" in choice.reason
        low, high = choice.interval
        assert low <= choice.radius < high
        for rival in choice.runners_up:  # rivals obey too
            assert wanted.get("components", rival.betti[0]) == rival.betti[0]
            assert wanted.get("holes", rival.betti[1]) == rival.betti[1]


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"betti": 3}, "two numbers"),
        ({"betti": (1, 2, 3)}, "two numbers"),
        ({"components": 0}, "components"),
        ({"holes": -1}, "holes"),
        ({"holes": 1.5}, "holes"),
        ({"min_hole": -1.0}, "min_hole"),
        ({"min_hole": math.nan}, "min_hole"),
        ({"min_hole": "big"}, "min_hole"),
    ],
)
def test_topology_refuses_impossible_wishes(options, message):
    with pytest.raises(ParameterError, match=message):
        am.AlphaComplex([[0, 0], [1, 0], [0, 1]]).choose_radius(**options)


def test_small_holes_need_not_count():
    cx = am.AlphaComplex(am.demo_cloud("cheese", 6000, seed=3))
    every = cx.choose_radius()
    diagram = cx.persistence().diagram(1)
    alive = (diagram[:, 0] <= every.radius) & (every.radius < diagram[:, 1])
    deaths = np.sort(diagram[alive, 1])
    assert len(deaths) == every.betti[1] == 5
    fewer = cx.choose_radius(min_hole=(deaths[1] + deaths[2]) / 2)
    assert fewer.betti == (1, 3) and fewer.radius >= deaths[1]


def test_outliers_are_strays_and_not_components():
    points = am.demo_cloud("annulus", 4000, seed=6)
    far = np.array([[-300.0, -300.0], [900.0, 30.0], [905.0, 30.0], [256.0, 256.0]])
    choice = am.AlphaComplex(np.concatenate((points, far))).choose_radius()
    assert choice.betti == (1, 1) and choice.clear
    assert choice.strays == 3 + (choice.radius < 2.5)
    assert "3 small pieces stand apart" in choice.reason
    clean = am.AlphaComplex(points).choose_radius()
    assert clean.strays == 0 and clean.radius == pytest.approx(choice.radius, rel=0.15)


def test_many_outliers_do_not_hide_the_holes():
    points = add_outliers(am.demo_cloud("cheese", 20000, seed=0), 400, seed=1)
    choice = am.AlphaComplex(points).choose_radius()
    assert choice.betti[0] == 1 and 5 <= choice.betti[1] <= 7
    assert 100 < choice.strays < 400


def test_a_small_but_dense_piece_is_a_component():
    points = np.concatenate(
        (am.demo_cloud("disc", 5000, seed=1), 600 + 9 * RNG.random((30, 2)))
    )
    choice = am.AlphaComplex(points).choose_radius()
    assert choice.betti == (2, 0) and choice.strays == 0


def test_density_may_vary():
    x = np.linspace(0, 1, 12001)[1:] ** 2  # from dense to sparse, by a factor of 50
    y = np.random.default_rng(1).random(12000)
    x = np.random.default_rng(2).choice(x, 12000) + 0.02 * np.random.default_rng(3).random(
        12000
    )
    points = np.column_stack((x, y))
    hole = np.hypot(points[:, 0] - 0.7, points[:, 1] - 0.5) < 0.12
    choice = am.AlphaComplex(points[~hole]).choose_radius()
    assert choice.betti == (1, 1)


SCALES = (2.0**-300, 3.0, 2.0**200)


@pytest.mark.parametrize("name", ["eight", "islands", "disc"])
@pytest.mark.parametrize("scale", SCALES)
def test_topology_knows_no_units(name, scale):
    points = am.demo_cloud(name, 800, seed=9)
    one = am.AlphaComplex(points).choose_radius()
    other = am.AlphaComplex(points * scale).choose_radius()
    assert other.radius == pytest.approx(scale * one.radius, rel=1e-9)
    assert (other.betti, other.strays, other.clear) == (one.betti, one.strays, one.clear)
    assert other.confidence == pytest.approx(one.confidence, abs=1e-6)


@given(complexes().filter(lambda cx: len(cx.points)))
def test_topology_does_not_depend_on_the_order_of_points(cx):
    order = np.random.default_rng(len(cx.points)).permutation(len(cx.points))
    one, other = cx.choose_radius(), am.AlphaComplex(cx.points[order]).choose_radius()
    assert (other.radius, other.betti, other.strays) == (one.radius, one.betti, one.strays)


def test_topology_does_not_depend_on_the_order_of_many_points():
    points = add_outliers(am.demo_cloud("cheese", 3000, seed=5), 40, seed=5)
    one = am.AlphaComplex(points).choose_radius()
    for seed in range(3):
        order = np.random.default_rng(seed).permutation(len(points))
        assert am.AlphaComplex(points[order]).choose_radius() == one


@pytest.mark.parametrize(
    ("points", "betti"),
    [
        ([[0, 0], [1, 0]], None),
        ([[k, 0] for k in range(30)], (1, 0)),
        ([[k, 0] for k in (*range(30), *range(90, 120))], (2, 0)),
        ([[i, j] for i in range(12) for j in range(12)], (1, 0)),
        ([[i, j] for i in range(30) for j in range(30) if max(i, j) > 9], (1, 0)),
        (
            [[i, j] for i in range(30) for j in range(30) if max(abs(i - 15), abs(j - 15)) > 6],
            (1, 1),
        ),
        ([[math.cos(t / 9), math.sin(t / 9)] for t in range(57)], (1, 1)),
    ],
)  # fmt: skip
def test_topology_of_regular_clouds(points, betti):
    choice = am.AlphaComplex(points).choose_radius()
    assert math.isfinite(choice.radius) and choice.strays == 0
    if betti is None:
        assert not choice.clear and choice.runners_up[0].betti == (2, 0)
    else:
        assert choice.betti == betti


def test_the_reason_names_the_shape_its_range_and_what_ends_it():
    choice = am.AlphaComplex(am.demo_cloud("annulus", 2000, seed=2)).choose_radius()
    low, high = choice.interval
    assert choice.reason.startswith(
        f"From radius {low:.4g} to {high:.4g} the 2,000 points form 1 component and 1 hole. "
    )
    assert "The hole is too large for chance: it would have room for about 7" in choice.reason
    assert choice.reason.endswith(f"At radius {high:.4g} a hole is filled.")
    islands = am.AlphaComplex(am.demo_cloud("percent", 2000, seed=2)).choose_radius().reason
    assert "form 3 components and 2 holes" in islands and "apart are joined" in islands
    solid = am.AlphaComplex(am.demo_cloud("disc", 500, seed=2)).choose_radius().reason
    assert " on the 500 points form 1 component and no holes. " in solid
    assert "At radius" not in solid and "room" not in solid
    line = am.AlphaComplex([[k, k] for k in (*range(30), *range(90, 120))]).choose_radius()
    assert line.reason.startswith("The points lie on one line. From radius 0.7071 to 43.13")


def test_few_points_give_no_clear_answer():
    choice = am.AlphaComplex(np.random.default_rng(4).random((6, 2))).choose_radius()
    assert not choice.clear and "no clear answer" in choice.reason


def test_topology_says_when_the_cloud_gives_no_clear_answer():
    choice = am.AlphaComplex(am.demo_cloud("letter-b", 5000, seed=1)).choose_radius()
    assert choice.confidence < 0.75 and not choice.clear and "no clear answer" in choice.reason


def test_regions_and_counts():
    cx = am.AlphaComplex(am.demo_cloud("islands", 2000, seed=4))
    one, five = cx.choose_radius("one-region"), cx.choose_radius("regions", regions=5)
    assert five.radius < one.radius and one.betti[0] == 1
    assert cx.at(five.radius).isolated_vertices.size == 0
    many = cx.choose_radius("triangle-count", triangles=3000)
    assert len(cx.at(many.radius).triangles) >= 3000
    assert len(cx.at(math.nextafter(many.radius, 0)).triangles) < 3000
    widest = cx.choose_radius("longest-interval")
    radii, _ = cx.persistence().betti_curve()
    assert widest.interval[1] - widest.interval[0] == pytest.approx(np.diff(radii).max())
