"""The choice by topology in words, for readers who never heard of persistence."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from alphamesh.radius._words import apart, components_and_holes, counted, shape_words

if TYPE_CHECKING:
    from alphamesh.radius._choice import RadiusInterval

__all__ = ["Findings", "explain"]


@dataclass(frozen=True, slots=True)
class Findings:
    """What there is to say about a choice.

    Attributes
    ----------
    points : int
    dimension : int
        1 for points on a line, 2 for those in a plane, 3 for those in space.
    interval : RadiusInterval
    noise : float
        The radius of the largest empty disc or ball that chance leaves; 0 if unknown.
    room : float
        How many points would fill the smallest hole; infinite without holes.
    next_change : tuple of int
        How the Betti numbers change at the end of the interval.
    strays, accidents : int
    confidence : float
    clear : bool
    runner_up : RadiusInterval or None
    sheet : bool
        Whether the points are taken to lie on a surface in space.
    """

    points: int
    dimension: int
    interval: RadiusInterval
    noise: float
    room: float
    next_change: tuple[int, ...]
    strays: int
    accidents: int
    confidence: float
    clear: bool
    runner_up: RadiusInterval | None
    sheet: bool = False

    def shape(self, betti: tuple[int, ...]) -> str:
        """Return Betti numbers in words: points in a plane in space have holes, too."""
        return shape_words(betti) if self.dimension == 3 else components_and_holes(*betti[:2])

    @property
    def flat(self) -> bool:
        """Whether points in space lie in one plane."""
        return self.dimension < len(self.interval.betti)


def explain(findings: Findings) -> str:
    """Return a few sentences that say why a radius was chosen."""
    sentences = [
        _shape_sentence(findings),
        _surface_sentence(findings),
        _noise_sentence(findings),
        _holes_sentence(findings),
        _end_sentence(findings),
        _strays_sentence(findings),
        _doubt_sentence(findings),
    ]
    return " ".join(sentence for sentence in sentences if sentence)


def _shape_sentence(findings: Findings) -> str:
    over = _range(findings.interval)
    if findings.dimension == 1:
        shape = counted(findings.interval.betti[0], "component")
        return f"The points lie on one line. {over} they form {shape}."
    shape = findings.shape(findings.interval.betti)
    if findings.flat:
        return f"The points lie in one plane. {over} they form {shape}."
    return f"{over} the {findings.points:,} points form {shape}."


def _surface_sentence(findings: Findings) -> str:
    if not findings.sheet:
        return ""
    return (
        "They are taken to lie on a surface and not within a solid; to make a closed surface "
        'of a scan, see the rule "enclosed".'
    )


def _range(interval: RadiusInterval) -> str:
    if math.isinf(interval.high):
        return f"From radius {interval.low:.4g} on"
    return f"From radius {apart(interval.low, interval.high)[0]} to {_end(interval)}"


def _end(interval: RadiusInterval) -> str:
    return apart(interval.low, interval.high)[1]


def _noise_sentence(findings: Findings) -> str:
    if findings.dimension == 1:
        return "The gaps within these are no longer than chance leaves between random points."
    if findings.noise > findings.interval.low:
        return (
            "Smaller radii leave gaps that mean nothing: they are no larger than chance "
            "leaves between points strewn at random, as densely as these."
        )
    solid = findings.dimension == 3 and not findings.sheet
    return (
        "Smaller radii leave gaps that mean nothing: points strewn at random, as densely as "
        f"these, leave empty {'balls' if solid else 'discs'} of a radius up to about "
        f"{findings.noise:.3g}."
    )


def _holes_sentence(findings: Findings) -> str:
    numbers = findings.interval.betti[1:]
    if sum(numbers) == 0 or math.isinf(findings.room):
        return ""
    room = counted(max(round(findings.room), 1), "point")
    names = _hole_names(findings.dimension)
    there = [pair for pair in zip(numbers, names, strict=False) if pair[0]]
    one = sum(numbers) == 1
    if one:
        which = f"The {there[0][1]}"
    else:
        which = " and ".join(f"the {_the(*pair)}" for pair in there)
    if not findings.clear:
        which = which if one else f"The smallest of {which}"
        return f"{which} would have room for about {room}."
    smallest = "it" if one else "the smallest"
    return (
        f"{which[0].upper()}{which[1:]} {'is' if one else 'are'} too large for chance: "
        f"{smallest} would have room for about {room}."
    )


def _hole_names(dimension: int) -> tuple[str, ...]:
    return ("tunnel", "void") if dimension == 3 else ("hole",)


def _the(number: int, name: str) -> str:
    return name if number == 1 else f"{number:,} {name}s"


def _end_sentence(findings: Findings) -> str:
    if math.isinf(findings.interval.high):
        return ""
    components, holes, *voids = findings.next_change
    hole = _hole_names(findings.dimension)[0]
    if components < 0:
        what = "components that stood apart are joined"
    elif min(voids, default=0) < 0:
        what = "a void is filled"
    elif holes < 0:
        what = f"a {hole} is filled"
    elif max(voids, default=0) > 0:
        what = "a hollow is closed off as if it were a void"
    elif holes > 0 and findings.dimension == 3:
        what = "a bay is bridged as if there were a tunnel"
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
        holes = "tunnels and voids" if findings.dimension == 3 else "holes"
        look = "looks like an accident" if findings.accidents == 1 else "look like accidents"
        doubts.append(
            f"{findings.accidents:,} of the {holes} {look} of chance or of outliers, which no "
            "radius avoids"
        )
    if findings.runner_up is not None and not findings.clear and not doubts:
        other = findings.runner_up
        doubts.append(
            f"{findings.shape(other.betti)}, {_range(other).lower()}, would be nearly as likely"
        )
    if not doubts:
        return "" if findings.clear else "The cloud gives no clear answer: it has few points."
    return f"The cloud gives no clear answer: {'; '.join(doubts)}."
