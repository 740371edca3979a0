"""``python -m benchmarks.space``: clouds in space, beside shull, CGAL, gudhi and diode.

Ours makes the triangulation and the values of all simplices, as gudhi and diode do; shull
(in two ways) and CGAL, which is compiled where its headers are, the bare triangulation. Ours
is measured twice: the public call, and the compiled core without what surrounds it. In each
table the contestants take turns; those that are not installed, or are expected to take too
long, are left out with a word. Ends with a table of all clouds and the promised ratios, pass
or fail.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from importlib import import_module
from statistics import median
from typing import Any

import numpy as np

from benchmarks import isolated
from benchmarks.cgal import cgal_delaunay3
from benchmarks.clouds import Points
from benchmarks.jobs import JOBS, Run, space
from benchmarks.timing import Rounds, forecast, interleave, once
from benchmarks.verdict import Criterion

__all__ = ["SPACE_CLOUDS", "main"]

_OURS, _ONE = "all values", "all values, 1 thread"
_BARE, _BARE_ONE = "bare", "bare, 1 thread"
_CORE, _CORE_BARE, _CORE_BARE_ONE = "core", "core, bare", "core, bare, 1 thread"
_SHULL = ("shull", "shull parallel")
_BETTER_SHULL = "the better bare shull"
_MOST_BYTES = 1800.0
_PILOTS = 2_000, 10_000  # points of first calls, to tell how a contestant's time grows
# Peers that cannot do what a cloud asks for in bearable time, measured at 100,000 points.
_HOPELESS = {("shull", "grid"), ("shull parallel", "grid")}


def _uniform(n: int, random: np.random.Generator) -> Points:
    return random.random((n, 3))


def _clusters(n: int, random: np.random.Generator) -> Points:
    centres, widths = random.random((30, 3)), np.geomspace(0.002, 0.06, 30)
    which = random.integers(30, size=n)
    return centres[which] + widths[which, None] * random.standard_normal((n, 3))


def _sphere(n: int, random: np.random.Generator) -> Points:
    points = random.standard_normal((n, 3))
    unit: Points = points / np.linalg.norm(points, axis=1, keepdims=True)
    return unit


def _torus(n: int, random: np.random.Generator) -> Points:
    u, v = 2 * np.pi * random.random((2, n))
    distance = 2 + np.cos(v)
    return np.column_stack([distance * np.cos(u), distance * np.sin(u), np.sin(v)])


def _grid(n: int, random: np.random.Generator) -> Points:
    """Return a shuffled integer cube of at most `n` points."""
    side = round(n ** (1 / 3))
    side -= side**3 > n
    return random.permutation(np.indices((side,) * 3).reshape(3, -1).T.astype(np.float64))


SPACE_CLOUDS: dict[str, Callable[[int, np.random.Generator], Points]] = {
    "uniform": _uniform,
    "clusters": _clusters,
    "sphere": _sphere,
    "torus": _torus,
    "grid": _grid,
}


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line; 1 if a promise is broken."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.space")
    parser.add_argument("--sizes", type=int, nargs="+", default=[100_000, 1_000_000])
    parser.add_argument("--clouds", nargs="+", choices=SPACE_CLOUDS, default=[*SPACE_CLOUDS])
    parser.add_argument("--repeats", type=int, default=5, help="turns of each contestant")
    parser.add_argument("--budget", type=float, default=60.0, help="seconds for each")
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--tiny", action="store_true", help="1,000 points, in seconds")
    options = parser.parse_args(arguments)
    if options.tiny:
        options.sizes, options.repeats, options.budget = [1_000], 2, 1.0
    runs = dict(_contestants(options.threads))
    medians: dict[tuple[str, int], dict[str, float]] = {}
    minima: dict[tuple[str, int], dict[str, float]] = {}
    for cloud in options.clouds:
        earlier = {} if options.tiny else {n: _pilot(runs, cloud, n) for n in _PILOTS}
        for size in sorted(options.sizes):
            samples = _table(runs, cloud, _make(cloud, size), earlier, options)
            cell = cloud, size
            medians[cell] = earlier[size] = {name: median(s) for name, s in samples.items()}
            minima[cell] = {name: min(s) for name, s in samples.items()}
    criteria = [*_criteria(medians, minima, options.sizes), *_memory(options.sizes)]
    print(f"\n{_summary(medians)}\n")
    for criterion in criteria:
        print(criterion)
    return 0 if options.tiny or all(criterion.passed for criterion in criteria) else 1


def _make(cloud: str, size: int) -> Points:
    return np.ascontiguousarray(SPACE_CLOUDS[cloud](size, np.random.default_rng(1)))


def _contestants(threads: int) -> Iterator[tuple[str, Run]]:
    yield _OURS, space("filtration", threads)()
    yield _ONE, space("filtration", 1)()
    yield _CORE, space("filtration", threads, core=True)()
    yield _BARE, space("delaunay", threads)()
    yield _BARE_ONE, space("delaunay", 1)()
    yield _CORE_BARE, space("delaunay", threads, core=True)()
    yield _CORE_BARE_ONE, space("delaunay", 1, core=True)()
    peers: dict[str, Callable[[], Run]] = {
        "shull": JOBS["shull"].load,
        "shull parallel": JOBS["shull-parallel"].load,
        "CGAL": _cgal,
        "diode": JOBS["diode"].load,
        "gudhi safe": partial(_gudhi, "safe"),
        "gudhi exact": partial(_gudhi, "exact"),
    }
    for name, load in peers.items():
        try:
            yield name, load()
        except ImportError as error:
            print(f"left out: {name}: {error}")


def _cgal() -> Run:
    cgal_delaunay3(np.zeros((1, 3)))  # compiled now, not in the first turn
    return cgal_delaunay3


def _gudhi(precision: str) -> Run:
    alpha_complex = import_module("gudhi").AlphaComplex
    return lambda points: alpha_complex(
        points=points, precision=precision
    ).create_simplex_tree()


def _pilot(runs: Mapping[str, Run], cloud: str, size: int) -> dict[str, float]:
    """Time the second call of each contestant on few points of a cloud."""
    points = _make(cloud, size)
    taken = {}
    for name, run in runs.items():
        if (name, cloud) in _HOPELESS:
            continue
        try:
            run(points)
            taken[name] = once(partial(run, points))
        except Exception as error:  # a peer may raise anything: it is reported, and out
            print(f"failed: {name}, {cloud}, {size:,} points: {error}")
    return taken


def _table(
    runs: Mapping[str, Run],
    cloud: str,
    points: Points,
    earlier: Mapping[int, Mapping[str, float]],
    options: Any,
) -> dict[str, list[float]]:
    """Measure and print one cloud; the seconds of each turn."""
    size = len(points)
    print(f"\n{cloud}, {size:,} points (s, median and minimum)")
    contestants: dict[str, Callable[[], object]] = {}
    for name, run in runs.items():
        reason = _too_slow(name, cloud, size, earlier, options.budget)
        if reason:
            print(f"{name:>22}  left out: {reason}")
        else:
            contestants[name] = partial(run, points)
    seconds = 0.0 if not options.tiny else 0.05
    turns = interleave(contestants, Rounds(options.repeats, seconds, options.budget))
    for name, samples in turns.samples.items():
        if samples:
            print(f"{name:>22}  {median(samples):>9.4f}  {min(samples):>9.4f}")
        else:
            print(f"{name:>22}  failed: {turns.failures[name]}")
    return {name: samples for name, samples in turns.samples.items() if samples}


def _too_slow(
    name: str, cloud: str, size: int, earlier: Mapping[int, Mapping[str, float]], budget: float
) -> str:
    if size >= 100_000 and (name, cloud) in _HOPELESS:
        return "takes minutes"
    known = {n: taken[name] for n, taken in earlier.items() if name in taken}
    if earlier and not known:
        return "left out or failed at a smaller size"
    expected = forecast(known, size)
    return f"expected {expected:.0f} s" if expected > budget else ""


def _summary(medians: Mapping[tuple[str, int], Mapping[str, float]]) -> str:
    """Return a Markdown table of all clouds: medians, and ours against the others."""
    names = list(dict.fromkeys(name for taken in medians.values() for name in taken))
    pairs = ((_OURS, _BETTER_SHULL), (_BARE_ONE, _BARE))
    titles = ["seconds (median)", *names, *(f"{over} / {under}" for over, under in pairs)]
    lines = [f"| {' | '.join(titles)} |", "|---|" + "---:|" * (len(titles) - 1)]
    for (cloud, size), taken in medians.items():
        cells = [f"{taken[name]:.3g}" if name in taken else "" for name in names]
        ratios = [_ratio(taken, *pair) for pair in pairs]
        cells += ["" if ratio is None else f"{ratio:.2f}" for ratio in ratios]
        lines.append(f"| {cloud}, {size:,} | {' | '.join(cells)} |")
    return "\n".join(lines)


def _criteria(
    medians: Mapping[tuple[str, int], Mapping[str, float]],
    minima: Mapping[tuple[str, int], Mapping[str, float]],
    sizes: Sequence[int],
) -> Iterator[Criterion]:
    large, small = max(sizes), min(sizes)
    promises = [
        *((large, ours, _BETTER_SHULL, 0.45, False) for ours in (_OURS, _CORE)),
        *((large, ours, "CGAL", 0.75, False) for ours in (_OURS, _CORE)),
        (large, _BARE_ONE, _BARE, 1.5, True),
        (large, _CORE_BARE_ONE, _CORE_BARE, 1.5, True),
        *((small, "gudhi safe", ours, 25.0, True) for ours in (_OURS, _CORE)),
        *((small, "diode", ours, 8.0, True) for ours in (_OURS, _CORE)),
    ]
    for size, over, under, limit, at_least in promises:
        values = [
            _ratio(taken.get(("uniform", size), {}), over, under) for taken in (medians, minima)
        ]
        yield Criterion(f"{over} over {under}, {size:,}", values[0], limit, at_least, values[1])


def _ratio(taken: Mapping[str, float], over: str, under: str) -> float | None:
    pair = [
        min((taken[peer] for peer in _SHULL if peer in taken), default=None)
        if name == _BETTER_SHULL
        else taken.get(name)
        for name in (over, under)
    ]
    return None if pair[0] is None or pair[1] is None else pair[0] / pair[1]


def _memory(sizes: Sequence[int]) -> Iterator[Criterion]:
    size = max(sizes)
    peak, seconds = isolated.fresh_run(isolated.SPACE, _make("uniform", size), 600.0)
    print(f"\nfirst call in a fresh process, {size:,} points: {seconds:.2f} s")
    yield Criterion("peak memory beyond the input, bytes a point", peak / size, _MOST_BYTES)


if __name__ == "__main__":
    raise SystemExit(main())
