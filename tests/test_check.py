"""The validators pass every right result, and name what is broken in the others."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import alphamesh.check
from alphamesh.check import RADIUS_ERROR, check_delaunay, check_filtration, check_shape
from alphamesh.delaunay import Delaunay, delaunay
from alphamesh.errors import CoordinateRangeError, InvalidResultError
from alphamesh.filtration import filtration
from alphamesh.shape import AlphaShape
from strategies import FAMILIES

RANDOM = np.random.default_rng(0).uniform(size=(60, 2))
GRID = np.stack(np.meshgrid(np.arange(6.0), np.arange(5.0)), axis=-1).reshape(-1, 2)
REPEATED = np.concatenate((GRID, GRID[::2]))
LINE = np.arange(7.0)[:, np.newaxis] * [1.0, 2.0]


def edited(array, index, value):
    copy = array.copy()
    copy[index] = value
    return copy


# ------------------------------------------------------------- right results


@pytest.mark.parametrize("family", FAMILIES)
@given(data=st.data())
def test_right_results_pass(family, data):
    points = data.draw(FAMILIES[family])
    check_delaunay(delaunay(points))
    try:
        result = filtration(points)
    except CoordinateRangeError:
        return
    check_filtration(result)
    radii = np.concatenate(([0.0, 1.0, np.inf], *result.radii[1:]))
    check_shape(AlphaShape(result, radii[data.draw(st.integers(0, len(radii) - 1))]))


def test_the_names_are_public():
    assert set(alphamesh.check.__all__) == {
        "RADIUS_ERROR", "RADIUS_ERROR_IN_SPACE", "RADIUS_ERROR_WITH_WEIGHTS",
        "check_delaunay", "check_filtration", "check_periodic", "check_shape", "check_surface",
    }  # fmt: skip
    assert RADIUS_ERROR <= alphamesh.check.RADIUS_ERROR_IN_SPACE <= 1e-12


# ------------------------------------------------------ broken triangulations


def without_triangle(result, row):
    """Return the result without a triangle, everything else consistent."""
    keep = np.delete(np.arange(len(result.triangles)), row)
    new_row = np.full(len(result.triangles) + 1, -1, dtype=np.int32)
    new_row[keep] = np.arange(len(keep))
    return replace(
        result, triangles=result.triangles[keep], neighbors=new_row[result.neighbors[keep]]
    )


def from_triangles(points, triangles):
    """Return a triangulation of these triangles with the neighbours that follow."""
    triangles = np.sort(np.array(triangles, dtype=np.int32), axis=1)
    neighbors = np.full(triangles.shape, -1, dtype=np.int32)
    sides = {}
    for row, triangle in enumerate(triangles.tolist()):
        for j in range(3):
            side = (*triangle[:j], *triangle[j + 1 :])
            if side in sides:
                other, k = sides[side]
                neighbors[row, j], neighbors[other, k] = other, row
            sides[side] = (row, j)
    rows = np.arange(len(points), dtype=np.int32)
    none = np.empty((0, 2), dtype=np.int32)
    return Delaunay(np.array(points, dtype=float), rows, triangles, neighbors, none)


def flipped(result):
    """Return every triangulation with one inner edge flipped, where that is possible."""
    for row, opposite in enumerate(result.neighbors):
        for j, other in enumerate(opposite):
            if other > row:
                a, (b, c) = result.triangles[row, j], np.delete(result.triangles[row], j)
                d = np.setdiff1d(result.triangles[other], [b, c])[0]
                triangles = result.triangles.copy()
                triangles[row], triangles[other] = np.sort([a, b, d]), np.sort([a, c, d])
                yield from_triangles(result.points, triangles)


@pytest.mark.parametrize("points", [RANDOM, GRID, np.array([(0, 0), (4, 0), (3, 3), (0, 4.0)])])
def test_any_flip_is_found(points):
    """In the grid too: of two diagonals with equal rights, one alone is canonical."""
    count = 0
    for broken in flipped(delaunay(points)):
        count += 1
        with pytest.raises(InvalidResultError, match=r"circumcircle|flat|folded|convex"):
            check_delaunay(broken)
    assert count > 0


def test_any_missing_triangle_is_found():
    result = delaunay(RANDOM)
    for row in range(len(result.triangles)):
        with pytest.raises(InvalidResultError):
            check_delaunay(without_triangle(result, row))


def test_any_wrong_neighbor_is_found():
    result = delaunay(RANDOM)
    for row in range(len(result.triangles)):
        broken = edited(result.neighbors, (row, row % 3), (result.neighbors[row, row % 3] + 1))
        with pytest.raises(InvalidResultError, match=rf"neighbors: .*row {row}\b") as caught:
            check_delaunay(replace(result, neighbors=broken))
        assert caught.value.rows == (row,)


def test_any_wrong_vertex_is_found():
    result = delaunay(RANDOM)
    for row in range(len(result.triangles)):
        for column in range(3):
            id_ = result.triangles[row, column]
            broken = edited(result.triangles, (row, column), (id_ + 1) % len(RANDOM))
            with pytest.raises(InvalidResultError):
                check_delaunay(replace(result, triangles=np.sort(broken, axis=1)))


def star_of(*turns):
    """Return the centre and the points at these angles, in degrees."""
    angles = np.radians(turns)
    return [(0.0, 0.0), *np.column_stack((np.cos(angles), np.sin(angles)))]


BAD_MESHES = {
    "hull is not convex": (
        [(0, 0), (4, 0), (1, 1), (0, 4)],
        [(0, 1, 2), (0, 2, 3)],
        "not convex",
    ),
    "a spike of the hull": (
        [(0, 0), (2, 0), (4, 0), (1, 3), (3, 3)],
        [(0, 1, 3), (1, 2, 4)],
        "ring",
    ),
    "a hole": (
        star_of(0, 60, 120, 180, 240, 300)[1:]
        + [(3 * x, 3 * y) for x, y in star_of(0, 120, 240)[1:]],
        [
            (0, 1, 6),
            (1, 6, 7),
            (1, 2, 7),
            (2, 3, 7),
            (3, 7, 8),
            (3, 4, 8),
            (4, 5, 8),
            (0, 5, 8),
            (0, 6, 8),
        ],
        "ring|Euler|convex|circumcircle",
    ),
    "two triangles apart": (
        [(0, 0), (1, 0), (0, 1), (5, 5), (6, 5), (5, 6)],
        [(0, 1, 2), (3, 4, 5)],
        "one ring",
    ),
    "a triangle twice": ([(0, 0), (1, 0), (0, 1)], [(0, 1, 2), (0, 1, 2)], "ring|folded"),
    "a triangle thrice": ([(0, 0), (1, 0), (0, 1)], [(0, 1, 2)] * 3, "more than two"),
    "twice round its centre": (
        star_of(0, 90, 180, 270, 10, 100, 190, 280),
        [
            (0, 1, 2),
            (0, 2, 3),
            (0, 3, 4),
            (0, 4, 5),
            (0, 5, 6),
            (0, 6, 7),
            (0, 7, 8),
            (0, 8, 1),
        ],
        "one ring|convex",
    ),
    "a flat triangle": ([(0, 0), (1, 0), (2, 0), (0, 2)], [(0, 1, 2), (0, 2, 3)], "flat"),
    "a point is left out": ([(0, 0), (9, 0), (0, 9), (2, 2)], [(0, 1, 2)], "row 3"),
    "no triangle though not on a line": ([(0, 0), (1, 0), (0, 1)], [], "not on one line"),
}


@pytest.mark.parametrize("name", BAD_MESHES)
def test_bad_meshes_are_found(name):
    points, triangles, message = BAD_MESHES[name]
    broken = from_triangles(points, np.reshape(triangles, (-1, 3)))
    with pytest.raises(InvalidResultError, match=message):
        check_delaunay(broken)


def test_rows_out_of_order_or_out_of_range():
    result = delaunay(RANDOM)
    for value, problem in [(-1, "no such point"), (60, "no such point")]:
        broken = replace(result, triangles=edited(result.triangles, (4, 0), value))
        with pytest.raises(InvalidResultError, match=f"triangles: {problem}.*row 4") as caught:
            check_delaunay(broken)
        assert caught.value.rows == (4,)
    swapped = edited(result.triangles, 7, result.triangles[7, [1, 0, 2]])
    with pytest.raises(InvalidResultError, match=r"not ascending \(row 7\)"):
        check_delaunay(replace(result, triangles=swapped))


def test_other_types_and_shapes():
    result = delaunay(RANDOM)
    for name in ("triangles", "neighbors", "representative"):
        array = getattr(result, name)
        for broken in (array.astype(np.int64), array[:-1], array.tolist()):
            with pytest.raises(InvalidResultError):
                check_delaunay(replace(result, **{name: broken}))
    with pytest.raises(InvalidResultError, match=r"points: not finite \(row 3\)"):
        check_delaunay(replace(result, points=edited(RANDOM, (3, 1), np.nan)))
    with pytest.raises(InvalidResultError, match=r"points: .*range"):
        check_delaunay(replace(result, points=edited(RANDOM, (3, 1), 1e300)))
    with pytest.raises(InvalidResultError, match="float64"):
        check_delaunay(replace(result, points=RANDOM.astype(np.float32)))


def test_wrong_representatives():
    result = delaunay(REPEATED)
    twin = len(GRID)
    for row, value, problem in [
        (twin, twin, "lowest"),
        (twin, 1, "other coordinates"),
        (0, twin, "lower"),
        (twin, -1, "lower"),
        (twin + 1, twin, "represent itself"),
    ]:
        broken = edited(result.representative, row, value)
        with pytest.raises(InvalidResultError, match=problem):
            check_delaunay(replace(result, representative=broken))
    duplicate = np.where(result.triangles == 0, twin, result.triangles)
    with pytest.raises(InvalidResultError, match="duplicate"):
        check_delaunay(replace(result, triangles=np.sort(duplicate, axis=1).astype(np.int32)))


def test_wrong_paths():
    result = delaunay(LINE)
    for broken in (
        result.path[1:],
        edited(result.path, 2, [0, 6]),
        edited(result.path, 0, result.path[1]),
    ):
        with pytest.raises(InvalidResultError, match="edges"):
            check_delaunay(replace(result, path=broken))
    with pytest.raises(InvalidResultError, match="path"):
        check_delaunay(replace(delaunay(GRID), path=result.path))


# -------------------------------------------------------- broken filtrations


@pytest.mark.parametrize("points", [RANDOM, GRID, REPEATED])
@pytest.mark.parametrize("dimension", [0, 1, 2])
@pytest.mark.parametrize("factor", [1 + 1e-12, 1 - 1e-12, 0.5, 2.0, np.nan, np.inf])
def test_any_wrong_radius_is_found(points, dimension, factor):
    result = filtration(points)
    for row in range(0, len(result.radii[dimension]), 7):
        value = result.radii[dimension][row]
        radii = list(result.radii)
        radii[dimension] = edited(radii[dimension], row, value * factor if value else factor)
        with pytest.raises(InvalidResultError, match="radii"):
            check_filtration(replace(result, radii=tuple(radii)))


def test_a_radius_an_ulp_off_its_triangle_is_found():
    """Equal values must be equal floats, else a face could come after its coface."""
    result = filtration(RANDOM)
    not_gabriel = np.flatnonzero(np.isin(result.radii[1], result.radii[2]))
    assert len(not_gabriel) > 10
    for row in not_gabriel:
        for way in (0.0, np.inf):
            value = np.nextafter(result.radii[1][row], way)
            radii = (result.radii[0], edited(result.radii[1], row, value), result.radii[2])
            with pytest.raises(InvalidResultError, match=rf"edge radii.*row {row}\b"):
                check_filtration(replace(result, radii=radii))


@pytest.mark.parametrize("height", [1e-6, 1e-9, 1e-15])
def test_radii_of_slivers_are_checked_too(height):
    """Where the check's own floats would be too coarse, it measures in fractions."""
    result = filtration([[0.0, 0.0], [1.0, 0.3], [2.0, 0.6 + height]])
    check_filtration(result)
    for factor in (1 + 3e-14, 1 - 3e-14):
        radii = tuple(
            np.where(values == result.radii[2], values * factor, values)
            for values in result.radii
        )
        with pytest.raises(InvalidResultError, match=r"triangle radii: .*row 0"):
            check_filtration(replace(result, radii=radii))


def test_any_wrong_coface_is_found():
    result = filtration(GRID)
    count = len(result.simplices[2])
    for row in range(len(result.edge_triangles)):
        for column in (0, 1):
            value = (result.edge_triangles[row, column] + 2) % count
            broken = edited(result.edge_triangles, (row, column), value)
            with pytest.raises(InvalidResultError, match=rf"edge_triangles: .*row {row}\b"):
                check_filtration(replace(result, edge_triangles=broken))


def test_any_missing_or_foreign_simplex_is_found():
    result = filtration(RANDOM)
    for dimension in range(3):
        simplices = result.simplices[dimension]
        for row in range(0, len(simplices), 5):
            broken = list(result.simplices)
            broken[dimension] = edited(simplices, row, simplices[row - 1])
            with pytest.raises(InvalidResultError):
                check_filtration(replace(result, simplices=tuple(broken)))


def test_filtrations_of_a_line():
    result = filtration(LINE)
    check_filtration(result)
    cofaces = edited(result.edge_triangles, (0, 0), 0)
    with pytest.raises(InvalidResultError, match="edge_triangles"):
        check_filtration(replace(result, edge_triangles=cofaces))
    with pytest.raises(InvalidResultError, match="one array for each dimension"):
        check_filtration(replace(result, simplices=result.simplices[:2]))
