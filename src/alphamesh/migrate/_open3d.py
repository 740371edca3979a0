"""``TriangleMesh.create_from_point_cloud_alpha_shape`` of Open3D."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from alphamesh.complex3d import AlphaComplex3D
from alphamesh.points import as_cloud

if TYPE_CHECKING:
    from alphamesh.io.meshes import Mesh

__all__ = ["create_from_point_cloud_alpha_shape"]


def create_from_point_cloud_alpha_shape(pcd: Any, alpha: float) -> Mesh:
    """Return the surface of the alpha shape of points in space, as Open3D does.

    Parameters
    ----------
    pcd : array-like of shape (n, 3), or open3d.geometry.PointCloud
    alpha : float
        The radius: tetrahedra of a radius of at most `alpha` are filled.

    Returns
    -------
    Mesh
        The corners in use as ``points``, and the triangles between the filled and the
        empty as ``cells["triangle"]``, counter-clockwise seen from outside. The numbers
        ``point_data["input_row"]`` are the rows of `pcd`. ``write_mesh(mesh, path)`` writes
        it; ``open3d.utility.Vector3dVector(mesh.points)`` takes it back.

    Raises
    ------
    ParameterError
        If `alpha` is not a number, or negative.
    CloudShapeError, NonFiniteError, CoordinateRangeError
        If `pcd` holds no points in space.

    Notes
    -----
    Differences from Open3D: all triangles have one orientation; decisions are exact, where
    Open3D leaves out tetrahedra that it takes for flat and warns of them; duplicates are
    merged. There is no `tetra_mesh` nor `pt_map`, as the complex can be kept:
    ``cx = AlphaComplex(points)``, then ``cx.at(alpha)`` for as many radii as you like.
    """
    from alphamesh.io.meshes import Mesh, compact

    points = as_cloud(np.asarray(pcd.points) if hasattr(pcd, "points") else pcd, 3)
    shape = AlphaComplex3D(points).at(alpha)
    return compact(Mesh(shape.points, {"triangle": shape.boundary_triangles}))
