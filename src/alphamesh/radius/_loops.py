"""Loops: which are holes of the shape, and which chance explains."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from alphamesh.radius._noise import log_range
from alphamesh.radius._places import ends_of

if TYPE_CHECKING:
    from alphamesh._arrays import BoolArray, FloatArray, IntArray
    from alphamesh.persistence import Persistence
    from alphamesh.radius._density import Density
    from alphamesh.radius._outliers import Outliers

__all__ = ["Loops", "weighed_loops"]

# Holes are alike when the larger has less than this many times the content of the smaller.
_ALIKE = float(np.exp(0.5))
# At most this part of a content is put down to the error of the density.
_DOUBT = 0.3
# Edges around a hole, over the square root of its content: 2 pi / sqrt(log 2) / 2.
_AROUND = 32.0


class Loops(NamedTuple):
    """Loops that die beyond some radius.

    Attributes
    ----------
    births, deaths : (m,) float64
        Radii.
    contents : (m,) float64
        Points that would fill the void, at the density around it.
    weights : (m,) float64
        Positive if the shape explains the loop better than chance: what speaks for a
        radius at which it is there.
    by_outliers : (m,) bool
        Whether an outlier rather than the shape closes the loop.
    """

    births: FloatArray
    deaths: FloatArray
    contents: FloatArray
    weights: FloatArray
    by_outliers: BoolArray


def weighed_loops(
    pairs: Persistence, density: Density, outliers: Outliers, least: float
) -> Loops:
    """Weigh the loops that die beyond `least`."""
    births, deaths = pairs.births[1], pairs.deaths[1]
    late = np.flatnonzero((deaths > least) & (births < deaths))
    births, deaths, creators = births.take(late), deaths.take(late), pairs.pairs[1][late, 0]
    n = len(pairs.filtration.simplices[0])
    content = density.content(deaths, creators)
    # The edge that closes the loop may cross a gap of the shape.
    bridge = outliers.gaps.weight(
        density.content(births, creators), _AROUND * np.sqrt(content), n
    )
    by_outliers = outliers.chance(_later_end(pairs, density, creators))
    plausible = (bridge < 0.0) & (by_outliers < 0.5)
    prior = 1.0 / log_range(n) + _alike(content, content.compress(plausible))
    sure = content - np.minimum(content**2 * density.variance(creators) / 2.0, _DOUBT * content)
    weight = np.log(prior / content) - (np.log(n * sure) - sure)
    # A loop across a gap of the shape is no hole at this scale.
    weight = (1.0 - by_outliers) * np.minimum(weight, -bridge)
    return Loops(births, deaths, content, weight, by_outliers >= 0.5)


def _alike(contents: FloatArray, others: FloatArray) -> FloatArray:
    """Return how many other loops are a little larger: one hole makes others likely."""
    ordered = np.sort(others)
    return np.asarray(
        np.searchsorted(ordered, contents * _ALIKE, side="right")
        - np.searchsorted(ordered, contents, side="right"),
        dtype=np.float64,
    )


def _later_end(pairs: Persistence, density: Density, edges: IntArray) -> FloatArray:
    """Return the content of the first edge of the later end of each edge."""
    filtration = pairs.filtration
    first = filtration.joined_from.take(ends_of(filtration, edges)).max(axis=1, initial=0.0)
    return density.content(first, edges)
