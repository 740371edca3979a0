"""The smallest radius that leaves no point out."""

from __future__ import annotations

from typing import TYPE_CHECKING

from alphamesh.classify import least_at_vertices
from alphamesh.radius._choice import RadiusChoice
from alphamesh.radius._registry import radius_rule
from alphamesh.radius._words import CELLS, flat_text

if TYPE_CHECKING:
    from alphamesh._arrays import FloatArray
    from alphamesh.filtration import AnyFiltration

__all__ = ["covered_from"]


@radius_rule("all-points", balls="any")
def _all_points(filtration: AnyFiltration) -> RadiusChoice:
    """Choose the smallest radius at which no point is left out of the cells."""
    if filtration.dimension == 0:
        there = float(filtration.radii[0].max())
        return _choice(there, "All points are at one place: nothing is left out.")
    covered = covered_from(filtration)
    last = int(covered.argmax())
    row = int(filtration.simplices[0][last, 0])
    place = ", ".join(f"{x:.6g}" for x in filtration.points[row])
    count, last_point = f"{len(covered):,}", f"row {row} at ({place})"
    dimension, columns = filtration.dimension, filtration.points.shape[1]
    joined = "joined to another by" if dimension == 1 else "a corner of"
    flat = flat_text(f"The {count} points", dimension, columns)
    seen = "points that are not hidden" if len(filtration.hidden) else "points"
    each = "each point" if flat else f"each of the {count} {seen}"
    reason = (
        f"{flat}This is the smallest radius at which {each} is {joined} "
        f"{CELLS[dimension][0]}; any smaller one leaves out {last_point}."
    )
    return _choice(float(covered[last]), reason)


def covered_from(filtration: AnyFiltration) -> FloatArray:
    """Return from which radius on each vertex has a cell: the largest simplices there are.

    These are edges for points on a line, and triangles for points in a plane in space.

    Returns
    -------
    (m_0,) float64
    """
    dimension = filtration.dimension
    if dimension == filtration.points.shape[1]:
        return filtration.vertex_intervals.regular_from
    vertices = filtration.simplices[0][:, 0]
    return least_at_vertices(
        vertices, filtration.simplices[dimension], filtration.radii[dimension]
    )


def _choice(radius: float, reason: str) -> RadiusChoice:
    return RadiusChoice(radius, "all-points", reason)
