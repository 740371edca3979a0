"""``alphamesh hull``: the convex hull of a cloud."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from alphamesh.cli.building import (
    Job,
    cloud_options,
    need_matplotlib,
    plot_option,
    save_figure,
    source_argument,
)
from alphamesh.cli.command import Command
from alphamesh.cli.files import TableFile
from alphamesh.cli.outputs import Output, Outputs, check_targets, output_options
from alphamesh.cli.progress import Steps
from alphamesh.cli.summary import area_text, length_text
from alphamesh.cli.tables import write_table

__all__ = ["command"]

_EXAMPLES = (
    "alphamesh hull points.csv -o hull.csv",
    "alphamesh hull points.csv --collinear --plot hull.png --json",
)


@click.command("hull", cls=Command, examples=_EXAMPLES)
@source_argument
@output_options(TableFile(".csv"), "Write the corners here", name="tables")
@click.option("--collinear", is_flag=True, help="Keep points on the border between corners.")
@plot_option("Draw the hull.")
@cloud_options
def command(
    source: str,
    tables: tuple[Path, ...],
    collinear: bool,
    picture: Path | None,
    **options: Any,
) -> None:
    """Find the convex hull of a cloud.

    INPUT is a mask image, a file of points, "-" for standard input, or demo:NAME
    for a built-in shape. The table has one line for each corner, counter-clockwise:
    its row in INPUT counted from 0, x and y.
    """
    from alphamesh.hull import convex_hull

    check_targets([*tables, *([picture] if picture else [])], source)
    need_matplotlib(picture is not None)
    outputs = Outputs()
    with Steps(quiet=options["quiet"]) as steps:
        job = Job.begin(source, options, steps)
        hull = convex_hull(job.complex.points, collinear=collinear)
        columns: dict[str, Any] = {
            "row": hull.ring,
            "x": hull.corners[:, 0],
            "y": hull.corners[:, 1],
        }
        files = [Output(path, lambda path: write_table(path, columns)) for path in tables]
        if picture is not None:

            def draw(path: Path) -> None:
                from alphamesh.plot import plot_hull

                save_figure(plot_hull(hull).figure, path)

            files.append(Output(picture, draw))
        outputs.write(files, steps)
    facts = {"corners": len(hull.ring), "area": hull.area, "perimeter": hull.perimeter}
    lines = {
        "Corners": f"{len(hull.ring):,}",
        "Area": area_text(hull.area),
        "Perimeter": length_text(hull.perimeter),
    }
    job.tell(facts, lines, outputs)
