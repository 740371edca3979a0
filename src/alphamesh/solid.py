"""What tetrahedra make up: regions and voids, and selections of them."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from alphamesh._arrays import read_only
from alphamesh.bounded import BoundedShape
from alphamesh.classify import SimplexKind
from alphamesh.parts import Parts, as_cell_mask, chosen_regions, labelled, large_regions
from alphamesh.regions3d import (
    Regions3D,
    Voids,
    find_parts,
    find_regions,
    find_voids,
    without_voids,
)

if TYPE_CHECKING:
    from alphamesh._arrays import BoolArray, IntArray, KindArray

__all__ = ["Selection3D", "SolidShape"]


@dataclass(frozen=True, eq=False, repr=False)
class SolidShape(BoundedShape):
    """Simplices in space, and what their tetrahedra make up.

    Regions are about the tetrahedra alone, the regularized shape: not about singular
    triangles and edges, and isolated vertices. Voids are those of all simplices.
    """

    @property
    def _walls(self) -> BoolArray:
        walls: BoolArray = self._triangle_kinds != SimplexKind.EXTERIOR
        return walls

    @cached_property
    def _parts(self) -> Parts:
        return find_parts(self.filtration, self._has_tetrahedron, self._walls)

    @cached_property
    def regions(self) -> Regions3D:
        """Sets of tetrahedra connected by triangles, the largest first, and their measures."""
        return find_regions(self.filtration, self._parts)

    @cached_property
    def voids(self) -> Voids:
        """Bounded parts of space without the shape, the largest first."""
        return find_voids(self.filtration, self._parts)

    def filtered(
        self,
        *,
        min_region_volume: float = 0.0,
        max_void_volume: float = 0.0,
        keep_largest: int | None = None,
    ) -> Selection3D:
        """Return the shape without small voids and small regions.

        Voids are filled first, so that the volumes of regions are those after it; then
        small regions are dropped, then all but the largest ones.

        Parameters
        ----------
        min_region_volume : float, default 0
            Drop regions of a smaller volume, in cubed units of the points.
        max_void_volume : float, default 0
            Fill voids of at most this volume; ``numpy.inf`` fills them all. See
            :class:`~alphamesh.Voids` for what a void is.
        keep_largest : int, optional
            Keep so many regions at most.

        Returns
        -------
        Selection3D

        Raises
        ------
        ParameterError
            If a volume is negative or NaN, or `keep_largest` is not a whole number of 0
            or more.
        """
        parts = without_voids(
            self.filtration, self._has_tetrahedron, self._walls, self._parts, max_void_volume
        )
        sizes = parts.region_sizes
        kept = large_regions(sizes, "min_region_volume", min_region_volume, keep_largest)
        return Selection3D(self.filtration, self.radius, labelled(parts.labels, kept))

    def select(self, regions: Any) -> Selection3D:
        """Return some regions of the shape.

        Parameters
        ----------
        regions : array-like of int or bool
            Numbers of regions, or one truth value for each region.

        Returns
        -------
        Selection3D

        Raises
        ------
        ParameterError
            If there are no such regions.
        """
        kept = chosen_regions(regions, len(self._parts.region_sizes))
        return Selection3D(self.filtration, self.radius, labelled(self._parts.labels, kept))


@dataclass(frozen=True, eq=False, repr=False)
class Selection3D(SolidShape):
    """Some tetrahedra of a filtration and their faces: a shape made from another one.

    It offers what an :class:`~alphamesh.AlphaShape3D` offers, but for what a radius alone
    can tell. Nothing in it is singular or isolated.

    Parameters
    ----------
    filtration : Filtration3D
    radius : float
        Of the shape that the tetrahedra were chosen from.
    has_tetrahedron : (T,) bool
        Which tetrahedra of the filtration it has.

    Raises
    ------
    ParameterError
        If there is not one truth value for each tetrahedron.
    """

    has_tetrahedron: BoolArray

    def __post_init__(self) -> None:
        count = len(self.filtration.simplices[3])
        mask = as_cell_mask("has_tetrahedron", self.has_tetrahedron, count)
        object.__setattr__(self, "has_tetrahedron", mask)

    @property
    def _has_tetrahedron(self) -> BoolArray:
        return self.has_tetrahedron

    @cached_property
    def _triangle_kinds(self) -> KindArray:
        # Row -1, no tetrahedron, reads the last entry: not there.
        inside = np.append(self.has_tetrahedron, False).view(np.int8)
        cofaces = inside.take(self.filtration.triangle_tetrahedra).sum(axis=1, dtype=np.int8)
        kinds = np.array([SimplexKind.EXTERIOR, SimplexKind.REGULAR, SimplexKind.INTERIOR])
        return read_only(kinds.astype(np.int8).take(cofaces))

    @cached_property
    def _edge_kinds(self) -> KindArray:
        count = len(self.filtration.simplices[1])
        return _kinds_of_faces(self.filtration.triangle_edges, self._triangle_kinds, count)

    @cached_property
    def _vertex_kinds(self) -> KindArray:
        rows = _kinds_of_faces(
            self.filtration.simplices[1], self._edge_kinds, len(self.filtration.points)
        )
        return read_only(rows.take(self._vertices))

    @property
    def _isolated_edge(self) -> BoolArray:
        return np.zeros(len(self.filtration.simplices[1]), dtype=bool)

    @cached_property
    def isolated_vertices(self) -> IntArray:
        """None: every vertex is a corner of a tetrahedron."""
        return read_only(np.empty(0, dtype=np.int32))

    def __repr__(self) -> str:
        tetrahedra = int(np.count_nonzero(self.has_tetrahedron))
        return f"<Selection3D: {tetrahedra:,} tetrahedra, {len(self.regions):,} regions>"


def _kinds_of_faces(faces: IntArray, kinds: KindArray, count: int) -> KindArray:
    """Return the kinds of faces, given those of cofaces that are regular or interior."""
    of_faces = np.zeros(count, dtype=np.int8)
    for kind in (SimplexKind.INTERIOR, SimplexKind.REGULAR):  # regular ones have the last word
        of_faces[faces.compress(kinds == kind, axis=0)] = kind
    return read_only(of_faces)
