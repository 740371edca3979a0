"""as_cloud: what it takes, what it refuses, and that messages name rows and remedy."""

from __future__ import annotations

import copy
import pickle
from decimal import Decimal
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from hypothesis import example, given

import alphamesh as am
import strategies
from alphamesh.errors import (
    CloudError,
    CloudShapeError,
    CoordinateRangeError,
    NonFiniteError,
)
from alphamesh.points import Cloud, as_cloud, coordinate_error

EXPECTED = np.array([[0.0, 1.0], [2.0, 3.0], [4.0, 5.0]])


class HasArray:
    """Something foreign that knows how to become an array."""

    def __array__(self, dtype=None, copy=None):
        return EXPECTED.astype(np.float32 if dtype is None else dtype)


@pytest.mark.parametrize(
    "points",
    [
        EXPECTED,
        EXPECTED.tolist(),
        [tuple(row) for row in EXPECTED],
        [np.array(row) for row in EXPECTED],
        EXPECTED.astype(">f8"),
        EXPECTED.astype(np.float16),
        EXPECTED.astype(np.longdouble),
        EXPECTED.astype(np.int8),
        EXPECTED.astype(np.uint64),
        EXPECTED.astype(object),
        [[Fraction(0), 1], [2.0, np.int32(3)], [np.float32(4), 5]],
        np.asfortranarray(EXPECTED),
        np.repeat(EXPECTED, 2, axis=0)[::2],
        np.ma.masked_array(EXPECTED, mask=np.zeros((3, 2), dtype=bool)),
        memoryview(EXPECTED),
        HasArray(),
        Cloud(EXPECTED),
    ],
    ids=lambda value: type(value).__name__,
)
def test_takes_anything_that_holds_the_numbers(points):
    made = as_cloud(points).points
    assert type(made) is np.ndarray
    assert made.dtype == np.float64 and made.dtype.isnative and made.flags.c_contiguous
    np.testing.assert_array_equal(made, EXPECTED)


def test_takes_no_points():
    assert as_cloud(np.empty((0, 2))).points.shape == (0, 2)
    assert len(as_cloud(np.empty((0, 2), dtype=int))) == 0


@given(strategies.clouds())
def test_is_a_private_read_only_copy_of_every_bit(points):
    original = points.copy()
    made = as_cloud(points).points
    assert not made.flags.writeable and made.flags.owndata
    assert not np.shares_memory(made, points)
    assert made.tobytes() == original.tobytes() == points.tobytes()
    assert points.flags.writeable


def test_a_read_only_view_is_copied_as_its_base_can_change():
    base = EXPECTED.copy()
    view = base[:]
    view.flags.writeable = False
    made = as_cloud(view).points
    base[0, 0] = 99
    np.testing.assert_array_equal(made, EXPECTED)


def test_points_in_space_and_stages_of_one_dimension():
    space = np.arange(12.0).reshape(4, 3)
    assert as_cloud(space).points.tobytes() == space.tobytes()
    assert as_cloud(space.astype(int)).points.shape == (4, 3)
    assert as_cloud(space.tolist(), 3).points.shape == (4, 3)
    assert as_cloud(np.empty((0, 3))).points.shape == (0, 3)
    cloud = as_cloud(space)
    assert as_cloud(cloud) is as_cloud(cloud, 3) is cloud
    for source in (space, space.tolist(), cloud):
        with pytest.raises(CloudShapeError, match=r"in the plane alone: .* points\[:, :2\]"):
            as_cloud(source, 2)
    with pytest.raises(CloudShapeError, match=r"in space alone: .*numpy\.zeros"):
        as_cloud(space[:, :2], 3)
    with pytest.raises(CloudShapeError, match="three coordinates: look at row 1"):
        as_cloud([[1, 2, 3], [4, 5], [6, 7, 8]])
    for stage in (am.convex_hull, am.voronoi, am.framed_delaunay):
        with pytest.raises(CloudShapeError, match="in the plane alone"):
            stage(space)


def test_negative_zero_stays():
    made = as_cloud([[-0.0, 1.0]]).points
    assert np.signbit(made[0, 0])


def test_cloud_cannot_change():
    cloud = as_cloud(EXPECTED)
    with pytest.raises(AttributeError):
        cloud.points = EXPECTED
    with pytest.raises(ValueError, match="read-only"):
        cloud.points[0, 0] = 7
    assert copy.deepcopy(cloud) is cloud
    thawed = pickle.loads(pickle.dumps(cloud))
    np.testing.assert_array_equal(thawed.points, EXPECTED)
    assert not thawed.points.flags.writeable


SHAPES = {
    "no shape": ([], "numpy.empty((0, 2))"),
    "no rows but four columns": (np.empty((0, 4)), "numpy.empty((0, 2))"),
    "one point": ([1.0, 2.0], "[[x, y]]"),
    "one point in space": ([1.0, 2.0, 3.0], "[[x, y, z]]"),
    "one dimension": (np.arange(6.0), "numpy.column_stack([x, y])"),
    "one column": (np.ones((5, 1)), "numpy.column_stack([x, y])"),
    "four columns": (np.ones((5, 4)), "points[:, :2]"),
    "three rows": (np.ones((3, 500)), "points.T"),
    "two rows": (np.ones((2, 500)), "points.T"),
    "an image": (np.ones((48, 64), dtype=np.uint8), "sample_mask"),
    "three dimensions": (np.ones((4, 5, 2)), "points.reshape(-1, 2)"),
    "a number": (3.5, "got float"),
    "nothing": (None, "got NoneType"),
    "a generator": (((x, x) for x in range(3)), "got generator"),
    "a dictionary": ({"x": [1], "y": [2]}, "got dict"),
    "complex numbers": (np.array([1 + 2j, 3 + 4j]), "numpy.column_stack([z.real, z.imag])"),
    "a mask": (np.ones((4, 2), dtype=bool), "sample_mask"),
    "dates": (np.zeros((3, 2), dtype="datetime64[s]"), "datetime64"),
    "fields": (np.zeros(3, dtype=[("x", "f8"), ("y", "f8")]), "fields x, y"),
    "a file name": ("cloud.csv", "read_points('cloud.csv')"),
    "a path": (Path("cloud.csv"), "read_points('cloud.csv')"),
    "numbers as text": ([["1", "2"], ["3", "4.5"]], "numpy.asarray(points, dtype=float)"),
    "too deep objects": (np.full((2, 2, 2), Fraction(1, 3), dtype=object), "reshape"),
}


@pytest.mark.parametrize("name", SHAPES)
def test_refuses_what_is_no_table_of_two_or_three_columns(name):
    points, remedy = SHAPES[name]
    with pytest.raises(CloudShapeError) as caught:
        as_cloud(points)
    assert remedy in str(caught.value)
    assert caught.value.rows == ()


ROWS = {
    "ragged": ([[1, 2], [3], [4, 5], [6, 7, 8]], (1, 3), "row 1 has 1"),
    "ragged objects": (np.array([[1, 2], [3]], dtype=object), (1,), "row 1 has 1"),
    "a lone number": ([[1, 2], 3], (1,), "row 1 is a single value"),
    "words": ([[1, 2], [3, "n/a"], [5, 6]], (1,), "row 1 holds 'n/a'"),
    "words in an array": (np.array([["1", "2"], ["x", "4"]]), (1,), "row 1 holds 'x'"),
    "bytes": (np.array([[b"1", b"2"], [b"x", b"4"]]), (1,), "row 1 holds b'x'"),
    "None": ([[1.0, 2.0], [None, 4.0], [5.0, None]], (1, 2), "row 1 holds None, a NoneType"),
    "decimals": ([[Decimal("0.1"), 1]], (0,), "a Decimal"),
    "True among objects": (np.array([[1, 2], [True, 4]], dtype=object), (1,), "a bool"),
    "masked": (np.ma.masked_equal([[1, 2], [3, -1]], -1), (1,), "numpy.ma.compress_rows"),
    "many": (np.array([[None, 1]] * 9), (0, 1, 2, 3, 4, 5), "0, 1, 2, 3, 4, ... (9 in all)"),
    "a long word": ([[1, "x" * 99]], (0,), "xxx..."),
}


@pytest.mark.parametrize("name", ROWS)
def test_names_the_rows_that_are_no_numbers(name):
    points, rows, text = ROWS[name]
    with pytest.raises(CloudShapeError) as caught:
        as_cloud(points)
    assert caught.value.rows == rows
    assert text in str(caught.value)


def test_rows_of_two_that_do_not_stack():
    with pytest.raises(CloudShapeError, match=r"row 0 holds \[1, 2\], a list"):
        as_cloud(np.array([[[1, 2], [3]], [[4], [5, 6]]], dtype=object))
    pairs = np.empty(2, dtype=object)
    pairs[:] = [(1, 2), (3, 4)]
    with pytest.raises(CloudShapeError, match=r"numpy\.array\(\[tuple\(p\) for p in points\]"):
        as_cloud(pairs)


ROUNDED = {
    "odd beyond 2**53": (np.array([[0, 1], [2**53 + 1, 0]]), (1,)),
    "negative": (np.array([[-(2**53) - 1, 0]]), (0,)),
    "largest": (np.array([[0, 2**63 - 1]]), (0,)),
    "unsigned": (np.array([[0, 2**64 - 1]], dtype=np.uint64), (0,)),
    "huge": ([[0, 0], [10**400, 0]], (1,)),
    "fraction": ([[Fraction(1, 3), 0]], (0,)),
}


@pytest.mark.parametrize("name", ROUNDED)
def test_refuses_numbers_that_would_be_rounded(name):
    points, rows = ROUNDED[name]
    with pytest.raises(CoordinateRangeError, match="would round") as caught:
        as_cloud(points)
    assert caught.value.rows == rows


def test_refuses_long_doubles_that_would_be_rounded():
    if np.finfo(np.longdouble).nmant <= 52:
        pytest.skip("long double is float64 here")
    points = np.ones((3, 2), dtype=np.longdouble)
    points[2, 1] += np.finfo(np.longdouble).eps
    with pytest.raises(CoordinateRangeError, match="row 2"):
        as_cloud(points)
    points[2, 1] = np.longdouble("1e4000")
    with pytest.raises(CoordinateRangeError, match="row 2"):
        as_cloud(points)


@pytest.mark.parametrize("value", [2**53, 2**60, -(2**63), 3 * 2**61, 2**63 - 2**10])
def test_keeps_large_integers_that_fit(value):
    made = as_cloud(np.array([[value, 0]], dtype=np.int64)).points
    assert int(made[0, 0]) == value


# DataFrames


def test_takes_the_two_columns_of_a_frame():
    pandas = pytest.importorskip("pandas")
    frame = pandas.DataFrame({"x": [0, 2, 4], "y": [1.0, 3.0, 5.0]})
    np.testing.assert_array_equal(as_cloud(frame).points, EXPECTED)
    np.testing.assert_array_equal(as_cloud(frame.astype("Float64")).points, EXPECTED)
    frame.columns = ["same", "same"]
    np.testing.assert_array_equal(as_cloud(frame).points, EXPECTED)


def test_names_the_columns_of_a_frame():
    pandas = pytest.importorskip("pandas")
    frame = pandas.DataFrame({"x": [0, 1], "name": ["a", "b"], "y": [1.0, 2.0]})
    with pytest.raises(CloudShapeError, match="not numeric: 'name'; ") as caught:
        as_cloud(frame)
    assert "df[['x', 'y']]" in str(caught.value)
    in_space = pandas.DataFrame({"x": [1.0], "y": [2.0], "z": [3.0]})
    assert as_cloud(in_space).points.tolist() == [[1.0, 2.0, 3.0]]
    with pytest.raises(CloudShapeError, match="got 'x', 'y', 'z'; choose two"):
        as_cloud(in_space, 2)
    with pytest.raises(CloudShapeError, match="'w', 'x', 'y', 'z'; choose two"):
        as_cloud(in_space.assign(w=1.0)[["w", "x", "y", "z"]])
    mixed = in_space.assign(name="a")
    with pytest.raises(
        CloudShapeError, match=r"'name'; choose three columns: df\[\['x', 'y', 'z'\]\]"
    ):
        as_cloud(mixed)
    with pytest.raises(CloudShapeError, match="got 'x'; choose"):
        as_cloud(pandas.DataFrame({"x": [1.0]}))


def test_names_the_missing_rows_of_a_frame():
    pandas = pytest.importorskip("pandas")
    frame = pandas.DataFrame({"x": [0.0, 1.0], "y": [1.0, None]})
    with pytest.raises(NonFiniteError, match="row 1"):
        am.filtration(frame)
    with pytest.raises(CloudError, match="row 1"):
        am.filtration(frame.astype("Float64"))
    with pytest.raises(CoordinateRangeError, match="row 0"):
        as_cloud(pandas.DataFrame({"x": [2**53 + 1], "y": [0]}))


# What the core refuses


@pytest.mark.parametrize("build", [am.filtration, am.delaunay, am.AlphaComplex])
def test_names_the_rows_that_are_not_finite(build):
    points = np.ones((10, 2))
    points[[2, 7], [0, 1]] = np.nan
    points[4, 0] = -np.inf
    with pytest.raises(NonFiniteError, match=r"rows 2, 4, 7 of 10.*isfinite") as caught:
        build(points)
    assert caught.value.rows == (2, 4, 7)
    assert np.isnan(points[2, 0])


@pytest.mark.parametrize("build", [am.filtration, am.delaunay, am.AlphaComplex])
def test_names_the_rows_that_are_too_small(build):
    points = np.full((6, 2), 1e100)
    points[3] = 1e-100, 1e100
    with pytest.raises(CoordinateRangeError, match=r"row 3 of 6, beside 1e\+100") as caught:
        build(points)
    assert caught.value.rows == (3,)
    advised = float(str(caught.value).split("points[abs(points) < ")[1].split("]")[0])
    points[abs(points) < advised] = 0
    assert len(build(points).points) == 6


@pytest.mark.parametrize("build", [am.filtration, am.delaunay, am.AlphaComplex])
def test_names_the_rows_that_are_too_large(build):
    points = np.ones((6, 2))
    points[5] = 1e200, 0
    with pytest.raises(
        CoordinateRangeError, match=r"row 5 of 6, up to 1e\+200.*drop"
    ) as caught:
        build(points)
    assert caught.value.rows == (5,)


@given(strategies.beyond_range())
@example(np.array([[0, 2.0**600], [2.0**-600, 0]]))
@example(np.array([[0, 2.0**600], [0, 0], [2.0**-600, 0]]))
def test_each_cloud_beyond_the_range_is_refused_with_its_rows(points):
    with pytest.raises(CoordinateRangeError) as caught:
        am.filtration(points)
    named = list(caught.value.rows)
    assert named
    # Without all rows of that kind there is nothing to refuse.
    sizes = np.abs(points)
    if "too small" in str(caught.value):
        kept = points[(sizes >= sizes.max() * 2.0**-437).all(axis=1)]
    else:
        kept = points[(sizes < sizes[named].max(axis=1).min()).all(axis=1)]
    assert am.filtration(kept).points.shape == kept.shape


@pytest.mark.parametrize("exponent", [-500, 0, 500])
def test_the_range_ends_where_it_says(exponent):
    scale = 2.0**exponent
    last = [[scale, 0], [scale * 2.0**-489, scale], [0, 3 * scale / 4]]
    assert len(am.filtration(last).simplices[2]) == 1
    beyond = [[scale, 0], [scale * 2.0**-490, scale], [0, 3 * scale / 4]]
    with pytest.raises(CoordinateRangeError, match="too small in row 1 of 3"):
        am.filtration(beyond)
    assert isinstance(coordinate_error(np.array(beyond)), CoordinateRangeError)


def test_filtration_values_beyond_float64_are_refused():
    flat = np.array([[0.0, 0.0], [1e300, 0.0], [2e300, 1e290]])
    with pytest.raises(CoordinateRangeError, match=r"rows 0, 1, 2 .*scale") as caught:
        am.filtration(flat)
    assert caught.value.rows == (0, 1, 2)
    assert np.isfinite(am.filtration(flat * 2.0**-600).radii[2]).all()
