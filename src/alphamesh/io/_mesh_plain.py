"""Mesh files written and read with NumPy alone: PLY, OBJ, OFF, STL and NPZ.

meshio has these formats too, but its OBJ and OFF lines are made one by one (five times
slower), its PLY turns edges into faces of two corners, which other programs refuse, its STL
divides by the length of zero normals, and PLY and OBJ carry the time of day, so that no two
files of one mesh are equal.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any, BinaryIO

import numpy as np

from alphamesh.errors import FileReadError
from alphamesh.io._mesh import (
    CELL_CORNERS,
    CELL_NAMES,
    INT32_END,
    DoesNotFit,
    Mesh,
    points_in_space,
    refuse_large,
    rows_of,
)

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = [
    "read_npz",
    "stl_corners",
    "write_npz",
    "write_obj",
    "write_off",
    "write_ply",
    "write_stl",
]

_LINES_AT_ONCE = 1 << 15


def write_obj(mesh: Mesh, path: Path) -> None:
    """Write vertices (``v``) and faces (``f``), edges (``l``) and single vertices (``p``)."""
    with path.open("wb") as file:
        _write_points(file, "v ", mesh)
        for kind, letter in (("vertex", "p"), ("line", "l"), ("triangle", "f")):
            if kind in mesh.cells:
                rows = mesh.cells[kind]
                # OBJ counts from 1; in 64 bits, where nothing can overflow.
                _write_lines(
                    file, letter + " %d" * CELL_CORNERS[kind], rows.astype(np.int64) + 1
                )


def write_off(mesh: Mesh, path: Path) -> None:
    """Write all points, then the triangles."""
    triangles = rows_of(mesh, "triangle")
    with path.open("wb") as file:
        file.write(f"OFF\n{len(mesh.points)} {len(triangles)} 0\n".encode())
        _write_points(file, "", mesh)
        _write_lines(file, "3 %d %d %d", triangles)


def _write_points(file: BinaryIO, start: str, mesh: Mesh) -> None:
    # repr() is the shortest text that reads back as the same float64.
    third = " %r" if mesh.points.shape[1] == 3 else " 0"
    _write_lines(file, f"{start}%r %r{third}", mesh.points)


def _write_lines(file: BinaryIO, template: str, rows: NDArray[Any]) -> None:
    """Write one line per row; formatting many at once is what makes it fast."""
    for start in range(0, len(rows), _LINES_AT_ONCE):
        part = rows[start : start + _LINES_AT_ONCE]
        text = (template + "\n") * len(part) % tuple(part.ravel().tolist())
        file.write(text.encode("ascii"))


def write_ply(mesh: Mesh, path: Path) -> None:
    """Write a binary PLY: vertices with their numbers, faces, and edges if there are any."""
    clash = sorted({"x", "y", "z"} & set(mesh.point_data))
    if clash:
        raise DoesNotFit(
            f"PLY files have columns x, y and z already: rename point_data[{clash[0]!r}]"
        )
    refuse_large(mesh, "PLY")
    columns = {name: _ply_column(values) for name, values in mesh.point_data.items()}
    vertices = np.empty(
        len(mesh.points),
        dtype=[(axis, "<f8") for axis in "xyz"]
        + [(name, values.dtype.newbyteorder("<")) for name, values in columns.items()],
    )
    for axis, values in zip("xyz", points_in_space(mesh).T, strict=True):
        vertices[axis] = values
    for name, values in columns.items():
        vertices[name] = values
    faces = np.empty(
        len(rows_of(mesh, "triangle")), dtype=[("count", "u1"), ("rows", "<i4", 3)]
    )
    faces["count"] = 3
    faces["rows"] = rows_of(mesh, "triangle")
    edges = rows_of(mesh, "line").astype("<i4")
    with path.open("wb") as file:
        file.write(_ply_header(vertices, len(faces), len(edges)).encode())
        for table in (vertices, faces, edges):
            file.write(_bytes(table))


_PLY_TYPES = {"u1": "uchar", "i4": "int", "f4": "float", "f8": "double"}


def _ply_column(values: NDArray[Any]) -> NDArray[Any]:
    """Return the numbers in a type that PLY has: integers up to 32 bits, or float64."""
    if values.dtype.kind == "b":
        return values.astype(np.uint8)
    if values.dtype.kind == "f":
        return values if values.dtype == np.float32 else values.astype(np.float64)
    if not values.size or (values.min() >= -INT32_END and values.max() < INT32_END):
        return values.astype(np.int32)
    return values.astype(np.float64)


def _ply_header(vertices: NDArray[Any], n_faces: int, n_edges: int) -> str:
    assert vertices.dtype.fields is not None
    lines = [
        "ply",
        "format binary_little_endian 1.0",
        "comment written by alphamesh",
        f"element vertex {len(vertices)}",
        *(
            f"property {_PLY_TYPES[dtype.str[1:]]} {name}"
            for name, (dtype, *_) in vertices.dtype.fields.items()
        ),
        f"element face {n_faces}",
        "property list uchar int vertex_indices",
    ]
    if n_edges:  # some readers stumble over this element, so only where it is needed
        lines += [f"element edge {n_edges}", "property int vertex1", "property int vertex2"]
    return "\n".join([*lines, "end_header", ""])


def write_stl(mesh: Mesh, path: Path) -> None:
    """Write a binary STL: each triangle with its normal, in 32-bit numbers."""
    _, corners = stl_corners(mesh)
    facets = np.zeros(
        len(corners), dtype=[("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("extra", "<u2")]
    )
    facets["normal"] = _normals(mesh)
    facets["corners"] = corners
    with path.open("wb") as file:
        # The first word must not be "solid": it would announce the text variant.
        file.write(b"alphamesh: binary STL".ljust(80))
        file.write(np.uint32(len(facets)).astype("<u4").tobytes())
        file.write(_bytes(facets))


def stl_corners(mesh: Mesh) -> tuple[int, NDArray[np.float32]]:
    """Return the corners of the triangles in the 32-bit numbers of STL.

    Returns
    -------
    n_collapsed : int
        In how many triangles two corners have become one.
    corners : (m, 3, 3) float32 array

    Raises
    ------
    DoesNotFit
        If coordinates are too large for 32-bit numbers.
    """
    with np.errstate(over="ignore"):
        points = points_in_space(mesh).astype(np.float32)
    if not np.isfinite(points).all():
        raise DoesNotFit(
            "STL files hold 32-bit numbers, and some coordinates are too large for them; "
            "scale the points, or choose .ply"
        )
    corners = points[rows_of(mesh, "triangle")]
    collapsed = np.zeros(len(corners), dtype=bool)
    for i, j in ((0, 1), (1, 2), (2, 0)):
        collapsed |= (corners[:, i] == corners[:, j]).all(axis=1)
    return int(np.count_nonzero(collapsed)), corners


def _normals(mesh: Mesh) -> NDArray[np.float64]:
    """Return the unit normals of the triangles, 0 where floating point cannot tell them."""
    triangles = rows_of(mesh, "triangle")
    if mesh.points.shape[1] == 2:
        # Counter-clockwise by contract; computed, a sliver might point down.
        return np.tile([0.0, 0.0, 1.0], (len(triangles), 1))
    corners = mesh.points[triangles]
    sides = corners[:, 1:] - corners[:, :1]  # below 1e39, as checked, so nothing overflows
    normals = np.cross(sides[:, 0], sides[:, 1])
    lengths = np.linalg.norm(normals, axis=1)
    return np.asarray(normals / np.where(lengths > 0, lengths, 1.0)[:, np.newaxis])


def write_npz(mesh: Mesh, path: Path) -> None:
    """Write all arrays as they are: ``points``, ``triangles``, ``triangles.radius``..."""
    arrays: dict[str, NDArray[Any]] = {"points": mesh.points}
    for kind, rows in mesh.cells.items():
        arrays[CELL_NAMES[kind]] = rows[:, 0] if kind == "vertex" else rows
    for name, values in mesh.point_data.items():
        arrays[f"points.{name}"] = values
    for name, by_kind in mesh.cell_data.items():
        for kind, values in by_kind.items():
            arrays[f"{CELL_NAMES[kind]}.{name}"] = values
    with path.open("wb") as file:
        np.savez(file, **arrays)  # type: ignore[arg-type]


def read_npz(path: Path) -> Mesh:
    """Read what `write_npz` wrote."""
    with path.open("rb") as file, np.load(file, allow_pickle=False) as archive:
        arrays = dict(archive.items())
    if "points" not in arrays:
        raise FileReadError("it has no array called points")
    cells = {kind: arrays[name] for kind, name in CELL_NAMES.items() if name in arrays}
    kinds = {name: kind for kind, name in CELL_NAMES.items()}
    point_data: dict[str, NDArray[Any]] = {}
    cell_data: dict[str, dict[str, NDArray[Any]]] = {}
    for key, values in arrays.items():
        owner, dot, name = key.partition(".")
        if dot and owner == "points":
            point_data[name] = values
        elif dot and owner in kinds:
            cell_data.setdefault(name, {})[kinds[owner]] = values
    return Mesh(arrays["points"], cells, point_data, cell_data)


def _bytes(table: NDArray[Any]) -> memoryview:
    """Return the bytes of an array without a copy."""
    return table.reshape(-1).view(np.uint8).data
