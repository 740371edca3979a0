"""One value for several points: means, sums and the like over triangles and regions."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from alphamesh._arrays import read_only
from alphamesh.errors import ParameterError

if TYPE_CHECKING:
    from alphamesh._arrays import BoolArray, CountArray, IntArray

__all__ = ["AGGREGATES", "as_values", "points_by_region", "reduced"]

Values: TypeAlias = "np.ndarray[Any, np.dtype[Any]]"

AGGREGATES = ("mean", "min", "max", "sum", "count", "first")
"""The ways to make one value of several. Missing ones (NaN, NaT, None) do not count."""

_OF_TIMES = ("min", "max", "count", "first")
_OF_ALL = ("count", "first")


def as_values(values: Any, count: int) -> Values:
    """Return one value for each point as an array.

    Raises
    ------
    ParameterError
        If there are not `count` of them.
    """
    array = np.asarray(values)
    if array.shape != (count,):
        raise ParameterError(
            f"values must be one for each of the {count:,} points; got shape {array.shape}"
        )
    return array


def reduced(values: Values, rows: IntArray, offsets: CountArray, how: str) -> Values:
    """Return one value for each group of rows.

    Parameters
    ----------
    values : (n,) array
        Numbers, times or text.
    rows : (k,) int
        Rows of `values`, group after group.
    offsets : (g + 1,) int64
        ``rows[offsets[i]:offsets[i + 1]]`` is group i.
    how : str
        One of :data:`AGGREGATES`.

    Returns
    -------
    (g,) array
        Means are float64 and counts int64; others have the type of `values`. A group
        with missing values alone has a missing one, a sum of 0 and a count of 0.

    Raises
    ------
    ParameterError
        If `how` is unknown, or `values` are of no such kind.
    """
    _check(how, values)
    taken = values.take(rows)
    present = ~_missing(taken)
    if not present.all():
        taken = taken.compress(present)
        offsets = np.append(0, np.cumsum(present))[offsets]
    counts = np.diff(offsets)
    if how == "count":
        return read_only(counts.astype(np.int64))
    some = counts > 0
    starts = offsets[:-1].compress(some)
    if how == "first":
        found = taken.take(starts)
    else:
        found = _REDUCTIONS[how](taken, starts) if len(starts) else taken[:0]
    if how == "mean":
        found = found / counts.compress(some)
    return read_only(_spread(found, some, how))


def _add(values: Values, starts: CountArray) -> Values:
    kind = np.int64 if values.dtype.kind in "bi" else values.dtype
    total: Values = np.add.reduceat(values, starts, dtype=kind)
    return total


def _mean(values: Values, starts: CountArray) -> Values:
    total: Values = np.add.reduceat(values, starts, dtype=np.float64)
    return total


_REDUCTIONS: dict[str, Callable[[Values, CountArray], Values]] = {
    "mean": _mean,
    "sum": _add,
    "min": np.minimum.reduceat,
    "max": np.maximum.reduceat,
}


def _spread(found: Values, some: BoolArray, how: str) -> Values:
    """Return the values at their groups, and missing ones at the others."""
    if some.all():
        return found
    if how == "sum":
        nothing: Any = 0
    else:
        nothing = {"f": np.nan, "m": "NaT", "M": "NaT"}.get(found.dtype.kind)
    kind = found.dtype if nothing is not None else np.dtype(np.object_)
    made = np.full(len(some), nothing, dtype=kind)
    made[some] = found
    return made


def _missing(values: Values) -> BoolArray:
    if values.dtype.kind == "f":
        return np.isnan(values)
    if values.dtype.kind in "mM":
        return np.isnat(values)
    if values.dtype.kind == "O":
        return np.array([_is_missing(value) for value in values], dtype=np.bool_)
    return np.zeros(len(values), dtype=np.bool_)


def _is_missing(value: Any) -> bool:
    """Whether this is None, NaN or what pandas has for them."""
    if value is None or type(value).__name__ in ("NAType", "NaTType"):
        return True
    return isinstance(value, float) and value != value  # noqa: PLR0124


def _check(how: str, values: Values) -> None:
    if how not in AGGREGATES:
        raise ParameterError(
            f"there is no aggregate {how!r}; choose one of {', '.join(AGGREGATES)}"
        )
    kind = values.dtype.kind
    allowed = AGGREGATES if kind in "biuf" else _OF_TIMES if kind in "mM" else _OF_ALL
    if how not in allowed:
        raise ParameterError(
            f"values of type {values.dtype} have no {how}; choose one of {', '.join(allowed)}, "
            "or convert them to numbers"
        )


def points_by_region(
    triangles: IntArray, labels: IntArray, count: int, representative: IntArray
) -> tuple[IntArray, CountArray]:
    """Return the points of each region: the corners of its triangles, duplicates and all.

    Parameters
    ----------
    triangles : (k, 3) int32
    labels : (k,) int32
        The region of each triangle.
    count : int
        How many regions there are.
    representative : (n,) int32
        The lowest row with the coordinates of each row.

    Returns
    -------
    rows : (m,) int64
        Ascending within a region. Where regions touch, a point is in each of them.
    offsets : (count + 1,) int64
    """
    n = len(representative)
    pairs = np.unique(labels.repeat(3).astype(np.int64) * n + triangles.ravel())
    regions, rows = np.divmod(pairs, n) if n else (pairs, pairs)
    if (representative != np.arange(n)).any():
        # Every row stands beside the one that represents it.
        order = np.argsort(representative, kind="stable")
        first = np.searchsorted(representative[order], rows)
        times = np.bincount(representative, minlength=n)[rows]
        ends = np.cumsum(times)
        within = np.arange(times.sum()) - np.repeat(ends - times, times)
        regions, rows = np.repeat(regions, times), order[np.repeat(first, times) + within]
        sorting = np.lexsort((rows, regions))
        regions, rows = regions[sorting], rows[sorting]
    offsets = np.searchsorted(regions, np.arange(count + 1)).astype(np.int64)
    return read_only(rows), read_only(offsets)
