"""Persistence: when components, loops and voids of the growing complex come and go."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from alphamesh._arrays import Record, read_only
from alphamesh._weights import signed_square
from alphamesh.betti import StepCurve, alive_counts, checked_radii, steps_of
from alphamesh.cycles import Rings, hole_rings
from alphamesh.errors import DimensionError, ParameterError
from alphamesh.filtration import Filtration
from alphamesh.filtration3d import Filtration3D
from alphamesh.loops import shortest_loops
from alphamesh.voids import VoidShells, void_shells

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from alphamesh._arrays import BoolArray, CountArray, FloatArray, IntArray
    from alphamesh._kernels import Progress
    from alphamesh.filtration import AnyFiltration

__all__ = ["Persistence", "persistence"]


@dataclass(frozen=True, eq=False, repr=False)
class Persistence(Record):
    """The classes of homology of a filtration over Z/2: which simplices begin and end them.

    A class of dimension 0 is a component, one of dimension 1 a loop (in the plane, a
    hole), one of dimension 2 a void. It is born when its creator joins the growing
    complex and dies when its destroyer does [1]_. Simplices of equal value join by
    dimension, then in their order in the filtration. Of two components that meet, the one
    that was born first stays; where both were, as without weights all are, the one whose
    point has the lower row.

    Attributes
    ----------
    filtration : Filtration or Filtration3D
    pairs : tuple of (p_k, 2) int32
        For each dimension k = 0, 1, 2 the classes that die, in no particular order:
        position of the creator in ``filtration.simplices[k]``, of the destroyer in
        ``filtration.simplices[k + 1]``. Pairs of equal value are among them. In the plane
        there are none of dimension 2.
    essential : tuple of (e_k,) int32
        For each dimension the creators of classes that never die, as positions in
        ``filtration.simplices[k]``: one component, unless the cloud is empty.

    References
    ----------
    .. [1] H. Edelsbrunner and J. Harer, Computational Topology, American Mathematical
       Society 2010, chapter VII.
    """

    filtration: AnyFiltration
    pairs: tuple[IntArray, IntArray, IntArray]
    essential: tuple[IntArray, IntArray, IntArray]

    @property
    def _signed(self) -> bool:
        """Whether radii may be negative: if the points have weights."""
        return self.filtration.weights is not None

    @property
    def _dimensions(self) -> range:
        """The dimensions that classes can have: 0 and 1 in the plane, also 2 in space."""
        return range(self.filtration.points.shape[1])

    def _checked(self, dimension: int) -> int:
        if dimension in (0, 1, 2):
            return int(dimension)
        raise ParameterError(
            f"dimension must be 0 (components), 1 (loops) or 2 (voids); got {dimension!r}"
        )

    # In radii

    @cached_property
    def births(self) -> tuple[FloatArray, ...]:
        """Birth of each of `pairs`, ``(p_k,)`` float64 arrays of radii."""
        radii = self.filtration.radii
        return tuple(
            read_only(radii[k].take(pairs[:, 0])) for k, pairs in enumerate(self.pairs)
        )

    @cached_property
    def deaths(self) -> tuple[FloatArray, ...]:
        """Death of each of `pairs`, ``(p_k,)`` float64 arrays of radii."""
        radii = (*self.filtration.radii[1:], np.empty(0))
        return tuple(
            read_only(radii[k].take(pairs[:, 1])) for k, pairs in enumerate(self.pairs)
        )

    def diagram(
        self, dimension: int, *, squared: bool = False, zero_length: bool = False
    ) -> FloatArray:
        """Return the persistence diagram of one dimension.

        Parameters
        ----------
        dimension : int
            0 for components, 1 for loops, 2 for voids; there are none in the plane.
        squared : bool, default False
            Give squared radii, the values of GUDHI's alpha complexes: with weights, power
            values, negative where the radius is. What is too large for float64 becomes
            infinite, what is too small zero.
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
        k = self._checked(dimension)
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
        return signed_square(rows) if squared else rows

    def diagrams(
        self, *, squared: bool = False, zero_length: bool = False
    ) -> tuple[FloatArray, ...]:
        """Return :meth:`diagram` of each dimension, as ``persim`` takes them.

        These are dimensions 0 and 1 in the plane, and 0, 1 and 2 in space.
        """
        return tuple(
            self.diagram(k, squared=squared, zero_length=zero_length) for k in self._dimensions
        )

    # Betti numbers

    def betti_numbers(self, radius: ArrayLike) -> CountArray:
        """Return how many components, loops and voids the complex has at each radius.

        Parameters
        ----------
        radius : float or array of floats of any shape
            Not negative unless the points have weights; infinity gives the whole
            triangulation.

        Returns
        -------
        (..., 2) or (..., 3) int64
            The shape of `radius`, then b0, b1 in the plane; b0, b1, b2 in space.

        Raises
        ------
        ParameterError
            If a radius is not a number, or NaN, or negative without weights.
        """
        radii = checked_radii(radius, signed=self._signed)
        numbers = np.stack(
            [alive_counts(*sorted_, radii) for sorted_ in self._sorted_lives], axis=-1
        )
        return read_only(numbers)

    def betti_curve(self) -> StepCurve:
        """Return the Betti numbers as exact step functions of the radius.

        Returns
        -------
        StepCurve
            ``radii``, (k,) float64, starts with 0, with weights where the first point
            appears; and ``values``, (k, 2) or (k, 3) int64, holds :meth:`betti_numbers`
            from each radius up to the next.
        """
        return steps_of(self.betti_numbers, self._sorted_lives, signed=self._signed)

    def euler_curve(self) -> StepCurve:
        """Return the Euler characteristic b0 - b1 + b2 as an exact step function.

        Returns
        -------
        StepCurve
            ``radii``, (k,) float64, as in :meth:`betti_curve`, and ``values``, (k,) int64.
        """
        signs = np.array([(-1) ** k for k in self._dimensions], dtype=np.int64)
        return steps_of(
            lambda radii: self.betti_numbers(radii) @ signs,
            self._sorted_lives,
            signed=self._signed,
        )

    @cached_property
    def _sorted_lives(self) -> tuple[tuple[FloatArray, FloatArray], ...]:
        """Births and deaths of lasting classes of each dimension, each ascending."""
        lives = []
        for k in self._dimensions:
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
            0 for components, 1 for loops, 2 for voids.

        Returns
        -------
        (m,) int32
            Rows of ``pairs[dimension]``, those that die last first.

        Raises
        ------
        ParameterError
            If `radius` is no number, or negative without weights, or there is no such
            dimension.
        """
        k = self._checked(dimension)
        value = float(checked_radii(radius, signed=self._signed).reshape(()))
        alive: BoolArray = (self.births[k] <= value) & (value < self.deaths[k])
        rows = np.flatnonzero(alive)
        latest_first = np.argsort(-self.deaths[k].take(rows), kind="stable")
        return read_only(rows.take(latest_first).astype(np.int32))

    def holes(self, classes: ArrayLike) -> Rings:
        """Return the rings around holes in the plane at their birth: representative cycles.

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
        DimensionError
            If the points lie in space: see :meth:`loops` and :meth:`voids`.
        """
        if isinstance(self.filtration, Filtration3D):
            raise DimensionError(
                "holes have rings around them in the plane alone; in space, see "
                "loops(classes) and voids(classes)"
            )
        return hole_rings(self.filtration, self.pairs[1], classes)

    def loops(self, classes: ArrayLike) -> Rings:
        """Return a short closed path for each loop at its birth: representative cycles.

        The path runs through the edge that creates the class and takes the shortest way
        back along edges that joined before. Any such way represents the class as it is
        born: two of them differ by loops that are older.

        Parameters
        ----------
        classes : int or sequence of int
            Rows of ``pairs[1]``, as :meth:`alive` gives them.

        Returns
        -------
        Rings
            One closed path of rows of the points for each class; it starts with the lower
            end of the creating edge and ends with the other.

        Raises
        ------
        ParameterError
            If there is no such class.
        """
        return shortest_loops(self.filtration, self.pairs[1], classes)

    def voids(self, classes: ArrayLike) -> VoidShells:
        """Return the triangles around voids at their birth: representative cycles.

        Parameters
        ----------
        classes : int or sequence of int
            Rows of ``pairs[2]``, as :meth:`alive` gives them for dimension 2.

        Returns
        -------
        VoidShells
            For each class the border of the region that the void covers when it is born:
            closed surfaces, one around it and others around what lies within it.

        Raises
        ------
        ParameterError
            If there is no such class.
        DimensionError
            If the points lie in the plane, where there are no voids.
        """
        if not isinstance(self.filtration, Filtration3D):
            raise DimensionError("there are voids in space alone; in the plane, see holes()")
        return void_shells(self.filtration, self.pairs[2], classes)

    def __repr__(self) -> str:
        counts = [int((self.births[k] < self.deaths[k]).sum()) for k in self._dimensions]
        counts[0] += len(self.essential[0])
        names = ("components", "holes" if len(counts) == 2 else "loops", "voids")
        facts = [f"{count:,} {name}" for count, name in zip(counts, names, strict=False)]
        return f"<Persistence: {', '.join(facts)} that come and go>"


def persistence(
    filtration: AnyFiltration,
    *,
    threads: int | None = None,
    progress: Progress | None = None,
) -> Persistence:
    """Pair the simplices of a filtration that begin and end its classes of homology.

    Components are found by union-find over the edges, holes in the plane and voids in
    space by union-find over the cells backwards [1]_: near-linear time, no matrix. That
    leaves loops in space: the columns of the triangles and the rows of the edges that are
    in no pair yet are reduced [2]_, [3]_.

    Parameters
    ----------
    filtration : Filtration or Filtration3D
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
    .. [2] C. Chen and M. Kerber, Persistent homology computation with a twist, 27th
       European Workshop on Computational Geometry (2011).
    .. [3] U. Bauer, M. Kerber, J. Reininghaus and H. Wagner, Phat: persistent homology
       algorithms toolbox, Journal of Symbolic Computation 78 (2017) 76-90.
    """
    given: Any = filtration
    if not isinstance(given, Filtration | Filtration3D):
        raise ParameterError(
            f"persistence needs a filtration, not {type(given).__name__}; "
            "make one with alphamesh.filtration(points), or use AlphaComplex.persistence()"
        )
    found = filtration.pairs(threads=threads, progress=progress)
    none = read_only(np.empty((0, 2), dtype=np.int32))
    components, loops, voids = (*found, none)[:3]
    pairs = (components, loops, voids)
    zero, one, two = (_unpaired(filtration, pairs, k) for k in range(3))
    return Persistence(filtration, pairs, (zero, one, two))


def _unpaired(filtration: AnyFiltration, pairs: tuple[IntArray, ...], k: int) -> IntArray:
    """Return the simplices of a dimension that end no class and begin none that ends."""
    alone = np.ones(len(filtration.simplices[k]), dtype=bool)
    alone[pairs[k][:, 0]] = False
    if k > 0:
        alone[pairs[k - 1][:, 1]] = False
    return read_only(np.flatnonzero(alone).astype(np.int32))
