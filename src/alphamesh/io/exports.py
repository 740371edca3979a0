"""Meshes as the objects of other libraries, which are imported when they are asked for."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from alphamesh.errors import MissingLibraryError
from alphamesh.io._mesh import points_in_space as in_space
from alphamesh.io._mesh import rows_of
from alphamesh.io._mesh_meshio import as_meshio

if TYPE_CHECKING:
    from alphamesh.io._mesh import Mesh

__all__ = ["to_meshio", "to_open3d", "to_pyvista", "to_trimesh"]

# What VTK calls the kinds of cells.
_VTK_TYPES = {"vertex": 1, "line": 3, "triangle": 5, "tetra": 10}


def to_meshio(mesh: Mesh) -> Any:
    """Return a mesh as a ``meshio.Mesh``, with all its cells and numbers.

    Raises
    ------
    MissingLibraryError
        If meshio is not installed.
    """
    return as_meshio(mesh)


def to_trimesh(mesh: Mesh) -> Any:
    """Return the triangles of a mesh as a ``trimesh.Trimesh``, vertex by vertex.

    Nothing is merged or reordered. The numbers per point are its ``vertex_attributes``,
    those per triangle its ``face_attributes``.

    Raises
    ------
    MissingLibraryError
        If trimesh is not installed.
    """
    try:
        import trimesh
    except ImportError as error:
        raise MissingLibraryError.of("trimesh", "trimesh", "Making its meshes") from error
    return trimesh.Trimesh(
        np.array(in_space(mesh)),
        np.array(rows_of(mesh, "triangle"), dtype=np.int64),
        vertex_attributes={name: np.array(data) for name, data in mesh.point_data.items()},
        face_attributes={
            name: np.array(data["triangle"])
            for name, data in mesh.cell_data.items()
            if "triangle" in data
        },
        process=False,
    )


def to_pyvista(mesh: Mesh) -> Any:
    """Return a mesh as a ``pyvista.UnstructuredGrid``, with all its cells and numbers.

    Raises
    ------
    MissingLibraryError
        If pyvista is not installed.
    """
    try:
        import pyvista
    except ImportError as error:
        raise MissingLibraryError.of("pyvista", "pyvista", "Making its grids") from error
    kinds = [kind for kind, rows in mesh.cells.items() if len(rows)]
    listed = [_counted(mesh, kind) for kind in kinds]
    types = [np.full(len(rows_of(mesh, kind)), _VTK_TYPES[kind], np.uint8) for kind in kinds]
    grid = pyvista.UnstructuredGrid(
        np.concatenate(listed) if listed else np.empty(0, np.int64),
        np.concatenate(types) if types else np.empty(0, np.uint8),
        np.array(in_space(mesh)),
    )
    for name, values in mesh.point_data.items():
        grid.point_data[name] = np.array(values)
    for name, by_kind in mesh.cell_data.items():
        if kinds:
            grid.cell_data[name] = np.concatenate([by_kind[kind] for kind in kinds])
    return grid


def _counted(mesh: Mesh, kind: str) -> np.ndarray[Any, np.dtype[np.int64]]:
    """Return cells as VTK lists them: each after the number of its corners."""
    rows = rows_of(mesh, kind).astype(np.int64)
    return np.insert(rows, 0, rows.shape[1], axis=1).ravel()


def to_open3d(mesh: Mesh) -> Any:
    """Return the triangles of a mesh as an ``open3d.geometry.TriangleMesh``.

    Raises
    ------
    MissingLibraryError
        If open3d is not installed.
    """
    try:
        import open3d
    except ImportError as error:
        raise MissingLibraryError.of("open3d", "open3d", "Making its meshes") from error
    utility = open3d.utility
    return open3d.geometry.TriangleMesh(
        utility.Vector3dVector(np.array(in_space(mesh))),
        utility.Vector3iVector(np.array(rows_of(mesh, "triangle"), dtype=np.int32)),
    )
