"""The middle of the widest range of radii over which components and holes stay the same."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from alphamesh.persistence import persistence
from alphamesh.radius._choice import RadiusChoice
from alphamesh.radius._registry import radius_rule
from alphamesh.radius._words import apart, components_and_holes

if TYPE_CHECKING:
    from alphamesh.filtration import Filtration


@radius_rule("longest-interval", columns=(2,), balls="any")
def _longest_interval(filtration: Filtration) -> RadiusChoice:
    """Choose the middle of the widest range without a change, before all becomes one."""
    radii, numbers = persistence(filtration).betti_curve()
    if len(radii) == 1:
        reason = "There is one component from the first point on: nothing ever changes."
        if filtration.dimension == 0:
            reason = "All points are at one place: nothing ever changes."
        return RadiusChoice(float(radii[0]), "longest-interval", reason)
    # Halves do not overflow.
    widest = int(np.argmax(radii[1:] / 2 - radii[:-1] / 2))
    low, high = radii[widest : widest + 2].tolist()
    b0, b1 = numbers[widest].tolist()
    start, end = apart(low, high)
    reason = (
        f"From {start} to {end} the shape keeps its {components_and_holes(b0, b1)}: no "
        "other range of radii without a change is so wide, before all holes are filled and "
        "all is one piece. This is its middle."
    )
    return RadiusChoice(
        low / 2 + high / 2, "longest-interval", reason, interval=(low, high), betti=(b0, b1)
    )
