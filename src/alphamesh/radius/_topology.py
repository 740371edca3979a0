"""The radius at which the noise of sampling has died out and the shape stands."""

from __future__ import annotations

import math
from dataclasses import replace
from numbers import Real
from typing import TYPE_CHECKING, Any

import numpy as np

from alphamesh.errors import ParameterError
from alphamesh.persistence import persistence
from alphamesh.radius._choice import RadiusChoice, RadiusInterval
from alphamesh.radius._explain import Findings, explain
from alphamesh.radius._options import whole_number
from alphamesh.radius._registry import radius_rule
from alphamesh.radius._stages import Stages, stages_of
from alphamesh.radius._words import counted

if TYPE_CHECKING:
    from alphamesh._arrays import BoolArray, CountArray, FloatArray
    from alphamesh.filtration import AnyFiltration
    from alphamesh.persistence import Persistence

_RULE = "topology"
# A radius a little above the low end of its range: hardly more is filled in, and the
# range may be a little off.
_STEP = 1.1
# A range wide enough to be taken for one.
_WIDE = 1.05
_TINY = 1e-300
_CLEAR = 0.75
_FEW = 10
_RUNNERS_UP = 3
_UNLIKELY = 0.01

# What the Betti numbers count, by the number of columns of the points.
_NAMES = {2: ("components", "holes"), 3: ("components", "tunnels", "voids")}
_NUMBERS = {2: "two", 3: "three"}
_OPTIONS = ("components", "holes", "voids")

Wanted = tuple[int | None, ...]


@radius_rule(_RULE)
def _topology(  # noqa: PLR0913 (all of them are options)
    filtration: AnyFiltration,
    *,
    betti: tuple[int, ...] | None = None,
    components: int | None = None,
    holes: int | None = None,
    voids: int | None = None,
    min_hole: float = 0.0,
    surface: bool | None = None,
) -> RadiusChoice:
    """Choose the range of radii that explains the persistence pairs best.

    Each loop and each piece has a weight: how much likelier it is a feature of the shape
    than an accident of a random sample of the local density. At each radius, the weights
    of all that is there add up; the largest sum wins, at the smallest such radius.

    The confidence is the probability of the chosen numbers of components and holes, each
    pair of numbers standing with the likelihood ``exp(sum)`` of its best radius.
    """
    columns = filtration.points.shape[1]
    if columns == 2 and not (voids is None and surface is None):
        raise ParameterError("voids= and surface= are for points in space; use holes= here")
    wanted = _wanted(columns, betti, (components, holes, voids)[:columns])
    smallest = _checked_size(min_hole)
    if surface not in (None, True, False):
        raise ParameterError(f"surface must be True, False or None; got {surface!r}")
    if filtration.dimension == 0:
        one = (1, 0, 0)[:columns]
        if not _fits(np.array([one]), wanted).all():
            raise _nowhere(wanted)
        reason = "All points are at one place: one component at any radius."
        return RadiusChoice(
            0.0, _RULE, reason, interval=(0.0, math.inf), betti=one, confidence=1.0
        )
    pairs = persistence(filtration)
    stages = stages_of(pairs, smallest, surface)
    fits = _fits(stages.betti, wanted)
    if not (stages.allowed & fits).any():
        return _anywhere(pairs, wanted)
    choice = _best(pairs, stages, stages.allowed & fits)
    if not any(number is not None for number in wanted):
        return choice
    return replace(choice, reason=f"{_wish(wanted).capitalize()}, as asked. {choice.reason}")


def _wanted(columns: int, betti: Any, single: Wanted) -> Wanted:
    """Return the Betti numbers asked for, None where any will do."""
    if betti is not None:
        if any(number is not None for number in single):
            options = " and ".join(f"{name}=" for name in _OPTIONS[:columns])
            names = ", ".join(f"b{k}" for k in range(columns))
            raise ParameterError(f"give either betti=({names}), or {options}, not both")
        try:
            single = tuple(betti)
        except TypeError:
            single = ()
        if len(single) != columns or None in single:
            raise ParameterError(
                f"betti must be {_NUMBERS[columns]} numbers ({', '.join(_NAMES[columns])}); "
                f"got {betti!r}"
            )
    return tuple(
        None if number is None else whole_number(name, number, least)
        for name, number, least in zip(_OPTIONS, single, (1, 0, 0), strict=False)
    )


def _checked_size(min_hole: Any) -> float:
    if isinstance(min_hole, Real) and 0.0 <= float(min_hole) < math.inf:
        return float(min_hole)
    raise ParameterError(
        "min_hole must be the radius of the smallest hole that counts, 0 or more; "
        f"got {min_hole!r}"
    )


def _fits(betti: CountArray, wanted: Wanted) -> BoolArray:
    """Return which numbers of components and holes are those that were asked for."""
    fits = np.ones(len(betti), dtype=bool)
    for column, number in enumerate(wanted):
        if number is not None:
            fits &= betti[:, column] == number
    return fits


def _best(pairs: Persistence, stages: Stages, eligible: BoolArray) -> RadiusChoice:
    weight = np.where(eligible, stages.weight, -np.inf)
    stage = _first_wide(stages, weight)
    confidence, others = _rivals(stages, weight, stage)
    low, high = _widened(stages, stage)
    radius = low * math.sqrt(min(high / low, _STEP**2)) if low > 0.0 else high / 2.0
    interval = RadiusInterval(low, high, _numbers(stages.betti[stage]))
    strays = int(pairs.betti_numbers(radius)[0]) - interval.betti[0]
    there = (stages.loops.births <= radius) & (radius < stages.loops.deaths)
    accidental = stages.loops.by_outliers | (stages.loops.weights < 0.0)
    accidents = int(np.count_nonzero(there & accidental))
    points = len(pairs.filtration.simplices[0])
    clear = confidence >= _CLEAR and accidents == 0 and points >= _FEW
    findings = Findings(
        points,
        pairs.filtration.dimension,
        interval,
        stages.noise,
        float(stages.loops.contents.compress(there).min(initial=np.inf)),
        _next_change(stages, stage, high),
        strays,
        accidents,
        confidence,
        clear,
        others[0] if others else None,
        stages.sheet,
    )
    return RadiusChoice(
        radius,
        _RULE,
        explain(findings),
        interval=(low, high),
        betti=interval.betti,
        confidence=confidence,
        runners_up=others,
        clear=clear,
        strays=strays,
    )


def _next_change(stages: Stages, stage: int, high: float) -> tuple[int, ...]:
    """Return how the numbers change from a stage to what follows its range."""
    change = stages.betti - stages.betti[stage]
    after = stages.low >= high
    # A narrow range is passed over, unless all is as before then.
    for following in (after & stages.allowed, after):
        first = int(np.argmax(following))
        if following[first] and change[first].any():
            return _numbers(change[first])
    return _numbers(change[stage])


def _first_wide(stages: Stages, weight: FloatArray) -> int:
    """Return the first one of the best stages whose range is wide, or the widest of them.

    The same loops and pieces can be there in several ranges, where a loop that hardly lives
    comes between. Of these, a smaller radius fills in less.
    """
    first = int(np.argmax(weight))
    same = (stages.betti == stages.betti[first]).all(axis=1)
    best = np.flatnonzero(same & (weight == weight[first]))
    starts = np.append(True, (stages.betti[1:] != stages.betti[:-1]).any(axis=1))
    run = (np.cumsum(starts) - 1).take(best)
    low = stages.low.compress(starts)
    high = np.append(low[1:], np.inf)
    widths = high.take(run) / np.maximum(low.take(run), _TINY)
    return int(best[int(np.argmax(np.minimum(widths, _WIDE)))])


def _rivals(
    stages: Stages, weight: FloatArray, stage: int
) -> tuple[float, tuple[RadiusInterval, ...]]:
    """Return how likely the shape of a stage is, and the ranges of the next likely ones."""
    kinds = _best_of_each_shape(stages.betti, weight)
    odds = np.exp(weight.take(kinds) - weight[stage])
    chances = odds / odds.sum()
    rivals = [
        i for i, chance in zip(kinds.tolist(), chances, strict=True) if chance >= _UNLIKELY
    ]
    return float(chances[0]), tuple(
        RadiusInterval(*_widened(stages, i), _numbers(stages.betti[i]))
        for i in rivals[1 : _RUNNERS_UP + 1]
    )


def _best_of_each_shape(betti: CountArray, weight: FloatArray) -> CountArray:
    """Return the eligible stage of the largest weight of each shape, the best one first."""
    order = np.argsort(-weight, kind="stable")
    order = order[weight.take(order) > -np.inf]
    _, first = np.unique(betti.take(order, axis=0), axis=0, return_index=True)
    return order.take(np.sort(first))


def _widened(stages: Stages, stage: int) -> tuple[float, float]:
    """Return the range about a stage over which the numbers stay the same."""
    differs = (stages.betti != stages.betti[stage]).any(axis=1)
    before = np.flatnonzero(differs[:stage])
    after = np.flatnonzero(differs[stage:])
    first = int(before[-1]) + 1 if len(before) else 0
    high = float(stages.low[stage + int(after[0])]) if len(after) else math.inf
    # Below the first allowed stage not everything is followed.
    first = max(first, int(np.argmax(stages.allowed)))
    return float(stages.low[first]), high


def _numbers(betti: CountArray) -> tuple[int, ...]:
    return tuple(betti.tolist())


def _anywhere(pairs: Persistence, wanted: Wanted) -> RadiusChoice:
    """Choose the widest range that has the wanted numbers, noise and strays included."""
    radii, numbers = pairs.betti_curve()
    fits = np.flatnonzero(_fits(numbers, wanted))
    if len(fits) == 0:
        raise _nowhere(wanted)
    low, high = radii, np.append(radii[1:], np.inf)
    step = int(fits[np.argmax((high / 2 - low / 2).take(fits))])
    betti = _numbers(numbers[step])
    radius = low[step] / 2 + high[step] / 2 if math.isfinite(high[step]) else low[step]
    return RadiusChoice(
        float(radius),
        _RULE,
        f"Only while noise is still there does the complex have what was asked for "
        f"({_wish(wanted)}), from {low[step]:.4g} to {high[step]:.4g}; the cloud gives no "
        "clear answer.",
        interval=(float(low[step]), float(high[step])),
        betti=betti,
        confidence=0.0,
        clear=False,
    )


def _nowhere(wanted: Wanted) -> ParameterError:
    return ParameterError(
        f"no radius gives {_wish(wanted)}; see persistence().betti_curve() for the numbers "
        "that there are"
    )


def _wish(wanted: Wanted) -> str:
    named = zip(wanted, _NAMES[len(wanted)], strict=True)
    texts = [counted(number, what[:-1]) for number, what in named if number is not None]
    return " and ".join((", ".join(texts[:-1]), texts[-1]) if texts[1:] else texts)
