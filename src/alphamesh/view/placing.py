"""In which order simplices come, and where their points are in the picture."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from alphamesh.filtration import AnyFiltration
from alphamesh.periodic import PeriodicFiltration

if TYPE_CHECKING:
    from alphamesh._arrays import FloatArray, IntArray

__all__ = ["BoxOrFree", "Frame", "Order", "places_of"]

BoxOrFree: TypeAlias = AnyFiltration | PeriodicFiltration

# Balls beyond the outermost points are shown as far as this share of half the cloud, what
# lies beyond a periodic box as far as that share of half the box.
_MOST_OVERHANG = 0.4
_MARGIN = 0.3


@dataclass(frozen=True, slots=True)
class Order:
    """Simplices by filtration value: which comes when, and when comes which."""

    order: np.ndarray[Any, np.dtype[np.intp]]
    rank: np.ndarray[Any, np.dtype[np.uint32]]

    @classmethod
    def of(cls, radii: FloatArray) -> Order:
        """Return the order of simplices of one dimension; equal ones stay as they are."""
        order = np.argsort(radii, kind="stable")
        rank = np.empty(len(order), dtype=np.uint32)
        rank[order] = np.arange(len(order), dtype=np.uint32)
        return cls(order, rank)


def places_of(filtration: BoxOrFree) -> FloatArray:
    """Return where the points are: in a periodic box, moved into it."""
    if isinstance(filtration, PeriodicFiltration):
        return filtration.positions
    return filtration.points


@dataclass(frozen=True, slots=True)
class Frame:
    """What moves and scales points into a square, or a cube, from -1 to 1.

    Attributes
    ----------
    centre : (d,) float64
    scale : float
        The length that is 1 in the picture.
    low, high : (d,) float64
        The corners of the box that holds the points, or of the periodic box.
    extent : (d,) float64
        Half of what is to be seen, in units of the picture.
    """

    centre: FloatArray
    scale: float
    low: FloatArray
    high: FloatArray
    extent: FloatArray

    @classmethod
    def of(cls, filtration: BoxOrFree, rows: IntArray) -> Frame:
        """Return the frame of the points in some rows."""
        points = places_of(filtration).take(rows, axis=0)
        low = high = np.zeros(points.shape[1])
        if len(points):
            low, high = points.min(axis=0), points.max(axis=0)
        margin = np.zeros(points.shape[1])
        if isinstance(filtration, PeriodicFiltration):
            low = np.where(filtration.periodic, 0.0, low)
            high = np.where(filtration.periodic, filtration.lattice, high)
            if len(margin) == 2:
                margin = np.where(filtration.periodic, _MARGIN * (high - low) / 2, margin)
        centre, half = low / 2 + high / 2, high / 2 - low / 2
        ball = 0.0
        if filtration.weights is not None:
            ball = float(np.sqrt(filtration.weights.take(rows).max(initial=0.0)))
        scale = float(half.max()) or ball or 1.0
        beyond = np.maximum(margin / scale, min(ball / scale, _MOST_OVERHANG))
        return cls(centre, scale, low, high, half / scale + beyond)

    def placed(self, points: FloatArray) -> np.ndarray[Any, np.dtype[np.float32]]:
        """Return points in units of the picture, one coordinate after the other."""
        places = (points - self.centre) / self.scale
        return np.asarray(places, dtype=np.float32).ravel()
