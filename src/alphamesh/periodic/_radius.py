"""Rules that choose a radius in a periodic box: those that look at homology alone."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from alphamesh.errors import EmptyCloudError, ParameterError, PeriodicError
from alphamesh.periodic._persistence import periodic_persistence
from alphamesh.radius import RadiusChoice, rule_names

if TYPE_CHECKING:
    from alphamesh.periodic._filtration import PeriodicFiltration

__all__ = ["PERIODIC_RULES", "choose_periodic_radius"]

PERIODIC_RULES = ("connected", "percolation", "longest-interval")


def choose_periodic_radius(
    filtration: PeriodicFiltration, rule: str | None = None, **options: Any
) -> RadiusChoice:
    """Choose a radius for a periodic filtration, and say why.

    Parameters
    ----------
    filtration : PeriodicFiltration
    rule : str, optional
        ``"connected"``, the default: the least radius at which all is one piece.
        ``"percolation"``: the least radius at which a chain of points runs around the box.
        ``"longest-interval"``: the middle of the widest range of radii over which no Betti
        number changes, from the first change on.
    **options
        There are none.

    Returns
    -------
    RadiusChoice

    Raises
    ------
    EmptyCloudError
        If there are no points.
    ParameterError
        If there is no such rule or option.
    PeriodicError
        If the rule has no meaning in a periodic box.
    """
    name = PERIODIC_RULES[0] if rule is None else rule
    if name not in PERIODIC_RULES:
        known = ", ".join(repr(known) for known in PERIODIC_RULES)
        if name in (*rule_names(2), *rule_names(3)):
            raise PeriodicError(
                f"the radius rule {name!r} is for clouds without periods; in a box: {known}"
            )
        raise ParameterError(f"there is no radius rule {name!r}; in a periodic box: {known}")
    if options:
        raise ParameterError(
            f"the radius rule {name!r} has no option {next(iter(options))!r}; its options: none"
        )
    if len(filtration.points) == 0:
        raise EmptyCloudError(
            "a cloud without points has no radius to choose; "
            "check where the points should have come from"
        )
    return _RULES[name](filtration)


def _longest_interval(filtration: PeriodicFiltration) -> RadiusChoice:
    radii, numbers = periodic_persistence(filtration).betti_curve()
    # Before the first change there are points alone.
    first = 1 if len(radii) > 2 else 0
    # Halves do not overflow.
    widest = first + int(np.argmax((radii[1:] / 2 - radii[:-1] / 2)[first:]))
    low, high = radii[widest : widest + 2].tolist()
    betti = tuple(numbers[widest].tolist())
    reason = (
        f"From {low:.4g} to {high:.4g} the Betti numbers stay {', '.join(map(str, betti))}: no "
        "other range of radii without a change is so wide, from the first change on until the "
        "box is full. This is its middle."
    )
    return RadiusChoice(
        low / 2 + high / 2, "longest-interval", reason, interval=(low, high), betti=betti
    )


def _connected(filtration: PeriodicFiltration) -> RadiusChoice:
    deaths = periodic_persistence(filtration).deaths[0]
    radius = float(deaths.max(initial=0.0))
    reason = "The least radius at which all points in the box are one piece with each other."
    return _placed(filtration, RadiusChoice(radius, "connected", reason))


def _percolation(filtration: PeriodicFiltration) -> RadiusChoice:
    loops = periodic_persistence(filtration).essential[1]
    radius = float(filtration.radii[1].take(loops).min())
    reason = (
        "The least radius at which a chain of points runs through the box to its own copy, "
        "and so on without end."
    )
    return _placed(filtration, RadiusChoice(radius, "percolation", reason))


def _placed(filtration: PeriodicFiltration, choice: RadiusChoice) -> RadiusChoice:
    """Return `choice` with the Betti numbers at its radius and where they hold."""
    radii, numbers = periodic_persistence(filtration).betti_curve()
    step = int(np.searchsorted(radii, choice.radius, side="right")) - 1
    high = float(radii[step + 1]) if step + 1 < len(radii) else float("inf")
    return RadiusChoice(
        choice.radius,
        choice.rule,
        choice.reason,
        interval=(float(radii[step]), high),
        betti=tuple(numbers[step].tolist()),
    )


_RULES = {
    "longest-interval": _longest_interval,
    "connected": _connected,
    "percolation": _percolation,
}
