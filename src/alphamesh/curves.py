"""Sizes of an alpha complex as functions of its radius, all radii in one pass."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from alphamesh._arrays import Record, read_only
from alphamesh.betti import checked_radii
from alphamesh.measures import scaled_points, triangle_areas

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from alphamesh._arrays import CountArray, FloatArray
    from alphamesh.filtration import Filtration

__all__ = ["MeasureCurves", "Sums", "count_up_to", "measure_curves", "vertices_up_to"]


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Sums(Record):
    """Sums of all numbers up to a radius.

    Numbers come and go; what is left must not carry the rounding of what is gone. So
    sums are whole numbers, of 2**-scale and of 2**-(scale + finer).
    """

    radii: FloatArray
    coarse: CountArray
    fine: CountArray
    scale: int
    finer: int

    @classmethod
    def of(cls, radii: FloatArray, values: FloatArray) -> Sums:
        """Return the sums of values that each come at a radius."""
        order = np.argsort(radii)  # sums of whole numbers do not depend on ties
        radii = radii.take(order)
        never = np.searchsorted(radii, np.inf)
        radii, values = radii[:never], values.take(order[:never])
        digits = len(values).bit_length()
        # Neither column of whole numbers may sum up to more than 2**62.
        largest = float(np.abs(values).max(initial=0.0))
        scale, finer = 62 - digits - int(np.frexp(largest)[1]), 62 - digits
        whole = np.ldexp(values, scale)
        coarse = np.trunc(whole)
        fine = np.trunc(np.ldexp(whole - coarse, finer))
        sums = [np.cumsum(np.append(0, part.astype(np.int64))) for part in (coarse, fine)]
        return cls(read_only(radii), read_only(sums[0]), read_only(sums[1]), scale, finer)

    def at(self, radii: FloatArray, exponent: int) -> FloatArray:
        """Return the sum up to each radius, times a power of two."""
        count = np.searchsorted(self.radii, radii, side="right")
        sums = self.coarse[count] + np.ldexp(self.fine[count].astype(np.float64), -self.finer)
        with np.errstate(over="ignore", under="ignore"):
            return np.asarray(np.ldexp(sums, exponent - self.scale), dtype=np.float64)


@dataclass(frozen=True, eq=False, repr=False)
class MeasureCurves(Record):
    """How large the complex is at every radius; each look-up takes a binary search.

    All methods take one radius or an array of radii, and return an array of the same
    shape: what the properties of ``cx.at(radius)`` say. Between two radii of
    ``cx.critical_radii()``, nothing changes.

    Areas and perimeters are as accurate as those of a shape, down to about 1e-30 of the
    largest triangle and of the longest edge of the cloud.

    Attributes
    ----------
    vertex_count : int
        Distinct points that are not hidden; without weights, all of them are in the complex
        from 0 on.
    edge_radii : (E,) float64
        Filtration values of edges, ascending.
    """

    vertex_count: int
    edge_radii: FloatArray
    _areas: Sums
    _lengths: Sums
    _exponent: int
    _vertex_radii: FloatArray | None = None

    @property
    def triangle_radii(self) -> FloatArray:
        """Filtration values of triangles, ascending, ``(T,)`` float64."""
        return self._areas.radii

    def area(self, radius: ArrayLike) -> FloatArray:
        """Return the area of the triangles, in squared units of the points.

        Parameters
        ----------
        radius : array-like of float

        Returns
        -------
        float64 array of the shape of `radius`

        Raises
        ------
        ParameterError
            If a radius is not a number, or NaN, or negative without weights.
        """
        return self._areas.at(self._checked(radius), 2 * self._exponent)

    def perimeter(self, radius: ArrayLike) -> FloatArray:
        """Return the length of the boundary of the triangles, holes and all.

        Parameters and errors are those of :meth:`area`.

        Returns
        -------
        float64 array of the shape of `radius`
        """
        return self._lengths.at(self._checked(radius), self._exponent)

    def triangle_count(self, radius: ArrayLike) -> CountArray:
        """Return the number of triangles.

        Parameters and errors are those of :meth:`area`.

        Returns
        -------
        int64 array of the shape of `radius`
        """
        return count_up_to(self.triangle_radii, self._checked(radius))

    def edge_count(self, radius: ArrayLike) -> CountArray:
        """Return the number of edges, singular ones and all.

        Parameters and errors are those of :meth:`area`.

        Returns
        -------
        int64 array of the shape of `radius`
        """
        return count_up_to(self.edge_radii, self._checked(radius))

    def euler_characteristic(self, radius: ArrayLike) -> CountArray:
        """Return vertices minus edges plus triangles: components minus holes.

        Parameters and errors are those of :meth:`area`.

        Returns
        -------
        int64 array of the shape of `radius`
        """
        radii = self._checked(radius)
        joined = count_up_to(self.triangle_radii, radii) - count_up_to(self.edge_radii, radii)
        return np.asarray(joined + vertices_up_to(self._vertex_radii, self.vertex_count, radii))

    def _checked(self, radius: ArrayLike) -> FloatArray:
        return checked_radii(radius, signed=self._vertex_radii is not None)

    def __repr__(self) -> str:
        changes = len(self.edge_radii) + len(self.triangle_radii)
        return f"<MeasureCurves: {changes:,} simplices come>"


def count_up_to(values: FloatArray, radii: FloatArray) -> CountArray:
    """Return how many of the ascending `values` are at most each radius, int64."""
    return np.asarray(np.searchsorted(values, radii, side="right"), dtype=np.int64)


def vertices_up_to(
    vertex_radii: FloatArray | None, count: int, radii: FloatArray
) -> CountArray | int:
    """Return how many vertices the complex has at each radius.

    Parameters
    ----------
    vertex_radii : (count,) float64 or None
        Ascending; None if all of them are 0.
    count : int
    radii : float64 array of any shape
    """
    return count if vertex_radii is None else count_up_to(vertex_radii, radii)


def measure_curves(filtration: Filtration) -> MeasureCurves:
    """Measure the complex at all radii at once.

    Parameters
    ----------
    filtration : Filtration

    Returns
    -------
    MeasureCurves
    """
    vertices, edges, triangles = filtration.simplices
    vertex_radii, edge_radii, triangle_radii = filtration.radii
    points, exponent = scaled_points(filtration.points)
    areas = filtration.triangle_areas if exponent == 0 else triangle_areas(points, triangles)
    steps = points.take(edges[:, 1], axis=0) - points.take(edges[:, 0], axis=0)
    lengths = np.hypot(steps[:, 0], steps[:, 1])
    # An edge is on the boundary from its first triangle on, until its second one comes.
    interval = filtration.edge_intervals
    changes = np.concatenate((interval.regular_from, interval.interior_from))
    return MeasureCurves(
        len(vertices),
        read_only(np.sort(edge_radii)),
        Sums.of(triangle_radii, areas),
        Sums.of(changes, np.concatenate((lengths, -lengths))),
        exponent,
        None if filtration.weights is None else read_only(np.sort(vertex_radii)),
    )
