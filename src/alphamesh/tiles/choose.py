"""A radius for a cloud that nobody has seen as a whole."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from alphamesh._arrays import read_only
from alphamesh.errors import EmptyCloudError, ParameterError, PeriodicError, UnweightedOnlyError
from alphamesh.filtration import filtration
from alphamesh.radius import choose_radius as choose_for_one
from alphamesh.tiles.tiling import plan
from alphamesh.tiles.weighing import WeightRange

if TYPE_CHECKING:
    from alphamesh._arrays import FloatArray
    from alphamesh.filtration import AnyFiltration
    from alphamesh.radius import RadiusChoice
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
        What follows from the choice in each tile.
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
    """Choose a radius by the default rule in some tiles of a cloud on disk.

    Space is divided into tiles of about `tile_points` points; some of them, drawn at
    random, are read as they are, and the rule chooses a radius for each. It is
    made larger by what the gaps between more points are wider by chance. Two passes over
    the data.

    With weights, the default rule is another one, as in memory: 0, where each ball has the
    size that its weight gives it. One pass tells whether some have a size at all.

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
    UnweightedOnlyError
        If there are weights, and none is positive.
    PeriodicError
        If the points are in a periodic box, for which the rule is not made.
    """
    if samples < 1 or tile_points < 1:
        raise ParameterError(
            f"samples and tile_points must be at least 1; got {samples!r}, {tile_points!r}"
        )
    if data.count == 0:
        raise EmptyCloudError("no radius can be chosen for a cloud without points")
    if data.periods is not None:
        raise PeriodicError(
            "no radius is chosen in tiles of a periodic box, whose rules look at all of it; "
            "give one"
        )
    if data.weights is not None:
        given = _of_given_balls(data)
        if given is not None:
            return given
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


def _of_given_balls(data: Dataset) -> SampledRadius | None:
    """Return the radius at which balls have their given sizes; None if all weights are 0."""
    ranges = [WeightRange.of(chunk.read_weights()) for chunk in data.chunks]
    greatest = max(part.greatest for part in ranges)
    if greatest == min(part.least for part in ranges) == 0.0:
        return None
    if greatest <= 0.0:
        raise UnweightedOnlyError(
            "no radius is chosen in tiles for weights none of which is positive; give one"
        )
    reason = (
        "Each ball has the size that its weight gives it: at radius 0, the complex is the "
        "dual of the union of these balls."
    )
    return SampledRadius(0.0, 0.0, 0.0, read_only(np.zeros(1)), 1, data.count, reason)


def _agreed(clouds: list[FloatArray], count: int) -> SampledRadius:
    chosen = [_for_tile(filtration(cloud), count) for cloud in clouds]
    radii = np.array([radius for radius, _ in chosen])
    low, radius, high = np.quantile(radii, (0.25, 0.5, 0.75)).tolist()
    points = sum(map(len, clouds))
    clear = sum(choice.clear for _, choice in chosen)
    rule = chosen[0][1].rule
    reason = (
        f"In {len(radii)} tiles with {points:,} points together, the rule {rule} chose "
        f"radii that are good for the whole cloud from {radii.min():.4g} to "
        f"{radii.max():.4g}, half of them from {low:.4g} to {high:.4g}; the answer was clear "
        f"in {clear}. This is the one in the middle."
    )
    return SampledRadius(radius, low, high, read_only(radii), clear, points, reason)


def _for_tile(found: AnyFiltration, count: int) -> tuple[float, RadiusChoice]:
    """Return a radius for the whole cloud from one of its tiles, and the choice there.

    Of n random points, about n x exp(-x) chance loops are alive when a ball holds x
    points. For N points to have as few, x must be larger by log(N / n). The distances of
    random points to their nearest neighbours tell how much a ball holds: half of these
    balls hold less than log(2) points.
    """
    choice = choose_for_one(found)
    nearest = 2.0 * float(np.median(found.joined_from))
    d = found.points.shape[1]
    more = math.log(count / len(found.points)) * nearest**d / math.log(2.0)
    radius = (choice.radius**d + (more if math.isfinite(more) else 0.0)) ** (1 / d)
    return radius, choice
