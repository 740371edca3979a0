"""``alphamesh measures``: how large the complex is at many radii."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click
import numpy as np

from alphamesh.cli.building import Job, cloud_options, source_argument
from alphamesh.cli.command import Command
from alphamesh.cli.files import TableFile
from alphamesh.cli.outputs import Output, Outputs, check_targets, output_options
from alphamesh.cli.progress import Steps
from alphamesh.cli.summary import number, print_table
from alphamesh.cli.tables import write_table
from alphamesh.cli.types import RadiiType

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from alphamesh.complex import AlphaComplex

__all__ = ["command"]

_EXAMPLES = (
    "alphamesh measures points.csv --radii 1,2,4,8",
    "alphamesh measures points.csv --radii log --steps 200 -o measures.csv",
)


@click.command("measures", cls=Command, examples=_EXAMPLES)
@source_argument
@output_options(TableFile(".csv"), "Write the table here", name="tables")
@click.option(
    "--radii",
    type=RadiiType(),
    metavar="R,R,...",
    default="even",
    show_default=True,
    help="List the radii, or choose them by the number of simplices (quantiles), by their "
    "size (log), or half-way between (even).",
)
@click.option(
    "--steps",
    "steps",
    type=click.IntRange(2, 1_000_000),
    metavar="N",
    default=20,
    show_default=True,
    help="How many radii, unless they are listed.",
)
@cloud_options
def command(
    source: str, tables: tuple[Path, ...], radii: Any, steps: int, **options: Any
) -> None:
    """Measure the complex at many radii: area or volume, numbers of simplices.

    INPUT is a mask image, a file of points, "-" for standard input, or demo:NAME
    for a built-in shape. The table has one line for each radius: components,
    holes, Euler characteristic, edges, triangles, their area and perimeter. In
    space: components, loops, voids, Euler characteristic, edges, triangles,
    tetrahedra, their volume and surface area.
    """
    from alphamesh.film import film_radii

    check_targets(tables, source)
    outputs = Outputs()
    with Steps(quiet=options["quiet"]) as told:
        job = Job.begin(source, options, told, space=True)
        with told.step("Measuring") as done:
            pairs = job.complex.persistence(threads=options["threads"], progress=done)
            columns = _columns(job.complex, film_radii(pairs, radii, steps))
        files = [Output(path, lambda path: write_table(path, columns)) for path in tables]
        outputs.write(files, told)
    job.tell(columns, {}, outputs)
    if not (outputs.streamed or options["as_json"]):
        rows = [[number(value) for value in row] for row in zip(*columns.values(), strict=True)]
        click.echo()
        print_table(list(columns), rows)


def _columns(built: AlphaComplex, radii: NDArray[np.float64]) -> dict[str, NDArray[Any]]:
    curves: Any = built.measure_curves()
    betti = built.persistence().betti_numbers(radii)
    columns = {
        "radius": radii,
        "components": betti[:, 0],
        "holes" if betti.shape[1] == 2 else "loops": betti[:, 1],
    }
    if betti.shape[1] == 3:
        columns["voids"] = betti[:, 2]
    columns |= {
        "euler": curves.euler_characteristic(radii),
        "edges": curves.edge_count(radii),
        "triangles": curves.triangle_count(radii),
    }
    if betti.shape[1] == 2:
        return columns | {"area": curves.area(radii), "perimeter": curves.perimeter(radii)}
    return columns | {
        "tetrahedra": curves.tetrahedron_count(radii),
        "volume": curves.volume(radii),
        "surface_area": curves.surface_area(radii),
    }
