"""Several panels in one figure: where they stand, their titles and their legend."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Protocol

import numpy as np
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from alphamesh.filtration import Filtration
from alphamesh.filtration3d import Filtration3D
from alphamesh.plot.drawing import new_figure
from alphamesh.plot.style import COLORS

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

    from alphamesh.shape import AlphaShape

__all__ = [
    "HasFiltration",
    "add_legend",
    "add_title",
    "cloud_text",
    "complex_text",
    "counted",
    "filtration_of",
    "panels",
]

# Inches.
_PANEL = 4.3
_TITLE = 0.6
_LEGEND = 0.4
_MARGIN = 0.12
_GAP = 0.25


class HasFiltration(Protocol):
    """What holds a filtration, such as an ``AlphaComplex``."""

    @property
    def filtration(self) -> Filtration:
        """The filtration."""


def filtration_of(source: Filtration | HasFiltration) -> Filtration:
    """Return the filtration that `source` is or holds."""
    return source if isinstance(source, Filtration | Filtration3D) else source.filtration


def panels(
    points: NDArray[np.float64], count: int, columns: int | None = None
) -> tuple[Figure, list[Axes]]:
    """Return a figure with `count` empty panels whose height follows the cloud's proportions.

    Parameters
    ----------
    points : (n, 2) float64
    count : int
    columns : int, optional
        How many stand side by side; by default all.
    """
    columns = count if columns is None else min(columns, count)
    rows = -(-count // columns)
    height = _PANEL * _aspect(points)
    width = columns * _PANEL + (columns - 1) * _GAP + 2 * _MARGIN
    total = width, rows * (height + _TITLE) + _LEGEND
    figure = new_figure(*total)
    axes = []
    for number in range(count):
        row, column = divmod(number, columns)
        x = _MARGIN + column * (_PANEL + _GAP)
        y = _LEGEND + (rows - 1 - row) * (height + _TITLE)
        ax = figure.add_axes((x / total[0], y / total[1], _PANEL / total[0], height / total[1]))
        ax.set_axis_off()
        ax.set_anchor("W")
        axes.append(ax)
    return figure, axes


def _aspect(points: NDArray[np.float64]) -> float:
    """Return height over width of the cloud, kept within what three panels can show."""
    if len(points) == 0:
        return 1.0
    width, height = points.max(axis=0) - points.min(axis=0)
    if width == height:
        return 1.0
    return float(np.clip(height / width if width > 0 else np.inf, 0.3, 1.6))


def add_title(ax: Axes, text: str, detail: str) -> None:
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


def add_legend(figure: Figure, ax: Axes, roles: Iterable[str]) -> None:
    """Name, under the complex on `ax`, the kinds of simplices among `roles`."""
    looks = {
        "triangles": ("triangle", Patch(facecolor=COLORS["triangles"])),
        "boundary_edges": ("boundary edge", _line(COLORS["boundary_edges"])),
        "singular_edges": ("singular edge", _line(COLORS["singular_edges"])),
        "isolated_vertices": ("isolated vertex", _dot(COLORS["isolated_vertices"])),
    }
    drawn = set(roles)
    shown = [look for role, look in looks.items() if role in drawn]
    if not shown:
        return
    box = ax.get_position(original=True)
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


def counted(number: int, singular: str, plural: str | None = None) -> str:
    """Return a number with its noun."""
    name = singular if number == 1 else plural or f"{singular}s"
    return f"{number:,} {name}"


def cloud_text(filtration: Filtration | Filtration3D) -> str:
    """Return how many points there are."""
    points = len(filtration.points)
    hidden = len(filtration.hidden)
    duplicates = points - len(filtration.simplices[0]) - hidden
    text = counted(points, "point")
    text = f"{text}, {counted(duplicates, 'duplicate')}" if duplicates else text
    return f"{text}, {hidden:,} hidden" if hidden else text


def complex_text(shape: AlphaShape) -> str:
    """Return what a complex is made of."""
    parts = [counted(len(shape.triangles), "triangle")]
    if len(shape.singular_edges):
        parts.append(counted(len(shape.singular_edges), "singular edge"))
    if len(shape.isolated_vertices):
        isolated = len(shape.isolated_vertices)
        parts.append(counted(isolated, "isolated vertex", "isolated vertices"))
    return ", ".join(parts)
