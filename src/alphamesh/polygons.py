"""Outlines as polygons of shapely: exact ones, simplified ones, smoothed ones."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from alphamesh._shapely import shapely_for
from alphamesh.corners import Corners, corners_of, in_triangles
from alphamesh.errors import ParameterError

if TYPE_CHECKING:
    from alphamesh._arrays import BoolArray, CountArray, FloatArray, IntArray
    from alphamesh.outline import Rings

__all__ = ["collect", "joined", "polygons", "simplified", "smoothed"]

Geometries: TypeAlias = "np.ndarray[Any, np.dtype[np.object_]]"

_PURPOSE = "making polygons"


def polygons(rings: Rings) -> Geometries:
    """Return one polygon for each region, holes and all.

    Parameters
    ----------
    rings : Rings

    Returns
    -------
    (r,) array of shapely.Polygon
        Valid by construction. Outer rings run counter-clockwise, holes clockwise.
    """
    coordinates, offsets = rings.closed()
    return _made(coordinates, offsets, rings.region_offsets)


def _made(coordinates: FloatArray, offsets: CountArray, ring_offsets: CountArray) -> Geometries:
    shapely = shapely_for(_PURPOSE)
    if len(ring_offsets) == 1:
        return np.empty(0, dtype=np.object_)
    made: Geometries = shapely.from_ragged_array(
        shapely.GeometryType.POLYGON, coordinates, (offsets, ring_offsets)
    )
    return made


def joined(parts: Geometries) -> Any:
    """Return polygons as one shapely.MultiPolygon."""
    return shapely_for(_PURPOSE).multipolygons(parts)


def collect(parts: Geometries, points: FloatArray, edges: IntArray, vertices: IntArray) -> Any:
    """Return polygons, edges and vertices as one shapely.GeometryCollection.

    Parameters
    ----------
    parts : array of shapely.Polygon
    points : (n, 2) float64
    edges : (k, 2) int32
        Each becomes a LineString.
    vertices : (m,) int32
        Each becomes a Point.
    """
    shapely = shapely_for(_PURPOSE)
    lines = shapely.linestrings(points.take(edges, axis=0))
    alone = shapely.points(points.take(vertices, axis=0))
    return shapely.geometrycollections(np.concatenate((parts, lines, alone)))


# ---------------------------------------------------------------------- other outlines


def simplified(parts: Geometries, tolerance: float) -> Geometries:
    """Return polygons with fewer corners, by the method of Douglas and Peucker [1]_.

    Parameters
    ----------
    parts : array of shapely.Polygon
        Polygons that do not overlap.
    tolerance : float
        How far the new outline may lie from the old one, in the units of the points.

    Returns
    -------
    array of shapely.Polygon
        As many, each with as many holes. They are valid and do not overlap: a
        tolerance at which they would is halved.

    Raises
    ------
    ParameterError
        If `tolerance` is negative or not finite.

    References
    ----------
    .. [1] D. H. Douglas and T. K. Peucker, Algorithms for the reduction of the number of
       points required to represent a digitized line or its caricature, Cartographica 10
       (1973) 112-122.
    """
    if not (0 <= tolerance < np.inf):
        raise ParameterError(
            "simplify must be 0 or more, in the units of the points: how far the outline may "
            f"move; got {tolerance!r}"
        )
    shapely = shapely_for(_PURPOSE)
    whole = shapely.multipolygons(parts)
    while tolerance > 0:
        made = shapely.simplify(whole, tolerance, preserve_topology=True)
        found: Geometries = shapely.get_parts(made)
        kept = len(found) == len(parts) and shapely.is_valid(made)
        if kept and (_hole_counts(found) == _hole_counts(parts)).all():
            return found
        tolerance /= 2
    return parts


def _hole_counts(parts: Geometries) -> CountArray:
    counts: CountArray = shapely_for(_PURPOSE).get_num_interior_rings(parts)
    return counts


def smoothed(parts: Geometries, times: int) -> Geometries:
    """Return polygons with their corners cut, by the method of Chaikin [1]_.

    Each time, every corner gives way to two points, a quarter along the edges to its
    neighbours, so that the outline tends to a quadratic B-spline. A corner stays where
    polygons touch, or where it could not be cut without coming near to another part of
    the outline: where the triangle that it makes with its neighbours holds a corner.

    Parameters
    ----------
    parts : array of shapely.Polygon
        Polygons that do not overlap.
    times : int
        How often to cut; the number of corners doubles each time.

    Returns
    -------
    array of shapely.Polygon
        As many, each with as many holes; valid, and not overlapping.

    Raises
    ------
    ParameterError
        If `times` is not a whole number of 0 or more.

    References
    ----------
    .. [1] G. M. Chaikin, An algorithm for high-speed curve generation, Computer Graphics
       and Image Processing 3 (1974) 346-349.
    """
    given: Any = times
    if not isinstance(given, int | np.integer) or isinstance(given, bool) or given < 0:
        raise ParameterError(
            f"smooth must be a whole number of 0 or more, how often to cut; got {times!r}"
        )
    shapely = shapely_for(_PURPOSE)
    if times == 0 or len(parts) == 0:
        return parts
    _, closed, (offsets, ring_offsets) = shapely.to_ragged_array(parts)
    corners = corners_of(closed, offsets.astype(np.int64))
    corners = replace(corners, fixed=_held(corners))
    for _ in range(times):
        corners = corners.cut()
    made = _made(*corners.closed(), ring_offsets)
    # What rounding has made touch itself stays as it was.
    return np.where(shapely.is_valid(made), made, parts)


def _held(corners: Corners) -> BoolArray:
    """Return the corners that must stay: where rings touch, or something is too near."""
    shapely = shapely_for(_PURPOSE)
    # As complex numbers, points are told apart by one sort.
    plane = np.ascontiguousarray(corners.points).view(np.complex128)[:, 0]
    _, first, place, counts = np.unique(
        plane, return_index=True, return_inverse=True, return_counts=True
    )
    held: BoolArray = counts[place] > 1
    before, after = corners.neighbours()
    triangles = np.stack((before, corners.points, after), axis=1)
    boxes = shapely.box(*triangles.min(axis=1).T, *triangles.max(axis=1).T)
    points = corners.points[first]
    corner, near = shapely.STRtree(shapely.points(points)).query(boxes)
    foreign = (triangles[corner] != points[near, np.newaxis]).any(axis=2).all(axis=1)
    corner, near = corner[foreign], near[foreign]
    held[corner[in_triangles(triangles[corner], points[near])]] = True
    return held
