"""Solids of known topology on a grid of voxels, drawn at random: for the accuracy in space.

As in :mod:`benchmarks.masks`, half of the families served to develop the rule
``"topology"``, and figures are reported on the other half.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

__all__ = ["DEVELOPMENT", "FAMILIES", "REPORT", "betti_of_solid", "draw_solid", "solid_room"]

SIZE = 72
# Smallest feature of a solid, in parts of the side of the cube.
_FINEST = 0.025

Grid: TypeAlias = NDArray[np.float64]
Region: TypeAlias = NDArray[np.bool_]
Numbers: TypeAlias = tuple[int, int, int]
Family: TypeAlias = Callable[[np.random.Generator, Grid], Region]


def draw_solid(family: str, seed: int, size: int = SIZE) -> tuple[Region, Numbers]:
    """Return voxels of a solid of a family and its Betti numbers ``(b0, b1, b2)``.

    A solid is drawn again if less than 1 % or more than 90 % of the cube belongs to it, or if
    its Betti numbers change when it is thickened or thinned by up to 2.5 % of the side.
    """
    rng = np.random.default_rng([seed, *family.encode()])
    centres = (np.arange(size) + 0.5) / size
    places = np.stack(np.meshgrid(centres, centres, centres, indexing="ij"))
    finest = math.ceil(_FINEST * size)
    while True:
        solid = FAMILIES[family](rng, places)
        if 0.01 < solid.mean() < 0.9:
            betti = betti_of_solid(solid)
            if min(solid_room(solid, betti, finest)) == finest:
                return solid, betti


def solid_room(solid: Region, betti: Numbers, most: int) -> tuple[int, int]:
    """Return by how many voxels a solid can be thickened, and thinned, and stay what it is.

    The search ends at `most`.
    """
    from scipy import ndimage

    padded = np.pad(solid, most + 1)
    outwards = ndimage.distance_transform_edt(~padded)
    inwards = ndimage.distance_transform_edt(padded)
    thicker = thinner = 0
    while thicker < most and betti_of_solid(outwards <= thicker + 1) == betti:
        thicker += 1
    while thinner < most and betti_of_solid(inwards > thinner + 1) == betti:
        thinner += 1
    return thicker, thinner


def betti_of_solid(solid: Region) -> Numbers:
    """Return components, tunnels and voids of the union of closed voxels."""
    from scipy import ndimage

    padded = np.pad(solid, 1)
    components = int(ndimage.label(padded, np.ones((3, 3, 3)))[1])
    voids = int(ndimage.label(~padded)[1]) - 1
    return components, components + voids - _euler(padded), voids


def _euler(padded: Region) -> int:
    """Return vertices - edges + faces - cubes of closed voxels; none is at the border."""
    total = 0
    for axes in range(8):  # the cells that extend along these axes
        cells = padded
        for axis in range(3):
            if not axes >> axis & 1:  # such a cell belongs to the voxels on both sides
                ahead = [slice(None)] * 3
                behind = list(ahead)
                ahead[axis], behind[axis] = slice(1, None), slice(None, -1)
                cells = cells[tuple(ahead)] | cells[tuple(behind)]
        total += (-1) ** axes.bit_count() * int(np.count_nonzero(cells))
    return total


# Parts


def _ball(places: Grid, centre: Grid, radius: float) -> Region:
    return np.asarray(_square(places, centre).sum(axis=0) <= radius**2)


def _square(places: Grid, centre: Grid) -> Grid:
    return (places - centre.reshape(3, 1, 1, 1)) ** 2


def _box(places: Grid, centre: Grid, half: Grid) -> Region:
    away = np.abs(places - centre.reshape(3, 1, 1, 1))
    return np.asarray((away <= half.reshape(3, 1, 1, 1)).all(axis=0))


def _bar(places: Grid, start: Grid, end: Grid, width: float) -> Region:
    """Return what lies within width/2 of a segment."""
    along = (end - start).reshape(3, 1, 1, 1)
    offset = places - start.reshape(3, 1, 1, 1)
    share = (offset * along).sum(axis=0) / max(float((along**2).sum()), 1e-12)
    foot = offset - np.clip(share, 0, 1) * along
    return np.asarray((foot**2).sum(axis=0) <= (width / 2) ** 2)


def _ring(places: Grid, centre: Grid, axis: int, radius: float, tube: float) -> Region:
    square = _square(places, centre)
    height = square[axis]
    across = np.sqrt(square.sum(axis=0) - height)
    return np.asarray((across - radius) ** 2 + height <= tube**2)


# The development half


def _balls(rng: np.random.Generator, places: Grid) -> Region:
    """Balls, apart or together, with smaller balls taken out."""
    solid = np.zeros(places.shape[1:], dtype=bool)
    for _ in range(rng.integers(1, 5)):
        radius = rng.uniform(0.15, 0.35)
        solid |= _ball(places, rng.uniform(radius, 1 - radius, 3), radius)
    for _ in range(rng.integers(0, 6)):
        solid &= ~_ball(places, rng.uniform(0.15, 0.85, 3), rng.uniform(0.06, 0.16))
    return solid


def _plates(rng: np.random.Generator, places: Grid) -> Region:
    """Draw a thick plate with round or square holes through it."""
    half = np.array([rng.uniform(0.3, 0.48), rng.uniform(0.2, 0.48), rng.uniform(0.06, 0.2)])
    solid = _box(places, np.full(3, 0.5), half)
    for _ in range(rng.integers(0, 6)):
        centre = np.append(0.5 + (half[:2] - 0.1) * rng.uniform(-1, 1, 2), 0.5)
        radius = rng.uniform(0.05, 0.12)
        if rng.random() < 0.5:
            solid &= ~_box(places, centre, np.array([radius, radius, 1.0]))
        else:
            up = np.array([0.0, 0.0, 1.0])
            solid &= ~_bar(places, centre - up, centre + up, 2 * radius)
    return solid


def _rings(rng: np.random.Generator, places: Grid) -> Region:
    """Draw rings of three directions: apart, linked or grown together."""
    solid = np.zeros(places.shape[1:], dtype=bool)
    for _ in range(rng.integers(1, 4)):
        radius, tube = rng.uniform(0.15, 0.3), rng.uniform(0.05, 0.1)
        reach = radius + tube
        centre = rng.uniform(reach, 1 - reach, 3)
        solid |= _ring(places, centre, int(rng.integers(3)), radius, tube)
    return solid


# The report half


def _frames(rng: np.random.Generator, places: Grid) -> Region:
    """Bars along the edges of a grid of boxes, some missing."""
    counts = rng.integers(1, 3, 3)
    width = rng.uniform(0.08, 0.14)
    solid = np.zeros(places.shape[1:], dtype=bool)
    corners = [np.linspace(0.1, 0.9, count + 1) for count in counts]
    nodes = np.stack(np.meshgrid(*corners, indexing="ij"), axis=-1)
    for node in np.ndindex(*nodes.shape[:3]):
        for axis in range(3):
            other = list(node)
            other[axis] += 1
            if other[axis] <= counts[axis] and rng.random() < 0.85:
                solid |= _bar(places, nodes[node], nodes[tuple(other)], width)
    return solid


def _cheeses(rng: np.random.Generator, places: Grid) -> Region:
    """Blocks and ovals with bubbles in them, and some borings."""
    half = rng.uniform(0.3, 0.46, 3)
    if rng.random() < 0.5:
        solid = _box(places, np.full(3, 0.5), half)
    else:
        scaled = (places - 0.5) / half.reshape(3, 1, 1, 1)
        solid = np.asarray((scaled**2).sum(axis=0) <= 1)
    for _ in range(rng.integers(1, 6)):
        centre = 0.5 + 0.6 * half * rng.uniform(-1, 1, 3)
        solid &= ~_ball(places, centre, rng.uniform(0.07, 0.15))
    for _ in range(rng.integers(0, 3)):
        start, end = 0.5 + 0.5 * half * rng.uniform(-1, 1, (2, 3))
        axis = rng.integers(3)
        start[axis], end[axis] = -0.2, 1.2
        solid &= ~_bar(places, start, end, rng.uniform(0.12, 0.2))
    return solid


def _sponges(rng: np.random.Generator, places: Grid) -> Region:
    """Draw where a smooth random field is high."""
    from scipy import ndimage

    size = places.shape[1]
    scale = rng.uniform(0.1, 0.16) * size
    field = ndimage.gaussian_filter(rng.standard_normal((size,) * 3), scale, mode="reflect")
    inside = _box(places, np.full(3, 0.5), np.full(3, 0.46))
    return np.asarray((field >= np.quantile(field, rng.uniform(0.3, 0.7))) & inside)


def _boxes(rng: np.random.Generator, places: Grid) -> Region:
    """Boxes, hollow ones and pipes, apart or together."""
    solid = np.zeros(places.shape[1:], dtype=bool)
    for _ in range(rng.integers(1, 4)):
        half = rng.uniform(0.12, 0.3, 3)
        centre = rng.uniform(half, 1 - half, 3)
        part = _box(places, centre, half)
        kind = rng.integers(3)
        if kind:  # hollow, or open at two ends
            inner = half - rng.uniform(0.06, 0.1)
            inner[rng.integers(3)] += float(kind - 1)
            part &= ~_box(places, centre, inner)
        solid |= part
    return solid


DEVELOPMENT: Mapping[str, Family] = MappingProxyType(
    {"balls": _balls, "plates": _plates, "rings": _rings}
)
REPORT: Mapping[str, Family] = MappingProxyType(
    {"frames": _frames, "cheeses": _cheeses, "sponges": _sponges, "boxes": _boxes}
)
FAMILIES: Mapping[str, Family] = MappingProxyType({**DEVELOPMENT, **REPORT})
