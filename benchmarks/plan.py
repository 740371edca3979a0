"""Runs the measurements: which job, on which cloud, at which size, within which budget."""

from __future__ import annotations

import subprocess
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field, replace
from functools import partial

from benchmarks import isolated
from benchmarks.clouds import Points, make_cloud
from benchmarks.jobs import OURS, Run
from benchmarks.results import FreshRun, Results, Skipped, Timing
from benchmarks.timing import Rounds, forecast, interleave

__all__ = ["Cell", "measure_fresh", "measure_growth", "measure_times"]

Tell = Callable[[str], None]

# Trials at a tenth and a hundredth of a size tell what to expect; smaller ones tell nothing.
_SMALLEST_TRIAL = 1_000
_TRIAL = Rounds(least=1, seconds=0.0, budget=1.0)
# Where sizes are compared, the small ones are called often in their turn.
_GROWTH_TURN = 0.2
# A fresh process has to start and to import before its job.
_START_SECONDS = 30.0


@dataclass(frozen=True, slots=True)
class Cell:
    """One cloud at one size, and the jobs that are measured on it in turn."""

    cloud: str
    size: int
    jobs: tuple[str, ...]


@dataclass(slots=True)
class _History:
    """Seconds that each job took on each cloud, by size."""

    seconds: dict[tuple[str, str], dict[int, float]] = field(default_factory=dict)

    def of(self, job: str, cloud: str) -> dict[int, float]:
        return self.seconds.setdefault((job, cloud), {})


def measure_times(
    cells: Iterable[Cell], runs: Mapping[str, Run], rounds: Rounds, results: Results, tell: Tell
) -> None:
    """Time the jobs of each cell in turn; those too slow for the budget are skipped."""
    history = _History()
    for cell in sorted(cells, key=lambda cell: cell.size):
        tell(f"time: {cell.cloud}, {cell.size:,} points")
        points = make_cloud(cell.cloud, cell.size)
        contestants: dict[str, Callable[[], object]] = {}
        expected: dict[str, float] = {}
        for job in (job for job in cell.jobs if job in runs):
            seconds = _expected(job, cell, runs[job], history, rounds.budget)
            if seconds > rounds.budget:
                reason = f"about {seconds:,.0f} s expected, more than the budget"
                results.skipped.append(Skipped(job, cell.cloud, cell.size, reason))
            else:
                contestants[job], expected[job] = partial(runs[job], points), seconds
        turns = interleave(contestants, rounds, expected)
        for job, error in turns.failures.items():
            if job in OURS:
                raise error
            reason = f"{type(error).__name__}: {error}"
            results.skipped.append(Skipped(job, cell.cloud, cell.size, reason))
        for job, samples in turns.samples.items():
            if samples:
                timing = Timing.of(job, cell.cloud, cell.size, samples)
                results.timings.append(timing)
                history.of(job, cell.cloud)[cell.size] = timing.median


def measure_fresh(cells: Iterable[Cell], budget: float, results: Results, tell: Tell) -> None:
    """Run each job of each cell, unless it was skipped before, once in a fresh process."""
    out = {(skip.job, skip.cloud, skip.size) for skip in results.skipped}
    for cell in cells:
        tell(f"peak memory: {cell.cloud}, {cell.size:,} points")
        points = make_cloud(cell.cloud, cell.size)
        for job in cell.jobs:
            if (job, cell.cloud, cell.size) in out or job in results.left_out:
                continue
            try:
                peak, seconds = isolated.fresh_run(job, points, 2 * budget + _START_SECONDS)
            except subprocess.TimeoutExpired:
                reason = "fresh process: took too long"
                results.skipped.append(Skipped(job, cell.cloud, cell.size, reason))
            except subprocess.CalledProcessError as error:
                if job in OURS:
                    raise RuntimeError(f"{job} failed: {error.stderr}") from error
                last = (error.stderr.strip().splitlines() or ["no message"])[-1]
                reason = f"fresh process: failed ({last})"
                results.skipped.append(Skipped(job, cell.cloud, cell.size, reason))
            else:
                results.fresh.append(FreshRun(job, cell.cloud, cell.size, peak, seconds))


def measure_growth(
    sizes: Iterable[int], runs: Mapping[str, Run], rounds: Rounds, results: Results, tell: Tell
) -> None:
    """Time our own jobs on uniform clouds of several sizes, the sizes in turn too."""
    clouds: dict[int, Points] = {size: make_cloud("uniform", size) for size in sorted(sizes)}
    tell(f"growth: uniform, {', '.join(f'{size:,}' for size in clouds)} points")
    ours = [job for job in runs if job in OURS]
    for job in ours:
        # Sizes of one job stand together: their ratio is the result.
        contestants = {size: partial(runs[job], points) for size, points in clouds.items()}
        turns = interleave(contestants, replace(rounds, turn=_GROWTH_TURN))
        for error in turns.failures.values():
            raise error
        for size, samples in turns.samples.items():
            results.growth.append(Timing.of(job, "uniform", size, samples))


def _expected(job: str, cell: Cell, run: Run, history: _History, budget: float) -> float:
    """Return the seconds that a job may take in a cell, from its times at smaller sizes."""
    known = history.of(job, cell.cloud)
    for size in (cell.size // 100, cell.size // 10):
        if size < _SMALLEST_TRIAL or size in known or forecast(known, size) > budget:
            continue
        contestant = partial(run, make_cloud(cell.cloud, size))
        turns = interleave({job: contestant}, _TRIAL, {job: forecast(known, size)})
        if turns.samples[job]:
            known[size] = min(turns.samples[job])
    return forecast(known, cell.size)
