"""The invariants of a periodic filtration: every simplex once, and Delaunay, exactly."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from alphamesh._kernels.periodic import periodic_check
from alphamesh._weights import equal_weight
from alphamesh.check._tools import check_table, require
from alphamesh.errors import InvalidResultError
from alphamesh.periodic import as_periods
from alphamesh.periodic._box import box_cloud

if TYPE_CHECKING:
    from alphamesh._arrays import IntArray, KindArray
    from alphamesh.periodic import PeriodicFiltration

__all__ = ["check_periodic"]

_NAMES = ("vertices", "edges", "triangles", "tetrahedra")
# The volumes of cells are rounded; those of one box too many would be twice as much.
_VOLUME_ERROR = 1e-6


def check_periodic(result: PeriodicFiltration) -> None:
    """Prove that `result` is the Delaunay triangulation of its periodic points.

    Each facet lies between two cells, on either side of it, whose far vertices lie outside
    of each other's circumspheres, ties included; both are decided exactly. Cells then cover
    the torus the same number of times everywhere, which is once by their volumes. Values
    are finite and do not decrease from face to coface. Of clouds with fewer dimensions than
    their points, cells are not looked at.

    Parameters
    ----------
    result : PeriodicFiltration

    Raises
    ------
    InvalidResultError
        If an invariant fails; the message and ``rows`` name the rows of the array that
        breaks it.
    """
    d = result.points.shape[1]
    as_periods(result.periods, d)
    if not all(
        len(part) == d + 1
        for part in (result.simplices, result.offsets, result.radii, result.faces)
    ):
        raise InvalidResultError("simplices, offsets, radii: not one array for each dimension")
    for k in range(d + 1):
        _check_layer(result, k)
    if len(result.simplices[0]):
        _check_vertices(result)
        _check_facets(result)
        _check_whole(result)


def _check_layer(result: PeriodicFiltration, k: int) -> None:
    """Check the order of vertices and simplices, their faces and values."""
    rows, offsets = result.simplices[k], result.offsets[k]
    name, d = _NAMES[k], result.points.shape[1]
    check_table(rows, (len(rows), k + 1), name)
    if offsets.shape != (len(rows), k + 1, d) or offsets.dtype != np.int8:
        raise InvalidResultError(f"offsets of {name}: not int8 of {k + 1} vertices each")
    require((np.abs(offsets) <= 1).all(axis=(1, 2)), f"offsets of {name}: beyond -1 to 1")
    require((offsets[:, 0] == 0).all(axis=1), f"offsets of {name}: the first is not zero")
    keys = _keys(rows, offsets)
    for j in range(k):
        require(_less(keys[:, j], keys[:, j + 1]), f"{name}: vertices not in order")
    flat = np.hstack((rows, offsets.reshape(len(rows), (k + 1) * d)))
    require(_less(flat[:-1], flat[1:]), f"{name}: not in order, or one twice")
    radii = result.radii[k]
    if radii.shape != (len(rows),) or not np.isfinite(radii).all():
        raise InvalidResultError(f"radii of {name}: not finite numbers")
    if k == 0:
        return
    check_table(result.faces[k], rows.shape, f"faces of {name}")
    for j in range(k + 1):
        face = result.faces[k][:, j]
        kept = np.delete(keys, j, axis=1)
        kept[:, :, 1:] -= kept[:, :1, 1:]
        below = _keys(result.simplices[k - 1], result.offsets[k - 1])
        require((kept == below[face]).all(axis=(1, 2)), f"faces of {name}: not those")
        require(result.radii[k - 1][face] <= radii, f"radii of {name}: below those of faces")


def _keys(rows: IntArray, offsets: KindArray) -> Any:
    """Return row and offsets of each vertex side by side."""
    return np.concatenate((rows[:, :, None], offsets), axis=2).astype(np.int32)


def _less(a: Any, b: Any) -> Any:
    """Return whether rows of one table come before those of another, lexicographically."""
    differs = a != b
    first = differs.argmax(axis=1)
    at = np.arange(len(a))
    return differs.any(axis=1) & (a[at, first] < b[at, first])


def _check_vertices(result: PeriodicFiltration) -> None:
    rows = np.arange(len(result.points))
    visible = result.representative == rows
    visible[result.hidden] = False
    same = np.array_equal(result.simplices[0][:, 0], np.flatnonzero(visible))
    if not same:
        raise InvalidResultError("vertices: not the rows that stand for themselves")


def _check_facets(result: PeriodicFiltration) -> None:
    d = result.dimension
    cells = result.facet_cells
    if d < result.points.shape[1]:
        return  # nothing is said of facets there
    check_table(cells, (len(result.simplices[d - 1]), 2), "facet_cells")
    found = np.bincount(result.faces[d].ravel(), minlength=len(cells))
    require(found == (cells >= 0).sum(axis=1), "facet_cells: not those")
    if result.periodic.all():
        require(found == 2, "facet_cells: a facet of a torus with one cell")
    # Equal weights change no simplex, and need not be in the range of exact arithmetic.
    weights = result.weights
    if weights is not None and equal_weight(weights) is not None:
        weights = None
    box = box_cloud(result.points, result.periods, weights)
    offsets = np.zeros((*result.simplices[d].shape, 3), dtype=np.int8)
    offsets[:, :, : result.points.shape[1]] = result.offsets[d]
    verdict = periodic_check(
        result.simplices[d],
        offsets,
        result.faces[d],
        cells,
        box.anchors,
        box.shifts,
        box.weights,
        box.periods,
    )
    require(verdict != 1, "facets: of a flat cell")
    require(verdict != 2, "facets: both cells on the same side")
    require(verdict != 3, "facets: not locally Delaunay")


def _check_whole(result: PeriodicFiltration) -> None:
    """Check what holds for the torus as a whole."""
    if not result.periodic.all():
        return
    volume = float(result.cell_sizes.sum())
    if not abs(volume - result.box_size) <= _VOLUME_ERROR * result.box_size:
        raise InvalidResultError(f"cells of size {volume} in a box of {result.box_size}")
    euler = sum((-1) ** k * len(rows) for k, rows in enumerate(result.simplices))
    if euler != 0:
        raise InvalidResultError(f"the Euler characteristic of a torus is 0, not {euler}")
