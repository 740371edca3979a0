"""The boundary of a set of tetrahedra: closed, oriented, and made manifold."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from alphamesh._arrays import Record, read_only
from alphamesh._kernels.space import parts3
from alphamesh._kernels.surfaces import outer_shells3, surface3
from alphamesh.errors import ParameterError
from alphamesh.manifold import is_closed, is_manifold, is_oriented, side_keys
from alphamesh.shells import Shells, shell_measures

if TYPE_CHECKING:
    import os

    from matplotlib.axes import Axes

    from alphamesh._arrays import BoolArray, FloatArray, IntArray
    from alphamesh._kernels.surfaces import Skin
    from alphamesh.filtration3d import Filtration3D
    from alphamesh.io.meshes import Mesh
    from alphamesh.plot import Drawing

__all__ = ["Surface", "boundary_surface"]


@dataclass(frozen=True, eq=False, repr=False)
class Surface(Record):
    """The boundary of a shape in space, a closed surface of triangles.

    Attributes
    ----------
    points : (v, 3) float64
        Its vertices, in the order of the cloud's rows.
    triangles : (k, 3) int32
        Rows of `points`, counter-clockwise seen from outside of the shape.
    source_rows : (v,) int32
        The row of the cloud that each vertex is.
    facets : (k,) int32
        The number of each triangle in ``filtration.simplices[2]``, ascending.
    shell_labels : (k,) int32
        The shell of each triangle, a row of :attr:`shells`.
    shells : Shells
    is_split : bool
        Whether points of the cloud stand here several times, so that the surface is a
        manifold: every edge has exactly two triangles, and the triangles at a vertex
        form one fan.

    All arrays are read-only.
    """

    points: FloatArray
    triangles: IntArray
    source_rows: IntArray
    facets: IntArray
    shell_labels: IntArray
    shells: Shells
    is_split: bool

    @property
    def area(self) -> float:
        """Area of all triangles, in squared units of the points."""
        return float(self.shells.areas.sum())

    @property
    def volume(self) -> float:
        """Enclosed volume, cavities taken off, in cubed units of the points."""
        return float(self.shells.volumes.sum())

    @cached_property
    def edges(self) -> IntArray:
        """All edges, ``(e, 2)`` int32, each ascending and once."""
        keys = np.unique(side_keys(self.triangles))
        return read_only(np.column_stack((keys >> 32, keys & 0xFFFFFFFF)).astype(np.int32))

    @property
    def euler_characteristic(self) -> int:
        """Vertices minus edges plus triangles of these arrays, as they are."""
        return len(self.points) - len(self.edges) + len(self.triangles)

    # What it is, told from its triangles alone

    @cached_property
    def is_closed(self) -> bool:
        """Whether every edge has an even number of triangles."""
        return is_closed(self.triangles)

    @cached_property
    def is_oriented(self) -> bool:
        """Whether every edge is run along as often one way as the other."""
        return is_oriented(self.triangles)

    @cached_property
    def is_manifold(self) -> bool:
        """Whether each edge has two triangles, and those at each vertex form one fan."""
        return is_manifold(self.triangles)

    # What to make of it

    def select(self, shells: Any) -> Surface:
        """Return some of the shells as a surface of its own.

        Parameters
        ----------
        shells : array-like of int or bool
            Numbers of shells, or one truth value for each.

        Returns
        -------
        Surface

        Raises
        ------
        ParameterError
            If there are no such shells.

        Examples
        --------
        >>> outside = surface.select(surface.shells.is_outer)       # doctest: +SKIP
        """
        kept = _chosen(shells, len(self.shells))
        numbers = np.cumsum(kept, dtype=np.int32) - np.int32(1)
        there = kept.take(self.shell_labels)
        triangles = self.triangles.compress(there, axis=0)
        used = np.zeros(len(self.points), dtype=bool)
        used[triangles] = True
        new = np.cumsum(used, dtype=np.int32) - np.int32(1)
        return Surface(
            read_only(self.points.compress(used, axis=0)),
            read_only(new.take(triangles)),
            read_only(self.source_rows.compress(used)),
            read_only(self.facets.compress(there)),
            read_only(numbers.take(self.shell_labels.compress(there))),
            self.shells.take(kept),
            self.is_split,
        )

    def outer(self) -> Surface:
        """Return the surface without the walls of cavities."""
        return self.select(self.shells.is_outer)

    def mesh(self) -> Mesh:
        """Return the surface as the mesh that is written to files.

        Returns
        -------
        Mesh
            With the point numbers ``"input_row"``, which are `source_rows`, and the cell
            numbers ``"shell"``.
        """
        from alphamesh.io.meshes import Mesh

        return Mesh(
            self.points,
            {"triangle": self.triangles},
            {"input_row": self.source_rows},
            {"shell": {"triangle": self.shell_labels}},
        )

    def save(self, path: str | os.PathLike[str], *, file_format: str | None = None) -> None:
        """Write the surface to a mesh file, whole or not at all.

        Parameters and errors are those of :func:`alphamesh.write_mesh`.
        """
        from alphamesh.io.meshes import write_mesh

        write_mesh(self.mesh(), path, file_format=file_format)

    def to_trimesh(self) -> Any:
        """Return the surface as a ``trimesh.Trimesh``, vertex by vertex.

        Its ``vertex_attributes["input_row"]`` are `source_rows`, its
        ``face_attributes["shell"]`` are `shell_labels`.

        Raises
        ------
        MissingLibraryError
            If trimesh is not installed.
        """
        from alphamesh.io.exports import to_trimesh

        return to_trimesh(self.mesh())

    def to_pyvista(self) -> Any:
        """Return the surface as ``pyvista.PolyData``, with its numbers.

        Raises
        ------
        MissingLibraryError
            If pyvista is not installed.
        """
        from alphamesh.io.exports import to_pyvista

        return to_pyvista(self.mesh()).extract_surface(algorithm=None)

    def to_meshio(self) -> Any:
        """Return the surface as a ``meshio.Mesh``, with its numbers.

        Raises
        ------
        MissingLibraryError
            If meshio is not installed.
        """
        from alphamesh.io.exports import to_meshio

        return to_meshio(self.mesh())

    def to_open3d(self) -> Any:
        """Return the surface as an ``open3d.geometry.TriangleMesh``.

        Raises
        ------
        MissingLibraryError
            If open3d is not installed.
        """
        from alphamesh.io.exports import to_open3d

        return to_open3d(self.mesh())

    def plot(self, ax: Axes | None = None, **options: Any) -> Drawing:
        """Draw the surface, lit and seen in perspective, on matplotlib axes.

        Parameters are those of :func:`alphamesh.plot.plot_surface`.
        """
        from alphamesh.plot import plot_surface

        return plot_surface(self, ax, **options)

    def __repr__(self) -> str:
        shells = len(self.shells)
        return (
            f"<Surface: {len(self.triangles):,} triangles, {shells:,} "
            f"shell{'s' * (shells != 1)}>"
        )


def boundary_surface(
    filtration: Filtration3D, has_tetrahedron: BoolArray, *, manifold: bool = True
) -> Surface:
    """Return the boundary of some tetrahedra.

    Parameters
    ----------
    filtration : Filtration3D
    has_tetrahedron : (T,) bool
        Which tetrahedra the shape has.
    manifold : bool, default True
        Where the boundary is pinched, at an edge in four facets or more or at a point
        with several fans of facets, give each sheet vertices of its own: equal in
        coordinates, and with the same `source_rows`. Around a pinched edge, two facets
        belong together if they bound the same wedge of tetrahedra; parts of the shape
        that touch at an edge or at a point only come apart, so that each region has
        surfaces of its own. Only where two sheets are connected around both ends of the
        edge, so that there is no parting them, two facets before the same gap belong
        together: the gap, of no width, is closed. With False, each point of the cloud is
        one vertex.

    Returns
    -------
    Surface
        Closed, and oriented: the triangles are counter-clockwise seen from outside.

    Notes
    -----
    Nothing is measured to find out which facets belong together: a walk around the edge
    through the tetrahedra leads from one to the other. So the result is right for the
    flattest of tetrahedra.
    """
    _, _, triangles, tetrahedra = filtration.simplices
    skin = surface3(
        filtration.points,
        tetrahedra,
        triangles,
        filtration.triangle_tetrahedra,
        filtration.tetrahedron_triangles,
        has_tetrahedron,
    )
    shells, order = _measured(filtration, skin, _is_outer(filtration, has_tetrahedron, skin))
    labels = read_only(order.take(skin.shells))
    rows, corners = skin.rows, skin.vertices
    if not manifold:
        rows, corners = _one_each(len(filtration.points), skin.corners)
    points = read_only(filtration.points.take(rows, axis=0))
    return Surface(points, corners, rows, skin.facets, labels, shells, manifold)


def _one_each(count: int, corners: IntArray) -> tuple[IntArray, IntArray]:
    """Return the rows in use, ascending, and the corners as numbers of these."""
    used = np.zeros(count, dtype=bool)
    used[corners] = True
    rows = np.flatnonzero(used).astype(np.int32)
    numbers = np.cumsum(used, dtype=np.int32) - np.int32(1)
    return read_only(rows), read_only(numbers.take(corners))


def _is_outer(filtration: Filtration3D, has_tetrahedron: BoolArray, skin: Skin) -> BoolArray:
    """Return which shells enclose their region."""
    if len(skin.facets) == 0:
        return np.zeros(0, dtype=bool)
    no_walls = np.zeros(len(filtration.triangle_tetrahedra), dtype=bool)
    # The last entry is that of -1, no tetrahedron: the part around everything.
    parts = np.append(
        parts3(filtration.triangle_tetrahedra, has_tetrahedron, no_walls), np.int32(-1)
    )
    both = parts.take(filtration.triangle_tetrahedra.take(skin.facets, axis=0), mode="wrap")
    return outer_shells3(skin.shells, both.max(axis=1), -1 - both.min(axis=1))


def _measured(
    filtration: Filtration3D, skin: Skin, is_outer: BoolArray
) -> tuple[Shells, IntArray]:
    """Return the shells, the largest first, and the new number of each."""
    count = len(is_outer)
    triangles = np.bincount(skin.shells, minlength=count)
    vertex_shells = np.empty(len(skin.rows), dtype=np.int32)
    vertex_shells[skin.vertices] = skin.shells[:, np.newaxis]
    # A closed surface has three edges for each two triangles.
    euler = np.bincount(vertex_shells, minlength=count) - triangles // 2
    areas, volumes = shell_measures(filtration.points, skin.corners, skin.shells, count)
    order = np.argsort(-np.abs(volumes), kind="stable")
    numbers = np.empty(count, dtype=np.int32)
    numbers[order] = np.arange(count)
    return Shells(triangles, areas, volumes, euler, is_outer).take(order), numbers


def _chosen(wanted: Any, count: int) -> BoolArray:
    """Return numbers or truth values as truth values."""
    chosen = np.asarray(wanted)
    if chosen.dtype == bool and chosen.shape == (count,):
        return chosen
    if chosen.size and (
        chosen.dtype.kind not in "iu" or not 0 <= chosen.min() <= chosen.max() < count
    ):
        raise ParameterError(
            f"shells must be numbers from 0 to {count - 1}, or {count} truth values; "
            f"got {wanted!r}"
        )
    kept = np.zeros(count, dtype=bool)
    kept[chosen.astype(np.intp)] = True
    return kept
