"""Kernels for the measures of unions of discs and of balls.

They suppose coordinates, radii and weights in the range that
``alphamesh._balls.scaled`` brings them into.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from alphamesh._arrays import read_only
from alphamesh._kernels import _check_progress, _core, resolve_threads

if TYPE_CHECKING:
    from typing import TypeAlias

    from alphamesh._arrays import BoolArray, FloatArray, IntArray
    from alphamesh._kernels import Progress

    Measures: TypeAlias = tuple[float, FloatArray, FloatArray, FloatArray, FloatArray]

__all__ = ["union2", "union3"]


def union2(  # noqa: PLR0913, PLR0917 (the arrays of a complex)
    points: FloatArray,
    weights: FloatArray | None,
    power: float,
    edges: IntArray,
    edge_triangles: IntArray,
    triangles: IntArray,
    triangle_edges: IntArray,
    has: tuple[BoolArray, BoolArray, BoolArray],
    hole: IntArray,
    hole_count: int,
    threads: int | None = None,
    progress: Progress | None = None,
) -> Measures:
    """Return the measures of the union of discs of squared radii ``weights + power``.

    Parameters
    ----------
    points : (n, 2) float64, C-contiguous
    weights : (n,) float64 or None
        None means 0.
    power : float
    edges, edge_triangles : (E, 2) int32
    triangles, triangle_edges : (T, 3) int32
    has : tuple of (n,), (E,), (T,) bool
        Which points, edges and triangles the alpha complex at `power` has.
    hole : (T,) int32
        The hole of the complex that each triangle lies in, below zero for none.
    hole_count : int
    threads : int, optional
    progress : callable, optional

    Returns
    -------
    area : float
    areas, perimeters : (n,) float64
        Of each disc in its power cell; of its arcs on the boundary.
    hole_areas, hole_perimeters : (hole_count,) float64
    """
    threads = resolve_threads(threads)
    _check_progress(progress)
    area, *arrays = _core.union2(
        edges,
        edge_triangles,
        triangles,
        triangle_edges,
        has,
        hole,
        hole_count,
        points,
        weights,
        power,
        threads,
        progress,
    )
    areas, perimeters, hole_areas, hole_perimeters = map(read_only, arrays)
    return area, areas, perimeters, hole_areas, hole_perimeters


def union3(  # noqa: PLR0913, PLR0917 (the arrays of a complex)
    points: FloatArray,
    weights: FloatArray | None,
    power: float,
    simplices: tuple[IntArray, IntArray, IntArray],
    triangle_edges: IntArray,
    triangle_tetrahedra: IntArray,
    tetrahedron_triangles: IntArray,
    has: tuple[BoolArray, BoolArray, BoolArray, BoolArray],
    hollow: IntArray,
    void_count: int,
    threads: int | None = None,
    progress: Progress | None = None,
) -> Measures:
    """Return the measures of the union of balls of squared radii ``weights + power``.

    Parameters
    ----------
    points : (n, 3) float64, C-contiguous
    weights : (n,) float64 or None
        None means 0.
    power : float
    simplices : tuple of (E, 2), (F, 3), (T, 4) int32
        Edges, triangles, tetrahedra.
    triangle_edges : (F, 3) int32
    triangle_tetrahedra : (F, 2) int32
    tetrahedron_triangles : (T, 4) int32
    has : tuple of (n,), (E,), (F,), (T,) bool
        Which points and simplices the alpha complex at `power` has.
    hollow : (T,) int32
        The void of the complex that each tetrahedron lies in, below zero for none.
    void_count : int
    threads : int, optional
    progress : callable, optional

    Returns
    -------
    volume : float
    volumes, surface_areas : (n,) float64
        Of each ball in its power cell; of its part of the boundary.
    void_volumes, void_surface_areas : (void_count,) float64
    """
    threads = resolve_threads(threads)
    _check_progress(progress)
    edges, triangles, tetrahedra = simplices
    volume, *arrays = _core.union3(
        edges,
        triangles,
        triangle_edges,
        triangle_tetrahedra,
        tetrahedra,
        tetrahedron_triangles,
        has,
        hollow,
        void_count,
        points,
        weights,
        power,
        threads,
        progress,
    )
    volumes, surface_areas, void_volumes, void_areas = map(read_only, arrays)
    return volume, volumes, surface_areas, void_volumes, void_areas
