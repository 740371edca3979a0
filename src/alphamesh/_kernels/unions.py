"""Kernels for the measures of unions of discs and of balls.

They suppose coordinates, radii and weights in the range that
``alphamesh._balls.scaled`` brings them into.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from alphamesh._arrays import read_only
from alphamesh._kernels import _check_progress, _core, resolve_threads

if TYPE_CHECKING:
    from typing import TypeAlias

    from alphamesh._arrays import BoolArray, FloatArray, IntArray
    from alphamesh._kernels import Progress

    Measures: TypeAlias = tuple[float, FloatArray, FloatArray, FloatArray, FloatArray]

__all__ = ["Centres", "Pieces", "measured_union"]


class Centres(NamedTuple):
    """Balls of squared radii ``weights + power``: where they are, and their copies.

    Attributes
    ----------
    high : (p, d) float64, C-contiguous
        The centres of the n balls, then those of copies.
    weights : (n,) float64 or None
        None means 0.
    power : float
    low : (p, d) float64, C-contiguous, or None
        What is to be added to `high`.
    rows : (p,) int32 or None
        The ball that each place belongs to; None if there are no copies.
    """

    high: FloatArray
    weights: FloatArray | None
    power: float
    low: FloatArray | None = None
    rows: IntArray | None = None


class Pieces(NamedTuple):
    """The simplices that cut a union into pieces, and which of them are there.

    Attributes
    ----------
    simplices : tuple of (m_k, k + 1) int32
        Edges, triangles and, in space, tetrahedra: numbers of places.
    sides : tuple of (m_k, k + 1) int32
        The face opposite to each vertex, of triangles and, in space, of tetrahedra.
    cofaces : (f, 2) int32
        The cells of each facet, -1 for none.
    has : tuple of bool arrays
        Which balls, and which simplices of each dimension, the alpha complex at the radius
        has.
    holes : (c,) int32
        The hole of the complex that each cell lies in, below zero for none.
    hole_count : int
    """

    simplices: tuple[IntArray, ...]
    sides: tuple[IntArray, ...]
    cofaces: IntArray
    has: tuple[BoolArray, ...]
    holes: IntArray
    hole_count: int


def measured_union(
    centres: Centres,
    pieces: Pieces,
    threads: int | None = None,
    progress: Progress | None = None,
) -> Measures:
    """Return the measures of a union of discs or balls.

    Parameters
    ----------
    centres : Centres
    pieces : Pieces
    threads : int, optional
    progress : callable, optional

    Returns
    -------
    content : float
        Area in the plane, volume in space.
    contents, borders : (n,) float64
        Of each ball in its power cell; of its part of the boundary.
    hole_contents, hole_borders : (hole_count,) float64
    """
    kernel = _core.union2 if centres.high.shape[1] == 2 else _core.union3
    threads = resolve_threads(threads)
    _check_progress(progress)
    content, *arrays = kernel(
        centres.high,
        centres.low,
        centres.weights,
        centres.rows,
        centres.power,
        pieces.simplices,
        pieces.sides,
        pieces.has,
        pieces.cofaces,
        pieces.holes,
        pieces.hole_count,
        threads,
        progress,
    )
    contents, borders, hole_contents, hole_borders = map(read_only, arrays)
    return content, contents, borders, hole_contents, hole_borders
