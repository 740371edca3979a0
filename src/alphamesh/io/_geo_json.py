"""GeoJSON, written without GDAL, which drops the last digits of some numbers."""

from __future__ import annotations

import json
import math
import warnings
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from alphamesh.io._geo_frames import with_named_index

__all__ = ["write_geojson"]


def write_geojson(frame: Any, temporary: Path, path: Path, layer: str | None) -> None:
    """Write a collection of features, one a line; every number reads back as the same."""
    import shapely

    table = with_named_index(frame)
    columns = table.drop(columns=table.geometry.name)
    names = [str(name) for name in columns.columns]
    geometries = shapely.to_geojson(table.geometry.to_numpy())
    head = {"type": "FeatureCollection", "name": path.stem} | _crs(table.crs)
    with temporary.open("w", encoding="utf-8") as file:
        file.write(json.dumps(head, ensure_ascii=False)[:-1] + ', "features": [\n')
        before = ""
        for values, geometry in zip(_rows(columns), geometries, strict=True):
            properties = json.dumps(dict(zip(names, values, strict=True)), ensure_ascii=False)
            file.write(
                f'{before}{{"type": "Feature", "properties": {properties}, '
                f'"geometry": {geometry or "null"}}}'
            )
            before = ",\n"
        file.write("\n]}\n")


def _crs(crs: Any) -> dict[str, Any]:
    """Return the member that names a reference system, as GeoJSON had it before 2016."""
    if crs is None:
        return {}
    authority = crs.to_authority()
    if authority is None:
        warnings.warn(
            f"GeoJSON names reference systems by an authority, and {crs.name!r} has none: it "
            "is left out",
            UserWarning,
            stacklevel=2,
        )
        return {}
    # In a file, longitudes come first.
    name = "OGC:1.3:CRS84" if authority == ("EPSG", "4326") else "{}::{}".format(*authority)
    return {"crs": {"type": "name", "properties": {"name": f"urn:ogc:def:crs:{name}"}}}


def _rows(columns: Any) -> Iterator[tuple[Any, ...]]:
    """Return the rows of a table in types that JSON has."""
    if len(columns.columns) == 0:
        return iter([()] * len(columns))
    return zip(*(_plain(columns.iloc[:, k]) for k in range(columns.shape[1])), strict=True)


def _plain(column: Any) -> list[Any]:
    """Return values as Python's own, times as text, and None for what is missing."""
    missing = column.isna().to_numpy(dtype=bool)
    if column.dtype.kind in "mM":
        values = column.astype(str).tolist()
    else:
        values = [v.item() if isinstance(v, np.generic) else v for v in column.tolist()]
    return [
        None if gone or (isinstance(value, float) and not math.isfinite(value)) else value
        for value, gone in zip(values, missing, strict=True)
    ]
