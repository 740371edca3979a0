"""``alphamesh query``: which points lie in a shape, in which region, and how far off."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click
import numpy as np

from alphamesh.cli.building import Job, cloud_options, radius_text, source_argument
from alphamesh.cli.command import Command
from alphamesh.cli.files import TableFile
from alphamesh.cli.inputs import Input, InputOptions, load
from alphamesh.cli.outputs import Output, Outputs, check_targets, output_options
from alphamesh.cli.progress import Steps
from alphamesh.cli.shaping import any_shape_at, any_shape_options
from alphamesh.cli.streams import STDIN
from alphamesh.cli.summary import counted, length_text
from alphamesh.cli.tables import write_table
from alphamesh.cli.types import ColumnsType, SourceType
from alphamesh.errors import DimensionError, ParameterError

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from alphamesh.planar import PlanarShape
    from alphamesh.solid import SolidShape

__all__ = ["command"]

_EXAMPLES = (
    "alphamesh query points.csv places.csv -o answers.csv",
    "alphamesh query points.csv places.csv -r 25 --nearest -o answers.parquet",
    "cat places.csv | alphamesh query points.csv - -o - | grep ',1,'",
)


@click.command("query", cls=Command, examples=_EXAMPLES)
@source_argument
@click.argument("places", metavar="PLACES", type=SourceType())
@output_options(TableFile(".csv"), "Write the answers here", name="tables")
@click.option(
    "--places-columns",
    type=ColumnsType(),
    metavar="X,Y[,Z]",
    help="Columns of PLACES.  [default: x,y, and z if there is one]",
)
@click.option("--nearest", is_flag=True, help="Tell the nearest point of the boundary, too.")
@any_shape_options
@cloud_options
def command(
    source: str,
    places: str,
    tables: tuple[Path, ...],
    places_columns: tuple[str | int, ...] | None,
    nearest: bool,
    **options: Any,
) -> None:
    """Ask a shape where points lie: inside or not, in which region, how far off.

    INPUT is a mask image, a file of points, "-" for standard input, or demo:NAME
    for a built-in shape; the shape is its complex at one radius. PLACES is a
    file of points, or "-". The answers have one line for each place: x, y, its
    other columns, inside (1 or 0, exact, borders belong to the shape), region (-1 outside) and
    distance to the boundary, negative inside. If both files have a column z, the
    shape is one in space.
    """
    if source == places == STDIN:
        raise click.UsageError("INPUT and PLACES cannot both be standard input")
    check_targets(tables, source)
    check_targets(tables, places)
    outputs = Outputs()
    with Steps(quiet=options["quiet"]) as steps:
        given = InputOptions(columns=places_columns)
        known = load(places, given, steps, attributes=True)
        job = Job.begin(source, options, steps, space=known.points.shape[1] == 3)
        known = _like(known, job.complex.points.shape[1])
        choice, shape = any_shape_at(job, options, steps)
        with steps.step(f"Asking about {counted(len(known.points), 'place')}"):
            columns = _with_columns(known, _answers(shape, known.points, nearest))
        files = [Output(path, lambda path: write_table(path, columns)) for path in tables]
        outputs.write(files, steps)
    inside = int(np.count_nonzero(columns["inside"]))
    least = float(columns["distance"].min(initial=np.inf))
    most = float(columns["distance"].max(initial=-np.inf))
    facts = {
        "radius": choice.radius,
        "rule": choice.rule,
        "places": len(known.points),
        "inside": inside,
        "least_distance": least,
        "largest_distance": most,
    }
    lines = {
        "Radius": radius_text(choice),
        "Places": f"{len(known.points):,}, {inside:,} of them inside",
        "Distance": f"{length_text(least)} to {length_text(most)}, negative inside",
    }
    job.tell(facts, lines, outputs)


def _like(places: Input, dimension: int) -> Input:
    """Return the places with as many coordinates as the points; z becomes a column."""
    given = places.points.shape[1]
    if given == dimension:
        return places
    if given < dimension:
        raise DimensionError(
            "INPUT is in space, and PLACES have two coordinates; name three of its columns "
            "with --places-columns, or two of INPUT with --columns"
        )
    from alphamesh.table import PointTable

    flat, others = np.ascontiguousarray(places.points[:, :2]), {"z": places.points[:, 2]}
    crs = None
    if places.table is not None:
        others |= places.table.columns
        crs = places.table.crs
    return replace(places, points=flat, table=PointTable(flat, others, crs))


def _with_columns(places: Input, answers: dict[str, NDArray[Any]]) -> dict[str, NDArray[Any]]:
    """Return the answers, after what the file of places holds besides its coordinates."""
    known = {} if places.table is None else dict(places.table.columns)
    twins = sorted(set(known) & set(answers))
    if twins:
        raise ParameterError(
            f"PLACES has a column {twins[0]!r}, as the answers have; rename it there"
        )
    axes = {name: answers.pop(name) for name in "xyz" if name in answers}
    return axes | known | answers


def _answers(
    shape: PlanarShape | SolidShape, asked: NDArray[np.float64], nearest: bool
) -> dict[str, NDArray[Any]]:
    region = shape.region_of(asked)
    inside = region >= 0
    found = shape.nearest(asked)
    columns: dict[str, NDArray[Any]] = {
        **dict(zip("xyz", asked.T, strict=False)),
        "inside": inside,
        "region": region,
        "distance": np.where(inside, -found.distances, found.distances) + 0.0,
    }
    if nearest:
        axes = zip("xyz", found.points.T, strict=False)
        columns |= {f"nearest_{axis}": values for axis, values in axes}
    return columns
