"""Representative cycles of voids: the closed surfaces around them at the radius of birth."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from alphamesh._arrays import Record, read_only
from alphamesh.cycles import checked_classes, hollow_cells
from alphamesh.delaunay3d import outward_triangles

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from alphamesh._arrays import CountArray, IntArray
    from alphamesh.filtration3d import Filtration3D

__all__ = ["VoidShells", "void_shells"]


@dataclass(frozen=True, eq=False, repr=False)
class VoidShells(Record):
    """The triangles around voids, flat: those of one void are a slice of `triangles`.

    Iterating gives the triangles around each void as an ``(m, 3)`` int32 array.

    Attributes
    ----------
    offsets : (k + 1,) int64
        Around void i are ``triangles[offsets[i]:offsets[i + 1]]``.
    triangles : (m, 3) int32
        Rows of the points, counter-clockwise as seen from outside of the void.
    classes : (k,) int32
        Which class each void is.
    """

    offsets: CountArray
    triangles: IntArray
    classes: IntArray

    def __len__(self) -> int:
        return len(self.classes)

    def __getitem__(self, index: int) -> IntArray:
        if not -len(self) <= index < len(self):
            raise IndexError(f"void {index} of {len(self)}")
        index %= len(self)
        return self.triangles[self.offsets[index] : self.offsets[index + 1]]

    def __iter__(self) -> Iterator[IntArray]:
        return (self[i] for i in range(len(self)))

    def __repr__(self) -> str:
        voids = f"{len(self):,} void{'s' * (len(self) != 1)}"
        return f"<VoidShells: {len(self.triangles):,} triangles around {voids}>"


def void_shells(filtration: Filtration3D, voids: IntArray, classes: ArrayLike) -> VoidShells:
    """Return the triangles around voids at their birth.

    Parameters
    ----------
    filtration : Filtration3D
    voids : (p, 2) int32
        Creating triangle and destroying tetrahedron of each class.
    classes : int or sequence of int
        Rows of `voids`.

    Returns
    -------
    VoidShells
        In the order of `classes`.

    Raises
    ------
    ParameterError
        If there is no such class.
    """
    wanted = checked_classes(classes, len(voids), 2)
    shells = [_shell(filtration, *voids[number].tolist()) for number in wanted.tolist()]
    lengths = [len(shell) for shell in shells]
    return VoidShells(
        read_only(np.concatenate(([0], np.cumsum(lengths, dtype=np.int64)))),
        read_only(np.concatenate([np.empty((0, 3), dtype=np.int32), *shells])),
        read_only(wanted.astype(np.int32)),
    )


def _shell(filtration: Filtration3D, triangle: int, tetrahedron: int) -> IntArray:
    """Return the border of the void that `triangle` closes off and `tetrahedron` fills."""
    sides = filtration.tetrahedron_triangles
    cells = hollow_cells(
        filtration.radii[2], filtration.triangle_tetrahedra, sides, triangle, tetrahedron
    )
    faces, first, counts = np.unique(
        sides.take(cells, axis=0), return_index=True, return_counts=True
    )
    # Between two of the cells there is no border, even where a membrane stands.
    border = counts == 1
    apexes = filtration.simplices[3].take(cells, axis=0).ravel()[first.compress(border)]
    triangles = filtration.simplices[2].take(faces.compress(border), axis=0)
    return outward_triangles(filtration.points, triangles, apexes)
