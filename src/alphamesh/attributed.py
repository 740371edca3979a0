"""What is known about the points, brought to triangles, regions and tables of a GIS."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from alphamesh.aggregates import Values, as_values, points_by_region, reduced
from alphamesh.simplices import SimplexSet

if TYPE_CHECKING:
    import os
    from collections.abc import Mapping

    from alphamesh._arrays import CountArray, IntArray
    from alphamesh.regions import Regions

__all__ = ["AttributedShape"]


@dataclass(frozen=True, eq=False, repr=False)
class AttributedShape(SimplexSet):
    """Simplices to which columns of the points can be brought, and tables made of them."""

    @property
    def regions(self) -> Regions:
        """Sets of triangles connected by edges, the largest first, and their measures."""
        raise NotImplementedError

    @cached_property
    def _region_points(self) -> tuple[IntArray, CountArray]:
        regions = self.regions
        return points_by_region(
            self.triangles, regions.labels, len(regions), self.filtration.representative
        )

    def triangle_values(self, values: Any, how: str = "mean") -> Values:
        """Return one value for each triangle, made of those at its three corners.

        Parameters
        ----------
        values : (n,) array-like
            One for each point: numbers, times or text. Of duplicates, that of the lowest
            row counts.
        how : str, default "mean"
            ``"mean"``, ``"min"``, ``"max"``, ``"sum"``, ``"count"`` or ``"first"``, in the
            order of rows. Missing values (NaN, NaT, None) do not count.

        Returns
        -------
        (k,) array
            For each row of :attr:`triangles`.

        Raises
        ------
        ParameterError
            If there is not one value for each point, or `how` does not go with them.
        """
        corners = np.sort(self.triangles, axis=1)
        offsets = np.arange(0, corners.size + 1, 3)
        return reduced(as_values(values, len(self.points)), corners.ravel(), offsets, how)

    def region_values(self, values: Any, how: str = "mean") -> Values:
        """Return one value for each region, made of those at its points.

        Parameters
        ----------
        values : (n,) array-like
            One for each point. Duplicates all count. A point where regions touch counts
            in each of them; one that is a corner of no triangle, in none.
        how : str, default "mean"
            See :meth:`triangle_values`, also for the errors.

        Returns
        -------
        (r,) array
            In the order of :attr:`regions`.
        """
        return reduced(as_values(values, len(self.points)), *self._region_points, how)

    def to_geopandas(  # noqa: PLR0913 (each option is of use alone)
        self,
        what: str = "regions",
        *,
        crs: Any = None,
        data: Any = None,
        aggregate: Mapping[str, str | list[str]] | None = None,
        elevation: Any = None,
        simplify: float = 0.0,
        smooth: int = 0,
    ) -> Any:
        """Return the shape as a geopandas.GeoDataFrame, its reference system kept.

        Parameters
        ----------
        what : str, default "regions"
            ``"regions"``: a Polygon for each region, holes and all, the largest first,
            with the columns ``region``, ``area``, ``perimeter``, ``holes``,
            ``triangles`` and ``points``. ``"shape"``: one MultiPolygon in one row.
            ``"triangles"``: a Polygon for each triangle, with its ``region``, ``area``
            and ``radius`` (its filtration value). ``"points"``: all points, with the
            ``region`` that they are corners of (-1 for none) and their columns.
        crs : pyproj.CRS, str or int, optional
            The reference system of the points, if they came with none. Nothing is
            projected; for that, use ``to_crs`` of the result.
        data : mapping, DataFrame or PointTable, optional
            Columns of the points, one value for each.
        aggregate : mapping of str to str or list of str, optional
            What becomes of columns of `data` (``{"height": ["min", "max"]}`` gives
            ``height_min`` and ``height_max``), see :meth:`region_values`; by default,
            columns of points become columns of ``"points"`` only.
        elevation : (n,) array-like of float, or str, optional
            The z of each point, or a column of `data`; corners then have three
            coordinates. Of duplicates, that of the lowest row counts.
        simplify, smooth : optional
            See :meth:`polygons`; for regions and shape. Smoothed outlines have new
            corners, which have no elevation.

        Raises
        ------
        ParameterError
            If an option has no such value, or two do not go together.
        MissingLibraryError
            If geopandas is not installed.

        Examples
        --------
        >>> import alphamesh as am
        >>> shape = am.AlphaComplex(am.demo_cloud("letter-i", 500, seed=1)).at()
        >>> frame = shape.to_geopandas(crs="EPSG:25832")  # doctest: +SKIP
        """
        from alphamesh.gis import shape_frame

        return shape_frame(
            self,
            what,
            crs=crs,
            data=data,
            aggregate=aggregate,
            elevation=elevation,
            simplify=simplify,
            smooth=smooth,
        )

    def save_outlines(
        self,
        path: str | os.PathLike[str],
        what: str = "regions",
        *,
        layer: str | None = None,
        file_format: str | None = None,
        **options: Any,
    ) -> None:
        """Write the shape to a file of a GIS, whole or not at all.

        Parameters
        ----------
        path : path-like
            The extension tells the format, see ``alphamesh.GEO_FORMATS``: GeoJSON,
            GeoPackage, FlatGeobuf, GeoParquet, shapefile, WKT, WKB.
        what : str, default "regions"
            See :meth:`to_geopandas`, also for the `options`.
        layer, file_format : str, optional
            See :func:`alphamesh.write_geo`, also for the errors.
        """
        from alphamesh.gis import shape_frame
        from alphamesh.io.geo import geo_format, write_geo

        geo_format(path, file_format, layer=layer)  # refused before the work
        frame = shape_frame(self, what, **options)
        write_geo(frame, path, layer=layer, file_format=file_format)
