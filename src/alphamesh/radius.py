"""Rules that choose a radius, each with its reason."""

from __future__ import annotations

import difflib
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, TypeAlias

from alphamesh.errors import EmptyCloudError, ParameterError
from alphamesh.filtration import Filtration

__all__ = ["DEFAULT_RULE", "RadiusChoice", "choose_radius", "radius_rule", "rule_names"]

DEFAULT_RULE = "all-points"


@dataclass(frozen=True, slots=True)
class RadiusChoice:
    """A radius, and why it was chosen.

    Attributes
    ----------
    radius : float
        In the units of the points.
    rule : str
        Name of the rule that chose it.
    reason : str
        One or two sentences for a reader who has never heard of the rule.
    """

    radius: float
    rule: str
    reason: str

    def __str__(self) -> str:
        return f"radius {self.radius:.6g} (rule {self.rule!r}): {self.reason}"


Rule: TypeAlias = Callable[[Filtration], RadiusChoice]

_RULES: dict[str, Rule] = {}


def radius_rule(name: str) -> Callable[[Rule], Rule]:
    """Return a decorator that makes a function known as the rule `name`.

    The function takes a :class:`~alphamesh.filtration.Filtration` of at least one point
    and returns a :class:`RadiusChoice`.
    """

    def register(rule: Rule) -> Rule:
        if name in _RULES:
            raise ParameterError(f"there is a radius rule {name!r} already")
        _RULES[name] = rule
        return rule

    return register


def rule_names() -> tuple[str, ...]:
    """Return the names of all rules, the default first."""
    return tuple(sorted(_RULES, key=lambda name: (name != DEFAULT_RULE, name)))


def choose_radius(filtration: Filtration, rule: str = DEFAULT_RULE) -> RadiusChoice:
    """Choose a radius for a filtration, and say why.

    Parameters
    ----------
    filtration : Filtration
        From :func:`alphamesh.filtration.filtration`, or ``AlphaComplex.filtration``.
    rule : str
        ``"all-points"``: the smallest radius at which every point is a corner of some
        triangle, as ``criticalAlpha(shp, "all-points")`` in MATLAB.

    Returns
    -------
    RadiusChoice

    Raises
    ------
    EmptyCloudError
        If the cloud has no points.
    ParameterError
        If there is no such rule; the message lists those that there are.
    """
    given: Any = filtration
    if not isinstance(given, Filtration):
        raise ParameterError(
            f"choose_radius needs a filtration, not {type(given).__name__}; "
            "make one with alphamesh.filtration(points), or use AlphaComplex.choose_radius()"
        )
    chosen = _RULES.get(rule)
    if chosen is None:
        raise _unknown_rule(rule)
    if len(filtration.points) == 0:
        raise EmptyCloudError(
            "a cloud without points has no radius to choose; "
            "check where the points should have come from"
        )
    return chosen(filtration)


def _unknown_rule(rule: Any) -> ParameterError:
    names = ", ".join(repr(name) for name in rule_names())
    close = difflib.get_close_matches(str(rule), list(_RULES), n=1)
    guess = f"did you mean {close[0]!r}? " if close else ""
    return ParameterError(f"there is no radius rule {rule!r}; {guess}rules: {names}")


@radius_rule("all-points")
def _all_points(filtration: Filtration) -> RadiusChoice:
    """Choose the smallest radius at which no point is left out of the triangles."""
    if filtration.dimension == 0:
        return _all_points_choice(0.0, "All points are at one place: nothing is left out.")
    flat = filtration.dimension == 1
    joined = filtration.joined_from if flat else filtration.vertex_intervals.regular_from
    last = int(joined.argmax())
    row = int(filtration.simplices[0][last, 0])
    x, y = filtration.points[row]
    count, last_point = f"{len(joined):,}", f"row {row} at ({x:.6g}, {y:.6g})"
    if flat:
        reason = (
            f"The {count} points lie on one line, so there are no triangles. This is the "
            "smallest radius at which each point is joined to another by an edge; any "
            f"smaller one leaves out {last_point}."
        )
    else:
        reason = (
            f"This is the smallest radius at which each of the {count} points is a corner of "
            f"a triangle; any smaller one leaves out {last_point}."
        )
    return _all_points_choice(float(joined[last]), reason)


def _all_points_choice(radius: float, reason: str) -> RadiusChoice:
    return RadiusChoice(radius, "all-points", reason)
