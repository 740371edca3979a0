"""``python -m benchmarks.restricted``: Voronoi cells, hull and point location, beside peers.

Each table comes from one run in which the contestants take turns:

- restricted Voronoi cells against their filtration and against pyafv (PyPI), areas compared;
- Voronoi diagram, convex hull and point location against scipy.

Ends with the promised ratios, pass or fail.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from statistics import median
from typing import Any

import numpy as np

import alphamesh as am
from benchmarks.clouds import make_cloud
from benchmarks.timing import Rounds, interleave
from benchmarks.verdict import Criterion

__all__ = ["main"]

# Discs that overlap: most cells have arcs and segments. In mean spacings.
_RADIUS = 0.7
_ROUNDS = Rounds(least=5, seconds=3.0, budget=60.0)
_MOST_FILTRATIONS, _LEAST_OF_PEER, _AREA_ERROR = 10.0, 20.0, 1e-9


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line; 1 if a promise is broken."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.restricted")
    parser.add_argument("--points", type=int, default=100_000)
    parser.add_argument("--tiny", action="store_true", help="2,000 points, in seconds")
    options = parser.parse_args(arguments)
    size = 2_000 if options.tiny else options.points
    points = make_cloud("uniform", size)
    criteria = _restricted(points, _RADIUS / np.sqrt(size))
    _against_scipy(points)
    print()
    for criterion in criteria:
        print(criterion)
    return 0 if all(criterion.passed for criterion in criteria) else 1


def _restricted(points: Any, radius: float) -> list[Criterion]:
    built = am.filtration(points)
    contestants: dict[str, Callable[[], object]] = {
        "filtration": partial(am.filtration, points),
        "restricted_voronoi": partial(am.restricted_voronoi, built, radius),
    }
    simulator = _simulator(points, radius)
    if simulator is not None:
        contestants["pyafv build"] = simulator.build
    taken = _medians(contestants, f"restricted cells of {len(points):,} points")
    ours = taken["restricted_voronoi"]
    slower = faster = error = None
    if simulator is None:
        print("pyafv is not installed: left out")
    else:
        faster = taken["pyafv build"] / ours
        theirs = np.asarray(simulator.build()["areas"])
        error = float(np.abs(am.restricted_voronoi(built, radius).area / theirs - 1).max())
    slower = ours / taken["filtration"]
    return [
        Criterion("restricted_voronoi over filtration", slower, _MOST_FILTRATIONS),
        Criterion("pyafv over restricted_voronoi", faster, _LEAST_OF_PEER, at_least=True),
        Criterion("largest relative difference of areas", error, _AREA_ERROR),
    ]


def _simulator(points: Any, radius: float) -> Any:
    try:
        import pyafv
    except ImportError:
        return None
    return pyafv.FiniteVoronoiSimulator(points, pyafv.PhysicalParams(r=radius))


def _against_scipy(points: Any) -> None:
    from scipy import spatial

    ours, theirs = am.delaunay(points), spatial.Delaunay(points)
    queries = np.random.default_rng(1).random(points.shape) * 1.1 - 0.05
    pairs: dict[str, tuple[Callable[[], object], Callable[[], object]]] = {
        "voronoi": (partial(am.voronoi, points), partial(spatial.Voronoi, points)),
        "convex_hull": (partial(am.convex_hull, points), partial(spatial.ConvexHull, points)),
        "find": (partial(ours.find, queries), partial(theirs.find_simplex, queries)),
    }
    for name, (mine, other) in pairs.items():
        contestants = {"alphamesh": mine, "scipy": other}
        _medians(contestants, f"{name} of {len(points):,} points")


def _medians(contestants: Mapping[str, Callable[[], object]], title: str) -> dict[str, float]:
    turns = interleave(contestants, _ROUNDS)
    for error in turns.failures.values():
        raise error
    taken = {name: median(samples) for name, samples in turns.samples.items()}
    print(f"\n{title} (ms, median)")
    for name, seconds in taken.items():
        print(f"{name:>20}  {1e3 * seconds:>10.2f}")
    return taken


if __name__ == "__main__":
    raise SystemExit(main())
