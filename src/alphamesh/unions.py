"""The union of balls around the points: its measures, ball by ball and void by void."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any, overload

import numpy as np

from alphamesh._arrays import Record, read_only
from alphamesh._balls import (
    ball_radii,
    chosen_holes,
    finite_radius,
    largest_first,
    measured,
    present,
    scaled,
)
from alphamesh._kernels.space import parts3
from alphamesh._kernels.unions import Pieces
from alphamesh.errors import ParameterError
from alphamesh.filtration import Filtration
from alphamesh.filtration3d import Filtration3D

if TYPE_CHECKING:
    from alphamesh._arrays import FloatArray, IntArray
    from alphamesh._balls import Measured
    from alphamesh._kernels import Progress
    from alphamesh.filtration import AnyFiltration

__all__ = ["UnionHoles", "UnionOfBalls", "UnionOfDiscs", "UnionVoids", "union_of_balls"]


@dataclass(frozen=True, eq=False, repr=False)
class _Union(Record):
    """What unions of discs and of balls have in common."""

    filtration: AnyFiltration
    radius: float

    @property
    def points(self) -> FloatArray:
        """The centres, ``(n, d)`` float64."""
        return self.filtration.points

    @property
    def weights(self) -> FloatArray | None:
        """What each squared radius is more than that of `radius`, ``(n,)`` float64, or None."""
        return self.filtration.weights

    @cached_property
    def ball_radii(self) -> FloatArray:
        """The radius of each ball, ``(n,)`` float64: ``sqrt(weights + radius**2)``.

        0 where the square is negative: no ball. See ``AlphaComplex`` for the sign of the
        radius.
        """
        return ball_radii(self.weights, self.radius, len(self.points))

    def _cells_of(self, labels: IntArray, index: int, count: int, what: str) -> IntArray:
        """Return the rows at the corners of the cells of a hole whose balls are there."""
        if not -count <= index < count:
            raise IndexError(f"{what} {index} of {count}")
        cells = self.filtration.simplices[-1].compress(labels == index % count, axis=0)
        vertices = self.filtration.simplices[0][:, 0].compress(
            self.filtration.radii[0] <= self.radius
        )
        return read_only(np.intersect1d(cells, vertices))


@dataclass(frozen=True, eq=False, repr=False)
class UnionHoles(Record):
    """The holes of a union of discs: bounded parts of the plane without it, the largest first.

    Attributes
    ----------
    labels : (T,) int32
        The hole in which each triangle of the filtration lies, but for what discs cover of
        it; -1 if in none.
    areas, perimeters : (h,) float64

    All arrays are read-only.
    """

    labels: IntArray
    areas: FloatArray
    perimeters: FloatArray

    def __len__(self) -> int:
        return len(self.areas)

    def __repr__(self) -> str:
        return f"<UnionHoles: {len(self):,}>"


@dataclass(frozen=True, eq=False, repr=False)
class UnionVoids(Record):
    """The voids of a union of balls: bounded parts of space without it, the largest first.

    Attributes
    ----------
    labels : (T,) int32
        The void in which each tetrahedron of the filtration lies, but for what balls cover
        of it; -1 if in none.
    volumes, surface_areas : (v,) float64

    All arrays are read-only.
    """

    labels: IntArray
    volumes: FloatArray
    surface_areas: FloatArray

    def __len__(self) -> int:
        return len(self.volumes)

    def __repr__(self) -> str:
        return f"<UnionVoids: {len(self):,}>"


@dataclass(frozen=True, eq=False, repr=False)
class UnionOfDiscs(_Union):
    """The union of the discs around the points of a cloud in the plane: its measures.

    All in closed form, by the pieces into which the alpha complex cuts the union [1]_.

    Attributes
    ----------
    filtration : Filtration
    radius : float
        Of the discs; of a weighted cloud, their squared radii are ``weights + radius**2``,
        the square being negative if the radius is.
    area : float
        In squared units of the points.
    disc_areas : (n,) float64
        Area of each disc's part: where no other is nearer (of a weighted cloud, by power
        distance). Together they are the whole.
    disc_perimeters : (n,) float64
        Length of each disc's part of the boundary.
    holes : UnionHoles
        The bounded parts of the plane without discs: their areas and perimeters.

    All arrays are read-only. Duplicates and hidden points have no part: their numbers are 0.

    References
    ----------
    .. [1] H. Edelsbrunner, The union of balls and its dual shape, Discrete &
       Computational Geometry 13 (1995) 415-440.
    """

    filtration: Filtration
    area: float
    disc_areas: FloatArray
    disc_perimeters: FloatArray
    holes: UnionHoles

    @property
    def perimeter(self) -> float:
        """Length of the boundary, that of holes and all."""
        with np.errstate(over="ignore"):
            return float(self.disc_perimeters.sum())

    @property
    def disc_radii(self) -> FloatArray:
        """The radius of each disc, ``(n,)`` float64; 0 for none."""
        return self.ball_radii

    def hole_discs(self, hole: int) -> IntArray:
        """Return the rows whose discs bound a hole, ascending int32.

        Raises
        ------
        IndexError
            If there is no such hole.
        """
        return self._cells_of(self.holes.labels, hole, len(self.holes), "hole")

    def __repr__(self) -> str:
        holes = len(self.holes)
        return (
            f"<UnionOfDiscs at radius {self.radius:.6g}: area {self.area:.6g}, "
            f"perimeter {self.perimeter:.6g}, {holes:,} hole{'s' * (holes != 1)}>"
        )


@dataclass(frozen=True, eq=False, repr=False)
class UnionOfBalls(_Union):
    """The union of the balls around the points of a cloud in space: its measures.

    All in closed form, by the pieces into which the alpha complex cuts the union [1]_.

    Attributes
    ----------
    filtration : Filtration3D
    radius : float
        Of the balls; of a weighted cloud, their squared radii are ``weights + radius**2``,
        the square being negative if the radius is.
    volume : float
        In cubed units of the points.
    ball_volumes : (n,) float64
        Volume of each ball's part: where no other is nearer (of a weighted cloud, by power
        distance). Together they are the whole.
    ball_surface_areas : (n,) float64
        Area of each ball's part of the boundary.
    voids : UnionVoids
        The bounded parts of space without balls: their volumes and surface areas.

    All arrays are read-only. Duplicates and hidden points have no part: their numbers are 0.

    Notes
    -----
    Radii of van der Waals, each larger by that of a probe, give the surface and the volume
    that a solvent can reach [2]_: weights ``(r + probe)**2`` at radius 0.

    References
    ----------
    .. [1] H. Edelsbrunner, The union of balls and its dual shape, Discrete &
       Computational Geometry 13 (1995) 415-440; for voids: H. Edelsbrunner, M. Facello,
       P. Fu and J. Liang, Measuring proteins and voids in proteins, HICSS (1995) 256-264.
    .. [2] B. Lee and F. M. Richards, The interpretation of protein structures: estimation
       of static accessibility, Journal of Molecular Biology 55 (1971) 379-400.
    """

    filtration: Filtration3D
    volume: float
    ball_volumes: FloatArray
    ball_surface_areas: FloatArray
    voids: UnionVoids

    @property
    def surface_area(self) -> float:
        """Area of the boundary, that of voids and all."""
        with np.errstate(over="ignore"):
            return float(self.ball_surface_areas.sum())

    def void_balls(self, void: int) -> IntArray:
        """Return the rows whose balls bound a void, ascending int32.

        Raises
        ------
        IndexError
            If there is no such void.
        """
        return self._cells_of(self.voids.labels, void, len(self.voids), "void")

    def __repr__(self) -> str:
        voids = len(self.voids)
        return (
            f"<UnionOfBalls at radius {self.radius:.6g}: volume {self.volume:.6g}, "
            f"surface area {self.surface_area:.6g}, {voids:,} void{'s' * (voids != 1)}>"
        )


@overload
def union_of_balls(
    filtration: Filtration,
    radius: float,
    *,
    threads: int | None = None,
    progress: Progress | None = None,
) -> UnionOfDiscs: ...
@overload
def union_of_balls(
    filtration: Filtration3D,
    radius: float,
    *,
    threads: int | None = None,
    progress: Progress | None = None,
) -> UnionOfBalls: ...
def union_of_balls(
    filtration: AnyFiltration,
    radius: float,
    *,
    threads: int | None = None,
    progress: Progress | None = None,
) -> UnionOfDiscs | UnionOfBalls:
    """Measure the union of the balls of `radius` around the points of a cloud.

    Parameters
    ----------
    filtration : Filtration or Filtration3D
        From :func:`alphamesh.filtration.filtration`, or ``AlphaComplex.filtration``. Its
        exact values decide which balls meet.
    radius : float
        In the units of the points, finite. Of a weighted cloud it may be negative: the
        balls are then smaller than the weights tell.
    threads : int, optional
        Threads to use; by default one for each usable CPU. The result does not depend
        on it.
    progress : callable, optional
        Called with the fraction that is done, from 0 to 1, about ten times a second.

    Returns
    -------
    UnionOfDiscs or UnionOfBalls

    Raises
    ------
    ParameterError
        If `radius` is not a finite number, or negative without weights, or one of the
        others is not what it must be.

    Examples
    --------
    >>> import alphamesh as am
    >>> cx = am.AlphaComplex([[0, 0, 0], [1, 0, 0]])
    >>> cx.union(1)
    <UnionOfBalls at radius 1: volume 7.06858, surface area 18.8496, 0 voids>
    """
    given: Any = filtration
    if isinstance(given, Filtration3D):
        return _of_balls(given, finite_radius(radius, given), threads, progress)
    if isinstance(given, Filtration):
        return _of_discs(given, finite_radius(radius, given), threads, progress)
    raise ParameterError(
        f"union_of_balls needs a filtration, not {type(given).__name__}; make one with "
        "alphamesh.filtration(points), or use AlphaComplex.union(radius)"
    )


def _of_discs(
    filtration: Filtration, radius: float, threads: int | None, progress: Progress | None
) -> UnionOfDiscs:
    found = _measured(filtration, radius, threads, progress)
    holes = UnionHoles(found.labels, found.hole_contents, found.hole_borders)
    return UnionOfDiscs(filtration, radius, found.content, found.contents, found.borders, holes)


def _of_balls(
    filtration: Filtration3D, radius: float, threads: int | None, progress: Progress | None
) -> UnionOfBalls:
    found = _measured(filtration, radius, threads, progress)
    voids = UnionVoids(found.labels, found.hole_contents, found.hole_borders)
    return UnionOfBalls(filtration, radius, found.content, found.contents, found.borders, voids)


def _measured(
    filtration: AnyFiltration, radius: float, threads: int | None, progress: Progress | None
) -> Measured:
    has = present(filtration, radius)
    centres, exponent = scaled(filtration, radius, alone=not has[1].any())
    sides: tuple[IntArray, ...] = (filtration.triangle_edges,)
    if isinstance(filtration, Filtration3D):
        cofaces = filtration.triangle_tetrahedra
        sides += (filtration.tetrahedron_triangles,)
    else:
        cofaces = filtration.edge_triangles
    # Enclosed parts are -2, -3, ...
    labels = np.maximum(-2 - parts3(cofaces, has[-1], has[-2]), -1).astype(np.int32)
    count = int(labels.max(initial=-1)) + 1
    pieces = Pieces(filtration.simplices[1:], sides, cofaces, has, labels, count)
    found = measured(centres, pieces, exponent, threads, progress)
    return chosen_holes(found, largest_first(found.hole_contents))
