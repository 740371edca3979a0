"""Representative cycles: the rings around a hole at the radius of its birth."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from alphamesh._arrays import Record, read_only
from alphamesh.errors import ParameterError

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from alphamesh._arrays import CountArray, FloatArray, IntArray
    from alphamesh.filtration import Filtration

__all__ = ["Rings", "checked_classes", "hole_rings", "hollow_cells", "rings_of"]

# A triangle, and the corner from which a step leaves along one of its sides.
_Place: TypeAlias = tuple[int, int]
# Where the step ends, and the triangle beyond the side.
_Step: TypeAlias = tuple[int, int]


@dataclass(frozen=True, eq=False, repr=False)
class Rings(Record):
    """Closed rings of points, flat: a ring is a slice of `vertices`.

    Iterating gives each ring as an ``(m,)`` int32 array, its first row not repeated at its
    end; rings of the same hole follow one another.

    Attributes
    ----------
    offsets : (k + 1,) int64
        Ring i is ``vertices[offsets[i]:offsets[i + 1]]``.
    vertices : (m,) int32
        Rows of the points. Where the rings are those around holes in the plane, the hole
        lies on the left: the ring around it runs counter-clockwise, rings within it run
        clockwise.
    classes : (k,) int32
        Which class, a hole or a loop, each ring belongs to.
    """

    offsets: CountArray
    vertices: IntArray
    classes: IntArray

    def __len__(self) -> int:
        return len(self.classes)

    def __getitem__(self, index: int) -> IntArray:
        if not -len(self) <= index < len(self):
            raise IndexError(f"ring {index} of {len(self)}")
        index %= len(self)
        return self.vertices[self.offsets[index] : self.offsets[index + 1]]

    def __iter__(self) -> Iterator[IntArray]:
        return (self[i] for i in range(len(self)))

    def __repr__(self) -> str:
        return f"<Rings: {len(self):,} around {len(np.unique(self.classes)):,} holes>"


def hole_rings(filtration: Filtration, loops: IntArray, classes: ArrayLike) -> Rings:
    """Return the rings around holes at their birth.

    Parameters
    ----------
    filtration : Filtration
    loops : (p, 2) int32
        Creating edge and destroying triangle of each class.
    classes : int or sequence of int
        Rows of `loops`.

    Returns
    -------
    Rings
        In the order of `classes`; of one hole, the ring around it first.

    Raises
    ------
    ParameterError
        If there is no such class.
    """
    wanted = checked_classes(classes, len(loops))
    rings: list[list[int]] = []
    owners: list[int] = []
    neighbors = _Neighbors(filtration) if len(wanted) else None
    for number in wanted.tolist():
        assert neighbors is not None
        found = neighbors.rings_of(*loops[number].tolist())
        rings += found
        owners += [number] * len(found)
    return rings_of(rings, owners)


def rings_of(rings: list[list[int]], owners: list[int]) -> Rings:
    """Return lists of rows, each with the class it belongs to, as one record."""
    lengths = [len(ring) for ring in rings]
    flat = [row for ring in rings for row in ring]
    return Rings(
        read_only(np.concatenate(([0], np.cumsum(lengths, dtype=np.int64)))),
        read_only(np.array(flat, dtype=np.int32)),
        read_only(np.array(owners, dtype=np.int32)),
    )


def checked_classes(classes: ArrayLike, count: int, dimension: int = 1) -> CountArray:
    """Return `classes` as row numbers of ``pairs[dimension]``, or say what is wrong with them.

    Raises
    ------
    ParameterError
        If they are no numbers of rows, or there is no such row.
    """
    wanted = np.atleast_1d(np.asarray(classes))
    if wanted.size == 0:
        return np.empty(0, dtype=np.int64)
    if wanted.ndim != 1 or wanted.dtype.kind not in "iu":
        raise ParameterError(
            f"classes must be rows of pairs[{dimension}], as alive(radius, {dimension}) gives "
            f"them; got {classes!r}"
        )
    wrong = wanted[(wanted < 0) | (wanted >= count)]
    if len(wrong):
        raise ParameterError(
            f"there is no class {wrong[0]}: pairs[{dimension}] has {count} rows"
        )
    return wanted.astype(np.int64)


def hollow_cells(
    facet_radii: FloatArray, cofaces: IntArray, sides: IntArray, creator: int, destroyer: int
) -> IntArray:
    """Return the cells that a hole or void covers when its last facet has just joined.

    Parameters
    ----------
    facet_radii : (F,) float64
    cofaces : (F, 2) int32
        The cells of each facet, -1 for none.
    sides : (C, d + 1) int32
        The facets of each cell.
    creator, destroyer : int
        The facet that closes the hollow off, the cell that fills it at last.

    Returns
    -------
    (m,) int32, ascending
    """
    birth = facet_radii[creator]
    seen = {destroyer}
    frontier = np.array([destroyer], dtype=np.int32)
    while len(frontier):
        around = sides.take(frontier, axis=0).ravel()
        value = facet_radii.take(around)
        # Facets of equal value join in their order.
        open_ = (value > birth) | ((value == birth) & (around > creator))
        reached = np.unique(cofaces.take(around.compress(open_), axis=0))
        fresh = [cell for cell in reached.tolist() if cell not in seen]
        seen.update(fresh)
        frontier = np.array(fresh, dtype=np.int32)
    return np.array(sorted(seen), dtype=np.int32)


class _Neighbors:
    """The triangles across edges: regions of them, and the walk around a region."""

    def __init__(self, filtration: Filtration) -> None:
        self._filtration = filtration
        self._sides = filtration.triangle_edges

    def rings_of(self, edge: int, triangle: int) -> list[list[int]]:
        """Return the rings around the hole that `edge` closes off and `triangle` fills."""
        filtration = self._filtration
        region = hollow_cells(
            filtration.radii[1], filtration.edge_triangles, self._sides, edge, triangle
        )
        corners = self._corners_of(region)
        starts = {place: end for place, (end, beyond) in corners.items() if beyond < 0}
        rings = []
        while starts:
            place = next(iter(starts))
            ring = []
            while place in starts:
                ring.append(place[1])
                place = _next_border(corners, place[0], starts.pop(place))
            rings.append(ring)
        rings.sort(key=self._leftmost)
        return rings

    def _corners_of(self, region: IntArray) -> dict[_Place, _Step]:
        """Return, for each corner of the region's triangles, the step that leaves it.

        The step runs counter-clockwise along a side of the triangle: its end, and the
        triangle of the region beyond that side, -1 if there is none.
        """
        filtration = self._filtration
        inside = np.zeros(len(filtration.simplices[2]), dtype=bool)
        inside[region] = True
        steps: dict[_Place, _Step] = {}
        rows = zip(
            region.tolist(),
            filtration.simplices[2].take(region, axis=0).tolist(),
            filtration.oriented_triangles.take(region, axis=0).tolist(),
            self._sides.take(region, axis=0).tolist(),
            strict=True,
        )
        for triangle, ascending, (a, b, c), sides in rows:
            for start, end, opposite in ((a, b, c), (b, c, a), (c, a, b)):
                side = sides[ascending.index(opposite)]
                first, second = filtration.edge_triangles[side].tolist()
                beyond = second if first == triangle else first
                if beyond >= 0 and not inside[beyond]:
                    beyond = -1
                steps[triangle, start] = end, beyond
        return steps

    def _leftmost(self, ring: list[int]) -> tuple[float, ...]:
        """Return the ring's first point from the left: the outer ring has the least."""
        xy = self._filtration.points.take(ring, axis=0)
        return tuple(xy[np.lexsort((xy[:, 1], xy[:, 0]))[0]].tolist())


def _next_border(corners: dict[_Place, _Step], triangle: int, corner: int) -> _Place:
    """Return where the border goes on from `corner`: turn about it, inside the region."""
    while (beyond := corners[triangle, corner][1]) >= 0:
        triangle = beyond
    return triangle, corner
