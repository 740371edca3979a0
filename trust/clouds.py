"""Random nasty clouds, each built and proved by :mod:`alphamesh.check`."""

from __future__ import annotations

import multiprocessing
import sys
import time
from collections import Counter
from collections.abc import Callable, Iterable
from functools import partial
from typing import Any

import numpy as np

import alphamesh as am
from alphamesh import check
from alphamesh.errors import CoordinateRangeError, PeriodsError

__all__ = ["FAMILIES", "campaign", "cloud", "sides", "weights"]

Points = np.ndarray[Any, np.dtype[np.float64]]
Family = Callable[[np.random.Generator, int, int], Points]

_MOST = 24
_NAMES = {
    "": "clouds in {}D",
    "weighted": "weighted clouds in {}D",
    "boxed": "periodic clouds in {}D",
}


def _lattice(rng: np.random.Generator, n: int, d: int) -> Points:
    return rng.integers(-3, 4, (n, d)).astype(float)


def _tenths(rng: np.random.Generator, n: int, d: int) -> Points:
    return _lattice(rng, n, d) * rng.choice([0.1, 1 / 3, 1e-3, 7.0])


def _line(rng: np.random.Generator, n: int, d: int) -> Points:
    return rng.integers(-9, 10, (n, 1)) * rng.integers(-5, 6, (1, d)).astype(float)


def _near_line(rng: np.random.Generator, n: int, d: int) -> Points:
    start, way = rng.normal(size=(2, d))
    return start + rng.normal(size=(n, 1)) * way


def _flat(rng: np.random.Generator, n: int, d: int) -> Points:
    """On a line in the plane, on a plane in space: exactly, and tilted."""
    span = rng.integers(-4, 5, (d - 1, d))
    return (rng.integers(-6, 7, (n, d - 1)) @ span).astype(float)


def _near_flat(rng: np.random.Generator, n: int, d: int) -> Points:
    return rng.normal(size=(n, d - 1)) @ rng.normal(size=(d - 1, d))


def _round(rng: np.random.Generator, n: int, d: int) -> Points:
    """Whole points of one length, moved to another centre: cospherical, exactly."""
    axis = np.arange(-7, 8)
    grid = np.stack(np.meshgrid(*[axis] * d), axis=-1).reshape(-1, d)
    ball = grid[(grid**2).sum(axis=1) == {2: 25, 3: 41}[d]]
    return ball[rng.integers(0, len(ball), n)] + rng.integers(-9, 10, d).astype(float)


def _near_round(rng: np.random.Generator, n: int, d: int) -> Points:
    points = rng.normal(size=(n, d))
    return points / np.linalg.norm(points, axis=1, keepdims=True)


def _twins(rng: np.random.Generator, n: int, d: int) -> Points:
    """Few different points, and some that differ in their last digits."""
    points = rng.random((max(1, n // 3), d))
    points = points[rng.integers(0, len(points), n)]
    return _nudged(rng, points)


def _scales(rng: np.random.Generator, n: int, d: int) -> Points:
    return np.ldexp(rng.normal(size=(n, d)), rng.integers(-60, 60, (n, d)))


def _uniform(rng: np.random.Generator, n: int, d: int) -> Points:
    return rng.random((n, d))


FAMILIES: dict[str, Family] = {
    "lattice": _lattice,
    "tenths": _tenths,
    "line": _line,
    "near line": _near_line,
    "flat": _flat,
    "near flat": _near_flat,
    "round": _round,
    "near round": _near_round,
    "twins": _twins,
    "scales": _scales,
    "uniform": _uniform,
}


def _nudged(rng: np.random.Generator, points: Points) -> Points:
    """Move some coordinates by an ulp or two."""
    steps = rng.integers(-2, 3, points.shape) * (rng.random(points.shape) < 0.2)
    moved: Points = points + steps * np.spacing(points) * (points != 0)
    return moved


def cloud(seed: int, dimension: int) -> tuple[str, Points]:
    """Return the cloud of a seed, and the name of its family."""
    rng = np.random.default_rng([seed, dimension])
    name = list(FAMILIES)[int(rng.integers(len(FAMILIES)))]
    points = FAMILIES[name](rng, int(rng.integers(0, _MOST)), dimension)
    if rng.random() < 0.25:
        points = _nudged(rng, points)
    if rng.random() < 0.2:
        points = np.ldexp(points, int(rng.integers(-150, 150)))
    return name, np.ascontiguousarray(points)


def weights(seed: int, points: Points) -> Points:
    """Return nasty weights for the points of a seed, of the size of their squares."""
    rng = np.random.default_rng([seed, points.shape[1], 1])
    n = len(points)
    size = 4.0 ** np.frexp(np.abs(points).max(initial=0.0))[1]
    if not 0 < size < np.inf:
        size = 1.0
    kinds = (
        rng.integers(-3, 4, n) * size / 4.0 ** int(rng.integers(0, 4)),
        rng.normal(size=n) * size * rng.choice([1.0, 0.1, 1e-3, 1e-12]),
        np.where(rng.random(n) < 0.2, size * rng.normal(), 0.0),
        (points**2).sum(axis=1),  # lifted, all are in one plane but for rounding
        rng.random(n) * size / 64 + rng.integers(0, 2) * size,
    )
    return np.ascontiguousarray(kinds[int(rng.integers(len(kinds)))])


def sides(seed: int, points: Points) -> tuple[float | None, ...]:
    """Return the side lengths of a box for the points of a seed, None where it is open."""
    rng = np.random.default_rng([seed, points.shape[1], 2])
    size = 2.0 ** np.frexp(np.abs(points).max(initial=0.0))[1]
    if not 0 < size < np.inf:
        size = 1.0
    shares = rng.choice([0.25, 1 / 3, 0.5, 1.0, 1.1, 2.0], points.shape[1])
    open_ones = rng.random(points.shape[1]) < 0.2
    open_ones[int(rng.integers(points.shape[1]))] = False
    return tuple(
        None if is_open else float(size * share)
        for share, is_open in zip(shares, open_ones, strict=True)
    )


def _prove_box(seed: int, dimension: int) -> str:
    """Build and check one periodic box, with weights if its seed is odd."""
    points = cloud(seed, dimension)[1]
    given = weights(seed, points) if seed % 2 else None
    try:
        box = am.AlphaComplex(
            points, weights=given, periods=sides(seed, points), threads=1 + seed % 3
        )
    except (CoordinateRangeError, PeriodsError):
        return "refused"
    check.check_periodic(box.filtration)
    return "proved"


def _prove(seed: int, dimension: int, kind: str) -> str:
    """Build and check one cloud; return what came of it."""
    if kind == "boxed":
        return _prove_box(seed, dimension)
    _, points = cloud(seed, dimension)
    given = weights(seed, points) if kind == "weighted" else None
    try:
        cx = am.AlphaComplex(points, weights=given, threads=1 + seed % 3)
    except CoordinateRangeError:
        return "refused"
    check.check_filtration(cx.filtration)
    values = np.unique(np.concatenate(cx.radii))
    if len(values):
        check.check_shape(cx.at(float(values[seed % len(values)])))
    return "proved"


def _batch(
    seeds: Iterable[int], dimension: int, kind: str = ""
) -> tuple[Counter[str], list[str]]:
    tally: Counter[str] = Counter()
    failures = []
    for seed in seeds:
        try:
            tally[_prove(seed, dimension, kind)] += 1
        except Exception as error:
            tally["failed"] += 1
            which = f"{kind}, " if kind else ""
            failures.append(f"{which}dimension {dimension}, seed {seed}: {error!r}")
    return tally, failures


def campaign(  # noqa: PLR0913 (which clouds, and how they are divided)
    count: int,
    dimension: int,
    *,
    kind: str = "",
    first: int = 0,
    processes: int = 1,
    size: int = 500,
) -> dict[str, Any]:
    """Prove many clouds; a process that dies ends the campaign with an error.

    Parameters
    ----------
    count, dimension : int
    kind : str
        Empty for clouds as they are, or ``"weighted"``, or ``"boxed"``: in periodic boxes,
        every other one weighted.
    first : int
        The first seed.
    processes, size : int
        How many processes take so many seeds at a time.

    Returns
    -------
    dict
        How many clouds were proved, refused for their range, or failed; the seconds.
    """
    start = time.perf_counter()
    batches = [
        range(k, min(k + size, first + count)) for k in range(first, first + count, size)
    ]
    tally: Counter[str] = Counter()
    failures: list[str] = []
    work = partial(_batch, dimension=dimension, kind=kind)
    with multiprocessing.get_context("spawn").Pool(processes) as pool:
        for found, messages in pool.imap_unordered(work, batches):
            tally.update(found)
            failures += messages
            for message in messages:
                print(message, file=sys.stderr)
    return {
        "campaign": _NAMES[kind].format(dimension),
        "first": first,
        "cases": count,
        "proved": tally["proved"],
        "refused": tally["refused"],
        "failed": tally["failed"],
        "seconds": round(time.perf_counter() - start),
    }
