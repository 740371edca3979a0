"""Weighted clouds in the plane that break careless geometry, and the core's results by name."""

from __future__ import annotations

from fractions import Fraction
from itertools import combinations, pairwise

import numpy as np

from alphamesh._kernels import _core
from oracles import orient, sign

NAMES_2 = [
    "dimension",
    "representative",
    "hidden",
    "triangles",
    "triangle_radii",
    "edges",
    "edge_radii",
    "edge_triangles",
    "vertices",
    "vertex_radii",
]


def regular2(points, weights, threads=1):
    points = np.ascontiguousarray(points, dtype=float)
    weights = np.ascontiguousarray(weights, dtype=float)
    return dict(zip(NAMES_2, _core.regular2(points, weights, threads, None), strict=True))


def values_of(result):
    """Return every simplex of a result in the plane with its signed root."""
    rows = (result["vertices"].reshape(-1, 1), result["edges"], result["triangles"])
    radii = (result["vertex_radii"], result["edge_radii"], result["triangle_radii"])
    return {
        tuple(simplex): value
        for simplices, values in zip(rows, radii, strict=True)
        for simplex, value in zip(simplices.tolist(), values.tolist(), strict=True)
    }


# ------------------------------------------------------------------------ weights


def spacing_sq(points):
    """Return about how far points are apart, squared."""
    spread = np.ptp(points, axis=0).max(initial=0.0) if len(points) else 0.0
    return (spread or 1.0) ** 2 / max(1, len(points))


def none(rng, points):
    return np.zeros(len(points))


def equal(rng, points):
    return np.full(len(points), spacing_sq(points) / 4)


def small(rng, points):
    return rng.random(len(points)) * spacing_sq(points) / 8


def as_large_as_cells(rng, points):
    return rng.normal(size=len(points)) * spacing_sq(points)


def negative(rng, points):
    return -rng.random(len(points)) * spacing_sq(points)


def hiding_many(rng, points):
    return rng.exponential(size=len(points)) * 20 * spacing_sq(points)


def integers(rng, points):
    return rng.integers(-3, 9, len(points)).astype(float)


def extreme(rng, points):
    return 10.0 ** rng.uniform(-12, 4, len(points)) * spacing_sq(points)


def hairs(rng, points):
    """Return weights that differ by a hair, if at all."""
    return rng.integers(0, 2, len(points)) * spacing_sq(points) * 2.0**-45


def tied(rng, points):
    """Return weights that lift all points onto a plane, up to rounding: the hardest tie."""
    return (points**2).sum(axis=1) + points @ rng.integers(-3, 4, points.shape[1])


def nearly_tied(rng, points):
    return tied(rng, points) * (1 + rng.integers(-1, 2, len(points)) * 2.0**-50)


def half_tied(rng, points):
    return tied(rng, points) * rng.integers(0, 2, len(points))


WEIGHTS = {
    maker.__name__.replace("_", " "): maker
    for maker in (
        none, equal, small, as_large_as_cells, negative, hiding_many, integers, extreme, hairs,
        tied, nearly_tied, half_tied,
    )
}  # fmt: skip


# ---------------------------------------------------------- a proof for larger clouds


def as_integers(points, weights):
    """Return coordinates and weights as whole multiples of a unit and of its square."""
    exact = [[Fraction(x) for x in row] for row in points.tolist()]
    heavy = [Fraction(w) for w in weights.tolist()]
    finest = max((x.denominator for row in exact for x in row), default=1)
    coarse = max((w.denominator for w in heavy), default=1)
    while finest**2 < coarse:
        finest *= 2
    places = [tuple(int(x * finest) for x in row) for row in exact]
    return places, [int(w * finest**2) for w in heavy]


def is_in_conflict(a, b, c, d, weights):
    """Tell whether the lifted d is below counter-clockwise a, b, c; ties as documented."""
    rows = []
    for p, w in zip((a, b, c), weights[:3], strict=True):
        x, y = p[0] - d[0], p[1] - d[1]
        rows.append((x, y, x * x + y * y - (w - weights[3])))
    (ax, ay, az), (bx, by, bz), (cx, cy, cz) = rows
    det = az * (bx * cy - by * cx) + bz * (cx * ay - cy * ax) + cz * (ax * by - ay * bx)
    if det:
        return det > 0
    for top in sorted((a, b, c), reverse=True):
        if top < d:
            return False
        turn = orient(*(d if p == top else p for p in (a, b, c)))
        if turn:
            return turn > 0
    raise AssertionError("the corners are on a line")


def prove_regular(points, weights, result):
    """Assert that the triangles cover the hull and no point is lifted below any of them."""
    places, heavy = as_integers(points, weights)
    merged = result["representative"]
    rows = range(len(points)) if merged is None else sorted({*merged.tolist()})
    doubled = 0
    for triangle in result["triangles"].tolist():
        a, b, c = (places[i] for i in triangle)
        if orient(a, b, c) < 0:
            triangle[1:] = triangle[:0:-1]
            b, c = c, b
        doubled += (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
        assert orient(a, b, c) > 0
        for d in rows:
            if d not in triangle:
                four = [heavy[i] for i in (*triangle, d)]
                assert not is_in_conflict(a, b, c, places[d], four)
    assert doubled == doubled_hull_area([places[i] for i in rows])
    used = {i for row in result["triangles"].tolist() for i in row}
    used |= {i for row in result["edges"].tolist() for i in row}
    assert used == {*result["vertices"].tolist()} or len(rows) < 2
    faces = {e for row in result["triangles"].tolist() for e in combinations(row, 2)}
    assert not faces or faces == {tuple(row) for row in result["edges"].tolist()}


def doubled_hull_area(places):
    """Return twice the area of the convex hull (Andrew's monotone chain)."""
    area = 0
    for way in (1, -1):
        chain = []
        for p in sorted(places)[::way]:
            while len(chain) > 1 and sign(orient(chain[-2], chain[-1], p)) <= 0:
                chain.pop()
            chain.append(p)
        area += sum(p[0] * q[1] - p[1] * q[0] for p, q in pairwise(chain))
    return area
