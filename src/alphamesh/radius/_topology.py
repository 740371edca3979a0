"""The radius at which the noise of sampling has died out and the shape stands."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from alphamesh.errors import ParameterError
from alphamesh.persistence import persistence
from alphamesh.radius._choice import RadiusChoice, RadiusInterval
from alphamesh.radius._registry import radius_rule
from alphamesh.radius._words import components_and_holes

if TYPE_CHECKING:
    from alphamesh._arrays import CountArray, FloatArray
    from alphamesh.filtration import Filtration
    from alphamesh.persistence import Persistence

_RULE = "topology"
_RIVALS = 3
# A radius stays near the low end of its interval, where the least has been filled in.
_MARGIN = 1.02
# Enough points in a disc; keeps infinities out of the sums.
_BEYOND_DOUBT = 1e9


class _Steps(NamedTuple):
    """Ranges of radii with constant Betti numbers, and the evidence for each."""

    low: FloatArray
    high: FloatArray
    betti: CountArray
    score: FloatArray


@radius_rule(_RULE, columns=(2,))
def _topology(
    filtration: Filtration,
    *,
    betti: tuple[int, int] | None = None,
    components: int | None = None,
    holes: int | None = None,
    min_hole: float = 0.0,
) -> RadiusChoice:
    """Choose the range of radii that explains the persistence pairs best.

    If n points are drawn at random with the intensity `m` per unit of area, about
    ``n x exp(-x)`` loops die beyond ``x = m pi r^2``, the number of points expected in a
    disc, and ``n exp(-2 x)`` components stand alone at r: the noise of sampling. A class
    that lives on is evidence for the shape, the more the less likely noise explains it.
    At each radius, the evidence of all classes that are alive is added up (log-likelihood
    ratios of shape against noise); the range with the highest sum wins. The confidence is
    ``1 - exp(-lead)``, `lead` being the difference to the best range of another shape.
    """
    if filtration.dimension == 0:
        reason = "All points are at one place: one component at any radius."
        return RadiusChoice(0.0, _RULE, reason)
    pairs = persistence(filtration)
    steps = _steps(filtration, pairs, min_hole)
    wanted = _wanted(betti, components, holes)
    fits = np.ones(len(steps.low), dtype=bool)
    for k, number in enumerate(wanted):
        if number is not None:
            fits &= steps.betti[:, k] == number
    if not fits.any():
        raise ParameterError(
            f"no radius gives {_wish(wanted)}; "
            "see betti_curve() of the persistence for the numbers that there are"
        )
    score = np.where(fits, steps.score, -np.inf)
    return _choice(steps, score)


def _wanted(
    betti: tuple[int, int] | None, components: int | None, holes: int | None
) -> tuple[int | None, int | None]:
    if betti is None:
        return components, holes
    if components is not None or holes is not None:
        raise ParameterError("give either betti=(b0, b1), or components= and holes=, not both")
    return betti[0], betti[1]


def _wish(wanted: tuple[int | None, int | None]) -> str:
    named = zip(wanted, ("components", "holes"), strict=True)
    return " and ".join(f"{number} {what}" for number, what in named if number is not None)


def _expected(filtration: Filtration, radii: FloatArray) -> FloatArray:
    """Return how many points a disc holds on average, judged by nearest neighbours.

    The squared distances of random points to their nearest neighbours, times pi and the
    intensity, are distributed exponentially: half of them are below log(2).
    """
    median = 2.0 * float(np.median(filtration.joined_from))
    with np.errstate(over="ignore"):
        ratio = radii / median if median > 0.0 else radii
        expected = np.minimum(np.log(2.0) * ratio**2, _BEYOND_DOUBT)
        return np.asarray(expected, dtype=np.float64)


def _evidence(
    filtration: Filtration, pairs: Persistence, min_hole: float
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return birth, death and the weight of evidence of each class."""
    n = len(filtration.simplices[0])
    scale = np.log(max(n, 10))  # a class of the shape may have any size: log-uniform
    loops = pairs.diagram(1)
    born, dead = _expected(filtration, loops).T
    weight = dead - np.log(n * dead) - np.log(dead * scale)
    # A loop that closes only over a gap too wide for noise is not of this scale.
    gap = born - np.log(2.0 * n)
    weight = np.where(gap > 0.0, -gap - 1.0, weight)
    weight -= 2.0 * (dead - born < np.minimum(1.0, 0.2 * dead))
    if min_hole > 0.0:
        weight = np.where(loops[:, 1] < min_hole, -np.abs(weight), np.abs(weight))
    joined = pairs.diagram(0)[:, 1]
    joined = joined[np.isfinite(joined)]
    apart = _expected(filtration, joined)
    lone = apart - np.log(2.0 * n) - np.log(np.maximum(apart, 0.1) * scale)
    births = np.concatenate((loops[:, 0], np.zeros(len(joined))))
    return births, np.concatenate((loops[:, 1], joined)), np.concatenate((weight, lone))


def _steps(filtration: Filtration, pairs: Persistence, min_hole: float) -> _Steps:
    births, deaths, weight = _evidence(filtration, pairs, min_hole)
    low, betti = pairs.betti_curve()
    at = np.concatenate((births, deaths))
    change = np.concatenate((weight, -weight))
    order = np.argsort(at, kind="stable")
    total = np.concatenate(([0.0], np.cumsum(change[order])))
    score = total[np.searchsorted(at[order], low, side="right")]
    score = np.asarray(np.round(score, 9), dtype=np.float64)  # equal evidence, equal score
    return _Steps(low, np.append(low[1:], np.inf), betti, score)


def _choice(steps: _Steps, score: FloatArray) -> RadiusChoice:
    best = int(np.argmax(score))
    low, high = float(steps.low[best]), float(steps.high[best])
    b0, b1 = steps.betti[best].tolist()
    radius = (low + min(high, _MARGIN * low)) / 2.0
    others = _others(steps, score, (b0, b1))
    lead = float(score[best] - score[others[0]]) if others else np.inf
    confidence = 1.0 - float(np.exp(-max(lead, 0.0)))
    clear = confidence > 0.5
    rivals = tuple(
        RadiusInterval(
            float(steps.low[i]), float(steps.high[i]), tuple(steps.betti[i].tolist())
        )
        for i in others
    )
    return RadiusChoice(
        radius,
        _RULE,
        _reason(low, high, (b0, b1), rivals, clear),
        interval=(low, high),
        betti=(b0, b1),
        confidence=confidence,
        runners_up=rivals,
        clear=clear,
    )


def _others(steps: _Steps, score: FloatArray, betti: tuple[int, int]) -> list[int]:
    """Return the best ranges that give other shapes, one for each shape."""
    found: dict[tuple[int, ...], int] = {}
    for i in np.argsort(-score, kind="stable")[:1000].tolist():
        shape = tuple(steps.betti[i].tolist())
        if score[i] == -np.inf or len(found) == _RIVALS:
            break
        if shape != betti:
            found.setdefault(shape, i)
    return list(found.values())


def _reason(
    low: float,
    high: float,
    betti: tuple[int, int],
    rivals: tuple[RadiusInterval, ...],
    clear: bool,
) -> str:
    shape = components_and_holes(*betti)
    until = f"up to {high:.4g}" if np.isfinite(high) else "however large the radius"
    text = (
        f"From radius {low:.4g} {until} the shape has {shape}: the small gaps that are left "
        "by chance between random points have closed, and what is left is too large for that."
    )
    if clear or not rivals:
        return text
    rival = rivals[0]
    return (
        f"{text} But the cloud gives no clear answer: radius {rival.low:.4g} with "
        f"{components_and_holes(*rival.betti)} explains it nearly as well."
    )
