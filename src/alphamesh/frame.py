"""A frame of extra points around a cloud, and the triangulation that it carves out."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from functools import cached_property
from itertools import pairwise
from numbers import Real
from typing import TYPE_CHECKING, Any

import numpy as np

from alphamesh._arrays import Record, read_only
from alphamesh._weights import refuse_weights
from alphamesh.delaunay import Delaunay, delaunay_in_plane, edges_of
from alphamesh.errors import ParameterError
from alphamesh.hull import convex_hull
from alphamesh.points import as_cloud

if TYPE_CHECKING:
    from alphamesh._arrays import BoolArray, FloatArray, IntArray
    from alphamesh._kernels import Progress

__all__ = ["FRAME_SHAPES", "Frame", "FramedDelaunay", "framed_delaunay"]

FRAME_SHAPES = ("box", "circle", "hull")

_MOST_POINTS = 10_000_000


@dataclass(frozen=True, slots=True)
class Frame:
    """Points around a cloud, evenly spaced.

    Parameters
    ----------
    shape : {"box", "circle", "hull"}
        The bounding box, a circle around its centre, or the convex hull with round
        corners, each wider than the cloud by `margin`.
    margin : float, optional
        Distance between cloud and frame, positive, in the units of the points; by default
        the typical distance between points, the root of the bounding box's area per point.
    spacing : float, optional
        Distance between neighbours on the frame, at most; by default as the margin's.

    Raises
    ------
    ParameterError
        If `shape` is unknown or a distance is not a positive number.

    Notes
    -----
    A triangle of the cloud is kept if no point of the frame lies in its circumcircle. The
    closer the frame and the denser its points, the deeper it cuts into the hollows of the
    cloud.
    """

    shape: str = "box"
    margin: float | None = None
    spacing: float | None = None

    def __post_init__(self) -> None:
        if self.shape not in FRAME_SHAPES:
            raise ParameterError(
                f"there is no frame shape {self.shape!r}; shapes: "
                + ", ".join(repr(shape) for shape in FRAME_SHAPES)
            )
        for name in ("margin", "spacing"):
            given: Any = getattr(self, name)
            if given is None:
                continue
            if not isinstance(given, Real) or not (0 < float(given) < math.inf):
                raise ParameterError(
                    f"{name} must be a positive number in the units of the points, or None "
                    f"for the typical distance between points; got {given!r}"
                )
            object.__setattr__(self, name, float(given))

    def around(self, points: Any) -> FloatArray:
        """Return the points of the frame around a cloud, counter-clockwise.

        Parameters
        ----------
        points : array-like of shape (n, 2)

        Returns
        -------
        (k, 2) float64
            Empty around an empty cloud.

        Raises
        ------
        CloudShapeError, NonFiniteError, CoordinateRangeError
            If `points` is not a cloud.
        ParameterError
            If there would be more than ten million points.
        """
        hull = convex_hull(points)
        corners = hull.corners
        if len(corners) == 0:
            return read_only(np.empty((0, 2)))
        usual = _typical_distance(corners, len(hull.points))
        margin = usual if self.margin is None else self.margin
        spacing = usual if self.spacing is None else self.spacing
        draw = {"box": _box, "circle": _circle, "hull": _rounded_hull}[self.shape]
        return read_only(draw(corners, margin, spacing))


@dataclass(frozen=True, eq=False, repr=False)
class FramedDelaunay(Record):
    """A Delaunay triangulation without the triangles that touch a frame: need not be convex.

    Attributes
    ----------
    points : (n, 2) float64
        The cloud alone.
    representative : (n,) int32
        The lowest row with the coordinates of row i: i itself unless it is a duplicate.
    triangles : (T, 3) int32
        The triangles that are kept: rows of `points`, ascending within a triangle.
    neighbors : (T, 3) int32
        ``neighbors[t, j]`` is the triangle on the other side of the edge that lies
        opposite to ``triangles[t, j]``; -1 on the boundary.
    frame : Frame
    frame_points : (k, 2) float64
    full : Delaunay
        The triangulation of the cloud and, in the rows from n on, the points of the frame.
        Its first T triangles are the kept ones, the others those that are dropped.

    All arrays are read-only.
    """

    points: FloatArray
    representative: IntArray
    triangles: IntArray
    neighbors: IntArray
    frame: Frame
    frame_points: FloatArray
    full: Delaunay = field(repr=False)

    @cached_property
    def edges(self) -> IntArray:
        """All edges of the kept triangles, ``(E, 2)`` int32, ascending within an edge."""
        return edges_of(self.triangles, self.neighbors)

    def find(self, queries: Any, *, threads: int | None = None) -> IntArray:
        """Return the kept triangle that each query lies in, -1 where there is none.

        Parameters, result and errors are those of :meth:`Delaunay.find`.
        """
        found = self.full.find(queries, threads=threads)
        return read_only(np.where(found < len(self.triangles), found, np.int32(-1)))

    def __repr__(self) -> str:
        return (
            f"<FramedDelaunay: {len(self.points):,} points, {len(self.triangles):,} triangles, "
            f"{self.frame.shape} of {len(self.frame_points):,} points>"
        )


def framed_delaunay(
    points: Any,
    frame: Frame | None = None,
    *,
    threads: int | None = None,
    progress: Progress | None = None,
) -> FramedDelaunay:
    """Triangulate a cloud with a frame of points around it, and drop what touches the frame.

    The long triangles that close the hollows of a cloud up to its convex hull are Delaunay
    only because nothing lies outside. With points outside, they give way.

    Parameters
    ----------
    points : array-like of shape (n, 2)
        See :func:`alphamesh.points.as_cloud`. Duplicates are merged.
    frame : Frame, optional
        By default a box, as far away from the cloud as its points are from one another.
    threads, progress : optional
        See :func:`alphamesh.delaunay`.

    Returns
    -------
    FramedDelaunay

    Raises
    ------
    CloudShapeError, NonFiniteError, CoordinateRangeError, CloudTooLargeError
        If there is no exact triangulation of such points; the message names the rows.
    ParameterError
        If `frame` is not a frame, has too many points, or lies in the cloud because its
        margin is lost in the rounding of the coordinates.
    """
    if frame is None:
        frame = Frame()
    given: Any = frame
    if not isinstance(given, Frame):
        raise ParameterError(
            f"frame must be an alphamesh.Frame, such as Frame('circle'); got {given!r}"
        )
    cloud = as_cloud(points, 2)
    refuse_weights(
        cloud.weights, "frames", "triangulate without one: AlphaComplex(points, weights=w)"
    )
    count = len(cloud)
    frame_points = frame.around(cloud)
    everything = np.concatenate((cloud.points, frame_points))
    full = delaunay_in_plane(everything, threads=threads, progress=progress)
    if (full.representative[count:] < count).any():
        raise ParameterError(
            f"points of the frame fall on points of the cloud: a margin of {frame.margin} is "
            "too small for coordinates of this size; choose a larger one"
        )
    full, kept = _kept_first(full, full.triangles[:, 2] < count)
    neighbors = full.neighbors[:kept].copy()
    neighbors[neighbors >= kept] = -1
    return FramedDelaunay(
        cloud.points,
        read_only(full.representative[:count]),
        read_only(full.triangles[:kept]),
        read_only(neighbors),
        frame,
        frame_points,
        full,
    )


def _kept_first(full: Delaunay, kept: BoolArray) -> tuple[Delaunay, int]:
    """Return the triangulation with the kept triangles in front, and how many they are."""
    order = np.argsort(~kept, kind="stable")
    place = np.empty(len(order) + 1, dtype=np.int32)
    place[order] = np.arange(len(order), dtype=np.int32)
    place[-1] = -1  # where no triangle is
    return (
        Delaunay(
            full.points,
            full.representative,
            read_only(full.triangles[order]),
            read_only(place[full.neighbors[order]]),
            full.path,
        ),
        int(np.count_nonzero(kept)),
    )


# Where the points of a frame are, around the corners of the hull


def _typical_distance(corners: FloatArray, count: int) -> float:
    """Return the side of the square that each point has to itself in the bounding box.

    In a narrow box it is at least the distance that points have along the box.
    """
    low, high = corners.min(axis=0), corners.max(axis=0)
    width, height = high - low
    distance = max(math.sqrt(width / count) * math.sqrt(height), width / count, height / count)
    # Wide enough not to be lost in the rounding of the coordinates.
    return max(distance or 1.0, float(np.abs(corners).max()) * 2.0**-40)


def _share(length: float, spacing: float, least: int = 1) -> int:
    """Return into how many parts a length is cut so that none is longer than `spacing`."""
    parts = length / spacing
    if not parts <= _MOST_POINTS:
        raise ParameterError(
            f"a frame with a spacing of {spacing:.6g} would have more than {_MOST_POINTS:,} "
            "points; choose a larger spacing"
        )
    return max(least, math.ceil(parts))


def _box(corners: FloatArray, margin: float, spacing: float) -> FloatArray:
    (x0, y0), (x1, y1) = corners.min(axis=0) - margin, corners.max(axis=0) + margin
    ends = np.array([(x0, y0), (x1, y0), (x1, y1), (x0, y1), (x0, y0)])
    sides = []
    for start, end in pairwise(ends):
        parts = _share(float(np.hypot(*(end - start))), spacing)
        share = np.arange(parts)[:, np.newaxis] / parts
        sides.append(start + share * (end - start))
    return np.concatenate(sides)


def _circle(corners: FloatArray, margin: float, spacing: float) -> FloatArray:
    centre = 0.5 * corners.min(axis=0) + 0.5 * corners.max(axis=0)
    radius = float(np.hypot(*(corners - centre).T).max()) + margin
    parts = _share(2 * math.pi * radius, spacing, least=8)
    angle = np.arange(parts) * (2 * math.pi / parts)
    # Widened so that the chords, too, keep the margin.
    radius /= math.cos(math.pi / parts)
    circle: FloatArray = centre + radius * np.column_stack((np.cos(angle), np.sin(angle)))
    return circle


def _rounded_hull(corners: FloatArray, margin: float, spacing: float) -> FloatArray:
    """Return points on the curve at distance `margin` from the hull, evenly spaced.

    It consists of the sides of the hull, moved outwards, and of an arc around each corner.
    """
    sides = np.roll(corners, -1, axis=0) - corners
    lengths = np.hypot(*sides.T)
    if len(corners) == 1:
        heading, turns = np.zeros(1), np.full(1, 2 * math.pi)
    else:
        heading = np.arctan2(sides[:, 1], sides[:, 0])
        turns = (np.roll(heading, -1) - heading) % (2 * math.pi)
    # Each side is followed by the arc around its end.
    pieces = np.column_stack((lengths, margin * turns)).ravel()
    before = np.append(0.0, np.cumsum(pieces))
    parts = _share(float(before[-1]), spacing, least=8)
    along = np.arange(parts) * (before[-1] / parts)
    piece = np.clip(np.searchsorted(before, along, side="right") - 1, 0, len(pieces) - 1)
    rest, side = along - before[piece], piece // 2
    on_arc = piece % 2 == 1
    angle = heading[side] - math.pi / 2 + np.where(on_arc, rest / margin, 0.0)
    ahead = np.where(on_arc, lengths[side], rest)[:, np.newaxis]
    forward = np.column_stack((np.cos(heading[side]), np.sin(heading[side])))
    outward = np.column_stack((np.cos(angle), np.sin(angle)))
    curve: FloatArray = corners[side] + ahead * forward + margin * outward
    return curve
