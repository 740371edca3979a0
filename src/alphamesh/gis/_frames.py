"""Shapes and points as tables of geopandas."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from alphamesh import _shapely
from alphamesh._geopoints import as_crs, geopandas
from alphamesh.aggregates import as_values
from alphamesh.errors import ParameterError
from alphamesh.table import PointTable, as_columns

if TYPE_CHECKING:
    from alphamesh._arrays import FloatArray
    from alphamesh.planar import PlanarShape

__all__ = ["point_frame", "shape_frame"]

_PURPOSE = "A table of geometries"


@dataclass(frozen=True, slots=True, kw_only=True)
class _Options:
    """What :func:`shape_frame` can be asked for."""

    crs: Any = None
    data: Any = None
    aggregate: Mapping[str, Any] | None = None
    elevation: Any = None
    simplify: float = 0.0
    smooth: int = 0


def shape_frame(shape: Any, what: str = "regions", **options: Any) -> Any:
    """Return a shape as a GeoDataFrame; see :meth:`alphamesh.AlphaShape.to_geopandas`."""
    if what not in _KINDS:
        raise ParameterError(
            f"there is no table of {what!r}; choose one of {', '.join(map(repr, _KINDS))}"
        )
    unknown = sorted(set(options) - set(_Options.__dataclass_fields__))
    if unknown:
        raise ParameterError(
            f"to_geopandas has no option {unknown[0]!r}; its options: "
            f"{', '.join(_Options.__dataclass_fields__)}"
        )
    library = geopandas(_PURPOSE)
    asked = _Options(**options)
    crs = _crs(shape, asked)
    outlined = what in ("regions", "shape")
    if not outlined and (asked.simplify or asked.smooth):
        raise ParameterError(f"simplify and smooth are for regions and shape, not for {what}")
    z = _elevation(shape, asked)
    columns, geometries = _KINDS[what](shape, asked)
    if z is not None:
        geometries = _raised(shape, geometries, z)
    return library.GeoDataFrame(columns, geometry=geometries, crs=crs)


def _crs(shape: PlanarShape, asked: _Options) -> Any:
    """Return the reference system of the shape, or the one that is said for it."""
    given = as_crs(asked.crs)
    if shape.crs is None:
        return given
    if given is not None and given != shape.crs:
        raise ParameterError(
            f"the points are in {shape.crs.name}, not in {given.name}: leave crs= out, and "
            "project the result with its to_crs()"
        )
    return shape.crs


# What each kind of table holds


def _regions(shape: PlanarShape, asked: _Options) -> tuple[dict[str, Any], Any]:
    regions = shape.regions
    columns: dict[str, Any] = {
        "region": np.arange(len(regions)),
        "area": regions.areas,
        "perimeter": regions.perimeters,
        "holes": regions.hole_counts,
        "triangles": regions.triangle_counts,
        "points": shape.region_values(np.zeros(len(shape.points)), "count"),
    }
    columns |= _aggregated(columns, asked, shape.region_values, len(shape.points))
    return columns, shape.polygons(simplify=asked.simplify, smooth=asked.smooth)


def _shape(shape: PlanarShape, asked: _Options) -> tuple[dict[str, Any], Any]:
    inside = shape.regions.vertex_labels >= 0
    columns: dict[str, Any] = {
        "radius": [shape.radius],
        "regions": [len(shape.regions)],
        "holes": [int(shape.regions.hole_counts.sum())],
        "area": [shape.area],
        "perimeter": [shape.perimeter],
        "triangles": [len(shape.triangles)],
        "points": [int(np.count_nonzero(inside))],
    }
    if asked.aggregate:
        from alphamesh.aggregates import reduced

        rows = np.flatnonzero(inside).astype(np.int32)
        ends = np.array([0, len(rows)])
        columns |= _aggregated(
            columns,
            asked,
            lambda values, how: reduced(values, rows, ends, how),
            len(shape.points),
        )
    whole = shape.geometry(simplify=asked.simplify, smooth=asked.smooth)
    return columns, [whole]


def _triangles(shape: PlanarShape, asked: _Options) -> tuple[dict[str, Any], Any]:
    inside = shape.kinds[2] > 0
    columns: dict[str, Any] = {
        "region": shape.regions.labels,
        "area": shape.filtration.triangle_areas.compress(inside),
        "radius": shape.filtration.radii[2].compress(inside),
    }
    columns |= _aggregated(columns, asked, shape.triangle_values, len(shape.points))
    shapely = _shapely.shapely_for(_PURPOSE)
    corners = shape.points.take(shape.triangles[:, [0, 1, 2, 0]], axis=0)
    return columns, shapely.polygons(corners) if len(corners) else []


def _points(shape: PlanarShape, asked: _Options) -> tuple[dict[str, Any], Any]:
    if asked.aggregate:
        raise ParameterError("points have their own values: leave aggregate= out")
    columns: dict[str, Any] = {"region": shape.regions.vertex_labels}
    given = {} if asked.data is None else as_columns(asked.data, len(shape.points))
    _refuse_twins(columns, given)
    columns |= given
    return columns, _shapely.shapely_for(_PURPOSE).points(shape.points)


_KINDS: dict[str, Callable[[Any, _Options], tuple[dict[str, Any], Any]]] = {
    "regions": _regions,
    "shape": _shape,
    "triangles": _triangles,
    "points": _points,
}


# Columns


def _aggregated(
    taken: Mapping[str, Any], asked: _Options, values_of: Callable[..., Any], count: int
) -> dict[str, Any]:
    """Return the columns that `aggregate` asks for."""
    if not asked.aggregate:
        return {}
    data = {} if asked.data is None else as_columns(asked.data, count)
    made = {}
    for name, ways in asked.aggregate.items():
        if name not in data:
            listed = ", ".join(map(repr, data)) or "none: pass them as data="
            raise ParameterError(f"there is no column {name!r} to aggregate; columns: {listed}")
        for how in [ways] if isinstance(ways, str) else ways:
            made[f"{name}_{how}"] = values_of(data[name], how)
    _refuse_twins(taken, made)
    return made


def _refuse_twins(taken: Mapping[str, Any], columns: Mapping[str, Any]) -> None:
    twins = sorted((set(taken) | {"geometry"}) & set(columns))
    if twins:
        raise ParameterError(
            f"the table has a column {twins[0]!r} of its own; rename that of the points"
        )


# Elevations


def _elevation(shape: PlanarShape, asked: _Options) -> FloatArray | None:
    """Return the elevation of each point, if it is asked for."""
    if asked.elevation is None:
        return None
    if asked.smooth:
        raise ParameterError(
            "smoothed outlines have corners that are no points, so they have no elevation: "
            "leave out smooth= or elevation="
        )
    given = asked.elevation
    if isinstance(given, str):
        data = {} if asked.data is None else as_columns(asked.data, len(shape.points))
        if given not in data:
            raise ParameterError(f"there is no column {given!r} of elevations in data=")
        given = data[given]
    z = as_values(given, len(shape.points))
    if z.dtype.kind not in "iuf":
        raise ParameterError(f"elevations must be numbers, not {z.dtype}")
    return z.astype(np.float64)


def _raised(shape: PlanarShape, geometries: Any, z: FloatArray) -> Any:
    """Return geometries with the elevations of the points that are their corners."""
    shapely = _shapely.shapely_for(_PURPOSE)
    if len(geometries) == 0:
        return geometries
    # Corners are points bit for bit, so equal numbers tell them; a sum makes -0 to 0.
    place = np.ascontiguousarray(shape.points + 0.0).view(np.complex128)[:, 0]
    distinct, first = np.unique(place, return_index=True)
    kind, corners, offsets = shapely.to_ragged_array(np.asarray(geometries, dtype=np.object_))
    flat = np.ascontiguousarray(corners + 0.0).view(np.complex128)[:, 0]
    heights = z.take(first.take(np.searchsorted(distinct, flat)))
    made: Any = shapely.from_ragged_array(kind, np.column_stack((corners, heights)), offsets)
    return made


def point_frame(table: PointTable) -> Any:
    """Return a table of points as a GeoDataFrame; see :meth:`PointTable.to_geopandas`."""
    library = geopandas(_PURPOSE)
    _refuse_twins({}, table.columns)
    points = _shapely.shapely_for(_PURPOSE).points(table.points)
    return library.GeoDataFrame(dict(table.columns), geometry=points, crs=table.crs)
