"""``python -m benchmarks.tiles``: a cloud on disk, tile by tile, beside the cloud in memory.

Writes a cloud of uniform points to a folder of NPY files, a part at a time, builds its
alpha complex with processes of its own, and tells the points per second of each stage, the
peak memory of all processes together and the size of the result. A tenth of the cloud,
built in memory with all cores, is the measure; a small cloud is compared bit for bit.
"""

from __future__ import annotations

import argparse
import os
import tempfile
import threading
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

import numpy as np

import alphamesh as am
from alphamesh import tiles
from benchmarks.machine import cores

__all__ = ["main"]

# In mean spacings: nearly all triangles of the triangulation are there.
_RADIUS = 2.0
_PART = 5_000_000
_COMPARED = 200_000


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line; 1 if the tiles are not the whole."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.tiles")
    parser.add_argument("--points", type=float, default=1e7, help="100000000, say, or 1e8")
    parser.add_argument("--tile-points", type=float, default=500_000)
    parser.add_argument("--processes", type=int, default=cores(), help="0: in this process")
    parser.add_argument("--folder", help="where to work; gigabytes for large clouds")
    parser.add_argument("--tiny", action="store_true", help="60,000 points, in seconds")
    options = parser.parse_args(arguments)
    count, tile_points = int(options.points), int(options.tile_points)
    if options.tiny:
        count, tile_points, options.processes = 60_000, 20_000, 0
    with tempfile.TemporaryDirectory(dir=options.folder) as folder:
        same = _compare(Path(folder), min(count, _COMPARED))
        print(f"tiles of a small cloud are its complex, bit for bit: {'yes' if same else 'NO'}")
        _measure(Path(folder), count, tile_points, options.processes)
    return 0 if same else 1


def _compare(folder: Path, count: int) -> bool:
    data = _written(folder / "small", count)
    result = tiles.run(data, _RADIUS, folder / "small-tiles", tile_points=count // 7)
    whole = am.filtration(np.concatenate([chunk.read() for chunk in data.chunks]))
    for k in range(3):
        there = whole.radii[k] <= _RADIUS
        wanted = whole.simplices[k].compress(there, axis=0)
        order = np.lexsort(wanted.T[::-1])
        simplices, radii = result.simplices(k)
        if not (
            np.array_equal(simplices, wanted.take(order, axis=0))
            and np.array_equal(radii, whole.radii[k].compress(there).take(order))
        ):
            return False
    return True


def _measure(folder: Path, count: int, tile_points: int, processes: int) -> None:
    data = _written(folder / "cloud", count)
    in_memory = _speed_in_memory(max(count // 10, 1000))
    with _peak_memory() as peak:
        start = time.perf_counter()
        result = tiles.run(
            data,
            _RADIUS,
            folder / "tiles",
            tile_points=tile_points,
            cluster="local" if processes else None,
            processes=processes or None,
        )
        taken = time.perf_counter() - start
    size = sum(file.stat().st_size for file in result.folder.rglob("*") if file.is_file())
    speed = count / taken
    print(f"points                         {count:,} in {len(result.tiling):,} tiles")
    print(f"cells                          {result.summary.counts[-1]:,}")
    print(f"time                           {taken:.1f} s, {speed:,.0f} points a second")
    print(f"a tenth of them in memory      {in_memory:,.0f} points a second")
    print(f"ratio                          {speed / in_memory:.2f}")
    print(f"peak memory of all processes   {max(peak) / 1e9:.2f} GB")
    print(f"result on disk                 {size / 1e9:.2f} GB")


def _written(folder: Path, count: int) -> tiles.Dataset:
    """Write uniform points, one to each unit of area, a part at a time."""
    folder.mkdir()
    side = np.sqrt(count)
    for part, start in enumerate(range(0, count, _PART)):
        rng = np.random.default_rng(part)
        np.save(folder / f"{part:05}.npy", rng.random((min(_PART, count - start), 2)) * side)
    return tiles.dataset(folder)


def _speed_in_memory(count: int) -> float:
    points = np.random.default_rng(0).random((count, 2))
    times = []
    for _ in range(3):
        start = time.perf_counter()
        am.filtration(points)
        times.append(time.perf_counter() - start)
    return count / sorted(times)[1]


@contextmanager
def _peak_memory() -> Iterator[list[float]]:
    """Watch the memory of this process and its children; shared pages count once."""
    import psutil  # type: ignore[import-untyped,unused-ignore]

    peaks = [0.0]
    done = threading.Event()

    def watch() -> None:
        me = psutil.Process(os.getpid())
        while not done.wait(0.5):
            total = 0.0
            for process in (me, *me.children(recursive=True)):
                try:
                    info = process.memory_full_info()
                except psutil.Error:
                    continue
                total += getattr(info, "pss", info.uss)
            peaks.append(total)

    watcher = threading.Thread(target=watch, daemon=True)
    watcher.start()
    try:
        yield peaks
    finally:
        done.set()
        watcher.join()


if __name__ == "__main__":
    raise SystemExit(main())
