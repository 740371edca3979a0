"""The seam to shapely: the one place where stages meet it, and only when they are asked to."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from alphamesh.errors import MissingLibraryError

if TYPE_CHECKING:
    from alphamesh._arrays import BoolArray, CountArray, FloatArray

__all__ = ["Geometries", "clipped", "polygons", "scaled", "shapely_for", "with_holes"]

Geometries: TypeAlias = "np.ndarray[Any, np.dtype[np.object_]]"


def shapely_for(purpose: str) -> Any:
    """Return the module shapely.

    Raises
    ------
    MissingLibraryError
        If it is not installed; the message says that `purpose` needs it.
    """
    try:
        import shapely
    except ImportError as missing:
        raise MissingLibraryError.of("shapely", "geo", purpose) from missing
    return shapely


def polygons(vertices: FloatArray, offset: CountArray, purpose: str) -> Geometries:
    """Return convex outlines as shapely polygons, empty ones where there are no vertices.

    Parameters
    ----------
    vertices : (m, 2) float64
    offset : (k + 1,) int64
        Vertices ``offset[i]`` to ``offset[i + 1]``, at least three or none, are outline i.
    purpose : str
        What shapely is needed for, should it be missing.
    """
    shapely = shapely_for(purpose)
    counts = np.diff(offset)
    made = np.full(len(counts), shapely.Polygon(), dtype=np.object_)
    used = np.flatnonzero(counts)
    if len(used):
        ring = np.repeat(np.arange(len(used)), counts[used])
        drawn = shapely.polygons(shapely.linearrings(vertices, indices=ring))
        # Vertices that are one but for rounding may come in the wrong order.
        twisted = ~shapely.is_valid(drawn)
        drawn[twisted] = shapely.convex_hull(drawn[twisted])
        made[used] = drawn
    return made


def with_holes(
    vertices: FloatArray,
    ring_offset: CountArray,
    hole: BoolArray,
    offset: CountArray,
    purpose: str,
) -> Geometries:
    """Return groups of rings as shapely geometries: the inverse of :func:`clipped`."""
    shapely = shapely_for(purpose)
    made = np.full(len(offset) - 1, shapely.Polygon(), dtype=np.object_)
    if len(hole) == 0:
        return made
    ring = np.repeat(np.arange(len(hole)), np.diff(ring_offset))
    part = np.cumsum(~hole) - 1
    parts = shapely.polygons(shapely.linearrings(vertices, indices=ring), indices=part)
    twisted = ~shapely.is_valid(parts)
    parts[twisted] = shapely.make_valid(parts[twisted])
    cell = np.repeat(np.arange(len(made)), np.diff(offset))[~hole]
    counts = np.bincount(cell, minlength=len(made))
    made[counts == 1] = parts[counts[cell] == 1]
    several = counts[cell] > 1
    if several.any():
        shapely.multipolygons(parts[several], indices=cell[several], out=made)
    return made


def scaled(region: Any, exponent: int) -> Any:
    """Return a geometry times a power of two."""
    shapely = shapely_for("Cutting cells by a polygon")
    if exponent == 0:
        return region
    return shapely.transform(region, lambda vertices: np.ldexp(vertices, exponent))


def clipped(
    cells: Geometries, region: Any
) -> tuple[FloatArray, CountArray, BoolArray, CountArray]:
    """Cut polygons by a region; return the parts as flat rings.

    Returns
    -------
    vertices : (m, 2) float64
    ring_offset : (k + 1,) int64
    hole : (k,) bool
        Outer rings are counter-clockwise, each followed by its holes, clockwise.
    offset : (n + 1,) int64
        Rings of each cell.
    """
    import shapely

    shapely.prepare(region)
    cut = cells.copy()
    crossing = ~shapely.contains_properly(region, cells)
    cut[crossing] = shapely.intersection(cells[crossing], region)
    parts, cell = shapely.get_parts(cut, return_index=True)
    # Cells that only touch the region leave points and lines.
    areal = shapely.get_dimensions(parts) == 2
    parts, cell = parts[areal], cell[areal]
    rings, part = shapely.get_rings(parts, return_index=True)
    hole = np.append(np.zeros(min(1, len(part)), dtype=np.bool_), part[1:] == part[:-1])
    turned = shapely.is_ccw(rings) == hole
    rings[turned] = shapely.reverse(rings[turned])
    vertices, ring = shapely.get_coordinates(rings, return_index=True)
    # Shapely repeats the first vertex at the end.
    kept = np.append(ring[1:] == ring[:-1], np.zeros(min(1, len(ring)), dtype=np.bool_))
    ring_counts = np.bincount(ring[kept], minlength=len(rings))
    counts = np.bincount(cell[part], minlength=len(cells))
    return (
        vertices[kept],
        np.append(0, np.cumsum(ring_counts)),
        hole,
        np.append(0, np.cumsum(counts)),
    )
