"""The Voronoi diagram of a cloud: which part of the plane is nearest to which point."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from alphamesh._arrays import Record, read_only
from alphamesh._kernels.cells import restricted2, rings2, voronoi_vertices2
from alphamesh._weights import nothing_hidden
from alphamesh.clip import ClippedVoronoi, lines_in_box
from alphamesh.filtration import Filtration, filtration_in_plane
from alphamesh.measures import kernel_balls, kernel_points
from alphamesh.points import as_cloud
from alphamesh.region import as_box, cut_cells

if TYPE_CHECKING:
    from alphamesh._arrays import BoolArray, CountArray, FloatArray, IntArray
    from alphamesh._kernels import Progress

__all__ = ["ClippedVoronoi", "Voronoi", "voronoi", "voronoi_of"]


@dataclass(frozen=True, eq=False, repr=False)
class Voronoi(Record):
    """The Voronoi diagram: for each point, what is nearer to it than to any other.

    It is the dual of the Delaunay triangulation: a *ridge* for each edge, between the cells
    of two neighbours; a *vertex* for each triangle, where three cells meet.

    Attributes
    ----------
    points : (n, 2) float64
    representative : (n,) int32
        The lowest row with the coordinates of row i. Only that row has a cell.
    triangles : (T, 3) int32
        The rows whose cells meet in each vertex, ascending.
    vertices : (T, 2) float64
        The circumcentres of `triangles`. Where more than three cells meet, several vertices
        lie in one place, to the last bit, joined by ridges of length 0.
    vertex_group : (T,) int32
        The first of the vertices that lie in the same place, an exact decision: v itself
        unless more than three cells meet.
    ridge_points : (E, 2) int32
        The two rows, ascending, whose cells meet along each ridge.
    ridge_vertices : (E, 2) int32
        From which vertex to which vertex the ridge runs, with the cell of its first row on
        the left; -1 where it runs to infinity.
    offset : (n + 1,) int64
        Entries ``offset[i]`` to ``offset[i + 1]`` of the next two arrays are the border of
        the cell of row i, counter-clockwise; none for merged duplicates, nor for a point
        that is alone and has the plane for a cell.
    cell_ridges : (2E,) int32
        The ridges of each cell. Those of an unbounded cell start with the ridge that comes
        from infinity.
    cell_vertices : (2E,) int32
        The vertex after each ridge, between it and the next; -1 after the one that runs to
        infinity, and everywhere for a cloud on one line.
    weights : (n,) float64 or None
        Squared radii of balls: then all is that of the power diagram [2]_, in which a point
        p is as far from x as ``|x - p|**2 - w`` tells, and vertices are the orthocentres of
        the triangles. None for balls of equal size.
    hidden : (h,) int32
        Rows that have no cell in a power diagram, ascending.

    All arrays are read-only.

    References
    ----------
    .. [1] F. Aurenhammer, Voronoi diagrams: a survey of a fundamental geometric data
       structure, ACM Computing Surveys 23 (1991) 345-405.
    .. [2] F. Aurenhammer, Power diagrams: properties, algorithms and applications, SIAM
       Journal on Computing 16 (1987) 78-96.
    """

    points: FloatArray
    representative: IntArray
    triangles: IntArray
    vertices: FloatArray
    vertex_group: IntArray
    ridge_points: IntArray
    ridge_vertices: IntArray
    offset: CountArray
    cell_ridges: IntArray
    cell_vertices: IntArray
    weights: FloatArray | None = None
    hidden: IntArray = field(default_factory=nothing_hidden)

    # Cells

    @cached_property
    def bounded(self) -> BoolArray:
        """Which rows have a bounded cell, ``(n,)`` bool; merged duplicates have none."""
        bounded = np.diff(self.offset) > 0
        bounded[self._owner[self.cell_vertices < 0]] = False
        return read_only(bounded)

    @cached_property
    def areas(self) -> FloatArray:
        """Area of each cell, ``(n,)`` float64: infinite if unbounded, 0 if merged or hidden."""
        areas = np.full(len(self.points), np.inf)
        areas[self.representative != np.arange(len(self.points))] = 0.0
        areas[self.hidden] = 0.0
        areas[self.bounded] = self._measured[self.bounded]
        return read_only(areas)

    @cached_property
    def _measured(self) -> FloatArray:
        """Areas of bounded cells: of restricted ones, as if every simplex were there."""
        points, weights, exponent = kernel_balls(self.points, self.weights)
        cofaces = np.sort(self.ridge_vertices, axis=1)[:, ::-1]
        area = restricted2(
            points,
            self.triangles,
            np.ones(len(self.triangles), dtype=np.bool_),
            self.ridge_points,
            np.ones(len(self.ridge_points), dtype=np.bool_),
            np.ascontiguousarray(cofaces),
            np.diff(self.offset) > 0,
            0.0,
            weights=weights,
        )[5]
        with np.errstate(over="ignore", under="ignore"):
            measured: FloatArray = np.ldexp(area, 2 * exponent)
        return measured

    @property
    def _owner(self) -> IntArray:
        """The row of each entry of `cell_ridges`."""
        return np.repeat(np.arange(len(self.points), dtype=np.int32), np.diff(self.offset))

    # Ridges

    @cached_property
    def ridge_directions(self) -> FloatArray:
        """Unit vector along each ridge, from first to second vertex, ``(E, 2)`` float64.

        A ridge without a second vertex runs to infinity in this direction, one without a
        first vertex comes from infinity in it; one without either is the whole line through
        :attr:`ridge_midpoints`.
        """
        points, _ = kernel_points(self.points)
        first, second = points[self.ridge_points.T]
        x, y = (second - first).T
        length = np.hypot(x, y)
        return read_only(np.column_stack((-y / length, x / length)))

    @cached_property
    def ridge_midpoints(self) -> FloatArray:
        """Midpoint of the two points of each ridge, ``(E, 2)`` float64: on its line.

        With weights, the point between or beside them that is on that line.
        """
        first, second = self.points[self.ridge_points.T]
        if self.weights is None:
            return read_only(0.5 * first + 0.5 * second)
        points, weights, exponent = kernel_balls(self.points, self.weights)
        assert weights is not None
        first, second = points[self.ridge_points.T]
        change = -np.diff(weights[self.ridge_points], axis=1)
        way = 0.5 + 0.5 * change / ((second - first) ** 2).sum(axis=1, keepdims=True)
        return read_only(np.ldexp(first + way * (second - first), exponent))

    @cached_property
    def is_zero_length(self) -> BoolArray:
        """Which ridges are single points, an exact decision, ``(E,)`` bool.

        Their two points lie on a circle with two others. Without these ridges, each two
        cells that are left as neighbours share a border of positive length.
        """
        first, second = np.append(self.vertex_group, np.int32(-1))[self.ridge_vertices.T]
        return read_only((first == second) & (first >= 0))

    def segments(self, box: tuple[float, float, float, float]) -> tuple[FloatArray, CountArray]:
        """Return the part of each ridge that lies in a box, for drawing.

        Parameters
        ----------
        box : (xmin, ymin, xmax, ymax)

        Returns
        -------
        segments : (m, 2, 2) float64
            The two ends; ridges outside of the box are left out.
        ridge : (m,) int64
            Which ridge each segment is part of.

        Raises
        ------
        ParameterError
            If `box` is not four finite numbers, each minimum below its maximum.
        """
        ends = np.append(self.vertices, [[np.nan, np.nan]], axis=0)[self.ridge_vertices]
        lines = (self.ridge_midpoints, self.ridge_directions)
        segments, ridge = lines_in_box(lines, ends, as_box(box))
        return read_only(segments), read_only(ridge)

    def clip(self, region: Any) -> ClippedVoronoi:
        """Cut all cells by a region.

        Parameters
        ----------
        region : (xmin, ymin, xmax, ymax), (c, 2) array-like, or shapely geometry
            A box; the corners of a convex polygon, counter-clockwise (as
            ``convex_hull(points).corners``); or any polygon or multipolygon of shapely.

        Returns
        -------
        ClippedVoronoi

        Raises
        ------
        ParameterError
            If `region` is none of these, or so large or far away beside the points that
            exact arithmetic would overflow.
        """
        return cut_cells(self.points, region, self.weights)

    def __repr__(self) -> str:
        unbounded = int(np.count_nonzero(self.cell_vertices < 0))
        return (
            f"<Voronoi: {len(self.vertices):,} vertices, {len(self.ridge_points):,} ridges"
            f"{f', {unbounded:,} unbounded cells' if len(self.vertices) else ''}>"
        )


def voronoi(
    points: Any,
    *,
    weights: Any = None,
    threads: int | None = None,
    progress: Progress | None = None,
) -> Voronoi:
    """Compute the Voronoi diagram of a cloud; every decision is exact, positions are rounded.

    Parameters
    ----------
    points : array-like of shape (n, 2)
        See :func:`alphamesh.points.as_cloud`. Duplicates are merged. Any number of points
        is legal; those on one line have parallel lines for ridges.
    weights : array-like of shape (n,), optional
        Squared radii of balls: then this is the power diagram. By default all balls are of
        equal size.
    threads : int, optional
        Threads to use; by default one for each usable CPU. The result does not depend
        on it.
    progress : callable, optional
        Called with the fraction that is done, from 0 to 1, about ten times a second.

    Returns
    -------
    Voronoi

    Raises
    ------
    CloudShapeError, NonFiniteError, CoordinateRangeError, CloudTooLargeError
        If there is no exact diagram of such points; the message names the rows.
    ParameterError
        If `threads` or `progress` is not what it must be.
    """
    cloud = as_cloud(points, 2, weights)
    built = filtration_in_plane(cloud, threads=threads, progress=progress)
    return voronoi_of(built, threads=threads)


def voronoi_of(filtration: Filtration, *, threads: int | None = None) -> Voronoi:
    """Return the Voronoi diagram that is dual to the triangulation of a filtration."""
    points, weights, exponent = kernel_balls(filtration.points, filtration.weights)
    _, edges, triangles = filtration.simplices
    cofaces = filtration.edge_triangles
    offset, ridges, after = rings2(points, triangles, edges, cofaces, threads)
    vertices, group = voronoi_vertices2(
        points, triangles, edges, cofaces, threads, weights=weights
    )
    if exponent:
        with np.errstate(over="ignore", under="ignore"):
            vertices = read_only(np.ldexp(vertices, exponent))
    return Voronoi(
        filtration.points,
        filtration.representative,
        triangles,
        vertices,
        group,
        edges,
        _ridge_vertices(edges, offset, ridges, after),
        offset,
        ridges,
        after,
        filtration.weights,
        filtration.hidden,
    )


def _ridge_vertices(
    edges: IntArray, offset: CountArray, ridges: IntArray, after: IntArray
) -> IntArray:
    """Return the vertices at which each ridge starts and ends, around its first row."""
    owner = np.repeat(np.arange(len(offset) - 1, dtype=np.int32), np.diff(offset))
    before = np.empty_like(after)
    before[1:] = after[:-1]
    used = np.diff(offset) > 0
    before[offset[:-1][used]] = after[offset[1:][used] - 1]
    mine = np.flatnonzero(edges[ridges, 0] == owner)
    ends = np.empty((len(edges), 2), dtype=np.int32)
    ends[ridges[mine]] = np.column_stack((before[mine], after[mine]))
    return read_only(ends)
