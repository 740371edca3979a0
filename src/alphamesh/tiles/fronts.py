"""The sides of a complex in space that face what is not in it, vertex by vertex.

A small ball around a vertex of the complex is divided by its simplices; the parts of it
that are not in the complex are the *fronts* of the vertex. Fronts of two vertices are one
if a simplex of the complex that has both vertices faces both. A class of fronts is one side
of one component of the complex. Components of the complex and of its complement, joined by
these sides, make a tree (Alexander duality), so that the voids are as many as the sides
minus the components [1]_. All of it is local, so that tiles can count it: the kernel
:func:`alphamesh._kernels.tiles.tile_share3` does, with a frame around its points.

References
----------
.. [1] C. J. A. Delfinado and H. Edelsbrunner, An incremental algorithm for Betti numbers of
   simplicial complexes on the 3-sphere, Computer Aided Geometric Design 12 (1995) 771-784.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from alphamesh._arrays import FloatArray

__all__ = ["FRAME", "with_frame"]

FRAME = 8
"""How many points :func:`with_frame` adds."""


def with_frame(points: FloatArray, width: float) -> FloatArray:
    """Return the points and the corners of a box around them, at least `width` away.

    With these, no point is on the hull, and the triangulation fills a neighbourhood of
    each, whatever the points are.
    """
    low = points.min(axis=0, initial=np.inf) if len(points) else np.zeros(3)
    high = points.max(axis=0, initial=-np.inf) if len(points) else np.zeros(3)
    margin = (
        2.0 * width + float((high - low).max(initial=0.0)) + np.abs(points).max(initial=1e-3)
    )
    sides = np.stack((low - margin, high + margin))
    corners = np.stack(np.meshgrid(*sides.T, indexing="ij"), axis=-1).reshape(-1, 3)
    return np.concatenate((points, corners))
