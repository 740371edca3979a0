"""The first picture: cloud, Delaunay triangulation and alpha complex side by side."""

from __future__ import annotations

from typing import TYPE_CHECKING

from alphamesh.filtration3d import Filtration3D
from alphamesh.plot.complexes import plot_complex, plot_delaunay
from alphamesh.plot.drawing import plot_cloud
from alphamesh.plot.overview3d import plot_overview_in_space
from alphamesh.plot.panels import (
    add_legend,
    add_title,
    cloud_text,
    complex_text,
    counted,
    filtration_of,
    panels,
)
from alphamesh.radius import choose_radius
from alphamesh.shape import AlphaShape

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from alphamesh.filtration import Filtration
    from alphamesh.plot.panels import HasFiltration

__all__ = ["cloud_text", "delaunay_text", "delaunay_title", "plot_overview"]


def plot_overview(source: Filtration | HasFiltration, radius: float | None = None) -> Figure:
    """Draw a cloud, its Delaunay triangulation and its alpha complex side by side.

    In space, a cloud, its alpha complex, and that cut open.

    Parameters
    ----------
    source : Filtration or Filtration3D, AlphaComplex or AlphaComplex3D
    radius : float, optional
        Radius of the complex shown, in the units of the points; chosen by the
        default rule if None.

    Returns
    -------
    matplotlib.figure.Figure
        A new figure with three axes, whose height follows the cloud's proportions.
    """
    filtration = filtration_of(source)
    if isinstance(filtration, Filtration3D):
        return plot_overview_in_space(filtration, radius)
    if radius is None:
        radius = choose_radius(filtration).radius
    shape = AlphaShape(filtration, radius)
    figure, (left, middle, right) = panels(filtration.points, 3)
    plot_cloud(filtration.points, left)
    add_title(left, "Cloud", cloud_text(filtration))
    plot_delaunay(filtration, middle)
    add_title(middle, *delaunay_title(filtration))
    drawing = plot_complex(shape, right)
    add_title(right, f"Alpha complex, radius {radius:.4g}", complex_text(shape))
    add_legend(figure, right, drawing.artists)
    return figure


def delaunay_title(filtration: Filtration) -> tuple[str, str]:
    """Return the name of the triangulation, and how many simplices it has."""
    name = "Delaunay" if filtration.weights is None else "Regular"
    return f"{name} triangulation", delaunay_text(filtration)


def delaunay_text(filtration: Filtration) -> str:
    """Return how many simplices the triangulation has."""
    _, edges, triangles = filtration.simplices
    return f"{counted(len(triangles), 'triangle')}, {counted(len(edges), 'edge')}"
