"""The invariants of a Delaunay triangulation."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from alphamesh.check._mesh import check_edges, check_representative, proved_mesh
from alphamesh.check._space_filtration import check_delaunay3d
from alphamesh.check._tools import check_table, require
from alphamesh.check._weighted import check_rows, standing_rows
from alphamesh.delaunay3d import Delaunay3D
from alphamesh.errors import InvalidResultError

if TYPE_CHECKING:
    from alphamesh.delaunay import Delaunay


def check_delaunay(result: Delaunay | Delaunay3D) -> None:
    """Prove that `result` is the canonical Delaunay triangulation of its points.

    Parameters
    ----------
    result : Delaunay or Delaunay3D

    Raises
    ------
    InvalidResultError
        If an invariant fails; the message and ``rows`` name the rows of the array that
        breaks it.
    """
    if isinstance(result, Delaunay3D):
        check_delaunay3d(result)
        return
    standing = result.representative
    if result.weights is None:
        check_representative(result.points, standing)
    else:
        check_rows(result)
        standing = standing_rows(standing, result.hidden)
    mesh = proved_mesh(result.points, standing, result.triangles, result.weights)
    check_table(result.neighbors, (len(mesh.triangles), 3), "neighbors")
    require(
        (result.neighbors == mesh.neighbors).all(axis=1),
        "neighbors: not the triangles opposite to the vertices",
    )
    check_edges(result.edges, mesh)
    path = result.edges if len(mesh.triangles) == 0 else result.edges[:0]
    if not np.array_equal(result.path, path):
        raise InvalidResultError("path: not the edges of a cloud on one line, and only of such")
