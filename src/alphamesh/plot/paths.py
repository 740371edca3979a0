"""Many simplices in few matplotlib paths, so that a million of them draw in seconds."""

from __future__ import annotations

import numpy as np
from matplotlib.path import Path
from numpy.typing import NDArray

__all__ = ["drawn_count", "segment_paths", "triangle_paths"]

# Simplices per path: large enough that Python objects cost nothing, small
# enough for the limits of matplotlib's rasteriser.
CHUNK = 512


def segment_paths(points: NDArray[np.float64], edges: NDArray[np.integer]) -> list[Path]:
    """Return paths that hold each edge once, as a move and a line."""
    return _paths(points[edges], np.array([Path.MOVETO, Path.LINETO], np.uint8))


def triangle_paths(points: NDArray[np.float64], triangles: NDArray[np.integer]) -> list[Path]:
    """Return paths that hold each triangle once, as a closed outline.

    Triangles that share a path and turn the same way are filled without a seam.
    """
    closed = points[triangles[:, [0, 1, 2, 0]]]
    return _paths(
        closed, np.array([Path.MOVETO, Path.LINETO, Path.LINETO, Path.CLOSEPOLY], np.uint8)
    )


def _paths(corners: NDArray[np.float64], codes: NDArray[np.uint8]) -> list[Path]:
    """Return one path for each `CHUNK` rows of `corners` (m, len(codes), 2)."""
    paths = []
    for start in range(0, len(corners), CHUNK):
        part = corners[start : start + CHUNK]
        path = Path(part.reshape(-1, 2), np.tile(codes, len(part)))
        path.should_simplify = False
        paths.append(path)
    return paths


def drawn_count(paths: list[Path]) -> int:
    """Return how many simplices `paths` hold."""
    return sum(int(np.count_nonzero(path.codes == Path.MOVETO)) for path in paths)
