"""Which tetrahedra of a triangulation hold points; every decision is exact."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from alphamesh import _kernels
from alphamesh._arrays import read_only
from alphamesh._kernels.surfaces import locate3
from alphamesh.points import as_cloud, coordinate_error, tiny_queries

if TYPE_CHECKING:
    from alphamesh._arrays import FloatArray, IntArray, KindArray

__all__ = ["as_queries_in_space", "labels_at"]


def as_queries_in_space(queries: Any) -> FloatArray:
    """Return queries as a table of three finite numbers each.

    Raises
    ------
    CloudShapeError, NonFiniteError
        If they are not; the message names the rows.
    """
    table = as_cloud(queries, 3).points
    if not np.isfinite(table).all():
        raise coordinate_error(table)
    return table


def labels_at(  # noqa: PLR0913, PLR0917 (the arrays of a triangulation)
    points: FloatArray,
    tetrahedra: IntArray,
    incidence: tuple[IntArray, IntArray],
    labels: IntArray,
    queries: FloatArray,
    threads: int | None = None,
) -> tuple[IntArray, KindArray]:
    """Return which labelled tetrahedra hold each query.

    Parameters
    ----------
    points : (n, 3) float64, C-contiguous
    tetrahedra : (T, 4) int32
    incidence : (F, 2) int32 and (T, 4) int32
        The tetrahedra of each triangle, and the triangles of each tetrahedron.
    labels : (T,) int32
        Below zero for none.
    queries : (q, 3) float64
        Finite.
    threads : int, optional

    Returns
    -------
    labels : (q,) int32
        The lowest of the tetrahedra, closed ones, that hold it; -1 if none does.
    sides : (q,) int8
        1 inside of the union of the labelled tetrahedra, 0 on its boundary, -1 outside.

    Raises
    ------
    CoordinateRangeError
        If coordinates of queries are too small beside the points for exact arithmetic.
    """
    arrays = points, tetrahedra, *incidence, labels
    try:
        return locate3(*arrays, queries, threads)
    except _kernels.BadCoordinates:
        pass
    # Queries far outside need no arithmetic to be told so.
    low, high = points.min(axis=0, initial=np.inf), points.max(axis=0, initial=-np.inf)
    near = ((queries >= low) & (queries <= high)).all(axis=1)
    found = np.full(len(queries), -1, dtype=np.int32)
    sides = np.full(len(queries), -1, dtype=np.int8)
    try:
        found[near], sides[near] = locate3(*arrays, queries[near], threads)
    except _kernels.BadCoordinates:
        raise tiny_queries(points, np.where(near[:, None], queries, 0.0)) from None
    return read_only(found), read_only(sides)
