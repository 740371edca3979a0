"""Pieces: which are components of the shape, which are strays, and which belong together."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from alphamesh.radius._places import corners_of

if TYPE_CHECKING:
    from alphamesh._arrays import CountArray, IntArray
    from alphamesh.persistence import Persistence
    from alphamesh.radius._density import Density
    from alphamesh.radius._outliers import Outliers

__all__ = ["Pieces", "weighed_pieces"]

# A piece of so few points, and so small a part of the cloud, says nothing about a shape.
_STRAY = 4
_STRAY_PART = 100
# Bounds of a weight: no single piece decides everything.
_LEAST, _MOST = -6.0, 50.0


@dataclass(slots=True)
class Pieces:
    """Changes of the pieces of the complex beyond some radius, in no order.

    Attributes
    ----------
    radii, weights, components : list
        At each radius, the changes of the sum of weights and of the number of pieces
        that count as components.
    """

    radii: list[float] = field(default_factory=list)
    weights: list[float] = field(default_factory=list)
    components: list[int] = field(default_factory=list)

    def add(self, start: float, end: float, weight: float, counts: bool) -> None:
        """Add a piece that keeps its size from `start` to `end`."""
        self.radii += [start, end]
        self.weights += [weight, -weight]
        self.components += [int(counts), -int(counts)]


def weighed_pieces(
    pairs: Persistence, density: Density, outliers: Outliers, least: float
) -> Pieces:
    """Weigh the pieces that stand alone at some radius beyond `least`.

    Parameters
    ----------
    pairs : Persistence
    density : Density
    outliers : Outliers
    least : float
        Pieces are followed from this radius on.
    """
    edges, deaths = pairs.pairs[0][:, 1], pairs.deaths[0]
    ends = corners_of(pairs.filtration, 1, edges)
    labels = _labels(ends.compress(deaths <= least, axis=0), outliers.total)
    late = np.flatnonzero(deaths > least)
    late = late[np.argsort(deaths.take(late), kind="stable")]
    contents = density.content(deaths.take(late), edges.take(late))
    gaps = outliers.gaps.weight(contents, outliers.total, outliers.total)
    meetings = zip(
        deaths.take(late).tolist(),
        gaps.tolist(),
        labels.take(ends.take(late, axis=0)).tolist(),
        strict=True,
    )
    return _followed(np.bincount(labels), meetings, _Judge(outliers))


def _followed(
    sizes: CountArray, meetings: Iterator[tuple[float, float, list[int]]], judge: _Judge
) -> Pieces:
    """Follow the pieces as they meet, and weigh each for as long as it keeps its size."""
    pieces = Pieces()
    size = {int(i): int(sizes[i]) for i in np.flatnonzero(sizes)}
    core = dict(size)
    since = dict.fromkeys(size, 0.0)
    spans: dict[int, list[tuple[float, float, bool]]] = {}
    into: dict[int, int] = {}

    def end(piece: int, radius: float) -> list[tuple[float, float, bool]]:
        counts = judge.counts(size[piece], core[piece])
        return [*spans.pop(piece, []), (since[piece], radius, counts)]

    for radius, gap, met in meetings:
        small, large = sorted((_root(into, i) for i in met), key=lambda i: size[i])
        # Only now is it known how long the smaller piece has stood alone.
        for start, stop, counts in end(small, radius):
            pieces.add(start, stop, judge.weight(counts, gap), counts)
        spans[large] = end(large, radius)
        into[small] = large
        size[large] += size[small]
        core[large] = max(core[small], core[large])
        since[large] = radius
    for piece in size:
        if piece not in into:
            for start, stop, counts in end(piece, np.inf):
                pieces.add(start, stop, 0.0, counts)
    return pieces


def _root(into: dict[int, int], piece: int) -> int:
    while piece in into:
        piece = into[piece]
    return piece


class _Judge:
    """Tells components of the shape from outliers."""

    def __init__(self, outliers: Outliers) -> None:
        self._outliers = outliers.count
        self._part = outliers.total // _STRAY_PART

    def counts(self, members: int, core: int) -> bool:
        """Return whether a piece is large enough, or dense enough, to be a component."""
        few = min(_STRAY, self._part)
        return core > few or members > max(few, self._part)

    def weight(self, counts: bool, gap: float) -> float:
        """Return the weight of a piece, by that of the gap around it."""
        if counts:
            return float(np.clip(gap, _LEAST, _MOST))
        # An outlier is no evidence; a point that chance has set apart is some against.
        return float(min(gap + np.log(self._outliers), 0.0))


def _labels(edges: IntArray, n: int) -> CountArray:
    """Return the least vertex that each vertex is connected to by `edges`.

    Parameters
    ----------
    edges : (k, 2) int32
    n : int
    """
    labels = np.arange(n)
    start, end = edges.T
    while len(start):
        first, second = labels.take(start), labels.take(end)
        apart = first != second
        start, end = start.compress(apart), end.compress(apart)
        first, second = first.compress(apart), second.compress(apart)
        np.minimum.at(labels, np.maximum(first, second), np.minimum(first, second))
        while not np.array_equal(further := labels.take(labels), labels):
            labels = further
    return labels
