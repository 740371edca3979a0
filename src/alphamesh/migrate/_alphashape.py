"""``alphashape.alphashape(points, alpha)``."""

from __future__ import annotations

from typing import Any

from alphamesh import _geopoints, _shapely
from alphamesh.complex import AlphaComplex
from alphamesh.complex3d import AlphaComplex3D
from alphamesh.errors import MissingLibraryError
from alphamesh.migrate._radius import alpha_of, just_below
from alphamesh.points import Cloud, as_cloud

__all__ = ["alphashape", "optimizealpha"]

_PURPOSE = "alphashape"


def alphashape(points: Any, alpha: float | None = None) -> Any:
    """Return the alpha shape of points, as ``alphashape.alphashape`` does.

    Parameters
    ----------
    points : array-like of shape (n, 2) or (n, 3), MultiPoint, GeoDataFrame or GeoSeries
    alpha : float, optional
        One over the radius: triangles, in space tetrahedra, of a radius below
        ``1 / alpha`` are kept. By default what :func:`optimizealpha` returns. 0 or less
        gives the convex hull, and so do fewer than four points.

    Returns
    -------
    shapely.Polygon, MultiPolygon, LineString, Point or GeometryCollection
        A GeoDataFrame of one row for a GeoDataFrame with a reference system.
    trimesh.Trimesh
        For four or more points in space: the boundary of the tetrahedra.

    Raises
    ------
    ParameterError
        If `alpha` is not a number.
    CloudShapeError, NonFiniteError, CoordinateRangeError
        If `points` are no points in the plane or in space.
    MissingLibraryError
        If shapely, or trimesh for points in space, is not installed.

    Notes
    -----
    Differences from alphashape 1.3:

    - Holes are kept. There they are filled, as it takes the union of all polygons that
      the boundary edges enclose. To fill them: ``shape.filtered(max_hole_area=inf)``.
    - Decisions are exact; there, Qhull and the radii are rounded.
    - `alpha` cannot be a function of the triangle.
    - In space, voids are kept there, too, and the triangles around them face into them; an
      `alpha` of 0 gives the convex hull in space, where alphashape has that in the plane.
    """
    cloud = _cloud(points)
    if cloud.points.shape[1] == 3 and len(cloud) >= 4:
        return _in_space(cloud, alpha)
    shapely = _shapely.shapely_for(_PURPOSE)
    few = len(cloud) < 4
    best = 0.0 if few or alpha is not None else optimizealpha(cloud)
    value = best if alpha is None else alpha_of(alpha)
    if few or value <= 0:
        made = shapely.convex_hull(shapely.multipoints(cloud.points))
    else:
        shape = AlphaComplex(Cloud(cloud.points)).at(just_below(value))
        made = shape.geometry()
        if len(shape.regions) == 1:
            made = shapely.get_geometry(made, 0)
        elif len(shape.regions) == 0:
            made = shapely.geometrycollections([])
    if cloud.crs is not None and hasattr(points, "columns"):
        return _geopoints.geopandas(_PURPOSE).GeoDataFrame(geometry=[made], crs=cloud.crs)
    return made


def _cloud(points: Any) -> Cloud:
    """Return the points, those of geometries without their z."""
    if isinstance(points, Cloud):
        return points
    is_geometry = hasattr(points, "geom_type") or hasattr(points, "crs")
    return as_cloud(points, 2 if is_geometry else None)


def _in_space(cloud: Cloud, alpha: float | None) -> Any:
    try:
        import trimesh
    except ImportError as error:
        raise MissingLibraryError.of("trimesh", "trimesh", "alphashape in space") from error
    value = optimizealpha(cloud) if alpha is None else alpha_of(alpha)
    shape = AlphaComplex3D(cloud.points).at(just_below(value))
    # As there: vertices in use, equal ones merged.
    return trimesh.Trimesh(vertices=shape.points, faces=shape.boundary_triangles)


def optimizealpha(points: Any) -> float:
    """Return the largest alpha that leaves no point out and gives one piece.

    Parameters
    ----------
    points : as for :func:`alphashape`

    Returns
    -------
    float
        0, for the convex hull, if there is none: where the points are on one line, or,
        in space, in one plane.

    Notes
    -----
    There, a bisection looks for it, and can miss it: the number of pieces can go up and
    down as alpha grows. With version 2 of shapely it fails. Here, it is the rule
    ``"one-region"`` of :func:`alphamesh.choose_radius`, in one pass.
    """
    cx = AlphaComplex(Cloud(_cloud(points).points))
    if cx.dimension < cx.points.shape[1]:
        return 0.0
    radius = cx.choose_radius("one-region").radius
    alpha = 1.0 / radius
    while just_below(alpha) < radius:  # its triangles are to be kept
        alpha -= alpha * 2.0**-53
    return alpha
