"""Tables of geometries as GeoParquet, WKT and WKB, without GDAL."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from alphamesh._geopoints import geopandas
from alphamesh.errors import FileReadError, MissingLibraryError

__all__ = [
    "read_geoparquet",
    "read_wkb",
    "read_wkt",
    "write_geoparquet",
    "write_wkb",
    "write_wkt",
]


def write_geoparquet(frame: Any, temporary: Path, path: Path, layer: str | None) -> None:
    """Write a GeoParquet file; its index is kept if it has a name."""
    _require_pyarrow("Writing")
    named = any(name is not None for name in frame.index.names)
    frame.to_parquet(temporary, index=named or None)


def read_geoparquet(path: Path, layer: str | None) -> Any:
    """Read a GeoParquet file."""
    _require_pyarrow("Reading")
    frame = geopandas("Reading GeoParquet files").read_parquet(path)
    _refuse_bad_text(frame)
    return frame


def _refuse_bad_text(frame: Any) -> None:
    """Raise what pyarrow raises of text that is no UTF-8; pandas looks when it is used."""
    import pandas as pd
    import pyarrow as pa

    for number in range(frame.shape[1]):
        column = frame.iloc[:, number]
        if isinstance(column.dtype, pd.StringDtype):
            pa.array(column.array).validate(full=True)


def _require_pyarrow(doing: str) -> None:
    try:
        import pyarrow  # noqa: F401
    except ImportError as missing:
        raise MissingLibraryError.of("pyarrow", "io", f"{doing} GeoParquet files") from missing


def write_wkt(frame: Any, temporary: Path, path: Path, layer: str | None) -> None:
    """Write one geometry a line."""
    import shapely

    # Without rounding, the shortest text that reads back as the same numbers.
    lines = shapely.to_wkt(frame.geometry.to_numpy(), rounding_precision=25)
    temporary.write_text("".join(f"{line or ''}\n" for line in lines), encoding="ascii")


def read_wkt(path: Path, layer: str | None) -> Any:
    """Read one geometry from each line that is not blank."""
    import shapely

    try:
        text = path.read_text(encoding="utf-8-sig")
    except UnicodeDecodeError as error:
        raise FileReadError(f"{path} is not a text of WKT but binary ({error})") from error
    lines = [(number, line) for number, line in enumerate(text.splitlines(), 1) if line.strip()]
    found = shapely.from_wkt([line for _, line in lines], on_invalid="ignore")
    for (number, line), geometry in zip(lines, found, strict=True):
        if geometry is None:
            raise FileReadError(
                f"{path} is not a complete WKT file: line {number} holds no geometry "
                f"({line.strip()[:40]!r}); each line must hold one"
            )
    return geopandas("Reading WKT files").GeoDataFrame(geometry=found)


def write_wkb(frame: Any, temporary: Path, path: Path, layer: str | None) -> None:
    """Write the geometry of the only row, or all in one collection."""
    import shapely

    geometries = frame.geometry.to_numpy()
    if len(geometries) == 1 and geometries[0] is not None:
        whole = geometries[0]
    elif len(geometries) and (shapely.get_type_id(geometries) == _POLYGON).all():
        whole = shapely.multipolygons(geometries)
    else:
        whole = shapely.geometrycollections(geometries)
    temporary.write_bytes(shapely.to_wkb(whole, byte_order=1))


_POLYGON = 3


def read_wkb(path: Path, layer: str | None) -> Any:
    """Read the only geometry, into one row."""
    import shapely

    try:
        found = shapely.from_wkb(path.read_bytes())
    except shapely.errors.GEOSException as error:
        raise FileReadError(
            f"{path} is not a complete WKB file ({error}); write or copy it again"
        ) from error
    return geopandas("Reading WKB files").GeoDataFrame(
        geometry=np.array([found], dtype=np.object_)
    )
