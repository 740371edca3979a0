"""What tiles need to know of the weights of a whole cloud: the least and the greatest."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from alphamesh._weights import shifted_radii
from alphamesh.errors import WeightsError

if TYPE_CHECKING:
    from alphamesh._arrays import FloatArray

__all__ = ["WeightRange", "limits_of"]

# Float radii are off by less than this share of their terms.
_SLACK = 2.0**-40


@dataclass(frozen=True, slots=True)
class WeightRange:
    """The least and the greatest weight of a whole cloud.

    Attributes
    ----------
    least, greatest : float
        Squared radii of balls, of any sign, in squared units of the points.
    """

    least: float
    greatest: float

    @classmethod
    def of(cls, weights: FloatArray) -> WeightRange:
        """Return the range of some weights; that of none is 0 to 0.

        Raises
        ------
        WeightsError
            If a weight is NaN or infinite.
        """
        if len(weights) == 0:
            return cls(0.0, 0.0)
        found = cls(float(np.min(weights)), float(np.max(weights)))
        if not (math.isfinite(found.least) and math.isfinite(found.greatest)):
            raise WeightsError("NaN or infinite weights; drop or mend these rows")
        return found

    def covers(self, weights: FloatArray) -> bool:
        """Tell whether all of some weights lie in this range."""
        return bool(((weights >= self.least) & (weights <= self.greatest)).all())

    def reach(self, radius: float) -> float:
        """Return the radius of the largest ball once `radius` is the signed root of a.

        The orthocentre of a simplex of power value at most a lies within
        ``sqrt(a + greatest)`` of its vertices, and so does it of each point that keeps the
        simplex out. So the halo of a tile is twice as wide.

        Parameters
        ----------
        radius : float
            ``sign(a) * sqrt(|a|)`` for the power parameter a.

        Returns
        -------
        float
            Rounded up; 0 where there is no ball at all.
        """
        root = math.copysign(math.sqrt(abs(self.greatest)), self.greatest)
        return _root_of_sum(radius + _SLACK * abs(radius), root + _SLACK * abs(root))

    def plain_radius(self, radius: float) -> float | None:
        """Return the same radius of the complex without weights, if all weights are equal.

        Its simplices up to this radius are those of the weighted complex up to `radius`,
        to the last bit: values of the former are turned into those of the latter by
        :func:`alphamesh._weights.shifted_radii`, which keeps their order.

        Returns
        -------
        float or None
            Negative where nothing is there yet; None if weights differ.
        """
        if self.least != self.greatest:
            return None
        if self.greatest == 0.0:
            return radius
        if _shifted(0.0, self.greatest) > radius:
            return -1.0
        low, high = 0.0, 2.0 * self.reach(radius) + np.finfo(float).tiny
        if not high < math.inf:
            return math.inf
        while _shifted(high, self.greatest) <= radius:  # what is added is lost in rounding
            low, high = high, 2.0 * high
        # Floats that are not negative are ordered as the integers with the same bits.
        bits = np.array([low, high]).view(np.int64).tolist()
        while bits[1] - bits[0] > 1:
            middle = (bits[0] + bits[1]) // 2
            there = _shifted(float(np.int64(middle).view(np.float64)), self.greatest) <= radius
            bits[0 if there else 1] = middle
        return float(np.int64(bits[0]).view(np.float64))


def limits_of(
    radius: float, weights: FloatArray | None, weight_range: WeightRange | None
) -> tuple[float, float | None]:
    """Return the radius of the largest balls, and `radius` without weights if that will do.

    Raises
    ------
    WeightsError
        If weights come without their range, or do not lie in it.
    """
    if weights is None:
        return radius, radius
    if weight_range is None or not weight_range.covers(weights):
        raise WeightsError(
            "weight_range must be that of the weights of the whole cloud: "
            "WeightRange.of(weights)"
        )
    return weight_range.reach(radius), weight_range.plain_radius(radius)


def _shifted(radius: float, weight: float) -> float:
    return float(shifted_radii(np.array([radius]), weight)[0])


def _root_of_sum(a: float, b: float) -> float:
    """Return the root of the sum of the signed squares of two numbers; 0 if it is negative."""
    low, high = min(a, b), max(a, b)
    if high <= -low:
        return 0.0
    if low >= 0.0:
        return math.hypot(low, high)
    return math.sqrt(high + low) * math.sqrt(high - low)
