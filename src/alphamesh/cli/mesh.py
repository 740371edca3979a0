"""``alphamesh mesh``: from images or points to meshes."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
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
from alphamesh.cli.periods import box_lines, box_sizes, periods_option
from alphamesh.cli.progress import Steps
from alphamesh.cli.solids import (
    Solid,
    refuse_solid_options,
    solid_at,
    solid_options,
    surface_option,
)
from alphamesh.cli.summary import area_text, length_text
from alphamesh.cli.types import SourceType

if TYPE_CHECKING:
    from alphamesh.radius import RadiusChoice
    from alphamesh.shape import AlphaShape

__all__ = ["command"]

_STREAM = ".ply"

_EXAMPLES = (
    "alphamesh mesh shape.png -o mesh.vtu --plot mesh.png",
    "alphamesh mesh shape.png --points 20000 --seed 7 -o mesh.ply -o mesh.stl",
    "alphamesh mesh trees.csv --columns easting,northing --radius 25 --units m -o mesh.vtu",
    "alphamesh mesh points.csv --radius topology:holes=2 -o mesh.obj",
    "alphamesh mesh scan.ply -o surface.stl --plot surface.png",
    "alphamesh mesh cells.xyz -r 0.5 --fill-voids all --largest 1 -o solid.vtu -o skin.ply",
    "alphamesh mesh atoms.csv --periods 10,10,10 -r 1.2 -o atoms.vtu",
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
@solid_options
@surface_option
@plot_option("Draw cloud, Delaunay triangulation and complex side by side.")
@periods_option
@cloud_options
def command(
    sources: tuple[str, ...],
    meshes: tuple[Path, ...],
    picture: Path | None,
    **options: Any,
) -> None:
    """Make a mesh from an image or a file of points, or meshes of many.

    INPUT is a mask image (points are drawn from its white pixels), a file of
    points (CSV, TSV, TXT, XYZ, NPY, NPZ, Parquet, PLY, PCD, LAS), "-" for any of
    these on standard input, or demo:NAME for a built-in shape such as demo:annulus.

    Points with a third coordinate, a column z, are in space. Then VTU, VTK, MSH and
    NPZ get tetrahedra; formats of surfaces get the closed surface around them,
    watertight and oriented. The scan of a surface is found out, closed and filled.

    With --periods, the mesh is that of one box: what crosses its border is there once,
    in one piece, and reaches beyond it.

    Without -o, the mesh is only described. With --output-dir, a mesh of every INPUT
    is written there, under its name.
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
        made = _made(source, options, steps)
        files = [Output(path, _saver(made, options), _STREAM) for path in meshes]
        if picture is not None:
            files.append(Output(picture, lambda path: _draw(made, path)))
        outputs.write(files, steps)
    lines = _lines(made)
    if not meshes:
        lines["Written"] = "nothing; -o FILE writes the mesh"
    facts = {"dimension": made.job.complex.dimension, **_facts(made)}
    made.job.tell(facts, lines, outputs)


# What the summary of many files shows.
_COLUMNS = ("points", "radius", "triangles", "tetrahedra", "area", "volume", "watertight")


def _mesh_file(source: str, path: Path, options: dict[str, Any]) -> dict[str, Any]:
    """Make one mesh of many."""
    with Steps(quiet=True) as steps:
        made = _made(source, options, steps)
    _saver(made, options)(path)
    job = made.job
    return {
        "input": job.given.facts,
        "points": len(job.complex.points),
        "duplicates": job.duplicates,
        "dimension": job.complex.dimension,
        **_facts(made),
    }


@dataclass(frozen=True, slots=True)
class _Made:
    """A shape in the plane, in space or in a box; `solid` tells of one in space."""

    job: Job
    choice: RadiusChoice
    shape: Any
    solid: Solid | None = None


def _made(source: str, options: dict[str, Any], steps: Steps) -> _Made:
    job = Job.begin(source, options, steps, space=True, attributes=options["keep_columns"])
    if options["periods"] is not None:
        if options["keep_columns"]:
            raise click.UsageError("--keep-columns does not go with --periods; leave it out")
        refuse_solid_options(options, "points in a periodic box")
        choice = job.choose(options["radius"], steps)
        return _Made(job, choice, job.complex.at(choice.radius))
    if job.complex.points.shape[1] == 3:
        if options["keep_columns"]:
            raise click.UsageError("--keep-columns is for points in the plane; leave it out")
        choice, solid = solid_at(job, options, steps)
        return _Made(job, choice, solid.shape, solid)
    refuse_solid_options(options, f"{source!r}, points in the plane")
    choice = job.choose(options["radius"], steps)
    return _Made(job, choice, job.complex.at(choice.radius))


def _saver(made: _Made, options: dict[str, Any]) -> Callable[[Path], None]:
    """Return what writes the mesh."""
    if made.solid is not None:
        return made.solid.save
    if not options["keep_columns"]:
        save: Callable[[Path], None] = made.shape.save
        return save
    return partial(made.shape.save, point_data=made.job.given.table)


def _draw(made: _Made, path: Path) -> None:
    from alphamesh.plot import plot_overview
    from alphamesh.plot.overview3d import plot_shape_in_space

    if made.job.periodic:
        figure = made.shape.plot().figure
    elif made.solid is not None:
        figure = plot_shape_in_space(made.solid.shape)
    else:
        figure = plot_overview(made.job.complex, made.choice.radius)
    save_figure(figure, path)


def _facts(made: _Made) -> dict[str, Any]:
    """Return the summary for scripts."""
    return {
        "radius": made.choice.radius,
        "rule": made.choice.rule,
        "reason": made.choice.reason,
        **made.shape.counts,
        **_told_sizes(made),
    }


def _told_sizes(made: _Made) -> dict[str, Any]:
    if made.job.periodic:
        return box_sizes(made.shape)
    return _sizes(made.shape) if made.solid is None else made.solid.facts()


def _sizes(shape: AlphaShape) -> dict[str, Any]:
    return {"area": shape.area, "perimeter": shape.perimeter}


def _lines(made: _Made) -> dict[str, str]:
    """Return the summary for people."""
    shape = made.shape
    told = ("tetrahedra", "triangles", "singular_triangles", "singular_edges")
    counts = {
        name.replace("_", " ").capitalize(): f"{shape.counts[name]:,}"
        for name in (*told, "isolated_vertices")
        if name in shape.counts and (name != "triangles" or "tetrahedra" not in shape.counts)
    }
    if made.job.periodic:
        sizes = box_lines(shape)
    elif made.solid is not None:
        sizes = made.solid.lines()
    else:
        sizes = {"Area": area_text(shape.area), "Perimeter": length_text(shape.perimeter)}
    return {"Radius": radius_text(made.choice), "": made.choice.reason, **counts, **sizes}
