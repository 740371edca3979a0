"""Kernels for periodic boxes: the cells around one box, and the simplices of the quotient."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from alphamesh._arrays import read_only
from alphamesh._kernels import _check_progress, _core, resolve_threads
from alphamesh.errors import CloudTooLargeError

if TYPE_CHECKING:
    from alphamesh._arrays import BoolArray, FloatArray, IntArray, KindArray
    from alphamesh._kernels import Progress

__all__ = [
    "Layer",
    "Star",
    "periodic_check",
    "periodic_complex",
    "periodic_parts",
    "periodic_star",
]


class Star(NamedTuple):
    """The cells of a triangulation that have one of its first sites.

    Attributes
    ----------
    dimension : int
        Of the cloud: 0 to 3.
    cells : (k, dimension + 1) int32
        Tuples of sites.
    lo, hi : (3,) float64
        A box around their spheres, rounded outwards.
    open : bool
        Whether one of the first sites lies on the convex hull, or a sphere is too large
        to tell.
    """

    dimension: int
    cells: IntArray
    lo: FloatArray
    hi: FloatArray
    open: bool


class Layer(NamedTuple):
    """The simplices of one dimension k.

    Attributes
    ----------
    rows : (m, k + 1) int32
    offsets : (m, k + 1, 3) int8
    faces : (m, k + 1) int32
        The number of the face opposite to each vertex.
    radii : (m,) float64
    """

    rows: IntArray
    offsets: KindArray
    faces: IntArray
    radii: FloatArray


def periodic_star(  # noqa: PLR0913, PLR0917 (the arrays of a cloud)
    high: FloatArray,
    low: FloatArray,
    weights: FloatArray,
    unit: float,
    base: int,
    progress: Progress | None = None,
) -> Star:
    """Triangulate sites, and return the cells around the first of them.

    Parameters
    ----------
    high, low : (n, 3) float64, C-contiguous
        Coordinates are their sums, the first rounded; all of them different sites.
    weights : (n,) float64
    unit : float
        A power of two: all coordinates are multiples of it, weights of its square.
    base : int
        How many sites are the first ones.
    progress : callable, optional

    Returns
    -------
    Star

    Raises
    ------
    CloudTooLargeError
        If there are more sites than 32-bit numbers of cells can hold.
    """
    _check_progress(progress)
    try:
        result = _core.periodic_star(high, low, weights, unit, base, progress)
    except _core.TooManyPoints:
        raise CloudTooLargeError(
            f"the box and its surroundings hold {len(high):,} points, more than 32-bit "
            "numbers of tetrahedra can tell apart; thin the cloud out"
        ) from None
    return Star(*result)


def periodic_complex(  # noqa: PLR0913, PLR0917 (the arrays of a cloud)
    rows: IntArray,
    offsets: KindArray,
    base: int,
    cells: IntArray,
    anchors: FloatArray,
    shifts: KindArray,
    weights: FloatArray | None,
    periods: FloatArray,
    exponent: int,
    threads: int | None = None,
) -> tuple[list[Layer], IntArray]:
    """Return each simplex of a periodic complex once, with faces and values.

    Parameters
    ----------
    rows : (c,) int32
        The point that each site is a copy of.
    offsets : (c, 3) int8
        How many periods the copy lies from the point in the box.
    base : int
        How many sites, the first ones, are the points in the box.
    cells : (k, D + 1) int32
        Tuples of sites: all cells that have one of the first, at least.
    anchors : (n, 3) float64
    shifts : (n, 3) int8
        A point lies at its anchor, moved by so many periods.
    weights : (n,) float64, optional
    periods : (3,) float64
        Zero where the box is open.
    exponent : int
        Of the power of two that coordinates were scaled by.
    threads : int, optional

    Returns
    -------
    layers : list of Layer
        From vertices to cells.
    cofaces : (m, 2) int32
        The one or two cells of each facet, -1 for none.
    """
    layers, cofaces = _core.periodic_complex(
        rows,
        offsets,
        base,
        cells,
        anchors,
        shifts,
        weights,
        periods,
        exponent,
        resolve_threads(threads),
    )
    made = []
    for k, layer in enumerate(layers):
        for array in layer:
            read_only(array)
        rows, moves, faces, radii = layer
        made.append(Layer(rows.reshape(-1, k + 1), moves, faces.reshape(-1, k + 1), radii))
    return made, read_only(np.asarray(cofaces))


def periodic_check(  # noqa: PLR0913, PLR0917 (the arrays of a complex)
    cells: IntArray,
    offsets: KindArray,
    faces: IntArray,
    facet_cells: IntArray,
    anchors: FloatArray,
    shifts: KindArray,
    weights: FloatArray | None,
    periods: FloatArray,
    threads: int | None = None,
) -> KindArray:
    """Tell what is wrong with the cells of each facet of a periodic triangulation, exactly.

    Parameters
    ----------
    cells, faces : (k, D + 1) int32
    offsets : (k, D + 1, 3) int8
    facet_cells : (m, 2) int32
    anchors, shifts, weights, periods
        See :func:`periodic_complex`.
    threads : int, optional

    Returns
    -------
    (m,) int8
        0 if nothing is, 1 if a cell is flat, 2 if both lie on the same side, 3 if the far
        vertex of one lies in the circumsphere of the other.
    """
    return read_only(
        _core.periodic_check(
            cells,
            np.ascontiguousarray(offsets).reshape(-1, 3),
            faces,
            facet_cells,
            anchors,
            shifts,
            weights,
            periods,
            resolve_threads(threads),
        )
    )


def periodic_parts(
    offsets: KindArray,
    faces: IntArray,
    facet_cells: IntArray,
    inside: BoolArray,
    wall: BoolArray,
) -> tuple[IntArray, KindArray]:
    """Return the connected parts of some cells of a box, and how each runs on.

    Parameters
    ----------
    offsets : (k, D + 1, d) int8
    faces : (k, D + 1) int32
    facet_cells : (m, 2) int32
    inside : (k,) bool
        Cells that belong to no part.
    wall : (m,) bool
        Facets that connect nothing.

    Returns
    -------
    parts : (k,) int32
        Numbers of parts, in the order of their first cells; -1 inside, and where a part
        reaches an open border.
    ranks : (p,) int8
        In how many independent directions each part goes on without end; 0 if it is
        bounded.
    """
    second = np.zeros((len(offsets), 3), dtype=np.int8)
    second[:, : offsets.shape[2]] = offsets[:, 1]
    parts, ranks = _core.periodic_parts(second, faces, facet_cells, inside, wall)
    return read_only(parts), read_only(ranks)
