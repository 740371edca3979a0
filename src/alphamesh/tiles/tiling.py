"""A tiling of space into boxes with about equally many points each, and its halos."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from alphamesh._arrays import Record, read_only
from alphamesh._kernels.tiles import spread
from alphamesh.errors import ParameterError

if TYPE_CHECKING:
    from alphamesh._arrays import CountArray, FloatArray, IntArray
    from alphamesh._kernels import Progress

__all__ = ["Tiling", "halo_width", "plan"]

# A float radius says less than this much more than the exact one.
_MARGIN = 1.0 + 2.0**-40


@dataclass(frozen=True, eq=False, repr=False)
class Tiling(Record):
    """Boxes that divide space, as a tree of cuts.

    Node i cuts at ``cuts[i]`` along ``axes[i]``: what lies below goes to node
    ``below[i]``, the rest, the cut itself included, to ``above[i]``. A negative number
    ``-1 - t`` stands for tile t. The boxes are half open, so that each point of space
    belongs to one tile, whatever its coordinates.

    Attributes
    ----------
    dimension : int
    axes : (m,) int64
    cuts : (m,) float64
    below, above : (m,) int64

    References
    ----------
    .. [1] J. L. Bentley, Multidimensional binary search trees used for associative
       searching, Communications of the ACM 18 (1975) 509-517.
    """

    dimension: int
    axes: CountArray
    cuts: FloatArray
    below: CountArray
    above: CountArray

    def __len__(self) -> int:
        return len(self.cuts) + 1

    @cached_property
    def boxes(self) -> FloatArray:
        """Lower and upper corner of each tile, ``(t, 2, d)``; infinite at the rim."""
        boxes = np.empty((len(self), 2, self.dimension))
        boxes[:, 0], boxes[:, 1] = -np.inf, np.inf
        waiting = [(0 if len(self.cuts) else -1, boxes[0].copy())]
        while waiting:
            node, box = waiting.pop()
            if node < 0:
                boxes[-1 - node] = box
                continue
            for child, side in ((self.below[node], 1), (self.above[node], 0)):
                part = box.copy()
                part[side, self.axes[node]] = self.cuts[node]
                waiting.append((int(child), part))
        return read_only(boxes)

    def tile_of(self, points: FloatArray) -> CountArray:
        """Return the tile that each point belongs to, ``(n,)`` int64."""
        offsets, rows, _ = self._send(points, self.cuts, self.cuts)
        tiles = np.empty(len(points), dtype=np.int64)
        tiles[rows] = np.repeat(np.arange(len(self)), np.diff(offsets))
        return tiles

    def with_halo(self, points: FloatArray, radius: float) -> tuple[CountArray, CountArray]:
        """Return the points that each tile needs to know: its own, and those around it.

        Parameters
        ----------
        points : (n, d) float64
        radius : float
            The halo is twice as wide.

        Returns
        -------
        offsets : (t + 1,) int64
        rows : (k,) int64
            ``rows[offsets[i]:offsets[i + 1]]``, ascending, are those of tile i.
        """
        offsets, rows, _ = self.spread(points, radius)
        return offsets, rows.astype(np.int64)

    def spread(
        self, points: FloatArray, radius: float, progress: Progress | None = None
    ) -> tuple[CountArray, IntArray, FloatArray]:
        """Return what :meth:`with_halo` does, and the points in this order.

        Parameters
        ----------
        points : (n, d) float64
        radius : float
        progress : callable, optional

        Returns
        -------
        offsets : (t + 1,) int64
        rows : (k,) int32
        points : (k, d) float64
        """
        width = halo_width(radius)
        # A sum is rounded, so the next float is surely not too near.
        low = np.nextafter(self.cuts + width, np.inf)
        high = np.nextafter(self.cuts - width, -np.inf)
        return self._send(points, low, high, progress)

    def _send(
        self,
        points: FloatArray,
        low: FloatArray,
        high: FloatArray,
        progress: Progress | None = None,
    ) -> tuple[CountArray, IntArray, FloatArray]:
        points = np.ascontiguousarray(points, dtype=np.float64)
        return spread(points, self.axes, low, high, self.below, self.above, progress)

    def bounds(self, tile: int, radius: float) -> FloatArray:
        """Return the box of a tile, and how near to it other tiles see its points.

        Parameters
        ----------
        tile : int
        radius : float

        Returns
        -------
        (4, d) float64
            Lower and upper corner; others may know points that are not above the third
            row, or not below the last one, in any coordinate.
        """
        return self.bounds_of(self.boxes[tile], radius)

    @staticmethod
    def bounds_of(box: FloatArray, radius: float) -> FloatArray:
        """Return the same of a box, ``(2, d)``, that is not one of the tiling's."""
        (low, high), width = box, halo_width(radius)
        near = np.nextafter(low + width, np.inf), np.nextafter(high - width, -np.inf)
        return read_only(np.stack((low, high, *near)))

    def __repr__(self) -> str:
        return f"<Tiling: {len(self):,} tiles of dimension {self.dimension}>"


def halo_width(radius: float) -> float:
    """Return how far around a tile points matter for simplices up to a radius.

    A simplex of value at most r lies in an empty ball of radius r through its vertices,
    so that all that decides upon it is within 2 r of each of them.
    """
    return 2.0 * radius * _MARGIN


def plan(sample: FloatArray, tiles: int) -> Tiling:
    """Divide space so that a sample is spread evenly over tiles.

    Each cut divides a box and its tiles in two halves, across the longest side of its
    points. The result is right for any sample; a good one makes it balanced.

    Parameters
    ----------
    sample : (n, d) float64
        Points drawn from the whole cloud.
    tiles : int
        How many tiles to make; fewer where points are equal.

    Returns
    -------
    Tiling
    """
    if tiles < 1:
        raise ParameterError(f"tiles must be at least 1; got {tiles!r}")
    tree = _Tree(sample)
    tree.grow(np.arange(len(sample), dtype=np.int64), tiles)
    return tree.tiling()


class _Tree:
    """A tree of cuts while it is made."""

    def __init__(self, sample: FloatArray) -> None:
        self.sample = sample
        self.cuts: list[tuple[int, float]] = []
        self.children: list[tuple[int, int]] = []
        self.leaves = 0

    def grow(self, rows: CountArray, tiles: int) -> int:
        """Divide some rows between tiles; return the number of the node or leaf."""
        points = self.sample.take(rows, axis=0)
        cut = _cut(points, tiles // 2 / tiles) if tiles > 1 and len(rows) > 1 else None
        if cut is None:
            self.leaves += 1
            return -self.leaves
        node = len(self.cuts)
        self.cuts.append(cut)
        self.children.append((0, 0))
        low = points[:, cut[0]] < cut[1]
        below = self.grow(rows.compress(low), tiles // 2)
        above = self.grow(rows.compress(~low), tiles - tiles // 2)
        self.children[node] = below, above
        return node

    def tiling(self) -> Tiling:
        children = np.array(self.children, dtype=np.int64).reshape(-1, 2)
        return Tiling(
            self.sample.shape[1],
            read_only(np.array([axis for axis, _ in self.cuts], dtype=np.int64)),
            read_only(np.array([at for _, at in self.cuts], dtype=np.float64)),
            read_only(children[:, 0].copy()),
            read_only(children[:, 1].copy()),
        )


def _cut(points: FloatArray, share: float) -> tuple[int, float] | None:
    """Return the axis and the place that have a share of some points below, if they differ."""
    low, high = points.min(axis=0), points.max(axis=0)
    axis = int(np.argmax(high / 2 - low / 2))
    if low[axis] == high[axis]:
        return None
    values = points[:, axis]
    place = int(len(values) * share)
    at = float(np.partition(values, place)[place])
    if at == low[axis]:  # nothing below: the next larger value is the nearest cut
        at = float(values.compress(values > at).min())
    return axis, at
