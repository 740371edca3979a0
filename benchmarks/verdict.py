"""The acceptance of the 2D core: each promised ratio, measured, with pass or fail."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from benchmarks.plan import Cell
from benchmarks.results import Results, Timing
from benchmarks.tables import SHULL

__all__ = ["GROWTH_SIZES", "Criterion", "cells", "criteria", "verdict_text"]

GROWTH_SIZES = (100_000, 1_000_000, 10_000_000)

_SMALL, _LARGE = 1_000, 1_000_000
_CLOUDS = ("uniform", "grid", "pixels")
_BYTES_PER_POINT = 300.0
_GROWTH = 1.6


@dataclass(frozen=True, slots=True)
class Criterion:
    """One promise, its limit, and what was measured.

    Attributes
    ----------
    what : str
    value : float or None
        None if it was not measured.
    limit : float
    at_least : bool
        Whether the value must not be below the limit; otherwise it must not be above.
    of_minima : float or None
        For a ratio of medians: the ratio of the minima. It decides nothing; where it is far
        from the value, other programs were disturbing the run.
    """

    what: str
    value: float | None
    limit: float
    at_least: bool = False
    of_minima: float | None = None

    @property
    def passed(self) -> bool:
        """Whether the promise is kept; what was not measured is not."""
        if self.value is None:
            return False
        return self.value >= self.limit if self.at_least else self.value <= self.limit

    def __str__(self) -> str:
        sign = ">=" if self.at_least else "<="
        value = "not measured" if self.value is None else f"{self.value:.3g}"
        word = "pass" if self.passed else "FAIL"
        minima = "" if self.of_minima is None else f"; of minima {self.of_minima:.3g}"
        return f"{word}  {self.what}: {value} (must be {sign} {self.limit:g}{minima})"


def cells() -> list[Cell]:
    """Return what has to be measured for the verdict, and no more."""
    jobs = ("alphamesh", "alphamesh-1", *SHULL)
    # gudhi's promise is about uniform points; elsewhere it would only take time.
    return [
        Cell(cloud, size, (*jobs, "gudhi") if cloud == "uniform" else jobs)
        for size in (_SMALL, _LARGE)
        for cloud in _CLOUDS
    ]


def criteria(results: Results) -> Iterator[Criterion]:
    """Yield every promise with its measured value."""
    yield from _times(results)
    for job in ("alphamesh", "alphamesh-1"):
        for cloud in _CLOUDS:
            run = results.fresh_run(job, cloud, _LARGE)
            what = f"{_LARGE:,} points, {cloud}: {job}, peak bytes per point"
            yield Criterion(what, run.bytes_per_point if run else None, _BYTES_PER_POINT)
    for job in ("alphamesh", "alphamesh-1"):
        what = f"{job}, time per point, largest / at {GROWTH_SIZES[0]:,} points"
        yield Criterion(what, _growth(results, job), _GROWTH)


def _times(results: Results) -> Iterator[Criterion]:
    """Yield the promises about time against the better of shull, and against gudhi."""
    where = f"{_LARGE:,} points"
    for cloud in _CLOUDS:
        ours, one = (results.timing(job, cloud, _LARGE) for job in ("alphamesh", "alphamesh-1"))
        shull = results.best(SHULL, cloud, _LARGE)
        yield _compare(f"{where}, {cloud}: ours / best of shull", ours, shull, 0.35)
        yield _compare(f"{where}, {cloud}: 1 thread / best of shull", one, shull, 0.6)
    ours, gudhi = (results.timing(job, "uniform", _LARGE) for job in ("alphamesh", "gudhi"))
    yield _compare(f"{where}, uniform: gudhi / ours", gudhi, ours, 40.0, at_least=True)
    for cloud in _CLOUDS:
        ours = results.timing("alphamesh", cloud, _SMALL)
        shull = results.best(SHULL, cloud, _SMALL)
        yield _compare(f"{_SMALL:,} points, {cloud}: ours / best of shull", ours, shull, 1.2)


def verdict_text(results: Results) -> tuple[str, bool]:
    """Return one line for each promise, and whether all are kept."""
    found = list(criteria(results))
    return "\n".join(str(criterion) for criterion in found), all(c.passed for c in found)


def _compare(
    what: str,
    above: Timing | None,
    below: Timing | None,
    limit: float,
    *,
    at_least: bool = False,
) -> Criterion:
    """Return the promise that the ratio of two medians keeps to a limit."""
    if above is None or below is None:
        return Criterion(what, None, limit, at_least)
    minima = above.minimum / below.minimum
    return Criterion(what, above.median / below.median, limit, at_least, minima)


def _growth(results: Results, job: str) -> float | None:
    """Return the largest time per point over that of the smallest size, all sizes given."""
    by_size = {timing.size: timing.per_point for timing in results.growth if timing.job == job}
    if not set(GROWTH_SIZES) <= set(by_size):
        return None
    return max(by_size.values()) / by_size[GROWTH_SIZES[0]]
