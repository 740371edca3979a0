"""Places of points among the vertices of a filtration."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from alphamesh._arrays import IntArray
    from alphamesh.filtration import AnyFiltration

__all__ = ["corners_of"]


def corners_of(filtration: AnyFiltration, dimension: int, simplices: IntArray) -> IntArray:
    """Return the corners of some simplices as positions in ``filtration.simplices[0]``.

    Returns
    -------
    (k, dimension + 1) int32
    """
    rows = filtration.simplices[dimension].take(simplices, axis=0)
    vertices = filtration.simplices[0][:, 0]
    if len(vertices) == len(filtration.points):
        return rows
    return np.searchsorted(vertices, rows).astype(np.int32)
