"""Files of geographic information: what each format holds, and tables written into one."""

from __future__ import annotations

import os
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from alphamesh.errors import (
    AlphameshError,
    FileReadError,
    FileWriteError,
    LossyFormatWarning,
    MissingLibraryError,
    ParameterError,
    user_stacklevel,
)
from alphamesh.io._atomic import atomic_path
from alphamesh.io._geo_json import write_geojson
from alphamesh.io._geo_plain import (
    read_geoparquet,
    read_wkb,
    read_wkt,
    write_geoparquet,
    write_wkb,
    write_wkt,
)
from alphamesh.io._geo_vector import (
    reader,
    write_flatgeobuf,
    write_geopackage,
    write_shapefile,
    write_zipped_shapefile,
)
from alphamesh.io._sources import read_failure

__all__ = ["GEO_FORMATS", "GeoFormat", "geo_format", "read_geo", "write_geo"]


@dataclass(frozen=True, slots=True)
class GeoFormat:
    """A file format of geographic information and what it can hold.

    Attributes
    ----------
    name : str
        As its users call it.
    note : str
        What to know about it.
    write, read : callable
        Its writer and reader; :func:`write_geo` and :func:`read_geo` are safer.
    layers : bool
        Whether a file can have several layers.
    columns : bool
        Whether columns and the reference system are stored, not geometries alone.
    """

    name: str
    note: str
    write: Callable[[Any, Path, Path, str | None], None] = field(repr=False)
    read: Callable[[Path, str | None], Any] = field(repr=False)
    layers: bool = False
    columns: bool = True


_GEOJSON = GeoFormat(
    "GeoJSON",
    "text; every number exact; the reference system is the member `crs`, which RFC 7946 no "
    "longer knows, but most programs do; without one, the file is read as WGS 84",
    write_geojson,
    reader("GeoJSON"),
)
_ZIPPED = GeoFormat(
    "zipped shapefile",
    "a shapefile in one zip archive, as GIS programs read it; with its limits",
    write_zipped_shapefile,
    reader("ESRI Shapefile"),
)

GEO_FORMATS: dict[str, GeoFormat] = {
    ".geojson": _GEOJSON,
    ".json": _GEOJSON,
    ".gpkg": GeoFormat(
        "GeoPackage",
        "one or several layers; with `layer` given, other layers of an existing file stay",
        write_geopackage,
        reader("GPKG"),
        layers=True,
    ),
    ".fgb": GeoFormat(
        "FlatGeobuf",
        "binary, fast to stream; written without an index, so that rows keep their order",
        write_flatgeobuf,
        reader("FlatGeobuf"),
    ),
    ".parquet": GeoFormat(
        "GeoParquet", "columnar; needs pyarrow", write_geoparquet, read_geoparquet
    ),
    ".shp": GeoFormat(
        "shapefile",
        "several files (.shp, .shx, .dbf, .prj, .cpg); one kind of geometry, names of ten "
        "letters, 254 letters of text, numbers of 15 decimals, no times, nothing empty",
        write_shapefile,
        reader("ESRI Shapefile"),
    ),
    ".zip": _ZIPPED,
    ".shz": _ZIPPED,
    ".wkt": GeoFormat(
        "WKT",
        "text, one geometry a line, every number exact; neither columns nor reference system",
        write_wkt,
        read_wkt,
        columns=False,
    ),
    ".wkb": GeoFormat(
        "WKB",
        "one geometry in binary: that of the only row, or a collection of those of all rows; "
        "neither columns nor reference system",
        write_wkb,
        read_wkb,
        columns=False,
    ),
}
"""The formats by file extension."""


def write_geo(
    frame: Any,
    path: str | os.PathLike[str],
    *,
    layer: str | None = None,
    file_format: str | None = None,
) -> None:
    """Write a table of geometries to a file, whole or not at all.

    :data:`GEO_FORMATS` tells what each format holds.

    Parameters
    ----------
    frame : GeoDataFrame, GeoSeries or PointTable
    path : path-like
        Where to; an existing file is replaced once the new one is complete.
    layer : str, optional
        The name of the layer; by default the name of the file. In a GeoPackage, a layer
        of that name is replaced and others stay; without `layer`, the file is replaced.
    file_format : str, optional
        A key of :data:`GEO_FORMATS`, with or without the dot; by default the extension
        of `path`.

    Raises
    ------
    FileWriteError
        If the extension is unknown, the file cannot be written, or the format cannot
        hold the table.
    ParameterError
        If `file_format` is unknown, `layer` does not go with it, or `frame` is no table
        of geometries.
    MissingLibraryError
        If geopandas, or pyogrio or pyarrow beneath it, is not installed.

    Warns
    -----
    LossyFormatWarning
        If the format shortens names or text, or changes the type of a column.
    """
    chosen = geo_format(path, file_format, layer=layer)
    table = _as_frame(frame)
    shown = f"'{os.fspath(path)}'"
    with _told_losses(shown), _translated(shown, chosen):
        if chosen.write is write_shapefile:  # several files: each beside its own target
            write_shapefile(table, Path(path), Path(path), layer)
            return
        with atomic_path(path) as temporary:
            chosen.write(table, temporary, Path(path), layer)


def _as_frame(frame: Any) -> Any:
    """Return a GeoDataFrame."""
    if hasattr(frame, "to_geopandas"):
        frame = frame.to_geopandas()
    if hasattr(frame, "geom_type") and hasattr(frame, "to_frame"):
        frame = frame.to_frame(frame.name or "geometry")
    # A plain DataFrame with such a column has no reference system, not even None.
    if not (hasattr(frame, "columns") and hasattr(frame, "geometry") and hasattr(frame, "crs")):
        raise ParameterError(
            "write_geo needs a GeoDataFrame, a GeoSeries or a PointTable, not a "
            f"{type(frame).__name__}; shape.to_geopandas() makes one"
        )
    return frame


@contextmanager
def _told_losses(shown: str) -> Iterator[None]:
    """Turn the warnings of GDAL into ours."""
    with warnings.catch_warnings(record=True) as noticed:
        warnings.simplefilter("always")
        yield
    for notice in noticed:
        if issubclass(notice.category, RuntimeWarning | UserWarning):
            told = f"{shown}: {notice.message}"
            warnings.warn(told, LossyFormatWarning, stacklevel=user_stacklevel())


@contextmanager
def _translated(shown: str, chosen: GeoFormat) -> Iterator[None]:
    """Turn whatever the libraries raise into a FileWriteError."""
    try:
        yield
    except (AlphameshError, OSError):
        raise
    except ImportError as missing:
        raise MissingLibraryError.of(
            missing.name or "pyogrio", "geo", f"Writing {chosen.name} files"
        ) from missing
    except Exception as error:  # GDAL refuses for reasons of its own, with types to match
        raise FileWriteError(
            f"cannot write {shown} as {chosen.name}: {error}; .gpkg and .parquet hold most"
        ) from error


def read_geo(
    path: str | os.PathLike[str], *, layer: str | None = None, file_format: str | None = None
) -> Any:
    """Read a table of geometries from a file.

    Parameters
    ----------
    path : path-like
    layer : str, optional
        Which layer; needed if there are several.
    file_format : str, optional
        A key of :data:`GEO_FORMATS`; by default the extension of `path`.

    Returns
    -------
    geopandas.GeoDataFrame

    Raises
    ------
    FileReadError
        If the file is missing, damaged, cut off or not what its name says, or has
        several layers and none is chosen.
    ParameterError
        If `file_format` is unknown, or `layer` does not go with it.
    MissingLibraryError
        If geopandas, or pyogrio or pyarrow beneath it, is not installed.
    """
    chosen = geo_format(path, file_format, layer=layer, reading=True)
    name = os.fspath(path)
    try:
        with Path(path).open("rb") as file:
            empty = not file.read(1)
    except OSError as error:
        raise read_failure(name, error) from error
    if empty:
        raise FileReadError(f"{name} is empty (0 bytes); was it written to the end?")
    try:
        return chosen.read(Path(path), layer)
    except AlphameshError:
        raise
    except ImportError as missing:
        raise MissingLibraryError.of(
            missing.name or "pyogrio", "geo", f"Reading {chosen.name} files"
        ) from missing
    except Exception as error:  # GDAL fails in any way on a file that is not as expected
        detail = str(error).partition("; It might help")[0].rstrip(".")
        raise FileReadError(
            f"{name} is not a complete {chosen.name} file ({detail or type(error).__name__}); "
            "write or copy it again"
        ) from error


def geo_format(
    path: str | os.PathLike[str],
    file_format: str | None = None,
    *,
    layer: str | None = None,
    reading: bool = False,
) -> GeoFormat:
    """Return the format of a file, from its name unless `file_format` says it.

    Parameters
    ----------
    path : path-like
    file_format : str, optional
        A key of :data:`GEO_FORMATS`, with or without the dot.
    layer : str, optional
        Checked to go with the format.
    reading : bool, default False
        Whether the file is to be read; only the error differs.

    Raises
    ------
    FileWriteError, FileReadError
        If the extension is unknown.
    ParameterError
        If `file_format` is unknown, or there are no layers in it.
    """
    known = ", ".join(GEO_FORMATS)
    if file_format is not None:
        key = "." + file_format.lower().removeprefix(".")
        if key not in GEO_FORMATS:
            raise ParameterError(f"unknown format {file_format!r}; there are {known}")
    else:
        key = Path(path).suffix.lower()
    if key not in GEO_FORMATS:
        what = f"the extension {key!r} is none of a GIS" if key else "it has no extension"
        verb, kind = ("read", FileReadError) if reading else ("write", FileWriteError)
        raise kind(f"cannot {verb} '{os.fspath(path)}': {what}; choose one of {known}")
    chosen = GEO_FORMATS[key]
    if layer is not None and not chosen.layers:
        raise ParameterError(
            f"layer= is for GeoPackages; {chosen.name} files have one layer: leave it out"
        )
    return chosen
