"""Points of shapely and geopandas as tables of floats, or a refusal that names the rows."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from alphamesh import _shapely
from alphamesh.errors import (
    CloudShapeError,
    MissingLibraryError,
    ParameterError,
    rows_text,
)

if TYPE_CHECKING:
    from alphamesh._arrays import BoolArray, FloatArray

__all__ = ["as_crs", "crs_of", "geopandas", "holds_geometries", "point_table"]

_PURPOSE = "Reading points of geometries"
_DROP = "drop them: frame[~(frame.geometry.isna() | frame.geometry.is_empty)]"


def holds_geometries(points: Any) -> bool:
    """Whether this is a geometry, a table with a geometry column, or a list of geometries."""
    if isinstance(points, list | tuple) or (
        isinstance(points, np.ndarray) and points.dtype.kind == "O" and points.ndim == 1
    ):
        # None stands for a geometry that is not there; numbers and rows have no type.
        return any(hasattr(item, "geom_type") for item in points[:100])
    if hasattr(points, "geom_type"):
        return True
    return hasattr(points, "columns") and hasattr(points, "geometry")


def crs_of(points: Any) -> Any:
    """Return the coordinate reference system that comes with points, or None."""
    return getattr(points, "crs", None)


def as_crs(crs: Any) -> Any:
    """Return a coordinate reference system as a pyproj.CRS; None stays None.

    Parameters
    ----------
    crs : pyproj.CRS, str, int or None
        What ``pyproj.CRS.from_user_input`` takes: ``"EPSG:25832"``, ``25832``, WKT.

    Raises
    ------
    ParameterError
        If there is no such system.
    MissingLibraryError
        If pyproj is not installed.
    """
    if crs is None or hasattr(crs, "is_geographic"):
        return crs
    try:
        import pyproj
    except ImportError as missing:
        purpose = "A coordinate reference system"
        raise MissingLibraryError.of("pyproj", "geo", purpose) from missing
    try:
        return pyproj.CRS.from_user_input(crs)
    except pyproj.exceptions.CRSError as error:
        raise ParameterError(
            f"crs={crs!r} is no coordinate reference system that pyproj knows; "
            "give one such as 'EPSG:25832'"
        ) from error


def geopandas(purpose: str) -> Any:
    """Return the module geopandas.

    Raises
    ------
    MissingLibraryError
        If it is not installed; the message says that `purpose` needs it.
    """
    try:
        import geopandas as library
    except ImportError as missing:
        raise MissingLibraryError.of("geopandas", "geo", purpose) from missing
    return library


def point_table(points: Any, dimension: int = 2) -> FloatArray:
    """Return the coordinates of points, one row each, in the order they come.

    Parameters
    ----------
    points : GeoDataFrame, GeoSeries, array-like of shapely.Point, or one shapely.MultiPoint
    dimension : {2, 3}
        With 3, elevations too.

    Raises
    ------
    CloudShapeError
        If a geometry is no point, empty, missing or lacks an elevation.
    MissingLibraryError
        If shapely is not installed.
    """
    shapely = _shapely.shapely_for(_PURPOSE)
    geometries = _geometries(shapely, points)
    _refuse_missing(shapely.is_missing(geometries) | shapely.is_empty(geometries))
    _refuse_others(shapely, geometries)
    coordinates: FloatArray = shapely.get_coordinates(geometries, include_z=dimension == 3)
    if dimension == 3:
        _refuse_flat(~shapely.has_z(geometries))
    return np.ascontiguousarray(coordinates)


def _geometries(shapely: Any, points: Any) -> Any:
    """Return an array of geometries."""
    if hasattr(points, "columns"):
        points = points.geometry
    if isinstance(points, shapely.Geometry):
        if points.geom_type == "MultiPoint":
            return shapely.get_parts(points)
        points = [points]
    if isinstance(points, Sequence):
        made = np.empty(len(points), dtype=np.object_)
        made[:] = points
    else:
        made = np.array(points, dtype=np.object_)
    given = shapely.is_geometry(made)
    strange = [row for row in np.flatnonzero(~given).tolist() if not _is_nothing(made[row])]
    if strange:
        raise CloudShapeError(
            f"no geometry but a {type(made[strange[0]]).__name__} in "
            f"{rows_text(strange[:6], total=len(strange))}; give points of one kind",
            rows=strange[:6],
        )
    made[~given] = None  # also what pandas has for nothing
    return made


def _is_nothing(item: Any) -> bool:
    """Whether this is None, or what pandas puts in its place."""
    nan = isinstance(item, float) and item != item  # noqa: PLR0124
    return item is None or nan or type(item).__name__ == "NAType"


def _refuse_missing(missing: BoolArray) -> None:
    rows = np.flatnonzero(missing)
    if len(rows):
        raise CloudShapeError(
            f"no point, but an empty or missing geometry in "
            f"{rows_text(rows[:6], total=len(rows))} of {len(missing):,}; {_DROP}",
            rows=rows[:6],
        )


def _refuse_others(shapely: Any, geometries: Any) -> None:
    """Refuse all that are not points, with what turns the first one into points."""
    rows = np.flatnonzero(shapely.get_type_id(geometries) != int(shapely.GeometryType.POINT))
    if not len(rows):
        return
    kind = geometries[rows[0]].geom_type
    remedy = (
        "make one row of each point: frame.explode(ignore_index=True)"
        if kind == "MultiPoint"
        else "take their corners, shapely.get_coordinates(geometries), or one point of each, "
        "frame.representative_point()"
    )
    raise CloudShapeError(
        f"geometries that are not points in {rows_text(rows[:6], total=len(rows))} "
        f"(row {rows[0]} holds a {kind}); {remedy}",
        rows=rows[:6],
    )


def _refuse_flat(flat: BoolArray) -> None:
    rows = np.flatnonzero(flat)
    if len(rows):
        raise CloudShapeError(
            f"points without an elevation in {rows_text(rows[:6], total=len(rows))} of "
            f"{len(flat):,}; add it with shapely.force_3d, or read two coordinates",
            rows=rows[:6],
        )
