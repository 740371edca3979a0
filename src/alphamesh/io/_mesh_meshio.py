"""Mesh files through meshio: VTU and VTK, and its readers.

meshio does not notice what other programs refuse, so meshes are made to fit first: ParaView,
for instance, takes no 32-bit integers from its VTK files.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from alphamesh.errors import FileReadError, MissingLibraryError
from alphamesh.io._mesh import CELL_CORNERS, Mesh, points_in_space, rows_of

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from alphamesh.io._mesh import Numbers

__all__ = ["as_meshio", "read_off", "read_with_meshio", "write_vtk", "write_vtu"]


def write_vtu(mesh: Mesh, path: Path) -> None:
    """Write a VTU file: XML with binary arrays."""
    meshio = _meshio("Writing VTU files")
    # Without any block, meshio leaves out a section that readers miss.
    blocks = _blocks(mesh) or ["triangle"]
    # Compression would halve the file, and take six times as long.
    meshio.vtu.write(
        str(path),
        _converted(meshio, mesh, blocks, _vtu_numbers),
        compression=None,
        header_type="UInt64",
    )


def write_vtk(mesh: Mesh, path: Path) -> None:
    """Write a binary VTK file, version 5.1."""
    meshio = _meshio("Writing VTK files")
    meshio.vtk.write(str(path), _converted(meshio, mesh, _blocks(mesh), _vtk_numbers))


def as_meshio(mesh: Mesh) -> Any:
    """Return a mesh as a ``meshio.Mesh``: kinds without a cell are left out."""
    meshio = _meshio("Making its meshes")
    return _converted(meshio, mesh, _blocks(mesh), np.array)


def read_with_meshio(path: Path, module: str) -> Mesh:
    """Read a mesh with ``meshio.<module>``.

    Numbers with several components, and those that meshio or Gmsh keep for themselves
    (``gmsh:...``, ``obj:...``), are left out.
    """
    # Not `meshio.read`: it ends the program where a file is not what it seems.
    found = getattr(_meshio("Reading this file"), module).read(str(path))
    if not len(found.points):  # meshio's OBJ reader skips all that it does not know
        raise FileReadError("it has no points")
    cells: dict[str, list[NDArray[Any]]] = {}
    cell_data: dict[str, dict[str, list[NDArray[Any]]]] = {}
    names = [name for name, blocks in found.cell_data.items() if _is_plain(name, blocks)]
    for number, block in enumerate(found.cells):
        if block.type not in CELL_CORNERS:
            raise FileReadError(f"it has {block.type} cells; convert them to triangles")
        cells.setdefault(block.type, []).append(np.asarray(block.data))
        for name in names:
            by_kind = cell_data.setdefault(name, {})
            by_kind.setdefault(block.type, []).append(found.cell_data[name][number])
    return Mesh(
        np.asarray(found.points, dtype=np.float64).reshape(-1, 3),
        {kind: np.concatenate(parts) for kind, parts in cells.items()},
        {name: data for name, data in found.point_data.items() if _is_plain(name, [data])},
        {
            name: {kind: np.concatenate(parts) for kind, parts in by_kind.items()}
            for name, by_kind in cell_data.items()
        },
    )


def read_off(path: Path) -> Mesh:
    """Read an OFF file of triangles.

    Raises
    ------
    FileReadError
        If its counts are missing, or larger than the file; meshio would look for them for
        ever, or fill the memory.
    """
    with path.open("rb") as file:
        file.readline()
        lines = (line.strip() for line in file)
        counts = next((line for line in lines if line and not line.startswith(b"#")), b"")
    numbers = counts.split()
    if len(numbers) != 3 or not all(number.isdigit() for number in numbers):
        raise FileReadError("it is cut off: there are no numbers of vertices, faces and edges")
    vertices, faces = int(numbers[0]), int(numbers[1])
    if vertices + faces > path.stat().st_size:
        raise FileReadError(
            f"it is cut off: its header promises {vertices:,} vertices and {faces:,} faces"
        )
    return read_with_meshio(path, "off")


def _is_plain(name: str, blocks: list[Any]) -> bool:
    return not name.startswith(("gmsh:", "obj:")) and all(np.ndim(part) == 1 for part in blocks)


def _meshio(purpose: str) -> Any:
    try:
        import meshio
    except ImportError as error:
        raise MissingLibraryError.of("meshio", "io", purpose) from error
    return meshio


def _blocks(mesh: Mesh) -> list[str]:
    """Return the kinds that have cells: meshio fails on empty ones among others."""
    return [kind for kind, rows in mesh.cells.items() if len(rows)]


def _converted(
    meshio: Any, mesh: Mesh, blocks: list[str], numbers: Callable[[Numbers], Numbers]
) -> Any:
    """Return the mesh as meshio's own object, its numbers in the types of the format."""
    nothing = np.empty(0)
    return meshio.Mesh(
        points_in_space(mesh),
        [(kind, rows_of(mesh, kind)) for kind in blocks],
        point_data={name: numbers(values) for name, values in mesh.point_data.items()},
        cell_data={
            name: [numbers(by_kind.get(kind, nothing)) for kind in blocks]
            for name, by_kind in mesh.cell_data.items()
        },
    )


def _vtu_numbers(values: Numbers) -> Numbers:
    if values.dtype.kind == "b":
        return values.astype(np.uint8)
    if values.dtype.kind == "f" and values.dtype.itemsize not in (4, 8):
        return values.astype(np.float64)
    return values


def _vtk_numbers(values: Numbers) -> Numbers:
    # VTK's own reader takes integers from such files only if they have 64 bits.
    if values.dtype.kind in "bi":
        return values.astype(np.int64)
    return values.astype(np.uint64) if values.dtype.kind == "u" else _vtu_numbers(values)
