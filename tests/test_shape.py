"""AlphaShape: the complex at one radius, against the definitions."""

from __future__ import annotations

import copy
import math
import pickle
from dataclasses import FrozenInstanceError
from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given

import alphamesh as am
import oracles
from alphamesh.classify import SimplexKind
from alphamesh.errors import FileWriteError, LossyFormatWarning, ParameterError
from complexes import complexes, shapes

# A hexagon around a point, an edge apart, a point apart, and a duplicate.
FIGURE = np.array(
    [[0, 0], [2, 0], [2, 2], [0, 2], [4, 2], [4, 4], [2, 4], [9, 9], [9, 11], [30, 0], [2, 2]]
)
RNG = np.random.default_rng(7)


def ring(n=60, inner=3.0, outer=5.0):
    """Return points of an annulus, dense enough for a triangulated ring."""
    angles = np.linspace(0, 2 * np.pi, n, endpoint=False)
    radii = np.repeat(np.linspace(inner, outer, 5), n)
    angles = np.tile(angles, 5) + np.repeat(np.arange(5) * np.pi / n, n)
    return np.column_stack([radii * np.cos(angles), radii * np.sin(angles)])


def rows(array):
    return [tuple(row) for row in array.tolist()]


def values_of(filtration):
    """Return the filtration value of every simplex."""
    simplices = [simplex for k in range(3) for simplex in rows(filtration.simplices[k])]
    return dict(zip(simplices, np.concatenate(filtration.radii).tolist(), strict=True))


def kinds_by_definition(shape):
    """Return the kind of every simplex, by the words of the definition."""
    filtration, r = shape.filtration, shape.radius
    values = values_of(filtration)
    hull_edges = {tuple(sorted(edge)) for edge in oracles.hull_edges(filtration.points)}
    hull_vertices = {v for edge in hull_edges for v in edge}
    kinds = {}
    for simplex, value in values.items():
        cofaces = [t for t in values if len(t) == 3 and set(simplex) <= set(t)]
        present = [t for t in cofaces if values[t] <= r]
        on_hull = (simplex in hull_edges) or (simplex[0] in hull_vertices and len(simplex) == 1)
        if value > r:
            kinds[simplex] = SimplexKind.EXTERIOR
        elif len(simplex) == 3:
            kinds[simplex] = SimplexKind.INTERIOR
        elif not present:
            kinds[simplex] = SimplexKind.SINGULAR
        elif len(present) == len(cofaces) and not on_hull:
            kinds[simplex] = SimplexKind.INTERIOR
        else:
            kinds[simplex] = SimplexKind.REGULAR
    return kinds


@given(shapes())
def test_kinds_follow_the_definition(shape):
    expected = kinds_by_definition(shape)
    for k in range(3):
        found = dict(
            zip(rows(shape.filtration.simplices[k]), shape.kinds[k].tolist(), strict=True)
        )
        assert found == {
            simplex: kind for simplex, kind in expected.items() if len(simplex) == k + 1
        }
    lists = {
        SimplexKind.SINGULAR: (shape.singular_vertices, shape.singular_edges),
        SimplexKind.REGULAR: (shape.regular_vertices, shape.regular_edges),
        SimplexKind.INTERIOR: (shape.interior_vertices, shape.interior_edges),
    }
    for kind, (vertices, edges) in lists.items():
        of_kind = [simplex for simplex, other in expected.items() if other == kind]
        assert [(v,) for v in vertices.tolist()] == [s for s in of_kind if len(s) == 1]
        assert rows(edges) == [s for s in of_kind if len(s) == 2]


@given(shapes())
def test_the_complex_is_all_simplices_up_to_the_radius(shape):
    filtration = shape.filtration
    present = {s for s, value in values_of(filtration).items() if value <= shape.radius}
    edges, triangles = ({s for s in present if len(s) == k + 1} for k in (1, 2))
    assert set(rows(shape.edges)) == edges and len(shape.edges) == len(edges)
    assert {tuple(sorted(row)) for row in rows(shape.triangles)} == triangles
    assert len(shape.triangles) == len(triangles)
    joined = {v for edge in edges for v in edge}
    vertices = filtration.simplices[0][:, 0].tolist()
    assert shape.isolated_vertices.tolist() == [v for v in vertices if v not in joined]
    assert shape.counts == {
        "vertices": len(vertices),
        "edges": len(edges),
        "triangles": len(triangles),
        "singular_edges": len(shape.singular_edges),
        "regular_edges": len(shape.regular_edges),
        "interior_edges": len(shape.interior_edges),
        "isolated_vertices": len(shape.isolated_vertices),
    }
    assert shape.euler_characteristic == len(vertices) - len(edges) + len(triangles)


@given(shapes())
def test_triangles_turn_left_and_boundary_has_the_shape_on_its_left(shape):
    exact, _ = oracles.lattice(shape.points)
    sides = {}
    for a, b, c in rows(shape.triangles):
        assert a < b and a < c
        assert oracles.orient(exact[a], exact[b], exact[c]) > 0
        sides |= {(a, b): c, (b, c): a, (c, a): b}
    directed = rows(shape.boundary_edges)
    assert set(directed) == {(a, b) for a, b in sides if (b, a) not in sides}
    assert [tuple(sorted(edge)) for edge in directed] == rows(shape.regular_edges)
    starts, ends = ([edge[k] for edge in directed] for k in (0, 1))
    assert sorted(starts) == sorted(ends)


@given(shapes())
def test_measures_are_accurate(shape):
    exact, scale = oracles.lattice(shape.points)
    area = sum(
        Fraction(oracles.doubled_area([exact[v] for v in row])) for row in rows(shape.triangles)
    )
    area *= scale * scale / 2
    tiny, huge = Fraction(2) ** -1000, Fraction(2) ** 1020
    if area == 0 or tiny < area < huge:
        assert abs(Fraction(shape.area) - area) <= area * Fraction(1, 10**12)
    lengths = [math.dist(*shape.points[list(edge)]) for edge in rows(shape.boundary_edges)]
    assert shape.perimeter == pytest.approx(math.fsum(lengths), rel=1e-13, abs=0)


def test_area_of_slivers_far_from_the_origin():
    points = np.array([[1e8, 1e8], [1e8 + 1, 1e8 + 1], [1e8 + 2, 1e8 + 2 + 2**-26]])
    shape = am.AlphaComplex(points).at(math.inf)
    (ax, ay), (bx, by), (cx, cy) = ([Fraction(v) for v in p] for p in points.tolist())
    exact = abs((bx - ax) * (cy - ay) - (cx - ax) * (by - ay)) / 2
    assert exact > 0
    assert abs(Fraction(shape.area) - exact) <= exact * Fraction(1, 10**13)


@pytest.mark.parametrize("exponent", [-500, -60, 60, 500])
def test_measures_scale_with_the_points(exponent):
    unit, scaled = (am.AlphaComplex(ring() * 2.0**e).at() for e in (0, exponent))
    assert scaled.radius == unit.radius * 2.0**exponent
    assert scaled.perimeter == unit.perimeter * 2.0**exponent
    assert scaled.area == pytest.approx(unit.area * 4.0**exponent, rel=1e-12)


def test_area_beyond_float64_is_infinite():
    assert am.AlphaComplex(FIGURE * 1e200).at(math.inf).area == math.inf


def test_a_figure_by_hand():
    shape = am.AlphaComplex(FIGURE).at(1.5)
    assert shape.area == 12.0
    assert shape.perimeter == pytest.approx(8 + 4 * math.sqrt(2), rel=1e-15)
    assert shape.counts == {
        "vertices": 10,
        "edges": 13,
        "triangles": 6,
        "singular_edges": 1,
        "regular_edges": 6,
        "interior_edges": 6,
        "isolated_vertices": 1,
    }
    assert rows(shape.singular_edges) == [(7, 8)]
    assert shape.isolated_vertices.tolist() == [9]
    assert shape.singular_vertices.tolist() == [7, 8, 9]
    assert shape.regular_vertices.tolist() == [0, 1, 3, 4, 5, 6]
    assert shape.interior_vertices.tolist() == [2]
    assert shape.euler_characteristic == 3
    assert repr(shape) == (
        "<AlphaShape at radius 1.5: 6 triangles, 1 singular edges, 1 isolated vertices>"
    )


def test_boundary_runs_left_around_the_shape_and_right_around_its_hole():
    shape = am.AlphaComplex(ring()).at(0.5)
    assert shape.euler_characteristic == 0
    following = dict(rows(shape.boundary_edges))
    assert len(following) == len(shape.boundary_edges) == 120
    turns = []
    while following:
        start, here = following.popitem()
        loop = [start]
        while here != start:
            loop.append(here)
            here = following.pop(here)
        x, y = shape.points[loop].T
        turns.append(float((x * np.roll(y, -1) - y * np.roll(x, -1)).sum()) / 2)
    hole, around = sorted(turns)
    assert hole < 0 < around
    assert shape.area == pytest.approx(around + hole, rel=1e-12)


def test_grows_with_the_radius():
    cx = am.AlphaComplex(RNG.random((300, 2)))
    for lower, upper in pairwise(cx.at(r) for r in (0, 0.01, 0.03, 0.05, 0.1, math.inf)):
        assert set(rows(lower.edges)) <= set(rows(upper.edges))
        assert set(rows(lower.triangles)) <= set(rows(upper.triangles))
        for k in range(3):
            assert (lower.kinds[k] <= upper.kinds[k]).all()
        assert lower.area <= upper.area
    assert len(cx.at(0).edges) == 0
    assert len(cx.at(math.inf).triangles) == len(cx.simplices[2])


@given(complexes())
def test_the_radius_is_closed(cx):
    for r in cx.critical_radii()[1:8]:
        at, below = cx.at(r), cx.at(math.nextafter(r, 0))
        here = sum(at.counts[k] for k in ("edges", "triangles"))
        assert here > sum(below.counts[k] for k in ("edges", "triangles"))


@pytest.mark.parametrize("radius", [0, 5, math.inf])
def test_what_never_joins_stays_isolated(radius):
    alone = am.AlphaComplex([[1, 1], [1, 1]]).at(radius)
    assert alone.isolated_vertices.tolist() == [0] and alone.kinds[0].tolist() == [1]
    line = am.AlphaComplex([[0, 0], [2, 0], [4, 0]]).at(radius)
    assert line.isolated_vertices.tolist() == ([0, 1, 2] if radius == 0 else [])
    assert line.kinds[0].tolist() == [SimplexKind.SINGULAR] * 3
    assert line.kinds[1].tolist() == [int(radius > 0)] * 2


def test_without_a_radius_one_is_chosen():
    cx = am.AlphaComplex(FIGURE)
    assert cx.at().radius == cx.choose_radius().radius
    everything = cx.at(cx.choose_radius("all-points").radius)
    assert len(everything.singular_vertices) == 0


@pytest.mark.parametrize("radius", [-1, -1e-300, math.nan, -math.inf, np.float64("nan")])
def test_refuses_a_negative_radius(radius):
    with pytest.raises(ParameterError, match="radius must be 0 or more"):
        am.AlphaComplex(FIGURE).at(radius)


@pytest.mark.parametrize("radius", ["1.5", [1.5], 1j, np.array([1.0])])
def test_refuses_what_is_no_number(radius):
    with pytest.raises(ParameterError, match="radius must be a number"):
        am.AlphaComplex(FIGURE).at(radius)


@pytest.mark.parametrize("radius", [1, np.float32(1), np.int16(1), Fraction(1), -0.0, 2**60])
def test_takes_any_real_number(radius):
    shape = am.AlphaComplex(FIGURE).at(radius)
    assert type(shape.radius) is float and shape.radius == radius


def test_is_kept_and_cannot_change():
    shape = am.AlphaComplex(FIGURE).at(1.5)
    names = [
        "boundary_edges",
        "edges",
        "interior_edges",
        "interior_vertices",
        "isolated_vertices",
        "points",
        "regular_edges",
        "regular_vertices",
        "singular_edges",
        "singular_vertices",
        "triangles",
    ]
    for name in names:
        array = getattr(shape, name)
        assert array is getattr(shape, name), name
        assert not array.flags.writeable, name
        assert array.dtype == (np.float64 if name == "points" else np.int32), name
    assert not any(kinds.flags.writeable for kinds in shape.kinds)
    with pytest.raises(FrozenInstanceError):
        shape.radius = 2.0
    with pytest.raises(FrozenInstanceError):
        shape.area = 2.0
    assert copy.deepcopy(shape) is shape


def test_survives_a_pickle():
    shape = am.AlphaComplex(FIGURE).at(1.5)
    thawed = pickle.loads(pickle.dumps(shape))
    assert thawed.radius == shape.radius and thawed.counts == shape.counts
    np.testing.assert_array_equal(thawed.triangles, shape.triangles)
    assert not thawed.points.flags.writeable


def test_makes_a_mesh_of_what_is_in_it():
    shape = am.AlphaComplex(FIGURE).at(1.5)
    mesh = shape.mesh()
    np.testing.assert_array_equal(mesh.points, FIGURE)
    np.testing.assert_array_equal(mesh.cells["triangle"], shape.triangles)
    np.testing.assert_array_equal(mesh.cells["line"], shape.singular_edges)
    np.testing.assert_array_equal(mesh.cells["vertex"][:, 0], shape.isolated_vertices)
    radii = mesh.cell_data["radius"]
    np.testing.assert_array_equal(radii["line"], [1.0])
    np.testing.assert_array_equal(radii["triangle"], [math.sqrt(2)] * 6)
    np.testing.assert_array_equal(radii["vertex"], [0.0])


def test_saves_points_in_input_order_with_their_rows(tmp_path):
    shape = am.AlphaComplex(FIGURE[::-1]).at(1.5)
    shape.save(tmp_path / "mesh.npz")
    with np.load(tmp_path / "mesh.npz") as saved:
        input_rows = saved["points.input_row"]
        # The duplicate of row 0 is row 8 of the reversed figure.
        assert input_rows.tolist() == [row for row in range(11) if row != 8]
        np.testing.assert_array_equal(saved["points"], FIGURE[::-1][input_rows])
        np.testing.assert_array_equal(input_rows[saved["triangles"]], shape.triangles)
    shape.save(str(tmp_path / "all.npz"), keep_all=True)
    with np.load(tmp_path / "all.npz") as saved:
        np.testing.assert_array_equal(saved["points"], FIGURE[::-1])
        np.testing.assert_array_equal(saved["triangles"], shape.triangles)


def test_saving_tells_what_goes_wrong(tmp_path):
    shape = am.AlphaComplex(FIGURE).at(1.5)
    with pytest.raises(FileWriteError, match="xyz"):
        shape.save(tmp_path / "mesh.xyz")
    with pytest.warns(LossyFormatWarning, match="mesh.stl"):
        shape.save(tmp_path / "mesh.stl")
    assert [path.name for path in tmp_path.iterdir()] == ["mesh.stl"]


def test_plots_on_new_or_given_axes():
    pytest.importorskip("matplotlib")
    from matplotlib.figure import Figure

    cx = am.AlphaComplex(FIGURE)
    drawing = cx.at(1.5).plot()
    assert {"triangles", "singular_edges", "isolated_vertices"} <= set(drawing.artists)
    ax = Figure().add_subplot()
    assert cx.plot(1.5, ax=ax).axes is ax
    assert "singular_edges" not in cx.plot(math.inf).artists
