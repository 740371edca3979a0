"""The smallest radius that leaves no point out and gives few pieces."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from alphamesh import _kernels
from alphamesh.radius._all_points import covered_from
from alphamesh.radius._choice import RadiusChoice
from alphamesh.radius._options import whole_number
from alphamesh.radius._registry import radius_rule

if TYPE_CHECKING:
    from alphamesh._arrays import FloatArray
    from alphamesh.filtration import Filtration


@radius_rule("one-region")
def _one_region(filtration: Filtration) -> RadiusChoice:
    """Choose the smallest radius at which all points are in one piece."""
    return _few_regions(filtration, 1, "one-region")


@radius_rule("regions")
def _regions(filtration: Filtration, *, regions: int = 1) -> RadiusChoice:
    """Choose the smallest radius at which all points are in at most `regions` pieces."""
    return _few_regions(filtration, whole_number("regions", regions, 1), "regions")


def _few_regions(filtration: Filtration, most: int, rule: str) -> RadiusChoice:
    if filtration.dimension == 0:
        return RadiusChoice(0.0, rule, "All points are at one place: one piece at any radius.")
    begins, ends = _region_events(filtration)
    covered = float(covered_from(filtration).max())
    # The number of pieces changes only where one begins or two meet.
    radii = np.unique(np.append(ends, covered))
    radii = radii[radii >= covered]
    count = np.searchsorted(begins, radii, side="right") - np.searchsorted(
        ends, radii, side="right"
    )
    first = int(np.argmax(count <= most))
    pieces = "one piece" if most == 1 else f"at most {most:,} pieces"
    members = "triangles" if filtration.dimension == 2 else "edges"
    found = f" ({count[first]:,} here)" if count[first] != 1 and most > 1 else ""
    reason = (
        f"This is the smallest radius at which no point is left out and the {members} form "
        f"{pieces}{found}."
    )
    if filtration.dimension == 1:
        reason = f"The points lie on one line, so there are no triangles. {reason}"
    return RadiusChoice(float(radii[first]), rule, reason)


def _region_events(filtration: Filtration) -> tuple[FloatArray, FloatArray]:
    """Return the radii at which pieces begin and at which two of them meet, each ascending.

    Pieces are sets of triangles connected across edges; on a line, of points.
    """
    _, edge_radii, triangle_radii = filtration.radii
    if filtration.dimension == 1:
        return filtration.radii[0], np.sort(edge_radii)
    cofaces = filtration.edge_triangles
    inner = cofaces.compress(cofaces[:, 1] >= 0, axis=0)
    joined_from = triangle_radii.take(inner).max(axis=1)
    # The pieces meet along a shortest spanning tree of the triangles: what the core
    # finds for the components of any graph.
    count = len(triangle_radii)
    meets, _ = _kernels.persistence2(
        np.zeros((count, 2)),
        filtration.simplices[2][:0],
        triangle_radii[:0],
        inner,
        joined_from,
        np.full(inner.shape, -1, dtype=np.int32),
    )
    return np.sort(triangle_radii), np.sort(joined_from.take(meets[:, 1]))
