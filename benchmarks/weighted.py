"""``python -m benchmarks.weighted``: weighted clouds in space, beside gudhi and diode.

All make the regular triangulation and the power values of all simplices; ours is measured
without weights, too. The contestants take turns; those that are not installed are left out
with a word. Ends with the promised ratios, pass or fail.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from importlib import import_module
from statistics import median
from typing import TypeAlias

import numpy as np

from benchmarks.clouds import Points
from benchmarks.contest import measured, options_of
from benchmarks.verdict import Criterion

__all__ = ["WEIGHTS", "main"]

Run: TypeAlias = Callable[[Points, Points], object]

_OURS, _ONE, _PLAIN = "weighted", "weighted, 1 thread", "no weights, 1 thread"

# Squared radii up to this share of the squared distance between neighbours.
WEIGHTS = {"few hidden": 0.5, "most hidden": 6.0}


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line; 1 if a promise is broken."""
    options = options_of("weighted", arguments)
    runs = dict(_contestants(options.threads))
    criteria: list[Criterion] = []
    for name, share in WEIGHTS.items():
        cloud = _cloud(options.size, share)
        contestants = {key: partial(run, *cloud) for key, run in runs.items()}
        taken = measured(f"{name}, {options.size:,} points", contestants, options.rounds)
        criteria += _criteria(name, taken)
    print()
    for criterion in criteria:
        print(criterion)
    return 0 if options.tiny or all(criterion.passed for criterion in criteria) else 1


def _cloud(size: int, share: float) -> tuple[Points, Points]:
    random = np.random.default_rng(1)
    points: Points = random.random((size, 3))
    weights: Points = random.random(size) * (share * size ** (-2 / 3))
    return points, weights


def _contestants(threads: int) -> Iterator[tuple[str, Run]]:
    filtration = import_module("alphamesh.filtration").filtration
    yield _OURS, lambda points, w: filtration(points, weights=w, threads=threads)
    yield _ONE, lambda points, w: filtration(points, weights=w, threads=1)
    yield _PLAIN, lambda points, _: filtration(points, threads=1)
    for name, load in {"diode": _diode, "gudhi safe": _gudhi}.items():
        try:
            yield name, load()
        except ImportError as error:
            print(f"left out: {name}: {error}")


def _diode() -> Run:
    fill = import_module("diode").fill_weighted_alpha_shapes_arrays
    return lambda points, weights: fill(np.column_stack([points, weights]))


def _gudhi() -> Run:
    alpha_complex = import_module("gudhi").AlphaComplex
    return lambda points, weights: alpha_complex(
        points=points, weights=weights, precision="safe"
    ).create_simplex_tree()


def _criteria(name: str, taken: Mapping[str, Sequence[float]]) -> Iterator[Criterion]:
    for over, under, limit, at_least in (
        ("gudhi safe", _OURS, 10.0, True),
        ("gudhi safe", _ONE, 10.0, True),
        (_ONE, _PLAIN, 1.3, False),
    ):
        ratios = [
            best(taken[over]) / best(taken[under]) if over in taken and under in taken else None
            for best in (median, min)
        ]
        yield Criterion(f"{over} over {under}, {name}", ratios[0], limit, at_least, ratios[1])


if __name__ == "__main__":
    raise SystemExit(main())
