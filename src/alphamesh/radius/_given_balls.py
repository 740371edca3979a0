"""The radius at which balls are as large as their weights say."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from alphamesh.radius._choice import RadiusChoice
from alphamesh.radius._registry import WEIGHTED_RULE, radius_rule
from alphamesh.radius._words import counted

if TYPE_CHECKING:
    from alphamesh.filtration import AnyFiltration


@radius_rule(WEIGHTED_RULE, balls="weighted")
def _given_balls(filtration: AnyFiltration) -> RadiusChoice:
    """Choose 0: no ball grows nor shrinks."""
    assert filtration.weights is not None
    empty = int(np.count_nonzero(filtration.weights < 0))
    without = f"; without a ball: {counted(empty, 'point')} of negative weight" if empty else ""
    reason = (
        "Each ball has the size that its weight gives it: at radius 0, the complex is the "
        f"dual of the union of these balls{without}."
    )
    return RadiusChoice(0.0, WEIGHTED_RULE, reason)
