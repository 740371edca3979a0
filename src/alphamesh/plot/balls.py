"""Unions of balls in space, as they look: every pixel on the ball that is in front."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.colors import to_rgba_array

from alphamesh.errors import ParameterError
from alphamesh.plot.drawing import Drawing, new_figure
from alphamesh.plot.scene import Camera
from alphamesh.plot.solids import VIEW
from alphamesh.plot.style import COLORS

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from alphamesh._arrays import FloatArray
    from alphamesh.unions import UnionOfBalls

__all__ = ["plot_balls"]

# Pixels across the picture; each is the mean of so many squared.
_PIXELS, _FINE = 640, 2
# Light from above the left shoulder of the viewer, and from all around.
_LIGHT, _AMBIENT = np.array([-0.45, 0.55, 0.7]), 0.46


def plot_balls(
    union: UnionOfBalls,
    ax: Axes | None = None,
    *,
    colors: Any = None,
    view: tuple[float, float] = VIEW,
) -> Drawing:
    """Draw the union of balls, lit, seen from far away.

    Parameters
    ----------
    union : UnionOfBalls
    ax : matplotlib.axes.Axes, optional
        Ordinary axes of two dimensions; new ones in a new figure if None.
    colors : color or sequence of n colors, optional
        Of each ball, in any way that matplotlib understands.
    view : (float, float), default (24, -58)
        Where it is seen from: elevation above the xy-plane and azimuth from the x-axis, in
        degrees.

    Returns
    -------
    Drawing
        With the artists ``"balls"``.

    Raises
    ------
    ParameterError
        If `view` is not two numbers, or there is not one color for each ball.
    """
    shown = np.flatnonzero(union.ball_surface_areas > 0)
    camera = Camera.at(union.points[shown], view)
    rgba = _checked(COLORS["skin"] if colors is None else colors, len(union.points))
    owned = ax is None
    if ax is None:
        ax = new_figure(6, 6).add_axes((0.02, 0.02, 0.96, 0.96))
    ax.set_axis_off()
    ax.set_aspect("equal")
    places = (union.points[shown] - camera.centre) @ camera.axes.T
    radii = union.ball_radii[shown]
    reach = float((np.abs(places[:, :2]).max(axis=1) + radii).max(initial=0.0)) * 1.02 or 1.0
    picture = _picture(places / reach, radii / reach, rgba[shown, :3])
    image = ax.imshow(
        picture,
        extent=(-reach, reach, -reach, reach),
        origin="lower",
        interpolation="antialiased",
    )
    return Drawing(ax, {"balls": [image]}, owned)


def _checked(colors: Any, count: int) -> FloatArray:
    """Return one colour for each ball, ``(n, 4)``."""
    try:
        rgba = np.asarray(to_rgba_array(colors), dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise ParameterError(f"colors must be colors of matplotlib: {error}") from None
    if len(rgba) not in {1, count}:
        raise ParameterError(
            f"colors must be one color, or one for each of {count} points; got {len(rgba)}"
        )
    return np.broadcast_to(rgba, (count, 4))


def _picture(places: FloatArray, radii: FloatArray, rgb: FloatArray) -> FloatArray:
    """Return balls within -1 and 1 as an image with white behind, ``(k, k, 3)``."""
    size = _PIXELS * _FINE
    middle = (np.arange(size) + 0.5) / size * 2 - 1
    depth = np.full((size, size), -np.inf)
    image = np.ones((size, size, 3))
    light = _LIGHT / np.linalg.norm(_LIGHT)
    for (x, y, z), radius, color in zip(places, radii, rgb, strict=True):
        columns = slice(*np.searchsorted(middle, (x - radius, x + radius)))
        rows = slice(*np.searchsorted(middle, (y - radius, y + radius)))
        right = (middle[columns] - x) / radius
        up = (middle[rows, np.newaxis] - y) / radius
        near = np.sqrt(np.maximum(0.0, 1 - right**2 - up**2))
        front = (near > 0) & (z + radius * near > depth[rows, columns])
        depth[rows, columns][front] = (z + radius * near)[front]
        lit = np.maximum(0.0, light[0] * right + light[1] * up + light[2] * near)
        shade = _AMBIENT + (1 - _AMBIENT) * lit * (0.35 + 0.65 * near)
        image[rows, columns][front] = (shade[..., np.newaxis] * color)[front]
    return np.asarray(image.reshape(_PIXELS, _FINE, _PIXELS, _FINE, 3).mean(axis=(1, 3)))
