"""Kernels for weighted clouds: regular triangulations and the power values of simplices."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from alphamesh._kernels import _check_progress, _core, _too_large, resolve_threads
from alphamesh._kernels.space import _too_many

if TYPE_CHECKING:
    from collections.abc import Iterable

    from alphamesh._arrays import FloatArray, IntArray
    from alphamesh._kernels import Progress

__all__ = ["regular2", "regular3"]


def regular2(
    points: FloatArray,
    weights: FloatArray,
    threads: int | None = None,
    progress: Progress | None = None,
) -> tuple[
    IntArray | None,
    IntArray,
    tuple[IntArray, IntArray, IntArray],
    tuple[FloatArray, FloatArray, FloatArray],
    IntArray,
]:
    """Return all simplices of a weighted alpha complex in the plane, and their values.

    Parameters
    ----------
    points : (n, 2) float64, C-contiguous
    weights : (n,) float64
        Squared radii of balls.
    threads : int, optional
    progress : callable, optional
        Called with the fraction that is done, about ten times a second.

    Returns
    -------
    representative : (n,) int32 or None
        Of rows with equal coordinates the heaviest, the lowest of these; None if all
        points are distinct.
    hidden : (h,) int32
        Rows whose power cells are empty, ascending; rows that are merely equal to another
        one are none of them.
    simplices : (V,), (E, 2), (T, 3) int32
        Vertices, edges and triangles, each row ascending.
    radii : (V,), (E,), (T,) float64
        Signed roots of their power values.
    edge_triangles : (E, 2) int32
        The cofaces of each edge, -1 where there is none.

    Raises
    ------
    BadCoordinates
        If a number is not finite or their scales are too far apart. The core does not say
        which; :func:`alphamesh.points.coordinate_error` does.
    CloudTooLargeError
        If there are more points than 32-bit numbers of triangles can hold.
    """
    threads = resolve_threads(threads)
    _check_progress(progress)
    try:
        result = _core.regular2(points, weights, threads, progress)
    except _core.TooManyPoints:
        raise _too_large(len(points)) from None
    _close(result[1:])
    _, representative, hidden, triangles, triangle_radii, edges, edge_radii = result[:7]
    edge_triangles, vertices, vertex_radii = result[7:]
    simplices = vertices, edges, triangles
    return (
        representative,
        hidden,
        simplices,
        (vertex_radii, edge_radii, triangle_radii),
        edge_triangles,
    )


def regular3(
    points: FloatArray,
    weights: FloatArray,
    threads: int | None = None,
    progress: Progress | None = None,
) -> tuple[
    IntArray | None,
    IntArray,
    tuple[IntArray, IntArray, IntArray, IntArray],
    tuple[FloatArray, FloatArray, FloatArray, FloatArray],
    IntArray,
]:
    """Return all simplices of a weighted alpha complex in space, and their values.

    Parameters and errors are those of :func:`regular2`, for points in space.

    Returns
    -------
    representative : (n,) int32 or None
    hidden : (h,) int32
    simplices : (V,), (E, 2), (F, 3), (T, 4) int32
        Vertices, edges, triangles and tetrahedra, each row ascending.
    radii : (V,), (E,), (F,), (T,) float64
        Signed roots of their power values.
    triangle_tetrahedra : (F, 2) int32
        The cofaces of each triangle, -1 where there is none.
    """
    threads = resolve_threads(threads)
    _check_progress(progress)
    try:
        result = _core.regular3(points, weights, threads, progress)
    except _core.TooManyPoints:
        raise _too_many(points) from None
    _close(result[1:])
    _, representative, hidden, tetrahedra, tetrahedron_radii = result[:5]
    triangles, triangle_radii, triangle_tetrahedra = result[5:8]
    edges, edge_radii, vertices, vertex_radii = result[8:]
    simplices = vertices, edges, triangles, tetrahedra
    radii = vertex_radii, edge_radii, triangle_radii, tetrahedron_radii
    return representative, hidden, simplices, radii, triangle_tetrahedra


def _close(arrays: Iterable[Any]) -> None:
    """Close arrays to writing."""
    for array in arrays:
        if array is not None:
            array.setflags(write=False)
