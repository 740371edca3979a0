"""Loops and voids: which are holes of the shape, and which chance explains."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from alphamesh.filtration3d import Filtration3D
from alphamesh.radius._noise import chance, log_range
from alphamesh.radius._places import corners_of

if TYPE_CHECKING:
    from alphamesh._arrays import BoolArray, CountArray, FloatArray, IntArray
    from alphamesh.persistence import Persistence
    from alphamesh.radius._density import Density
    from alphamesh.radius._outliers import Outliers

__all__ = ["Loops", "joined", "weighed_loops"]

# Holes are alike when the larger has less than this many times the content of the smaller.
_ALIKE = float(np.exp(0.5))
# At most this part of a content is put down to the error of the density.
_DOUBT = 0.3
# Edges around a hole, over the square root of its content: 2 pi / sqrt(log 2) / 2.
_AROUND = 32.0
# A void that is there until a radius this many times that of its birth is there for long.
_LASTING = 1.05
_MOMENT = 1e-9


class Loops(NamedTuple):
    """Loops and voids that die beyond some radius.

    Attributes
    ----------
    dimensions : (m,) int64
        1 for loops, 2 for voids.
    births, deaths : (m,) float64
        Radii.
    contents : (m,) float64
        Points that would fill the void, at the density around it.
    weights : (m,) float64
        Positive if the shape explains the loop better than chance: what speaks for a
        radius at which it is there.
    by_outliers : (m,) bool
        Whether an outlier rather than the shape closes it.
    """

    dimensions: CountArray
    births: FloatArray
    deaths: FloatArray
    contents: FloatArray
    weights: FloatArray
    by_outliers: BoolArray


def joined(one: Loops, other: Loops) -> Loops:
    """Return both."""
    return Loops(
        np.concatenate((one.dimensions, other.dimensions)),
        np.concatenate((one.births, other.births)),
        np.concatenate((one.deaths, other.deaths)),
        np.concatenate((one.contents, other.contents)),
        np.concatenate((one.weights, other.weights)),
        np.concatenate((one.by_outliers, other.by_outliers)),
    )


def weighed_loops(
    pairs: Persistence, density: Density, outliers: Outliers, least: float, cycles: int = 1
) -> Loops:
    """Weigh the loops that die beyond `least`; the voids if `cycles` is 2."""
    births, deaths = pairs.births[cycles], pairs.deaths[cycles]
    late = np.flatnonzero((deaths > least) & (births < deaths))
    births, deaths = births.take(late), deaths.take(late)
    creators = pairs.pairs[cycles][late, 0]
    edges = _an_edge(pairs, cycles, creators)
    n = len(pairs.filtration.simplices[0])
    content = density.content(deaths, edges)
    places = _AROUND * content ** (cycles / density.dimension)
    closed_at = density.content(births, edges)
    if cycles == 1:  # the edge that closes a loop may cross a gap of the shape
        bridge = outliers.gaps.weight(closed_at, places, n)
    else:  # so may the triangle that closes a void, by filling a loop
        closed_at = np.maximum(closed_at, _MOMENT)  # has a logarithm
        expected = chance(density.dimension, 1, closed_at, places)
        bridge = -np.log(log_range(n) * closed_at) - expected
        # A wide void falls apart just before it is filled; its parts live for a moment.
        part = np.log(_LASTING) / np.maximum(np.log(deaths) - np.log(births), _MOMENT)
        bridge = np.where(part > 1.0, np.maximum(bridge, np.log(part)), bridge)
    first = _latest_corner(pairs, cycles, creators)
    by_outliers = outliers.chance(density.content(first, edges))
    plausible = (bridge < 0.0) & (by_outliers < 0.5)
    prior = 1.0 / log_range(n) + _alike(content, content.compress(plausible))
    sure = content - np.minimum(content**2 * density.variance(edges) / 2.0, _DOUBT * content)
    weight = np.log(prior / content) - chance(density.dimension, cycles, sure, n)
    # A loop across a gap of the shape is no hole at this scale.
    weight = (1.0 - by_outliers) * np.minimum(weight, -bridge)
    dimensions = np.full(len(late), cycles)
    return Loops(dimensions, births, deaths, content, weight, by_outliers >= 0.5)


def _an_edge(pairs: Persistence, dimension: int, simplices: IntArray) -> IntArray:
    """Return an edge of each of some simplices."""
    if dimension == 1:
        return simplices
    filtration = pairs.filtration
    assert isinstance(filtration, Filtration3D)
    return filtration.triangle_edges.take(simplices, axis=0)[:, 0]


def _alike(contents: FloatArray, others: FloatArray) -> FloatArray:
    """Return how many other loops are a little larger: one hole makes others likely."""
    ordered = np.sort(others)
    return np.asarray(
        np.searchsorted(ordered, contents * _ALIKE, side="right")
        - np.searchsorted(ordered, contents, side="right"),
        dtype=np.float64,
    )


def _latest_corner(pairs: Persistence, dimension: int, simplices: IntArray) -> FloatArray:
    """Return the first edge's radius of the corner of each simplex that is joined last."""
    filtration = pairs.filtration
    corners = corners_of(filtration, dimension, simplices)
    return np.asarray(filtration.joined_from.take(corners).max(axis=1, initial=0.0))
