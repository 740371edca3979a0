"""``alphamesh polygons``: the outlines of a shape, holes and all."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from alphamesh.cli.batch import batch_options, only_one, run_batch, threads_each
from alphamesh.cli.building import Job, cloud_options, radius_text
from alphamesh.cli.command import Command, setting
from alphamesh.cli.files import GeoFile
from alphamesh.cli.outputs import Output, Outputs, check_targets, output_options
from alphamesh.cli.progress import Steps
from alphamesh.cli.shaping import shape_at, shape_options
from alphamesh.cli.summary import area_text, length_text
from alphamesh.cli.types import AggregateType, SourceType

if TYPE_CHECKING:
    from alphamesh.planar import PlanarShape
    from alphamesh.radius import RadiusChoice

__all__ = ["command"]

_STREAM = ".geojson"

_EXAMPLES = (
    "alphamesh polygons trees.csv --columns easting,northing --crs EPSG:25832 -o woods.geojson",
    "alphamesh polygons trees.gpkg --aggregate height:max -o woods.gpkg",
    "alphamesh polygons points.csv -r 25 --min-area 400 --fill-holes 50 -o regions.geojson",
    "alphamesh polygons points.csv --as shape --simplify 0.5 -o outline.wkt",
    "alphamesh polygons a.csv b.csv --output-dir outlines --to geojson",
    "alphamesh sample demo:cheese -o - | alphamesh polygons - -o - --to wkt",
)


@click.command("polygons", cls=Command, examples=_EXAMPLES)
@click.argument("sources", metavar="INPUT...", nargs=-1, required=True, type=SourceType())
@output_options(GeoFile(_STREAM), "Write the polygons here", many=True)
@batch_options
@click.option(
    "--as",
    "what",
    type=click.Choice(["regions", "shape", "collection", "triangles", "points"]),
    default="regions",
    show_default=True,
    help="A polygon for each region; one for all; that with the edges and vertices in no "
    "triangle; a polygon for each triangle; or the points with their regions.",
)
@click.option(
    "--crs",
    metavar="NAME",
    help="The reference system of the points, such as EPSG:25832.  [default: that of INPUT]",
)
@click.option(
    "--aggregate",
    type=AggregateType(),
    metavar="COLUMN:HOW",
    multiple=True,
    help="Tell the mean, min, max, sum, count or first of a column of INPUT. Can be given "
    "several times.",
)
@click.option("--elevation", metavar="COLUMN", help="Column of INPUT with the z of each point.")
@click.option(
    "--simplify",
    type=click.FloatRange(0),
    metavar="D",
    default=0.0,
    help="Leave out corners while the outline moves by no more than D.  [default: none]",
)
@click.option(
    "--smooth",
    type=click.IntRange(0, 12),
    metavar="N",
    default=0,
    help="Cut corners N times.  [default: never]",
)
@shape_options
@cloud_options
def command(sources: tuple[str, ...], files: tuple[Path, ...], **options: Any) -> None:
    """Write the outlines of a shape as polygons with holes, or those of many.

    INPUT is a mask image, a file of points, "-" for standard input, or demo:NAME
    for a built-in shape; the shape is its complex at one radius. Polygons are
    valid, outer rings counter-clockwise; each has its area, perimeter, number
    of holes and triangles. With --output-dir, a file of every INPUT is written
    there, under its name.
    """
    _check(options)
    if options["folder"] is not None:
        if files:
            raise click.UsageError("-o is for one input, --output-dir for many")
        options["threads"] = threads_each(options["threads"], options["jobs"])
        work = partial(_outline_file, options=options)
        run_batch(work, sources, setting("to") or _STREAM, _COLUMNS, options)
        return
    source = only_one(sources, options)
    check_targets(files, source)
    outputs = Outputs()
    with Steps(quiet=options["quiet"]) as steps:
        job = _job(source, options, steps)
        choice, shape = shape_at(job, options, steps)
        outputs.write(
            [
                Output(path, lambda path: _write(path, job, shape, options), _STREAM)
                for path in files
            ],
            steps,
        )
    facts = _facts(choice, shape)
    lines = {
        "Radius": radius_text(choice),
        "Regions": f"{facts['regions']:,}",
        "Holes": f"{facts['holes']:,}",
        "Area": area_text(shape.area),
        "Perimeter": length_text(shape.perimeter),
    }
    if not files:
        lines["Written"] = "nothing; -o FILE writes the polygons"
    job.tell(facts, lines, outputs)


# What the summary of many files shows.
_COLUMNS = ("points", "radius", "regions", "holes", "area")


def _outline_file(source: str, path: Path, options: dict[str, Any]) -> dict[str, Any]:
    """Write the outlines of one input of many."""
    with Steps(quiet=True) as steps:
        job = _job(source, options, steps)
        choice, shape = shape_at(job, options, steps)
    _write(path, job, shape, options)
    points = len(job.complex.points)
    return {"input": job.given.facts, "points": points, **_facts(choice, shape)}


def _facts(choice: RadiusChoice, shape: PlanarShape) -> dict[str, Any]:
    return {
        "radius": choice.radius,
        "rule": choice.rule,
        "reason": choice.reason,
        "regions": len(shape.regions),
        "holes": int(shape.regions.hole_counts.sum()),
        "area": shape.area,
        "perimeter": shape.perimeter,
    }


def _check(options: dict[str, Any]) -> None:
    """Refuse before the work what cannot be: a missing library, an unknown CRS."""
    from alphamesh._geopoints import as_crs, geopandas

    geopandas("Writing polygons")
    as_crs(options["crs"])


def _job(source: str, options: dict[str, Any], steps: Steps) -> Job:
    needed = options["aggregate"] or options["elevation"] or options["what"] == "points"
    crs = options["crs"]
    return Job.begin(source, options, steps, attributes=bool(needed), crs=crs)


def _write(path: Path, job: Job, shape: PlanarShape, options: dict[str, Any]) -> None:
    """Write a feature for each region, or triangle, or point, or one for all."""
    from alphamesh.io.geo import write_geo

    what = options["what"]
    look = {name: options[name] for name in ("simplify", "smooth", "elevation")}
    look |= {"data": job.given.table, "aggregate": _merged(options["aggregate"])}
    frame = shape.to_geopandas("shape" if what == "collection" else what, **look)
    if what == "collection":
        simpler = {name: options[name] for name in ("simplify", "smooth")}
        whole = shape.geometry(collection=True, **simpler)
        frame = frame.set_geometry([whole], crs=frame.crs)
    write_geo(frame, path)


def _merged(asked: Sequence[tuple[str, str]]) -> dict[str, list[str]]:
    """Return the ways to aggregate each column."""
    merged: dict[str, list[str]] = {}
    for column, how in asked:
        merged.setdefault(column, []).append(how)
    return merged
