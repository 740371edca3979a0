"""``alphamesh animate``: a film of the growing radius."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from alphamesh.cli.building import Job, cloud_options, need_matplotlib, source_argument
from alphamesh.cli.command import Command, setting
from alphamesh.cli.files import STREAM, FilmFile
from alphamesh.cli.outputs import Output, Outputs, check_targets, output_options
from alphamesh.cli.periods import periods_option
from alphamesh.cli.progress import Steps
from alphamesh.cli.summary import length_text, number
from alphamesh.cli.types import RadiiType

__all__ = ["command"]

_EXAMPLES = (
    "alphamesh animate shape.png -o grow.gif",
    "alphamesh animate points.csv --frames 60 --width 640 -o grow.webp",
    "alphamesh animate demo:torus --points 2000 --turn 120 -o torus.gif",
    "alphamesh animate demo:target --radii 0,5,10,20,40 --fps 1 -o steps.gif",
    "alphamesh animate atoms.csv --periods 10,10,10 --weights w -o box.gif",
)


@click.command("animate", cls=Command, examples=_EXAMPLES)
@source_argument
@output_options(
    FilmFile(".gif"),
    "Write the film here (.mp4 needs ffmpeg)",
    name="films",
    required=True,
)
@click.option(
    "--radii",
    type=RadiiType(),
    default="even",
    show_default=True,
    help="Choose the radii by the number of simplices (quantiles), by their size (log), or "
    "half-way between (even); or list them: 1,2,4,8.",
)
@click.option(
    "--frames",
    type=click.IntRange(2, 10_000),
    default=100,
    show_default=True,
    help="How many frames, unless the radii are listed.",
)
@click.option(
    "--fps",
    type=click.FloatRange(0.1, 50),
    default=10,
    show_default=True,
    help="Frames a second.",
)
@click.option(
    "--hold",
    type=click.FloatRange(0, 60),
    default=1.5,
    show_default=True,
    help="Seconds that the last frame stays.",
)
@click.option(
    "--width",
    type=click.IntRange(200, 4000),
    default=960,
    show_default=True,
    help="Width in pixels.",
)
@click.option(
    "--turn",
    type=click.FloatRange(-3600, 3600),
    help="Degrees that the camera turns in the course of the film; for points in space.  "
    "[default: 60]",
)
@periods_option
@cloud_options
def command(
    source: str, films: tuple[Path, ...], radii: Any, frames: int, **options: Any
) -> None:
    """Make a film of balls that grow around the points, and of the mesh they give.

    INPUT is a mask image, a file of points, "-" for a table on standard input,
    or demo:NAME for a built-in shape. Each frame shows the Voronoi cells cut by
    the discs and the alpha complex, for points in space the complex and the same
    cut open, and how many components and holes there are.
    """
    from alphamesh.film import film_radii
    from alphamesh.film.writers import need_writer

    check_targets(films, source)
    need_matplotlib()
    for path in films:
        need_writer((setting("to") or ".gif") if path == STREAM else path.suffix.lower())
    outputs = Outputs()
    with Steps(quiet=options["quiet"]) as steps:
        job = Job.begin(source, options, steps, space=True)
        shown = film_radii(job.complex.persistence(), radii, frames)

        def write(path: Path) -> None:
            with steps.step(f"Drawing {len(shown):,} frames") as done:
                look = {name: options[name] for name in ("fps", "hold", "width", "turn")}
                job.complex.animate(path, radii=shown, progress=done, **look)

        outputs.write([Output(path, write, ".gif") for path in films], steps)
    low, high = float(shown.min()), float(shown.max())
    facts = {"frames": len(shown), "radii": shown}
    lines = {"Frames": f"{len(shown):,}", "Radii": f"{number(low)} to {length_text(high)}"}
    job.tell(facts, lines, outputs)
