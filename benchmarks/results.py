"""The results of a run: plain records, and their way to JSON and back."""

from __future__ import annotations

import json
import statistics
from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any, TypeVar

__all__ = ["FreshRun", "Results", "Skipped", "Timing", "read_results", "write_results"]


@dataclass(frozen=True, slots=True)
class Timing:
    """Wall time of one call, in seconds: median and minimum over `calls` calls."""

    job: str
    cloud: str
    size: int
    calls: int
    median: float
    minimum: float

    @classmethod
    def of(cls, job: str, cloud: str, size: int, samples: Sequence[float]) -> Timing:
        """Summarise the samples, in seconds."""
        return cls(job, cloud, size, len(samples), statistics.median(samples), min(samples))

    @property
    def per_point(self) -> float:
        """Median time per point, in seconds."""
        return self.median / self.size


@dataclass(frozen=True, slots=True)
class FreshRun:
    """One call in a fresh process.

    Attributes
    ----------
    job, cloud, size
        What was called.
    peak : int
        Peak memory beyond what the process held with the input in it, in bytes.
    seconds : float
        Wall time of this first, cold call.
    """

    job: str
    cloud: str
    size: int
    peak: int
    seconds: float

    @property
    def bytes_per_point(self) -> float:
        """Peak memory per point."""
        return self.peak / self.size


@dataclass(frozen=True, slots=True)
class Skipped:
    """A job that was not measured at some size, and why."""

    job: str
    cloud: str
    size: int
    reason: str


_Record = TypeVar("_Record", Timing, FreshRun)


@dataclass(slots=True)
class Results:
    """All that one run measured."""

    machine: dict[str, Any]
    left_out: dict[str, str] = field(default_factory=dict)
    timings: list[Timing] = field(default_factory=list)
    growth: list[Timing] = field(default_factory=list)
    fresh: list[FreshRun] = field(default_factory=list)
    skipped: list[Skipped] = field(default_factory=list)
    import_seconds: dict[str, float] = field(default_factory=dict)

    def timing(self, job: str, cloud: str, size: int) -> Timing | None:
        """Return the timing of a job on a cloud, if it was measured."""
        return _find(self.timings, job, cloud, size)

    def fresh_run(self, job: str, cloud: str, size: int) -> FreshRun | None:
        """Return the call of a job in a fresh process, if it was measured."""
        return _find(self.fresh, job, cloud, size)

    def best(self, jobs: Iterable[str], cloud: str, size: int) -> Timing | None:
        """Return the timing with the least median among `jobs`."""
        measured = [t for job in jobs if (t := self.timing(job, cloud, size)) is not None]
        return min(measured, key=lambda timing: timing.median, default=None)

    def jobs(self) -> list[str]:
        """Return the jobs that were measured, in order."""
        return list(dict.fromkeys(self._column("job")))

    def clouds(self) -> list[str]:
        """Return the clouds that were measured, in order."""
        return list(dict.fromkeys(self._column("cloud")))

    def _column(self, name: str) -> list[str]:
        return [getattr(t, name) for t in self.timings] + [getattr(f, name) for f in self.fresh]

    def sizes(self) -> list[int]:
        """Return the numbers of points that were timed, ascending."""
        return sorted({timing.size for timing in self.timings})


def _find(records: Iterable[_Record], job: str, cloud: str, size: int) -> _Record | None:
    for record in records:
        if (record.job, record.cloud, record.size) == (job, cloud, size):
            return record
    return None


def write_results(results: Results, path: Path) -> None:
    """Write the results as JSON."""
    path.write_text(json.dumps(asdict(results), indent=1) + "\n", encoding="utf-8")


def read_results(path: Path) -> Results:
    """Read the results that `write_results` wrote."""
    raw = json.loads(path.read_text(encoding="utf-8"))
    for name, record in (
        ("timings", Timing),
        ("growth", Timing),
        ("fresh", FreshRun),
        ("skipped", Skipped),
    ):
        raw[name] = [record(**entry) for entry in raw[name]]
    return Results(**raw)
