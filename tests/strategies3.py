"""Hypothesis strategies for clouds in space that break careless geometry."""

from __future__ import annotations

import numpy as np
from hypothesis import assume
from hypothesis import strategies as st

import alphamesh as am
from alphamesh.errors import CoordinateRangeError

# Every integer point at distance 3 and 9 from the origin: exactly cospherical.
SPHERES = [
    np.array(
        [
            (x, y, z)
            for x in range(-r, r + 1)
            for y in range(-r, r + 1)
            for z in range(-r, r + 1)
            if x * x + y * y + z * z == r * r
        ],
        dtype=float,
    )
    for r in (3, 9)
]
MOST = 14


def of_lattice(rng, n):
    return rng.integers(0, rng.integers(2, 5), (n, 3)) * rng.choice([1.0, 0.1, 1 / 3, 7.0])


def on_spheres(rng, n):
    sphere = SPHERES[rng.integers(2)]
    return sphere[rng.permutation(len(sphere))[:n]]


def in_plane(rng, n):
    base = rng.integers(-3, 4, (2, 3))
    return (rng.integers(-3, 4, (n, 2)) @ base + rng.integers(-5, 6, 3)).astype(float)


def nearly_in_plane(rng, n):
    points = in_plane(rng, n)
    # The neighbours of zero are so small that they leave the range of the kernels.
    steps = np.where(points == 0, 0.0, np.spacing(points))
    return points + rng.integers(-1, 2, (n, 3)) * steps


def on_line(rng, n):
    return (rng.integers(-6, 7, (n, 1)) * rng.integers(-3, 4, 3)).astype(float)


def duplicates(rng, n):
    return rng.integers(-1, 2, (n, 3)).astype(float)


def uniform(rng, n):
    return rng.random((n, 3)) + rng.choice([0.0, 1e6])


def scales(rng, n):
    return rng.standard_normal((n, 3)) * 10.0 ** rng.integers(-6, 7, (n, 1))


def far_apart(rng, n):
    return np.ldexp(rng.integers(-3, 4, (n, 3)).astype(float), rng.choice([-200, 0, 150]))


def flat(rng, n):
    return rng.random((n, 3)) * [1.0, 1.0, 10.0 ** -rng.integers(3, 15)]


FAMILIES = {
    family.__name__: family
    for family in (
        of_lattice,
        on_spheres,
        in_plane,
        nearly_in_plane,
        on_line,
        duplicates,
        uniform,
        scales,
        far_apart,
        flat,
    )
}


@st.composite
def clouds3(draw: st.DrawFn, most: int = MOST) -> np.ndarray:
    """Draw small clouds of every family, as ``(n, 3)`` float64."""
    family = FAMILIES[draw(st.sampled_from(sorted(FAMILIES)))]
    n = draw(st.integers(0, most))
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    return np.asarray(family(rng, n), dtype=float).reshape(-1, 3)


def complex_of(points):
    """Return the complex of a nasty cloud; not if its spheres are beyond float64."""
    try:
        return am.AlphaComplex(points)
    except CoordinateRangeError as error:
        assume("too large for float64" not in str(error))
        raise
