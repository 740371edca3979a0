"""Shapes in space: their surfaces, what is inside of them, and what belongs to no cell."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from alphamesh.errors import ParameterError
from alphamesh.plot.scene import Camera, Scene
from alphamesh.plot.section import cut_open
from alphamesh.plot.style import COLORS

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from alphamesh._arrays import BoolArray, FloatArray
    from alphamesh.bounded import BoundedShape
    from alphamesh.plot.drawing import Drawing
    from alphamesh.surface import Surface

__all__ = [
    "VIEW",
    "cutting_plane",
    "edge_width",
    "into_opening",
    "plot_solid",
    "plot_surface",
    "solid_scene",
]

# From the front, a little from above and from the right.
VIEW = (24.0, -58.0)
# Edges are drawn as long as there are no more triangles than these to be seen.
_EDGES_UNTIL, _FINE_UNTIL = 6_000, 25_000
# So many isolated vertices are a crowd.
_CROWD = 300
_AXES = {"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "z": (0.0, 0.0, 1.0)}


def plot_surface(
    surface: Surface, ax: Axes | None = None, *, view: tuple[float, float] = VIEW
) -> Drawing:
    """Draw a surface in space: lit, and seen in perspective.

    Parameters
    ----------
    surface : Surface
    ax : matplotlib.axes.Axes, optional
        Ordinary axes of two dimensions; new ones in a new figure if None.
    view : (float, float), default (24, -58)
        Where it is seen from: elevation above the xy-plane and azimuth from the x-axis, in
        degrees.

    Returns
    -------
    Drawing
        With the artists ``"scene"``.

    Raises
    ------
    ParameterError
        If `view` is not two numbers.
    """
    scene = Scene(surface.points, Camera.at(surface.points, view))
    width = edge_width(len(surface.triangles))
    scene.triangles(surface.triangles, COLORS["skin"], edge_width=width)
    return scene.draw(ax)


def plot_solid(
    shape: BoundedShape,
    ax: Axes | None = None,
    *,
    cut: Any = None,
    view: tuple[float, float] | None = None,
) -> Drawing:
    """Draw an alpha complex in space: lit, seen in perspective, cut open if asked for.

    The surface of the tetrahedra is blue; where it is cut, the cut through the tetrahedra
    is sand-coloured. Singular triangles are orange and let light through, edges without a
    triangle are orange lines, and isolated vertices are purple dots.

    Parameters
    ----------
    shape : AlphaShape3D or Selection3D
    ax : matplotlib.axes.Axes, optional
        Ordinary axes of two dimensions; new ones in a new figure if None.
    cut : str or sequence of 3 or 4 floats, optional
        Take away all that lies beyond a plane: ``"x"``, ``"-y"`` and so on for the half of
        the cloud in that direction; a normal vector, for that half; or a normal vector and
        the number that its product with points of the plane must be. What is singular
        goes whole, where its centre lies beyond.
    view : (float, float), optional
        Where it is seen from: elevation above the xy-plane and azimuth from the x-axis, in
        degrees. By default from the front, or, where it is cut open, into the opening.

    Returns
    -------
    Drawing
        With the artists ``"scene"``.

    Raises
    ------
    ParameterError
        If `cut` or `view` is not as above.
    """
    plane = None if cut is None else cutting_plane(cut, shape.points)
    if view is None:
        view = VIEW if plane is None else into_opening(plane[0])
    return solid_scene(shape, Camera.at(_used(shape), view), plane).draw(ax)


def solid_scene(
    shape: BoundedShape, camera: Camera, plane: tuple[FloatArray, float] | None
) -> Scene:
    """Return what :func:`plot_solid` draws, as seen by a camera."""
    scene = _opened(shape, camera, plane) if plane else _closed(shape, camera)
    _add_singular(scene, shape, plane)
    return scene


def _used(shape: BoundedShape) -> FloatArray:
    """Return the points that are drawn."""
    parts = (shape.tetrahedra, shape.singular_triangles, shape.isolated_edges)
    rows = np.concatenate([part.ravel() for part in (*parts, shape.isolated_vertices)])
    return np.asarray(shape.points[np.unique(rows)])


def _closed(shape: BoundedShape, camera: Camera) -> Scene:
    """Return a scene of the surface as it is."""
    scene = Scene(shape.points, camera)
    triangles = shape.boundary_triangles
    scene.triangles(triangles, COLORS["skin"], edge_width=edge_width(len(triangles)))
    return scene


def _opened(shape: BoundedShape, camera: Camera, plane: tuple[FloatArray, float]) -> Scene:
    """Return a scene of what is behind the plane, and of the cut."""
    section = cut_open(shape.points, shape.boundary_triangles, shape.tetrahedra, *plane)
    scene = Scene(section.points, camera)
    width = edge_width(len(section.skin))
    scene.triangles(section.skin, COLORS["skin"], edge_width=width)
    scene.triangles(section.flesh, COLORS["flesh"], edge_width=0.0, lit=False)
    if len(section.lines) < _FINE_UNTIL:
        scene.segments(section.lines, COLORS["flesh_edges"], 0.35, on_top=True)
    return scene


def _add_singular(
    scene: Scene, shape: BoundedShape, plane: tuple[FloatArray, float] | None
) -> None:
    """Add what belongs to no tetrahedron."""
    points = shape.points
    lone = shape.singular_triangles
    lone = lone[_kept(points, lone, plane)]
    width = edge_width(len(lone))
    scene.triangles(
        lone, COLORS["films"], edge_width=width, two_sided=True, opacity=0.7, smooth=False
    )
    edges = shape.isolated_edges
    edges = edges[_kept(points, edges, plane)]
    scene.segments(edges, COLORS["singular_edges"], 0.9 if len(edges) < _EDGES_UNTIL else 0.4)
    alone = shape.isolated_vertices
    alone = alone[_kept(points, alone[:, np.newaxis], plane)]
    scene.dots(alone, COLORS["isolated_vertices"], 0.025 if len(alone) < _CROWD else 0.012)


def edge_width(count: int) -> float:
    """Return how wide edges are drawn among so many triangles, in 1/72 inch; 0 for none."""
    return 0.35 if count < _EDGES_UNTIL else 0.2 if count < _FINE_UNTIL else 0.0


def _kept(
    points: FloatArray, simplices: Any, plane: tuple[FloatArray, float] | None
) -> BoolArray:
    """Return which simplices have their centre on this side of the plane."""
    if plane is None:
        return np.ones(len(simplices), dtype=bool)
    normal, offset = plane
    return np.asarray((points @ normal)[simplices].mean(axis=1) <= offset)


def cutting_plane(cut: Any, points: FloatArray) -> tuple[FloatArray, float]:
    """Return the normal of a plane, and its product with points of the plane."""
    if isinstance(cut, str):
        name = cut.lower().removeprefix("+")
        axis = _AXES.get(name.removeprefix("-"))
        numbers = None if axis is None else (-1 if name[0] == "-" else 1) * np.array(axis)
    else:
        try:
            numbers = np.asarray(cut, dtype=np.float64)
        except (TypeError, ValueError):
            numbers = None
    if (
        numbers is None
        or numbers.shape not in ((3,), (4,))
        or not np.isfinite(numbers).all()
        or not numbers[:3].any()
    ):
        raise ParameterError(
            'cut must be "x", "-x", "y", "-y", "z" or "-z", a vector of 3 numbers, or these '
            f"and the plane's offset; got {cut!r}"
        )
    normal = numbers[:3]
    if len(numbers) == 4:
        return normal, float(numbers[3])
    heights = points @ normal
    low, high = heights.min(initial=np.inf), heights.max(initial=-np.inf)
    return normal, float(low / 2 + high / 2) if len(points) else 0.0


def into_opening(normal: FloatArray) -> tuple[float, float]:
    """Return a view of the side that a plane's normal points to, a little aslant."""
    x, y, z = normal / np.linalg.norm(normal)
    elevation = float(np.degrees(np.arcsin(np.clip(z, -1.0, 1.0))))
    upright = abs(elevation) > 70
    azimuth = VIEW[1] if upright else float(np.degrees(np.arctan2(y, x))) + 26
    return (elevation - 34 * np.sign(z) if upright else elevation + 20), azimuth
