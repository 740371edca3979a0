"""``python -m benchmarks.periodic``: periodic boxes, beside diode.

Both make all simplices and their values, in the plane and in space, with weights and
without; diode leaves out offsets. The contestants take turns. Ends with the promised ratio,
pass or fail.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Iterator, Sequence
from functools import partial
from importlib import import_module
from statistics import median
from typing import Any

import numpy as np

from alphamesh.periodic import periodic_filtration
from benchmarks.timing import Rounds, interleave
from benchmarks.verdict import Criterion

__all__ = ["main"]

_PROMISED = "space"


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line; 1 if the promise is broken."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.periodic")
    parser.add_argument("--size", type=int, default=100_000)
    parser.add_argument("--repeats", type=int, default=3, help="turns of each contestant")
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--tiny", action="store_true", help="1,000 points, in seconds")
    options = parser.parse_args(arguments)
    if options.tiny:
        options.size, options.repeats = 1_000, 2
    criterion = Criterion(f"diode over ours in space, {options.size:,}", None, 5.0, True)
    for name, points, weights in _boxes(options.size):
        taken = _table(name, points, weights, options)
        if name == _PROMISED and len(taken) == 2:
            ratio = taken["diode"] / taken["ours"]
            criterion = Criterion(criterion.what, ratio, 5.0, True)
    print()
    print(criterion)
    return 0 if options.tiny or criterion.passed else 1


def _boxes(size: int) -> Iterator[tuple[str, Any, Any]]:
    """Return clouds in a box of side 10, where hardly any copy is a float64."""
    random = np.random.default_rng(1)
    yield "plane", random.random((size, 2)) * 10, None
    yield "space", random.random((size, 3)) * 10, None
    yield "space, weights", random.random((size, 3)) * 10, random.random(size) * 1e-3
    yield "diamond", _diamond(size // 100), None


def _diamond(size: int) -> Any:
    """Return about so many atoms of a diamond in a box of side 10.

    Their coordinates are rounded, so that ties are there but for the last digit.
    """
    cells = max(1, round((size / 8) ** (1 / 3)))
    base = [
        [0, 0, 0],
        [0, 2, 2],
        [2, 0, 2],
        [2, 2, 0],
        [1, 1, 1],
        [1, 3, 3],
        [3, 1, 3],
        [3, 3, 1],
    ]
    corners = np.indices((cells,) * 3).reshape(3, -1).T * 4
    return (corners[:, None] + np.array(base)).reshape(-1, 3) * (10 / (4 * cells))


def _table(name: str, points: Any, weights: Any, options: Any) -> dict[str, float]:
    """Measure and print one cloud; medians in seconds."""
    box = (10.0,) * points.shape[1]
    contestants: dict[str, Callable[[], object]] = {
        "ours": partial(
            periodic_filtration, points, box, weights=weights, threads=options.threads
        )
    }
    try:
        contestants["diode"] = _diode(points, weights, box)
    except ImportError as error:
        print(f"left out: diode: {error}")
    print(f"\n{name}, {len(points):,} points (s, median and minimum)")
    seconds = 0.05 if options.tiny else 0.0
    turns = interleave(contestants, Rounds(options.repeats, seconds, 300.0))
    for contestant, samples in turns.samples.items():
        if samples:
            print(f"{contestant:>8}  {median(samples):>9.4f}  {min(samples):>9.4f}")
        else:
            print(f"{contestant:>8}  failed: {turns.failures[contestant]}")
    return {key: median(samples) for key, samples in turns.samples.items() if samples}


def _diode(points: Any, weights: Any, box: tuple[float, ...]) -> Callable[[], object]:
    diode = import_module("diode")
    corner = [0.0] * len(box)
    if weights is None:
        fill, rows = diode.fill_periodic_alpha_shapes_arrays, points
    else:
        fill = diode.fill_weighted_periodic_alpha_shapes_arrays
        rows = np.column_stack((points, weights))
    return partial(fill, rows, False, corner, list(box))


if __name__ == "__main__":
    raise SystemExit(main())
