"""Slow, obvious, exact: periodic filtrations by their definition, in fractions."""

from __future__ import annotations

from fractions import Fraction
from itertools import product

from oracles3 import dot, minus, solve

# A sphere without points inside reaches at most half a period from its centre to a vertex
# in each periodic direction: copies further away than this cannot lie in one.
FAR = 2


def positions(filtration):
    """Return the exact places in the box of all rows."""
    places = []
    for row in filtration.points.tolist():
        place = []
        for x, side in zip(row, filtration.periods, strict=True):
            exact = Fraction(x)
            place.append(exact if side is None else exact % Fraction(side))
        places.append(tuple(place))
    return places


def moved(place, offset, periods):
    pairs = zip(place, offset, periods, strict=True)
    return tuple(x if side is None else x + k * Fraction(side) for x, k, side in pairs)


def weights_of(filtration):
    if filtration.weights is None:
        return [Fraction(0)] * len(filtration.points)
    return [Fraction(w) for w in filtration.weights.tolist()]


def all_copies(filtration, places, weights):
    """Return all copies near the box, with their weights."""
    periods = filtration.periods
    ranges = [(0,) if side is None else range(-FAR, FAR + 1) for side in periods]
    return {
        (moved(place, offset, periods), weight)
        for place, weight in set(zip(places, weights, strict=True))
        for offset in product(*ranges)
    }


def corners(filtration, places, k, i):
    pairs = zip(filtration.simplices[k][i], filtration.offsets[k][i].tolist(), strict=True)
    return [moved(places[row], offset, filtration.periods) for row, offset in pairs]


def smallest_sphere(points, weights):
    """Return the centre and the value of the smallest sphere orthogonal to weighted points."""
    arms = [minus(p, points[0]) for p in points[1:]]
    pairs = list(zip(arms, weights[1:], strict=True))
    rows = [[2 * dot(a, b) for b in arms] + [dot(a, a) - w + weights[0]] for a, w in pairs]
    shares = solve(rows) if arms else []
    centre = points[0]
    for share, arm in zip(shares, arms, strict=True):
        centre = tuple(c + share * x for c, x in zip(centre, arm, strict=True))
    away = minus(centre, points[0])
    return centre, dot(away, away) - weights[0]


def inside(centre, value, copies):
    """Return the copies whose power is less than a value."""
    return [p for p, w in copies if dot(minus(p, centre), minus(p, centre)) - w < value]


def exact_values(filtration):
    """Return the exact value of each simplex, the square of its radius, by its definition."""
    places, weights = positions(filtration), weights_of(filtration)
    copies = all_copies(filtration, places, weights)
    top = filtration.dimension
    values = [[None] * len(rows) for rows in filtration.simplices]
    for k in range(top, -1, -1):
        least = [None] * len(filtration.simplices[k])
        if k < top:
            for cell, faces in enumerate(filtration.faces[k + 1].tolist()):
                for face in faces:
                    value = values[k + 1][cell]
                    least[face] = value if least[face] is None else min(value, least[face])
        for i, rows in enumerate(filtration.simplices[k].tolist()):
            ends = corners(filtration, places, k, i)
            centre, value = smallest_sphere(ends, [weights[row] for row in rows])
            gabriel = not inside(centre, value, copies)
            assert gabriel or k < top, "a cell with a point in its sphere"
            values[k][i] = value if gabriel else least[i]
    return values


def matrix_pairs(filtration):
    """Return pairs and creators that stay, by reducing the whole boundary matrix over Z/2."""
    order = sorted(
        (radius, k, i)
        for k, radii in enumerate(filtration.radii)
        for i, radius in enumerate(radii.tolist())
    )
    place = {(k, i): at for at, (_, k, i) in enumerate(order)}
    owner, pairs = {}, [set() for _ in filtration.simplices]
    staying = [set() for _ in filtration.simplices]
    for at, (_, k, i) in enumerate(order):
        column = set()
        for face in filtration.faces[k][i].tolist() if k > 1 else ():
            column ^= {place[k - 1, face]}
        if k == 1:
            for face in filtration.faces[1][i].tolist():
                column ^= {place[0, face]}
        while column and max(column) in owner:
            column ^= owner[max(column)][0]
        if not column:
            staying[k].add(i)
            continue
        pivot = max(column)
        owner[pivot] = column, at
        creator = order[pivot][2]
        staying[k - 1].discard(creator)
        pairs[k - 1].add((creator, i))
    return pairs, staying
