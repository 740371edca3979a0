"""Several boxes in a row as one larger box."""

from __future__ import annotations

import itertools
from typing import TYPE_CHECKING, Any

import numpy as np

from alphamesh.errors import PeriodsError

if TYPE_CHECKING:
    from alphamesh._arrays import FloatArray

__all__ = ["tiled_points"]


def tiled_points(
    points: FloatArray, periods: tuple[float | None, ...], repeats: Any
) -> tuple[FloatArray, tuple[float | None, ...]]:
    """Return the points of several boxes, and the sides of all of them together.

    Parameters
    ----------
    points : (n, d) float64
    periods : tuple of float or None
    repeats : int or sequence of int
        1 or more in each direction, 1 where the box is open.

    Returns
    -------
    points : (k n, d) float64
        Those of one box after another, the last direction fastest. Copies are rounded to
        float64.
    periods : tuple of float or None

    Raises
    ------
    PeriodsError
        If `repeats` are not such numbers.
    """
    counts = _counts(repeats, periods)
    sides = np.array([side or 0.0 for side in periods])
    moves = itertools.product(*(range(k) for k in counts))
    tiles = [points + np.array(move) * sides for move in moves]
    larger = tuple(
        None if side is None else side * k for side, k in zip(periods, counts, strict=True)
    )
    return np.concatenate(tiles), larger


def _counts(repeats: Any, periods: tuple[float | None, ...]) -> list[int]:
    """Return how many boxes there are in each direction."""
    given = np.asarray(repeats)
    closed = np.array([side is not None for side in periods])
    whole = given.dtype.kind in "iu"
    if whole and given.ndim == 0:
        given = np.where(closed, given, 1)
    if (
        not whole
        or given.shape != closed.shape
        or (given < 1).any()
        or (given[~closed] != 1).any()
    ):
        raise PeriodsError(
            f"repeats must be {len(periods)} whole numbers, 1 or more, and 1 in open "
            f"directions; got {repeats!r}"
        )
    counts: list[int] = given.tolist()
    return counts
