"""Balls at a radius: which of their simplices there are, and what they measure together."""

from __future__ import annotations

import math
from numbers import Real
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from alphamesh._arrays import read_only
from alphamesh._kernels.unions import Centres, measured_union
from alphamesh.errors import ParameterError

if TYPE_CHECKING:
    from typing import TypeAlias

    from alphamesh._arrays import BoolArray, CountArray, FloatArray, IntArray
    from alphamesh._kernels import Progress
    from alphamesh._kernels.unions import Pieces
    from alphamesh.filtration import AnyFiltration
    from alphamesh.periodic import PeriodicFiltration

    Balls: TypeAlias = AnyFiltration | PeriodicFiltration

__all__ = [
    "Measured",
    "ball_radii",
    "chosen_holes",
    "finite_radius",
    "largest_first",
    "measured",
    "present",
    "rescaled",
    "scaled",
    "scaled_squares",
    "unscaled",
]

# Coordinates that the kernels take as they are, and to which size they bring others. So
# neither a product of four lengths nor one of two areas leaves the range of float64.
_LARGEST, _LEAST = {2: 2.0**249, 3: 2.0**100}, {2: 2.0**-188, 3: 2.0**-100}
_SCALED_TO = {2: 249, 3: 164}
_LARGEST_RADIUS = 2.0**250

# Squared values that differ by less, as a share of the largest square, may be in the wrong
# order: several times what rounding can do to them.
_CLOSE = 2e-12


def finite_radius(radius: object, filtration: Balls) -> float:
    """Return `radius` as a float, or say what is wrong with it."""
    if isinstance(radius, Real) and math.isfinite(value := float(radius)):
        if value >= 0 or filtration.weights is not None:
            return value
        raise ParameterError(
            f"radius must be 0 or more where the points have no weights; got {radius!r}"
        )
    raise ParameterError(
        f"radius must be a finite number, in the units of the points; got {radius!r}"
    )


def ball_radii(weights: FloatArray | None, radius: float, count: int) -> FloatArray:
    """Return ``sqrt(weights + radius**2)`` of each ball, 0 where there is none."""
    if weights is None:
        return read_only(np.full(count, max(0.0, radius)))
    exponent = math.frexp(max(abs(radius), _root(np.abs(weights).max(initial=0.0))))[1]
    squares = np.ldexp(weights, -2 * exponent) + _power(math.ldexp(radius, -exponent))
    return read_only(np.ldexp(np.sqrt(np.maximum(squares, 0.0)), exponent))


def present(filtration: Balls, radius: float) -> tuple[BoolArray, ...]:
    """Return which rows and which simplices of each higher dimension there are at `radius`."""
    last = _settled(filtration, radius)
    vertex = np.zeros(len(filtration.points), dtype=np.bool_)
    vertex[filtration.simplices[0][:, 0]] = filtration.radii[0] <= last
    return vertex, *(radii <= last for radii in filtration.radii[1:])


def _settled(filtration: Balls, radius: float) -> float:
    """Return the value from `radius` on after which none follows too closely.

    Values carry rounding errors. Of two that hardly differ, the larger may truly be the
    smaller one, and the complex at a radius in between not that of any union; the one
    that has both differs from the true one by simplices that hardly matter.
    """
    weights = filtration.weights
    # Balls that are far from there, for their weight, do not matter.
    heaviest = 0.0 if weights is None else float(weights.max(initial=0.0))
    last, found = radius, True
    while found:
        found = False
        scale = max(abs(last), _root(heaviest))
        # Over the scale: no square leaves the range of float64.
        power = _power(last / scale) + _CLOSE if scale else 0.0
        limit = scale * math.copysign(_root(abs(power)), power)
        for radii in filtration.radii[1:]:
            reached = radii <= limit
            if np.count_nonzero(reached) > np.count_nonzero(radii <= last):
                last, found = float(radii[reached].max()), True
    return last


def _root(square: Any) -> float:
    return math.sqrt(float(square))


def _power(radius: float) -> float:
    return math.copysign(radius * radius, radius)


def scaled(filtration: AnyFiltration, radius: float, *, alone: bool) -> tuple[Centres, int]:
    """Return balls whose lengths are divided by a power of two, and its exponent.

    Where all balls are `alone`, only their own size counts, and no point is looked at.
    """
    points, weights = filtration.points, filtration.weights
    dimension = points.shape[1]
    sizes = np.abs(points)
    largest = float(sizes.max(initial=0.0))
    least = float(sizes.min(initial=np.inf, where=sizes > 0))
    span = _largest_radius(weights, radius)
    exponent = 0
    if alone:
        exponent = math.frexp(span)[1]
    elif largest >= _LARGEST[dimension] or least < _LEAST[dimension]:
        exponent = int(np.frexp(largest)[1]) - _SCALED_TO[dimension]
    elif span >= _LARGEST_RADIUS:
        exponent = int(np.frexp(span)[1]) - 250
    if exponent and not alone:
        points = np.ldexp(points, -exponent)
    return Centres(points, *scaled_squares(weights, radius, exponent)), exponent


def _largest_radius(weights: FloatArray | None, radius: float) -> float:
    """Return what no ball is larger than, but for a factor below two."""
    heaviest = 0.0 if weights is None else float(np.abs(weights).max(initial=0.0))
    return max(abs(radius), _root(heaviest))


def scaled_squares(
    weights: FloatArray | None, radius: float, exponent: int
) -> tuple[FloatArray | None, float]:
    """Return weights and the signed square of the radius over ``4**exponent``.

    Raises
    ------
    ParameterError
        If they are too large for that.
    """
    span = _largest_radius(weights, radius)
    if math.frexp(span)[1] - exponent > 250:
        raise ParameterError(
            f"a radius of {span:.6g} is too large beside coordinates as small as these; "
            "scale the points up"
        )
    if weights is not None and exponent:
        weights = np.ldexp(weights, -2 * exponent)
    return weights, _power(math.ldexp(radius, -exponent))


def rescaled(array: FloatArray, exponent: int) -> FloatArray:
    """Return `array` times a power of two; what leaves the range becomes 0 or infinite."""
    if exponent == 0:
        return read_only(array)
    with np.errstate(over="ignore", under="ignore"):
        return read_only(np.ldexp(array, exponent))


def unscaled(value: float, exponent: int) -> float:
    """Return `value` times a power of two, 0 or infinite where that leaves the range."""
    with np.errstate(over="ignore", under="ignore"):
        return float(np.ldexp(value, exponent))


class Measured(NamedTuple):
    """The measures of a union, and of the parts of its complement, `labels` of cells."""

    content: float
    contents: FloatArray
    borders: FloatArray
    labels: IntArray
    hole_contents: FloatArray
    hole_borders: FloatArray


def measured(
    centres: Centres,
    pieces: Pieces,
    exponent: int,
    threads: int | None,
    progress: Progress | None,
) -> Measured:
    """Return the measures of balls whose lengths are divided by ``2**exponent``."""
    content, contents, borders, hole_contents, hole_borders = measured_union(
        centres, pieces, threads, progress
    )
    d = centres.high.shape[1]
    return Measured(
        unscaled(content, d * exponent),
        rescaled(contents, d * exponent),
        rescaled(borders, (d - 1) * exponent),
        pieces.holes,
        rescaled(hole_contents, d * exponent),
        rescaled(hole_borders, (d - 1) * exponent),
    )


def largest_first(sizes: FloatArray, wanted: BoolArray | None = None) -> CountArray:
    """Return numbers of holes, of the `wanted` ones or of all, those of the largest first."""
    order = np.argsort(-sizes, kind="stable")
    return order if wanted is None else order.compress(wanted.take(order))


def chosen_holes(found: Measured, order: CountArray) -> Measured:
    """Return the measures with some of the holes alone, in another order."""
    places = np.full(len(found.hole_contents) + 1, -1, dtype=np.int32)
    places[order] = np.arange(len(order), dtype=np.int32)  # the last one, of -1, stays
    return found._replace(
        labels=read_only(places.take(found.labels)),
        hole_contents=read_only(found.hole_contents.take(order)),
        hole_borders=read_only(found.hole_borders.take(order)),
    )
