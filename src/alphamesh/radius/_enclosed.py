"""The smallest radius at which the complex closes around all points, as a scan needs it."""

from __future__ import annotations

from numbers import Real
from typing import TYPE_CHECKING

import numpy as np

from alphamesh._kernels.space import parts3
from alphamesh.errors import ParameterError
from alphamesh.radius._choice import RadiusChoice
from alphamesh.radius._registry import radius_rule
from alphamesh.radius._words import flat_text

if TYPE_CHECKING:
    from alphamesh.filtration3d import Filtration3D

# What `_enclosed_points` calls the part around everything.
_OUTSIDE = -1


@radius_rule("enclosed", columns=(3,), balls="any")
def _enclosed(filtration: Filtration3D, share: float = 1.0) -> RadiusChoice:
    """Choose the smallest radius at which the complex, voids filled, holds the points."""
    if not isinstance(share, Real) or not 0 < share <= 1:
        raise ParameterError(f"share must be a number above 0, up to 1; got {share!r}")
    count = len(filtration.simplices[0])
    if filtration.dimension < 3:
        text = flat_text(f"The {count:,} points", max(filtration.dimension, 1), 3)
        return RadiusChoice(0.0, "enclosed", f"{text}Nothing can be enclosed.")
    wanted = int(np.ceil(share * count))
    values = np.unique(np.concatenate(filtration.radii[2:]))
    # What is outside only shrinks as the radius grows.
    low, high = -1, len(values) - 1
    while high - low > 1:
        middle = (low + high) // 2
        if _enclosed_points(filtration, float(values[middle])) >= wanted:
            high = middle
        else:
            low = middle
    radius = float(values[high])
    found = _enclosed_points(filtration, radius)
    reason = (
        f"This is the smallest radius at which the complex closes around {found:,} of the "
        f"{count:,} points: its voids filled, each of them is a corner of some tetrahedron. "
        "Where the points lie on a surface, it has no gap left: with the voids filled, its "
        "boundary is that surface."
    )
    return RadiusChoice(radius, "enclosed", reason)


def _enclosed_points(filtration: Filtration3D, radius: float) -> int:
    """Return how many points have a tetrahedron that is in the complex or in its voids."""
    parts = parts3(
        filtration.triangle_tetrahedra,
        filtration.radii[3] <= radius,
        filtration.radii[2] <= radius,
    )
    inside = np.zeros(len(filtration.points), dtype=bool)
    inside[filtration.simplices[3][parts != _OUTSIDE]] = True
    return int(np.count_nonzero(inside))
