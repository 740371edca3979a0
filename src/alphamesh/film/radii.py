"""The radii of a film: chosen so that something happens in every frame."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from alphamesh._arrays import read_only
from alphamesh._weights import refuse_weights
from alphamesh.betti import checked_radii
from alphamesh.errors import ParameterError

if TYPE_CHECKING:
    from alphamesh._arrays import CountArray, FloatArray
    from alphamesh.persistence import Persistence

__all__ = ["RADII_RULES", "film_radii", "last_radius"]

# How much of the film each rule gives to the number of simplices so far; the rest goes to
# the logarithm of the radius.
_SHARE_OF_COUNT: dict[str, float] = {"even": 0.5, "quantiles": 1.0, "log": 0.0}

# Up to this share of the events the logarithm does not count.
_FIRST = 0.02

RADII_RULES = tuple(_SHARE_OF_COUNT)


def film_radii(persistence: Persistence, radii: Any = None, frames: int = 100) -> FloatArray:
    """Return the radius of each frame of a film.

    Parameters
    ----------
    persistence : Persistence
    radii : {"even", "quantiles", "log"} or sequence of float, optional
        ``"quantiles"``: about as many simplices appear from each frame to the next.
        ``"log"``: the radius grows by about the same factor. ``"even"``, the default:
        half-way between, which shows both the many small steps and the few large ones.
        Or the radii themselves, finite and not negative, in the units of the points. With
        weights, ``"even"`` is half-way to steps of equal length, there is no ``"log"``, and
        radii may be negative.
    frames : int, default 100
        How many, unless `radii` lists them: the first at radius 0, with weights where the
        first point appears, the others where the complex changes. If it changes less
        often, the discs grow in the frames between.

    Returns
    -------
    (frames,) float64
        Ascending, unless they were given.

    Raises
    ------
    ParameterError
        If `frames` is not a whole number of at least 2, or `radii` is none of the above.
    UnweightedOnlyError
        If `radii` is ``"log"`` and the points have weights.
    """
    if radii is None:
        radii = "even"
    if not isinstance(radii, str):
        return _given(radii, signed=persistence.filtration.weights is not None)
    if radii not in _SHARE_OF_COUNT:
        raise ParameterError(
            f"there is no rule {radii!r} for the radii of a film; give radii, or one of: "
            + ", ".join(repr(rule) for rule in RADII_RULES)
        )
    given: Any = frames
    if not isinstance(given, int | np.integer) or isinstance(given, bool) or given < 2:
        raise ParameterError(f"frames must be a whole number of at least 2; got {frames!r}")
    if persistence.filtration.weights is not None:
        return _signed(persistence, radii, int(frames))
    events = _events(persistence)
    if len(events) == 0:  # fewer than two points: nothing but one disc grows
        return read_only(np.linspace(0.0, 1.0, frames))
    if len(events) < frames - 1:
        return read_only(np.append(0.0, _between(events, frames - 1)))
    share = _SHARE_OF_COUNT[radii]
    count = np.arange(len(events)) / max(len(events) - 1, 1)
    # The first few events would take up half of all orders of magnitude.
    floor = float(np.quantile(events, _FIRST))
    depth = np.log(np.maximum(events / floor, 1.0))
    along = share * count + (1 - share) * depth / max(float(depth[-1]), 1e-300)
    wanted = np.linspace(0.0, along[-1], frames - 1)
    chosen = np.searchsorted(along, wanted * (1 - 1e-12))
    return read_only(np.append(0.0, events[_distinct(chosen, len(events))]))


def _signed(persistence: Persistence, rule: str, frames: int) -> FloatArray:
    """Return radii of a complex with weights, from where its first point appears."""
    if rule == "log":
        refuse_weights(
            persistence.filtration.weights, "logarithms of radii", 'use "even" or "quantiles"'
        )
    events = np.unique(np.concatenate(persistence.filtration.radii))
    events = events[events <= max(last_radius(persistence), float(events[0]))]
    if len(events) < frames:
        first = float(events[0])
        return read_only(np.append(first, _between(events[1:], frames - 1, first)))
    count = np.arange(len(events)) / (len(events) - 1)
    length = (events - events[0]) / (events[-1] - events[0])
    share = _SHARE_OF_COUNT[rule]
    along = share * count + (1 - share) * length
    chosen = np.searchsorted(along, np.linspace(0.0, 1.0, frames) * (1 - 1e-12))
    return read_only(events[_distinct(chosen, len(events))])


def last_radius(persistence: Persistence) -> float:
    """Return the radius at which there is nothing more to see.

    Beyond it are neither a gap between components nor the hole, loop or void that lasts
    longest, nor does a class come that stays, only flat simplices along the hull, whose
    spheres are far larger than the cloud.
    """
    (_, joined), *holes = zip(persistence.births, persistence.deaths, strict=True)
    signed = persistence.filtration.weights is not None
    last = float(joined.max(initial=-np.inf if signed else 0.0))
    for births, filled in holes:
        if len(births):
            last = max(last, float(filled[np.argmax(filled - births)]))
    # In a periodic box some classes come to stay: those that run around it.
    for values, rows in zip(
        persistence.filtration.radii[1:], persistence.essential[1:], strict=False
    ):
        last = max(last, float(values.take(rows).max(initial=-np.inf)))
    if signed and not np.isfinite(last):  # one component from the first point on
        return float(persistence.filtration.radii[0].max(initial=0.0))
    return 1.1 * last if last >= 0 else 0.9 * last


def _events(persistence: Persistence) -> FloatArray:
    """Return the positive radii up to the end of the film at which the complex changes."""
    events = np.unique(np.concatenate(persistence.filtration.radii[1:]))
    # A cloud that no hole and no gap outlasts still ends with its last change.
    end = last_radius(persistence) or np.inf
    return events[(events > 0) & (events <= end)]


def _between(events: FloatArray, frames: int, first: float = 0.0) -> FloatArray:
    """Return all `events`, and radii in the widest gaps between them and after `first`."""
    if len(events) == 0:  # nothing but the balls grows
        return first + np.linspace(0.0, max(abs(first), 1.0), frames + 1)[1:]
    ends = np.append(first, events)
    parts = np.ones(len(events), dtype=np.int64)
    gaps = np.diff(ends)
    for _ in range(frames - len(events)):
        parts[np.argmax(gaps / parts)] += 1
    steps = [
        low + (high - low) * (np.arange(1, number + 1) / number)
        for low, high, number in zip(ends[:-1], events, parts, strict=True)
    ]
    radii = np.concatenate(steps)
    radii[np.cumsum(parts) - 1] = events  # to the last bit
    return radii


def _distinct(chosen: CountArray, count: int) -> CountArray:
    """Return ascending places below `count` as near to `chosen` as can be without repeats."""
    steps = np.arange(len(chosen))
    forward = np.maximum.accumulate(chosen - steps) + steps
    return np.asarray(np.minimum(forward, count - len(chosen) + steps))


def _given(radii: Any, *, signed: bool) -> FloatArray:
    try:
        array = np.asarray(radii, dtype=np.float64)
    except (TypeError, ValueError):
        array = np.empty(0)
    if array.ndim != 1 or len(array) == 0:
        names = ", ".join(repr(rule) for rule in RADII_RULES)
        raise ParameterError(
            f"radii must be a list of numbers or one of: {names}; got {radii!r}"
        )
    values = checked_radii(array, signed=signed)
    if not np.isfinite(values).all():
        raise ParameterError("the radii of a film must be finite: discs are drawn")
    return read_only(values.copy())
