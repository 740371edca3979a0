"""Axes of a chart: quiet spines, labelled ticks, the colours of the figures."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.lines import Line2D
from numpy.typing import NDArray

from alphamesh.plot.drawing import Drawing, new_figure
from alphamesh.plot.style import COLORS

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes
    from matplotlib.collections import Collection

__all__ = ["Chart"]

# Beyond this many marks a vector file becomes slow to open: pixels instead.
_RASTER_FROM = 20_000


class Chart:
    """Axes for a chart, and the artists so far.

    Parameters
    ----------
    ax : matplotlib.axes.Axes, optional
        New ones in a new figure if None.
    x, y : str
        What the axes show.
    """

    def __init__(self, ax: Axes | None, x: str, y: str) -> None:
        self._owned = ax is None
        if ax is None:
            ax = new_figure(6, 4.2).add_axes((0.12, 0.13, 0.85, 0.84))
        self.ax = ax
        self._artists: dict[str, list[Artist]] = {}
        for side in ("top", "right"):
            ax.spines[side].set_visible(False)
        for side in ("left", "bottom"):
            ax.spines[side].set_color(COLORS["diagonal"])
        ax.tick_params(which="both", labelsize=8, labelcolor=COLORS["text"], length=0)
        ax.set_xlabel(x, fontsize=9, color=COLORS["text"])
        ax.set_ylabel(y, fontsize=9, color=COLORS["text"])

    def drawing(self) -> Drawing:
        """Return what has been drawn."""
        return Drawing(self.ax, self._artists, self._owned)

    def keep(self, role: str, artist: Artist) -> None:
        """Name an artist that is on the axes."""
        self._artists.setdefault(role, []).append(artist)

    def add(self, role: str, artist: Collection) -> None:
        """Put a collection on the axes."""
        self.ax.add_collection(artist, autolim=False)
        self.keep(role, artist)

    def line(
        self, role: str, x: Sequence[float], y: Sequence[float], width: float, style: Any = "-"
    ) -> None:
        """Draw a line of `width` (1/72 inch)."""
        line = Line2D(x, y, color=COLORS[role], linewidth=width, linestyle=style, zorder=1.5)
        self.ax.add_line(line)
        self.keep(role, line)

    def marks(self, role: str, places: NDArray[np.float64], diameter: float) -> None:
        """Draw dots of `diameter` (1/72 inch); nothing for no rows."""
        if len(places) == 0:
            return
        dots = self.ax.scatter(
            places[:, 0],
            places[:, 1],
            s=diameter**2,
            c=COLORS[role],
            linewidths=0,
            alpha=0.75,
            zorder=2,
            rasterized=len(places) > _RASTER_FROM,
        )
        self.keep(role, dots)

    def note(
        self,
        text: str,
        place: tuple[float, float],
        offset: tuple[float, float],
        align: str,
        color: str = "text",
    ) -> None:
        """Write beside a place, `offset` (1/72 inch) away from it."""
        self.ax.annotate(
            text,
            xy=place,
            xytext=offset,
            textcoords="offset points",
            ha=align,
            va="baseline",
            fontsize=8,
            color=COLORS[color],
        )

    def limits(self, x: tuple[float, float], y: tuple[float, float]) -> None:
        """Show this range of both axes."""
        self.ax.set_xlim(*x)
        self.ax.set_ylim(*y)

    def legend(
        self, names: Mapping[str, str], place: Any, *, columns: int = 1, above: float = 0.0
    ) -> None:
        """Name the kinds of classes that are drawn, in a corner or a share `above` it."""
        shown = [role for role in names if role in self._artists]
        if not shown:
            return
        self.ax.legend(
            handles=[
                Line2D([], [], color=COLORS[role], marker="o", markersize=5, linestyle="none")
                for role in shown
            ],
            labels=[names[role] for role in shown],
            loc=place,
            bbox_to_anchor=(0, above, 1, 1),
            frameon=False,
            fontsize=8,
            labelcolor=COLORS["text"],
            handletextpad=0.2,
            ncols=columns,
            columnspacing=1.2,
        )
