"""Representative cycles of loops: the shortest way around at the radius of birth."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from alphamesh.cycles import Rings, checked_classes, rings_of
from alphamesh.measures import edge_lengths, scaled_points

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from alphamesh._arrays import BoolArray, CountArray, FloatArray, IntArray
    from alphamesh.filtration import AnyFiltration

__all__ = ["shortest_loops"]


def shortest_loops(filtration: AnyFiltration, loops: IntArray, classes: ArrayLike) -> Rings:
    """Return a closed path for each loop: its creating edge and the shortest way back.

    Parameters
    ----------
    filtration : Filtration or Filtration3D
    loops : (p, 2) int32
        Creating edge and destroying triangle of each class.
    classes : int or sequence of int
        Rows of `loops`.

    Returns
    -------
    Rings
        One for each of `classes`. Lengths are compared as rounded sums of float64.

    Raises
    ------
    ParameterError
        If there is no such class.
    """
    wanted = checked_classes(classes, len(loops))
    creators = loops[:, 0].take(wanted)
    if len(creators) == 0:
        return rings_of([], [])
    roads = _Roads.until(filtration, float(filtration.radii[1].take(creators).max()))
    rings = [roads.way_around(edge) for edge in creators.tolist()]
    return rings_of(rings, wanted.tolist())


@dataclass(frozen=True, slots=True)
class _Roads:
    """The edges up to a radius as roads from each point, flat: both directions of each.

    Roads from point i are those from ``offsets[i]`` to ``offsets[i + 1]``.
    """

    filtration: AnyFiltration
    points: FloatArray  # over a power of two: no length overflows
    offsets: CountArray
    ends: IntArray
    edges: CountArray
    lengths: FloatArray

    @classmethod
    def until(cls, filtration: AnyFiltration, radius: float) -> _Roads:
        points, _ = scaled_points(filtration.points)
        there = np.flatnonzero(filtration.radii[1] <= radius)
        ends = filtration.simplices[1].take(there, axis=0)
        starts = np.concatenate((ends[:, 0], ends[:, 1]))
        order = np.argsort(starts, kind="stable")
        counts = np.bincount(starts, minlength=len(points))
        return cls(
            filtration,
            points,
            np.concatenate(([0], np.cumsum(counts, dtype=np.int64))),
            np.concatenate((ends[:, 1], ends[:, 0])).take(order),
            np.concatenate((there, there)).take(order),
            np.tile(edge_lengths(points, ends), 2).take(order),
        )

    def way_around(self, creator: int) -> list[int]:
        """Return the shortest way between the ends of an edge along edges before it."""
        start, goal = self.filtration.simplices[1][creator].tolist()
        open_ = self._before(creator)
        straight = _distances(self.points, goal)
        distance = np.full(len(self.points), np.inf)
        came_from = np.full(len(self.points), -1, dtype=np.int32)
        distance[start] = 0.0
        frontier = np.array([start])
        # All points that a round reached nearer than before go on in the next one.
        while len(frontier):
            sources, roads = self._roads_from(frontier)
            ends = self.ends.take(roads)
            length = distance.take(sources) + self.lengths.take(roads)
            nearer = open_.take(roads) & (length < distance.take(ends))
            nearer &= length + straight.take(ends) <= distance[goal]
            ends, length = ends.compress(nearer), length.compress(nearer)
            np.minimum.at(distance, ends, length)
            best = length == distance.take(ends)
            came_from[ends.compress(best)] = sources.compress(nearer).compress(best)
            frontier = np.unique(ends)
        path = [goal]
        while path[-1] != start:
            path.append(int(came_from[path[-1]]))
        return path[::-1]

    def _before(self, creator: int) -> BoolArray:
        """Return which roads run along edges that joined before one of them."""
        radii = self.filtration.radii[1]
        values, birth = radii.take(self.edges), radii[creator]
        # Edges of equal value join in their order.
        before: BoolArray = (values < birth) | ((values == birth) & (self.edges < creator))
        return before

    def _roads_from(self, points: CountArray) -> tuple[CountArray, CountArray]:
        """Return the roads that leave points, and from which one each does."""
        first = self.offsets.take(points)
        counts = self.offsets.take(points + 1) - first
        skipped = np.repeat(first - np.cumsum(counts) + counts, counts)
        return np.repeat(points, counts), skipped + np.arange(len(skipped))


def _distances(points: FloatArray, row: int) -> FloatArray:
    distance = np.zeros(len(points))
    for axis in points.T:
        np.hypot(distance, axis - axis[row], out=distance)
    return distance
