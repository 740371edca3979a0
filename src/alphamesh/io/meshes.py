"""Mesh files: what each format holds, and how a mesh is written into one."""

from __future__ import annotations

import os
import warnings
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path

from alphamesh.errors import (
    AlphameshError,
    FileReadError,
    FileWriteError,
    LossyFormatWarning,
    ParameterError,
)
from alphamesh.io._atomic import atomic_path
from alphamesh.io._mesh import CELL_CORNERS, DoesNotFit, Mesh, compact, with_input_rows
from alphamesh.io._mesh_meshio import read_off, read_with_meshio, write_vtk, write_vtu
from alphamesh.io._mesh_msh import read_msh, write_msh
from alphamesh.io._mesh_plain import (
    read_npz,
    stl_corners,
    write_npz,
    write_obj,
    write_off,
    write_ply,
    write_stl,
)
from alphamesh.io._mesh_ply import read_ply
from alphamesh.io._vertex_data import tell_of_lost_data, vertex_data
from alphamesh.io.geo import GEO_FORMATS

__all__ = [
    "MESH_FORMATS",
    "Mesh",
    "MeshFormat",
    "compact",
    "mesh_format",
    "read_mesh",
    "tell_of_lost_data",
    "vertex_data",
    "write_mesh",
]


@dataclass(frozen=True, slots=True)
class MeshFormat:
    """A mesh file format and what it can hold.

    Attributes
    ----------
    name : str
        As its users call it.
    note : str
        What to know about it.
    write, read : callable
        Its writer and reader; :func:`write_mesh` and :func:`read_mesh` are safer.
    cells : tuple of str
        The kinds of cells that it holds, of ``"vertex"``, ``"line"``, ``"triangle"``
        and ``"tetra"``; others are left out with a :class:`LossyFormatWarning`.
    point_data, cell_data : bool
        Whether numbers per point and per cell are stored.
    double : bool
        Whether coordinates keep all their 64 bits.
    """

    name: str
    note: str
    write: Callable[[Mesh, Path], None] = field(repr=False)
    read: Callable[[Path], Mesh] = field(repr=False)
    cells: tuple[str, ...] = tuple(CELL_CORNERS)
    point_data: bool = True
    cell_data: bool = True
    double: bool = True


def _meshio_reader(module: str) -> Callable[[Path], Mesh]:
    return partial(read_with_meshio, module=module)


_NO_TETRA = ("vertex", "line", "triangle")

MESH_FORMATS: dict[str, MeshFormat] = {
    ".vtu": MeshFormat(
        "VTU",
        "ParaView's own; binary; needs meshio",
        write_vtu,
        _meshio_reader("vtu"),
    ),
    ".vtk": MeshFormat(
        "VTK",
        "the older VTK format (5.1); binary, integers in 64 bits; needs meshio",
        write_vtk,
        _meshio_reader("vtk"),
    ),
    ".msh": MeshFormat(
        "MSH",
        "Gmsh 4.1; binary, all numbers as float64; each kind of cell is a physical group",
        write_msh,
        read_msh,
    ),
    ".npz": MeshFormat(
        "NPZ",
        "NumPy arrays: points (two-dimensional ones stay so), vertices, edges, triangles, "
        "tetrahedra, and numbers such as points.input_row and triangles.radius",
        write_npz,
        read_npz,
    ),
    ".ply": MeshFormat(
        "PLY",
        "binary; isolated vertices are vertices that no face uses, singular edges are "
        "elements of their own (`edge`), which some programs skip and meshio refuses",
        write_ply,
        read_ply,
        cells=_NO_TETRA,
        cell_data=False,
    ),
    ".obj": MeshFormat(
        "OBJ",
        "text; triangles are `f`, singular edges `l` and isolated vertices `p`; many "
        "programs skip the last two",
        write_obj,
        _meshio_reader("obj"),
        cells=_NO_TETRA,
        point_data=False,
        cell_data=False,
    ),
    ".off": MeshFormat(
        "OFF",
        "text; isolated vertices are vertices that no face uses",
        write_off,
        read_off,
        cells=("vertex", "triangle"),
        point_data=False,
        cell_data=False,
    ),
    ".stl": MeshFormat(
        "STL",
        "binary; the corners of each triangle in 32-bit numbers, no common vertices; "
        "normals of two-dimensional meshes point up (+z)",
        write_stl,
        _meshio_reader("stl"),
        cells=("triangle",),
        point_data=False,
        cell_data=False,
        double=False,
    ),
}
"""The formats by file extension."""


def write_mesh(
    mesh: Mesh,
    path: str | os.PathLike[str],
    *,
    file_format: str | None = None,
    keep_all: bool = False,
) -> None:
    """Write a mesh to a file, whole or not at all.

    Two-dimensional points get z = 0, except in NPZ. :data:`MESH_FORMATS` tells what each
    format holds. The same mesh gives the same bytes.

    Parameters
    ----------
    mesh : Mesh
    path : path-like
        Where to; an existing file is replaced once the new one is complete.
    file_format : str, optional
        A key of :data:`MESH_FORMATS`, with or without the dot; by default the extension
        of `path`.
    keep_all : bool, default False
        Write all points. By default only those that a cell uses are written, in their
        order. The point numbers ``"input_row"`` tell their rows in ``mesh.points``, unless
        `mesh` has such numbers already.

    Raises
    ------
    FileWriteError
        If the extension is unknown, the file cannot be written, or the format cannot
        hold the mesh.
    ParameterError
        If `file_format` is unknown.
    MissingLibraryError
        If the format needs meshio, and it is not installed.

    Warns
    -----
    LossyFormatWarning
        If cells are left out, or triangles collapse in 32-bit numbers.
    """
    chosen = mesh_format(path, file_format)
    held = mesh.only(chosen.cells)
    held = with_input_rows(held) if keep_all else compact(held)
    try:
        for loss in _losses(mesh, held, chosen):
            warnings.warn(f"{os.fspath(path)}: {loss}", LossyFormatWarning, stacklevel=2)
        with atomic_path(path) as temporary:
            chosen.write(held, temporary)
    except DoesNotFit as error:
        raise FileWriteError(f"cannot write '{os.fspath(path)}': {error}") from error


def read_mesh(path: str | os.PathLike[str], *, file_format: str | None = None) -> Mesh:
    """Read a mesh file.

    Points are three-dimensional, as in the files, except in NPZ. Of the numbers, those
    with one component are read. Outside of NPZ, files are read by meshio, which knows
    neither meshes without points, nor VTU and VTK files without cells, nor the edges of
    OBJ; PLY files with edges are read without it.

    Parameters
    ----------
    path : path-like
    file_format : str, optional
        A key of :data:`MESH_FORMATS`; by default the extension of `path`.

    Returns
    -------
    Mesh

    Raises
    ------
    FileReadError
        If the file is missing, or is not what its name says.
    ParameterError
        If `file_format` is unknown.
    MissingLibraryError
        If meshio is needed, and not installed.
    """
    chosen = mesh_format(path, file_format, reading=True)
    shown = f"'{os.fspath(path)}'"
    try:
        with Path(path).open("rb"):
            pass
    except OSError as error:
        raise FileReadError(f"cannot read {shown}: {error.strerror}") from error
    try:
        return chosen.read(Path(path))
    except AlphameshError as error:
        if isinstance(error, ImportError):
            raise
        raise FileReadError(f"cannot read {shown} as {chosen.name}: {error}") from error
    except Exception as error:  # meshio fails in any way on a file that is not as expected
        detail = str(error) or type(error).__name__
        raise FileReadError(
            f"cannot read {shown} as {chosen.name} ({detail}); "
            "it is damaged, of another format, or of a variant that is not supported"
        ) from error


def mesh_format(
    path: str | os.PathLike[str], file_format: str | None = None, *, reading: bool = False
) -> MeshFormat:
    """Return the format of a mesh file, from its name unless `file_format` says it.

    Parameters
    ----------
    path : path-like
    file_format : str, optional
        A key of :data:`MESH_FORMATS`, with or without the dot.
    reading : bool, default False
        Whether the file is to be read; only the error differs.

    Raises
    ------
    FileWriteError, FileReadError
        If the extension is unknown.
    ParameterError
        If `file_format` is unknown.
    """
    known = ", ".join(MESH_FORMATS)
    if file_format is not None:
        key = "." + file_format.lower().removeprefix(".")
        if key not in MESH_FORMATS:
            raise ParameterError(f"unknown mesh format {file_format!r}; there are {known}")
        return MESH_FORMATS[key]
    key = Path(path).suffix.lower()
    if key in MESH_FORMATS:
        return MESH_FORMATS[key]
    what = f"the extension {key!r} is no mesh format" if key else "the name has no extension"
    verb, kind = ("read", FileReadError) if reading else ("write", FileWriteError)
    if key in GEO_FORMATS:
        known += "; for outlines in a GIS, " + ("read_geo" if reading else "save_outlines")
    raise kind(f"cannot {verb} '{os.fspath(path)}': {what}; choose one of {known}")


_NOUNS = {
    "vertex": ("isolated vertex", "isolated vertices"),
    "line": ("singular edge", "singular edges"),
    "triangle": ("triangle", "triangles"),
    "tetra": ("tetrahedron", "tetrahedra"),
}


def _losses(mesh: Mesh, held: Mesh, chosen: MeshFormat) -> list[str]:
    """Say what of the mesh the format cannot hold."""
    losses = []
    left_out = {
        kind: len(rows)
        for kind, rows in mesh.cells.items()
        if len(rows) and kind not in chosen.cells
    }
    if left_out:
        counts = " and ".join(
            f"{count} {_NOUNS[kind][count != 1]}" for kind, count in left_out.items()
        )
        keep_them = (
            key for key, fmt in MESH_FORMATS.items() if set(left_out) <= set(fmt.cells)
        )
        losses.append(
            f"{chosen.name} files cannot hold {counts}, left out; "
            f"these formats can: {', '.join(keep_them)}"
        )
    if not chosen.double:
        n_collapsed, _ = stl_corners(held)
        if n_collapsed:
            losses.append(
                f"{n_collapsed} triangles collapse in the 32-bit numbers of {chosen.name}; "
                "move the points towards the origin, or choose .ply"
            )
    return losses
