"""What goes around a cloud: its convex hull, and a frame of points."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from alphamesh.plot.drawing import Canvas, Drawing
from alphamesh.plot.paths import closed_rings, outline_paths

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from numpy.typing import NDArray

    from alphamesh.frame import FramedDelaunay
    from alphamesh.hull import ConvexHull

__all__ = ["plot_frame", "plot_hull"]


def plot_hull(hull: ConvexHull, ax: Axes | None = None) -> Drawing:
    """Draw a convex hull around its cloud.

    Parameters
    ----------
    hull : ConvexHull
    ax : matplotlib.axes.Axes, optional
        Axes to draw on; new ones in a new figure if None.

    Returns
    -------
    Drawing
        With the artists ``"hull"`` (the area), ``"hull_edges"``, ``"corners"`` (the points
        of the ring) and ``"points"``.
    """
    canvas = Canvas(hull.points, ax)
    if len(hull.ring) > 2:
        ring = closed_rings(hull.corners, np.array([0, len(hull.ring)]))
        canvas.fill("hull", outline_paths(*ring, np.zeros(1, dtype=np.int64)), of=1)
    canvas.segments("hull_edges", hull.edges, max(canvas.sizes.boundary, 1.2))
    canvas.markers("points", slice(None), canvas.sizes.point)
    canvas.markers("corners", hull.ring, max(1.2 * canvas.sizes.point, 2.6))
    return canvas.drawing()


def plot_frame(framed: FramedDelaunay, ax: Axes | None = None) -> Drawing:
    """Draw the triangulation that a frame of points carves out of a cloud.

    Parameters
    ----------
    framed : FramedDelaunay
    ax : matplotlib.axes.Axes, optional
        Axes to draw on; new ones in a new figure if None.

    Returns
    -------
    Drawing
        With the artists ``"triangles"``, ``"edges"`` and ``"boundary_edges"`` (what is
        kept), ``"frame_edges"`` (what is dropped), ``"frame_points"`` and, where there is
        room for them, ``"points"``.
    """
    full = framed.full
    canvas = Canvas(full.points, ax)
    dropped = full.triangles[len(framed.triangles) :]
    edges = np.unique(dropped[:, [[0, 1], [0, 2], [1, 2]]].reshape(-1, 2), axis=0)
    canvas.segments("frame_edges", edges, max(0.7 * canvas.sizes.edge, 0.2))
    canvas.triangles("triangles", framed.triangles)
    canvas.segments("edges", framed.edges, canvas.sizes.edge)
    canvas.segments("boundary_edges", _border(framed), canvas.sizes.boundary)
    if canvas.sizes.shows_edges:
        canvas.markers("points", slice(None, len(framed.points)), canvas.sizes.point)
    canvas.markers(
        "frame_points", slice(len(framed.points), None), max(canvas.sizes.point, 1.0)
    )
    return canvas.drawing()


def _border(framed: FramedDelaunay) -> NDArray[np.int32]:
    """Return the edges of the kept triangles that have a triangle on one side only."""
    opposite = framed.triangles[:, [[1, 2], [0, 2], [0, 1]]]
    border: NDArray[np.int32] = opposite[framed.neighbors < 0]
    return border
