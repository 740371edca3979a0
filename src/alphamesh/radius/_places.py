"""Places of points among the vertices of a filtration."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from alphamesh._arrays import IntArray
    from alphamesh.filtration import Filtration

__all__ = ["ends_of"]


def ends_of(filtration: Filtration, edges: IntArray) -> IntArray:
    """Return the ends of some edges as positions in ``filtration.simplices[0]``, (k, 2)."""
    rows = filtration.simplices[1].take(edges, axis=0)
    vertices = filtration.simplices[0][:, 0]
    if len(vertices) == len(filtration.points):
        return rows
    return np.searchsorted(vertices, rows).astype(np.int32)
