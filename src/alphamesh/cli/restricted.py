"""``alphamesh restricted``: Voronoi cells cut by discs of one radius."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click
import numpy as np

from alphamesh.cli.building import (
    Job,
    cloud_options,
    need_matplotlib,
    plot_option,
    radius_option,
    radius_text,
    save_figure,
    source_argument,
)
from alphamesh.cli.command import Command
from alphamesh.cli.files import TableFile
from alphamesh.cli.outputs import Output, Outputs, check_targets, output_options
from alphamesh.cli.progress import Steps
from alphamesh.cli.summary import area_text, length_text
from alphamesh.cli.tables import write_table
from alphamesh.cli.types import Rule

if TYPE_CHECKING:
    from alphamesh.restricted import RestrictedVoronoi

__all__ = ["command"]

_EXAMPLES = (
    "alphamesh restricted points.csv --radius 0.5 -o cells.csv",
    "alphamesh restricted demo:annulus -n 500 -o cells.npz --plot cells.svg",
)
_ARRAYS = (
    *("points", "representative", "radius", "offset", "start", "end", "neighbor"),
    *("angles", "area", "segment_length", "arc_length"),
)


@click.command("restricted", cls=Command, examples=_EXAMPLES)
@source_argument
@output_options(TableFile(".csv"), "Write the cells here", name="tables")
@plot_option("Draw the cells.")
@radius_option
@cloud_options
def command(
    source: str,
    tables: tuple[Path, ...],
    picture: Path | None,
    radius: float | Rule,
    **options: Any,
) -> None:
    """Find restricted Voronoi cells: what is nearest to each point, and in its disc.

    INPUT is a mask image, a file of points, "-" for standard input, or demo:NAME
    for a built-in shape. A table has one line for each point: its row, x, y,
    area, lengths of the straight and the round border, and number of neighbors.
    NPZ has every segment and arc.
    """
    check_targets([*tables, *([picture] if picture else [])], source)
    need_matplotlib(picture is not None)
    outputs = Outputs()
    with Steps(quiet=options["quiet"]) as steps:
        job = Job.begin(source, options, steps)
        choice = job.choose(radius, steps)
        with steps.step("Cutting the cells") as done:
            cells = job.complex.restricted_voronoi(
                choice.radius, threads=options["threads"], progress=done
            )
        files = [Output(path, lambda path: _write(cells, path)) for path in tables]
        if picture is not None:
            files.append(Output(picture, lambda path: _draw(cells, path)))
        outputs.write(files, steps)
    facts, lines = _told(cells)
    facts = {"radius": choice.radius, "rule": choice.rule, **facts}
    job.tell(facts, {"Radius": radius_text(choice), **lines}, outputs)


def _told(cells: RestrictedVoronoi) -> tuple[dict[str, Any], dict[str, str]]:
    own = int(np.count_nonzero(np.diff(cells.offset)))
    free = int(np.count_nonzero(cells.is_free))
    facts = {
        "cells": own,
        "free": free,
        "pairs_that_touch": len(cells.edges),
        "area": cells.total_area,
        "outer_length": cells.outer_length,
    }
    lines = {
        "Cells": f"{own:,}, {free:,} of them touched by no other",
        "Pairs that touch": f"{len(cells.edges):,}",
        "Area": area_text(cells.total_area),
        "Outer length": length_text(cells.outer_length),
    }
    return facts, lines


def _write(cells: RestrictedVoronoi, path: Path) -> None:
    """Write one line for each cell, or all arrays."""
    x, y = cells.points.T
    segments = np.append(0, np.cumsum(~cells.is_arc))
    columns: dict[str, Any] = {
        "row": np.arange(len(x)),
        "x": x,
        "y": y,
        "area": cells.area,
        "segment_length": cells.segment_length,
        "arc_length": cells.arc_length,
        "neighbors": np.diff(segments[cells.offset]),
    }
    names = _ARRAYS if cells.disc_radii is None else (*_ARRAYS, "disc_radii")
    arrays = {name: np.asarray(getattr(cells, name)) for name in names}
    write_table(path, columns, arrays)


def _draw(cells: RestrictedVoronoi, path: Path) -> None:
    from alphamesh.plot import plot_restricted_voronoi

    save_figure(plot_restricted_voronoi(cells).figure, path)
