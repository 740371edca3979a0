r"""``python -m trust``: hunt for wrong answers and crashes; keep the record.

    python -m trust --quick                         a look at each campaign, in a minute
    python -m trust --predicates 15000000 --clouds 1000000 --solids 100000 --files 100000 \
        --processes 2 --json record.json            the figures of record
    python -m trust fuzz core --minutes 60 --json record.json      libFuzzer on the kernels
    python -m trust fuzz readers --minutes 60 --json record.json   atheris on the readers
    python -m trust merge record.json other.json    add up runs of different seeds
    python -m trust --write-docs docs --json record.json      write them into the page

A record grows: a campaign that is run again takes the place of its older figures, but for
fuzzing, which adds to them.
"""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from trust import clouds, predicates, readers
from trust.fuzz import run
from trust.record import coverage_entries, merged, read, table, today, write

__all__ = ["main"]

_QUICK = {
    "predicates": 200_000,
    **{"clouds": 2000, "solids": 500, "weighted": 300, "weighted_solids": 100},
    **{"boxes": 300, "solid_boxes": 150},
    **{"files": 1000, "inputs": 500, "sanitized": 50},
}
_MARKERS = ("<!-- figures of record -->", "<!-- end of the figures -->")


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line; 1 if anything failed."""
    words = list(sys.argv[1:] if arguments is None else arguments)
    command = {"fuzz": _fuzz, "merge": _merge}.get(words[0] if words else "", _campaigns)
    return command(words if command is _campaigns else words[1:])


def _campaigns(words: Sequence[str]) -> int:
    parser = argparse.ArgumentParser(prog="python -m trust")
    for name, what in (
        ("predicates", "near-degenerate cases of each predicate"),
        ("clouds", "nasty clouds in the plane"),
        ("solids", "nasty clouds in space"),
        ("weighted", "nasty clouds with weights in the plane"),
        ("weighted-solids", "nasty clouds with weights in space"),
        ("boxes", "nasty clouds in periodic boxes of the plane"),
        ("solid-boxes", "nasty clouds in periodic boxes of space"),
        ("files", "damaged files"),
        ("inputs", "what fuzzers have found before, and so many changes of it"),
        ("sanitized", "the same for the kernels, built with sanitizers"),
    ):
        parser.add_argument(f"--{name}", type=int, default=0, metavar="N", help=what)
    parser.add_argument("--quick", action="store_true", help="some of each")
    parser.add_argument("--first", type=int, default=0, help="the first seed")
    parser.add_argument("--processes", type=int, default=1)
    parser.add_argument("--json", type=Path, help="keep the record here")
    parser.add_argument("--write-docs", type=Path, metavar="FOLDER", help="write the table")
    options = parser.parse_args(words)
    if options.quick:
        vars(options).update(_QUICK)
    record = read(options.json)
    failed = 0
    for result in _results(options):
        print(json.dumps(result), flush=True)
        record[result["campaign"]] = result | {"date": today()}
        failed += result.get("failed", 0) + result.get("wrong", 0)
        if options.json:
            write(record, options.json)
    if options.write_docs:
        _write(options.write_docs / "exactness.md", table(record))
    return 1 if failed else 0


def _results(options: argparse.Namespace) -> Any:
    at = {"first": options.first, "processes": options.processes}
    if options.predicates:
        yield from predicates.campaign(options.predicates, seed=options.first + 1)
    for count, dimension, kind in (
        (options.clouds, 2, ""),
        (options.solids, 3, ""),
        (options.weighted, 2, "weighted"),
        (options.weighted_solids, 3, "weighted"),
        (options.boxes, 2, "boxed"),
        (options.solid_boxes, 3, "boxed"),
    ):
        if count:
            yield clouds.campaign(count, dimension, kind=kind, **at)
    if options.files:
        yield readers.campaign(options.files, **at)
    if options.inputs:
        yield run.replay_core(options.inputs)
        yield run.replay_readers(options.inputs)
    if options.sanitized:
        yield run.replay_core(options.sanitized, sanitized=True)


def _fuzz(words: Sequence[str]) -> int:
    parser = argparse.ArgumentParser(prog="python -m trust fuzz")
    parser.add_argument("what", choices=("core", "readers"))
    parser.add_argument("--minutes", type=float, default=1.0)
    parser.add_argument("--json", type=Path, help="add the figures to this record")
    parser.add_argument("--keep", action="store_true", help="keep new inputs in trust/corpus")
    options = parser.parse_args(words)
    campaign = run.fuzz_core if options.what == "core" else run.fuzz_readers
    result = campaign(options.minutes) | {"date": today()}
    print(json.dumps(result), flush=True)
    if options.json:
        write(merged([read(options.json), {result["campaign"]: result}]), options.json)
    if options.keep:
        run.keep(options.what)
    return 1 if result["failed"] else 0


def _merge(words: Sequence[str]) -> int:
    parser = argparse.ArgumentParser(prog="python -m trust merge")
    parser.add_argument("record", type=Path, help="grows by the others")
    parser.add_argument("others", type=Path, nargs="*")
    parser.add_argument("--coverage", type=Path, nargs=2, metavar=("PYTHON", "CPP"))
    options = parser.parse_args(words)
    record = merged(map(read, (options.record, *options.others)))
    if options.coverage:
        record |= coverage_entries(*options.coverage)
    write(record, options.record)
    return 0


def _write(page: Path, text: str) -> None:
    start, end = _MARKERS
    content = page.read_text(encoding="utf-8")
    if start not in content or end not in content:
        sys.exit(f"{page} lacks the lines {start} and {end}")
    before, after = content.partition(start)[0], content.partition(end)[2]
    page.write_text(f"{before}{start}\n\n{text}\n\n{end}{after}", encoding="utf-8")


if __name__ == "__main__":
    raise SystemExit(main())
