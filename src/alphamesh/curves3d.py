"""Sizes of an alpha complex in space as functions of its radius, all radii in one pass."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from alphamesh._arrays import Record, read_only
from alphamesh.betti import checked_radii
from alphamesh.curves import Sums, count_up_to, vertices_up_to
from alphamesh.measures import tetrahedron_volumes, triangle_areas

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from alphamesh._arrays import CountArray, FloatArray
    from alphamesh.filtration3d import Filtration3D

__all__ = ["MeasureCurves3D", "measure_curves_in_space"]

# Beyond these exponents of coordinates, volumes may leave the range of float64.
_SAFE_EXPONENTS = range(-300, 300)


@dataclass(frozen=True, eq=False, repr=False)
class MeasureCurves3D(Record):
    """How large the complex in space is at every radius; each look-up is a binary search.

    All methods take one radius or an array of radii, and return an array of the same
    shape: what the properties of ``cx.at(radius)`` say. Between two radii of
    ``cx.critical_radii()``, nothing changes.

    Attributes
    ----------
    vertex_count : int
        Distinct points that are not hidden; without weights, all of them are in the complex
        from 0 on.
    edge_radii : (E,) float64
        Filtration values of edges, ascending.
    triangle_radii : (F,) float64
        Filtration values of triangles, ascending.
    """

    vertex_count: int
    edge_radii: FloatArray
    triangle_radii: FloatArray
    _volumes: Sums
    _areas: Sums
    _exponent: int
    _vertex_radii: FloatArray | None = None

    @property
    def tetrahedron_radii(self) -> FloatArray:
        """Filtration values of tetrahedra, ascending, ``(T,)`` float64."""
        return self._volumes.radii

    def volume(self, radius: ArrayLike) -> FloatArray:
        """Return the volume of the tetrahedra, in cubed units of the points.

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
        return self._volumes.at(self._checked(radius), 3 * self._exponent)

    def surface_area(self, radius: ArrayLike) -> FloatArray:
        """Return the area of the boundary of the tetrahedra, voids and all.

        Parameters and errors are those of :meth:`volume`.

        Returns
        -------
        float64 array of the shape of `radius`
        """
        return self._areas.at(self._checked(radius), 2 * self._exponent)

    def tetrahedron_count(self, radius: ArrayLike) -> CountArray:
        """Return the number of tetrahedra.

        Parameters and errors are those of :meth:`volume`.

        Returns
        -------
        int64 array of the shape of `radius`
        """
        return count_up_to(self.tetrahedron_radii, self._checked(radius))

    def triangle_count(self, radius: ArrayLike) -> CountArray:
        """Return the number of triangles, singular ones and all.

        Parameters and errors are those of :meth:`volume`.

        Returns
        -------
        int64 array of the shape of `radius`
        """
        return count_up_to(self.triangle_radii, self._checked(radius))

    def edge_count(self, radius: ArrayLike) -> CountArray:
        """Return the number of edges, singular ones and all.

        Parameters and errors are those of :meth:`volume`.

        Returns
        -------
        int64 array of the shape of `radius`
        """
        return count_up_to(self.edge_radii, self._checked(radius))

    def euler_characteristic(self, radius: ArrayLike) -> CountArray:
        """Return vertices minus edges plus triangles minus tetrahedra: b0 - b1 + b2.

        Parameters and errors are those of :meth:`volume`.

        Returns
        -------
        int64 array of the shape of `radius`
        """
        radii = self._checked(radius)
        vertices = vertices_up_to(self._vertex_radii, self.vertex_count, radii)
        even = count_up_to(self.triangle_radii, radii) + vertices
        odd = count_up_to(self.edge_radii, radii) + count_up_to(self.tetrahedron_radii, radii)
        return np.asarray(even - odd)

    def _checked(self, radius: ArrayLike) -> FloatArray:
        return checked_radii(radius, signed=self._vertex_radii is not None)

    def __repr__(self) -> str:
        kinds = (self.edge_radii, self.triangle_radii, self.tetrahedron_radii)
        return f"<MeasureCurves3D: {sum(map(len, kinds)):,} simplices come>"


def measure_curves_in_space(filtration: Filtration3D) -> MeasureCurves3D:
    """Measure the complex at all radii at once; see :func:`alphamesh.measure_curves`."""
    vertices, _, triangles, tetrahedra = filtration.simplices
    vertex_radii, edge_radii, triangle_radii, tetrahedron_radii = filtration.radii
    volumes, areas = filtration.tetrahedron_volumes, filtration.triangle_areas
    exponent = int(np.frexp(np.abs(filtration.points).max(initial=0.0))[1])
    if exponent in _SAFE_EXPONENTS:
        exponent = 0
    else:
        points = np.ldexp(filtration.points, -exponent)
        volumes = tetrahedron_volumes(points, tetrahedra)
        areas = triangle_areas(points, triangles)
    # A triangle is on the boundary from its first tetrahedron on, until its second one.
    interval = filtration.triangle_intervals
    changes = np.concatenate((interval.regular_from, interval.interior_from))
    return MeasureCurves3D(
        len(vertices),
        read_only(np.sort(edge_radii)),
        read_only(np.sort(triangle_radii)),
        Sums.of(tetrahedron_radii, volumes),
        Sums.of(changes, np.concatenate((areas, -areas))),
        exponent,
        None if filtration.weights is None else read_only(np.sort(vertex_radii)),
    )
