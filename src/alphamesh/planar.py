"""What triangles make up: outlines, regions and holes, and answers to queries."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np

from alphamesh._arrays import read_only
from alphamesh.attributed import AttributedShape
from alphamesh.classify import SimplexKind
from alphamesh.outline import Rings, outline
from alphamesh.parts import Parts, as_cell_mask, chosen_regions, labelled, large_regions
from alphamesh.queries import (
    EdgeTree,
    Nearest,
    as_queries,
    edge_tree,
    nearest_edges,
    regions_at,
)
from alphamesh.regions import (
    Holes,
    Regions,
    find_holes,
    find_parts,
    find_regions,
    without_holes,
)

if TYPE_CHECKING:
    from alphamesh._arrays import BoolArray, FloatArray, IntArray, KindArray
    from alphamesh.polygons import Geometries

__all__ = ["PlanarShape", "Selection"]


@dataclass(frozen=True, eq=False, repr=False)
class PlanarShape(AttributedShape):
    """Simplices in the plane, and what their triangles make up.

    Outlines, regions, holes and queries are about the triangles alone, the regularized
    shape: not about singular edges and isolated vertices.
    """

    # Outlines

    @cached_property
    def rings(self) -> Rings:
        """The outlines of all regions as flat arrays; see :class:`~alphamesh.Rings`."""
        return outline(self.filtration, self._parts.labels)

    def polygons(self, *, simplify: float = 0.0, smooth: int = 0) -> Geometries:
        """Return the regions as polygons of shapely, holes and all.

        Parameters
        ----------
        simplify : float, default 0
            Leave out corners as long as the outline moves by no more than this, in the
            units of the points (Douglas and Peucker). 0 leaves the outline as it is.
        smooth : int, default 0
            Cut the corners that many times (Chaikin), after simplifying.

        Returns
        -------
        (r,) array of shapely.Polygon
            In the order of :attr:`regions`, the largest first. Valid, by construction;
            outer rings run counter-clockwise and holes clockwise. Unless simplified or
            smoothed, their area is that of the triangles, and their corners are points
            of the cloud, bit for bit.

        Raises
        ------
        MissingLibraryError
            If shapely is not installed.
        ParameterError
            If `simplify` or `smooth` is negative.

        See Also
        --------
        geometry : all of them in one.

        Notes
        -----
        GEOS, the library under shapely, computes with 106 binary digits at most, and
        takes triangles for flat that are thinner than 1e-31 of their length. Only at
        radii as much larger than the cloud do such triangles belong to a shape.
        """
        from alphamesh import polygons

        parts = polygons.polygons(self.rings)
        return polygons.smoothed(polygons.simplified(parts, simplify), smooth)

    def geometry(
        self, *, collection: bool = False, simplify: float = 0.0, smooth: int = 0
    ) -> Any:
        """Return the shape as one geometry of shapely.

        Parameters
        ----------
        collection : bool, default False
            Take in what belongs to no triangle, too: singular edges and isolated vertices.
        simplify, smooth
            See :meth:`polygons`.

        Returns
        -------
        shapely.MultiPolygon or shapely.GeometryCollection
            With `collection`, the Polygons, then a LineString for each singular edge,
            then a Point for each isolated vertex.

        Raises
        ------
        MissingLibraryError
            If shapely is not installed.
        ParameterError
            If `simplify` or `smooth` is negative.
        """
        from alphamesh import polygons

        parts = self.polygons(simplify=simplify, smooth=smooth)
        if collection:
            alone = self.isolated_vertices
            return polygons.collect(parts, self.points, self.singular_edges, alone)
        return polygons.joined(parts)

    @property
    def __geo_interface__(self) -> dict[str, Any]:
        """The shape as a GeoJSON MultiPolygon: what shapely, geopandas and others read."""
        coordinates, offsets = self.rings.closed()
        corners = [tuple(corner) for corner in coordinates.tolist()]
        rings = [tuple(corners[i:j]) for i, j in pairwise(offsets.tolist())]
        parts = [tuple(rings[i:j]) for i, j in pairwise(self.rings.region_offsets.tolist())]
        return {"type": "MultiPolygon", "coordinates": tuple(parts)}

    # Regions and holes

    @cached_property
    def _parts(self) -> Parts:
        return find_parts(self.filtration, self._has_triangle)

    @cached_property
    def regions(self) -> Regions:
        """Sets of triangles connected by edges, the largest first, and their measures."""
        return find_regions(self.filtration, self._parts, self.rings)

    @cached_property
    def holes(self) -> Holes:
        """Bounded parts of the plane without the shape, the largest first."""
        return find_holes(self.filtration, self._parts, self.rings)

    def filtered(
        self,
        *,
        min_region_area: float = 0.0,
        max_hole_area: float = 0.0,
        keep_largest: int | None = None,
    ) -> Selection:
        """Return the shape without small holes and small regions.

        Holes are filled first, so that the areas of regions are those after it; then
        small regions are dropped, then all but the largest ones.

        Parameters
        ----------
        min_region_area : float, default 0
            Drop regions of a smaller area, in squared units of the points.
        max_hole_area : float, default 0
            Fill holes of at most this area; ``numpy.inf`` fills them all. See
            :class:`~alphamesh.regions.Holes` for what a hole is.
        keep_largest : int, optional
            Keep so many regions at most.

        Returns
        -------
        Selection

        Raises
        ------
        ParameterError
            If an area is negative or NaN, or `keep_largest` is not a whole number of 0
            or more.
        """
        parts = without_holes(self.filtration, self._has_triangle, self._parts, max_hole_area)
        sizes = parts.region_sizes
        kept = large_regions(sizes, "min_region_area", min_region_area, keep_largest)
        return Selection(self.filtration, self.radius, labelled(parts.labels, kept))

    def select(self, regions: Any) -> Selection:
        """Return some regions of the shape.

        Parameters
        ----------
        regions : array-like of int or bool
            Numbers of regions, or one truth value for each region.

        Returns
        -------
        Selection

        Raises
        ------
        ParameterError
            If there are no such regions.

        Examples
        --------
        >>> import alphamesh as am
        >>> shape = am.AlphaComplex(am.demo_cloud("eight", 500, seed=1)).at()
        >>> shape.select(shape.regions.hole_counts > 0).area <= shape.area
        True
        """
        kept = chosen_regions(regions, len(self._parts.region_sizes))
        return Selection(self.filtration, self.radius, labelled(self._parts.labels, kept))

    # Queries

    def contains(self, points: Any) -> BoolArray:
        """Return which points lie in the triangles, borders included; exact.

        Parameters
        ----------
        points : array-like of shape (q, 2)

        Returns
        -------
        (q,) bool

        Raises
        ------
        CloudShapeError, NonFiniteError, CoordinateRangeError
            If `points` is not a table of finite numbers of the scale of the cloud; the
            message names the rows.
        ParameterError
            If they come with another reference system than that of the shape.
        """
        return read_only(self.region_of(points) >= 0)

    def region_of(self, points: Any) -> IntArray:
        """Return the region that each point lies in; exact.

        Parameters and errors are those of :meth:`contains`.

        Returns
        -------
        (q,) int32
            Numbers of :attr:`regions`; -1 outside. Regions are closed: where two of them
            touch, the lower number is returned.
        """
        queries = as_queries(points, self.crs)
        return regions_at(
            self.filtration.delaunay, self._parts.labels, self.regions.vertex_labels, queries
        )

    def nearest(self, points: Any) -> Nearest:
        """Return the nearest point of the boundary to each point, and how far it is.

        Parameters
        ----------
        points : array-like of shape (q, 2)

        Returns
        -------
        Nearest

        Raises
        ------
        CloudShapeError, NonFiniteError
            If `points` is not a table of finite numbers; the message names the rows.
        """
        return nearest_edges(self._edge_tree, as_queries(points, self.crs))

    def distance(self, points: Any, *, signed: bool = False) -> FloatArray:
        """Return how far each point is from the shape, in the units of the points.

        Parameters
        ----------
        points : array-like of shape (q, 2)
        signed : bool, default False
            Return minus the distance to the boundary for points inside.

        Returns
        -------
        (q,) float64
            0 on the boundary, exactly, and inside unless `signed`; infinity if the shape
            has no triangles.

        Raises
        ------
        CloudShapeError, NonFiniteError, CoordinateRangeError
            See :meth:`contains`.
        """
        queries = as_queries(points, self.crs)
        inside = self.contains(queries)
        distances = nearest_edges(self._edge_tree, queries).distances
        inner = -distances if signed else np.zeros(len(queries))
        # Adding zero turns -0 into 0.
        return read_only(np.where(inside, inner, distances) + 0.0)

    @cached_property
    def _edge_tree(self) -> EdgeTree:
        return edge_tree(self.points, self.boundary_edges)


@dataclass(frozen=True, eq=False, repr=False)
class Selection(PlanarShape):
    """Some triangles of a filtration and their faces: a shape made from another one.

    It offers what an :class:`~alphamesh.AlphaShape` offers, but for what a radius alone
    can tell. There are no singular edges and no isolated vertices in it.

    Parameters
    ----------
    filtration : Filtration
    radius : float
        Of the shape that the triangles were chosen from.
    has_triangle : (T,) bool
        Which triangles of the filtration it has.

    Raises
    ------
    ParameterError
        If there is not one truth value for each triangle.
    """

    has_triangle: BoolArray

    def __post_init__(self) -> None:
        count = len(self.filtration.simplices[2])
        mask = as_cell_mask("has_triangle", self.has_triangle, count)
        object.__setattr__(self, "has_triangle", mask)

    @property
    def _has_triangle(self) -> BoolArray:
        return self.has_triangle

    @cached_property
    def _edge_kinds(self) -> KindArray:
        # Row -1, no triangle, reads the last entry: not there.
        inside = np.append(self.has_triangle, False).view(np.int8)
        triangles = inside.take(self.filtration.edge_triangles).sum(axis=1, dtype=np.int8)
        kinds = np.array([SimplexKind.EXTERIOR, SimplexKind.REGULAR, SimplexKind.INTERIOR])
        return read_only(kinds.astype(np.int8).take(triangles))

    @cached_property
    def _vertex_kinds(self) -> KindArray:
        kinds = np.zeros(len(self.points), dtype=np.int8)
        triangles, edges = self.filtration.simplices[2], self.filtration.simplices[1]
        kinds[triangles.compress(self.has_triangle, axis=0)] = SimplexKind.INTERIOR
        kinds[edges.compress(self._edge_kinds == SimplexKind.REGULAR, axis=0)] = (
            SimplexKind.REGULAR
        )
        return read_only(kinds.take(self._vertices))

    @cached_property
    def isolated_vertices(self) -> IntArray:
        """None: every vertex is a corner of a triangle."""
        return read_only(np.empty(0, dtype=np.int32))

    def __repr__(self) -> str:
        triangles = int(np.count_nonzero(self.has_triangle))
        return f"<Selection: {triangles:,} triangles, {len(self.regions):,} regions>"
