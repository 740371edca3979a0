"""What the page counts and draws is what the complex holds, told by its own code."""

from __future__ import annotations

import numpy as np
import pytest

import alphamesh as am
from alphamesh.errors import ParameterError
from view_facts import _HEAVY, CASES, SPACE, WEIGHTED, numbers_of, radii_of, told


@pytest.mark.parametrize("name", CASES)
def test_the_page_counts_what_the_complex_holds(name, tmp_path):
    cx = am.AlphaComplex(CASES[name])
    radii = radii_of(cx)
    shown = told(cx, radii, tmp_path)
    assert len(shown["facts"]) == len(radii)
    for radius, facts in zip(radii, shown["facts"], strict=True):
        shape = cx.at(radius)
        assert numbers_of(facts) == shape.counts
        betti = cx.persistence().betti_numbers(radius).tolist()
        assert facts["betti"] == betti
        assert facts["curves"] == betti
        assert facts["size"] == pytest.approx(shape.area, rel=1e-4, abs=1e-300)
        assert facts["border"] == pytest.approx(shape.perimeter, rel=1e-4)


@pytest.mark.parametrize("name", SPACE)
def test_the_page_counts_what_the_complex_holds_in_space(name, tmp_path):
    cx = am.AlphaComplex(SPACE[name])
    radii = radii_of(cx)
    for radius, facts in zip(radii, told(cx, radii, tmp_path)["facts"], strict=True):
        shape = cx.at(radius)
        counts = shape.counts
        kinds = ("vertices", "edges", "triangles", "tetrahedra")
        assert facts["present"] == [counts[kind] for kind in kinds]
        assert facts["singularTriangles"] == counts["singular_triangles"]
        assert facts["boundary"] == counts["regular_triangles"]
        assert facts["interior"] == counts["interior_triangles"]
        assert facts["singularEdges"] == counts["isolated_edges"]
        assert facts["isolated"] == counts["isolated_vertices"]
        assert facts["betti"] == facts["curves"] == list(shape.betti)
        assert facts["size"] == pytest.approx(shape.volume, rel=1e-3, abs=1e-12)
        assert facts["border"] == pytest.approx(shape.surface_area, rel=1e-3)


@pytest.mark.parametrize("name", WEIGHTED)
def test_the_page_counts_what_a_complex_with_weights_holds(name, tmp_path):
    points, weights = WEIGHTED[name]
    cx = am.AlphaComplex(points, weights=weights)
    changes = cx.critical_radii()
    radii = np.unique(np.concatenate((changes, changes - 1e-9, changes[-1:] + 1)))[::7]
    shown = told(cx, radii, tmp_path)
    assert sorted(shown["hidden"]) == cx.hidden.tolist()
    assert sorted(shown["rows"]) == cx.simplices[0][:, 0].tolist()
    # The first vertex does not count as a change.
    assert shown["changes"] == cx.persistence().betti_curve().radii[1:].tolist()
    for radius, facts in zip(radii, shown["facts"], strict=True):
        shape = cx.at(radius)
        betti = cx.persistence().betti_numbers(radius).tolist()
        assert facts["betti"] == facts["curves"] == betti
        assert facts["present"] == [int((values <= radius).sum()) for values in cx.radii]
        assert facts["isolated"] == len(shape.isolated_vertices)
        size = shape.volume if len(cx.simplices) == 4 else shape.area
        assert facts["size"] == pytest.approx(size, rel=1e-3, abs=1e-9)


def test_the_pieces_of_power_cells_are_the_cells(tmp_path):
    points, weights = WEIGHTED["random"]
    cx = am.AlphaComplex(points, weights=weights)
    shown = told(cx, [], tmp_path)
    # At a radius that leaves no gap, cells are cut at their ridges alone.
    whole = cx.restricted_voronoi(float(max(cx.radii[2]))).area[shown["rows"]]
    areas = np.array(shown["cells"]) * shown["meta"]["scale"] ** 2
    inner = ~np.isin(shown["rows"], cx.convex_hull.ring)
    assert inner.sum() > 45
    assert (whole[inner] > 0).all()
    assert areas[inner] == pytest.approx(whole[inner], rel=2e-3, abs=1e-7)


def test_radii_of_weighted_complexes_may_be_negative():
    cx = am.AlphaComplex(*WEIGHTED["random"][:1], weights=_HEAVY)
    pytest.importorskip("anywidget")
    widget = cx.widget(-0.01)
    assert widget.radius == -0.01
    widget.radius = -0.02
    assert widget.radius == -0.02
    with pytest.raises(ParameterError, match="got nan"):
        widget.radius = np.nan
    lowest = min(values.min() for values in cx.radii)
    assert cx.widget(-np.inf).radius == lowest < 0


def test_the_surface_is_seen_from_outside(tmp_path):
    cx = am.AlphaComplex(SPACE["random"])
    shown = told(cx, [], tmp_path)
    corners = np.array(shown["triangles"], dtype=int).reshape(-1, 3)
    last = cx.at(np.inf).boundary_triangles
    as_shown = {tuple(np.roll(row, -int(np.argmin(row)))) for row in corners.tolist()}
    assert all(tuple(row) in as_shown for row in last.tolist())


@pytest.mark.parametrize("name", ["random", "shape", "duplicates", "line"])
def test_the_page_has_the_simplices_in_their_order(name, tmp_path):
    cx = am.AlphaComplex(CASES[name])
    shown = told(cx, [], tmp_path)
    order = np.argsort(cx.radii[2], kind="stable")
    rows = np.array(shown["rows"], dtype=int)
    corners = rows[np.array(shown["triangles"], dtype=int)].reshape(-1, 3)
    assert np.array_equal(corners, cx.simplices[2][order])
    meta = shown["meta"]
    places = np.array(shown["positions"]).reshape(-1, 2) * meta["scale"] + meta["centre"]
    assert np.abs(places - cx.points[rows]).max() < 1e-6 * meta["scale"]
    assert np.array_equal(shown["changes"], cx.persistence().betti_curve().radii[1:])


def test_the_pieces_of_bounded_cells_are_the_cells(tmp_path):
    cx = am.AlphaComplex(CASES["random"])
    shown = told(cx, [], tmp_path)
    bounded = cx.voronoi.bounded
    assert bounded.sum() > 200
    areas = np.array(shown["cells"]) * shown["meta"]["scale"] ** 2
    small = bounded & (cx.voronoi.areas < 0.1)
    assert areas[small] == pytest.approx(cx.voronoi.areas[small], rel=1e-3)


@pytest.mark.parametrize("name", ["line", "two", "one"])
def test_unbounded_cells_cover_the_plane_as_far_as_a_disc_reaches(name, tmp_path):
    shown = told(am.AlphaComplex(CASES[name]), [], tmp_path)
    assert sum(shown["cells"]) > np.pi * 64**2 * 0.9
