"""The rule "topology" in space: right on solids and surfaces, and well-behaved elsewhere."""

from __future__ import annotations

import dataclasses
import importlib
import math
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given

import alphamesh as am
from alphamesh.errors import EmptyCloudError, ParameterError
from alphamesh.radius import rule_names
from alphamesh.sampling import add_outliers
from strategies3 import clouds3, complex_of

ROOT = Path(__file__).resolve().parent.parent


def numbers(cx, radius):
    return tuple(cx.persistence().betti_numbers(radius).tolist())


@pytest.mark.parametrize("name", am.DEMO_SOLIDS)
def test_topology_finds_the_demo_solids(name):
    cx = am.AlphaComplex(am.sample_solid(name, 4000, seed=1))
    choice = cx.choose_radius()
    assert choice.rule == "topology" == rule_names(3)[0]
    assert choice.betti == am.DEMO_SOLIDS[name].betti and choice.strays == 0
    low, high = choice.interval
    assert low <= choice.radius < high
    for radius in (low, choice.radius, math.nextafter(high, 0)):
        assert numbers(cx, radius) == choice.betti
    assert cx.at().radius == choice.radius and cx.at().betti == choice.betti
    assert "surface" not in choice.reason


@pytest.mark.parametrize("name", ["ball", "shell", "torus", "double-torus", "linked-rings"])
def test_topology_finds_surfaces_and_says_so(name):
    points = am.sample_solid(name, 4000, seed=2, surface=True)
    choice = am.AlphaComplex(points).choose_radius()
    genera = am.DEMO_SOLIDS[name].genera
    assert choice.betti == (len(genera), 2 * sum(genera), len(genera)) and choice.clear
    assert "lie on a surface" in choice.reason and '"enclosed"' in choice.reason


def test_whether_points_lie_on_a_surface_can_be_told():
    solid = am.AlphaComplex(am.sample_solid("torus", 2000, seed=3))
    found, told = solid.choose_radius(), solid.choose_radius(surface=True)
    assert solid.choose_radius(surface=False) == found
    assert "surface" in told.reason and told.reason != found.reason
    plate = np.random.default_rng(0).random((5000, 3)) * [10.0, 10.0, 0.2]
    thin = am.AlphaComplex(plate)
    assert not thin.choose_radius().clear  # many tunnels: the gaps of a thin layer
    assert thin.choose_radius(surface=True).betti == (1, 0, 0)


@given(clouds3())
def test_topology_keeps_its_word(points):
    cx = complex_of(points)
    if len(points) == 0:
        with pytest.raises(EmptyCloudError):
            cx.choose_radius()
        return
    choice = cx.choose_radius()
    low, high = choice.interval
    assert low <= choice.radius < high or cx.dimension == 0
    b0, b1, b2 = numbers(cx, choice.radius)
    assert (b0 - choice.strays, b1, b2) == choice.betti
    assert 0.0 <= choice.confidence <= 1.0
    for rival in choice.runners_up:
        assert rival.betti != choice.betti and numbers(cx, rival.low) == rival.betti
    order = np.random.default_rng(len(points)).permutation(len(points))
    other = am.AlphaComplex(cx.points[order]).choose_radius()
    assert (other.radius, other.betti, other.strays) == (
        choice.radius, choice.betti, choice.strays,
    )  # fmt: skip


def test_flat_clouds_are_judged_as_in_the_plane():
    flat = am.demo_cloud("eight", 2000, seed=3)
    plane = am.AlphaComplex(flat).choose_radius()
    tilted = flat @ np.array([[1.0, 0.0, 1.0], [0.0, 1.0, 0.0]])
    for points in (np.column_stack((flat, np.full(len(flat), 7.0))), tilted):
        choice = am.AlphaComplex(points).choose_radius()
        assert choice.betti == (*plane.betti, 0) == (1, 2, 0)
        assert choice.reason.startswith("The points lie in one plane. From radius")
        assert "1 component and 2 holes" in choice.reason
    same = am.AlphaComplex(np.column_stack((flat, np.zeros(len(flat))))).choose_radius()
    assert same.radius == pytest.approx(plane.radius, rel=1e-12)


def test_clouds_on_a_line_and_at_one_place():
    line = [[k, 2 * k, -k] for k in (*range(30), *range(90, 120))]
    choice = am.AlphaComplex(line).choose_radius()
    assert choice.betti == (2, 0, 0) and "The points lie on one line" in choice.reason
    one = am.AlphaComplex([[1, 2, 3]] * 4)
    assert one.choose_radius().betti == (1, 0, 0) and one.choose_radius().radius == 0.0
    with pytest.raises(ParameterError, match="no radius gives 1 tunnel"):
        one.choose_radius(holes=1)
    assert am.AlphaComplex(np.eye(3)[:2]).choose_radius().betti[1:] == (0, 0)


def test_a_regular_grid_is_a_solid_of_one_piece():
    grid = np.stack(np.meshgrid(*[np.arange(9.0)] * 3), axis=-1).reshape(-1, 3)
    choice = am.AlphaComplex(grid).choose_radius()
    assert choice.betti == (1, 0, 0) and "surface" not in choice.reason
    hollow = grid[np.abs(grid - 4).max(axis=1) > 2]
    assert am.AlphaComplex(hollow).choose_radius().betti == (1, 0, 1)


@pytest.mark.parametrize("scale", [2.0**-150, 3.0, 2.0**150])
def test_topology_knows_no_units_in_space(scale):
    points = am.sample_solid("shell", 1000, seed=9)
    one, other = (am.AlphaComplex(points * k).choose_radius() for k in (1.0, scale))
    assert other.radius == pytest.approx(scale * one.radius, rel=1e-9)
    assert (other.betti, other.strays, other.clear) == (one.betti, one.strays, one.clear)


def test_topology_does_not_depend_on_the_order_of_many_points_in_space():
    points = add_outliers(am.sample_solid("torus", 3000, seed=5), 20, seed=5)
    one = am.AlphaComplex(points).choose_radius()
    order = np.random.default_rng(0).permutation(len(points))
    other = am.AlphaComplex(points[order]).choose_radius()
    assert other.confidence == pytest.approx(one.confidence, abs=1e-5)
    assert dataclasses.replace(other, confidence=one.confidence) == one


def test_topology_does_as_it_is_told_in_space():
    cx = am.AlphaComplex(am.sample_solid("hollow-torus", 4000, seed=1))
    assert cx.choose_radius(betti=(1, 2, 1)).betti == (1, 2, 1)
    assert cx.choose_radius(voids=0).betti[2] == 0
    assert cx.choose_radius(holes=1).betti[1] == 1
    both = cx.choose_radius(holes=2, voids=1)
    assert both.betti[1:] == (2, 1) and both.reason.startswith("2 tunnels and 1 void, as asked")
    deaths = cx.persistence().diagram(2)[:, 1]
    assert cx.choose_radius(min_hole=1.01 * deaths.max()).betti == (1, 1, 0)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"betti": (1, 2)}, "three numbers"),
        ({"betti": (1, 0, 0), "voids": 0}, "not both"),
        ({"betti": (1, 0, None)}, "three numbers"),
        ({"voids": -1}, "voids"),
        ({"surface": "yes"}, "surface must be"),
        ({"betti": (1, 500, 0)}, "no radius gives 1 component, 500 tunnels and no voids"),
    ],
)
def test_topology_refuses_impossible_wishes_in_space(options, message):
    with pytest.raises(ParameterError, match=message):
        am.AlphaComplex(np.vstack((np.zeros(3), np.eye(3)))).choose_radius(**options)


@pytest.mark.parametrize("options", [{"voids": 0}, {"surface": True}])
def test_options_of_space_are_refused_in_the_plane(options):
    with pytest.raises(ParameterError, match="for points in space"):
        am.AlphaComplex([[0, 0], [1, 0], [0, 1]]).choose_radius(**options)


def test_clouds_of_very_different_scales():
    rng = np.random.default_rng(3)
    points = np.concatenate((rng.random((20, 3)) * 2.0**-140, rng.random((200, 3))))
    choice = am.AlphaComplex(points).choose_radius()
    assert math.isfinite(choice.radius) and choice.betti[0] == 1


def test_outliers_in_space_are_strays():
    points = am.sample_solid("ball", 4000, seed=6)
    far = np.array([[-5.0, 0.0, 0.0], [0.0, 6.0, 0.0], [4.0, 4.0, 4.0]])
    choice = am.AlphaComplex(np.concatenate((points, far))).choose_radius()
    assert choice.betti == (1, 0, 0) and choice.strays == 3
    assert "3 small pieces stand apart" in choice.reason


def test_the_reason_in_space_names_tunnels_and_voids():
    reason = am.AlphaComplex(am.sample_solid("shell", 4000, seed=1)).choose_radius().reason
    assert "the 4,000 points form 1 component, no tunnels and 1 void." in reason
    assert "The void is too large for chance: it would have room for about 1" in reason
    assert reason.endswith("a void is filled.")
    torus = am.AlphaComplex(am.sample_solid("hollow-torus", 4000, seed=1)).choose_radius()
    assert "2 tunnels and the void" in torus.reason


def test_other_rules_in_space_leave_the_shape_open():
    cx = am.AlphaComplex(am.sample_solid("ball", 300, seed=1))
    choice = cx.choose_radius("all-points")
    assert choice.betti is None and choice.interval is None


# The benchmark


@pytest.fixture(name="solids")
def solid_module():
    """Return the module that draws solids."""
    pytest.importorskip("scipy")
    with pytest.MonkeyPatch.context() as patch:
        patch.syspath_prepend(str(ROOT))
        yield importlib.import_module("benchmarks.solid_masks")


def test_betti_numbers_of_voxels(solids):
    solid = np.zeros((9, 9, 9), dtype=bool)
    solid[1:8, 1:8, 1:8] = True
    assert solids.betti_of_solid(solid) == (1, 0, 0)
    solid[3:6, 3:6, 3:6] = False
    assert solids.betti_of_solid(solid) == (1, 0, 1)
    assert solids.solid_room(solid, (1, 0, 1), 4) == (1, 0)  # walls of two voxels
    solid[:, 4, 4] = False
    assert solids.betti_of_solid(solid) == (1, 1, 0)
    solid[4, 4, 4] = True
    assert solids.betti_of_solid(solid) == (2, 1, 0)


def test_the_benchmark_measures_in_space(solids):
    space = importlib.import_module("benchmarks.accuracy_space")
    outcomes = list(space.measure_solids(["balls"], [2], [300], size=40))
    assert [o.kind for o in outcomes] == ["uniform", "noise", "outliers"]
    assert all(o.possible for o in outcomes if o.right)
    outcomes += space.measure_surfaces([0], [200])
    text = space.report_in_space(outcomes, "develop")
    assert "| uniform | 300 | 1 |" in text and "| surfaces | 200 | 8 |" in text
