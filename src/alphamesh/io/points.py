"""Read a cloud from a file of any usual format."""

from __future__ import annotations

import os
from pathlib import PurePath
from typing import TYPE_CHECKING, Literal

from alphamesh.errors import FileReadError, ParameterError
from alphamesh.io._columns import Columns, Wanted, wanted_columns, without_flat_z
from alphamesh.io._layout import TextOptions
from alphamesh.io._npy import read_npy, read_npz
from alphamesh.io._parquet import read_parquet
from alphamesh.io._ply import read_ply
from alphamesh.io._scans import read_las, read_pcd
from alphamesh.io._sources import Source, open_source
from alphamesh.io._text import read_text

if TYPE_CHECKING:
    from alphamesh._arrays import FloatArray

__all__ = ["POINT_FORMATS", "read_points"]

# The delimiter that an extension stands for; None: look at the file.
_TEXT: dict[str, str | None] = {
    "csv": None,
    "tsv": "\t",
    "tab": "\t",
    "txt": None,
    "dat": None,
    "xyz": None,
}
_BINARY = {
    "las": read_las,
    "laz": read_las,
    "npy": read_npy,
    "parquet": read_parquet,
    "pcd": read_pcd,
    "ply": read_ply,
}

# Where three columns without names are coordinates, as a rule.
_UNNAMED = frozenset({"xyz", "npy", "npz"})

_IMAGES = frozenset({"png", "jpg", "jpeg", "tif", "tiff", "gif", "bmp", "webp", "pgm", "pbm"})

POINT_FORMATS: tuple[str, ...] = (
    *_TEXT, "las", "laz", "npy", "npz", "parquet", "pcd", "ply",
)  # fmt: skip
"""The formats that :func:`read_points` reads, each also a file name extension."""


def read_points(  # noqa: PLR0913 (one keyword per property of a text table)
    path: str | os.PathLike[str],
    *,
    columns: Columns = None,
    dimension: int | None = None,
    file_format: str | None = None,
    delimiter: str | None = None,
    header: bool | Literal["auto"] = "auto",
    skip: int = 0,
    comment: str | None = "#",
    decimal: str = ".",
    encoding: str | None = None,
    key: str | None = None,
) -> FloatArray:
    """Read the coordinates of points from a file.

    Text tables (CSV, TSV, TXT, DAT, XYZ; also packed as ``.gz``), NPY and NPZ, Parquet,
    the vertices of PLY files, ASCII or binary, and the clouds of scanners: LAS and LAZ
    (with laspy), PCD (with pypcd4).

    Parameters
    ----------
    path : str or path-like
        The file; ``"-"`` reads a text table from standard input. The extension tells
        the format.
    columns : sequence of str or int, or str, optional
        Two columns, or three for 3D, by name or by number from 0; ``"x,y"`` is
        ``("x", "y")``. Upper and lower case are the same, and so are ``x [m]`` and
        ``x``. By default the columns called x and y, or lon(gitude) and lat(itude), or
        east(ing) and north(ing); if no name is one of these, the first columns.
    dimension : {2, 3}, optional
        How many coordinates to read: by default as many as `columns`. Without these, 3
        if there is a column z beside x and y, as in most PLY and LAS files, or if an XYZ,
        NPY or NPZ file has three columns without names, unless all z are equal; else 2. So
        ``dimension=2`` leaves z out.
    file_format : str, optional
        One of :data:`POINT_FORMATS`, whatever the extension says.
    delimiter : str, optional
        What stands between the cells of a text; ``" "`` means runs of blanks. By
        default found in the file: tab, semicolon, comma, else blanks.
    header : bool or "auto"
        Whether the first line names the columns. By default it does if no cell of it
        is a number. Names in a comment just before the data are understood too.
    skip : int
        Lines to skip at the top of a text, besides comments and blank lines.
    comment : str or None
        The character that starts a comment in a text.
    decimal : {".", ","}
        The decimal mark in a text.
    encoding : str, optional
        The encoding of a text: by default UTF-8, or what its byte order mark says.
    key : str, optional
        The array in an NPZ file: by default ``points``, or the only one there is.

    Returns
    -------
    (n, dimension) float64 array
        In the order of the file, in its units. ``nan`` and ``inf`` written in the file
        are kept (no complex can be built from them); empty cells are errors.

    Raises
    ------
    FileReadError
        If the file cannot be opened, is damaged, cut off or not what its name says,
        lacks a column, or holds something other than a number where one is needed.
    ParameterError
        If a parameter has no possible value, or does not go with the format.
    MissingLibraryError
        For Parquet, LAS, LAZ or PCD, if the library that reads it is not installed.

    Examples
    --------
    >>> read_points("trees.csv", columns=("easting", "northing"))  # doctest: +SKIP
    """
    if not isinstance(path, str | os.PathLike):
        raise ParameterError(f"path must name a file, not be a {type(path).__name__}")
    options = TextOptions(delimiter, header, skip, comment, decimal, encoding)
    options.check()
    wanted = wanted_columns(columns, dimension)
    name = os.fspath(path)
    kind = _format_of(name, file_format)
    _refuse_idle(kind, options, key)
    wanted = wanted._replace(unnamed=kind in _UNNAMED)
    return without_flat_z(_read(open_source(name), kind, wanted, options, key), wanted)


def _read(
    source: Source,
    kind: str,
    wanted: Wanted,
    options: TextOptions,
    key: str | None,
) -> FloatArray:
    if kind in _TEXT:
        return read_text(source, wanted, options, _TEXT[kind])
    if source.compressed:
        raise source.failure(f"is a packed {kind.upper()} file; unpack it with gunzip first")
    if kind == "npz":
        return read_npz(source, wanted, key)
    return _BINARY[kind](source, wanted)


def _format_of(name: str, file_format: str | None) -> str:
    """Return the format that is asked for, or that the extension stands for."""
    if file_format is not None:
        kind = str(file_format).lower().removeprefix(".")
        if kind not in POINT_FORMATS:
            raise ParameterError(
                f"file_format={file_format!r} is unknown; choose one of "
                f"{', '.join(POINT_FORMATS)}"
            )
    elif name == "-":
        kind = "csv"
    else:
        kind = PurePath(name.lower().removesuffix(".gz")).suffix.removeprefix(".")
        if kind not in POINT_FORMATS:
            raise _unknown_format(name, kind)
    if name == "-" and kind not in _TEXT:
        raise ParameterError(f"standard input is read as text, not as {kind}; name a file")
    return kind


def _unknown_format(name: str, kind: str) -> FileReadError:
    known = ", ".join(POINT_FORMATS)
    if kind in _IMAGES:
        return FileReadError(f"{name} is an image; draw points from it with sample_mask")
    what = f"the extension .{kind}" if kind else "no extension"
    return FileReadError(
        f"{name} has {what}, which tells no format of points; known are: {known}; if it is "
        "one of them, pass file_format="
    )


def _refuse_idle(kind: str, options: TextOptions, key: str | None) -> None:
    """Refuse parameters that would do nothing, because their user expects otherwise."""
    if kind not in _TEXT and options != TextOptions():
        raise ParameterError(
            f"delimiter, header, skip, comment, decimal and encoding are for text tables; "
            f"this is {kind.upper()}: leave them out"
        )
    if kind != "npz" and key is not None:
        raise ParameterError(f"key= is for NPZ files; this is {kind.upper()}: leave it out")
