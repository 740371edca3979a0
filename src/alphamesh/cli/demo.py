"""``alphamesh demo``: a gallery of shapes whose holes are known."""

from __future__ import annotations

import io
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from alphamesh.cli.batch import make_folder
from alphamesh.cli.command import Command, json_option, quiet_option, threads_option
from alphamesh.cli.gallery import Exhibit, gallery_page
from alphamesh.cli.inputs import seed_option
from alphamesh.cli.outputs import check_targets, write_bytes
from alphamesh.cli.progress import Steps
from alphamesh.cli.summary import counted, print_json
from alphamesh.cli.write_points import write_points
from alphamesh.errors import MissingLibraryError, ParameterError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from alphamesh.complex import AlphaComplex

__all__ = ["command"]

# Enough for a page, and a third of the bytes of the usual resolution.
_DPI = 100

_FRAMES = 40
_FILM_WIDTH = 640

# Share of the time of a shape that its pictures take.
_PICTURES = 0.3

_EXAMPLES = (
    "alphamesh demo",
    "alphamesh demo gallery --points 10000 --seed 4",
    "alphamesh demo gallery --shapes cheese,target --quick",
)


@click.command("demo", cls=Command, examples=_EXAMPLES)
@click.argument(
    "folder", type=click.Path(path_type=Path, file_okay=False), default="alphamesh-demo"
)
@click.option(
    "-s",
    "--shape",
    "--shapes",
    "names",
    multiple=True,
    metavar="NAME",
    help="Show this shape only, or these with commas between; can be given several times.  "
    "[default: all]",
)
@click.option(
    "-n",
    "--points",
    "each",
    type=click.IntRange(min=1),
    metavar="N",
    default=2000,
    show_default=True,
    help="How many points to draw from each shape.",
)
@click.option("--quick", is_flag=True, help="Make no films, which take longest.")
@seed_option
@threads_option
@json_option
@quiet_option
def command(folder: Path, names: tuple[str, ...], **options: Any) -> None:
    """Write a gallery of demo shapes into FOLDER and a page that shows it.

    For each shape: the mask image, the points drawn from it, the mesh, pictures
    of hull, Delaunay triangulation, frame, cells and complex at three radii,
    and a film of the growing radius. Open index.html in a browser. FOLDER is
    alphamesh-demo if not given, and made if missing.
    """
    import alphamesh.plot  # noqa: F401 - if matplotlib is missing, say so before the work

    chosen = _chosen(names)
    make_folder(folder)
    check_targets([folder / "index.html"])
    exhibits = []
    with Steps(quiet=options["quiet"]) as steps, steps.step("Gallery") as done:
        for number, name in enumerate(chosen):

            def part(share: float, before: int = number) -> None:
                done((before + share) / len(chosen))

            exhibits.append(_exhibit(folder, name, options, part))
        write_bytes(gallery_page(exhibits).encode(), folder / "index.html")
    page = folder / "index.html"
    if options["as_json"]:
        print_json({"page": str(page), "shapes": [exhibit.facts() for exhibit in exhibits]})
    else:
        click.echo(f"{counted(len(exhibits), 'shape')} drawn; open {page} in a browser")


def _chosen(names: tuple[str, ...]) -> list[str]:
    """Return the names without repeats, or those of all shapes."""
    from alphamesh.sampling import DEMO_SHAPES

    names = tuple(name.strip() for given in names for name in given.split(","))
    unknown = [name for name in names if name not in DEMO_SHAPES]
    if unknown:
        raise ParameterError(
            f"there is no demo shape {unknown[0]!r}; choose among: {', '.join(DEMO_SHAPES)}"
        )
    return list(dict.fromkeys(names or DEMO_SHAPES))


def _exhibit(
    folder: Path, name: str, options: dict[str, Any], done: Callable[[float], None]
) -> Exhibit:
    """Make the files of one shape."""
    from alphamesh.complex import AlphaComplex
    from alphamesh.sampling import DEMO_SHAPES, demo_cloud, demo_mask

    points = demo_cloud(name, options["each"], seed=options["seed"] or 0)
    built = AlphaComplex(points, threads=options["threads"])
    choice = built.choose_radius()
    shape = built.at(choice.radius)
    exhibit = Exhibit(
        DEMO_SHAPES[name],
        choice,
        shape.counts,
        shape.euler_characteristic,
        not options["quick"],
    )
    done(0.0)
    write_bytes(_mask_png(demo_mask(name)), folder / exhibit.mask)
    write_points(points, folder / exhibit.cloud)
    shape.save(folder / exhibit.mesh)
    _draw(built, choice.radius, exhibit, folder)
    if exhibit.with_film:
        done(_PICTURES)
        built.animate(
            folder / exhibit.film,
            frames=_FRAMES,
            width=_FILM_WIDTH,
            progress=lambda share: done(_PICTURES + (1 - _PICTURES) * share),
        )
    return exhibit


def _draw(built: AlphaComplex, radius: float, exhibit: Exhibit, folder: Path) -> None:
    """Write the pictures of one shape."""
    from alphamesh.film.still import small_png
    from alphamesh.plot import plot_outlines, plot_overview, plot_radii

    for name, figure in (
        (exhibit.picture, plot_overview(built, radius)),
        (exhibit.outlines, plot_outlines(built)),
        (exhibit.radii, plot_radii(built)),
    ):
        write_bytes(small_png(figure, dpi=_DPI), folder / name)


def _mask_png(mask: NDArray[np.bool_]) -> bytes:
    """Return a mask as a picture, white inside the shape."""
    try:
        from PIL import Image
    except ImportError as error:
        raise MissingLibraryError.of("Pillow", "io", "Writing images") from error
    target = io.BytesIO()
    Image.fromarray(mask).save(target, format="png", optimize=True)
    return target.getvalue()
