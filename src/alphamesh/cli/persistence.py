"""``alphamesh persistence``: when components, holes and voids come and go."""

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
    radius_option,
    save_figure,
    source_argument,
)
from alphamesh.cli.command import Command
from alphamesh.cli.files import TableFile
from alphamesh.cli.outputs import Output, Outputs, check_targets, output_options
from alphamesh.cli.periods import periods_option
from alphamesh.cli.progress import Steps
from alphamesh.cli.summary import length_text, number
from alphamesh.cli.tables import write_table
from alphamesh.cli.types import Rule

if TYPE_CHECKING:
    from alphamesh.persistence import Persistence

__all__ = ["command"]

# How many of the holes, loops and voids that last longest are told.
_TOLD = 5

_EXAMPLES = (
    "alphamesh persistence points.csv -o pairs.csv",
    "alphamesh persistence shape.png --plot diagram.png --plot-as barcode",
    "alphamesh persistence demo:cheese --json",
)


@click.command("persistence", cls=Command, examples=_EXAMPLES)
@source_argument
@output_options(
    TableFile(".csv"), "Write dimension, birth and death of every class here", name="tables"
)
@click.option("--squared", is_flag=True, help="Write squared radii, the values of GUDHI.")
@plot_option("Draw the classes.")
@click.option(
    "--plot-as",
    "view",
    type=click.Choice(["diagram", "barcode", "betti"]),
    default="diagram",
    show_default=True,
    help="Death against birth, bars, or how many there are at each radius.",
)
@radius_option
@periods_option
@cloud_options
def command(
    source: str,
    tables: tuple[Path, ...],
    squared: bool,
    picture: Path | None,
    radius: float | Rule,
    **options: Any,
) -> None:
    """Tell at which radii components and holes of the complex come and go.

    In space, these are components, loops and voids.

    INPUT is a mask image, a file of points, "-" for a table on standard input,
    or demo:NAME for a built-in shape. The radius, chosen unless given, is only
    marked in the picture.
    """
    check_targets([*tables, *([picture] if picture else [])], source)
    need_matplotlib(picture is not None)
    outputs = Outputs()
    with Steps(quiet=options["quiet"]) as steps:
        job = Job.begin(source, options, steps, space=True)
        with steps.step("Pairing simplices") as done:
            pairs = job.complex.persistence(threads=options["threads"], progress=done)
        files = [Output(path, lambda path: _write(pairs, squared, path)) for path in tables]
        if picture is not None:
            marked = job.choose(radius, steps).radius

            def draw(path: Path) -> None:
                from alphamesh.cli.plot import figure_of

                save_figure(figure_of(options["view"], job.complex, marked), path)

            files.append(Output(picture, draw))
        outputs.write(files, steps)
    facts, lines = _told(pairs, job)
    job.tell(facts, lines, outputs)


def _told(pairs: Persistence, job: Job) -> tuple[dict[str, Any], dict[str, str]]:
    components, *others = pairs.diagrams()
    finite = components[np.isfinite(components[:, 1]), 1]
    joined = float(finite.max(initial=0.0))
    facts: dict[str, Any] = {"components": len(components), "connected_from": joined}
    lines = {"Components": f"{len(components):,}, all joined at radius {length_text(joined)}"}
    plane = job.complex.points.shape[1] == 2
    periodic = getattr(job.complex, "periods", None) is not None
    names = ("loops" if periodic else "holes",) if plane else ("loops", "voids")
    # Of a torus, a class of its own dimension is left over: it comes last, and stays.
    for name, rows in zip(names, others, strict=not periodic):
        by_length = np.argsort(rows[:, 0] - rows[:, 1], kind="stable")
        longest = rows[by_length[:_TOLD]]
        bars = [f"{number(birth)} to {length_text(death)}" for birth, death in longest]
        facts |= {name: len(rows), f"longest_{name}": longest}
        staying = int(np.isinf(rows[:, 1]).sum())
        lines[name.capitalize()] = f"{len(rows) - staying:,} that come and go" + (
            f", {staying} that stay" if staying else ""
        )
        lines[f"Longest {name}"] = "\n".join(bars) or "none"
    return facts, lines


def _write(pairs: Persistence, squared: bool, path: Path) -> None:
    diagrams = pairs.diagrams(squared=squared)
    rows = np.concatenate(diagrams)
    dimension = np.repeat(np.arange(len(diagrams)), [len(diagram) for diagram in diagrams])
    columns = {"dimension": dimension, "birth": rows[:, 0], "death": rows[:, 1]}
    arrays = {f"dimension_{k}": diagram for k, diagram in enumerate(diagrams)}
    write_table(path, columns, arrays)
