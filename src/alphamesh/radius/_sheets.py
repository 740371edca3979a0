"""Points on a surface in space, such as those of a scanner."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from alphamesh.filtration3d import Filtration3D

if TYPE_CHECKING:
    from alphamesh.persistence import Persistence

__all__ = ["is_sheet"]

# Small tetrahedra have at most this times the median radius of the edges of a shortest
# spanning tree. In a cubic grid it is 1.73 times.
_REACH = 2.0
# A smaller share of points than this has one. On the surfaces of the demo solids, with 300 to
# 4,000 points, the share is 0 to 0.2; with noise of a tenth of the spacing about 0.35, of a
# quarter 0.5 to 0.6; within the solids, 0.67 to 0.82, whatever their shape.
_FEW = 0.6


def is_sheet(pairs: Persistence) -> bool:
    """Return whether few points have small tetrahedra, so that they fill no space.

    Four neighbours on a smooth surface lie nearly in one plane: the sphere through them is as
    large as the curvature of the surface has it, and not as small as their distances.
    """
    filtration = pairs.filtration
    if not isinstance(filtration, Filtration3D) or filtration.dimension < 3:
        return False
    return _share(filtration, float(np.median(pairs.deaths[0]))) < _FEW


def _share(filtration: Filtration3D, length: float) -> float:
    """Return the share of the points that have a tetrahedron of about that `length`."""
    small = filtration.radii[3] <= _REACH * length
    has = np.zeros(len(filtration.points), dtype=bool)
    has[filtration.simplices[3].compress(small, axis=0)] = True
    return np.count_nonzero(has) / len(filtration.simplices[0])
