"""Where points lie with respect to a set of tetrahedra: in which region, and how far off."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from alphamesh._arrays import Record, read_only
from alphamesh._kernels.surfaces import nearest3, triangle_tree3
from alphamesh.location3d import labels_at

if TYPE_CHECKING:
    from alphamesh._arrays import FloatArray, IntArray, KindArray
    from alphamesh._kernels.surfaces import TriangleTree
    from alphamesh.filtration3d import Filtration3D

__all__ = [
    "Nearest3D",
    "SurfaceTree",
    "nearest_triangles",
    "sides_at",
    "surface_tree",
]

# Coordinates whose exponents lie in this range have products of six, and of their last
# digits, within the range of float64.
_SAFE_EXPONENTS = range(-60, 150)


@dataclass(frozen=True, eq=False, repr=False)
class Nearest3D(Record):
    """The nearest points of a shape's boundary in space.

    Attributes
    ----------
    points : (q, 3) float64
        The nearest point of the boundary to each query; NaN if there is no boundary.
    distances : (q,) float64
        How far it is, not negative; infinity if there is no boundary.
    triangles : (q,) int32
        The boundary triangle that it lies on, as a row of ``shape.surface().triangles``,
        one of them if there are several; -1 if there is no boundary.

    All arrays are read-only.
    """

    points: FloatArray
    distances: FloatArray
    triangles: IntArray

    def __len__(self) -> int:
        return len(self.triangles)

    def __repr__(self) -> str:
        return f"<Nearest3D: {len(self):,} queries>"


@dataclass(frozen=True, eq=False, repr=False)
class SurfaceTree(Record):
    """Boundary triangles, ready to be asked for the nearest one.

    Attributes
    ----------
    points : (n, 3) float64
    triangles : (k, 3) int32
    exponent : int
        Of the power of two that the coordinates in `tree` have been divided by.
    tree : tuple of arrays, or None without triangles
    """

    points: FloatArray
    triangles: IntArray
    exponent: int
    tree: TriangleTree | None


def sides_at(
    filtration: Filtration3D, labels: IntArray, queries: FloatArray
) -> tuple[IntArray, KindArray]:
    """Return the region that each query lies in, and on which side of the boundary.

    Parameters
    ----------
    filtration : Filtration3D
    labels : (T,) int32
        Region of each tetrahedron, below zero for none.
    queries : (q, 3) float64

    Returns
    -------
    regions : (q,) int32
        The lowest of the regions, closed ones, that hold it; -1 if none does.
    sides : (q,) int8
        1 inside, 0 on the boundary, -1 outside; exact.

    Raises
    ------
    CoordinateRangeError
        If queries and points are too far apart in scale for exact arithmetic.
    """
    return labels_at(
        filtration.points,
        filtration.simplices[3],
        (filtration.triangle_tetrahedra, filtration.tetrahedron_triangles),
        labels,
        queries,
    )


def _exponent(points: FloatArray) -> int:
    """Return the exponent of a power of two to divide by, as a rule 0."""
    exponent = int(np.frexp(np.abs(points).max(initial=0.0))[1])
    return 0 if exponent in _SAFE_EXPONENTS else exponent


def surface_tree(points: FloatArray, triangles: IntArray) -> SurfaceTree:
    """Prepare triangles for :func:`nearest_triangles`.

    Parameters
    ----------
    points : (n, 3) float64
    triangles : (k, 3) int32
    """
    if len(triangles) == 0:
        return SurfaceTree(points, triangles, 0, None)
    exponent = _exponent(points)
    return SurfaceTree(
        points, triangles, exponent, triangle_tree3(np.ldexp(points, -exponent), triangles)
    )


def nearest_triangles(tree: SurfaceTree, queries: FloatArray) -> Nearest3D:
    """Return the nearest triangle to each query, the nearest point on it and its distance.

    Parameters
    ----------
    tree : SurfaceTree
        From :func:`surface_tree`.
    queries : (q, 3) float64
        Finite.
    """
    if tree.tree is None:
        nothing = np.full((len(queries), 3), np.nan)
        far = np.full(len(queries), np.inf)
        none = np.full(len(queries), -1, dtype=np.int32)
        return Nearest3D(read_only(nothing), read_only(far), read_only(none))
    arrays, exponent = tree.tree, tree.exponent
    # Products of queries must not overflow either, wherever they are.
    farthest = int(np.frexp(np.abs(queries).max(initial=0.0))[1])
    if farthest - exponent >= _SAFE_EXPONENTS.stop:
        exponent = farthest
        arrays = triangle_tree3(np.ldexp(tree.points, -exponent), tree.triangles)
    triangles, points, distances = nearest3(arrays, np.ldexp(queries, -exponent))
    if exponent:
        with np.errstate(over="ignore", under="ignore"):
            points, distances = np.ldexp(points, exponent), np.ldexp(distances, exponent)
    return Nearest3D(read_only(points), read_only(distances), triangles)
