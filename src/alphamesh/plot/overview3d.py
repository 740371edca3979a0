"""The first picture of a cloud in space: the cloud, its complex, and that cut open."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.colors import to_rgb

from alphamesh.plot.drawing import Drawing, new_figure
from alphamesh.plot.panels import add_title, cloud_text, counted, panels
from alphamesh.plot.scene import Camera, frame_of, hazed
from alphamesh.plot.solids import VIEW, plot_solid
from alphamesh.plot.style import COLORS
from alphamesh.points import as_cloud, coordinate_error
from alphamesh.radius import choose_radius
from alphamesh.shape3d import AlphaShape3D

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from alphamesh.filtration3d import Filtration3D
    from alphamesh.solid import SolidShape

__all__ = ["plot_cloud_in_space", "plot_overview_in_space", "plot_shape_in_space"]

# Beyond this many points a vector file becomes slow to open: pixels instead.
_RASTER_FROM = 20_000
_SQUARE = np.array([[0.0, 0.0], [1.0, 1.0]])


def plot_cloud_in_space(
    points: Any, ax: Axes | None = None, *, view: tuple[float, float] = VIEW
) -> Drawing:
    """Draw the points of a cloud in space, paler the farther away they are.

    Parameters
    ----------
    points : (n, 3) array-like
    ax : matplotlib.axes.Axes, optional
        Ordinary axes of two dimensions; new ones in a new figure if None.
    view : (float, float), default (24, -58)
        Where it is seen from: elevation above the xy-plane and azimuth from the x-axis, in
        degrees.

    Returns
    -------
    Drawing
        With the artists ``"points"``.

    Raises
    ------
    CloudError
        If `points` is not a cloud in space, or not finite.
    ParameterError
        If `view` is not two numbers.
    """
    cloud = as_cloud(points, 3).points
    if not np.isfinite(cloud).all():
        raise coordinate_error(cloud)
    owned = ax is None
    if ax is None:
        ax = new_figure(6, 6).add_axes((0.02, 0.02, 0.96, 0.96))
    ax.set_axis_off()
    ax.set_aspect("equal")
    flat, near = Camera.at(cloud, view).seen(cloud)
    order = np.argsort(near, kind="stable")
    colors = hazed(np.tile(to_rgb(COLORS["points"]), (len(cloud), 1)), near, strength=0.75)
    diameter = float(np.clip(90.0 / np.sqrt(max(len(cloud), 1)), 0.25, 4.0))
    dots = ax.scatter(
        flat[order, 0],
        flat[order, 1],
        s=diameter**2,
        c=colors[order],
        linewidths=0,
        rasterized=len(cloud) > _RASTER_FROM,
    )
    dots.set_snap(False)
    frame_of(ax, flat)
    return Drawing(ax, {"points": [dots]} if len(cloud) else {}, owned)


def plot_overview_in_space(filtration: Filtration3D, radius: float | None = None) -> Figure:
    """Draw a cloud in space, its alpha complex, and that cut open, side by side.

    See :func:`alphamesh.plot.plot_overview`.
    """
    if radius is None:
        radius = choose_radius(filtration).radius
    return plot_shape_in_space(AlphaShape3D(filtration, radius))


def plot_shape_in_space(shape: SolidShape) -> Figure:
    """Draw the cloud of a shape in space, the shape, and that cut open, side by side.

    Parameters
    ----------
    shape : AlphaShape3D or Selection3D

    Returns
    -------
    matplotlib.figure.Figure
        A new figure with three axes.
    """
    filtration = shape.filtration
    figure, (left, middle, right) = panels(_SQUARE, 3)
    plot_cloud_in_space(filtration.points, left)
    add_title(left, "Cloud", cloud_text(filtration))
    plot_solid(shape, middle)
    counts = shape.counts
    lone = counts["singular_triangles"]
    text = counted(counts["tetrahedra"], "tetrahedron", "tetrahedra")
    text = f"{text}, {counted(lone, 'triangle')} besides" if lone else text
    what = "Alpha complex" if isinstance(shape, AlphaShape3D) else "Solid"
    add_title(middle, f"{what}, radius {shape.radius:.4g}", text)
    plot_solid(shape, right, cut="-y")
    text = f"{counted(len(shape.regions), 'region')}, {counted(len(shape.voids), 'void')}"
    add_title(right, "Cut open", text)
    return figure
