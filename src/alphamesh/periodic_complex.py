"""The alpha complex of a periodic box, built once, looked at in many ways."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NoReturn

import numpy as np

from alphamesh._arrays import read_only
from alphamesh.errors import PeriodicError
from alphamesh.export import Exports, write_arrays
from alphamesh.periodic import (
    PeriodicShape,
    choose_periodic_radius,
    periodic_filtration,
    periodic_persistence,
    periodic_union,
    tiled_points,
)
from alphamesh.shown import Shown

if TYPE_CHECKING:
    import os

    from matplotlib.axes import Axes

    from alphamesh._arrays import FloatArray, IntArray, KindArray
    from alphamesh._kernels import Progress
    from alphamesh.film import Film
    from alphamesh.periodic import (
        PeriodicFiltration,
        PeriodicPersistence,
        PeriodicUnionOfBalls,
        PeriodicUnionOfDiscs,
    )
    from alphamesh.plot import Drawing
    from alphamesh.radius import RadiusChoice

__all__ = ["PeriodicComplex", "periodic_complex"]


class PeriodicComplex(Exports, Shown):
    """The alpha complex of a periodic box; what ``AlphaComplex(points, periods=...)`` returns.

    Notes
    -----
    Nothing in it can change: arrays are read-only, and a copy is the object itself.

    Examples
    --------
    >>> import alphamesh as am
    >>> cx = am.AlphaComplex([[0.5, 0.5]], periods=(1, 1))
    >>> cx.at(1).betti
    (1, 2, 1)
    >>> cx.at(1).area
    1.0
    """

    __slots__ = ("__weakref__", "_filtration", "_persistence")

    _filtration: PeriodicFiltration

    def __init__(self, filtration: PeriodicFiltration) -> None:
        self._filtration = filtration
        self._persistence: PeriodicPersistence | None = None

    @property
    def filtration(self) -> PeriodicFiltration:
        """Every simplex, its offsets and its filtration value."""
        return self._filtration

    @property
    def points(self) -> FloatArray:
        """The cloud as it was given, ``(n, 2)`` or ``(n, 3)`` float64."""
        return self._filtration.points

    @property
    def positions(self) -> FloatArray:
        """The points moved into the box, ``(n, 2)`` or ``(n, 3)`` float64."""
        return self._filtration.positions

    @property
    def periods(self) -> tuple[float | None, ...]:
        """The side lengths of the box, None where it is open."""
        return self._filtration.periods

    @property
    def representative(self) -> IntArray:
        """The lowest row at the same place of the box, ``(n,)`` int32."""
        return self._filtration.representative

    @property
    def dimension(self) -> int:
        """Dimension of the cloud and its copies together; -1 if there are no points."""
        return self._filtration.dimension

    @property
    def simplices(self) -> tuple[IntArray, ...]:
        """Vertices, edges, triangles, tetrahedra: rows of `points`, ``(m_k, k + 1)`` int32."""
        return self._filtration.simplices

    @property
    def offsets(self) -> tuple[KindArray, ...]:
        """How many periods vertices lie from their positions, ``(m_k, k + 1, d)`` int8."""
        return self._filtration.offsets

    @property
    def radii(self) -> tuple[FloatArray, ...]:
        """Filtration values of `simplices`, ``(m_k,)`` float64 in the units of the points."""
        return self._filtration.radii

    @property
    def is_simplicial(self) -> bool:
        """Whether the vertices of simplices tell them apart; see :meth:`tiled`."""
        return self._filtration.is_simplicial

    def tiled(self, repeats: Any) -> PeriodicComplex:
        """Return the complex of several boxes in a row, as one larger box.

        Parameters
        ----------
        repeats : int or sequence of int
            How many boxes in each direction, 1 or more; 1 where it is open.

        Returns
        -------
        PeriodicComplex
            Its points are those of one box after another, the last direction fastest.
            Copies are rounded to float64.

        Raises
        ------
        PeriodsError
            If `repeats` are not such numbers.
        """
        points, periods = tiled_points(self.positions, self.periods, repeats)
        boxes = len(points) // max(1, len(self.points))
        weights = None if self.weights is None else np.tile(self.weights, boxes)
        return periodic_complex(points, periods, weights=weights)

    def persistence(
        self, *, threads: int | None = None, progress: Progress | None = None
    ) -> PeriodicPersistence:
        """Return when classes of homology come and go; computed once.

        Parameters and errors are those of :func:`alphamesh.persistence.persistence`.
        """
        if self._persistence is None:
            self._persistence = periodic_persistence(
                self._filtration, threads=threads, progress=progress
            )
        return self._persistence

    def choose_radius(self, rule: str | None = None, **options: Any) -> RadiusChoice:
        """Choose a radius, and say why.

        Parameters and errors are those of
        :func:`alphamesh.periodic.choose_periodic_radius`.
        """
        return choose_periodic_radius(self._filtration, rule, **options)

    def at(self, radius: float | None = None) -> PeriodicShape:
        """Return the complex at one radius: all simplices of value <= radius.

        Parameters
        ----------
        radius : float, optional
            In the units of the points; by default the one that :meth:`choose_radius`
            chooses.

        Returns
        -------
        PeriodicShape

        Raises
        ------
        ParameterError
            If `radius` is not a number, negative or NaN.
        EmptyCloudError
            If there are no points to choose a radius for.
        """
        if radius is None:
            radius = self.choose_radius().radius
        return PeriodicShape(self._filtration, radius)

    def union(
        self, radius: float | None = None, **options: Any
    ) -> PeriodicUnionOfDiscs | PeriodicUnionOfBalls:
        """Measure the union of the balls of `radius` and of all their copies, per box.

        Parameters
        ----------
        radius : float, optional
            Finite, in the units of the points; by default the one that
            :meth:`choose_radius` chooses.
        **options
            ``threads`` and ``progress``: see :func:`alphamesh.union_of_balls`, also for
            the errors.
        """
        if radius is None:
            radius = self.choose_radius().radius
        return periodic_union(self._filtration, radius, **options)

    def critical_radii(self) -> FloatArray:
        """Return every radius at which the complex changes, ascending, without repeats.

        Returns
        -------
        (k,) float64
            See :meth:`AlphaComplex.critical_radii`.
        """
        return read_only(np.unique(np.concatenate(self._filtration.radii)))

    def plot(
        self, radius: float | None = None, ax: Axes | None = None, **options: Any
    ) -> Drawing:
        """Draw the complex at `radius`, the box, and what crosses its border.

        See :meth:`at` for the radius and :func:`alphamesh.plot.plot_periodic`.
        """
        return self.at(radius).plot(ax, **options)

    def animate(self, path: str | os.PathLike[str], **options: Any) -> Film:
        """Make a film of the growing radius.

        Parameters and errors are those of :func:`alphamesh.animate`.
        """
        from alphamesh.film import animate

        return animate(self.persistence(), path, **options)

    def to_gudhi(self, *, squared: bool = False) -> Any:
        """Return the complex as a ``gudhi.SimplexTree``.

        Parameters
        ----------
        squared : bool, default False
            Give squared radii.

        Raises
        ------
        PeriodicError
            If the complex is not simplicial.
        MissingLibraryError
            If gudhi is not installed.
        """
        if not self.is_simplicial:
            raise PeriodicError(
                "too few points for the box: some simplices have a vertex twice, or the "
                "vertices of others, which a simplex tree cannot hold; repeat the box: "
                "tiled(2), or tiled(3) if that is not enough"
            )
        return super().to_gudhi(squared=squared)

    def to_numpy(self) -> dict[str, np.ndarray[Any, Any]]:
        """Return points, simplices, offsets and radii as a plain dict of arrays.

        Returns
        -------
        dict of str to ndarray
            What :func:`alphamesh.export.to_numpy` gives, ``positions`` (n, d), ``periods``
            (d,), infinite where the box is open, and ``edge_offsets``, ``triangle_offsets``
            and ``tetrahedron_offsets`` (m_k, k + 1, d) int8.
        """
        return super().to_numpy() | _arrays_of(self._filtration)

    def save_npz(self, path: str | os.PathLike[str]) -> None:
        """Write :meth:`to_numpy` into one file, to be read by ``numpy.load``.

        Parameters and errors are those of :func:`alphamesh.export.write_npz`.
        """
        write_arrays(self.to_numpy(), path)

    if not TYPE_CHECKING:

        def __getattr__(self, name: str) -> NoReturn:
            from alphamesh.complex3d import AlphaComplex3D

            if not name.startswith("_") and hasattr(AlphaComplex3D, name):
                raise PeriodicError(
                    f"complexes of periodic boxes have no {name!r}; it is there for clouds "
                    "without periods: AlphaComplex(points)"
                )
            raise AttributeError(f"'PeriodicComplex' object has no attribute {name!r}")

    def __repr__(self) -> str:
        return repr(self._filtration).replace("PeriodicFiltration", "PeriodicComplex")

    def __reduce__(self) -> tuple[Any, tuple[Any, ...]]:
        return PeriodicComplex, (self._filtration,)


def periodic_complex(
    points: Any,
    periods: Any,
    *,
    weights: Any = None,
    threads: int | None = None,
    progress: Progress | None = None,
) -> PeriodicComplex:
    """Return the alpha complex of points in a periodic box.

    Parameters and errors are those of :func:`alphamesh.periodic.periodic_filtration`.
    """
    return PeriodicComplex(
        periodic_filtration(
            points, periods, weights=weights, threads=threads, progress=progress
        )
    )


def _arrays_of(filtration: PeriodicFiltration) -> dict[str, np.ndarray[Any, Any]]:
    names = ("edge_offsets", "triangle_offsets", "tetrahedron_offsets")
    sides = [np.inf if side is None else side for side in filtration.periods]
    arrays: dict[str, np.ndarray[Any, Any]] = {
        "positions": filtration.positions,
        "periods": np.array(sides),
    }
    arrays.update(zip(names, filtration.offsets[1:], strict=False))
    return arrays
