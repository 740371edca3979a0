"""Clouds made at random: from the chosen pixels of a mask, and with noise added.

Pixel coordinates: a pixel is the unit square whose lower left corner has integer
coordinates, x runs right and y runs up, and the bottom row of the image has y = 0. An
image of height h and width w thus covers [0, w] x [0, h].
"""

from __future__ import annotations

import math
import operator
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from alphamesh.errors import EmptyMaskError, ParameterError
from alphamesh.points import as_cloud
from alphamesh.shapes import DEMO_SHAPES, DemoShape, demo_mask
from alphamesh.solids import DEMO_SOLIDS, DemoSolid, demo_solid

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

__all__ = [
    "DEMO_SHAPES",
    "DEMO_SOLIDS",
    "DemoShape",
    "DemoSolid",
    "Seed",
    "add_noise",
    "add_outliers",
    "demo_cloud",
    "demo_mask",
    "sample_pixels",
    "sample_solid",
]

Seed: TypeAlias = "int | np.random.Generator | np.random.SeedSequence | None"

# Row numbers of a cloud are 32-bit integers.
_MOST_POINTS = 2**31 - 1
# Steps inside a pixel. A power of two keeps pixel + offset exact in float64, so that a
# point never rounds onto the far side of its pixel (masks up to 2**22 pixels wide).
_STEPS = 2**30


def sample_pixels(
    mask: ArrayLike,
    n: int,
    *,
    seed: Seed = None,
    jitter: bool = True,
    replace: bool = False,
) -> NDArray[np.float64]:
    """Draw points from the True pixels of a mask, in random order.

    Parameters
    ----------
    mask : (h, w) bool array
        Row 0 is the top.
    n : int
        How many points, at least 1.
    seed : int, numpy.random.Generator or None
        The same integer gives the same points; None gives new ones each time. A
        generator is advanced.
    jitter : bool
        True: each point lies uniformly inside its pixel, its upper and right sides
        left out. False: each point is the pixel's lower left corner, so that all
        coordinates are integers.
    replace : bool
        True: every point picks its pixel independently. False: the points use all
        pixels as evenly as can be, each pixel floor(n / pixels) times or once more.

    Returns
    -------
    (n, 2) float64 array
        x to the right, y upwards, in pixels: the bottom row of the mask has
        0 <= y < 1. Points may repeat only with ``jitter=False, replace=True``.

    Raises
    ------
    EmptyMaskError
        No pixel is True.
    ParameterError
        `mask` is not a 2D bool array; `n` is not a positive integer; or it exceeds the
        number of pixels and neither `jitter` nor `replace` allows a pixel twice.
    """
    pixels = np.asarray(mask)
    if pixels.dtype != np.bool_ or pixels.ndim != 2:
        raise ParameterError(
            "mask must be a 2D bool array, not "
            f"{pixels.dtype} of shape {pixels.shape}; compare the image with a level"
        )
    count = point_count(n)
    rng = generator(seed)
    chosen = np.flatnonzero(pixels)
    if len(chosen) == 0:
        raise EmptyMaskError(
            f"none of the {pixels.size} pixels of the mask is True, so no point can be drawn"
        )
    if count > len(chosen) and not (jitter or replace):
        raise ParameterError(
            f"n={count} exceeds the {len(chosen)} chosen pixels, and without jitter or "
            f"replacement each gives one point; take n <= {len(chosen)}, jitter=True "
            "(points inside the pixels) or replace=True (repeated points)"
        )
    picked = chosen[_draw(len(chosen), count, rng, replace)]
    rows, columns = np.divmod(picked, pixels.shape[1])
    points = np.empty((count, 2))
    points[:, 0] = columns
    points[:, 1] = pixels.shape[0] - 1 - rows
    if jitter:
        points += rng.integers(_STEPS, size=(count, 2)) / _STEPS
    return points


def demo_cloud(
    name: str, n: int = 2000, *, seed: Seed = None, size: int = 512
) -> NDArray[np.float64]:
    """Draw points inside a demo shape.

    Parameters
    ----------
    name : str
        A key of :data:`DEMO_SHAPES`.
    n : int
        How many points, at least 1.
    seed : int, numpy.random.Generator or None
        As for :func:`sample_pixels`.
    size : int
        Width and height of the mask in pixels, from 64 to 16384.

    Returns
    -------
    (n, 2) float64 array
        In pixels, y upwards, within [0, size].

    Raises
    ------
    ParameterError
        An unknown name, or `n`, `seed` or `size` out of range.
    """
    return sample_pixels(demo_mask(name, size), n, seed=seed)


def sample_solid(
    name: str, n: int = 4000, *, seed: Seed = None, surface: bool = False
) -> NDArray[np.float64]:
    """Draw points inside a demo solid, or on its surface.

    Parameters
    ----------
    name : str
        A key of :data:`DEMO_SOLIDS`.
    n : int
        How many points, at least 1.
    seed : int, numpy.random.Generator or None
        As for :func:`sample_pixels`.
    surface : bool, default False
        Draw from the surface instead of the volume, walls of cavities included.

    Returns
    -------
    (n, 3) float64 array
        Uniform in the volume. On the surface, uniform but for a share of a hundredth or
        so where it is curved most.

    Raises
    ------
    ParameterError
        An unknown name, or `n` or `seed` out of range.
    """
    solid = demo_solid(name)
    count, rng = point_count(n), generator(seed)
    parts: list[NDArray[np.float64]] = []
    missing = count
    while missing > 0:
        found = solid.draw(rng, 2 * missing + 64, surface=surface)[:missing]
        parts.append(found)
        missing -= len(found)
    return np.concatenate(parts)


def add_noise(points: ArrayLike, sigma: float, *, seed: Seed = None) -> NDArray[np.float64]:
    """Move every point by a normal deviate in each coordinate.

    Parameters
    ----------
    points : (n, d) array
        A cloud; it is not changed.
    sigma : float
        Standard deviation of each coordinate, at least 0, in the units of the cloud.
    seed : int, numpy.random.Generator or None
        As for :func:`sample_pixels`.

    Returns
    -------
    (n, d) float64 array
        A new cloud, its rows in the order of `points`.

    Raises
    ------
    CloudError
        `points` is not a cloud.
    ParameterError
        `sigma` is negative or not a finite number, or `seed` is not a seed.
    """
    cloud = as_cloud(points).points
    spread = _finite_number("sigma", sigma)
    return cloud + spread * generator(seed).standard_normal(cloud.shape)


def add_outliers(
    points: ArrayLike, count: int, *, margin: float = 0.1, seed: Seed = None
) -> NDArray[np.float64]:
    """Append points spread uniformly over the bounding box of a cloud.

    Parameters
    ----------
    points : (n, d) array
        A cloud of at least one point; it is not changed.
    count : int
        How many outliers, at least 1.
    margin : float
        The box is widened on each side by this fraction of its width, at least 0.
    seed : int, numpy.random.Generator or None
        As for :func:`sample_pixels`.

    Returns
    -------
    (n + count, d) float64 array
        The rows of `points`, then the outliers.

    Raises
    ------
    CloudError
        `points` is not a cloud.
    ParameterError
        The cloud is empty; or `count`, `margin` or `seed` is out of range.
    """
    cloud = as_cloud(points).points
    extra = point_count(count, "count")
    widening = _finite_number("margin", margin)
    if len(cloud) == 0:
        raise ParameterError("an empty cloud has no bounding box to spread outliers over")
    low, high = cloud.min(axis=0), cloud.max(axis=0)
    reach = widening * (high - low)
    outliers = generator(seed).uniform(low - reach, high + reach, (extra, cloud.shape[1]))
    return np.concatenate([cloud, outliers])


def generator(seed: Seed) -> np.random.Generator:
    """Return the random generator of `seed`, or raise ParameterError."""
    try:
        return np.random.default_rng(seed)
    except (TypeError, ValueError) as error:
        raise ParameterError(
            "seed must be a non-negative integer, a numpy.random.Generator or None, "
            f"not {seed!r}"
        ) from error


def point_count(n: int, name: str = "n") -> int:
    """Return `n` as an int from 1 to 2**31 - 1, or raise ParameterError."""
    try:
        count = operator.index(n)
    except TypeError:
        count = 0
    if isinstance(n, bool | np.bool_) or not 1 <= count <= _MOST_POINTS:
        raise ParameterError(
            f"{name} must be an integer from 1 to {_MOST_POINTS} (a number of points), "
            f"not {n!r}"
        )
    return count


def _draw(
    pixels: int, count: int, rng: np.random.Generator, replace: bool
) -> NDArray[np.int64]:
    """Return `count` of the numbers below `pixels`, in random order."""
    if replace:
        return rng.integers(pixels, size=count)
    rounds, rest = divmod(count, pixels)
    once_more = rng.choice(pixels, rest, replace=False)
    if rounds == 0:
        return once_more
    drawn = np.concatenate([np.tile(np.arange(pixels), rounds), once_more])
    rng.shuffle(drawn)
    return drawn


def _finite_number(name: str, value: float) -> float:
    try:
        number = float(value)
    except (TypeError, ValueError):
        number = math.nan
    if not (math.isfinite(number) and number >= 0):
        raise ParameterError(f"{name} must be a finite number of at least 0, not {value!r}")
    return number
