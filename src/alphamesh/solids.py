"""Demo shapes of known topology in space: what surrounds points and curves at a distance.

A solid is all that lies within some distance of its core: of a point, a ball; of a closed
curve, a tube. A shell keeps a distance from its core on both sides.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from types import MappingProxyType
from typing import TYPE_CHECKING

import numpy as np

from alphamesh.errors import ParameterError

if TYPE_CHECKING:
    from alphamesh._arrays import BoolArray, FloatArray

__all__ = ["DEMO_SOLIDS", "DemoSolid", "demo_solid"]

# Corners of the polygons that stand for curves.
_CORNERS = 240
# Boxes along each side of the grid that points are drawn in.
_GRID = 24
# Half the thickness of the layer that becomes a surface, as a share of the distance. To
# first order a layer holds as many points for each patch of its middle; so 1 % is wrong.
_LAYER = 0.15


@dataclass(frozen=True)
class DemoSolid:
    """A solid whose topology is known.

    Attributes
    ----------
    name : str
        The name that :func:`alphamesh.sample_solid` takes.
    description : str
        One line for people.
    betti : tuple of int
        ``(b0, b1, b2)``: the number of components, tunnels and cavities.
    genera : tuple of int
        Handles of each shell of its surface, in descending order.
    cores : tuple of (c, 3) arrays
        Corners of closed polygons, or single points, that the solid surrounds.
    low, high : float
        Its least and largest distance from the cores.
    """

    name: str
    description: str
    betti: tuple[int, int, int]
    genera: tuple[int, ...]
    cores: tuple[FloatArray, ...] = field(repr=False)
    high: float
    low: float = 0.0

    @cached_property
    def _cells(self) -> tuple[FloatArray, FloatArray]:
        """Low corners and size of the boxes of a grid that may hold a part of it."""
        corners, reach = np.concatenate(self.cores), self.high * (1 + _LAYER)
        low, high = corners.min(axis=0) - reach, corners.max(axis=0) + reach
        size = (high - low) / _GRID
        places = np.stack(np.meshgrid(*[np.arange(_GRID)] * 3, indexing="ij"), axis=-1)
        lows = low + places.reshape(-1, 3) * size
        distance = self.distance(lows + size / 2)
        slack = np.linalg.norm(size) / 2 + _LAYER * self.high
        may = (distance <= self.high + slack) & (distance >= self.low - slack)
        return lows[may], size

    def draw(
        self, rng: np.random.Generator, tries: int, *, surface: bool = False
    ) -> FloatArray:
        """Return random points in it or on its surface: those of some that hit it."""
        lows, size = self._cells
        points = lows[rng.integers(len(lows), size=tries)] + size * rng.random((tries, 3))
        if not surface:
            return points[self.contains(points)]
        # A thin layer on both sides of the surface, pressed onto it.
        nearest = self.nearest_core(points)
        offset = points - nearest
        distance = np.linalg.norm(offset, axis=1)
        levels = np.array([self.low, self.high]) if self.low else np.array([self.high])
        layer = np.abs(distance[:, np.newaxis] - levels)
        level = levels[layer.argmin(axis=1)]
        hit = layer.min(axis=1) <= _LAYER * self.high
        moved = nearest + offset * (level / np.maximum(distance, 1e-300))[:, np.newaxis]
        # Where tubes meet, a part of the layer of one lies inside of another.
        return np.asarray(moved[hit & self._on_surface(moved, level)])

    def _on_surface(self, points: FloatArray, level: FloatArray) -> BoolArray:
        return np.asarray(np.abs(self.distance(points) - level) <= 1e-9 * self.high)

    def nearest_core(self, points: FloatArray) -> FloatArray:
        """Return the point of the cores that is nearest to each point, ``(q, 3)``."""
        best = np.full(len(points), np.inf)
        nearest = np.empty_like(points)
        for core in self.cores:
            start, end = core, np.roll(core, -1, axis=0)
            found = _nearest_on_segments(points, start, end)
            distance = np.linalg.norm(points - found, axis=1)
            closer = distance < best
            best[closer], nearest[closer] = distance[closer], found[closer]
        return nearest

    def distance(self, points: FloatArray) -> FloatArray:
        """Return how far each point is from the cores, ``(q,)``."""
        return np.asarray(np.linalg.norm(points - self.nearest_core(points), axis=1))

    def contains(self, points: FloatArray) -> BoolArray:
        """Return which points lie in it, ``(q,)`` bool."""
        distance = self.distance(points)
        return np.asarray((distance >= self.low) & (distance <= self.high))


def demo_solid(name: str) -> DemoSolid:
    """Return a demo solid by its name.

    Raises
    ------
    ParameterError
        If there is none of that name.
    """
    if name not in tuple(DEMO_SOLIDS):
        raise ParameterError(
            f"no demo solid is called {name!r}; choose one of {', '.join(DEMO_SOLIDS)}"
        )
    return DEMO_SOLIDS[name]


def _nearest_on_segments(points: FloatArray, start: FloatArray, end: FloatArray) -> FloatArray:
    """Return the nearest point to each point on any of the segments."""
    along = end - start
    length_sq = np.maximum(np.einsum("ij,ij->i", along, along), np.finfo(float).tiny)
    best = np.full(len(points), np.inf)
    nearest = np.empty_like(points)
    for a, d, sq in zip(start, along, length_sq, strict=True):
        share = np.clip((points - a) @ d / sq, 0.0, 1.0)
        foot = a + share[:, np.newaxis] * d
        distance = np.square(points - foot).sum(axis=1)
        closer = distance < best
        best[closer], nearest[closer] = distance[closer], foot[closer]
    return nearest


# ---------------------------------------------------------------------- cores


def _point(x: float, y: float, z: float) -> FloatArray:
    return np.array([[x, y, z]])


def _circle(centre: tuple[float, float, float], radius: float, axes: str = "xy") -> FloatArray:
    """Return a circle in the plane of two axes."""
    angle = 2 * np.pi * np.arange(_CORNERS) / _CORNERS
    corners = np.tile(np.asarray(centre, dtype=np.float64), (_CORNERS, 1))
    corners[:, "xyz".index(axes[0])] += radius * np.cos(angle)
    corners[:, "xyz".index(axes[1])] += radius * np.sin(angle)
    return corners


def _trefoil(scale: float) -> FloatArray:
    """Return a trefoil knot: twice around the axis while it goes three times up and down."""
    t = 2 * np.pi * np.arange(_CORNERS) / _CORNERS
    x = np.sin(t) + 2 * np.sin(2 * t)
    y = np.cos(t) - 2 * np.cos(2 * t)
    return scale * np.column_stack((x, y, -1.5 * np.sin(3 * t)))


def _catalogue(*solids: DemoSolid) -> Mapping[str, DemoSolid]:
    return MappingProxyType({solid.name: solid for solid in solids})


DEMO_SOLIDS: Mapping[str, DemoSolid] = _catalogue(
    DemoSolid("ball", "a solid ball", (1, 0, 0), (0,), (_point(0, 0, 0),), 1.0),
    DemoSolid("shell", "a hollow ball", (1, 0, 1), (0, 0), (_point(0, 0, 0),), 1.0, low=0.6),
    DemoSolid("torus", "a ring", (1, 1, 0), (1,), (_circle((0, 0, 0), 1.0),), 0.4),
    DemoSolid(
        "double-torus",
        "two rings grown together side by side",
        (1, 2, 0),
        (2,),
        (_circle((-0.95, 0, 0), 0.8), _circle((0.95, 0, 0), 0.8)),
        0.35,
    ),
    DemoSolid(
        "two-balls",
        "two separate balls",
        (2, 0, 0),
        (0, 0),
        (_point(-1.4, 0, 0), _point(1.4, 0, 0)),
        1.0,
    ),
    DemoSolid(
        "linked-rings",
        "two rings, each through the other",
        (2, 2, 0),
        (1, 1),
        (_circle((-0.5, 0, 0), 1.0), _circle((0.5, 0, 0), 1.0, "xz")),
        0.25,
    ),
    DemoSolid("trefoil", "a knotted tube", (1, 1, 0), (1,), (_trefoil(0.5),), 0.2),
    DemoSolid(
        "hollow-torus",
        "a ring of tube: a torus with a wall",
        (1, 2, 1),
        (1, 1),
        (_circle((0, 0, 0), 1.0),),
        0.45,
        low=0.2,
    ),
)
"""Every demo solid by its name; ``DEMO_SOLIDS["torus"].betti`` is ``(1, 1, 0)``."""
