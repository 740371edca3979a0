"""What triangles are by the way they hang together: closed, oriented, manifold."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from alphamesh._arrays import CountArray, IntArray

__all__ = ["fan_of_corners", "is_closed", "is_manifold", "is_oriented", "side_keys"]


def sides_of(triangles: IntArray) -> IntArray:
    """Return the directed sides: of each triangle those opposite to its corners."""
    return triangles[:, [1, 2, 2, 0, 0, 1]].reshape(-1, 2)


def side_keys(triangles: IntArray) -> CountArray:
    """Return one number for each side, the same in both directions."""
    sides = np.sort(sides_of(triangles), axis=1).astype(np.int64)
    return (sides[:, 0] << 32) | sides[:, 1]


def is_closed(triangles: IntArray) -> bool:
    """Return whether every edge has an even number of triangles."""
    _, counts = np.unique(side_keys(triangles), return_counts=True)
    return bool((counts % 2 == 0).all())


def is_oriented(triangles: IntArray) -> bool:
    """Return whether every edge is run along as often one way as the other."""
    start, end = sides_of(triangles).T.astype(np.int64)
    keys, which = np.unique(side_keys(triangles), return_inverse=True)
    return not np.bincount(which, np.sign(end - start), len(keys)).any()


def is_manifold(triangles: IntArray) -> bool:
    """Return whether oriented triangles form a closed manifold.

    Parameters
    ----------
    triangles : (k, 3) int32

    Returns
    -------
    bool
        Every edge has two triangles, which run along it in opposite directions, and the
        triangles at each vertex form one fan.
    """
    if len(triangles) == 0:
        return True
    start, end = sides_of(triangles).T.astype(np.int64)
    forward, backward = np.sort((start << 32) | end), np.sort((end << 32) | start)
    if (forward[1:] == forward[:-1]).any() or not np.array_equal(forward, backward):
        return False
    return len(np.unique(fan_of_corners(triangles))) == len(np.unique(triangles))


def fan_of_corners(triangles: IntArray) -> CountArray:
    """Return the fan that each corner belongs to, by its first corner.

    Parameters
    ----------
    triangles : (k, 3) int32
        Each of their edges must have two triangles, in opposite directions.

    Returns
    -------
    (3 k,) int64
        Corner 3 t + j is ``triangles[t, j]``.
    """
    start, end = sides_of(triangles).T.astype(np.int64)
    order, back = np.argsort((start << 32) | end), np.argsort((end << 32) | start)
    # Side 3 t + j ends at corner j + 2; the side across the same edge begins there.
    across = np.empty_like(order)
    across[order] = back
    number = np.arange(len(across))
    following = np.empty_like(order)
    following[number - number % 3 + (number + 2) % 3] = across - across % 3 + (across + 1) % 3
    return _least_of_orbits(following)


def _least_of_orbits(following: CountArray) -> CountArray:
    """Return the least element of the cycle of each element, by pointer doubling."""
    least = np.arange(len(following))
    while True:
        lower = np.minimum(least, least.take(following))
        if np.array_equal(lower, least):
            return least
        least, following = lower, following.take(following)
