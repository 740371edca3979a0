"""One look for all figures: colours told apart by everybody, sizes that follow the cloud."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = [
    "CELL_COLORS",
    "COLORMAP",
    "COLORS",
    "LAYERS",
    "Sizes",
    "frame",
    "on_paper",
    "point_spacing",
    "sizes",
]

Points = NDArray[np.float64]


# By the role of what is drawn; blue against orange is safe for colour-blind readers.
COLORS: Mapping[str, str] = {
    "hull": "#e9eff6",
    "frame_edges": "#c9ced6",
    "cells": "#f3ddb8",
    "union": "#f6dfb6",
    "triangles": "#c6e0f3",
    "skin": "#7fb2dc",
    "flesh": "#f0d9ae",
    "flesh_edges": "#b9975a",
    "films": "#ee9b52",
    "segments": "#ffffff",
    "ridges": "#8a6a3c",
    "arcs": "#8a5a14",
    "hull_edges": "#0b4f8a",
    "edges": "#8793a3",
    "interior_edges": "#86b6da",
    "boundary_edges": "#0b4f8a",
    "points": "#374151",
    "singular_edges": "#d55e00",
    "vertices": "#0b4f8a",
    "isolated_vertices": "#b0127b",
    "frame_points": "#a3abb7",
    "corners": "#0b4f8a",
    "components": "#0b4f8a",
    "holes": "#d55e00",
    "radius": "#b0127b",
    "diagonal": "#c9ced6",
    "title": "#22262b",
    "text": "#6b7280",
}

# What hides what, from back to front.
LAYERS = {role: layer for layer, role in enumerate(COLORS)}

COLORMAP = "viridis"

# Cells that meet get different ones: light, so that what lies on them is seen, and apart
# from one another for colour-blind readers, too.
CELL_COLORS = ("#dfc690", "#99c6f4", "#b4e6c1", "#e9ae9d", "#dbc7e3", "#e1eeb6", "#bcc9c4")

# The most that a picture reaches beyond the cloud, as a share of its longest side.
_FARTHEST = 0.12


@dataclass(frozen=True, slots=True)
class Sizes:
    """Line widths and marker diameters, all in typographic points (1/72 inch)."""

    spacing: float
    point: float
    edge: float
    boundary: float
    singular: float
    isolated: float

    @property
    def shows_edges(self) -> bool:
        """Whether the edges inside a shape can be told apart on paper."""
        return self.spacing > 1.6

    @property
    def shows_vertices(self) -> bool:
        """Whether the vertices of a shape can be told apart from its edges."""
        return self.spacing > 6


def point_spacing(points: Points) -> float:
    """Return the typical distance between neighbouring points.

    The box of the cloud is cut into cells of about four points each; the occupied
    ones measure the area that the points share, so gaps and holes do not count.

    Parameters
    ----------
    points : (n, 2) float64 array

    Returns
    -------
    float
        In the units of the data; infinite for fewer than two distinct points.
    """
    count = len(points)
    if count == 0:
        return float("inf")
    low = points.min(axis=0)
    width, height = (float(side) for side in points.max(axis=0) - low)
    longest = max(width, height)
    if longest == 0:
        return float("inf")
    if min(width, height) < longest / count:
        return longest / count
    cell = 2 * float(np.sqrt(width / count) * np.sqrt(height))
    cells = np.floor((points - low) / cell).astype(np.int64)
    occupied = len(np.unique(cells[:, 0] * (cells[:, 1].max() + 1) + cells[:, 1]))
    return cell * float(np.sqrt(occupied / count))


def sizes(points: Points, ax: Axes) -> Sizes:
    """Return line widths and marker sizes that suit `points` drawn to fill `ax`."""
    spacing = _on_paper(points, ax)

    def between(low: float, share: float, high: float) -> float:
        return float(min(max(share * spacing, low), high))

    return Sizes(
        spacing=spacing,
        point=between(min(0.45, 0.8 * spacing), 0.4, 4.5),
        edge=between(0.09, 0.1, 0.8),
        boundary=between(0.4, 0.17, 1.6),
        singular=between(0.6, 0.2, 1.8),
        isolated=between(2.4, 0.5, 6),
    )


def _on_paper(points: Points, ax: Axes) -> float:
    """Return the typical spacing of `points` in typographic points."""
    spacing = point_spacing(points)
    if spacing == float("inf"):
        return spacing
    box = ax.get_window_extent()
    dpi = ax.figure.figure.dpi  # of the figure around all subfigures
    extent = points.max(axis=0) - points.min(axis=0)
    shares = [
        spacing / side * room
        for side, room in zip(extent, (box.width, box.height), strict=True)
        if side >= spacing or side == extent.max()
    ]
    return float(min(shares)) * 72 / dpi


def on_paper(length: float, ax: Axes) -> float:
    """Return a length, in the units of the data, in typographic points."""
    box = ax.get_window_extent()
    across, up = (abs(np.ptp(limits)) for limits in (ax.get_xlim(), ax.get_ylim()))
    pixels = min(box.width / across, box.height / up)
    return float(length * pixels) * 72 / float(ax.figure.figure.dpi)


def frame(ax: Axes, points: Points, reach: float = 0.0) -> None:
    """Give `ax` equal units on both axes and limits that hold `points` with a margin.

    The margin grows with `reach`, how far discs or cells go beyond the points.
    """
    ax.set_aspect("equal")
    ax.set_xmargin(0)
    ax.set_ymargin(0)
    if len(points) == 0:
        ax.set_xlim(-1, 1)
        ax.set_ylim(-1, 1)
        return
    low, high = points.min(axis=0), points.max(axis=0)
    longest = float((high - low).max())
    if longest == 0:
        longest = max(float(np.abs(high).max()), 1.0)
    pad = 0.025 * longest + min(reach, _FARTHEST * longest)
    # A flat cloud still gets a box that has an inside.
    thin = np.maximum(0.05 * longest - (high - low), 0) / 2
    low, high = low - pad - thin, high + pad + thin
    ax.set_xlim(low[0], high[0])
    ax.set_ylim(low[1], high[1])
