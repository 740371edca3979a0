"""Points with what is known about them: columns, and a coordinate reference system."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from alphamesh._arrays import Record, read_only
from alphamesh._geopoints import as_crs, holds_geometries
from alphamesh.errors import ParameterError

if TYPE_CHECKING:
    from alphamesh._arrays import FloatArray

__all__ = ["Columns", "PointTable", "as_columns"]

Columns: TypeAlias = "Mapping[str, np.ndarray[Any, np.dtype[Any]]]"


@dataclass(frozen=True, eq=False, repr=False)
class PointTable(Record):
    """Points, one value of each column for each point, and where on Earth they are.

    Whatever takes points takes a table of points; rows of results are rows of the table.

    Parameters
    ----------
    points : (n, 2) or (n, 3) array-like of float
    columns : mapping of str to (n,) array-like, or DataFrame
        Numbers, text, times: one value for each point.
    crs : pyproj.CRS, str or int, optional
        The coordinate reference system of `points`.

    Raises
    ------
    ParameterError
        If a column has not one value for each point, or there is no such system.

    Examples
    --------
    >>> import alphamesh as am
    >>> table = am.PointTable([[0, 0], [4, 0], [0, 3]], {"height": [2, 5, 3]})
    >>> am.AlphaComplex(table).at(2.5).triangle_values(table.columns["height"], "max")
    array([5.])
    """

    points: FloatArray
    columns: Columns = field(default_factory=dict)
    crs: Any = None

    def __post_init__(self) -> None:
        points = np.asarray(self.points)
        if points.ndim != 2 or points.shape[1] not in (2, 3) or points.dtype.kind not in "iuf":
            raise ParameterError(
                f"points must be an (n, 2) or (n, 3) table of numbers; got {points.dtype} of "
                f"shape {points.shape}"
            )
        if points.flags.writeable or points.dtype != np.float64:
            points = read_only(np.array(points, dtype=np.float64, order="C"))
        object.__setattr__(self, "points", points)
        object.__setattr__(self, "columns", as_columns(self.columns, len(points)))
        object.__setattr__(self, "crs", as_crs(self.crs))

    def __reduce__(self) -> tuple[Any, tuple[Any, ...]]:
        # A proxy of a mapping cannot be pickled.
        return type(self), (self.points, dict(self.columns), self.crs)

    def __len__(self) -> int:
        return len(self.points)

    def __repr__(self) -> str:
        shown = ", ".join(self.columns) or "none"
        crs = "" if self.crs is None else f"; {getattr(self.crs, 'name', self.crs)}"
        return f"<PointTable: {len(self):,} points; columns: {shown}{crs}>"

    def to_geopandas(self) -> Any:
        """Return the table as a geopandas.GeoDataFrame of Points, elevations and all.

        Raises
        ------
        MissingLibraryError
            If geopandas is not installed.
        """
        from alphamesh.gis import point_frame

        return point_frame(self)


def as_columns(columns: Any, count: int) -> Columns:
    """Return columns as arrays by name, each with `count` values.

    Parameters
    ----------
    columns : mapping, DataFrame or PointTable
        The geometry column of a GeoDataFrame is left out.
    count : int

    Raises
    ------
    ParameterError
        If it is none of these, or a column has not `count` values.
    """
    if isinstance(columns, PointTable):
        columns = columns.columns
    elif hasattr(columns, "columns") and hasattr(columns, "iloc"):
        kept = columns
        if holds_geometries(columns) and hasattr(columns, "crs"):
            kept = columns.drop(columns=columns.geometry.name)
        columns = {str(name): kept.iloc[:, k].to_numpy() for k, name in enumerate(kept.columns)}
    if not isinstance(columns, Mapping):
        raise ParameterError(
            "columns must be a mapping of names to values or a DataFrame, not a "
            f"{type(columns).__name__}"
        )
    return MappingProxyType(
        {str(name): _column(str(name), values, count) for name, values in columns.items()}
    )


def _column(name: str, values: Any, count: int) -> np.ndarray[Any, np.dtype[Any]]:
    column = np.asarray(values)
    if column.shape != (count,):
        raise ParameterError(
            f"column {name!r} must have one value for each of the {count:,} points; "
            f"got shape {column.shape}"
        )
    return read_only(column.view())
