"""Many simplices in few matplotlib paths, so that a million of them draw in seconds."""

from __future__ import annotations

import numpy as np
from matplotlib.path import Path
from numpy.typing import NDArray

__all__ = [
    "closed_rings",
    "curve_paths",
    "drawn_count",
    "line_paths",
    "outline_paths",
    "segment_paths",
    "triangle_paths",
]

# Simplices per path: large enough that Python objects cost nothing, small
# enough for the limits of matplotlib's rasteriser.
CHUNK = 512


def segment_paths(points: NDArray[np.float64], edges: NDArray[np.integer]) -> list[Path]:
    """Return paths that hold each edge once, as a move and a line."""
    return line_paths(points[edges])


def line_paths(ends: NDArray[np.float64]) -> list[Path]:
    """Return paths that hold each of the lines ``(m, 2, 2)`` once."""
    return _paths(ends, np.array([Path.MOVETO, Path.LINETO], np.uint8))


def curve_paths(controls: NDArray[np.float64]) -> list[Path]:
    """Return paths that hold each of the cubic Bézier curves ``(m, 4, 2)`` once."""
    return _paths(controls, np.array([Path.MOVETO, *3 * [Path.CURVE4]], np.uint8))


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


def closed_rings(
    vertices: NDArray[np.float64], offset: NDArray[np.int64]
) -> tuple[NDArray[np.float64], NDArray[np.uint8], NDArray[np.int64]]:
    """Return rings of corners as outlines: vertices, codes and offset.

    Parameters
    ----------
    vertices : (m, 2) float64
    offset : (k + 1,) int64
        Ring i is ``vertices[offset[i]:offset[i + 1]]``, its first corner not repeated;
        it may be empty.
    """
    used = np.diff(offset) > 0
    first, last = offset[:-1][used], offset[1:][used]
    codes = np.full(len(vertices), Path.LINETO, np.uint8)
    codes[first] = Path.MOVETO
    return (
        np.insert(vertices, last, vertices[first], axis=0),
        np.insert(codes, last, np.uint8(Path.CLOSEPOLY)),
        offset + np.append(0, np.cumsum(used)),
    )


def outline_paths(
    vertices: NDArray[np.float64],
    codes: NDArray[np.uint8],
    offset: NDArray[np.int64],
    rows: NDArray[np.integer],
) -> list[Path]:
    """Return paths that hold the outlines of `rows` once each, whatever they are made of.

    Outline i is ``vertices[offset[i]:offset[i + 1]]`` with the codes of the same places.
    """
    paths = []
    for start in range(0, len(rows), CHUNK):
        part = rows[start : start + CHUNK]
        begin, counts = offset[part], offset[part + 1] - offset[part]
        total = int(counts.sum())
        if total == 0:
            continue
        before = np.cumsum(counts) - counts
        places = np.arange(total) + np.repeat(begin - before, counts)
        path = Path(vertices[places], codes[places])
        path.should_simplify = False
        paths.append(path)
    return paths


def drawn_count(paths: list[Path]) -> int:
    """Return how many simplices `paths` hold."""
    return sum(int(np.count_nonzero(path.codes == Path.MOVETO)) for path in paths)
