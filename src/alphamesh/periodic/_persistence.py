"""Persistence in a periodic box: its torus has classes that never die."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NoReturn

import numpy as np

from alphamesh._arrays import read_only
from alphamesh.errors import ParameterError, PeriodicError
from alphamesh.periodic._filtration import PeriodicFiltration
from alphamesh.persistence import Persistence

if TYPE_CHECKING:
    from alphamesh._arrays import IntArray
    from alphamesh._kernels import Progress

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

    # Cycles that may run around the box

    def holes(self, *_: Any) -> NoReturn:
        """Not there in periodic boxes."""
        raise _no_cycles("holes")

    def loops(self, *_: Any) -> NoReturn:
        """Not there in periodic boxes."""
        raise _no_cycles("loops")

    def voids(self, *_: Any) -> NoReturn:
        """Not there in periodic boxes."""
        raise _no_cycles("voids")

    def __repr__(self) -> str:
        lasting = [int((b < d).sum()) for b, d in zip(self.births, self.deaths, strict=True)]
        names = ("components", "loops", "voids", "bodies")
        facts = [f"{count:,} {name}" for count, name in zip(lasting, names, strict=False)]
        staying = ", ".join(str(len(rows)) for rows in self.essential)
        return f"<PeriodicPersistence: {', '.join(facts[:-1])} that end; {staying} that stay>"


def _no_cycles(kind: str) -> PeriodicError:
    return PeriodicError(
        f"representative {kind} are not traced in periodic boxes, where they may run around "
        "the box; pairs names the simplices that begin and end them, filtration.corners() "
        "where these are"
    )


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
