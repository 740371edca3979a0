"""What a random sample shows by chance, and what that says about a loop or a gap.

In a random sample of n points in the plane, about ``n * (1 + c) * exp(-c)`` loops die at
radii of content c or more: these are the voids between the points, local maxima of the
distance to them. About ``2 * n * exp(-c)`` Gabriel edges are longer. (The content of a
radius is the number of points that such a disc holds on average.) Both follow from the
theory of Poisson processes and fall off so fast that the largest void has nearly the same
content in every sample.

In space, ``n * 3 pi**2 / 16 * (1 + c + c**2 / 2) * exp(-c)`` voids die at contents of c or
more: critical tetrahedra, whose contents have a Gamma distribution (Edelsbrunner,
Nikitenko and Reitzner 2017). For loops there is no formula; a simulation of 240,000 uniform
points gave ``4.7 * n * exp(-c)`` from c = 3 on.

A feature of the shape may have any size: the logarithm of its content is spread evenly
over some range, one feature being expected beforehand. The *weight* of a feature is the
logarithm of how much likelier the shape explains it than chance does.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from alphamesh._arrays import FloatArray

__all__ = ["Gaps", "chance", "log_range", "noise_power"]

_FEWEST = 10
# Part of the edges of a spanning tree that tell how long gaps are.
_TAIL = 0.2
# No regular grid is so perfect that gaps of chance are shorter than this, in parts of the
# typical length.
_LEAST_SCALE = 0.05
_TINY = 1e-6
# Of each point, the density of cycles over the content c at which they die is ``factor *
# c**degree * exp(-c)``: by the dimension of the sample, and 1 for loops or 2 for voids.
_CHANCE = {
    (2, 1): (1.0, 1),
    # On a surface chance leaves no voids; noise about it makes fewer of them than loops.
    (2, 2): (1.0, 1),
    (3, 1): (4.7, 0),
    (3, 2): (3.0 * math.pi**2 / 32.0, 2),
}


def log_range(n: int) -> float:
    """Return the length of the range of log contents that features of n points span."""
    return float(np.log(max(n, _FEWEST)))


def chance(
    dimension: int, cycles: int, contents: FloatArray, count: FloatArray | float
) -> FloatArray:
    """Return the logarithm of how many cycles chance makes, per unit of content.

    Parameters
    ----------
    dimension : int
        2 or 3: of the sample.
    cycles : int
        1 for loops, 2 for voids.
    contents : float64 array
        At which the cycles die.
    count : float or float64 array
        Number of points of the sample.
    """
    factor, degree = _CHANCE[dimension, cycles]
    return np.asarray(np.log(factor * count * contents**degree) - contents)


def _beyond(dimension: int, cycles: int, contents: FloatArray) -> FloatArray:
    """Return how many cycles a point has that die at these contents or later."""
    factor, degree = _CHANCE[dimension, cycles]
    total = np.ones_like(contents)
    for k in range(degree, 0, -1):  # 1 + c + c**2 / 2 + ..., innermost first
        total = 1.0 + total * contents / k
    return np.asarray(factor * math.factorial(degree) * total * np.exp(-contents))


def noise_power(dimension: int, rates: FloatArray, n: int) -> float:
    """Return the power of the radius that half a void exceeds on average, by local density.

    Parameters
    ----------
    dimension : int
        2 or 3: of the sample.
    rates : (b,) float64
        Points in a disc or ball of radius 1, in equal shares of the cloud.
    n : int
        Number of points.
    """
    # Without noise, there are no voids in a surface.
    cycles = range(1, dimension)
    # Few values tell as much about the whole as all of them.
    sample = np.sort(rates)[:: max(1, len(rates) // 2000)]
    low, high = 0.0, (np.log(max(n, 2)) * 2.0 + 20.0) / float(sample[0])
    for _ in range(60):
        middle = (low + high) / 2.0
        content = sample * middle
        expected = n * np.mean(sum(_beyond(dimension, k, content) for k in cycles))
        low, high = (middle, high) if expected > 0.5 else (low, middle)
    return float(high)


@dataclass(frozen=True, slots=True)
class Gaps:
    """How long the gaps are that chance leaves between neighbours of a cloud.

    They are told by the cloud's own shortest spanning tree: beyond the length that a fifth
    of its edges exceed, lengths are taken to fall off exponentially. So they do along
    curves and thin bands; in the thick of the plane they fall off faster.

    Attributes
    ----------
    root : float
        One over the dimension of the sample: the power of contents that is a length.
    start, scale : float
        Lengths.
    """

    root: float
    start: float
    scale: float

    @classmethod
    def of(cls, contents: FloatArray, dimension: int) -> Gaps:
        """Return the model for the contents of the edges of a shortest spanning tree."""
        root = 1.0 / dimension
        start, middle = np.quantile(contents**root, [1.0 - _TAIL, 1.0 - _TAIL / 2.0])
        scale = float(middle - start) / np.log(2.0)
        return cls(root, float(start), max(scale, _LEAST_SCALE * float(start), _TINY))

    def weight(self, contents: FloatArray, count: FloatArray | float, n: int) -> FloatArray:
        """Return the weight of gaps: positive if the shape explains them better than chance.

        Parameters
        ----------
        contents : float64 array
        count : float or float64 array
            Number of places where chance could have left the gap.
        n : int
            Number of points of the cloud.
        """
        excess = np.maximum(contents**self.root - self.start, 0.0) / self.scale
        exponent = excess - np.log(_TAIL)
        return np.asarray(exponent - np.log(count * exponent * log_range(n)))
