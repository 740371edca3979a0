"""``alphamesh betti``: how many components and holes there are at each radius."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from alphamesh.cli.building import (
    Job,
    cloud_options,
    need_matplotlib,
    plot_option,
    radius_option,
    radius_text,
    save_figure,
    source_argument,
)
from alphamesh.cli.command import Command
from alphamesh.cli.files import TableFile
from alphamesh.cli.outputs import Output, Outputs, check_targets, output_options
from alphamesh.cli.periods import betti_text, class_names, periods_option
from alphamesh.cli.progress import Steps
from alphamesh.cli.summary import counted
from alphamesh.cli.tables import write_table
from alphamesh.cli.types import Rule

__all__ = ["command"]

_EXAMPLES = (
    "alphamesh betti points.csv -o betti.csv --plot betti.png",
    "alphamesh betti demo:cheese --radius 8 --json",
    "alphamesh sample demo:target -o - | alphamesh betti - -o - | head",
    "alphamesh betti atoms.csv --periods 10,10,10 -o betti.csv",
)


@click.command("betti", cls=Command, examples=_EXAMPLES)
@source_argument
@output_options(TableFile(".csv"), "Write the curve here", name="tables")
@plot_option("Draw the curve.")
@radius_option
@periods_option
@cloud_options
def command(
    source: str,
    tables: tuple[Path, ...],
    picture: Path | None,
    radius: float | Rule,
    **options: Any,
) -> None:
    """Count components and holes at every radius; in space, tunnels and voids.

    INPUT is a mask image, a file of points, "-" for standard input, or demo:NAME
    for a built-in shape. The curve is exact: b0 components and b1 holes from each
    radius up to the next. What is told are the numbers at one radius, chosen
    unless given, which the picture marks.
    """
    check_targets([*tables, *([picture] if picture else [])], source)
    need_matplotlib(picture is not None)
    outputs = Outputs()
    with Steps(quiet=options["quiet"]) as steps:
        job = Job.begin(source, options, steps, space=True)
        with steps.step("Pairing simplices") as done:
            pairs = job.complex.persistence(threads=options["threads"], progress=done)
        radii, numbers = pairs.betti_curve()
        columns = {"radius": radii} | {f"b{k}": row for k, row in enumerate(numbers.T)}
        choice = job.choose(radius, steps)
        files = [Output(path, lambda path: write_table(path, columns)) for path in tables]
        if picture is not None:

            def draw(path: Path) -> None:
                from alphamesh.cli.plot import figure_of

                save_figure(figure_of("betti", job.complex, choice.radius), path)

            files.append(Output(picture, draw))
        outputs.write(files, steps)
    found = pairs.betti_numbers(choice.radius).tolist()
    names = class_names(job.complex)
    facts = {
        "radius": choice.radius,
        "rule": choice.rule,
        **{
            plural.replace(" ", "_"): count
            for (_, plural), count in zip(names, found, strict=True)
        },
        "steps": len(radii),
    }
    lines = {
        "Radius": radius_text(choice),
        "Betti numbers": betti_text(found, names),
        "Curve": counted(len(radii), "step"),
    }
    job.tell(facts, lines, outputs)
