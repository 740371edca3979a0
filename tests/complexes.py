"""Strategies for complexes and shapes of nasty clouds."""

from __future__ import annotations

import math

from hypothesis import assume
from hypothesis import strategies as st

import alphamesh as am
import strategies
from alphamesh.errors import CoordinateRangeError


@st.composite
def complexes(draw):
    """Complexes of all clouds whose circles float64 can hold."""
    points = draw(strategies.clouds())
    try:
        return am.AlphaComplex(points)
    except CoordinateRangeError as error:
        assume("too large for float64" not in str(error))
        raise


@st.composite
def shapes(draw):
    """Shapes at, just below, between and beyond the radii where the complex changes."""
    cx = draw(complexes())
    radius = draw(st.sampled_from([*cx.critical_radii().tolist(), 0.0, math.inf, 1.0]))
    return cx.at(draw(st.sampled_from([radius, math.nextafter(radius, 0), radius * 1.5])))
