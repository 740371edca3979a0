"""The seam to the compiled core: clean arrays in, read-only arrays out.

Nothing here knows what a cloud or a complex is. Arguments that the core could choke on
are checked, exceptions become typed errors, and every result is closed to writing.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from alphamesh.errors import CloudTooLargeError, ParameterError

try:
    from alphamesh._kernels import _core
    from alphamesh._kernels._core import BadCoordinates
except ImportError as error:
    raise ImportError(
        "alphamesh was installed without its compiled core (alphamesh._kernels._core); "
        "install it again with: pip install --force-reinstall alphamesh "
        "(from a checkout: pip install .)"
    ) from error

if TYPE_CHECKING:
    from alphamesh._arrays import FloatArray, IntArray, KindArray

__all__ = [
    "BadCoordinates",
    "Progress",
    "alpha2",
    "delaunay2",
    "dot2",
    "incircle2",
    "orient2",
    "persistence2",
    "resolve_threads",
    "self_test",
    "triangle_edges2",
    "trim_memory",
]

Progress: TypeAlias = Callable[[float], object]

# Results do not depend on the number of threads, so a wild request is simply bounded.
_MOST_THREADS = 256


def resolve_threads(threads: int | None) -> int:
    """Return how many threads to use: `threads`, or one for each CPU that we may use.

    Raises
    ------
    ParameterError
        If `threads` is neither None nor a whole number of at least 1.
    """
    if threads is None:
        if hasattr(os, "sched_getaffinity"):
            return len(os.sched_getaffinity(0))
        return os.cpu_count() or 1
    given: Any = threads
    if not isinstance(given, int | np.integer) or isinstance(given, bool) or given < 1:
        raise ParameterError(
            "threads must be a whole number of at least 1, or None for every CPU; "
            f"got {threads!r}"
        )
    return min(int(given), _MOST_THREADS)


def alpha2(
    points: FloatArray, threads: int | None = None, progress: Progress | None = None
) -> tuple[IntArray | None, IntArray, FloatArray, IntArray, FloatArray, IntArray]:
    """Return all simplices of a 2D alpha complex and their filtration values.

    Parameters
    ----------
    points : (n, 2) float64, C-contiguous
    threads : int, optional
    progress : callable, optional
        Called with the fraction that is done, about ten times a second.

    Returns
    -------
    representative : (n,) int32 or None
        The lowest row with equal coordinates; None if all points are distinct.
    triangles : (T, 3) int32
    triangle_radii : (T,) float64
    edges : (E, 2) int32
    edge_radii : (E,) float64
    edge_triangles : (E, 2) int32
        The cofaces of each edge, -1 where there is none.

    Raises
    ------
    BadCoordinates
        If a coordinate is not finite or their scales are too far apart. The core does
        not say which; :func:`alphamesh.points.coordinate_error` does.
    CloudTooLargeError
        If there are more points than 32-bit numbers of triangles can hold.
    """
    threads = resolve_threads(threads)
    _check_progress(progress)
    try:
        result = _core.alpha2(points, threads, progress)
    except _core.TooManyPoints:
        raise _too_large(len(points)) from None
    for array in result:
        if array is not None:
            array.setflags(write=False)
    return result


def delaunay2(
    points: FloatArray, threads: int | None = None, progress: Progress | None = None
) -> tuple[IntArray | None, IntArray, IntArray, IntArray]:
    """Return the Delaunay triangulation of a 2D cloud: no filtration values.

    Parameters and errors are those of :func:`alpha2`.

    Returns
    -------
    representative : (n,) int32 or None
    triangles : (T, 3) int32
    neighbors : (T, 3) int32
        ``neighbors[t, j]`` lies opposite to vertex j of row t; -1 on the hull.
    path : (E, 2) int32
        The edges of a cloud on one line; otherwise empty.
    """
    threads = resolve_threads(threads)
    _check_progress(progress)
    try:
        result = _core.delaunay2(points, threads, progress)
    except _core.TooManyPoints:
        raise _too_large(len(points)) from None
    for array in result:
        if array is not None:
            array.setflags(write=False)
    return result


def orient2(corners: FloatArray) -> KindArray:
    """Return the exact orientation of each triple: +1 for counter-clockwise.

    Parameters
    ----------
    corners : (k, 3, 2) float64

    Returns
    -------
    (k,) int8
    """
    return _core.orient2(np.ascontiguousarray(corners, dtype=np.float64))


def incircle2(corners: FloatArray, *, perturb: bool) -> KindArray:
    """Return on which side of a circle the fourth point of each row lies: +1 inside.

    Parameters
    ----------
    corners : (k, 4, 2) float64
        Three counter-clockwise points of the circle, then the point in question.
    perturb : bool
        Break ties by the symbolic perturbation of the triangulation; otherwise 0.

    Returns
    -------
    (k,) int8
    """
    return _core.incircle2(np.ascontiguousarray(corners, dtype=np.float64), perturb)


def dot2(corners: FloatArray) -> KindArray:
    """Return the exact sign of ``(a - c) . (b - c)`` for each row a, b, c.

    Parameters
    ----------
    corners : (k, 3, 2) float64

    Returns
    -------
    (k,) int8
        +1 where the angle at c is acute, 0 where right, -1 where obtuse.
    """
    return _core.dot2(np.ascontiguousarray(corners, dtype=np.float64))


def persistence2(  # noqa: PLR0913, PLR0917 (the arrays of a filtration)
    points: FloatArray,
    triangles: IntArray,
    triangle_radii: FloatArray,
    edges: IntArray,
    edge_radii: FloatArray,
    edge_triangles: IntArray,
    threads: int | None = None,
    progress: Progress | None = None,
    *,
    births: FloatArray | None = None,
) -> tuple[IntArray, IntArray]:
    """Return the simplices that begin and end each class of a 2D filtration.

    Parameters
    ----------
    points : (n, 2) float64, C-contiguous
    triangles : (T, 3) int32
    triangle_radii : (T,) float64
    edges : (E, 2) int32
    edge_radii : (E,) float64
    edge_triangles : (E, 2) int32
    threads : int, optional
    progress : callable, optional
    births : (n,) float64, optional
        When each point joins; by default all at once. Of two equally old ones, the lower
        row is older.

    Returns
    -------
    components : (k, 2) int32
        Row of a point, number of the edge that joins its component to an older one.
    loops : (m, 2) int32
        Number of an edge, number of the triangle that fills its loop.
    """
    threads = resolve_threads(threads)
    _check_progress(progress)
    pairs = _core.persistence2(
        points,
        triangles,
        triangle_radii,
        edges,
        edge_radii,
        edge_triangles,
        np.empty(0) if births is None else births,
        threads,
        progress,
    )
    for array in pairs:
        array.setflags(write=False)
    return pairs


def triangle_edges2(
    points: FloatArray,
    triangles: IntArray,
    edges: IntArray,
    edge_triangles: IntArray,
    threads: int | None = None,
) -> IntArray:
    """Return the number of the edge opposite to each corner of each triangle.

    Parameters
    ----------
    points : (n, 2) float64, C-contiguous
    triangles : (T, 3) int32
    edges : (E, 2) int32
    edge_triangles : (E, 2) int32
    threads : int, optional

    Returns
    -------
    (T, 3) int32
    """
    threads = resolve_threads(threads)
    sides = _core.triangle_edges2(points, triangles, edges, edge_triangles, threads)
    sides.setflags(write=False)
    return sides


def self_test() -> str:
    """Return '' if floating-point arithmetic works as the core needs it, else why not."""
    return _core.self_test()


def trim_memory() -> None:
    """Give memory that is kept for the next call back to the system.

    The core keeps up to an eighth of the machine's memory, 2 GiB at most, of what earlier
    calls have freed, as fresh pages cost up to a third of a call on a large cloud. The
    system may take it whenever it needs some; until then it counts as that of the process.
    Results that you hold are not touched.

    Examples
    --------
    >>> import alphamesh as am
    >>> am.trim_memory()
    """
    _core.trim_memory()


def _check_progress(progress: Progress | None) -> None:
    if progress is not None and not callable(progress):
        raise ParameterError(
            f"progress must be None or a function of one number; got {progress!r}"
        )


def _too_large(n: int) -> CloudTooLargeError:
    return CloudTooLargeError(
        f"{n:,} points are more than the {2**27:,} that 32-bit triangle numbers can hold; "
        "thin the cloud out, or split it into parts"
    )
