"""Stages: ranges of radii with the same shape, and how much speaks for each."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from alphamesh.radius._density import local_density
from alphamesh.radius._loops import Loops, joined, weighed_loops
from alphamesh.radius._noise import Gaps, noise_power
from alphamesh.radius._outliers import find_outliers
from alphamesh.radius._pieces import Pieces, weighed_pieces
from alphamesh.radius._sheets import is_sheet

if TYPE_CHECKING:
    from alphamesh._arrays import BoolArray, CountArray, FloatArray
    from alphamesh.persistence import Persistence

__all__ = ["Stages", "stages_of"]

# No stage below this part of the content at which chance voids die is looked at.
_EARLIEST = 0.45**2
# What speaks against a radius at which outliers make a loop. More such loops speak less
# and less against it: with many outliers, some are made at any radius.
_BY_OUTLIERS = 3.0
# Narrower ranges, in parts of the radius, are made by rounding: of points on one circle,
# say, whose triangles would all come at once.
_NARROWEST = 1e-6


@dataclass(frozen=True, slots=True)
class Stages:
    """Ranges of radii, ``low <= radius < high``, one after the other.

    Attributes
    ----------
    low, high : (m,) float64
    betti : (m, 2) or (m, 3) int64
        Components, without strays, and holes; in space, tunnels and voids.
    weight : (m,) float64
        Sum of the weights of the pieces and loops that are there.
    allowed : (m,) bool
        Whether the noise has died far enough for a shape to be told at all, and a radius
        can be told from the next.
    loops : Loops
    noise : float
        The radius of the largest empty disc or ball that chance leaves.
    sheet : bool
        Whether the points are taken to lie on a surface in space.
    """

    low: FloatArray
    high: FloatArray
    betti: CountArray
    weight: FloatArray
    allowed: BoolArray
    loops: Loops
    noise: float
    sheet: bool


def stages_of(pairs: Persistence, min_hole: float, surface: bool | None = None) -> Stages:
    """Weigh every range of radii of a cloud of at least two places.

    Parameters
    ----------
    pairs : Persistence
    min_hole : float
        Loops and voids that die at a smaller radius are no holes.
    surface : bool, optional
        Whether points in space lie on a surface; by default this is found out.
    """
    if pairs.filtration.dimension == 1:
        return _stages_on_a_line(pairs)
    solid = pairs.filtration.dimension == 3
    sheet = solid and (is_sheet(pairs) if surface is None else surface)
    power = 3 if solid and not sheet else 2
    density = local_density(pairs.filtration, power)
    n = len(pairs.filtration.simplices[0])
    typical = noise_power(power, np.ones(1), n) / float(np.median(density.all_rates()))
    least = density.radius(_EARLIEST * typical)
    noise = density.radius(noise_power(power, density.all_rates(), n))
    tree = pairs.pairs[0][:, 1]
    gaps = Gaps.of(density.content(pairs.deaths[0], tree), power)
    outliers = find_outliers(pairs.filtration, density, gaps, least)
    loops = weighed_loops(pairs, density, outliers, least)
    if solid:
        loops = joined(loops, weighed_loops(pairs, density, outliers, least, 2))
    if min_hole > 0.0:
        small = loops.deaths < min_hole
        loops = loops._replace(weights=np.where(small, -50.0, loops.weights))
    pieces = weighed_pieces(pairs, density, outliers, least)
    return _swept(pairs, loops, pieces, least, noise=noise, sheet=sheet)


def _stages_on_a_line(pairs: Persistence) -> Stages:
    """Weigh the gaps between points on one line, which are spread like exp(-length)."""
    gaps = pairs.deaths[0]
    with np.errstate(over="ignore"):
        lengths = np.minimum(gaps / (float(np.median(gaps)) or 1.0), 1e6)
    contents = lengths**2
    weight = Gaps.of(contents, 2).weight(contents, len(gaps) + 1, len(gaps) + 1)
    pieces = Pieces(
        [0.0] * len(gaps) + gaps.tolist() + [0.0],
        [*weight.tolist(), *(-weight).tolist(), 0.0],
        [1] * len(gaps) + [-1] * len(gaps) + [1],
    )
    none = np.empty(0)
    loops = Loops(none.astype(int), none, none, none, none, none.astype(bool))
    return _swept(pairs, loops, pieces, 0.0, noise=0.0, sheet=False)


def _swept(  # noqa: PLR0913 (what there is at each radius, and what to remember)
    pairs: Persistence,
    loops: Loops,
    pieces: Pieces,
    least: float,
    *,
    noise: float,
    sheet: bool,
) -> Stages:
    """Add up the weights of what is there, radius by radius."""
    count = len(loops.births)
    radii = np.concatenate((loops.births, loops.deaths, pieces.radii, _before(pairs, least)))
    extra = len(radii) - 2 * count - len(pieces.radii)
    columns = pairs.filtration.points.shape[1]
    change = np.zeros((len(radii), columns + 1), dtype=np.int64)
    for k in range(1, columns):
        comes = loops.dimensions == k
        change[:count, k], change[count : 2 * count, k] = comes, -1 * comes
    by_outliers = loops.by_outliers
    change[:count, -1], change[count : 2 * count, -1] = by_outliers, -1 * by_outliers
    change[2 * count : len(radii) - extra, 0] = pieces.components
    weight = np.concatenate((loops.weights, -loops.weights, pieces.weights, np.zeros(extra)))
    finite = np.isfinite(radii)  # what stays for ever never leaves
    radii, change, weight = radii[finite], change[finite], weight[finite]
    order = np.argsort(radii, kind="stable")
    radii = radii.take(order)
    last = np.append(radii[1:] > radii[:-1], True)
    low = radii.compress(last)
    high = np.append(low[1:], np.inf)
    numbers = np.cumsum(change.take(order, axis=0), axis=0).compress(last, axis=0)
    total = np.cumsum(weight.take(order)).compress(last)
    total -= _BY_OUTLIERS * np.log2(1.0 + numbers[:, -1])
    return Stages(
        low,
        high,
        numbers[:, :-1],
        np.round(total, 6),  # equal evidence shall give equal sums
        (high > least) & (high - low > _NARROWEST * low),
        loops,
        noise,
        sheet,
    )


def _before(pairs: Persistence, least: float) -> FloatArray:
    """Return the last changes up to `least` of what is not followed one by one."""
    lives = (*pairs.deaths, *pairs.births[1:])
    radii = [values[values <= least] for values in lives]
    return np.array([0.0, *(values.max() for values in radii if len(values))])
