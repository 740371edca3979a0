"""What a random sample shows by chance, and what that says about a loop or a gap.

In a random sample of n points in the plane, about ``n * (1 + c) * exp(-c)`` loops die at
radii of content c or more: these are the voids between the points, local maxima of the
distance to them. About ``2 * n * exp(-c)`` Gabriel edges are longer. (The content of a
radius is the number of points that such a disc holds on average.) Both follow from the
theory of Poisson processes and fall off so fast that the largest void has nearly the same
content in every sample.

A feature of the shape may have any size: the logarithm of its content is spread evenly
over some range, one feature being expected beforehand. The *weight* of a feature is the
logarithm of how much likelier the shape explains it than chance does.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from alphamesh._arrays import FloatArray

__all__ = ["Gaps", "log_range", "noise_content", "noise_square"]

_FEWEST = 10
# Part of the edges of a spanning tree that tell how long gaps are.
_TAIL = 0.2
# No regular grid is so perfect that gaps of chance are shorter than this, in parts of the
# typical length.
_LEAST_SCALE = 0.05
_TINY = 1e-6


def log_range(n: int) -> float:
    """Return the length of the range of log contents that features of n points span."""
    return float(np.log(max(n, _FEWEST)))


def noise_content(n: int) -> float:
    """Return the content that half a void of a sample of n points exceeds on average."""
    return noise_square(np.ones(1), n)


def noise_square(rates: FloatArray, n: int) -> float:
    """Return the squared radius that half a void exceeds on average, by local density.

    Parameters
    ----------
    rates : (b,) float64
        Points in a disc of radius 1, in equal shares of the cloud.
    n : int
        Number of points.
    """
    # Few values tell as much about the whole as all of them.
    sample = np.sort(rates)[:: max(1, len(rates) // 2000)]
    low, high = 0.0, (np.log(max(n, 2)) * 2.0 + 20.0) / float(sample[0])
    for _ in range(60):
        middle = (low + high) / 2.0
        content = sample * middle
        expected = n * np.mean((1.0 + content) * np.exp(-content))
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
    start, scale : float
        In square roots of contents.
    """

    start: float
    scale: float

    @classmethod
    def of(cls, contents: FloatArray) -> Gaps:
        """Return the model for the contents of the edges of a shortest spanning tree."""
        start, middle = np.quantile(np.sqrt(contents), [1.0 - _TAIL, 1.0 - _TAIL / 2.0])
        scale = float(middle - start) / np.log(2.0)
        return cls(float(start), max(scale, _LEAST_SCALE * float(start), _TINY))

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
        excess = np.maximum(np.sqrt(contents) - self.start, 0.0) / self.scale
        exponent = excess - np.log(_TAIL)
        return np.asarray(exponent - np.log(count * exponent * log_range(n)))
