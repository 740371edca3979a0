"""Voronoi cells, whole and cut by discs; every arc is drawn as a curve."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.path import Path
from numpy.typing import NDArray

from alphamesh.errors import ParameterError
from alphamesh.plot.drawing import Canvas, Drawing
from alphamesh.plot.paths import closed_rings, curve_paths, line_paths, outline_paths
from alphamesh.plot.style import CELL_COLORS, on_paper, point_spacing

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from alphamesh.restricted import RestrictedVoronoi
    from alphamesh.voronoi import Voronoi

__all__ = ["cell_coloring", "plot_restricted_voronoi", "plot_union", "plot_voronoi"]

# In 1/72 inch: the outline of a shape that has hardly any beside its inside.
_THINNEST_OUTLINE = 0.45

# Outlines: vertices, codes, and where each begins.
_Outlines = tuple[NDArray[np.float64], NDArray[np.uint8], NDArray[np.int64]]


def cell_coloring(count: int, edges: NDArray[np.integer]) -> NDArray[np.int64]:
    """Return a colour number for each cell, so that cells that meet have different ones.

    Parameters
    ----------
    count : int
        Number of cells.
    edges : (e, 2) integer array
        Which cells meet, such as the edges of the Delaunay triangulation.

    Returns
    -------
    (count,) int64
        From 0 upwards, as small as those of the neighbours allow: rarely more than six.
        The same for the same `edges`.

    Notes
    -----
    In rounds: every cell that comes before all its uncoloured neighbours in a random order
    takes the least number that its neighbours left.
    """
    place = np.random.default_rng(0).permutation(count)
    colors = np.full(count, -1, dtype=np.int64)
    taken = np.zeros(count, dtype=np.int64)  # bit c: a neighbour has colour c
    todo, left = np.arange(count), np.asarray(edges, dtype=np.int64)
    while len(todo):
        waiting = np.zeros(count, dtype=np.bool_)
        waiting[np.where(place[left[:, 0]] < place[left[:, 1]], left[:, 1], left[:, 0])] = True
        bits = taken[todo]
        free = ~bits & (bits + 1)
        turn = ~waiting[todo]
        colors[todo[turn]] = np.log2(free[turn]).astype(np.int64)
        for here, there in ((0, 1), (1, 0)):
            told = left[colors[left[:, here]] >= 0]
            np.bitwise_or.at(taken, told[:, there], 1 << colors[told[:, here]])
        todo = todo[~turn]
        left = left[(colors[left] < 0).all(axis=1)]
    return colors


def plot_voronoi(
    voronoi: Voronoi,
    ax: Axes | None = None,
    *,
    fill: bool = True,
    coloring: NDArray[np.integer] | None = None,
    reach: float = 0.0,
) -> Drawing:
    """Draw a Voronoi diagram, cut at the border of the axes.

    Parameters
    ----------
    voronoi : Voronoi
    ax : matplotlib.axes.Axes, optional
        Axes to draw on; new ones in a new figure if None.
    fill : bool, default True
        Colour the cells.
    coloring : (n,) integer array, optional
        Number of the colour of each cell; by default from :func:`cell_coloring`.
    reach : float, default 0
        Show more around the points: as much as :func:`plot_restricted_voronoi` does at
        this radius.

    Returns
    -------
    Drawing
        With the artists ``"cells"``, ``"ridges"`` (among coloured cells too small to see,
        long ones alone) and, where there is room for them, ``"points"``.

    Raises
    ------
    ParameterError
        If `coloring` does not have one number for each point.
    """
    canvas = Canvas(voronoi.points, ax, reach=reach)
    box = _box(canvas.ax)
    if len(voronoi.points):
        if fill:
            cells = voronoi.clip(box)
            rings = closed_rings(cells.vertices, cells.ring_offset)
            outlines = rings[0], rings[1], rings[2][cells.offset]
            colors = _checked(coloring, len(voronoi.points), voronoi.ridge_points)
            _add_cells(canvas, outlines, colors)
        ridges, _ = voronoi.segments(box)
        if fill and not canvas.sizes.shows_edges:  # short ones would hide all colours
            lengths = np.hypot(*(ridges[:, 1] - ridges[:, 0]).T)
            ridges = ridges[lengths > 6 * point_spacing(voronoi.points)]
        width = canvas.sizes.edge if fill else 1.4 * canvas.sizes.edge
        canvas.strokes("ridges", line_paths(ridges), width, of=len(ridges))
    _add_points(canvas)
    return canvas.drawing()


def plot_restricted_voronoi(
    cells: RestrictedVoronoi,
    ax: Axes | None = None,
    *,
    coloring: NDArray[np.integer] | None = None,
) -> Drawing:
    """Draw Voronoi cells cut by discs: coloured, with straight borders and true arcs.

    Parameters
    ----------
    cells : RestrictedVoronoi
    ax : matplotlib.axes.Axes, optional
        Axes to draw on; new ones in a new figure if None.
    coloring : (n,) integer array, optional
        Number of the colour of each cell; by default from :func:`cell_coloring`. Give the
        same one at several radii, made from the edges of the Delaunay triangulation, and
        every cell keeps its colour.

    Returns
    -------
    Drawing
        With the artists ``"cells"``, ``"segments"`` (between two cells; left out where too
        small to see), ``"arcs"`` and, where there is room for them, ``"points"``. At
        radius 0 there are points alone.

    Raises
    ------
    ParameterError
        If `coloring` does not have one number for each point.
    """
    canvas = Canvas(cells.points, ax, reach=cells.largest_radius)
    add_restricted(canvas, cells, coloring)
    _add_points(canvas)
    return canvas.drawing()


def add_restricted(
    canvas: Canvas, cells: RestrictedVoronoi, coloring: NDArray[np.integer] | None
) -> None:
    """Add the cells, their segments and arcs to a canvas that holds their points."""
    outlines = cells.bezier_paths()
    _add_cells(canvas, outlines, _checked(coloring, len(cells.points), cells.edges))
    if canvas.sizes.shows_edges:
        mine = cells.cell < cells.neighbor
        ends = np.stack((cells.start[mine], cells.end[mine]), axis=1)
        width = 1.3 * canvas.sizes.edge
        canvas.strokes("segments", line_paths(ends), width, of=len(ends))
    _add_arcs(canvas, outlines, cells.largest_radius)


def plot_union(cells: RestrictedVoronoi, ax: Axes | None = None) -> Drawing:
    """Draw the union of discs of one radius around the points.

    Parameters
    ----------
    cells : RestrictedVoronoi
        The cells that fill the union, at its radius.
    ax : matplotlib.axes.Axes, optional
        Axes to draw on; new ones in a new figure if None.

    Returns
    -------
    Drawing
        With the artists ``"union"``, ``"arcs"`` (its border) and, where there is room for
        them, ``"points"``.
    """
    canvas = Canvas(cells.points, ax, reach=cells.largest_radius)
    outlines = cells.bezier_paths()
    rows = np.flatnonzero(np.diff(outlines[2]))
    canvas.fill("union", outline_paths(*outlines, rows), of=len(rows))
    _add_arcs(canvas, outlines, cells.largest_radius)
    _add_points(canvas)
    return canvas.drawing()


def _add_cells(canvas: Canvas, outlines: _Outlines, colors: NDArray[np.integer]) -> None:
    """Fill outlines, one for each point."""
    drawn = np.diff(outlines[2]) > 0
    shade = np.asarray(colors) % len(CELL_COLORS)
    for number, color in enumerate(CELL_COLORS):
        rows = np.flatnonzero(drawn & (shade == number))
        paths = outline_paths(*outlines, rows)
        canvas.fill("cells", paths, of=int(drawn.sum()), color=color)


def _add_arcs(canvas: Canvas, outlines: _Outlines, radius: float) -> None:
    """Draw the curves among the outlines, which begin where the vertex before them is."""
    vertices, codes, _ = outlines
    curved = np.flatnonzero(codes == Path.CURVE4)[::3]
    curves = vertices[curved[:, np.newaxis] + np.arange(-1, 3)]
    width = max(0.7 * canvas.sizes.boundary, _THINNEST_OUTLINE)
    if len(curves) > len(canvas.points):
        # Around a crowd of small discs, bold outlines would leave nothing of the cells.
        width = min(width, max(0.15, 0.2 * on_paper(radius, canvas.ax)))
    canvas.strokes("arcs", curve_paths(curves), width, of=len(curves))


def _add_points(canvas: Canvas) -> None:
    if canvas.sizes.shows_edges or len(canvas.points) < 2:
        canvas.markers("points", slice(None), 0.7 * canvas.sizes.point)


def _box(ax: Axes) -> tuple[float, float, float, float]:
    """Return what the axes show: xmin, ymin, xmax, ymax."""
    (xmin, xmax), (ymin, ymax) = ax.get_xlim(), ax.get_ylim()
    return xmin, ymin, xmax, ymax


def _checked(
    coloring: NDArray[np.integer] | None, count: int, edges: NDArray[np.integer]
) -> NDArray[np.integer]:
    if coloring is None:
        return cell_coloring(count, edges)
    if np.shape(coloring) != (count,) or np.asarray(coloring).dtype.kind not in "iu":
        raise ParameterError(
            f"coloring must be {count} whole numbers, one for each point; "
            "alphamesh.plot.cell_coloring makes them"
        )
    return coloring
