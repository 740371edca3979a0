"""Slow, obvious persistence: reduction of the whole boundary matrix over Z/2."""

from __future__ import annotations

import numpy as np

__all__ = ["ordered_simplices", "reduced_pairs"]


def ordered_simplices(filtration):
    """Return (radius, dimension, position, rows) of all simplices, as they join."""
    return sorted(
        (radius, k, i, tuple(row))
        for k, (rows, radii) in enumerate(
            zip(filtration.simplices, filtration.radii, strict=True)
        )
        for i, (row, radius) in enumerate(zip(rows.tolist(), radii.tolist(), strict=True))
    )


def reduced_pairs(filtration):
    """Return the pairs of positions of each dimension, and those that create what stays."""
    simplices = ordered_simplices(filtration)
    place = {rows: i for i, (_, _, _, rows) in enumerate(simplices)}
    by_pivot, creators = {}, set()
    pairs = [set() for _ in filtration.simplices]
    for j, (_, k, position, rows) in enumerate(simplices):
        column = {place[rows[:i] + rows[i + 1 :]] for i in range(k + 1)} if k else set()
        while column and max(column) in by_pivot:
            column ^= by_pivot[max(column)]
        if column:
            pivot = max(column)
            by_pivot[pivot] = column
            creators.discard(pivot)
            pairs[k - 1].add((simplices[pivot][2], position))
        else:
            creators.add(j)
    staying = [set() for _ in filtration.simplices]
    for j in creators:
        _, k, position, _ = simplices[j]
        staying[k].add(position)
    return pairs, staying


def pair_set(rows):
    """Return an ``(m, 2)`` array as a set of tuples; none may come twice."""
    found = {tuple(row) for row in rows.tolist()}
    assert len(found) == len(rows)
    return found


def check_pairs(persistence):
    """Compare pairs and classes that stay with those of matrix reduction."""
    filtration = persistence.filtration
    pairs, staying = reduced_pairs(filtration)
    for k in range(3):
        assert pair_set(persistence.pairs[k]) == pairs[k]
        assert set(persistence.essential[k].tolist()) == staying[k]
        born = filtration.radii[k].take(persistence.pairs[k][:, 0])
        assert np.array_equal(persistence.births[k], born)
    assert not any(pairs[3:])
