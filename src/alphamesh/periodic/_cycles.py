"""Representative cycles in a periodic box: rings and shells, in one piece across borders."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from alphamesh._arrays import read_only
from alphamesh.cycles import Rings, checked_classes, hollow_cells, rings_of
from alphamesh.loops import Roads
from alphamesh.measures import edge_lengths, scaled_points
from alphamesh.voids import VoidShells

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from alphamesh._arrays import BoolArray, CountArray, FloatArray, IntArray, KindArray
    from alphamesh.periodic._filtration import PeriodicFiltration

__all__ = ["PeriodicRings", "PeriodicShells", "box_holes", "box_loops", "box_voids"]

# Rows, their shifts, and where one comes out a round later.
_Ring: TypeAlias = tuple[list[int], list["CountArray"], "CountArray"]


@dataclass(frozen=True, eq=False, repr=False)
class PeriodicRings(Rings):
    """Closed rings of points in a periodic box, flat; see :class:`~alphamesh.cycles.Rings`.

    Attributes
    ----------
    shifts : (m, d) int32
        How many periods each vertex of `vertices` lies from its position, so that a ring is
        in one piece; zero for the first vertex of each.
    places : (m, d) float64
        Where they lie: positions, moved by the shifts.
    windings : (k, d) int32
        How many periods from its first vertex each ring comes out: zeros for a ring that
        closes, else it runs around the box, as a loop of the torus.
    """

    shifts: IntArray
    places: FloatArray
    windings: IntArray

    @property
    def winds(self) -> BoolArray:
        """Which rings run around the box, ``(k,)`` bool."""
        return read_only((self.windings != 0).any(axis=1))

    def __repr__(self) -> str:
        around = np.count_nonzero(self.winds)
        return f"<PeriodicRings: {len(self):,}, {around:,} around the box>"


@dataclass(frozen=True, eq=False, repr=False)
class PeriodicShells(VoidShells):
    """Triangles around voids in a periodic box, flat; see :class:`~alphamesh.voids.VoidShells`.

    Rows of a triangle ascend: nothing is said of its side.

    Attributes
    ----------
    numbers : (m,) int32
        Which triangles of the filtration `triangles` are.
    places : (m, 3, d) float64
        Where their vertices lie: in one piece, unless the void runs around the box.
    """

    numbers: IntArray
    places: FloatArray

    def __repr__(self) -> str:
        return super().__repr__().replace("VoidShells", "PeriodicShells")


def box_loops(
    filtration: PeriodicFiltration, creators: IntArray, classes: ArrayLike
) -> PeriodicRings:
    """Return a closed path for each loop: its creating edge and the shortest way back.

    Parameters
    ----------
    filtration : PeriodicFiltration
    creators : (p,) int32
        Creating edges.
    classes : int or sequence of int
        Rows of `creators`.
    """
    wanted = checked_classes(classes, len(creators))
    edges = creators.take(wanted).tolist()
    rings: list[_Ring] = []
    if edges:
        steps = filtration.offsets[1][:, 1].astype(np.int64)
        roads = _roads_of(filtration, float(filtration.radii[1].take(edges).max()))
        rings = [_loop(roads, steps, edge) for edge in edges]
    return _rings(filtration, rings, wanted.tolist())


def _roads_of(filtration: PeriodicFiltration, radius: float) -> Roads:
    there = np.flatnonzero(filtration.radii[1] <= radius)
    corners = filtration.corners(1, there).reshape(-1, len(filtration.periods))
    ends = np.arange(len(corners), dtype=np.int32).reshape(-1, 2)
    lengths = edge_lengths(scaled_points(corners)[0], ends)
    # Around the box, the way may be as short as can be.
    nothing = np.zeros(len(filtration.points))
    return Roads.along(
        filtration.simplices[1], filtration.radii[1], there, lengths, lambda _: nothing
    )


def _loop(roads: Roads, steps: CountArray, creator: int) -> _Ring:
    """Return the path from the lower end of an edge to the other, which the edge closes."""
    row = int(roads.edges[creator, 0])
    rows, shifts = [row], [np.zeros_like(steps[creator])]
    for road in roads.way_around(creator):
        number = int(roads.numbers[road])
        forward = int(roads.starts[road]) == int(roads.edges[number, 0])
        shifts.append(shifts[-1] + (steps[number] if forward else -steps[number]))
        rows.append(int(roads.ends[road]))
    return rows, shifts, shifts[-1] - steps[creator]


def _rings(
    filtration: PeriodicFiltration, rings: list[_Ring], owners: list[int]
) -> PeriodicRings:
    """Return rings, each with the class it belongs to, as one record."""
    d = len(filtration.periods)
    plain = rings_of([rows for rows, _, _ in rings], owners)
    moves = [np.array(shifts) - shifts[0] for _, shifts, _ in rings]
    shifts = np.concatenate([np.empty((0, d), dtype=np.int64), *moves])
    places = filtration.positions.take(plain.vertices, axis=0) + shifts * filtration.lattice
    windings = np.array([winding for _, _, winding in rings]).reshape(-1, d)
    return PeriodicRings(
        plain.offsets,
        plain.vertices,
        plain.classes,
        read_only(shifts.astype(np.int32)),
        read_only(places),
        read_only(windings.astype(np.int32)),
    )


def box_holes(
    filtration: PeriodicFiltration, pairs: IntArray, classes: ArrayLike
) -> PeriodicRings:
    """Return the rings around holes in the plane at their birth.

    Parameters
    ----------
    filtration : PeriodicFiltration
    pairs : (p, 2) int32
        Creating edge and destroying triangle of each class.
    classes : int or sequence of int
        Rows of `pairs`.
    """
    rings: list[_Ring] = []
    owners: list[int] = []
    for number in checked_classes(classes, len(pairs)).tolist():
        region = _Region(filtration, *pairs[number].tolist())
        found = region.rings()
        rings += found
        owners += [number] * len(found)
    return _rings(filtration, rings, owners)


def box_voids(
    filtration: PeriodicFiltration, pairs: IntArray, classes: ArrayLike
) -> PeriodicShells:
    """Return the triangles around voids at their birth.

    Parameters
    ----------
    filtration : PeriodicFiltration
    pairs : (p, 2) int32
        Creating triangle and destroying tetrahedron of each class.
    classes : int or sequence of int
        Rows of `pairs`.
    """
    wanted = checked_classes(classes, len(pairs), 2)
    shells = [
        _Region(filtration, *pairs[number].tolist()).shell() for number in wanted.tolist()
    ]
    numbers = np.array([n for shell in shells for n, _ in shell], dtype=np.int32)
    moves = np.array([move for shell in shells for _, move in shell]).reshape(-1, 1, 3)
    places = filtration.corners(2, numbers) + moves * filtration.lattice
    lengths = [len(shell) for shell in shells]
    return PeriodicShells(
        read_only(np.concatenate(([0], np.cumsum(lengths, dtype=np.int64)))),
        read_only(filtration.simplices[2].take(numbers, axis=0)),
        read_only(wanted.astype(np.int32)),
        read_only(numbers),
        read_only(places),
    )


class _Region:
    """The cells that a hole or void covers at its birth, and what is around them."""

    def __init__(self, filtration: PeriodicFiltration, creator: int, destroyer: int) -> None:
        self._filtration = filtration
        self._d = len(filtration.periods)
        self._faces = filtration.faces[self._d]
        self._rows = filtration.simplices[self._d]
        self._offsets = filtration.offsets[self._d]
        cells = hollow_cells(
            filtration.radii[-2], filtration.facet_cells, self._faces, creator, destroyer
        )
        self._cells = set(cells.tolist())
        self._destroyer = destroyer

    def _beyond(self, cell: int, side: int) -> int:
        """Return the cell of the region across a side, -1 if there is none."""
        first, second = self._filtration.facet_cells[self._faces[cell, side]].tolist()
        other = int(second if first == cell else first)
        return other if other in self._cells else -1

    def _entry(self, cell: int, side: int) -> int:
        """Return which side of a cell has the facet that is `side`."""
        return int(np.flatnonzero(self._faces[cell] == side)[0])

    def _facet_at(self, cell: int, side: int) -> KindArray:
        """Return where a facet lies, from where it is listed, as a side of a cell."""
        offset: KindArray = self._offsets[cell, 1 if side == 0 else 0]
        return offset

    def _across(self, cell: int, side: int, place: CountArray) -> tuple[int, int, CountArray]:
        """Return the cell beyond a side, its side there, and where it lies."""
        other = self._beyond(cell, side)
        entry = self._entry(other, int(self._faces[cell, side]))
        step = self._facet_at(cell, side) - self._facet_at(other, entry)
        return other, entry, place + step

    def shell(self) -> list[tuple[int, CountArray]]:
        """Return the facets with one cell of the region, and where they lie."""
        places = {self._destroyer: np.zeros(self._d, dtype=np.int64)}
        open_ = [self._destroyer]
        shell = []
        for cell in open_:
            for side in range(self._d + 1):
                if self._beyond(cell, side) < 0:
                    facet = int(self._faces[cell, side])
                    shell.append((facet, places[cell] + self._facet_at(cell, side)))
                    continue
                other, _, place = self._across(cell, side, places[cell])
                if other not in places:
                    places[other] = place
                    open_.append(other)
        return sorted(shell, key=lambda entry: entry[0])

    def rings(self) -> list[_Ring]:
        """Return the rings around the region in the plane, the outer one first."""
        left = {
            (cell, side)
            for cell in sorted(self._cells)
            for side in range(3)
            if self._beyond(cell, side) < 0
        }
        rings = [self._ring(*place, left) for place in sorted(left) if place in left]
        rings.sort(key=lambda ring: (not ring[2].any(), -self._area(ring)))
        return rings

    def _ring(self, cell: int, side: int, left: set[tuple[int, int]]) -> _Ring:
        """Walk along the border from one side on, turning about each corner inside."""
        rows, shifts, turns = [], [], 0.0
        place = np.zeros(self._d, dtype=np.int64)
        start, end = (side + 1) % 3, (side + 2) % 3
        while (cell, side) in left:
            left.remove((cell, side))
            rows.append(int(self._rows[cell, end]))
            shifts.append(place + self._offsets[cell, end])
            turns += self._turn(cell, start, end, side)
            # The next side at the corner, until one is at the border.
            side, start, end = start, end, side
            while self._beyond(cell, side) >= 0:
                kept = [k for k in range(3) if k != side]
                cell, entry, place = self._across(cell, side, place)
                corner = [k for k in range(3) if k != entry][kept.index(start)]
                side, start, end = 3 - entry - corner, corner, entry
        if turns < 0:  # the region lies on the right
            return rows[::-1], shifts[::-1], -place
        return rows, shifts, place

    def _turn(self, cell: int, start: int, end: int, apex: int) -> float:
        """Return twice the area of a triangle, negative if it lies right of a side."""
        a, b, c = self._filtration.corners(2, cell)[[start, end, apex]].tolist()
        return float((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))

    def _area(self, ring: _Ring) -> float:
        """Return twice the area within a ring that closes, negative if it runs clockwise."""
        rows, shifts, _ = ring
        x, y = (self._filtration.positions[rows] + shifts * self._filtration.lattice).T
        return float(x @ np.roll(y, -1) - y @ np.roll(x, -1))
