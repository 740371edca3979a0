"""One cloud at four radii, side by side: from scattered points to the Delaunay triangulation.

Usage: python growing_radius.py [FOLDER]

Balls of one radius grow around the points. An edge or a triangle joins the complex when the
balls around its corners meet, so holes of the shape open first and fill last.
"""

import sys
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

import alphamesh as am


def main(folder="."):
    alpha = am.AlphaComplex(am.demo_cloud("letter-b", 400, seed=3))
    chosen = alpha.choose_radius().radius

    figure = Figure(figsize=(14, 4.5), layout="constrained")
    for ax, radius in zip(
        figure.subplots(1, 4), (0.3 * chosen, 0.6 * chosen, chosen, np.inf), strict=True
    ):
        shape = alpha.at(radius)
        am.plot.plot_complex(shape, ax)
        ax.set_axis_off()
        ax.set_title(f"radius {radius:.3g}: {len(shape.triangles)} triangles")
        print(f"{radius:8.3f}  {shape}")
    figure.savefig(Path(folder) / "growing_radius.png", dpi=120)


if __name__ == "__main__":
    main(*sys.argv[1:])
