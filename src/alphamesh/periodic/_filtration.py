"""The alpha filtration of a periodic box: every simplex once, with lattice offsets."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from alphamesh._arrays import Record, read_only
from alphamesh._kernels.topology import persistence3
from alphamesh._weights import hidden_text
from alphamesh.errors import DimensionError
from alphamesh.points import at_positions, births_of_rows

if TYPE_CHECKING:
    from alphamesh._arrays import BoolArray, FloatArray, IntArray, KindArray
    from alphamesh._kernels import Progress

__all__ = ["PeriodicFiltration"]


@dataclass(frozen=True, eq=False, repr=False)
class PeriodicFiltration(Record):
    """All simplices of a periodic Delaunay triangulation, each once, with their values.

    A box stands for all of space, filled with translated copies of it. Their Delaunay
    triangulation, with ties broken by the lexicographic order of coordinates, is carried
    onto itself by each translation. One simplex of each class of translates is listed:
    the quotient is a Delta-complex [1]_ for any number of points, one included. Its
    simplices may have a vertex several times, at different offsets, or the same vertices
    as others; see `is_simplicial`.

    Vertex j of simplex i of dimension k lies at
    ``positions[simplices[k][i, j]] + offsets[k][i, j] * periods``.

    Attributes
    ----------
    points : (n, 2) or (n, 3) float64
        As they were given, inside or outside of the box.
    positions : (n, 2) or (n, 3) float64
        The same in the box, from 0 to the period in each periodic direction, rounded to
        float64; simplices and values are those of the exact places.
    periods : tuple of float or None
        The side lengths of the box, None where it is open.
    representative : (n,) int32
        The lowest row at the place of row i in the box: i itself unless it is a duplicate.
    simplices : tuple of (m_k, k + 1) int32
        Vertices, edges, triangles and, in space, tetrahedra: rows of `points`, ascending
        within a simplex by row, then by offset. Simplices come in the order of their rows,
        then of their offsets.
    offsets : tuple of (m_k, k + 1, d) int8
        How many periods from its position each vertex lies: -1, 0 or 1. The first vertex of
        each simplex has offset 0.
    radii : tuple of (m_k,) float64
        The filtration values of `simplices`, in the units of the points: see
        :class:`~alphamesh.filtration.Filtration`.
    faces : tuple of (m_k, k + 1) int32
        The number, in ``simplices[k - 1]``, of the face opposite to each vertex; empty for
        vertices. Rows and offsets need not tell simplices apart: numbers do.
    facet_cells : (m, 2) int32
        The one or two cells of each facet, -1 for none, which is there at the border of
        open directions alone. Empty if the cloud has fewer dimensions than the points.
    crs : pyproj.CRS or None
        The coordinate reference system of the points, if they came with one.
    weights : (n,) float64 or None
        Squared radii of balls at radius zero; radii are then signed roots.
    hidden : (h,) int32
        Rows of weighted points that are in no simplex, ascending.

    All arrays are read-only. There is an entry for each dimension, possibly empty.

    References
    ----------
    .. [1] A. Hatcher, Algebraic Topology, Cambridge University Press 2002, section 2.1.
    """

    points: FloatArray
    positions: FloatArray
    periods: tuple[float | None, ...]
    representative: IntArray
    simplices: tuple[IntArray, ...]
    offsets: tuple[KindArray, ...]
    radii: tuple[FloatArray, ...]
    faces: tuple[IntArray, ...]
    facet_cells: IntArray
    crs: Any
    weights: FloatArray | None
    hidden: IntArray

    @property
    def dimension(self) -> int:
        """Dimension of the cloud and its copies together; -1 if there are no points."""
        return max(
            (k for k in range(len(self.simplices)) if len(self.simplices[k])), default=-1
        )

    @property
    def periodic(self) -> BoolArray:
        """Which directions are periodic, ``(d,)`` bool."""
        return np.array([side is not None for side in self.periods])

    @property
    def lattice(self) -> FloatArray:
        """The periods as numbers, 0 for open directions, ``(d,)`` float64."""
        sides: FloatArray = np.array([side or 0.0 for side in self.periods])
        return sides

    @property
    def triangle_edges(self) -> IntArray:
        """The edge opposite to each vertex of each triangle, ``(F, 3)`` int32."""
        return self.faces[2]

    @property
    def tetrahedron_triangles(self) -> IntArray:
        """The triangle opposite to each vertex of each tetrahedron, ``(T, 4)`` int32."""
        if len(self.faces) < 4:
            raise DimensionError("there are tetrahedra in space alone; see triangle_edges")
        return self.faces[3]

    @cached_property
    def is_simplicial(self) -> bool:
        """Whether it is a simplicial complex: vertices tell simplices apart.

        If not, because there are too few points for the box, that of two or three boxes in
        a row is: see :meth:`alphamesh.PeriodicComplex.tiled`.
        """
        for rows in self.simplices[1:]:
            if (rows[:, 1:] == rows[:, :-1]).any():
                return False
            # Simplices come in the order of their rows.
            if len(rows) and (rows[1:] == rows[:-1]).all(axis=1).any():
                return False
        return True

    def corners(self, dimension: int, numbers: Any = slice(None)) -> FloatArray:
        """Return where the vertices of simplices are, as one piece across borders.

        Parameters
        ----------
        dimension : int
        numbers : index array or slice, optional
            Which simplices; by default all of that dimension.

        Returns
        -------
        (m, k + 1, d) float64
        """
        rows, offsets = self.simplices[dimension][numbers], self.offsets[dimension][numbers]
        places: FloatArray = self.positions.take(rows, axis=0) + offsets * self.lattice
        return places

    @cached_property
    def cell_sizes(self) -> FloatArray:
        """The areas of triangles in the plane, the volumes of tetrahedra in space."""
        d = self.points.shape[1]
        corners = self.corners(d)
        arms = corners[:, 1:] - corners[:, :1]
        if d == 2:
            sizes = np.abs(arms[:, 0, 0] * arms[:, 1, 1] - arms[:, 0, 1] * arms[:, 1, 0]) / 2
        else:
            sizes = (
                np.abs(np.einsum("ij,ij->i", arms[:, 0], np.cross(arms[:, 1], arms[:, 2]))) / 6
            )
        return read_only(sizes)

    @cached_property
    def facet_sizes(self) -> FloatArray:
        """The lengths of edges in the plane, the areas of triangles in space."""
        d = self.points.shape[1]
        corners = self.corners(d - 1)
        arms = corners[:, 1:] - corners[:, :1]
        if d == 2:
            return read_only(np.hypot(arms[:, 0, 0], arms[:, 0, 1]))
        return read_only(np.linalg.norm(np.cross(arms[:, 0], arms[:, 1]), axis=1) / 2)

    @property
    def box_size(self) -> float:
        """Area of the box in the plane, volume in space; infinite if it is open."""
        return float(np.prod([np.inf if side is None else side for side in self.periods]))

    def pairs(
        self, *, threads: int | None = None, progress: Progress | None = None
    ) -> tuple[IntArray, ...]:
        """Return the simplices that begin and end each class of homology that ends.

        Parameters
        ----------
        threads : int, optional
            Threads to use; by default one for each usable CPU.
        progress : callable, optional
            Called with the fraction that is done, from 0 to 1.

        Returns
        -------
        tuple of (p_k, 2) int32
            Components and loops and, in space, voids: positions of creator and destroyer,
            see :class:`~alphamesh.persistence.Persistence`. Kept for the next call.
        """
        known: tuple[IntArray, ...] | None = vars(self).get("_pairs")
        if known is None:
            known = vars(self)["_pairs"] = _pairs_of(self, threads, progress)
        return known

    def __repr__(self) -> str:
        names = ("vertices", "edges", "triangles", "tetrahedra")
        counts = zip(self.simplices, names, strict=False)
        facts = ", ".join(f"{len(rows):,} {name}" for rows, name in counts)
        sides = " x ".join("open" if side is None else f"{side:.6g}" for side in self.periods)
        return f"<PeriodicFiltration, {sides}: {facts}{hidden_text(self.hidden)}>"


def _pairs_of(
    filtration: PeriodicFiltration, threads: int | None, progress: Progress | None
) -> tuple[IntArray, ...]:
    """Return the pairs of components, loops and voids.

    Without an outside, the last cell of all fills no hollow: no translation moves a facet
    of a cell to another one of it, so that each facet of the torus has two cells, and
    union-find over cells leaves one. The reduction of what remains needs no outside either.
    """
    simplices, radii, faces = filtration.simplices, filtration.radii, filtration.faces
    space = len(simplices) == 4
    cells = space and len(simplices[3]) > 0
    components, loops, voids = persistence3(
        len(filtration.points),
        simplices[1],
        radii[1],
        faces[2],
        radii[2],
        filtration.facet_cells if cells else np.full((len(simplices[2]), 2), -1, np.int32),
        radii[3] if cells else np.empty(0),
        threads,
        progress,
        births=births_of_rows(
            filtration.weights, simplices[0], radii[0], len(filtration.points)
        ),
    )
    components = at_positions(components, simplices[0], len(filtration.points))
    return (components, loops, voids) if space else (components, loops)
