"""The invariants of an alpha shape in space, counted from its tetrahedra."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from alphamesh._kernels.space import orient3
from alphamesh.check._mesh import unit_points
from alphamesh.check._space_mesh import faces, order_of_rows
from alphamesh.check._tools import LongArray, check_table, require, signs
from alphamesh.errors import InvalidResultError

if TYPE_CHECKING:
    from alphamesh._arrays import BoolArray, FloatArray, IntArray, KindArray
    from alphamesh.shape3d import AlphaShape3D

__all__ = ["check_shape3d"]

_NAMES = ("vertices", "edges", "triangles", "tetrahedra")
_KINDS = ("exterior", "singular", "regular", "interior")
# Relative error of a volume or an area that sums many rounded ones.
_MEASURE_ERROR = 1e-12


def check_shape3d(shape: AlphaShape3D) -> None:
    """Prove a shape in space; see :func:`alphamesh.check.check_shape`."""
    _check_tetrahedra(shape)
    boundary = _check_boundary(shape)
    for k in (2, 1, 0):
        _check_kinds(shape, k, boundary)
    _check_isolated(shape)
    _check_counts(shape)
    _check_measures(shape)


def _check_tetrahedra(shape: AlphaShape3D) -> None:
    """Check that all tetrahedra up to the radius are there, positively oriented."""
    expected = shape.filtration.simplices[3][shape.filtration.radii[3] <= shape.radius]
    check_table(shape.tetrahedra, expected.shape, "tetrahedra")
    same = (np.sort(shape.tetrahedra, axis=1) == expected).all(axis=1)
    require(same, "tetrahedra: not those of the filtration up to the radius")
    require(
        shape.tetrahedra[:, 0] == expected[:, 0], "tetrahedra: not from their lowest row on"
    )
    points, _ = unit_points(shape.points)
    turns = signs(orient3, points, shape.tetrahedra)
    require(turns > 0, "tetrahedra: not positively oriented")


def _check_boundary(shape: AlphaShape3D) -> IntArray:
    """Check that the boundary is closed and faces outwards; return its triangles, ascending."""
    # Outward facets of positively oriented tetrahedra; inner ones cancel.
    outward = shape.tetrahedra[:, [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]]].reshape(-1, 3)
    ascending = np.sort(outward, axis=1)
    order = order_of_rows(ascending)
    same = np.flatnonzero((ascending[order[1:]] == ascending[order[:-1]]).all(axis=1))
    once = np.ones(len(order), dtype=bool)
    once[order[same]] = once[order[same + 1]] = False
    check_table(shape.boundary_triangles, (int(once.sum()), 3), "boundary triangles")
    found = np.sort(shape.boundary_triangles, axis=1)
    require((found[:, 0] == shape.boundary_triangles[:, 0]), "boundary triangles: not turned")
    mine, theirs = order_of_rows(found), order_of_rows(ascending[once])
    require(
        (shape.boundary_triangles[mine] == _from_lowest(outward[once][theirs])).all(axis=1),
        "boundary triangles: not the facets of one tetrahedron, as seen from outside",
        mine,
    )
    start = shape.boundary_triangles.astype(np.int64)
    end = shape.boundary_triangles[:, [1, 2, 0]]
    forward, back = (
        np.sort((start << 32 | end).ravel()),
        np.sort((end.astype(np.int64) << 32 | start).ravel()),
    )
    if not np.array_equal(forward, back):
        raise InvalidResultError("boundary triangles: not closed")
    return found


def _from_lowest(triangles: IntArray) -> IntArray:
    """Return triangles turned to begin with their lowest row, as oriented as before."""
    first = triangles.argmin(axis=1)[:, np.newaxis]
    return np.take_along_axis(triangles, (first + np.arange(3)) % 3, axis=1)


def _check_kinds(shape: AlphaShape3D, k: int, boundary: IntArray) -> None:
    """Check which vertices, edges or triangles are singular, regular and interior."""
    rows, name = shape.filtration.simplices[k], _NAMES[k]
    there = shape.filtration.radii[k] <= shape.radius
    in_cell = _among(rows, _faces_of_size(shape.tetrahedra, k + 1))
    on_border = _among(rows, _faces_of_size(boundary, k + 1))
    if (in_cell & ~there).any():
        raise InvalidResultError(f"tetrahedra: a face of them is not in the complex ({name})")
    expected = np.zeros(len(rows), dtype=np.int8)
    expected[there], expected[in_cell], expected[on_border] = 1, 3, 2
    kinds: KindArray = shape.kinds[k]
    if kinds.shape != expected.shape:
        raise InvalidResultError(f"kinds: not one for each of the {name}")
    require(kinds == expected, f"kinds of {name}: wrong")
    for number, kind in enumerate(_KINDS[1:], 1):
        found = np.asarray(getattr(shape, f"{kind}_{name}")).reshape(-1, k + 1)
        if not np.array_equal(found, rows[expected == number]):
            raise InvalidResultError(f"{kind} {name}: not those of that kind")
    if k and not np.array_equal(getattr(shape, name), rows[there]):
        raise InvalidResultError(f"{name}: not those of the filtration up to the radius")


def _faces_of_size(simplices: IntArray, size: int) -> IntArray:
    rows = np.sort(simplices, axis=1)
    while rows.shape[1] > size:
        rows = faces(rows)
    return rows


def _among(rows: IntArray, others: IntArray) -> BoolArray:
    """Return which rows are among the others."""
    together = np.concatenate((rows, others))
    order = order_of_rows(together)
    new = np.append(True, (together[order[1:]] != together[order[:-1]]).any(axis=1))
    group: LongArray = np.empty(len(together), dtype=np.int64)
    group[order] = np.cumsum(new[: len(order)])
    there = np.zeros(len(together) + 2, dtype=bool)
    there[group[len(rows) :]] = True
    return there[group[: len(rows)]]


def _check_isolated(shape: AlphaShape3D) -> None:
    """Check which vertices have no edge, and which edges no triangle."""
    for k, found in ((0, shape.isolated_vertices.reshape(-1, 1)), (1, shape.isolated_edges)):
        rows, radii = shape.filtration.simplices[k], shape.filtration.radii[k]
        above = shape.edges if k == 0 else shape.triangles
        alone = (radii <= shape.radius) & ~_among(rows, faces(above))
        if not np.array_equal(found, rows[alone]):
            raise InvalidResultError(f"isolated {_NAMES[k]}: not those without a coface")


def _check_counts(shape: AlphaShape3D) -> None:
    vertices = int(np.count_nonzero(shape.filtration.radii[0] <= shape.radius))
    wrong = [
        name
        for name, count in shape.counts.items()
        if count != (vertices if name == "vertices" else len(getattr(shape, name)))
    ]
    if wrong:
        raise InvalidResultError(f"counts: not the lengths of {', '.join(wrong)}")


def _check_measures(shape: AlphaShape3D) -> None:
    """Check volume and surface area, up to rounding: the volume by its boundary."""
    points, exponent = unit_points(shape.points)
    corners = points[shape.boundary_triangles]
    u, v = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    areas = np.sqrt((np.cross(u, v) ** 2).sum(axis=1)) / 2
    doubt = _MEASURE_ERROR * (np.abs(u).max(axis=1) * np.abs(v).max(axis=1)).sum()
    _require_close(shape.surface_area, areas, doubt, 2 * exponent, "surface area")
    corners -= corners.reshape(-1, 3).mean(axis=0) if len(corners) else 0.0
    a, b, c = (corners[:, k] for k in range(3))
    volumes = (np.cross(a, b) * c).sum(axis=1) / 6
    doubt = _MEASURE_ERROR * np.prod(np.abs(corners).max(axis=2), axis=1).sum()
    _require_close(shape.volume, volumes, doubt, 3 * exponent, "volume")


def _require_close(
    value: float, parts: FloatArray, doubt: float, exponent: int, name: str
) -> None:
    """Raise unless `value` is near the sum of the parts, in units of ``2**exponent``."""
    total = parts.sum()
    with np.errstate(all="ignore"):
        low, middle, high = np.ldexp([total - doubt, total, total + doubt], exponent)
    step = len(parts) * 5e-324  # among subnormal numbers each part may have been rounded
    if not low - step <= value <= high + step:
        raise InvalidResultError(f"{name}: {value}, but the parts sum up to {middle}")
