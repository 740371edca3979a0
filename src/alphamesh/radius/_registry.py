"""The rules by name."""

from __future__ import annotations

import difflib
import inspect
from collections.abc import Callable
from dataclasses import replace
from typing import Any, TypeAlias

import numpy as np

from alphamesh._weights import has_weights
from alphamesh.errors import (
    DimensionError,
    EmptyCloudError,
    ParameterError,
    UnweightedOnlyError,
)
from alphamesh.filtration import AnyFiltration, Filtration
from alphamesh.filtration3d import Filtration3D
from alphamesh.persistence import persistence
from alphamesh.radius._choice import RadiusChoice

__all__ = ["DEFAULT_RULE", "WEIGHTED_RULE", "choose_radius", "radius_rule", "rule_names"]

DEFAULT_RULE = "topology"
WEIGHTED_RULE = "weights"

Rule: TypeAlias = Callable[..., RadiusChoice]

_RULES: dict[str, Rule] = {}
_COLUMNS: dict[str, tuple[int, ...]] = {}
_BALLS: dict[str, str] = {}


def radius_rule(
    name: str, columns: tuple[int, ...] = (2, 3), balls: str = "equal"
) -> Callable[[Rule], Rule]:
    """Return a decorator that makes a function known as the rule `name`.

    The function takes a filtration of at least one point, whose points have one of the
    given numbers of `columns`, and its own options as keywords, and returns a
    :class:`RadiusChoice`. What it leaves out of `interval` and `betti` is filled in.
    `balls` tells whether it has a meaning for "equal" balls alone, for "weighted" ones
    alone, or for "any".
    """

    def register(rule: Rule) -> Rule:
        if name in _RULES:
            raise ParameterError(f"there is a radius rule {name!r} already")
        _RULES[name] = rule
        _COLUMNS[name] = columns
        _BALLS[name] = balls
        return rule

    return register


def rule_names(columns: int = 2, *, weighted: bool = False) -> tuple[str, ...]:
    """Return the names of all rules for points of so many columns, the default first.

    With weights, the one that is the default where some weight is positive.
    """
    balls = "weighted" if weighted else "equal"
    first = WEIGHTED_RULE if weighted else DEFAULT_RULE
    names = (name for name in _RULES if columns in _COLUMNS[name])
    fitting = (name for name in names if _BALLS[name] in (balls, "any"))
    return tuple(sorted(fitting, key=lambda name: (name != first, name)))


def default_rule(filtration: AnyFiltration) -> str:
    """Return the rule that is used if none is asked for."""
    weights = filtration.weights
    if weights is None or not has_weights(weights):
        return DEFAULT_RULE
    if float(weights.max()) > 0:
        return WEIGHTED_RULE
    return "longest-interval" if filtration.points.shape[1] == 2 else "all-points"


def choose_radius(
    filtration: AnyFiltration, rule: str | None = None, **options: Any
) -> RadiusChoice:
    """Choose a radius for a filtration, and say why.

    Parameters
    ----------
    filtration : Filtration or Filtration3D
        From :func:`alphamesh.filtration.filtration`, or ``AlphaComplex.filtration``.
    rule : str, optional
        By default ``"topology"``; with weights, ``"weights"`` if some are positive, else
        ``"longest-interval"`` in the plane and ``"all-points"`` in space. Rules speak of
        triangles; in space these are tetrahedra.

        ``"topology"``: where the noise of sampling has died out while the holes and gaps
        of the shape stand. It needs the persistence of the cloud, which is kept. Options,
        for those who know: ``betti=(b0, b1)``, ``components=b0``, ``holes=b1`` and
        ``min_hole=radius``; in space ``betti=(b0, b1, b2)``, where holes are tunnels,
        ``voids=b2``, and ``surface=True`` or ``False`` if the points are known to lie on
        a surface, or not. For balls of equal size alone: what it knows of chance holds for
        them.

        ``"weights"``: 0, where each ball has the size that its weight gives it, so that the
        complex is the dual of their union. For points with weights alone.

        ``"all-points"``: the smallest radius at which every point is a corner of some
        triangle. Known from ``criticalAlpha(shp, "all-points")`` in MATLAB and
        ``optimal_alpha`` in shull.

        ``"regions"``: the smallest such radius at which the triangles also form at most
        ``regions=k`` pieces. Known from ``find_optimal_alpha(k)`` in CGAL and
        ``CG_OptimalAlphaShape`` in PostGIS.

        ``"one-region"``: the same for one piece. Known from
        ``criticalAlpha(shp, "one-region")`` in MATLAB.

        ``"enclosed"``: the smallest radius at which every point is a corner of a
        tetrahedron once the voids of the complex are filled: for points on a surface, such
        as those of a scanner. With ``share=0.99``, at least that share of the points. In
        space alone.

        ``"longest-interval"``: the middle of the widest range of radii over which the
        numbers of components and holes do not change. In the plane alone.

        ``"triangle-count"``: the smallest radius that gives at least ``triangles=k``
        triangles. In the plane alone; in space, ``"tetrahedron-count"`` with
        ``tetrahedra=k``.

        With weights, hidden points count as none, and radii may be negative.
    **options
        Options of the rule.

    Returns
    -------
    RadiusChoice

    Raises
    ------
    EmptyCloudError
        If the cloud has no points.
    ParameterError
        If there is no such rule or option, with a list of those that there are, or an
        option cannot be met.
    DimensionError, UnweightedOnlyError
        If the rule has no meaning for points in the plane or in space, or with weights;
        with a list of those that have.
    """
    given: Any = filtration
    if not isinstance(given, Filtration | Filtration3D):
        raise ParameterError(
            f"choose_radius needs a filtration, not {type(given).__name__}; "
            "make one with alphamesh.filtration(points), or use AlphaComplex.choose_radius()"
        )
    columns = filtration.points.shape[1]
    rule = default_rule(filtration) if rule is None else rule
    chosen = _RULES.get(rule)
    if chosen is None:
        raise _unknown_rule(rule, columns)
    if columns not in _COLUMNS[rule]:
        raise _other_columns(rule, columns)
    _refuse_other_balls(rule, columns, weighted=has_weights(filtration.weights))
    _refuse_unknown_options(rule, chosen, options)
    if len(filtration.points) == 0:
        raise EmptyCloudError(
            "a cloud without points has no radius to choose; "
            "check where the points should have come from"
        )
    return _completed(filtration, chosen(filtration, **options))


def _completed(filtration: AnyFiltration, choice: RadiusChoice) -> RadiusChoice:
    """Return `choice` with the Betti numbers at its radius and where they hold.

    Not in space: these numbers would take as long as all that a rule needs otherwise.
    """
    if isinstance(filtration, Filtration3D):
        return choice
    if choice.interval is not None and choice.betti is not None:
        return choice
    radii, numbers = persistence(filtration).betti_curve()
    step = int(np.searchsorted(radii, choice.radius, side="right")) - 1
    if step < 0:  # with weights, before the first point is there
        return replace(choice, interval=(-np.inf, float(radii[0])), betti=(0, 0))
    high = float(radii[step + 1]) if step + 1 < len(radii) else float("inf")
    b0, b1 = numbers[step].tolist()
    return replace(choice, interval=(float(radii[step]), high), betti=(b0, b1))


def _other_columns(rule: str, columns: int) -> DimensionError:
    names = ", ".join(repr(name) for name in rule_names(columns))
    where = "in the plane" if _COLUMNS[rule] == (2,) else "in space"
    return DimensionError(
        f"the radius rule {rule!r} is for points {where} alone; for these points: {names}"
    )


def _refuse_other_balls(rule: str, columns: int, *, weighted: bool) -> None:
    balls = _BALLS[rule]
    if balls == "any" or (balls == "weighted") == weighted:
        return
    names = ", ".join(repr(name) for name in rule_names(columns, weighted=weighted))
    if weighted:
        raise UnweightedOnlyError(
            f"the radius rule {rule!r} is for balls of equal size, and these points have "
            f"weights; for these: {names}; or give a radius"
        )
    raise ParameterError(
        f"the radius rule {rule!r} is for points with weights; for these: {names}"
    )


def _unknown_rule(rule: Any, columns: int) -> ParameterError:
    names = ", ".join(repr(name) for name in rule_names(columns))
    close = difflib.get_close_matches(str(rule), list(_RULES), n=1)
    guess = f"did you mean {close[0]!r}? " if close else ""
    return ParameterError(f"there is no radius rule {rule!r}; {guess}rules: {names}")


def _refuse_unknown_options(name: str, rule: Rule, options: dict[str, Any]) -> None:
    known = list(inspect.signature(rule).parameters)[1:]
    unknown = [option for option in options if option not in known]
    if unknown:
        listed = ", ".join(known) or "none"
        raise ParameterError(
            f"the radius rule {name!r} has no option {unknown[0]!r}; its options: {listed}"
        )
