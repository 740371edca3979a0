"""The union of the balls in a periodic box: what one box holds of it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from alphamesh._arrays import read_only
from alphamesh._balls import (
    chosen_holes,
    finite_radius,
    largest_first,
    measured,
    present,
    scaled_squares,
)
from alphamesh._kernels.periodic import periodic_parts
from alphamesh._kernels.unions import Centres, Pieces
from alphamesh.errors import ParameterError
from alphamesh.periodic._box import placed
from alphamesh.periodic._filtration import PeriodicFiltration
from alphamesh.unions import UnionHoles, UnionOfBalls, UnionOfDiscs, UnionVoids

if TYPE_CHECKING:
    from alphamesh._arrays import FloatArray, IntArray, KindArray
    from alphamesh._balls import Measured
    from alphamesh._kernels import Progress

__all__ = [
    "BallChannels",
    "DiscChannels",
    "PeriodicUnionOfBalls",
    "PeriodicUnionOfDiscs",
    "periodic_union",
]


@dataclass(frozen=True, eq=False, repr=False)
class DiscChannels(UnionHoles):
    """The parts of the plane without discs that run through all boxes, the largest first.

    As :class:`~alphamesh.unions.UnionHoles`; areas and perimeters are those in one box.

    Attributes
    ----------
    ranks : (c,) int8
        In how many independent directions each goes on without end: 1 for a strip between
        rows of discs, 2 for what is around them all.
    """

    ranks: KindArray

    def __repr__(self) -> str:
        return f"<DiscChannels: {len(self):,}>"


@dataclass(frozen=True, eq=False, repr=False)
class BallChannels(UnionVoids):
    """The parts of space without balls that run through all boxes, the largest first.

    As :class:`~alphamesh.unions.UnionVoids`; volumes and surface areas are those in one box.

    Attributes
    ----------
    ranks : (c,) int8
        In how many independent directions each goes on without end: 1 for a tube, 2 for a
        layer, 3 for a network.
    """

    ranks: KindArray

    def __repr__(self) -> str:
        return f"<BallChannels: {len(self):,}>"


class _InBox:
    """What unions of discs and of balls in a box have in common."""

    filtration: PeriodicFiltration
    channels: DiscChannels | BallChannels

    @property
    def points(self) -> FloatArray:
        """The centres in the box, ``(n, d)`` float64."""
        return self.filtration.positions

    def __repr__(self) -> str:
        count = len(self.channels)
        return f"<Periodic{super().__repr__()[1:-1]}, {count:,} channel{'s' * (count != 1)}>"


@dataclass(frozen=True, eq=False, repr=False)
class PeriodicUnionOfDiscs(_InBox, UnionOfDiscs):
    """The union of the discs of a periodic box and of all their copies: what one box holds.

    As :class:`~alphamesh.unions.UnionOfDiscs`. A disc may overlap its own copies. Holes are
    bounded; what runs on through all boxes is a channel, unless it reaches the outside of a
    box that is open. If none is, the areas of the union, its holes and its channels add up
    to that of the box.

    Attributes
    ----------
    channels : DiscChannels
    """

    filtration: PeriodicFiltration  # type: ignore[assignment]
    channels: DiscChannels

    @property
    def filled_share(self) -> float:
        """The share of the box that discs cover, from 0 to 1; 0 if a direction is open."""
        return self.area / self.filtration.box_size

    def channel_discs(self, channel: int) -> IntArray:
        """Return the rows whose discs bound a channel, ascending int32.

        Raises
        ------
        IndexError
            If there is no such channel.
        """
        return self._cells_of(self.channels.labels, channel, len(self.channels), "channel")


@dataclass(frozen=True, eq=False, repr=False)
class PeriodicUnionOfBalls(_InBox, UnionOfBalls):
    """The union of the balls of a periodic box and of all their copies: what one box holds.

    As :class:`~alphamesh.unions.UnionOfBalls`. A ball may overlap its own copies. Voids are
    bounded; what runs on through all boxes is a channel, unless it reaches the outside of a
    box that is open. If none is, the volumes of the union, its voids and its channels add
    up to that of the box.

    Attributes
    ----------
    channels : BallChannels
    """

    filtration: PeriodicFiltration  # type: ignore[assignment]
    channels: BallChannels

    @property
    def filled_share(self) -> float:
        """The share of the box that balls fill, from 0 to 1; 0 if a direction is open."""
        return self.volume / self.filtration.box_size

    def channel_balls(self, channel: int) -> IntArray:
        """Return the rows whose balls bound a channel, ascending int32.

        Raises
        ------
        IndexError
            If there is no such channel.
        """
        return self._cells_of(self.channels.labels, channel, len(self.channels), "channel")


def periodic_union(
    filtration: PeriodicFiltration,
    radius: float,
    *,
    threads: int | None = None,
    progress: Progress | None = None,
) -> PeriodicUnionOfDiscs | PeriodicUnionOfBalls:
    """Measure the union of the balls of `radius` around the points of a periodic box.

    Parameters
    ----------
    filtration : PeriodicFiltration
    radius, threads, progress
        See :func:`alphamesh.union_of_balls`, also for the errors.

    Returns
    -------
    PeriodicUnionOfDiscs or PeriodicUnionOfBalls

    Notes
    -----
    Per box, the pieces of the union are those of the simplices of the quotient, each
    counted once: what a piece measures is told by its simplex alone.
    """
    given: Any = filtration
    if not isinstance(given, PeriodicFiltration):
        raise ParameterError(
            f"periodic_union needs a periodic filtration, not {type(given).__name__}; "
            "use AlphaComplex(points, periods=...).union(radius)"
        )
    radius = finite_radius(radius, given)
    found, ranks = _measured(given, radius, threads, progress)
    holes = largest_first(found.hole_contents, ranks == 0)
    channels = largest_first(found.hole_contents, ranks > 0)
    return _named(
        given,
        radius,
        chosen_holes(found, holes),
        chosen_holes(found, channels),
        read_only(ranks.take(channels)),
    )


def _named(
    filtration: PeriodicFiltration,
    radius: float,
    found: Measured,
    channels: Measured,
    ranks: KindArray,
) -> PeriodicUnionOfDiscs | PeriodicUnionOfBalls:
    """Return measures by the names that they have in the plane and in space."""
    own, through = found[3:], (*channels[3:], ranks)
    if filtration.points.shape[1] == 2:
        return PeriodicUnionOfDiscs(
            filtration, radius, *found[:3], UnionHoles(*own), DiscChannels(*through)
        )
    return PeriodicUnionOfBalls(
        filtration, radius, *found[:3], UnionVoids(*own), BallChannels(*through)
    )


def _measured(
    filtration: PeriodicFiltration,
    radius: float,
    threads: int | None,
    progress: Progress | None,
) -> tuple[Measured, KindArray]:
    """Return the measures, and the ranks of the parts of what is left of the box."""
    d = filtration.points.shape[1]
    has = present(filtration, radius)
    if filtration.dimension == d:
        cofaces = filtration.facet_cells
    else:
        cofaces = np.full((len(filtration.simplices[d - 1]), 2), -1, dtype=np.int32)
    parts, ranks = periodic_parts(
        filtration.offsets[d], filtration.faces[d], cofaces, has[-1], has[-2]
    )
    if filtration.periodic.all():
        # All is filled there: how large balls are beyond that changes nothing.
        radius = min(radius, max(float(radii.max(initial=0.0)) for radii in filtration.radii))
    centres, exponent, simplices = _copied(filtration, radius)
    pieces = Pieces(simplices, filtration.faces[2:], cofaces, has, parts, len(ranks))
    return measured(centres, pieces, exponent, threads, progress), ranks


def _copied(
    filtration: PeriodicFiltration, radius: float
) -> tuple[Centres, int, tuple[IntArray, ...]]:
    """Return balls and their copies, over a power of two; and simplices made of them."""
    count, d = filtration.points.shape
    simplices, keys = _numbered(filtration)
    rows = np.concatenate((np.arange(count), keys % max(1, count))).astype(np.int32)
    codes = np.concatenate((np.zeros(count, dtype=np.int64), keys // max(1, count)))
    offsets = np.zeros((len(rows), 3), dtype=np.int8)
    for axis in range(d):
        offsets[:, axis] = (codes // 3 ** (d - 1 - axis) + 1) % 3 - 1
    place = placed(filtration.points, filtration.periods)
    high, low = (np.ascontiguousarray(part[:, :d]) for part in place.at(rows, offsets))
    weights, power = scaled_squares(filtration.weights, radius, -place.exponent)
    centres = Centres(high, weights, power, low if low.any() else None, rows)
    return centres, -place.exponent, simplices


def _numbered(filtration: PeriodicFiltration) -> tuple[tuple[IntArray, ...], IntArray]:
    """Return simplices made of numbers of balls and of copies, and what copies these are.

    The first copy follows the last ball. Copy of row r is n c + r, where n is the number of
    points, and the digits of c to the base 3 are its offsets, 2 standing for -1.
    """
    count, d = filtration.points.shape
    powers = 3 ** np.arange(d - 1, -1, -1)
    keys = [
        rows + count * (offsets % 3 @ powers)
        for rows, offsets in zip(filtration.simplices[1:], filtration.offsets[1:], strict=True)
    ]
    copies: IntArray = np.unique(np.concatenate([key[key >= count] for key in keys]))
    numbered = []
    for key in keys:
        far = key >= count
        number = key.astype(np.int32)
        number[far] = count + np.searchsorted(copies, key[far])
        numbered.append(number)
    return tuple(numbered), copies
