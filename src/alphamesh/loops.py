"""Representative cycles of loops: the shortest way around at the radius of birth."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from alphamesh.cycles import Rings, checked_classes, rings_of
from alphamesh.measures import edge_lengths, scaled_points

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from alphamesh._arrays import BoolArray, CountArray, FloatArray, IntArray
    from alphamesh.filtration import AnyFiltration

__all__ = ["Roads", "shortest_loops"]


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
    roads = _roads_of(filtration, float(filtration.radii[1].take(creators).max()))
    rings = [
        [start, *roads.ends.take(roads.way_around(edge)).tolist()]
        for edge, start in zip(
            creators.tolist(), filtration.simplices[1][creators, 0].tolist(), strict=True
        )
    ]
    return rings_of(rings, wanted.tolist())


def _roads_of(filtration: AnyFiltration, radius: float) -> Roads:
    points, _ = scaled_points(filtration.points)  # no length overflows
    there = np.flatnonzero(filtration.radii[1] <= radius)
    lengths = edge_lengths(points, filtration.simplices[1].take(there, axis=0))
    return Roads.along(
        filtration.simplices[1],
        filtration.radii[1],
        there,
        lengths,
        partial(_distances, points),
    )


@dataclass(frozen=True, slots=True)
class Roads:
    """Edges as roads from each point, flat: both directions of each.

    Roads from point i are those from ``offsets[i]`` to ``offsets[i + 1]``. Points may be
    joined by several edges, or to themselves.

    Attributes
    ----------
    edges : (E, 2) int32
    radii : (E,) float64
        When they join.
    straight : callable
        The least distance of all points from one.
    offsets : (n + 1,) int64
    starts, ends : (m,) int32
    numbers : (m,) int64
        Of edges.
    lengths : (m,) float64
    """

    edges: IntArray
    radii: FloatArray
    straight: Callable[[int], FloatArray]
    offsets: CountArray
    starts: IntArray
    ends: IntArray
    numbers: CountArray
    lengths: FloatArray

    @classmethod
    def along(
        cls,
        edges: IntArray,
        radii: FloatArray,
        there: CountArray,
        lengths: FloatArray,
        straight: Callable[[int], FloatArray],
    ) -> Roads:
        """Return roads along the edges that are `there`, of the given lengths."""
        ends = edges.take(there, axis=0)
        starts = np.concatenate((ends[:, 0], ends[:, 1]))
        order = np.argsort(starts, kind="stable")
        counts = np.bincount(starts, minlength=len(straight(0)))
        return cls(
            edges,
            radii,
            straight,
            np.concatenate(([0], np.cumsum(counts, dtype=np.int64))),
            starts.take(order),
            np.concatenate((ends[:, 1], ends[:, 0])).take(order),
            np.concatenate((there, there)).take(order),
            np.tile(lengths, 2).take(order),
        )

    def way_around(self, creator: int) -> list[int]:
        """Return the shortest way between the ends of an edge along edges before it: roads."""
        start, goal = self.edges[creator].tolist()
        open_ = self._before(creator)
        straight = self.straight(goal)
        distance = np.full(len(straight), np.inf)
        came_by = np.full(len(straight), -1, dtype=np.int64)
        distance[start] = 0.0
        frontier = np.array([start])
        # All points that a round reached nearer than before go on in the next one.
        while len(frontier):
            roads = self._roads_from(frontier)
            ends = self.ends.take(roads)
            length = distance.take(self.starts.take(roads)) + self.lengths.take(roads)
            nearer = open_.take(roads) & (length < distance.take(ends))
            nearer &= length + straight.take(ends) <= distance[goal]
            ends, length = ends.compress(nearer), length.compress(nearer)
            np.minimum.at(distance, ends, length)
            best = length == distance.take(ends)
            came_by[ends.compress(best)] = roads.compress(nearer).compress(best)
            frontier = np.unique(ends)
        path: list[int] = []
        while goal != start:
            path.append(int(came_by[goal]))
            goal = int(self.starts[path[-1]])
        return path[::-1]

    def _before(self, creator: int) -> BoolArray:
        """Return which roads run along edges that joined before one of them."""
        values, birth = self.radii.take(self.numbers), self.radii[creator]
        # Edges of equal value join in their order.
        before: BoolArray = (values < birth) | ((values == birth) & (self.numbers < creator))
        return before

    def _roads_from(self, points: CountArray) -> CountArray:
        """Return the roads that leave points."""
        first = self.offsets.take(points)
        counts = self.offsets.take(points + 1) - first
        skipped = np.repeat(first - np.cumsum(counts) + counts, counts)
        return skipped + np.arange(len(skipped))


def _distances(points: FloatArray, row: int) -> FloatArray:
    distance = np.zeros(len(points))
    for axis in points.T:
        np.hypot(distance, axis - axis[row], out=distance)
    return distance
