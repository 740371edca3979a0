"""Figures: on given axes, without pyplot, so that they run headless and leak nothing.

Every ``plot_*`` function takes ``ax`` (a new figure if None) and returns a
:class:`Drawing` that names the artists it added. Composed views (``plot_overview``,
``plot_story``, ``plot_outlines``, ``plot_radii``) return a new figure.
"""

from __future__ import annotations

try:
    import matplotlib as _matplotlib  # noqa: F401
except ImportError as missing:
    from alphamesh.errors import MissingLibraryError

    raise MissingLibraryError.of("matplotlib", "plot", "Drawing a figure") from missing

from alphamesh.plot.balls import plot_balls
from alphamesh.plot.cells import (
    cell_coloring,
    plot_restricted_voronoi,
    plot_union,
    plot_voronoi,
)
from alphamesh.plot.complexes import plot_complex, plot_delaunay, plot_filtration
from alphamesh.plot.cycles import plot_cycles
from alphamesh.plot.drawing import Drawing, plot_cloud
from alphamesh.plot.growth import GrowthView
from alphamesh.plot.growth3d import GrowthView3D
from alphamesh.plot.growth_box import GrowthViewBox, GrowthViewBox3D
from alphamesh.plot.outlines import plot_frame, plot_hull
from alphamesh.plot.overview import plot_overview
from alphamesh.plot.overview3d import plot_cloud_in_space
from alphamesh.plot.periodic import plot_periodic
from alphamesh.plot.periodic3d import plot_periodic_in_space
from alphamesh.plot.render import FIGURE_FORMATS, figure_bytes
from alphamesh.plot.solids import plot_solid, plot_surface
from alphamesh.plot.steps import plot_outlines, plot_radii, three_radii
from alphamesh.plot.story import plot_story
from alphamesh.plot.style import COLORS
from alphamesh.plot.topology import plot_barcode, plot_betti, plot_diagram

__all__ = [
    "COLORS",
    "FIGURE_FORMATS",
    "Drawing",
    "GrowthView",
    "GrowthView3D",
    "GrowthViewBox",
    "GrowthViewBox3D",
    "cell_coloring",
    "figure_bytes",
    "plot_balls",
    "plot_barcode",
    "plot_betti",
    "plot_cloud",
    "plot_cloud_in_space",
    "plot_complex",
    "plot_cycles",
    "plot_delaunay",
    "plot_diagram",
    "plot_filtration",
    "plot_frame",
    "plot_hull",
    "plot_outlines",
    "plot_overview",
    "plot_periodic",
    "plot_periodic_in_space",
    "plot_radii",
    "plot_restricted_voronoi",
    "plot_solid",
    "plot_story",
    "plot_surface",
    "plot_union",
    "plot_voronoi",
    "three_radii",
]
