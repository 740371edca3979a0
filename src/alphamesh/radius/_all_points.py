"""The smallest radius that leaves no point out."""

from __future__ import annotations

from typing import TYPE_CHECKING

from alphamesh.radius._choice import RadiusChoice
from alphamesh.radius._registry import radius_rule

if TYPE_CHECKING:
    from alphamesh._arrays import FloatArray
    from alphamesh.filtration import Filtration

__all__ = ["covered_from"]


@radius_rule("all-points")
def _all_points(filtration: Filtration) -> RadiusChoice:
    """Choose the smallest radius at which no point is left out of the triangles."""
    if filtration.dimension == 0:
        return _choice(0.0, "All points are at one place: nothing is left out.")
    covered = covered_from(filtration)
    last = int(covered.argmax())
    row = int(filtration.simplices[0][last, 0])
    x, y = filtration.points[row]
    count, last_point = f"{len(covered):,}", f"row {row} at ({x:.6g}, {y:.6g})"
    if filtration.dimension == 1:
        reason = (
            f"The {count} points lie on one line, so there are no triangles. This is the "
            "smallest radius at which each point is joined to another by an edge; any "
            f"smaller one leaves out {last_point}."
        )
    else:
        reason = (
            f"This is the smallest radius at which each of the {count} points is a corner of "
            f"a triangle; any smaller one leaves out {last_point}."
        )
    return _choice(float(covered[last]), reason)


def covered_from(filtration: Filtration) -> FloatArray:
    """Return from which radius on each vertex has a triangle; an edge, for points on a line.

    Returns
    -------
    (m_0,) float64
    """
    if filtration.dimension == 1:
        return filtration.joined_from
    return filtration.vertex_intervals.regular_from


def _choice(radius: float, reason: str) -> RadiusChoice:
    return RadiusChoice(radius, "all-points", reason)
