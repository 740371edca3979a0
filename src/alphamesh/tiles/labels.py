"""What hangs together across the borders of tiles: each tile tells its share."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from alphamesh._arrays import Record, read_only
from alphamesh._kernels.outlines import connected

if TYPE_CHECKING:
    from collections.abc import Sequence

    from alphamesh._arrays import CountArray, IntArray

__all__ = ["Border", "join"]


@dataclass(frozen=True, eq=False, repr=False)
class Border(Record):
    """The connected parts of what one tile knows, and what other tiles know of them.

    Attributes
    ----------
    count : int
        How many parts there are.
    keys : (b, w) int64
        Things that other tiles may know, too, named by rows of the whole cloud.
    labels : (b,) int32
        The part, from 0 to `count` - 1, of each of them.
    """

    count: int
    keys: CountArray
    labels: IntArray


def join(borders: Sequence[Border]) -> tuple[int, list[CountArray]]:
    """Join the parts of all tiles where they share something.

    Parameters
    ----------
    borders : sequence of Border
        At least one.

    Returns
    -------
    count : int
        How many parts the whole has.
    labels : list of (count_i,) int64
        For each tile the number, from 0 to `count` - 1, of each of its parts.
    """
    starts = np.concatenate(([0], np.cumsum([border.count for border in borders])))
    nodes = [border.labels + start for border, start in zip(borders, starts, strict=False)]
    keys = np.concatenate([border.keys for border in borders])
    links = _shared(keys, np.concatenate(nodes))
    total = int(starts[-1])
    joined = connected(total, links.astype(np.int32)).astype(np.int64)
    parts = [read_only(joined[a:b].copy()) for a, b in pairwise(starts)]
    return int(joined.max(initial=-1)) + 1, parts


def _shared(keys: CountArray, nodes: CountArray) -> CountArray:
    """Return pairs of nodes that know the same key, ``(k, 2)``."""
    order = np.lexsort(keys.T[::-1])
    keys, nodes = keys.take(order, axis=0), nodes.take(order)
    same = (keys[1:] == keys[:-1]).all(axis=1)
    return np.stack((nodes[:-1].compress(same), nodes[1:].compress(same)), axis=1)
