"""``alphamesh voronoi``: the Voronoi cells of a cloud."""

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
    save_figure,
    source_argument,
)
from alphamesh.cli.command import Command
from alphamesh.cli.files import TableFile
from alphamesh.cli.outputs import Output, Outputs, check_targets, output_options
from alphamesh.cli.progress import Steps
from alphamesh.cli.tables import write_table

if TYPE_CHECKING:
    from alphamesh.voronoi import Voronoi

__all__ = ["command"]

_EXAMPLES = (
    "alphamesh voronoi points.csv -o cells.csv",
    "alphamesh voronoi demo:annulus -n 500 -o cells.npz --plot cells.svg",
)
_ARRAYS = (
    *("points", "representative", "triangles", "vertices", "ridge_points"),
    *("ridge_vertices", "offset", "cell_ridges", "cell_vertices"),
)


@click.command("voronoi", cls=Command, examples=_EXAMPLES)
@source_argument
@output_options(TableFile(".csv"), "Write the cells here", name="tables")
@plot_option("Draw the cells.")
@cloud_options
def command(
    source: str, tables: tuple[Path, ...], picture: Path | None, **options: Any
) -> None:
    """Find the Voronoi cells of a cloud: what is nearest to each point.

    INPUT is a mask image, a file of points, "-" for standard input, or demo:NAME
    for a built-in shape. A table has one line for each point: its row, x, y,
    area (inf if unbounded) and number of neighbors. NPZ has the whole diagram.
    For cells cut by discs, see alphamesh restricted.
    """
    check_targets([*tables, *([picture] if picture else [])], source)
    need_matplotlib(picture is not None)
    outputs = Outputs()
    with Steps(quiet=options["quiet"]) as steps:
        job = Job.begin(source, options, steps)
        with steps.step("Finding the cells"):
            cells = job.complex.voronoi
        files = [Output(path, lambda path: _write(cells, path)) for path in tables]
        if picture is not None:
            files.append(Output(picture, lambda path: _draw(cells, path)))
        outputs.write(files, steps)
    job.tell(*_told(cells), outputs)


def _told(cells: Voronoi) -> tuple[dict[str, Any], dict[str, str]]:
    bounded = int(np.count_nonzero(cells.bounded))
    has = cells.representative == np.arange(len(cells.points))
    has[cells.hidden] = False
    own = int(np.count_nonzero(has))
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


def _write(cells: Voronoi, path: Path) -> None:
    """Write one line for each cell, or all arrays."""
    x, y = cells.points.T
    columns: dict[str, Any] = {
        "row": np.arange(len(x)),
        "x": x,
        "y": y,
        "area": cells.areas,
        "neighbors": np.diff(cells.offset),
    }
    names = _ARRAYS if cells.weights is None else (*_ARRAYS, "weights", "hidden")
    arrays = {name: np.asarray(getattr(cells, name)) for name in names}
    write_table(path, columns, arrays)


def _draw(cells: Voronoi, path: Path) -> None:
    from alphamesh.plot import plot_voronoi

    save_figure(plot_voronoi(cells).figure, path)
