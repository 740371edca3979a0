"""Regions that cut a Voronoi diagram, and the cut itself."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from alphamesh import _kernels, _shapely
from alphamesh._arrays import read_only
from alphamesh._kernels.cells import rings2, voronoi_vertices2
from alphamesh._kernels.weighted import regular2
from alphamesh.arcs import without_repeats
from alphamesh.clip import ClippedVoronoi, Rings, clip_rings
from alphamesh.errors import ParameterError
from alphamesh.measures import kernel_balls

if TYPE_CHECKING:
    from alphamesh._arrays import FloatArray

__all__ = ["as_box", "cut_cells"]

_KINDS = (
    "region must be a box (xmin, ymin, xmax, ymax), the corners of a convex polygon as a "
    "(c, 2) table, counter-clockwise, or a polygon of shapely"
)


def as_box(region: Any) -> tuple[float, float, float, float]:
    """Return a box as four floats.

    Raises
    ------
    ParameterError
        If it is not four finite numbers, each minimum below its maximum.
    """
    numbers = _table(region)
    right = numbers.shape == (4,) and np.isfinite(numbers).all()
    if not right or not (numbers[:2] < numbers[2:]).all():
        raise ParameterError(
            "a box is four finite numbers (xmin, ymin, xmax, ymax), each minimum below its "
            f"maximum; got {region!r}"
        )
    xmin, ymin, xmax, ymax = numbers.tolist()
    return xmin, ymin, xmax, ymax


def _table(region: Any) -> FloatArray:
    """Return numbers as an array; one of no use if they are not numbers or ragged."""
    try:
        table = np.asarray(region)
    except ValueError:
        return np.empty(0)
    return table.astype(np.float64) if table.dtype.kind in "iuf" else np.empty(0)


def cut_cells(
    points: FloatArray, region: Any, weights: FloatArray | None = None
) -> ClippedVoronoi:
    """Cut the Voronoi cells of a cloud by a region; see :meth:`alphamesh.Voronoi.clip`."""
    polygon = hasattr(region, "geom_type")
    border = _shapely_bounds(region) if polygon else _corners(region)
    masses = None if weights is None else np.append(weights, np.zeros(len(border)))
    exponent = kernel_balls(np.concatenate((points, border)), masses)[2]
    masses = None if weights is None else np.ldexp(weights, -2 * exponent)
    cells = _bounded_cells(np.ldexp(points, -exponent), masses, np.ldexp(border, -exponent))
    if polygon:
        outlines = _shapely.polygons(*cells, "Cutting cells by a polygon")
        vertices, ring_offset, hole, offset = _shapely.clipped(
            outlines, _shapely.scaled(region, -exponent)
        )
    else:
        rings = clip_rings(cells, np.ldexp(border, -exponent))
        vertices, cell_offset = without_repeats(*rings)
        used = np.diff(cell_offset) > 0
        ring_offset = np.append(0, cell_offset[1:][used])
        hole = np.zeros(len(ring_offset) - 1, dtype=np.bool_)
        offset = np.append(0, np.cumsum(used))
    vertices = np.ldexp(vertices, exponent)
    for array in (offset, ring_offset, hole, vertices):
        read_only(array)
    return ClippedVoronoi(points, offset, ring_offset, hole, vertices)


def _shapely_bounds(region: Any) -> FloatArray:
    if region.geom_type not in {"Polygon", "MultiPolygon"} or region.is_empty:
        raise ParameterError(f"{_KINDS}; got an empty one or a {region.geom_type}")
    if not region.is_valid:
        raise ParameterError(
            "region is not a valid polygon (shapely.is_valid_reason tells why); "
            "repair it with shapely.make_valid(region)"
        )
    return np.reshape(region.bounds, (2, 2))


def _corners(region: Any) -> FloatArray:
    """Return a box or a convex polygon as corners, counter-clockwise."""
    corners = _table(region)
    if corners.shape == (4,):
        xmin, ymin, xmax, ymax = as_box(region)
        return np.array([(xmin, ymin), (xmax, ymin), (xmax, ymax), (xmin, ymax)])
    if corners.ndim != 2 or corners.shape[1] != 2:
        raise ParameterError(f"{_KINDS}; got {region!r}")
    if not np.isfinite(corners).all() or not _is_convex(corners):
        raise ParameterError(
            "the corners of a region must be finite, in convex position and counter-clockwise; "
            "for another polygon, give a shapely.Polygon"
        )
    return corners


def _is_convex(corners: FloatArray) -> bool:
    """Tell whether all corners turn left, once around: an exact decision."""
    if len(corners) < 3:
        return False
    last, following = np.roll(corners, 1, axis=0), np.roll(corners, -1, axis=0)
    turns = _kernels.orient2(np.stack((last, corners, following), axis=1))
    # From the first corner, all others are seen in turn: it winds around once.
    fan = [np.broadcast_to(corners[0], (len(corners) - 2, 2)), corners[1:-1], corners[2:]]
    seen = _kernels.orient2(np.stack(fan, axis=1))
    return bool((turns >= 0).all() and (seen >= 0).all() and (seen > 0).any())


def _bounded_cells(points: FloatArray, weights: FloatArray | None, region: FloatArray) -> Rings:
    """Return the cells as rings that are right wherever the region is, and never infinite.

    Four more points take the place of infinity. They are so far away that no part of the
    region is nearer to one of them than to any point of the cloud; nor are they heavier.
    """
    walled = _walled(points, region)
    masses = None
    try:
        if weights is None:
            _, triangles, _, edges, _, cofaces = _kernels.alpha2(walled)
        else:
            masses = np.append(weights, np.full(4, weights.min(initial=0.0)))
            _, _, (_, edges, triangles), _, cofaces = regular2(walled, masses)
    except _kernels.BadCoordinates:
        raise ParameterError(
            "region is too large, too small or too far away beside the points for exact "
            "arithmetic; choose one of about their size"
        ) from None
    offset, _, after = rings2(walled, triangles, edges, cofaces)
    vertices, _ = voronoi_vertices2(walled, triangles, edges, cofaces, weights=masses)
    count = len(points)
    return without_repeats(vertices[after[: offset[count]]], offset[: count + 1])


def _walled(points: FloatArray, region: FloatArray) -> FloatArray:
    """Return the points and four more around them.

    Points and region lie in a circle of radius R. So a point of the region is at most 2 R
    from any point of the cloud, and at least 7 R from the four.
    """
    everything = np.concatenate((points, region))
    low, high = everything.min(axis=0), everything.max(axis=0)
    middle = 0.5 * low + 0.5 * high
    reach = np.ldexp(8.0, int(np.frexp(np.hypot(*(high - low)))[1]) - 1)
    wall = middle + reach * np.array([(-1.0, 0.0), (0.0, -1.0), (1.0, 0.0), (0.0, 1.0)])
    return np.concatenate((points, wall))
