"""Shapes in space and their boundaries: surfaces, queries and what other libraries take."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from alphamesh._arrays import read_only
from alphamesh.location3d import as_queries_in_space
from alphamesh.queries3d import (
    Nearest3D,
    SurfaceTree,
    nearest_triangles,
    sides_at,
    surface_tree,
)
from alphamesh.simplices3d import SimplexSet3D
from alphamesh.surface import Surface, boundary_surface

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from alphamesh._arrays import BoolArray, FloatArray, IntArray, KindArray
    from alphamesh.parts import Parts
    from alphamesh.plot import Drawing

__all__ = ["BoundedShape"]


@dataclass(frozen=True, eq=False, repr=False)
class BoundedShape(SimplexSet3D):
    """Simplices in space whose tetrahedra have a boundary to look at and to ask about.

    Boundaries and queries are about the tetrahedra alone, the regularized shape: not
    about singular triangles and edges, and isolated vertices.
    """

    @property
    def _parts(self) -> Parts:
        raise NotImplementedError

    # Surfaces

    def surface(self, *, manifold: bool = True, outer_only: bool = False) -> Surface:
        """Return the boundary as a closed surface, oriented outwards.

        To fill cavities or to drop small regions first, see :meth:`filtered`:
        ``shape.filtered(max_void_volume=0.1).surface()``.

        Parameters
        ----------
        manifold : bool, default True
            Where the boundary is pinched, at an edge in four triangles or more or at a
            point with several fans of triangles, give each sheet vertices of its own:
            then every edge has exactly two triangles, and the triangles at each vertex
            form one fan. See :func:`alphamesh.boundary_surface` for which triangles
            belong together. With False, each point of the cloud is one vertex.
        outer_only : bool, default False
            Leave out the walls of cavities.

        Returns
        -------
        Surface
            Its triangles are :attr:`boundary_triangles`, in the same order.
        """
        found = self._surface if manifold else self._made_surface(False)
        return found.outer() if outer_only else found

    @cached_property
    def _surface(self) -> Surface:
        return self._made_surface(True)

    def _made_surface(self, manifold: bool) -> Surface:
        return boundary_surface(self.filtration, self._has_tetrahedron, manifold=manifold)

    # Queries

    def contains(self, points: Any) -> BoolArray:
        """Return which points lie in the tetrahedra, boundary included; exact.

        Parameters
        ----------
        points : array-like of shape (q, 3)

        Returns
        -------
        (q,) bool

        Raises
        ------
        CloudShapeError, NonFiniteError, CoordinateRangeError
            If `points` is not a table of finite numbers of the scale of the cloud; the
            message names the rows.
        """
        return read_only(self.side_of(points) >= 0)

    def side_of(self, points: Any) -> KindArray:
        """Return on which side of the boundary each point lies; exact.

        Parameters and errors are those of :meth:`contains`.

        Returns
        -------
        (q,) int8
            1 inside, 0 on the boundary, -1 outside.
        """
        return self._located(as_queries_in_space(points))[1]

    def region_of(self, points: Any) -> IntArray:
        """Return the region that each point lies in; exact.

        Parameters and errors are those of :meth:`contains`.

        Returns
        -------
        (q,) int32
            Numbers of :attr:`regions`; -1 outside. Regions are closed: where some touch,
            the lowest number is returned.
        """
        return self._located(as_queries_in_space(points))[0]

    def _located(self, queries: FloatArray) -> tuple[IntArray, KindArray]:
        return sides_at(self.filtration, self._parts.labels, queries)

    def nearest(self, points: Any) -> Nearest3D:
        """Return the nearest point of the boundary to each point, and how far it is.

        Parameters
        ----------
        points : array-like of shape (q, 3)

        Returns
        -------
        Nearest3D

        Raises
        ------
        CloudShapeError, NonFiniteError
            If `points` is not a table of finite numbers; the message names the rows.
        """
        return nearest_triangles(self._surface_tree, as_queries_in_space(points))

    def distance(self, points: Any, *, signed: bool = False) -> FloatArray:
        """Return how far each point is from the shape, in the units of the points.

        Parameters
        ----------
        points : array-like of shape (q, 3)
        signed : bool, default False
            Return minus the distance to the boundary for points inside.

        Returns
        -------
        (q,) float64
            0 on the boundary, exactly, and inside unless `signed`; infinity if the shape
            has no tetrahedra.

        Raises
        ------
        CloudShapeError, NonFiniteError, CoordinateRangeError
            See :meth:`contains`.
        """
        queries = as_queries_in_space(points)
        sides = self._located(queries)[1]
        distances = nearest_triangles(self._surface_tree, queries).distances
        factors = np.where(sides < 0, 1.0, 0.0)
        if signed:
            factors = -sides.astype(np.float64)
        # Nothing is on the boundary but what exact arithmetic finds there; infinity, where
        # there is no boundary, is outside of it. Adding zero turns -0 into 0.
        with np.errstate(invalid="ignore"):
            return read_only(np.where(sides == 0, 0.0, factors * distances) + 0.0)

    @cached_property
    def _surface_tree(self) -> SurfaceTree:
        return surface_tree(self.points, self.boundary_triangles)

    # For other libraries

    def to_trimesh(self) -> Any:
        """Return the surface as a ``trimesh.Trimesh``; see :meth:`Surface.to_trimesh`."""
        return self.surface().to_trimesh()

    def to_open3d(self) -> Any:
        """Return the surface as a triangle mesh; see :meth:`Surface.to_open3d`."""
        return self.surface().to_open3d()

    def to_pyvista(self) -> Any:
        """Return the complex as a ``pyvista.UnstructuredGrid``, tetrahedra and all.

        Its points are all rows of the cloud; the cell numbers ``"radius"`` are filtration
        values. ``shape.surface().to_pyvista()`` is the boundary alone.

        Raises
        ------
        MissingLibraryError
            If pyvista is not installed.
        """
        from alphamesh.io.exports import to_pyvista

        return to_pyvista(self.mesh())

    def to_meshio(self) -> Any:
        """Return the complex as a ``meshio.Mesh``, tetrahedra and all.

        Raises
        ------
        MissingLibraryError
            If meshio is not installed.
        """
        from alphamesh.io.exports import to_meshio

        return to_meshio(self.mesh())

    # Figures

    def plot(self, ax: Axes | None = None, **options: Any) -> Drawing:
        """Draw the complex in space, lit and seen in perspective, on matplotlib axes.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Ordinary axes of two dimensions; new ones in a new figure if None.
        options
            Those of :func:`alphamesh.plot.plot_solid`, such as ``cut`` and ``view``.
        """
        from alphamesh.plot import plot_solid

        return plot_solid(self, ax, **options)
