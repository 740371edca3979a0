"""Hypothesis strategies for clouds that break careless geometry.

`FAMILIES` maps a name to a strategy of `(n, 2)` float64 arrays, small enough for the
oracles and all within the range of coordinates that the kernels accept.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from hypothesis import strategies as st

from oracles import in_range

Pair = tuple[float, float]

# Every integer point at distance 5, 25 and 65 from the origin: exactly cocircular.
CIRCLES = {
    radius: [
        (x, y)
        for x in range(-radius, radius + 1)
        for y in range(-radius, radius + 1)
        if x * x + y * y == radius * radius
    ]
    for radius in (5, 25, 65)
}
SPACINGS = (1.0, 0.5, 0.1, 1 / 3, 1e-3, 7.0)
POWERS = (-300, -60, -1, 0, 1, 60, 300)


def as_array(pairs: Sequence[Pair]) -> np.ndarray:
    return np.array(pairs, dtype=np.float64).reshape(-1, 2)


def nudge(value: float, ulps: int) -> float:
    """Return the float `ulps` steps above (or below) `value`; zero stays zero.

    The neighbours of zero are so small that they leave the range of the kernels.
    """
    if value == 0:
        return value
    for _ in range(abs(ulps)):
        value = math.nextafter(value, math.copysign(math.inf, ulps))
    return value


@st.composite
def nudged(draw: st.DrawFn, base: st.SearchStrategy[np.ndarray], most: int = 2) -> np.ndarray:
    """Move some coordinates of a cloud by a few ulps."""
    points = draw(base)
    steps = draw(st.lists(st.integers(-most, most), min_size=points.size, max_size=points.size))
    return as_array(np.array([nudge(c, s) for c, s in zip(points.ravel(), steps, strict=True)]))


@st.composite
def shuffled(draw: st.DrawFn, base: st.SearchStrategy[np.ndarray]) -> np.ndarray:
    points = draw(base)
    order = draw(st.permutations(range(len(points))))
    return points[np.array(order, dtype=np.intp)]


@st.composite
def full_grids(draw: st.DrawFn) -> np.ndarray:
    columns, rows = draw(st.integers(1, 5)), draw(st.integers(1, 3))
    cells = [(x, y) for x in range(columns) for y in range(rows)]
    return as_array(cells) * draw(st.sampled_from(SPACINGS))


@st.composite
def partial_grids(draw: st.DrawFn) -> np.ndarray:
    cell = st.tuples(st.integers(0, 4), st.integers(0, 4))
    cells = draw(st.lists(cell, max_size=12))
    return as_array(cells) * draw(st.sampled_from(SPACINGS))


@st.composite
def mask_pixels(draw: st.DrawFn) -> np.ndarray:
    """Pixel centres or corners of a small mask, y up."""
    columns, rows = draw(st.integers(1, 5)), draw(st.integers(1, 5))
    mask = draw(st.lists(st.booleans(), min_size=columns * rows, max_size=columns * rows))
    y, x = np.nonzero(np.array(mask).reshape(rows, columns))
    chosen = np.column_stack((x, rows - 1 - y)).astype(np.float64)[:13]
    return chosen + draw(st.sampled_from((0.0, 0.5)))


@st.composite
def cocircular(draw: st.DrawFn) -> np.ndarray:
    ring = CIRCLES[draw(st.sampled_from(sorted(CIRCLES)))]
    on_circle = draw(st.lists(st.sampled_from(ring), min_size=3, max_size=11, unique=True))
    inside = draw(st.sampled_from([[], [(0, 0)], [(1, 1)]]))
    scale = draw(st.sampled_from((1.0, 0.1, 2.0**-40)))
    return (as_array([*on_circle, *inside]) + draw(st.integers(-70, 70))) * scale


@st.composite
def rotated_squares(draw: st.DrawFn) -> np.ndarray:
    corners: list[Pair] = []
    for _ in range(draw(st.integers(1, 3))):
        x, y, a, b = (draw(st.integers(-4, 4)) for _ in range(4))
        corners += [(x, y), (x + a, y + b), (x + a - b, y + a + b), (x - b, y + a)]
    return as_array(corners) * draw(st.sampled_from(SPACINGS))


@st.composite
def on_lines(draw: st.DrawFn) -> np.ndarray:
    """Exactly collinear integers, axis-aligned or sloped, with repeats."""
    dx, dy = draw(st.integers(-3, 3)), draw(st.integers(-3, 3))
    steps = draw(st.lists(st.integers(-20, 20), max_size=10))
    return as_array([(5 + dx * t, -2 + dy * t) for t in steps]) * 2.0 ** draw(
        st.sampled_from(POWERS)
    )


@st.composite
def near_lines(draw: st.DrawFn) -> np.ndarray:
    """Points of a line as floats put them: mostly an ulp off it."""
    slope = draw(st.sampled_from((1 / 3, 0.1, -0.7, 1e-5, 3.0)))
    steps = draw(st.lists(st.integers(-20, 20), max_size=10))
    return as_array([(0.1 * t, slope * (0.1 * t)) for t in steps])


@st.composite
def slivers(draw: st.DrawFn) -> np.ndarray:
    """Points within 1e-9 or so of a line."""
    slope = draw(st.sampled_from((0.0, 1.0, 0.3)))
    offset = st.sampled_from((0.0, 1e-9, -1e-9, 3e-10, 1e-12, 1e-15))
    steps = draw(st.lists(st.floats(-1, 1), min_size=3, max_size=9))
    return as_array([(t, slope * t + draw(offset)) for t in steps])


@st.composite
def duplicates(draw: st.DrawFn) -> np.ndarray:
    coordinate = st.sampled_from((0.0, -0.0, 1.0, 0.1, -2.5))
    return as_array(draw(st.lists(st.tuples(coordinate, coordinate), max_size=14)))


@st.composite
def generic(draw: st.DrawFn) -> np.ndarray:
    coordinate = st.floats(-1, 1, allow_subnormal=False)
    return as_array(draw(st.lists(st.tuples(coordinate, coordinate), max_size=11)))


@st.composite
def any_floats(draw: st.DrawFn) -> np.ndarray:
    """Whatever floats Hypothesis thinks of, as long as the kernels accept them."""
    coordinate = st.floats(-1e150, 1e150)
    return as_array(draw(st.lists(st.tuples(coordinate, coordinate), max_size=8)))


@st.composite
def scaled(draw: st.DrawFn) -> np.ndarray:
    """Huge and tiny clouds, by powers of two (exact) and of ten (rounded)."""
    points = draw(st.one_of(partial_grids(), cocircular(), near_lines()))
    return points * draw(
        st.sampled_from((1e150, 1e-150, 1e290, 2.0**500, 2.0**-500, 2.0**-900))
    )


@st.composite
def offsets(draw: st.DrawFn) -> np.ndarray:
    """Clouds far from the origin, their fine digits rounded away."""
    points = draw(st.one_of(partial_grids(), generic(), slivers()))
    return points + draw(st.sampled_from((1e8, -1e8, 1e15, 123456789.1)))


@st.composite
def many_scales(draw: st.DrawFn) -> np.ndarray:
    """Clusters of very different sizes and one far outlier."""
    pairs: list[Pair] = [(draw(st.sampled_from((1e6, 1e30, -1e60))), 1.0)]
    for _ in range(draw(st.integers(1, 3))):
        size = draw(st.sampled_from((1.0, 1e-6, 1e-12, 1e-30)))
        cells = st.tuples(st.integers(-2, 2), st.integers(-2, 2))
        at = draw(st.sampled_from((0.0, 1.0, -3.7)))
        pairs += [(at + size * x, size * y) for x, y in draw(st.lists(cells, max_size=4))]
    return as_array(pairs)


@st.composite
def subnormal(draw: st.DrawFn) -> np.ndarray:
    """Multiples of the smallest float there is."""
    step = st.integers(-6, 6)
    cells = draw(st.lists(st.tuples(step, step), max_size=10))
    return as_array(cells) * 5e-324


@st.composite
def few_points(draw: st.DrawFn) -> np.ndarray:
    coordinate = st.sampled_from((0.0, -0.0, 1.0, -3.25, 1e100))
    return as_array(draw(st.lists(st.tuples(coordinate, coordinate), max_size=3)))


EVERYTHING = {
    "full grids": shuffled(full_grids()),
    "partial grids": partial_grids(),
    "mask pixels": shuffled(mask_pixels()),
    "cocircular": cocircular(),
    "nearly cocircular": nudged(cocircular()),
    "rotated squares": rotated_squares(),
    "nearly squares": nudged(rotated_squares(), most=1),
    "on a line": on_lines(),
    "nearly on a line": near_lines(),
    "nudged off a line": nudged(on_lines(), most=1),
    "slivers": slivers(),
    "duplicates": duplicates(),
    "generic": generic(),
    "any floats": any_floats(),
    "scaled": scaled(),
    "offset": offsets(),
    "many scales": many_scales(),
    "subnormal": subnormal(),
    "few points": few_points(),
}
FAMILIES: dict[str, st.SearchStrategy[np.ndarray]] = {
    name: family.filter(in_range) for name, family in EVERYTHING.items()
}


def clouds() -> st.SearchStrategy[np.ndarray]:
    """Return clouds of any family."""
    return st.one_of(*FAMILIES.values())


@st.composite
def beyond_range(draw: st.DrawFn) -> np.ndarray:
    """Finite clouds whose exponents lie too far apart for exact arithmetic."""
    points = draw(st.one_of(generic(), partial_grids())).tolist()
    low, high = draw(st.sampled_from(((-200, 290), (-1000, 0), (0, 500), (-600, 600))))
    points += [[2.0**low, 0.0], [0.0, 2.0**high]]
    order = draw(st.permutations(range(len(points))))
    return as_array(points)[np.array(order)]


# Crowds: hundreds of points, for the validators in place of the oracles. Drawn by NumPy
# from a seed, as Hypothesis does not shrink them usefully.


def _lattice(rng: np.random.Generator, n: int) -> np.ndarray:
    side = max(1, math.isqrt(n))
    shear = rng.integers(-2, 3)
    x, y = np.divmod(rng.permutation(side * side)[: int(n * rng.uniform(0.3, 1))], side)
    return np.column_stack((x + shear * y, y)) * rng.choice(SPACINGS)


def _integers(rng: np.random.Generator, n: int) -> np.ndarray:
    return rng.integers(-(size := math.isqrt(n)) // 2, size, (n, 2)) * rng.choice(SPACINGS)


def _long_circle(rng: np.random.Generator, n: int) -> np.ndarray:
    """Of the 324 integer points at distance 5 * 13 * 17 * 29 from the origin."""
    radius = 5 * 13 * 17 * 29
    x = np.arange(-radius, radius + 1)
    y = np.sqrt(radius * radius - x * x).astype(np.int64)
    x, y = x[on := x * x + y * y == radius * radius], y[on]
    ring = np.concatenate((np.column_stack((x, y)), np.column_stack((x, -y))))
    inner = rng.integers(-radius // 2, radius // 2, (n // 8, 2))
    return np.concatenate((rng.permutation(ring)[:n], inner)).astype(float)


def _circles(rng: np.random.Generator, n: int) -> np.ndarray:
    angles = rng.choice(np.arange(n) * (2 * np.pi / n), n)
    circle = np.column_stack((np.cos(angles), np.sin(angles)))
    return circle * rng.integers(1, 4, (n, 1))


def _strips(rng: np.random.Generator, n: int) -> np.ndarray:
    """Points on a few parallel lines, some of them an ulp off."""
    rows = rng.integers(0, rng.integers(1, 5), n) * 10.0 ** rng.integers(-12, 1)
    points = np.column_stack((rng.integers(0, n, n) * 0.1, rows))
    points[:, 1] += rng.integers(-1, 2, n) * np.spacing(points[:, 1]) * (rows > 0)
    return points


def _sloped(rng: np.random.Generator, n: int) -> np.ndarray:
    """A line as floats put it, and some points beside it."""
    t = rng.integers(-n, n, n) * 0.1
    points = np.column_stack((t, t / 3))
    points[: n // 10, 1] += rng.normal(size=n // 10)
    return points


def _nested(rng: np.random.Generator, n: int) -> np.ndarray:
    """Grids inside grids: clusters at three scales."""
    scales = 10.0 ** -np.array([0, 5, 10])
    return sum(rng.integers(-2, 3, (n, 2)) * scale for scale in scales)


def _near_duplicates(rng: np.random.Generator, n: int) -> np.ndarray:
    points = rng.uniform(1, 2, (n // 6 + 1, 2))[rng.integers(0, n // 6 + 1, n)]
    return points + rng.integers(-1, 2, (n, 2)) * np.spacing(points)


def _exponential(rng: np.random.Generator, n: int) -> np.ndarray:
    """Coordinates of every scale that the kernels accept, often equal."""
    exponents = rng.integers(-200, 200, (n, 2)) // rng.integers(1, 30)
    return np.ldexp(rng.integers(-3, 4, (n, 2)).astype(float), exponents)


def _parabola(rng: np.random.Generator, n: int) -> np.ndarray:
    x = rng.integers(-n, n, n).astype(float)
    return np.column_stack((x, x * x))


def _fan(rng: np.random.Generator, n: int) -> np.ndarray:
    """A line that one far point sees under every angle: a vertex of many triangles."""
    points = np.column_stack((rng.integers(-n, n, n), np.zeros(n))).astype(float)
    points[0] = rng.integers(-n, n), 10.0 ** rng.integers(0, 9)
    return points


def _spiral(rng: np.random.Generator, n: int) -> np.ndarray:
    t = np.arange(n)
    angle, growth = t * rng.uniform(0.01, 2), np.exp(t / n * rng.uniform(0, 40))
    return np.column_stack((np.cos(angle), np.sin(angle))) * growth[:, np.newaxis]


def _walk(rng: np.random.Generator, n: int) -> np.ndarray:
    return rng.integers(-1, 2, (n, 2)).cumsum(axis=0).astype(float)


def _uniform(rng: np.random.Generator, n: int) -> np.ndarray:
    return rng.uniform(size=(n, 2)) * 10.0 ** rng.integers(-6, 1, 2)


def _smallest(rng: np.random.Generator, n: int) -> np.ndarray:
    return rng.integers(-n, n, (n, 2)) * 5e-324


CROWDS = {
    maker.__name__.strip("_"): maker
    for maker in (
        _lattice, _integers, _long_circle, _circles, _strips, _sloped, _nested,
        _near_duplicates, _exponential, _parabola, _fan, _spiral, _walk, _uniform, _smallest,
    )
}  # fmt: skip


def crowd(kind: str, seed: int, most: int = 700) -> np.ndarray:
    """Return a crowd of that kind, shuffled, moved, turned and scaled at random."""
    rng = np.random.default_rng(seed)
    n = int(math.exp(rng.uniform(math.log(3), math.log(most))))
    points = rng.permutation(CROWDS[kind](rng, n))
    if rng.uniform() < 0.3:
        points = points[:, ::-1]
    if rng.uniform() < 0.3 and kind not in {"exponential", "smallest"}:
        points = points + rng.choice([1e8, -3.0, 0.1])
    if rng.uniform() < 0.3 and kind != "smallest":
        points = points * rng.choice([0.1, 2.0**500, 2.0**-500, -1.0])
    return np.ascontiguousarray(points)
