"""Where points lie with respect to a set of triangles: in which region, and how far off."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from alphamesh._arrays import Record, read_only
from alphamesh._kernels import orient2
from alphamesh._kernels.outlines import nearest2, segment_tree2
from alphamesh.errors import ParameterError
from alphamesh.measures import scaled_points
from alphamesh.points import as_cloud, coordinate_error

if TYPE_CHECKING:
    from alphamesh._arrays import FloatArray, IntArray
    from alphamesh._kernels.outlines import SegmentTree
    from alphamesh.delaunay import Delaunay

__all__ = ["EdgeTree", "Nearest", "as_queries", "edge_tree", "nearest_edges", "regions_at"]

# Queries worked on at a time: their triangles stay in the processor's cache.
_CHUNK = 1 << 15

# Coordinates below this power of two have squares within the range of float64.
_MOST_EXPONENT = 500


@dataclass(frozen=True, eq=False, repr=False)
class Nearest(Record):
    """The nearest points of a shape's boundary.

    Attributes
    ----------
    points : (q, 2) float64
        The nearest point of the boundary to each query; NaN if there is no boundary.
    distances : (q,) float64
        How far it is, not negative; infinity if there is no boundary.
    edges : (q,) int32
        The boundary edge that it lies on, as a row of ``shape.boundary_edges``, the
        lowest if there are several; -1 if there is no boundary.

    All arrays are read-only.
    """

    points: FloatArray
    distances: FloatArray
    edges: IntArray

    def __len__(self) -> int:
        return len(self.edges)

    def __repr__(self) -> str:
        return f"<Nearest: {len(self):,} queries>"


@dataclass(frozen=True, slots=True, eq=False)
class EdgeTree(Record):
    """Boundary edges, ready to be asked for the nearest one.

    Attributes
    ----------
    points : (n, 2) float64
    edges : (k, 2) int32
    exponent : int
        Of the power of two that the coordinates in `tree` have been divided by.
    tree : tuple of arrays, or None without edges
    """

    points: FloatArray
    edges: IntArray
    exponent: int
    tree: SegmentTree | None


def as_queries(queries: Any, crs: Any = None) -> FloatArray:
    """Return queries as a table of finite numbers.

    Parameters
    ----------
    queries : array-like of shape (q, 2)
    crs : pyproj.CRS, optional
        The reference system that queries with one must be in.

    Raises
    ------
    CloudShapeError, NonFiniteError
        If they are not; the message names the rows.
    ParameterError
        If they are in another reference system.
    """
    cloud = as_cloud(queries, 2)
    table = cloud.points
    if crs is not None and cloud.crs is not None and cloud.crs != crs:
        raise ParameterError(
            f"the points asked about are in {cloud.crs.name}, the shape in {crs.name}; "
            "project them: points.to_crs(shape.crs)"
        )
    if not np.isfinite(table).all():
        raise coordinate_error(table)
    return table


# ---------------------------------------------------------------------- regions


def regions_at(
    delaunay: Delaunay, labels: IntArray, vertex_labels: IntArray, queries: FloatArray
) -> IntArray:
    """Return the region that each query lies in, the lowest if it lies in several.

    Parameters
    ----------
    delaunay : Delaunay
    labels : (T,) int32
        Region of each triangle, below zero for none. Regions share no edges.
    vertex_labels : (n,) int32
        The lowest label at each point, below zero for none.
    queries : (q, 2) float64

    Returns
    -------
    (q,) int32
        -1 outside of all regions. Regions are closed, and every decision is exact.
    """
    found = np.full(len(queries), -1, dtype=np.int32)
    if len(delaunay.triangles) == 0:
        return read_only(found)
    triangles = delaunay.find(queries)
    for start in range(0, len(queries), _CHUNK):
        part = slice(start, start + _CHUNK)
        hit = np.flatnonzero(triangles[part] >= 0)
        found[part][hit] = _regions_in(
            delaunay, labels, vertex_labels, queries[part][hit], triangles[part][hit]
        )
    return read_only(np.maximum(found, -1))


def _regions_in(
    delaunay: Delaunay,
    labels: IntArray,
    vertex_labels: IntArray,
    queries: FloatArray,
    triangles: IntArray,
) -> IntArray:
    """Return the regions of queries that lie in known triangles."""
    regions = labels.take(triangles)
    corners = delaunay.triangles.take(triangles, axis=0)
    # At a corner other regions may meet; at an edge, if its triangle is in no region.
    query, corner = np.nonzero(
        (delaunay.points.take(corners, axis=0) == queries[:, np.newaxis]).all(axis=2)
    )
    regions[query] = vertex_labels.take(corners[query, corner])
    left = np.flatnonzero(regions < 0)
    across = delaunay.neighbors.take(triangles[left], axis=0)
    for side in range(3):
        # Only an edge of a region matters, and most triangles have none.
        region = np.where(across[:, side] >= 0, labels.take(across[:, side], mode="wrap"), -1)
        near = np.flatnonzero(region >= 0)
        rows = left[near]
        ends = delaunay.points.take(np.delete(corners[rows], side, axis=1), axis=0)
        on_edge = orient2(np.concatenate((ends, queries[rows, np.newaxis]), axis=1)) == 0
        regions[rows[on_edge]] = region[near[on_edge]]
    return regions


# ---------------------------------------------------------------------- distances


def edge_tree(points: FloatArray, edges: IntArray) -> EdgeTree:
    """Prepare edges for :func:`nearest_edges`.

    Parameters
    ----------
    points : (n, 2) float64
    edges : (k, 2) int32
    """
    if len(edges) == 0:
        return EdgeTree(points, edges, 0, None)
    scaled, exponent = scaled_points(points)
    return EdgeTree(points, edges, exponent, segment_tree2(scaled, edges))


def nearest_edges(tree: EdgeTree, queries: FloatArray) -> Nearest:
    """Return the nearest edge to each query, the nearest point on it and its distance.

    Parameters
    ----------
    tree : EdgeTree
        From :func:`edge_tree`.
    queries : (q, 2) float64
        Finite.
    """
    if tree.tree is None:
        nothing = np.full((len(queries), 2), np.nan)
        far = np.full(len(queries), np.inf)
        none = np.full(len(queries), -1, dtype=np.int32)
        return Nearest(read_only(nothing), read_only(far), read_only(none))
    arrays, exponent = tree.tree, tree.exponent
    # Squares of queries must not overflow either, wherever they are.
    farthest = int(np.frexp(np.abs(queries).max(initial=0.0))[1])
    if farthest - exponent > _MOST_EXPONENT:
        exponent = farthest
        arrays = segment_tree2(np.ldexp(tree.points, -exponent), tree.edges)
    edges, points, distances = nearest2(arrays, np.ldexp(queries, -exponent))
    if exponent == 0:
        return Nearest(points, distances, edges)
    with np.errstate(over="ignore", under="ignore"):
        points, distances = np.ldexp(points, exponent), np.ldexp(distances, exponent)
    return Nearest(read_only(points), read_only(distances), edges)
