"""``alphaShape`` of MATLAB."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from alphamesh._arrays import read_only
from alphamesh.complex import AlphaComplex
from alphamesh.errors import ParameterError
from alphamesh.points import as_cloud
from alphamesh.queries import as_queries, edge_tree, nearest_edges

if TYPE_CHECKING:
    from alphamesh._arrays import BoolArray, FloatArray, IntArray
    from alphamesh.planar import Selection

__all__ = ["alphaShape"]

_CRITERIA = ("all-points", "one-region")


class alphaShape:  # noqa: N801 - MATLAB's own name
    """The alpha shape of points, with the names of MATLAB's ``alphaShape``.

    Parameters
    ----------
    P : array-like of shape (n, 2)
    a : float, optional
        The alpha radius; by default the smallest one that leaves no point out,
        ``criticalAlpha("all-points")``.
    HoleThreshold : float, default 0
        Fill holes of at most this area.
    RegionThreshold : float, default 0
        Leave out regions of a smaller area.

    Raises
    ------
    ParameterError
        If `a` or a threshold is negative or NaN.
    CloudShapeError, NonFiniteError, CoordinateRangeError
        If `P` are no points in the plane.

    Notes
    -----
    Differences from MATLAB: rows, regions and triangles count from 0; duplicates stay in
    `Points` and are merged in results; regions are numbered by area, the largest first;
    decisions are exact. Of `boundaryFacets` the edges run counter-clockwise, with the
    shape on their left. Points on one line give a shape without area, no error. Points are
    in the plane; for those in space, see :class:`alphamesh.AlphaComplex3D`.

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
        self._complex = AlphaComplex(as_cloud(P, 2))
        self._thresholds = HoleThreshold, RegionThreshold
        self._shape: Selection
        self.Alpha = self.criticalAlpha("all-points") if a is None else a

    # Properties

    @property
    def Points(self) -> FloatArray:  # noqa: N802
        """The points, ``(n, 2)`` float64."""
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
        """Holes of at most this area are filled; it can be set."""
        return self._thresholds[0]

    @HoleThreshold.setter
    def HoleThreshold(self, area: float) -> None:  # noqa: N802
        self._shape = self._at(self._alpha, area, self._thresholds[1])
        self._thresholds = area, self._thresholds[1]

    @property
    def RegionThreshold(self) -> float:  # noqa: N802
        """Regions of a smaller area are left out; it can be set."""
        return self._thresholds[1]

    @RegionThreshold.setter
    def RegionThreshold(self, area: float) -> None:  # noqa: N802
        self._shape = self._at(self._alpha, self._thresholds[0], area)
        self._thresholds = self._thresholds[0], area

    def _at(self, radius: float, hole: float, region: float) -> Selection:
        shape = self._complex.at(radius)
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
        return read_only(np.unique(self._complex.radii[2])[::-1])

    def alphaTriangulation(self, RegionID: int | None = None) -> IntArray:  # noqa: N802
        """Return the triangles, of one region or of all, ``(k, 3)`` int32."""
        return self._region(RegionID).triangles

    def boundaryFacets(  # noqa: N802
        self,
        RegionID: int | None = None,
    ) -> tuple[IntArray, FloatArray]:
        """Return the edges of the boundary, and the points that they are rows of.

        Returns
        -------
        bf : (k, 2) int32
        P : (n, 2) float64
        """
        return self._region(RegionID).boundary_edges, self.Points

    def area(self, RegionID: int | None = None) -> float:
        """Return the area, of one region or of all."""
        return self._region(RegionID).area

    def perimeter(self, RegionID: int | None = None) -> float:
        """Return the length of the boundary, of one region or of all."""
        return self._region(RegionID).perimeter

    def numRegions(self) -> int:  # noqa: N802
        """Return the number of regions."""
        return len(self._shape.regions)

    def inShape(self, QP: Any, RegionID: int | None = None) -> BoolArray:  # noqa: N802
        """Return which points of `QP` lie in the shape, borders included, ``(q,)`` bool."""
        return self._region(RegionID).contains(QP)

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
        edges = self._shape.boundary_edges
        if len(edges) == 0:
            raise ParameterError("the shape has no boundary; choose a larger Alpha")
        # Each corner as an edge without length.
        corners = np.unique(edges)
        tree = edge_tree(self.Points, np.column_stack((corners, corners)).astype(np.int32))
        found = nearest_edges(tree, as_queries(QP))
        return read_only(corners[found.edges].astype(np.int32)), found.distances

    def plot(self, ax: Any = None) -> Any:
        """Draw the shape on matplotlib axes."""
        return self._shape.plot(ax)

    def _region(self, number: int | None) -> Selection:
        return self._shape if number is None else self._shape.select([number])

    def __repr__(self) -> str:
        regions = f"{self.numRegions():,} region{'s' * (self.numRegions() != 1)}"
        return f"<alphaShape: {len(self.Points):,} points, Alpha {self.Alpha:.6g}, {regions}>"
