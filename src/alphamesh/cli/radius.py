"""``alphamesh radius``: which radius to take, and why."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import click

from alphamesh.cli.building import Job, cloud_options, radius_text, source_argument
from alphamesh.cli.command import Command
from alphamesh.cli.outputs import Outputs
from alphamesh.cli.periods import betti_text, class_names, periods_option
from alphamesh.cli.progress import Steps
from alphamesh.cli.summary import counted, number
from alphamesh.cli.types import AUTO, RULE_OPTIONS, BettiType, RuleName

if TYPE_CHECKING:
    from collections.abc import Sequence

    from alphamesh.radius import RadiusChoice

__all__ = ["command"]

_EXAMPLES = (
    "alphamesh radius points.csv",
    "alphamesh radius shape.png --holes 2",
    "alphamesh radius points.csv --rule regions --regions 3 --json",
)


@click.command("radius", cls=Command, examples=_EXAMPLES)
@source_argument
@click.option(
    "--rule",
    type=RuleName(),
    default=AUTO,
    show_default=True,
    help="The rule that chooses.",
)
@click.option(
    "--betti",
    type=BettiType(),
    metavar="B0,B1[,B2]",
    help="Where the shape has exactly so many components and holes; in space, components, "
    "tunnels and voids.",
)
@click.option("--components", type=click.IntRange(1), metavar="N", help="So many components.")
@click.option(
    "--holes", type=click.IntRange(0), metavar="N", help="So many holes; in space, tunnels."
)
@click.option("--voids", type=click.IntRange(0), metavar="N", help="So many voids in space.")
@click.option(
    "--min-hole", type=float, metavar="R", help="Holes of at least this radius count."
)
@click.option(
    "--surface/--solid",
    default=None,
    help="Points in space lie on a surface, or fill a solid.  [default: found out]",
)
@click.option("--regions", type=click.IntRange(1), metavar="N", help="At most N regions.")
@click.option("--triangles", type=click.IntRange(1), metavar="N", help="At least N triangles.")
@click.option("--tetrahedra", type=click.IntRange(1), metavar="N", help="So many in space.")
@periods_option
@cloud_options
def command(source: str, rule: str, **options: Any) -> None:
    """Choose a radius for a cloud, and say why.

    INPUT is a mask image, a file of points, "-" for a table on standard input,
    or demo:NAME for a built-in shape. The options --betti, --components,
    --holes, --voids, --min-hole and --surface are those of the rule topology,
    --regions, --triangles and --tetrahedra those of the rules regions,
    triangle-count and, in space, tetrahedron-count.
    """
    wanted = {name: options.pop(name) for name in RULE_OPTIONS}
    wanted = {name: value for name, value in wanted.items() if value is not None}
    with Steps(quiet=options["quiet"]) as steps:
        job = Job.begin(source, options, steps, space=True)
        with steps.step("Choosing the radius"):
            choice = job.complex.choose_radius(None if rule == AUTO else rule, **wanted)
    facts, lines = _told(choice, class_names(job.complex))
    job.tell(facts, lines, Outputs())


def _told(
    choice: RadiusChoice, names: Sequence[tuple[str, str]]
) -> tuple[dict[str, Any], dict[str, str]]:
    facts = {
        "radius": choice.radius,
        "rule": choice.rule,
        "reason": choice.reason,
        "interval": choice.interval,
        "betti": choice.betti,
        "confidence": choice.confidence,
        "clear": choice.clear,
        "strays": choice.strays,
        "runners_up": [
            {"low": other.low, "high": other.high, "betti": other.betti}
            for other in choice.runners_up
        ],
    }
    lines = {"Radius": radius_text(choice), "": choice.reason}
    if choice.interval is not None:
        lines["Interval"] = _range_text(*choice.interval)
    if choice.betti is not None:
        lines["Shape"] = betti_text(choice.betti, names)
        if choice.strays:
            lines["Shape"] += f", beside {counted(choice.strays, 'stray piece')}"
    if choice.confidence is not None:
        lines["Confidence"] = f"{choice.confidence:.2f}{'' if choice.clear else ', not clear'}"
    if choice.runners_up:
        others = (
            f"{_range_text(other.low, other.high)}: {betti_text(other.betti, names)}"
            for other in choice.runners_up
        )
        lines["Or else"] = "\n".join(others)
    return facts, lines


def _range_text(low: float, high: float) -> str:
    return f"{number(low)} {'and more' if math.isinf(high) else f'to {number(high)}'}"
