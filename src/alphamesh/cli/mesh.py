"""``alphamesh mesh``: from images or points to meshes."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from alphamesh.cli.batch import batch_options, only_one, run_batch, threads_each
from alphamesh.cli.building import (
    Job,
    cloud_options,
    need_matplotlib,
    plot_option,
    radius_option,
    radius_text,
    save_figure,
)
from alphamesh.cli.command import Command, setting
from alphamesh.cli.files import MeshFile
from alphamesh.cli.outputs import Output, Outputs, check_targets, output_options
from alphamesh.cli.progress import Steps
from alphamesh.cli.summary import area_text, length_text, volume_text
from alphamesh.cli.types import SourceType
from alphamesh.errors import DimensionError

if TYPE_CHECKING:
    from alphamesh.radius import RadiusChoice
    from alphamesh.shape import AlphaShape
    from alphamesh.shape3d import AlphaShape3D

__all__ = ["command"]

_STREAM = ".ply"

_EXAMPLES = (
    "alphamesh mesh shape.png -o mesh.vtu --plot mesh.png",
    "alphamesh mesh shape.png --points 20000 --seed 7 -o mesh.ply -o mesh.stl",
    "alphamesh mesh trees.csv --columns easting,northing --radius 25 --units m -o mesh.vtu",
    "alphamesh mesh points.csv --radius topology:holes=2 -o mesh.obj",
    "alphamesh mesh a.csv b.csv scan.ply --output-dir meshes --to vtu --jobs 2 --keep-going",
    "alphamesh sample shape.png -o - | alphamesh mesh - -o - --to off",
)


@click.command("mesh", cls=Command, examples=_EXAMPLES)
@click.argument("sources", metavar="INPUT...", nargs=-1, required=True, type=SourceType())
@output_options(MeshFile(_STREAM), "Write the mesh here", name="meshes", many=True)
@batch_options
@radius_option
@click.option(
    "--keep-columns",
    is_flag=True,
    help="Keep other columns of INPUT as numbers of the vertices.",
)
@plot_option("Draw cloud, Delaunay triangulation and complex side by side.")
@cloud_options
def command(
    sources: tuple[str, ...],
    meshes: tuple[Path, ...],
    picture: Path | None,
    **options: Any,
) -> None:
    """Make a mesh from an image or a file of points, or meshes of many.

    INPUT is a mask image (points are drawn from its white pixels), a file of
    points (CSV, TSV, TXT, XYZ, NPY, NPZ, Parquet, PLY), "-" for any of these on
    standard input, or demo:NAME for a built-in shape such as demo:annulus.
    Points with a third coordinate (a column z, as in PLY and XYZ files) are in
    space: the mesh is of tetrahedra, in surface formats of their boundary.
    Without -o, the mesh is only described. With --output-dir, a mesh of every
    INPUT is written there, under its name.
    """
    if options["folder"] is not None:
        if meshes or picture:
            raise click.UsageError("-o and --plot are for one input, --output-dir for many")
        options["threads"] = threads_each(options["threads"], options["jobs"])
        work = partial(_mesh_file, options=options)
        run_batch(work, sources, setting("to") or _STREAM, _COLUMNS, options)
        return
    source = only_one(sources, options)
    check_targets([*meshes, *([picture] if picture else [])], source)
    need_matplotlib(picture is not None)
    outputs = Outputs()
    with Steps(quiet=options["quiet"]) as steps:
        job, choice, shape = _made(source, options, steps)
        files = [Output(path, _saver(job, shape, options), _STREAM) for path in meshes]
        if picture is not None:
            files.append(Output(picture, lambda path: _draw(job, choice, path)))
        outputs.write(files, steps)
    lines = _lines(choice, shape)
    if not meshes:
        lines["Written"] = "nothing; -o FILE writes the mesh"
    job.tell({"dimension": job.complex.dimension, **_facts(choice, shape)}, lines, outputs)


# What the summary of many files shows.
_COLUMNS = ("points", "radius", "triangles", "tetrahedra", "area", "volume")


def _mesh_file(source: str, path: Path, options: dict[str, Any]) -> dict[str, Any]:
    """Make one mesh of many."""
    with Steps(quiet=True) as steps:
        job, choice, shape = _made(source, options, steps)
    _saver(job, shape, options)(path)
    return {
        "input": job.given.facts,
        "points": len(job.complex.points),
        "duplicates": job.duplicates,
        "dimension": job.complex.dimension,
        **_facts(choice, shape),
    }


def _made(
    source: str, options: dict[str, Any], steps: Steps
) -> tuple[Job, RadiusChoice, AlphaShape]:
    job = Job.begin(source, options, steps, space=True, attributes=options["keep_columns"])
    choice = job.choose(options["radius"], steps)
    return job, choice, job.complex.at(choice.radius)


def _saver(job: Job, shape: AlphaShape, options: dict[str, Any]) -> Callable[[Path], None]:
    """Return what writes the mesh."""
    if not options["keep_columns"]:
        return shape.save
    if job.complex.points.shape[1] == 3:
        raise click.UsageError("--keep-columns is for points in the plane; leave it out")
    return partial(shape.save, point_data=job.given.table)


def _draw(job: Job, choice: RadiusChoice, path: Path) -> None:
    from alphamesh.plot import plot_overview

    if job.complex.points.shape[1] == 3:
        raise DimensionError("--plot draws clouds in the plane alone; add --columns x,y")
    save_figure(plot_overview(job.complex, choice.radius), path)


def _facts(choice: RadiusChoice, shape: AlphaShape | AlphaShape3D) -> dict[str, Any]:
    """Return the summary for scripts."""
    return {
        "radius": choice.radius,
        "rule": choice.rule,
        "reason": choice.reason,
        **shape.counts,
        **_sizes(shape),
    }


def _sizes(shape: AlphaShape | AlphaShape3D) -> dict[str, Any]:
    """Return how large a shape is, in the plane or in space."""
    from alphamesh.simplices3d import SimplexSet3D

    if not isinstance(shape, SimplexSet3D):
        return {"area": shape.area, "perimeter": shape.perimeter}
    return {
        "volume": shape.volume,
        "surface_area": shape.surface_area,
        "regions": len(shape.regions),
        "region_volumes": shape.regions.volumes,
        "voids": len(shape.voids),
        "void_volumes": shape.voids.volumes,
    }


def _lines(choice: RadiusChoice, shape: AlphaShape | AlphaShape3D) -> dict[str, str]:
    """Return the summary for people."""
    told = ("tetrahedra", "triangles", "singular_triangles", "singular_edges")
    counts = {
        name.replace("_", " ").capitalize(): f"{shape.counts[name]:,}"
        for name in (*told, "isolated_vertices")
        if name in shape.counts and (name != "triangles" or "tetrahedra" not in shape.counts)
    }
    texts = {
        "area": area_text,
        "perimeter": length_text,
        "volume": volume_text,
        "surface_area": area_text,
        "regions": "{:,}".format,
        "voids": "{:,}".format,
    }
    sizes = {
        name.replace("_", " ").capitalize(): texts[name](size)
        for name, size in _sizes(shape).items()
        if name in texts
    }
    return {"Radius": radius_text(choice), "": choice.reason, **counts, **sizes}
