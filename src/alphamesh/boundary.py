"""The boundary of a regularized shape, oriented: the shape lies on the left."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from alphamesh._arrays import read_only
from alphamesh.classify import SimplexKind

if TYPE_CHECKING:
    from alphamesh._arrays import BoolArray, IntArray, KindArray
    from alphamesh.filtration import Filtration

__all__ = ["directed_boundary_edges"]


def directed_boundary_edges(
    filtration: Filtration, has_triangle: BoolArray, edge_kinds: KindArray
) -> IntArray:
    """Return the regular edges, each turned so that its triangle lies on its left.

    Parameters
    ----------
    filtration : Filtration
    has_triangle : (T,) bool
        Which triangles the shape has.
    edge_kinds : (E,) int8

    Returns
    -------
    (k, 2) int32
        In the order of the regular edges.
    """
    regular = np.flatnonzero(edge_kinds == SimplexKind.REGULAR)
    directed = filtration.simplices[1].take(regular, axis=0)
    cofaces = filtration.edge_triangles.take(regular, axis=0)
    first_is_in = has_triangle.take(cofaces[:, 0])
    inside = np.where(first_is_in, cofaces[:, 0], cofaces[:, 1])
    # Counter-clockwise corners a, b, c: the triangle is on the left of ab, bc and ca. As a
    # is the lowest row and edges ascend, an edge runs forward only as ab or as bc.
    a, b, c = filtration.oriented_triangles.take(inside, axis=0).T
    start, end = directed.T
    forward = ((start == a) & (end == b)) | ((start == b) & (end == c))
    directed[~forward] = directed[~forward, ::-1]
    return read_only(directed)
