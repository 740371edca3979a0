"""The invariants of a surface: closed, oriented, manifold, and the boundary of its shape."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from alphamesh._kernels.space import orient3
from alphamesh.check._mesh import unit_points
from alphamesh.check._tools import LongArray, check_table, require, signs
from alphamesh.errors import InvalidResultError
from alphamesh.manifold import fan_of_corners
from alphamesh.shells import shell_measures

if TYPE_CHECKING:
    from alphamesh.simplices3d import SimplexSet3D
    from alphamesh.surface import Surface

# Relative error of an area or a volume that sums many rounded ones.
_MEASURE_ERROR = 1e-9


def check_surface(result: Surface, shape: SimplexSet3D | None = None) -> None:
    """Prove that `result` is a closed, oriented surface, and the boundary of `shape`.

    Parameters
    ----------
    result : Surface
        Once split, every edge must have exactly two triangles, in opposite directions,
        and the triangles at each vertex must form one fan; else every edge as many in
        one direction as in the other.
    shape : AlphaShape3D or Selection3D, optional
        Whose boundary it must be, whole or in part; all triangles must have the shape
        behind them: exact.

    Raises
    ------
    InvalidResultError
        If an invariant fails; the message and ``rows`` name the rows of the array that
        breaks it.
    """
    count = len(result.triangles)
    check_table(result.triangles, (count, 3), "triangles")
    check_table(result.source_rows, (len(result.points),), "source_rows")
    check_table(result.facets, (count,), "facets")
    check_table(result.shell_labels, (count,), "shell_labels")
    _check_vertices(result)
    start, end = _sides(result)
    _check_edges(result, start, end)
    if result.is_split:
        _check_sheets(result, start, end)
    _check_measures(result)
    if shape is not None:
        _check_boundary(result, shape)


def _check_vertices(surface: Surface) -> None:
    """Check that every vertex is used, and that no triangle uses one twice."""
    triangles, count = surface.triangles, len(surface.points)
    there = (triangles >= 0) & (triangles < count)
    require(there.all(axis=1), "triangles: no such vertex")
    used = np.zeros(count, dtype=bool)
    used[triangles] = True
    require(used, "points: in no triangle")
    corners = np.sort(triangles, axis=1)
    require((np.diff(corners, axis=1) > 0).all(axis=1), "triangles: a corner comes twice")
    require(np.append(True, np.diff(surface.source_rows) >= 0)[:count], "source_rows: order")


def _sides(surface: Surface) -> tuple[LongArray, LongArray]:
    """Return where the sides begin and end: of triangle t, those of 3t, 3t + 1, 3t + 2."""
    triangles = surface.triangles.astype(np.int64)
    return triangles[:, [1, 2, 0]].ravel(), triangles[:, [2, 0, 1]].ravel()


def _check_edges(surface: Surface, start: LongArray, end: LongArray) -> None:
    """Check that each edge is run along both ways, once each if the surface is split."""
    forward, backward = (start << 32) | end, (end << 32) | start
    keys, which, counts = np.unique(forward, return_inverse=True, return_counts=True)
    found = np.searchsorted(keys, backward)
    there = np.append(keys, -1)[found] == backward
    owner = np.arange(len(start)) // 3
    require(there, "triangles: an edge that no other one runs along the other way", owner)
    same = counts[which] == counts[found]
    require(same, "triangles: an edge run along more often one way than the other", owner)
    if surface.is_split:
        require(counts[which] == 1, "triangles: an edge in more than two of them", owner)


def _check_sheets(surface: Surface, start: LongArray, end: LongArray) -> None:
    """Check that each vertex has one fan, and each shell is connected."""
    fans = fan_of_corners(surface.triangles)
    vertices = surface.triangles.ravel()
    first = np.full(len(surface.points), -1, dtype=np.int64)
    first[vertices] = fans
    require(first[vertices] == fans, "points: with several fans of triangles", vertices)
    order = np.argsort((start << 32) | end)
    back = np.argsort((end << 32) | start)
    across = np.empty_like(order)
    across[order] = back
    owner = np.arange(len(start)) // 3
    labels = surface.shell_labels
    require(labels[owner] == labels[across // 3], "shell_labels: change at an edge", owner)
    pieces = _piece_count(surface)
    if pieces != len(surface.shells):
        raise InvalidResultError(f"shells: {len(surface.shells)}, but {pieces} pieces")


def _piece_count(surface: Surface) -> int:
    """Return the number of connected pieces, by spreading the least vertex number."""
    label = np.arange(len(surface.points))
    triangles = surface.triangles
    while True:
        least = label.take(triangles).min(axis=1)
        spread = label.copy()
        for corner in range(3):
            np.minimum.at(spread, triangles[:, corner], least)
            np.minimum.at(spread, label.take(triangles[:, corner]), least)
        spread = spread.take(spread)  # and jump ahead
        if np.array_equal(spread, label):
            return len(np.unique(label))
        label = spread


def _check_measures(surface: Surface) -> None:
    """Check the counts and sums of each shell."""
    shells, labels, count = surface.shells, surface.shell_labels, len(surface.shells)
    triangles = np.bincount(labels, minlength=count)
    require(shells.triangle_counts == triangles, "shells: triangle_counts")
    areas, volumes = shell_measures(surface.points, surface.triangles, labels, count)
    slack = _MEASURE_ERROR * areas
    require(np.abs(areas - shells.areas) <= slack, "shells: areas")
    require(np.abs(volumes - shells.volumes) <= slack * np.sqrt(areas), "shells: volumes")
    require(shells.euler_characteristics % 2 == 0, "shells: an odd Euler characteristic")
    if surface.is_split:
        of_vertex = np.zeros(len(surface.points), dtype=np.int32)
        of_vertex[surface.triangles] = labels[:, np.newaxis]
        euler = np.bincount(of_vertex, minlength=count) - triangles // 2
        require(shells.euler_characteristics == euler, "shells: euler_characteristics")


def _check_boundary(surface: Surface, shape: SimplexSet3D) -> None:
    """Check that each triangle has the shape behind it and nothing of it before it."""
    filtration = shape.filtration
    inside = np.zeros(len(filtration.simplices[3]) + 1, dtype=bool)
    inside[:-1] = shape._has_tetrahedron  # the last entry is that of -1, no tetrahedron
    both = filtration.triangle_tetrahedra[surface.facets]
    require(inside[both].sum(axis=1) == 1, "facets: not between inside and outside")
    rows = surface.source_rows[surface.triangles]
    expected = filtration.simplices[2][surface.facets]
    same = (np.sort(rows, axis=1) == expected).all(axis=1)
    require(same, "triangles: corners that are not those of their facets")
    behind = np.where(inside[both[:, 0]], both[:, 0], both[:, 1])
    apex = filtration.simplices[3][behind].sum(axis=1) - expected.sum(axis=1)
    points, _ = unit_points(filtration.points)
    turns = signs(orient3, points, np.column_stack((rows, apex)))
    require(turns < 0, "triangles: not counter-clockwise seen from outside")
    same = (surface.points == filtration.points[surface.source_rows]).all(axis=1)
    require(same, "points: other coordinates than those of source_rows")
