"""The validators pass every right result in space, and name what is broken in the others."""

from __future__ import annotations

from dataclasses import replace
from itertools import product

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import alphamesh as am
from alphamesh.check import (
    RADIUS_ERROR_IN_SPACE,
    check_delaunay,
    check_filtration,
    check_shape,
)
from alphamesh.errors import InvalidResultError
from strategies3 import FAMILIES

GRID = np.array(list(product(range(4), range(4), range(3))), dtype=float)
RANDOM = np.random.default_rng(0).random((60, 3))
SHEET = np.column_stack([RANDOM[:, :2], np.ones(60)])
LINE = np.arange(7.0)[:, np.newaxis] * [1.0, 2.0, -1.0]


def edited(array, index, value):
    copy = array.copy()
    copy[index] = value
    return copy


def changed(result, k, name, array):
    """Return a filtration with another array of dimension k."""
    arrays = list(getattr(result, name))
    arrays[k] = array
    return replace(result, **{name: tuple(arrays)})


@pytest.mark.parametrize("family", FAMILIES)
@given(data=st.data())
def test_right_results_pass(family, data):
    rng = np.random.default_rng(data.draw(st.integers(0, 2**32 - 1)))
    points = np.asarray(FAMILIES[family](rng, data.draw(st.integers(0, 14))), dtype=float)
    cx = am.AlphaComplex(points.reshape(-1, 3))
    check_filtration(cx.filtration)
    check_delaunay(cx.delaunay)
    radii = [0.0, 1.0, np.inf, *cx.critical_radii()]
    check_shape(cx.at(data.draw(st.sampled_from(radii))))


@pytest.mark.parametrize(
    "points", [GRID, GRID * 0.1, RANDOM, np.concatenate([GRID, GRID[::2]])]
)
def test_larger_right_results_pass(points):
    cx = am.AlphaComplex(points)
    check_filtration(cx.filtration)
    for radius in cx.critical_radii()[::7]:
        check_shape(cx.at(radius))


def drop(rows):
    return rows[:-1]


BROKEN = {
    "a tetrahedron gone": (3, "simplices", drop, "triangles: not those"),
    "a triangle gone": (2, "simplices", drop, "triangles: not those"),
    "an edge gone": (1, "simplices", drop, "edges: not those"),
    "a vertex gone": (0, "simplices", drop, "vertices: not the representatives"),
    "another point": (3, "simplices", lambda r: edited(r, (2, 3), 77), "tetrahedra: no such"),
    "not ascending": (3, "simplices", lambda r: r[:, ::-1].copy(), "not ascending"),
    "a double edge": (1, "simplices", lambda r: edited(r, 0, r[1]), "edges: not those"),
    "wide numbers": (2, "simplices", lambda r: r.astype(np.int64), "not an int32 array"),
    "large tetrahedron": (3, "radii", lambda r: r * (1 + 1e-9), "smallest sphere"),
    "large triangle": (2, "radii", lambda r: edited(r, 0, r.max() * 2), "greater than"),
    "small triangles": (2, "radii", lambda r: r * (1 - 1e-9), "triangle radii"),
    "small edges": (1, "radii", lambda r: r * (1 - 1e-9), "edge radii"),
    "negative": (1, "radii", lambda r: edited(r, 3, -1.0), "not finite or negative (row 3)"),
    "not a number": (
        3,
        "radii",
        lambda r: edited(r, 4, np.nan),
        "not finite or negative (row 4)",
    ),
    "vertices": (0, "radii", lambda r: edited(r, 5, 1e-9), "vertex radii: not zero (row 5)"),
    "single precision": (2, "radii", lambda r: r.astype(np.float32), "not a float64 array"),
}


@pytest.mark.parametrize("name", BROKEN)
def test_names_what_is_broken(name):
    k, field, edit, problem = BROKEN[name]
    found = am.filtration(RANDOM)
    with pytest.raises(InvalidResultError) as caught:
        check_filtration(changed(found, k, field, edit(getattr(found, field)[k])))
    assert problem in str(caught.value)


def test_names_attached_simplices_that_are_taken_for_gabriel():
    found = am.filtration(RANDOM)
    for row, (simplex, value) in enumerate(
        zip(found.simplices[2], found.radii[2], strict=True)
    ):
        lone = float(am.filtration(RANDOM[simplex]).radii[2][0])
        if lone < value * (1 - 1e-6):
            broken = changed(found, 2, "radii", edited(found.radii[2], row, lone))
            with pytest.raises(InvalidResultError, match="triangle radii: not Gabriel"):
                check_filtration(broken)
            return
    pytest.fail("the cloud has no attached triangle")


def test_names_wrong_cofaces_and_neighbours():
    found = am.filtration(RANDOM)
    cofaces = found.triangle_tetrahedra
    with pytest.raises(InvalidResultError, match=r"not the cofaces \(row 7\)"):
        check_filtration(replace(found, triangle_tetrahedra=edited(cofaces, (7, 0), 3)))
    # Either order of two cofaces will do.
    inner = np.flatnonzero(cofaces[:, 1] >= 0)
    check_filtration(
        replace(found, triangle_tetrahedra=edited(cofaces, inner, cofaces[inner, ::-1]))
    )
    neighbors = found.delaunay.neighbors
    with pytest.raises(InvalidResultError, match=r"neighbors: .* \(row 4\)"):
        check_delaunay(replace(found.delaunay, neighbors=edited(neighbors, (4, 1), 0)))


def test_names_triangulations_that_are_not_delaunay():
    """Two of the four corners of a flat pyramid joined the other way round."""
    points = np.array([[0, 0, 0], [3, 0, 0], [3, 2, 0], [0, 2.5, 0], [1, 1, 2.0]])
    right = am.filtration(points)
    check_filtration(right)
    diagonals = [{0, 2}, {1, 3}]
    there = next(d for d in diagonals if any(d <= set(t) for t in right.simplices[3].tolist()))
    ends = next(d for d in diagonals if d != there)
    cells = np.array([sorted({*ends, 4, other}) for other in there], dtype=np.int32)
    wrong = from_cells(points, cells)
    with pytest.raises(InvalidResultError, match="a point inside their circumsphere"):
        check_delaunay(wrong)


def from_cells(points, cells):
    """Return a Delaunay3D of any tetrahedra, two of which share a triangle."""
    triangles = np.unique(
        np.concatenate([np.delete(cells, k, axis=1) for k in range(4)]), axis=0
    )
    edges = np.unique(
        np.concatenate([np.delete(triangles, k, axis=1) for k in range(3)]), axis=0
    )
    neighbors = np.full((2, 4), -1, dtype=np.int32)
    common = set(cells[0]) & set(cells[1])
    for t in (0, 1):
        neighbors[t, [v not in common for v in cells[t]]] = 1 - t
    rows = np.arange(len(points), dtype=np.int32)
    return am.Delaunay3D(points, rows, cells, neighbors, (triangles, edges))


def test_names_clouds_of_another_dimension():
    sheet, line = am.filtration(SHEET), am.filtration(LINE)
    check_filtration(sheet)
    check_filtration(line)
    bent = edited(SHEET, (5, 2), 1 + 1e-12)
    with pytest.raises(InvalidResultError, match="not in one plane"):
        check_filtration(replace(sheet, points=bent))
    with pytest.raises(InvalidResultError, match="not on one line"):
        check_filtration(replace(line, points=edited(LINE, (3, 0), 3.5)))
    with pytest.raises(InvalidResultError, match=r"circumcircle|folded|convex"):
        check_filtration(replace(sheet, points=edited(SHEET, (5, 0), 0.5)))
    for k in (1, 2):
        broken = changed(sheet, k, "radii", sheet.radii[k] * (1 + 10 * RADIUS_ERROR_IN_SPACE))
        with pytest.raises(InvalidResultError, match="radii"):
            check_filtration(broken)


class Loose:
    """A shape whose parts can be changed."""

    def __init__(self, shape, **parts):
        self.shape, self.parts = shape, parts

    def __getattr__(self, name):
        return self.parts[name] if name in self.parts else getattr(self.shape, name)


PARTS = [
    "tetrahedra", "triangles", "edges", "boundary_triangles", "singular_triangles",
    "regular_triangles", "interior_triangles", "singular_edges", "regular_edges",
    "interior_edges", "singular_vertices", "regular_vertices", "interior_vertices",
    "isolated_edges", "isolated_vertices",
]  # fmt: skip


@pytest.fixture(name="shape", scope="module")
def make_shape():
    rng = np.random.default_rng(1)
    cloud = np.concatenate(
        [rng.random((300, 3)), [[5, 5, 5], [5.1, 5, 5], [7, 7, 7], [9, 9, 9]]]
    )
    shape = am.AlphaComplex(cloud).at(0.14)
    assert all(len(getattr(shape, name)) for name in PARTS)
    return shape


@pytest.mark.parametrize("name", PARTS)
def test_names_every_part_of_a_shape_that_is_changed(shape, name):
    from alphamesh.check._space_shape import check_shape3d

    check_shape3d(Loose(shape))
    with pytest.raises(InvalidResultError):
        check_shape3d(Loose(shape, **{name: getattr(shape, name)[1:]}))
    swapped = getattr(shape, name).copy()
    swapped[0] = swapped[1] if swapped.ndim == 1 else swapped[0, ::-1]
    with pytest.raises(InvalidResultError):
        check_shape3d(Loose(shape, **{name: swapped}))


def test_names_wrong_measures_and_counts(shape):
    from alphamesh.check._space_shape import check_shape3d

    for name in ("volume", "surface_area"):
        value = getattr(shape, name) * (1 + 1e-9)
        with pytest.raises(InvalidResultError, match=name.replace("_", " ")):
            check_shape3d(Loose(shape, **{name: value}))
    for name in shape.counts:
        counts = {**shape.counts, name: shape.counts[name] + 1}
        with pytest.raises(InvalidResultError, match=f"counts: .*{name}"):
            check_shape3d(Loose(shape, counts=counts))
    kinds = (*shape.kinds[:2], edited(shape.kinds[2], 9, (shape.kinds[2][9] + 1) % 4))
    with pytest.raises(InvalidResultError, match=r"kinds of triangles: wrong \(row 9\)"):
        check_shape3d(Loose(shape, kinds=(*kinds, shape.kinds[3])))
