"""Tiles of a periodic box: halos go round its borders.

A tile with its halo on all sides is narrower than a period, so that it knows no point
twice: it is a piece of an open cloud, whose coordinates are exact sums as in
:mod:`alphamesh.periodic`. Translations keep the lexicographic order that breaks ties, so
that neighbours across the border of the box agree as all do. Rows tell simplices apart,
and each belongs to the tile of its lowest row.
"""

from __future__ import annotations

import itertools
from typing import TYPE_CHECKING

import numpy as np

from alphamesh._arrays import read_only
from alphamesh.errors import PeriodsError
from alphamesh.periodic import wrapped_points
from alphamesh.tiles.tiling import Tiling, plan

if TYPE_CHECKING:
    from alphamesh._arrays import CountArray, FloatArray, IntArray, KindArray
    from alphamesh._kernels import Progress

__all__ = ["Periods", "check_box", "closed_box", "plan_in_box", "reach_in_box", "spread_in_box"]

Periods = tuple[float | None, ...]

# A tile takes half a period at most, its halo a quarter on either side; less what is rounded.
_WIDEST, _FARTHEST = 0.5, 0.125 * (1 - 2.0**-30)


def plan_in_box(sample: FloatArray, tiles: int, periods: Periods) -> Tiling:
    """Divide a periodic box so that a sample is spread evenly over tiles.

    Parameters
    ----------
    sample : (n, d) float64
        Points drawn from the whole cloud.
    tiles : int
        How many tiles to make, at least: none takes more than half a period.
    periods : tuple of float or None

    Returns
    -------
    Tiling
        Of places in the box.
    """
    tiling = plan(wrapped_points(sample, periods), tiles)
    axes, cuts = tiling.axes.tolist(), tiling.cuts.tolist()
    below, above = tiling.below.tolist(), tiling.above.tolist()
    waiting = [(tile, closed_box(box, periods)) for tile, box in enumerate(tiling.boxes)]
    count = len(tiling)
    while waiting:
        tile, box = waiting.pop()
        for axis, side in enumerate(periods):
            if side is None or box[1, axis] - box[0, axis] <= _WIDEST * side:
                continue
            at = float(box[0, axis] / 2 + box[1, axis] / 2)
            for children in (below, above):
                for node, child in enumerate(children):
                    if child == -1 - tile:
                        children[node] = len(cuts)
            axes.append(axis)
            cuts.append(at)
            below.append(-1 - tile)
            above.append(-1 - count)
            low, high = box.copy(), box.copy()
            low[1, axis] = high[0, axis] = at
            waiting += [(tile, low), (count, high)]
            count += 1
            break
    tree = (np.array(children, dtype=np.int64) for children in (axes, below, above))
    made_axes, made_below, made_above = (read_only(array) for array in tree)
    places = read_only(np.array(cuts, dtype=np.float64))
    return Tiling(tiling.dimension, made_axes, places, made_below, made_above)


def closed_box(box: FloatArray, periods: Periods) -> FloatArray:
    """Return the corners of a tile, which ends where the box does."""
    ends = np.array(
        [(-np.inf, np.inf) if side is None else (0.0, side) for side in periods], dtype=float
    ).T
    return np.stack((np.maximum(box[0], ends[0]), np.minimum(box[1], ends[1])))


def reach_in_box(reach: float, periods: Periods) -> float:
    """Return the reach of balls, and of what is rounded where points are wrapped."""
    return reach + max(side for side in periods if side is not None) * 2.0**-50


def check_box(periods: Periods, reach: float) -> None:
    """Refuse a radius whose halos are too wide for a box.

    Parameters
    ----------
    periods : tuple of float or None
    reach : float
        The radius of the largest balls.

    Raises
    ------
    PeriodsError
    """
    for axis, side in enumerate(periods):
        if side is not None and reach_in_box(reach, periods) > _FARTHEST * side:
            raise PeriodsError(
                "tiles need periods of at least 8 radii of the largest balls, "
                f"{8 * reach:.6g}; that along {'xyz'[axis]} is {side:.6g}. A box so small is "
                "worked on in memory: AlphaComplex(points, periods=...)"
            )


def spread_in_box(
    tiling: Tiling,
    points: FloatArray,
    periods: Periods,
    reach: float,
    progress: Progress | None = None,
) -> tuple[CountArray, IntArray, KindArray]:
    """Return the points that each tile needs to know, and how they are moved there.

    Parameters
    ----------
    tiling : Tiling
        From :func:`plan_in_box`.
    points : (n, d) float64
        As they come.
    periods : tuple of float or None
    reach : float
        The halo is twice as wide: the radius, with weights ``weight_range.reach(radius)``.
    progress : callable, optional

    Returns
    -------
    offsets : (t + 1,) int64
    rows : (k,) int32
        ``rows[offsets[i]:offsets[i + 1]]`` are those of tile i.
    moves : (k, d) int8
        How many periods each of them is away from its place in the box.
    """
    places = wrapped_points(points, periods)
    reach = reach_in_box(reach, periods)
    width = 2.0 * reach * (1 + 2.0**-30)  # a copy too many does no harm
    choices = []
    for at, side in zip(places.T, periods, strict=True):
        near = [(0, np.ones(len(at), dtype=bool))]
        if side is not None:
            near += [(-1, at >= side - width), (1, at <= width)]
        choices.append(near)
    found, moved = [], []
    for choice in itertools.product(*choices):
        near_by = np.flatnonzero(np.logical_and.reduce([there for _, there in choice]))
        found.append(near_by)
        move = np.array([[move for move, _ in choice]], dtype=np.int8)
        moved.append(np.repeat(move, len(near_by), axis=0))
    rows: IntArray = np.concatenate(found).astype(np.int32)
    moves = np.concatenate(moved)
    sides = np.array([0.0 if side is None else side for side in periods])
    copies = places.take(rows, axis=0) + moves * sides
    offsets, order, _ = tiling.spread(copies, reach, progress)
    return offsets, read_only(rows.take(order)), read_only(moves.take(order, axis=0))
