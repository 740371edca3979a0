"""LAZ files from strangers: lazrs believes them, makes room, and may end the process.

A file is a table of chunks of packed points. What it says of itself, before a point is
unpacked, is held against its size: the number of chunks, and of each layered chunk the sizes
of its layers. Places as in the specification of LAZ [1]_ and in the LAS specification 1.4 R15.

References
----------
.. [1] M. Isenburg, LASzip: lossless compression of lidar data, Photogrammetric Engineering
   and Remote Sensing 79, 2013; and the LAZ specification 1.4 R1 (rapidlasso), 2021.
"""

from __future__ import annotations

import struct
from importlib import import_module
from itertools import accumulate, pairwise
from typing import TYPE_CHECKING, Any, BinaryIO, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Iterator

    from alphamesh.errors import FileReadError
    from alphamesh.io._sources import Source

__all__ = ["laz_backend", "refuse_packed"]

# Bytes and layers of the items of layered chunks, by their type; of extra bytes, one for each.
_SIZES = {10: 30, 11: 6, 12: 8, 13: 29}
_LAYERS = {10: 9, 11: 1, 12: 2, 13: 1}
# lazrs unpacks chunks side by side in room for whole ones. Writers make chunks of 50,000.
_MOST_POINTS = 4_000_000


class _Packing(NamedTuple):
    """What the record of LASzip says."""

    record: bytes
    chunk_points: int
    items: tuple[tuple[int, int, int], ...]


def laz_backend(file: BinaryIO) -> dict[str, Any]:
    """Return what laspy is to unpack with, as its option; nothing if it is to choose.

    Chunks that may be larger than any writer makes them are unpacked one after the other.
    """
    packing = _packing(file)
    if packing is None or packing.chunk_points <= _MOST_POINTS:
        return {}
    from laspy import LazBackend

    one_by_one = (LazBackend.Lazrs, LazBackend.Laszip)
    return {"laz_backend": [backend for backend in one_by_one if backend.is_available()]}


def refuse_packed(source: Source, file: BinaryIO, start: int) -> None:
    """Refuse chunks, and layers of them, for which the file has no room.

    Raises
    ------
    FileReadError
        If there are such, or the table of chunks makes no sense.
    """
    table = _table_place(source, file, start)
    packing = _packing(file)
    if packing is None or not any(kind in _LAYERS for kind, _, _ in packing.items):
        return
    if any(size != _SIZES.get(kind, size) for kind, size, _ in packing.items):
        raise _damaged(source)
    layers = sum(_LAYERS.get(kind, size) for kind, size, _ in packing.items)
    head = sum(size for _, size, _ in packing.items) + 4
    for begin, end in _chunks(source, file, start, packing):
        file.seek(begin + head)
        sizes = file.read(4 * layers)
        short = len(sizes) < 4 * layers or end > table
        if short or sum(struct.unpack(f"<{layers}I", sizes)) > end - begin:
            raise _damaged(source)


def _table_place(source: Source, file: BinaryIO, start: int) -> int:
    """Return where the table of chunks is.

    Its place is told where the points begin, or at the end if that says -1.
    """
    place = -1
    for at in (start, source.size - 8):
        file.seek(max(0, at))
        (place,) = struct.unpack("<q", file.read(8).ljust(8, b"\0"))
        if place != -1:
            break
    file.seek(max(0, place))
    _, chunks = struct.unpack("<II", file.read(8).ljust(8, b"\0"))
    if place < 0 or chunks > source.size:
        raise _damaged(source)
    return int(place)


def _chunks(
    source: Source, file: BinaryIO, start: int, packing: _Packing
) -> Iterator[tuple[int, int]]:
    """Return where each chunk of some points begins and ends; nothing without lazrs."""
    try:
        lazrs: Any = import_module("lazrs")
    except ImportError:
        return iter(())
    try:
        file.seek(start)
        table = lazrs.read_chunk_table(file, lazrs.LazVlr(packing.record))
    except BaseException as error:
        # lazrs is written in Rust: its panics are no Exception.
        if not isinstance(error, Exception) and type(error).__name__ != "PanicException":
            raise
        raise _damaged(source) from error
    places = list(accumulate((size for _, size in table), initial=start + 8))
    return (place for place, (points, _) in zip(pairwise(places), table, strict=True) if points)


def _packing(file: BinaryIO) -> _Packing | None:
    """Return the record of LASzip, None if there is none that is whole."""
    file.seek(94)
    size, _, records = struct.unpack("<HII", file.read(10).ljust(10, b"\0"))
    file.seek(size)
    for _ in range(records):
        head = file.read(54)
        if len(head) < 54:
            return None
        length = struct.unpack_from("<H", head, 20)[0]
        record = file.read(length)
        if head[2:18].rstrip(b"\0") == b"laszip encoded" and len(record) >= 34:
            items = struct.unpack_from("<H", record, 32)[0]
            if len(record) < 34 + 6 * items:
                return None
            kinds = tuple(struct.iter_unpack("<HHH", record[34 : 34 + 6 * items]))
            return _Packing(record, struct.unpack_from("<I", record, 12)[0], kinds)
    return None


def _damaged(source: Source) -> FileReadError:
    return source.failure(
        "is damaged: its table of packed chunks is not in its place; write or copy it again"
    )
