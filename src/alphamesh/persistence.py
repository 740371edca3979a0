"""Persistence: when components and holes of the growing complex come and go."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from alphamesh._arrays import Record, read_only
from alphamesh.betti import StepCurve, alive_counts, checked_radii, steps_of
from alphamesh.cycles import Rings, hole_rings
from alphamesh.errors import ParameterError
from alphamesh.filtration import Filtration

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from alphamesh._arrays import BoolArray, CountArray, FloatArray, IntArray
    from alphamesh._kernels import Progress

__all__ = ["Persistence", "persistence"]


@dataclass(frozen=True, eq=False, repr=False)
class Persistence(Record):
    """The classes of homology of a filtration over Z/2: which simplices begin and end them.

    A class of dimension 0 is a component, one of dimension 1 a loop: in the plane, a hole.
    It is born when its creator joins the growing complex and dies when its destroyer does
    [1]_. Simplices of equal value join by dimension, then in their order in the
    filtration. Of two components that meet, the one whose point has the lower row stays.

    Attributes
    ----------
    filtration : Filtration
    pairs : tuple of (p_k, 2) int32
        For each dimension k = 0, 1, 2 the classes that die, in no particular order:
        position of the creator in ``filtration.simplices[k]``, of the destroyer in
        ``filtration.simplices[k + 1]``. Pairs of equal value are among them.
    essential : tuple of (e_k,) int32
        For each dimension the creators of classes that never die, as positions in
        ``filtration.simplices[k]``: in the plane one component, unless the cloud is empty.

    References
    ----------
    .. [1] H. Edelsbrunner and J. Harer, Computational Topology, American Mathematical
       Society 2010, chapter VII.
    """

    filtration: Filtration
    pairs: tuple[IntArray, IntArray, IntArray]
    essential: tuple[IntArray, IntArray, IntArray]

    # In radii

    @cached_property
    def births(self) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Birth of each of `pairs`, three ``(p_k,)`` float64 arrays of radii."""
        taken = (
            radii.take(pairs[:, 0])
            for radii, pairs in zip(self.filtration.radii, self.pairs, strict=True)
        )
        zero, one, two = (read_only(values) for values in taken)
        return zero, one, two

    @cached_property
    def deaths(self) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Death of each of `pairs`, three ``(p_k,)`` float64 arrays of radii."""
        radii = (*self.filtration.radii[1:], np.empty(0))
        taken = (
            values.take(pairs[:, 1]) for values, pairs in zip(radii, self.pairs, strict=True)
        )
        zero, one, two = (read_only(values) for values in taken)
        return zero, one, two

    def diagram(
        self, dimension: int, *, squared: bool = False, zero_length: bool = False
    ) -> FloatArray:
        """Return the persistence diagram of one dimension.

        Parameters
        ----------
        dimension : int
            0 for components, 1 for loops; there are none of dimension 2 in the plane.
        squared : bool, default False
            Give squared radii, the values of GUDHI's alpha complexes. What is too large
            for float64 becomes infinite, what is too small zero.
        zero_length : bool, default False
            Keep classes that die the moment they are born.

        Returns
        -------
        (k, 2) float64
            Birth and death in the units of the points, ascending by birth, then death;
            death is infinite for classes that stay. An array of one's own.

        Raises
        ------
        ParameterError
            If `dimension` is not 0, 1 or 2.
        """
        k = _checked_dimension(dimension)
        births, deaths = self.births[k], self.deaths[k]
        if not zero_length:
            lasting = births < deaths
            births, deaths = births.compress(lasting), deaths.compress(lasting)
        staying = self.filtration.radii[k].take(self.essential[k])
        rows = np.column_stack(
            (
                np.concatenate((births, staying)),
                np.concatenate((deaths, np.full(len(staying), np.inf))),
            )
        )
        rows = rows.take(np.lexsort((rows[:, 1], rows[:, 0])), axis=0)
        if squared:
            with np.errstate(over="ignore", under="ignore"):
                np.square(rows, out=rows)
        return rows

    def diagrams(
        self, *, squared: bool = False, zero_length: bool = False
    ) -> tuple[FloatArray, FloatArray]:
        """Return :meth:`diagram` of dimensions 0 and 1, as ``persim`` takes them."""
        zero, one = (self.diagram(k, squared=squared, zero_length=zero_length) for k in (0, 1))
        return zero, one

    # Betti numbers

    def betti_numbers(self, radius: ArrayLike) -> CountArray:
        """Return how many components and holes the complex has at each radius.

        Parameters
        ----------
        radius : float or array of floats of any shape
            Not negative; infinity gives the whole triangulation.

        Returns
        -------
        (..., 2) int64
            The shape of `radius`, then b0, b1.

        Raises
        ------
        ParameterError
            If a radius is not a number, negative or NaN.
        """
        radii = checked_radii(radius)
        numbers = np.stack(
            [alive_counts(*sorted_, radii) for sorted_ in self._sorted_lives], axis=-1
        )
        return read_only(numbers)

    def betti_curve(self) -> StepCurve:
        """Return b0 and b1 as exact step functions of the radius.

        Returns
        -------
        StepCurve
            ``radii``, (k,) float64, starts with 0, and ``values``, (k, 2) int64, holds
            b0, b1 from each radius up to the next.
        """
        return steps_of(self.betti_numbers, self._sorted_lives)

    def euler_curve(self) -> StepCurve:
        """Return the Euler characteristic b0 - b1 as an exact step function of the radius.

        Returns
        -------
        StepCurve
            ``radii``, (k,) float64, starts with 0, and ``values``, (k,) int64.
        """
        return steps_of(
            lambda radii: np.subtract(*np.moveaxis(self.betti_numbers(radii), -1, 0)),
            self._sorted_lives,
        )

    @cached_property
    def _sorted_lives(self) -> tuple[tuple[FloatArray, FloatArray], ...]:
        """Births and deaths of lasting classes of dimensions 0 and 1, each ascending."""
        lives = []
        for k in (0, 1):
            lasting = self.births[k] < self.deaths[k]
            births = (
                self.births[k].compress(lasting),
                self.filtration.radii[k].take(self.essential[k]),
            )
            deaths = self.deaths[k].compress(lasting)
            lives.append((np.sort(np.concatenate(births)), np.sort(deaths)))
        return tuple(lives)

    # Cycles

    def alive(self, radius: float, dimension: int = 1) -> IntArray:
        """Return the classes that are there at a radius and die later.

        Parameters
        ----------
        radius : float
        dimension : int, default 1

        Returns
        -------
        (m,) int32
            Rows of ``pairs[dimension]``, those that die last first.

        Raises
        ------
        ParameterError
            If `radius` is negative or no number, or there is no such dimension.
        """
        k = _checked_dimension(dimension)
        value = float(checked_radii(radius).reshape(()))
        alive: BoolArray = (self.births[k] <= value) & (value < self.deaths[k])
        rows = np.flatnonzero(alive)
        latest_first = np.argsort(-self.deaths[k].take(rows), kind="stable")
        return read_only(rows.take(latest_first).astype(np.int32))

    def holes(self, classes: ArrayLike) -> Rings:
        """Return the rings around holes at their birth: representative cycles.

        Parameters
        ----------
        classes : int or sequence of int
            Rows of ``pairs[1]``, as :meth:`alive` gives them.

        Returns
        -------
        Rings
            Closed rings of rows of the points: the border of the region that the hole
            covers when it is born. The first ring of a hole runs around it, others
            around what lies within it.

        Raises
        ------
        ParameterError
            If there is no such class.
        """
        return hole_rings(self.filtration, self.pairs[1], classes)

    def __repr__(self) -> str:
        components, holes = (int((b < d).sum()) for b, d in zip(*self._lives, strict=True))
        components += len(self.essential[0])
        return f"<Persistence: {components:,} components, {holes:,} holes that come and go>"

    @property
    def _lives(self) -> tuple[tuple[FloatArray, ...], tuple[FloatArray, ...]]:
        return self.births[:2], self.deaths[:2]


def persistence(
    filtration: Filtration, *, threads: int | None = None, progress: Progress | None = None
) -> Persistence:
    """Pair the simplices of a filtration that begin and end its classes of homology.

    Components are found by union-find over the edges, holes by union-find over the
    triangles backwards [1]_: near-linear time, no matrix.

    Parameters
    ----------
    filtration : Filtration
        From :func:`alphamesh.filtration`, or ``AlphaComplex.filtration``.
    threads : int, optional
        Threads to use; by default one for each usable CPU. The result does not depend
        on it.
    progress : callable, optional
        Called with the fraction that is done, from 0 to 1, about ten times a second.

    Returns
    -------
    Persistence

    Raises
    ------
    ParameterError
        If `filtration` is none, or `threads` or `progress` is not what it must be.

    References
    ----------
    .. [1] C. J. A. Delfinado and H. Edelsbrunner, An incremental algorithm for Betti
       numbers of simplicial complexes, Computer Aided Geometric Design 12 (1995) 771-784.
    """
    given: Any = filtration
    if not isinstance(given, Filtration):
        raise ParameterError(
            f"persistence needs a filtration, not {type(given).__name__}; "
            "make one with alphamesh.filtration(points), or use AlphaComplex.persistence()"
        )
    components, loops = filtration.pairs(threads=threads, progress=progress)
    survivors = np.ones(len(filtration.simplices[0]), dtype=bool)
    survivors[components[:, 0]] = False
    none = read_only(np.empty(0, dtype=np.int32))
    return Persistence(
        filtration,
        (components, loops, read_only(np.empty((0, 2), dtype=np.int32))),
        (read_only(np.flatnonzero(survivors).astype(np.int32)), none, none),
    )


def _checked_dimension(dimension: int) -> int:
    if dimension in (0, 1, 2):
        return int(dimension)
    raise ParameterError(
        f"dimension must be 0 (components), 1 (loops) or 2 (voids); got {dimension!r}"
    )
