"""Geometries with their numbers into GeoJSON and WKT, whole or not at all."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import click

from alphamesh.cli.types import File, ParamType
from alphamesh.errors import MissingLibraryError
from alphamesh.io._atomic import atomic_path

__all__ = ["CrsType", "FeatureFile", "need_shapely", "write_features"]

_FORMATS = (".geojson", ".json", ".wkt")


class FeatureFile(File):
    """A file of geometries to write."""

    what = "file of geometries"

    def formats(self) -> tuple[str, ...]:
        """Return the extensions of files of geometries."""
        return _FORMATS


class CrsType(ParamType):
    """A coordinate reference system by its number, as in ``EPSG:25832``."""

    name = "crs"

    def convert(
        self, value: Any, param: click.Parameter | None, ctx: click.Context | None
    ) -> str:
        """Return the system as ``AUTHORITY:CODE``."""
        found = re.fullmatch(r"(?:([A-Za-z]+):)?(\w+)", str(value).strip())
        if found is None or (found[1] is None and not found[2].isdigit()):
            self.fail(f"{value!r} is no reference system, such as EPSG:25832", param, ctx)
        return f"{(found[1] or 'EPSG').upper()}:{found[2]}"


def need_shapely() -> None:
    """Say before the work if shapely is missing."""
    try:
        import shapely  # noqa: F401
    except ImportError as error:
        raise MissingLibraryError.of("shapely", "geo", "Writing polygons") from error


def write_features(
    path: Path,
    geometries: Sequence[Any],
    columns: Mapping[str, Sequence[Any]],
    crs: str | None = None,
) -> None:
    """Write one feature for each geometry.

    Parameters
    ----------
    path : Path
        Its extension is one of `FeatureFile`.
    geometries : sequence of shapely geometries
    columns : mapping of str to sequence
        Properties of the features, in GeoJSON.
    crs : str, optional
        ``AUTHORITY:CODE``. RFC 7946 knows WGS 84 alone; any other is kept as the older
        member ``crs``, which GDAL and QGIS read.

    Raises
    ------
    FileWriteError
        If it cannot be written; nothing is left behind.
    """
    import shapely

    with atomic_path(path) as temporary, temporary.open("w", encoding="utf-8") as file:
        if path.suffix.lower() == ".wkt":
            # Without rounding, the shortest text that reads back as the same numbers.
            for line in shapely.to_wkt(list(geometries), rounding_precision=25):
                file.write(f"{line}\n")
            return
        file.write('{"type": "FeatureCollection", ')
        if crs is not None and crs not in {"EPSG:4326", "OGC:CRS84"}:
            authority, _, code = crs.partition(":")
            name = f"urn:ogc:def:crs:{authority}::{code}"
            file.write(f'"crs": {{"type": "name", "properties": {{"name": "{name}"}}}}, ')
        file.write('"features": [\n')
        rows = zip(*columns.values(), strict=True)
        shown = (json.dumps(dict(zip(columns, row, strict=True))) for row in rows)
        drawn = shapely.to_geojson(list(geometries))
        features = (
            f'{{"type": "Feature", "properties": {properties}, "geometry": {geometry}}}'
            for properties, geometry in zip(shown, drawn, strict=True)
        )
        for number, feature in enumerate(features):
            file.write(f"{',' if number else ''}{feature}\n")
        file.write("]}\n")
