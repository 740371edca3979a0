"""PLY files that hold edges: triangles, edges and numbers of vertices, ASCII or binary."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from alphamesh.errors import FileReadError
from alphamesh.io._mesh import Mesh
from alphamesh.io._mesh_meshio import read_with_meshio

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["read_ply"]

_ORDERS = {b"binary_little_endian": "<", b"binary_big_endian": ">", b"ascii": ""}
_TYPES = {
    b"char": "i1", b"int8": "i1", b"uchar": "u1", b"uint8": "u1",
    b"short": "i2", b"int16": "i2", b"ushort": "u2", b"uint16": "u2",
    b"int": "i4", b"int32": "i4", b"uint": "u4", b"uint32": "u4",
    b"float": "f4", b"float32": "f4", b"double": "f8", b"float64": "f8",
}  # fmt: skip
_END = re.compile(rb"^[ \t]*end_header[ \t\r]*$", re.MULTILINE)
_AXES = ("x", "y", "z")
_CORNERS = 3


@dataclass(slots=True)
class _Element:
    """One kind of record; a list has one field for its length and three for its entries."""

    count: int
    fields: list[tuple[str, str]] = field(default_factory=list)


def read_ply(path: Path) -> Mesh:
    """Read a PLY file, the edges too, which meshio refuses.

    Raises
    ------
    FileReadError
        If it is cut off, or has edges beside faces that are no triangles.
    """
    content = path.read_bytes()
    head, _, body = content.partition(b"end_header")
    if not _END.search(content):  # meshio would look for it for ever
        raise FileReadError("it is cut off: its header has no line 'end_header'")
    elements = _elements(head)
    if elements.get("edge") is None:
        return read_with_meshio(path, "ply")
    form = next((line.split()[1] for line in head.splitlines() if line[:7] == b"format "), b"")
    if form not in _ORDERS:
        raise FileReadError("it has no line 'format' of a known kind")
    body = body.partition(b"\n")[2]
    tables = (_texts if form == b"ascii" else _records)(body, elements, _ORDERS[form])
    return _mesh(tables)


def _elements(head: bytes) -> dict[str, _Element]:
    """Return the elements that a header declares."""
    found: dict[str, _Element] = {}
    last = _Element(0)
    for line in head.splitlines():
        match line.split():
            case [b"element", name, count]:
                last = found[name.decode()] = _Element(int(count))
            case [b"property", b"list", size, kind, _]:
                corners = [(f"corner_{k}", _TYPES[kind]) for k in range(_CORNERS)]
                last.fields += [("length", _TYPES[size]), *corners]
            case [b"property", kind, name]:
                last.fields.append((name.decode(), _TYPES[kind]))
    return found


def _records(
    body: bytes, elements: dict[str, _Element], order: str
) -> dict[str, NDArray[np.void]]:
    """Return the tables in binary, one after another."""
    tables, start = {}, 0
    for name, element in elements.items():
        record = np.dtype([(entry, order + kind) for entry, kind in element.fields])
        if start + element.count * record.itemsize > len(body):
            raise _cut_off(name, element)
        tables[name] = np.frombuffer(body, record, element.count, start)
        _refuse_other_faces(tables[name])
        start += element.count * record.itemsize
    return tables


def _texts(body: bytes, elements: dict[str, _Element], _: str) -> dict[str, NDArray[np.void]]:
    """Return the tables in text, one after another."""
    tables, words, start = {}, body.split(), 0
    for name, element in elements.items():
        width = len(element.fields)
        part = words[start : start + element.count * width]
        if len(part) < element.count * width:
            raise _cut_off(name, element)
        numbers = np.array(part, dtype=np.float64).reshape(element.count, width)
        table = np.empty(element.count, np.dtype(element.fields))
        for column, (entry, _kind) in enumerate(element.fields):
            table[entry] = numbers[:, column]
        _refuse_other_faces(table)
        tables[name] = table
        start += element.count * width
    return tables


def _cut_off(name: str, element: _Element) -> FileReadError:
    return FileReadError(f"it is cut off: its header promises {element.count} of {name!r}")


def _refuse_other_faces(table: NDArray[np.void]) -> None:
    if "length" in (table.dtype.names or ()) and (table["length"] != _CORNERS).any():
        raise FileReadError("it has edges beside faces that are no triangles; split these")


def _mesh(tables: dict[str, NDArray[np.void]]) -> Mesh:
    vertices = tables["vertex"]
    names = vertices.dtype.names or ()
    native: dict[str, NDArray[Any]] = {
        name: vertices[name].astype(vertices.dtype[name].newbyteorder("=")) for name in names
    }
    points = np.column_stack([native.pop(axis) for axis in _AXES]).astype(np.float64)
    cells = {"line": _rows(tables["edge"], "vertex1", "vertex2")}
    if "face" in tables:
        corners = (f"corner_{k}" for k in range(_CORNERS))
        cells["triangle"] = _rows(tables["face"], *corners)
    return Mesh(points, cells, native)


def _rows(table: NDArray[np.void], *names: str) -> NDArray[np.int64]:
    return np.column_stack([table[name] for name in names]).astype(np.int64)
