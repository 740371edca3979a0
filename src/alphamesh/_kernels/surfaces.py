"""Kernels for sets of tetrahedra: their boundaries, and answers to queries."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from alphamesh._kernels import _core, resolve_threads

if TYPE_CHECKING:
    from alphamesh._arrays import BoolArray, FloatArray, IntArray, KindArray

__all__ = [
    "Skin",
    "TriangleTree",
    "locate3",
    "nearest3",
    "outer_shells3",
    "surface3",
    "triangle_tree3",
]

TriangleTree = tuple["FloatArray", "IntArray", "FloatArray"]


class Skin(NamedTuple):
    """The boundary of a set of tetrahedra; k facets, v vertices."""

    facets: IntArray
    """(k,) number of the triangle, ascending"""
    corners: IntArray
    """(k, 3) rows of points, counter-clockwise seen from outside"""
    across: IntArray
    """(k, 3) the facet beyond the side opposite to each corner"""
    vertices: IntArray
    """(k, 3) vertices, one for each fan of facets around a point"""
    rows: IntArray
    """(v,) row of points of each vertex, ascending"""
    shells: IntArray
    """(k,) connected component, numbered in the order of the first facets"""


def surface3(  # noqa: PLR0913, PLR0917 (the arrays of a filtration)
    points: FloatArray,
    tetrahedra: IntArray,
    triangles: IntArray,
    triangle_tetrahedra: IntArray,
    tetrahedron_triangles: IntArray,
    inside: BoolArray,
    threads: int | None = None,
) -> Skin:
    """Return the boundary of some tetrahedra as a surface without singularities.

    Around an edge in more than two facets, those are joined that bound the same wedge of
    chosen tetrahedra.

    Parameters
    ----------
    points : (n, 3) float64, C-contiguous
    tetrahedra : (T, 4) int32
    triangles : (F, 3) int32
    triangle_tetrahedra : (F, 2) int32
    tetrahedron_triangles : (T, 4) int32
    inside : (T,) bool
    threads : int, optional
    """
    skin = Skin(
        *_core.surface3(
            points,
            tetrahedra,
            triangles,
            triangle_tetrahedra,
            tetrahedron_triangles,
            inside,
            resolve_threads(threads),
        )
    )
    for array in skin:
        array.setflags(write=False)
    return skin


def outer_shells3(shells: IntArray, regions: IntArray, parts: IntArray) -> BoolArray:
    """Return which shells enclose the region that they bound.

    Parameters
    ----------
    shells, regions, parts : (k,) int32
        Of each facet its shell, the region behind it and the part of the complement
        before it, all from 0 on; part 0 reaches to infinity.

    Returns
    -------
    (s,) bool
    """
    outer = _core.outer_shells3(shells, regions, parts)
    outer.setflags(write=False)
    return outer


def locate3(  # noqa: PLR0913, PLR0917 (the arrays of a filtration)
    points: FloatArray,
    tetrahedra: IntArray,
    triangle_tetrahedra: IntArray,
    tetrahedron_triangles: IntArray,
    labels: IntArray,
    queries: FloatArray,
    threads: int | None = None,
) -> tuple[IntArray, KindArray]:
    """Return which labelled tetrahedra hold each query; every decision is exact.

    Parameters
    ----------
    points : (n, 3) float64, C-contiguous
    tetrahedra : (T, 4) int32
    triangle_tetrahedra : (F, 2) int32
    tetrahedron_triangles : (T, 4) int32
    labels : (T,) int32
        Below zero for none.
    queries : (q, 3) float64, C-contiguous
        Finite.
    threads : int, optional

    Returns
    -------
    labels : (q,) int32
        The lowest of the tetrahedra, closed ones, that hold the query; -1 if none does.
    sides : (q,) int8
        1 inside of the union of the labelled tetrahedra, 0 on its boundary, -1 outside.
    """
    found = _core.locate3(
        points,
        tetrahedra,
        triangle_tetrahedra,
        tetrahedron_triangles,
        labels,
        queries,
        resolve_threads(threads),
    )
    for array in found:
        array.setflags(write=False)
    return found


def triangle_tree3(
    points: FloatArray, triangles: IntArray, threads: int | None = None
) -> TriangleTree:
    """Return a tree of boxes over triangles, for :func:`nearest3`.

    Parameters
    ----------
    points : (n, 3) float64, C-contiguous
    triangles : (k, 3) int32
        At least one.
    threads : int, optional

    Returns
    -------
    tuple of arrays
        To be handed on as it is.
    """
    corners, places, boxes = _core.triangle_tree3(points, triangles, resolve_threads(threads))
    for array in (corners, places, boxes):
        array.setflags(write=False)
    return corners, places, boxes


def nearest3(
    tree: TriangleTree, queries: FloatArray, threads: int | None = None
) -> tuple[IntArray, FloatArray, FloatArray]:
    """Return the nearest triangle to each query.

    Parameters
    ----------
    tree : tuple of arrays
        From :func:`triangle_tree3`.
    queries : (q, 3) float64, C-contiguous
        Finite; no product of six coordinates may overflow.
    threads : int, optional

    Returns
    -------
    places : (q,) int32
        Row of the triangle.
    points : (q, 3) float64
        The nearest point on it.
    distances : (q,) float64
    """
    places, points, distances = _core.nearest3(*tree, queries, resolve_threads(threads))
    for array in (places, points, distances):
        array.setflags(write=False)
    return places, points, distances
