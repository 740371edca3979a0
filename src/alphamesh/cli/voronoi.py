"""``alphamesh voronoi``: Voronoi cells, whole or cut by discs."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click
import numpy as np

from alphamesh.cli.building import (
    Job,
    cloud_options,
    need_matplotlib,
    save_figure,
    source_argument,
)
from alphamesh.cli.command import Command
from alphamesh.cli.outputs import Output, Outputs, check_targets
from alphamesh.cli.progress import Steps
from alphamesh.cli.summary import number
from alphamesh.cli.tables import TableFile, write_table
from alphamesh.cli.types import FigureFile, RadiusType

if TYPE_CHECKING:
    from alphamesh.restricted import RestrictedVoronoi
    from alphamesh.voronoi import Voronoi

__all__ = ["command"]

_EXAMPLES = (
    "alphamesh voronoi points.csv -o cells.csv",
    "alphamesh voronoi points.csv --radius 0.5 -o cells.npz --plot cells.svg",
    "alphamesh voronoi demo:annulus -n 500 --radius auto --plot cells.png",
)
_ARRAYS = {
    "voronoi": (
        *("points", "representative", "triangles", "vertices", "ridge_points"),
        *("ridge_vertices", "offset", "cell_ridges", "cell_vertices"),
    ),
    "restricted": (
        *("points", "representative", "radius", "offset", "start", "end", "neighbor"),
        *("angles", "area", "segment_length", "arc_length"),
    ),
}


@click.command("voronoi", cls=Command, examples=_EXAMPLES)
@source_argument
@click.option(
    "-o",
    "--output",
    "tables",
    type=TableFile(),
    multiple=True,
    help="Write the cells here: one line for each (.csv, .tsv), or all arrays (.npz). "
    "Can be given several times.",
)
@click.option(
    "-r",
    "--radius",
    type=RadiusType(),
    help="Cut every cell by the disc of this radius; or the rule that chooses it, or auto.",
)
@click.option("--plot", "picture", type=FigureFile(), help="Draw the cells.")
@cloud_options
def command(
    source: str,
    tables: tuple[Path, ...],
    radius: float | str | None,
    picture: Path | None,
    **options: Any,
) -> None:
    """Find the Voronoi cells of a cloud, whole or cut by discs.

    INPUT is a mask image, a file of points, "-" for a table on standard input,
    or demo:NAME for a built-in shape. With --radius, the cells are restricted:
    the part of each that lies within the radius of its point.
    """
    check_targets([*tables, *([picture] if picture else [])], source)
    need_matplotlib(picture is not None)
    outputs = Outputs()
    with Steps(quiet=options["quiet"]) as steps:
        job = Job.begin(source, options, steps)
        if radius is None:
            with steps.step("Finding the cells"):
                found: Voronoi | RestrictedVoronoi = job.complex.voronoi
            facts, lines = _whole(job.complex.voronoi)
        else:
            choice = job.choose(radius, steps)
            with steps.step("Cutting the cells") as done:
                found = job.complex.restricted_voronoi(
                    choice.radius, threads=options["threads"], progress=done
                )
            facts, lines = _restricted(found)
            facts["rule"] = choice.rule
            lines["Radius"] += f"  ({choice.rule})"
        files = [Output(path, lambda path: _write(found, path)) for path in tables]
        if picture is not None:
            files.append(Output(picture, lambda path: _draw(found, path)))
        outputs.write(files, steps)
    job.tell(facts, lines, outputs)


Told = tuple[dict[str, Any], dict[str, str]]


def _whole(cells: Voronoi) -> Told:
    bounded = int(np.count_nonzero(cells.bounded))
    own = int(np.count_nonzero(cells.representative == np.arange(len(cells.points))))
    ridges = len(cells.ridge_points)
    facts = {
        "cells": own,
        "bounded": bounded,
        "ridges": ridges,
        "vertices": len(cells.vertices),
    }
    lines = {
        "Cells": f"{own:,}, {bounded:,} of them bounded",
        "Ridges": f"{ridges:,}",
        "Vertices": f"{len(cells.vertices):,}",
    }
    return facts, lines


def _restricted(cells: RestrictedVoronoi) -> Told:
    own = int(np.count_nonzero(np.diff(cells.offset)))
    free = int(np.count_nonzero(cells.is_free))
    facts = {
        "radius": cells.radius,
        "cells": own,
        "free": free,
        "pairs_that_touch": len(cells.edges),
        "area": cells.total_area,
        "outer_length": cells.outer_length,
    }
    lines = {
        "Radius": number(cells.radius),
        "Cells": f"{own:,}, {free:,} of them touched by no other",
        "Pairs that touch": f"{len(cells.edges):,}",
        "Area": number(cells.total_area),
        "Outer length": number(cells.outer_length),
    }
    return facts, lines


def _write(cells: Voronoi | RestrictedVoronoi, path: Path) -> None:
    """Write one line for each cell, or all arrays."""
    from alphamesh.restricted import RestrictedVoronoi

    x, y = cells.points.T
    columns: dict[str, Any] = {"row": np.arange(len(x)), "x": x, "y": y}
    if isinstance(cells, RestrictedVoronoi):
        names = _ARRAYS["restricted"]
        segments = np.append(0, np.cumsum(~cells.is_arc))
        columns |= {
            "area": cells.area,
            "segment_length": cells.segment_length,
            "arc_length": cells.arc_length,
            "neighbors": np.diff(segments[cells.offset]),
        }
    else:
        names = _ARRAYS["voronoi"]
        columns |= {"area": cells.areas, "neighbors": np.diff(cells.offset)}
    arrays = {name: np.asarray(getattr(cells, name)) for name in names}
    write_table(path, columns, arrays)


def _draw(cells: Voronoi | RestrictedVoronoi, path: Path) -> None:
    from alphamesh.plot import plot_restricted_voronoi, plot_voronoi
    from alphamesh.restricted import RestrictedVoronoi

    if isinstance(cells, RestrictedVoronoi):
        drawing = plot_restricted_voronoi(cells)
    else:
        drawing = plot_voronoi(cells)
    save_figure(drawing.figure, path)
