"""Read a cloud from a file of any usual format, with all that is known of its points."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import PurePath
from typing import TYPE_CHECKING, Any, Literal

from alphamesh._geopoints import point_table
from alphamesh.errors import CloudError, FileReadError, ParameterError
from alphamesh.io import _attributes
from alphamesh.io._columns import Columns, Wanted, wanted_columns, without_flat_z
from alphamesh.io._layout import TextOptions
from alphamesh.io._npy import read_npy, read_npz
from alphamesh.io._parquet import read_parquet
from alphamesh.io._ply import read_ply
from alphamesh.io._scans import read_las, read_pcd
from alphamesh.io._sources import Source, open_source
from alphamesh.io._text import read_text
from alphamesh.io.geo import GEO_FORMATS, read_geo
from alphamesh.io.molecules import MOLECULE_FORMATS, read_atoms
from alphamesh.table import PointTable

if TYPE_CHECKING:
    from alphamesh._arrays import FloatArray

__all__ = ["POINT_FORMATS", "read_points", "read_table"]

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
    **dict.fromkeys(MOLECULE_FORMATS, read_atoms),
}

# Where three columns without names are coordinates, as a rule.
_UNNAMED = frozenset({"xyz", "npy", "npz"})

_IMAGES = frozenset({"png", "jpg", "jpeg", "tif", "tiff", "gif", "bmp", "webp", "pgm", "pbm"})

_VECTOR = tuple(key[1:] for key in GEO_FORMATS if key[1:] not in ("parquet", "wkb"))

POINT_FORMATS: tuple[str, ...] = (
    *_TEXT,
    *("las", "laz", "npy", "npz", "parquet", "pcd", "ply"),
    *MOLECULE_FORMATS,
    *_VECTOR,
)
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
    layer: str | None = None,
) -> FloatArray:
    """Read the coordinates of points from a file.

    Text tables (CSV, TSV, TXT, DAT, XYZ; also packed as ``.gz``), NPY and NPZ, Parquet,
    the vertices of PLY files, ASCII or binary, the clouds of scanners: LAS and LAZ (with
    laspy), PCD (with pypcd4), the atoms of molecules: PDB and mmCIF (with gemmi), and the
    point layers of a GIS: GeoJSON, GeoPackage, FlatGeobuf, GeoParquet, shapefiles, WKT.

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
    layer : str, optional
        The layer of a GeoPackage: by default the only one there is.

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
        For Parquet, LAS, LAZ, PCD, molecules or files of a GIS, if the library that reads
        them is not installed.

    See Also
    --------
    read_table : all other columns, too.

    Examples
    --------
    >>> read_points("trees.csv", columns=("easting", "northing"))  # doctest: +SKIP
    """
    text = TextOptions(delimiter, header, skip, comment, decimal, encoding)
    return _request(
        path,
        columns=columns,
        dimension=dimension,
        file_format=file_format,
        text=text,
        key=key,
        layer=layer,
    ).points()


def read_table(  # noqa: PLR0913 (as read_points)
    path: str | os.PathLike[str],
    *,
    columns: Columns = None,
    dimension: int | None = None,
    file_format: str | None = None,
    key: str | None = None,
    layer: str | None = None,
    **text: Any,
) -> PointTable:
    """Read points from a file, with their other columns and their reference system.

    Parameters
    ----------
    path, columns, dimension, file_format, key, layer
        See :func:`read_points`, also for the errors. `columns` are those of the
        coordinates; all others are read, too.
    **text
        The options for text tables: `delimiter`, `header`, `skip`, `comment`, `decimal`
        and `encoding`.

    Returns
    -------
    PointTable
        Columns of text that hold numbers alone are numbers, NaN where a cell is empty or
        a usual mark of a missing number. Columns without a name are left out; so is the
        geometry of a GIS, which is the coordinates.

    Examples
    --------
    >>> table = read_table("trees.gpkg")  # doctest: +SKIP
    >>> shape = AlphaComplex(table).at()  # doctest: +SKIP
    >>> shape.region_values(table.columns["height"], "max")  # doctest: +SKIP
    """
    unknown = sorted(set(text) - set(TextOptions.__dataclass_fields__))
    if unknown:
        raise ParameterError(f"read_table has no option {unknown[0]!r}")
    options = TextOptions(**text)
    return _request(
        path,
        columns=columns,
        dimension=dimension,
        file_format=file_format,
        text=options,
        key=key,
        layer=layer,
    ).table()


@dataclass(frozen=True, slots=True)
class _Request:
    """A file of points, and what is said of it."""

    name: str
    kind: str
    wanted: Wanted
    text: TextOptions
    key: str | None
    layer: str | None

    def points(self) -> FloatArray:
        if self.kind in _VECTOR:
            return self._of_frame().points
        source = open_source(self.name)
        if self._has_geometry(source):
            return self._of_frame().points
        return self._points(source)

    def table(self) -> PointTable:
        if self.kind in _VECTOR:
            return self._of_frame()
        source = open_source(self.name)
        if self._has_geometry(source):
            return self._of_frame()
        points = self._points(source)
        if self.kind in _TEXT:
            others = _attributes.of_text(source, self.wanted, self.text, _TEXT[self.kind])
        else:
            others = _attributes.OF[self.kind](source, self.wanted, self.key)
        return PointTable(points, others)

    def _points(self, source: Source) -> FloatArray:
        return without_flat_z(self._coordinates(source), self.wanted)

    def _coordinates(self, source: Source) -> FloatArray:
        if self.kind in _TEXT:
            return read_text(source, self.wanted, self.text, _TEXT[self.kind])
        if source.compressed and self.kind not in MOLECULE_FORMATS:
            raise source.failure(
                f"is a packed {self.kind.upper()} file; unpack it with gunzip first"
            )
        if self.kind == "npz":
            return read_npz(source, self.wanted, self.key)
        return _BINARY[self.kind](source, self.wanted)

    def _has_geometry(self, source: Source) -> bool:
        return (
            self.kind == "parquet"
            and not self.wanted.columns
            and (_attributes.is_geoparquet(source))
        )

    def _of_frame(self) -> PointTable:
        frame = read_geo(self.name, layer=self.layer, file_format=self.kind)
        try:
            points = point_table(frame, self.wanted.dimension)
        except CloudError as error:
            raise FileReadError(f"{self.name}: {error}", rows=error.rows) from error
        return PointTable(points, frame, frame.crs)


def _request(  # noqa: PLR0913 (what read_points is given)
    path: str | os.PathLike[str],
    *,
    columns: Columns,
    dimension: int | None,
    file_format: str | None,
    text: TextOptions,
    key: str | None,
    layer: str | None,
) -> _Request:
    """Return what is asked for, if it goes together."""
    if not isinstance(path, str | os.PathLike):
        raise ParameterError(f"path must name a file, not be a {type(path).__name__}")
    text.check()
    wanted = wanted_columns(columns, dimension)
    name = os.fspath(path)
    kind = _format_of(name, file_format)
    _refuse_idle(kind, text, key, layer)
    if kind in _VECTOR and wanted.columns:
        raise ParameterError(
            f"columns= is for tables; the coordinates in {kind.upper()} files are those of "
            "the geometries: leave it out"
        )
    wanted = wanted._replace(unnamed=kind in _UNNAMED)
    return _Request(name, kind, wanted, text, key, layer)


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


def _refuse_idle(kind: str, options: TextOptions, key: str | None, layer: str | None) -> None:
    """Refuse parameters that would do nothing, because their user expects otherwise."""
    if kind not in _TEXT and options != TextOptions():
        raise ParameterError(
            f"delimiter, header, skip, comment, decimal and encoding are for text tables; "
            f"this is {kind.upper()}: leave them out"
        )
    if kind != "npz" and key is not None:
        raise ParameterError(f"key= is for NPZ files; this is {kind.upper()}: leave it out")
    if kind != "gpkg" and layer is not None:
        raise ParameterError(f"layer= is for GeoPackages; this is {kind.upper()}: leave it out")
