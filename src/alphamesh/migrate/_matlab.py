"""``alphaShape`` of MATLAB."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from alphamesh._arrays import read_only
from alphamesh.complex import AlphaComplex
from alphamesh.errors import DimensionError, ParameterError
from alphamesh.location3d import as_queries_in_space
from alphamesh.points import as_cloud
from alphamesh.queries import as_queries, edge_tree, nearest_edges
from alphamesh.queries3d import nearest_triangles, surface_tree

if TYPE_CHECKING:
    from alphamesh._arrays import BoolArray, FloatArray, IntArray

__all__ = ["alphaShape"]

_CRITERIA = ("all-points", "one-region")


class alphaShape:  # noqa: N801 - MATLAB's own name
    """The alpha shape of points, with the names of MATLAB's ``alphaShape``.

    Parameters
    ----------
    P : array-like of shape (n, 2) or (n, 3)
    a : float, optional
        The alpha radius; by default the smallest one that leaves no point out,
        ``criticalAlpha("all-points")``.
    HoleThreshold : float, default 0
        Fill holes of at most this area; in space, voids of at most this volume.
    RegionThreshold : float, default 0
        Leave out regions of a smaller area; in space, of a smaller volume.

    Raises
    ------
    ParameterError
        If `a` or a threshold is negative or NaN.
    CloudShapeError, NonFiniteError, CoordinateRangeError
        If `P` are no points in the plane or in space.

    Notes
    -----
    Differences from MATLAB: rows, regions and triangles count from 0; duplicates stay in
    `Points` and are merged in results; regions are numbered by area, the largest first;
    decisions are exact. Of `boundaryFacets` the edges run counter-clockwise, with the
    shape on their left, and the triangles counter-clockwise as seen from outside. Points
    on one line give a shape without area, and points in space that lie in one plane a shape
    without volume, no error.

    Examples
    --------
    >>> from alphamesh.migrate import alphaShape
    >>> shp = alphaShape([[0, 0], [2, 0], [0, 2], [2, 2], [9, 1]], 1.5)
    >>> shp.area(), shp.numRegions(), shp.inShape([[1, 1], [5, 1]]).tolist()
    (4.0, 1, [True, False])
    """

    def __init__(
        self,
        P: Any,
        a: float | None = None,
        *,
        HoleThreshold: float = 0.0,
        RegionThreshold: float = 0.0,
    ) -> None:
        self._complex = AlphaComplex(as_cloud(P))
        self._thresholds = HoleThreshold, RegionThreshold
        self._shape: Any
        self.Alpha = self.criticalAlpha("all-points") if a is None else a

    # Properties

    @property
    def Points(self) -> FloatArray:  # noqa: N802
        """The points, ``(n, 2)`` or ``(n, 3)`` float64."""
        return self._complex.points

    @property
    def Alpha(self) -> float:  # noqa: N802
        """The alpha radius; it can be set."""
        return self._alpha

    @Alpha.setter
    def Alpha(self, radius: float) -> None:  # noqa: N802
        self._shape = self._at(radius, *self._thresholds)
        self._alpha = float(radius)

    @property
    def HoleThreshold(self) -> float:  # noqa: N802
        """Holes of at most this area, or volume, are filled; it can be set."""
        return self._thresholds[0]

    @HoleThreshold.setter
    def HoleThreshold(self, size: float) -> None:  # noqa: N802
        self._shape = self._at(self._alpha, size, self._thresholds[1])
        self._thresholds = size, self._thresholds[1]

    @property
    def RegionThreshold(self) -> float:  # noqa: N802
        """Regions of a smaller area, or volume, are left out; it can be set."""
        return self._thresholds[1]

    @RegionThreshold.setter
    def RegionThreshold(self, size: float) -> None:  # noqa: N802
        self._shape = self._at(self._alpha, self._thresholds[0], size)
        self._thresholds = self._thresholds[0], size

    @property
    def _in_space(self) -> bool:
        return bool(self.Points.shape[1] == 3)

    def _at(self, radius: float, hole: float, region: float) -> Any:
        shape: Any = self._complex.at(radius)
        if self._in_space:
            # Voids are those of the tetrahedra, whatever triangles there are besides.
            return shape.filtered().filtered(max_void_volume=hole, min_region_volume=region)
        return shape.filtered(max_hole_area=hole, min_region_area=region)

    # Functions

    def criticalAlpha(self, type: str) -> float:  # noqa: A002, N802
        """Return a critical radius.

        Parameters
        ----------
        type : {"all-points", "one-region"}
            The smallest radius at which no point is left out; or at which there is one
            region, too.

        Raises
        ------
        ParameterError
            If it is neither.
        """
        if type not in _CRITERIA:
            raise ParameterError(f"type must be one of {_CRITERIA}; got {type!r}")
        if len(self.Points) == 0:
            return 0.0
        return self._complex.choose_radius(type).radius

    def alphaSpectrum(self) -> FloatArray:  # noqa: N802
        """Return the radii at which the shape changes, descending, ``(k,)`` float64."""
        return read_only(np.unique(self._complex.radii[-1])[::-1])

    def alphaTriangulation(self, RegionID: int | None = None) -> IntArray:  # noqa: N802
        """Return the triangles or tetrahedra, of one region or of all, ``(k, d + 1)`` int32."""
        shape = self._region(RegionID)
        found: IntArray = shape.tetrahedra if self._in_space else shape.triangles
        return found

    def boundaryFacets(  # noqa: N802
        self,
        RegionID: int | None = None,
    ) -> tuple[IntArray, FloatArray]:
        """Return the boundary, edges or triangles, and the points that they are rows of.

        Returns
        -------
        bf : (k, d) int32
        P : (n, d) float64
        """
        return self._facets(self._region(RegionID)), self.Points

    def _facets(self, shape: Any) -> IntArray:
        found: IntArray = shape.boundary_triangles if self._in_space else shape.boundary_edges
        return found

    def area(self, RegionID: int | None = None) -> float:
        """Return the area, of one region or of all; of a shape in the plane."""
        self._require(2, "area", "volume and surfaceArea")
        return float(self._region(RegionID).area)

    def perimeter(self, RegionID: int | None = None) -> float:
        """Return the length of the boundary, of one region or of all; in the plane."""
        self._require(2, "perimeter", "surfaceArea")
        return float(self._region(RegionID).perimeter)

    def volume(self, RegionID: int | None = None) -> float:
        """Return the volume, of one region or of all; of a shape in space."""
        self._require(3, "volume", "area")
        return float(self._region(RegionID).volume)

    def surfaceArea(self, RegionID: int | None = None) -> float:  # noqa: N802
        """Return the area of the boundary, of one region or of all; in space."""
        self._require(3, "surfaceArea", "perimeter")
        return float(self._region(RegionID).surface_area)

    def _require(self, columns: int, name: str, instead: str) -> None:
        if self.Points.shape[1] != columns:
            where = "the plane" if columns == 2 else "space"
            raise DimensionError(f"{name} is for points in {where}; take {instead}")

    def numRegions(self) -> int:  # noqa: N802
        """Return the number of regions."""
        return len(self._shape.regions)

    def inShape(self, QP: Any, RegionID: int | None = None) -> BoolArray:  # noqa: N802
        """Return which points of `QP` lie in the shape, borders included, ``(q,)`` bool."""
        found: BoolArray = self._region(RegionID).contains(QP)
        return found

    def nearestNeighbor(self, QP: Any) -> tuple[IntArray, FloatArray]:  # noqa: N802
        """Return the nearest corner of the boundary to each point, and how far it is.

        Returns
        -------
        I : (q,) int32
            Rows of `Points`.
        D : (q,) float64

        Raises
        ------
        ParameterError
            If the shape has no boundary.
        """
        facets = self._facets(self._shape)
        if len(facets) == 0:
            raise ParameterError("the shape has no boundary; choose a larger Alpha")
        # Each corner as an edge without length, or as a triangle without area.
        corners = np.unique(facets).astype(np.int32)
        pointed = np.repeat(corners[:, np.newaxis], facets.shape[1], axis=1)
        if self._in_space:
            in_space = surface_tree(self.Points, pointed)
            near = nearest_triangles(in_space, as_queries_in_space(QP))
            return read_only(corners[near.triangles]), near.distances
        found = nearest_edges(edge_tree(self.Points, pointed), as_queries(QP))
        return read_only(corners[found.edges]), found.distances

    def plot(self, ax: Any = None) -> Any:
        """Draw the shape on matplotlib axes."""
        return self._shape.plot(ax)

    def _region(self, number: int | None) -> Any:
        return self._shape if number is None else self._shape.select([number])

    def __repr__(self) -> str:
        regions = f"{self.numRegions():,} region{'s' * (self.numRegions() != 1)}"
        return f"<alphaShape: {len(self.Points):,} points, Alpha {self.Alpha:.6g}, {regions}>"
