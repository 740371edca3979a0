"""Gmsh's mesh files, version 4.1, binary.

Written here, because what meshio writes of a mesh with several kinds of cells is refused by
Gmsh (version 4.1: entities are missing) or by meshio itself (version 2.2: numbers per cell).
"""

from __future__ import annotations

import re
import struct
from pathlib import Path
from typing import TYPE_CHECKING, Any, BinaryIO

import numpy as np

from alphamesh.errors import FileReadError
from alphamesh.io._mesh import CELL_NAMES, Mesh, points_in_space, refuse_large
from alphamesh.io._mesh_meshio import read_with_meshio

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

__all__ = ["read_msh", "write_msh"]

_NODES = re.compile(rb"^\$Nodes\s*?\n", re.MULTILINE)
# A number for each tag up to the largest is a table that the file can answer for.
_SPREAD = 16

# Gmsh's number and dimension of each kind of cell. Each kind is one entity of Gmsh, and one
# physical group; both have the tag 1, as tags are counted apart in every dimension.
_TYPES = {"vertex": 15, "line": 1, "triangle": 2, "tetra": 4}
_DIMENSIONS = {"vertex": 0, "line": 1, "triangle": 2, "tetra": 3}
_TAG = 1


def read_msh(path: Path) -> Mesh:
    """Read a file of Gmsh with meshio.

    Raises
    ------
    FileReadError
        If the tag of a point is far beyond the size of the file: meshio makes a table of all
        tags up to the largest.
    """
    content = path.read_bytes()
    largest = _largest_tag(content)
    if largest > max(10_000, _SPREAD * len(content)):
        raise FileReadError(f"it is damaged: a point has the tag {largest:,}")
    return read_with_meshio(path, "gmsh")


def _largest_tag(content: bytes) -> int:
    """Return the largest tag of a point in a binary file of version 4.1, else 0."""
    form = content.partition(b"\n")[2][:20].split()
    start = _NODES.search(content)
    if form[:3] != [b"4.1", b"1", b"8"] or start is None:
        return 0
    at, largest = start.end(), 0
    (blocks,) = _words(content, at, "<Q")
    at += 32
    for _ in range(blocks):
        if at + 20 > len(content):
            break
        *_, count = _words(content, at, "<iiiQ")
        at += 20
        whole = content[at : at + 8 * count]
        tags = np.frombuffer(whole[: len(whole) // 8 * 8], dtype="<u8")
        largest = max(largest, int(tags.max(initial=0)))
        at += 32 * count
    return largest


def _words(content: bytes, at: int, form: str) -> tuple[int, ...]:
    size = struct.calcsize(form)
    return struct.unpack(form, content[at : at + size].ljust(size, b"\0"))


def write_msh(mesh: Mesh, path: Path) -> None:
    """Write nodes, elements, and the numbers of both as post-processing views."""
    refuse_large(mesh, "MSH")  # numbers are attached to 32-bit tags
    cells = {kind: rows for kind, rows in mesh.cells.items() if len(rows)}
    with path.open("wb") as file:
        file.write(b"$MeshFormat\n4.1 1 8\n")
        file.write(_ints(1))  # tells the order of bytes
        file.write(b"\n$EndMeshFormat\n$PhysicalNames\n")
        file.write(f"{len(cells)}\n".encode())
        for kind in cells:
            file.write(f'{_DIMENSIONS[kind]} {_TAG} "{CELL_NAMES[kind]}"\n'.encode())
        file.write(b"$EndPhysicalNames\n")
        _write_entities(file, mesh, list(cells))
        _write_nodes(file, mesh, list(cells))
        _write_elements(file, cells)
        for name, values in mesh.point_data.items():
            _write_numbers(file, "NodeData", name, values)
        for name, by_kind in mesh.cell_data.items():
            if cells:
                joined = np.concatenate([by_kind[kind].astype(np.float64) for kind in cells])
                _write_numbers(file, "ElementData", name, joined)


def _ints(*values: int) -> bytes:
    return np.array(values, dtype=np.int32).tobytes()


def _sizes(*values: int) -> bytes:
    return np.array(values, dtype=np.uint64).tobytes()


def _top(kinds: list[str]) -> int:
    """Return the dimension of the entity that all nodes are given to."""
    return _DIMENSIONS[kinds[-1]] if kinds else 0


def _write_entities(file: BinaryIO, mesh: Mesh, kinds: list[str]) -> None:
    points = points_in_space(mesh)
    used = {_DIMENSIONS[kind] for kind in kinds} | ({_top(kinds)} if len(points) else set())
    file.write(b"$Entities\n")
    file.write(_sizes(*(int(dimension in used) for dimension in range(4))))
    for dimension in sorted(used):
        box = np.concatenate([points.min(axis=0), points.max(axis=0)])
        file.write(_ints(_TAG))
        file.write((box[:3] if dimension == 0 else box).tobytes())
        named = dimension in {_DIMENSIONS[kind] for kind in kinds}
        file.write(_sizes(int(named)) + (_ints(_TAG) if named else b""))
        if dimension > 0:
            file.write(_sizes(0))  # entities on its boundary
    file.write(b"\n$EndEntities\n")


def _write_nodes(file: BinaryIO, mesh: Mesh, kinds: list[str]) -> None:
    count = len(mesh.points)
    file.write(b"$Nodes\n")
    file.write(_sizes(int(count > 0), count, int(count > 0), count))
    if count:
        file.write(_ints(_top(kinds), _TAG, 0))
        file.write(_sizes(count))
        file.write(np.arange(1, count + 1, dtype=np.uint64).data)
        file.write(np.ascontiguousarray(points_in_space(mesh)).data)
    file.write(b"\n$EndNodes\n")


def _write_elements(file: BinaryIO, cells: Mapping[str, NDArray[Any]]) -> None:
    count = sum(map(len, cells.values()))
    file.write(b"$Elements\n")
    file.write(_sizes(len(cells), count, int(count > 0), count))
    first = 1
    for kind, rows in cells.items():
        file.write(_ints(_DIMENSIONS[kind], _TAG, _TYPES[kind]))
        file.write(_sizes(len(rows)))
        table = np.empty((len(rows), 1 + rows.shape[1]), dtype=np.uint64)
        table[:, 0] = np.arange(first, first + len(rows))
        table[:, 1:] = rows
        table[:, 1:] += np.uint64(1)
        file.write(table.data)
        first += len(rows)
    file.write(b"\n$EndElements\n")


def _write_numbers(file: BinaryIO, section: str, name: str, values: NDArray[Any]) -> None:
    # One text (the name), one real (the time), three integers: step, components, entries.
    file.write(f'${section}\n1\n"{name}"\n1\n0.0\n3\n0\n1\n{len(values)}\n'.encode())
    table = np.empty(len(values), dtype=[("tag", np.int32), ("value", np.float64)])
    table["tag"] = np.arange(1, len(values) + 1)
    table["value"] = values
    file.write(table.tobytes())
    file.write(f"\n$End{section}\n".encode())
