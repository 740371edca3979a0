"""From a cloud on disk to its alpha complex on disk, tile by tile."""

from __future__ import annotations

import math
import os
import shutil
from collections.abc import Callable, Generator, Iterator
from contextlib import closing
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from alphamesh.errors import ParameterError, PeriodsError
from alphamesh.tiles.box_pieces import solve_in_box
from alphamesh.tiles.boxes import check_box, plan_in_box, spread_in_box
from alphamesh.tiles.complex import TiledComplex
from alphamesh.tiles.dataset import Chunk, Dataset
from alphamesh.tiles.merge import merge
from alphamesh.tiles.pieces import solve
from alphamesh.tiles.store import Store
from alphamesh.tiles.tiling import Tiling, plan
from alphamesh.tiles.weighing import WeightRange
from alphamesh.tiles.workers import Workers, computing, go_on, workers_of

if TYPE_CHECKING:
    from alphamesh._arrays import CountArray, FloatArray, IntArray
    from alphamesh.tiles.pieces import Piece

__all__ = ["run"]

_TILE_POINTS = 500_000
# How many points of a sample a tile shall have, so that tiles are balanced.
_SAMPLE = 1_000
# Shares of the work, for progress.
_SURVEYED, _SPREAD, _SOLVED = 0.05, 0.25, 0.98

Progress = Callable[[float], object]


def run(  # noqa: PLR0913 (each is a choice of the user's)
    data: Dataset,
    radius: float,
    folder: str | os.PathLike[str],
    *,
    tile_points: int = _TILE_POINTS,
    cluster: Any = None,
    processes: int | None = None,
    threads: int | None = None,
    overwrite: bool = False,
    keep_chunks: bool = False,
    progress: Progress | None = None,
) -> TiledComplex:
    """Compute the alpha complex of a cloud on disk up to a radius, and keep it on disk.

    The result is that of the cloud as a whole, bit for bit; no more than a tile with its
    halo has to fit in the memory of a worker. A run that was stopped goes on where it
    was: finished tiles whose checksums are right are not computed again.

    Parameters
    ----------
    data : Dataset
        See :func:`dataset`. Files must be within reach of all workers.
    radius : float
        Not negative, finite. Tiles need a halo of twice this width: many times the
        distance between points is slow. With weights it is a signed root of a power value,
        see :class:`alphamesh.Filtration`, and may be negative; the halo is twice as wide
        as the largest ball at this radius.
    folder : path-like
        For the result; made if it is not there. Within reach of all workers.
    tile_points : int
        About how many points a tile shall have; it takes some 500 bytes of memory each.
    cluster : None, "local", str or distributed.Client
        Who works: threads of this process, processes of its own on this machine, or the
        Dask cluster of this address or client.
    processes : int, optional
        How many for "local"; by default one for each CPU.
    threads : int, optional
        How many tiles this process computes at a time if there is no cluster, while it
        reads or writes one or a few more; by default one for each CPU.
    overwrite : bool
        Delete another run's result in the folder.
    keep_chunks : bool
        Keep the points that were sorted into tiles once all is done.
    progress : callable, optional
        Called with the fraction that is done.

    Returns
    -------
    TiledComplex

    Raises
    ------
    ParameterError
        If `radius` or `tile_points` is not what it must be, or the folder holds
        something else.
    PeriodsError
        If a periodic box is too small for tiles with halos.
    FileReadError, FileWriteError, NonFiniteError, WeightsError
        If the data cannot be read, or the result not be written.
    """
    radius = _checked_radius(radius, weighted=data.weights is not None)
    if tile_points < 1:
        raise ParameterError(f"tile_points must be at least 1; got {tile_points!r}")
    if data.periods is not None and data.weights is None:  # else, weights come first
        check_box(data.periods, radius)
    store = Store(Path(folder).absolute())
    _begin(store, data, radius, int(tile_points), overwrite=overwrite)
    told = _unheard if progress is None else progress
    with workers_of(cluster, processes, threads) as workers:
        try:
            _plan(store, data, radius, int(tile_points), workers, told)
        except PeriodsError:
            shutil.rmtree(store.folder)  # holds what was just begun, and nothing else
            raise
        tiling = _solve(store, data, radius, workers, told)
    parts = [store.part(tile)[0] for tile in range(len(tiling))]
    store.write_summary(merge(parts, radius, periodic=data.periods is not None)[0])
    if not keep_chunks:
        store.spool(tiling).drop()
    told(1.0)
    return TiledComplex(store.folder)


def _unheard(fraction: float) -> None:
    """Take no notice."""


def _checked_radius(radius: Any, *, weighted: bool) -> float:
    try:
        value = float(radius)
    except (TypeError, ValueError):
        value = math.nan
    if not (math.isfinite(value) and (weighted or value >= 0)):
        least = "finite" if weighted else "0 or more and finite"
        raise ParameterError(f"radius must be a number, {least}; got {radius!r}")
    return value


def _begin(
    store: Store, data: Dataset, radius: float, tile_points: int, *, overwrite: bool
) -> None:
    """Make sure that the folder is empty, or holds the beginning of this very run."""
    wanted = {
        "format": 2,
        "data": data.digest,
        "points": data.count,
        "dimension": data.dimension,
        "chunks": len(data.chunks),
        "radius": radius,
        "tile_points": tile_points,
        **({} if data.weights is None else {"weights": data.weights}),
        **({} if data.periods is None else {"periods": list(data.periods)}),
    }
    known = store.manifest()
    if known == wanted:
        return
    if store.folder.exists() and any(store.folder.iterdir()):
        if known is None:
            raise ParameterError(
                f"{store.folder} holds other files; choose an empty folder or a new one"
            )
        if not overwrite:
            keys = dict.fromkeys((*wanted, *known))
            different = ", ".join(key for key in keys if known.get(key) != wanted.get(key))
            raise ParameterError(
                f"{store.folder} holds another run (different: {different}); choose another "
                "folder, or replace it with overwrite=True"
            )
        shutil.rmtree(store.folder)
    store.write_manifest(wanted)


def _plan(  # noqa: PLR0913, PLR0917 (what a run is given)
    store: Store,
    data: Dataset,
    radius: float,
    tile_points: int,
    workers: Workers,
    told: Progress,
) -> None:
    if store.plan() is not None:
        return
    tiles = max(1, math.ceil(data.count / tile_points))
    share = min(1.0, _SAMPLE * tiles / max(data.count, 1))
    done = workers.each(partial(_sample, share=share), data.chunks)
    found = dict(_counted(done, len(data.chunks), told, 0.0, _SURVEYED))
    samples = [found[k][0] for k in sorted(found)]
    sample = np.concatenate([np.empty((0, data.dimension)), *samples])
    first_rows = np.array([chunk.first_row for chunk in data.chunks], dtype=np.int64)
    weights = None
    if data.weights is not None:
        weights = WeightRange.of(np.array([part[1] for part in found.values()]).ravel())
    if data.periods is None:
        tiling = plan(sample, tiles)
    else:
        if weights is not None:
            check_box(data.periods, weights.reach(radius))
        tiling = plan_in_box(sample, tiles, data.periods)
    store.write_plan(tiling, first_rows, weights)


def _solve(
    store: Store, data: Dataset, radius: float, workers: Workers, told: Progress
) -> Tiling:
    tiling = store.plan()
    assert tiling is not None
    done = dict(workers.each(partial(_has_tile, folder=store.folder), range(len(tiling))))
    tiles = [tile for tile in range(len(tiling)) if not done[tile]]
    if tiles:
        spread = partial(_spread, folder=store.folder, radius=radius)
        for _ in _counted(
            workers.each(spread, data.chunks), len(data.chunks), told, _SURVEYED, _SPREAD
        ):
            pass
    # All that a task needs to know beyond a few words is in the folder.
    row_type = np.int32 if data.count <= np.iinfo(np.int32).max else np.int64
    work = partial(_solve_tile, folder=store.folder, radius=radius, row_type=row_type)
    for _ in _counted(workers.each(work, tiles), len(tiles), told, _SPREAD, _SOLVED):
        pass
    return tiling


def _counted(
    results: Generator[Any, None, None], total: int, told: Progress, start: float, end: float
) -> Iterator[Any]:
    with closing(results):  # at once, should `told` raise
        for number, result in enumerate(results, start=1):
            told(start + (end - start) * number / total)
            yield result


# ------------------------------------------------------- tasks, one process each


def _sample(chunk: Chunk, share: float) -> tuple[int, tuple[FloatArray, tuple[float, ...]]]:
    """Return some points of a chunk, the same ones each time, and the range of all weights."""
    sample = chunk.sample(math.ceil(chunk.count * share))
    if chunk.weight is None:
        return chunk.number, (sample, ())
    weights = WeightRange.of(chunk.read_weights())
    return chunk.number, (sample, (weights.least, weights.greatest))


def _has_tile(tile: int, folder: Path) -> tuple[int, bool]:
    """Tell whether a tile is complete."""
    return tile, Store(folder).has_tile(tile)


def _spread(chunk: Chunk, folder: Path, radius: float) -> None:
    """Sort the points of a chunk into tiles and their halos, unless that is done."""
    store = Store(folder)
    tiling = store.plan()
    assert tiling is not None
    spool = store.spool(tiling)
    if not spool.holds(chunk.number):
        with computing():
            found = _sent(store, tiling, chunk.read_weighted(), radius)
        spool.write(chunk.number, *found)


def _solve_tile(tile: int, folder: Path, radius: float, row_type: Any) -> int:
    """Compute and keep what a tile owns."""
    store = Store(folder)
    tiling = store.plan()
    assert tiling is not None
    rows, points = store.spool(tiling).points_of(tile, store.first_rows(), row_type)
    with computing():
        piece = _solved(store, tiling, tile, rows, points, radius)
    store.write_tile(piece)
    return tile


# What goes along with the points, as one coordinate more each: weights, and moves round a
# periodic box, of -1, 0 or 1 as one number.
_DIGITS = 3 ** np.arange(3)


def _sent(
    store: Store, tiling: Tiling, table: FloatArray, radius: float
) -> tuple[CountArray, IntArray, FloatArray]:
    """Return the points of a chunk, with all that goes along, sorted into tiles."""
    reach = _reach(store, radius)
    if store.periods is None:
        return tiling.spread(table, reach, go_on)
    points = table[:, : tiling.dimension]
    offsets, rows, moves = spread_in_box(tiling, points, store.periods, reach, go_on)
    codes = (moves + 1) @ _DIGITS[: moves.shape[1]]
    return offsets, rows, np.column_stack((table.take(rows, axis=0), codes))


def _solved(  # noqa: PLR0913, PLR0917 (a tile, its points and the radius)
    store: Store,
    tiling: Tiling,
    tile: int,
    rows: CountArray,
    table: FloatArray,
    radius: float,
) -> Piece:
    """Return what a tile owns, from its points and all that goes along with them."""
    d, weight_range = tiling.dimension, store.weight_range()
    points = np.ascontiguousarray(table[:, :d])
    weights = None if weight_range is None else np.ascontiguousarray(table[:, d])
    if store.periods is None:
        return solve(
            tiling, tile, rows, points, radius,
            weights=weights, weight_range=weight_range, progress=go_on,
        )  # fmt: skip
    moves = table[:, -1:].astype(np.int64) // _DIGITS[:d] % 3 - 1
    return solve_in_box(
        tiling, tile, rows, points, moves.astype(np.int8), store.periods, radius,
        weights=weights, weight_range=weight_range, progress=go_on,
    )  # fmt: skip


def _reach(store: Store, radius: float) -> float:
    """Return the radius of the largest balls."""
    weights = store.weight_range()
    return radius if weights is None else weights.reach(radius)
