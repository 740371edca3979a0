"""The sides of a complex in space that face what is not in it, vertex by vertex.

A small ball around a vertex of the complex is divided by its simplices; the parts of it
that are not in the complex are the *fronts* of the vertex. Fronts of two vertices are one
if a simplex of the complex that has both vertices faces both. A class of fronts is one side
of one component of the complex. Components of the complex and of its complement, joined by
these sides, make a tree (Alexander duality), so that the voids are as many as the sides
minus the components [1]_. All of it is local, so that tiles can count it.

References
----------
.. [1] C. J. A. Delfinado and H. Edelsbrunner, An incremental algorithm for Betti numbers of
   simplicial complexes on the 3-sphere, Computer Aided Geometric Design 12 (1995) 771-784.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from alphamesh._arrays import read_only
from alphamesh._kernels.outlines import connected
from alphamesh._kernels.space import orient3
from alphamesh.measures import scaled_points
from alphamesh.tiles.labels import Border

if TYPE_CHECKING:
    from alphamesh._arrays import BoolArray, CountArray, FloatArray, IntArray
    from alphamesh.filtration3d import Filtration3D

__all__ = ["FRAME", "fronts", "with_frame"]

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


def fronts(found: Filtration3D, inside: BoolArray, rows: CountArray, radius: float) -> Border:
    """Divide the fronts of a tile's vertices by the simplices that the tile knows.

    Parameters
    ----------
    found : Filtration3D
        Of the points of the tile and its halo, and a frame.
    inside : (n,) bool
        Which points are the tile's.
    rows : (n,) int64
        Their rows in the whole cloud, ascending.
    radius : float

    Returns
    -------
    Border
        Keys are ``(a, b, c, side)`` for triangles and ``(a, b, -1, 0)`` for edges.
    """
    corners = _Corners(found, inside, radius)
    labels, count = corners.labels()
    keys, at = [], []
    for key, nodes in (corners.sides(rows), corners.lone_edges(rows)):
        keys.append(key)
        at.append(labels.take(nodes))
    return Border(count, read_only(np.concatenate(keys)), read_only(np.concatenate(at)))


# Which corners of a tetrahedron are the ends of its edges.
_ENDS = ((0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3))


class _Corners:
    """Corners of the tetrahedra that are not in the complex, at the tile's vertices.

    Corner j of tetrahedron t is node 4 t + j of a graph.
    """

    def __init__(self, found: Filtration3D, inside: BoolArray, radius: float) -> None:
        self.found = found
        self.inside = inside
        self.edge_there, self.triangle_there, self.cell_there = (
            radii <= radius for radii in found.radii[1:]
        )
        codes = self._codes(found.simplices[1])
        self.edge_order = np.argsort(codes)
        self.edge_codes = codes.take(self.edge_order)

    def labels(self) -> tuple[CountArray, int]:
        """Return numbers of the fronts at the tile's vertices; -1 for other corners."""
        tetrahedra = self.found.simplices[3]
        count = 4 * len(tetrahedra)
        triangles = np.flatnonzero(~self.triangle_there)
        links = [self._across(triangles), *self._along()]
        parts = connected(count, np.concatenate(links).astype(np.int32))
        used = (~self.cell_there)[:, np.newaxis] & self.inside.take(tetrahedra)
        numbers, places = np.unique(parts[used.ravel()], return_inverse=True)
        labels = np.full(count, -1, dtype=np.int64)
        labels[used.ravel()] = places
        return labels, len(numbers)

    def _across(self, triangles: CountArray) -> CountArray:
        """Link corners at both sides of triangles that are not in the complex."""
        cofaces = self.found.triangle_tetrahedra.take(triangles, axis=0)
        between = (cofaces >= 0).all(axis=1)
        triangles, cofaces = triangles.compress(between), cofaces.compress(between, axis=0)
        vertices = self.found.simplices[2].take(triangles, axis=0)
        links = np.stack([self._node(cofaces[:, side], vertices) for side in (0, 1)], axis=-1)
        mine: CountArray = links[self.inside.take(vertices)]
        return mine

    def _node(self, tetrahedra: IntArray, vertices: IntArray) -> CountArray:
        """Return the corners of tetrahedra at some of their vertices, ``(k, w)``."""
        rows = self.found.simplices[3].take(tetrahedra, axis=0)
        place = (rows[:, np.newaxis, :] == vertices[:, :, np.newaxis]).argmax(axis=2)
        nodes: CountArray = 4 * tetrahedra.astype(np.int64)[:, np.newaxis] + place
        return nodes

    def _along(self) -> list[CountArray]:
        """Link corners of one tetrahedron that a simplex of the complex faces.

        The two ends of an edge of the complex are next to the same part of the outside.
        """
        links = []
        tetrahedra = self.found.simplices[3]
        free = ~self.cell_there
        for i, j in _ENDS:
            ends = tetrahedra[:, (i, j)]
            both = np.flatnonzero(free & self.inside.take(ends).all(axis=1))
            edges = self._edge_numbers(ends.take(both, axis=0))
            both = both.compress(self.edge_there.take(edges))
            links.append(np.stack((4 * both + i, 4 * both + j), axis=1))
        return links

    def _codes(self, ends: IntArray) -> CountArray:
        """Return a number for each pair of rows."""
        return ends[:, 0].astype(np.int64) * len(self.found.points) + ends[:, 1]

    def _edge_numbers(self, ends: IntArray) -> CountArray:
        """Return the edge of the triangulation between each pair of rows."""
        return self.edge_order.take(np.searchsorted(self.edge_codes, self._codes(ends)))

    def sides(self, rows: CountArray) -> tuple[CountArray, CountArray]:
        """Name the free sides of triangles of the complex, at the tile's vertices."""
        vertices = self.found.simplices[2]
        known = self.inside.take(vertices)
        shared = np.flatnonzero(self.triangle_there & known.any(axis=1) & ~known.all(axis=1))
        keys, nodes = [np.empty((0, 4), dtype=np.int64)], [np.empty(0, dtype=np.int64)]
        points, _ = scaled_points(self.found.points)
        for coface in self.found.triangle_tetrahedra.take(shared, axis=0).T:
            free = (coface >= 0) & ~self.cell_there.take(coface)
            cells, faces = coface.compress(free), vertices.take(shared.compress(free), axis=0)
            if len(cells) == 0:
                continue
            tetrahedra = self.found.simplices[3].take(cells, axis=0)
            apexes = tetrahedra.sum(axis=1, dtype=np.int64) - faces.sum(axis=1, dtype=np.int64)
            corners = np.column_stack((faces, apexes))
            side = orient3(points.take(corners, axis=0)).astype(np.int64)
            key = np.column_stack((rows.take(faces), side))
            mine = self.inside.take(faces)
            keys.append(np.repeat(key[:, np.newaxis], 3, axis=1)[mine])
            nodes.append(self._node(cells, faces)[mine])
        return np.concatenate(keys), np.concatenate(nodes)

    def lone_edges(self, rows: CountArray) -> tuple[CountArray, CountArray]:
        """Name the edges of the complex that are in none of its triangles."""
        tetrahedra = self.found.simplices[3]
        edges = self.found.simplices[1]
        lone = self.edge_there.copy()
        lone[self.found.triangle_edges.compress(self.triangle_there, axis=0)] = False
        keys, nodes = [np.empty((0, 4), dtype=np.int64)], [np.empty(0, dtype=np.int64)]
        for i, j in _ENDS:
            ends = tetrahedra[:, (i, j)]
            known = self.inside.take(ends)
            cells = np.flatnonzero(known.any(axis=1) & ~known.all(axis=1))
            numbers = self._edge_numbers(ends.take(cells, axis=0))
            there = lone.take(numbers)
            cells, numbers = cells.compress(there), numbers.compress(there)
            named = rows.take(edges.take(numbers, axis=0))
            key = np.column_stack((named, np.full(len(named), -1), np.zeros(len(named))))
            for corner, place in ((i, 0), (j, 1)):
                mine = known[cells, place]
                keys.append(key[mine].astype(np.int64))
                nodes.append(4 * cells.compress(mine) + corner)
        return np.concatenate(keys), np.concatenate(nodes)
