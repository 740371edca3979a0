"""One frame of a film in space: the complex at one radius, from outside and cut open."""

from __future__ import annotations

from typing import TYPE_CHECKING

from alphamesh.errors import DimensionError
from alphamesh.filtration3d import Filtration3D
from alphamesh.plot.growth import FilmView
from alphamesh.plot.scene import Camera, frame_of
from alphamesh.plot.solids import VIEW, cutting_plane, into_opening, solid_scene
from alphamesh.shape3d import AlphaShape3D

if TYPE_CHECKING:
    from alphamesh.persistence import Persistence

__all__ = ["GrowthView3D"]


class GrowthView3D(FilmView):
    """A figure that shows the complex in space at any radius, and the same cut open.

    Parameters
    ----------
    persistence : Persistence
        Of a filtration in space.
    radii : (low, high)
        See :class:`FilmView`.
    width : int, default 960
        Width of the pictures in pixels.
    turn : float, default 60
        Degrees that the camera turns around the z-axis on the way, left; the opening on
        the right is seen from one side.
    """

    def __init__(
        self,
        persistence: Persistence,
        radii: tuple[float, float],
        *,
        width: int = 960,
        turn: float = 60.0,
    ) -> None:
        if not isinstance(persistence.filtration, Filtration3D):
            raise DimensionError("this view is that of points in space")
        self._filtration = persistence.filtration
        self._turn = turn
        points = self._filtration.points
        self._plane = cutting_plane("-y", points)
        self._into = Camera.at(points, into_opening(self._plane[0]))
        titles = "Alpha complex at r", "Cut open"
        super().__init__(persistence, radii, titles, 1.0, width)

    def _draw(self, radius: float, along: float) -> None:
        shape = AlphaShape3D(self._filtration, radius)
        points = self._filtration.points
        outside = Camera.at(points, (VIEW[0], VIEW[1] + self._turn * (along - 0.5)))
        for ax, camera, plane in zip(
            self._axes, (outside, self._into), (None, self._plane), strict=True
        ):
            solid_scene(shape, camera, plane).draw(ax)
            # The picture stands still while the shape grows.
            frame_of(ax, camera.seen(points)[0])
