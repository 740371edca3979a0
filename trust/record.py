"""The record of campaigns: kept, merged from partial runs, and shown as tables."""

from __future__ import annotations

import datetime
import json
from collections.abc import Iterable
from itertools import pairwise
from pathlib import Path
from typing import Any

__all__ = ["coverage_entries", "merged", "read", "table", "write"]

Facts = dict[str, Any]
Record = dict[str, Facts]

_STAGES = ("beyond filter", "beyond double-double")
# What the runs of a campaign add up to; all else is that of the later run.
_SUMS = (
    *("cases", "wrong", "zero", "beyond_filter", "beyond_double_double"),
    *("proved", "read", "refused", "failed", "seconds", "cpu_seconds", "found"),
)


def read(path: Path | None) -> Record:
    """Return a record, be it one object or the lines that a campaign has printed."""
    if path is None or not path.exists():
        return {}
    text = path.read_text(encoding="utf-8")
    try:
        found = json.loads(text)
    except json.JSONDecodeError:
        found = None
    if isinstance(found, dict) and "campaign" not in found:
        record: Record = found
        return record
    lines = [json.loads(line) for line in text.splitlines() if line.startswith("{")]
    return merged({facts["campaign"]: facts} for facts in lines)


def write(record: Record, path: Path) -> None:
    """Keep a record."""
    path.write_text(json.dumps(record, indent=1) + "\n", encoding="utf-8")


def today() -> str:
    """Return the date that a record tells."""
    return datetime.datetime.now(datetime.UTC).date().isoformat()


def merged(records: Iterable[Record]) -> Record:
    """Add up partial runs.

    Raises
    ------
    ValueError
        If two runs share seeds: their cases would count twice.
    """
    total: Record = {}
    for record in records:
        for name, facts in record.items():
            known = total.get(name)
            total[name] = _sum(name, known, facts) if known and "cases" in facts else facts
    return total


def _sum(name: str, known: Facts, facts: Facts) -> Facts:
    out = known | facts | {key: known[key] + facts[key] for key in _SUMS if key in facts}
    seeds = sorted(_seeds(known) + _seeds(facts))
    for before, after in pairwise(seeds):
        if after[0] < before[1]:
            raise ValueError(
                f"{name}: both runs have seed {after[0]}; their cases are the same"
            )
    out.pop("first", None)
    if seeds:
        out["seeds"] = _joined(seeds)
    return out


def _seeds(facts: Facts) -> list[list[int]]:
    """Return the ranges of seeds of a run: the first one of each, and what comes after it.

    A campaign of the predicates has one seed whatever its length, and fuzzers have none.
    """
    if "seeds" in facts:
        return [list(pair) for pair in facts["seeds"]]
    if "cpu_seconds" in facts:
        return []
    first = facts.get("first", 0)
    return [[first, first + 1 if "wrong" in facts else first + facts["cases"]]]


def _joined(seeds: list[list[int]]) -> list[list[int]]:
    out: list[list[int]] = []
    for first, end in seeds:
        if out and out[-1][1] == first:
            out[-1][1] = end
        else:
            out.append([first, end])
    return out


def coverage_entries(python: Path, cpp: Path) -> Record:
    """Return the figures that ``trust/coverage.sh`` has measured."""
    totals = json.loads(python.read_text(encoding="utf-8"))["totals"]
    core = json.loads(cpp.read_text(encoding="utf-8"))
    rows = {
        "lines of Python": (totals["num_statements"], totals["covered_lines"]),
        "lines of C++": (core["line_total"], core["line_covered"]),
    }
    return {
        name: {"campaign": name, "lines": lines, "run": run, "date": today()}
        for name, (lines, run) in rows.items()
    }


def table(record: Record) -> str:
    """Return the record as tables of Markdown."""
    parts = [
        _rows(
            (
                "predicate",
                "cases",
                "exactly zero",
                "beyond filter",
                "beyond double-double",
                "wrong",
            ),
            [
                (f"`{name}`", f["cases"], f["zero"], *_beyond(f), f["wrong"])
                for name, f in record.items()
                if "wrong" in f
            ],
        ),
        _rows(
            ("campaign", "cases", "proved or read", "refused", "failed"),
            [
                (name, f["cases"], f.get("proved", f.get("read")), f["refused"], f["failed"])
                for name, f in record.items()
                if "refused" in f
            ],
        ),
        _rows(
            (
                "fuzzer",
                "inputs",
                "minutes",
                "of a processor",
                "places reached",
                "failures left",
            ),
            [
                (
                    *(name, f["cases"], round(f["seconds"] / 60)),
                    *(round(f["cpu_seconds"] / 60), f["places"], f["failed"]),
                )
                for name, f in record.items()
                if "cpu_seconds" in f
            ],
        ),
        _rows(
            ("coverage", "lines", "run by the tests", "share"),
            [
                (name, f["lines"], f["run"], f"{100 * f['run'] / f['lines']:.1f} %")
                for name, f in record.items()
                if "run" in f
            ],
        ),
    ]
    return "\n\n".join(filter(None, parts))


def _beyond(facts: Facts) -> tuple[int, int]:
    return facts["beyond_filter"], facts["beyond_double_double"]


def _rows(head: tuple[str, ...], rows: list[tuple[Any, ...]]) -> str:
    if not rows:
        return ""
    lines = [" | ".join(head), "|".join(["---", *["--:"] * (len(head) - 1)])]
    lines[1] = f"|{lines[1]}|"
    lines[0] = f"| {lines[0]} |"
    for row in rows:
        cells = [f"{cell:,}" if isinstance(cell, int) else str(cell) for cell in row]
        lines.append(f"| {' | '.join(cells)} |")
    return "\n".join(lines)
