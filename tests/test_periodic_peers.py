"""Periodic boxes against diode, tilings, and clouds without periods."""

from __future__ import annotations

import numpy as np
import pytest

import alphamesh as am
from alphamesh.errors import InvalidResultError
from test_periodic import boxed, grid


def diode_values(points, periods, *, exact=False):
    diode = pytest.importorskip("diode")
    d = points.shape[1]
    rows, values = diode.fill_periodic_alpha_shapes_arrays(
        points, exact, [0.0] * d, [float(side) for side in periods]
    )
    return [len(part) for part in rows], [np.sort(np.sqrt(np.asarray(v))) for v in values]


@pytest.mark.parametrize("d", [2, 3])
@pytest.mark.parametrize("side", [1.0, 7.3])
def test_values_are_those_of_diode(d, side):
    points = np.random.default_rng(5).random((300, d)) * side
    made = boxed(points, (side,) * d)
    counts, values = diode_values(points, (side,) * d)
    assert counts == [len(rows) for rows in made.simplices]
    for own, theirs in zip(made.radii, values, strict=True):
        assert np.allclose(np.sort(own), theirs, rtol=1e-9, atol=0)


@pytest.mark.parametrize("sides", [(6, 6), (4, 4, 4)])
def test_values_of_grids_are_those_of_diode(sides):
    points = grid(sides) + 0.25
    made = boxed(points, sides)
    _, values = diode_values(points, sides, exact=True)
    # Ties are broken otherwise there: counts agree by Euler, values as sets.
    for own, theirs in zip(made.radii, values, strict=True):
        assert len(own) == len(theirs)
        assert np.allclose(np.sort(own), theirs, rtol=1e-9, atol=0)


@pytest.mark.parametrize("d", [2, 3])
def test_the_middle_of_a_tiling_is_the_same(d):
    rng = np.random.default_rng(7)
    points = rng.integers(0, 1 << 20, (60, d)) / (1 << 20)
    made = boxed(points, (1.0,) * d)
    moves = grid((3,) * d) - 1
    tiling = np.concatenate([points + move for move in moves])
    whole = am.AlphaComplex(tiling)
    middle = int(np.flatnonzero((moves == 0).all(axis=1))[0])
    for k in range(1, d + 1):
        rows = whole.simplices[k]
        tile, point = np.divmod(rows, len(points))
        offset = (moves[tile] - moves[middle]).astype(int)
        seen = {}
        for r, o, value in zip(
            point.tolist(), offset.tolist(), whole.radii[k].tolist(), strict=True
        ):
            vertices = sorted((row, tuple(move)) for row, move in zip(r, o, strict=True))
            if not any(vertices[0][1]):
                seen[tuple(vertices)] = value
        own = {
            tuple((row, tuple(move)) for row, move in zip(r, o, strict=True)): value
            for r, o, value in zip(
                made.simplices[k].tolist(),
                made.offsets[k].tolist(),
                made.radii[k].tolist(),
                strict=True,
            )
        }
        assert own.keys() == seen.keys()
        for key, value in own.items():
            assert value == pytest.approx(seen[key], rel=1e-12)


@pytest.mark.parametrize("d", [2, 3])
def test_a_box_with_ample_room_changes_nothing_near(d):
    points = np.random.default_rng(13).random((80, d))
    made = boxed(points + 49.5, (100.0,) * d)
    alone = am.AlphaComplex(points + 49.5)
    # Copies are further away than twice this.
    near = 49.0 / 2
    for k in range(1, d + 1):
        own = {
            tuple(rows): radius
            for rows, radius in zip(
                made.simplices[k].tolist(), made.radii[k].tolist(), strict=True
            )
            if radius < near
        }
        expected = {
            tuple(rows): radius
            for rows, radius in zip(
                alone.simplices[k].tolist(), alone.radii[k].tolist(), strict=True
            )
            if radius < near
        }
        assert own.keys() == expected.keys()
        for key, radius in own.items():
            assert radius == pytest.approx(expected[key], rel=1e-12)


def test_one_check_is_for_all_filtrations():
    filtration = am.AlphaComplex([[0.1, 0.2], [0.4, 0.9]], periods=(1, 1)).filtration
    am.check.check_filtration(filtration)
    values = {name: getattr(filtration, name) for name in filtration.__dataclass_fields__}
    radii = tuple(-part - 1 for part in filtration.radii)
    with pytest.raises(InvalidResultError, match="below"):
        am.check.check_filtration(type(filtration)(**{**values, "radii": radii}))
