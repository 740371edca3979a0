"""Nasty small clouds in space, and a check of every simplex and value by the definition.

Coordinates are integers times a power of two, so that whole numbers and fractions decide
everything: orientation, volume, ties, values. Nothing here is shared with the core, nor with
`alphamesh.check`.
"""

from __future__ import annotations

from fractions import Fraction
from itertools import combinations

import numpy as np

from oracles import relative_error
from space_core import alpha3

# Relative; the core promises 2e-13 for tetrahedra, 1e-14 for the others.
BOUND = 2e-13


# ------------------------------------------------------------------------- clouds


def lattice(n, random):
    return random.integers(0, random.integers(2, 6), (n, 3))


def noisy_plane(n, random):
    steps = random.integers(-6, 7, (n, 2)) @ random.integers(-4, 5, (2, 3))
    steps *= 2 ** random.integers(1, 24)
    steps[:, random.integers(3)] += random.integers(-1, 2, n)
    return steps


def duplicates(n, random):
    return random.integers(-9, 10, (max(4, n // 3), 3))[random.integers(0, max(4, n // 3), n)]


def line(n, random):
    points = np.outer(random.integers(-500, 500, n), random.integers(-3, 4, 3))
    points[random.integers(0, n, 3)] += random.integers(-1, 2, (3, 3))
    return points


def sphere(n, random):
    """Return integer points with x² + y² + z² = 9, and a few near them."""
    ball = np.indices((7, 7, 7)).reshape(3, -1).T - 3
    points = random.permutation(ball[(ball**2).sum(axis=1) == 9])[:n] * 2**10
    points[: n // 4] += random.integers(-1, 2, points[: n // 4].shape)
    return points


def scales(n, random):
    return random.integers(-9, 10, (n, 3)) * 2 ** random.integers(0, 30, (n, 1))


KINDS = [lattice, noisy_plane, duplicates, line, sphere, scales]


def nasty_cloud(seed):
    """Return integer points and the exponent of their unit."""
    random = np.random.default_rng(seed)
    kind = KINDS[seed % len(KINDS)]
    points = kind(int(random.integers(1, 17)), random).astype(np.int64)
    return points, int(random.choice([0, 0, 1, -40, 100, -100]))


# ------------------------------------------------------------------------- checks


def minus(p, q):
    return [x - y for x, y in zip(p, q, strict=True)]


def dot(u, v):
    return sum(x * y for x, y in zip(u, v, strict=True))


def cross(u, v):
    return [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]


def volume(a, b, c, d):
    return dot(cross(minus(b, a), minus(c, a)), minus(d, a))


def in_sphere(corners, e):
    """Tell whether e is in the sphere of positive corners; the largest point is lifted most."""
    rows = [[*minus(p, e), dot(minus(p, e), minus(p, e))] for p in corners]
    value = sum(
        (-1) ** k * rows[k][3] * dot(rows[i], [*cross(rows[j][:3], rows[m][:3]), 0])
        for k, (i, j, m) in enumerate([(1, 2, 3), (0, 2, 3), (0, 1, 3), (0, 1, 2)])
    )
    if value:
        return value > 0
    for top in sorted([*corners, e], reverse=True):
        if top == e:
            return False
        side = volume(*(e if p == top else p for p in corners))
        if side:
            return side > 0
    raise AssertionError("no perturbation decides")


def smallest_sphere(corners):
    """Return centre and squared radius of the smallest sphere through two to four points."""
    a, edges = corners[0], [minus(p, corners[0]) for p in corners[1:]]
    # The centre is a + sum of x_i edges_i, at equal distance from all: 2 G x = diagonal of G.
    matrix = [[Fraction(2 * dot(u, v)) for v in edges] + [Fraction(dot(u, u))] for u in edges]
    for i, row in enumerate(matrix):
        row[:] = [value / row[i] for value in row]
        for other in matrix:
            if other is not row:
                factor = other[i]
                other[:] = [x - factor * y for x, y in zip(other, row, strict=True)]
    offset = [
        sum(row[-1] * e[k] for row, e in zip(matrix, edges, strict=True)) for k in range(3)
    ]
    return [x + y for x, y in zip(a, offset, strict=True)], dot(offset, offset)


def expected_squares(points, simplices):
    """Return the squared value of each simplex by the definition, cofaces first."""
    cloud = sorted(set(points))
    squares = {}
    for rows in sorted(simplices, key=len, reverse=True):
        centre, square = smallest_sphere([points[i] for i in rows])
        if any(dot(minus(p, centre), minus(p, centre)) < square for p in cloud):
            size = len(rows) + 1
            above = (v for s, v in squares.items() if len(s) == size and {*rows} <= {*s})
            square = min(above)
        squares[rows] = square
    return squares


def check_tetrahedra(points, tetrahedra, inside=in_sphere):
    facets = {}
    total = 0
    for row in tetrahedra:
        corners = [points[i] for i in row]
        size = volume(*corners)
        assert size != 0, f"flat tetrahedron {row}"
        if size < 0:
            corners[:2] = corners[1::-1]
        total += abs(size)
        for k in range(4):
            facets.setdefault((*row[:k], *row[k + 1 :]), []).append((corners, points[row[k]]))
    hull = 0
    for row, sides in facets.items():
        triangle = [points[i] for i in row]
        assert len(sides) in (1, 2), f"facet {row} of {len(sides)} tetrahedra"
        if len(sides) == 2:
            (corners, apex), (_, other) = sides
            assert volume(*triangle, apex) * volume(*triangle, other) < 0, f"fold at {row}"
            assert not inside(corners, other), f"facet {row} is not locally Delaunay"
            continue
        out = 1 if volume(*triangle, sides[0][1]) > 0 else -1
        assert all(out * volume(*triangle, p) >= 0 for p in points), f"{row} is not on the hull"
        hull += out * volume(*triangle, points[0])
    assert total == hull, "the tetrahedra do not fill the hull"


def check_cloud(integers, exponent=0):
    """Raise AssertionError if anything about the complex of a cloud is wrong."""
    result = alpha3(np.ldexp(integers.astype(float), exponent))
    points = [tuple(row) for row in integers.tolist()]
    first = {}
    representative = [first.setdefault(p, row) for row, p in enumerate(points)]
    if result["representative"] is None:
        assert len(first) == len(points)
    else:
        assert result["representative"].tolist() == representative
    squares = {}
    for name, radii in (
        ("edges", "edge_radii"),
        ("triangles", "triangle_radii"),
        ("tetrahedra", "tetrahedron_radii"),
    ):
        rows = [tuple(row) for row in result[name].tolist()]
        values = result[radii].tolist()
        assert len(set(rows)) == len(rows)
        for row, value in zip(rows, values, strict=True):
            faces = combinations(row, len(row) - 1)
            assert all(squares[face] <= value for face in faces if len(face) > 1), row
            squares[row] = value
    counts = [len(first), *(len(result[k]) for k in ("edges", "triangles", "tetrahedra"))]
    assert counts[0] - counts[1] + counts[2] - counts[3] == 1
    assert (result["dimension"] == 3) == (counts[3] > 0)
    check_tetrahedra(points, result["tetrahedra"].tolist())
    unit = Fraction(2) ** exponent
    for row, square in expected_squares(points, list(squares)).items():
        error = relative_error(squares[row], square * unit**2)
        assert error < BOUND, f"value of {row} is off by {error}"
