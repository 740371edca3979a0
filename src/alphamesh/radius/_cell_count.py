"""The radius that gives a wanted number of triangles."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from alphamesh.errors import ParameterError
from alphamesh.radius._choice import RadiusChoice
from alphamesh.radius._options import whole_number
from alphamesh.radius._registry import radius_rule

if TYPE_CHECKING:
    from alphamesh.filtration import Filtration


@radius_rule("triangle-count")
def _triangle_count(filtration: Filtration, *, triangles: int | None = None) -> RadiusChoice:
    """Choose the smallest radius at which there are at least `triangles` triangles."""
    if triangles is None:
        raise ParameterError(
            "the radius rule 'triangle-count' needs to know how many: "
            'choose_radius("triangle-count", triangles=1000)'
        )
    wanted = whole_number("triangles", triangles, 0)
    radii = filtration.radii[2]
    if wanted > len(radii):
        raise ParameterError(
            f"triangles={wanted} is more than the {len(radii)} triangles of the whole "
            "triangulation; ask for fewer"
        )
    radius = float(np.partition(radii, wanted - 1)[wanted - 1]) if wanted else 0.0
    there = int(np.count_nonzero(radii <= radius))
    more = f" (there are {there:,}, as some come together)" if there > wanted else ""
    reason = (
        f"This is the smallest radius that gives at least {wanted:,} of the {len(radii):,} "
        f"triangles of the whole triangulation{more}."
    )
    return RadiusChoice(radius, "triangle-count", reason)
