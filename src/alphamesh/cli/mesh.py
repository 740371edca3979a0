"""``alphamesh mesh``: from an image or points to a mesh."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from alphamesh.cli.command import Command, json_option, quiet_option, threads_option
from alphamesh.cli.inputs import Input, InputOptions, load, sampling_options, table_options
from alphamesh.cli.outputs import Output, Outputs, check_targets, write_bytes
from alphamesh.cli.progress import Steps
from alphamesh.cli.summary import (
    counted,
    number,
    points_text,
    print_json,
    print_lines,
    size_text,
)
from alphamesh.cli.types import AUTO, FigureFile, MeshFile, RadiusType

if TYPE_CHECKING:
    from alphamesh.complex import AlphaComplex
    from alphamesh.radius import RadiusChoice
    from alphamesh.shape import AlphaShape

__all__ = ["command"]

_EXAMPLES = (
    "alphamesh mesh shape.png -o mesh.vtu --plot mesh.png",
    "alphamesh mesh shape.png --points 20000 --seed 7 -o mesh.ply -o mesh.stl",
    "alphamesh mesh trees.csv --columns easting,northing --radius 25 -o mesh.vtu",
    "alphamesh mesh demo:cheese -o cheese.obj",
    "alphamesh sample shape.png -o - | alphamesh mesh - --json",
)


@click.command("mesh", cls=Command, examples=_EXAMPLES)
@click.argument("source", metavar="INPUT")
@click.option(
    "-o",
    "--output",
    "meshes",
    type=MeshFile(),
    multiple=True,
    help="Write the mesh here; the extension tells the format. Can be given several times.",
)
@click.option(
    "-r",
    "--radius",
    type=RadiusType(),
    default=AUTO,
    show_default=True,
    help="Radius in the units of the points, or the rule that chooses it.",
)
@click.option(
    "--plot",
    "picture",
    type=FigureFile(),
    help="Draw cloud, Delaunay triangulation and complex side by side.",
)
@sampling_options
@table_options
@threads_option
@json_option
@quiet_option
def command(
    source: str,
    meshes: tuple[Path, ...],
    radius: float | str,
    picture: Path | None,
    **options: Any,
) -> None:
    """Make a mesh from an image or a point file.

    INPUT is a mask image (points are drawn from its white pixels), a file of
    points (CSV, TSV, TXT, XYZ, NPY, NPZ, Parquet, PLY), "-" for a table on
    standard input, or demo:NAME for a built-in shape such as demo:annulus.
    Without -o, the mesh is only described.
    """
    threads, as_json, quiet = (options.pop(name) for name in ("threads", "as_json", "quiet"))
    check_targets([*meshes, *([picture] if picture else [])], source)
    if picture:
        import alphamesh.plot  # noqa: F401 - if matplotlib is missing, say so before the work
    outputs = Outputs()
    with Steps(quiet=quiet) as steps:
        given = load(source, InputOptions(**options), steps)
        result = _build(given, radius, threads, steps)
        outputs.write(_files(result, meshes, picture), steps)
    if as_json:
        print_json(_facts(result, outputs))
    else:
        print_lines(_lines(result, outputs))
    outputs.raise_failures()


@dataclass(frozen=True, slots=True)
class _Result:
    """What the command has made."""

    given: Input
    complex: AlphaComplex
    shape: AlphaShape
    choice: RadiusChoice

    @property
    def duplicates(self) -> int:
        """Points that repeat an earlier one."""
        return len(self.complex.points) - len(self.complex.simplices[0])


def _build(given: Input, radius: float | str, threads: int | None, steps: Steps) -> _Result:
    from alphamesh.complex import AlphaComplex
    from alphamesh.radius import RadiusChoice

    with steps.step(f"Triangulating {counted(len(given.points), 'point')}") as done:
        built = AlphaComplex(given.points, threads=threads, progress=done)
    with steps.step("Choosing the radius"):
        choice = (
            built.choose_radius(radius)
            if isinstance(radius, str)
            else RadiusChoice(radius, "given", "Given on the command line.")
        )
        shape = built.at(choice.radius)
    return _Result(given, built, shape, choice)


def _files(result: _Result, meshes: tuple[Path, ...], picture: Path | None) -> list[Output]:
    files = [Output(path, result.shape.save) for path in meshes]
    if picture is not None:
        files.append(Output(picture, lambda path: _draw(result, path)))
    return files


def _draw(result: _Result, path: Path) -> None:
    from alphamesh.plot import figure_bytes, plot_overview

    figure = plot_overview(result.complex, result.choice.radius)
    write_bytes(figure_bytes(figure, path.suffix.lower().removeprefix(".")), path)


def _facts(result: _Result, outputs: Outputs) -> dict[str, Any]:
    """Return the summary for scripts."""
    shape, choice = result.shape, result.choice
    return {
        "input": result.given.facts,
        "points": len(result.complex.points),
        "duplicates": result.duplicates,
        "dimension": result.complex.dimension,
        "radius": choice.radius,
        "rule": choice.rule,
        "reason": choice.reason,
        **shape.counts,
        "area": shape.area,
        "perimeter": shape.perimeter,
        "files": [{"path": path, "bytes": size} for path, size in outputs.sizes().items()],
        "failures": outputs.failures,
    }


def _lines(result: _Result, outputs: Outputs) -> dict[str, str]:
    """Return the summary for people."""
    shape, choice = result.shape, result.choice
    counts = shape.counts
    lines = {
        "Input": result.given.text,
        "Points": points_text(len(result.complex.points), result.duplicates),
        "Radius": f"{number(choice.radius)}  ({choice.rule})",
        "": choice.reason,
        "Triangles": f"{counts['triangles']:,}",
        "Singular edges": f"{counts['singular_edges']:,}",
        "Isolated vertices": f"{counts['isolated_vertices']:,}",
        "Area": number(shape.area),
        "Perimeter": number(shape.perimeter),
    }
    written = [f"{path}  ({size_text(size)})" for path, size in outputs.sizes().items()]
    lines["Written"] = "\n".join(written) or "nothing; -o FILE writes the mesh"
    return lines
