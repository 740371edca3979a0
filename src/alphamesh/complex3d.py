"""The alpha complex of a cloud in space, built once, looked at in many ways."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NoReturn

from alphamesh._weights import hidden_text
from alphamesh.classify import critical_radii
from alphamesh.complex import AlphaComplex
from alphamesh.curves3d import MeasureCurves3D, measure_curves_in_space
from alphamesh.errors import DimensionError
from alphamesh.filtration3d import filtration_in_space
from alphamesh.shape3d import AlphaShape3D
from alphamesh.unions import UnionOfBalls, union_of_balls

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from alphamesh._arrays import FloatArray, IntArray
    from alphamesh._kernels import Progress
    from alphamesh.delaunay3d import Delaunay3D
    from alphamesh.filtration3d import Filtration3D
    from alphamesh.hull3d import ConvexHull3D
    from alphamesh.plot import Drawing

__all__ = ["AlphaComplex3D"]

_IN_PLANE = "project the points, or choose two columns: alphamesh.AlphaComplex(points[:, :2])"


class AlphaComplex3D(AlphaComplex):
    """The alpha complex of a cloud in space; what ``AlphaComplex`` of three columns returns.

    Parameters
    ----------
    points : array-like of shape (n, 3)
        Arrays, lists, DataFrames of three numeric columns; copied. Duplicates are merged.
        Any number of points is legal: none, one, all on one line or in one plane.
    weights : array-like of shape (n,), optional
        Squared radii of balls; by default all balls are of equal size.
    threads, progress : optional
        See :class:`~alphamesh.AlphaComplex`, also for the errors.

    Examples
    --------
    >>> import alphamesh as am
    >>> cube = [[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)]
    >>> cx = am.AlphaComplex(cube)
    >>> cx.at(1).volume
    1.0
    """

    __slots__ = ()

    _filtration: Filtration3D  # type: ignore[assignment]

    @staticmethod
    def _built(points: Any, threads: int | None, progress: Progress | None) -> Any:
        return filtration_in_space(points, threads=threads, progress=progress)

    @property
    def filtration(self) -> Filtration3D:  # type: ignore[override]
        """Every simplex and its filtration value."""
        return self._filtration

    @property
    def points(self) -> FloatArray:
        """The cloud, ``(n, 3)`` float64."""
        return self._filtration.points

    @property
    def dimension(self) -> int:
        """Of the cloud: 3, 2 if in one plane, 1 if on one line, 0 if at one point, or -1."""
        return self._filtration.dimension

    @property
    def simplices(self) -> tuple[IntArray, IntArray, IntArray, IntArray]:  # type: ignore[override]
        """Vertices, edges, triangles, tetrahedra: rows of `points`, ``(m_k, k + 1)`` int32."""
        return self._filtration.simplices

    @property
    def radii(self) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:  # type: ignore[override]
        """Filtration values of `simplices`, ``(m_k,)`` float64 in the units of the points."""
        return self._filtration.radii

    @property
    def delaunay(self) -> Delaunay3D:  # type: ignore[override]
        """The Delaunay triangulation, with the neighbours of each tetrahedron."""
        return self._filtration.delaunay

    def at(self, radius: float | None = None) -> AlphaShape3D:  # type: ignore[override]
        """Return the complex at one radius: all simplices of value <= radius.

        Parameters and errors are those of :meth:`AlphaComplex.at`.

        Returns
        -------
        AlphaShape3D
        """
        if radius is None:
            radius = self.choose_radius().radius
        return AlphaShape3D(self._filtration, radius)

    def union(self, radius: float | None = None, **options: Any) -> UnionOfBalls:  # type: ignore[override]
        """Measure the union of the balls of `radius`: see :meth:`AlphaComplex.union`."""
        if radius is None:
            radius = self.choose_radius().radius
        return union_of_balls(self._filtration, radius, **options)

    def critical_radii(self) -> FloatArray:
        """Return every radius at which the complex changes, ascending, without repeats.

        Returns
        -------
        (k,) float64
            See :meth:`AlphaComplex.critical_radii`.
        """
        return critical_radii(self._filtration.radii, weighted=self.weights is not None)

    def plot(
        self, radius: float | None = None, ax: Axes | None = None, **options: Any
    ) -> Drawing:
        """Draw the complex at `radius`, lit and seen in perspective, on matplotlib axes.

        See :meth:`at` for the radius and :func:`alphamesh.plot.plot_solid` for the axes,
        new ones if `ax` is None, and for `options` such as ``cut`` and ``view``.
        """
        return self.at(radius).plot(ax, **options)

    @property
    def convex_hull(self) -> ConvexHull3D:  # type: ignore[override]
        """The convex hull: the border of the triangulation."""
        return self.delaunay.convex_hull

    def measure_curves(self) -> MeasureCurves3D:  # type: ignore[override]
        """Return volume, surface area and counts as functions of the radius, in one pass.

        Returns
        -------
        MeasureCurves3D
        """
        return measure_curves_in_space(self._filtration)

    # What there is in the plane alone

    @property
    def voronoi(self) -> NoReturn:
        """Not there in space."""
        raise DimensionError(f"Voronoi diagrams are there in the plane alone; {_IN_PLANE}")

    def restricted_voronoi(self, *_: Any, **__: Any) -> NoReturn:
        """Not there in space."""
        raise DimensionError(
            f"restricted Voronoi cells are there in the plane alone; {_IN_PLANE}"
        )

    def __repr__(self) -> str:
        vertices, edges, triangles, tetrahedra = (f"{len(rows):,}" for rows in self.simplices)
        return (
            f"<AlphaComplex3D: {vertices} vertices, {edges} edges, {triangles} triangles, "
            f"{tetrahedra} tetrahedra{hidden_text(self.hidden)}>"
        )
