"""The alpha filtration in space: every simplex of a triangulation and when it appears."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from alphamesh import _kernels
from alphamesh._arrays import Record, read_only
from alphamesh._kernels.space import alpha3, tetrahedron_triangles3, triangle_edges3
from alphamesh._kernels.topology import persistence3
from alphamesh._kernels.weighted import regular3
from alphamesh._weights import equal_weight, hidden_text, nothing_hidden, shifted_radii
from alphamesh.classify import (
    Intervals,
    face_intervals,
    facet_intervals,
    least_at_vertices,
)
from alphamesh.delaunay3d import Delaunay3D, neighbors_in_space, oriented_tetrahedra
from alphamesh.measures import tetrahedron_volumes, triangle_areas
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
    from collections.abc import Sequence

    from alphamesh._arrays import FloatArray, IntArray
    from alphamesh._kernels import Progress
    from alphamesh.points import Cloud

__all__ = ["Filtration3D", "filtration_in_space"]


@dataclass(frozen=True, eq=False, repr=False)
class Filtration3D(Record):
    """All simplices of the Delaunay triangulation of a cloud in space, with their values.

    The filtration value of a simplex is the smallest radius at which it is in the alpha
    complex: the radius of its smallest circumscribed sphere if no point lies inside that
    sphere (a Gabriel simplex), else the least value among its cofaces [1]_. Values never
    decrease from face to coface. With weights, they are those of the weighted complex, see
    :class:`~alphamesh.Filtration`.

    Attributes
    ----------
    points : (n, 3) float64
    representative : (n,) int32
        The lowest row with the coordinates of row i: i itself unless it is a duplicate.
        With weights, the lowest of the heaviest with these coordinates.
    simplices : tuple of (m_k, k + 1) int32
        Vertices, edges, triangles and tetrahedra, as rows of `points`, ascending within a
        simplex. The order of the simplices depends on the geometry alone.
    radii : tuple of (m_k,) float64
        The filtration values of `simplices`, in the units of the points: those of vertices
        are 0 unless there are weights, and none is negative.
    triangle_tetrahedra : (m_2, 2) int32
        The one or two tetrahedra that each triangle belongs to; -1 for none.
    crs : pyproj.CRS or None
        The coordinate reference system of the points, if they came with one.
    weights : (n,) float64 or None
        Squared radii of balls, of any sign; None for balls of equal size.
    hidden : (h,) int32
        Rows that are in no simplex because heavier points leave them no part of the power
        diagram, ascending. Rows equal to one that is there are not hidden.

    All arrays are read-only. Four entries are always there, possibly empty: a cloud in
    one plane has no tetrahedra.

    References
    ----------
    .. [1] H. Edelsbrunner and E. P. Mücke, Three-dimensional alpha shapes, ACM
       Transactions on Graphics 13 (1994) 43-72.
    """

    points: FloatArray
    representative: IntArray
    simplices: tuple[IntArray, IntArray, IntArray, IntArray]
    radii: tuple[FloatArray, FloatArray, FloatArray, FloatArray]
    triangle_tetrahedra: IntArray
    crs: Any = None
    weights: FloatArray | None = None
    hidden: IntArray = field(default_factory=nothing_hidden)

    @property
    def dimension(self) -> int:
        """Of the cloud: 3, 2 if in one plane, 1 if on one line, 0 if at one point, or -1."""
        return max((k for k in range(4) if len(self.simplices[k])), default=-1)

    # Computed once, when a shape or a rule first asks

    @cached_property
    def oriented_tetrahedra(self) -> IntArray:
        """The tetrahedra as ``(T, 4)`` int32, positively oriented from their lowest row on.

        Seen from the last corner, the other three run counter-clockwise.
        """
        return oriented_tetrahedra(self.points, self.simplices[3])

    @cached_property
    def tetrahedron_volumes(self) -> FloatArray:
        """The volume of each tetrahedron, ``(T,)`` float64."""
        return read_only(tetrahedron_volumes(self.points, self.simplices[3]))

    @property
    def cell_sizes(self) -> FloatArray:
        """How large the cells are, which are the tetrahedra: their volumes."""
        return self.tetrahedron_volumes

    @cached_property
    def triangle_areas(self) -> FloatArray:
        """The area of each triangle, ``(F,)`` float64."""
        return read_only(triangle_areas(self.points, self.simplices[2]))

    @cached_property
    def tetrahedron_triangles(self) -> IntArray:
        """The triangle opposite to each corner of `simplices[3]`, ``(T, 4)`` int32."""
        return tetrahedron_triangles3(
            self.simplices[3], self.simplices[2], self.triangle_tetrahedra
        )

    @cached_property
    def triangle_edges(self) -> IntArray:
        """The edge opposite to each corner of `simplices[2]`, ``(F, 3)`` int32."""
        return triangle_edges3(len(self.points), self.simplices[2], self.simplices[1])

    @cached_property
    def triangle_intervals(self) -> Intervals:
        """The radii at which the triangles become singular, regular and interior."""
        return facet_intervals(self.radii[2], self.triangle_tetrahedra, self.radii[3])

    @cached_property
    def edge_intervals(self) -> Intervals:
        """The radii at which the edges become singular, regular and interior."""
        return face_intervals(self.radii[1], self.triangle_edges, self.triangle_intervals)

    @cached_property
    def vertex_intervals(self) -> Intervals:
        """The radii at which the vertices become singular, regular and interior."""
        return face_intervals(self.radii[0], self._edge_vertices, self.edge_intervals)

    @property
    def _edge_vertices(self) -> IntArray:
        """The ends of each edge as positions in `simplices[0]`, ``(E, 2)`` int32."""
        vertices, edges = self.simplices[:2]
        if len(vertices) == len(self.points):
            return edges
        position = np.empty(len(self.points), dtype=np.int32)
        position[vertices[:, 0]] = np.arange(len(vertices), dtype=np.int32)
        return position.take(edges)

    @cached_property
    def delaunay(self) -> Delaunay3D:
        """The triangulation that the simplices are those of, with its neighbours."""
        _, edges, triangles, tetrahedra = self.simplices
        return Delaunay3D(
            self.points,
            self.representative,
            tetrahedra,
            neighbors_in_space(self.triangle_tetrahedra, self.tetrahedron_triangles),
            (triangles, edges),
            self.weights,
            self.hidden,
        )

    @cached_property
    def joined_from(self) -> FloatArray:
        """The radius at which each vertex gets its first edge, ``(m_0,)`` float64."""
        return least_at_vertices(self.simplices[0][:, 0], self.simplices[1], self.radii[1])

    @cached_property
    def filled_from(self) -> FloatArray:
        """The radius at which each edge gets its first triangle, ``(m_1,)`` float64."""
        least = np.full(len(self.simplices[1]), np.inf)
        for edges in self.triangle_edges.T:
            np.minimum.at(least, edges, self.radii[2])
        return read_only(least)

    def pairs(
        self, *, threads: int | None = None, progress: Progress | None = None
    ) -> tuple[IntArray, IntArray, IntArray]:
        """Return the simplices that begin and end each component, each loop and each void.

        Parameters
        ----------
        threads : int, optional
            Threads to use; by default one for each usable CPU.
        progress : callable, optional
            Called with the fraction that is done, from 0 to 1.

        Returns
        -------
        components, loops, voids : (k, 2), (l, 2), (m, 2) int32
            Positions of creator and destroyer, see
            :class:`~alphamesh.persistence.Persistence`. Kept for the next call.
        """
        known: tuple[IntArray, IntArray, IntArray] | None = vars(self).get("_pairs")
        if known is None:
            components, loops, voids = persistence3(
                len(self.points),
                self.simplices[1],
                self.radii[1],
                self.triangle_edges,
                self.radii[2],
                self.triangle_tetrahedra,
                self.radii[3],
                threads,
                progress,
                births=births_of_rows(
                    self.weights, self.simplices[0], self.radii[0], len(self.points)
                ),
            )
            components = at_positions(components, self.simplices[0], len(self.points))
            known = vars(self)["_pairs"] = components, loops, voids
        return known

    def __repr__(self) -> str:
        counts = [f"{len(rows):,}" for rows in self.simplices]
        return (
            f"<Filtration3D: {counts[0]} vertices, {counts[1]} edges, {counts[2]} triangles, "
            f"{counts[3]} tetrahedra{hidden_text(self.hidden)}>"
        )


def filtration_in_space(
    points: Any, *, threads: int | None = None, progress: Progress | None = None
) -> Filtration3D:
    """Compute the alpha filtration of a cloud in space; every decision is exact.

    Parameters
    ----------
    points : array-like of shape (n, 3)
        See :func:`alphamesh.points.as_cloud`. Duplicates are merged.
    threads, progress : optional
        See :func:`alphamesh.filtration`, also for the errors.

    Returns
    -------
    Filtration3D
    """
    cloud = as_cloud(points, 3)
    warn_of_degrees(cloud)
    weight = 0.0 if cloud.weights is None else equal_weight(cloud.weights)
    if weight is None:
        return _weighted(cloud, threads, progress)
    try:
        result = alpha3(cloud.points, threads, progress)
    except _kernels.BadCoordinates:
        raise coordinate_error(cloud.points) from None
    merged, simplices, radii, triangle_tetrahedra = result
    _refuse_overflow(simplices, radii)
    representative, vertices = merged_rows(merged, len(cloud))
    zero = read_only(np.zeros(len(vertices)))
    zero, one, two, three = (shifted_radii(r, weight) for r in (zero, *radii))
    return Filtration3D(
        cloud.points,
        representative,
        (vertices.reshape(-1, 1), *simplices),
        (zero, one, two, three),
        triangle_tetrahedra,
        cloud.crs,
        cloud.weights,
    )


def _weighted(cloud: Cloud, threads: int | None, progress: Progress | None) -> Filtration3D:
    """Return the filtration of a cloud whose weights differ."""
    assert cloud.weights is not None
    try:
        result = regular3(cloud.points, cloud.weights, threads, progress)
    except _kernels.BadCoordinates:
        raise coordinate_error(cloud.points, cloud.weights) from None
    merged, hidden, (vertices, *others), radii, triangle_tetrahedra = result
    _refuse_overflow(others, radii[1:])
    representative, _ = merged_rows(merged, len(cloud))
    return Filtration3D(
        cloud.points,
        representative,
        (read_only(vertices.reshape(-1, 1)), *result[2][1:]),
        radii,
        triangle_tetrahedra,
        cloud.crs,
        cloud.weights,
        hidden,
    )


def _refuse_overflow(simplices: Sequence[IntArray], radii: Sequence[FloatArray]) -> None:
    """Refuse values beyond float64, of edges, triangles and tetrahedra."""
    # No simplex has a larger value than the cells that it belongs to.
    for rows, values in zip(reversed(simplices), reversed(radii), strict=True):
        if len(rows):
            refuse_overflow(rows, values)
            break
