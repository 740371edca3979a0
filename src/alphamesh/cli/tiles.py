"""``alphamesh tiles``: complexes larger than memory, tile by tile."""

from __future__ import annotations

import json
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from alphamesh.cli.command import (
    Command,
    json_option,
    quiet_option,
    threads_option,
    write_section,
)
from alphamesh.cli.outputs import Output, Outputs, check_targets, write_bytes
from alphamesh.cli.periods import betti_text, periods_facts, periods_option
from alphamesh.cli.progress import Steps
from alphamesh.cli.summary import counted, number, print_json, print_lines, size_text
from alphamesh.cli.types import AUTO
from alphamesh.cli.weights import weights_option

if TYPE_CHECKING:
    from collections.abc import Sequence

    from alphamesh.tiles import Summary, TiledComplex

__all__ = ["command"]

_EXAMPLES = (
    "alphamesh tiles run lidar/ --radius 2.5 -o tiles",
    "alphamesh tiles run points.parquet --radius auto --workers 4 -o tiles",
    "alphamesh tiles run atoms.parquet --dimension 3 --weights w --radius 0 -o tiles",
    "alphamesh tiles run lidar/ --radius 2.5 --cluster tcp://head:8786 -o tiles",
    "alphamesh tiles merge tiles -o outline.geojson",
)
_folder = click.argument("folder", type=click.Path(path_type=Path))


class _Group(click.Group):
    """A group whose help ends with examples, as that of a command."""

    def format_epilog(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """End the help with the examples."""
        write_section(formatter, "Examples", _EXAMPLES)


@click.group("tiles", cls=_Group)
def command() -> None:
    """Build a complex larger than memory, tile by tile.

    The result is that of the cloud as a whole, bit for bit: Parquet datasets of
    vertices, edges and triangles in a folder. A run that was stopped goes on
    where it was when it is started again.
    """


@command.command("run", cls=Command, examples=_EXAMPLES)
@click.argument("data")
@click.option(
    "-o", "--output", "folder", required=True, type=click.Path(path_type=Path),
    help="The folder for the result.",
)  # fmt: skip
@click.option(
    "-r", "--radius", required=True,
    help="Radius in the units of the points, or auto: chosen by topology in sampled tiles. "
    "With --weights it may be negative, and auto is 0 if some are positive.",
)  # fmt: skip
@click.option("--columns", metavar="X,Y[,Z]", help="The columns that hold the coordinates.")
@click.option("--dimension", type=click.IntRange(2, 3), help="Read so many coordinates.")
@weights_option
@periods_option
@click.option(
    "--tile-points", type=click.IntRange(1), default=500_000, show_default=True, metavar="N",
    help="About how many points a tile shall have.",
)  # fmt: skip
@click.option(
    "--workers", type=click.IntRange(1), metavar="N",
    help="Work with N processes of Dask on this machine.",
)  # fmt: skip
@click.option("--cluster", metavar="ADDRESS", help="Work on this Dask cluster.")
@threads_option
@click.option("--overwrite", is_flag=True, help="Replace another run in the folder.")
@json_option
@quiet_option
def _run(  # noqa: PLR0913, PLR0917 (one option each)
    data: str,
    folder: Path,
    radius: str,
    columns: str | None,
    dimension: int | None,
    weights: str | int | None,
    periods: tuple[float | None, ...] | None,
    tile_points: int,
    workers: int | None,
    cluster: str | None,
    threads: int | None,
    overwrite: bool,
    as_json: bool,
    quiet: bool,
) -> None:
    """Compute the complex of DATA up to a radius.

    DATA is an NPY, Parquet, LAS or LAZ file, or a folder of such files.
    """
    from alphamesh.tiles import choose_radius, dataset, run

    if sum(choice is not None for choice in (threads, workers, cluster)) > 1:
        raise click.UsageError("give one of --threads, --workers and --cluster, not several")
    with Steps(quiet=quiet) as steps:
        found = dataset(
            data, columns=columns, dimension=dimension, weights=weights, periods=periods
        )
        reason = "Given on the command line."
        if radius == AUTO:
            with steps.step("Choosing the radius"):
                choice = choose_radius(found)
            wanted, reason = choice.radius, choice.reason
        else:
            wanted = _number(radius)
        with steps.step(f"Building tiles of {counted(found.count, 'point')}") as done:
            result = run(
                found, wanted, folder, tile_points=tile_points, overwrite=overwrite,
                cluster="local" if workers else cluster, processes=workers, threads=threads,
                progress=done,
            )  # fmt: skip
    _tell(result, as_json, {"reason": reason})


def _number(radius: str) -> float:
    try:
        return float(radius)
    except ValueError:
        raise click.UsageError(f"--radius {radius!r} is neither a number nor auto") from None


@command.command("status", cls=Command)
@_folder
@json_option
def _status(folder: Path, as_json: bool) -> None:
    """Tell how far the run in FOLDER has come."""
    from alphamesh.tiles import status

    found = status(folder)
    if as_json:
        print_json(asdict(found))
        return
    tiles = "not yet divided" if found.tiles is None else f"{found.tiles_done} of {found.tiles}"
    print_lines(
        {
            "Points": f"{found.points:,}",
            "Radius": number(found.radius),
            "Chunks sorted": f"{found.chunks_done} of {found.chunks}",
            "Tiles done": tiles,
            "Finished": "yes" if found.finished else "no; run it again to go on",
        }
    )


@command.command("merge", cls=Command)
@_folder
@click.option(
    "-o", "--output", type=click.Path(path_type=Path), metavar="FILE.geojson",
    help="Write the regions of the whole as polygons.",
)  # fmt: skip
@json_option
@quiet_option
def _merge(folder: Path, output: Path | None, as_json: bool, quiet: bool) -> None:
    """Tell of the whole complex in FOLDER; write its outline."""
    from alphamesh.tiles import TiledComplex

    check_targets([output] if output else [])
    result = TiledComplex(folder)
    outputs = Outputs()
    if output is not None:
        with Steps(quiet=quiet) as steps:
            outputs.write([Output(output, lambda path: _write_polygons(result, path))], steps)
    files = [{"path": path, "bytes": size} for path, size in outputs.sizes().items()]
    _tell(result, as_json, {"files": files})
    outputs.raise_failures()


def _write_polygons(result: TiledComplex, path: Path) -> None:
    """Write a GeoJSON feature for each region, whole or not at all."""
    import shapely

    areas = result.region_sizes.tolist()
    features = [
        {"type": "Feature", "properties": {"region": k, "area": area}, "geometry": shape}
        for k, (area, shape) in enumerate(
            zip(areas, map(json.loads, shapely.to_geojson(result.polygons())), strict=True)
        )
    ]
    content = {"type": "FeatureCollection", "features": features}
    write_bytes(json.dumps(content).encode(), path)


def _shape(betti: Sequence[int | None], *, in_space: bool, periodic: bool) -> str:
    """Return how many classes of each kind there are, as far as tiles know, in words."""
    loop = "loop" if periodic else "tunnel" if in_space else "hole"
    names = [("component", "components"), (loop, f"{loop}s")]
    names += [("void", "voids")] if in_space else []
    names += [("whole box", "whole boxes")] if periodic else []
    pairs = [(k, name) for k, name in zip(betti, names, strict=True) if k is not None]
    return betti_text([k for k, _ in pairs], [name for _, name in pairs])


def _around(windings: Sequence[int]) -> str:
    """Return which components run around a periodic box, in words."""
    found = [
        f"{counted(count, 'component')} in {counted(k, 'direction')}"
        for k, count in enumerate(windings)
        if k > 0 and count > 0
    ]
    return ", ".join(found) or ("no component" if windings else "")


def _tell(result: TiledComplex, as_json: bool, more: dict[str, Any]) -> None:
    from alphamesh.tiles.store import TABLES

    facts: Summary = result.summary
    if as_json:
        numbers = asdict(facts) | {"tiles": len(result.tiling), "folder": str(result.folder)}
        print_json(numbers | periods_facts(result)[0] | more)
        return
    in_space = result.tiling.dimension == 3
    sizes = ("Volume", "Surface area") if in_space else ("Area", "Perimeter")
    lines = {
        "Folder": f"{result.folder}  ({counted(len(result.tiling), 'tile')})",
        "Points": f"{facts.points:,}",
        **periods_facts(result)[1],
        "Radius": number(facts.radius),
        "": more.get("reason", ""),
        "Complex": ", ".join(
            f"{count:,} {name}" for count, name in zip(facts.counts, TABLES, strict=False)
        ),
        "Shape": _shape(facts.betti, in_space=in_space, periodic=result.periods is not None)
        + (f", Euler number {facts.euler_characteristic:,}" if None in facts.betti else "")
        + f", {counted(facts.regions, 'region')}",
        "Around the box": _around(facts.windings or ()),
        sizes[0]: number(facts.size),
        sizes[1]: number(facts.boundary_size),
    }
    if more.get("files"):
        lines["Written"] = "\n".join(
            f"{file['path']}  ({size_text(file['bytes'])})" for file in more["files"]
        )
    print_lines({key: text for key, text in lines.items() if text})
