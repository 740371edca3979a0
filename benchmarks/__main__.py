"""``python -m benchmarks``: measure, then write tables, a figure, and a verdict."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Sequence
from pathlib import Path

from benchmarks import isolated, machine, plan, tables, verdict
from benchmarks.clouds import CLOUDS
from benchmarks.jobs import JOBS, OURS, available
from benchmarks.plan import Cell
from benchmarks.results import Results, read_results, write_results
from benchmarks.timing import Rounds

__all__ = ["main", "measure"]

_SIZES = (1_000, 10_000, 100_000, 1_000_000)
_TINY_SIZES = (200, 1_000)
# Below this size the noise of a process would hide the memory of a job.
_MEMORY_SIZE = 100_000

_EPILOG = """examples:
  python -m benchmarks --tiny                     all of it on small clouds, in seconds
  python -m benchmarks --clouds uniform,grid --sizes 10k,1M
  python -m benchmarks --sizes 10M --jobs alphamesh,shull-parallel
  python -m benchmarks --growth --write-docs docs --update README.md --json full.json
  python -m benchmarks --load full.json --update README.md
  python -m benchmarks --verdict                  the promised ratios, pass or fail
"""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line; return 1 if a verdict was asked for and is not all pass."""
    options = _parser().parse_args(arguments)
    if options.cores:
        machine.limit_cores(options.cores)
    results = read_results(options.load) if options.load else measure(options)
    if options.json:
        write_results(results, options.json)
    if options.write_docs:
        _write_docs(results, options.write_docs)
    if options.update:
        tables.replace_between_markers(options.update, tables.readme_table(results))
    if options.plot:
        from benchmarks.plot import save_figure

        save_figure(results, options.plot)
    if options.output:
        options.output.write_text(tables.full_report(results) + "\n", encoding="utf-8")
    elif not options.quiet:
        print(tables.full_report(results))
    if options.verdict:
        text, passed = verdict.verdict_text(results)
        print(f"\n{text}")
        return 0 if passed else 1
    return 0


def measure(options: argparse.Namespace) -> Results:
    """Measure what the options ask for."""
    cells = (
        verdict.cells()
        if options.verdict and not (options.sizes or options.tiny)
        else _cells(options)
    )
    wanted = dict.fromkeys(job for cell in cells for job in cell.jobs)
    runs, left_out = available(wanted)
    for job, reason in left_out.items():
        if job in OURS:
            # Without ours the run would prove nothing; `--jobs` can still ask for peers alone.
            raise SystemExit(f"{job}: {reason}")
        _tell(f"left out: {job}: {reason}")
    results = Results(machine.describe(runs), left_out)
    rounds = _rounds(options)
    plan.measure_times(cells, runs, rounds, results, _tell)
    if not options.no_fresh:
        plan.measure_fresh(_fresh_cells(cells, options.tiny), rounds.budget, results, _tell)
    if options.growth or options.verdict:
        sizes = _TINY_SIZES if options.tiny else verdict.GROWTH_SIZES
        plan.measure_growth(sizes, runs, rounds, results, _tell)
    if any(job in runs for job in OURS):
        _tell("import time")
        results.import_seconds = isolated.import_times(3 if options.tiny else 9)
    return results


def _cells(options: argparse.Namespace) -> list[Cell]:
    sizes = options.sizes or (_TINY_SIZES if options.tiny else _SIZES)
    peers = set(JOBS) - set(OURS) if options.peers is None else set(options.peers)
    jobs = tuple(
        job for job in options.jobs or JOBS if job in OURS or {job, JOBS[job].package} & peers
    )
    return [Cell(cloud, size, jobs) for size in sizes for cloud in options.clouds or CLOUDS]


def _fresh_cells(cells: Sequence[Cell], tiny: bool) -> list[Cell]:
    if not tiny:
        return [cell for cell in cells if cell.size >= _MEMORY_SIZE]
    # One cell shows that it works; its numbers mean nothing.
    return [max(cells, key=lambda cell: (cell.size, cell.cloud == "uniform"))]


def _rounds(options: argparse.Namespace) -> Rounds:
    if options.tiny:
        return Rounds(options.repeats or 2, seconds=0.05, budget=1.0)
    return Rounds(options.repeats or 5, budget=options.budget)


def _write_docs(results: Results, folder: Path) -> None:
    from benchmarks.plot import save_figure

    save_figure(results, folder / "benchmarks.svg")
    tables.replace_between_markers(folder / "benchmarks.md", tables.full_report(results))


def _tell(text: str) -> None:
    print(text, file=sys.stderr, flush=True)


def _size(text: str) -> int:
    """Return 10000 for "10k", "10_000" and "1e4"."""
    scale = {"k": 1_000, "m": 1_000_000}.get(text[-1:].lower(), 1)
    value = float(text[:-1] if scale > 1 else text) * scale
    if value < 1 or value != int(value):
        raise ValueError(text)
    return int(value)


def _sizes(text: str) -> list[int]:
    try:
        return sorted({_size(word) for word in text.split(",")})
    except ValueError as error:
        raise argparse.ArgumentTypeError(f"{error} is no number of points") from None


def _names(*known: str) -> Callable[[str], list[str]]:
    def names(text: str) -> list[str]:
        words = [word for word in text.split(",") if word not in ("", "none")]
        for word in words:
            if word not in known:
                raise argparse.ArgumentTypeError(f"{word} is none of {', '.join(known)}")
        return words

    return names


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        "python -m benchmarks",
        description="Measure alphamesh and its peers in turn, in one run.",
        epilog=_EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    add = parser.add_argument
    peers = sorted({*JOBS, *(job.package for job in JOBS.values())} - set(OURS))
    add("--jobs", type=_names(*JOBS), help=f"some of {', '.join(JOBS)}")
    add("--peers", type=_names(*peers), help="only these peers beside ours, or none")
    add("--clouds", type=_names(*CLOUDS), help=f"some of {', '.join(CLOUDS)}")
    add("--sizes", type=_sizes, help="numbers of points, as 1k,100k,10M (default 1k to 1M)")
    add("--repeats", type=int, help="turns of each job (default 5); more where it is fast")
    add("--budget", type=float, default=30.0, help="seconds for a job in a cell (default 30)")
    add("--cores", type=int, help="bind the run to this many cores (Linux)")
    add("--tiny", action="store_true", help="small clouds, few turns: a test of the tool")
    add(
        "--no-fresh",
        action="store_true",
        help="no fresh processes: no peak memory, no cold calls",
    )
    add("--growth", action="store_true", help="time per point at 100k, 1M and 10M points")
    add("--verdict", action="store_true", help="the promised ratios, pass or fail")
    add("--load", type=Path, help="take the results from a JSON file, measure nothing")
    add("--json", type=Path, help="write the results to this JSON file")
    add("--output", type=Path, help="write the Markdown there instead of printing it")
    add("--plot", type=Path, help="write the figure there (SVG, PNG, PDF)")
    add("--update", type=Path, help="put the short table between the markers of this file")
    add("--write-docs", type=Path, metavar="DIR", help="fill benchmarks.md and .svg in DIR")
    add("--quiet", action="store_true", help="do not print the Markdown")
    return parser


if __name__ == "__main__":
    sys.exit(main())
