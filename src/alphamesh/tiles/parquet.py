"""Tables of plain numbers, written as Parquet without a copy of any of them.

Parquet is written by others, too, but they encode what has to be as it is: pages here are
the columns themselves, between headers of some bytes.

References
----------
Apache Parquet, File Format; Apache Thrift, Compact Protocol Encoding.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["write_parquet"]

_GROUP = 1 << 20
"""Rows of a row group, which readers take at a time."""
_PAGE = 1 << 18
"""Rows of a page, a multiple of eight."""

_MAGIC = b"PAR1"
_DATA_PAGE, _DICTIONARY_PAGE = 0, 2
_PLAIN, _RLE, _RLE_DICTIONARY = 0, 3, 8

# Physical type; type that it was converted from; bits of a number with a sign.
_TYPES = {"i1": (1, 15, 8), "i4": (1, None, 0), "i8": (2, None, 0), "f8": (5, None, 0)}


class Output(Protocol):
    """Where bytes go, one after the other."""

    size: int

    def write(self, content: bytes | memoryview) -> None:
        """Add some bytes."""


def write_parquet(
    file: Output, columns: Mapping[str, NDArray[Any]], ranges: Iterable[str] = ()
) -> None:
    """Write a table.

    Parameters
    ----------
    file : Output
    columns : mapping from str to (n,) int32, int64, float64 or int8 array
        Those of int8 take no more bits than they need: 1, 2, 4 or 8.
    ranges : iterable of str
        Columns of which least and greatest value are noted for each row group, without
        NaN among them.
    """
    count = len(next(iter(columns.values())))
    noted = set(ranges)
    file.write(_MAGIC)
    groups = []
    for start in range(0, count, _GROUP):
        rows = slice(start, min(start + _GROUP, count))
        written = [
            _write_chunk(file, name, column[rows], noted=name in noted)
            for name, column in columns.items()
        ]
        size = sum(chunk.size for chunk in written)
        parts = [_struct(_i64(2, chunk.start), _nested(3, chunk.about)) for chunk in written]
        groups.append(
            _struct(_list(1, _STRUCT, parts), _i64(2, size), _i64(3, rows.stop - rows.start))
        )
    schema = [_struct(_text(4, "schema"), _i32(5, len(columns)))]
    schema += [_element(name, column) for name, column in columns.items()]
    orders = [_struct(_nested(1, _struct()))] * len(columns)  # as the type defines it
    footer = _struct(
        _i32(1, 2),
        _list(2, _STRUCT, schema),
        _i64(3, count),
        _list(4, _STRUCT, groups),
        _text(6, "alphamesh"),
        _list(7, _STRUCT, orders),
    )
    file.write(footer + len(footer).to_bytes(4, "little") + _MAGIC)


class _Chunk(NamedTuple):
    """A column of a row group: where it is, and what the footer says of it."""

    start: int
    size: int
    about: bytes


def _kind(column: NDArray[Any]) -> str:
    return f"{column.dtype.kind}{column.dtype.itemsize}"


def _element(name: str, column: NDArray[Any]) -> bytes:
    """Describe a column; no value is missing."""
    physical, converted, bits = _TYPES[_kind(column)]
    fields = [_i32(1, physical), _i32(3, 0), _text(4, name)]
    if converted is not None:
        integer = _struct((1, _BYTE, bytes([bits])), (2, _TRUE, b""))
        fields += [_i32(6, converted), _nested(10, _struct(_nested(10, integer)))]
    return _struct(*fields)


def _write_chunk(file: Output, name: str, column: NDArray[Any], *, noted: bool) -> _Chunk:
    start = file.size
    words = _Words(file, column) if _kind(column) == "i1" else None
    encoding = _PLAIN if words is None else _RLE_DICTIONARY
    first = file.size
    for at in range(0, len(column), _PAGE):
        values = column[at : at + _PAGE]
        header = _struct(_i32(1, len(values)), _i32(2, encoding), _i32(3, _RLE), _i32(4, _RLE))
        parts = [_bytes(values)] if words is None else words.packed(values)
        _write_page(file, _DATA_PAGE, _nested(5, header), *parts)
    size = file.size - start
    fields = [
        _i32(1, _TYPES[_kind(column)][0]),
        _list(2, _I32, [_number(each) for each in sorted({_PLAIN, _RLE, encoding})]),
        _list(3, _BINARY, [_string(name.encode())]),
        _i32(4, 0),  # not compressed
        _i64(5, len(column)),
        _i64(6, size),
        _i64(7, size),
        _i64(9, first),
    ]
    if words is not None:
        fields.append(_i64(11, start))
    if noted:
        fields.append(_nested(12, _range(column)))
    return _Chunk(start, size, _struct(*fields))


class _Words:
    """The numbers from the least to the greatest of a column, a dictionary of its own.

    Parameters
    ----------
    file : Output
        The dictionary is written there.
    column : (n,) int8 array
    """

    def __init__(self, file: Output, column: NDArray[np.int8]) -> None:
        least, most = int(column.min()), int(column.max())
        self._least = np.int8(least).view(np.uint8)
        # A power of two, as bytes can be packed two by two then.
        self._bits = next(bits for bits in (1, 2, 4, 8) if most - least < 1 << bits)
        words = np.arange(least, most + 1, dtype="<i4")
        header = _struct(_i32(1, len(words)), _i32(2, _PLAIN))
        _write_page(file, _DICTIONARY_PAGE, _nested(7, header), words.tobytes())

    def packed(self, values: NDArray[np.int8]) -> list[bytes | memoryview]:
        """Return the places of values in the dictionary, in one run."""
        groups = -(-len(values) // 8)
        packed = np.zeros(8 * groups, dtype=np.uint8)
        np.subtract(values.view(np.uint8), self._least, out=packed[: len(values)])
        bits = self._bits
        while bits < 8:
            pairs = packed.view("<u2")
            packed = (pairs | pairs >> np.uint16(8 - bits)).astype(np.uint8)
            bits *= 2
        return [bytes([self._bits]) + _varint(2 * groups + 1), packed.data]


def _write_page(file: Output, kind: int, header: _Field, *parts: bytes | memoryview) -> None:
    size = sum(map(len, parts))
    file.write(_struct(_i32(1, kind), _i32(2, size), _i32(3, size), header))
    for part in parts:
        file.write(part)


def _bytes(values: NDArray[Any]) -> memoryview:
    little = np.ascontiguousarray(values, dtype=values.dtype.newbyteorder("<"))
    return little.view(np.uint8).data


def _range(column: NDArray[Any]) -> bytes:
    """Return statistics; zeros have the sign that makes the range wider."""
    least, most = column.min(), column.max()
    if column.dtype.kind == "f":
        least, most = least - 0.0 if least else -0.0, most + 0.0
    ends = (
        np.array(end, dtype=column.dtype.newbyteorder("<")).tobytes() for end in (most, least)
    )
    largest, smallest = map(_string, ends)
    return _struct(_i64(3, 0), (5, _BINARY, largest), (6, _BINARY, smallest))


# ------------------------------------------- Thrift: structures of numbered fields

_TRUE, _BYTE, _I32, _I64, _BINARY, _LIST, _STRUCT = 1, 3, 5, 6, 8, 9, 12

_Field = tuple[int, int, bytes]
"""Number, type, content"""


def _struct(*fields: _Field) -> bytes:
    """Return a structure of fields in the order of their numbers, which step by 15 at most."""
    content, before = b"", 0
    for number, kind, value in fields:
        content += bytes([(number - before) << 4 | kind]) + value
        before = number
    return content + b"\0"


def _i32(number: int, value: int) -> _Field:
    return number, _I32, _number(value)


def _i64(number: int, value: int) -> _Field:
    return number, _I64, _number(value)


def _text(number: int, value: str) -> _Field:
    return number, _BINARY, _string(value.encode())


def _nested(number: int, value: bytes) -> _Field:
    return number, _STRUCT, value


def _list(number: int, kind: int, values: list[bytes]) -> _Field:
    count = len(values)
    head = bytes([count << 4 | kind]) if count < 15 else bytes([0xF0 | kind]) + _varint(count)
    return number, _LIST, head + b"".join(values)


def _number(value: int) -> bytes:
    return _varint(2 * value)  # the last bit is the sign


def _string(value: bytes) -> bytes:
    return _varint(len(value)) + value


def _varint(value: int) -> bytes:
    """Return seven bits a byte, the lowest first."""
    found = bytearray()
    while value >= 0x80:
        found.append(value & 0x7F | 0x80)
        value >>= 7
    return bytes([*found, value])
