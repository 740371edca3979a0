"""A cloud: whatever holds points becomes one clean array, or an error that says why not.

This is the only place where input is coerced. Nothing is rounded on the way: a number
that float64 cannot hold is refused, with its row.
"""

from __future__ import annotations

import os
import warnings
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from alphamesh import _coercion, _geopoints
from alphamesh._arrays import Record, read_only
from alphamesh._weights import as_weights
from alphamesh.errors import (
    CloudError,
    CoordinateRangeError,
    GeographicCoordinatesWarning,
    NonFiniteError,
    rows_text,
    user_stacklevel,
)
from alphamesh.table import PointTable

if TYPE_CHECKING:
    from alphamesh._arrays import FloatArray, IntArray

__all__ = [
    "Cloud",
    "as_cloud",
    "at_positions",
    "births_of_rows",
    "coordinate_error",
    "last_digits",
    "merged_rows",
    "refuse_overflow",
    "tiny_queries",
    "warn_of_degrees",
]

_FLOAT64 = np.dtype(np.float64)

# The core's exact sums reach from a power of the largest coordinate, higher in space, down
# to that power of the last binary digit of the smallest one; so many binary digits fit in
# between.
_EXPONENT_RANGES = {2: 490, 3: 325}
_WEIGHTED_RANGE = 325


@dataclass(frozen=True, slots=True, eq=False)
class Cloud(Record):
    """Points in the plane or in space, ready for the core.

    Attributes
    ----------
    points : (n, 2) or (n, 3) float64
        Read-only, C-contiguous and nobody else's: row i is point i everywhere.
        Whether all numbers are finite is seen by the core, which reads them anyway.
    crs : pyproj.CRS or None
        The coordinate reference system that came with the points; nothing is computed
        with it.
    weights : (n,) float64 or None
        Squared radii of the balls around the points, of any sign, in squared units of the
        points; None for balls of equal size.
    """

    points: FloatArray
    crs: Any = None
    weights: FloatArray | None = None

    def __len__(self) -> int:
        return len(self.points)


def as_cloud(points: Any, dimension: int | None = None, weights: Any = None) -> Cloud:
    """Return `points` as a cloud: a private copy, so that later changes do not reach it.

    Parameters
    ----------
    points : array-like of shape (n, 2) or (n, 3), DataFrame of so many columns, or Cloud
        Anything that NumPy understands as real numbers: integers, floats of any size,
        lists, objects with ``__array__``. No point at all is ``numpy.empty((0, 2))`` in
        the plane and ``numpy.empty((0, 3))`` in space. Or a PointTable; a GeoDataFrame or
        GeoSeries of Points; shapely Points; one MultiPoint.
    dimension : {2, 3}, optional
        Take clouds of so many columns alone; by default, both. Of geometries, elevations
        are left out unless it is 3.
    weights : array-like of shape (n,), optional
        One finite number for each point; by default those of `points` if it is a Cloud,
        else none.

    Returns
    -------
    Cloud

    Raises
    ------
    CloudShapeError
        If it is not such a table of real numbers: another shape, rows of unequal length,
        text, missing values, complex numbers.
    CoordinateRangeError
        If a number cannot be held exactly, such as the integer ``2**53 + 1``.
    WeightsError
        If there is not one finite weight for each point; the message names the rows.
    """
    cloud = _cloud(points, dimension)
    if weights is None:
        return cloud
    return Cloud(cloud.points, cloud.crs, as_weights(weights, len(cloud)))


def _cloud(points: Any, dimension: int | None) -> Cloud:
    """Return `points` as a cloud, with the weights that they came with."""
    allowed = (2, 3) if dimension is None else (dimension,)
    if type(points) is np.ndarray and points.dtype == _FLOAT64:
        if points.ndim == 2 and points.shape[1] in allowed:
            return Cloud(read_only(np.array(points, order="C")))
    elif isinstance(points, Cloud):
        if points.points.shape[1] in allowed:
            return points
        points = points.points
    elif isinstance(points, PointTable):
        return Cloud(_cloud(points.points, dimension).points, points.crs)
    elif isinstance(points, str | bytes | os.PathLike):
        raise _coercion.path_error(points)
    elif _geopoints.holds_geometries(points):
        places = _geopoints.point_table(points, dimension or 2)
        return Cloud(read_only(places), _geopoints.crs_of(points))
    return Cloud(read_only(_coercion.table_of_floats(points, dimension)))


def warn_of_degrees(cloud: Cloud) -> None:
    """Warn that a radius has no meaning among longitudes and latitudes.

    Warns
    -----
    GeographicCoordinatesWarning
        If the reference system of the cloud is a geographic one.
    """
    if not getattr(cloud.crs, "is_geographic", False):
        return
    warnings.warn(
        f"the points are longitudes and latitudes ({cloud.crs.name}): a radius in degrees is "
        "a shorter way east than north, and areas are no areas; project them first: "
        "frame.to_crs(frame.estimate_utm_crs()), or an equal-area system of your country",
        GeographicCoordinatesWarning,
        stacklevel=user_stacklevel(),
    )


def coordinate_error(points: FloatArray, weights: FloatArray | None = None) -> CloudError:
    """Return the error for a cloud that the core has refused: which rows, and what to do.

    Parameters
    ----------
    points : (n, 2) or (n, 3) float64
    weights : (n,) float64, optional
        Finite.

    Returns
    -------
    NonFiniteError or CoordinateRangeError
    """
    rows = np.flatnonzero(~np.isfinite(points).all(axis=1))
    if len(rows):
        return NonFiniteError(
            f"NaN or infinite coordinates in {rows_text(rows[:6], total=len(rows))} of "
            f"{len(points):,}; drop them with points[numpy.isfinite(points).all(axis=1)]",
            rows=rows[:6],
        )
    return _range_error(points) if weights is None else _weight_range_error(points, weights)


def tiny_queries(points: FloatArray, queries: FloatArray) -> CoordinateRangeError:
    """Return the error for queries whose last digits lie below those that sums can hold.

    Parameters
    ----------
    points : (n, 2) or (n, 3) float64
    queries : (q, 2) or (q, 3) float64
        Not beyond the points.
    """
    digits = _EXPONENT_RANGES[points.shape[1]]
    # Any number of at least this size has all of its 53 digits within the range.
    safe = float(np.ldexp(np.abs(points).max(), 53 - digits))
    sizes = np.abs(queries)
    rows = np.flatnonzero(((sizes > 0) & (sizes < safe)).any(axis=1))
    return CoordinateRangeError(
        "coordinates too small beside the points for exact arithmetic in "
        f"{rows_text(rows[:6], total=len(rows))} of the queries; set them to zero: "
        f"queries[abs(queries) < {safe:.3g}] = 0",
        rows=rows[:6],
    )


def merged_rows(representative: IntArray | None, count: int) -> tuple[IntArray, IntArray]:
    """Return the representative of each row, and the rows that stand for themselves.

    Parameters
    ----------
    representative : (n,) int32 or None
        From the core; None if all points are distinct.
    count : int
    """
    rows = read_only(np.arange(count, dtype=np.int32))
    if representative is None:
        return rows, rows
    return representative, read_only(rows[representative == rows])


def at_positions(pairs: IntArray, vertices: IntArray, count: int) -> IntArray:
    """Return pairs whose first numbers are rows of points with positions in their place.

    Parameters
    ----------
    pairs : (k, 2) int32
        From the core, to which duplicates have numbers, too.
    vertices : (m, 1) int32
        The rows that stand for themselves, ascending.
    count : int
        How many points there are, duplicates and all.
    """
    if len(vertices) == count:
        return pairs
    moved = pairs.copy()
    moved[:, 0] = np.searchsorted(vertices[:, 0], moved[:, 0])
    return read_only(moved)


def births_of_rows(
    weights: FloatArray | None, vertices: IntArray, radii: FloatArray, count: int
) -> FloatArray | None:
    """Return when each row of points joins the complex; None if all do at once, at 0.

    Parameters
    ----------
    weights : (n,) float64 or None
    vertices : (m, 1) int32
        Rows of points.
    radii : (m,) float64
        Values of `vertices`.
    count : int
        How many points there are, hidden and all.

    Returns
    -------
    (n,) float64 or None
        Never, infinity, where a row is no vertex.
    """
    if weights is None:
        return None
    births = np.full(count, np.inf)
    births[vertices[:, 0]] = radii
    return read_only(births)


_ROUND = {
    2: ("segment between", "far from one another"),
    3: ("circle through", "nearly on one line and far from one another"),
    4: ("sphere through", "nearly in one plane and far from one another"),
}


def refuse_overflow(simplices: IntArray, radii: FloatArray) -> None:
    """Refuse values beyond float64: those of nearly flat simplices of far-apart points."""
    if len(radii) and np.maximum.reduce(radii) == np.inf:
        rows = simplices[int(np.argmax(radii))]
        listed = ", ".join(str(row) for row in rows)
        figure, fault = _ROUND[len(rows)]
        raise CoordinateRangeError(
            f"the {figure} rows {listed} is too large for float64: the points are {fault}; "
            "scale the coordinates down, for example points * 2.0**-600",
            rows=rows,
        )


def _range_error(points: FloatArray, digits: int | None = None) -> CoordinateRangeError:
    """Name the rows that are too small beside the others, or too large if these are fewer."""
    sizes, digits = np.abs(points), digits or _EXPONENT_RANGES[points.shape[1]]
    used = sizes > 0
    first = np.where(used, np.frexp(sizes)[1], np.iinfo(np.int32).min)
    last = np.where(used, last_digits(sizes), np.iinfo(np.int32).max)
    tiny = np.flatnonzero((int(first.max()) - last > digits).any(axis=1))
    huge = np.flatnonzero((first - int(last.min()) > digits).any(axis=1))
    largest = float(sizes.max())
    if len(huge) < len(tiny):
        return CoordinateRangeError(
            "coordinates too far apart in scale for exact arithmetic: too large in "
            f"{rows_text(huge[:6], total=len(huge))} of {len(points):,}, up to {largest:.6g}; "
            "if they stand for missing values, drop these rows; else set the tiny "
            "coordinates of the others to zero",
            rows=huge[:6],
        )
    # Any number of at least this size has all of its 53 digits within the range.
    safe = float(np.ldexp(largest, 53 - digits))
    return CoordinateRangeError(
        "coordinates too far apart in scale for exact arithmetic: too small in "
        f"{rows_text(tiny[:6], total=len(tiny))} of {len(points):,}, beside {largest:.6g}; "
        f"if they are noise, set them to zero: points[abs(points) < {safe:.3g}] = 0",
        rows=tiny[:6],
    )


def _weight_range_error(points: FloatArray, weights: FloatArray) -> CoordinateRangeError:
    """Name the weights that are too large or too small beside the points, or the points."""
    digits = _WEIGHTED_RANGE
    sizes, masses = np.abs(points), np.abs(weights)
    top, bottom = _digits_used(sizes)
    if top - bottom > digits:
        return _range_error(points, digits)
    used = masses > 0
    # A weight counts as a coordinate squared does: its digits are half as far from 1.
    first, last = np.frexp(masses)[1], last_digits(masses)
    huge = np.flatnonzero(used & (first > 2 * (bottom + digits)))
    if len(huge):
        return CoordinateRangeError(
            "weights too large beside the points for exact arithmetic in "
            f"{rows_text(huge[:6], total=len(huge))} of {len(points):,}, up to "
            f"{masses.max():.6g}; a weight is a squared radius, in squared units of the points",
            rows=huge[:6],
        )
    top = max(top, (int(first.max(where=used, initial=2 * top)) + 1) // 2)
    tiny = np.flatnonzero(used & (last < 2 * (top - digits)))
    tiny = (
        tiny if len(tiny) else np.flatnonzero(used & (last == last.min(where=used, initial=0)))
    )
    # Any number of at least this size has all of its 53 digits within the range.
    safe = float(np.ldexp(1.0, 2 * (top - digits) + 53))
    return CoordinateRangeError(
        "weights too small beside the points or beside one another for exact arithmetic in "
        f"{rows_text(tiny[:6], total=len(tiny))} of {len(points):,}; set them to zero: "
        f"weights[abs(weights) < {safe:.3g}] = 0",
        rows=tiny[:6],
    )


def _digits_used(magnitudes: FloatArray) -> tuple[int, int]:
    """Return the exponents of the first and of the last binary digit of some numbers."""
    used = magnitudes[magnitudes > 0]
    if len(used) == 0:
        return 0, 0
    return int(np.frexp(used.max())[1]), int(last_digits(used).min())


def last_digits(magnitudes: FloatArray) -> np.ndarray[Any, np.dtype[np.int64]]:
    """Return the exponent of the last binary digit that is set in each number (0 of 0)."""
    mantissas, exponents = np.frexp(magnitudes)
    integers = np.ldexp(mantissas, 53).astype(np.int64)
    lowest = np.maximum(integers & -integers, 1).astype(np.float64)
    last: np.ndarray[Any, np.dtype[np.int64]] = (
        exponents.astype(np.int64) - 53 + np.frexp(lowest)[1] - 1
    )
    return last
