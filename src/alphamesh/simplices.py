"""A set of simplices of a filtration, with all their faces: which, and how large."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from alphamesh._arrays import Record, read_only
from alphamesh._kernels.topology import component_count
from alphamesh.boundary import directed_boundary_edges
from alphamesh.classify import SimplexKind, chosen
from alphamesh.filtration import Filtration
from alphamesh.measures import total_length

if TYPE_CHECKING:
    import os

    from matplotlib.axes import Axes

    from alphamesh._arrays import BoolArray, FloatArray, IntArray, KindArray
    from alphamesh.io.meshes import Mesh
    from alphamesh.plot import Drawing

__all__ = ["SimplexSet"]


@dataclass(frozen=True, eq=False, repr=False)
class SimplexSet(Record):
    """Simplices of a filtration, and all their faces.

    What is in it, a subclass says: ``_vertex_kinds``, ``_edge_kinds`` and
    ``_has_triangle``. Each property is computed when it is first asked for, in a few
    passes over arrays, and kept. Simplices are rows of `points`, in the order of the
    filtration. Arrays are read-only.

    Attributes
    ----------
    filtration : Filtration
    radius : float
    """

    filtration: Filtration
    radius: float

    @property
    def points(self) -> FloatArray:
        """The cloud, ``(n, 2)`` float64; duplicates and all."""
        return self.filtration.points

    @property
    def crs(self) -> Any:
        """The coordinate reference system that came with the points, or None."""
        return self.filtration.crs

    # Which simplices

    @cached_property
    def kinds(self) -> tuple[KindArray, KindArray, KindArray]:
        """Kind of every vertex, edge and triangle of the filtration, three int8 arrays.

        ``shape.kinds[k][i]`` is the :class:`~alphamesh.classify.SimplexKind` of
        ``shape.filtration.simplices[k][i]``: 0 exterior, 1 singular, 2 regular,
        3 interior.
        """
        triangles = self._has_triangle.view(np.int8) * np.int8(SimplexKind.INTERIOR)
        return self._vertex_kinds, self._edge_kinds, read_only(triangles)

    @property
    def _vertex_kinds(self) -> KindArray:
        raise NotImplementedError

    @property
    def _edge_kinds(self) -> KindArray:
        raise NotImplementedError

    @property
    def _has_triangle(self) -> BoolArray:
        raise NotImplementedError

    @cached_property
    def triangles(self) -> IntArray:
        """Triangles, ``(k, 3)`` int32, each counter-clockwise from its lowest row."""
        return chosen(self.filtration.oriented_triangles, self._has_triangle)

    @cached_property
    def edges(self) -> IntArray:
        """All edges of the complex, ``(k, 2)`` int32, each ascending."""
        return chosen(self.filtration.simplices[1], self._edge_kinds != SimplexKind.EXTERIOR)

    @cached_property
    def singular_edges(self) -> IntArray:
        """Edges in none of the triangles, ``(k, 2)`` int32, each ascending."""
        return self._edges_of(SimplexKind.SINGULAR)

    @cached_property
    def regular_edges(self) -> IntArray:
        """Edges of exactly one triangle, ``(k, 2)`` int32, each ascending."""
        return self._edges_of(SimplexKind.REGULAR)

    @cached_property
    def interior_edges(self) -> IntArray:
        """Edges between two triangles, ``(k, 2)`` int32, each ascending."""
        return self._edges_of(SimplexKind.INTERIOR)

    def _edges_of(self, kind: SimplexKind) -> IntArray:
        return chosen(self.filtration.simplices[1], self._edge_kinds == kind)

    @cached_property
    def boundary_edges(self) -> IntArray:
        """Boundary of the triangles, ``(k, 2)`` int32: from, to, with the shape on the left.

        These are the regular edges, in the same order. They run counter-clockwise around
        the shape and clockwise around its holes.
        """
        return directed_boundary_edges(self.filtration, self._has_triangle, self._edge_kinds)

    @cached_property
    def isolated_vertices(self) -> IntArray:
        """Vertices without any edge, ``(k,)`` int32."""
        raise NotImplementedError

    @cached_property
    def singular_vertices(self) -> IntArray:
        """Vertices in none of the triangles, ``(k,)`` int32; isolated ones among them."""
        return chosen(self._vertices, self._vertex_kinds == SimplexKind.SINGULAR)

    @cached_property
    def regular_vertices(self) -> IntArray:
        """Vertices on the boundary of the triangles, ``(k,)`` int32."""
        return chosen(self._vertices, self._vertex_kinds == SimplexKind.REGULAR)

    @cached_property
    def interior_vertices(self) -> IntArray:
        """Vertices with triangles all around them, ``(k,)`` int32."""
        return chosen(self._vertices, self._vertex_kinds == SimplexKind.INTERIOR)

    @property
    def _vertices(self) -> IntArray:
        return self.filtration.simplices[0][:, 0]

    # How large

    @cached_property
    def area(self) -> float:
        """Area of the triangles, in squared units of the points."""
        with np.errstate(over="ignore"):
            return float(self.filtration.triangle_areas.compress(self._has_triangle).sum())

    @cached_property
    def perimeter(self) -> float:
        """Length of the boundary of the triangles, around the shape and its holes."""
        return total_length(self.points, self.regular_edges)

    @cached_property
    def counts(self) -> dict[str, int]:
        """Number of simplices of each kind, by name."""
        singular, regular, interior = (
            int(np.count_nonzero(self._edge_kinds == kind)) for kind in list(SimplexKind)[1:]
        )
        return {
            "vertices": int(np.count_nonzero(self._vertex_kinds)),
            "edges": singular + regular + interior,
            "triangles": int(np.count_nonzero(self._has_triangle)),
            "singular_edges": singular,
            "regular_edges": regular,
            "interior_edges": interior,
            "isolated_vertices": len(self.isolated_vertices),
        }

    @property
    def euler_characteristic(self) -> int:
        """Vertices minus edges plus triangles: components minus holes of the complex."""
        counts = self.counts
        return counts["vertices"] - counts["edges"] + counts["triangles"]

    @cached_property
    def betti(self) -> tuple[int, int]:
        """Betti numbers ``(b0, b1)``: how many components and holes the complex has.

        Components by union-find over the edges; holes are as many as the Euler
        characteristic lacks. No persistence is needed.
        """
        # Rows that are no vertices of the complex stand alone, and are not counted.
        absent = len(self.points) - self.counts["vertices"]
        components = component_count(len(self.points), self.edges) - absent
        return components, components - self.euler_characteristic

    # What to do with it

    def mesh(self, point_data: Any = None) -> Mesh:
        """Return the complex as the mesh that is written to files.

        Parameters
        ----------
        point_data : mapping, DataFrame or PointTable, optional
            Columns of the points, one number for each, to stay with the vertices.

        Returns
        -------
        Mesh
            The triangles, the singular edges as lines and the isolated vertices as
            vertices, over all rows of `points`. The numbers ``"radius"`` of its cells
            are their filtration values.

        Raises
        ------
        ParameterError
            If a column has not one value for each point.

        Warns
        -----
        LossyFormatWarning
            If columns hold no numbers, which meshes cannot hold: they are left out.
        """
        from alphamesh.io.meshes import Mesh, vertex_data

        vertex_radii, edge_radii, triangle_radii = self.filtration.radii
        alone = np.searchsorted(self._vertices, self.isolated_vertices)
        return Mesh(
            self.points,
            {
                "vertex": self.isolated_vertices,
                "line": self.singular_edges,
                "triangle": self.triangles,
            },
            point_data=vertex_data(point_data, len(self.points)),
            cell_data={
                "radius": {
                    "vertex": vertex_radii.take(alone),
                    "line": edge_radii.compress(self._edge_kinds == SimplexKind.SINGULAR),
                    "triangle": triangle_radii.compress(self._has_triangle),
                }
            },
        )

    def save(
        self,
        path: str | os.PathLike[str],
        *,
        file_format: str | None = None,
        keep_all: bool = False,
        point_data: Any = None,
    ) -> None:
        """Write the complex to a mesh file, whole or not at all.

        Vertices are written in the order of the points, with their rows in `points` as
        the numbers ``"input_row"`` where the format holds numbers.

        Parameters
        ----------
        path : path-like
            An existing file is replaced once the new one is complete.
        file_format : str, optional
            A key of ``alphamesh.MESH_FORMATS``; by default the extension of `path`.
        keep_all : bool, default False
            Write duplicates, too, so that the rows of the file are those of `points`.
        point_data : mapping, DataFrame or PointTable, optional
            Columns of the points, one number for each: they become numbers of the
            vertices, where the format holds such.

        Raises
        ------
        FileWriteError
            If it cannot be written, or the extension is unknown.
        ParameterError
            If `file_format` is unknown.
        MissingLibraryError
            If the format needs a library that is not installed.

        Warns
        -----
        LossyFormatWarning
            If the format leaves out singular edges or isolated vertices, or columns of
            `point_data`.
        """
        from alphamesh.io.meshes import mesh_format, tell_of_lost_data, write_mesh

        chosen = mesh_format(path, file_format)
        if point_data is not None and not chosen.point_data:
            tell_of_lost_data(path, chosen.name)
            point_data = None
        mesh = self.mesh(point_data)
        write_mesh(mesh, path, file_format=file_format, keep_all=keep_all)

    def plot(self, ax: Axes | None = None) -> Drawing:
        """Draw the complex on matplotlib axes, new ones if `ax` is None.

        See :func:`alphamesh.plot.plot_complex`.
        """
        from alphamesh.plot import plot_complex

        return plot_complex(self, ax)
