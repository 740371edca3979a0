"""Wall time, measured in turn: A B C, B C A, C A B, ... so that drift hits all alike."""

from __future__ import annotations

import gc
import math
from collections.abc import Callable, Hashable, Mapping
from dataclasses import dataclass, field
from time import perf_counter
from typing import Generic, TypeVar

__all__ = ["Rounds", "Turns", "forecast", "interleave", "once"]

_Key = TypeVar("_Key", bound=Hashable)
Call = Callable[[], object]

# A job that takes longer than this is not run once more just to warm up.
_WARM_UP_SECONDS = 2.0
_MOST_CALLS = 200_000


@dataclass(frozen=True, slots=True)
class Rounds:
    """How long to measure.

    Attributes
    ----------
    least : int
        Turns that each contestant gets, unless its budget ends before.
    seconds : float
        Short contestants go on taking turns for this long in all.
    budget : float
        A contestant that has used up this many seconds takes no more turns.
    turn : float
        A contestant is called several times in a row in its turn, up to this many seconds.
    """

    least: int = 5
    seconds: float = 2.0
    budget: float = 30.0
    turn: float = 0.003


@dataclass(slots=True)
class Turns(Generic[_Key]):
    """What came of the turns.

    Attributes
    ----------
    samples : dict of key to list of float
        Seconds of each call, in the order in which they were made.
    failures : dict of key to Exception
        The contestants that raised, and left.
    """

    samples: dict[_Key, list[float]]
    failures: dict[_Key, Exception] = field(default_factory=dict)


def once(call: Call) -> float:
    """Return the seconds that one call takes, without the time to free its result."""
    start = perf_counter()
    result = call()
    seconds = perf_counter() - start
    del result
    return seconds


def interleave(
    contestants: Mapping[_Key, Call],
    rounds: Rounds,
    expected: Mapping[_Key, float] | None = None,
) -> Turns[_Key]:
    """Time the contestants in turn, the order rotated by one in each round.

    Parameters
    ----------
    contestants : mapping of key to callable
    rounds : Rounds
    expected : mapping of key to float, optional
        Expected seconds a call. A contestant that is expected to be slow is not warmed up.
    """
    turns: Turns[_Key] = Turns({key: [] for key in contestants})
    gc.collect()
    collecting = gc.isenabled()
    gc.disable()
    try:
        calls = _warm_up(contestants, expected or {}, rounds.turn, turns)
        start = perf_counter()
        done = 0
        while done < rounds.least or perf_counter() - start < rounds.seconds:
            running = [key for key in calls if _goes_on(key, turns, rounds)]
            if not running:
                break
            for key in _rotated(running, done):
                _take(key, contestants[key], calls[key], turns)
            done += 1
    finally:
        if collecting:
            gc.enable()
    return turns


def forecast(history: Mapping[int, float], size: int) -> float:
    """Return the expected seconds at `size` from the seconds at smaller sizes.

    The last two sizes give the exponent of a power law, kept between 1 and 3; with one
    size alone, time is taken to grow with the square.
    """
    smaller = sorted(n for n in history if n < size)
    if not smaller:
        return 0.0
    last = smaller[-1]
    exponent = 2.0
    if len(smaller) > 1:
        before = smaller[-2]
        exponent = math.log(history[last] / history[before]) / math.log(last / before)
    growth: float = (size / last) ** min(max(exponent, 1.0), 3.0)
    return history[last] * growth


def _warm_up(
    contestants: Mapping[_Key, Call],
    expected: Mapping[_Key, float],
    turn: float,
    turns: Turns[_Key],
) -> dict[_Key, int]:
    """Call each contestant that is not slow; return how many calls make one turn of each."""
    calls: dict[_Key, int] = {}
    for key, call in contestants.items():
        if expected.get(key, 0.0) > _WARM_UP_SECONDS:
            calls[key] = 1
        elif seconds := _take(key, call, 2, turns):
            calls[key] = max(1, round(turn / seconds[-1]))
            turns.samples[key].clear()
    return calls


def _take(key: _Key, call: Call, calls: int, turns: Turns[_Key]) -> list[float]:
    """Time a few calls in a row; return all samples, none if the contestant failed."""
    if key in turns.failures:
        return []
    try:
        turns.samples[key] += [once(call) for _ in range(calls)]
    except Exception as error:  # a peer may raise anything: it is reported, and out
        turns.failures[key] = error
        turns.samples[key].clear()
    return turns.samples[key]


def _goes_on(key: _Key, turns: Turns[_Key], rounds: Rounds) -> bool:
    samples = turns.samples[key]
    return (
        key not in turns.failures
        and sum(samples) < rounds.budget
        and len(samples) < _MOST_CALLS
    )


def _rotated(keys: list[_Key], turn: int) -> list[_Key]:
    shift = turn % len(keys)
    return keys[shift:] + keys[:shift]
