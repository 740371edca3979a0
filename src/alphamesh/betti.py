"""Betti numbers: how many classes are alive at a radius."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from alphamesh._arrays import read_only
from alphamesh.classify import least_text
from alphamesh.errors import ParameterError

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from alphamesh._arrays import CountArray, FloatArray

__all__ = ["StepCurve", "alive_counts", "checked_radii", "steps_of"]


class StepCurve(NamedTuple):
    """A step function of the radius, exact: ``plt.step(*curve, where="post")`` draws it.

    Attributes
    ----------
    radii : (k,) float64
        Ascending, without repeats; the function changes at each but the first.
    values : (k,), (k, 2) or (k, 3) int64
        The value from each radius up to, but not including, the next; the last value
        holds for ever.
    """

    radii: FloatArray
    values: CountArray


def checked_radii(radius: ArrayLike, *, signed: bool = False) -> FloatArray:
    """Return `radius` as a float64 array, or say what is wrong with it.

    Parameters
    ----------
    radius : array-like of float
    signed : bool, default False
        Whether the balls have weights: a negative radius makes them smaller.

    Raises
    ------
    ParameterError
        If a radius is not a real number, or NaN, or negative without weights.
    """
    array = np.asarray(radius)
    if array.dtype.kind not in "iuf":
        raise ParameterError(
            f"a radius must be a number in the units of the points; got {radius!r}"
        )
    radii = array.astype(np.float64)
    wrong = np.isnan(radii) if signed else ~(radii >= 0)  # NaN, too
    if wrong.any():
        raise ParameterError(
            f"a radius must be {least_text(signed=signed)}; got {radii[wrong].flat[0]}"
        )
    return radii


def alive_counts(births: FloatArray, deaths: FloatArray, radii: FloatArray) -> CountArray:
    """Return how many classes are alive at each radius: born by then, not yet dead.

    Parameters
    ----------
    births, deaths : (m,), (l,) float64
        Ascending, each by itself; classes that never die have a birth alone.
    radii : float64 array of any shape

    Returns
    -------
    int64 array of the shape of `radii`
    """
    # Everything that happens does so at a finite radius or not at all.
    born = np.searchsorted(births, radii, side="right")
    dead = np.searchsorted(deaths, radii, side="right")
    return np.asarray(born - dead, dtype=np.int64)


def steps_of(
    values_at: Callable[[FloatArray], CountArray],
    lives: Iterable[tuple[FloatArray, FloatArray]],
    *,
    signed: bool = False,
) -> StepCurve:
    """Return the step function `values_at`, which changes at births and deaths only.

    It starts with 0; with the first birth, if there is one, where radii are `signed`.
    """
    events = [values for life in lives for values in life]
    radii = np.unique(np.concatenate(([0.0], *events)))
    if signed and any(map(len, events)):
        radii = np.unique(np.concatenate(events))
    values = values_at(radii)
    columns = values.reshape(len(radii), values.size // len(radii))
    kept = np.append(True, (np.diff(columns, axis=0) != 0).any(axis=1))
    return StepCurve(read_only(radii.compress(kept)), read_only(values.compress(kept, axis=0)))
