"""The whole story in one picture: from the cloud and its hull to the alpha complex."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from alphamesh.errors import ParameterError
from alphamesh.hull import convex_hull
from alphamesh.plot.cells import cell_coloring, plot_restricted_voronoi, plot_voronoi
from alphamesh.plot.complexes import plot_complex, plot_delaunay
from alphamesh.plot.drawing import plot_cloud
from alphamesh.plot.outlines import plot_hull
from alphamesh.plot.overview import cloud_text, delaunay_title
from alphamesh.plot.panels import (
    add_legend,
    add_title,
    complex_text,
    counted,
    filtration_of,
    panels,
)
from alphamesh.radius import choose_radius
from alphamesh.restricted import restricted_voronoi
from alphamesh.shape import AlphaShape
from alphamesh.voronoi import voronoi_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from alphamesh.filtration import Filtration
    from alphamesh.plot.panels import HasFiltration

__all__ = ["plot_story"]


def plot_story(
    source: Filtration | HasFiltration, radius: float | None = None, *, columns: int = 3
) -> Figure:
    """Draw how a cloud becomes a complex, step by step.

    The panels: cloud, convex hull, Voronoi cells, Delaunay triangulation, Voronoi cells cut
    by discs, and the alpha complex, which joins the cells that still touch. A cell has the
    same colour in both panels.

    Parameters
    ----------
    source : Filtration or AlphaComplex
    radius : float, optional
        Finite radius of discs and complex, in the units of the points; chosen by the
        default rule if None.
    columns : int, default 3
        How many panels stand side by side, from 1 to 6.

    Returns
    -------
    matplotlib.figure.Figure
        A new figure with six axes.

    Raises
    ------
    ParameterError
        If `radius` is not finite, or `columns` is not a whole number from 1 to 6.
    """
    given: Any = columns
    if not isinstance(given, int | np.integer) or not 1 <= given <= 6:
        raise ParameterError(f"columns must be a whole number from 1 to 6; got {columns!r}")
    filtration = filtration_of(source)
    if radius is None:
        radius = choose_radius(filtration).radius
    cells = restricted_voronoi(filtration, radius)
    shape = AlphaShape(filtration, radius)
    figure, axes = panels(filtration.points, 6, int(columns))
    _whole_cloud(filtration, cells.largest_radius, axes)
    plot_restricted_voronoi(cells, axes[4], coloring=_coloring(filtration))
    free = int(np.count_nonzero(cells.is_free))
    text = counted(len(cells.edges), "pair of cells touches", "pairs of cells touch")
    add_title(
        axes[4],
        f"Cells within radius {radius:.4g}",
        f"{text}, {counted(free, 'cell')} alone" if free else text,
    )
    drawing = plot_complex(shape, axes[5])
    add_title(axes[5], f"Alpha complex, radius {radius:.4g}", complex_text(shape))
    for ax in axes[:4] + axes[5:]:  # the discs need a little more room: the same for all
        ax.set_xlim(*axes[4].get_xlim())
        ax.set_ylim(*axes[4].get_ylim())
    add_legend(figure, axes[5], drawing.artists)
    return figure


def _whole_cloud(filtration: Filtration, reach: float, axes: list[Axes]) -> None:
    """Fill the panels that know no radius."""
    points = filtration.points
    plot_cloud(points, axes[0])
    add_title(axes[0], "Cloud", cloud_text(filtration))
    hull = convex_hull(points)
    plot_hull(hull, axes[1])
    add_title(axes[1], "Convex hull", counted(len(hull.ring), "corner"))
    voronoi = voronoi_of(filtration)
    plot_voronoi(voronoi, axes[2], coloring=_coloring(filtration), reach=reach)
    add_title(
        axes[2],
        "Voronoi cells" if filtration.weights is None else "Power cells",
        f"{counted(len(filtration.simplices[0]), 'cell')}, "
        f"{counted(len(voronoi.ridge_points), 'border')}",
    )
    plot_delaunay(filtration, axes[3])
    add_title(axes[3], *delaunay_title(filtration))


def _coloring(filtration: Filtration) -> np.ndarray[tuple[int], np.dtype[np.int64]]:
    return cell_coloring(len(filtration.points), filtration.simplices[1])
