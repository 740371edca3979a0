"""Kernels for sets of triangles: their connected parts, outlines and nearest edges.

All but :func:`nearest2` take a finished triangulation whose coordinates lie within the
direct range of the core (see :func:`alphamesh.measures.kernel_points`).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from alphamesh._kernels import _core, resolve_threads

if TYPE_CHECKING:
    from alphamesh._arrays import BoolArray, CountArray, FloatArray, IntArray

__all__ = ["SegmentTree", "connected", "nearest2", "outlines2", "parts2", "segment_tree2"]

SegmentTree = tuple["FloatArray", "IntArray", "FloatArray"]


def parts2(
    points: FloatArray,
    triangles: IntArray,
    edges: IntArray,
    edge_triangles: IntArray,
    inside: BoolArray,
) -> IntArray:
    """Return numbers of the connected parts of some triangles, and of the others.

    Triangles are connected by edges, not by vertices.

    Parameters
    ----------
    points : (n, 2) float64, C-contiguous
    triangles : (T, 3) int32
    edges : (E, 2) int32
    edge_triangles : (E, 2) int32
    inside : (T,) bool

    Returns
    -------
    (T,) int32
        Parts of the inside are 0, 1, ... in the order of their first triangles; of the
        others, -1 is around everything, and holes are -2, -3, ...
    """
    parts = _core.parts2(points, triangles, edges, edge_triangles, inside)
    parts.setflags(write=False)
    return parts


def connected(count: int, links: IntArray) -> IntArray:
    """Return numbers of the connected parts of a graph.

    Parameters
    ----------
    count : int
        How many nodes it has.
    links : (k, 2) int32, C-contiguous
        Nodes that belong together.

    Returns
    -------
    (count,) int32
        0, 1, ... in the order of the first node of each part.
    """
    # Triangles whose corners nobody looks at, linked by edges.
    nowhere = np.empty((0, 2))
    nodes = np.broadcast_to(np.int32(0), (count, 3)).copy()
    return parts2(nowhere, nodes, links, links, np.ones(count, dtype=np.bool_))


def outlines2(  # noqa: PLR0913, PLR0917 (the arrays of a filtration)
    points: FloatArray,
    triangles: IntArray,
    edges: IntArray,
    edge_triangles: IntArray,
    regions: IntArray,
    threads: int | None = None,
) -> tuple[CountArray, IntArray, IntArray, IntArray, BoolArray]:
    """Trace the border of each region as closed rings, the region on their left.

    Parameters
    ----------
    points : (n, 2) float64, C-contiguous
    triangles : (T, 3) int32
    edges : (E, 2) int32
    edge_triangles : (E, 2) int32
    regions : (T,) int32
        Region of each triangle, connected by edges; below zero for none.
    threads : int, optional

    Returns
    -------
    offsets : (m + 1,) int64
    rows : (k,) int32
        Corners ``offsets[i]`` to ``offsets[i + 1]`` are ring i, from its
        lexicographically least corner on; none is repeated.
    edges : (k,) int32
        The edge from each corner to the next.
    regions : (m,) int32
        Ascending.
    holes : (m,) bool
        Of each region, the outer ring comes first.
    """
    offsets, rows, ring_edges, ring_regions, holes = _core.outlines2(
        points, triangles, edges, edge_triangles, regions, resolve_threads(threads)
    )
    for array in (offsets, rows, ring_edges, ring_regions, holes):
        array.setflags(write=False)
    return offsets, rows, ring_edges, ring_regions, holes


def segment_tree2(
    points: FloatArray, edges: IntArray, threads: int | None = None
) -> SegmentTree:
    """Return a tree of boxes over segments, for :func:`nearest2`.

    Parameters
    ----------
    points : (n, 2) float64, C-contiguous
    edges : (k, 2) int32
        At least one.
    threads : int, optional

    Returns
    -------
    tuple of arrays
        To be handed on as it is.
    """
    segments, places, boxes = _core.segment_tree2(points, edges, resolve_threads(threads))
    for array in (segments, places, boxes):
        array.setflags(write=False)
    return segments, places, boxes


def nearest2(
    tree: SegmentTree, queries: FloatArray, threads: int | None = None
) -> tuple[IntArray, FloatArray, FloatArray]:
    """Return the nearest segment to each query.

    Parameters
    ----------
    tree : tuple of arrays
        From :func:`segment_tree2`.
    queries : (q, 2) float64, C-contiguous
        Finite; no square of a coordinate may overflow.
    threads : int, optional

    Returns
    -------
    places : (q,) int32
        Row of the segment, the lowest where several are equally near.
    points : (q, 2) float64
        The nearest point on it.
    distances : (q,) float64
        Zero exactly on the segment.
    """
    places, points, distances = _core.nearest2(*tree, queries, resolve_threads(threads), None)
    for array in (places, points, distances):
        array.setflags(write=False)
    return places, points, distances
