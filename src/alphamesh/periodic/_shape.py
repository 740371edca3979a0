"""The alpha complex of a periodic box at one radius: what is in it, and how large it is."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any, NoReturn

import numpy as np

from alphamesh._arrays import Record, read_only
from alphamesh.classify import checked_radius
from alphamesh.errors import DimensionError, PeriodicError
from alphamesh.periodic._filtration import PeriodicFiltration
from alphamesh.periodic._mesh import periodic_mesh
from alphamesh.periodic._persistence import periodic_persistence
from alphamesh.planar import PlanarShape
from alphamesh.solid import SolidShape

if TYPE_CHECKING:
    import os

    from matplotlib.axes import Axes

    from alphamesh._arrays import BoolArray, FloatArray, IntArray, KindArray
    from alphamesh.io.meshes import Mesh
    from alphamesh.plot import Drawing

__all__ = ["PeriodicShape"]

_NAMES = ("vertices", "edges", "triangles", "tetrahedra")


@dataclass(frozen=True, eq=False, repr=False)
class PeriodicShape(Record):
    """The alpha complex of a periodic box at one radius: all simplices of value <= radius.

    Each simplex stands for all its translates. What is measured is what one box holds.

    Parameters
    ----------
    filtration : PeriodicFiltration
    radius : float
        In the units of the points, not negative unless these have weights. ``numpy.inf``
        gives the whole triangulation.

    Raises
    ------
    ParameterError
        If `radius` is not a number, or NaN, or negative without weights.
    """

    filtration: PeriodicFiltration
    radius: float

    def __post_init__(self) -> None:
        signed = self.filtration.weights is not None
        object.__setattr__(self, "radius", checked_radius(self.radius, signed=signed))

    @property
    def _d(self) -> int:
        return len(self.filtration.periods)

    # What there is

    def numbers(self, dimension: int) -> IntArray:
        """Return which simplices of the filtration there are, ``(k,)`` int32, ascending."""
        there = self.filtration.radii[dimension] <= self.radius
        return read_only(np.flatnonzero(there).astype(np.int32))

    def offsets(self, dimension: int) -> KindArray:
        """Return the lattice offsets of the simplices, ``(k, dimension + 1, d)`` int8."""
        return read_only(self.filtration.offsets[dimension][self.numbers(dimension)])

    def corners(self, dimension: int) -> FloatArray:
        """Return where simplices are, ``(k, dimension + 1, d)`` float64."""
        return self.filtration.corners(dimension, self.numbers(dimension))

    def _rows(self, dimension: int) -> IntArray:
        return read_only(self.filtration.simplices[dimension][self.numbers(dimension)])

    @property
    def points(self) -> FloatArray:
        """The cloud as it was given, ``(n, 2)`` or ``(n, 3)`` float64."""
        return self.filtration.points

    @cached_property
    def vertices(self) -> IntArray:
        """The vertices, ``(k, 1)`` int32 rows of `points`."""
        return self._rows(0)

    @cached_property
    def edges(self) -> IntArray:
        """The edges, ``(k, 2)`` int32 rows of `points`; see :meth:`offsets`."""
        return self._rows(1)

    @cached_property
    def triangles(self) -> IntArray:
        """The triangles, ``(k, 3)`` int32 rows of `points`; see :meth:`offsets`."""
        return self._rows(2)

    @property
    def tetrahedra(self) -> IntArray:
        """The tetrahedra, ``(k, 4)`` int32 rows of `points`; see :meth:`offsets`."""
        if self._d == 2:
            raise DimensionError("there are tetrahedra in space alone; see triangles")
        return self._rows(3)

    @cached_property
    def counts(self) -> dict[str, int]:
        """How many vertices, edges, triangles and tetrahedra there are."""
        sizes = (len(self.numbers(k)) for k in range(self._d + 1))
        return dict(zip(_NAMES, sizes, strict=False))

    @property
    def isolated_vertices(self) -> IntArray:
        """Rows of vertices without any edge, ``(k,)`` int32."""
        alone = np.zeros(len(self.points), dtype=bool)
        alone[self.vertices[:, 0]] = True
        alone[self.edges] = False
        return read_only(np.flatnonzero(alone).astype(np.int32))

    # Topology

    @property
    def euler(self) -> int:
        """The Euler characteristic: 0 of a whole torus."""
        return sum((-1) ** k * count for k, count in enumerate(self.counts.values()))

    @cached_property
    def betti(self) -> tuple[int, ...]:
        """Betti numbers on the torus: components, loops and 1 if all is filled, or voids."""
        numbers = periodic_persistence(self.filtration).betti_numbers(self.radius)
        return tuple(int(number) for number in numbers)

    # Measures

    @cached_property
    def _has_cell(self) -> BoolArray:
        return read_only(self.filtration.radii[-1] <= self.radius)

    @cached_property
    def _facets(self) -> IntArray:
        """Numbers of facets with one of two cells, those at open borders included."""
        cells = self.filtration.facet_cells
        if len(self._has_cell) == 0:
            return read_only(np.empty(0, dtype=np.int32))
        inside = self._has_cell[cells] & (cells >= 0)
        return read_only(np.flatnonzero(inside.sum(axis=1) == 1).astype(np.int32))

    @cached_property
    def _content(self) -> float:
        return float(self.filtration.cell_sizes.compress(self._has_cell).sum())

    @cached_property
    def _border(self) -> float:
        return float(self.filtration.facet_sizes.take(self._facets).sum())

    @property
    def area(self) -> float:
        """The area of the triangles in the plane."""
        self._need_plane("the area", "volume")
        return self._content

    @property
    def perimeter(self) -> float:
        """The length of the border between triangles and what is left out."""
        self._need_plane("the perimeter", "surface_area")
        return self._border

    @property
    def volume(self) -> float:
        """The volume of the tetrahedra in space."""
        self._need_space("the volume", "area")
        return self._content

    @property
    def surface_area(self) -> float:
        """The area of the border between tetrahedra and what is left out."""
        self._need_space("the surface area", "perimeter")
        return self._border

    @property
    def filled_share(self) -> float:
        """The share of the box that is filled, from 0 to 1; 0 if a direction is open."""
        return self._content / self.filtration.box_size

    @property
    def boundary_edges(self) -> IntArray:
        """Numbers of the edges at the border in the plane, ``(k,)`` int32."""
        self._need_plane("the border of edges", "boundary_triangles")
        return self._facets

    @property
    def boundary_triangles(self) -> IntArray:
        """Numbers of the triangles at the border in space, ``(k,)`` int32."""
        self._need_space("the border of triangles", "boundary_edges")
        return self._facets

    def _need_plane(self, what: str, other: str) -> None:
        if self._d == 3:
            raise DimensionError(f"{what} is there in the plane alone; in space, see {other}")

    def _need_space(self, what: str, other: str) -> None:
        if self._d == 2:
            raise DimensionError(f"{what} is there in space alone; in the plane, see {other}")

    # What to do with it

    def mesh(self, *, surface: bool = False) -> Mesh:
        """Return what one box holds as the mesh that is written to files.

        Each simplex is there once, in one piece, where its first vertex lies in the box:
        those that cross the border reach beyond it.

        Parameters
        ----------
        surface : bool, default False
            In space: put the boundary triangles, counter-clockwise seen from outside, in
            the place of the tetrahedra.

        Returns
        -------
        Mesh
            Triangles or, in space, tetrahedra; and simplices that are a face of no other
            one. The numbers ``"input_row"`` of its points are their rows in `points`,
            ``"offset_x"``, ``"offset_y"`` and ``"offset_z"`` how many periods they lie
            from their place in the box; ``"radius"`` of its cells their filtration values.

        Raises
        ------
        DimensionError
            If the surface of a complex in the plane is asked for.
        """
        if surface:
            self._need_space("the surface", "boundary_edges")
        return periodic_mesh(self, surface=surface)

    def save(self, path: str | os.PathLike[str], *, file_format: str | None = None) -> None:
        """Write what one box holds to a mesh file, whole or not at all.

        Of complexes in space, formats that hold tetrahedra (VTU, VTK, MSH and NPZ) get
        ``mesh()``, the others (PLY, OBJ, OFF and STL) ``mesh(surface=True)``.

        Parameters, errors and warnings are those of :meth:`alphamesh.AlphaShape.save`.
        """
        from alphamesh.io.meshes import mesh_format, write_mesh

        surface = self._d == 3 and "tetra" not in mesh_format(path, file_format).cells
        write_mesh(self.mesh(surface=surface), path, file_format=file_format)

    def to_pyvista(self) -> Any:
        """Return :meth:`mesh` as a ``pyvista.UnstructuredGrid``.

        Raises
        ------
        MissingLibraryError
            If pyvista is not installed.
        """
        from alphamesh.io.exports import to_pyvista

        return to_pyvista(self.mesh())

    def to_meshio(self) -> Any:
        """Return :meth:`mesh` as a ``meshio.Mesh``.

        Raises
        ------
        MissingLibraryError
            If meshio is not installed.
        """
        from alphamesh.io.exports import to_meshio

        return to_meshio(self.mesh())

    def plot(self, ax: Axes | None = None, **options: Any) -> Drawing:
        """Draw the complex, the box and what crosses its border.

        See :func:`alphamesh.plot.plot_periodic` and, in space,
        :func:`alphamesh.plot.plot_periodic_in_space`, also for `options`.
        """
        from alphamesh.plot import plot_periodic, plot_periodic_in_space

        draw = plot_periodic if self._d == 2 else plot_periodic_in_space
        return draw(self, ax, **options)

    if not TYPE_CHECKING:

        def __getattr__(self, name: str) -> NoReturn:
            if not name.startswith("_") and (
                hasattr(PlanarShape, name) or hasattr(SolidShape, name)
            ):
                raise PeriodicError(
                    f"shapes in a periodic box have no {name!r}; their simplices may cross the "
                    "border of the box: see corners()"
                )
            raise AttributeError(f"'PeriodicShape' object has no attribute {name!r}")

    def __repr__(self) -> str:
        facts = ", ".join(f"{count:,} {name}" for name, count in self.counts.items())
        return f"<PeriodicShape at radius {self.radius:.6g}: {facts}>"
