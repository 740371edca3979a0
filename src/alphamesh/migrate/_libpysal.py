"""``libpysal.cg.alpha_shape`` and ``alpha_shape_auto``."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from alphamesh import _geopoints, _shapely
from alphamesh.complex import AlphaComplex
from alphamesh.migrate._radius import alpha_of, just_below
from alphamesh.points import as_cloud
from alphamesh.radius import region_events

if TYPE_CHECKING:
    from alphamesh.filtration import Filtration

__all__ = ["alpha_shape", "alpha_shape_auto"]


def alpha_shape(xys: Any, alpha: float) -> Any:
    """Return the alpha shape of points, as ``libpysal.cg.alpha_shape`` does.

    Parameters
    ----------
    xys : array-like of shape (n, 2)
    alpha : float
        One over the radius: triangles of a radius below ``1 / alpha`` are kept.

    Returns
    -------
    geopandas.GeoSeries of Polygon
        Holes and all, the largest first.

    Raises
    ------
    ParameterError
        If `alpha` is not a number.
    CloudShapeError, NonFiniteError, CoordinateRangeError
        If `xys` are no points in the plane.
    MissingLibraryError
        If geopandas is not installed.

    Notes
    -----
    Differences from libpysal 4.14: the order of the polygons, the largest first here;
    three points or fewer give a GeoSeries too, where there is a Polygon; decisions are
    exact. A gap that several regions enclose by touching at points stays open here; there,
    polygonize fills it.
    """
    library = _geopoints.geopandas("alpha_shape")
    value = alpha_of(alpha)
    cloud = as_cloud(xys, 2)
    shape = AlphaComplex(cloud).at(just_below(value))
    return library.GeoSeries(shape.polygons(), crs=cloud.crs)


def alpha_shape_auto(
    xys: Any, step: int = 1, verbose: bool = False, return_radius: bool = False
) -> Any:
    """Return the tightest polygon around all points, as ``libpysal.cg`` does.

    From the largest radius down, as long as the triangles make one polygon, without
    holes, that holds all points.

    Parameters
    ----------
    xys : array-like of shape (n, 2)
    step : int, default 1
        Without effect: all radii are looked at in one pass, as with a step of 1 there.
    verbose : bool, default False
        Print the radius and alpha.
    return_radius : bool, default False
        Return the radius, too.

    Returns
    -------
    shapely.Polygon or list of Polygon and float
        An empty one for fewer than three points, or points on one line.

    Raises
    ------
    CloudShapeError, NonFiniteError, CoordinateRangeError
        If `xys` are no points in the plane.
    MissingLibraryError
        If shapely is not installed.

    Notes
    -----
    Differences from libpysal 4.14: there is no `return_circles`. There, 2e-16 is taken off
    ``1 / radius`` to keep the triangle of that radius. At radii below 1 that is less than
    the rounding, so that the triangle goes, and the search ends too early or fails; at
    large ones it keeps others, too. Points times 1024, for instance, give the same as
    here. For a shape with holes, or of several pieces: ``AlphaComplex(xys).at()``.
    """
    cx = AlphaComplex(as_cloud(xys, 2).points)
    shapely = _shapely.shapely_for("alpha_shape_auto")
    radius = _tightest(cx.filtration) if cx.dimension == 2 else 0.0
    parts = cx.at(radius).polygons()
    made = parts[0] if len(parts) else shapely.Polygon()
    if verbose:
        print(f"radius {radius:.6g}, alpha {1 / radius if radius else np.inf:.6g}")  # noqa: T201
    return [made, radius] if return_radius else made


def _tightest(filtration: Filtration) -> float:
    """Return the least radius down to which all points are in one polygon without holes.

    The triangles form one such polygon if they are one piece, connected by edges, and
    their vertices minus edges plus triangles are 1.
    """
    radii = np.unique(filtration.radii[2])
    begins, ends = region_events(filtration)
    corners = np.sort(filtration.vertex_intervals.regular_from)
    sides = np.sort(filtration.edge_intervals.regular_from)
    triangles = np.sort(filtration.radii[2])
    pieces, vertices, edges, faces = (
        np.searchsorted(events, radii, side="right")
        for events in (begins, corners, sides, triangles)
    )
    pieces = pieces - np.searchsorted(ends, radii, side="right")
    good = (pieces == 1) & (vertices - edges + faces == 1) & (vertices == len(corners))
    # At the last radius there is the convex hull.
    bad = np.flatnonzero(~good)
    return float(radii[bad[-1] + 1 if len(bad) else 0])
