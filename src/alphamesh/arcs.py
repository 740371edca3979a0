"""Outlines made of segments and circular arcs: as polygons, as Bézier curves, as SVG."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np

from alphamesh._arrays import read_only
from alphamesh.errors import ParameterError

if TYPE_CHECKING:
    from alphamesh._arrays import AnyArray, CodeArray, CountArray, FloatArray, IntArray

__all__ = ["Border", "bezier_paths", "next_pieces", "polygons", "svg_paths", "without_repeats"]

# Chords and curves span at most an eighth of a turn.
_WIDEST = math.pi / 4

_MOVE, _LINE, _CURVE, _CLOSE = 1, 2, 4, 79


@dataclass(frozen=True, slots=True)
class Border:
    """Closed outlines, piece after piece; see RestrictedVoronoi for the arrays.

    `cell` is the row of each piece, `points` the centre of the arcs of each row, `radius`
    that of the largest disc. `radii`, of each row, is None if all discs have that one.
    """

    points: FloatArray
    radius: float
    offset: CountArray
    cell: IntArray
    start: FloatArray
    end: FloatArray
    neighbor: IntArray
    angles: FloatArray
    radii: FloatArray | None = None

    def radius_at(self, piece: AnyArray) -> FloatArray | float:
        """Return the radius of the circles of the pieces `piece`, or that of all."""
        return self.radius if self.radii is None else self.radii.take(self.cell[piece])

    @property
    def turns(self) -> FloatArray:
        """Angle of each arc in radians; 0 for a segment."""
        turns: FloatArray = np.where(
            self.neighbor < 0, self.angles[:, 1] - self.angles[:, 0], 0.0
        )
        return turns

    def on_circles(self, piece: AnyArray, angle: FloatArray) -> FloatArray:
        """Return the points at the angles `angle` of the circles of the pieces `piece`."""
        centre: FloatArray = self.points.take(self.cell[piece], axis=0)
        return centre + np.reshape(self.radius_at(piece), (-1, 1)) * _unit(angle)


def next_pieces(offset: CountArray) -> CountArray:
    """Return the index of the piece that follows each one on the same outline."""
    following = np.arange(1, int(offset[-1]) + 1)
    used = np.diff(offset) > 0
    following[offset[1:][used] - 1] = offset[:-1][used]
    return following


def polygons(border: Border, tolerance: float) -> tuple[FloatArray, CountArray]:
    """Return the outlines as polygons whose chords are at most `tolerance` off their arcs."""
    if border.radius == 0:
        return _nothing(len(border.offset))
    # A chord over the angle a is r (1 - cos(a / 2)) = 2 r sin(a / 4)**2 away from its arc.
    turns = border.turns
    widest: FloatArray | float
    if border.radii is None:
        share = tolerance / (2 * border.radius)
        widest = min(_WIDEST, 4 * math.asin(math.sqrt(share)) if share < 1 else _WIDEST)
    else:
        with np.errstate(divide="ignore"):
            shares = tolerance / (2 * border.radii.take(border.cell))
        widest = np.minimum(_WIDEST, 4 * np.arcsin(np.sqrt(np.minimum(shares, 1.0))))
    chords = np.maximum(1, np.ceil(turns / widest)).astype(np.int64)
    first = np.cumsum(chords) - chords
    piece = np.repeat(np.arange(len(chords)), chords)
    step = np.arange(len(piece)) - first[piece]
    vertices = np.empty((len(piece), 2))
    vertices[first] = border.start
    inner = np.flatnonzero(step)
    at = piece[inner]
    angle = border.angles[at, 0] + turns[at] * (step[inner] / chords[at])
    vertices[inner] = border.on_circles(at, angle)
    offset = np.append(first, len(piece))[border.offset]
    return without_repeats(vertices, offset)


def _nothing(count: int) -> tuple[FloatArray, CountArray]:
    return read_only(np.empty((0, 2))), read_only(np.zeros(count, dtype=np.int64))


def without_repeats(vertices: FloatArray, offset: CountArray) -> tuple[FloatArray, CountArray]:
    """Drop vertices that equal the next one; outlines left with less than three vanish."""
    kept = (vertices != vertices.take(next_pieces(offset), axis=0)).any(axis=1)
    count = np.diff(np.append(0, np.cumsum(kept))[offset])
    small = (count > 0) & (count < 3)
    if small.any():
        kept &= ~np.repeat(small, np.diff(offset))
        count[small] = 0
    return read_only(vertices[kept]), read_only(np.append(0, np.cumsum(count)))


def bezier_paths(border: Border) -> tuple[FloatArray, CodeArray, CountArray]:
    """Return the outlines as paths of lines and cubic curves: vertices, codes, offset."""
    if border.radius == 0:
        vertices, offset = _nothing(len(border.offset))
        return vertices, read_only(np.empty(0, dtype=np.uint8)), offset
    turns = border.turns
    arc = border.neighbor < 0
    curves = np.where(arc, np.maximum(1, np.ceil(turns / _WIDEST)), 0).astype(np.int64)
    sizes = np.where(arc, 3 * curves, 1)
    # Each outline begins with a move and ends with a close.
    used = np.diff(border.offset) > 0
    before = np.append(0, np.cumsum(sizes))
    offset = before[border.offset] + 2 * np.append(0, np.cumsum(used))
    outline = np.cumsum(used)[border.cell] - 1
    last = before[1:] + 2 * outline
    vertices = np.empty((int(offset[-1]), 2))
    codes = np.full(len(vertices), _CURVE, dtype=np.uint8)
    codes[last[~arc]] = _LINE
    begin, close = offset[:-1][used], offset[1:][used] - 1
    codes[begin], codes[close] = _MOVE, _CLOSE
    vertices[begin] = vertices[close] = border.start[border.offset[:-1][used]]
    piece = np.repeat(np.arange(len(curves)), curves)
    step = np.arange(len(piece)) - np.repeat(np.cumsum(curves) - curves, curves)
    turn = turns[piece] / curves[piece]
    after = last[piece] - 3 * (curves[piece] - step)
    for k, points in enumerate(_curves(border, piece, turn, step), start=1):
        vertices[after + k] = points
    vertices[last] = border.end
    return read_only(vertices), read_only(codes), read_only(offset)


def _curves(
    border: Border, piece: CountArray, turn: FloatArray, step: CountArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return two controls and the end of each curve, `step` curves from its arc's start."""
    angle = border.angles[piece, 0] + turn * step
    reach = (4 / 3 * border.radius_at(piece) * np.tan(turn / 4))[:, np.newaxis]
    quarter = math.pi / 2
    start, end = border.on_circles(piece, angle), border.on_circles(piece, angle + turn)
    return (
        start + reach * _unit(angle + quarter),
        end - reach * _unit(angle + turn + quarter),
        end,
    )


def _unit(angle: FloatArray) -> FloatArray:
    return np.column_stack((np.cos(angle), np.sin(angle)))


def svg_paths(border: Border, digits: int) -> list[str]:
    """Return the outlines as SVG path data."""
    given: Any = digits
    if not isinstance(given, int | np.integer) or not 1 <= given <= 17:
        raise ParameterError(f"digits must be a whole number from 1 to 17; got {digits!r}")
    if border.radius == 0:
        return [""] * (len(border.offset) - 1)
    turns = border.turns
    # SVG draws nothing between equal ends, so that arcs of more than half a turn are halved.
    halfway = border.on_circles(np.arange(len(turns)), border.angles[:, 0] + turns / 2)
    ends, middles = border.end.tolist(), halfway.tolist()
    number = f"%.{digits}g"
    arc_to = f"A{number} {number} 0 0 1 {number} {number}"
    line_to, move_to = f"L{number} {number}", f"M{number} {number}"
    radii = np.broadcast_to(border.radius_at(np.arange(len(turns))), len(turns)).tolist()
    drawn = []
    for k, (neighbor, turn) in enumerate(
        zip(border.neighbor.tolist(), turns.tolist(), strict=True)
    ):
        round_ = radii[k], radii[k]
        if neighbor >= 0:
            drawn.append(line_to % tuple(ends[k]))
        elif turn <= math.pi:
            drawn.append(arc_to % (*round_, *ends[k]))
        else:
            drawn.append(arc_to % (*round_, *middles[k]) + arc_to % (*round_, *ends[k]))
    starts = border.start.tolist()
    return [
        move_to % tuple(starts[a]) + "".join(drawn[a:b]) + "Z" if b > a else ""
        for a, b in pairwise(border.offset.tolist())
    ]
