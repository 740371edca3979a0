"""Delaunay triangulation, alpha complex and filtration, drawn simplex by simplex."""

from __future__ import annotations

from typing import TYPE_CHECKING

import matplotlib as mpl
import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.colors import LogNorm, Normalize

from alphamesh.plot.drawing import Canvas, Drawing
from alphamesh.plot.paths import segment_paths, triangle_paths
from alphamesh.plot.style import COLORMAP, COLORS, point_spacing

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.path import Path
    from numpy.typing import NDArray

    from alphamesh.delaunay import Delaunay
    from alphamesh.filtration import Filtration
    from alphamesh.simplices import SimplexSet

__all__ = ["add_complex", "plot_complex", "plot_delaunay", "plot_filtration"]

# Least width in 1/72 inch of edges that stand alone, across a gap in a dense cloud.
_LONG_EDGE = 0.3

# From this share of the points on, isolated vertices are a crowd.
_CROWD = 0.1

# A value's colour is one of so many: enough for the eye, few enough to draw fast.
_LEVELS = 128


def plot_delaunay(triangulation: Delaunay | Filtration, ax: Axes | None = None) -> Drawing:
    """Draw the edges and points of a Delaunay triangulation.

    Parameters
    ----------
    triangulation : Delaunay or Filtration
        A filtration holds the edges of its triangulation, too.
    ax : matplotlib.axes.Axes, optional
        Axes to draw on; new ones in a new figure if None.

    Returns
    -------
    Drawing
        With the artists ``"edges"`` and, where there is room for them, ``"points"``.
    """
    canvas = Canvas(triangulation.points, ax)
    edges = getattr(triangulation, "edges", None)
    if edges is None:
        edges = triangulation.simplices[1]  # type: ignore[union-attr]
    long = _long(triangulation.points, edges)
    canvas.segments("edges", edges[~long], canvas.sizes.edge)
    canvas.segments("edges", edges[long], max(canvas.sizes.edge, _LONG_EDGE))
    if canvas.sizes.shows_edges:
        canvas.markers("points", slice(None), canvas.sizes.point)
    return canvas.drawing()


def _long(points: NDArray[np.float64], edges: NDArray[np.integer]) -> NDArray[np.bool_]:
    """Return which edges are several times as long as neighbours are apart."""
    ends = points[edges]
    lengths = np.hypot(*(ends[:, 1] - ends[:, 0]).T)
    return np.asarray(lengths > 6 * point_spacing(points))


def plot_complex(shape: SimplexSet, ax: Axes | None = None) -> Drawing:
    """Draw an alpha complex: triangles, their border, and what belongs to no triangle.

    Parameters
    ----------
    shape : AlphaShape or Selection
        The complex at one radius.
    ax : matplotlib.axes.Axes, optional
        Axes to draw on; new ones in a new figure if None.

    Returns
    -------
    Drawing
        With the artists ``"triangles"``, ``"interior_edges"`` and ``"vertices"``
        (left out where too small to see), ``"boundary_edges"``,
        ``"singular_edges"`` and ``"isolated_vertices"``.
    """
    canvas = Canvas(shape.points, ax)
    add_complex(canvas, shape)
    return canvas.drawing()


def add_complex(canvas: Canvas, shape: SimplexSet) -> None:
    """Add a complex to a canvas that holds its points."""
    size = canvas.sizes
    canvas.triangles("triangles", shape.triangles)
    if size.shows_edges:
        canvas.segments("interior_edges", shape.interior_edges, size.edge)
    canvas.segments("boundary_edges", shape.boundary_edges, size.boundary)
    canvas.segments("singular_edges", shape.singular_edges, size.singular)
    if size.shows_vertices:
        canvas.markers("vertices", np.unique(shape.edges), 0.7 * size.point)
    isolated = shape.isolated_vertices
    # One alone must be seen; many together must not hide where they are.
    crowd = len(isolated) > _CROWD * len(shape.points)
    diameter = min(size.isolated, max(size.point, 0.35 * size.spacing)) if crowd else None
    canvas.markers("isolated_vertices", isolated, diameter or size.isolated)


def plot_filtration(filtration: Filtration, ax: Axes | None = None) -> Drawing:
    """Draw every triangle and edge in the colour of its filtration value.

    Parameters
    ----------
    filtration : Filtration
    ax : matplotlib.axes.Axes, optional
        Axes to draw on; new ones in a new figure if None. A colour bar is put
        beside them.

    Returns
    -------
    Drawing
        With the artists ``"triangles"``, ``"edges"`` and, where there is room for
        them, ``"points"``. Colours run over the logarithm of the value, as values
        spread over orders of magnitude.
    """
    canvas = Canvas(filtration.points, ax)
    values = np.concatenate(filtration.radii[1:])
    if len(values):
        norm = _norm(values)
        _add_valued(canvas, "triangles", filtration, norm)
        _add_valued(canvas, "edges", filtration, norm)
        _add_scale(canvas, norm)
    if canvas.sizes.shows_vertices:
        canvas.markers("points", slice(None), 0.5 * canvas.sizes.point)
    return canvas.drawing()


def _norm(values: NDArray[np.float64]) -> Normalize:
    """Return a scale over all but the extreme values, logarithmic where it can be."""
    low, high = (float(value) for value in np.quantile(values, [0.02, 0.98]))
    if 0 < low < high:
        return LogNorm(low, high, clip=True)
    return Normalize(low, high if high > low else low + 1, clip=True)


def _add_scale(canvas: Canvas, norm: Normalize) -> None:
    """Put a colour bar beside the axes, with round numbers."""
    low, high = float(norm.vmin or 0), float(norm.vmax or 0)
    space = np.geomspace if isinstance(norm, LogNorm) else np.linspace
    ticks = [float(f"{value:.2g}") for value in space(low, high, 6)[1:-1]]
    bar = canvas.drawing().figure.colorbar(
        ScalarMappable(norm, COLORMAP),
        ax=canvas.ax,
        shrink=0.7,
        pad=0.02,
        ticks=ticks,
        format="%g",
    )
    bar.minorticks_off()
    bar.ax.tick_params(labelsize=8, labelcolor=COLORS["text"], color=COLORS["text"])
    bar.ax.set_title("radius", fontsize=9, color=COLORS["text"])
    bar.outline.set_visible(False)


def _add_valued(canvas: Canvas, role: str, filtration: Filtration, norm: Normalize) -> None:
    """Add the edges or triangles, one colour for each level of value."""
    edges = role == "edges"
    dimension, make_paths = (1, segment_paths) if edges else (2, triangle_paths)
    simplices, values = filtration.simplices[dimension], filtration.radii[dimension]
    if len(simplices) == 0:
        return
    level = np.clip(np.asarray(norm(values)) * _LEVELS, 0, _LEVELS - 1).astype(np.intp)
    order = np.argsort(level, kind="stable")
    ends = np.searchsorted(level[order], np.arange(_LEVELS + 1))
    paths: list[Path] = []
    shades: list[float] = []
    for number in range(_LEVELS):
        part = make_paths(filtration.points, simplices[order[ends[number] : ends[number + 1]]])
        paths += part
        shades += [(number + 0.5) / _LEVELS] * len(part)
    colors = mpl.colormaps[COLORMAP](np.array(shades))
    canvas.paths(
        role,
        paths,
        of=len(simplices),
        facecolors="none" if edges else colors,
        edgecolors=colors,
        linewidths=2 * canvas.sizes.edge if edges else 0.3,
    )
