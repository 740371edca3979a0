"""What every check needs: an exact sign for each row, and an error that names rows."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from alphamesh._kernels import BadCoordinates
from alphamesh.errors import InvalidResultError, rows_text

if TYPE_CHECKING:
    from alphamesh._arrays import BoolArray, FloatArray, KindArray

LongArray: TypeAlias = "np.ndarray[Any, np.dtype[np.int64]]"

_CHUNK = 1 << 18  # rows of coordinates gathered at a time: bounds the extra memory


def require(good: Any, problem: str, names: Any = None) -> None:
    """Raise for the rows where `good` fails, under their own numbers or those in `names`."""
    bad = np.flatnonzero(~good)
    if len(bad):
        rows = bad if names is None else np.unique(names[bad])
        raise InvalidResultError(
            f"{problem} ({rows_text(rows[:6], total=len(rows))})", rows=rows[:6]
        )


def check_table(array: Any, shape: tuple[int, ...], name: str) -> None:
    """Raise unless `array` is an int32 array of that shape."""
    if not isinstance(array, np.ndarray) or array.shape != shape or array.dtype != np.int32:
        raise InvalidResultError(f"{name}: not an int32 array of shape {shape}")


def check_radii(radii: Any, count: int, name: str, *, signed: bool = False) -> None:
    """Raise unless `radii` is a float64 array of finite numbers, at least 0 if not `signed`."""
    good = (
        isinstance(radii, np.ndarray) and radii.shape == (count,) and radii.dtype == np.float64
    )
    if not good:
        raise InvalidResultError(f"{name}: not a float64 array of shape ({count},)")
    if signed:
        require(np.isfinite(radii), f"{name}: not finite")
    else:
        require(np.isfinite(radii) & (radii >= 0), f"{name}: not finite or negative")


def signs(
    predicate: Callable[[FloatArray], KindArray], points: FloatArray, rows: Any
) -> KindArray:
    """Return the exact predicate of the points of each row."""
    out = np.empty(len(rows), dtype=np.int8)
    for begin in range(0, len(rows), _CHUNK):
        part = slice(begin, begin + _CHUNK)
        try:
            out[part] = predicate(points[rows[part]])
        except BadCoordinates as error:
            raise InvalidResultError(f"points: {error}") from error
    return out


def edge_keys(edges: Any) -> LongArray:
    """Return one number for each pair of ids."""
    keys: LongArray = (edges[:, 0].astype(np.int64) << 32) | edges[:, 1]
    return keys


def find_sorted(keys: LongArray, wanted: LongArray) -> tuple[LongArray, BoolArray]:
    """Return where each wanted key would stand in the sorted keys, and whether it does."""
    where = np.searchsorted(keys, wanted)
    there: BoolArray = where < len(keys)
    there[there] = keys[where[there]] == wanted[there]
    return where, there
