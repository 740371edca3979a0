"""The invariants of an alpha shape, counted from its triangles and its filtration."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from alphamesh._kernels import orient2
from alphamesh.check._mesh import unit_points
from alphamesh.check._space_shape import check_shape3d
from alphamesh.check._tools import (
    LongArray,
    check_table,
    edge_keys,
    find_sorted,
    require,
    signs,
)
from alphamesh.errors import InvalidResultError
from alphamesh.shape3d import AlphaShape3D

if TYPE_CHECKING:
    from alphamesh._arrays import BoolArray, IntArray
    from alphamesh.shape import AlphaShape

# Relative error of an area or a length that sums many rounded ones.
_MEASURE_ERROR = 1e-12


def check_shape(result: AlphaShape | AlphaShape3D) -> None:
    """Prove that `result` is the alpha complex of its filtration at its radius.

    The filtration itself is taken to be right; :func:`check_filtration` proves that.

    Parameters
    ----------
    result : AlphaShape or AlphaShape3D

    Raises
    ------
    InvalidResultError
        If an invariant fails; the message and ``rows`` name the rows of the array that
        breaks it.
    """
    if isinstance(result, AlphaShape3D):
        check_shape3d(result)
        return
    _check_triangles(result)
    uses = _check_edges(result)
    _check_boundary(result)
    _check_vertices(result)
    _check_counts(result, uses)
    _check_measures(result)


def _check_triangles(shape: AlphaShape) -> None:
    """Check that all triangles up to the radius are there, counter-clockwise."""
    expected = shape.filtration.simplices[2][shape.filtration.radii[2] <= shape.radius]
    check_table(shape.triangles, (len(shape.triangles), 3), "triangles")
    problem = "triangles: not those of the filtration up to the radius"
    _require_rows(np.sort(shape.triangles, axis=1), expected, problem)
    require(shape.triangles[:, 0] == expected[:, 0], "triangles: not from their lowest row on")
    points, _ = unit_points(shape.points)
    turns = signs(orient2, points, shape.triangles)
    require(turns > 0, "triangles: not counter-clockwise")


def _check_edges(shape: AlphaShape) -> LongArray:
    """Check the edges and their kinds; return how many triangles each belongs to."""
    expected = shape.filtration.simplices[1][shape.filtration.radii[1] <= shape.radius]
    _require_rows(shape.edges, expected, "edges: not those of the filtration up to the radius")
    keys = edge_keys(shape.edges)
    order = np.argsort(keys)
    sides = edge_keys(np.sort(_directed(shape), axis=1))
    used, counts = np.unique(sides, return_counts=True)
    where, there = find_sorted(keys[order], used)
    if not there.all():
        owner = np.arange(len(sides)) // 3
        problem = "triangles: an edge of them is not in the complex"
        require(find_sorted(keys[order], sides)[1], problem, owner)
    uses = np.zeros(len(keys), dtype=np.int64)
    uses[order[where]] = counts
    kinds = (shape.singular_edges, shape.regular_edges, shape.interior_edges)
    for count, name in enumerate(("singular", "regular", "interior")):
        problem = f"{name} edges: not those in {count} triangles"
        _require_rows(kinds[count], shape.edges[uses == count], problem)
    return uses


def _check_boundary(shape: AlphaShape) -> None:
    """Check that the boundary is the regular edges, closed, the shape on their left."""
    boundary = shape.boundary_edges
    check_table(boundary, (len(boundary), 2), "boundary edges")
    problem = "boundary edges: not the regular edges"
    _require_rows(np.sort(boundary, axis=1), shape.regular_edges, problem)
    _, on_left = find_sorted(np.sort(edge_keys(_directed(shape))), edge_keys(boundary))
    require(on_left, "boundary edges: the shape is not on their left")
    balance = _degrees(shape, boundary[:, 0]) - _degrees(shape, boundary[:, 1])
    require(balance == 0, "boundary edges: not closed at these points")


def _check_vertices(shape: AlphaShape) -> None:
    """Check which vertices are isolated, singular, regular and interior."""
    vertices = shape.filtration.simplices[0][:, 0]
    there = shape.filtration.radii[0] <= shape.radius
    on_edge = _marked(shape, shape.edges)[vertices]
    in_triangle = _marked(shape, shape.triangles)[vertices]
    on_boundary = _marked(shape, shape.boundary_edges)[vertices]
    kinds = {
        "isolated": (shape.isolated_vertices, there & ~on_edge),
        "singular": (shape.singular_vertices, there & ~in_triangle),
        "regular": (shape.regular_vertices, on_boundary),
        "interior": (shape.interior_vertices, in_triangle & ~on_boundary),
    }
    for name, (found, expected) in kinds.items():
        _require_rows(found, vertices[expected], f"{name} vertices: not those of that kind")


def _check_counts(shape: AlphaShape, uses: LongArray) -> None:
    expected = {
        "vertices": int(np.count_nonzero(shape.filtration.radii[0] <= shape.radius)),
        "edges": len(shape.edges),
        "triangles": len(shape.triangles),
        "singular_edges": int(np.count_nonzero(uses == 0)),
        "regular_edges": int(np.count_nonzero(uses == 1)),
        "interior_edges": int(np.count_nonzero(uses == 2)),
        "isolated_vertices": len(shape.isolated_vertices),
    }
    wrong = [name for name, count in expected.items() if shape.counts.get(name) != count]
    if wrong:
        raise InvalidResultError(f"counts: not the lengths of {', '.join(wrong)}")


def _check_measures(shape: AlphaShape) -> None:
    """Check area and perimeter, up to rounding."""
    points, exponent = unit_points(shape.points)
    a, b, c = (points[shape.triangles[:, k]] for k in range(3))
    u, v = b - a, c - a
    left, right = u[:, 0] * v[:, 1], u[:, 1] * v[:, 0]
    doubt = _MEASURE_ERROR * float((np.abs(left) + np.abs(right)).sum())
    steps = points[shape.boundary_edges[:, 1]] - points[shape.boundary_edges[:, 0]]
    length = float(np.hypot(steps[:, 0], steps[:, 1]).sum())
    area = float((left - right).sum()) / 2
    _require_close(shape.area, (area, doubt), 2 * exponent, len(u), "area")
    doubt = _MEASURE_ERROR * length
    _require_close(shape.perimeter, (length, doubt), exponent, len(steps), "perimeter")


def _require_close(
    value: float, expected: tuple[float, float], exponent: int, count: int, name: str
) -> None:
    """Raise unless `value` is near the sum of `count` parts.

    The sum and its doubt come in units of ``2**exponent``, in which either may leave the
    range of floats; among subnormal numbers each part may have been rounded by a step.
    """
    middle, doubt = expected
    with np.errstate(all="ignore"):
        low, total, high = np.ldexp([middle - doubt, middle, middle + doubt], exponent)
    step = count * 5e-324
    if not low - step <= value <= high + step:
        raise InvalidResultError(f"{name}: {value}, but the parts sum up to {total}")


# ---------------------------------------------------------------------- parts


def _directed(shape: AlphaShape) -> IntArray:
    """Return the directed edges of the triangles, three a row."""
    edges: IntArray = shape.triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
    return edges


def _marked(shape: AlphaShape, ids: IntArray) -> BoolArray:
    marks = np.zeros(len(shape.points), dtype=bool)
    marks[ids] = True
    return marks


def _degrees(shape: AlphaShape, ids: IntArray) -> LongArray:
    return np.bincount(ids, minlength=len(shape.points))


def _require_rows(found: IntArray, expected: IntArray, problem: str) -> None:
    if len(found) != len(expected):
        raise InvalidResultError(f"{problem} ({len(found)} rows in place of {len(expected)})")
    check_table(found, expected.shape, problem)
    different = found != expected
    require(~(different.any(axis=1) if different.ndim == 2 else different), problem)
