"""``python -m benchmarks.tiles``: a cloud on disk, tile by tile, beside the cloud in memory.

Writes a cloud of uniform points to a folder of NPY files, a part at a time, builds its
alpha complex, and tells the points per second, the peak memory of all processes together
and the size of the result. A cloud in memory, built before and after with all cores, is the
measure; a small cloud is compared bit for bit. ``--costs`` measures what each step of a tile
takes instead. The runs of record, some 20 GB on disk for the largest::

    python -m benchmarks.tiles --points 1e7 --write-docs docs
    python -m benchmarks.tiles --points 1e8 --write-docs docs
    python -m benchmarks.tiles --points 2e7 --dimension 3 --write-docs docs
    python -m benchmarks.tiles --costs --write-docs docs
    python -m benchmarks.tiles --costs --dimension 3 --tile-points 5e5 --write-docs docs
"""

from __future__ import annotations

import argparse
import os
import statistics
import tempfile
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TypeVar

import numpy as np

import alphamesh as am
from alphamesh import tiles
from alphamesh._kernels.tiles import Recycling
from alphamesh.tiles.store import Store
from benchmarks import machine
from benchmarks.tables import replace_between_markers

__all__ = ["main"]

Result = TypeVar("Result")

_PART = 5_000_000
_COMPARED = 200_000


@dataclass(frozen=True, slots=True)
class Kind:
    """What a dimension asks for; the radius is in mean spacings.

    At this radius, nearly all cells of the triangulation are there.
    """

    name: str
    dimension: int
    radius: float
    tile_points: int
    in_memory: int


_KINDS = {
    2: Kind("the plane", 2, 2.0, 500_000, 10_000_000),
    3: Kind("space", 3, 1.5, 1_000_000, 2_000_000),
}


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line; 1 if the tiles are not the whole."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.tiles")
    add = parser.add_argument
    add("--points", type=float, default=1e7, help="100000000, say, or 1e8")
    add("--dimension", type=int, choices=(2, 3), default=2)
    add("--tile-points", type=float, help="by default 500,000 in the plane, 1,000,000 in space")
    add("--threads", type=int, help="of this process; by default one for each core")
    add("--processes", type=int, help="so many processes of Dask instead of threads")
    add("--folder", type=Path, help="where to work; gigabytes for large clouds")
    add("--costs", action="store_true", help="measure the steps of one tile, on one core")
    add("--tiny", action="store_true", help="60,000 points, in seconds")
    add("--write-docs", type=Path, metavar="DIR", help="put the figures into tiles.md in DIR")
    options = parser.parse_args(arguments)
    kind = _KINDS[options.dimension]
    count, tile_points = int(options.points), int(options.tile_points or kind.tile_points)
    if options.tiny:
        count, tile_points = 60_000, min(tile_points, 20_000)
    if options.folder is not None:
        options.folder.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=options.folder) as name:
        folder = Path(name)
        same = _compare(folder, kind, min(count, _COMPARED))
        print(f"tiles of a small cloud are its complex, bit for bit: {'yes' if same else 'NO'}")
        if options.costs:
            table = _costs(folder, kind, tile_points)
            print(table)
            if options.write_docs is not None:
                path = options.write_docs / "tiles.md"
                replace_between_markers(path, table, f"tile-costs-{kind.dimension}")
            return 0 if same else 1
        row = _measure(folder, kind, count, tile_points, options.threads, options.processes)
    if options.write_docs is not None and same:
        _add_row(options.write_docs / "tiles.md", row)
    return 0 if same else 1


def _compare(folder: Path, kind: Kind, count: int) -> bool:
    data = _written(folder / "small", kind, count)
    result = tiles.run(data, kind.radius, folder / "small-tiles", tile_points=count // 7)
    whole = am.filtration(np.concatenate([chunk.read() for chunk in data.chunks]))
    for k in range(kind.dimension + 1):
        there = whole.radii[k] <= kind.radius
        wanted = whole.simplices[k].compress(there, axis=0)
        order = np.lexsort(wanted.T[::-1])
        simplices, radii = result.simplices(k)
        if not (
            np.array_equal(simplices, wanted.take(order, axis=0))
            and np.array_equal(radii, whole.radii[k].compress(there).take(order))
        ):
            return False
    return True


def _measure(  # noqa: PLR0913, PLR0917 (what the command line says)
    folder: Path,
    kind: Kind,
    count: int,
    tile_points: int,
    threads: int | None,
    processes: int | None,
) -> list[str]:
    """Print what a run takes; return it as a row of the table of runs."""
    data = _written(folder / "cloud", kind, count)
    size = min(count, kind.in_memory)
    in_memory = [_in_memory(kind, size) for _ in range(2)]
    with _peak_memory() as peak:
        start, work = time.perf_counter(), time.process_time()
        result = tiles.run(
            data,
            kind.radius,
            folder / "tiles",
            tile_points=tile_points,
            cluster="local" if processes else None,
            processes=processes,
            threads=threads,
        )
        taken, work = time.perf_counter() - start, time.process_time() - work
    in_memory += [_in_memory(kind, size) for _ in range(2)]
    measure, measured_work = (statistics.median(each) for each in zip(*in_memory, strict=True))
    core_seconds = "-" if processes else f"{work / count * 1e6:.2f}"
    on_disk = sum(file.stat().st_size for file in result.folder.rglob("*") if file.is_file())
    speed = count / taken
    workers, kind_of = (processes, "process") if processes else (threads, "thread")
    workers = workers or machine.cores()
    who = f"{workers} {kind_of}{'' if workers == 1 else 'es' if processes else 's'}"
    about = machine.describe([])
    print(f"machine                        {about['cpu']}, {about['cores']} cores, {who}")
    print(f"load                           {about['load']}")
    print(f"points                         {count:,} in {len(result.tiling):,} tiles")
    print(f"cells                          {result.summary.counts[-1]:,}")
    print(f"time                           {taken:.1f} s, {speed:,.0f} points a second")
    print(f"in memory                      {measure:,.0f} points a second")
    print(f"ratio                          {speed / measure:.2f}")
    print(f"core seconds a million points  {core_seconds}; in memory {measured_work * 1e6:.2f}")
    print(f"peak memory of all processes   {max(peak) / 1e9:.2f} GB")
    print(f"result on disk                 {on_disk / 1e9:.2f} GB")
    return [
        kind.name,
        f"{count:,}",
        f"{len(result.tiling):,}",
        who,
        f"{taken:.0f} s",
        f"{speed / 1e6:.2g}",
        f"{measure / 1e6:.2g}",
        f"{speed / measure:.2f}",
        core_seconds,
        f"{measured_work * 1e6:.2f}",
        f"{max(peak) / 1e9:.1f} GB",
        f"{on_disk / 1e9:.1f} GB",
        str(about["date"]),
        f"{about['load']}",
    ]


_HEAD = (
    "cloud in", "points", "tiles", "workers", "time", "million points a second",
    "the same in memory", "ratio", "core seconds a million points", "the same in memory",
    "peak memory", "result on disk", "date", "load",
)  # fmt: skip


def _add_row(path: Path, row: list[str]) -> None:
    """Put a row into the table of runs, in place of one of the same cloud and workers."""
    _, _, rest = path.read_text(encoding="utf-8").partition("<!-- tile-runs:begin -->")
    rows = {
        tuple(cells[k] for k in (0, 1, 3)): cells
        for line in rest.partition("<!-- tile-runs:end -->")[0].splitlines()[3:]
        if len(cells := [cell.strip() for cell in line.strip("|").split("|")]) == len(_HEAD)
    }
    rows[row[0], row[1], row[3]] = row
    ordered = sorted(rows.values(), key=lambda cells: (cells[0], len(cells[1]), cells[1]))
    rule = ["---", *["--:"] * (len(_HEAD) - 1)]
    table = "\n".join(f"| {' | '.join(cells)} |" for cells in (_HEAD, rule, *ordered))
    replace_between_markers(path, table, "tile-runs")


def _costs(folder: Path, kind: Kind, tile_points: int) -> str:
    """Measure the steps of a tile in the middle of a cloud, on one core; return a table."""
    count = 9 * tile_points
    data = _written(folder / "cloud", kind, count)
    cloud = np.concatenate([chunk.read() for chunk in data.chunks])
    tiling = tiles.plan(cloud[:: count // 20_000], 9)
    # The tile in the middle has neighbours all around.
    tile = int(
        tiling.tile_of(np.full((1, kind.dimension), count ** (1 / kind.dimension) / 2))[0]
    )
    store = Store(folder / "tiles")
    store.write_manifest({"dimension": kind.dimension})
    spool = store.spool(tiling)
    first = np.array([chunk.first_row for chunk in data.chunks])
    recycling = Recycling()  # as in a run

    def spread() -> None:
        for chunk in data.chunks:
            spool.write(chunk.number, *tiling.spread(chunk.read(), kind.radius))

    def read() -> tuple[np.ndarray, np.ndarray]:
        return spool.points_of(tile, first, np.int32)

    spreading, _ = _timed(spread)
    reading, (rows, points) = _timed(read)
    in_memory, _ = _timed(lambda: am.filtration(points, threads=1))
    solving, piece = _timed(lambda: tiles.solve(tiling, tile, rows, points, kind.radius))
    writing, _ = _timed(lambda: store.write_tile(piece))
    del recycling
    own = len(piece.rows)
    parts = [file for file in store.folder.rglob(f"*{tile:06}.*") if "chunks" not in file.parts]
    border = sum(file.stat().st_size for file in parts if file.suffix == ".npz")
    size = sum(file.stat().st_size for file in parts)
    on_the_way = sum(file.stat().st_size for file in spool.folder.iterdir())

    def seconds(taken: float, points: int) -> str:
        return f"{taken / points * 1e6:.2f} s"

    lines = [
        (f"for each million points in {kind.name}, one core", ""),
        ("---", "--:"),
        ("reading, sorting into tiles", seconds(spreading, count)),
        ("reading a tile", seconds(reading, own)),
        ("triangulation, values, what belongs to whom, borders", seconds(solving, own)),
        ("of which the filtration of tile and halo alone", seconds(in_memory, own)),
        ("writing tables, checksums", seconds(writing, own)),
        ("points on their way (temporary)", f"{on_the_way / count:.0f} MB"),
        ("tables in Parquet", f"{(size - border) / own:.0f} MB"),
        (f"halo of a tile of {own:,} points", f"{100 * (len(rows) / own - 1):.1f} %"),
        ("what it tells of its border", f"{border / 1e6:.2f} MB"),
    ]
    return "\n".join(f"| {name} | {value} |" for name, value in lines)


def _timed(work: Callable[[], Result], times: int = 5) -> tuple[float, Result]:
    """Return the least of some processor times, which others only make longer."""
    taken = []
    for _ in range(times):
        start = time.process_time()
        result = work()
        taken.append(time.process_time() - start)
    return min(taken), result


def _written(folder: Path, kind: Kind, count: int) -> tiles.Dataset:
    """Write uniform points, one to each unit of area or volume, a part at a time."""
    folder.mkdir()
    side = count ** (1 / kind.dimension)
    for part, start in enumerate(range(0, count, _PART)):
        points = np.random.default_rng(part).random((min(_PART, count - start), kind.dimension))
        np.save(folder / f"{part:05}.npy", points * side)
    return tiles.dataset(folder, dimension=kind.dimension)


def _in_memory(kind: Kind, count: int) -> tuple[float, float]:
    """Return points a second with all cores, and core seconds a point."""
    points = np.random.default_rng(0).random((count, kind.dimension))
    start, work = time.perf_counter(), time.process_time()
    am.filtration(points)
    taken, work = time.perf_counter() - start, time.process_time() - work
    return count / taken, work / count


@contextmanager
def _peak_memory() -> Iterator[list[float]]:
    """Watch the memory of this process and its children; shared pages count once."""
    import psutil  # type: ignore[import-untyped,unused-ignore]

    peaks = [0.0]
    done = threading.Event()

    def watch() -> None:
        me = psutil.Process(os.getpid())
        while not done.wait(0.2):
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
