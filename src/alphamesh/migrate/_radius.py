"""From alpha as one over the radius, with what is strictly below it, to radii."""

from __future__ import annotations

import math
from numbers import Real
from typing import Any

from alphamesh.errors import ParameterError

__all__ = ["alpha_of", "just_below"]


def alpha_of(alpha: Any) -> float:
    """Return alpha as a float.

    Raises
    ------
    ParameterError
        If it is not a number.
    """
    if not isinstance(alpha, Real) or math.isnan(float(alpha)):
        raise ParameterError(f"alpha must be a number, one over the radius; got {alpha!r}")
    return float(alpha)


def just_below(alpha: float) -> float:
    """Return the largest radius below ``1 / alpha``, infinity for 0 or less."""
    if alpha <= 0 or alpha < 1 / 1.7976931348623157e308:
        return math.inf
    return max(0.0, math.nextafter(1.0 / alpha, 0.0))
