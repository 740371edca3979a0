"""The holes of persistence on the mesh: a ring around each, as it is born."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from alphamesh.errors import DimensionError, ParameterError
from alphamesh.filtration import Filtration
from alphamesh.plot.complexes import add_complex
from alphamesh.plot.drawing import Canvas
from alphamesh.shape import AlphaShape

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from alphamesh.persistence import Persistence
    from alphamesh.plot.drawing import Drawing

__all__ = ["plot_cycles"]


def plot_cycles(
    persistence: Persistence, radius: float, ax: Axes | None = None, *, most: int = 20
) -> Drawing:
    """Draw the complex at a radius, and around each of its holes the ring that began it.

    A ring is that of ``persistence.holes``: of edges that are there when the hole is born,
    at a radius of its own. It is therefore wider than the hole is at `radius`.

    Parameters
    ----------
    persistence : Persistence
        Of a cloud in the plane.
    radius : float
        In the units of the points.
    ax : matplotlib.axes.Axes, optional
        Axes to draw on; new ones in a new figure if None.
    most : int, default 20
        How many holes get rings: those that die last.

    Returns
    -------
    Drawing
        With the artists of :func:`plot_complex` and ``"cycles"``.

    Raises
    ------
    ParameterError
        If `radius` is negative or no number, or `most` is no positive whole number.
    DimensionError
        If the cloud lies in space.
    """
    filtration = persistence.filtration
    if not isinstance(filtration, Filtration):
        raise DimensionError("rings around holes are drawn in the plane alone")
    given: Any = most
    if not isinstance(given, int | np.integer) or given < 1:
        raise ParameterError(f"most must be a whole number of at least 1; got {most!r}")
    shape = AlphaShape(filtration, radius)
    canvas = Canvas(filtration.points, ax)
    add_complex(canvas, shape)
    rings = persistence.holes(persistence.alive(shape.radius)[:most])
    for ring in rings:
        steps = np.column_stack((ring, np.roll(ring, -1)))
        canvas.segments("cycles", steps, 2.5 * canvas.sizes.boundary)
    return canvas.drawing()
