"""The choice by topology in words, for readers who never heard of persistence."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from alphamesh.radius._words import apart, components_and_holes, counted

if TYPE_CHECKING:
    from alphamesh.radius._choice import RadiusInterval

__all__ = ["Findings", "explain"]


@dataclass(frozen=True, slots=True)
class Findings:
    """What there is to say about a choice.

    Attributes
    ----------
    points : int
    on_a_line : bool
    interval : RadiusInterval
    noise : float
        The radius of the largest empty disc that chance leaves; 0 if unknown.
    room : float
        How many points would fill the smallest hole; infinite without holes.
    next_change : tuple of int
        How the numbers of components and holes change at the end of the interval.
    strays, accidents : int
    confidence : float
    clear : bool
    runner_up : RadiusInterval or None
    """

    points: int
    on_a_line: bool
    interval: RadiusInterval
    noise: float
    room: float
    next_change: tuple[int, int]
    strays: int
    accidents: int
    confidence: float
    clear: bool
    runner_up: RadiusInterval | None


def explain(findings: Findings) -> str:
    """Return a few sentences that say why a radius was chosen."""
    sentences = [
        _shape_sentence(findings),
        _noise_sentence(findings),
        _holes_sentence(findings),
        _end_sentence(findings),
        _strays_sentence(findings),
        _doubt_sentence(findings),
    ]
    return " ".join(sentence for sentence in sentences if sentence)


def _shape_sentence(findings: Findings) -> str:
    shape = components_and_holes(*findings.interval.betti)
    if findings.on_a_line:
        shape = counted(findings.interval.betti[0], "component")
        return f"The points lie on one line. {_range(findings.interval)} they form {shape}."
    return f"{_range(findings.interval)} the {findings.points:,} points form {shape}."


def _range(interval: RadiusInterval) -> str:
    if math.isinf(interval.high):
        return f"From radius {interval.low:.4g} on"
    return f"From radius {apart(interval.low, interval.high)[0]} to {_end(interval)}"


def _end(interval: RadiusInterval) -> str:
    return apart(interval.low, interval.high)[1]


def _noise_sentence(findings: Findings) -> str:
    if findings.on_a_line:
        return "The gaps within these are no longer than chance leaves between random points."
    if findings.noise > findings.interval.low:
        return (
            "Smaller radii leave gaps that mean nothing: they are no larger than chance "
            "leaves between points strewn at random, as densely as these."
        )
    return (
        "Smaller radii leave gaps that mean nothing: points strewn at random, as densely as "
        f"these, leave empty discs of a radius up to about {findings.noise:.3g}."
    )


def _holes_sentence(findings: Findings) -> str:
    holes = findings.interval.betti[1]
    if holes == 0 or math.isinf(findings.room):
        return ""
    room = counted(max(round(findings.room), 1), "point")
    if not findings.clear:
        which = "The hole" if holes == 1 else f"The smallest of the {holes:,} holes"
        return f"{which} would have room for about {room}."
    which = "The hole is" if holes == 1 else f"The {holes:,} holes are"
    smallest = "it" if holes == 1 else "the smallest"
    return f"{which} too large for chance: {smallest} would have room for about {room}."


def _end_sentence(findings: Findings) -> str:
    if math.isinf(findings.interval.high):
        return ""
    components, holes = findings.next_change
    if components < 0:
        what = "components that stood apart are joined"
    elif holes < 0:
        what = "a hole is filled"
    elif holes > 0:
        what = "a bay of the outline is closed off as if it were a hole"
    else:
        what = "outliers form a piece of their own"
    return f"At radius {_end(findings.interval)} {what}."


def _strays_sentence(findings: Findings) -> str:
    if findings.strays == 0:
        return ""
    if findings.strays == 1:
        return "1 small piece stands apart, as outliers do, and is not counted as a component."
    return (
        f"{findings.strays:,} small pieces stand apart, as outliers do, and are not counted as "
        "components."
    )


def _doubt_sentence(findings: Findings) -> str:
    doubts = []
    if findings.accidents:
        look = "looks like an accident" if findings.accidents == 1 else "look like accidents"
        doubts.append(
            f"{findings.accidents:,} of the holes {look} of chance or of outliers, which no "
            "radius avoids"
        )
    if findings.runner_up is not None and not findings.clear and not doubts:
        other = findings.runner_up
        doubts.append(
            f"{components_and_holes(*other.betti)}, {_range(other).lower()}, would be nearly "
            "as likely"
        )
    if not doubts:
        return "" if findings.clear else "The cloud gives no clear answer: it has few points."
    return f"The cloud gives no clear answer: {'; '.join(doubts)}."
