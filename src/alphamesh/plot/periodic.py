"""Periodic boxes: the complex runs on beyond the border, paler where it repeats."""

from __future__ import annotations

import itertools
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.patches import Rectangle

from alphamesh.errors import DimensionError, ParameterError
from alphamesh.plot.drawing import Canvas, Drawing
from alphamesh.plot.paths import line_paths, triangle_paths
from alphamesh.plot.style import COLORS, LAYERS, sizes

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from numpy.typing import NDArray

    from alphamesh.periodic import PeriodicFiltration, PeriodicShape

__all__ = ["Copies", "add_box", "add_simplices", "box_window", "plot_periodic"]

_VEIL = 0.62
_BOX_WIDTH = 1.1


def plot_periodic(
    shape: PeriodicShape, ax: Axes | None = None, *, margin: float = 0.15
) -> Drawing:
    """Draw a complex in a periodic box, and what repeats around it.

    Parameters
    ----------
    shape : PeriodicShape
        Of points in the plane.
    ax : matplotlib.axes.Axes, optional
        Axes to draw on; new ones in a new figure if None.
    margin : float, default 0.15
        How much is shown beyond the box, as a share of its period, from 0 to 1.

    Returns
    -------
    Drawing
        With the artists ``"triangles"``, ``"interior_edges"``, ``"vertices"`` (left out
        where too small to see), ``"boundary_edges"``, ``"singular_edges"`` and
        ``"isolated_vertices"``.

    Raises
    ------
    DimensionError
        If the points lie in space.
    ParameterError
        If `margin` is not within 0 to 1.
    """
    if shape.points.shape[1] != 2:
        raise DimensionError(
            "these points lie in space; draw them with alphamesh.plot.plot_periodic_in_space"
        )
    if not 0 <= margin <= 1:
        raise ParameterError(f"margin must be a share of the period, 0 to 1; got {margin!r}")
    filtration = shape.filtration
    window = box_window(filtration, margin)
    canvas = Canvas(window, ax)
    copies = Copies(filtration, window)
    canvas.sizes = sizes(copies.of(0, np.arange(len(filtration.simplices[0])))[:, 0], canvas.ax)
    add_simplices(canvas, shape, copies)
    add_box(canvas, filtration)
    return canvas.drawing()


class Copies:
    """Copies of simplices that are seen in a window."""

    def __init__(self, filtration: PeriodicFiltration, window: NDArray[np.float64]) -> None:
        self.filtration = filtration
        self.window = window
        steps = [(0,) if side is None else (-1, 0, 1) for side in self.filtration.periods]
        self.moves = np.array(list(itertools.product(*steps))) * self.filtration.lattice

    def of(self, dimension: int, numbers: NDArray[np.integer]) -> NDArray[np.float64]:
        """Return the corners of all copies that the window meets, ``(m, k + 1, 2)``."""
        corners = self.filtration.corners(dimension, numbers)
        parts = []
        for move in self.moves:
            moved = corners + move
            meets = (moved.max(axis=1) >= self.window[0]) & (
                moved.min(axis=1) <= self.window[1]
            )
            parts.append(moved[meets.all(axis=1)])
        return np.concatenate(parts)


def box_window(filtration: PeriodicFiltration, margin: float) -> NDArray[np.float64]:
    """Return the corners of the box, larger by a share of its periods, ``(2, 2)``.

    Where it is open, those of the points.
    """
    periodic, positions = filtration.periodic, filtration.positions
    low, high = np.zeros(2), np.where(periodic, filtration.lattice, 1.0)
    if len(positions):
        low = np.where(periodic, 0.0, positions.min(axis=0))
        high = np.where(periodic, filtration.lattice, positions.max(axis=0))
    beyond = margin * filtration.lattice
    return np.array([low - beyond, high + beyond])


def add_simplices(canvas: Canvas, shape: PeriodicShape, copies: Copies) -> None:
    """Add all copies of simplices that are seen."""
    numbers = shape.numbers(2)
    corners = copies.of(2, numbers)
    arms = corners[:, 1:] - corners[:, :1]
    clockwise = arms[:, 0, 0] * arms[:, 1, 1] < arms[:, 0, 1] * arms[:, 1, 0]
    corners[clockwise] = corners[clockwise, ::-1]
    rows = np.arange(3 * len(corners)).reshape(-1, 3)
    paths = triangle_paths(corners.reshape(-1, 2), rows)
    canvas.fill("triangles", paths, of=len(corners))
    used = np.bincount(
        shape.filtration.triangle_edges[numbers].ravel(),
        minlength=len(shape.filtration.radii[1]),
    )
    edges, size = shape.numbers(1), canvas.sizes
    roles = {
        "interior_edges": (edges[used[edges] == 2], size.edge),
        "boundary_edges": (edges[used[edges] == 1], size.boundary),
        "singular_edges": (edges[used[edges] == 0], size.singular),
    }
    for role, (chosen, width) in roles.items():
        ends = copies.of(1, chosen)
        if role != "interior_edges" or size.shows_edges:
            canvas.strokes(role, line_paths(ends), width, of=len(ends))
    alone = np.isin(shape.vertices[:, 0], shape.isolated_vertices)
    for role, chosen, diameter in (
        ("vertices", shape.numbers(0)[~alone], 0.7 * size.point),
        ("isolated_vertices", shape.numbers(0)[alone], size.isolated),
    ):
        if role == "isolated_vertices" or size.shows_vertices:
            places = copies.of(0, chosen).reshape(-1, 2)
            canvas.points = places
            canvas.markers(role, slice(None), diameter)


def add_box(canvas: Canvas, filtration: PeriodicFiltration) -> None:
    """Draw a veil over what lies beyond the box, and its frame."""
    axes = canvas.ax
    low, high = box_window(filtration, 0.0)
    left, right = axes.get_xlim()
    bottom, top = axes.get_ylim()
    periodic = filtration.periodic
    if not periodic[0]:
        low, high = np.array([left, low[1]]), np.array([right, high[1]])
    if not periodic[1]:
        low, high = np.array([low[0], bottom]), np.array([high[0], top])
    for x, y, width, height in (
        (left, bottom, low[0] - left, top - bottom),
        (high[0], bottom, right - high[0], top - bottom),
        (low[0], bottom, high[0] - low[0], low[1] - bottom),
        (low[0], high[1], high[0] - low[0], top - high[1]),
    ):
        veil = Rectangle((x, y), width, height, color="white", alpha=_VEIL, linewidth=0)
        veil.set_zorder(len(LAYERS))
        axes.add_patch(veil)
    lines = {0: axes.axvline, 1: axes.axhline}
    for axis, draw in lines.items():
        if periodic[axis]:
            for place in (low[axis], high[axis]):
                draw(place, color=COLORS["title"], linewidth=_BOX_WIDTH, zorder=len(LAYERS) + 1)
