"""The alpha filtration: every simplex of the Delaunay triangulation and when it appears."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from alphamesh import _kernels
from alphamesh._arrays import Record, read_only
from alphamesh.classify import (
    Intervals,
    chosen,
    facet_intervals,
    least_at_vertices,
    vertex_intervals,
)
from alphamesh.delaunay import Delaunay
from alphamesh.filtration3d import Filtration3D, filtration_in_space
from alphamesh.measures import scaled_points, triangle_areas
from alphamesh.points import (
    as_cloud,
    coordinate_error,
    merged_rows,
    refuse_overflow,
    warn_of_degrees,
)

if TYPE_CHECKING:
    from alphamesh._arrays import FloatArray, IntArray
    from alphamesh._kernels import Progress

__all__ = ["AnyFiltration", "Filtration", "filtration", "filtration_in_plane"]

# Triangles worked on at a time: their coordinates stay in the processor's cache.
_CHUNK = 1 << 15


@dataclass(frozen=True, eq=False, repr=False)
class Filtration(Record):
    """All simplices of a cloud's Delaunay triangulation, with their filtration values.

    The filtration value of a simplex is the smallest radius at which it is in the alpha
    complex: the radius of its smallest circumscribed circle if no point lies inside that
    circle (a Gabriel simplex), else the least value among its cofaces [1]_. Values never
    decrease from face to coface.

    Attributes
    ----------
    points : (n, 2) float64
    representative : (n,) int32
        The lowest row with the coordinates of row i: i itself unless it is a duplicate.
    simplices : tuple of (m_k, k + 1) int32
        Vertices, edges and triangles, as rows of `points`, ascending within a simplex.
        The order of the simplices depends on the geometry alone.
    radii : tuple of (m_k,) float64
        The filtration values of `simplices`, in the units of the points.
    edge_triangles : (m_1, 2) int32
        The one or two triangles that each edge belongs to; -1 for none.
    crs : pyproj.CRS or None
        The coordinate reference system of the points, if they came with one.

    All arrays are read-only. Three entries are always there, possibly empty.

    References
    ----------
    .. [1] H. Edelsbrunner and E. P. Mücke, Three-dimensional alpha shapes, ACM
       Transactions on Graphics 13 (1994) 43-72.
    """

    points: FloatArray
    representative: IntArray
    simplices: tuple[IntArray, IntArray, IntArray]
    radii: tuple[FloatArray, FloatArray, FloatArray]
    edge_triangles: IntArray
    crs: Any = None

    @property
    def dimension(self) -> int:
        """Dimension of the cloud: 2, 1 if on one line, 0 if at one point, -1 if empty."""
        return max((k for k in range(3) if len(self.simplices[k])), default=-1)

    # Computed once, when a shape or a rule first asks

    @cached_property
    def oriented_triangles(self) -> IntArray:
        """The triangles as ``(T, 3)`` int32, each counter-clockwise from its lowest row."""
        oriented = self.simplices[2].copy()
        points, _ = scaled_points(self.points)
        for start in range(0, len(oriented), _CHUNK):
            part = oriented[start : start + _CHUNK]
            clockwise = _kernels.orient2(points.take(part, axis=0)) < 0
            part[clockwise, 1:] = part[clockwise, :0:-1]
        return read_only(oriented)

    @cached_property
    def triangle_areas(self) -> FloatArray:
        """The area of each triangle, ``(T,)`` float64."""
        return read_only(triangle_areas(self.points, self.simplices[2]))

    @property
    def cell_sizes(self) -> FloatArray:
        """How large the cells are, which are the triangles: their areas."""
        return self.triangle_areas

    @cached_property
    def vertex_intervals(self) -> Intervals:
        """The radii at which the vertices become singular, regular and interior."""
        hull_edges = chosen(self.simplices[1], self.edge_triangles[:, 1] < 0)
        return vertex_intervals(
            self.simplices[0][:, 0], self.simplices[2], self.radii[2], hull_edges
        )

    @cached_property
    def edge_intervals(self) -> Intervals:
        """The radii at which the edges become singular, regular and interior."""
        return facet_intervals(self.radii[1], self.edge_triangles, self.radii[2])

    @cached_property
    def triangle_edges(self) -> IntArray:
        """The edge opposite to each corner of `simplices[2]`, ``(T, 3)`` int32."""
        return _kernels.triangle_edges2(
            self.points, self.simplices[2], self.simplices[1], self.edge_triangles
        )

    @cached_property
    def delaunay(self) -> Delaunay:
        """The triangulation that the simplices are those of, with its neighbours."""
        return _delaunay_of(self)

    @cached_property
    def joined_from(self) -> FloatArray:
        """The radius at which each vertex gets its first edge, ``(m_0,)`` float64."""
        return least_at_vertices(self.simplices[0][:, 0], self.simplices[1], self.radii[1])

    def pairs(
        self, *, threads: int | None = None, progress: Progress | None = None
    ) -> tuple[IntArray, IntArray]:
        """Return the simplices that begin and end each component and each loop.

        Parameters
        ----------
        threads : int, optional
            Threads to use; by default one for each usable CPU.
        progress : callable, optional
            Called with the fraction that is done, from 0 to 1.

        Returns
        -------
        components, loops : (k, 2), (m, 2) int32
            Positions of creator and destroyer, see
            :class:`~alphamesh.persistence.Persistence`. Kept for the next call.
        """
        known: tuple[IntArray, IntArray] | None = vars(self).get("_pairs")
        if known is None:
            (vertices, edges, triangles), (_, edge_radii, triangle_radii) = (
                self.simplices,
                self.radii,
            )
            components, loops = _kernels.persistence2(
                self.points,
                triangles,
                triangle_radii,
                edges,
                edge_radii,
                self.edge_triangles,
                threads,
                progress,
            )
            if len(vertices) < len(self.points):
                # The core counts rows of points; duplicates have no place of their own.
                components = components.copy()
                components[:, 0] = np.searchsorted(vertices[:, 0], components[:, 0])
                read_only(components)
            known = vars(self)["_pairs"] = components, loops
        return known

    def __repr__(self) -> str:
        vertices, edges, triangles = (f"{len(rows):,}" for rows in self.simplices)
        return f"<Filtration: {vertices} vertices, {edges} edges, {triangles} triangles>"


#: What :func:`filtration` returns.
AnyFiltration: TypeAlias = Filtration | Filtration3D


def filtration(
    points: Any, *, threads: int | None = None, progress: Progress | None = None
) -> AnyFiltration:
    """Compute the alpha filtration of a cloud; every decision is exact.

    Parameters
    ----------
    points : array-like of shape (n, 2) or (n, 3)
        See :func:`alphamesh.points.as_cloud`. Duplicates are merged.
    threads : int, optional
        Threads to use; by default one for each usable CPU. The result does not depend
        on it.
    progress : callable, optional
        Called with the fraction that is done, from 0 to 1, about ten times a second.

    Returns
    -------
    Filtration or Filtration3D
        Points with two columns lie in the plane, those with three in space.

    Raises
    ------
    CloudShapeError, NonFiniteError, CoordinateRangeError, CloudTooLargeError
        If there is no exact filtration of such points; the message names the rows.
    ParameterError
        If `threads` or `progress` is not what it must be.

    Warns
    -----
    GeographicCoordinatesWarning
        If the points come with a reference system of longitudes and latitudes.
    """
    cloud = as_cloud(points)
    if cloud.points.shape[1] == 3:
        return filtration_in_space(cloud, threads=threads, progress=progress)
    return filtration_in_plane(cloud, threads=threads, progress=progress)


def filtration_in_plane(
    points: Any, *, threads: int | None = None, progress: Progress | None = None
) -> Filtration:
    """Compute the alpha filtration of a cloud in the plane; see :func:`filtration`."""
    cloud = as_cloud(points, 2)
    warn_of_degrees(cloud)
    try:
        result = _kernels.alpha2(cloud.points, threads, progress)
    except _kernels.BadCoordinates:
        raise coordinate_error(cloud.points) from None
    merged, triangles, triangle_radii, edges, edge_radii, edge_triangles = result
    # No edge has a larger value than the triangles that it belongs to.
    if len(triangles):
        refuse_overflow(triangles, triangle_radii)
    else:
        refuse_overflow(edges, edge_radii)
    representative, vertices = merged_rows(merged, len(cloud))
    return Filtration(
        cloud.points,
        representative,
        (vertices.reshape(-1, 1), edges, triangles),
        (read_only(np.zeros(len(vertices))), edge_radii, triangle_radii),
        edge_triangles,
        cloud.crs,
    )


def _delaunay_of(filtration: Filtration) -> Delaunay:
    """Return the triangulation that a filtration was made of."""
    _, edges, triangles = filtration.simplices
    neighbors = np.full(triangles.size, -1, dtype=np.int32)
    # Hull edges have one triangle, which keeps its -1.
    inner = np.flatnonzero(filtration.edge_triangles.min(axis=1, initial=0) >= 0)
    cofaces, ends = (rows.take(inner, axis=0) for rows in (filtration.edge_triangles, edges))
    for side in (0, 1):
        corners = triangles.take(cofaces[:, side], axis=0)
        # Corners and ends ascend, so the corner left out is where they first differ.
        opposite = 2 - (corners[:, 1] != ends[:, 1])
        opposite[corners[:, 0] != ends[:, 0]] = 0
        neighbors[3 * cofaces[:, side].astype(np.intp) + opposite] = cofaces[:, 1 - side]
    return Delaunay(
        filtration.points,
        filtration.representative,
        triangles,
        read_only(neighbors.reshape(-1, 3)),
        edges if len(triangles) == 0 else edges[:0],
    )
