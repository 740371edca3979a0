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


def all_copies(places, periods):
    ranges = [(0,) if side is None else range(-FAR, FAR + 1) for side in periods]
    return {
        moved(place, offset, periods) for place in set(places) for offset in product(*ranges)
    }


def corners(filtration, places, k, i):
    pairs = zip(filtration.simplices[k][i], filtration.offsets[k][i].tolist(), strict=True)
    return [moved(places[row], offset, filtration.periods) for row, offset in pairs]


def smallest_sphere(points):
    """Return the centre and the squared radius of the smallest sphere through points."""
    arms = [minus(p, points[0]) for p in points[1:]]
    rows = [[2 * dot(a, b) for b in arms] + [dot(a, a)] for a in arms]
    shares = solve(rows) if arms else []
    centre = points[0]
    for share, arm in zip(shares, arms, strict=True):
        centre = tuple(c + share * x for c, x in zip(centre, arm, strict=True))
    away = minus(centre, points[0])
    return centre, dot(away, away)


def inside(centre, square, copies):
    """Return the copies strictly within a sphere."""
    return [p for p in copies if dot(minus(p, centre), minus(p, centre)) < square]


def squared_values(filtration):
    """Return the exact squared value of each simplex, by its definition."""
    places = positions(filtration)
    copies = all_copies(places, filtration.periods)
    top = filtration.dimension
    values = [[None] * len(rows) for rows in filtration.simplices]
    for k in range(top, -1, -1):
        least = [None] * len(filtration.simplices[k])
        if k < top:
            for cell, faces in enumerate(filtration.faces[k + 1].tolist()):
                for face in faces:
                    value = values[k + 1][cell]
                    least[face] = value if least[face] is None else min(value, least[face])
        for i in range(len(filtration.simplices[k])):
            centre, square = smallest_sphere(corners(filtration, places, k, i))
            gabriel = not inside(centre, square, copies)
            assert gabriel or k < top, "a cell with a point in its sphere"
            values[k][i] = square if gabriel else least[i]
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
