"""The radius that gives a wanted number of triangles, or of tetrahedra."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from alphamesh.errors import ParameterError
from alphamesh.radius._choice import RadiusChoice
from alphamesh.radius._options import whole_number
from alphamesh.radius._registry import radius_rule

if TYPE_CHECKING:
    from alphamesh._arrays import FloatArray
    from alphamesh.filtration import Filtration
    from alphamesh.filtration3d import Filtration3D


@radius_rule("triangle-count", columns=(2,), balls="any")
def _triangle_count(filtration: Filtration, *, triangles: int | None = None) -> RadiusChoice:
    """Choose the smallest radius at which there are at least `triangles` triangles."""
    return _cell_count(filtration.radii[2], "triangle-count", "triangles", triangles)


@radius_rule("tetrahedron-count", columns=(3,), balls="any")
def _tetrahedron_count(
    filtration: Filtration3D, *, tetrahedra: int | None = None
) -> RadiusChoice:
    """Choose the smallest radius at which there are at least `tetrahedra` tetrahedra."""
    return _cell_count(filtration.radii[3], "tetrahedron-count", "tetrahedra", tetrahedra)


def _cell_count(radii: FloatArray, rule: str, cells: str, count: Any) -> RadiusChoice:
    if count is None:
        raise ParameterError(
            f"the radius rule {rule!r} needs to know how many: "
            f'choose_radius("{rule}", {cells}=1000)'
        )
    wanted = whole_number(cells, count, 0)
    if wanted > len(radii):
        raise ParameterError(
            f"{cells}={wanted} is more than the {len(radii)} {cells} of the whole "
            "triangulation; ask for fewer"
        )
    radius = float(np.partition(radii, wanted - 1)[wanted - 1]) if wanted else 0.0
    there = int(np.count_nonzero(radii <= radius))
    more = f" (there are {there:,}, as some come together)" if there > wanted else ""
    reason = (
        f"This is the smallest radius that gives at least {wanted:,} of the {len(radii):,} "
        f"{cells} of the whole triangulation{more}."
    )
    return RadiusChoice(radius, rule, reason)
