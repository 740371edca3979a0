"""The shape at one radius, without what is too small: for commands that tell of regions."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, TypeVar

import click

from alphamesh.cli.building import Job, radius_option
from alphamesh.cli.progress import Steps
from alphamesh.cli.solids import refuse_solid_options, solid_at, void_options

if TYPE_CHECKING:
    from alphamesh.planar import PlanarShape
    from alphamesh.radius import RadiusChoice
    from alphamesh.solid import SolidShape

__all__ = ["any_shape_at", "any_shape_options", "shape_at", "shape_options"]

Function = TypeVar("Function", bound=Callable[..., Any])

_OPTIONS = (
    radius_option,
    click.option(
        "--fill-holes",
        type=click.FloatRange(0),
        metavar="AREA",
        help="Fill holes of at most this area (inf: all), before all else.  [default: none]",
    ),
    click.option(
        "--min-area",
        type=click.FloatRange(0),
        metavar="AREA",
        help="Drop regions of a smaller area.  [default: none]",
    ),
    click.option(
        "--largest",
        type=click.IntRange(0),
        metavar="N",
        help="Keep the largest N regions.  [default: all]",
    ),
)


def shape_options(command: Function) -> Function:
    """Add the options that `shape_at` understands."""
    for option in reversed(_OPTIONS):
        command = option(command)
    return command


def shape_at(
    job: Job, options: dict[str, Any], steps: Steps
) -> tuple[RadiusChoice, PlanarShape]:
    """Return the radius that `options` ask for, and the shape there."""
    job.need_plane()
    choice = job.choose(options["radius"], steps)
    fill, least, most = (options[name] for name in ("fill_holes", "min_area", "largest"))
    with steps.step("Finding regions"):
        shape: PlanarShape = job.complex.at(choice.radius)
        if fill is not None or least is not None or most is not None:
            shape = shape.filtered(
                max_hole_area=fill or 0.0, min_region_area=least or 0.0, keep_largest=most
            )
        len(shape.regions)
    return choice, shape


def any_shape_options(command: Function) -> Function:
    """Add the options that `any_shape_at` understands."""
    return shape_options(void_options(command))


def any_shape_at(
    job: Job, options: dict[str, Any], steps: Steps
) -> tuple[RadiusChoice, PlanarShape | SolidShape]:
    """Return the radius that `options` ask for, and the shape there, in plane or space."""
    if job.complex.points.shape[1] == 2:
        refuse_solid_options(options, "points in the plane", but=("largest",))
        return shape_at(job, options, steps)
    for name, flag in (("fill_holes", "--fill-holes"), ("min_area", "--min-area")):
        if options[name] is not None:
            raise click.UsageError(
                f"{flag} is for points in the plane, and these are in space: take "
                "--fill-voids or --min-volume"
            )
    choice, solid = solid_at(job, options, steps)
    return choice, solid.shape
