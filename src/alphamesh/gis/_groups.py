"""One shape for each group of points."""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np

from alphamesh import _geopoints, _shapely
from alphamesh.complex import AlphaComplex
from alphamesh.errors import CloudShapeError, ParameterError
from alphamesh.points import Cloud, coordinate_error, warn_of_degrees
from alphamesh.radius import DEFAULT_RULE, rule_names

if TYPE_CHECKING:
    from alphamesh.shape import AlphaShape

__all__ = ["alpha_shapes"]

_AUTO = "auto"


def alpha_shapes(  # noqa: PLR0913 (each option is of use alone)
    frame: Any,
    by: str | list[str] | None = None,
    radius: float | str = _AUTO,
    *,
    collection: bool = False,
    simplify: float = 0.0,
    smooth: int = 0,
    threads: int | None = None,
    progress: Callable[[float], Any] | None = None,
) -> Any:
    """Return the alpha shape of each group of points in a table.

    Parameters
    ----------
    frame : geopandas.GeoDataFrame or GeoSeries
        Points, in a projected reference system.
    by : str or list of str, optional
        The column, or columns, whose values make the groups; rows where one is missing
        belong to none. By default, all points are one group.
    radius : float or str, default "auto"
        One radius for all groups, in the units of the points; or the name of a rule
        that chooses one for each group (see :func:`alphamesh.choose_radius`). ``"auto"``
        is the default rule. For groups of a few points ``"all-points"`` is a good
        choice: no point is left out.
    collection : bool, default False
        Take in what belongs to no triangle, too: a group of one place then is a Point,
        one of two places a LineString. By default every geometry is a MultiPolygon,
        which all formats hold, and is empty for such groups.
    simplify, smooth : optional
        See :meth:`alphamesh.AlphaShape.polygons`.
    threads : int, optional
        Threads to use for each group.
    progress : callable, optional
        Called with the fraction of the points that is done, from 0 to 1.

    Returns
    -------
    geopandas.GeoDataFrame
        A row for each group, in ascending order: the columns of `by`, ``points`` (how
        many the group has), ``radius``, ``regions``, ``holes``, ``area``, ``perimeter``
        and ``geometry``, in the reference system of `frame`.

    Raises
    ------
    CloudShapeError
        If a geometry is not a Point; rows are those of `frame`.
    ParameterError
        If there is no such column or rule, or the radius is negative.
    MissingLibraryError
        If geopandas is not installed.

    Warns
    -----
    GeographicCoordinatesWarning
        If the points are longitudes and latitudes.

    Examples
    --------
    >>> ranges = alpha_shapes(sightings, by="species", radius=2000)  # doctest: +SKIP
    """
    library = _geopoints.geopandas("Shapes of groups")
    keys = [by] if isinstance(by, str) else list(by or [])
    table = _checked(frame, keys)
    rule = _rule(radius)
    points = _geopoints.point_table(table)
    if not np.isfinite(points).all():
        raise coordinate_error(points)
    crs = _geopoints.crs_of(table)
    warn_of_degrees(Cloud(points, crs))
    groups = _groups(table, keys)
    facts, geometries, done = [], [], 0
    for rows in groups:
        share = _share(progress, done, len(rows), len(points))
        cx = AlphaComplex(points.take(rows, axis=0), threads=threads, progress=share)
        # A rule is a name here, a radius a number.
        shape = cx.at(cx.choose_radius(rule).radius if rule else radius)  # type: ignore[arg-type]
        facts.append((len(rows), *_facts(shape)))
        geometries.append(_geometry(shape, collection, simplify, smooth))
        done += len(rows)
    if progress is not None:
        progress(1.0)
    # Without keys there is one group, of no point perhaps.
    made = table[keys].iloc[[rows[0] for rows in groups] if keys else [0][: len(table)]]
    made = made.reset_index(drop=True)
    for k, name in enumerate(_FACTS):
        made[name] = [fact[k] for fact in facts]
    return library.GeoDataFrame(made, geometry=geometries, crs=crs)


def _checked(frame: Any, keys: list[str]) -> Any:
    """Return a table with a geometry column and the columns that make groups."""
    if hasattr(frame, "geom_type") and hasattr(frame, "to_frame"):
        frame = frame.to_frame("geometry")
    if not (hasattr(frame, "columns") and hasattr(frame, "geometry")):
        raise CloudShapeError(
            f"alpha_shapes needs a GeoDataFrame of points, not a {type(frame).__name__}; make "
            "one with geopandas.GeoDataFrame(df, geometry=geopandas.points_from_xy(df.x, df.y),"
            " crs=...)"
        )
    for key in keys:
        if key not in frame.columns or key == frame.geometry.name:
            listed = ", ".join(repr(str(name)) for name in frame.columns[:12])
            raise ParameterError(f"there is no column {key!r} to group by; columns: {listed}")
        if key in (*_FACTS, "geometry"):
            raise ParameterError(f"the result has a column {key!r} of its own; rename yours")
    return frame


def _rule(radius: float | str) -> str | None:
    """Return the name of the rule that is asked for, None for a number."""
    if not isinstance(radius, str):
        return None
    rule = DEFAULT_RULE if radius == _AUTO else radius
    if rule not in rule_names():
        listed = ", ".join(map(repr, (_AUTO, *rule_names())))
        raise ParameterError(f"radius={radius!r} is neither a number nor a rule: {listed}")
    return rule


def _groups(table: Any, keys: list[str]) -> list[Any]:
    """Return the rows of each group, ascending, the groups in the order of their keys."""
    if not keys:
        return [np.arange(len(table))]
    grouped = table.groupby(keys, sort=True, dropna=True, observed=True)
    codes = grouped.ngroup().fillna(-1).to_numpy(dtype=np.int64)  # NaN: in no group
    order = np.argsort(codes, kind="stable")
    starts = np.searchsorted(codes[order], np.arange(int(codes.max(initial=-1)) + 2))
    return [order[i:j] for i, j in pairwise(starts)]


def _share(
    progress: Callable[[float], Any] | None, done: int, count: int, total: int
) -> Callable[[float], Any] | None:
    """Return what tells of the progress of one group in that of all."""
    if progress is None:
        return None
    return lambda fraction: progress((done + fraction * count) / total)


_FACTS = ("points", "radius", "regions", "holes", "area", "perimeter")


def _facts(shape: AlphaShape) -> tuple[float, int, int, float, float]:
    holes = int(shape.regions.hole_counts.sum())
    return shape.radius, len(shape.regions), holes, shape.area, shape.perimeter


def _geometry(shape: AlphaShape, collection: bool, simplify: float, smooth: int) -> Any:
    """Return a shape as a MultiPolygon, or else as the simplest geometry of all of it."""
    whole = shape.geometry(collection=collection, simplify=simplify, smooth=smooth)
    if not collection:
        return whole
    shapely = _shapely.shapely_for("Shapes of groups")
    parts = shapely.get_parts(whole)
    kinds = shapely.get_dimensions(parts)
    polygons, lines, places = (parts[kinds == dimension] for dimension in (2, 1, 0))
    merged = shapely.get_parts(shapely.line_merge(shapely.multilinestrings(lines)))
    simplest = np.concatenate((polygons, merged, places))
    if len(simplest) == 1:
        return simplest[0]
    gathered = {len(polygons): 2, len(merged): 1, len(places): 0}.get(len(simplest))
    if gathered is None or len(simplest) == 0:
        return shapely.geometrycollections(simplest)
    many = (shapely.multipoints, shapely.multilinestrings, shapely.multipolygons)
    return many[gathered](simplest)
