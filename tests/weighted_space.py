"""Nasty small weighted clouds in space, and a check of every result by the definition.

Coordinates are integers times a power of two, weights integers times its square, so that whole
numbers and fractions decide everything. Nothing here is shared with the core.
"""

from __future__ import annotations

import math
from fractions import Fraction
from itertools import combinations

import numpy as np

from nasty_space import KINDS, check_tetrahedra, cross, dot, minus, volume
from space_core import regular3

# Relative, of the signed root of a power value.
BOUND = 5e-13


# ------------------------------------------------------------------------ weights


def none(points, random):
    return np.zeros(len(points), dtype=np.int64)


def equal(points, random):
    return np.full(len(points), random.integers(-9, 10))


def few(points, random):
    return random.integers(-2, 3, len(points))


def of_scale(points, random):
    size = np.ptp(points, axis=0).max() + 1
    return [
        int(size**2 * share)
        for share in random.uniform(-1, 1, len(points)) / random.integers(1, 9)
    ]


def extreme(points, random):
    return random.integers(-9, 10, len(points)) * 2 ** random.integers(0, 40, len(points))


def tied(points, random):
    """Return weights that lift all points onto a plane; that is the hardest tie there is."""
    return (points**2).sum(axis=1) + points @ random.integers(-9, 10, 3)


def nearly_tied(points, random):
    return tied(points, random) + random.integers(-1, 2, len(points))


def heavy(points, random):
    """Return weights of which few are very large, so that they swallow others."""
    size = np.ptp(points, axis=0).max()
    chosen = random.integers(0, len(points), 2)
    return [size**2 if row in chosen else 0 for row in range(len(points))]


WEIGHTS = [none, equal, few, of_scale, extreme, tied, nearly_tied, heavy]


def nasty_weighted_cloud(seed):
    """Return integer points and weights, and the exponent of the unit of length."""
    random = np.random.default_rng(seed)
    kind = KINDS[random.integers(len(KINDS))]
    points = kind(int(random.integers(4, 17)), random).astype(np.int64)
    weights = WEIGHTS[seed % len(WEIGHTS)](points.astype(object), random)
    weights = [int(float(w)) for w in weights]  # what a float can hold
    return points, weights, int(random.choice([0, 0, 1, -40, 100, -100]))


# ------------------------------------------------------------------------- checks


def heaviest_rows(points, weights):
    """Return for each row the heaviest, then lowest, of those with the same coordinates."""
    best = {}
    for row, p in enumerate(points):
        if p not in best or weights[row] > weights[best[p]]:
            best[p] = row
    return [best[p] for p in points]


def lifted(p, weight, origin, base):
    d = minus(p, origin)
    return [*d, dot(d, d) - weight + base]


def power_side(corners, e, weight):
    """Return 1 if e is lifted below the positive corners, -1 above, 0 in one plane."""
    rows = [lifted(p, weight[p], e, weight[e]) for p in corners]
    value = sum(
        (-1) ** k * rows[k][3] * dot(rows[i][:3], cross(rows[j][:3], rows[m][:3]))
        for k, (i, j, m) in enumerate([(1, 2, 3), (0, 2, 3), (0, 1, 3), (0, 1, 2)])
    )
    return (value > 0) - (value < 0)


def in_power_sphere(corners, e, weight):
    """The same with ties broken: the largest point is lifted most."""
    side = power_side(corners, e, weight)
    if side:
        return side > 0
    for top in sorted([*corners, e], reverse=True):
        if top == e:
            return False
        side = volume(*(e if p == top else p for p in corners))
        if side:
            return side > 0
    raise AssertionError("no perturbation decides")


def orthocentre(corners, weights):
    """Return where the powers of one to four points are equal and least, and that power."""
    a, edges = corners[0], [minus(p, corners[0]) for p in corners[1:]]
    # a + sum of x_i edges_i; 2 G x = |edge|^2 - (weight - first weight).
    matrix = [
        [Fraction(2 * dot(u, v)) for v in edges] + [Fraction(dot(u, u) - w + weights[0])]
        for u, w in zip(edges, weights[1:], strict=True)
    ]
    for i, row in enumerate(matrix):
        row[:] = [value / row[i] for value in row]
        for other in matrix:
            if other is not row:
                factor = other[i]
                other[:] = [x - factor * y for x, y in zip(other, row, strict=True)]
    offset = [
        sum((row[-1] * e[k] for row, e in zip(matrix, edges, strict=True)), Fraction(0))
        for k in range(3)
    ]
    return [x + y for x, y in zip(a, offset, strict=True)], dot(offset, offset) - weights[0]


def expected_powers(points, weights, simplices):
    """Return the power value of each simplex by the definition, cofaces first."""
    cloud = sorted({(points[row], weights[row]) for row in heaviest_rows(points, weights)})
    powers = {}
    for rows in sorted(simplices, key=len, reverse=True):
        centre, power = orthocentre([points[i] for i in rows], [weights[i] for i in rows])
        if any(dot(e := minus(p, centre), e) - w < power for p, w in cloud):
            size = len(rows) + 1
            above = (v for s, v in powers.items() if len(s) == size and {*rows} <= {*s})
            power = min(above)
        powers[rows] = power
    return powers


def root_error(radius, power):
    """Return the relative error of a signed root of `power`."""
    if power == 0:
        return 0.0 if radius == 0 else math.inf
    ratio = Fraction(radius) ** 2 * (1 if radius > 0 else -1) / power
    return float(abs(ratio - 1)) / 2 if ratio > 0 else math.inf


def simplices_of(result):
    """Return the radius of each simplex."""
    radii = {
        (row,): r for row, r in zip(result["vertices"], result["vertex_radii"], strict=True)
    }
    for name, values in (
        ("edges", "edge_radii"),
        ("triangles", "triangle_radii"),
        ("tetrahedra", "tetrahedron_radii"),
    ):
        rows = [tuple(row) for row in result[name].tolist()]
        assert len(set(rows)) == len(rows)
        radii |= dict(zip(rows, result[values].tolist(), strict=True))
    return radii


def check_hidden(result, points, weights):
    rows = heaviest_rows(points, weights)
    if result["representative"] is None:
        assert rows == [*range(len(points))]
    else:
        assert result["representative"].tolist() == rows
    vertices = set(result["vertices"].tolist())
    assert result["vertices"].tolist() == sorted(vertices)
    assert vertices == set(np.unique(result["tetrahedra"]).tolist())
    expected = [
        row
        for row, best in enumerate(rows)
        if weights[row] < weights[best] or (best == row and row not in vertices)
    ]
    assert result["hidden"].tolist() == expected
    weight = {points[row]: weights[row] for row in rows}
    cells = []
    for cell in result["tetrahedra"].tolist():
        corners = [points[i] for i in cell]
        if volume(*corners) < 0:
            corners[:2] = corners[1::-1]
        cells.append(corners)
    for row in set(rows) - vertices:
        p = points[row]
        around = next(
            corners
            for corners in cells
            if all(
                volume(*(p if k == i else q for i, q in enumerate(corners))) >= 0
                for k in range(4)
            )
        )
        assert power_side(around, p, weight) < 0, f"row {row} is not hidden"


def check_weighted_cloud(integers, whole, exponent=0):
    """Raise AssertionError if anything about a weighted complex in space is wrong."""
    result = regular3(
        np.ldexp(integers.astype(float), exponent),
        np.ldexp(np.array(whole, float), 2 * exponent),
    )
    points, weights = [tuple(row) for row in integers.tolist()], whole
    assert result["dimension"] == 3
    check_hidden(result, points, weights)
    weight = {points[row]: weights[row] for row in heaviest_rows(points, weights)}
    check_tetrahedra(
        points, result["tetrahedra"].tolist(), lambda c, e: in_power_sphere(c, e, weight)
    )
    radii = simplices_of(result)
    counts = [sum(len(s) == size for s in radii) for size in (1, 2, 3, 4)]
    assert counts[0] - counts[1] + counts[2] - counts[3] == 1
    for rows, value in radii.items():
        for face in combinations(rows, len(rows) - 1):
            assert not face or radii[face] <= value, rows
    unit = Fraction(2) ** exponent
    for rows, power in expected_powers(points, weights, list(radii)).items():
        error = root_error(radii[rows], power * unit**2)
        assert error < BOUND, f"value of {rows} is off by {error}"
