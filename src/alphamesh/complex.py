"""The object that users hold: an alpha complex, built once, looked at in many ways."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Self

from alphamesh._weights import hidden_text
from alphamesh.classify import critical_radii
from alphamesh.curves import MeasureCurves, measure_curves
from alphamesh.export import Exports
from alphamesh.filtration import filtration_in_plane
from alphamesh.hull import ConvexHull
from alphamesh.hull import convex_hull as find_convex_hull
from alphamesh.persistence import Persistence
from alphamesh.persistence import persistence as find_persistence
from alphamesh.points import Cloud, as_cloud
from alphamesh.radius import RadiusChoice, choose_radius
from alphamesh.restricted import RestrictedVoronoi, restricted_voronoi
from alphamesh.shape import AlphaShape
from alphamesh.shown import Shown
from alphamesh.unions import UnionOfDiscs, union_of_balls
from alphamesh.voronoi import Voronoi, voronoi_of

if TYPE_CHECKING:
    import os

    from matplotlib.axes import Axes

    from alphamesh._arrays import FloatArray, IntArray
    from alphamesh._kernels import Progress
    from alphamesh.delaunay import Delaunay
    from alphamesh.film import Film
    from alphamesh.filtration import Filtration
    from alphamesh.plot import Drawing

__all__ = ["AlphaComplex"]


class AlphaComplex(Exports, Shown):
    """The alpha complex of a cloud: its Delaunay triangulation and exact filtration.

    Parameters
    ----------
    points : array-like of shape (n, 2) or (n, 3)
        Arrays, lists, DataFrames of two or three numeric columns; GeoDataFrames,
        GeoSeries and lists of Points; tables from :func:`alphamesh.read_table`. Copied.
        Duplicates are merged. Any number of points is legal: none, one, all on one line.
        Three columns give an :class:`~alphamesh.AlphaComplex3D`.
    weights : array-like of shape (n,), optional
        Squared radii of balls around the points, of any sign, in squared units of the
        points: the ball of point i has the squared radius ``weights[i] + r**2`` at radius r,
        and ``weights[i] - r**2`` at radius -r [1]_. By default all balls are of equal size.
    threads : int, optional
        Threads to use; by default one for each usable CPU. The result does not depend
        on it.
    progress : callable, optional
        Called with the fraction that is done, from 0 to 1, about ten times a second.
    periods : sequence of float or None, optional
        The side lengths of a periodic box, None where it is open, such as
        ``(10, 10, None)``. They give a :class:`~alphamesh.PeriodicComplex`.

    Raises
    ------
    CloudShapeError, NonFiniteError, CoordinateRangeError, CloudTooLargeError
        If there is no exact complex of such points; the message names the rows.
    WeightsError
        If there is not one finite weight for each point.
    ParameterError
        If `threads` or `progress` is not what it must be.

    Warns
    -----
    GeographicCoordinatesWarning
        If the points come with a reference system of longitudes and latitudes.

    Notes
    -----
    Nothing in an alpha complex can change: arrays are read-only, and a copy is the
    object itself.

    References
    ----------
    .. [1] H. Edelsbrunner, The union of balls and its dual shape, Discrete &
       Computational Geometry 13 (1995) 415-440.

    Examples
    --------
    >>> import alphamesh as am
    >>> cx = am.AlphaComplex([[0, 0], [2, 0], [0, 2], [2, 2], [9, 1]])
    >>> cx.at(1.5)
    <AlphaShape at radius 1.5: 2 triangles, 1 isolated vertices>
    >>> cx.at(1.5).area
    4.0
    """

    __slots__ = ("__weakref__", "_filtration", "_hull", "_persistence", "_voronoi")

    _filtration: Filtration
    _persistence: Persistence | None
    _hull: ConvexHull | None
    _voronoi: Voronoi | None

    def __new__(
        cls,
        points: Any,
        *,
        weights: Any = None,
        periods: Any = None,
        threads: int | None = None,
        progress: Progress | None = None,
    ) -> Self:
        """Return the class that the columns of the points, or `periods`, ask for."""
        cloud = as_cloud(points, weights=weights)
        if periods is not None:
            from alphamesh.periodic_complex import periodic_complex

            boxed: Any = periodic_complex(cloud, periods, threads=threads, progress=progress)
            return boxed  # type: ignore[no-any-return]
        kind: Any = cls
        if cls is AlphaComplex and cloud.points.shape[1] == 3:
            from alphamesh.complex3d import AlphaComplex3D

            kind = AlphaComplex3D
        made: Self = _from_filtration(kind, kind._built(cloud, threads, progress))
        return made

    @staticmethod
    def _built(points: Any, threads: int | None, progress: Progress | None) -> Any:
        return filtration_in_plane(points, threads=threads, progress=progress)

    @property
    def filtration(self) -> Filtration:
        """Every simplex and its filtration value."""
        return self._filtration

    @property
    def points(self) -> FloatArray:
        """The cloud, ``(n, 2)`` float64."""
        return self._filtration.points

    @property
    def representative(self) -> IntArray:
        """The lowest row with the coordinates of each row, ``(n,)`` int32.

        With weights, the lowest of the heaviest with these coordinates.
        """
        return self._filtration.representative

    @property
    def dimension(self) -> int:
        """Dimension of the cloud: 2, 1 if on one line, 0 if at one point, -1 if empty."""
        return self._filtration.dimension

    @property
    def simplices(self) -> tuple[IntArray, IntArray, IntArray]:
        """Vertices, edges and triangles: rows of `points`, ``(m_k, k + 1)`` int32."""
        return self._filtration.simplices

    @property
    def radii(self) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Filtration values of `simplices`, ``(m_k,)`` float64 in the units of the points."""
        return self._filtration.radii

    @property
    def delaunay(self) -> Delaunay:
        """The Delaunay triangulation, with the neighbours of each triangle."""
        return self._filtration.delaunay

    @property
    def convex_hull(self) -> ConvexHull:
        """The convex hull, without points between its corners."""
        if self._hull is None:
            self._hull = find_convex_hull(Cloud(self.points))
        return self._hull

    @property
    def voronoi(self) -> Voronoi:
        """The Voronoi diagram, dual to the triangulation."""
        if self._voronoi is None:
            self._voronoi = voronoi_of(self._filtration)
        return self._voronoi

    def restricted_voronoi(
        self,
        radius: float | None = None,
        *,
        threads: int | None = None,
        progress: Progress | None = None,
    ) -> RestrictedVoronoi:
        """Return every Voronoi cell cut by the disc of `radius` around its point.

        Parameters
        ----------
        radius : float, optional
            Finite, in the units of the points; by default the one that
            :meth:`choose_radius` chooses.
        threads, progress : optional
            See :func:`alphamesh.restricted_voronoi`, also for the errors.
        """
        if radius is None:
            radius = self.choose_radius().radius
        return restricted_voronoi(self._filtration, radius, threads=threads, progress=progress)

    def union(self, radius: float | None = None, **options: Any) -> UnionOfDiscs:
        """Measure the union of the discs of `radius`, by default of the one chosen.

        Parameters and errors are those of :func:`alphamesh.union_of_balls`.
        """
        if radius is None:
            radius = self.choose_radius().radius
        return union_of_balls(self._filtration, radius, **options)

    def persistence(
        self, *, threads: int | None = None, progress: Progress | None = None
    ) -> Persistence:
        """Return when components and holes come and go; computed once, near-linear time.

        Parameters and errors are those of :func:`alphamesh.persistence`.
        """
        if self._persistence is None:
            self._persistence = find_persistence(
                self._filtration, threads=threads, progress=progress
            )
        return self._persistence

    def choose_radius(self, rule: str | None = None, **options: Any) -> RadiusChoice:
        """Choose a radius, and say why.

        Parameters and errors are those of :func:`alphamesh.choose_radius`.
        """
        return choose_radius(self._filtration, rule, **options)

    def at(self, radius: float | None = None) -> AlphaShape:
        """Return the complex at one radius: all simplices of value <= radius.

        Parameters
        ----------
        radius : float, optional
            In the units of the points; by default the one that :meth:`choose_radius`
            chooses. Negative ones are for points with weights alone.

        Returns
        -------
        AlphaShape

        Raises
        ------
        ParameterError
            If `radius` is not a number, or NaN, or negative without weights.
        EmptyCloudError
            If there are no points to choose a radius for.
        """
        if radius is None:
            radius = self.choose_radius().radius
        return AlphaShape(self._filtration, radius)

    def critical_radii(self) -> FloatArray:
        """Return every radius at which the complex changes, ascending, without repeats.

        Returns
        -------
        (k,) float64
            Starts with 0, where the points appear, unless there are none or they have
            weights. Between one and the next, all complexes are the same.
        """
        return critical_radii(self._filtration.radii, weighted=self.weights is not None)

    def measure_curves(self) -> MeasureCurves:
        """Return area, perimeter and counts as functions of the radius, in one pass.

        Returns
        -------
        MeasureCurves
        """
        return measure_curves(self._filtration)

    def plot(self, radius: float | None = None, ax: Axes | None = None) -> Drawing:
        """Draw the complex at `radius` on matplotlib axes, new ones if `ax` is None.

        See :meth:`at` for the radius and :func:`alphamesh.plot.plot_complex`.
        """
        return self.at(radius).plot(ax)

    def animate(self, path: str | os.PathLike[str], **options: Any) -> Film:
        """Make a film of the growing radius: cells and complex, in space the complex alone.

        Parameters and errors are those of :func:`alphamesh.animate`.
        """
        from alphamesh.film import animate

        return animate(self.persistence(), path, **options)

    def __repr__(self) -> str:
        vertices, edges, triangles = (f"{len(rows):,}" for rows in self.simplices)
        return (
            f"<AlphaComplex: {vertices} vertices, {edges} edges, {triangles} triangles"
            f"{hidden_text(self.hidden)}>"
        )

    def __reduce__(self) -> tuple[Any, tuple[Any, ...]]:
        return _from_filtration, (type(self), self._filtration)


def _from_filtration(kind: type[Any], filtration: Filtration) -> Any:
    """Return the complex that has `filtration`, without computing it again."""
    made = object.__new__(kind)
    made._filtration = filtration
    made._persistence = None
    made._hull = None
    made._voronoi = None
    return made
