"""``alphamesh hull``: the convex hull of a cloud in the plane or in space."""

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
from alphamesh.cli.files import STREAM, HullFile, TableFile
from alphamesh.cli.outputs import Output, Outputs, check_targets, output_options
from alphamesh.cli.progress import Steps
from alphamesh.cli.summary import area_text, length_text
from alphamesh.cli.tables import write_table
from alphamesh.cli.whole import SpatialHull

__all__ = ["command"]

_EXAMPLES = (
    "alphamesh hull points.csv -o hull.csv",
    "alphamesh hull points.csv --collinear --plot hull.png --json",
    "alphamesh hull scan.ply -o hull.stl",
)


@click.command("hull", cls=Command, examples=_EXAMPLES)
@source_argument
@output_options(
    HullFile(".csv"), "Write the corners here, in space also the mesh", name="tables"
)
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
    for a built-in shape. The table has one line for each corner, counter-clockwise
    in the plane: its row in INPUT counted from 0, and its coordinates. Points with a
    third coordinate, a column z, are in space; mesh files get the hull's triangles.
    """
    check_targets([*tables, *([picture] if picture else [])], source)
    need_matplotlib(picture is not None)
    outputs = Outputs()
    with Steps(quiet=options["quiet"]) as steps:
        job = Job.begin(source, options, steps, space=True)
        made = _made(job, collinear, tables)
        files = [Output(path, made.save, ".csv") for path in tables]
        if picture is not None:
            files.append(Output(picture, made.draw))
        outputs.write(files, steps)
    job.tell(*made.told(), outputs)


def _made(job: Job, collinear: bool, tables: tuple[Path, ...]) -> PlaneHull | SpatialHull:
    if job.complex.points.shape[1] == 3:
        if collinear:
            raise click.UsageError(
                "--collinear is for points in the plane; in space every point on the border "
                "is a corner"
            )
        return SpatialHull(job)
    known = TableFile().formats()
    for path in tables:
        if path != STREAM and path.suffix.lower() not in known:
            raise click.UsageError(
                f"{path.name}: the hull of points in the plane is a ring, not a mesh; write "
                f"a table: {', '.join(known)}"
            )
    return PlaneHull(job, collinear)


class PlaneHull:
    """The hull of points in the plane, and how to tell of it, write it and draw it."""

    def __init__(self, job: Job, collinear: bool) -> None:
        from alphamesh.hull import convex_hull

        self._hull = convex_hull(job.complex.points, collinear=collinear)

    def save(self, path: Path) -> None:
        """Write its corners."""
        x, y = self._hull.corners.T
        write_table(path, {"row": self._hull.ring, "x": x, "y": y})

    def draw(self, path: Path) -> None:
        """Draw it around the points."""
        from alphamesh.plot import plot_hull

        save_figure(plot_hull(self._hull).figure, path)

    def told(self) -> tuple[dict[str, Any], dict[str, str]]:
        """Return the summary for scripts and that for people."""
        hull = self._hull
        facts = {"corners": len(hull.ring), "area": hull.area, "perimeter": hull.perimeter}
        lines = {
            "Corners": f"{len(hull.ring):,}",
            "Area": area_text(hull.area),
            "Perimeter": length_text(hull.perimeter),
        }
        return facts, lines
