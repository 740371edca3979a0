"""Which simplices of a tile's neighbourhood are the tile's, and how they hang together."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from alphamesh._arrays import read_only
from alphamesh._kernels import orient2
from alphamesh.classify import SimplexKind
from alphamesh.delaunay3d import outward_triangles
from alphamesh.filtration import AnyFiltration
from alphamesh.filtration3d import Filtration3D
from alphamesh.measures import scaled_points, total_length, triangle_areas
from alphamesh.tiles.labels import Border, border_of
from alphamesh.tiles.tiling import halo_width

if TYPE_CHECKING:
    from alphamesh._arrays import BoolArray, CountArray, FloatArray, IntArray, KindArray

__all__ = ["Share"]


class Share:
    """The filtration of a tile with its halo, and which of its simplices are the tile's.

    Parameters
    ----------
    found : Filtration or Filtration3D
        Of the points of the tile and its halo.
    inside : (n,) bool
        Which of these points are the tile's.
    box : (2, d) float64
        The tile.
    radius : float
    """

    def __init__(
        self, found: AnyFiltration, inside: BoolArray, box: FloatArray, radius: float
    ) -> None:
        self.found = found
        self.inside = inside
        self.box = box
        self.radius = radius
        self.dimension = found.points.shape[1]
        self.mine = tuple(
            np.flatnonzero((radii <= radius) & inside.take(_first(found.points, simplices)))
            for simplices, radii in zip(found.simplices, found.radii, strict=True)
        )
        # One more entry, which row -1 reads: no cell.
        self.has_cell = np.append(found.radii[-1] <= radius, False)
        self.cofaces = self._all_cofaces.take(self.mine[-2], axis=0)
        self.coface_there = self.has_cell.take(self.cofaces)
        kinds = SimplexKind.SINGULAR + self.coface_there.sum(axis=1, dtype=np.int8)
        self.facet_kinds: KindArray = read_only(kinds.astype(np.int8))

    @property
    def _all_cofaces(self) -> IntArray:
        """The one or two cells that each facet belongs to, -1 for none."""
        if isinstance(self.found, Filtration3D):
            return self.found.triangle_tetrahedra
        return self.found.edge_triangles

    # The boundary of the cells

    @cached_property
    def boundary(self) -> tuple[IntArray, IntArray, CountArray]:
        """Boundary facets, turned outwards, the last corners of their cells, their cells."""
        regular = self.facet_kinds == SimplexKind.REGULAR
        there, cofaces = (
            array.compress(regular, axis=0) for array in (self.coface_there, self.cofaces)
        )
        cells = np.where(there[:, 0], cofaces[:, 0], cofaces[:, 1]).astype(np.int64)
        facets = self.found.simplices[-2].take(self.mine[-2].compress(regular), axis=0)
        # The corner that is not in the facet; rows are small enough for their sums.
        corners = self.found.simplices[-1].take(cells, axis=0)
        apexes = corners.sum(axis=1, dtype=np.int64) - facets.sum(axis=1, dtype=np.int64)
        apexes = apexes.astype(np.int32)
        return self._outwards(facets, apexes), apexes, cells

    def _outwards(self, facets: IntArray, apexes: IntArray) -> IntArray:
        """Turn facets: edges with the shape on their left, triangles as seen from outside."""
        if self.dimension == 3:
            return outward_triangles(self.found.points, facets, apexes)
        points, _ = scaled_points(self.found.points)
        right = orient2(points.take(np.column_stack((facets, apexes)), axis=0)) < 0
        facets = facets.copy()
        facets[right] = facets[right, ::-1]
        return facets

    @property
    def boundary_size(self) -> float:
        """Length or area of the boundary."""
        facets = self.boundary[0]
        if self.dimension == 2:
            return total_length(self.found.points, facets)
        return float(triangle_areas(self.found.points, facets).sum())

    # What hangs together

    def components(self, rows: CountArray) -> Border:
        """Divide the vertices that the tile knows by its edges."""
        ends = self.found.simplices[1].take(self.mine[1], axis=0)
        known = np.zeros(len(self.found.points), dtype=np.bool_)
        known[self.found.simplices[0][self.mine[0], 0]] = True
        known[ends] = True
        place = np.cumsum(known) - 1
        vertices = np.flatnonzero(known)
        near = _near_border(self.found.points, self.box, halo_width(self.radius))
        shared = ~self.inside.take(vertices) | near.take(vertices)
        return border_of(rows.take(vertices)[:, np.newaxis], place.take(ends), shared)[1]

    def regions(self, rows: CountArray) -> tuple[CountArray, Border]:
        """Divide the cells that the tile knows by its facets; -1 for the others."""
        both = self.coface_there.all(axis=1)
        links = self.cofaces.compress(both, axis=0)
        known = np.zeros(len(self.found.simplices[-1]), dtype=np.bool_)
        known[self.mine[-1]] = True
        known[self.cofaces[self.coface_there]] = True
        place = np.cumsum(known) - 1
        cells = np.flatnonzero(known)
        corners = self.found.simplices[-1].take(cells, axis=0)
        shared = np.any(~self.inside.take(corners), axis=1)
        labels, border = border_of(rows.take(corners), place.take(links), shared)
        everywhere = np.full(len(known), -1, dtype=np.int64)
        everywhere[cells] = labels
        return everywhere, border

    def region_sizes(self, labels: CountArray, count: int) -> FloatArray:
        """Return the area or volume of the tile's cells for each region."""
        cells = self.mine[-1]
        if isinstance(self.found, Filtration3D):
            sizes = self.found.tetrahedron_volumes
        else:
            sizes = self.found.triangle_areas
        sums = np.bincount(labels.take(cells), sizes.take(cells), count)
        return read_only(np.asarray(sums, dtype=np.float64))


def _first(points: FloatArray, simplices: IntArray) -> IntArray:
    """Return the lexicographically first vertex of each simplex."""
    x = np.ascontiguousarray(points[:, 0])
    first, least = simplices[:, 0].copy(), x.take(simplices[:, 0])
    for other in simplices.T[1:]:
        its = x.take(other)
        less = its < least
        tied = np.flatnonzero(its == least)
        mine, theirs = (points.take(rows.take(tied), axis=0) for rows in (first, other))
        less[tied] = _is_less(theirs[:, 1:], mine[:, 1:])
        np.copyto(first, other, where=less)
        np.copyto(least, its, where=less)
    return first


def _is_less(a: FloatArray, b: FloatArray) -> BoolArray:
    """Return which rows of `a` come before those of `b` in lexicographic order."""
    less = np.zeros(len(a), dtype=np.bool_)
    for axis in reversed(range(a.shape[1])):
        less = (a[:, axis] < b[:, axis]) | ((a[:, axis] == b[:, axis]) & less)
    return less


def _near_border(points: FloatArray, box: FloatArray, width: float) -> BoolArray:
    """Return which points lie so near to the border of a box that other tiles see them."""
    low = points <= np.nextafter(box[0] + width, np.inf)
    high = points >= np.nextafter(box[1] - width, -np.inf)
    near: BoolArray = (low | high).any(axis=1)
    return near
