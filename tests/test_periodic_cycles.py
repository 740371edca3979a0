"""Representative cycles in periodic boxes: closed, where they say, and born when they say."""

from __future__ import annotations

import math

import numpy as np
import pytest

import alphamesh as am
from alphamesh.cycles import hollow_cells
from alphamesh.errors import DimensionError, ParameterError


def box(points, periods, weights=None):
    return am.AlphaComplex(np.asarray(points, dtype=float), periods=periods, weights=weights)


def edges_of(filtration):
    """Number of each edge by its ends and the step from the first to the second."""
    found = {}
    rows, offsets = filtration.simplices[1].tolist(), filtration.offsets[1][:, 1]
    for number, ((a, b), step) in enumerate(zip(rows, offsets, strict=True)):
        found[a, b, tuple(step.tolist())] = number
        found[b, a, tuple((-step).tolist())] = number
    return found


def numbers_along(rings, index, edges):
    """Numbers of the edges of a ring, the closing one last; a KeyError if there is none."""
    where = slice(rings.offsets[index], rings.offsets[index + 1])
    rows, shifts = rings.vertices[where].tolist(), rings.shifts[where]
    assert not shifts[0].any()
    rows = [*rows, rows[0]]
    shifts = np.vstack((shifts, rings.windings[index]))
    steps = np.diff(shifts, axis=0).tolist()
    return [edges[rows[i], rows[i + 1], tuple(step)] for i, step in enumerate(steps)]


def clouds():
    rng = np.random.default_rng(7)
    yield box(rng.random((60, 2)), (1, 1))
    yield box(rng.random((12, 2)) * 3, (1, 0.4))
    yield box(rng.integers(0, 8, (40, 2)) * 0.1, (0.8, 0.8))
    yield box(rng.random((40, 2)), (None, 0.5), rng.random(40) * 0.01)
    yield box([[0.2, 0.2], [0.5, 0.6]], (1, 1))


@pytest.mark.parametrize("number", range(5))
def test_rings_around_holes_are_the_borders_of_what_they_enclose(number):
    made = list(clouds())[number]
    filtration, pairs = made.filtration, made.persistence()
    edges = edges_of(filtration)
    classes = np.arange(len(pairs.pairs[1]))
    rings = pairs.holes(classes)
    assert np.array_equal(np.unique(rings.classes), classes)
    for which, (creator, destroyer) in enumerate(pairs.pairs[1].tolist()):
        region = hollow_cells(
            filtration.radii[1], filtration.facet_cells, filtration.faces[2], creator, destroyer
        )
        found = np.bincount(filtration.faces[2][region].ravel(), minlength=len(edges))
        own = np.flatnonzero(rings.classes == which)
        along = [edge for k in own for edge in numbers_along(rings, k, edges)]
        assert sorted(along) == np.flatnonzero(found == 1).tolist()
        assert creator in along
        assert filtration.radii[1][along].max() == filtration.radii[1][creator]
        assert not rings.windings[own].sum(axis=0).any()
        if not rings.winds[own].any():
            area = 0.0
            for k in own:
                x, y = rings.places[rings.offsets[k] : rings.offsets[k + 1]].T
                area += (x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2
            assert area == pytest.approx(filtration.cell_sizes[region].sum())


@pytest.mark.parametrize("number", range(5))
def test_loops_close_and_are_born_with_their_edge(number):
    made = list(clouds())[number]
    filtration, pairs = made.filtration, made.persistence()
    edges = edges_of(filtration)
    loops = pairs.loops(np.arange(len(pairs.pairs[1])))
    for k, creator in enumerate(pairs.pairs[1][:, 0].tolist()):
        along = numbers_along(loops, k, edges)
        assert along[-1] == creator
        assert all(
            (filtration.radii[1][edge], edge) < (filtration.radii[1][creator], creator)
            for edge in along[:-1]
        )


@pytest.mark.parametrize("periods", [(1, 0.7), (1, None), (1, 0.6, 0.9), (None, 0.5, 1)])
@pytest.mark.parametrize("count", [1, 3, 80])
def test_loops_that_stay_wind_in_independent_directions(periods, count):
    made = box(np.random.default_rng(count).random((count, len(periods))), periods)
    rings = made.persistence().essential_loops()
    closed = [k for k, side in enumerate(periods) if side]
    assert len(rings) == len(closed)
    assert rings.winds.all()
    windings = rings.windings[:, closed]
    assert round(np.linalg.det(windings)) % 2 == 1
    assert not np.delete(rings.windings, closed, axis=1).any()
    edges = edges_of(made.filtration)
    for k, creator in enumerate(made.persistence().essential[1].tolist()):
        assert numbers_along(rings, k, edges)[-1] == creator
    sides = np.array([side or 0 for side in periods])
    expected = made.positions[rings.vertices] + rings.shifts * sides
    assert np.array_equal(rings.places, expected)


def test_a_strip_between_two_rows_has_two_rings_that_wind():
    steps = np.linspace(0, 1, 40, endpoint=False)
    rows = np.array([(x, y) for y in (0.1, 0.45) for x in steps])
    pairs = box(rows, (1, 1)).persistence()
    strip = pairs.alive(0.1)
    assert len(strip) == 1
    rings = pairs.holes(strip)
    assert sorted(map(tuple, rings.windings.tolist())) == [(-1, 0), (1, 0)]
    assert sorted(map(len, rings)) == [40, 40]
    # The hole lies on the left: the lower row runs to the right.
    lower = int(np.flatnonzero([ring.max() < 40 for ring in rings])[0])
    assert rings.windings[lower].tolist() == [1, 0]
    assert repr(rings) == "<PeriodicRings: 2, 2 around the box>"


def test_a_hole_across_the_border_is_in_one_piece():
    turns = np.linspace(0, 2 * math.pi, 30, endpoint=False)
    circle = 0.2 * np.column_stack((np.cos(turns), np.sin(turns)))  # around the corner
    pairs = box(circle, (1, 1)).persistence()
    [hole] = pairs.alive(0.1).tolist()
    rings = pairs.holes(hole)
    assert len(rings) == 1
    assert not rings.winds.any()
    centre = np.round(rings.places.mean(axis=0))
    assert np.hypot(*(rings.places - centre).T) == pytest.approx(0.2)
    assert np.array_equal(np.sort(rings[0]), np.arange(30))
    loop = pairs.loops(hole)
    assert sorted(loop[0].tolist()) == list(range(30))


@pytest.mark.parametrize("count", [3, 40])
def test_shells_of_voids_are_closed(count):
    made = box(np.random.default_rng(count).random((count, 3)) * 5, (1, 0.8, 0.6))
    filtration, pairs = made.filtration, made.persistence()
    classes = np.arange(len(pairs.pairs[2]))
    shells = pairs.voids(classes)
    assert len(shells) == len(classes) > 0
    for which, (creator, destroyer) in enumerate(pairs.pairs[2].tolist()):
        numbers = shells.numbers[shells.offsets[which] : shells.offsets[which + 1]]
        assert creator in numbers
        assert (np.bincount(filtration.faces[2][numbers].ravel()) % 2 == 0).all()
        assert np.array_equal(filtration.simplices[2][numbers], shells[which])
        region = hollow_cells(
            filtration.radii[2], filtration.facet_cells, filtration.faces[3], creator, destroyer
        )
        found = np.bincount(filtration.faces[3][region].ravel())
        assert numbers.tolist() == np.flatnonzero(found == 1).tolist()
    moved = shells.places - filtration.corners(2, shells.numbers)
    moves = moved / np.array(made.periods)
    assert moves == pytest.approx(np.repeat(np.round(moves[:, :1]), 3, axis=1), abs=1e-12)


def test_a_shell_across_the_border_is_in_one_piece():
    rng = np.random.default_rng(2)
    sphere = rng.normal(size=(300, 3))
    sphere *= 0.3 / np.linalg.norm(sphere, axis=1)[:, None]
    pairs = box(sphere, (1, 1, 1)).persistence()
    [void] = pairs.alive(0.25, 2).tolist()
    shell = pairs.voids(void)
    centre = np.round(shell.places.mean(axis=(0, 1)))
    assert np.linalg.norm(shell.places - centre, axis=2) == pytest.approx(0.3)
    assert repr(shell) == f"<PeriodicShells: {len(shell.triangles):,} triangles around 1 void>"


def test_what_there_is_not():
    flat, solid = box([[0, 0]], (1, 1)).persistence(), box([[0, 0, 0]], (1, 1, 1)).persistence()
    with pytest.raises(DimensionError, match="loops"):
        solid.holes(0)
    with pytest.raises(DimensionError, match="holes"):
        flat.voids(0)
    with pytest.raises(ParameterError, match="there is no class 7"):
        flat.loops(7)
    for nothing in (flat.holes([]), solid.loops([]), solid.voids([])):
        assert len(nothing) == 0
