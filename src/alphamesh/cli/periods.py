"""The option --periods: points in a box that repeats, and what there is in it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from alphamesh.cli.summary import area_text, counted, length_text, number, volume_text
from alphamesh.cli.types import ParamType

if TYPE_CHECKING:
    from collections.abc import Sequence

    from alphamesh.periodic import PeriodicShape

__all__ = [
    "betti_text",
    "box_lines",
    "box_sizes",
    "class_names",
    "periods_facts",
    "periods_option",
]


class PeriodsType(ParamType):
    """Side lengths of a box with commas between them, nothing for open directions."""

    name = "periods"

    def convert(
        self, value: Any, param: click.Parameter | None, ctx: click.Context | None
    ) -> tuple[float | None, ...]:
        """Return numbers, None for open directions."""
        from alphamesh.errors import PeriodsError
        from alphamesh.periodic import as_periods

        if isinstance(value, tuple):
            return value
        parts = str(value).split(",")
        try:
            sides = tuple(float(part) if part.strip() else None for part in parts)
            return as_periods(sides, len(sides))
        except ValueError as error:
            reason = error if isinstance(error, PeriodsError) else "not numbers"
            self.fail(f"{value!r}: {reason}; write it as 10,10,10 or 10,,10", param, ctx)


periods_option = click.option(
    "--periods",
    type=PeriodsType(),
    metavar="LX,LY[,LZ]",
    default=None,
    help="The points lie in a periodic box with sides of these lengths, in units of the "
    "points; nothing between commas for an open direction, as in 10,,10.  [default: open]",
)


def class_names(complex_: Any) -> tuple[tuple[str, str], ...]:
    """Return singular and plural of what each Betti number counts."""
    columns = complex_.points.shape[1]
    component, void, whole = (
        ("component", "components"),
        ("void", "voids"),
        ("whole box", "whole boxes"),
    )
    if getattr(complex_, "periods", None) is None:
        loop = ("hole", "holes") if columns == 2 else ("tunnel", "tunnels")
        return (component, loop) if columns == 2 else (component, loop, void)
    loop = ("loop", "loops")
    return (component, loop, whole) if columns == 2 else (component, loop, void, whole)


def betti_text(betti: Sequence[int], names: Sequence[tuple[str, str]]) -> str:
    """Return how many classes of each kind there are, in words."""
    pairs = zip(betti, names, strict=True)
    return ", ".join(
        counted(count, *name) for count, name in pairs if count or name[0] != "whole box"
    )


def periods_facts(complex_: Any) -> tuple[dict[str, Any], dict[str, str]]:
    """Return the box of a periodic complex, for people and for programs; else nothing."""
    periods = getattr(complex_, "periods", None)
    if periods is None:
        return {}, {}
    sides = ("open" if side is None else number(side) for side in periods)
    text = " x ".join(sides)
    return {"periods": list(periods)}, {"Periodic box": text}


def box_sizes(shape: PeriodicShape) -> dict[str, Any]:
    """Return how large what one box holds is, for programs."""
    if shape.points.shape[1] == 2:
        sizes = {"area": shape.area, "perimeter": shape.perimeter}
    else:
        sizes = {"volume": shape.volume, "surface_area": shape.surface_area}
    return {**sizes, "filled_share": shape.filled_share}


def box_lines(shape: PeriodicShape) -> dict[str, str]:
    """Return the same for people."""
    texts = (area_text, length_text) if shape.points.shape[1] == 2 else (volume_text, area_text)
    *sizes, share = box_sizes(shape).items()
    told = {
        name.replace("_", " ").capitalize(): text(value)
        for (name, value), text in zip(sizes, texts, strict=True)
    }
    # No share of a box that is open and has no end.
    return {**told, "Filled": f"{share[1]:.1%} of the box"} if share[1] else told
