"""Clouds of the accuracy benchmark, and at which radii each has the topology of its mask."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

import alphamesh as am
from alphamesh.persistence import persistence
from alphamesh.sampling import add_noise, add_outliers, sample_pixels
from benchmarks.masks import Region

__all__ = ["KINDS", "NOISE", "MaskCloud", "sample_cloud", "spacing"]

KINDS = ("uniform", "density", "noise", "outliers")
# How much denser the points lie at one end of the shape than at the other.
_DENSER = 4.0
# Standard deviation of the noise, in mean spacings of the points.
NOISE = 0.25
_OUTLIERS = 0.02

Numbers = NDArray[np.int64]


def spacing(mask: Region, n: int) -> float:
    """Return the mean spacing of n points of a mask, in pixels."""
    return math.sqrt(float(mask.sum()) / n)


def outliers_of(kind: str, n: int) -> int:
    """Return how many of n points are outliers; they are the last rows."""
    return max(1, round(_OUTLIERS * n)) if kind == "outliers" else 0


def sample_cloud(
    mask: Region, n: int, kind: str, rng: np.random.Generator
) -> NDArray[np.float64]:
    """Draw n points of a mask, spread or spoilt as `kind` says."""
    if kind == "density":
        return _unevenly(mask, n, rng)
    extra = outliers_of(kind, n)
    points = sample_pixels(mask, n - extra, seed=rng, replace=True)
    if kind == "noise":
        return add_noise(points, NOISE * spacing(mask, n), seed=rng)
    return add_outliers(points, extra, seed=rng) if extra else points


def _unevenly(mask: Region, n: int, rng: np.random.Generator) -> NDArray[np.float64]:
    """Draw points whose density grows exponentially across the shape, in any direction."""
    rows, columns = np.nonzero(mask)
    angle = rng.uniform(0, 2 * math.pi)
    along = columns * math.cos(angle) + rows * math.sin(angle)
    chances = _DENSER ** ((along - along.min()) / np.ptp(along))
    chosen = rng.choice(len(rows), n, p=chances / chances.sum())
    corners = np.column_stack((columns[chosen], mask.shape[0] - 1 - rows[chosen]))
    return corners + rng.random((n, 2))


@dataclass(frozen=True)
class MaskCloud:
    """A cloud, and for each step of its filtration the Betti numbers.

    Components that consist of outliers alone are not counted.

    Attributes
    ----------
    filtration : Filtration or Filtration3D
    radii : (m,) float64
        Where the numbers change, ascending.
    numbers : (m, 2) or (m, 3) int64
    """

    filtration: am.Filtration | am.Filtration3D
    radii: NDArray[np.float64]
    numbers: Numbers

    @classmethod
    def of(cls, points: NDArray[np.float64], outliers: int = 0) -> MaskCloud:
        """Return a cloud whose last points are outliers."""
        filtration = am.filtration(points)
        radii, numbers = persistence(filtration).betti_curve()
        if outliers:
            merged = _merges_of_shapes(filtration, len(points) - outliers)
            left = len(merged) + 1 - np.searchsorted(merged, radii, side="right")
            numbers = np.column_stack((left, numbers[:, 1:]))
        return cls(filtration, radii, numbers)

    def succeeds(self, betti: tuple[int, ...]) -> bool:
        """Return whether some radius gives these numbers."""
        return bool((self.numbers == betti).all(axis=1).any())

    def at(self, radius: float) -> tuple[int, ...]:
        """Return the Betti numbers at a radius."""
        step = int(np.searchsorted(self.radii, radius, side="right")) - 1
        return tuple(self.numbers[step].tolist())


def _merges_of_shapes(
    filtration: am.Filtration | am.Filtration3D, inliers: int
) -> NDArray[np.float64]:
    """Return the radii at which components meet that both hold points of the shape."""
    joined = filtration.pairs()[0]
    order = np.argsort(filtration.radii[1][joined[:, 1]], kind="stable")
    edges = joined[order, 1]
    parent = list(range(len(filtration.points)))
    holds = [row < inliers for row in parent]
    merged = []
    for edge, (a, b) in zip(
        edges.tolist(), filtration.simplices[1][edges].tolist(), strict=True
    ):
        one, other = _root(parent, a), _root(parent, b)
        if holds[one] and holds[other]:
            merged.append(float(filtration.radii[1][edge]))
        parent[other] = one
        holds[one] = holds[one] or holds[other]
    return np.array(merged)


def _root(parent: list[int], row: int) -> int:
    while parent[row] != row:
        parent[row] = parent[parent[row]]
        row = parent[row]
    return row
