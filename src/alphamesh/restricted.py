"""Restricted Voronoi cells: every Voronoi cell cut by the disc around its point."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from numbers import Real
from typing import TYPE_CHECKING, Any

import numpy as np

from alphamesh import _shapely, arcs
from alphamesh._arrays import Record, read_only
from alphamesh._kernels.cells import restricted2
from alphamesh._weights import signed_square
from alphamesh.errors import ParameterError
from alphamesh.filtration import Filtration
from alphamesh.measures import kernel_balls, rescaled, scaled_radius

if TYPE_CHECKING:
    from alphamesh._arrays import BoolArray, CodeArray, CountArray, FloatArray, IntArray
    from alphamesh._kernels import Progress

__all__ = ["RestrictedVoronoi", "restricted_voronoi"]


@dataclass(frozen=True, eq=False, repr=False)
class RestrictedVoronoi(Record):
    """The Voronoi cells of a cloud, each cut by the disc of one radius around its point.

    Together the cells fill the union of the discs, and none overlaps another. They are
    convex; their borders are straight *segments*, each shared with the cell across, and
    *arcs* of the cell's own circle. The alpha complex is the nerve of these cells [1]_:
    two cells share a segment if and only if their edge is in the complex, three share a
    corner if and only if their triangle is.

    Attributes
    ----------
    points : (n, 2) float64
    representative : (n,) int32
        The lowest row with the coordinates of row i. Only that row has a cell; with
        weights, the lowest of the heaviest ones, once its disc reaches its cell.
    radius : float
    offset : (n + 1,) int64
        Pieces ``offset[i]`` to ``offset[i + 1]`` of the arrays below are the border of the
        cell of row i, counter-clockwise; none for merged duplicates.
    start, end : (k, 2) float64
        Where each piece begins and ends. The end of a piece is the start of the next to the
        last bit, that of the last piece the start of the first.
    neighbor : (k,) int32
        The row across a segment; -1 for an arc.
    angles : (k, 2) float64
        From where to where an arc runs, in radians, the second angle larger than the first
        by at most 2 pi; NaN for a segment. Rounding can make both equal for an arc too
        short to be told from a point.
    area : (n,) float64
        Area of each cell; 0 for merged duplicates.
    segment_length, arc_length : (n,) float64
        Length of the straight and of the round part of each border.
    disc_radii : (n,) float64 or None
        With weights, the radius of each disc: the root of weight and signed square of
        `radius`, 0 where that is negative. None if `radius` is that of all.

    All arrays are read-only.

    Notes
    -----
    A cell that nothing cuts is one arc of a full turn. A neighbour that the disc only
    touches has a segment of length 0; so have two of four points on a common circle, in
    the complex as in :class:`~alphamesh.delaunay.Delaunay`. At radius 0 each cell is the
    point itself: one arc without length.

    References
    ----------
    .. [1] H. Edelsbrunner, The union of balls and its dual shape, Discrete &
       Computational Geometry 13 (1995) 415-440.
    """

    points: FloatArray
    representative: IntArray
    radius: float
    offset: CountArray
    start: FloatArray
    end: FloatArray
    neighbor: IntArray
    angles: FloatArray
    area: FloatArray
    segment_length: FloatArray
    arc_length: FloatArray
    disc_radii: FloatArray | None = None

    # Pieces

    @cached_property
    def cell(self) -> IntArray:
        """The row in whose border each piece is, ``(k,)`` int32."""
        rows = np.arange(len(self.points), dtype=np.int32)
        return read_only(np.repeat(rows, np.diff(self.offset)))

    @cached_property
    def is_arc(self) -> BoolArray:
        """Which pieces are arcs, ``(k,)`` bool; the others are segments."""
        return read_only(self.neighbor < 0)

    @cached_property
    def edges(self) -> IntArray:
        """Pairs of cells that share a segment, ``(e, 2)`` int32, ascending; from the pieces."""
        mine = self.cell < self.neighbor
        pairs = np.column_stack((self.cell[mine], self.neighbor[mine]))
        return read_only(pairs[np.lexsort(pairs.T[::-1])])

    @cached_property
    def triangles(self) -> IntArray:
        """Triples of cells that share a corner, ``(t, 3)`` int32, ascending: likewise."""
        following = arcs.next_pieces(self.offset)
        neighbor, beyond = self.neighbor, self.neighbor[following]
        # Each corner is seen from three cells; the one of the lowest row counts.
        mine = (neighbor > self.cell) & (beyond > self.cell)
        triples = np.column_stack((self.cell[mine], neighbor[mine], beyond[mine]))
        triples[:, 1:].sort(axis=1)
        return read_only(triples[np.lexsort(triples.T[::-1])])

    # Cells

    def neighbors(self, row: int) -> IntArray:
        """Return the rows whose cells share a segment with that of `row`, counter-clockwise.

        Raises
        ------
        ParameterError
            If there is no such row.
        """
        if not 0 <= row < len(self.points):
            raise ParameterError(f"row must be 0 to {len(self.points) - 1}; got {row!r}")
        around = self.neighbor[self.offset[row] : self.offset[row + 1]]
        return read_only(around[around >= 0])

    @cached_property
    def is_free(self) -> BoolArray:
        """Which cells no neighbour touches, whole discs, ``(n,)`` bool; not merged rows."""
        touched = np.zeros(len(self.points), dtype=np.bool_)
        touched[self.cell[~self.is_arc]] = True
        return read_only(~touched & (np.diff(self.offset) > 0))

    @cached_property
    def border_length(self) -> FloatArray:
        """Length of the whole border of each cell, ``(n,)`` float64."""
        return read_only(self.segment_length + self.arc_length)

    @cached_property
    def total_area(self) -> float:
        """Area of the union of the discs: the sum over the cells."""
        with np.errstate(over="ignore"):
            return float(self.area.sum())

    @cached_property
    def outer_length(self) -> float:
        """Length of the boundary of the union of the discs: the sum of all arcs."""
        with np.errstate(over="ignore"):
            return float(self.arc_length.sum())

    @property
    def largest_radius(self) -> float:
        """Radius of the largest disc."""
        if self.disc_radii is None:
            return self.radius
        return float(self.disc_radii.max(initial=0.0))

    # Outlines

    def polygons(self, tolerance: float | None = None) -> tuple[FloatArray, CountArray]:
        """Return each cell as a polygon, its arcs replaced by chords.

        Parameters
        ----------
        tolerance : float, optional
            The most that a chord may be away from its arc, in the units of the points; by
            default a thousandth of the radius, with weights of the largest one.

        Returns
        -------
        vertices : (m, 2) float64
            Counter-clockwise, the first of a cell not repeated. Where two cells meet they
            have the same numbers.
        offset : (n + 1,) int64
            Vertices ``offset[i]`` to ``offset[i + 1]`` are the cell of row i. None for
            merged duplicates and at radius 0.

        Raises
        ------
        ParameterError
            If `tolerance` is not a positive number.
        """
        return arcs.polygons(self._border, self._tolerance(tolerance))

    def bezier_paths(self) -> tuple[FloatArray, CodeArray, CountArray]:
        """Return each cell as a path of lines and cubic Bézier curves.

        Returns
        -------
        vertices : (m, 2) float64
        codes : (m,) uint8
            What matplotlib calls the codes of a path: 1 move to, 2 line to, 4 curve to,
            79 close. Thus ``Path(vertices[a:b], codes[a:b])`` is one cell, and
            ``Path(vertices, codes)`` all of them.
        offset : (n + 1,) int64
            Where the path of each cell begins in both arrays; empty for merged duplicates
            and at radius 0.

        Notes
        -----
        An arc is cut into parts of at most an eighth of a turn, each within 5e-6 radii of
        its curve.
        """
        return arcs.bezier_paths(self._border)

    def svg_paths(self, digits: int = 9) -> list[str]:
        """Return each cell as the ``d`` of an SVG path, with true arcs.

        Parameters
        ----------
        digits : int, default 9
            Significant digits of the numbers, 1 to 17; 17 lose nothing.

        Returns
        -------
        list of n str
            Empty for merged duplicates and at radius 0. In the coordinates of the points,
            where y points up: let SVG turn them with ``transform="scale(1,-1)"``.

        Raises
        ------
        ParameterError
            If `digits` is not a whole number from 1 to 17.
        """
        return arcs.svg_paths(self._border, digits)

    def to_shapely(self, tolerance: float | None = None) -> _shapely.Geometries:
        """Return each cell as a shapely polygon.

        Parameters and errors are those of :meth:`polygons`.

        Returns
        -------
        (n,) object
            Empty polygons for merged duplicates and at radius 0.

        Raises
        ------
        MissingLibraryError
            If shapely is not installed.
        """
        return _shapely.polygons(*self.polygons(tolerance), "Turning cells into polygons")

    @property
    def _border(self) -> arcs.Border:
        return arcs.Border(
            self.points,
            self.largest_radius,
            self.offset,
            self.cell,
            self.start,
            self.end,
            self.neighbor,
            self.angles,
            self.disc_radii,
        )

    def _tolerance(self, tolerance: float | None) -> float:
        if tolerance is None:
            return self.largest_radius / 1000
        if not isinstance(tolerance, Real) or not tolerance > 0:
            raise ParameterError(
                "tolerance must be a positive number in the units of the points, or None "
                f"for a thousandth of the radius; got {tolerance!r}"
            )
        return float(tolerance)

    def __repr__(self) -> str:
        cells = int(np.count_nonzero(np.diff(self.offset)))
        return (
            f"<RestrictedVoronoi at radius {self.radius:.6g}: {cells:,} cells, "
            f"{int(np.count_nonzero(self.is_free)):,} free>"
        )


def restricted_voronoi(
    filtration: Filtration,
    radius: float,
    *,
    threads: int | None = None,
    progress: Progress | None = None,
) -> RestrictedVoronoi:
    """Cut every Voronoi cell of a cloud by the disc of `radius` around its point.

    With weights, every cell of the power diagram by the disc of its point's own radius.

    Parameters
    ----------
    filtration : Filtration
        From :func:`alphamesh.filtration.filtration`, or ``AlphaComplex.filtration``. Its
        exact values decide which segments and corners there are.
    radius : float
        In the units of the points; finite, 0 or more unless these have weights.
    threads : int, optional
        Threads to use; by default one for each usable CPU. The result does not depend
        on it.
    progress : callable, optional
        Called with the fraction that is done, from 0 to 1, about ten times a second.

    Returns
    -------
    RestrictedVoronoi

    Raises
    ------
    ParameterError
        If `radius` is not a finite number of at least 0, or one of the others is not what
        it must be.
    """
    _refuse_others(filtration)
    radius = _checked(radius, signed=filtration.weights is not None)
    points, weights, exponent = kernel_balls(filtration.points, filtration.weights)
    _, edges, triangles = filtration.simplices
    disc_radii = _disc_radii(filtration.weights, radius)
    offset, start, end, neighbor, angles, straight_area, segment_length, arc_length = (
        restricted2(
            points,
            triangles,
            filtration.radii[2] <= radius,
            edges,
            filtration.radii[1] <= radius,
            filtration.edge_triangles,
            _with_cells(filtration, radius),
            scaled_radius(radius, exponent),
            threads,
            progress,
            weights=weights,
        )
    )
    arc_length = rescaled(arc_length, exponent)
    with np.errstate(over="ignore", under="ignore"):
        sectors = arc_length * ((radius if disc_radii is None else disc_radii) / 2)
        area = rescaled(straight_area, 2 * exponent) + sectors
    return RestrictedVoronoi(
        filtration.points,
        filtration.representative,
        radius,
        offset,
        rescaled(start, exponent),
        rescaled(end, exponent),
        neighbor,
        angles,
        read_only(area),
        rescaled(segment_length, exponent),
        arc_length,
        disc_radii,
    )


def _with_cells(filtration: Filtration, radius: float) -> BoolArray:
    """Return which rows have a cell at a radius: the vertices of the complex."""
    has = np.zeros(len(filtration.points), dtype=np.bool_)
    has[filtration.simplices[0][:, 0]] = filtration.radii[0] <= radius
    return has


def _disc_radii(weights: FloatArray | None, radius: float) -> FloatArray | None:
    """Return the radius of each disc; None without weights."""
    if weights is None:
        return None
    square = float(signed_square(np.array(radius)))
    if math.isinf(square):  # beside which weights are nothing
        return read_only(np.full(len(weights), max(radius, 0.0)))
    return read_only(np.sqrt(np.maximum(weights + square, 0.0)))


def _refuse_others(filtration: Filtration) -> None:
    """Raise unless this is a filtration in the plane."""
    given: Any = filtration
    if not isinstance(given, Filtration):
        raise ParameterError(
            f"restricted_voronoi needs a filtration, not {type(given).__name__}; make one with "
            "alphamesh.filtration(points), or use AlphaComplex.restricted_voronoi(radius)"
        )


def _checked(radius: object, *, signed: bool) -> float:
    """Return `radius` as a float, or say what is wrong with it."""
    value = float(radius) if isinstance(radius, Real) else math.nan
    if math.isfinite(value) and (value >= 0 or signed):
        return value
    least = "" if signed else " of at least 0"
    raise ParameterError(
        f"radius must be a finite number{least}, in the units of the points; got {radius!r}"
    )
