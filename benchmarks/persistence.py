"""``python -m benchmarks.persistence``: from points to persistence pairs, beside gudhi.

In one run, in which the contestants take turns:

- filtration and pairs of uniform points in the plane, and how the time of both grows;
- the same in space.

gudhi does what its users do: ``create_simplex_tree``, then ``compute_persistence`` over
Z/2. Ends with the promised ratios, pass or fail.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import partial
from math import inf
from statistics import median
from typing import Any

import numpy as np

import alphamesh as am
from benchmarks.timing import Rounds, interleave
from benchmarks.verdict import Criterion

__all__ = ["main"]

_ROUNDS = Rounds(least=5, seconds=3.0, budget=60.0)
_FEW_ROUNDS = Rounds(least=2, seconds=0.05, budget=1.0)
_LEAST = {2: 40.0, 3: 15.0}
_SIZES = {2: (100_000, 1_000_000, 4_000_000), 3: (10_000, 100_000, 1_000_000)}
# Beside gudhi, the size of the promise.
_BESIDE = {2: 1_000_000, 3: 100_000}
_TINY = {2: (1_000, 2_000, 4_000), 3: (500, 1_000, 2_000)}
# Time per point from the smallest to the largest size: 40 times as many points leave the
# caches of the processor.
_GROWTH = 2.0
# gudhi's values are good to about 1e-5 by default, squared.
_ERROR = 1e-4
_WHERE = {2: "in the plane", 3: "in space"}


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line; 1 if a promise is broken."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.persistence")
    parser.add_argument("--tiny", action="store_true", help="a few thousand points, in seconds")
    parser.add_argument("--columns", type=int, choices=(2, 3), help="the plane or space alone")
    parser.add_argument("--threads", type=int, help="of alphamesh; by default all")
    options = parser.parse_args(arguments)
    rounds = _FEW_ROUNDS if options.tiny else _ROUNDS
    criteria: list[Criterion] = []
    for columns in (options.columns,) if options.columns else (2, 3):
        sizes = (_TINY if options.tiny else _SIZES)[columns]
        size = sizes[1] if options.tiny else _BESIDE[columns]
        criteria += _beside_gudhi(columns, size, options.threads, rounds)
        criteria += _growth(columns, sizes, options.threads, rounds)
    if options.tiny:
        # Small clouds show that all of it works; their times promise nothing.
        criteria = [c for c in criteria if "difference" in c.what and c.value is not None]
    print()
    for criterion in criteria:
        print(criterion)
    return 0 if all(criterion.passed for criterion in criteria) else 1


def _cloud(columns: int, size: int) -> Any:
    return np.random.default_rng(size).random((size, columns))


def _ours(points: Any, threads: int | None) -> Any:
    filtration = am.filtration(points, threads=threads)
    return am.persistence(filtration, threads=threads)


def _beside_gudhi(
    columns: int, size: int, threads: int | None, rounds: Rounds
) -> list[Criterion]:
    points = _cloud(columns, size)
    contestants: dict[str, Callable[[], object]] = {
        "alphamesh": partial(_ours, points, threads)
    }
    gudhi = _gudhi()
    if gudhi is not None:
        contestants["gudhi"] = partial(_theirs, gudhi, points)
    where = f"{size:,} points {_WHERE[columns]}"
    slow = {"gudhi": inf} if size >= _BESIDE[columns] else {}  # not called to warm up
    taken = _medians(contestants, f"{where}: filtration and pairs", rounds, slow)
    faster = error = None
    if gudhi is not None:
        faster = taken["gudhi"] / taken["alphamesh"]
        error = _difference(gudhi, _cloud(columns, min(size, 20_000)))
    return [
        Criterion(f"{where}: gudhi over alphamesh", faster, _LEAST[columns], at_least=True),
        Criterion(f"{_WHERE[columns]}: largest relative difference of deaths", error, _ERROR),
    ]


def _growth(
    columns: int, sizes: Sequence[int], threads: int | None, rounds: Rounds
) -> list[Criterion]:
    """Measure filtration and pairs at several sizes, one after another."""
    table = []
    for size in sizes:
        built = am.filtration(_cloud(columns, size), threads=threads)
        contestants: dict[str, Callable[[], object]] = {
            "filtration": partial(am.filtration, built.points, threads=threads),
            # A new record of the same arrays, which knows no pairs yet.
            "pairs": lambda built=built: am.persistence(replace(built), threads=threads),
        }
        taken = {name: median(s) / size for name, s in _samples(contestants, rounds).items()}
        table.append((size, taken["filtration"], taken["pairs"]))
    print(f"\n{_WHERE[columns]} (microseconds per point, median)")
    print(f"{'points':>20}  {'filtration':>10}  {'pairs':>10}")
    for size, *seconds in table:
        print(f"{size:>20,}", *(f"{1e6 * part:>11.3f}" for part in seconds))
    growth = max(pairs for _, _, pairs in table) / table[0][2]
    what = f"{_WHERE[columns]}: pairs, time per point, largest / at {sizes[0]:,} points"
    return [Criterion(what, growth, _GROWTH)]


def _gudhi() -> Any:
    try:
        import gudhi
    except ImportError:
        print("gudhi is not installed: left out")
        return None
    return gudhi


def _theirs(gudhi: Any, points: Any) -> Any:
    tree = gudhi.AlphaComplex(points=points).create_simplex_tree()
    tree.compute_persistence(homology_coeff_field=2)
    return tree


def _difference(gudhi: Any, points: Any) -> float:
    """Return how far the sorted deaths of the classes that last longest are from gudhi's."""
    tree = _theirs(gudhi, points)
    worst = 0.0
    for k, rows in enumerate(am.persistence(am.filtration(points)).diagrams(squared=True)):
        theirs = tree.persistence_intervals_in_dimension(k).reshape(-1, 2)
        mine, other = (
            np.sort(diagram[np.isfinite(diagram[:, 1]), 1])[-1000:]
            for diagram in (rows, theirs)
        )
        worst = max(worst, float(np.abs(mine / other - 1).max()))
    return worst


def _medians(
    contestants: Mapping[str, Callable[[], object]],
    title: str,
    rounds: Rounds,
    expected: Mapping[str, float],
) -> dict[str, float]:
    samples = _samples(contestants, rounds, expected)
    taken = {name: median(seconds) for name, seconds in samples.items()}
    print(f"\n{title} (ms, median)")
    for name, seconds in taken.items():
        print(f"{name:>20}  {1e3 * seconds:>10.2f}")
    return taken


def _samples(
    contestants: Mapping[str, Callable[[], object]],
    rounds: Rounds,
    expected: Mapping[str, float] | None = None,
) -> dict[str, list[float]]:
    turns = interleave(contestants, rounds, expected)
    for error in turns.failures.values():
        raise error
    return turns.samples


if __name__ == "__main__":
    raise SystemExit(main())
