"""From a mask image to a mesh: draw points, choose a radius, save mesh and picture.

Usage: python mask_to_mesh.py [IMAGE] [FOLDER]

Without IMAGE, a demo shape serves. The results go to FOLDER, by default the current one.
"""

import sys
from pathlib import Path

import alphamesh as am


def main(image=None, folder="."):
    folder = Path(folder)
    mask = am.demo_mask("cheese") if image is None else image
    points = am.sample_mask(mask, 4000, seed=1)

    alpha = am.AlphaComplex(points)
    choice = alpha.choose_radius()
    print(choice)

    shape = alpha.at(choice.radius)
    print(shape)
    shape.save(folder / "mesh.ply")

    figure = am.plot.plot_overview(alpha, choice.radius)
    figure.savefig(folder / "overview.png")


if __name__ == "__main__":
    main(*sys.argv[1:])
