"""Which components of a complex run around a periodic box, from what tiles tell of borders.

A tile lies in open space, where each point that it knows has one place. Parts of two tiles
that share a point are moved so that they meet there; a way from part to part that comes back
to where it began, but some periods away, runs around the box.
"""

from __future__ import annotations

from collections import defaultdict
from typing import TYPE_CHECKING

import numpy as np

from alphamesh.tiles.labels import join, numbered, shared

if TYPE_CHECKING:
    from collections.abc import Sequence

    from alphamesh._arrays import CountArray
    from alphamesh.tiles.labels import Border

__all__ = ["windings"]


def windings(borders: Sequence[Border]) -> tuple[int, ...]:
    """Return how many components run around a box in 0, 1, ... independent directions.

    Parameters
    ----------
    borders : sequence of Border
        Those of components, with moves, one for each tile.

    Returns
    -------
    tuple of d + 1 int
        Their sum is the number of components.
    """
    count, labels = join(borders)
    component = np.concatenate(labels).tolist()
    moves = np.concatenate([border.moves for border in borders if border.moves is not None])
    one, other = shared(np.concatenate([border.keys for border in borders]))
    _, nodes = numbered(borders)
    steps = moves.take(one, axis=0).astype(np.int64) - moves.take(other, axis=0)
    links = np.column_stack((nodes.take(one), nodes.take(other), steps))
    links = np.unique(links, axis=0)
    loops = defaultdict(set)
    for node, loop in _loops(links):
        loops[component[node]].add(loop)
    found = np.zeros(moves.shape[1] + 1, dtype=np.int64)
    for vectors in loops.values():
        found[_rank(vectors)] += 1
    found[0] += count - len(loops)
    return tuple(found.tolist())


def _loops(links: CountArray) -> list[tuple[int, tuple[int, ...]]]:
    """Return a node of each loop of links that does not close, and by how much it fails to.

    Parameters
    ----------
    links : (k, 2 + d) int64
        Two nodes, and how far the second must be moved to meet the first.
    """
    around: dict[int, list[tuple[int, tuple[int, ...]]]] = defaultdict(list)
    for a, b, *step in links.tolist():
        around[a].append((b, tuple(step)))
        around[b].append((a, tuple(-s for s in step)))
    places: dict[int, tuple[int, ...]] = {}
    found = []
    for start in around:
        if start in places:
            continue
        places[start] = (0,) * (links.shape[1] - 2)
        waiting = [start]
        while waiting:
            node = waiting.pop()
            for other, step in around[node]:
                at = tuple(p + s for p, s in zip(places[node], step, strict=True))
                if other not in places:
                    places[other] = at
                    waiting.append(other)
                elif places[other] != at:
                    gap = tuple(p - q for p, q in zip(at, places[other], strict=True))
                    found.append((node, gap))
    return found


def _rank(vectors: set[tuple[int, ...]]) -> int:
    """Return how many of some vectors of integers are independent, exactly."""
    rows, rank = [list(vector) for vector in vectors], 0
    for column in range(len(rows[0])):
        pivot = next((row for row in rows if row[column]), None)
        if pivot is None:
            continue
        rank += 1
        rows = [
            [pivot[column] * x - row[column] * p for x, p in zip(row, pivot, strict=True)]
            for row in rows
            if row is not pivot
        ]
    return rank
