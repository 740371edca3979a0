"""Kernels for clouds in space: complexes, exact predicates, and what bounds what."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from alphamesh._kernels import _check_progress, _core, resolve_threads
from alphamesh.errors import CloudTooLargeError

if TYPE_CHECKING:
    from alphamesh._arrays import BoolArray, FloatArray, IntArray, KindArray
    from alphamesh._kernels import Progress

__all__ = [
    "alpha3",
    "delaunay3",
    "insphere3",
    "orient3",
    "parts3",
    "tetrahedron_triangles3",
    "triangle_edges3",
]

# The core numbers up to seven tetrahedra a point, four facets each, in 32 bits.
_MOST_POINTS = 2**26


def alpha3(
    points: FloatArray, threads: int | None = None, progress: Progress | None = None
) -> tuple[
    IntArray | None,
    tuple[IntArray, IntArray, IntArray],
    tuple[FloatArray, FloatArray, FloatArray],
    IntArray,
]:
    """Return all simplices of a 3D alpha complex and their filtration values.

    Parameters
    ----------
    points : (n, 3) float64, C-contiguous
    threads : int, optional
    progress : callable, optional
        Called with the fraction that is done, about ten times a second.

    Returns
    -------
    representative : (n,) int32 or None
        The lowest row with equal coordinates; None if all points are distinct.
    simplices : (E, 2), (F, 3), (T, 4) int32
        Edges, triangles and tetrahedra, each row ascending.
    radii : (E,), (F,), (T,) float64
    triangle_tetrahedra : (F, 2) int32
        The cofaces of each triangle, -1 where there is none.

    Raises
    ------
    BadCoordinates
        If a coordinate is not finite or their scales are too far apart. The core does
        not say which; :func:`alphamesh.points.coordinate_error` does.
    CloudTooLargeError
        If there are more points than 32-bit numbers of tetrahedra can hold.
    """
    threads = resolve_threads(threads)
    _check_progress(progress)
    try:
        result = _core.alpha3(points, threads, progress)
    except _core.TooManyPoints:
        raise _too_many(points) from None
    for array in result[1:]:
        if array is not None:
            array.setflags(write=False)
    representative, triangle_tetrahedra = result[1], result[6]
    simplices = result[7], result[4], result[2]
    radii = result[8], result[5], result[3]
    return representative, simplices, radii, triangle_tetrahedra


def delaunay3(
    points: FloatArray, threads: int | None = None, progress: Progress | None = None
) -> tuple[IntArray | None, IntArray, IntArray]:
    """Return the tetrahedra of a Delaunay triangulation, those of `alpha3`, and neighbours.

    Parameters and errors are those of `alpha3`.

    Returns
    -------
    representative : (n,) int32 or None
    tetrahedra : (T, 4) int32
        Each row ascending.
    neighbors : (T, 4) int32
        The tetrahedron beyond the triangle opposite to each corner, -1 where there is none.
    """
    threads = resolve_threads(threads)
    _check_progress(progress)
    try:
        result = _core.delaunay3(points, threads, progress)
    except _core.TooManyPoints:
        raise _too_many(points) from None
    _, representative, tetrahedra, neighbors = result
    for array in result[1:]:
        if array is not None:
            array.setflags(write=False)
    return representative, tetrahedra, neighbors


def _too_many(points: FloatArray) -> CloudTooLargeError:
    return CloudTooLargeError(
        f"{len(points):,} points are more than the {_MOST_POINTS:,} that 32-bit numbers "
        "of tetrahedra can hold; thin the cloud out, or split it into parts"
    )


def orient3(corners: FloatArray) -> KindArray:
    """Return the exact sign of ``det(b - a, c - a, d - a)`` of each row a, b, c, d.

    Parameters
    ----------
    corners : (k, 4, 3) float64

    Returns
    -------
    (k,) int8
        +1 where d sees a, b, c run clockwise; such a tetrahedron is positively oriented.
    """
    return _core.orient3(np.ascontiguousarray(corners, dtype=np.float64))


def insphere3(corners: FloatArray, *, perturb: bool) -> KindArray:
    """Return on which side of a sphere the fifth point of each row lies: +1 inside.

    Parameters
    ----------
    corners : (k, 5, 3) float64
        Four points of the sphere, positively oriented, then the point in question.
    perturb : bool
        Break ties by the symbolic perturbation of the triangulation; otherwise 0.

    Returns
    -------
    (k,) int8
    """
    return _core.insphere3(np.ascontiguousarray(corners, dtype=np.float64), perturb)


def tetrahedron_triangles3(
    tetrahedra: IntArray,
    triangles: IntArray,
    triangle_tetrahedra: IntArray,
    threads: int | None = None,
) -> IntArray:
    """Return the number of the triangle opposite to each vertex of each tetrahedron.

    Parameters
    ----------
    tetrahedra : (T, 4) int32
    triangles : (F, 3) int32
    triangle_tetrahedra : (F, 2) int32
    threads : int, optional

    Returns
    -------
    (T, 4) int32
    """
    faces = _core.tetrahedron_triangles3(
        tetrahedra, triangles, triangle_tetrahedra, resolve_threads(threads)
    )
    faces.setflags(write=False)
    return faces


def triangle_edges3(
    n: int, triangles: IntArray, edges: IntArray, threads: int | None = None
) -> IntArray:
    """Return the number of the edge opposite to each vertex of each triangle.

    Parameters
    ----------
    n : int
        Number of points; all numbers in the arrays are below.
    triangles : (F, 3) int32
    edges : (E, 2) int32
    threads : int, optional

    Returns
    -------
    (F, 3) int32
    """
    faces = _core.triangle_edges3(n, triangles, edges, resolve_threads(threads))
    faces.setflags(write=False)
    return faces


def parts3(triangle_tetrahedra: IntArray, inside: BoolArray, wall: BoolArray) -> IntArray:
    """Return numbers of the connected parts of some tetrahedra, and of the others.

    Tetrahedra are connected by triangles, not by edges.

    Parameters
    ----------
    triangle_tetrahedra : (F, 2) int32
    inside : (T,) bool
    wall : (F,) bool
        Triangles that connect nothing but the inside.

    Returns
    -------
    (T,) int32
        Parts of the inside are 0, 1, ... in the order of their first tetrahedra; of the
        others, -1 is around everything, and enclosed ones are -2, -3, ...
    """
    parts = _core.parts3(triangle_tetrahedra, inside, wall)
    parts.setflags(write=False)
    return parts
