"""Persistence and Betti numbers as charts."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.collections import LineCollection
from numpy.typing import NDArray

from alphamesh.errors import ParameterError
from alphamesh.plot.chart import Chart
from alphamesh.plot.style import COLORS

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.axes import Axes

    from alphamesh.persistence import Persistence
    from alphamesh.plot.drawing import Drawing

__all__ = [
    "add_betti_curves",
    "betti_range",
    "betti_text",
    "classes_text",
    "plot_barcode",
    "plot_betti",
    "plot_diagram",
]

# What classes are called, by dimension: loops are holes where they lie in the plane.
_ROLES = {2: ("components", "holes"), 3: ("components", "loops", "voids")}
# In a periodic box, what runs around it is no hole.
_PERIODIC_ROLES = {2: ("components", "loops"), 3: _ROLES[3]}
_SINGULAR = {"components": "component", "holes": "hole", "loops": "loop", "voids": "void"}

# Finer than the pixels of any chart: marks and steps closer than this are one.
_CELLS = 1500


def _roles(persistence: Persistence) -> tuple[str, ...]:
    """Return what classes are called; that of a whole periodic box, the last, is not drawn."""
    columns = persistence.filtration.points.shape[1]
    periodic = getattr(persistence.filtration, "periods", None) is not None
    return (_PERIODIC_ROLES if periodic else _ROLES)[columns]


def plot_diagram(
    persistence: Persistence, ax: Axes | None = None, *, radius: float | None = None
) -> Drawing:
    """Draw a persistence diagram: death against birth, one mark for each class.

    Parameters
    ----------
    persistence : Persistence
    ax : matplotlib.axes.Axes, optional
        Axes to draw on; new ones in a new figure if None.
    radius : float, optional
        A chosen radius to mark: the classes above and to the left of the corner are those
        that are there at that radius.

    Returns
    -------
    Drawing
        With the artists ``"components"``, ``"holes"``, ``"diagonal"`` and ``"radius"``; in
        space with ``"loops"`` and ``"voids"`` for holes.
        Of marks that lie on one another, one is drawn. Classes that never die stand on a
        line above the others.
    """
    chart = Chart(ax, "birth radius", "death radius")
    diagrams = persistence.diagrams()
    low, top = _ends(diagrams, radius)
    span = top - low
    chart.line("diagonal", [low, top], [low, top], 0.8)
    above = top + 0.06 * span
    if any(np.isinf(rows[:, 1]).any() for rows in diagrams):
        chart.line("diagonal", [low, top], [above, above], 0.8, style=(0, (4, 3)))
        chart.note("never ends", (top, above), (0, 4), "right")
    for role, rows in zip(_roles(persistence), diagrams, strict=False):
        marks = np.where(np.isinf(rows), above, rows)
        chart.marks(role, _apart(marks, low, top), 3.4)
    if radius is not None:
        chart.line("radius", [low, radius, radius], [radius, radius, above], 1.2)
        chart.note(f"r = {radius:.4g}", (radius, radius), (6, -4), "left", "radius")
    below = low - 0.03 * span
    chart.limits((below, top + 0.03 * span), (below, top + 0.13 * span))
    chart.ax.set_aspect("equal")
    chart.legend(_SINGULAR, "lower right")
    return chart.drawing()


def plot_barcode(
    persistence: Persistence,
    ax: Axes | None = None,
    *,
    radius: float | None = None,
    most: int = 40,
) -> Drawing:
    """Draw a barcode: one bar for each class, from birth to death.

    Parameters
    ----------
    persistence : Persistence
    ax : matplotlib.axes.Axes, optional
        Axes to draw on; new ones in a new figure if None.
    radius : float, optional
        A chosen radius to mark: the bars that it crosses are the classes that are there.
    most : int, default 40
        How many bars of each dimension to draw: those that last longest. How many are
        left out stands beside them.

    Returns
    -------
    Drawing
        With the artists ``"components"``, ``"holes"`` and ``"radius"``; in space with
        ``"loops"`` and ``"voids"`` for holes.

    Raises
    ------
    ParameterError
        If `most` is not a positive whole number.
    """
    given: Any = most
    if not isinstance(given, int | np.integer) or given < 1:
        raise ParameterError(f"most must be a whole number of at least 1; got {most!r}")
    chart = Chart(ax, "radius", "")
    diagrams = persistence.diagrams()
    low, top = _ends(diagrams, radius)
    top += 0.08 * (top - low)
    level = 0
    for role, rows in zip(_roles(persistence), diagrams, strict=False):
        order = np.argsort(rows[:, 0] - rows[:, 1], kind="stable")
        bars = rows[order[:most]]
        _add_bars(chart, role, np.minimum(bars, top), -level - np.arange(len(bars)))
        level += len(bars)
        if len(rows) > len(bars):
            text = f"and {len(rows) - len(bars):,} shorter {role}"
            chart.note(text, (top, -level), (0, 0), "right")
            level += 1
        level += 2
    if radius is not None:
        chart.line("radius", [radius, radius], [2, 1 - level], 1.2)
        chart.note(f"r = {radius:.4g}", (radius, 2), (4, -2), "left", "radius")
    chart.limits((low, top), (1 - level, 4))
    chart.ax.set_yticks([])
    chart.ax.spines["left"].set_visible(False)
    # Beside short bars: holes often come late, and voids later still.
    corner, above = ("lower right", 0.06) if len(diagrams) == 2 else ("upper right", -0.06)
    chart.legend(_SINGULAR, corner, above=above)
    return chart.drawing()


def _add_bars(
    chart: Chart, role: str, bars: NDArray[np.float64], levels: NDArray[np.integer]
) -> None:
    heights = np.repeat(levels[:, np.newaxis], 2, axis=1)
    lines = LineCollection(
        list(np.stack((bars, heights), axis=2)),
        colors=COLORS[role],
        linewidths=1.6 if len(bars) <= 60 else 0.8,
        capstyle="butt",
    )
    if len(bars):
        chart.add(role, lines)


def plot_betti(
    persistence: Persistence,
    ax: Axes | None = None,
    *,
    radius: float | None = None,
) -> Drawing:
    """Draw the number of components, holes or loops, and voids against the radius.

    Parameters
    ----------
    persistence : Persistence
    ax : matplotlib.axes.Axes, optional
        Axes to draw on; new ones in a new figure if None.
    radius : float, optional
        A chosen radius to mark, with its Betti numbers.

    Returns
    -------
    Drawing
        With the artists ``"components"``, ``"holes"`` and ``"radius"``; in space with
        ``"loops"`` and ``"voids"`` for holes. Both axes are logarithmic, as most changes
        come at small radii, but that of radii that may be negative, with weights. Steps
        closer than a pixel are drawn as one.
    """
    chart = Chart(ax, "radius", "how many")
    shown = betti_range(persistence)
    top = add_betti_curves(chart, persistence, shown)
    if radius is not None:
        _mark(chart, persistence, radius, shown, top)
    return chart.drawing()


def add_betti_curves(
    chart: Chart, persistence: Persistence, shown: tuple[float, float]
) -> float:
    """Draw Betti curves from radius to radius on logarithmic axes; return the upper end."""
    low, high = shown
    radii, numbers = persistence.betti_curve()
    linear = persistence.filtration.weights is not None
    if not linear:
        chart.ax.set_xscale("log")
    # Linear up to 1, so that none and one have a place of their own.
    chart.ax.set_yscale("symlog", linthresh=1, linscale=0.5)
    roles = _roles(persistence)
    for column, role in enumerate(roles):
        x, y = _steps(radii, numbers[:, column], low, linear=linear)
        (line,) = chart.ax.step(
            np.append(x, max(high, x[-1])),
            np.append(y, y[-1]),
            where="post",
            color=COLORS[role],
            linewidth=1.6,
        )
        chart.keep(role, line)
    # Room above the curves for what is written there.
    top: float = 1.3 * max(int(numbers.max(initial=0)), 1) ** 1.35 + 2
    chart.limits((low, high), (-0.15, top))
    chart.ax.yaxis.set_major_formatter(lambda value, _: f"{value:,.0f}")
    chart.ax.xaxis.set_major_formatter(lambda value, _: f"{value:g}")
    chart.legend({role: role for role in roles}, "upper left", columns=len(roles))
    return top


def _mark(
    chart: Chart,
    persistence: Persistence,
    radius: float,
    shown: tuple[float, float],
    top: float,
) -> None:
    """Mark a radius among Betti curves, and write down what it gives."""
    low, high = shown
    marked = min(max(radius, low), high)
    chart.line("radius", [marked, marked], [0, top], 1.2)
    linear = persistence.filtration.weights is not None
    left = 2 * marked < low + high if linear else marked * marked < low * high
    text = f"r = {radius:.4g}: {classes_text(persistence, radius)}"
    offset, align = ((4, -26), "left") if left else ((-4, -26), "right")
    chart.note(text, (marked, top), offset, align, "radius")


def classes_text(persistence: Persistence, radius: float) -> str:
    """Return how many classes there are at a radius, in words."""
    roles = _roles(persistence)
    return _counts_text(persistence.betti_numbers(radius).tolist(), roles)


def betti_text(*numbers: int) -> str:
    """Return Betti numbers, b0 and b1 in the plane or b0, b1 and b2 in space, in words."""
    return _counts_text(numbers, _ROLES[len(numbers)])


def _counts_text(numbers: Sequence[int], roles: tuple[str, ...]) -> str:
    named = zip(numbers, roles, strict=False)
    return ", ".join(
        f"{number:,} {_SINGULAR[name] if number == 1 else name}" for number, name in named
    )


def betti_range(persistence: Persistence) -> tuple[float, float]:
    """Return from where to where Betti numbers are worth a look: without weights, positive."""
    radii = persistence.betti_curve().radii
    if persistence.filtration.weights is not None:
        around = 0.05 * float(np.ptp(radii)) or 1.0
        return float(radii[0]) - around, float(radii[-1]) + around
    radii = radii[1:]
    positive = radii[radii > 0]
    if len(positive) == 0:
        return 0.1, 10.0
    low = float(np.quantile(positive, 0.01)) / 1.5
    return low, max(1.3 * float(positive[-1]), 2 * low)


def _ends(
    diagrams: tuple[NDArray[np.float64], ...], radius: float | None
) -> tuple[float, float]:
    """Return the range of radii that a chart must show: from 0 on, unless some are negative."""
    finite = [rows[np.isfinite(rows)] for rows in diagrams]
    low = float(min(*(rows.min(initial=0.0) for rows in finite), radius or 0.0))
    top = float(max(*(rows.max(initial=0.0) for rows in finite), radius or 0.0))
    if low == 0:
        return 0.0, 1.05 * top or 1.0
    return low, top + 0.05 * (top - low)


def _apart(marks: NDArray[np.float64], low: float, top: float) -> NDArray[np.float64]:
    """Return one of the marks for each place that the eye can tell apart."""
    places = np.floor((marks - low) / (top - low) * _CELLS).astype(np.int64)
    _, kept = np.unique(places[:, 0] * (2 * _CELLS) + places[:, 1], return_index=True)
    return marks.take(np.sort(kept), axis=0)


def _steps(
    radii: NDArray[np.float64], numbers: NDArray[np.integer], low: float, *, linear: bool
) -> tuple[NDArray[np.float64], NDArray[np.integer]]:
    """Return the steps from `low` on, thinned to the first and last in each pixel."""
    start = max(int(np.searchsorted(radii, low, side="right")) - 1, 0)
    x, y = np.maximum(radii[start:], low), numbers[start:]
    if radii[0] > low:  # with weights, nothing is there at first
        x, y = np.append(low, x), np.append(0, y)
    if len(x) > 2 * _CELLS:
        along = x - low if linear else np.log(x / low)
        place = (along * (_CELLS / along[-1])).astype(np.int64)
        new = np.append(True, np.diff(place) > 0)
        kept = new | np.append(new[1:], True)
        x, y = x[kept], y[kept]
    return x, y
