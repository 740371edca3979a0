"""Kernels for topology: classes of homology in space, and connected components."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from alphamesh._kernels import _check_progress, _core, resolve_threads

if TYPE_CHECKING:
    from alphamesh._arrays import FloatArray, IntArray
    from alphamesh._kernels import Progress

__all__ = ["component_count", "persistence3"]


def persistence3(  # noqa: PLR0913, PLR0917 (the arrays of a filtration)
    n: int,
    edges: IntArray,
    edge_radii: FloatArray,
    triangle_edges: IntArray,
    triangle_radii: FloatArray,
    triangle_tetrahedra: IntArray,
    tetrahedron_radii: FloatArray,
    threads: int | None = None,
    progress: Progress | None = None,
    *,
    births: FloatArray | None = None,
) -> tuple[IntArray, IntArray, IntArray]:
    """Return the simplices that begin and end each class of a 3D filtration.

    Parameters
    ----------
    n : int
        Number of points; all rows of points are below.
    edges : (E, 2) int32
    edge_radii : (E,) float64
    triangle_edges : (F, 3) int32
    triangle_radii : (F,) float64
    triangle_tetrahedra : (F, 2) int32
    tetrahedron_radii : (T,) float64
    threads : int, optional
    progress : callable, optional
    births : (n,) float64, optional
        When each point joins; by default all at once. Of two equally old ones, the lower
        row is older.

    Returns
    -------
    components : (k, 2) int32
        Row of a point, number of the edge that joins its component to an older one.
    loops : (l, 2) int32
        Number of an edge, number of the triangle that fills its loop.
    voids : (m, 2) int32
        Number of a triangle, number of the tetrahedron that fills its void.
    """
    threads = resolve_threads(threads)
    _check_progress(progress)
    pairs = _core.persistence3(
        n,
        edges,
        edge_radii,
        triangle_edges,
        triangle_radii,
        triangle_tetrahedra,
        tetrahedron_radii,
        np.empty(0) if births is None else births,
        threads,
        progress,
    )
    for array in pairs:
        array.setflags(write=False)
    return pairs


def component_count(n: int, pairs: IntArray) -> int:
    """Return how many sets `n` numbers make when those of each pair are joined.

    Parameters
    ----------
    n : int
    pairs : (k, 2) int32
        Numbers from 0 to n - 1.
    """
    return _core.component_count(n, np.ascontiguousarray(pairs))
