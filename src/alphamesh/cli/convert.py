"""``alphamesh convert``: points or meshes from one format into another."""

from __future__ import annotations

import warnings
from functools import partial
from pathlib import Path, PurePath
from typing import TYPE_CHECKING, Any

import click
import numpy as np

from alphamesh.cli.batch import batch_options, run_batch
from alphamesh.cli.command import (
    Command,
    json_option,
    overwrite_option,
    quiet_option,
)
from alphamesh.cli.files import STREAM, ConvertedFile, FormatType
from alphamesh.cli.inputs import Input, InputOptions, table_options
from alphamesh.cli.kinds import MESH, POINTS, holds
from alphamesh.cli.outputs import Output, Outputs, check_targets
from alphamesh.cli.progress import Steps
from alphamesh.cli.streams import STDIN, from_standard_input
from alphamesh.cli.summary import counted, print_json, print_lines, size_text
from alphamesh.cli.tables import write_table
from alphamesh.cli.types import SourceType
from alphamesh.cli.write_points import POINT_WRITERS, write_points
from alphamesh.errors import FileReadError, LossyFormatWarning

if TYPE_CHECKING:
    from alphamesh.io.meshes import Mesh
    from alphamesh.table import PointTable

__all__ = ["command"]

_FILE = ConvertedFile(".csv")

GEOMETRIES = "geometries"

# Files of points that hold other columns, besides those of a GIS.
_WITH_COLUMNS = (".csv", ".tsv", ".parquet")

# Files of points whose columns have no names.
_NAMELESS = (".npy", ".npz", ".xyz")

_EXAMPLES = (
    "alphamesh convert points.csv points.parquet",
    "alphamesh convert trees.csv trees.gpkg --columns easting,northing",
    "alphamesh convert mesh.vtu mesh.stl",
    "alphamesh convert mesh.ply corners.csv",
    "alphamesh convert *.ply --output-dir vtu --to vtu --keep-going",
    "alphamesh mesh points.csv -o - | alphamesh convert - mesh.off",
)


@click.command("convert", cls=Command, examples=_EXAMPLES)
@click.argument("names", metavar="INPUT... OUTPUT", nargs=-1, required=True, type=SourceType())
@click.option(
    "--to",
    "--format",
    "to",
    type=FormatType(_FILE),
    metavar="FORMAT",
    help='Format of OUTPUT, if it is "-", or of the files in --output-dir.',
)
@click.option(
    "--crs",
    metavar="NAME",
    help="The reference system of the points, such as EPSG:25832.  [default: that of INPUT]",
)
@batch_options
@table_options
@overwrite_option
@json_option
@quiet_option
def command(names: tuple[str, ...], to: str | None, **options: Any) -> None:
    """Convert points or a mesh into another format.

    INPUT and OUTPUT are files whose extensions tell their formats, or "-". A file
    of points becomes another one, with its other columns where the format holds
    them; so does a mesh, or its vertices become points; so does a file of a GIS.
    What the new format cannot hold is named in a warning. With --output-dir,
    every name is that of an INPUT.
    """
    ctx = click.get_current_context()
    if options["folder"] is not None:
        if to is None:
            raise click.UsageError("--output-dir needs --to: the format of the files there")
        run_batch(partial(_convert, options=options), names, to, _COLUMNS, options)
        return
    if len(names) != 2:
        raise click.UsageError(
            "give one INPUT and one OUTPUT, or --output-dir DIR with --to FORMAT for many"
        )
    source, target = names[0], _FILE.convert(names[1], None, ctx)
    if target == STREAM and to is None:
        raise click.UsageError("OUTPUT is -: tell its format with --to")
    if target != STREAM and to is not None:
        raise click.UsageError(
            "--to is for standard output and --output-dir; the extension of OUTPUT tells "
            "its format"
        )
    ctx.meta["alphamesh.to"] = to
    check_targets([target], source)
    outputs = Outputs()
    facts: dict[str, Any] = {}
    with Steps(quiet=options["quiet"]) as steps:
        outputs.write(
            [Output(target, lambda path: facts.update(_convert(source, path, options)))], steps
        )
    _tell(source, facts, outputs, as_json=options["as_json"])


# What the summary of many files shows.
_COLUMNS = ("points", "cells")


def _tell(source: str, facts: dict[str, Any], outputs: Outputs, *, as_json: bool) -> None:
    sizes = outputs.sizes()
    if as_json:
        files = [{"path": path, "bytes": size} for path, size in sizes.items()]
        print_json({"input": source, **facts, "files": files, "failures": outputs.failures})
    elif sizes:
        ((path, size),) = sizes.items()
        name = "standard input" if source == STDIN else source
        print_lines(
            {"Input": name, "Holds": _held(facts), "Written": f"{path}  ({size_text(size)})"}
        )
    outputs.raise_failures()


def _held(facts: dict[str, Any]) -> str:
    if facts["kind"] == GEOMETRIES:
        return counted(facts["points"], "geometry", "geometries")
    held = counted(facts["points"], "point")
    return held + (f", {counted(facts['cells'], 'cell')}" if facts["kind"] == MESH else "")


def _convert(source: str, path: Path, options: dict[str, Any]) -> dict[str, Any]:
    """Write at `path` what `source` holds, and warn of what is lost."""
    if source != STDIN:
        return _convert_file(source, path, options)
    with from_standard_input(
        InputOptions(file_format=options["file_format"]).suffix
    ) as spooled:
        return _convert_file(str(spooled), path, options)


def _convert_file(source: str, path: Path, options: dict[str, Any]) -> dict[str, Any]:
    from alphamesh.io.geo import GEO_FORMATS

    kind = holds(source, options["file_format"])
    target, suffix = path.suffix.lower(), PurePath(source).suffix.lower()
    both_geo = suffix in GEO_FORMATS and target in GEO_FORMATS
    if kind == MESH:
        return _convert_mesh(source, path)
    if kind != POINTS:
        raise FileReadError(
            f"{source} holds neither points nor a mesh; draw points from an image with "
            "alphamesh sample"
        )
    if both_geo and not {suffix, target} <= set(POINT_WRITERS):
        return _convert_frame(source, path, options)
    if target not in POINT_WRITERS and target not in GEO_FORMATS:
        raise FileReadError(
            f"{source} holds points without a mesh, and {path.suffix} is for meshes; make "
            f"one with: alphamesh mesh {source} -o {path.name}"
        )
    return _convert_points(source, path, options)


def _convert_frame(source: str, path: Path, options: dict[str, Any]) -> dict[str, Any]:
    """Convert geometries of any kind, columns and reference system and all."""
    from alphamesh.io.geo import read_geo, write_geo

    frame = read_geo(source, layer=options["layer"])
    write_geo(frame, path)
    return {"kind": GEOMETRIES, "points": len(frame), "cells": 0}


def _convert_points(source: str, path: Path, options: dict[str, Any]) -> dict[str, Any]:
    from alphamesh.io.geo import GEO_FORMATS, write_geo

    given = {name: options[name] for name in InputOptions.table_names()}
    table = _read(source, InputOptions(**given))
    if options["crs"] is not None:
        placed = Input(table.points, source, {}, table).placed(options["crs"])
        table = placed.table or table
    table = _in_space(table, flat=PurePath(source).suffix.lower() == ".ply")
    suffix = path.suffix.lower()
    if suffix in GEO_FORMATS and not (suffix in POINT_WRITERS and table.crs is None):
        write_geo(table, path)
    elif suffix in _WITH_COLUMNS:
        write_table(path, _columns_of(table))
    else:
        if table.columns:
            warnings.warn(
                f"{path}: holds coordinates alone, left out: {', '.join(table.columns)}; "
                f"these formats hold them: {', '.join((*_WITH_COLUMNS, '.gpkg'))}",
                LossyFormatWarning,
                stacklevel=2,
            )
        write_points(table.points, path)
    if table.crs is not None and suffix not in GEO_FORMATS:
        warnings.warn(
            f"{path}: the reference system is not kept ({table.crs.name})",
            LossyFormatWarning,
            stacklevel=2,
        )
    return {"kind": POINTS, "points": len(table), "cells": 0}


def _read(source: str, options: InputOptions) -> PointTable:
    """Return points; where columns have no names, a third one is z."""
    from alphamesh.io.points import read_table

    given = options.table()
    suffix = options.suffix or PurePath(source).suffix.lower()
    if suffix in _NAMELESS and options.columns is None:
        try:
            return read_table(source, **given, dimension=3)
        except FileReadError:
            pass  # two columns, or a fault that reading two will tell
    return read_table(source, **given)


def _in_space(table: PointTable, *, flat: bool) -> PointTable:
    """Return points with their column z as a coordinate; if `flat`, not if it is all 0."""
    z = table.columns.get("z")
    if z is None or z.dtype.kind not in "iuf" or table.points.shape[1] == 3:
        return table
    others = {name: values for name, values in table.columns.items() if name != "z"}
    points = table.points if flat and not z.any() else np.column_stack((table.points, z))
    return type(table)(points, others, table.crs)


def _columns_of(table: PointTable) -> dict[str, Any]:
    """Return the coordinates and the other columns; one with the name of an axis comes last."""
    axes = dict(zip("xyz", table.points.T, strict=False))
    others = {f"{name}_2" if name in axes else name: v for name, v in table.columns.items()}
    return axes | others


def _convert_mesh(source: str, path: Path) -> dict[str, Any]:
    from alphamesh.io.meshes import MESH_FORMATS, read_mesh, write_mesh

    mesh = read_mesh(source)
    for loss in _unread(source):
        warnings.warn(f"{source}: {loss}", LossyFormatWarning, stacklevel=2)
    cells = {kind: len(rows) for kind, rows in mesh.cells.items() if len(rows)}
    if path.suffix.lower() in MESH_FORMATS:
        for loss in _lost_numbers(mesh, path):
            warnings.warn(f"{path}: {loss}", LossyFormatWarning, stacklevel=2)
        write_mesh(mesh, path, keep_all=True)
    else:
        count = counted(sum(cells.values()), "cell")
        warnings.warn(
            f"{path}: a file of points holds the vertices alone; {count} left out",
            LossyFormatWarning,
            stacklevel=2,
        )
        write_points(_flat(mesh.points), path)
    return {"kind": MESH, "points": len(mesh.points), "cells": sum(cells.values())}


def _flat(points: Any) -> Any:
    """Return points without z if it is 0 everywhere, as in meshes made in the plane."""
    return points[:, :2] if points.shape[1] == 3 and not np.any(points[:, 2]) else points


def _lost_numbers(mesh: Mesh, path: Path) -> list[str]:
    """Say which numbers of the mesh the format of `path` does not hold."""
    from alphamesh.io.meshes import MESH_FORMATS, mesh_format

    chosen = mesh_format(path)
    losses = []
    for what, data, held in (
        ("point", mesh.point_data, chosen.point_data),
        ("cell", mesh.cell_data, chosen.cell_data),
    ):
        if data and not held:
            keep = [
                suffix
                for suffix, known in MESH_FORMATS.items()
                if getattr(known, f"{what}_data")
            ]
            losses.append(
                f"{chosen.name} files cannot hold numbers of {what}s, left out: "
                f"{', '.join(data)}; these formats can: {', '.join(keep)}"
            )
    if not chosen.double and len(mesh.points):
        losses.append(f"{chosen.name} files round coordinates to 32-bit numbers")
    return losses


def _unread(source: str) -> list[str]:
    """Say which cells of a mesh file its reader passes over."""
    if PurePath(source).suffix.lower() != ".obj":
        return []
    with Path(source).open("rb") as file:
        count = sum(line[:2] in {b"l ", b"p "} for line in file)
    if count == 0:
        return []
    return [
        f"its {counted(count, 'edge or single vertex', 'edges and single vertices')} cannot "
        "be read back and are left out; write them from the points to .vtu, .vtk, .msh or .npz"
    ]
