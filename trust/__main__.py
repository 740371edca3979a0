r"""``python -m trust``: hunt for wrong answers and crashes; keep the record.

    python -m trust --quick                         a look at each campaign, in a minute
    python -m trust --predicates 15000000 --clouds 1000000 --solids 100000 --files 100000 \
        --processes 2 --json record.json            the figures of record
    python -m trust --write-docs docs --json record.json      write them into the page

A record grows: a campaign that is run again takes the place of its older figures.
"""

from __future__ import annotations

import argparse
import datetime
import json
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from trust import clouds, predicates, readers

__all__ = ["main", "table"]

_QUICK = {"predicates": 200_000, "clouds": 2000, "solids": 500, "files": 1000}
_MARKERS = ("<!-- figures of record -->", "<!-- end of the figures -->")


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line; 1 if anything failed."""
    parser = argparse.ArgumentParser(prog="python -m trust")
    for name, what in (
        ("predicates", "near-degenerate cases of each predicate"),
        ("clouds", "nasty clouds in the plane"),
        ("solids", "nasty clouds in space"),
        ("files", "damaged files"),
    ):
        parser.add_argument(f"--{name}", type=int, default=0, metavar="N", help=what)
    parser.add_argument("--quick", action="store_true", help="some of each")
    parser.add_argument("--first", type=int, default=0, help="the first seed")
    parser.add_argument("--processes", type=int, default=1)
    parser.add_argument("--json", type=Path, help="keep the record here")
    parser.add_argument("--write-docs", type=Path, metavar="FOLDER", help="write the table")
    options = parser.parse_args(arguments)
    if options.quick:
        vars(options).update(_QUICK)
    record = _read(options.json)
    failed = 0
    for result in _results(options):
        print(json.dumps(result), flush=True)
        record[result["campaign"]] = result | {"date": _today()}
        failed += result.get("failed", 0) + result.get("wrong", 0)
        if options.json:
            options.json.write_text(json.dumps(record, indent=1), encoding="utf-8")
    if options.write_docs:
        _write(options.write_docs / "exactness.md", table(record))
    return 1 if failed else 0


def _results(options: argparse.Namespace) -> Any:
    at = {"first": options.first, "processes": options.processes}
    if options.predicates:
        yield from predicates.campaign(options.predicates, seed=options.first + 1)
    if options.clouds:
        yield clouds.campaign(options.clouds, 2, **at)
    if options.solids:
        yield clouds.campaign(options.solids, 3, **at)
    if options.files:
        yield readers.campaign(options.files, **at)


def _today() -> str:
    return datetime.datetime.now(datetime.UTC).date().isoformat()


def _read(path: Path | None) -> dict[str, Any]:
    if path is None or not path.exists():
        return {}
    found: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
    return found


def table(record: dict[str, Any]) -> str:
    """Return the record as two tables of Markdown."""
    lines = [
        "| predicate | cases | exactly zero | beyond filter | beyond double-double | wrong |",
        "|---|--:|--:|--:|--:|--:|",
    ]
    others = [
        "| campaign | cases | proved or read | refused | failed |",
        "|---|--:|--:|--:|--:|",
    ]
    for name, facts in record.items():
        if "wrong" in facts:
            keys = ("cases", "zero", "beyond_filter", "beyond_double_double", "wrong")
            lines.append(f"| `{name}` | " + " | ".join(f"{facts[k]:,}" for k in keys) + " |")
        else:
            good = facts.get("proved", facts.get("read"))
            numbers = (facts["cases"], good, facts["refused"], facts["failed"])
            others.append(f"| {name} | " + " | ".join(f"{k:,}" for k in numbers) + " |")
    return "\n".join([*lines, "", *others])


def _write(page: Path, text: str) -> None:
    start, end = _MARKERS
    content = page.read_text(encoding="utf-8")
    if start not in content or end not in content:
        sys.exit(f"{page} lacks the lines {start} and {end}")
    before, after = content.partition(start)[0], content.partition(end)[2]
    page.write_text(f"{before}{start}\n\n{text}\n\n{end}{after}", encoding="utf-8")


if __name__ == "__main__":
    raise SystemExit(main())
