"""The measures of a union of balls in 50 digits, from the simplices of its alpha complex.

Slow and plain: positions by solving linear equations, every angle by itself. Which simplices
there are is taken from the filtration, whose values are tested elsewhere.
"""

from __future__ import annotations

import itertools

import numpy as np
from mpmath import mp, mpf


def minus(a, b):
    return [x - y for x, y in zip(a, b, strict=True)]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b, strict=True))


def cross(a, b):
    return [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]


class Balls:
    """Sums over the simplices at one radius: `volume`, `volumes`, `areas`."""

    def __init__(self, filtration, radius):
        with mp.workdps(50):
            self.points = [[mpf(x) for x in row] for row in filtration.points.tolist()]
            n = len(self.points)
            weights = getattr(filtration, "weights", None)
            power = mpf(radius) * abs(mpf(radius))
            self.weights = [mpf(0)] * n if weights is None else list(map(mpf, weights.tolist()))
            self.squares = [w + power for w in self.weights]
            self.has = [radii <= radius for radii in filtration.radii]
            self.filtration = filtration
            self.total, self.shares, self.turns = mpf(0), [mpf(0)] * n, [mpf(0)] * n
            self.euler = [0] * n
            for row in filtration.simplices[0][self.has[0]][:, 0].tolist():
                self.euler[row] = 2
            self.left = {}
            self._edges()
            self._tetrahedra()
            self._triangles()
            self._finish()

    def of(self, dimension):
        present = np.flatnonzero(self.has[dimension])
        rows = self.filtration.simplices[dimension][present].tolist()
        return zip(present.tolist(), rows, strict=True)

    def lens(self, i, j):
        """Length of an edge; how far the radical plane is from i and from j."""
        edge = minus(self.points[j], self.points[i])
        length = mp.sqrt(dot(edge, edge))
        near = (length**2 + self.weights[i] - self.weights[j]) / (2 * length)
        return length, near

    def away(self, i, j, k):
        """How far the orthocentre of a triangle is from edge ij, towards k."""
        length, near = self.lens(i, j)
        a, b = minus(self.points[j], self.points[i]), minus(self.points[k], self.points[i])
        normal = cross(a, b)
        along = dot(a, b) / length
        beside = mp.sqrt(dot(normal, normal)) / length
        square = dot(b, b) + self.weights[i] - self.weights[k]
        return (square - 2 * along * near) / (2 * beside)

    def _edges(self):
        for _, edge in self.of(1):
            self.left[tuple(edge)] = 2 * mp.pi
            for row in edge:
                self.euler[row] -= 1

    def _tetrahedra(self):
        for _, rows in self.of(3):
            p = [self.points[row] for row in rows]
            sides = [minus(q, p[0]) for q in p[1:]]
            det = abs(dot(sides[0], cross(sides[1], sides[2])))
            self.total += det / 6
            right = [
                (dot(s, s) + self.weights[rows[0]] - self.weights[row]) / 2
                for s, row in zip(sides, rows[1:], strict=True)
            ]
            offset = list(mp.lu_solve(mp.matrix(sides), mp.matrix(right)))
            centre = [x + y for x, y in zip(p[0], offset, strict=True)]
            for row in rows:
                self.euler[row] -= 1
            for i, j in itertools.combinations(rows, 2):
                k, m = (row for row in rows if row not in (i, j))
                a = minus(self.points[j], self.points[i])
                u = cross(a, minus(self.points[k], self.points[i]))
                v = cross(a, minus(self.points[m], self.points[i]))
                self.left[i, j] -= mp.atan2(mp.sqrt(dot(a, a)) * det, dot(u, v))
            for i, j, k, m in itertools.permutations(rows):
                normal = cross(
                    minus(self.points[j], self.points[i]), minus(self.points[k], self.points[i])
                )
                size = mp.sqrt(dot(normal, normal))
                up = 1 if dot(normal, minus(self.points[m], self.points[i])) > 0 else -1
                height = up * dot(minus(centre, self.points[i]), normal) / size
                self.shares[i] += self.lens(i, j)[1] * self.away(i, j, k) * height / 6

    def _triangles(self):
        for number, rows in self.of(2):
            for row in rows:
                self.euler[row] += 1
            cofaces = self.filtration.triangle_tetrahedra[number]
            open_sides = 2 - sum(t >= 0 and bool(self.has[3][t]) for t in cofaces.tolist())
            if not open_sides:
                continue
            i, j, k = rows
            normal = cross(
                minus(self.points[j], self.points[i]), minus(self.points[k], self.points[i])
            )
            size = mp.sqrt(dot(normal, normal))
            square = self.squares[i] - self.lens(i, j)[1] ** 2 - self.away(i, j, k) ** 2
            height = mp.sqrt(max(square, mpf(0)))
            self.total += open_sides * size * height / 6
            for i, j, k in itertools.permutations(rows):
                away = self.away(i, j, k)
                self.shares[i] += open_sides * self.lens(i, j)[1] * away * height / 6
                if i < j:
                    self.left[i, j] -= open_sides * mp.atan2(height, away)
                if j < k:
                    a = minus(self.points[j], self.points[i])
                    b = minus(self.points[k], self.points[i])
                    (la, na), (lb, nb) = self.lens(i, j), self.lens(i, k)
                    across = self.squares[i] * dot(a, b) - na * la * nb * lb
                    turn = mp.atan2(mp.sqrt(self.squares[i]) * height * size, across)
                    self.turns[i] -= open_sides * turn

    def _finish(self):
        for (i, j), left in self.left.items():
            length, near = self.lens(i, j)
            circle_sq = self.squares[i] - near**2
            self.total += length * circle_sq * left / 6
            for row, h in ((i, near), (j, length - near)):
                self.shares[row] += h * circle_sq * left / 6
                self.turns[row] += h / mp.sqrt(self.squares[row]) * left
        areas = []
        for row, square in enumerate(self.squares):
            there = self.has[0][self.filtration.simplices[0][:, 0] == row].any()
            area = square * (2 * mp.pi * self.euler[row] + self.turns[row]) if there else mpf(0)
            areas.append(area)
            if there:
                self.total += mp.sqrt(square) * area / 3
                self.shares[row] += mp.sqrt(square) * area / 3
        self.volume = float(self.total)
        self.volumes = np.array(self.shares, dtype=float)
        self.areas = np.array(areas, dtype=float)
