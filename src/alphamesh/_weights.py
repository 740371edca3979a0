"""Weights: squared radii of balls, and the signed roots that stand for squared radii."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from alphamesh import _coercion
from alphamesh._arrays import read_only
from alphamesh.errors import UnweightedOnlyError, WeightsError, rows_text

if TYPE_CHECKING:
    from alphamesh._arrays import FloatArray, IntArray

__all__ = [
    "as_weights",
    "equal_weight",
    "has_weights",
    "hidden_text",
    "nothing_hidden",
    "refuse_weights",
    "shifted_radii",
    "signed_root",
    "signed_square",
]

_OMIT = "leave weights out for balls of equal size"


def as_weights(weights: Any, count: int) -> FloatArray:
    """Return weights as a private table of finite floats, one for each point.

    Parameters
    ----------
    weights : array-like of shape (count,)
        Squared radii of balls, of any sign, in squared units of the points.
    count : int
        How many points there are.

    Returns
    -------
    (count,) float64
        Read-only.

    Raises
    ------
    WeightsError
        If there is not one for each point, or some are no finite numbers, or float64
        cannot hold them; the message names the rows.
    """
    if isinstance(weights, np.ma.MaskedArray):
        masked = np.flatnonzero(np.ma.getmaskarray(weights))
        if len(masked):
            raise _wrong_rows("masked weights", masked)
        weights = weights.data
    try:
        array = np.asarray(weights)
    except ValueError as error:
        raise WeightsError(f"weights must be one number for each point; {_OMIT}") from error
    if array.shape != (count,):
        raise _shape_error(array, count)
    if array.dtype.kind not in "iufO":
        raise WeightsError(
            f"weights must be numbers, squared radii of balls; got values of type {array.dtype}"
        )
    floats = _floats(array)
    wrong = np.flatnonzero(~np.isfinite(floats))
    if len(wrong):
        raise _wrong_rows("NaN or infinite weights", wrong)
    return read_only(floats)


def _shape_error(array: np.ndarray[Any, Any], count: int) -> WeightsError:
    if array.ndim == 0 and array.dtype.kind in "US":
        return WeightsError(
            f"weights must be numbers, not the name {array.item()!r} of a column; give the "
            f"column itself: table[{array.item()!r}]"
        )
    if array.ndim == 0:
        remedy = f"weights=numpy.full({count}, {array.item()!r})"
        return WeightsError(f"weights must be one number for each point: {remedy}, or {_OMIT}")
    if array.ndim == 1:
        return WeightsError(
            f"there must be one weight for each of the {count:,} points; got {len(array):,}"
        )
    flat = "; make them flat with weights.ravel()" if array.size == count else ""
    return WeightsError(f"weights must have shape ({count},); got {array.shape}{flat}")


def _floats(array: np.ndarray[Any, Any]) -> FloatArray:
    """Return the same numbers as float64; refuse what is none, and what it would round."""
    if array.dtype.kind == "O":
        kept = np.array([_coercion._is_real(value) for value in array], dtype=bool)
        if not kept.all():
            raise _wrong_rows("weights that are not numbers", np.flatnonzero(~kept))
        floats, same = _coercion._floats_of_objects(array)
    else:
        with np.errstate(over="ignore"):
            floats = np.array(array, dtype=np.float64)
        if array.dtype.kind in "iu":
            same = _coercion._integers_fit(array)
        else:
            same = (floats == array) | np.isnan(array)
    if not same.all():
        raise _wrong_rows("weights that float64 would round", np.flatnonzero(~same))
    return floats


def _wrong_rows(fault: str, rows: np.ndarray[Any, Any]) -> WeightsError:
    return WeightsError(
        f"{fault} in {rows_text(rows[:6], total=len(rows))}; drop or mend these rows",
        rows=rows[:6],
    )


def has_weights(weights: FloatArray | None) -> bool:
    """Return whether there are weights other than zero, which change nothing."""
    return weights is not None and bool(weights.any())


def refuse_weights(weights: FloatArray | None, what: str, remedy: str) -> None:
    """Raise if there are weights other than zero.

    Parameters
    ----------
    weights : (n,) float64 or None
    what : str
        What is not there for them, in the plural.
    remedy : str

    Raises
    ------
    UnweightedOnlyError
    """
    if has_weights(weights):
        raise UnweightedOnlyError(f"{what} are there for balls of equal size alone; {remedy}")


def nothing_hidden() -> IntArray:
    """Return the rows that are hidden in a cloud without weights: none."""
    return read_only(np.empty(0, dtype=np.int32))


def hidden_text(hidden: IntArray) -> str:
    """Return ``", 12 hidden points"``, or nothing if there are none."""
    if len(hidden) == 0:
        return ""
    return f", {len(hidden):,} hidden point{'s' if len(hidden) > 1 else ''}"


def equal_weight(weights: FloatArray) -> float | None:
    """Return the weight that all points have, if they have the same; 0 if there is none."""
    if len(weights) == 0:
        return 0.0
    first = float(weights[0])
    return first if bool((weights == first).all()) else None


def signed_root(values: FloatArray) -> FloatArray:
    """Return ``sign(a) * sqrt(|a|)`` of each power value: the radius that stands for it."""
    return np.copysign(np.sqrt(np.abs(values)), values) + 0.0  # no negative zero


def signed_square(radii: FloatArray) -> FloatArray:
    """Return the power value that each radius, a signed root, stands for."""
    with np.errstate(over="ignore", under="ignore"):
        return np.asarray(np.copysign(np.square(radii), radii) + 0.0)


def shifted_radii(radii: FloatArray, weight: float) -> FloatArray:
    """Return the radii of a complex whose balls all have the same weight.

    Parameters
    ----------
    radii : (m,) float64
        Those without weights.
    weight : float

    Returns
    -------
    (m,) float64
        Signed roots of ``radii**2 - weight``; the radii themselves if it is 0.
    """
    if weight == 0.0:
        return radii
    largest = max(float(radii.max(initial=0.0)), float(np.sqrt(abs(weight))))
    # A power of two rounds nothing, and squares of what it leaves cannot overflow.
    exponent = int(np.frexp(largest)[1])
    with np.errstate(under="ignore"):
        scaled = np.square(np.ldexp(radii, -exponent))
        values = scaled - np.ldexp(weight, -2 * exponent)
        return read_only(np.ldexp(signed_root(values), exponent))
