"""Periodic boxes: every simplex once, exactly, whatever the points and the box."""

from __future__ import annotations

import importlib
import math
import pickle
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import alphamesh as am
from alphamesh.check import check_periodic
from alphamesh.errors import (
    CloudShapeError,
    CoordinateRangeError,
    InvalidResultError,
    NonFiniteError,
    ParameterError,
    PeriodsError,
)
from periodic_oracle import exact_values


def boxed(points, periods):
    made = am.AlphaComplex(points, periods=periods)
    check_periodic(made.filtration)
    return made


def grid(sides, step=1.0):
    axes = np.indices(sides).reshape(len(sides), -1).T
    return axes * step


def named(complex_):
    """Return all simplices with their offsets and values, by the rows of their vertices."""
    filtration = complex_.filtration
    return {
        (k, tuple(rows), tuple(map(tuple, offsets))): radius
        for k in range(len(filtration.simplices))
        for rows, offsets, radius in zip(
            filtration.simplices[k].tolist(),
            filtration.offsets[k].tolist(),
            filtration.radii[k].tolist(),
            strict=True,
        )
    }


# By definition

coordinates = st.one_of(
    st.floats(-3, 3).map(lambda x: x if abs(x) > 2.0**-100 else 0.0),
    st.integers(-8, 8).map(lambda k: k / 4),
    st.sampled_from([0.0, 1.0, 0.1, 0.3, 1 / 3, 1e-20, -1e-20, 1 - 2**-53]),
)
sides = st.sampled_from([1.0, 1.0, 2.0, 0.3, 0.7, 3.1])


@st.composite
def boxes(draw, most=4):
    d = draw(st.sampled_from([2, 3]))
    point = st.tuples(*[coordinates] * d)
    points = draw(st.lists(point, min_size=1, max_size=most if d == 2 else most - 1))
    periods = [draw(st.one_of(sides, st.none())) for _ in range(d)]
    periods[draw(st.integers(0, d - 1))] = draw(sides)
    return np.array(points), tuple(periods)


@settings(max_examples=25, deadline=None)
@given(boxes())
def test_every_value_is_that_of_its_definition(box):
    filtration = boxed(*box).filtration
    for values, radii in zip(exact_values(filtration), filtration.radii, strict=True):
        for value, radius in zip(values, radii.tolist(), strict=True):
            assert radius == pytest.approx(math.sqrt(value), rel=4e-15, abs=0)


@settings(max_examples=60, deadline=None)
@given(boxes(most=12))
def test_every_box_has_the_homology_of_its_torus(box):
    points, periods = box
    made = boxed(points, periods)
    whole = made.at(np.inf)
    loops = sum(side is not None for side in periods)
    expected = [math.comb(loops, k) for k in range(len(periods) + 1)]
    assert whole.betti == tuple(expected)
    assert whole.euler == 0


@pytest.mark.parametrize(("d", "counts"), [(2, (1, 3, 2)), (3, (1, 7, 12, 6))])
def test_one_point_makes_a_torus(d, counts):
    made = boxed([[0.25] * d], (1.0,) * d)
    assert tuple(map(len, made.simplices)) == counts
    assert not made.is_simplicial
    assert set(made.radii[1].tolist()) <= {0.5, math.sqrt(0.5), math.sqrt(0.75)}
    assert made.radii[d].tolist() == pytest.approx([math.sqrt(d) / 2] * counts[-1], rel=1e-15)
    assert made.at(np.inf).filled_share == pytest.approx(1, rel=1e-14)


def test_two_points_at_the_border_of_the_box_are_apart():
    made = boxed([[0.0, 0.5], [0.9375, 0.5]], (1.0, 1.0))
    shortest = int(np.argmin(made.radii[1]))
    assert made.simplices[1][shortest].tolist() == [0, 1]
    assert made.offsets[1][shortest].tolist() == [[0, 0], [-1, 0]]
    assert made.radii[1][shortest] == 0.03125


def test_points_at_one_place_of_the_box_are_merged():
    points = [[0.25, 0.5], [1.25, 0.5], [0.25, -2.5], [0.5, 0.5]]
    made = boxed(points, (1.0, 1.0))
    assert made.representative.tolist() == [0, 0, 0, 3]
    assert made.simplices[0].tolist() == [[0], [3]]
    assert made.positions.tolist() == [[0.25, 0.5]] * 3 + [[0.5, 0.5]]


def test_places_that_float64_cannot_tell_apart_stay_apart():
    # In the box, -1e-20 is 1 - 1e-20, which rounds to 1.
    made = boxed([[-1e-20, 0.5], [0.0, 0.5], [0.5, 0.5]], (1.0, 1.0))
    assert made.representative.tolist() == [0, 1, 2]
    assert made.radii[1].min() == pytest.approx(5e-21, rel=1e-15)


def test_no_points_have_an_empty_complex():
    made = boxed(np.empty((0, 3)), (1, None, 2.5))
    assert [len(rows) for rows in made.simplices] == [0, 0, 0, 0]
    assert made.dimension == -1
    assert made.at(1).betti == (0, 0, 0, 0)
    assert made.critical_radii().size == 0


# Nothing that means nothing changes anything


@pytest.mark.parametrize(
    "points",
    [
        np.random.default_rng(1).integers(0, 1 << 16, (80, 2)) / (1 << 16),
        np.random.default_rng(2).integers(0, 1 << 16, (60, 3)) / (1 << 16),
        grid((4, 4)) / 4,
        grid((4, 4, 4)) / 4,
    ],
)
def test_translation_changes_nothing(points):
    d = points.shape[1]
    first = boxed(points, (1.0,) * d)
    moved = points + np.array([0.625, 0.25, 0.4375])[:d] - 2
    second = boxed(moved, (1.0,) * d)
    # A simplex by the arrows from its first row's vertex on: offsets change with wrapping.
    for k in range(1, d + 1):
        assert arrows(first, k) == arrows(second, k)


def arrows(complex_, k):
    """Return rows, arrows between the vertices, and values, without mention of the box."""
    corners = complex_.filtration.corners(k)
    found = []
    for rows, places, radius in zip(
        complex_.simplices[k].tolist(), corners, complex_.radii[k].tolist(), strict=True
    ):
        order = np.lexsort((*places.T[::-1], rows))
        away = places[order] - places[order[0]]
        found.append((tuple(np.array(rows)[order]), tuple(away.ravel().tolist()), radius))
    return sorted(found)


@pytest.mark.parametrize("d", [2, 3])
def test_the_order_of_points_changes_nothing(d):
    rng = np.random.default_rng(3)
    points = np.concatenate((rng.random((50, d)), grid((3,) * d, 0.3)))
    order = rng.permutation(len(points))
    first, second = (boxed(rows, (0.9,) * d) for rows in (points, points[order]))
    for k in range(1, d + 1):
        renamed = [
            (tuple(sorted(order[rows].tolist())), radius)
            for rows, radius in zip(second.simplices[k], second.radii[k].tolist(), strict=True)
        ]
        plain = [
            (tuple(sorted(rows)), radius)
            for rows, radius in zip(
                first.simplices[k].tolist(), first.radii[k].tolist(), strict=True
            )
        ]
        assert sorted(renamed) == sorted(plain)


def test_threads_change_nothing():
    points = np.random.default_rng(4).random((12_000, 2))
    first = am.AlphaComplex(points, periods=(1, 1), threads=1)
    second = am.AlphaComplex(points, periods=(1, 1), threads=2)
    assert named(first) == named(second)


def test_progress_never_goes_back(monkeypatch):
    import alphamesh.periodic._making as stage

    monkeypatch.setattr(stage, "_HALO", 1e-9)  # all is done three times
    told = []
    points = np.random.default_rng(4).random((52_000, 2))
    am.AlphaComplex(points, periods=(1, 1), progress=told.append)
    assert told == sorted(told)
    assert told[-1] == 1
    with pytest.raises(ParameterError):
        am.AlphaComplex(points[:5], periods=(1, 1), progress=5)


@pytest.mark.parametrize("step", [0.1, 1 / 3])
def test_crystals_need_no_wide_margin(monkeypatch, step):
    """Slivers as thin as the last digit have spheres that are no larger than others."""
    stage = importlib.import_module("alphamesh.periodic._making")
    margins = []

    def counted(high, *rest):
        margins.append(len(high))
        return star(high, *rest)

    star = stage.periodic_star
    monkeypatch.setattr(stage, "periodic_star", counted)
    made = am.AlphaComplex(grid((8, 8, 8), step), periods=(8 * step,) * 3)
    assert len(made.simplices[0]) == 512
    assert margins == [pytest.approx(15**3, rel=0.1)]  # and not 27 boxes


def test_narrow_and_wide_margins_give_the_same(monkeypatch):
    import alphamesh.periodic._making as stage

    rng = np.random.default_rng(8)
    points = np.concatenate((rng.random((300, 2)) * 0.3, rng.random((20, 2))))
    expected = named(boxed(points, (1.0, 1.0)))
    for halo in (1e-9, 0.5, 100.0):
        monkeypatch.setattr(stage, "_HALO", halo)
        assert named(boxed(points, (1.0, 1.0))) == expected


@pytest.mark.parametrize("scale", [2.0**-400, 1e-150, 2.0**-130, 1e-9, 1e9, 1e150, 2.0**400])
def test_scale_changes_nothing_but_the_radii(scale):
    points = np.random.default_rng(6).random((40, 3)).astype(np.float32).astype(float)
    exact = math.frexp(scale)[0] == 0.5
    first = boxed(points, (1.0, 1.0, None))
    second = boxed(points * scale, (scale, scale, None))
    assert [len(rows) for rows in first.simplices] == [len(rows) for rows in second.simplices]
    for own, other in zip(first.radii, second.radii, strict=True):
        if exact:
            assert np.array_equal(own * scale, other)
        else:
            assert np.allclose(own, other / scale, rtol=1e-9)


# Boxes of all kinds


def test_a_long_thin_box_wraps_many_times():
    points = np.random.default_rng(9).random((30, 3)) * [1, 1, 1000]
    made = boxed(points, (1, 1, 1000))
    assert made.at(np.inf).volume == pytest.approx(1000)
    assert not made.is_simplicial


@pytest.mark.parametrize(
    ("points", "periods", "dimension"),
    [
        (np.column_stack((np.arange(5) / 5, np.zeros(5))), (1, None), 1),
        (np.column_stack((np.arange(5) / 5, np.zeros(5), np.zeros(5))), (1, None, None), 1),
        (np.column_stack((np.arange(5) / 7, np.arange(5) / 3, np.ones(5))), (1, 1, None), 2),
        # In a plane that is none of the coordinate planes.
        (
            np.column_stack((np.arange(5) / 7, np.arange(5), 3 * np.arange(5))),
            (1, None, None),
            2,
        ),
        (np.array([[0.0, 3.0, 0.1]]), (None, None, 0.3), 1),
    ],
)
def test_clouds_may_have_fewer_dimensions(points, periods, dimension):
    made = boxed(points, periods)
    assert made.dimension == dimension
    filtration = made.filtration
    for values, radii in zip(exact_values(filtration), filtration.radii, strict=True):
        assert radii.tolist() == pytest.approx([math.sqrt(v) for v in values], rel=4e-15)


def test_open_directions_have_a_border():
    points = np.random.default_rng(10).random((200, 3))
    made = boxed(points, (1.0, None, 1.0))
    whole = made.at(np.inf)
    height = np.ptp(points[:, 1])
    assert whole.volume == pytest.approx(height, rel=1e-12)
    assert whole.surface_area == pytest.approx(2, rel=1e-12)
    assert whole.betti == (1, 2, 1, 0)


def test_tiling_makes_simplices_of_few_points_differ():
    made = boxed([[0.2, 0.3]], (1, 1))
    larger = made.tiled(3)
    check_periodic(larger.filtration)
    assert larger.is_simplicial
    assert larger.periods == (3.0, 3.0)
    assert tuple(map(len, larger.simplices)) == (9, 27, 18)
    assert boxed([[0.2, 0.3]], (1, None)).tiled(4).periods == (4.0, None)
    for repeats in (0, (2,), (2, 0), "ab", 1.5):
        with pytest.raises(PeriodsError, match="whole numbers"):
            made.tiled(repeats)


def test_points_on_a_line_of_a_box_meet_their_copies_far_away():
    points = np.column_stack((np.arange(40) / 40, np.full(40, 0.5)))
    made = boxed(points, (1, 1))
    assert made.dimension == 2
    assert made.at(0.49).betti == (1, 1, 0)


def test_large_boxes_of_random_points_are_proved():
    made = boxed(np.random.default_rng(11).random((3000, 3)) * 10, (10, 10, 10))
    assert made.is_simplicial
    assert made.at(np.inf).betti == (1, 3, 3, 1)


# What is wrong is named


@pytest.mark.parametrize(
    "periods",
    [
        (1,),
        (1, 2, 3),
        (0, 1),
        (-1, 1),
        (math.inf, 1),
        (math.nan, 1),
        (None, None),
        "11",
        5,
        ("a", 1),
        (True, 1),
        {1: 2},
    ],
)
def test_wrong_periods_are_refused(periods):
    with pytest.raises(PeriodsError, match="period"):
        am.AlphaComplex([[0.1, 0.2]], periods=periods)


def test_wrong_points_are_refused_with_their_rows():
    with pytest.raises(NonFiniteError) as error:
        am.AlphaComplex([[0, 0], [np.nan, 1]], periods=(1, 1))
    assert error.value.rows == (1,)
    with pytest.raises(PeriodsError, match="last digit") as error:
        am.AlphaComplex([[0, 0], [1e20, 1]], periods=(1, 1))
    assert error.value.rows == (1,)
    with pytest.raises(CoordinateRangeError, match="too small") as error:
        am.AlphaComplex([[0, 0], [1e-200, 1]], periods=(1, 1))
    assert error.value.rows == (1,)
    with pytest.raises(CloudShapeError):
        am.AlphaComplex([1, 2, 3], periods=(1, 1))


def test_checks_name_what_is_broken():
    filtration = am.AlphaComplex(
        np.random.default_rng(12).random((20, 2)), periods=(1, 1)
    ).filtration
    values = {name: getattr(filtration, name) for name in filtration.__dataclass_fields__}

    def broken(**changes):
        with pytest.raises(InvalidResultError) as error:
            check_periodic(type(filtration)(**{**values, **changes}))
        return str(error.value)

    radii = tuple(part.copy() for part in filtration.radii)
    radii[1][3] = 100.0
    assert "below those of faces" in broken(radii=radii)
    offsets = tuple(part.copy() for part in filtration.offsets)
    offsets[2][0, 2] *= -1
    offsets[2][0, 2, 0] += 1 if offsets[2][0, 2, 0] < 1 else -1
    assert broken(offsets=offsets)
    # A point that moves makes triangles fold or lie within each other's circles.
    points = filtration.points.copy()
    points[4] = (points[4] + 0.4) % 1
    assert "facets" in broken(points=points)
    simplices = tuple(part.copy() for part in filtration.simplices)
    simplices[2][:2] = simplices[2][1::-1]
    assert broken(simplices=simplices)


def test_records_can_be_pickled_and_copied():
    made = am.AlphaComplex([[0.1, 0.2], [0.5, 0.7]], periods=(1, None))
    again = pickle.loads(pickle.dumps(made))
    assert named(again) == named(made)
    assert not again.offsets[1].flags.writeable
    assert repr(made) == "<PeriodicComplex, 1 x open: 2 vertices, 4 edges, 2 triangles>"


def test_positions_are_rounded_and_values_are_not():
    # 0.1 + 3 does not fit in float64: the exact place decides.
    made = boxed([[0.1, 0.0], [3.0 + 0.1 - 3.0, 0.5]], (3.0, 1.0))
    distance = Fraction(3.0 + 0.1 - 3.0) - Fraction(0.1)
    assert distance != 0
    assert made.radii[1].min() == pytest.approx(math.hypot(float(distance), 0.5) / 2, rel=1e-15)
