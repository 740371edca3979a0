"""Hypothesis profiles: a fast, repeatable one by default, and a deep, random one.

``ALPHAMESH_HYPOTHESIS=deep pytest`` searches fifty times longer, from a new seed.
"""

from __future__ import annotations

import os

from hypothesis import HealthCheck, settings

COMMON = {
    "deadline": None,
    "print_blob": True,
    "suppress_health_check": [HealthCheck.too_slow, HealthCheck.filter_too_much],
}

settings.register_profile("fast", max_examples=40, derandomize=True, **COMMON)
settings.register_profile("deep", max_examples=2000, **COMMON)
settings.load_profile(os.environ.get("ALPHAMESH_HYPOTHESIS", "fast"))
