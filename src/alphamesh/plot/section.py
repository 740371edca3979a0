"""What a plane leaves of triangles, and where it cuts tetrahedra."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple, TypeAlias

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from alphamesh._arrays import FloatArray, IntArray

__all__ = ["Plane", "Section", "block_of", "clipped_lines", "clipped_triangles", "cut_open"]

# A normal, and its product with points of the plane: what is above is taken away.
Plane: TypeAlias = "tuple[FloatArray, float]"


class Section(NamedTuple):
    """The part of a solid on one side of a plane; rows are those of `points`.

    Attributes
    ----------
    points : (n + m, 3) float64
        The given ones, and those where edges meet the plane.
    skin : (a, 3) int32
        What is left of the boundary.
    flesh : (b, 3) int32
        The cut through the tetrahedra, counter-clockwise seen from the side taken away.
    lines : (c, 2) int32
        The sides of the polygons that the tetrahedra are cut into.
    """

    points: FloatArray
    skin: IntArray
    flesh: IntArray
    lines: IntArray


class _Points:
    """Points, and those added where edges meet the plane."""

    def __init__(self, points: FloatArray, heights: FloatArray) -> None:
        self.heights = heights
        self._parts = [points]
        self._count = len(points)

    def between(self, above: IntArray, below: IntArray) -> IntArray:
        """Add the point where each edge meets the plane, and return its row."""
        points, high = self._parts[0], self.heights[above]
        share = (high / (high - self.heights[below]))[:, np.newaxis]
        self._parts.append(points[above] * (1 - share) + points[below] * share)
        rows = self._count + np.arange(len(above), dtype=np.int32)
        self._count += len(above)
        return rows

    def all(self) -> FloatArray:
        """Return all points."""
        return np.concatenate(self._parts)


def cut_open(
    points: FloatArray,
    boundary: IntArray,
    tetrahedra: IntArray,
    normal: FloatArray,
    offset: float,
) -> Section:
    """Take away all of a solid where the product with `normal` is above `offset`.

    Parameters
    ----------
    points : (n, 3) float64
    boundary : (k, 3) int32
        Counter-clockwise seen from outside.
    tetrahedra : (t, 4) int32
    normal : (3,) float64
    offset : float
    """
    found = _Points(points, points @ normal - offset)
    skin = _clipped(found, boundary)
    flesh, lines = _sections(found, tetrahedra)
    everything = found.all()
    corners = everything[flesh]
    turned = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]) @ normal < 0
    flesh[turned] = flesh[turned][:, [0, 2, 1]]
    return Section(everything, skin, flesh, lines)


def block_of(
    points: FloatArray, boundary: IntArray, tetrahedra: IntArray, planes: Sequence[Plane]
) -> tuple[FloatArray, IntArray, list[IntArray], IntArray]:
    """Take away all of a solid that is above one of several planes.

    Parameters
    ----------
    points, boundary, tetrahedra
        See :func:`cut_open`.
    planes : sequence of Plane

    Returns
    -------
    points : (m, 3) float64
    skin : (a, 3) int32
        What is left of the boundary.
    flesh : list of (b, 3) int32
        What is left of the cut by each of the planes.
    lines : (c, 2) int32
        See :class:`Section`.
    """
    skin, parts, lines = boundary, [], []
    for normal, offset in planes:
        points, skin, flesh, sides = cut_open(points, skin, tetrahedra, normal, offset)
        parts.append(flesh)
        lines.append(sides)
    for number, (normal, offset) in enumerate(planes):
        found = _Points(points, points @ normal - offset)
        others = [k for k in range(len(planes)) if k != number]
        for k in others:
            parts[k] = _clipped(found, parts[k])
            lines[k] = _shortened(found, lines[k])
        points = found.all()
    return points, skin, parts, np.concatenate([np.empty((0, 2), dtype=np.int32), *lines])


def clipped_triangles(corners: FloatArray, planes: Sequence[Plane]) -> FloatArray:
    """Return what is left of triangles below planes, ``(k, 3, 3)``."""
    return _below(corners, planes, _clipped)


def clipped_lines(ends: FloatArray, planes: Sequence[Plane]) -> FloatArray:
    """Return what is left of lines below planes, ``(k, 2, 3)``."""
    return _below(ends, planes, _shortened)


def _below(
    corners: FloatArray, planes: Sequence[Plane], clip: Callable[[_Points, IntArray], IntArray]
) -> FloatArray:
    size = corners.shape[1]
    for normal, offset in planes:
        points = corners.reshape(-1, 3)
        found = _Points(points, points @ normal - offset)
        left = clip(found, np.arange(len(points), dtype=np.int32).reshape(-1, size))
        corners = found.all()[left]
    return corners


def _shortened(found: _Points, lines: IntArray) -> IntArray:
    """Return what is left of lines below the plane."""
    up = found.heights[lines] > 0
    crossing = up.sum(axis=1) == 1
    one, two = lines[crossing].T
    high, low = np.where(up[crossing, 0], (one, two), (two, one))
    cut = np.column_stack((found.between(high, low), low))
    return np.concatenate((lines[~up.any(axis=1)], cut)).astype(np.int32)


def _sorted_up(found: _Points, simplices: IntArray, above: int) -> IntArray:
    """Return the simplices with so many corners above the plane, those first.

    The corners of triangles only turn around, so that these stay oriented.
    """
    up = found.heights[simplices] > 0
    chosen, up = simplices[up.sum(axis=1) == above], up[up.sum(axis=1) == above]
    width = simplices.shape[1]
    if width == 4:
        return np.take_along_axis(chosen, np.argsort(~up, axis=1, kind="stable"), axis=1)
    # The corner on its own side comes first.
    lone = np.argmax(up if above == 1 else ~up, axis=1)
    turns = (lone[:, np.newaxis] + np.arange(width)) % width
    return np.take_along_axis(chosen, turns, axis=1)


def _clipped(found: _Points, triangles: IntArray) -> IntArray:
    """Return what is left of triangles below the plane, as triangles."""
    whole = triangles[(found.heights[triangles] <= 0).all(axis=1)]
    a, b, c = _sorted_up(found, triangles, 1).T
    ab, ac = found.between(a, b), found.between(a, c)
    low, d, e = _sorted_up(found, triangles, 2).T
    parts = [
        whole,
        np.column_stack((ab, b, c)),
        np.column_stack((ab, c, ac)),
        np.column_stack((low, found.between(d, low), found.between(e, low))),
    ]
    return np.concatenate(parts).astype(np.int32)


def _sections(found: _Points, tetrahedra: IntArray) -> tuple[IntArray, IntArray]:
    """Return the cut through tetrahedra as triangles, and the sides of its polygons."""
    up = found.heights[tetrahedra] > 0
    near = tetrahedra[up.any(axis=1) & ~up.all(axis=1)]
    triples = []
    for above in (1, 3):
        rows = _sorted_up(found, near, above).T
        high, low = rows[:above], rows[above:]
        triples.append(
            np.column_stack([found.between(x, y) for x in high for y in low])
            if len(near)
            else np.empty((0, 3), dtype=np.int32)
        )
    a, b, c, d = _sorted_up(found, near, 2).T
    quads = np.column_stack([found.between(x, y) for x, y in ((a, c), (a, d), (b, d), (b, c))])
    threes = np.concatenate(triples)
    flesh = np.concatenate((threes, quads[:, :3], quads[:, [0, 2, 3]]))
    sides = [threes[:, [i, (i + 1) % 3]] for i in range(3)]
    sides += [quads[:, [i, (i + 1) % 4]] for i in range(4)]
    return flesh.astype(np.int32), np.concatenate(sides).astype(np.int32)
