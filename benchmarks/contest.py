"""What the benchmarks of one kind of input share: their options, and a table of seconds."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Mapping, Sequence
from statistics import median

from benchmarks.timing import Rounds, interleave

__all__ = ["measured", "options_of"]


def options_of(name: str, arguments: Sequence[str] | None) -> argparse.Namespace:
    """Read the command line: ``size``, ``threads``, ``tiny``, and ``rounds`` of all that."""
    parser = argparse.ArgumentParser(prog=f"python -m benchmarks.{name}")
    parser.add_argument("--size", type=int, default=100_000)
    parser.add_argument("--repeats", type=int, default=5, help="turns of each contestant")
    parser.add_argument("--budget", type=float, default=60.0, help="seconds for each")
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--tiny", action="store_true", help="1,000 points, in seconds")
    options = parser.parse_args(arguments)
    if options.tiny:
        options.size, options.repeats, options.budget = 1_000, 2, 1.0
    least = 0.05 if options.tiny else 0.0
    options.rounds = Rounds(options.repeats, least, options.budget)
    return options


def measured(
    title: str,
    runs: Mapping[str, Callable[[], object]],
    rounds: Rounds,
    aside: Callable[[str], str] = lambda _: "",
) -> dict[str, list[float]]:
    """Measure and print one input; the seconds of each turn.

    `aside` tells more of a contestant, at the end of its line.
    """
    print(f"\n{title} (s, median and minimum)")
    turns = interleave(runs, rounds)
    for key, samples in turns.samples.items():
        if samples:
            print(f"{key:>22}  {median(samples):>9.4f}  {min(samples):>9.4f}{aside(key)}")
        else:
            print(f"{key:>22}  failed: {turns.failures[key]}")
    return {key: samples for key, samples in turns.samples.items() if samples}
