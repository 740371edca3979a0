"""The validators name what is broken in weighted results."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import alphamesh as am
from alphamesh.check import (
    RADIUS_ERROR_WITH_WEIGHTS,
    check_delaunay,
    check_filtration,
    check_shape,
)
from alphamesh.errors import InvalidResultError


def result(d, seed=3):
    rng = np.random.default_rng(seed)
    points, weights = rng.random((60, d)), rng.normal(size=60) * 0.03
    points[7], weights[7] = points[5], weights[5] - 1  # a lighter duplicate
    return am.filtration(points, weights=weights)


def edited(array, index, value):
    copy = array.copy()
    copy[index] = value
    return copy


def with_radius(found, k, row, factor):
    radii = list(found.radii)
    radii[k] = edited(radii[k], row, radii[k][row] * factor)
    return replace(found, radii=tuple(radii))


def forgotten(found):
    return replace(found, hidden=found.hidden[:-1])


def not_ascending(found):
    return replace(found, hidden=found.hidden[::-1].copy())


def hidden_vertex(found):
    rows = np.sort(np.append(found.hidden, found.simplices[0][3])).astype(np.int32)
    return replace(found, hidden=rows)


def lighter_stands(found):
    return replace(found, representative=edited(found.representative, 5, 7))


def lighter_is_not_told(found):
    return replace(found, hidden=found.hidden[found.hidden != 7])


def heavier(found):
    row = int(found.hidden[found.representative[found.hidden] == found.hidden][0])
    return replace(found, weights=edited(found.weights, row, 5.0))


def lighter_vertex(found):
    row = int(found.simplices[0][4, 0])
    return replace(found, weights=edited(found.weights, row, -5.0))


def too_few(found):
    return replace(found, weights=found.weights[:-1])


BROKEN = {
    "a hidden row is left out": (forgotten, "representatives|points: in no"),
    "hidden rows in no order": (not_ascending, "hidden: not ascending"),
    "a vertex is called hidden": (hidden_vertex, "representative"),
    "a lighter point stands for others": (lighter_stands, "heaviest"),
    "a lighter point is not told of": (lighter_is_not_told, "heavier equal point"),
    "a heavy point is hidden": (heavier, "hidden: a point with a part"),
    "a light point is no vertex": (lighter_vertex, "power circle|power sphere"),
    "a weight is missing": (too_few, "weights: not"),
}


@pytest.mark.parametrize("d", [2, 3])
@pytest.mark.parametrize("name", BROKEN)
def test_what_is_broken_is_named(d, name):
    found = result(d)
    check_filtration(found)
    break_it, message = BROKEN[name]
    with pytest.raises(InvalidResultError, match=message):
        check_filtration(break_it(found))


@pytest.mark.parametrize("d", [2, 3])
@pytest.mark.parametrize("factor", [1 - 1e-9, 1 + 1e-9, -1.0])
def test_every_wrong_value_is_found(d, factor):
    found = result(d)
    for k in range(d + 1):
        for row in range(0, len(found.radii[k]), max(1, len(found.radii[k]) // 5)):
            with pytest.raises(InvalidResultError, match="radii"):
                check_filtration(with_radius(found, k, row, factor))


@pytest.mark.parametrize("d", [2, 3])
def test_small_errors_of_gabriel_values_pass(d):
    found = result(d)
    last = found.radii[d].max()
    for share, passes in ((0.5, True), (10, False)):
        # Faces that have the value from this cell alone keep having it.
        value = last * (1 + share * RADIUS_ERROR_WITH_WEIGHTS)
        radii = tuple(np.where(values == last, value, values) for values in found.radii)
        if passes:
            check_filtration(replace(found, radii=radii))
            continue
        with pytest.raises(InvalidResultError, match="orthosphere"):
            check_filtration(replace(found, radii=radii))


@pytest.mark.parametrize("d", [2, 3])
def test_a_delaunay_triangulation_is_not_regular(d):
    found = result(d)
    plain = am.delaunay(found.points[found.simplices[0][:, 0]])
    weights = found.weights[found.simplices[0][:, 0]]
    check_delaunay(plain)
    with pytest.raises(InvalidResultError, match=r"power circle|power sphere"):
        check_delaunay(replace(plain, weights=weights))


@pytest.mark.parametrize("d", [2, 3])
def test_shapes_are_counted_with_their_points(d):
    cx = am.AlphaComplex(result(d).points, weights=result(d).weights)
    shape = cx.at(-0.05)
    check_shape(shape)
    assert 0 < shape.counts["vertices"] < len(cx.simplices[0])
    vars(shape)["counts"] = shape.counts | {"vertices": len(cx.simplices[0])}
    with pytest.raises(InvalidResultError, match="vertices"):
        check_shape(shape)
