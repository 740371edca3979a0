"""Markdown from results: the full report, and the short table of the README."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path

from benchmarks.jobs import FILTRATION, JOBS, OURS
from benchmarks.results import FreshRun, Results, Timing

__all__ = ["SHULL", "full_report", "milliseconds", "readme_table", "replace_between_markers"]

SHULL = ("shull", "shull-parallel")


def milliseconds(seconds: float) -> str:
    """Return a time in milliseconds with about three digits."""
    value = 1000 * seconds
    decimals = 0 if value >= 100 else 1 if value >= 10 else 2 if value >= 1 else 3
    return f"{value:,.{decimals}f}"


def readme_table(results: Results) -> str:
    """Return the table of the README: every job on every cloud at one size.

    The size is the largest, up to a million points, that was measured.
    """
    sizes = [size for size in results.sizes() if size <= 1_000_000] or results.sizes()
    if not sizes:
        return "No times were measured."
    size = sizes[-1]
    parts = [_time_table(results, size), _notes(results), _memory_sentence(results)]
    return "\n\n".join(part for part in parts if part)


def full_report(results: Results) -> str:
    """Return all tables: times by size, ratios, memory, growth, imports, what is missing."""
    sections = {
        "Machine": _machine(results),
        "Wall time": _join(_time_table(results, size) for size in results.sizes()),
        "Ratios": _ratio_table(results),
        "Peak memory": _fresh_table(
            results, "bytes per point", lambda run: f"{run.bytes_per_point:,.0f}"
        ),
        "Cold calls": _fresh_table(results, "ms", lambda run: milliseconds(run.seconds)),
        "Growth": _growth_table(results),
        "Import": _import_table(results),
        "Not measured": _missing(results),
    }
    return _join(f"### {title}\n\n{text}" for title, text in sections.items() if text)


def replace_between_markers(path: Path, text: str, name: str = "benchmark") -> None:
    """Replace what stands between the markers of a name in a file.

    Raises
    ------
    SystemExit
        If the file does not exist or lacks the markers; it is not touched then.
    """
    if not path.exists():
        raise SystemExit(f"{path.name} does not exist")
    first, last = f"<!-- {name}:begin -->", f"<!-- {name}:end -->"
    before, begin, rest = path.read_text(encoding="utf-8").partition(first)
    _, end, after = rest.partition(last)
    if not begin or not end:
        raise SystemExit(f"{path.name} has no lines {first} and {last}")
    path.write_text(f"{before}{begin}\n{text}\n{end}{after}", encoding="utf-8")


def _time_table(results: Results, size: int) -> str:
    clouds = [c for c in results.clouds() if any(results.timing(j, c, size) for j in JOBS)]
    if not clouds:
        return ""

    def row(job: str) -> list[str]:
        name = f"**`{JOBS[job].call}`**" if job in OURS else f"`{JOBS[job].call}`"
        cells = [_time_cell(results.timing(job, cloud, size)) for cloud in clouds]
        return [name, "yes" if JOBS[job].makes == FILTRATION else "no", *cells]

    timed = [job for job in results.jobs() if any(results.timing(job, c, size) for c in clouds)]
    head = [f"{size:,} points, ms: median (min)", "filtration", *clouds]
    return _table(head, [row(job) for job in timed])


def _time_cell(timing: Timing | None) -> str:
    if timing is None:
        return "-"
    return f"{milliseconds(timing.median)} ({milliseconds(timing.minimum)})"


def _ratio_table(results: Results) -> str:
    """Return ours (all cores, and one thread) against the best of shull, and gudhi."""
    rows = []
    for size in results.sizes():
        for cloud in results.clouds():
            ours, one = (results.timing(job, cloud, size) for job in OURS[:2])
            shull = results.best(SHULL, cloud, size)
            gudhi, diode = (results.timing(job, cloud, size) for job in ("gudhi", "diode"))
            pairs = [(ours, shull), (one, shull), (gudhi, ours), (diode, ours)]
            cells = [_ratio(above, below) for above, below in pairs]
            if set(cells) != {"-"}:
                rows.append([f"{size:,}", cloud, *cells])
    head = ["points", "cloud", "ours / shull", "ours, 1 thread / shull"]
    return _table([*head, "gudhi / ours", "diode / ours"], rows) if rows else ""


def _ratio(above: Timing | None, below: Timing | None) -> str:
    if above is None or below is None:
        return "-"
    value = above.median / below.median
    return f"{value:.2f}" if value < 10 else f"{value:.0f}"


def _fresh_table(results: Results, title: str, show: Callable[[FreshRun], str]) -> str:
    """Return one property of the calls in fresh processes, by job, cloud and size."""
    columns = [
        (cloud, size)
        for size in sorted({run.size for run in results.fresh})
        for cloud in results.clouds()
        if any(results.fresh_run(job, cloud, size) for job in JOBS)
    ]
    rows = []
    for job in (job for job in results.jobs() if any(run.job == job for run in results.fresh)):
        runs = [results.fresh_run(job, *column) for column in columns]
        cells = ["-" if run is None else show(run) for run in runs]
        rows.append([f"`{JOBS[job].call}`", *cells])
    head = [title, *(f"{cloud}, {size:,}" for cloud, size in columns)]
    return _table(head, rows) if rows else ""


def _growth_table(results: Results) -> str:
    sizes = sorted({timing.size for timing in results.growth})
    rows = []
    for job in dict.fromkeys(timing.job for timing in results.growth):
        by_size = {timing.size: timing for timing in results.growth if timing.job == job}
        cells = [f"{1e9 * by_size[size].per_point:,.0f}" for size in sizes]
        worst = max(by_size[size].per_point for size in sizes) / by_size[sizes[0]].per_point
        rows.append([f"`{JOBS[job].call}`", *cells, f"{worst:.2f}"])
    head = ["ns per point", *(f"{size:,} points" for size in sizes), "growth"]
    return _table(head, rows) if rows else ""


def _import_table(results: Results) -> str:
    rows = [[name, milliseconds(value)] for name, value in results.import_seconds.items()]
    return _table(["fresh process", "ms"], rows) if rows else ""


def _missing(results: Results) -> str:
    lines = [f"- {job}: left out, {reason}" for job, reason in results.left_out.items()]
    lines += [
        f"- {skip.job}, {skip.cloud}, {skip.size:,} points: {skip.reason}"
        for skip in results.skipped
    ]
    return "\n".join(lines)


def _machine(results: Results) -> str:
    machine = results.machine
    versions = ", ".join(f"{name} {number}" for name, number in machine["versions"].items())
    lines = [
        f"{machine['cpu']}, {machine['cores']} cores, {machine['system']}, "
        f"Python {machine['python']}, NumPy {machine['numpy']}; {versions}; {machine['date']}."
    ]
    load = machine["load"]
    if load is not None and load > 0.3 * machine["cores"]:
        lines.append(f"Other programs were running (load {load} at the start): ratios hold, "
                     "times are too long.")  # fmt: skip
    return "\n".join(lines)


def _notes(results: Results) -> str:
    notes = "Wall time of one call, measured in turn in one run on " + _machine(results)
    if results.left_out:
        notes += f" Left out: {', '.join(results.left_out)}."
    return notes


def _memory_sentence(results: Results) -> str:
    """Return peak memory at the largest size on uniform points, as a sentence."""
    runs = [run for run in results.fresh if run.cloud == "uniform"]
    size = max((run.size for run in runs), default=0)
    parts = [f"{run.job} {run.bytes_per_point:,.0f}" for run in runs if run.size == size]
    if not parts:
        return ""
    return f"Peak memory beyond the input, bytes per point, {size:,} uniform points: " + (
        ", ".join(parts) + "."
    )


def _table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    lines = [head, [":--", *["--:"] * (len(head) - 1)], *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def _join(parts: Iterable[str]) -> str:
    return re.sub(r"\n{3,}", "\n\n", "\n\n".join(parts)).strip()
