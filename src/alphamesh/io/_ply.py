"""The vertices of PLY files, ASCII or binary, with or without faces."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import IO, TYPE_CHECKING, NoReturn

import numpy as np

from alphamesh.io._columns import Wanted, choose_columns, exact_floats, stack
from alphamesh.io._layout import Layout
from alphamesh.io._sources import Source
from alphamesh.io._text import read_rows

if TYPE_CHECKING:
    from alphamesh._arrays import FloatArray

__all__ = ["read_ply", "vertex_properties"]

_LONGEST_HEADER = 2**20
_BYTE_ORDERS = {"binary_little_endian": "<", "binary_big_endian": ">"}
_TYPES = {
    "char": "i1", "int8": "i1", "uchar": "u1", "uint8": "u1",
    "short": "i2", "int16": "i2", "ushort": "u2", "uint16": "u2",
    "int": "i4", "int32": "i4", "uint": "u4", "uint32": "u4",
    "float": "f4", "float32": "f4", "double": "f8", "float64": "f8",
}  # fmt: skip


@dataclass(slots=True)
class _Element:
    """One kind of record: its name, how many there are, and their properties."""

    name: str
    count: int
    names: list[str] = field(default_factory=list)
    types: list[str] = field(default_factory=list)
    first_list: int | None = None


@dataclass(slots=True)
class _Header:
    """What a PLY file says of itself; `lines` and `size` are those of the header."""

    form: str
    elements: list[_Element]
    lines: int
    size: int


def read_ply(source: Source, wanted: Wanted) -> FloatArray:
    """Read the coordinates of the vertices in a PLY file.

    Parameters
    ----------
    source : Source
    wanted : Wanted
        As from :func:`wanted_columns`; the columns are the vertex properties.

    Returns
    -------
    (n, dimension) float64 array

    Raises
    ------
    FileReadError
        If it is not a complete PLY file, or has no such vertex properties.
    """
    with source.open() as file:
        header = _read_header(source, file)
    vertex, before = _vertex_element(source, header)
    usable = vertex.names[: vertex.first_list]
    chosen = choose_columns(source, wanted, usable, len(usable))
    if header.form == "ascii":
        return _read_ascii(source, header, vertex, before, chosen)
    return _read_binary(source, header, vertex, before, chosen)


def vertex_properties(source: Source) -> dict[str, str]:
    """Return the names of the numbers of the vertices, and their types for NumPy."""
    with source.open() as file:
        vertex, _ = _vertex_element(source, _read_header(source, file))
    usable = slice(vertex.first_list)
    return dict(zip(vertex.names[usable], vertex.types[usable], strict=True))


def _vertex_element(source: Source, header: _Header) -> tuple[_Element, list[_Element]]:
    """Return the vertices, and the elements before them."""
    for number, element in enumerate(header.elements):
        if element.name == "vertex":
            return element, header.elements[:number]
    listed = ", ".join(repr(element.name) for element in header.elements) or "none"
    raise source.failure(f"has no element 'vertex' (its elements: {listed})")


def _read_ascii(
    source: Source,
    header: _Header,
    vertex: _Element,
    before: list[_Element],
    chosen: tuple[int, ...],
) -> FloatArray:
    # A digit and a blank for each number; the last line may end without its line feed.
    _refuse_short(source, vertex, 2 * len(vertex.names), header, skipped=-1)
    if vertex.count == 0:
        return np.empty((0, len(chosen)))
    layout = Layout(
        first=header.lines + sum(element.count for element in before) + 1,
        columns=chosen,
        names=tuple(vertex.names),
        rows=vertex.count,
    )
    points = read_rows(source, "latin-1", layout)
    if len(points) < vertex.count:
        raise source.failure(
            f"is cut off: its header promises {vertex.count} vertices and {len(points)} "
            "follow; write or copy it again"
        )
    return points


def _read_binary(
    source: Source,
    header: _Header,
    vertex: _Element,
    before: list[_Element],
    chosen: tuple[int, ...],
) -> FloatArray:
    order = _BYTE_ORDERS[header.form]
    for element in (*before, vertex):
        if element.first_list is not None:
            raise source.failure(
                f"has lists of varying length in its {element.name!r} elements, which are "
                "not read here; convert it to one whose vertices come first and hold "
                "plain numbers"
            )
    record = _record(order, vertex)
    skipped = sum(element.count * _record(order, element).itemsize for element in before)
    _refuse_short(source, vertex, record.itemsize, header, skipped)
    with source.open() as file:
        file.seek(header.size + skipped)
        vertices = np.frombuffer(file.read(vertex.count * record.itemsize), record)
    return stack([exact_floats(source, vertices[f"f{k}"], vertex.names[k]) for k in chosen])


def _record(order: str, element: _Element) -> np.dtype[np.void]:
    return np.dtype([(f"f{k}", order + code) for k, code in enumerate(element.types)])


def _refuse_short(
    source: Source, vertex: _Element, least: int, header: _Header, skipped: int = 0
) -> None:
    """Refuse a file with fewer bytes than its vertices need, before any is allocated."""
    left = source.size - header.size - skipped
    if vertex.count * least > left:
        raise source.failure(
            f"is cut off or damaged: its header promises {vertex.count} vertices, and "
            f"{max(source.size - header.size, 0)} bytes follow; write or copy it again"
        )


def _read_header(source: Source, file: IO[bytes]) -> _Header:
    """Read up to ``end_header``."""
    header = _Header("", [], 0, 0)
    while header.size < _LONGEST_HEADER:
        raw = file.readline(_LONGEST_HEADER)
        header.lines += 1
        header.size += len(raw)
        words = raw.decode("latin-1").split()
        if header.lines == 1:
            if words != ["ply"]:
                raise source.failure("is not a PLY file: its first line is not 'ply'")
        elif words == ["end_header"]:
            if not header.form:
                _bad_line(source, header, "the line 'format' is missing before")
            return header
        elif not raw.endswith(b"\n"):
            break
        elif words and words[0] not in ("comment", "obj_info"):
            _read_declaration(source, header, words)
    raise source.failure("is cut off: its header has no line 'end_header'")


def _read_declaration(source: Source, header: _Header, words: list[str]) -> None:
    """Take in one line of the header."""
    match words:
        case ["format", form, "1.0"] if form == "ascii" or form in _BYTE_ORDERS:
            header.form = form
        case ["element", name, count] if count.isascii() and count.isdigit():
            header.elements.append(_Element(name, int(count)))
        case ["property", kind, name] if kind in _TYPES and header.elements:
            header.elements[-1].names.append(name)
            header.elements[-1].types.append(_TYPES[kind])
        case ["property", "list", size, kind, name] if (
            size in _TYPES and kind in _TYPES and header.elements
        ):
            element = header.elements[-1]
            if element.first_list is None:
                element.first_list = len(element.names)
            element.names.append(name)
            element.types.append(_TYPES[kind])
        case _:
            _bad_line(source, header, f"unknown declaration {' '.join(words)[:60]!r} in")


def _bad_line(source: Source, header: _Header, what: str) -> NoReturn:
    raise source.failure(
        f"is not a PLY file that can be read: {what} line {header.lines} of its header"
    )
