"""A set of simplices of a filtration in space, with all their faces: which, how large."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from alphamesh._arrays import Record, read_only
from alphamesh._kernels.topology import component_count
from alphamesh.classify import SimplexKind, chosen
from alphamesh.delaunay3d import outward_triangles
from alphamesh.filtration3d import Filtration3D

if TYPE_CHECKING:
    import os

    from alphamesh._arrays import BoolArray, FloatArray, IntArray, KindArray
    from alphamesh.io.meshes import Mesh

__all__ = ["SimplexSet3D"]


@dataclass(frozen=True, eq=False, repr=False)
class SimplexSet3D(Record):
    """Simplices of a filtration in space, and all their faces.

    What is in it, a subclass says: ``_vertex_kinds``, ``_edge_kinds``,
    ``_triangle_kinds`` and ``_has_tetrahedron``. Each property is computed when it is
    first asked for, in a few passes over arrays, and kept. Simplices are rows of
    `points`, in the order of the filtration. Arrays are read-only.

    Attributes
    ----------
    filtration : Filtration3D
    radius : float
    """

    filtration: Filtration3D
    radius: float

    @property
    def points(self) -> FloatArray:
        """The cloud, ``(n, 3)`` float64; duplicates and all."""
        return self.filtration.points

    @property
    def crs(self) -> Any:
        """The coordinate reference system that came with the points, or None."""
        return self.filtration.crs

    # Which simplices

    @cached_property
    def kinds(self) -> tuple[KindArray, KindArray, KindArray, KindArray]:
        """Kind of every vertex, edge, triangle and tetrahedron, four int8 arrays.

        ``shape.kinds[k][i]`` is the :class:`~alphamesh.classify.SimplexKind` of
        ``shape.filtration.simplices[k][i]``: 0 exterior, 1 singular, 2 regular,
        3 interior.
        """
        tetrahedra = self._has_tetrahedron.view(np.int8) * np.int8(SimplexKind.INTERIOR)
        return self._vertex_kinds, self._edge_kinds, self._triangle_kinds, read_only(tetrahedra)

    @property
    def _vertex_kinds(self) -> KindArray:
        raise NotImplementedError

    @property
    def _edge_kinds(self) -> KindArray:
        raise NotImplementedError

    @property
    def _triangle_kinds(self) -> KindArray:
        raise NotImplementedError

    @property
    def _has_tetrahedron(self) -> BoolArray:
        raise NotImplementedError

    @cached_property
    def tetrahedra(self) -> IntArray:
        """Tetrahedra, ``(k, 4)`` int32, each positively oriented from its lowest row on.

        Seen from the last corner, the other three run counter-clockwise.
        """
        return chosen(self.filtration.oriented_tetrahedra, self._has_tetrahedron)

    @cached_property
    def triangles(self) -> IntArray:
        """All triangles of the complex, ``(k, 3)`` int32, each ascending."""
        kinds = self._triangle_kinds
        return chosen(self.filtration.simplices[2], kinds != SimplexKind.EXTERIOR)

    @cached_property
    def singular_triangles(self) -> IntArray:
        """Triangles of none of the tetrahedra, ``(k, 3)`` int32, each ascending."""
        return self._triangles_of(SimplexKind.SINGULAR)

    @cached_property
    def regular_triangles(self) -> IntArray:
        """Triangles of exactly one tetrahedron, ``(k, 3)`` int32, each ascending."""
        return self._triangles_of(SimplexKind.REGULAR)

    @cached_property
    def interior_triangles(self) -> IntArray:
        """Triangles between two tetrahedra, ``(k, 3)`` int32, each ascending."""
        return self._triangles_of(SimplexKind.INTERIOR)

    def _triangles_of(self, kind: SimplexKind) -> IntArray:
        return chosen(self.filtration.simplices[2], self._triangle_kinds == kind)

    @cached_property
    def boundary_triangles(self) -> IntArray:
        """Boundary of the tetrahedra, ``(k, 3)`` int32, counter-clockwise seen from outside.

        These are the regular triangles, in the same order; each begins with its lowest
        row. Around voids, outside is in the void.
        """
        regular = np.flatnonzero(self._triangle_kinds == SimplexKind.REGULAR)
        triangles = self.filtration.simplices[2].take(regular, axis=0)
        cofaces = self.filtration.triangle_tetrahedra.take(regular, axis=0)
        first_is_in = self._has_tetrahedron.take(cofaces[:, 0])
        inside = np.where(first_is_in, cofaces[:, 0], cofaces[:, 1])
        corners = self.filtration.simplices[3].take(inside, axis=0)
        apexes = corners.sum(axis=1) - triangles.sum(axis=1)
        return outward_triangles(self.points, triangles, apexes.astype(np.int32))

    @cached_property
    def edges(self) -> IntArray:
        """All edges of the complex, ``(k, 2)`` int32, each ascending."""
        return chosen(self.filtration.simplices[1], self._edge_kinds != SimplexKind.EXTERIOR)

    @cached_property
    def singular_edges(self) -> IntArray:
        """Edges of none of the tetrahedra, ``(k, 2)`` int32, each ascending."""
        return self._edges_of(SimplexKind.SINGULAR)

    @cached_property
    def regular_edges(self) -> IntArray:
        """Edges on the boundary of the tetrahedra, ``(k, 2)`` int32, each ascending."""
        return self._edges_of(SimplexKind.REGULAR)

    @cached_property
    def interior_edges(self) -> IntArray:
        """Edges with tetrahedra all around them, ``(k, 2)`` int32, each ascending."""
        return self._edges_of(SimplexKind.INTERIOR)

    def _edges_of(self, kind: SimplexKind) -> IntArray:
        return chosen(self.filtration.simplices[1], self._edge_kinds == kind)

    @cached_property
    def isolated_edges(self) -> IntArray:
        """Edges without any triangle, ``(k, 2)`` int32, each ascending."""
        return chosen(self.filtration.simplices[1], self._isolated_edge)

    @property
    def _isolated_edge(self) -> BoolArray:
        raise NotImplementedError

    @cached_property
    def isolated_vertices(self) -> IntArray:
        """Vertices without any edge, ``(k,)`` int32."""
        raise NotImplementedError

    @cached_property
    def singular_vertices(self) -> IntArray:
        """Vertices of none of the tetrahedra, ``(k,)`` int32; isolated ones among them."""
        return self._vertices_of(SimplexKind.SINGULAR)

    @cached_property
    def regular_vertices(self) -> IntArray:
        """Vertices on the boundary of the tetrahedra, ``(k,)`` int32."""
        return self._vertices_of(SimplexKind.REGULAR)

    @cached_property
    def interior_vertices(self) -> IntArray:
        """Vertices with tetrahedra all around them, ``(k,)`` int32."""
        return self._vertices_of(SimplexKind.INTERIOR)

    def _vertices_of(self, kind: SimplexKind) -> IntArray:
        return chosen(self._vertices, self._vertex_kinds == kind)

    @property
    def _vertices(self) -> IntArray:
        return self.filtration.simplices[0][:, 0]

    # How large

    @cached_property
    def volume(self) -> float:
        """Volume of the tetrahedra, in cubed units of the points."""
        volumes = self.filtration.tetrahedron_volumes
        with np.errstate(over="ignore"):
            return float(volumes.compress(self._has_tetrahedron).sum())

    @cached_property
    def surface_area(self) -> float:
        """Area of the boundary of the tetrahedra, around the shape and its voids."""
        regular = self._triangle_kinds == SimplexKind.REGULAR
        with np.errstate(over="ignore"):
            return float(self.filtration.triangle_areas.compress(regular).sum())

    @cached_property
    def counts(self) -> dict[str, int]:
        """Number of simplices of each kind, by name."""
        singular_edges, regular_edges, interior_edges = _counted(self._edge_kinds)
        singular, regular, interior = _counted(self._triangle_kinds)
        return {
            "vertices": int(np.count_nonzero(self._vertex_kinds)),
            "edges": singular_edges + regular_edges + interior_edges,
            "triangles": singular + regular + interior,
            "tetrahedra": int(np.count_nonzero(self._has_tetrahedron)),
            "singular_triangles": singular,
            "regular_triangles": regular,
            "interior_triangles": interior,
            "singular_edges": singular_edges,
            "regular_edges": regular_edges,
            "interior_edges": interior_edges,
            "isolated_edges": len(self.isolated_edges),
            "isolated_vertices": len(self.isolated_vertices),
        }

    @property
    def euler_characteristic(self) -> int:
        """Vertices minus edges plus triangles minus tetrahedra: b0 - b1 + b2 of the complex."""
        counts = self.counts
        even = counts["vertices"] + counts["triangles"]
        return even - counts["edges"] - counts["tetrahedra"]

    @cached_property
    def betti(self) -> tuple[int, int, int]:
        """Betti numbers ``(b0, b1, b2)``: how many components, loops and voids there are.

        Components by union-find over the edges; voids by the same over the tetrahedra
        that are not there, which meet across triangles that are not there (Delfinado &
        Edelsbrunner 1995); loops are as many as the Euler characteristic lacks. No
        persistence is needed.
        """
        counts = self.counts
        # Rows that are no vertices of the complex stand alone, and are not counted.
        absent = len(self.points) - counts["vertices"]
        components = component_count(len(self.points), self.edges) - absent
        missing = self._triangle_kinds == SimplexKind.EXTERIOR
        outside = len(self.filtration.simplices[3])
        across = chosen(self.filtration.triangle_tetrahedra, missing)
        hollows = component_count(outside + 1, np.where(across < 0, outside, across))
        voids = hollows - 1 - counts["tetrahedra"]  # each tetrahedron is one by itself
        return components, components + voids - self.euler_characteristic, voids

    # What to do with it

    def mesh(self, point_data: Any = None, *, surface: bool = False) -> Mesh:
        """Return the complex as the mesh that is written to files.

        Parameters
        ----------
        point_data : mapping, DataFrame or PointTable, optional
            Columns of the points, one number for each, to stay with the vertices.
        surface : bool, default False
            Put the boundary triangles, counter-clockwise seen from outside, in the place
            of the tetrahedra.

        Returns
        -------
        Mesh
            The tetrahedra, the singular triangles, the isolated edges as lines and the
            isolated vertices as vertices, over all rows of `points`. The numbers
            ``"radius"`` of its cells are their filtration values.
        """
        from alphamesh.io.meshes import Mesh, vertex_data

        vertex_radii, edge_radii, triangle_radii, tetrahedron_radii = self.filtration.radii
        alone = np.searchsorted(self._vertices, self.isolated_vertices)
        kinds = self._triangle_kinds
        triangles = self.singular_triangles
        radii = triangle_radii.compress(kinds == SimplexKind.SINGULAR)
        if surface:
            triangles = np.concatenate((self.boundary_triangles, triangles))
            regular = triangle_radii.compress(kinds == SimplexKind.REGULAR)
            radii = np.concatenate((regular, radii))
        cells = {
            "vertex": (self.isolated_vertices, vertex_radii.take(alone)),
            "line": (self.isolated_edges, edge_radii.compress(self._isolated_edge)),
            "triangle": (triangles, radii),
        }
        if not surface:
            inside = tetrahedron_radii.compress(self._has_tetrahedron)
            cells["tetra"] = self.tetrahedra, inside
        return Mesh(
            self.points,
            {kind: rows for kind, (rows, _) in cells.items()},
            vertex_data(point_data, len(self.points)),
            cell_data={"radius": {kind: values for kind, (_, values) in cells.items()}},
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

        Formats that hold tetrahedra (VTU, VTK, MSH and NPZ) get ``mesh()``, the others
        (PLY, OBJ, OFF and STL) ``mesh(surface=True)``. Vertices are written in the order
        of the points, with their rows in `points` as the numbers ``"input_row"`` where
        the format holds numbers.

        Parameters, errors and warnings are those of :meth:`alphamesh.AlphaShape.save`.
        """
        from alphamesh.io.meshes import mesh_format, tell_of_lost_data, write_mesh

        chosen = mesh_format(path, file_format)
        if point_data is not None and not chosen.point_data:
            tell_of_lost_data(path, chosen.name)
            point_data = None
        mesh = self.mesh(point_data, surface="tetra" not in chosen.cells)
        write_mesh(mesh, path, file_format=file_format, keep_all=keep_all)


def _counted(kinds: KindArray) -> tuple[int, int, int]:
    """Return how many are singular, regular and interior."""
    _, *counts = np.bincount(kinds, minlength=4).tolist()
    singular, regular, interior = counts
    return singular, regular, interior
