"""Two more composed views: what goes around a cloud, and the same cloud at several radii."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from alphamesh._weights import has_weights, refuse_weights
from alphamesh.betti import checked_radii
from alphamesh.errors import ParameterError
from alphamesh.frame import framed_delaunay
from alphamesh.hull import convex_hull
from alphamesh.persistence import persistence
from alphamesh.plot.cells import cell_coloring, plot_restricted_voronoi
from alphamesh.plot.complexes import plot_complex, plot_delaunay
from alphamesh.plot.outlines import plot_frame, plot_hull
from alphamesh.plot.overview import delaunay_text
from alphamesh.plot.panels import add_legend, add_title, counted, filtration_of, panels
from alphamesh.plot.topology import betti_text
from alphamesh.points import Cloud
from alphamesh.radius import choose_radius
from alphamesh.restricted import restricted_voronoi
from alphamesh.shape import AlphaShape

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from alphamesh.filtration import Filtration
    from alphamesh.frame import FramedDelaunay
    from alphamesh.plot.panels import HasFiltration

__all__ = ["plot_outlines", "plot_radii", "three_radii"]


def plot_outlines(
    source: Filtration | HasFiltration, framed: FramedDelaunay | None = None
) -> Figure:
    """Draw a cloud's convex hull, its Delaunay triangulation, and what a frame leaves of it.

    Parameters
    ----------
    source : Filtration or AlphaComplex
    framed : FramedDelaunay, optional
        By default that of a box.

    Returns
    -------
    matplotlib.figure.Figure
        A new figure with three axes.

    Raises
    ------
    UnweightedOnlyError
        If the points have weights.
    """
    filtration = filtration_of(source)
    refuse_weights(
        filtration.weights, "outlines within a frame", "use plot_hull and plot_delaunay"
    )
    if framed is None:
        framed = framed_delaunay(Cloud(filtration.points))
    hull = convex_hull(filtration.points)
    figure, (left, middle, right) = panels(filtration.points, 3)
    plot_hull(hull, left)
    add_title(left, "Convex hull", counted(len(hull.ring), "corner"))
    plot_delaunay(filtration, middle)
    add_title(middle, "Delaunay triangulation", delaunay_text(filtration))
    plot_frame(framed, right)
    dropped = len(filtration.simplices[2]) - len(framed.triangles)
    add_title(right, "Within a frame", f"{counted(dropped, 'triangle')} fewer")
    for ax in (left, middle):
        ax.set_xlim(*right.get_xlim())
        ax.set_ylim(*right.get_ylim())
    return figure


def plot_radii(
    source: Filtration | HasFiltration, radii: Sequence[float] | None = None
) -> Figure:
    """Draw cells within discs, and below them the complex, at several radii.

    Parameters
    ----------
    source : Filtration or AlphaComplex
    radii : sequence of float, optional
        At most six, finite, in the units of the points; by default three: one too small,
        the one that the default rule chooses, and one too large.

    Returns
    -------
    matplotlib.figure.Figure
        A new figure with two axes for each radius.

    Raises
    ------
    ParameterError
        If `radii` is empty, too long, or holds what is no finite radius.
    """
    filtration = filtration_of(source)
    signed = filtration.weights is not None
    shown = three_radii(filtration)
    if radii is not None:
        shown = checked_radii(radii, signed=signed).tolist()
    if not 1 <= np.size(shown) <= 6 or not np.isfinite(shown).all():
        raise ParameterError(f"radii must be one to six finite numbers; got {radii!r}")
    pairs = persistence(filtration)
    coloring = cell_coloring(len(filtration.points), filtration.simplices[1])
    figure, axes = panels(filtration.points, 2 * len(shown), len(shown))
    widest = axes[len(shown) - 1]
    drawn: set[str] = set()
    for above, below, radius in zip(axes, axes[len(shown) :], shown, strict=False):
        plot_restricted_voronoi(
            restricted_voronoi(filtration, radius), above, coloring=coloring
        )
        b0, b1 = pairs.betti_numbers(radius).tolist()
        add_title(above, f"Radius {radius:.4g}", betti_text(b0, b1))
        drawing = plot_complex(AlphaShape(filtration, radius), below)
        drawn |= set(drawing.artists)
    for ax in axes:
        ax.set_xlim(*widest.get_xlim())
        ax.set_ylim(*widest.get_ylim())
    add_legend(figure, axes[len(shown)], drawn)
    return figure


def three_radii(filtration: Filtration) -> list[float]:
    """Return three radii to show: too small, chosen, and too large for the holes."""
    if len(filtration.points) == 0:
        return [0.0]
    chosen = choose_radius(filtration).radius
    if chosen == 0 and not has_weights(filtration.weights):
        return [0.0]
    holes = persistence(filtration).diagram(1)
    # Beyond the death of the hole that lasts longest, nothing is left of the shape.
    lengths = holes[:, 1] - holes[:, 0]
    filled = float(holes[np.argmax(lengths), 1]) if len(holes) else 0.0
    if has_weights(filtration.weights):
        first = float(filtration.radii[0].min())
        late = max(1.02 * filled, chosen + (chosen - first) / 2)
        return [first + 2 * (chosen - first) / 3, chosen, late]
    return [chosen / 3, chosen, max(1.02 * filled, 2 * chosen)]
