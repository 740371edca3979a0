"""Rules that choose a radius, each with its reason: one small module per rule."""

from __future__ import annotations

from alphamesh.radius import (
    _all_points,
    _cell_count,
    _enclosed,
    _given_balls,
    _longest_interval,
    _regions,
    _topology,
)
from alphamesh.radius._choice import RadiusChoice, RadiusInterval
from alphamesh.radius._regions import region_events
from alphamesh.radius._registry import DEFAULT_RULE, choose_radius, radius_rule, rule_names

__all__ = [
    "DEFAULT_RULE",
    "RadiusChoice",
    "RadiusInterval",
    "choose_radius",
    "radius_rule",
    "region_events",
    "rule_names",
]

_RULE_MODULES = (
    _all_points, _cell_count, _enclosed, _given_balls, _longest_interval, _regions,
    _topology,
)  # fmt: skip
