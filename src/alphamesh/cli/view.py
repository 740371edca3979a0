"""``alphamesh view``: a page that shows the complex live under a slider."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from alphamesh.cli.building import (
    Job,
    cloud_options,
    radius_option,
    radius_text,
    source_argument,
)
from alphamesh.cli.command import Command
from alphamesh.cli.files import STREAM, PageFile
from alphamesh.cli.outputs import Output, Outputs, check_targets, output_options
from alphamesh.cli.periods import periods_option
from alphamesh.cli.progress import Steps
from alphamesh.cli.types import Rule

__all__ = ["command"]

_EXAMPLES = (
    "alphamesh view points.csv -o page.html",
    "alphamesh view shape.png --points 2000 -o page.html --open",
    "alphamesh view demo:cheese -n 20000 --radius 4 -o cheese.html",
    "alphamesh view trees.csv --weights crown_sq --radius 0 -o crowns.html",
    "alphamesh view atoms.csv --periods 10,10,10 -o box.html",
)


@click.command("view", cls=Command, examples=_EXAMPLES)
@source_argument
@output_options(PageFile(".html"), "Write the page here", name="pages", required=True)
@click.option("--title", help="Heading of the page.  [default: the name of INPUT]")
@click.option("--open", "opened", is_flag=True, help="Show the page in the web browser.")
@radius_option
@periods_option
@cloud_options
def command(
    source: str,
    pages: tuple[Path, ...],
    title: str | None,
    opened: bool,
    radius: float | Rule,
    **options: Any,
) -> None:
    """Write a page that shows the complex live under a slider for the radius.

    INPUT is a mask image, a file of points, "-" for a table on standard input,
    or demo:NAME for a built-in shape. Points with a third coordinate are in
    space. The page is one HTML file with all in it: it opens from disk, and asks
    for nothing from the network.
    """
    from alphamesh.view import write_page

    check_targets(pages, source)
    outputs = Outputs()
    with Steps(quiet=options["quiet"]) as steps:
        job = Job.begin(source, options, steps, space=True)
        choice = job.choose(radius, steps)
        heading = title or ("Standard input" if source == "-" else Path(source).name)
        with steps.step("Pairing simplices") as done:
            pairs = job.complex.persistence(threads=options["threads"], progress=done)
        given = choice.rule == "given"
        marked = job.complex.choose_radius() if given else choice

        def write(path: Path) -> None:
            write_page(path, pairs, marked, radius=choice.radius, title=heading)

        outputs.write([Output(path, write, ".html") for path in pages], steps)
    facts = {"radius": choice.radius, "rule": choice.rule}
    job.tell(facts, {"Radius": radius_text(choice)}, outputs)
    for page in pages if opened else ():
        if page != STREAM:
            click.launch(page.resolve().as_uri())
