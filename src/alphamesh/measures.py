"""Lengths, areas and volumes, accurate for slivers and far from the origin."""

from __future__ import annotations

import math
from fractions import Fraction
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from alphamesh._arrays import read_only
from alphamesh.errors import ParameterError

if TYPE_CHECKING:
    from alphamesh._arrays import ComplexArray, FloatArray, IntArray

__all__ = [
    "edge_lengths",
    "kernel_balls",
    "kernel_points",
    "rescaled",
    "scaled_points",
    "scaled_radius",
    "tetrahedron_volumes",
    "total_length",
    "triangle_areas",
]

# A sum of two floats, the second a correction to the first.
Pair: TypeAlias = "tuple[FloatArray, FloatArray]"

# Relative error that an area or a volume may have before it is computed again.
_TOLERATED = 1e-13
_ROUNDING = np.finfo(np.float64).eps
_SPLITTER = 2.0**27 + 1.0

# If the largest coordinate has such an exponent, no product of two of them, or of their
# last digits, leaves the range of float64: a cloud spans at most 490 binary digits.
_SAFE_EXPONENTS = range(-20, 500)

# Of products below this, some digits may have been lost among subnormal numbers.
_SMALL = 2.0**-900

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


def kernel_balls(
    points: FloatArray, weights: FloatArray | None
) -> tuple[FloatArray, FloatArray | None, int]:
    """Return points and weights as `kernel_points` does, and the exponent of the power of two.

    With weights, kernels suppose coordinates, and roots of weights, below 2**165 whose last
    digits are above 2**-160: they take products of more factors.
    """
    if weights is None:
        scaled, exponent = kernel_points(points)
        return scaled, None, exponent
    sizes = np.concatenate((np.abs(points).ravel(), np.sqrt(np.abs(weights))))
    largest = float(sizes.max(initial=0.0))
    least = float(sizes.min(initial=np.inf, where=sizes > 0))
    if largest < 2.0**164 and least >= 2.0**-106:
        return points, weights, 0
    exponent = int(np.frexp(largest)[1]) - 164
    if exponent < 0:
        exponent = max(exponent, int(np.frexp(least)[1]) + 105)
    return np.ldexp(points, -exponent), np.ldexp(weights, -2 * exponent), exponent


def rescaled(array: FloatArray, exponent: int) -> FloatArray:
    """Return `array` times a power of two; what leaves the range becomes 0 or infinite."""
    if exponent == 0:
        return array
    with np.errstate(over="ignore", under="ignore"):
        return read_only(np.ldexp(array, exponent))


def scaled_radius(radius: float, exponent: int) -> float:
    """Return the radius over a power of two."""
    try:
        return math.ldexp(radius, -exponent)
    except OverflowError:
        raise ParameterError(
            f"a radius of {radius:.6g} is too large beside coordinates as small as these; "
            "scale the points up"
        ) from None


def edge_lengths(points: FloatArray, edges: IntArray) -> FloatArray:
    """Return the length of each edge, ``(k,)`` float64, in the units of the points."""
    lengths = np.zeros(len(edges))
    ends = points.take(edges, axis=0)
    with np.errstate(over="ignore"):
        for start, end in ends.transpose(2, 1, 0):
            np.hypot(lengths, end - start, out=lengths)
    return lengths


def total_length(points: FloatArray, edges: IntArray) -> float:
    """Return the sum of the lengths of `edges`, in the units of the points."""
    with np.errstate(over="ignore"):
        return float(edge_lengths(points, edges).sum())


def triangle_areas(points: FloatArray, triangles: IntArray) -> FloatArray:
    """Return the area of each triangle.

    Parameters
    ----------
    points : (n, 2) or (n, 3) float64
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
    plane = _complex(points) if points.shape[1] == 2 else None
    for start in range(0, len(triangles), _CHUNK):
        part = slice(start, start + _CHUNK)
        if plane is not None:
            areas[part] = _doubled_areas(plane.take(triangles[part]))
        else:
            areas[part] = _doubled_areas_in_space(points.take(triangles[part], axis=0))
    with np.errstate(over="ignore", under="ignore"):
        np.ldexp(areas, 2 * exponent - 1, out=areas)
    return areas


def tetrahedron_volumes(points: FloatArray, tetrahedra: IntArray) -> FloatArray:
    """Return the volume of each tetrahedron.

    Parameters
    ----------
    points : (n, 3) float64
    tetrahedra : (k, 4) int32

    Returns
    -------
    (k,) float64
        With a relative error of about 1e-13 at most, however thin they are. A volume
        beyond the range of float64 becomes infinite or zero.
    """
    volumes = np.empty(len(tetrahedra))
    exponent = int(np.frexp(np.abs(points).max(initial=0.0))[1])
    points = np.ldexp(points, -exponent)
    for start in range(0, len(tetrahedra), _CHUNK):
        corners = points.take(tetrahedra[start : start + _CHUNK], axis=0)
        volumes[start : start + _CHUNK] = _sixfold_volumes(corners, exponent) / 6
    return volumes


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


def _difference(a: FloatArray, b: FloatArray) -> Pair:
    """Return ``a - b`` and what its rounding lost (Knuth)."""
    high = a - b
    b_used = a - high
    a_used = high + b_used
    return high, (a - a_used) + (b_used - b)


def _product(a: Pair, b: Pair) -> Pair:
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


# ---------------------------------------------------------------------- in space


def _doubled_areas_in_space(corners: FloatArray) -> FloatArray:
    """Return twice the area of each triangle, computed again where it cancels."""
    u, v = (corners[:, 1] - corners[:, 0]).T, (corners[:, 2] - corners[:, 0]).T
    doubled, error = np.zeros(len(corners)), np.zeros(len(corners))
    for j, k in ((1, 2), (2, 0), (0, 1)):
        left, right = u[j] * v[k], u[k] * v[j]
        doubled = np.hypot(doubled, left - right)
        error += np.abs(left) + np.abs(right)
    poor = np.flatnonzero(4 * _ROUNDING * error > _TOLERATED * doubled)
    if len(poor):
        doubled[poor] = 0.0
        plane = np.empty((len(poor), 3), dtype=np.complex128)
        for j, k in ((1, 2), (2, 0), (0, 1)):
            plane.real, plane.imag = corners[poor, :, j], corners[poor, :, k]
            doubled[poor] = np.hypot(doubled[poor], _careful_doubled_areas(plane))
    return doubled


def _sixfold_volumes(corners: FloatArray, exponent: int) -> FloatArray:
    """Return six times the volume of each tetrahedron, times ``8**exponent``."""
    u, v, w = (np.ascontiguousarray((corners[:, k] - corners[:, 0]).T) for k in (1, 2, 3))
    sixfold, size = np.zeros(len(corners)), np.zeros(len(corners))
    for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        left, right = v[j] * w[k], v[k] * w[j]
        sixfold += u[i] * (left - right)
        size += np.abs(u[i]) * (np.abs(left) + np.abs(right))
    np.abs(sixfold, out=sixfold)
    poor = np.flatnonzero((8 * _ROUNDING * size > _TOLERATED * sixfold) | (size < _SMALL))
    with np.errstate(over="ignore", under="ignore"):
        np.ldexp(sixfold, 3 * exponent, out=sixfold)
        if len(poor):
            sixfold[poor] = _careful_sixfold_volumes(corners.take(poor, axis=0), exponent)
    return sixfold


def _careful_sixfold_volumes(corners: FloatArray, exponent: int) -> FloatArray:
    """Return six times the volumes, computed with twice the digits, or else exactly."""
    sides = [_difference(corners[:, k], corners[:, 0]) for k in (1, 2, 3)]
    # Each tetrahedron over its own power of two: products of three would be too small.
    size = np.max([np.abs(high).max(axis=1) for high, _ in sides], axis=0)
    own = np.frexp(size)[1]
    u, v, w = (
        [(np.ldexp(high[:, k], -own), np.ldexp(low[:, k], -own)) for k in range(3)]
        for high, low in sides
    )
    total, most = (np.zeros(len(own)), np.zeros(len(own))), np.zeros(len(own))
    for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        left, right = _product(v[j], w[k]), _product(v[k], w[j])
        total = _sum(total, _product(u[i], _sum(left, (-right[0], -right[1]))))
        most += np.abs(u[i][0]) * (np.abs(left[0]) + np.abs(right[0]))
    sixfold: FloatArray = np.ldexp(np.abs(total[0] + total[1]), 3 * (own + exponent))
    doubt = 64 * _ROUNDING**2 * most
    for row in np.flatnonzero(~(doubt <= _TOLERATED * np.abs(total[0])) | (most < _SMALL)):
        sixfold[row] = _exact_sixfold_volume(corners[row], exponent)
    return sixfold


def _exact_sixfold_volume(corners: FloatArray, exponent: int) -> float:
    """Return six times the volume of one tetrahedron, rounded once."""
    a, *others = ([Fraction(x) for x in corner] for corner in corners.tolist())
    u, v, w = ([x - y for x, y in zip(corner, a, strict=True)] for corner in others)
    value = Fraction(0)
    for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        value += u[i] * (v[j] * w[k] - v[k] * w[j])
    try:
        return float(abs(value) * Fraction(8) ** exponent)
    except OverflowError:
        return float("inf")


def _sum(a: Pair, b: Pair) -> Pair:
    """Return the sum of two sums of two floats, as such a sum."""
    high, low = _difference(a[0], -b[0])
    return _difference(high, -(low + (a[1] + b[1])))
