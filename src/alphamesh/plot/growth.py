"""One frame of a film: two drawings at one radius, and where on the way it is."""

from __future__ import annotations

from abc import abstractmethod
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.lines import Line2D
from numpy.typing import NDArray

from alphamesh.errors import DimensionError
from alphamesh.filtration import Filtration
from alphamesh.persistence import Persistence
from alphamesh.plot.cells import add_restricted, cell_coloring
from alphamesh.plot.chart import Chart
from alphamesh.plot.complexes import add_complex
from alphamesh.plot.drawing import Canvas, new_figure
from alphamesh.plot.style import COLORS, frame
from alphamesh.plot.topology import add_betti_curves, classes_text
from alphamesh.restricted import restricted_voronoi
from alphamesh.shape import AlphaShape

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from alphamesh.periodic import PeriodicFiltration

__all__ = ["FilmView", "GrowthView", "farthest"]

# Inches: the width of the figure, of its margins, and the heights of what is written and
# of the Betti curves.
_WIDTH = 9.6
_MARGIN = 0.15
_HEADER = 0.62
_CURVES = 1.05
_AXIS = 0.42


class FilmView:
    """Two drawings at any radius, above Betti curves along which a mark moves.

    Parameters
    ----------
    persistence : Persistence
        Of the filtration to be shown.
    radii : (low, high)
        The range of radii that the Betti curves show, without weights both positive.
    titles : (str, str)
        What is written above the two drawings.
    slope : float
        Height of a drawing over its width.
    width : int
        Width of the pictures in pixels; both sizes are even, as some film formats demand.
    """

    def __init__(
        self,
        persistence: Persistence,
        radii: tuple[float, float],
        titles: tuple[str, str],
        slope: float,
        width: int,
    ) -> None:
        self._persistence = persistence
        self._axes, strip = _layout(titles, slope, 2 * round(width / 2))
        self._mark = _betti_strip(strip, persistence, radii)
        self._figure = strip.figure.figure
        self._text = self._figure.text(
            _MARGIN / _WIDTH,
            1 - 0.1 / self._figure.get_figheight(),
            "",
            fontsize=13,
            fontweight="bold",
            color=COLORS["title"],
            va="top",
        )

    @property
    def size(self) -> tuple[int, int]:
        """Width and height of the pictures in pixels."""
        width, height = self._figure.canvas.get_width_height()
        return width, height

    def picture(self, radius: float, along: float = 0.0) -> NDArray[np.uint8]:
        """Return the picture at a finite radius, ``(height, width, 3)`` uint8.

        Parameters
        ----------
        radius : float
        along : float, default 0
            How far the film is, from 0 to 1.
        """
        for ax in self._axes:
            for artist in list(ax.collections):
                artist.remove()
        self._draw(radius, along)
        low, high = self._mark.axes.get_xlim() if self._mark.axes else (0.0, 1.0)
        self._mark.set_xdata([min(max(radius, low), high)] * 2)
        classes = classes_text(self._persistence, radius)
        self._text.set_text(f"r = {_rounded(radius, high)}    {classes}")
        drawn: Any = self._figure.canvas
        drawn.draw()
        return np.asarray(drawn.buffer_rgba())[:, :, :3].copy()

    @abstractmethod
    def _draw(self, radius: float, along: float) -> None:
        """Draw both drawings on empty axes."""


class GrowthView(FilmView):
    """A figure that shows restricted Voronoi cells and alpha complex at any radius.

    Parameters
    ----------
    persistence : Persistence
        Of a filtration in the plane.
    radii : (low, high)
        See :class:`FilmView`.
    width : int, default 960
        Width of the pictures in pixels; their height follows the cloud's proportions.
    """

    def __init__(
        self, persistence: Persistence, radii: tuple[float, float], *, width: int = 960
    ) -> None:
        if not isinstance(persistence.filtration, Filtration):
            raise DimensionError("cells and complex are drawn side by side in the plane alone")
        self._filtration = persistence.filtration
        points = self._filtration.points
        edges = self._filtration.simplices[1]
        self._coloring = cell_coloring(len(points), edges)
        self._reach = farthest(self._filtration, radii[1])
        cells = "Voronoi" if self._filtration.weights is None else "Power"
        titles = f"{cells} cells within r", "Alpha complex at r"
        super().__init__(persistence, radii, titles, _slope(points, self._reach), width)

    def _draw(self, radius: float, along: float) -> None:
        left, right = self._axes
        canvas = Canvas(self._filtration.points, left, reach=self._reach)
        if radius > 0 or self._filtration.weights is not None:
            add_restricted(canvas, restricted_voronoi(self._filtration, radius), self._coloring)
        if canvas.sizes.shows_edges or radius == 0:
            canvas.markers("points", slice(None), 0.6 * canvas.sizes.point)
        shape = AlphaShape(self._filtration, radius)
        add_complex(Canvas(self._filtration.points, right, reach=self._reach), shape)


def farthest(filtration: Filtration | PeriodicFiltration, radius: float) -> float:
    """Return the radius of the largest disc at a radius."""
    if filtration.weights is None:
        return radius
    most = float(filtration.weights.max(initial=0.0)) + radius * abs(radius)
    return float(np.sqrt(max(most, 0.0)))


def _slope(points: NDArray[np.float64], reach: float) -> float:
    """Return the height over the width of axes that hold the cloud."""
    probe = new_figure(1, 1).add_axes((0, 0, 1, 1))
    frame(probe, points, reach)
    across, up = np.ptp(probe.get_xlim()), np.ptp(probe.get_ylim())
    return float(np.clip(up / across, 0.25, 1.4))


def _layout(
    titles: tuple[str, str], slope: float, width: int
) -> tuple[tuple[Axes, Axes], Axes]:
    """Return the axes of the two drawings, and those of the Betti curves below."""
    panel = (_WIDTH - 3 * _MARGIN) / 2
    height = panel * slope
    total = _HEADER + height + _CURVES + _AXIS
    dpi = width / _WIDTH
    total = 2 * round(total * dpi / 2) / dpi
    figure = new_figure(_WIDTH, total)
    figure.set_dpi(dpi)
    axes = []
    for number, title in enumerate(titles):
        x = _MARGIN + number * (panel + _MARGIN)
        bottom = (_AXIS + _CURVES) / total
        ax = figure.add_axes((x / _WIDTH, bottom, panel / _WIDTH, height / total))
        ax.set_axis_off()
        ax.set_title(title, loc="left", fontsize=9, color=COLORS["text"], pad=2)
        axes.append(ax)
    curves = 0.9 * _CURVES / total
    strip = figure.add_axes((0.065, _AXIS / total, 0.925, curves))
    return (axes[0], axes[1]), strip


def _betti_strip(ax: Axes, persistence: Persistence, radii: tuple[float, float]) -> Line2D:
    """Draw the Betti curves small; return the mark that moves along them."""
    chart = Chart(ax, "radius r", "")
    add_betti_curves(chart, persistence, radii)
    ax.xaxis.label.set_fontsize(8)
    ax.xaxis.labelpad = 1
    ax.tick_params(labelsize=7)
    return ax.axvline(radii[0], color=COLORS["radius"], linewidth=1.6)


def _rounded(radius: float, largest: float) -> str:
    """Return a radius with as many decimals as suit the whole range: it stands still."""
    decimals = max(0, 2 - int(np.floor(np.log10(largest)))) if largest > 0 else 2
    if decimals > 6 or largest >= 1e7:
        return f"{radius:.3e}"
    return f"{radius:.{decimals}f}"
