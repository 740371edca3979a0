"""A small picture of a shape as SVG, made without any library."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np

from alphamesh.shape3d import AlphaShape3D

if TYPE_CHECKING:
    from alphamesh._arrays import FloatArray
    from alphamesh.shape import AlphaShape

__all__ = ["svg_picture"]

_SIDE = 220
_MARGIN = 8
# More than that make the picture heavy, and cannot be told apart in it.
_MOST_PIECES = 4000
_MOST_POINTS = 1500
# Towards the viewer: from the front, the right and above.
_VIEW = np.array([[0.8, -0.6, 0.0], [0.24, 0.32, 0.9165], [0.55, 0.733, -0.4]])
_LIGHT = np.array([0.3, 0.5, 0.81])
_SURFACE, _SHEET = (156, 200, 234), (240, 160, 96)
_FILL, _LINE, _SINGULAR, _POINT = "#9cc8ea", "#2f74ad", "#d55e00", "#7d8896"


def svg_picture(shape: AlphaShape | AlphaShape3D) -> str:
    """Return a picture of a shape, or nothing if it has too many pieces to draw quickly."""
    points = shape.points.take(shape.filtration.simplices[0][:, 0], axis=0)
    if len(points) == 0 or _pieces(shape) > _MOST_PIECES:
        return ""
    places = _Places(shape.points, points)
    dots = _dots(places, points) if len(points) <= _MOST_POINTS else ""
    if isinstance(shape, AlphaShape3D):
        # What stands in front hides points and lines.
        parts = [dots, _lines(places, shape.isolated_edges), *_surface(shape, places)]
    else:
        parts = [_area(shape, places), _lines(places, shape.singular_edges), dots]
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{_SIDE}" height="{_SIDE}" '
        f'viewBox="0 0 {_SIDE} {_SIDE}" role="img" aria-label="the shape">'
        f"{''.join(parts)}</svg>"
    )


def _pieces(shape: AlphaShape | AlphaShape3D) -> int:
    counts = shape.counts
    if isinstance(shape, AlphaShape3D):
        kinds = ["regular_triangles", "singular_triangles", "isolated_edges"]
    else:
        kinds = ["regular_edges", "singular_edges"]
    return sum(counts[kind] for kind in kinds)


def _dots(places: _Places, points: FloatArray) -> str:
    path = "".join(f"M{x} {y}h0" for x, y in places.of(points))
    style = f'stroke="{_POINT}" stroke-width="1.8" stroke-linecap="round"'
    return f'<path {style} d="{path}"/>'


def _lines(places: _Places, edges: Any) -> str:
    return f'<path stroke="{_SINGULAR}" fill="none" d="{places.paths(edges)}"/>'


class _Places:
    """Places on paper, in tenths of a pixel."""

    def __init__(self, rows: FloatArray, points: FloatArray) -> None:
        self.turned = points.shape[1] == 3
        low, high = points.min(axis=0), points.max(axis=0)
        self.centre = low / 2 + high / 2
        self.scale = float((high / 2 - low / 2).max()) or 1.0
        flat = self._flat(points)
        self.middle = (flat.min(axis=0) + flat.max(axis=0)) / 2
        reach = float(np.abs(flat - self.middle).max()) or 1.0
        self.zoom = (_SIDE / 2 - _MARGIN) / reach
        self.rows = rows

    def scaled(self, points: FloatArray) -> FloatArray:
        return np.asarray((points - self.centre) / self.scale, dtype=np.float64)

    def _flat(self, points: FloatArray) -> FloatArray:
        scaled = self.scaled(points)
        return np.asarray(scaled @ _VIEW[:2].T if self.turned else scaled, dtype=np.float64)

    def of(self, points: FloatArray) -> list[list[float]]:
        offset = (self._flat(points) - self.middle) * [self.zoom, -self.zoom]
        found: list[list[float]] = np.round(offset + _SIDE / 2, 1).tolist()
        return found

    def paths(self, simplices: Any, end: str = "") -> str:
        corners = self.of(self.rows.take(simplices.ravel(), axis=0))
        size = simplices.shape[1]
        rings = (corners[i : i + size] for i in range(0, len(corners), size))
        return "".join("M" + "L".join(f"{x} {y}" for x, y in ring) + end for ring in rings)


def _area(shape: AlphaShape, places: _Places) -> str:
    rings = shape.rings
    corners = places.of(places.rows.take(rings.rows, axis=0))
    ends = rings.offsets.tolist()
    path = "".join(
        "M" + "L".join(f"{x} {y}" for x, y in corners[start:end]) + "Z"
        for start, end in pairwise(ends)
    )
    style = f'fill="{_FILL}" fill-opacity="0.6" stroke="{_LINE}" stroke-linejoin="round"'
    return f'<path {style} d="{path}"/>'


def _surface(shape: AlphaShape3D, places: _Places) -> list[str]:
    """Return the triangles that face the viewer, the farthest first."""
    sheets = shape.singular_triangles
    triangles = np.concatenate((shape.boundary_triangles, sheets))
    if len(triangles) == 0:
        return []
    both = np.arange(len(triangles)) >= len(triangles) - len(sheets)
    a, b, c = (places.scaled(places.rows.take(column, axis=0)) for column in triangles.T)
    normals = np.cross(b - a, c - a)
    lengths = np.sqrt((normals**2).sum(axis=1))
    normals /= np.where(lengths > 0, lengths, 1.0)[:, np.newaxis]
    towards = np.cross(_VIEW[0], _VIEW[1])
    facing = normals @ towards
    normals[both & (facing < 0)] *= -1
    seen = np.flatnonzero(both | (facing > 0))
    order = seen[np.argsort(((a + b + c) @ towards)[seen], kind="stable")]
    light = _LIGHT @ np.array([_VIEW[0], _VIEW[1], towards])
    shade = np.clip(0.55 + 0.45 * normals.take(order, axis=0) @ light, 0.25, 1.0)
    base = np.where(both.take(order)[:, np.newaxis], _SHEET, _SURFACE)
    colours = np.round(shade[:, np.newaxis] * base).astype(int).tolist()
    paths = places.paths(triangles.take(order, axis=0), "Z").split("M")[1:]
    return [
        f'<path fill="rgb{(r, g, b)}" stroke="rgb{(r, g, b)}" stroke-width="0.5" d="M{path}"/>'
        for path, (r, g, b) in zip(paths, colours, strict=True)
    ]
