"""Figures: on given axes, without pyplot, so that they run headless and leak nothing.

Every ``plot_*`` function takes ``ax`` (a new figure if None) and returns a
:class:`Drawing` that names the artists it added.
"""

from __future__ import annotations

try:
    import matplotlib as _matplotlib  # noqa: F401
except ImportError as missing:
    from alphamesh.errors import MissingLibraryError

    raise MissingLibraryError.of("matplotlib", "plot", "Drawing a figure") from missing

from alphamesh.plot.complexes import plot_complex, plot_delaunay, plot_filtration
from alphamesh.plot.drawing import Drawing, plot_cloud
from alphamesh.plot.overview import plot_overview
from alphamesh.plot.render import FIGURE_FORMATS, figure_bytes
from alphamesh.plot.style import COLORS

__all__ = [
    "COLORS",
    "FIGURE_FORMATS",
    "Drawing",
    "figure_bytes",
    "plot_cloud",
    "plot_complex",
    "plot_delaunay",
    "plot_filtration",
    "plot_overview",
]
