"""Draw the pictures of the pages into docs/pictures, each less than 300 kB.

Usage: python docs/make_pictures.py [NAME ...]
"""

import sys
from pathlib import Path

import numpy as np

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
from alphamesh.plot.style import CELL_COLORS

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


def periodic():
    """Draw a complex in a box whose border a hole crosses, as the page tells."""
    points = np.random.default_rng(3).random((260, 2)) * 10
    away = np.abs(points - [9, 1.5])
    points = points[np.hypot(*np.minimum(away, 10 - away).T) > 2]
    cx = am.AlphaComplex(points, periods=(10, 10))
    return figure_bytes(cx.plot(0.42).figure, "svg")


def periodic_space():
    """Draw the network of docs/periodic.md: its block, that cut open, a layer beside it."""
    figure = new_figure(12, 4.2)
    axes = figure.subplots(1, 3)
    figure.subplots_adjust(0.0, 0.0, 1.0, 1.0, 0.0)
    points = np.random.default_rng(1).random((3000, 3)) * 10
    x, y, z = 2 * np.pi * points.T / 10
    inside = np.sin(x) * np.cos(y) + np.sin(y) * np.cos(z) + np.sin(z) * np.cos(x) > 0.2
    network = am.AlphaComplex(points[inside], periods=(10, 10, 10)).at(0.85)
    network.plot(axes[0])
    network.plot(axes[1], cut="-y")
    layer = points[inside & (points[:, 2] < 3)]
    am.AlphaComplex(layer, periods=(10, 10, None)).at(0.7).plot(axes[2], view=(38, -58))
    return small_png(figure, dpi=75)


def periodic_film():
    """Make the film of the box of docs/periodic.md; read back, as that of the tutorial."""
    points = np.random.default_rng(3).random((140, 2)) * 10
    away = np.abs(points - [9, 1.5])
    points = points[np.hypot(*np.minimum(away, 10 - away).T) > 2]
    target = PICTURES / "periodic.gif"
    cx = am.AlphaComplex(points, periods=(10, 10))
    cx.animate(target, frames=24, fps=5, width=440)
    return target.read_bytes()


def topology():
    """Draw the same classes of homology in three ways."""
    cx = tutorial_complex()
    figure = new_figure(12, 3.8)
    axes = figure.subplots(1, 3)
    figure.subplots_adjust(0.05, 0.13, 0.99, 0.98, 0.2)
    for draw, ax in zip((plot_diagram, plot_barcode, plot_betti), axes, strict=True):
        draw(cx.persistence(), ax, radius=RADIUS)
    return small_png(figure, dpi=80)


def maps(width, height, count):
    """Return a figure with so many axes for maps."""
    figure = new_figure(width, height)
    axes = figure.subplots(1, count)
    figure.subplots_adjust(0.01, 0.02, 0.99, 0.92, 0.03)
    return figure, axes


def titled(ax, text, box):
    ax.set_title(text, fontsize=11)
    ax.set_axis_off()
    ax.set_aspect("equal")
    (left, low), (right, high) = box.min(axis=0), box.max(axis=0)
    ax.set_xlim(left - 0.03 * (right - left), right + 0.03 * (right - left))
    ax.set_ylim(low - 0.03 * (high - low), high + 0.03 * (high - low))


FACE, LINE, DOT = "#9fc5e8", "#1f4e79", "#333333"


def soho():
    """Draw what docs/gis.md tells of the dead in Soho."""
    from libpysal import examples

    deaths = am.read_geo(examples.get_path("SohoPeople.shp"))
    deaths = deaths[deaths["Count"] > 0].to_crs("EPSG:27700")
    regions = (
        am.AlphaComplex(deaths).at(25).to_geopandas(data=deaths, aggregate={"Count": "sum"})
    )
    box = deaths.get_coordinates().to_numpy()
    figure, axes = maps(11, 5.2, 2)
    size = 4 * deaths["Count"]
    deaths.plot(ax=axes[0], color=DOT, markersize=size, linewidth=0)
    titled(axes[0], f"{len(deaths)} addresses, {deaths['Count'].sum()} dead", box)
    regions.plot(ax=axes[1], color=FACE, edgecolor=LINE, linewidth=0.9)
    deaths.plot(ax=axes[1], color=DOT, markersize=size / 4, linewidth=0)
    pumps = am.read_geo(examples.get_path("SohoWater.shp")).to_crs(deaths.crs)
    pumps.plot(ax=axes[1], color="#d55e00", marker="D", markersize=36)
    for region in regions.itertuples():
        text = f"{region.Count_sum} dead"
        middle, top = region.geometry.centroid.x, region.geometry.bounds[3]
        axes[1].annotate(text, (middle, top + 6), fontsize=10, ha="center", va="bottom")
    titled(axes[1], "regions at radius 25 m, and the pumps", box)
    return small_png(figure, dpi=80)


def airports():
    """Draw what docs/gis.md tells of the airports of the USA."""
    import geopandas
    from vega_datasets import data

    table = data.airports()
    contiguous = table["longitude"].between(-126, -60) & (table["latitude"] > 24)
    table = table[(table["country"] == "USA") & contiguous]
    places = geopandas.points_from_xy(table["longitude"], table["latitude"])
    frame = geopandas.GeoDataFrame(table[["state"]], geometry=places, crs="EPSG:4326")
    frame = frame.to_crs("EPSG:5070")
    states = am.alpha_shapes(frame, by="state", radius="one-region")
    box = frame.get_coordinates().to_numpy()
    figure, axes = maps(12, 4.2, 2)
    frame.plot(ax=axes[0], color=DOT, markersize=1.5, linewidth=0)
    titled(axes[0], f"{len(frame):,} airports", box)
    states = states[states["area"] > 0]  # all but the District of Columbia
    colors = [CELL_COLORS[3 * k % 7] for k in range(len(states))]
    states.plot(ax=axes[1], color=colors, edgecolor=LINE, linewidth=0.6)
    frame.plot(ax=axes[1], color=DOT, markersize=0.6, linewidth=0)
    titled(axes[1], f"one shape for each of {len(states)} states", box)
    return small_png(figure, dpi=90)


def horse():
    """Draw what docs/gis.md tells of the horse."""
    import geopandas
    from skimage.data import horse as picture

    points = am.sample_mask(~picture(), 4000, seed=1)
    shape = am.AlphaComplex(points).at()
    figure, axes = maps(12, 3.6, 3)
    axes[0].plot(*points.T, ".", color=DOT, markersize=1.2)
    titled(axes[0], f"{len(points):,} points", points)
    outlines = {
        f"outline at radius {shape.radius:.1f}": shape.geometry(),
        "simplified by 1.5, smoothed": shape.geometry(simplify=1.5, smooth=3),
    }
    for ax, (title, outline) in zip(axes[1:], outlines.items(), strict=True):
        geopandas.GeoSeries([outline]).plot(ax=ax, color=FACE, edgecolor=LINE, linewidth=0.9)
        titled(ax, title, points)
    return small_png(figure, dpi=80)


def molecule():
    """Draw what docs/molecules.md tells of villin."""
    import importlib.util

    import numpy as np
    from matplotlib import colormaps

    from alphamesh.cli.molecule import element_colors
    from alphamesh.plot import plot_balls

    package = Path(importlib.util.find_spec("openmm").origin).parent
    villin = am.read_molecule(package / "app" / "data" / "test.pdb", hetero=False)
    atoms, probed = (
        am.AlphaComplex(villin.points, weights=villin.weights(probe)).union(0)
        for probe in (0, 1.4)
    )
    reached = np.sqrt(probed.ball_surface_areas / (4 * np.pi * probed.ball_radii**2))
    reached /= reached.max()
    figure = new_figure(11, 5.5)
    for k, colors in enumerate([element_colors(villin), colormaps["viridis"](reached)]):
        plot_balls(atoms, figure.add_axes((0.5 * k, 0, 0.5, 1)), colors=colors)
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


def weights():
    """Draw the crowns of docs/weights.md, smaller, as they are and larger."""
    rng = np.random.default_rng(4)
    trees, crowns = rng.random((70, 2)) * [60, 48], rng.lognormal(0.9, 0.5, 70)
    figure = plot_radii(am.AlphaComplex(trees, weights=crowns**2), [-2, 0, 3])
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
    "periodic.svg": periodic,
    "periodic-space.png": periodic_space,
    "periodic.gif": periodic_film,
    "topology.png": topology,
    "soho.png": soho,
    "airports.png": airports,
    "horse.png": horse,
    "molecule.png": molecule,
    "solids.png": solids,
    "weights.png": weights,
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
