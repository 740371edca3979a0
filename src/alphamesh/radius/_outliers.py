"""Points that stand outside the shape."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from alphamesh._arrays import FloatArray, IntArray
    from alphamesh.filtration import Filtration
    from alphamesh.radius._density import Density
    from alphamesh.radius._noise import Gaps

__all__ = ["Outliers", "find_outliers"]

# Fewer than one outlier cannot be seen, nor ruled out.
_UNSEEN = 0.5


@dataclass(frozen=True, slots=True)
class Outliers:
    """How many outliers there are, and which points they may be.

    Attributes
    ----------
    count : float
        Points farther from all others than chance explains, at least a half.
    total : int
        Points of the cloud.
    gaps : Gaps
    """

    count: float
    total: int
    gaps: Gaps

    def chance(self, contents: FloatArray) -> FloatArray:
        """Return how likely points are outliers, by the contents of their first edges."""
        odds = self.gaps.weight(contents, self.total, self.total) + np.log(self.count)
        return np.asarray(1.0 / (1.0 + np.exp(-np.clip(odds, -50.0, 50.0))))


def find_outliers(
    filtration: Filtration, density: Density, gaps: Gaps, least: float
) -> Outliers:
    """Count the points that get their first edge later than chance explains.

    Parameters
    ----------
    filtration : Filtration
    density : Density
    gaps : Gaps
    least : float
        Points that have an edge at this radius are none.
    """
    first = filtration.joined_from
    late = np.flatnonzero(first > least)
    rows = filtration.simplices[0].take(late, axis=0)[:, 0]
    contents = density.content(first.take(late), _edges_at(filtration, rows))
    beyond = np.count_nonzero(gaps.weight(contents, len(first), len(first)) > 0.0)
    return Outliers(max(beyond - 0.5, _UNSEEN), len(first), gaps)


def _edges_at(filtration: Filtration, rows: IntArray) -> IntArray:
    """Return an edge at each of some points."""
    wanted = np.zeros(len(filtration.points), dtype=bool)
    wanted[rows] = True
    found = np.zeros(len(filtration.points), dtype=np.int32)
    for end in filtration.simplices[1].T:
        edges = np.flatnonzero(wanted.take(end))
        found[end.take(edges)] = edges
    return found.take(rows)
