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

    from alphamesh._arrays import BoolArray, CountArray, IntArray, KindArray

__all__ = ["Border", "join", "labels_of", "numbered", "shared"]


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
    moves : (b, d) int8 or None
        Of components in a periodic box: how many periods each of them, in the tile's
        halo, is away from its place.
    """

    count: int
    keys: CountArray
    labels: IntArray
    moves: KindArray | None = None


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
    starts, nodes = numbered(borders)
    one, other = shared(np.concatenate([border.keys for border in borders]))
    links = np.stack((nodes.take(one), nodes.take(other)), axis=1)
    total = int(starts[-1])
    joined = connected(total, links.astype(np.int32)).astype(np.int64)
    parts = [read_only(joined[a:b].copy()) for a, b in pairwise(starts)]
    return int(joined.max(initial=-1)) + 1, parts


def numbered(borders: Sequence[Border]) -> tuple[CountArray, CountArray]:
    """Return the first number of each tile's parts, one after the other, and those of keys."""
    starts = np.concatenate(([0], np.cumsum([border.count for border in borders])))
    nodes = [border.labels + start for border, start in zip(borders, starts, strict=False)]
    return starts, np.concatenate(nodes)


def shared(keys: CountArray) -> tuple[CountArray, CountArray]:
    """Return pairs of rows of `keys` that are equal, enough to join all that are."""
    order = np.lexsort(keys.T[::-1])
    keys = keys.take(order, axis=0)
    same = (keys[1:] == keys[:-1]).all(axis=1)
    return order[:-1].compress(same), order[1:].compress(same)


def labels_of(links: IntArray | CountArray, seen: BoolArray) -> tuple[int, CountArray]:
    """Return how many parts the seen nodes of a graph make, and their numbers; -1 for the rest.

    Parameters
    ----------
    links : (k, 2) int
        Nodes that belong together.
    seen : (n,) bool
    """
    parts = connected(len(seen), np.ascontiguousarray(links, dtype=np.int32))
    found, numbers = np.unique(parts.compress(seen), return_inverse=True)
    labels = np.full(len(seen), -1, dtype=np.int64)
    labels[seen] = numbers
    return len(found), labels
