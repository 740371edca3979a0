"""The first picture: cloud, Delaunay triangulation and alpha complex side by side."""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

import numpy as np
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from alphamesh.filtration import Filtration
from alphamesh.plot.complexes import plot_complex, plot_delaunay
from alphamesh.plot.drawing import Drawing, new_figure, plot_cloud
from alphamesh.plot.style import COLORS
from alphamesh.radius import choose_radius
from alphamesh.shape import AlphaShape

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

__all__ = ["plot_overview"]

# Inches.
_PANEL = 4.3
_TITLE = 0.6
_LEGEND = 0.4
_MARGIN = 0.12
_GAP = 0.25


class _HasFiltration(Protocol):
    """What holds a filtration, such as an ``AlphaComplex``."""

    @property
    def filtration(self) -> Filtration:
        """The filtration."""


def plot_overview(source: Filtration | _HasFiltration, radius: float | None = None) -> Figure:
    """Draw a cloud, its Delaunay triangulation and its alpha complex side by side.

    Parameters
    ----------
    source : Filtration or AlphaComplex
    radius : float, optional
        Radius of the complex shown, in the units of the points; chosen by the
        default rule if None.

    Returns
    -------
    matplotlib.figure.Figure
        A new figure with three axes, whose height follows the cloud's proportions.
    """
    filtration = source if isinstance(source, Filtration) else source.filtration
    if radius is None:
        radius = choose_radius(filtration).radius
    shape = AlphaShape(filtration, radius)
    figure, (left, middle, right) = _panels(_aspect(filtration.points))
    plot_cloud(filtration.points, left)
    _title(left, "Cloud", _cloud_text(filtration))
    plot_delaunay(filtration, middle)
    _title(middle, "Delaunay triangulation", _delaunay_text(filtration))
    drawing = plot_complex(shape, right)
    _title(right, f"Alpha complex, radius {radius:.4g}", _complex_text(shape))
    _legend(figure, drawing)
    return figure


def _aspect(points: NDArray[np.float64]) -> float:
    """Return height over width of the cloud, kept within what three panels can show."""
    if len(points) == 0:
        return 1.0
    width, height = points.max(axis=0) - points.min(axis=0)
    if width == height:
        return 1.0
    return float(np.clip(height / width if width > 0 else np.inf, 0.3, 1.6))


def _panels(aspect: float) -> tuple[Figure, list[Axes]]:
    """Return a figure with three empty panels of the given height over width."""
    height = _PANEL * aspect
    total = 3 * _PANEL + 2 * _GAP + 2 * _MARGIN, height + _TITLE + _LEGEND
    figure = new_figure(*total)
    axes = []
    for number in range(3):
        x = _MARGIN + number * (_PANEL + _GAP)
        ax = figure.add_axes(
            (x / total[0], _LEGEND / total[1], _PANEL / total[0], height / total[1])
        )
        ax.set_axis_off()
        ax.set_anchor("W")
        axes.append(ax)
    return figure, axes


def _title(ax: Axes, text: str, detail: str) -> None:
    """Put a title over `ax` and, quieter, the counts below it."""
    ax.set_title(
        text, loc="left", x=0.04, pad=19, fontsize=11, fontweight="bold", color=COLORS["title"]
    )
    ax.annotate(
        detail,
        xy=(0.04, 1),
        xycoords="axes fraction",
        xytext=(0, 7),
        textcoords="offset points",
        fontsize=9,
        color=COLORS["text"],
    )


def _legend(figure: Figure, drawing: Drawing) -> None:
    """Name, under the complex, the kinds of simplices that it holds."""
    looks = {
        "triangles": ("triangle", Patch(facecolor=COLORS["triangles"])),
        "boundary_edges": ("boundary edge", _line(COLORS["boundary_edges"])),
        "singular_edges": ("singular edge", _line(COLORS["singular_edges"])),
        "isolated_vertices": ("isolated vertex", _dot(COLORS["isolated_vertices"])),
    }
    shown = [looks[role] for role in looks if role in drawing.artists]
    if not shown:
        return
    box = drawing.axes.get_position(original=True)
    figure.legend(
        handles=[handle for _, handle in shown],
        labels=[label for label, _ in shown],
        loc="lower left",
        bbox_to_anchor=(box.x0 + 0.01 * box.width, 0.0),
        ncols=len(shown),
        frameon=False,
        fontsize=8,
        labelcolor=COLORS["text"],
        handlelength=1.2,
        handletextpad=0.4,
        columnspacing=1.1,
    )


def _line(color: str) -> Artist:
    return Line2D([], [], color=color, linewidth=1.8)


def _dot(color: str) -> Artist:
    return Line2D([], [], color=color, marker="o", markersize=5, linestyle="none")


def _count(number: int, singular: str, plural: str | None = None) -> str:
    name = singular if number == 1 else plural or f"{singular}s"
    return f"{number:,} {name}"


def _cloud_text(filtration: Filtration) -> str:
    points = len(filtration.points)
    duplicates = points - len(filtration.simplices[0])
    text = _count(points, "point")
    return f"{text}, {_count(duplicates, 'duplicate')}" if duplicates else text


def _delaunay_text(filtration: Filtration) -> str:
    _, edges, triangles = filtration.simplices
    return f"{_count(len(triangles), 'triangle')}, {_count(len(edges), 'edge')}"


def _complex_text(shape: AlphaShape) -> str:
    parts = [_count(len(shape.triangles), "triangle")]
    if len(shape.singular_edges):
        parts.append(_count(len(shape.singular_edges), "singular edge"))
    if len(shape.isolated_vertices):
        isolated = len(shape.isolated_vertices)
        parts.append(_count(isolated, "isolated vertex", "isolated vertices"))
    return ", ".join(parts)
