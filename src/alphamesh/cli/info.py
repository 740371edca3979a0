"""``alphamesh info``: what is in a file."""

from __future__ import annotations

import math
from contextlib import suppress
from pathlib import PurePath
from typing import TYPE_CHECKING, Any

import click
import numpy as np

from alphamesh.cli.command import Command, json_option, quiet_option, threads_option
from alphamesh.cli.demos import demo_shape, demo_solid
from alphamesh.cli.inputs import InputOptions, load, table_options
from alphamesh.cli.kinds import DEMO, IMAGE, MESH, POINTS, holds, ply_elements
from alphamesh.cli.mesh_facts import tell_surface
from alphamesh.cli.periods import periods_facts, periods_option
from alphamesh.cli.progress import Steps
from alphamesh.cli.streams import STDIN, from_standard_input
from alphamesh.cli.summary import counted, number, points_text, print_json, print_lines
from alphamesh.cli.weights import weights_option
from alphamesh.errors import AlphameshError, ParameterError
from alphamesh.measures import edge_lengths

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from alphamesh.filtration import AnyFiltration
    from alphamesh.solids import DemoSolid

__all__ = ["command", "nearest_distances"]

_NOUNS = {
    "vertex": ("vertex", "vertices"),
    "line": ("edge", "edges"),
    "triangle": ("triangle", "triangles"),
    "tetra": ("tetrahedron", "tetrahedra"),
}
_DIMENSIONS = {
    -1: "no points",
    0: "0, all at one place",
    1: "1, all on one line",
    2: "2, all in one plane",
}

_EXAMPLES = (
    "alphamesh info points.csv",
    "alphamesh info trees.csv --columns easting,northing --json",
    "alphamesh info shape.png",
    "alphamesh info mesh.vtu",
)


@click.command("info", cls=Command, examples=_EXAMPLES)
@click.argument("source", metavar="FILE")
@table_options
@weights_option
@periods_option
@threads_option
@json_option
@quiet_option
def command(source: str, **options: Any) -> None:
    """Tell what is in a file of points, an image or a mesh.

    Of points: how many, where, how far apart, and the radius that would be
    chosen for them. FILE can be "-" for a table on standard input, or
    demo:NAME for a built-in shape.
    """
    names = ("threads", "as_json", "quiet", "periods")
    threads, as_json, quiet, periods = (options.pop(name) for name in names)
    given = InputOptions(**options)
    with Steps(quiet=quiet) as steps:
        if source == STDIN:
            with from_standard_input(given.suffix) as path:
                facts, lines = _told(str(path), given, threads, steps, periods)
            lines = {k: text.replace(str(path), "standard input") for k, text in lines.items()}
            facts["name"] = STDIN
        else:
            facts, lines = _told(source, given, threads, steps, periods)
    if as_json:
        print_json(facts)
    else:
        print_lines(lines)


Told = tuple[dict[str, Any], dict[str, str]]


def _told(
    source: str,
    given: InputOptions,
    threads: int | None,
    steps: Steps,
    periods: tuple[float | None, ...] | None,
) -> Told:
    """Tell of a demo shape or a file, whatever it holds."""
    kind = holds(source, given.file_format)
    if periods is not None:
        if kind != POINTS:
            raise ParameterError("--periods is for files of points; leave it out")
        return _periodic(source, given, threads, steps, periods)
    if kind == DEMO:
        return _demo(source)
    if kind == IMAGE:
        return _image(source, steps)
    if kind == POINTS:
        return _points(source, given, threads, steps)
    if PurePath(source).suffix.lower() == ".ply":
        return _ply(source, ply_elements(source), steps)
    return _mesh(source, steps)


def _points(source: str, options: InputOptions, threads: int | None, steps: Steps) -> Told:
    from alphamesh.filtration import filtration
    from alphamesh.radius import choose_radius

    given = load(source, options, steps)
    with steps.step(f"Triangulating {counted(len(given.points), 'point')}") as done:
        complex_ = filtration(
            given.points, weights=given.weights, threads=threads, progress=done
        )
    count, hidden = len(complex_.points), len(complex_.hidden)
    duplicates = count - len(complex_.simplices[0]) - hidden
    facts: dict[str, Any] = {
        **given.facts,
        "points": count,
        "duplicates": duplicates,
        **({} if given.weights is None else {"hidden": hidden}),
        "dimension": complex_.dimension,
    }
    lines = {
        "File": given.text,
        "Points": points_text(count, duplicates, hidden),
        "Dimension": _dimension_text(complex_),
    }
    if count:
        _tell_bounds(complex_.points, facts, lines)
        # The nearest neighbours are those of a Delaunay triangulation.
        plain = complex_ if given.weights is None else filtration(given.points, threads=threads)
        _tell_spacing(plain, facts, lines)
        choice = choose_radius(complex_)
        facts |= {"radius": choice.radius, "rule": choice.rule, "reason": choice.reason}
        lines["Suggested radius"] = f"{number(choice.radius)}  ({choice.rule})"
        lines[""] = choice.reason
    return facts, lines


def _periodic(
    source: str,
    options: InputOptions,
    threads: int | None,
    steps: Steps,
    periods: tuple[float | None, ...],
) -> Told:
    from alphamesh.periodic import choose_periodic_radius, periodic_filtration

    given = load(source, options, steps)
    with steps.step(f"Triangulating {counted(len(given.points), 'point')}") as done:
        made = periodic_filtration(
            given.points, periods, weights=given.weights, threads=threads, progress=done
        )
    count, hidden = len(made.points), len(made.hidden)
    duplicates = count - len(made.simplices[0]) - hidden
    box, box_line = periods_facts(made)
    facts: dict[str, Any] = {
        **given.facts,
        "points": count,
        "duplicates": duplicates,
        **({} if given.weights is None else {"hidden": hidden}),
        **box,
        "simplicial": made.is_simplicial,
    }
    lines = {"File": given.text, "Points": points_text(count, duplicates, hidden), **box_line}
    if not made.is_simplicial:
        lines["Simplices"] = "some meet themselves: few points for the box"
    if count:
        _tell_bounds(made.points, facts, lines)
        choice = choose_periodic_radius(made)
        facts |= {"radius": choice.radius, "rule": choice.rule, "reason": choice.reason}
        lines["Suggested radius"] = f"{number(choice.radius)}  ({choice.rule})"
        lines[""] = choice.reason
    return facts, lines


def _dimension_text(filtration: AnyFiltration) -> str:
    dimension = filtration.dimension
    full = dimension == filtration.points.shape[1]
    return str(dimension) if full else _DIMENSIONS[dimension]


def _tell_bounds(
    points: NDArray[np.float64], facts: dict[str, Any], lines: dict[str, str]
) -> None:
    low, high = points.min(axis=0), points.max(axis=0)
    facts["bounds"] = [low, high]
    for axis, name in zip(range(len(low)), "xyz", strict=False):
        lines[name] = f"{number(low[axis])} to {number(high[axis])}"


def _tell_spacing(
    complex_: AnyFiltration, facts: dict[str, Any], lines: dict[str, str]
) -> None:
    nearest = nearest_distances(complex_)
    if len(nearest) == 0:
        return
    low, middle, high = (float(np.quantile(nearest, share)) for share in (0, 0.5, 1))
    facts["spacing"] = {"smallest": low, "median": middle, "largest": high}
    lines["Spacing"] = (
        f"{number(middle)} to the nearest neighbour (median; {number(low)} to {number(high)})"
    )


def nearest_distances(filtration: AnyFiltration) -> NDArray[np.float64]:
    """Return the distance from each distinct point to the nearest other one.

    The nearest neighbour of a point is among its neighbours in the Delaunay
    triangulation, so the edges suffice.

    Parameters
    ----------
    filtration : Filtration or Filtration3D

    Returns
    -------
    (m,) float64 array
        In the order of the vertices; empty for fewer than two distinct points.
    """
    vertices, edges = filtration.simplices[:2]
    if len(edges) == 0:
        return np.empty(0)
    lengths = edge_lengths(filtration.points, edges)
    nearest = np.full(len(filtration.points), math.inf)
    for side in (0, 1):
        np.minimum.at(nearest, edges[:, side], lengths)
    return nearest[vertices[:, 0]]


def _demo(source: str) -> Told:
    found = demo_solid(source)
    if found is not None:
        return _solid(source, *found)
    shape = demo_shape(source)
    components, holes = shape.betti
    facts = {
        "kind": DEMO,
        "name": source,
        "description": shape.description,
        "components": components,
        "holes": holes,
    }
    topology = f"{counted(components, 'component')}, {counted(holes, 'hole')}"
    return facts, {"Demo shape": f"{shape.name}: {shape.description}", "Topology": topology}


def _solid(source: str, solid: DemoSolid, of_surface: bool) -> Told:
    components, loops, voids = solid.betti
    facts = {
        "kind": DEMO,
        "name": source,
        "description": solid.description,
        "components": components,
        "loops": loops,
        "voids": voids,
        "genera": solid.genera,
    }
    parts = (components, "component"), (loops, "loop"), (voids, "void")
    what = "Surface of demo solid" if of_surface else "Demo solid"
    return facts, {
        what: f"{solid.name}: {solid.description}",
        "Topology": ", ".join(counted(count, noun) for count, noun in parts),
        "Genus": ", ".join(map(str, solid.genera)),
        "Next": f"alphamesh mesh {source} -o mesh.stl",
    }


def _image(source: str, steps: Steps) -> Told:
    from alphamesh.io.images import read_mask

    with steps.step(f"Reading {source}"):
        mask = read_mask(source)
    height, width = mask.shape
    inside = int(np.count_nonzero(mask))
    facts = {
        "kind": IMAGE,
        "name": source,
        "width": width,
        "height": height,
        "pixels_inside": inside,
    }
    return facts, {
        "File": f"{source} (image)",
        "Size": f"{width} x {height} pixels",
        "Inside": f"{counted(inside, 'pixel')} brighter than 0.5 ({inside / mask.size:.1%})",
        "Next": f"alphamesh mesh {source} -o mesh.vtu",
    }


def _mesh(source: str, steps: Steps) -> Told:
    from alphamesh.io.meshes import mesh_format, read_mesh

    with steps.step(f"Reading {source}"):
        mesh = read_mesh(source)
    cells = {kind: len(rows) for kind, rows in mesh.cells.items() if len(rows)}
    facts: dict[str, Any] = {
        "kind": MESH,
        "name": source,
        "format": mesh_format(source).name,
        "points": len(mesh.points),
        "cells": cells,
        "point_data": list(mesh.point_data),
        "cell_data": list(mesh.cell_data),
    }
    lines = {
        "File": f"{source} ({facts['format']} mesh)",
        "Points": f"{len(mesh.points):,}",
        "Cells": ", ".join(counted(count, *_NOUNS[kind]) for kind, count in cells.items())
        or "none",
    }
    if len(mesh.points):
        _tell_bounds(mesh.points, facts, lines)
    if "tetra" not in cells:
        tell_surface(mesh.points, mesh.cells.get("triangle"), facts, lines)
    for label, data in (("Point data", mesh.point_data), ("Cell data", mesh.cell_data)):
        if data:
            lines[label] = ", ".join(data)
    return facts, lines


def _ply(source: str, counts: dict[str, int], steps: Steps) -> Told:
    """Tell what a PLY file holds; its elements are more than most readers know."""
    from alphamesh.io.meshes import read_mesh
    from alphamesh.io.points import read_points

    triangles = None
    with steps.step(f"Reading {source}"):
        points = read_points(source, dimension=3)
        with suppress(AlphameshError):  # faces of four corners, for instance
            triangles = read_mesh(source).cells.get("triangle")
    facts: dict[str, Any] = {
        "kind": MESH,
        "name": source,
        "format": "PLY",
        "points": len(points),
        "cells": {name: count for name, count in counts.items() if name != "vertex"},
    }
    cells = ", ".join(counted(count, name) for name, count in facts["cells"].items())
    lines = {
        "File": f"{source} (PLY mesh)",
        "Points": f"{len(points):,}",
        "Elements": cells,
    }
    if len(points):
        _tell_bounds(points, facts, lines)
    tell_surface(points, triangles, facts, lines)
    return facts, lines
