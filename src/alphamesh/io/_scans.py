"""Clouds of scanners: LAS and LAZ files, read by laspy, and PCD files, read by pypcd4."""

from __future__ import annotations

import struct
from importlib import import_module
from typing import TYPE_CHECKING, Any, BinaryIO

import numpy as np

from alphamesh.errors import FileReadError, MissingLibraryError
from alphamesh.io._columns import Wanted, choose_columns, exact_floats, stack
from alphamesh.io._laz import laz_backend, refuse_packed
from alphamesh.io._sources import Source

if TYPE_CHECKING:
    from alphamesh._arrays import FloatArray

__all__ = ["las_table", "pcd_table", "read_las", "read_pcd", "refuse_counts"]

# Point formats from here on are those of LAZ.
_PACKED = 64


def read_las(source: Source, wanted: Wanted) -> FloatArray:
    """Read the coordinates in a LAS or LAZ file, scaled as its header says.

    Parameters
    ----------
    source : Source
    wanted : Wanted
        As from :func:`wanted_columns`; besides ``x``, ``y`` and ``z``, the columns are the
        other dimensions of the points, such as ``intensity``.

    Returns
    -------
    (n, dimension) float64 array

    Raises
    ------
    FileReadError
        If it is not a complete LAS or LAZ file, or has no such columns.
    MissingLibraryError
        If laspy is not installed, or, for LAZ, the library that it unpacks with.
    """
    return _columns(source, wanted, *las_table(source))


def las_table(source: Source) -> tuple[list[str], Any]:
    """Return the names of the columns of a LAS or LAZ file, and what has them by name."""
    try:
        import laspy
    except ImportError as error:
        raise MissingLibraryError.of("laspy", "las", "reading LAS and LAZ files") from error
    with source.open() as file:
        _refuse_other(source, file.read(4), b"LASF", "LAS")
        file.seek(0)
        refuse_counts(source, file)
        try:
            backend = laz_backend(file)
            file.seek(0)
            points: Any = laspy.read(file, closefd=False, **backend)
        except Exception as error:  # laspy and its decoders raise errors of many types
            if "No LazBackend" in str(error):
                raise MissingLibraryError.of("lazrs", "las", "reading LAZ files") from error
            raise _damaged(source, "LAS", error) from error
        except BaseException as error:
            # lazrs is written in Rust: its panics are no Exception.
            if type(error).__name__ != "PanicException":
                raise
            raise _damaged(source, "LAS", error) from error
    promised = points.header.point_count
    if len(points) != promised:
        raise _cut_off(source, promised, len(points))
    # The raw integers X, Y and Z come first; the scaled ones take their place.
    return ["x", "y", "z", *list(points.point_format.dimension_names)[3:]], points


def read_pcd(source: Source, wanted: Wanted) -> FloatArray:
    """Read the coordinates in a PCD file: ASCII, binary or compressed.

    Parameters
    ----------
    source : Source
    wanted : Wanted
        As from :func:`wanted_columns`; the columns are the fields of the points.

    Returns
    -------
    (n, dimension) float64 array
        Points that the scanner missed are NaN.

    Raises
    ------
    FileReadError
        If it is not a complete PCD file, or has no such fields.
    MissingLibraryError
        If pypcd4 is not installed.
    """
    return _columns(source, wanted, *pcd_table(source))


def pcd_table(source: Source) -> tuple[list[str], Any]:
    """Return the names of the fields of a PCD file, and what has them by name."""
    try:
        pypcd4: Any = import_module("pypcd4")
    except ImportError as error:
        raise MissingLibraryError.of("pypcd4", "pcd", "reading PCD files") from error
    with source.open() as file:
        try:
            points: Any = pypcd4.PointCloud.from_fileobj(file)
            table = points.pc_data
        except Exception as error:  # whatever it stumbles over in a broken file
            raise _damaged(source, "PCD", error) from error
    promised = points.metadata.points
    if len(table) != promised:
        raise _cut_off(source, promised, len(table))
    return list(points.fields), table


def _refuse_other(source: Source, start: bytes, wanted: bytes, name: str) -> None:
    if start != wanted:
        raise source.failure(f"is not a {name} file: it does not begin with {wanted.decode()}")


def refuse_counts(source: Source, file: BinaryIO) -> None:
    """Refuse a LAS header that promises more records than the file has room for.

    laspy believes it: millions of records of nothing take minutes and all memory. Offsets
    as in the LAS specification 1.4 R15, table 3; a record of variable length has 54 bytes
    or more, an extended one 60.
    """
    head = file.read(375)
    if len(head) < 227:
        return  # laspy tells
    head = head.ljust(375, b"\0")
    size = source.size
    header, start, records, kind, length, points = struct.unpack_from("<HIIBHI", head, 94)
    if records > max(0, min(start, size) - header) // 54:
        raise source.failure(
            f"is damaged: its header promises {records} records (VLR) before the points, "
            "and there is no room for them; write or copy it again"
        )
    if head[25] >= 4:
        extended_start, extended, points = struct.unpack_from("<QIQ", head, 235)
        if extended > max(0, size - extended_start) // 60:
            raise source.failure(
                f"is damaged: its header promises {extended} records (EVLR) after the points, "
                "and there is no room for them; write or copy it again"
            )
    following = max(0, size - start) // max(1, length)
    if kind < _PACKED and points > following:
        raise _cut_off(source, points, following)
    if kind >= _PACKED and points:
        refuse_packed(source, file, start)


def _cut_off(source: Source, promised: int, following: int) -> FileReadError:
    return source.failure(
        f"is cut off: its header promises {promised} points and {following} follow; "
        "write or copy it again"
    )


def _damaged(source: Source, name: str, error: BaseException) -> FileReadError:
    detail = str(error) or type(error).__name__
    return source.failure(f"is not a complete {name} file ({detail}); write or copy it again")


def _columns(source: Source, wanted: Wanted, names: list[str], table: Any) -> FloatArray:
    chosen = choose_columns(source, wanted, names, len(names))
    with np.errstate(over="ignore", invalid="ignore"):  # of scales that no scanner has
        columns = [(np.asarray(table[names[k]]), names[k]) for k in chosen]
    return stack([exact_floats(source, column, name) for column, name in columns])
