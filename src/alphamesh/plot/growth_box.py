"""One frame of a film of a periodic box: what grows in it and around it."""

from __future__ import annotations

import itertools
from typing import TYPE_CHECKING

import numpy as np

from alphamesh.errors import DimensionError
from alphamesh.filtration import filtration_in_plane
from alphamesh.periodic import PeriodicFiltration, PeriodicShape
from alphamesh.plot.cells import add_restricted, cell_coloring
from alphamesh.plot.drawing import Canvas
from alphamesh.plot.growth import FilmView, farthest
from alphamesh.plot.periodic import Copies, add_box, add_simplices, box_window
from alphamesh.plot.periodic3d import box_corners, box_scene
from alphamesh.plot.scene import Camera, frame_of
from alphamesh.plot.solids import VIEW, cutting_plane, into_opening
from alphamesh.plot.style import sizes
from alphamesh.points import Cloud
from alphamesh.restricted import restricted_voronoi

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from numpy.typing import NDArray

    from alphamesh.periodic import PeriodicPersistence

__all__ = ["GrowthViewBox", "GrowthViewBox3D"]

# How much is shown beyond the box, in periods, and how much farther copies are needed for
# cells that are whole: of few points a period, of many less.
_MARGIN, _FEW, _FARTHER, _FAR = 0.12, 1500, 1.1, 0.45


class GrowthViewBox(FilmView):
    """A figure that shows cells and complex in a periodic box at any radius.

    Parameters
    ----------
    persistence : PeriodicPersistence
        Of points in the plane.
    radii : (low, high)
        See :class:`FilmView`.
    width : int, default 960
        Width of the pictures in pixels.

    Raises
    ------
    DimensionError
        If the points lie in space.
    """

    def __init__(
        self, persistence: PeriodicPersistence, radii: tuple[float, float], *, width: int = 960
    ) -> None:
        filtration = _checked(persistence, 2)
        self._boxed = filtration
        window = box_window(filtration, _MARGIN)
        most = _MARGIN * float(np.ptp(window, axis=0).max())
        beyond = np.where(filtration.periodic, 0.0, min(farthest(filtration, radii[1]), most))
        self._window = window + np.array([-beyond, beyond])
        self._copies = Copies(filtration, self._window)
        points, rows = _around(filtration)
        weights = filtration.weights
        cloud = Cloud(points, weights=None if weights is None else weights[rows])
        self._around = filtration_in_plane(cloud)
        edges = np.unique(filtration.simplices[1], axis=0)
        # A point that is its own neighbour has the colour that it has.
        edges = edges[edges[:, 0] != edges[:, 1]]
        numbers = cell_coloring(len(filtration.points), edges)
        self._coloring = numbers[rows]
        self._places = self._copies.of(0, np.arange(len(filtration.simplices[0])))[:, 0]
        cells = "Voronoi" if weights is None else "Power"
        across, up = np.ptp(self._window, axis=0)
        slope = float(np.clip(up / across, 0.25, 1.4)) if across > 0 else 1.0
        titles = f"{cells} cells within r", "Alpha complex at r"
        super().__init__(persistence, radii, titles, slope, width)
        for ax in self._axes:
            add_box(Canvas(self._window, ax), filtration)

    def _draw(self, radius: float, along: float) -> None:
        left, right = self._axes
        canvas = self._canvas(left)
        if radius > 0 or self._boxed.weights is not None:
            add_restricted(canvas, restricted_voronoi(self._around, radius), self._coloring)
        if canvas.sizes.shows_edges or radius == 0:
            canvas.markers("points", slice(None), 0.6 * canvas.sizes.point)
        add_simplices(self._canvas(right), PeriodicShape(self._boxed, radius), self._copies)

    def _canvas(self, ax: Axes) -> Canvas:
        canvas = Canvas(self._window, ax)
        canvas.points = self._places
        canvas.sizes = sizes(self._places, ax)
        return canvas


def _around(filtration: PeriodicFiltration) -> tuple[NDArray[np.float64], NDArray[np.intp]]:
    """Return points of the box and their copies around it, and the row of each."""
    rows = filtration.simplices[0][:, 0].astype(np.intp)
    places = filtration.positions[rows]
    margin = _MARGIN + (_FARTHER if len(places) <= _FEW else _FAR)
    low, high = box_window(filtration, margin)
    reach = int(np.ceil(margin))
    steps = [
        range(-reach, reach + 1) if side else range(1) for side in filtration.periodic.tolist()
    ]
    points, owners = [], []
    for step in itertools.product(*steps):
        moved = places + np.array(step) * filtration.lattice
        kept = ((moved >= low) & (moved <= high) | ~filtration.periodic).all(axis=1)
        points.append(moved[kept])
        owners.append(rows[kept])
    return np.concatenate(points), np.concatenate(owners)


class GrowthViewBox3D(FilmView):
    """A figure that shows the block in a periodic box at any radius, and the same cut open.

    Parameters
    ----------
    persistence : PeriodicPersistence
        Of points in space.
    radii, width, turn
        See :class:`alphamesh.plot.GrowthView3D`.

    Raises
    ------
    DimensionError
        If the points lie in the plane.
    """

    def __init__(
        self,
        persistence: PeriodicPersistence,
        radii: tuple[float, float],
        *,
        width: int = 960,
        turn: float = 60.0,
    ) -> None:
        self._boxed = _checked(persistence, 3)
        self._turn = turn
        self._corners = box_corners(self._boxed)
        self._plane = cutting_plane("-y", self._corners)
        self._into = Camera.at(self._corners, into_opening(self._plane[0]))
        titles = "Alpha complex at r", "Cut open"
        super().__init__(persistence, radii, titles, 1.0, width)

    def _draw(self, radius: float, along: float) -> None:
        shape = PeriodicShape(self._boxed, radius)
        view = (VIEW[0], VIEW[1] + self._turn * (along - 0.5))
        outside = Camera.at(self._corners, view)
        for ax, camera, plane in zip(
            self._axes, (outside, self._into), (None, self._plane), strict=True
        ):
            box_scene(shape, camera, plane).draw(ax)
            # The picture stands still while the shape grows.
            frame_of(ax, camera.seen(self._corners)[0])


def _checked(persistence: PeriodicPersistence, dimension: int) -> PeriodicFiltration:
    filtration = persistence.filtration
    if not isinstance(filtration, PeriodicFiltration):
        raise DimensionError("this view is that of a periodic box")
    if filtration.points.shape[1] != dimension:
        where = "the plane" if dimension == 2 else "space"
        raise DimensionError(f"this view is that of a periodic box in {where}")
    return filtration
