"""``alphamesh delaunay``: the triangulation of a cloud, convex or carved by a frame."""

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
from alphamesh.cli.files import MeshFile
from alphamesh.cli.outputs import Output, Outputs, check_targets, output_options
from alphamesh.cli.progress import Steps
from alphamesh.cli.summary import area_text
from alphamesh.cli.whole import SpatialDelaunay

if TYPE_CHECKING:
    from alphamesh.delaunay import Delaunay
    from alphamesh.frame import FramedDelaunay

__all__ = ["command"]

# Those of alphamesh.frame.FRAME_SHAPES, known before it is loaded.
_FRAMES = ("box", "circle", "hull")

_EXAMPLES = (
    "alphamesh delaunay points.csv -o mesh.vtu",
    "alphamesh delaunay points.csv --frame hull --spacing 0.5 -o mesh.ply --plot mesh.png",
    "alphamesh delaunay scan.ply -o tetrahedra.vtu",
    "alphamesh delaunay demo:eight --frame box --plot frame.png",
)


@click.command("delaunay", cls=Command, examples=_EXAMPLES)
@source_argument
@output_options(MeshFile(".ply"), "Write the triangles or tetrahedra here", name="meshes")
@click.option(
    "--frame",
    "shape",
    type=click.Choice(_FRAMES),
    help="Put a frame of points around the cloud and drop the triangles that touch it.",
)
@click.option(
    "--margin", type=float, metavar="D", help="Distance of the frame.  [default: as points]"
)
@click.option(
    "--spacing",
    type=float,
    metavar="D",
    help="Distance of points on the frame.  [default: as points]",
)
@plot_option("Draw the triangulation.")
@cloud_options
def command(
    source: str,
    meshes: tuple[Path, ...],
    shape: str | None,
    picture: Path | None,
    **options: Any,
) -> None:
    """Triangulate a cloud.

    INPUT is a mask image, a file of points, "-" for a table on standard input,
    or demo:NAME for a built-in shape. The triangulation fills the convex hull;
    with --frame it gives way where points of the frame come close. Points with a
    third coordinate, a column z, are in space and give tetrahedra.
    """
    margin, spacing = options["margin"], options["spacing"]
    if shape is None and (margin is not None or spacing is not None):
        raise click.UsageError("--margin and --spacing are those of a frame: add --frame box")
    check_targets([*meshes, *([picture] if picture else [])], source)
    need_matplotlib(picture is not None)
    outputs = Outputs()
    with Steps(quiet=options["quiet"]) as steps:
        job = Job.begin(source, options, steps, space=True)
        with steps.step("Finding neighbours"):
            made = _made(job, shape, margin, spacing)
        files = [Output(path, made.save, ".ply") for path in meshes]
        if picture is not None:
            files.append(Output(picture, made.draw))
        outputs.write(files, steps)
    job.tell(*made.told(), outputs)


def _made(
    job: Job, shape: str | None, margin: float | None, spacing: float | None
) -> PlaneDelaunay | SpatialDelaunay:
    if job.complex.points.shape[1] == 3:
        if shape is not None:
            raise click.UsageError("--frame is for points in the plane; try alphamesh mesh")
        return SpatialDelaunay(job)
    if shape is None:
        return PlaneDelaunay(job.complex.delaunay)
    from alphamesh.frame import Frame, framed_delaunay

    return PlaneDelaunay(framed_delaunay(job.complex.points, Frame(shape, margin, spacing)))


class PlaneDelaunay:
    """A triangulation in the plane, and how to tell of it, write it and draw it."""

    def __init__(self, made: Delaunay | FramedDelaunay) -> None:
        self._made = made

    def save(self, path: Path) -> None:
        """Write its triangles, or, for points on a line, its edges."""
        _write(self._made, path)

    def draw(self, path: Path) -> None:
        """Draw it, with its frame."""
        _draw(self._made, path)

    def told(self) -> tuple[dict[str, Any], dict[str, str]]:
        """Return the summary for scripts and that for people."""
        return _told(self._made)


def _told(made: Delaunay | FramedDelaunay) -> tuple[dict[str, Any], dict[str, str]]:
    from alphamesh.frame import FramedDelaunay
    from alphamesh.measures import triangle_areas

    area = float(triangle_areas(made.points, made.triangles).sum())
    hull_edges = int(np.count_nonzero(made.neighbors < 0))
    facts: dict[str, Any] = {
        "triangles": len(made.triangles),
        "edges": len(made.edges),
        "boundary_edges": hull_edges,
        "area": area,
    }
    lines = {
        "Triangles": f"{len(made.triangles):,}",
        "Edges": f"{len(made.edges):,}, {hull_edges:,} of them on the boundary",
        "Area": area_text(area),
    }
    if isinstance(made, FramedDelaunay):
        facts |= {
            "frame": made.frame.shape,
            "frame_points": len(made.frame_points),
            "dropped": len(made.full.triangles) - len(made.triangles),
        }
        lines["Frame"] = f"{made.frame.shape}, {len(made.frame_points):,} points"
    return facts, lines


def _write(made: Delaunay | FramedDelaunay, path: Path) -> None:
    from alphamesh.io.meshes import Mesh, write_mesh

    cells: dict[str, Any] = {"triangle": made.triangles}
    path_edges = getattr(made, "path", None)
    if path_edges is not None and len(path_edges):
        cells["line"] = path_edges
    write_mesh(Mesh(made.points, cells), path)


def _draw(made: Delaunay | FramedDelaunay, path: Path) -> None:
    from alphamesh.frame import FramedDelaunay
    from alphamesh.plot import plot_delaunay, plot_frame

    framed = isinstance(made, FramedDelaunay)
    drawing = plot_frame(made) if framed else plot_delaunay(made)  # type: ignore[arg-type]
    save_figure(drawing.figure, path)
