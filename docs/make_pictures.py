"""Draw the pictures of the pages into docs/pictures, each less than 300 kB.

Usage: python docs/make_pictures.py [NAME ...]
"""

import sys
from pathlib import Path

import alphamesh as am
from alphamesh.film.still import small_png
from alphamesh.plot import (
    figure_bytes,
    plot_barcode,
    plot_betti,
    plot_complex,
    plot_diagram,
    plot_outlines,
    plot_overview,
    plot_radii,
    plot_restricted_voronoi,
    plot_solid,
    plot_story,
    plot_voronoi,
)
from alphamesh.plot.drawing import new_figure

PICTURES = Path(__file__).parent / "pictures"
MOST_BYTES = 300_000

# The radius that the tutorial looks at.
RADIUS = 34.0


def tutorial_complex():
    """Return the complex of the cloud that the tutorial tells of."""
    return am.AlphaComplex(am.demo_cloud("eight", 400, seed=1))


def eight():
    cx = am.AlphaComplex(am.demo_cloud("eight", 2000, seed=1))
    return small_png(plot_overview(cx), dpi=110)


def story():
    return small_png(plot_story(tutorial_complex(), RADIUS), dpi=80)


def outlines():
    return small_png(plot_outlines(tutorial_complex()), dpi=75)


def three_radii():
    return small_png(plot_radii(tutorial_complex(), [11, RADIUS, 68]), dpi=75)


def cells():
    """Draw a handful of cells, large enough to see arcs, segments and corners."""
    cx = am.AlphaComplex(am.demo_cloud("annulus", 36, seed=4))
    radius = 42.0
    figure = new_figure(12, 4)
    axes = figure.subplots(1, 3)
    figure.subplots_adjust(0.01, 0.02, 0.99, 0.98, 0.03)
    plot_voronoi(cx.voronoi, axes[0], reach=radius)
    plot_restricted_voronoi(cx.restricted_voronoi(radius), axes[1])
    plot_complex(cx.at(radius), axes[2])
    for ax in axes:
        ax.set_axis_off()
        ax.set_xlim(*axes[1].get_xlim())
        ax.set_ylim(*axes[1].get_ylim())
    return figure_bytes(figure, "svg")


def topology():
    """Draw the same classes of homology in three ways."""
    cx = tutorial_complex()
    figure = new_figure(12, 3.8)
    axes = figure.subplots(1, 3)
    figure.subplots_adjust(0.05, 0.13, 0.99, 0.98, 0.2)
    for draw, ax in zip((plot_diagram, plot_barcode, plot_betti), axes, strict=True):
        draw(cx.persistence(), ax, radius=RADIUS)
    return small_png(figure, dpi=80)


def solids():
    """Draw a cavity cut open, rings that are linked, and a knot, its cuts flat."""
    figure = new_figure(12, 4)
    axes = figure.subplots(1, 3)
    figure.subplots_adjust(0.0, 0.0, 1.0, 1.0, 0.0)
    hollow = am.AlphaComplex(am.sample_solid("hollow-torus", 6000, seed=1))
    plot_solid(hollow.at(0.16), axes[0], cut="-y", view=(28, -76))
    rings = am.AlphaComplex(am.sample_solid("linked-rings", 5000, seed=1))
    plot_solid(rings.at(0.17), axes[1], view=(22, -62))
    knot = am.AlphaComplex(am.sample_solid("trefoil", 6000, seed=1))
    plot_solid(knot.at(0.16), axes[2], view=(64, -60))
    return small_png(figure, dpi=75)


def grow():
    """Make the film; written by its own writer, so it is read back."""
    target = PICTURES / "grow.gif"
    cx = am.AlphaComplex(am.demo_cloud("annulus", 150, seed=3))
    cx.animate(target, frames=36, fps=6, width=440)
    return target.read_bytes()


MAKERS = {
    "eight.png": eight,
    "story.png": story,
    "outlines.png": outlines,
    "radii.png": three_radii,
    "cells.svg": cells,
    "topology.png": topology,
    "solids.png": solids,
    "grow.gif": grow,
}


def main(*names):
    for name in names or MAKERS:
        content = MAKERS[name]()
        if len(content) > MOST_BYTES:
            raise SystemExit(f"{name} has {len(content):,} bytes; draw it smaller")
        (PICTURES / name).write_bytes(content)
        print(f"{name}: {len(content):,} bytes")


if __name__ == "__main__":
    main(*sys.argv[1:])
