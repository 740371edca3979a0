"""Masks of known topology, drawn at random: the shapes of the accuracy benchmark.

A family draws shapes of one kind on the unit square. Half of the families served to
develop the rule ``"topology"``; figures are reported on the other half, which the rule
never saw.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Iterable, Mapping
from types import MappingProxyType
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from benchmarks.mask_fonts import BLOCK_LETTERS, STROKE_LETTERS

__all__ = ["DEVELOPMENT", "FAMILIES", "REPORT", "betti_of", "draw_mask", "room"]

SIZE = 512
# Smallest feature of a mask, in parts of its side.
_FINEST = 0.02

Grid: TypeAlias = NDArray[np.float64]
Region: TypeAlias = NDArray[np.bool_]
Family: TypeAlias = Callable[[np.random.Generator, Grid, Grid], Region]


def draw_mask(family: str, seed: int, size: int = SIZE) -> tuple[Region, tuple[int, int]]:
    """Return a mask of a family and its Betti numbers ``(b0, b1)``.

    A mask is drawn again if its corners touch, so that its topology is a matter of taste;
    if less than 1 % or more than 95 % is chosen; or if its Betti numbers change when it is
    thickened or thinned by up to 2 % of the side: then it has a hole, a crack or a bridge
    that hardly anyone would see.
    """
    rng = np.random.default_rng([seed, *family.encode()])
    centres = (np.arange(size) + 0.5) / size
    x, y = np.meshgrid(centres, centres[::-1])
    finest = math.ceil(_FINEST * size)
    while True:
        mask = FAMILIES[family](rng, x, y)
        betti = betti_of(mask)
        usual = betti is not None and 0.01 < mask.mean() < 0.95
        if betti is not None and usual and min(room(mask, betti, finest)) == finest:
            return mask, betti


def room(mask: Region, betti: tuple[int, int], most: int) -> tuple[int, int]:
    """Return by how many pixels a mask can be thickened, and thinned, and keep its topology.

    The search ends at `most`.
    """
    from scipy import ndimage

    padded = np.pad(mask, most + 1)
    outwards = ndimage.distance_transform_edt(~padded)
    inwards = ndimage.distance_transform_edt(padded)
    steps = range(1, most + 1)
    thicker = (_components_and_holes(outwards <= k) == betti for k in steps)
    thinner = (_components_and_holes(inwards > k) == betti for k in steps)
    return _until_false(thicker), _until_false(thinner)


def _until_false(answers: Iterable[bool]) -> int:
    return sum(1 for _ in itertools.takewhile(bool, answers))


def _components_and_holes(mask: Region) -> tuple[int, int]:
    from scipy import ndimage

    return ndimage.label(mask)[1], ndimage.label(~mask, np.ones((3, 3)))[1] - 1


def betti_of(mask: Region) -> tuple[int, int] | None:
    """Return the components and holes of a mask, None if they depend on touching corners."""
    from scipy import ndimage

    corners = np.ones((3, 3), dtype=bool)
    components = ndimage.label(mask)[1]
    outside = ndimage.label(np.pad(~mask, 1, constant_values=True))[1]
    if ndimage.label(mask, corners)[1] != components:
        return None
    if ndimage.label(np.pad(~mask, 1, constant_values=True), corners)[1] != outside:
        return None
    return components, outside - 1


# Parts


def _disc(x: Grid, y: Grid, centre: tuple[float, float], radius: float) -> Region:
    return (x - centre[0]) ** 2 + (y - centre[1]) ** 2 <= radius**2


def _bar(x: Grid, y: Grid, start: Grid, end: Grid, width: float) -> Region:
    """Return the points within width/2 of a segment."""
    dx, dy = end - start
    along = ((x - start[0]) * dx + (y - start[1]) * dy) / max(dx * dx + dy * dy, 1e-12)
    along = np.clip(along, 0, 1)
    return _disc(x - along * dx, y - along * dy, (start[0], start[1]), width / 2)


def _box(x: Grid, y: Grid, centre: tuple[float, float], half: tuple[float, float]) -> Region:
    return (np.abs(x - centre[0]) <= half[0]) & (np.abs(y - centre[1]) <= half[1])


def _turned(x: Grid, y: Grid, angle: float) -> tuple[Grid, Grid]:
    """Return coordinates turned about the centre of the square."""
    c, s = math.cos(angle), math.sin(angle)
    u, v = x - 0.5, y - 0.5
    return 0.5 + c * u + s * v, 0.5 - s * u + c * v


def _polygon(x: Grid, y: Grid, corners: Grid) -> Region:
    """Return the inside of a simple polygon, (k, 2)."""
    inside = np.zeros(x.shape, dtype=bool)
    for (x0, y0), (x1, y1) in zip(corners, np.roll(corners, -1, axis=0), strict=True):
        if y0 != y1:
            crosses = (y0 > y) != (y1 > y)
            inside ^= crosses & (x < x0 + (y - y0) * (x1 - x0) / (y1 - y0))
    return inside


def _wavy(
    rng: np.random.Generator, x: Grid, y: Grid, centre: tuple[float, float], radius: float
) -> Region:
    """Return a round blob with a wavy border."""
    angle = np.arctan2(y - centre[1], x - centre[0])
    border = np.ones(x.shape)
    for k in range(2, 7):
        height, turn = rng.normal(0, 0.35 / k**1.3), rng.uniform(0, 2 * math.pi)
        border += height * np.cos(k * angle + turn)
    return np.hypot(x - centre[0], y - centre[1]) <= radius * np.clip(border, 0.3, 2)


def _field(rng: np.random.Generator, x: Grid, scale: float) -> Grid:
    """Return a smooth random field with details of about `scale`."""
    from scipy import ndimage

    noise = ndimage.gaussian_filter(
        rng.standard_normal(x.shape), scale * x.shape[0], mode="reflect"
    )
    return (noise - noise.mean()) / noise.std()


# The development half


def _rings(rng: np.random.Generator, x: Grid, y: Grid) -> Region:
    """Rings side by side, apart or overlapping."""
    mask = np.zeros(x.shape, dtype=bool)
    for _ in range(rng.integers(1, 5)):
        outer = rng.uniform(0.1, 0.33)
        cx, cy = rng.uniform(outer + 0.02, 0.98 - outer, 2)
        distance = np.hypot(x - cx, y - cy)
        mask |= (distance <= outer) & (distance >= outer * rng.uniform(0.3, 0.8))
    return mask


def _hole_grid(rng: np.random.Generator, x: Grid, y: Grid) -> Region:
    """Draw a plate with rows and columns of round or square holes."""
    x, y = _turned(x, y, rng.uniform(0, math.pi))
    columns, rows = rng.integers(1, 6, 2)
    width, height = rng.uniform(0.5, 0.68, 2)
    mask = _box(x, y, (0.5, 0.5), (width / 2, height / 2))
    pitch = min(width / columns, height / rows)
    half = pitch * rng.uniform(0.18, 0.4)
    square = rng.random() < 0.5
    for i in range(columns):
        for j in range(rows):
            centre = (
                0.5 + width * ((i + 0.5) / columns - 0.5),
                0.5 + height * ((j + 0.5) / rows - 0.5),
            )
            mask &= ~(_box(x, y, centre, (half, half)) if square else _disc(x, y, centre, half))
    return mask


def _gears(rng: np.random.Generator, x: Grid, y: Grid) -> Region:
    """Draw a toothed wheel with a hub and holes around it."""
    teeth = rng.integers(6, 25)
    angle = np.arctan2(y - 0.5, x - 0.5)
    distance = np.hypot(x - 0.5, y - 0.5)
    height = rng.uniform(0.02, 0.07)
    mask = distance <= 0.4 + height * np.clip(3 * np.sin(teeth * angle), -1, 1)
    mask &= distance >= rng.uniform(0.04, 0.13)
    holes, middle = rng.integers(0, 8), rng.uniform(0.22, 0.27)
    if holes:
        radius = rng.uniform(0.25, 0.75) * min(0.09, math.pi * middle / holes)
        for turn in np.arange(holes) / holes * 2 * math.pi + rng.uniform(0, 6):
            centre = (0.5 + middle * math.cos(turn), 0.5 + middle * math.sin(turn))
            mask &= ~_disc(x, y, centre, radius)
    return mask


def _blobs(rng: np.random.Generator, x: Grid, y: Grid) -> Region:
    """Wavy blobs, apart or together, with holes of many sizes."""
    mask = np.zeros(x.shape, dtype=bool)
    for _ in range(rng.integers(1, 4)):
        radius = rng.uniform(0.15, 0.35)
        cx, cy = rng.uniform(radius, 1 - radius, 2)
        mask |= _wavy(rng, x, y, (cx, cy), radius)
    for _ in range(rng.integers(0, 9)):
        cx, cy = rng.uniform(0.1, 0.9, 2)
        mask &= ~_wavy(rng, x, y, (cx, cy), rng.uniform(0.03, 0.12))
    return mask


def _strokes(rng: np.random.Generator, x: Grid, y: Grid) -> Region:
    """One to three letters of pen strokes."""
    mask = np.zeros(x.shape, dtype=bool)
    count = rng.integers(1, 4)
    pen = rng.uniform(0.07, 0.2) / count
    for place in range(count):
        letter = STROKE_LETTERS[rng.integers(len(STROKE_LETTERS))]
        scale = np.array([0.78 / count, rng.uniform(0.5, 0.8)])
        corner = np.array([(place + 0.11) / count, 0.5 - scale[1] / 2])
        for line in letter:
            points = corner + scale * np.array(line)
            for start, end in itertools.pairwise(points):
                mask |= _bar(x, y, start, end, pen)
    return mask


def _links(rng: np.random.Generator, x: Grid, y: Grid) -> Region:
    """Thick discs and rings joined in a circle by thin bars, some bars missing."""
    mask = np.zeros(x.shape, dtype=bool)
    count = rng.integers(3, 7)
    turns = np.arange(count) / count * 2 * math.pi + rng.uniform(0, 6)
    centres = 0.5 + 0.31 * np.column_stack((np.cos(turns), np.sin(turns)))
    for start, end in zip(centres, np.roll(centres, -1, axis=0), strict=True):
        if rng.random() < 0.8:
            mask |= _bar(x, y, start, end, rng.uniform(0.02, 0.07))
    for cx, cy in centres:
        radius = rng.uniform(0.06, 0.14)
        mask |= _disc(x, y, (cx, cy), radius)
        if rng.random() < 0.5:
            mask &= ~_disc(x, y, (cx, cy), radius * rng.uniform(0.35, 0.7))
    return mask


# The report half


def _targets(rng: np.random.Generator, x: Grid, y: Grid) -> Region:
    """Rings within rings, some cut open, some with a disc in the middle."""
    distance = np.hypot(x - 0.5, y - 0.5)
    angle = np.arctan2(y - 0.5, x - 0.5)
    mask = np.zeros(x.shape, dtype=bool)
    outer = rng.uniform(0.38, 0.47)
    while outer > 0.08:
        inner = outer - rng.uniform(0.05, 0.13)
        ring = (distance <= outer) & (distance >= inner)
        if rng.random() < 0.3:
            away = np.abs((angle - rng.uniform(-3, 3) + math.pi) % (2 * math.pi) - math.pi)
            ring &= away * distance > rng.uniform(0.03, 0.09)
        mask |= ring
        outer = inner - rng.uniform(0.04, 0.12)
    return mask


def _carpets(rng: np.random.Generator, x: Grid, y: Grid) -> Region:
    """Square plates with a large hole in the middle and smaller ones around it."""
    mask = _box(x, y, (0.5, 0.5), (0.45, 0.45))
    cells = [(0.5, 0.5, 0.45)]
    large, small = rng.uniform(0.2, 0.45), rng.uniform(0.3, 0.6)
    for cx, cy, half in cells:
        mask &= ~_box(x, y, (cx, cy), (half * large, half * large))
    for i in (-1, 0, 1):
        for j in (-1, 0, 1):
            if (i, j) != (0, 0) and rng.random() < 0.7:
                centre = (0.5 + 0.3 * i, 0.5 + 0.3 * j)
                mask &= ~_box(x, y, centre, (0.15 * small, 0.15 * small))
    return mask


def _stars(rng: np.random.Generator, x: Grid, y: Grid) -> Region:
    """Stars and polygons with star and polygon holes."""
    mask = np.zeros(x.shape, dtype=bool)
    for _ in range(rng.integers(1, 4)):
        radius = rng.uniform(0.18, 0.42)
        centre = rng.uniform(radius, 1 - radius, 2)
        star, turn = _star(rng), rng.uniform(0, 6)
        hole = rng.uniform(0.25, 0.7) if rng.random() < 0.7 else 0.0
        mask |= _polygon(x, y, centre + radius * _spun(star, turn))
        if hole:
            inner = star if rng.random() < 0.5 else _star(rng)
            mask &= ~_polygon(x, y, centre + hole * radius * _spun(inner, turn))
    return mask


def _star(rng: np.random.Generator) -> Grid:
    corners = rng.integers(3, 8)
    turns = np.arange(2 * corners) / corners * math.pi
    lengths = np.where(np.arange(2 * corners) % 2, rng.uniform(0.45, 1.0), 1.0)
    return lengths[:, None] * np.column_stack((np.cos(turns), np.sin(turns)))


def _spun(corners: Grid, angle: float) -> Grid:
    c, s = math.cos(angle), math.sin(angle)
    spun: Grid = corners @ np.array([[c, s], [-s, c]])
    return spun


def _words(rng: np.random.Generator, x: Grid, y: Grid) -> Region:
    """One to four letters of square blocks."""
    count = rng.integers(1, 5)
    block = min(0.9 / (6 * count - 1), 0.9 / 7)
    mask = np.zeros(x.shape, dtype=bool)
    left = 0.5 - block * (6 * count - 1) / 2
    for place in range(count):
        letter = BLOCK_LETTERS[rng.integers(len(BLOCK_LETTERS))]
        column = np.floor((x - left) / block - 6 * place).astype(int)
        row = np.floor((0.5 + 3.5 * block - y) / block).astype(int)
        inside = (column >= 0) & (column < 5) & (row >= 0) & (row < 7)
        pixels = np.array([[dot == "#" for dot in line] for line in letter])
        mask |= inside & pixels[np.clip(row, 0, 6), np.clip(column, 0, 4)]
    return mask


def _sponges(rng: np.random.Generator, x: Grid, y: Grid) -> Region:
    """Draw the upper part of a smooth random field."""
    field = _field(rng, x, rng.uniform(0.035, 0.08))
    frame = np.maximum(np.abs(x - 0.5), np.abs(y - 0.5)) <= 0.47
    smooth = field >= rng.uniform(-0.7, 0.3)
    return smooth & frame


def _networks(rng: np.random.Generator, x: Grid, y: Grid) -> Region:
    """Streets of thin and thick bars between random places."""
    from scipy.spatial import Delaunay

    places = [rng.uniform(0.08, 0.92, 2)]
    for _ in range(500):
        place = rng.uniform(0.08, 0.92, 2)
        if min(np.hypot(*(place - other)) for other in places) > 0.24:
            places.append(place)
    points = np.array(places)
    mask = np.zeros(x.shape, dtype=bool)
    for corners in Delaunay(points).simplices:
        for i, j in ((0, 1), (1, 2), (2, 0)):
            a, b = sorted((int(corners[i]), int(corners[j])))
            if np.hypot(*(points[a] - points[b])) < 0.42 and (a * 31 + b * 17) % 3:
                width = 0.03 + 0.02 * ((a + b) % 4)
                mask |= _bar(x, y, points[a], points[b], width)
    return mask


DEVELOPMENT: Mapping[str, Family] = MappingProxyType(
    {
        "rings": _rings,
        "hole-grids": _hole_grid,
        "gears": _gears,
        "blobs": _blobs,
        "strokes": _strokes,
        "links": _links,
    }
)
REPORT: Mapping[str, Family] = MappingProxyType(
    {
        "targets": _targets,
        "carpets": _carpets,
        "stars": _stars,
        "words": _words,
        "sponges": _sponges,
        "networks": _networks,
    }
)
FAMILIES: Mapping[str, Family] = MappingProxyType({**DEVELOPMENT, **REPORT})
