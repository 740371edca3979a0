"""Power diagrams, and power cells cut by discs of different radii, in the plane."""

from __future__ import annotations

import numpy as np
import pytest

import alphamesh as am
from alphamesh.errors import ParameterError, UnweightedOnlyError
from alphamesh.film import film_radii

CLOUDS = {
    "few hidden": (80, 0.003),
    "some hidden": (80, 0.02),
    "many hidden": (80, 0.1),
}


def cloud(n, scale, seed=6):
    rng = np.random.default_rng(seed)
    return am.AlphaComplex(rng.random((n, 2)), weights=rng.normal(size=n) * scale)


def lattice(seed=0):
    """Return balls around lattice points: many orthogonal to one circle, some hidden."""
    rng = np.random.default_rng(seed)
    points = rng.integers(0, 5, (60, 2)).astype(float)
    return am.AlphaComplex(points, weights=rng.integers(0, 2, 60).astype(float))


@pytest.fixture(name="cx", params=[*CLOUDS, "lattice"])
def make_complex(request):
    return lattice() if request.param == "lattice" else cloud(*CLOUDS[request.param])


def rows(array):
    array = np.sort(array, axis=1)
    return array[np.lexsort(array.T[::-1])]


def power(cx, places):
    """Return the power distance of each place to each point."""
    away = ((places[:, np.newaxis] - cx.points) ** 2).sum(axis=2)
    return away - cx.weights


RADII = (-0.2, -0.03, 0.0, 0.05, 0.3, 2.0)


# ---------------------------------------------------------------- power diagrams


def test_vertices_are_as_far_from_three_points_and_farther_from_all_others(cx):
    diagram = cx.voronoi
    distance = power(cx, diagram.vertices)
    own = np.take_along_axis(distance, diagram.triangles, axis=1)
    size = 1 + np.abs(distance).max(axis=1, keepdims=True)
    assert (np.abs(own - own[:, :1]) < 1e-11 * size).all()
    assert (distance >= own.min(axis=1, keepdims=True) - 1e-11 * size).all()


def test_vertices_of_one_place_are_one_group():
    diagram = lattice().voronoi
    groups = diagram.vertex_group
    assert len(np.unique(groups)) < len(groups)
    for vertex, group in enumerate(groups):
        assert np.array_equal(diagram.vertices[vertex], diagram.vertices[group])
    places = {tuple(place) for place in np.round(diagram.vertices, 9).tolist()}
    assert len(places) == len(np.unique(groups))
    assert diagram.is_zero_length.any()


def test_ridges_lie_on_radical_axes(cx):
    diagram = cx.voronoi
    distance = power(cx, diagram.ridge_midpoints)
    ends = np.take_along_axis(distance, diagram.ridge_points, axis=1)
    np.testing.assert_allclose(ends[:, 0], ends[:, 1], atol=1e-9 * (1 + np.abs(ends).max()))
    first, second = cx.points[diagram.ridge_points].transpose(1, 0, 2)
    assert np.abs(((second - first) * diagram.ridge_directions).sum(axis=1)).max() < 1e-12


def test_hidden_points_have_no_cell(cx):
    diagram = cx.voronoi
    assert len(cx.hidden) > 0
    assert not diagram.bounded[cx.hidden].any()
    assert (diagram.areas[cx.hidden] == 0).all()
    assert (np.diff(diagram.offset)[cx.hidden] == 0).all()
    assert diagram.areas.min() >= 0
    assert diagram.bounded.any()


def test_areas_of_bounded_cells_are_those_within_large_discs(cx):
    diagram = cx.voronoi
    within = cx.restricted_voronoi(1e4).area[diagram.bounded]
    reach = np.abs(diagram.vertices).max()
    assert reach < 5e3
    np.testing.assert_allclose(diagram.areas[diagram.bounded], within, rtol=1e-9)


def test_cells_cut_by_a_box_hold_what_is_nearest(cx):
    shapely = pytest.importorskip("shapely")
    low, high = cx.points.min(axis=0) - 0.3, cx.points.max(axis=0) + 0.2
    cut = cx.voronoi.clip((*low, *high))
    cells = cut.to_shapely()
    assert shapely.area(cells).sum() == pytest.approx(np.prod(high - low))
    places = low + (high - low) * np.random.default_rng(1).random((300, 2))
    distance = power(cx, places)
    nearest = distance.argmin(axis=1)
    clear = np.partition(distance, 1, axis=1)[:, 1] - distance.min(axis=1) > 1e-9
    inside = shapely.contains_xy(cells[nearest], *places.T)
    assert inside[clear].all() and clear.sum() > 100  # where no duplicate is as near


# ---------------------------------------------------------------- cells within discs


@pytest.mark.parametrize("radius", RADII)
def test_the_complex_is_the_nerve_of_the_cells(cx, radius):
    cells, shape = cx.restricted_voronoi(radius), cx.at(radius)
    assert np.array_equal(cells.edges, rows(shape.edges))
    assert np.array_equal(cells.triangles, rows(shape.triangles))
    has = np.flatnonzero(np.diff(cells.offset))
    assert np.array_equal(has, cx.simplices[0][cx.radii[0] <= radius][:, 0])
    assert np.array_equal(np.flatnonzero(cells.is_free), shape.isolated_vertices)


@pytest.mark.parametrize("radius", RADII)
def test_the_cells_fill_the_union_of_the_discs(cx, radius):
    shapely = pytest.importorskip("shapely")
    cells = cx.restricted_voronoi(radius)
    expected = np.sqrt(np.maximum(cx.weights + np.copysign(radius**2, radius), 0))
    np.testing.assert_array_equal(cells.disc_radii, expected)
    discs = shapely.buffer(shapely.points(cx.points), cells.disc_radii, quad_segs=256)
    union = shapely.union_all(discs[cells.disc_radii > 0])
    assert cells.total_area == pytest.approx(union.area, rel=1e-4)
    assert cells.outer_length == pytest.approx(union.length, rel=1e-4)
    polygons = cells.to_shapely(1e-6)
    np.testing.assert_allclose(shapely.area(polygons), cells.area, atol=2e-5 * cells.total_area)


@pytest.mark.parametrize("radius", RADII)
def test_borders_are_closed_and_shared(cx, radius):
    cells = cx.restricted_voronoi(radius)
    arcs = cells.is_arc
    centre = cx.points[cells.cell[arcs]]
    for ends in (cells.start[arcs], cells.end[arcs]):
        away = np.hypot(*(ends - centre).T)
        np.testing.assert_allclose(away, cells.disc_radii[cells.cell[arcs]], atol=1e-7)
    segments = {
        (a, b): (*start, *end)
        for a, b, start, end in zip(
            cells.cell[~arcs].tolist(),
            cells.neighbor[~arcs].tolist(),
            cells.start[~arcs].tolist(),
            cells.end[~arcs].tolist(),
            strict=True,
        )
    }
    for (a, b), (x, y, u, v) in segments.items():
        assert segments[b, a] == (u, v, x, y)


def test_equal_weights_are_discs_of_another_radius():
    points = np.random.default_rng(3).random((50, 2))
    plain = am.AlphaComplex(points).restricted_voronoi(np.sqrt(0.01))
    cells = am.AlphaComplex(points, weights=np.full(50, 0.0075)).restricted_voronoi(0.05)
    assert np.array_equal(cells.neighbor, plain.neighbor)
    np.testing.assert_allclose(cells.area, plain.area, rtol=1e-9)
    np.testing.assert_allclose(cells.arc_length, plain.arc_length, rtol=1e-9)


def test_two_balls_in_closed_form():
    # Radii 5 and 4, centres 6 apart: they cross 3.75 from the first and 2.25 from the other.
    cells = am.AlphaComplex([[0, 0], [6, 0]], weights=[25, 16]).restricted_voronoi(0)
    chord = np.sqrt(25 - 3.75**2)
    for row, (r, near) in enumerate([(5, 3.75), (4, 2.25)]):
        angle = np.arccos(near / r)
        assert cells.area[row] == pytest.approx(r * r * (np.pi - angle) + near * chord)
        assert cells.arc_length[row] == pytest.approx(2 * r * (np.pi - angle))
        assert cells.segment_length[row] == pytest.approx(2 * chord)
    assert cells.to_shapely(1e-4)[0].area == pytest.approx(cells.area[0], rel=1e-3)


def test_a_point_may_lie_outside_of_its_own_cell():
    cx = am.AlphaComplex([[0, 0], [1, 0]], weights=[4, 0.5])
    # The radical axis is 2.25 from the first point, 1.25 behind the second, and the first
    # disc reaches it at the power parameter 2.25**2 - 4.
    assert cx.radii[0].tolist() == [-2.0, np.sqrt(2.25**2 - 4)]
    cells = cx.restricted_voronoi(1.2)
    chord = np.sqrt(4 + 1.44 - 2.25**2)
    assert cells.start[cells.neighbor == 1].tolist()[0] == pytest.approx([2.25, -chord])
    angle = np.arccos(1.25 / np.sqrt(0.5 + 1.44))
    assert cells.area[1] == pytest.approx((0.5 + 1.44) * angle - 1.25 * chord)
    assert cells.arc_length[1] == pytest.approx(2 * np.sqrt(0.5 + 1.44) * angle)
    assert len(cx.restricted_voronoi(1.0).edges) == 0
    assert np.diff(cx.restricted_voronoi(1.0).offset).tolist() == [1, 0]


def test_paths_are_those_of_the_discs():
    cells = cloud(40, 0.01).restricted_voronoi(0.05)
    vertices, codes, offset = cells.bezier_paths()
    assert len(vertices) == len(codes) == offset[-1]
    away = np.hypot(*(vertices[codes == 4] - cells.points.mean(axis=0)).T)
    assert np.isfinite(away).all()
    drawn = [path for path in cells.svg_paths() if path]
    assert len(drawn) == np.count_nonzero(np.diff(cells.offset))
    free = int(np.flatnonzero(cells.is_free)[0])
    assert f"A{cells.disc_radii[free]:.9g} " in cells.svg_paths()[free]


def test_scale_by_powers_of_two():
    cx = cloud(40, 0.01)
    for exponent in (-300, 200):
        scaled = am.AlphaComplex(
            np.ldexp(cx.points, exponent), weights=np.ldexp(cx.weights, 2 * exponent)
        )
        one, other = (
            cx.restricted_voronoi(0.1),
            scaled.restricted_voronoi(np.ldexp(0.1, exponent)),
        )
        assert np.array_equal(one.neighbor, other.neighbor)
        np.testing.assert_allclose(np.ldexp(one.start, exponent), other.start, rtol=1e-12)
        np.testing.assert_allclose(
            np.ldexp(one.arc_length, exponent), other.arc_length, rtol=1e-9, atol=0
        )


def test_beside_a_huge_radius_weights_are_nothing():
    cx = cloud(10, 0.01)
    cells = cx.restricted_voronoi(1e200)
    assert (cells.disc_radii == 1e200).all()
    assert cells.outer_length == pytest.approx(2e200 * np.pi)
    assert len(cx.restricted_voronoi(-1e200).start) == 0


def test_radii_that_cannot_be():
    cx = cloud(10, 0.01)
    for radius in (np.nan, np.inf, -np.inf, "1"):
        with pytest.raises(ParameterError, match="finite number"):
            cx.restricted_voronoi(radius)
    with pytest.raises(ParameterError, match="at least 0"):
        am.AlphaComplex(cx.points).restricted_voronoi(-1)


# ---------------------------------------------------------------- pictures


def test_pictures_are_drawn_of_power_cells(tmp_path):
    plot = pytest.importorskip("alphamesh.plot")
    pytest.importorskip("PIL")
    cx = cloud(50, 0.01)
    figure = plot.plot_story(cx)
    titles = [text.get_text() for ax in figure.axes for text in ax.texts]
    titles += [ax.get_title(loc="left") for ax in figure.axes]
    assert any("Power cells" in title for title in titles)
    assert any("Regular triangulation" in title for title in titles)
    assert len(plot.plot_radii(cx).axes) == 6
    film = cx.animate(tmp_path / "a.gif", frames=3, width=300)
    assert film.radii[0] == cx.critical_radii()[0]
    assert np.array_equal(film.radii, film_radii(cx.persistence(), None, 3))
    solid = am.AlphaComplex(
        np.random.default_rng(0).random((30, 3)), weights=np.arange(30) / 999
    )
    assert solid.animate(tmp_path / "b.gif", frames=2, width=300).radii[0] < 0
    with pytest.raises(UnweightedOnlyError, match="frame"):
        plot.plot_outlines(cx)
