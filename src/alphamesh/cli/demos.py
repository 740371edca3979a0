"""What ``demo:NAME`` stands for: shapes in the plane, solids in space and their surfaces."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from alphamesh.cli.kinds import DEMO_PREFIX

if TYPE_CHECKING:
    from alphamesh.sampling import DemoShape
    from alphamesh.solids import DemoSolid

__all__ = ["SURFACE", "demo_shape", "demo_solid"]

# What follows the name of a solid whose surface is meant.
SURFACE = "-surface"


def demo_shape(source: str) -> DemoShape:
    """Return the shape that ``demo:NAME`` stands for.

    Raises
    ------
    click.UsageError
        If there is none of that name; the message lists those that there are.
    """
    from alphamesh.sampling import DEMO_SHAPES
    from alphamesh.solids import DEMO_SOLIDS

    name = source.removeprefix(DEMO_PREFIX)
    if name not in DEMO_SHAPES:
        raise click.UsageError(
            f"there is no demo shape {name!r}; choose among: {', '.join(DEMO_SHAPES)}; or, in "
            f"space: {', '.join(DEMO_SOLIDS)}, or one of these with {SURFACE} after it"
        )
    return DEMO_SHAPES[name]


def demo_solid(source: str) -> tuple[DemoSolid, bool] | None:
    """Return the solid that ``demo:NAME`` stands for, and whether its surface is meant.

    None if it stands for no solid.
    """
    from alphamesh.solids import DEMO_SOLIDS

    name = source.removeprefix(DEMO_PREFIX)
    solid = name.removesuffix(SURFACE)
    return (DEMO_SOLIDS[solid], solid != name) if solid in DEMO_SOLIDS else None
