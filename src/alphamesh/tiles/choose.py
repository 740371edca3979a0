"""A radius for a cloud that nobody has seen as a whole."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from alphamesh._arrays import read_only
from alphamesh.errors import EmptyCloudError, ParameterError
from alphamesh.filtration import filtration
from alphamesh.radius import choose_radius as choose_for_one
from alphamesh.tiles.tiling import plan

if TYPE_CHECKING:
    from alphamesh._arrays import FloatArray
    from alphamesh.filtration import Filtration
    from alphamesh.tiles.dataset import Dataset

__all__ = ["SampledRadius", "choose_radius"]

_SAMPLE = 200_000


@dataclass(frozen=True, slots=True)
class SampledRadius:
    """A radius from some tiles of a cloud, and how far these agree.

    Attributes
    ----------
    radius : float
        The median of `radii`.
    low, high : float
        Half of `radii` lie between: their quartiles.
    radii : (k,) float64
        What follows from the choice of the rule of topology in each tile.
    clear : int
        In how many of them the answer was clear.
    points : int
        How many points these tiles have together.
    reason : str
    """

    radius: float
    low: float
    high: float
    radii: FloatArray
    clear: int
    points: int
    reason: str


def choose_radius(
    data: Dataset, *, samples: int = 9, tile_points: int = 10_000, seed: int = 0
) -> SampledRadius:
    """Choose a radius by topology in some tiles of a cloud on disk.

    Space is divided into tiles of about `tile_points` points; some of them, drawn at
    random, are read as they are, and the rule of topology chooses a radius for each. It is
    made larger by what the gaps between more points are wider by chance. Two passes over
    the data.

    Parameters
    ----------
    data : Dataset
    samples : int
        How many tiles to look at.
    tile_points : int
    seed : int

    Returns
    -------
    SampledRadius

    Raises
    ------
    EmptyCloudError
        If there are no points.
    """
    if samples < 1 or tile_points < 1:
        raise ParameterError(
            f"samples and tile_points must be at least 1; got {samples!r}, {tile_points!r}"
        )
    if data.count == 0:
        raise EmptyCloudError("no radius can be chosen for a cloud without points")
    rng = np.random.default_rng(seed)
    share = min(1.0, _SAMPLE / data.count)
    sample = []
    for chunk in data.chunks:
        points = chunk.read()
        sample.append(points[rng.random(len(points)) <= share])
    # No more tiles than the sample can tell apart.
    tiles = max(1, min(math.ceil(data.count / tile_points), sum(map(len, sample)) // 20))
    tiling = plan(np.concatenate(sample), tiles)
    chosen = rng.choice(len(tiling), min(samples, len(tiling)), replace=False)
    parts: dict[int, list[FloatArray]] = {int(tile): [] for tile in chosen}
    for chunk in data.chunks:
        points = chunk.read()
        where = tiling.tile_of(points)
        for tile, found in parts.items():
            found.append(points.compress(where == tile, axis=0))
    clouds = [np.concatenate(found) for found in parts.values()]
    return _agreed([cloud for cloud in clouds if len(cloud)], data.count)


def _agreed(clouds: list[FloatArray], count: int) -> SampledRadius:
    chosen = [_for_tile(filtration(cloud), count) for cloud in clouds]
    radii = np.array([radius for radius, _ in chosen])
    low, radius, high = np.quantile(radii, (0.25, 0.5, 0.75)).tolist()
    points = sum(map(len, clouds))
    clear = sum(was_clear for _, was_clear in chosen)
    reason = (
        f"In {len(radii)} tiles with {points:,} points together, the rule of topology chose "
        f"radii that are good for the whole cloud from {radii.min():.4g} to "
        f"{radii.max():.4g}, half of them from {low:.4g} to {high:.4g}; the answer was clear "
        f"in {clear}. This is the one in the middle."
    )
    return SampledRadius(radius, low, high, read_only(radii), clear, points, reason)


def _for_tile(found: Filtration, count: int) -> tuple[float, bool]:
    """Return a radius for the whole cloud from one of its tiles, and whether it is clear.

    Of n random points, about n x exp(-x) chance loops are alive when a disc holds x
    points. For N points to have as few, x must be larger by log(N / n). The squared
    distances of random points to their nearest neighbours tell how many a disc holds:
    half of them are below log(2) times the squared radius of the disc that holds one.
    """
    choice = choose_for_one(found)
    nearest = 2.0 * float(np.median(found.joined_from))
    more = math.log(count / len(found.points)) * nearest**2 / math.log(2.0)
    radius = math.sqrt(choice.radius**2 + (more if math.isfinite(more) else 0.0))
    return radius, choice.clear
