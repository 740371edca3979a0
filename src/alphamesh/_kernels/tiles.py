"""Kernels for tiles of clouds larger than memory: a tile's share, and points on their way."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from alphamesh._kernels import _check_progress, _core, resolve_threads

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from alphamesh._arrays import CountArray, FloatArray, IntArray, KindArray
    from alphamesh._kernels import Progress

__all__ = [
    "Border",
    "Recycling",
    "Share2",
    "Share3",
    "checksum",
    "recycled",
    "spread",
    "tile2",
    "tile_share3",
]

Border = tuple[int, "CountArray", "IntArray"]
Points = tuple["CountArray", "FloatArray", "CountArray"]
"""Rows, coordinates column by column, and the lowest rows with the same coordinates"""

# Bytes from which on the core keeps memory.
_RECYCLED = 1 << 20

Recycling = _core.Recycling
"""While such an object lives, memory that kernels release is kept for the next ones."""


class Share2(NamedTuple):
    """What one tile owns of a complex in the plane; rows are those of the whole cloud."""

    own: Points
    """the points in the box, duplicates and all"""
    vertices: CountArray
    """(m_0,) ascending"""
    vertex_radii: FloatArray | None
    """(m_0,) with weights; None without"""
    edges: CountArray
    """(m_1, 2) column by column"""
    edge_radii: FloatArray
    edge_kinds: KindArray
    triangles: CountArray
    """(m_2, 3) column by column"""
    triangle_radii: FloatArray
    boundary: IntArray
    """(b, 3) rows of the input: an edge with its triangle on the left, the third corner"""
    boundary_regions: IntArray
    region_sizes: FloatArray
    components: Border
    """how many parts; keys (k, 1) and labels (k,) of what other tiles may know, too"""
    regions: Border
    """the same of triangles, keys (k, 3)"""


def tile2(  # noqa: PLR0913, PLR0917 (a tile, its points and the radius)
    points: FloatArray,
    rows: CountArray,
    bounds: FloatArray,
    radius: float,
    threads: int | None = None,
    progress: Progress | None = None,
    weights: FloatArray | None = None,
) -> Share2:
    """Return the simplices of value at most `radius` that begin in a box.

    Parameters
    ----------
    points : (n, 2) float64, C-contiguous
    rows : (n,) int32 or int64
        Rows of the points in the whole cloud, ascending; results have this type.
    bounds : (4, 2) float64
        Lower and upper corner of the box, which is half open; other boxes may know points
        that are not above the third or not below the last one.
    radius : float
        A signed root of a power value if there are weights; without them, nothing is there
        below zero.
    threads : int, optional
    progress : callable, optional
    weights : (n,) float64, optional
        Squared radii of balls.

    Raises
    ------
    BadCoordinates
        See :func:`alphamesh._kernels.alpha2`.
    """
    threads = resolve_threads(threads)
    _check_progress(progress)
    if weights is not None:
        weights = np.ascontiguousarray(weights, dtype=np.float64)
    share = Share2(
        *_core.tile2(
            points, weights, np.ascontiguousarray(rows), bounds, radius, threads, progress
        )
    )
    _close(share)
    return share


def _close(share: Iterable[Any]) -> None:
    """Close arrays, and those in tuples, to writing."""
    for part in share:
        if isinstance(part, np.ndarray):
            part.setflags(write=False)
        elif isinstance(part, tuple):
            _close(part)


class Share3(NamedTuple):
    """What one tile owns of a complex in space; see :class:`Share2`."""

    own: Points
    vertices: CountArray
    vertex_radii: FloatArray | None
    edges: CountArray
    edge_radii: FloatArray
    triangles: CountArray
    triangle_radii: FloatArray
    triangle_kinds: KindArray
    tetrahedra: CountArray
    tetrahedron_radii: FloatArray
    boundary: IntArray
    """(b, 4) a triangle, counter-clockwise from outside, and the corner behind it"""
    boundary_regions: IntArray
    region_sizes: FloatArray
    components: Border
    regions: Border
    """of tetrahedra, keys (k, 4)"""
    fronts: Border
    """keys (k, 4)"""


def tile_share3(  # noqa: PLR0913, PLR0917 (the arrays of a filtration)
    points: FloatArray,
    real: int,
    rows: CountArray,
    representative: IntArray,
    simplices: tuple[IntArray, IntArray, IntArray, IntArray],
    radii: tuple[FloatArray, FloatArray, FloatArray, FloatArray],
    triangle_tetrahedra: IntArray,
    bounds: FloatArray,
    radius: float,
    progress: Progress | None = None,
    vertex_radii: FloatArray | None = None,
) -> Share3:
    """Return the simplices of a filtration in space, up to `radius`, that begin in a box.

    Parameters
    ----------
    points : (n, 3) float64, C-contiguous
    real : int
        Points from there on are a frame around the others.
    rows : (n,) int32 or int64
        Rows of the points in the whole cloud, ascending; results have this type.
    representative : (n,) int32
    simplices, radii, triangle_tetrahedra : arrays
        As in :class:`alphamesh.filtration3d.Filtration3D`.
    bounds : (4, 3) float64
        See :func:`tile2`.
    radius : float
    progress : callable, optional
    vertex_radii : (n,) float64, optional
        With weights: the value of each point, infinity for what is no vertex.
    """
    _check_progress(progress)
    (_, edges, triangles, tetrahedra), (_, edge_radii, triangle_radii, cell_radii) = (
        simplices,
        radii,
    )
    share = Share3(
        *_core.tile_share3(
            points,
            real,
            np.ascontiguousarray(rows),
            representative,
            vertex_radii,
            edges,
            edge_radii,
            triangles,
            triangle_radii,
            triangle_tetrahedra,
            tetrahedra,
            cell_radii,
            bounds,
            radius,
            progress,
        )
    )
    _close(share)
    return share


def spread(  # noqa: PLR0913, PLR0917 (the arrays of a tree)
    points: FloatArray,
    axes: CountArray,
    low: FloatArray,
    high: FloatArray,
    below: CountArray,
    above: CountArray,
    progress: Progress | None = None,
) -> tuple[CountArray, IntArray, FloatArray]:
    """Send points down a tree of cuts.

    Parameters
    ----------
    points : (n, d) float64, C-contiguous
    axes : (m,) int64
    low, high : (m,) float64
        What is less than `low` goes below, what is not less than `high` above, high <= low.
    below, above : (m,) int64
        Nodes, or -1 - t for tile t.
    progress : callable, optional

    Returns
    -------
    offsets : (m + 2,) int64
        Of the m + 1 tiles.
    rows : (k,) int32
        Of points, tile by tile, ascending in each.
    points : (k, d) float64
    """
    return _core.spread(points, axes, low, high, below, above, progress)


def checksum(content: bytes | memoryview, before: int = 0) -> int:
    """Return a checksum of 64 bits: no protection from intent, but from all accidents.

    Parameters
    ----------
    content : bytes-like
    before : int
        The checksum of what comes before; its length must be a multiple of eight.
    """
    return _core.checksum(np.frombuffer(content, dtype=np.uint8), before)


def recycled(shape: tuple[int, ...], dtype: Any) -> NDArray[Any]:
    """Return an array of any content in memory that :class:`Recycling` keeps.

    Parameters
    ----------
    shape : tuple of int
    dtype : dtype
    """
    size = math.prod(shape) * np.dtype(dtype).itemsize
    # Less would come from elsewhere.
    memory: NDArray[Any] = _core.memory(max(size, _RECYCLED))[:size].view(dtype)
    return memory.reshape(shape)
