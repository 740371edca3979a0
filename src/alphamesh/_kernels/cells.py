"""Kernels of the convex hull, of point location and of Voronoi cells.

Those that take a finished triangulation suppose coordinates in the range that
:func:`alphamesh.measures.kernel_points` brings them into.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from alphamesh._arrays import read_only
from alphamesh._kernels import (
    Progress,
    _check_progress,
    _core,
    _too_large,
    resolve_threads,
)

if TYPE_CHECKING:
    from alphamesh._arrays import BoolArray, CountArray, FloatArray, IntArray

__all__ = ["hull2", "locate2", "restricted2", "rings2", "voronoi_vertices2"]


def hull2(points: FloatArray, *, collinear: bool, threads: int | None = None) -> IntArray:
    """Return the rows of the convex hull, counter-clockwise from the lexicographic minimum.

    Parameters
    ----------
    points : (n, 2) float64, C-contiguous
    collinear : bool
        Keep points between corners.
    threads : int, optional

    Returns
    -------
    (h,) int32
        Of points on one line the two ends, or the path if `collinear`.

    Raises
    ------
    BadCoordinates
        If a coordinate is not finite or their scales are too far apart.
    CloudTooLargeError
        If there are more points than 32-bit numbers of triangles can hold.
    """
    try:
        return read_only(_core.hull2(points, collinear, resolve_threads(threads)))
    except _core.TooManyPoints:
        raise _too_large(len(points)) from None


def locate2(
    points: FloatArray,
    triangles: IntArray,
    neighbors: IntArray,
    queries: FloatArray,
    threads: int | None = None,
) -> IntArray:
    """Return the lowest closed triangle that holds each query, -1 where none does.

    Parameters
    ----------
    points : (n, 2) float64, C-contiguous
    triangles, neighbors : (T, 3) int32
        A Delaunay triangulation, with nothing left out.
    queries : (m, 2) float64, C-contiguous
    threads : int, optional

    Returns
    -------
    (m,) int32

    Raises
    ------
    BadCoordinates
        If a coordinate is not finite or all of them together are too far apart in scale.
    """
    threads = resolve_threads(threads)
    return read_only(_core.locate2(points, triangles, neighbors, queries, threads))


def rings2(
    points: FloatArray,
    triangles: IntArray,
    edges: IntArray,
    edge_triangles: IntArray,
    threads: int | None = None,
) -> tuple[CountArray, IntArray, IntArray]:
    """Return what is around each point, counter-clockwise.

    Parameters
    ----------
    points : (n, 2) float64, C-contiguous
    triangles : (T, 3) int32
    edges, edge_triangles : (E, 2) int32
    threads : int, optional

    Returns
    -------
    offset : (n + 1,) int64
    edge : (2E,) int32
    triangle : (2E,) int32
        Between each edge and the next; -1 where the hull is in between.
    """
    threads = resolve_threads(threads)
    offset, edge, triangle = _core.rings2(points, triangles, edges, edge_triangles, threads)
    return read_only(offset), read_only(edge), read_only(triangle)


def voronoi_vertices2(  # noqa: PLR0913 (the arrays of a triangulation)
    points: FloatArray,
    triangles: IntArray,
    edges: IntArray,
    edge_triangles: IntArray,
    threads: int | None = None,
    *,
    weights: FloatArray | None = None,
) -> tuple[FloatArray, IntArray]:
    """Return the circumcentres of triangles; those of cocircular points are the same.

    Parameters are those of :func:`rings2`, and weights of the points: with these, vertices
    of the power diagram.

    Returns
    -------
    centres : (T, 2) float64
    group : (T,) int32
        The first triangle with the same circumcircle.
    """
    threads = resolve_threads(threads)
    masses = np.empty(0) if weights is None else weights
    result = _core.voronoi_vertices2(points, triangles, edges, edge_triangles, masses, threads)
    return read_only(result[0]), read_only(result[1])


def restricted2(  # noqa: PLR0913, PLR0917 (the arrays of a complex)
    points: FloatArray,
    triangles: IntArray,
    has_triangle: BoolArray,
    edges: IntArray,
    has_edge: BoolArray,
    edge_triangles: IntArray,
    active: BoolArray,
    radius: float,
    threads: int | None = None,
    progress: Progress | None = None,
    *,
    weights: FloatArray | None = None,
) -> tuple[Any, ...]:
    """Return the borders and measures of restricted Voronoi cells.

    Parameters
    ----------
    points : (n, 2) float64, C-contiguous
    triangles : (T, 3) int32
    has_triangle : (T,) bool
        Which triangles the alpha complex at `radius` has.
    edges : (E, 2) int32
    has_edge : (E,) bool
    edge_triangles : (E, 2) int32
    active : (n,) bool
        Which rows stand for themselves.
    radius : float
    threads : int, optional
    progress : callable, optional
    weights : (n,) float64, optional
        Squared radii of balls, to which the signed square of `radius` is added.

    Returns
    -------
    offset, start, end, neighbor, angles, straight_area, segment_length, arc_length
        See :class:`alphamesh.restricted.RestrictedVoronoi`. The area lacks the sectors over
        the arcs: half their length times the radius.
    """
    threads = resolve_threads(threads)
    _check_progress(progress)
    result = _core.restricted2(
        points,
        triangles,
        has_triangle,
        edges,
        has_edge,
        edge_triangles,
        active,
        radius,
        np.empty(0) if weights is None else weights,
        threads,
        progress,
    )
    return tuple(read_only(array) for array in result)
