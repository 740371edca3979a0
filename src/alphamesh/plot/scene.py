"""Triangles, lines and dots in space, lit, seen in perspective, and sorted by depth.

Drawn on ordinary axes, so that it runs wherever matplotlib does: no graphics card, no
screen, no OpenGL. Simplices never cross one another, so that painting them from back to
front (the painter's algorithm) hides what is hidden, but for rare slips between large
triangles and small ones.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.collections import PolyCollection
from matplotlib.colors import to_rgb

from alphamesh.errors import ParameterError
from alphamesh.plot.drawing import Drawing, new_figure

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes

    from alphamesh._arrays import FloatArray, IntArray

__all__ = ["Camera", "Scene", "frame_of", "hazed"]

# Beyond this many triangles a vector file becomes slow to open: pixels instead.
_RASTER_FROM = 20_000
# Triangles per artist: one artist is drawn in one call that no Ctrl-C interrupts.
_PER_ARTIST = 100_000
# How far away the camera is, in radii of the scene.
_DISTANCE = 5.0
# Share of the light that a face gets as its neighbours do, so that bumps do not sparkle.
_SMOOTH = 0.55
# Light from above the left shoulder of the viewer, from the right, and from all around.
_KEY, _FILL, _AMBIENT = 0.62, 0.16, 0.34
_KEY_FROM, _FILL_FROM = np.array([-0.45, 0.65, 0.62]), np.array([0.8, 0.0, 0.6])
# How much of its colour what lies farthest away loses to the white of the paper.
_HAZE = 0.22
# How much nearer lines are taken for that lie in a face, in radii of the scene.
_LIFT = 0.05


@dataclass(frozen=True)
class Camera:
    """Where the scene is seen from.

    Attributes
    ----------
    centre : (3,) float64
        The middle of the picture.
    radius : float
        Of a sphere that holds the scene.
    axes : (3, 3) float64
        Unit vectors: to the right, up, and towards the camera.
    """

    centre: FloatArray
    radius: float
    axes: FloatArray

    @classmethod
    def at(cls, points: FloatArray, view: tuple[float, float]) -> Camera:
        """Return a camera that looks at all of some points.

        Parameters
        ----------
        points : (n, 3) float64
        view : (float, float)
            Elevation above the xy-plane and azimuth from the x-axis, in degrees.
        """
        angles = np.radians(np.asarray(view, dtype=np.float64))
        if angles.shape != (2,) or not np.isfinite(angles).all():
            raise ParameterError(
                f"view must be two angles in degrees, elevation and azimuth; got {view!r}"
            )
        elevation, azimuth = angles
        towards = np.array(
            [
                np.cos(elevation) * np.cos(azimuth),
                np.cos(elevation) * np.sin(azimuth),
                np.sin(elevation),
            ]
        )
        right = np.array([-np.sin(azimuth), np.cos(azimuth), 0.0])
        centre = np.zeros(3)
        if len(points):
            centre = points.min(axis=0) / 2 + points.max(axis=0) / 2
        radius = float(np.linalg.norm(points - centre, axis=1).max(initial=0.0)) or 1.0
        return cls(centre, radius, np.stack((right, np.cross(towards, right), towards)))

    @property
    def eye(self) -> FloatArray:
        """Where the camera is."""
        place: FloatArray = self.centre + _DISTANCE * self.radius * self.axes[2]
        return place

    def seen(self, points: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return where points are in the picture, and how near, over the scene's radius."""
        across, up, near = ((points - self.centre) / self.radius @ self.axes.T).T
        scale = _DISTANCE / (_DISTANCE - near)
        return np.stack((across * scale, up * scale), axis=-1), near


class Scene:
    """What is to be drawn, collected before it is sorted by depth.

    Parameters
    ----------
    points : (n, 3) float64
        What rows refer to.
    camera : Camera
    """

    def __init__(self, points: FloatArray, camera: Camera) -> None:
        self.points = points
        self.camera = camera
        self._flat, self._near = camera.seen(points)
        self._corners: list[FloatArray] = []
        self._depths: list[FloatArray] = []
        self._faces: list[FloatArray] = []
        self._lines: list[FloatArray] = []
        self._widths: list[FloatArray] = []

    def triangles(  # noqa: PLR0913 (how they look)
        self,
        triangles: IntArray,
        color: str,
        *,
        edge_width: float,
        two_sided: bool = False,
        opacity: float = 1.0,
        smooth: bool = True,
        lit: bool = True,
    ) -> None:
        """Add triangles; those of a closed surface that face away are left out.

        Parameters
        ----------
        triangles : (k, 3) int32
            Counter-clockwise seen from outside, unless `two_sided`.
        color : str
        edge_width : float
            Of their edges in 1/72 inch; 0 for none.
        two_sided : bool, default False
            Whether both sides are to be seen.
        opacity : float, default 1
        smooth : bool, default True
            Whether to even out the light among neighbours.
        lit : bool, default True
            Whether their light depends on how they lie.
        """
        normals = _normals(self.points, triangles)
        if smooth:
            normals = _evened(normals, triangles, len(self.points))
        flat = self._flat[triangles]
        facing = _turns(flat) > 0
        if two_sided:
            normals = np.where(facing[:, np.newaxis], normals, -normals)
        else:
            triangles, flat, normals = triangles[facing], flat[facing], normals[facing]
        near = self._near[triangles].mean(axis=1)
        base = self._lit(normals, color) if lit else np.tile(to_rgb(color), (len(near), 1))
        base = hazed(base, near)
        faces = np.column_stack((base, np.full(len(base), opacity)))
        # Edges as dark as the light is low; without edges, the face's own colour closes
        # the seam between one triangle and the next.
        lines = faces.copy()
        if edge_width:
            lines[:, :3] *= 0.72
        width = edge_width or (0.35 if opacity == 1.0 else 0.0)
        self._add(flat, near, faces, lines, width)

    def segments(
        self,
        edges: IntArray,
        color: str,
        width: float,
        *,
        on_top: bool = False,
        lift: float = 0.0,
    ) -> None:
        """Add edges as lines of `width` (1/72 inch), `on_top` of faces that they lie in.

        They are taken for nearer by `lift`, in radii of the scene.
        """
        near = self._near[edges].mean(axis=1)
        colors = np.column_stack(
            (hazed(np.tile(to_rgb(color), (len(edges), 1)), near), np.ones(len(edges)))
        )
        nearer = near + (_LIFT if on_top else 0.0) + lift
        self._add(self._flat[edges[:, [0, 1, 1]]], nearer, colors, colors, width)

    def dots(self, rows: IntArray, color: str, diameter: float) -> None:
        """Add points as dots, `diameter` in radii of the scene."""
        angle = np.pi / 4 * np.arange(9)
        rim = diameter / 2 * np.column_stack((np.cos(angle), np.sin(angle)))
        wedges = np.stack((np.zeros((8, 2)), rim[:-1], rim[1:]), axis=1)
        near = np.repeat(self._near[rows], 8)
        corners = self._flat[rows][:, np.newaxis, np.newaxis] + wedges
        rgb = np.tile(to_rgb(color), (len(near), 1))
        colors = np.column_stack((hazed(rgb, near), np.ones(len(near))))
        self._add(corners.reshape(-1, 3, 2), near, colors, colors, 0.3)

    def _add(
        self,
        corners: FloatArray,
        near: FloatArray,
        faces: FloatArray,
        lines: FloatArray,
        width: float,
    ) -> None:
        self._corners.append(corners)
        self._depths.append(near)
        self._faces.append(faces)
        self._lines.append(lines)
        self._widths.append(np.full(len(near), width))

    def _lit(self, normals: FloatArray, color: str) -> FloatArray:
        """Return the colour of faces in the light."""
        seen = normals @ self.camera.axes.T
        key = np.maximum(seen @ (_KEY_FROM / np.linalg.norm(_KEY_FROM)), 0.0)
        fill = np.maximum(seen @ (_FILL_FROM / np.linalg.norm(_FILL_FROM)), 0.0)
        light = (_AMBIENT + _KEY * key + _FILL * fill)[:, np.newaxis]
        shine = 0.12 * key[:, np.newaxis] ** 24
        return np.asarray(np.clip(np.array(to_rgb(color)) * light * 1.12 + shine, 0.0, 1.0))

    def draw(self, ax: Axes | None) -> Drawing:
        """Paint all of it from back to front.

        Returns
        -------
        Drawing
            With the artists ``"scene"``, if there is anything.
        """
        owned = ax is None
        if ax is None:
            ax = new_figure(6, 6).add_axes((0.02, 0.02, 0.96, 0.96))
        ax.set_axis_off()
        ax.set_aspect("equal")
        flat = [part.reshape(-1, 2) for part in self._corners]
        frame_of(ax, np.concatenate([np.empty((0, 2)), *flat]))
        artists: list[Artist] = []
        order = np.argsort(np.concatenate([np.empty(0), *self._depths]), kind="stable")
        if len(order):
            corners, faces, lines, widths = (
                np.concatenate(parts)
                for parts in (self._corners, self._faces, self._lines, self._widths)
            )
        for start in range(0, len(order), _PER_ARTIST):
            part = order[start : start + _PER_ARTIST]
            painted: Any = corners[part]  # an array is quicker than a list of polygons
            artist = PolyCollection(
                painted,
                facecolors=faces[part],
                edgecolors=lines[part],
                linewidths=widths[part],
                rasterized=len(order) > _RASTER_FROM,
                capstyle="round",
                joinstyle="round",
                zorder=2,
            )
            ax.add_collection(artist, autolim=False)
            artists.append(artist)
        return Drawing(ax, {"scene": artists} if artists else {}, owned)


def frame_of(ax: Axes, corners: FloatArray) -> None:
    """Make axes hold points of the picture, ``(k, 2)``, with a margin, in the middle."""
    flat = corners if len(corners) else np.zeros((1, 2))
    low, high = flat.min(axis=0), flat.max(axis=0)
    half = 0.52 * max(float((high - low).max()), 1e-3)
    x, y = (low + high) / 2
    ax.set_xlim(x - half, x + half)
    ax.set_ylim(y - half, y + half)


def _normals(points: FloatArray, triangles: IntArray) -> FloatArray:
    """Return unit normals, 0 where floating point cannot tell them."""
    corners = points[triangles]
    # Of any size: a product of two of its lengths must not vanish.
    size = np.abs(corners - corners[:, :1]).max(initial=0.0) or 1.0
    sides = (corners[:, 1:] - corners[:, :1]) / size
    normals = np.cross(sides[:, 0], sides[:, 1])
    return _units(normals)


def _units(vectors: FloatArray) -> FloatArray:
    lengths = np.linalg.norm(vectors, axis=1)
    return np.asarray(vectors / np.where(lengths > 0, lengths, 1.0)[:, np.newaxis])


def _evened(normals: FloatArray, triangles: IntArray, count: int) -> FloatArray:
    """Return normals mixed with those of the neighbours at common vertices."""
    sums = np.stack(
        [
            np.bincount(triangles.ravel(), np.repeat(column, 3), count).astype(np.float64)
            for column in normals.T
        ],
        axis=1,
    )
    around = _units(_units(sums)[triangles].sum(axis=1))
    return _units((1 - _SMOOTH) * normals + _SMOOTH * around)


def _turns(flat: FloatArray) -> FloatArray:
    """Return twice the signed area of triangles in the picture."""
    first, second = flat[:, 1] - flat[:, 0], flat[:, 2] - flat[:, 0]
    return np.asarray(first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0])


def hazed(colors: FloatArray, near: FloatArray, strength: float = _HAZE) -> FloatArray:
    """Return colours paler, the farther away they are."""
    share = (strength * np.clip(0.5 - near / 2, 0.0, 1.0))[:, np.newaxis]
    return np.asarray(colors * (1 - share) + share)
