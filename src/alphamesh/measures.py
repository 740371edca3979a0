"""Lengths and areas, accurate for slivers and far from the origin."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from alphamesh._arrays import ComplexArray, FloatArray, IntArray

__all__ = ["kernel_points", "scaled_points", "total_length", "triangle_areas"]

# Relative error that a triangle's area may have before it is computed again.
_TOLERATED = 1e-13
_ROUNDING = np.finfo(np.float64).eps
_SPLITTER = 2.0**27 + 1.0

# If the largest coordinate has such an exponent, no product of two of them, or of their
# last digits, leaves the range of float64: a cloud spans at most 490 binary digits.
_SAFE_EXPONENTS = range(-20, 500)

# Triangles worked on at a time: their coordinates stay in the processor's cache.
_CHUNK = 1 << 15


def scaled_points(points: FloatArray) -> tuple[FloatArray, int]:
    """Return the points over a power of two that makes products safe, and its exponent.

    A power of two rounds nothing; as a rule it is 1.
    """
    exponent = int(np.frexp(np.abs(points).max(initial=0.0))[1])
    if exponent in _SAFE_EXPONENTS:
        return points, 0
    return np.ldexp(points, -exponent), exponent


def kernel_points(points: FloatArray) -> tuple[FloatArray, int]:
    """Return the points over a power of two that makes products of four safe, and its exponent.

    Kernels that take a finished triangulation suppose coordinates below 2**250 whose last
    digits are above 2**-240. A cloud spans at most 490 binary digits, so that it fits.
    """
    sizes = np.abs(points)
    largest = float(sizes.max(initial=0.0))
    least = float(sizes.min(initial=np.inf, where=sizes > 0))
    if largest < 2.0**250 and least >= 2.0**-188:  # also where all are zero
        return points, 0
    # No further than it takes: a radius may be much larger or smaller than the points.
    exponent = int(np.frexp(largest)[1]) - 250
    if exponent < 0:
        exponent = max(exponent, int(np.frexp(least)[1]) + 187)
    return np.ldexp(points, -exponent), exponent


def total_length(points: FloatArray, edges: IntArray) -> float:
    """Return the sum of the lengths of `edges`, in the units of the points."""
    plane = _complex(points)
    with np.errstate(over="ignore"):
        steps = plane.take(edges[:, 1]) - plane.take(edges[:, 0])
        return float(np.hypot(steps.real, steps.imag).sum())


def triangle_areas(points: FloatArray, triangles: IntArray) -> FloatArray:
    """Return the area of each triangle.

    Parameters
    ----------
    points : (n, 2) float64
    triangles : (k, 3) int32

    Returns
    -------
    (k,) float64
        With a relative error of about 1e-13 at most, except for slivers thinner than
        1e-17 of their length. An area beyond the range of float64 becomes infinite or
        zero.
    """
    areas = np.empty(len(triangles))
    points, exponent = scaled_points(points)
    plane = _complex(points)
    for start in range(0, len(triangles), _CHUNK):
        corners = plane.take(triangles[start : start + _CHUNK])
        areas[start : start + _CHUNK] = _doubled_areas(corners)
    with np.errstate(over="ignore", under="ignore"):
        np.ldexp(areas, 2 * exponent - 1, out=areas)
    return areas


def _complex(points: FloatArray) -> ComplexArray:
    """Return the points as complex numbers: one item each, quicker to gather."""
    return np.ascontiguousarray(points).view(np.complex128)[:, 0]


def _doubled_areas(corners: ComplexArray) -> FloatArray:
    """Return twice the area of each triangle, computed again where it cancels."""
    (xa, xb, xc), (ya, yb, yc) = corners.real.T, corners.imag.T
    left, right = (xb - xa) * (yc - ya), (xc - xa) * (yb - ya)
    doubled: FloatArray = np.abs(left - right)
    error = 4 * _ROUNDING * (np.abs(left) + np.abs(right))
    poor = np.flatnonzero(error > _TOLERATED * doubled)
    if len(poor):
        doubled[poor] = _careful_doubled_areas(corners.take(poor, axis=0))
    return doubled


def _careful_doubled_areas(corners: ComplexArray) -> FloatArray:
    """Return twice the area of each triangle, computed with about twice the digits."""
    # From the corner opposite to the longest side, the least cancels.
    a, b, c = corners.T
    base = np.abs([c - b, a - c, b - a]).argmax(axis=0)[:, np.newaxis]
    corners = np.take_along_axis(corners, (base + np.arange(3)) % 3, axis=1)
    (xa, xb, xc), (ya, yb, yc) = corners.real.T, corners.imag.T
    left, left_rest = _product(_difference(xb, xa), _difference(yc, ya))
    right, right_rest = _product(_difference(xc, xa), _difference(yb, ya))
    high, low = _difference(left, right)
    doubled: FloatArray = np.abs(high + (low + (left_rest - right_rest)))
    return doubled


def _difference(a: FloatArray, b: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return ``a - b`` and what its rounding lost (Knuth)."""
    high = a - b
    b_used = a - high
    a_used = high + b_used
    return high, (a - a_used) + (b_used - b)


def _product(
    a: tuple[FloatArray, FloatArray], b: tuple[FloatArray, FloatArray]
) -> tuple[FloatArray, FloatArray]:
    """Return the product of two sums of two floats, as such a sum (Dekker)."""
    high = a[0] * b[0]
    a_top, a_rest = _halves(a[0])
    b_top, b_rest = _halves(b[0])
    lost = ((a_top * b_top - high) + a_top * b_rest + a_rest * b_top) + a_rest * b_rest
    return high, lost + (a[0] * b[1] + a[1] * b[0])


def _halves(a: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the upper and the lower half of the digits of `a`."""
    scaled = _SPLITTER * a
    top = scaled - (scaled - a)
    return top, a - top
