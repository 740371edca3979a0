"""The alpha filtration: every simplex of the Delaunay triangulation and when it appears."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from alphamesh import _kernels
from alphamesh._arrays import Record, read_only
from alphamesh._kernels.weighted import regular2
from alphamesh._weights import equal_weight, hidden_text, nothing_hidden, shifted_radii
from alphamesh.classify import (
    Intervals,
    chosen,
    facet_intervals,
    least_at_vertices,
    vertex_intervals,
)
from alphamesh.delaunay import Delaunay, neighbors_of
from alphamesh.filtration3d import Filtration3D, filtration_in_space
from alphamesh.measures import scaled_points, triangle_areas
from alphamesh.points import (
    as_cloud,
    at_positions,
    births_of_rows,
    coordinate_error,
    merged_rows,
    refuse_overflow,
    warn_of_degrees,
)

if TYPE_CHECKING:
    from alphamesh._arrays import FloatArray, IntArray
    from alphamesh._kernels import Progress
    from alphamesh.points import Cloud

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

    With weights, the ball of point i has the squared radius ``w_i + a`` at the power
    parameter a. The triangulation is the regular one, dual to the power diagram [2]_, and
    the value of a simplex is the least a at which it is in the complex, that of a Gabriel
    simplex ``|z - p|**2 - w_p`` for its corners p and its orthocentre z [3]_. Where a
    radius is shown, it is the signed root ``sign(a) * sqrt(|a|)``.

    Attributes
    ----------
    points : (n, 2) float64
    representative : (n,) int32
        The lowest row with the coordinates of row i: i itself unless it is a duplicate.
        With weights, the lowest of the heaviest with these coordinates.
    simplices : tuple of (m_k, k + 1) int32
        Vertices, edges and triangles, as rows of `points`, ascending within a simplex.
        The order of the simplices depends on the geometry alone.
    radii : tuple of (m_k,) float64
        The filtration values of `simplices`, in the units of the points: those of vertices
        are 0 unless there are weights, and none is negative.
    edge_triangles : (m_1, 2) int32
        The one or two triangles that each edge belongs to; -1 for none.
    crs : pyproj.CRS or None
        The coordinate reference system of the points, if they came with one.
    weights : (n,) float64 or None
        Squared radii of balls, of any sign; None for balls of equal size.
    hidden : (h,) int32
        Rows that are in no simplex because heavier points leave them no part of the power
        diagram, ascending. Rows equal to one that is there are not hidden.

    All arrays are read-only. Three entries are always there, possibly empty.

    References
    ----------
    .. [1] H. Edelsbrunner and E. P. Mücke, Three-dimensional alpha shapes, ACM
       Transactions on Graphics 13 (1994) 43-72.
    .. [2] F. Aurenhammer, Power diagrams: properties, algorithms and applications, SIAM
       Journal on Computing 16 (1987) 78-96.
    .. [3] H. Edelsbrunner, The union of balls and its dual shape, Discrete &
       Computational Geometry 13 (1995) 415-440.
    """

    points: FloatArray
    representative: IntArray
    simplices: tuple[IntArray, IntArray, IntArray]
    radii: tuple[FloatArray, FloatArray, FloatArray]
    edge_triangles: IntArray
    crs: Any = None
    weights: FloatArray | None = None
    hidden: IntArray = field(default_factory=nothing_hidden)

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
        vertices, _, triangles = self.simplices
        return vertex_intervals(
            self.radii[0], vertices[:, 0], triangles, self.radii[2], hull_edges
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
            vertices, edges, triangles = self.simplices
            vertex_radii, edge_radii, triangle_radii = self.radii
            components, loops = _kernels.persistence2(
                self.points,
                triangles,
                triangle_radii,
                edges,
                edge_radii,
                self.edge_triangles,
                threads,
                progress,
                births=births_of_rows(self.weights, vertices, vertex_radii, len(self.points)),
            )
            components = at_positions(components, vertices, len(self.points))
            known = vars(self)["_pairs"] = components, loops
        return known

    def __repr__(self) -> str:
        vertices, edges, triangles = (f"{len(rows):,}" for rows in self.simplices)
        return (
            f"<Filtration: {vertices} vertices, {edges} edges, {triangles} triangles"
            f"{hidden_text(self.hidden)}>"
        )


#: What :func:`filtration` returns.
AnyFiltration: TypeAlias = Filtration | Filtration3D


def filtration(
    points: Any,
    *,
    weights: Any = None,
    threads: int | None = None,
    progress: Progress | None = None,
) -> AnyFiltration:
    """Compute the alpha filtration of a cloud; every decision is exact.

    Parameters
    ----------
    points : array-like of shape (n, 2) or (n, 3)
        See :func:`alphamesh.points.as_cloud`. Duplicates are merged.
    weights : array-like of shape (n,), optional
        Squared radii of balls around the points, of any sign, in squared units of the
        points: then the filtration is that of the weighted alpha complex. By default all
        balls are of equal size.
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
    WeightsError
        If there is not one finite weight for each point.
    ParameterError
        If `threads` or `progress` is not what it must be.

    Warns
    -----
    GeographicCoordinatesWarning
        If the points come with a reference system of longitudes and latitudes.
    """
    cloud = as_cloud(points, weights=weights)
    if cloud.points.shape[1] == 3:
        return filtration_in_space(cloud, threads=threads, progress=progress)
    return filtration_in_plane(cloud, threads=threads, progress=progress)


def filtration_in_plane(
    points: Any, *, threads: int | None = None, progress: Progress | None = None
) -> Filtration:
    """Compute the alpha filtration of a cloud in the plane; see :func:`filtration`."""
    cloud = as_cloud(points, 2)
    warn_of_degrees(cloud)
    weight = 0.0 if cloud.weights is None else equal_weight(cloud.weights)
    if weight is None:
        return _weighted(cloud, threads, progress)
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
    radii = read_only(np.zeros(len(vertices))), edge_radii, triangle_radii
    vertex_radii, edge_radii, triangle_radii = (shifted_radii(r, weight) for r in radii)
    return Filtration(
        cloud.points,
        representative,
        (vertices.reshape(-1, 1), edges, triangles),
        (vertex_radii, edge_radii, triangle_radii),
        edge_triangles,
        cloud.crs,
        cloud.weights,
    )


def _weighted(cloud: Cloud, threads: int | None, progress: Progress | None) -> Filtration:
    """Return the filtration of a cloud whose weights differ."""
    assert cloud.weights is not None
    try:
        result = regular2(cloud.points, cloud.weights, threads, progress)
    except _kernels.BadCoordinates:
        raise coordinate_error(cloud.points, cloud.weights) from None
    merged, hidden, (vertices, edges, triangles), radii, edge_triangles = result
    refuse_overflow(edges, radii[1])
    refuse_overflow(triangles, radii[2])
    representative, _ = merged_rows(merged, len(cloud))
    return Filtration(
        cloud.points,
        representative,
        (read_only(vertices.reshape(-1, 1)), edges, triangles),
        radii,
        edge_triangles,
        cloud.crs,
        cloud.weights,
        hidden,
    )


def _delaunay_of(filtration: Filtration) -> Delaunay:
    """Return the triangulation that a filtration was made of."""
    _, edges, triangles = filtration.simplices
    return Delaunay(
        filtration.points,
        filtration.representative,
        triangles,
        neighbors_of(triangles, edges, filtration.edge_triangles),
        edges if len(triangles) == 0 else edges[:0],
        filtration.weights,
        filtration.hidden,
    )
