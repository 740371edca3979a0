"""Where simplices lie with respect to the complex: from which radius on, and at a radius.

As the radius grows, a simplex is first outside, then singular, then regular, then
interior. Each change comes at a radius that depends on the filtration alone, so these
radii are computed once, and a classification is a comparison with them.
"""

from __future__ import annotations

import math
import sys
from dataclasses import dataclass
from enum import IntEnum
from numbers import Real
from typing import TYPE_CHECKING

import numpy as np

from alphamesh._arrays import Record, read_only
from alphamesh.errors import ParameterError

if TYPE_CHECKING:
    from collections.abc import Sequence

    from alphamesh._arrays import BoolArray, FloatArray, IntArray, KindArray

__all__ = [
    "Intervals",
    "SimplexKind",
    "checked_radius",
    "chosen",
    "critical_radii",
    "face_intervals",
    "facet_intervals",
    "least_at_vertices",
    "least_text",
    "reached",
    "vertex_intervals",
]

# Simplices worked on at a time: what belongs to them stays in the processor's cache.
_CHUNK = 1 << 15


class SimplexKind(IntEnum):
    """Where a simplex of the triangulation lies with respect to the complex.

    The names are those of Edelsbrunner and Mücke, Three-dimensional alpha shapes, ACM
    Transactions on Graphics 13 (1994) 43-72.
    """

    EXTERIOR = 0
    """Not in the complex."""
    SINGULAR = 1
    """In the complex, but in none of its cells: triangles, in space tetrahedra."""
    REGULAR = 2
    """On the boundary of the cells of the complex."""
    INTERIOR = 3
    """Inside: surrounded by cells of the complex; so is each of these."""


@dataclass(frozen=True, slots=True, eq=False)
class Intervals(Record):
    """The radii at which simplices of one dimension change their kind.

    Attributes
    ----------
    singular_from, regular_from, interior_from : (m,) float64
        The filtration value; the least and the greatest value of the cells that the
        simplex belongs to: triangles, in space tetrahedra. Infinity means never, as
        ``interior_from`` on the hull.
    """

    singular_from: FloatArray
    regular_from: FloatArray
    interior_from: FloatArray

    def kinds_at(self, radius: float) -> KindArray:
        """Return the :class:`SimplexKind` of each simplex at `radius`, ``(m,)`` int8."""
        kinds = reached(self.singular_from, radius).view(np.int8)
        kinds += reached(self.regular_from, radius).view(np.int8)
        kinds += reached(self.interior_from, radius).view(np.int8)
        return read_only(kinds)


def reached(since: FloatArray, radius: float) -> BoolArray:
    """Return where ``since <= radius``; never where `since` is infinite."""
    # All changes come at finite radii, so the largest float is as good as infinity.
    return since <= min(radius, sys.float_info.max)


def checked_radius(radius: object, *, signed: bool = False) -> float:
    """Return `radius` as a float, of at least 0 unless it is `signed`.

    Parameters
    ----------
    radius : object
    signed : bool, default False
        Whether the balls have weights: a negative radius makes them smaller.

    Raises
    ------
    ParameterError
        If it is not a number, or NaN, or negative without weights.
    """
    if not isinstance(radius, Real):
        raise ParameterError(
            f"radius must be a number in the units of the points; got {radius!r}"
        )
    value = float(radius)
    if math.isnan(value) or (value < 0 and not signed):
        raise ParameterError(f"radius must be {least_text(signed=signed)}; got {value}")
    return value


def least_text(*, signed: bool) -> str:
    """Return ``"0 or more"`` and what infinity means; with weights, any number will do."""
    if signed:
        return "a number, negative for smaller balls (infinity for the whole triangulation)"
    return "0 or more (infinity for the whole triangulation)"


def critical_radii(radii: Sequence[FloatArray], *, weighted: bool) -> FloatArray:
    """Return all values of a filtration, ascending, without repeats.

    Parameters
    ----------
    radii : sequence of (m_k,) float64
        By dimension.
    weighted : bool
        Without weights, all vertices have the same value.
    """
    vertices, *others = radii
    first = vertices if weighted else vertices[:1]
    return read_only(np.unique(np.concatenate((first, *others))))


def facet_intervals(radii: FloatArray, cofaces: IntArray, cell_radii: FloatArray) -> Intervals:
    """Return the intervals of facets: edges in the plane, triangles in space.

    Parameters
    ----------
    radii : (m,) float64
    cofaces : (m, 2) int32
        Rows of cells, -1 for none.
    cell_radii : (k,) float64
    """
    # Row -1, no cell, reads the last entry: never.
    values = np.append(cell_radii, np.inf)
    least, greatest = np.empty(len(radii)), np.empty(len(radii))
    for start in range(0, len(radii), _CHUNK):
        part = slice(start, start + _CHUNK)
        first, second = values.take(cofaces[part]).T
        np.minimum(first, second, out=least[part])
        np.maximum(first, second, out=greatest[part])
    return Intervals(radii, read_only(least), read_only(greatest))


def vertex_intervals(
    radii: FloatArray,
    vertices: IntArray,
    triangles: IntArray,
    triangle_radii: FloatArray,
    hull_edges: IntArray,
) -> Intervals:
    """Return the intervals of vertices in the plane.

    Parameters
    ----------
    radii : (m,) float64
    vertices : (m,) int32
        Rows, ascending; all corners are among them.
    triangles : (T, 3) int32
    triangle_radii : (T,) float64
    hull_edges : (h, 2) int32
        Edges with less than two triangles.
    """
    least = least_at_vertices(vertices, triangles, triangle_radii)
    greatest = np.full(_rows_up_to(vertices), -np.inf)
    for corner in range(3):
        np.maximum.at(greatest, triangles[:, corner], triangle_radii)
    greatest[hull_edges] = np.inf
    greatest = greatest.take(vertices)
    greatest[least == np.inf] = np.inf
    return Intervals(radii, least, read_only(greatest))


def face_intervals(radii: FloatArray, faces: IntArray, above: Intervals) -> Intervals:
    """Return the intervals of simplices, given those of the simplices one dimension up.

    Each cell around a simplex is a cell around one of its cofaces.

    Parameters
    ----------
    radii : (m,) float64
    faces : (k, d) int32
        Of each coface, the numbers of its faces.
    above : Intervals
        Those of the k cofaces.
    """
    least, greatest = np.full(len(radii), np.inf), np.full(len(radii), -np.inf)
    for column in faces.T:
        np.minimum.at(least, column, above.regular_from)
        np.maximum.at(greatest, column, above.interior_from)
    greatest[greatest == -np.inf] = np.inf  # no coface at all
    return Intervals(radii, read_only(least), read_only(greatest))


def least_at_vertices(vertices: IntArray, simplices: IntArray, radii: FloatArray) -> FloatArray:
    """Return the least value of the simplices that each vertex is part of; infinity if none.

    Parameters
    ----------
    vertices : (m,) int32
        Rows, ascending; all corners are among them.
    simplices : (k, d) int32
    radii : (k,) float64

    Returns
    -------
    (m,) float64
    """
    least = np.full(_rows_up_to(vertices), np.inf)
    for corner in range(simplices.shape[1]):
        np.minimum.at(least, simplices[:, corner], radii)
    return read_only(least.take(vertices))


def _rows_up_to(vertices: IntArray) -> int:
    return int(vertices[-1]) + 1 if len(vertices) else 0


def chosen(simplices: IntArray, mask: BoolArray) -> IntArray:
    """Return the simplices where `mask` is true."""
    return read_only(simplices.compress(mask, axis=0))
