"""``python -m benchmarks.polygons``: outlines and queries, beside alphashape and shapely.

Three tables, each of one run in which the contestants take turns:

- from points to polygons, against alphashape (PyPI), and for larger clouds against what
  its largest one promises if its time grew no faster than the cloud;
- from a filtration to the polygons of one radius, against ``shapely.polygonize`` on the
  boundary edges;
- queries of random points, against the polygons in a tree of shapely.
"""

from __future__ import annotations

import argparse
import warnings
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from statistics import median
from typing import Any

import numpy as np
import shapely

import alphamesh as am
from benchmarks.clouds import make_cloud
from benchmarks.timing import Rounds, interleave, once

__all__ = ["main"]

# So that the outline of a uniform cloud is one region with few holes, in mean spacings;
# and one with about as many corners as there can be.
_FILLED, _RAGGED = 3.0, 0.8
_ROUNDS = Rounds(least=5, seconds=3.0, budget=30.0)
_QUERIES = 1_000_000


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.polygons")
    parser.add_argument("--tiny", action="store_true", help="small clouds, in seconds")
    parser.add_argument(
        "--patience", type=float, default=120.0, help="seconds that alphashape may take"
    )
    options = parser.parse_args(arguments)
    sizes = (1_000, 2_000) if options.tiny else (1_000, 10_000, 100_000, 1_000_000)
    _outlines(sizes, options.patience)
    _edges(sizes)
    _queries(sizes[-1], 1_000 if options.tiny else _QUERIES)
    return 0


def _cloud(size: int) -> tuple[Any, float]:
    """Return a uniform cloud in the unit square, and the spacing of its points."""
    return make_cloud("uniform", size), 1 / np.sqrt(size)


# ---------------------------------------------------------------------- points to polygons


def _outlines(sizes: Sequence[int], patience: float) -> None:
    try:
        import alphashape
    except ImportError:
        alphashape = None
        print("alphashape is not installed: left out")
    print("from points to polygons (ms, median)")
    print(f"{'points':>10}  {'alphamesh':>10}  {'alphashape':>12}  ratio")
    per_point = 0.0
    for size in sizes:
        points, spacing = _cloud(size)
        radius = _FILLED * spacing
        contestants = {"ours": partial(_ours, points, radius)}
        expected = per_point * size
        if alphashape and expected < patience:
            if expected < _ROUNDS.budget / 4:
                contestants["theirs"] = partial(_theirs, alphashape, points, radius)
                taken = _medians(contestants)
                theirs, mark = taken["theirs"], ""
            else:
                taken = _medians(contestants)
                theirs, mark = once(partial(_theirs, alphashape, points, radius)), ", once"
            per_point = theirs / size
        else:
            taken, theirs, mark = _medians(contestants), expected, ", extrapolated"
        _row(size, taken["ours"], theirs, mark if alphashape else ", not measured")


def _ours(points: Any, radius: float) -> Any:
    return am.AlphaComplex(points).at(radius).polygons()


def _theirs(alphashape: Any, points: Any, radius: float) -> Any:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return alphashape.alphashape(points, 1 / radius)


def _row(size: int, ours: float, theirs: float, note: str = "") -> None:
    ratio = theirs / ours
    print(f"{size:>10,}  {1e3 * ours:>10.2f}  {1e3 * theirs:>12.1f}  {ratio:,.1f}{note}")


# ---------------------------------------------------------------------- shape to polygons


def _edges(sizes: Sequence[int]) -> None:
    for name, spacings in (("filled", _FILLED), ("ragged", _RAGGED)):
        print(f"\nfrom a filtration to the polygons of one radius, {name} (ms, median)")
        print(f"{'edges':>10}  {'alphamesh':>10}  {'polygonize':>12}  ratio")
        for size in sizes:
            points, spacing = _cloud(size)
            shape = am.AlphaComplex(points).at(spacings * spacing)
            edges = len(shape.boundary_edges)
            taken = _medians(
                {"ours": partial(_traced, shape), "theirs": partial(_polygonized, shape)}
            )
            _row(edges, taken["ours"], taken["theirs"])


def _traced(shape: am.AlphaShape) -> Any:
    return am.AlphaShape(shape.filtration, shape.radius).polygons()


def _polygonized(shape: am.AlphaShape) -> Any:
    """Return the faces between the edges: shapes and holes, still to be told apart."""
    edges = am.AlphaShape(shape.filtration, shape.radius).boundary_edges
    return shapely.polygonize(shapely.linestrings(shape.points[edges]))


# ---------------------------------------------------------------------- queries


def _queries(size: int, count: int) -> None:
    print(f"\n{count:,} queries on a shape of {size:,} points (ms, median)")
    points, spacing = _cloud(size)
    queries = make_cloud("uniform", count)
    for name, spacings in (("filled", _FILLED), ("ragged", _RAGGED)):
        shape = am.AlphaComplex(points).at(spacings * spacing)
        segments = shapely.linestrings(points[shape.boundary_edges])
        once(partial(shape.distance, queries[:1]))  # what is kept between calls
        taken = _medians(
            {
                "region_of": partial(shape.region_of, queries),
                "nearest": partial(shape.nearest, queries),
                "distance": partial(shape.distance, queries, signed=True),
            }
        )
        tree = shapely.STRtree(segments)
        some = shapely.points(queries[: count // 10])
        taken["shapely's nearest"] = 10 * once(partial(tree.nearest, some))
        for job, seconds in taken.items():
            print(f"  {name}, {len(segments):,} edges, {job}: {1e3 * seconds:,.0f}")


def _medians(contestants: Mapping[str, Callable[[], object]]) -> dict[str, float]:
    turns = interleave(contestants, _ROUNDS)
    for error in turns.failures.values():
        raise error
    return {name: median(samples) for name, samples in turns.samples.items()}


if __name__ == "__main__":
    raise SystemExit(main())
