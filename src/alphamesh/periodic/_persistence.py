"""Persistence in a periodic box: its torus has classes that never die."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from alphamesh._arrays import read_only
from alphamesh.errors import DimensionError, ParameterError
from alphamesh.periodic._cycles import box_holes, box_loops, box_voids
from alphamesh.periodic._filtration import PeriodicFiltration
from alphamesh.persistence import Persistence

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from alphamesh._arrays import IntArray
    from alphamesh._kernels import Progress
    from alphamesh.periodic._cycles import PeriodicRings, PeriodicShells

__all__ = ["PeriodicPersistence", "periodic_persistence"]


@dataclass(frozen=True, eq=False, repr=False)
class PeriodicPersistence(Persistence):
    """The classes of homology of a periodic filtration over Z/2.

    As :class:`~alphamesh.persistence.Persistence`, of the quotient: a chain of points from
    one face of the box to the opposite one is a loop. In the whole box the classes of the
    torus are left, which never die: Betti numbers 1, 2, 1 in the plane and 1, 3, 3, 1 in
    space if all directions are periodic; 1, 1, 0 and 1, 2, 1, 0 if one is open.

    Attributes
    ----------
    filtration : PeriodicFiltration
    pairs : tuple of (p_k, 2) int32
        For each dimension, up to that of the points, the classes that die: creator and
        destroyer.
    essential : tuple of (e_k,) int32
        For each dimension the creators of classes that never die.
    """

    filtration: PeriodicFiltration  # type: ignore[assignment]
    pairs: tuple[IntArray, ...]  # type: ignore[assignment]
    essential: tuple[IntArray, ...]  # type: ignore[assignment]

    @property
    def _dimensions(self) -> range:
        """Also that of the box: a torus is a class of its own dimension."""
        return range(self.filtration.points.shape[1] + 1)

    def _checked(self, dimension: int) -> int:
        if dimension in self._dimensions:
            return int(dimension)
        raise ParameterError(
            f"dimension must be one of {', '.join(map(str, self._dimensions))}; "
            f"got {dimension!r}"
        )

    # Cycles, which may run around the box

    def holes(self, classes: ArrayLike) -> PeriodicRings:
        """Return the rings around holes in the plane at their birth: representative cycles.

        Parameters and errors are those of :meth:`Persistence.holes`.

        Returns
        -------
        PeriodicRings
            Of a strip that runs around the box, two that wind; else the first ring of a
            hole runs around it, others around what lies within it.
        """
        if len(self.filtration.periods) != 2:
            raise DimensionError(
                "holes have rings around them in the plane alone; in space, see "
                "loops(classes) and voids(classes)"
            )
        return box_holes(self.filtration, self.pairs[1], classes)

    def loops(self, classes: ArrayLike) -> PeriodicRings:
        """Return a short closed path for each loop at its birth: representative cycles.

        Parameters and errors are those of :meth:`Persistence.loops`.

        Returns
        -------
        PeriodicRings
            A path may wind around the box, where that way is the shortest: it represents
            the class up to loops that are older.
        """
        return box_loops(self.filtration, self.pairs[1][:, 0], classes)

    def essential_loops(self) -> PeriodicRings:
        """Return a short closed path for each loop that stays, as for :meth:`loops`.

        Returns
        -------
        PeriodicRings
            In the order of ``essential[1]``. All of them wind around the box, in
            independent directions.
        """
        creators = self.essential[1]
        return box_loops(self.filtration, creators, np.arange(len(creators)))

    def voids(self, classes: ArrayLike) -> PeriodicShells:
        """Return the triangles around voids at their birth: representative cycles.

        Parameters and errors are those of :meth:`Persistence.voids`.

        Returns
        -------
        PeriodicShells
        """
        if len(self.filtration.periods) != 3:
            raise DimensionError("there are voids in space alone; in the plane, see holes()")
        return box_voids(self.filtration, self.pairs[2], classes)

    def __repr__(self) -> str:
        lasting = [int((b < d).sum()) for b, d in zip(self.births, self.deaths, strict=True)]
        names = ("components", "loops", "voids", "bodies")
        facts = [f"{count:,} {name}" for count, name in zip(lasting, names, strict=False)]
        staying = ", ".join(str(len(rows)) for rows in self.essential)
        return f"<PeriodicPersistence: {', '.join(facts[:-1])} that end; {staying} that stay>"


def periodic_persistence(
    filtration: PeriodicFiltration,
    *,
    threads: int | None = None,
    progress: Progress | None = None,
) -> PeriodicPersistence:
    """Pair the simplices of a periodic filtration that begin and end its classes.

    Parameters
    ----------
    filtration : PeriodicFiltration
    threads, progress : optional
        See :func:`alphamesh.persistence.persistence`, also for how it is done.

    Returns
    -------
    PeriodicPersistence

    Raises
    ------
    ParameterError
        If `filtration` is not periodic, or `threads` or `progress` is not what it must be.
    """
    given: Any = filtration
    if not isinstance(given, PeriodicFiltration):
        raise ParameterError(
            f"periodic_persistence needs a periodic filtration, not {type(given).__name__}; "
            "use AlphaComplex(points, periods=...).persistence()"
        )
    found = filtration.pairs(threads=threads, progress=progress)
    pairs = (*found, read_only(np.empty((0, 2), dtype=np.int32)))
    essential = []
    for k, rows in enumerate(filtration.simplices):
        alone = np.ones(len(rows), dtype=bool)
        alone[pairs[k][:, 0]] = False
        if k > 0:
            alone[pairs[k - 1][:, 1]] = False
        essential.append(read_only(np.flatnonzero(alone).astype(np.int32)))
    return PeriodicPersistence(filtration, pairs, tuple(essential))
