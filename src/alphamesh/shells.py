"""The connected pieces of a surface, and their measures."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from alphamesh._arrays import Record, read_only

if TYPE_CHECKING:
    from alphamesh._arrays import BoolArray, CountArray, FloatArray, IntArray

__all__ = ["Shells", "shell_measures"]


@dataclass(frozen=True, eq=False, repr=False)
class Shells(Record):
    """The connected pieces of a surface: each closed, the largest volume first.

    Each bounds one region of the shape, from outside or as the wall of a cavity. A region
    has one outer shell.

    Attributes
    ----------
    triangle_counts : (s,) int64
    areas : (s,) float64
        In squared units of the points.
    volumes : (s,) float64
        What each encloses, in cubed units of the points; negative for cavities.
    euler_characteristics : (s,) int64
        Vertices minus edges plus triangles: 2 for a sphere, 0 for a torus. Edges in four
        facets, and points with several fans of them, are counted once for each pair or
        fan, as if the surface had been split there.
    is_outer : (s,) bool
        Whether it encloses its region; else it is the wall of a cavity. No rounding has
        a part in it.

    All arrays are read-only.
    """

    triangle_counts: CountArray
    areas: FloatArray
    volumes: FloatArray
    euler_characteristics: CountArray
    is_outer: BoolArray

    def __len__(self) -> int:
        return len(self.areas)

    @property
    def genera(self) -> CountArray:
        """How many handles each has, ``(s,)`` int64: 0 for a sphere, 1 for a torus."""
        return read_only(1 - self.euler_characteristics // 2)

    def __repr__(self) -> str:
        outer = int(np.count_nonzero(self.is_outer))
        return f"<Shells: {outer:,} outer, {len(self) - outer:,} around cavities>"

    def take(self, rows: IntArray | CountArray | BoolArray) -> Shells:
        """Return some of them, in the order of `rows`."""
        return Shells(
            read_only(self.triangle_counts[rows]),
            read_only(self.areas[rows]),
            read_only(self.volumes[rows]),
            read_only(self.euler_characteristics[rows]),
            read_only(self.is_outer[rows]),
        )


def shell_measures(
    points: FloatArray, triangles: IntArray, labels: IntArray, count: int
) -> tuple[FloatArray, FloatArray]:
    """Return the area of each shell and the volume that it encloses.

    Parameters
    ----------
    points : (n, 3) float64
    triangles : (k, 3) int32
    labels : (k,) int32
    count : int
        How many shells there are.
    """
    # Seen from a corner of the shell, little cancels far from the origin.
    origin = np.zeros(count, dtype=np.int32)
    origin[labels] = triangles[:, 0]
    exponent = int(np.frexp(np.abs(points).max(initial=0.0))[1])
    corners = np.ldexp(points.take(triangles, axis=0), -exponent)
    corners -= np.ldexp(points, -exponent).take(origin.take(labels), axis=0)[:, np.newaxis]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    sixfold = np.einsum("ij,ij->i", normals, corners[:, 0])
    areas = np.bincount(labels, np.sqrt(np.einsum("ij,ij->i", normals, normals)), count)
    volumes = np.bincount(labels, sixfold, count)
    with np.errstate(over="ignore", under="ignore"):
        return np.ldexp(areas / 2, 2 * exponent), np.ldexp(volumes / 6, 3 * exponent)
