"""What a plot function returns, and the canvas that all of them draw on."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.collections import PathCollection
from matplotlib.figure import Figure
from matplotlib.markers import MarkerStyle
from numpy.typing import NDArray

from alphamesh.plot.paths import line_paths, triangle_paths
from alphamesh.plot.style import COLORS, LAYERS, frame, sizes
from alphamesh.points import as_cloud, coordinate_error

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes
    from matplotlib.path import Path
    from numpy.typing import ArrayLike

__all__ = ["Canvas", "Drawing", "new_figure", "plot_cloud"]

# Beyond this many simplices a vector file becomes slow to open: pixels instead.
_RASTER_FROM = 20_000

# Simplices per artist: one artist is drawn in one call that no Ctrl-C interrupts.
_PER_ARTIST = 100_000


@dataclass(frozen=True)
class Drawing:
    """The axes drawn on and the artists added to them, by role.

    Attributes
    ----------
    axes : matplotlib.axes.Axes
    artists : mapping of str to list of matplotlib.artist.Artist
        Only what the data holds: no entry ``"singular_edges"`` without singular edges.
    owns_figure : bool
        Whether the figure was made for this drawing (``ax=None``).
    """

    axes: Axes
    artists: Mapping[str, list[Artist]] = field(repr=False)
    owns_figure: bool = False

    @property
    def figure(self) -> Figure:
        """The figure that holds the axes."""
        return self.axes.figure.figure  # that around all subfigures

    def _repr_png_(self) -> bytes | None:
        """Show a figure of our own in a notebook; pyplot shows the others."""
        from alphamesh.plot.render import figure_bytes

        return figure_bytes(self.figure, "png") if self.owns_figure else None


def new_figure(width: float, height: float) -> Figure:
    """Return a white figure of `width` by `height` inches, unknown to pyplot."""
    figure = Figure(figsize=(width, height), dpi=160, facecolor="white")
    FigureCanvasAgg(figure)
    return figure


def plot_cloud(points: ArrayLike, ax: Axes | None = None) -> Drawing:
    """Draw the points of a cloud.

    Parameters
    ----------
    points : (n, 2) array-like
    ax : matplotlib.axes.Axes, optional
        Axes to draw on; new ones in a new figure if None.

    Returns
    -------
    Drawing
        With the artists ``"points"``.

    Raises
    ------
    CloudError
        If `points` is not a cloud, or not finite.
    """
    cloud = as_cloud(points, 2).points
    if not np.isfinite(cloud).all():
        raise coordinate_error(cloud)
    canvas = Canvas(cloud, ax)
    canvas.markers("points", slice(None), canvas.sizes.point)
    return canvas.drawing()


class Canvas:
    """Axes, the points drawn on them, and the artists so far.

    Parameters
    ----------
    points : (n, 2) float64 array
        What rows refer to; the axes are made to hold all of it.
    ax : matplotlib.axes.Axes, optional
        New axes without ticks in a new figure if None.
    reach : float, default 0
        How far what is drawn reaches beyond the points, in their units; as much of it
        as leaves the points in the middle of attention is shown.
    """

    def __init__(
        self, points: NDArray[np.float64], ax: Axes | None, *, reach: float = 0.0
    ) -> None:
        self._owned = ax is None
        if ax is None:
            ax = new_figure(6, 6).add_axes((0.02, 0.02, 0.96, 0.96))
            ax.set_axis_off()
        frame(ax, points, reach)
        self.ax = ax
        self.points = points
        self.sizes = sizes(points, ax)
        self._artists: dict[str, list[Artist]] = {}

    def drawing(self) -> Drawing:
        """Return what has been drawn."""
        return Drawing(self.ax, self._artists, self._owned)

    def markers(self, role: str, rows: NDArray[np.integer] | slice, diameter: float) -> None:
        """Mark points by dots of `diameter` (1/72 inch); nothing for no rows."""
        points = self.points[rows]
        for start in range(0, len(points), _PER_ARTIST):
            part = points[start : start + _PER_ARTIST]
            dots = self.ax.scatter(
                part[:, 0],
                part[:, 1],
                s=diameter**2,
                c=COLORS[role],
                marker=MarkerStyle("o"),
                linewidths=0,
                zorder=LAYERS[role],
                rasterized=len(points) > _RASTER_FROM,
            )
            # Dots moved to whole pixels would show as a grid that is not there.
            dots.set_snap(False)
            self._artists.setdefault(role, []).append(dots)

    def segments(self, role: str, edges: NDArray[np.integer], width: float) -> None:
        """Draw edges as lines of `width` (1/72 inch); nothing for no rows."""
        for start in range(0, len(edges), _PER_ARTIST):
            ends = self.points[edges[start : start + _PER_ARTIST]]
            self.strokes(role, line_paths(ends), width, of=len(edges))

    def strokes(self, role: str, paths: list[Path], width: float, *, of: int) -> None:
        """Draw paths as lines of `width` (1/72 inch); they hold some of `of` things."""
        self.paths(
            role,
            paths,
            of=of,
            facecolors="none",
            edgecolors=COLORS[role],
            linewidths=width,
            capstyle="round",
        )

    def triangles(self, role: str, triangles: NDArray[np.integer]) -> None:
        """Fill triangles, all of which turn the same way; nothing for no rows."""
        for start in range(0, len(triangles), _PER_ARTIST):
            part = triangles[start : start + _PER_ARTIST]
            self.fill(role, triangle_paths(self.points, part), of=len(triangles))

    def fill(self, role: str, paths: list[Path], *, of: int, color: str | None = None) -> None:
        """Fill paths that hold some of `of` things, all outlines of which turn one way."""
        color = COLORS[role] if color is None else color
        self.paths(
            role,
            paths,
            of=of,
            facecolors=color,
            edgecolors=color,
            linewidths=0.3,  # closes the seam between one path and the next
            joinstyle="round",
        )

    def paths(self, role: str, paths: list[Path], *, of: int, **look: Any) -> None:
        """Add paths that hold some of `of` simplices; nothing for no paths."""
        if not paths:
            return
        artist = PathCollection(
            paths, zorder=LAYERS[role], rasterized=of > _RASTER_FROM, **look
        )
        artist.set_snap(False)
        # A single path would be measured curve by curve, in Python, to be stamped as a
        # marker; two links, to nowhere, prevent it.
        artist.set_urls([None, None])
        self.ax.add_collection(artist, autolim=False)
        self._artists.setdefault(role, []).append(artist)
