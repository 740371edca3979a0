"""``alphamesh regions``: the pieces of a shape, or its holes, measured."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click
import numpy as np

from alphamesh.cli.building import Job, cloud_options, radius_text, source_argument
from alphamesh.cli.command import Command
from alphamesh.cli.files import TableFile
from alphamesh.cli.outputs import Output, Outputs, check_targets, output_options
from alphamesh.cli.progress import Steps
from alphamesh.cli.shaping import any_shape_at, any_shape_options
from alphamesh.cli.summary import area_text, length_text, number, print_table, volume_text
from alphamesh.cli.tables import write_table

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from alphamesh.planar import PlanarShape
    from alphamesh.radius import RadiusChoice
    from alphamesh.solid import SolidShape

__all__ = ["command"]

# Lines of the table that are told where no file is asked for.
_TOLD = 20

_EXAMPLES = (
    "alphamesh regions points.csv",
    "alphamesh regions trees.csv --columns easting,northing -r 25 --min-area 400 -o woods.csv",
    "alphamesh regions demo:cheese --holes -o holes.csv",
)


@click.command("regions", cls=Command, examples=_EXAMPLES)
@source_argument
@output_options(TableFile(".csv"), "Write the table here", name="tables")
@click.option(
    "--holes",
    "of_holes",
    is_flag=True,
    help="List the holes, in space the voids, not the regions.",
)
@any_shape_options
@cloud_options
def command(source: str, tables: tuple[Path, ...], of_holes: bool, **options: Any) -> None:
    """Measure the regions of a shape: triangles connected by edges, or solid pieces.

    INPUT is a mask image, a file of points, "-" for standard input, or demo:NAME
    for a built-in shape. The table has one line for each region, the largest
    first: area, perimeter, centroid, holes and triangles; or, with --holes, for
    each hole: area, perimeter and the region around it (-1 if several are). In
    space: volume, surface area, centroid and tetrahedra, of regions or of voids.
    """
    from alphamesh.solid import SolidShape

    check_targets(tables, source)
    outputs = Outputs()
    with Steps(quiet=options["quiet"]) as steps:
        job = Job.begin(source, options, steps, space=True)
        choice, shape = any_shape_at(job, options, steps)
        columns = _columns(shape, of_holes)
        files = [Output(path, lambda path: write_table(path, columns)) for path in tables]
        outputs.write(files, steps)
    if isinstance(shape, SolidShape):
        facts, lines = _told_in_space(choice, shape)
    else:
        facts, lines = _told(choice, shape)
    job.tell({**facts, "holes" if of_holes else "regions": _records(columns)}, lines, outputs)
    if not (tables or options["as_json"]):
        _show(columns)


def _columns(shape: PlanarShape | SolidShape, of_holes: bool) -> dict[str, NDArray[Any]]:
    from alphamesh.solid import SolidShape

    if not isinstance(shape, SolidShape):
        return _holes(shape) if of_holes else _regions(shape)
    if of_holes:
        voids = shape.voids
        return {
            "void": np.arange(len(voids)),
            "volume": voids.volumes,
            "surface_area": voids.surface_areas,
            "tetrahedra": voids.tetrahedron_counts,
        }
    found = shape.regions
    return {
        "region": np.arange(len(found)),
        "volume": found.volumes,
        "surface_area": found.surface_areas,
        **{f"centroid_{axis}": found.centroids[:, k] for k, axis in enumerate("xyz")},
        "tetrahedra": found.tetrahedron_counts,
    }


def _regions(shape: PlanarShape) -> dict[str, NDArray[Any]]:
    found = shape.regions
    return {
        "region": np.arange(len(found)),
        "area": found.areas,
        "perimeter": found.perimeters,
        "centroid_x": found.centroids[:, 0],
        "centroid_y": found.centroids[:, 1],
        "holes": found.hole_counts,
        "triangles": found.triangle_counts,
    }


def _holes(shape: PlanarShape) -> dict[str, NDArray[Any]]:
    found = shape.holes
    return {
        "hole": np.arange(len(found)),
        "area": found.areas,
        "perimeter": found.perimeters,
        "region": found.regions,
    }


def _told(choice: RadiusChoice, shape: PlanarShape) -> tuple[dict[str, Any], dict[str, str]]:
    facts = {
        "radius": choice.radius,
        "rule": choice.rule,
        "region_count": len(shape.regions),
        "hole_count": len(shape.holes),
        "area": shape.area,
        "perimeter": shape.perimeter,
    }
    lines = {
        "Radius": radius_text(choice),
        "Regions": f"{len(shape.regions):,}",
        "Holes": f"{len(shape.holes):,}",
        "Area": area_text(shape.area),
        "Perimeter": length_text(shape.perimeter),
    }
    return facts, lines


def _told_in_space(
    choice: RadiusChoice, shape: SolidShape
) -> tuple[dict[str, Any], dict[str, str]]:
    facts = {
        "radius": choice.radius,
        "rule": choice.rule,
        "region_count": len(shape.regions),
        "void_count": len(shape.voids),
        "volume": shape.volume,
        "surface_area": shape.surface_area,
    }
    lines = {
        "Radius": radius_text(choice),
        "Regions": f"{len(shape.regions):,}",
        "Voids": f"{len(shape.voids):,}",
        "Volume": volume_text(shape.volume),
        "Surface area": area_text(shape.surface_area),
    }
    return facts, lines


def _records(columns: dict[str, NDArray[Any]]) -> list[dict[str, Any]]:
    """Return one object for each line of a table."""
    rows = zip(*(column.tolist() for column in columns.values()), strict=True)
    return [dict(zip(columns, row, strict=True)) for row in rows]


def _show(columns: dict[str, NDArray[Any]]) -> None:
    """Print the first lines of a table."""
    rows = list(zip(*(column[:_TOLD] for column in columns.values()), strict=True))
    if rows:
        click.echo()
        print_table(list(columns), [[number(value) for value in row] for row in rows])
    more = len(next(iter(columns.values()))) - _TOLD
    if more > 0:
        click.echo(f"... and {more:,} more; -o FILE writes them all")
