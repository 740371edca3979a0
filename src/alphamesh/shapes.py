"""Demo shapes of known topology, drawn by formulas as boolean masks.

A shape is a formula on the unit square: `x` runs right, `y` runs up, both broadcast.
"""

from __future__ import annotations

import operator
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from alphamesh.errors import ParameterError

__all__ = ["DEMO_SHAPES", "MAX_SIZE", "MIN_SIZE", "DemoShape", "demo_mask"]

# Below MIN_SIZE the thinnest bars and gaps are no longer whole pixels.
MIN_SIZE = 64
MAX_SIZE = 16_384
_BAND = 128

Coordinate: TypeAlias = NDArray[np.float64]
Region: TypeAlias = NDArray[np.bool_]
Pair: TypeAlias = tuple[float, float]
Formula: TypeAlias = Callable[[Coordinate, Coordinate], Region]


@dataclass(frozen=True, slots=True)
class DemoShape:
    """A shape whose topology is known.

    Attributes
    ----------
    name : str
        The name that :func:`demo_mask` takes.
    description : str
        One line for people.
    betti : tuple of int
        ``(b0, b1)``: the number of components and of holes.
    """

    name: str
    description: str
    betti: tuple[int, int]
    formula: Formula = field(repr=False, compare=False)


def demo_mask(name: str, size: int = 512) -> Region:
    """Return a demo shape as a square mask.

    Parameters
    ----------
    name : str
        A key of :data:`DEMO_SHAPES`.
    size : int
        Width and height in pixels, from 64 to 16384.

    Returns
    -------
    (size, size) bool array
        True inside the shape; row 0 is the top, as in an image.

    Raises
    ------
    ParameterError
        The name is unknown, or the size is not an integer in that range.
    """
    if name not in tuple(DEMO_SHAPES):
        raise ParameterError(
            f"no demo shape is called {name!r}; choose one of {', '.join(DEMO_SHAPES)}"
        )
    try:
        pixels = operator.index(size)
    except TypeError:
        raise ParameterError(f"size must be an integer, not {size!r}") from None
    if not MIN_SIZE <= pixels <= MAX_SIZE:
        raise ParameterError(
            f"size={pixels} is out of range; take {MIN_SIZE} to {MAX_SIZE} pixels"
        )
    centres = (np.arange(pixels) + 0.5) / pixels
    x, y = centres[np.newaxis, :], centres[::-1, np.newaxis]
    mask = np.empty((pixels, pixels), np.bool_)
    # In bands, so that the formula's temporary arrays stay small.
    for top in range(0, pixels, _BAND):
        mask[top : top + _BAND] = DEMO_SHAPES[name].formula(x, y[top : top + _BAND])
    return mask


def _disc(x: Coordinate, y: Coordinate, centre: Pair, radius: float) -> Region:
    return (x - centre[0]) ** 2 + (y - centre[1]) ** 2 <= radius**2


def _ring(x: Coordinate, y: Coordinate, centre: Pair, radius: float, width: float) -> Region:
    """Return the band of `width` around a circle."""
    return np.abs(np.hypot(x - centre[0], y - centre[1]) - radius) <= width / 2


def _box(x: Coordinate, y: Coordinate, low: Pair, high: Pair) -> Region:
    return (low[0] <= x) & (x <= high[0]) & (low[1] <= y) & (y <= high[1])


def _bar(x: Coordinate, y: Coordinate, start: Pair, end: Pair, width: float) -> Region:
    """Return the points within width/2 of a segment."""
    dx, dy = end[0] - start[0], end[1] - start[1]
    along = ((x - start[0]) * dx + (y - start[1]) * dy) / (dx * dx + dy * dy)
    along = np.clip(along, 0.0, 1.0)
    return _disc(x - along * dx, y - along * dy, start, width / 2)


def _shape_disc(x: Coordinate, y: Coordinate) -> Region:
    return _disc(x, y, (0.5, 0.5), 0.42)


def _shape_annulus(x: Coordinate, y: Coordinate) -> Region:
    return _ring(x, y, (0.5, 0.5), 0.32, 0.2)


def _shape_cheese(x: Coordinate, y: Coordinate) -> Region:
    inside = _disc(x, y, (0.5, 0.5), 0.45)
    for cx, cy, radius in (
        (0.34, 0.62, 0.13),
        (0.64, 0.68, 0.09),
        (0.66, 0.38, 0.14),
        (0.38, 0.28, 0.07),
        (0.45, 0.83, 0.035),
    ):
        inside &= ~_disc(x, y, (cx, cy), radius)
    return inside


def _shape_islands(x: Coordinate, y: Coordinate) -> Region:
    inside = _disc(x, y, (0.27, 0.7), 0.22)
    for cx, cy, radius in (
        (0.72, 0.78, 0.14),
        (0.75, 0.4, 0.2),
        (0.36, 0.25, 0.15),
        (0.57, 0.12, 0.04),
    ):
        inside |= _disc(x, y, (cx, cy), radius)
    return inside


def _shape_target(x: Coordinate, y: Coordinate) -> Region:
    rings = _ring(x, y, (0.5, 0.5), 0.4, 0.1) | _ring(x, y, (0.5, 0.5), 0.23, 0.1)
    return rings | _disc(x, y, (0.5, 0.5), 0.09)


def _shape_bars(x: Coordinate, y: Coordinate) -> Region:
    inside = np.zeros(np.broadcast_shapes(x.shape, y.shape), np.bool_)
    for left, width in zip(
        (0.08, 0.22, 0.35, 0.47, 0.59, 0.71, 0.83), (8, 6, 5, 4, 3, 2.5, 2), strict=True
    ):
        inside |= _bar(x, y, (left, 0.15), (left + 0.1, 0.85), width / 100)
    return inside


def _shape_window(x: Coordinate, y: Coordinate) -> Region:
    inside = _box(x, y, (0.08, 0.08), (0.92, 0.92))
    panes = (0.12, 0.39, 0.66)
    for left in panes:
        for bottom in panes:
            inside &= ~_box(x, y, (left, bottom), (left + 0.22, bottom + 0.22))
    return inside


def _shape_gear(x: Coordinate, y: Coordinate) -> Region:
    angle = np.arctan2(y - 0.5, x - 0.5)
    # A clipped sine gives teeth with sloping flanks.
    rim = 0.37 + 0.06 * np.clip(3 * np.sin(14 * angle), -1, 1)
    distance = np.hypot(x - 0.5, y - 0.5)
    inside: Region = (distance <= rim) & (distance >= 0.1)
    for turn in range(5):
        turned = 0.4 + turn * 2 * np.pi / 5
        inside &= ~_disc(x, y, (0.5 + 0.2 * np.cos(turned), 0.5 + 0.2 * np.sin(turned)), 0.055)
    return inside


def _shape_spiral(x: Coordinate, y: Coordinate) -> Region:
    distance = np.hypot(x - 0.5, y - 0.5)
    turns = np.arctan2(y - 0.5, x - 0.5) / (2 * np.pi)
    # Arms lie 0.13 apart; 0.5 is the middle of an arm.
    phase = distance / 0.13 - turns
    arm = np.abs(phase - np.floor(phase) - 0.5) <= 0.24
    along = np.floor(phase) + turns
    return arm & (along >= 0.3) & (along <= 2.9)


def _shape_dumbbell(x: Coordinate, y: Coordinate) -> Region:
    weights = _disc(x, y, (0.22, 0.5), 0.18) | _disc(x, y, (0.78, 0.5), 0.18)
    return weights | _bar(x, y, (0.22, 0.5), (0.78, 0.5), 0.04)


def _shape_chain(x: Coordinate, y: Coordinate) -> Region:
    inside = _ring(x, y, (0.2, 0.5), 0.15, 0.06)
    for cx in (0.4, 0.6, 0.8):
        inside |= _ring(x, y, (cx, 0.5), 0.15, 0.06)
    return inside


def _shape_letter_a(x: Coordinate, y: Coordinate) -> Region:
    left = _bar(x, y, (0.18, 0.12), (0.5, 0.88), 0.13)
    right = _bar(x, y, (0.82, 0.12), (0.5, 0.88), 0.13)
    return left | right | _bar(x, y, (0.3, 0.38), (0.7, 0.38), 0.12)


def _shape_letter_b(x: Coordinate, y: Coordinate) -> Region:
    inside = _box(x, y, (0.22, 0.07), (0.35, 0.93))
    for bottom, top in ((0.07, 0.54), (0.46, 0.93)):
        radius = (top - bottom - 0.12) / 2
        middle = (top + bottom) / 2
        inside |= _ring(x, y, (0.52, middle), radius, 0.12) & (x >= 0.52)
        inside |= _box(x, y, (0.3, bottom), (0.52, bottom + 0.12))
        inside |= _box(x, y, (0.3, top - 0.12), (0.52, top))
    return inside


def _shape_letter_c(x: Coordinate, y: Coordinate) -> Region:
    ring = _ring(x, y, (0.5, 0.5), 0.34, 0.14)
    return ring & ~((x > 0.5) & (np.abs(y - 0.5) < 0.07))


def _shape_letter_i(x: Coordinate, y: Coordinate) -> Region:
    return _bar(x, y, (0.5, 0.16), (0.5, 0.58), 0.14) | _disc(x, y, (0.5, 0.82), 0.09)


def _shape_eight(x: Coordinate, y: Coordinate) -> Region:
    return _ring(x, y, (0.5, 0.29), 0.17, 0.11) | _ring(x, y, (0.5, 0.69), 0.15, 0.11)


def _shape_percent(x: Coordinate, y: Coordinate) -> Region:
    rings = _ring(x, y, (0.26, 0.71), 0.14, 0.08) | _ring(x, y, (0.74, 0.29), 0.14, 0.08)
    return rings | _bar(x, y, (0.24, 0.12), (0.76, 0.88), 0.08)


def _catalogue(*shapes: DemoShape) -> Mapping[str, DemoShape]:
    return MappingProxyType({shape.name: shape for shape in shapes})


DEMO_SHAPES: Mapping[str, DemoShape] = _catalogue(
    DemoShape("disc", "a filled disc", (1, 0), _shape_disc),
    DemoShape("annulus", "a disc with one round hole", (1, 1), _shape_annulus),
    DemoShape("cheese", "a disc with five holes of many sizes", (1, 5), _shape_cheese),
    DemoShape("islands", "five separate discs, large to tiny", (5, 0), _shape_islands),
    DemoShape("target", "two rings around a disc, nested", (3, 2), _shape_target),
    DemoShape("bars", "seven separate bars, thick to thin", (7, 0), _shape_bars),
    DemoShape("window", "a frame of thin bars with nine panes", (1, 9), _shape_window),
    DemoShape("gear", "a toothed wheel with six round holes", (1, 6), _shape_gear),
    DemoShape("spiral", "one long arm, wound nearly three times", (1, 0), _shape_spiral),
    DemoShape("dumbbell", "two discs joined by a thin bar", (1, 0), _shape_dumbbell),
    DemoShape("chain", "four rings, each overlapping the next", (1, 7), _shape_chain),
    DemoShape("letter-a", "the letter A", (1, 1), _shape_letter_a),
    DemoShape("letter-b", "the letter B", (1, 2), _shape_letter_b),
    DemoShape("letter-c", "a ring with a narrow gap, so no hole", (1, 0), _shape_letter_c),
    DemoShape("letter-i", "the letter i: a stem and its dot", (2, 0), _shape_letter_i),
    DemoShape("eight", "the digit 8", (1, 2), _shape_eight),
    DemoShape("percent", "a percent sign: two rings and a bar", (3, 2), _shape_percent),
)
"""Every demo shape by its name; ``DEMO_SHAPES["annulus"].betti`` is ``(1, 1)``."""
