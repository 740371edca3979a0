"""Periodic boxes in space: a block of the material, cut where the box ends."""

from __future__ import annotations

import itertools
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from matplotlib.colors import to_hex, to_rgb

from alphamesh.errors import DimensionError
from alphamesh.plot.scene import Camera, Scene
from alphamesh.plot.section import Plane, block_of, clipped_lines, clipped_triangles
from alphamesh.plot.solids import VIEW, cutting_plane, edge_width, into_opening
from alphamesh.plot.style import COLORS

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from alphamesh._arrays import BoolArray, FloatArray, IntArray
    from alphamesh.periodic import PeriodicFiltration, PeriodicShape
    from alphamesh.plot.drawing import Drawing

__all__ = ["box_corners", "box_scene", "plot_periodic_in_space"]

_FRAME_WIDTH = 1.0
# Farther than anything in the box is from anything else, in radii of the scene.
_APART = 9.0
# Beyond so many lines the sides of what is cut are a grey mass.
_LINES_UNTIL = 25_000
_CROWD = 300
# How light the cuts across each direction are.
_TONES = np.array([0.86, 0.94, 1.0])


def plot_periodic_in_space(
    shape: PeriodicShape,
    ax: Axes | None = None,
    *,
    cut: Any = None,
    view: tuple[float, float] | None = None,
) -> Drawing:
    """Draw a complex in a periodic box in space: what of it and its copies is in the box.

    The surface of the tetrahedra is blue, and sand-coloured where the box ends and the
    material goes on, as on the opposite side. Singular triangles are orange, edges without
    a triangle are orange lines, isolated vertices are purple dots. Where the box is open
    nothing is cut.

    Parameters
    ----------
    shape : PeriodicShape
        Of points in space.
    ax : matplotlib.axes.Axes, optional
        Ordinary axes of two dimensions; new ones in a new figure if None.
    cut : str or sequence of 3 or 4 floats, optional
        Take away what lies beyond a plane, too: see :func:`alphamesh.plot.plot_solid`.
        Half of the box is that beyond its middle.
    view : (float, float), optional
        Where it is seen from: elevation above the xy-plane and azimuth from the x-axis, in
        degrees. By default from the front, or, where it is cut open, into the opening.

    Returns
    -------
    Drawing
        With the artists ``"scene"``.

    Raises
    ------
    DimensionError
        If the points lie in the plane.
    ParameterError
        If `cut` or `view` is not as above.
    """
    if shape.points.shape[1] != 3:
        raise DimensionError(
            "these points lie in the plane; draw them with alphamesh.plot.plot_periodic"
        )
    corners = box_corners(shape.filtration)
    plane = None if cut is None else cutting_plane(cut, corners)
    if view is None:
        view = VIEW if plane is None else into_opening(plane[0])
    return box_scene(shape, Camera.at(corners, view), plane).draw(ax)


def box_corners(filtration: PeriodicFiltration) -> FloatArray:
    """Return the corners of the box, ``(8, 3)``; where it is open, of the points."""
    low, high = np.zeros(3), filtration.lattice.copy()
    places = filtration.positions.take(filtration.simplices[0][:, 0], axis=0)
    free = ~filtration.periodic
    if len(places):
        low[free], high[free] = places.min(axis=0)[free], places.max(axis=0)[free]
    return np.array([np.where(side, high, low) for side in itertools.product((0, 1), repeat=3)])


def box_scene(shape: PeriodicShape, camera: Camera, plane: Plane | None) -> Scene:
    """Return what :func:`plot_periodic_in_space` draws, as seen by a camera."""
    filtration = shape.filtration
    block = _Block(shape)
    walls = _sides(filtration)
    planes = [*walls, plane] if plane else walls
    points, skin, parts, lines = block_of(*block.solid(), planes)
    sheets = clipped_triangles(block.corners(2, block.sheets), planes)
    edges = clipped_lines(block.corners(1, block.lone), planes)
    dots = block.corners(0, block.alone)
    if plane:
        dots = dots[dots[:, 0] @ plane[0] <= plane[1]]
    # One table of points for all of it.
    pieces = (sheets, edges, dots, *_frame(filtration, camera.eye))
    tables = [points, *(piece.reshape(-1, 3) for piece in pieces)]
    starts = np.cumsum([len(table) for table in tables])
    scene = Scene(np.concatenate(tables), camera)
    scene.triangles(skin, COLORS["skin"], edge_width=edge_width(len(skin)))
    for (normal, _), part in zip(planes, parts, strict=True):
        scene.triangles(part, _wall_color(normal), edge_width=0.0, lit=False, smooth=False)
    if len(lines) < _LINES_UNTIL:
        scene.segments(lines, COLORS["flesh_edges"], 0.35, on_top=True)
    _add_pieces(scene, [_rows(*pair) for pair in zip(starts, pieces, strict=False)])
    return scene


def _add_pieces(scene: Scene, pieces: list[IntArray]) -> None:
    """Add what belongs to no tetrahedron, and the frame of the box."""
    sheets, edges, dots, front, behind = pieces
    width = edge_width(len(sheets))
    scene.triangles(
        sheets, COLORS["films"], edge_width=width, two_sided=True, opacity=0.7, smooth=False
    )
    scene.segments(edges, COLORS["singular_edges"], 0.9)
    scene.dots(dots[:, 0], COLORS["isolated_vertices"], 0.025 if len(dots) < _CROWD else 0.012)
    scene.segments(front, COLORS["title"], _FRAME_WIDTH, lift=_APART)
    scene.segments(behind, COLORS["title"], _FRAME_WIDTH, lift=-_APART)


def _wall_color(normal: FloatArray) -> str:
    """Return the colour of a cut: a little darker on the sides than on top."""
    tone = _TONES @ np.abs(normal) / np.linalg.norm(normal)
    return to_hex(np.clip(tone * np.array(to_rgb(COLORS["flesh"])), 0, 1).tolist())


def _rows(start: int, pieces: FloatArray) -> IntArray:
    """Return rows of corners that stand one after the other from `start` on."""
    count, size = pieces.shape[:2]
    return (start + np.arange(count * size, dtype=np.int32)).reshape(count, size)


def _sides(filtration: PeriodicFiltration) -> list[Plane]:
    """Return the planes where the box ends."""
    planes: list[Plane] = []
    for axis in np.flatnonzero(filtration.periodic):
        normal = np.zeros(3)
        normal[axis] = 1.0
        planes += [(-normal, 0.0), (normal, float(filtration.lattice[axis]))]
    return planes


def _frame(filtration: PeriodicFiltration, eye: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the sides of the box in its periodic directions, those in front and behind.

    A side is behind all of the box if both faces that meet there turn away.
    """
    corners = box_corners(filtration)
    low, high = corners[0], corners[-1]
    facing = np.stack((eye < low, eye > high))
    lines: tuple[list[FloatArray], list[FloatArray]] = ([], [])
    for axis in np.flatnonzero(filtration.periodic):
        one, two = (k for k in range(3) if k != axis)
        for i, j in itertools.product((0, 1), repeat=2):
            ends = np.array([low, high])
            ends[:, one], ends[:, two] = corners[[0, -1]][i, one], corners[[0, -1]][j, two]
            lines[0 if facing[i, one] or facing[j, two] else 1].append(ends)
    front, behind = (np.array(part).reshape(-1, 2, 3) for part in lines)
    return front, behind


class _Solid(NamedTuple):
    points: FloatArray
    skin: IntArray
    tetrahedra: IntArray


class _Block:
    """What of a complex is seen in the box: all copies that meet it."""

    def __init__(self, shape: PeriodicShape) -> None:
        self.filtration = shape.filtration
        steps = [(-1, 0, 1) if side else (0,) for side in self.filtration.periodic]
        self.moves = np.array(list(itertools.product(*steps)))
        self.cells = shape.numbers(3)
        triangles, edges = shape.numbers(2), shape.numbers(1)
        self.boundary = np.zeros(len(self.filtration.radii[2]), dtype=bool)
        self.boundary[shape.boundary_triangles] = True
        self.sheets = triangles[~self._faces(3, self.cells)[triangles]]
        self.lone = edges[~self._faces(2, triangles)[edges]]
        alone = np.isin(shape.vertices[:, 0], shape.isolated_vertices)
        self.alone = shape.numbers(0)[alone]

    def _faces(self, dimension: int, numbers: IntArray) -> BoolArray:
        """Return which simplices are faces of some of the next dimension."""
        found = np.zeros(len(self.filtration.radii[dimension - 1]), dtype=bool)
        found[self.filtration.faces[dimension][numbers]] = True
        return found

    def _copies(self, dimension: int, numbers: IntArray) -> tuple[IntArray, IntArray]:
        """Return which simplices, and which moves of them, meet the box."""
        corners = self.filtration.corners(dimension, numbers)
        low, high = corners.min(axis=1), corners.max(axis=1)
        free = ~self.filtration.periodic
        side = self.filtration.lattice
        which, moves = [], []
        for number, move in enumerate(self.moves * side):
            meets = free | ((high + move > 0) & (low + move < side))
            if dimension == 0 and not move.any():
                meets[:] = True  # each point once, also at the border
            chosen = np.flatnonzero(meets.all(axis=1))
            which.append(numbers[chosen])
            moves.append(np.full(len(chosen), number))
        return np.concatenate(which), np.concatenate(moves)

    def corners(self, dimension: int, numbers: IntArray) -> FloatArray:
        """Return the corners of all copies that meet the box."""
        which, moves = self._copies(dimension, numbers)
        places: FloatArray = self.filtration.corners(dimension, which)
        return places + (self.moves[moves] * self.filtration.lattice)[:, np.newaxis]

    def solid(self) -> _Solid:
        """Return tetrahedra that meet the box, and their boundary, turned outwards."""
        which, moves = self._copies(3, self.cells)
        rows = self.filtration.simplices[3][which].astype(np.int64)
        offsets = self.filtration.offsets[3][which] + self.moves[moves][:, np.newaxis]
        # A copy of a point is told by its row and how far it is from the box.
        codes = rows * 125 + (offsets + 2) @ np.array([25, 5, 1])
        known = np.unique(codes)
        cells = np.searchsorted(known, codes).astype(np.int32)
        steps = np.stack([known // 25 % 5, known // 5 % 5, known % 5], axis=1) - 2
        places = self.filtration.positions.take(known // 125, axis=0)
        points = places + steps * self.filtration.lattice
        parts = [np.empty((0, 3), dtype=np.int32)]
        for k in range(4):
            chosen = self.boundary[self.filtration.faces[3][which, k]]
            face, apex = np.delete(cells[chosen], k, axis=1), cells[chosen, k]
            arms = points[face] - points[apex][:, np.newaxis]
            inward = np.einsum("ij,ij->i", arms[:, 0], np.cross(arms[:, 1], arms[:, 2])) < 0
            face[inward] = face[inward][:, [0, 2, 1]]
            parts.append(face)
        return _Solid(points, np.concatenate(parts), cells)
