"""A mesh as the file formats see it: points, cells of each kind, and numbers on both."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from alphamesh.errors import ParameterError, rows_text

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = [
    "CELL_CORNERS",
    "CELL_NAMES",
    "INT32_END",
    "DoesNotFit",
    "Mesh",
    "compact",
    "points_in_space",
    "refuse_large",
    "rows_of",
    "with_input_rows",
]

Numbers: TypeAlias = "NDArray[Any]"

CELL_CORNERS = {"vertex": 1, "line": 2, "triangle": 3, "tetra": 4}
"""The kinds of cells, in the order of files, and how many vertices each has."""

CELL_NAMES = {
    "vertex": "vertices",
    "line": "edges",
    "triangle": "triangles",
    "tetra": "tetrahedra",
}
"""What alphamesh calls them, in files that take names."""

INT32_END = 2**31


class DoesNotFit(Exception):  # noqa: N818 - a verdict on a mesh; users never see it
    """A mesh that a format cannot hold; the message says why, and what to do."""


@dataclass(frozen=True, eq=False)
class Mesh:
    """Points, the cells between them, and numbers given to points and cells.

    The arrays are checked and kept as read-only views; they are not copied where their
    types fit.

    Attributes
    ----------
    points : (n, 2) or (n, 3) float64 array
        Coordinates, all finite.
    cells : mapping of str to (m, k) int32 array
        Rows of `points`, under ``"vertex"`` (k = 1; ``(m,)`` is taken too), ``"line"``
        (k = 2), ``"triangle"`` (k = 3, counter-clockwise where the points are
        two-dimensional) and ``"tetra"`` (k = 4). Kinds without a cell may be left out.
    point_data : mapping of str to (n,) array
        Numbers per point. Names are ASCII without blanks, quotes and ``<>&``.
    cell_data : mapping of str to mapping of str to (m,) array
        Numbers per cell: by name, then by kind of cell. Each name needs numbers for
        every kind that has cells.

    Raises
    ------
    ParameterError
        If an array has a wrong shape or type, a cell names a missing point, or numbers
        are missing.
    """

    points: NDArray[np.float64]
    cells: Mapping[str, NDArray[np.integer[Any]]] = field(default_factory=dict)
    point_data: Mapping[str, Numbers] = field(default_factory=dict)
    cell_data: Mapping[str, Mapping[str, Numbers]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        points = _checked_points(self.points)
        cells = {
            kind: _checked_cells(kind, rows, len(points)) for kind, rows in self.cells.items()
        }
        cells = {kind: cells[kind] for kind in CELL_CORNERS if kind in cells}
        point_data = {
            name: _checked_numbers(f"point_data[{name!r}]", name, values, len(points))
            for name, values in self.point_data.items()
        }
        cell_data = {
            name: _checked_cell_data(name, by_kind, cells)
            for name, by_kind in self.cell_data.items()
        }
        object.__setattr__(self, "points", points)
        object.__setattr__(self, "cells", cells)
        object.__setattr__(self, "point_data", point_data)
        object.__setattr__(self, "cell_data", cell_data)

    def __repr__(self) -> str:
        counts = ", ".join(f"{len(rows)} {kind}" for kind, rows in self.cells.items())
        return f"Mesh({len(self.points)} points; cells: {counts or 'none'})"

    def only(self, kinds: tuple[str, ...]) -> Mesh:
        """Return the mesh with the cells of these kinds alone, and all points."""
        cells = {kind: rows for kind, rows in self.cells.items() if kind in kinds}
        cell_data = {
            name: {kind: by_kind[kind] for kind in by_kind if kind in cells}
            for name, by_kind in self.cell_data.items()
        }
        return Mesh(self.points, cells, self.point_data, cell_data)


def compact(mesh: Mesh) -> Mesh:
    """Return the mesh without the points that no cell uses.

    Parameters
    ----------
    mesh : Mesh

    Returns
    -------
    Mesh
        The same cells over the points in use, which keep their order. The numbers
        ``"input_row"`` of its points tell where each came from: its row in
        ``mesh.points``, or its number there if `mesh` has ``"input_row"`` already.
    """
    used = np.zeros(len(mesh.points), dtype=bool)
    for rows in mesh.cells.values():
        used[rows] = True
    kept = np.flatnonzero(used)
    renumbered = np.zeros(len(mesh.points), dtype=np.int64)
    renumbered[kept] = np.arange(len(kept))
    return Mesh(
        mesh.points[kept],
        {kind: renumbered[rows] for kind, rows in mesh.cells.items()},
        {name: data[kept] for name, data in with_input_rows(mesh).point_data.items()},
        mesh.cell_data,
    )


def with_input_rows(mesh: Mesh) -> Mesh:
    """Return the mesh with the point numbers ``"input_row"``, unless it has them."""
    if "input_row" in mesh.point_data:
        return mesh
    count = len(mesh.points)
    rows = np.arange(count, dtype=np.int32 if count < INT32_END else np.int64)
    return Mesh(mesh.points, mesh.cells, {"input_row": rows, **mesh.point_data}, mesh.cell_data)


def points_in_space(mesh: Mesh) -> NDArray[np.float64]:
    """Return the points as an ``(n, 3)`` array: z is 0 where they are two-dimensional."""
    if mesh.points.shape[1] == 3:
        return mesh.points
    return np.column_stack([mesh.points, np.zeros(len(mesh.points))])


def rows_of(mesh: Mesh, kind: str) -> NDArray[np.integer[Any]]:
    """Return the cells of one kind, an empty array if there are none."""
    return mesh.cells.get(kind, np.empty((0, CELL_CORNERS[kind]), dtype=np.int32))


def refuse_large(mesh: Mesh, name: str) -> None:
    """Make sure that 32 bits can number the points."""
    if len(mesh.points) >= INT32_END:
        raise DoesNotFit(f"{name} files number points in 32 bits; choose .vtu or .npz")


def _read_only(array: Numbers) -> Numbers:
    view = np.ascontiguousarray(array).view()
    view.flags.writeable = False
    return view


def _checked_points(points: Any) -> NDArray[np.float64]:
    given = np.asarray(points)
    if given.ndim != 2 or given.shape[1] not in (2, 3) or given.dtype.kind not in "biuf":
        raise ParameterError(
            "points must be an (n, 2) or (n, 3) array of real numbers; "
            f"got shape {given.shape} of {given.dtype}"
        )
    given = given.astype(np.float64, copy=False)
    wrong = np.flatnonzero(~np.isfinite(given).all(axis=1))
    if wrong.size:
        raise ParameterError(
            f"points must be finite: {rows_text(wrong[:9], total=wrong.size)} are not; "
            "leave these points out",
            rows=wrong[:9],
        )
    return _read_only(given)


def _checked_cells(kind: str, rows: Any, n_points: int) -> NDArray[np.integer[Any]]:
    if kind not in CELL_CORNERS:
        raise ParameterError(
            f"no cells are called {kind!r}; there are {', '.join(CELL_CORNERS)}"
        )
    corners = CELL_CORNERS[kind]
    given = np.asarray(rows)
    if given.size == 0:
        given = np.empty((0, corners), dtype=np.int32)
    elif kind == "vertex" and given.ndim == 1:
        given = given[:, np.newaxis]
    if given.ndim != 2 or given.shape[1] != corners or given.dtype.kind not in "iu":
        raise ParameterError(
            f"cells[{kind!r}] must be an (m, {corners}) array of row numbers; "
            f"got shape {given.shape} of {given.dtype}"
        )
    if given.size and (given.min() < 0 or given.max() >= n_points):
        wrong = np.flatnonzero(((given < 0) | (given >= n_points)).any(axis=1))
        raise ParameterError(
            f"cells[{kind!r}]: {rows_text(wrong[:9], total=wrong.size)} name points outside "
            f"of 0 ... {n_points - 1}; count the points from 0",
            rows=wrong[:9],
        )
    # One type for all kinds, or writers that join them end up with something wider.
    return _read_only(given.astype(np.int32 if n_points < INT32_END else np.int64, copy=False))


def _checked_numbers(where: str, name: str, values: Any, count: int) -> Numbers:
    better = re.sub(r"[^!-~]+|[\"'<>&]+", "_", name) or "values"
    if better != name:
        raise ParameterError(
            f"the name {name!r} does not fit all files; rename it to {better!r}"
        )
    given = np.asarray(values)
    if given.shape != (count,) or given.dtype.kind not in "biuf":
        raise ParameterError(
            f"{where} must be {count} real numbers, one each; "
            f"got shape {given.shape} of {given.dtype}"
        )
    return _read_only(given)


def _checked_cell_data(
    name: str, by_kind: Mapping[str, Any], cells: Mapping[str, Numbers]
) -> dict[str, Numbers]:
    missing = [kind for kind, rows in cells.items() if len(rows) and kind not in by_kind]
    extra = [kind for kind in by_kind if kind not in cells]
    if missing or extra:
        raise ParameterError(
            f"cell_data[{name!r}] must have numbers for {', '.join(cells) or 'no cells'}; "
            f"got them for {', '.join(by_kind) or 'none'}"
        )
    return {
        kind: _checked_numbers(f"cell_data[{name!r}][{kind!r}]", name, values, len(cells[kind]))
        for kind, values in by_kind.items()
    }
