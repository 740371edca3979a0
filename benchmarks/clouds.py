"""The clouds that everybody is measured on: exactly n points each, the same for all jobs."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = ["CLOUDS", "Points", "make_cloud"]

Points = NDArray[np.float64]
Random = np.random.Generator


def uniform(n: int, random: Random) -> Points:
    """Return `n` points uniform in the unit square."""
    return random.random((n, 2))


def clusters(n: int, random: Random) -> Points:
    """Return `n` points from 30 Gaussian clusters whose widths span a factor of 30."""
    count = 30
    centres = random.random((count, 2))
    widths = np.geomspace(0.002, 0.06, count)
    which = random.integers(count, size=n)
    return centres[which] + widths[which, None] * random.standard_normal((n, 2))


def grid(n: int, random: Random) -> Points:
    """Return `n` points of a square integer grid, shuffled: every square is cocircular."""
    side = _ceil_sqrt(n)
    rows, columns = np.divmod(np.arange(n), side)
    return random.permutation(np.column_stack([columns, rows]).astype(np.float64))


def pixels(n: int, random: Random) -> Points:
    """Return `n` pixels, shuffled, of a mask: a disc with seven round holes.

    The mask is just large enough; its first `n` pixels in reading order are taken.
    """
    side = _ceil_sqrt(n)
    while (mask := _holed_disc(side)).sum() < n:
        side += max(1, side // 200)
    rows, columns = np.nonzero(mask)
    return random.permutation(np.column_stack([columns[:n], rows[:n]]).astype(np.float64))


def circle(n: int, random: Random) -> Points:
    """Return `n` points on the unit circle, as closely as floats can say."""
    angle = 2 * np.pi * random.random(n)
    return np.column_stack([np.cos(angle), np.sin(angle)])


CLOUDS: dict[str, Callable[[int, Random], Points]] = {
    "uniform": uniform,
    "clusters": clusters,
    "grid": grid,
    "pixels": pixels,
    "circle": circle,
}


def make_cloud(name: str, n: int, seed: int = 1) -> Points:
    """Return the cloud `name` of `n` points: ``(n, 2)`` float64, C-contiguous, writable.

    Writable as a user's array is: a library that has to copy such input pays for it.
    """
    return np.ascontiguousarray(CLOUDS[name](n, np.random.default_rng(seed)))


def _ceil_sqrt(n: int) -> int:
    return int(np.ceil(np.sqrt(n)))


def _holed_disc(side: int) -> NDArray[Any]:
    """Return the mask of a disc that fills a `side` by `side` image, less seven holes."""
    axis = (np.arange(side) + 0.5) / side * 2 - 1
    x, y = axis[None, :], axis[:, None]
    mask = x * x + y * y < 1
    mask &= x * x + y * y > 0.15**2
    for turn in np.arange(6) * np.pi / 3:
        mask &= (x - 0.6 * np.cos(turn)) ** 2 + (y - 0.6 * np.sin(turn)) ** 2 > 0.17**2
    return mask
