"""A periodic box: which directions repeat, where points lie in it, and their copies."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from alphamesh._arrays import Record, read_only
from alphamesh.errors import CoordinateRangeError, PeriodsError, rows_text
from alphamesh.points import coordinate_error, last_digits

if TYPE_CHECKING:
    from alphamesh._arrays import FloatArray, IntArray, KindArray

__all__ = [
    "BoxCloud",
    "Copies",
    "Placed",
    "as_periods",
    "box_cloud",
    "placed",
    "wrapped_points",
]

# Exact sums of products of six coordinates reach from 2^100 each down to 2^-170.
_TOP, _BOTTOM = 100, -170
_THREE = 3


def as_periods(periods: Any, dimension: int) -> tuple[float | None, ...]:
    """Return the side lengths of a box as floats, None for open directions.

    Parameters
    ----------
    periods : sequence of float or None
        One for each coordinate.
    dimension : int

    Raises
    ------
    PeriodsError
        If a period is not a positive, finite number, their number is wrong, or none of the
        directions is periodic.
    """
    if isinstance(periods, str) or not isinstance(periods, Sequence | np.ndarray):
        raise PeriodsError(
            f"periods must be {dimension} side lengths, None for open directions, such as "
            f"{(10.0,) * dimension}; got {periods!r}"
        )
    if len(periods) != dimension:
        raise PeriodsError(
            f"points of {dimension} coordinates need {dimension} periods, None for open "
            f"directions; got {len(periods)}"
        )
    sides = tuple(None if side is None else _side(side) for side in periods)
    if all(side is None for side in sides):
        raise PeriodsError(
            "no direction is periodic; leave `periods` out, or give one side length at least"
        )
    return sides


def _side(side: Any) -> float:
    try:
        length = float(side)
    except (TypeError, ValueError):
        length = math.nan
    if not (math.isfinite(length) and length > 0) or isinstance(side, str | bool):
        raise PeriodsError(
            f"a period must be a positive, finite number, or None for an open direction; "
            f"got {side!r}"
        )
    return length


@dataclass(frozen=True, slots=True, eq=False)
class Copies(Record):
    """Points of a box and their copies near it.

    Attributes
    ----------
    rows : (c,) int32
    offsets : (c, 3) int8
        The copy lies so many periods from the point in the box; zero for the first ones.
    high, low : (c, 3) float64
        Exact coordinates as sums, the first rounded.
    """

    rows: IntArray
    offsets: KindArray
    high: FloatArray
    low: FloatArray


@dataclass(frozen=True, slots=True, eq=False)
class BoxCloud(Record):
    """Points of a periodic box, exactly: point i lies at ``anchors[i] + shifts[i] * periods``.

    Attributes
    ----------
    anchors : (n, 3) float64
        What is left of the coordinates when whole periods are taken away, which is exact;
        the third is zero in the plane. Scaled by ``2**exponent``, as are `periods`.
    shifts : (n, 3) int8
        1 where that is negative, else 0.
    periods : (3,) float64
        Zero where the box is open.
    representative : (n,) int32
        The lowest row of the heaviest that lie at the same place of the box.
    exponent : int
    unit : float
        A power of two that all numbers are multiples of, weights of its square.
    weights : (n,) float64 or None
        Scaled by ``4**exponent``.
    """

    anchors: FloatArray
    shifts: KindArray
    periods: FloatArray
    representative: IntArray
    exponent: int
    unit: float
    weights: FloatArray | None = None

    @property
    def rows(self) -> IntArray:
        """The rows that stand for themselves, ascending, ``(m,)`` int32."""
        rows = np.arange(len(self.representative), dtype=np.int32)
        own: IntArray = rows[self.representative == rows]
        return own

    def copies(self, halo: FloatArray) -> Copies:
        """Return the points and all copies that lie at most `halo` beyond the box.

        Parameters
        ----------
        halo : (3,) float64
            At most the period; that, for all copies in the boxes around.
        """
        rows = self.rows
        anchors, shifts = self.anchors.take(rows, axis=0), self.shifts.take(rows, axis=0)
        wrapped, _ = _two_sum(anchors, shifts * self.periods)
        choices = []
        for k in range(_THREE):
            everywhere = np.ones(len(rows), dtype=bool)
            choices.append([(0, everywhere)])
            if self.periods[k] > 0:
                full = halo[k] >= self.periods[k]
                before = full | (wrapped[:, k] >= self.periods[k] - halo[k])
                behind = full | (wrapped[:, k] <= halo[k])
                choices[k] += [(-1, before), (1, behind)]
        found, offsets = [], []
        for x, in_x in choices[0]:
            for y, in_y in choices[1]:
                for z, in_z in choices[2]:
                    places = np.flatnonzero(in_x & in_y & in_z)
                    found.append(places)
                    moved = np.array([[x, y, z]], dtype=np.int8)
                    offsets.append(np.repeat(moved, len(places), axis=0))
        return self.moved(rows.take(np.concatenate(found)), np.concatenate(offsets))

    def moved(self, rows: IntArray, offsets: KindArray) -> Copies:
        """Return some points, each moved by whole periods.

        Parameters
        ----------
        rows : (c,) int32
        offsets : (c, 3) int8
        """
        place = Placed(self.anchors, self.shifts, self.periods, self.exponent, self.unit)
        return Copies(rows, offsets, *place.at(rows, offsets))


class Placed(NamedTuple):
    """Where points of a box lie, exactly; see :class:`BoxCloud`."""

    anchors: FloatArray
    shifts: KindArray
    periods: FloatArray
    exponent: int
    unit: float

    def at(self, rows: IntArray, offsets: KindArray) -> tuple[FloatArray, FloatArray]:
        """Return copies of points in other boxes, as sums, the first rounded.

        Parameters
        ----------
        rows : (c,) int32
        offsets : (c, 3) int8
            -1, 0 or 1.

        Returns
        -------
        high, low : (c, 3) float64
        """
        multiples = self.shifts.take(rows, axis=0) + offsets
        return _two_sum(self.anchors.take(rows, axis=0), multiples * self.periods)


def placed(points: FloatArray, periods: tuple[float | None, ...]) -> Placed:
    """Put points into a periodic box, without rounding.

    Parameters and errors are those of :func:`box_cloud`.
    """
    if not np.isfinite(points).all():
        raise coordinate_error(points)
    sides = np.array([0.0 if side is None else side for side in periods])
    anchors = np.zeros((len(points), _THREE))
    anchors[:, : len(sides)] = _remainders(points, sides)
    lengths = np.zeros(_THREE)
    lengths[: len(sides)] = sides
    exponent, unit = _scale(anchors, lengths)
    anchors, lengths = np.ldexp(anchors, exponent), np.ldexp(lengths, exponent)
    shifts = ((anchors < 0) & (lengths > 0)).astype(np.int8)
    return Placed(read_only(anchors), read_only(shifts), read_only(lengths), exponent, unit)


def box_cloud(
    points: FloatArray,
    periods: tuple[float | None, ...],
    weights: FloatArray | None = None,
) -> BoxCloud:
    """Put points into a periodic box, without rounding.

    Parameters
    ----------
    points : (n, 2) or (n, 3) float64
    periods : tuple of float or None
        From :func:`as_periods`.
    weights : (n,) float64, optional

    Raises
    ------
    NonFiniteError, CoordinateRangeError
        If coordinates are not finite, or too far apart in scale for exact arithmetic.
    PeriodsError
        If a period is shorter than the last digit of a coordinate.
    """
    anchors, shifts, lengths, exponent, unit = placed(points, periods)
    if weights is not None:
        weights, unit = _scaled_weights(weights, exponent, unit)
    same = _representatives(anchors, shifts * lengths, weights)
    return BoxCloud(anchors, shifts, lengths, same, exponent, unit, weights)


def wrapped_points(points: FloatArray, periods: tuple[float | None, ...]) -> FloatArray:
    """Return where points lie in a periodic box, rounded: from 0 to the period.

    Parameters
    ----------
    points : (n, d) float64
        Finite.
    periods : tuple of float or None
        From :func:`as_periods`.

    Raises
    ------
    PeriodsError
        See :func:`box_cloud`.
    """
    sides = np.array([0.0 if side is None else side for side in periods])
    anchors = _remainders(points, sides)
    places: FloatArray = anchors + (anchors < 0) * sides
    return places


def _remainders(points: FloatArray, sides: FloatArray) -> FloatArray:
    """Return coordinates without whole periods, with their signs; 0 is the side of none."""
    closed = sides > 0
    coarse = (np.abs(points) >= np.ldexp(sides, 52)) & closed
    if coarse.any():
        rows = np.flatnonzero(coarse.any(axis=1))
        raise PeriodsError(
            f"coordinates in {rows_text(rows[:6], total=len(rows))} are so large that their "
            "last digit is more than a period; subtract what they have in common",
            rows=rows[:6],
        )
    return np.where(closed, np.fmod(points, np.where(closed, sides, 1.0)), points)


def _scaled_weights(
    weights: FloatArray, exponent: int, unit: float
) -> tuple[FloatArray, float]:
    """Return weights in scaled units, and a unit whose square they are multiples of."""
    used = weights != 0
    first = np.where(used, np.frexp(weights)[1] + 2 * exponent, 0)
    last = np.where(used, last_digits(np.abs(weights)) + 2 * exponent, 0)
    far = used & ((first > 2 * _TOP) | (last < 2 * _BOTTOM))
    if far.any():
        rows = np.flatnonzero(far)
        raise CoordinateRangeError(
            "weights too large or too small beside the box for exact arithmetic in "
            f"{rows_text(rows[:6], total=len(rows))} of {len(weights):,}; a weight is a "
            "squared radius, in squared units of the points",
            rows=rows[:6],
        )
    half = int(last.min(where=used, initial=0)) // 2
    return read_only(np.ldexp(weights, 2 * exponent)), min(unit, float(np.ldexp(1.0, half)))


def _scale(anchors: FloatArray, lengths: FloatArray) -> tuple[int, float]:
    """Return the exponent that brings all numbers into range, and their common unit."""
    numbers = np.vstack((anchors, lengths))
    used = numbers != 0
    top = int(np.frexp(np.abs(numbers).max())[1])
    last = np.where(used, last_digits(np.abs(numbers)), np.iinfo(np.int32).max)
    bottom = int(last.min())
    if top - bottom > _TOP - _BOTTOM:
        rows = np.flatnonzero((last[:-1] < top - (_TOP - _BOTTOM)).any(axis=1))
        safe = float(np.ldexp(1.0, top - (_TOP - _BOTTOM) + 53))
        raise CoordinateRangeError(
            f"coordinates too small beside the box for exact arithmetic in "
            f"{rows_text(rows[:6], total=len(rows))} of {len(anchors):,}; if they are noise, "
            f"set them to zero: points[abs(points) < {safe:.3g}] = 0",
            rows=rows[:6],
        )
    exponent = 0
    if top > _TOP or bottom < _BOTTOM:
        exponent = _TOP - top
    return exponent, float(np.ldexp(1.0, bottom + exponent))


def _representatives(
    anchors: FloatArray, moves: FloatArray, weights: FloatArray | None
) -> IntArray:
    """Return the lowest row at the same place, of the heaviest there.

    Sums of two numbers in normal form tell places apart.
    """
    high, low = _two_sum(anchors, moves)
    keys = np.hstack((high, low)) if low.any() else high
    keys = keys + 0.0  # no negative zeros
    sorted_by = keys.T if weights is None else np.vstack((-weights, keys.T))
    order = np.lexsort(sorted_by)
    ordered = keys.take(order, axis=0)
    fresh = np.append(True, (ordered[1:] != ordered[:-1]).any(axis=1))
    group = np.cumsum(fresh) - 1
    # A stable sort leaves the lowest row of each group first.
    representative = np.empty(len(order), dtype=np.int32)
    representative[order] = order[np.flatnonzero(fresh)][group]
    return read_only(representative)


def _two_sum(a: FloatArray, b: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return ``a + b`` rounded and the rest, exactly (Knuth 1969)."""
    high = a + b
    part = high - a
    return high, (a - (high - part)) + (b - part)
